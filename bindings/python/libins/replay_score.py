"""What a replay has to show in figures: errors against fixes, also those withheld, innovations, what was refused."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from libins import core
from libins.recording import Array, Gnss
from libins.replay import CHECK, STATE, Drive, Run, Solution, within
from libins.replay_config import Config

BOUND_95 = 3.8414588
"""Chi-squared, one degree of freedom."""
POSITION_REFUSED = 7
"""Bits of `refused`."""
NIS_NAMES = ("nis_n", "nis_e", "nis_d", "nis_vn", "nis_ve", "nis_vd")


def rms(values: Array) -> float | None:
    """None of nothing."""
    known = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(known**2))) if len(known) else None


def quantile(values: Array, share: float) -> float | None:
    """None of nothing."""
    known = values[np.isfinite(values)]
    return float(np.quantile(known, share)) if len(known) else None


def columns(table: Array, names: dict[str, int], *wanted: str) -> Array:
    """Some columns of a table."""
    part: Array = table[:, [names[name] for name in wanted]]
    return part


def horizontal(checks: Array, when: str) -> Array:
    """Distance of the filter from each fix [m]."""
    return np.asarray(np.hypot(*columns(checks, CHECK, f"dp_n_{when}", f"dp_e_{when}").T))


def outages_of(run: Run, spans: Sequence[tuple[float, float]]) -> list[dict[str, Any]]:
    """How far off it was at the last fix withheld in each, horizontally, and what the filter thought of that."""
    found = []
    t, off = run.checks[:, CHECK["t_s"]], horizontal(run.checks, "before")
    for begin, end in spans:
        inside = np.flatnonzero((t >= begin) & (t < end) & (run.checks[:, CHECK["withheld"]] > 0))
        if not len(inside):
            continue
        last = inside[-1]
        at = min(int(np.searchsorted(run.states[:, STATE["t_s"]], t[last])), len(run.states) - 1)
        sigma = np.hypot(*run.states[at, [STATE["sigma_n_m"], STATE["sigma_e_m"]]])
        speed = float(np.linalg.norm(run.states[at, STATE["v_n_m_s"] : STATE["v_d_m_s"]]))
        found.append(
            {
                "from_s": float(begin),
                "to_s": float(end),
                "end_m": float(off[last]),
                "max_m": float(off[inside].max()),
                "sigma_m": float(sigma),
                "down_m": None if np.isnan(down := run.checks[last, CHECK["dp_d_before"]]) else float(down),
                "speed_m_s": speed,
            }  # fmt: skip
        )
    return found


def of_ends(outages: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """Median, rms and largest of the errors at their ends."""
    ends = np.array([outage["end_m"] for outage in outages])
    if not len(ends):
        return {"count": 0, "median_m": None, "rms_m": None, "max_m": None}
    return {"count": len(ends), "median_m": float(np.median(ends)), "rms_m": rms(ends), "max_m": float(ends.max())}


def smoothed_errors(config: Config, drive: Drive, smoothed: Array) -> tuple[Array, Array]:
    """Times of fixes within the smoothed run, and the antenna less each: north, east, down [m]."""
    fixes: Gnss = drive.reference or drive.gnss
    t = smoothed[:, STATE["t_s"]]
    inside = (fixes.t >= t[0]) & (fixes.t <= t[-1])
    at, given = fixes.t[inside], fixes.position[inside]
    q = columns(smoothed, STATE, "q_w", "q_x", "q_y", "q_z")
    arm = core.quat_rotate(q, np.broadcast_to(config.gnss.lever_arm_m, (len(q), 3)).copy())
    radii = np.array([core.earth_radii(float(np.sin(given[0, 0])))]).ravel() + given[0, 2]
    metres = np.array([radii[0], radii[1] * np.cos(given[0, 0]), -1.0])
    place = columns(smoothed, STATE, "latitude_rad", "longitude_rad", "height_m") + arm / metres
    here = np.column_stack([np.interp(at, t, place[:, axis]) for axis in range(3)])
    return at, (here - given) * metres


def _smoothed(config: Config, drive: Drive, run: Run, spans: Sequence[tuple[float, float]]) -> dict[str, Any] | None:
    if run.smoothed is None:
        return None
    t, error = smoothed_errors(config, drive, run.smoothed)
    off, hidden = np.hypot(error[:, 0], error[:, 1]), within(t, spans)
    return {
        "aided_rms_m": rms(off[~hidden]),
        "withheld_rms_m": rms(off[hidden]),
        "withheld_max_m": float(off[hidden].max()) if hidden.any() else None,
    }


def summary(config: Config, drive: Drive, solution: Solution) -> dict[str, Any]:
    """Everything, for JSON and for people."""
    run, spans = solution.runs[0], solution.spans[0]
    checks = run.checks
    hidden = within(checks[:, CHECK["t_s"]], spans)
    given = ~hidden & (checks[:, CHECK["withheld"]] == 0)
    refused = given & ((checks[:, CHECK["refused"]].astype(int) & POSITION_REFUSED) > 0)
    plain = checks[given & ~refused]
    used = given & ~refused if drive.reference is None else ~hidden & (checks[:, CHECK["withheld"]] > 0)
    kind = "after" if drive.reference is None else "before"
    nis = {}
    for name in NIS_NAMES:
        values = checks[:, CHECK[name]]
        values = values[np.isfinite(values)]
        nis[name.removeprefix("nis_")] = {
            "count": len(values),
            "mean": float(values.mean()) if len(values) else None,
            "above_95": float(np.mean(values > BOUND_95)) if len(values) else None,
        }
    pooled = [
        outage | {"phase": k}
        for k, (each, its) in enumerate(zip(solution.runs, solution.spans, strict=True))
        for outage in outages_of(each, its)
    ]
    return {
        "filter": config.filter,
        "vehicle": config.vehicle,
        "seconds": float(run.states[-1, 0] - run.states[0, 0]),
        "starts": list(run.starts),
        "notes": [*drive.notes, *solution.notes],
        "files": dict(drive.findings.counts),
        "found": list(drive.findings.notes),
        "filter_counts": run.counts,
        "against": "reference" if drive.reference is not None else "fixes",
        "aided": {
            "count": int(used.sum()),
            "refused": int(refused.sum()),
            "horizontal_rms_m": rms(off := horizontal(checks[used], kind)),
            "horizontal_median_m": quantile(off, 0.5),
            "horizontal_95_m": quantile(off, 0.95),
            "horizontal_max_m": quantile(off, 1.0),
            "vertical_rms_m": rms(checks[used, CHECK[f"dp_d_{kind}"]]),
            "velocity_rms_m_s": rms(
                np.linalg.norm(columns(checks[used], CHECK, *(f"dv_{i}_{kind}" for i in "ned")), axis=1)
            ),
        },
        "innovation": {
            "horizontal_rms_m": rms(horizontal(plain, "before")),
            "vertical_rms_m": rms(plain[:, CHECK["dp_d_before"]]),
            "velocity_rms_m_s": rms(
                np.linalg.norm(columns(plain, CHECK, "dv_n_before", "dv_e_before", "dv_d_before"), axis=1)
            ),
        },
        "nis": nis,
        "outages": of_ends(pooled) | {"inside_rms_m": rms(horizontal(checks[hidden], "before")), "list": pooled},
        "smoothed": _smoothed(config, drive, run, spans),
    }


def _number(value: float | None, digits: int = 3) -> str:
    return "-" if value is None else f"{value:.{digits}f}"


def text(result: dict[str, Any]) -> str:
    """The summary for a terminal."""
    aided, innovation, outages = result["aided"], result["innovation"], result["outages"]
    lines = [
        f"{result['filter']}, {result['vehicle']}: {result['seconds']:.1f} s navigated",
        *(f"start     {how}" for how in result["starts"]),
        *(f"note      {note}" for note in result["notes"]),
        *(f"file      {found}" for found in result["found"]),
        *(f"filter    {what}: {count}" for what, count in result["filter_counts"].items() if count),
        f"aided     {aided['count']} {result['against']}, {aided['refused']} refused: horizontal rms "
        f"{_number(aided['horizontal_rms_m'])} m, "
        f"vertical {_number(aided['vertical_rms_m'])} m, velocity {_number(aided['velocity_rms_m_s'])} m/s",
        f"          median {_number(aided['horizontal_median_m'])} m, 95 % {_number(aided['horizontal_95_m'])} m, "
        f"max {_number(aided['horizontal_max_m'])} m",
        f"ahead     before each fix: horizontal rms {_number(innovation['horizontal_rms_m'])} m, vertical "
        f"{_number(innovation['vertical_rms_m'])} m, velocity {_number(innovation['velocity_rms_m_s'])} m/s",
        "NIS       mean (share above the 95 % bound): "
        + ", ".join(
            f"{name} {_number(nis['mean'], 2)} ({100.0 * nis['above_95']:.1f} %)"
            for name, nis in result["nis"].items()
            if nis["count"]
        ),
    ]
    if outages["list"]:
        lines += ["outage    phase   from s     to s   speed m/s   error at end m   filter's sigma m"]
        lines += [
            f"          {o['phase']:5d} {o['from_s']:8.1f} {o['to_s']:8.1f} {o['speed_m_s']:11.1f} {o['end_m']:16.2f} "
            f"{o['sigma_m']:18.2f}"
            for o in outages["list"]
        ]
        lines.append(
            f"outages   {outages['count']}: error at the end median {_number(outages['median_m'], 2)} m, rms "
            f"{_number(outages['rms_m'], 2)} m, max {_number(outages['max_m'], 2)} m"
        )
    if (smoothed := result["smoothed"]) is not None:
        lines.append(
            f"smoothed  horizontal rms {_number(smoothed['aided_rms_m'])} m; within outages rms "
            f"{_number(smoothed['withheld_rms_m'])} m, max {_number(smoothed['withheld_max_m'])} m"
        )
    return "\n".join(lines)
