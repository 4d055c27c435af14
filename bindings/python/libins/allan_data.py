"""Samples of sensors at rest from a recording, in stretches between gaps and motion. SI."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from libins import recording_csv
from libins.errors import UsageError
from libins.recording import Array, Findings
from libins.recording_imu import GAP_PERIODS, UNITS

FORCES, RATES = ("fx", "fy", "fz"), ("wx", "wy", "wz")
WINDOW_S = 1.0
"""Over which motion is looked for."""
QUIET = 0.05
"""Quantile of the windows' standard deviations that is taken as the sensor's own noise."""
MOVES = 2.0
"""Times that noise: the sensor moves."""
LEAST_STRETCH_S = 3.0


@dataclass(frozen=True)
class Declared:
    """What the columns of the file are."""

    columns: list[str]
    force_unit: str
    rate_unit: str
    time_scale: float
    rate_hz: float | None
    increments: bool


@dataclass(frozen=True)
class AtRest:
    """Stretches of each column, in its unit a second; first sample of each stretch, and the period."""

    stretches: dict[str, list[Array]]
    starts_s: list[float]
    dt: float

    @property
    def seconds(self) -> float:
        """Of all stretches."""
        return self.dt * sum(len(x) for x in next(iter(self.stretches.values())))


def unit(text: str, key: str, kind: str) -> float:
    """Factor to SI of "deg/s" or, for codes, "2.4e-4 rad/s". Raises UsageError."""
    factor, _, name = text.rpartition(" ")
    known = [u for u in UNITS if u.endswith("/s") == (kind == "rate")]
    try:
        value = float(factor) if factor else 1.0
    except ValueError:
        value = 0.0
    if name not in known or not 0 < value < np.inf:
        raise UsageError(
            f"{key} {text!r}: one of {', '.join(known)} is needed; of codes with what one is worth before it, "
            f"'2e-4 {known[0]}'"
        )
    return value * UNITS[name]


def _period(path: Path, found: dict[str, Array], declared: Declared) -> tuple[Array, float]:
    """Times and the mean period between gaps. Raises UsageError."""
    length = len(next(iter(found.values())))
    if "time" not in found:
        if declared.rate_hz is None:
            raise UsageError(f"{path}: no column is `time`: name it in --columns, or give --rate-hz")
        return np.arange(length) / declared.rate_hz, 1 / declared.rate_hz
    t = (found["time"] - found["time"][0]) * declared.time_scale
    steps = np.diff(t)
    if not np.all(steps > 0):
        row = int(np.argmin(steps > 0))
        raise UsageError(
            f"{path}: row {row + 2}: time {found['time'][row + 1]!r} after {found['time'][row]!r}; times must "
            "increase: sort the file, or leave the column out ('-') and give --rate-hz"
        )
    return t, float(np.mean(steps[steps < GAP_PERIODS * np.median(steps)]))


def moving(values: Array, dt: float) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """Windows of WINDOW_S in which any column moves."""
    rows = max(2, round(WINDOW_S / dt))
    windows = values[: len(values) // rows * rows].reshape(-1, rows, values.shape[1])
    spread = windows.std(axis=1)
    own = np.quantile(spread, QUIET, axis=0)
    steps = np.abs(np.diff(values, axis=0))
    least_step = np.array([np.min(s[s > 0], initial=np.inf, where=True) if np.any(s > 0) else 0.0 for s in steps.T])
    return np.asarray(np.any(spread > np.maximum(MOVES * own, least_step), axis=1))


def _stretches(t: Array, values: Array, dt: float, rest: bool | None, path: Path) -> list[slice]:
    """Rows between gaps and, with rest, motion."""
    breaks = set((np.flatnonzero(np.diff(t) > GAP_PERIODS * dt) + 1).tolist()) | {0, len(t)}
    if rest is not None:
        rows = max(2, round(WINDOW_S / dt))
        moves = moving(values, dt)
        if moves.any() and not rest:
            at = int(np.argmax(moves)) * rows
            raise UsageError(
                f"{path}: the sensor moves, first about {t[at]:.1f} s after the start ({moves.sum()} of {len(moves)} "
                "seconds): give --rest to take what lies between, --all to take everything, or --from-s and --to-s"
            )
        # The windows beside a motion go with it.
        wide = np.convolve(moves, [1, 1, 1], "same") > 0
        edges = np.flatnonzero(np.diff(np.concatenate([[True], wide, [True]]).astype(int)))
        still = list(zip((edges[::2] * rows).tolist(), (edges[1::2] * rows).tolist(), strict=True))
    else:
        still = [(0, len(t))]
    out = []
    for begin, end in still:
        cuts = sorted({begin, end, *(b for b in breaks if begin < b < end)})
        out += [slice(a, b) for a, b in zip(cuts, cuts[1:], strict=False) if (b - a) * dt >= LEAST_STRETCH_S]
    if not out:
        raise UsageError(
            f"{path}: nothing is at rest for {LEAST_STRETCH_S:g} s; a recording of a sensor that lies still is needed"
        )
    return out


def load(path: Path, declared: Declared, span_s: tuple[float, float], rest: bool | None) -> AtRest:
    """Read and convert; rest: True takes rest alone, False refuses motion, None takes everything. Raises UsageError."""
    findings = Findings()
    found = recording_csv.table(path, declared.columns, ("time", *FORCES, *RATES), findings)
    t, dt = _period(path, found, declared)
    factors = dict.fromkeys(FORCES, unit(declared.force_unit, "--force-unit", "force"))
    factors |= dict.fromkeys(RATES, unit(declared.rate_unit, "--rate-unit", "rate"))
    names = [name for name in (*FORCES, *RATES) if name in found]
    if not names:
        raise UsageError(f"{path}: --columns: none of {', '.join((*FORCES, *RATES))} is among them")
    within = (t >= span_s[0]) & (t <= span_s[1])
    if not within.any():
        raise UsageError(
            f"{path}: no sample lies in --from-s {span_s[0]:g} .. --to-s {span_s[1]:g}; the file has {t[-1]:g} s"
        )
    scale = 1 / dt if declared.increments else 1.0
    values = np.column_stack([found[name] * factors[name] * scale for name in names])[within]
    if not np.isfinite(values).all():
        row = int(np.argmin(np.isfinite(values).all(axis=1)))
        raise UsageError(
            f"{path}: {t[within][row]:.3f} s after the start: a field is no number; take it out, or end before it "
            "(--to-s)"
        )
    slices = _stretches(t[within], values, dt, rest, path)
    return AtRest(
        {name: [values[s, i] for s in slices] for i, name in enumerate(names)},
        [float(t[within][s.start]) for s in slices],
        dt,
    )
