"""A recorded drive through the GPS/DR filters: wheels each 100 ms, the newest fix each second (ins/gps_dr.h)."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from libins import _post
from libins.errors import UsageError
from libins.recording import Array, Gnss, Wheels, choose
from libins.replay import CHUNK_S, Drive, Progress, Run, Solution, fix_rows, phases, windows, within
from libins.replay_config import Config

TICK_S = 0.1
FIX_TICKS = 10
"""The paper's two tasks."""


def wheel_ticks(wheels: Wheels) -> Array:
    """As events each TICK_S: the way and the turn since the one before. Raises UsageError."""
    ticks = wheels.t[0] + TICK_S * np.arange(int((wheels.t[-1] - wheels.t[0]) / TICK_S + 1e-6) + 1)
    columns = []
    for name, values in (("speed", wheels.speed), ("yaw_rate", wheels.yaw_rate)):
        known = np.isfinite(values)
        if not known.any():
            raise UsageError(f"{wheels.path}: wheels.columns: no {name} is among them, and dead reckoning needs it")
        columns.append(np.interp(0.5 * (ticks[1:] + ticks[:-1]), wheels.t[known], values[known]))
    return np.ascontiguousarray(np.column_stack([ticks[1:], np.full(len(ticks) - 1, TICK_S), *columns]))


def newest(gnss: Gnss, seconds: Array, withheld: Array) -> Gnss:
    """Of the fixes that are not withheld, the last before each second."""
    usable = np.flatnonzero(~withheld)
    last = np.searchsorted(gnss.t[usable], seconds + 1e-6, "right") - 1
    fresh = np.diff(last, prepend=-1) > 0
    return choose(gnss, usable[last[fresh]])


def rows_of_fixes(drive: Drive, spans: Sequence[tuple[float, float]], ticks: Array) -> Array:
    """Those of the tasks of a second, when they run; what is withheld, or the reference, to compare."""
    seconds = ticks[FIX_TICKS - 1 :: FIX_TICKS]
    withheld = within(drive.gnss.t, spans)
    used = newest(drive.gnss, seconds, withheld)
    compared = drive.reference if drive.reference is not None else choose(drive.gnss, withheld)
    given = fix_rows(replace(drive, gnss=used, reference=None), [], seconds, 0.0)
    told = fix_rows(replace(drive, gnss=compared, reference=None), [(-np.inf, np.inf)], ticks, 0.0)
    rows = np.vstack([given, told])
    return np.ascontiguousarray(rows[np.lexsort((rows[:, 1], rows[:, 0]))])


def one_pass(config: Config, drive: Drive, spans: Sequence[tuple[float, float]], progress: Progress) -> Run:
    """The whole drive. Raises UsageError when no fix came with the wheels."""
    assert drive.wheels is not None
    table = config.gps_dr
    kind = "ours" if config.filter == "gps_dr" else table.reading
    settings = {"tau_fix": table.tau_fix_s, "sigma_bias": table.gyro_bias_rad_s, "sigma_scale": table.odometer_scale}
    filter_ = _post.GpsDr(kind, settings, table.uere_m)
    wheels = wheel_ticks(drive.wheels)
    fixes = rows_of_fixes(drive, spans, wheels[:, 0])
    none = np.zeros((0, len(_post.INCREMENT_COLUMNS)))
    replay = _post.Replay(filter_, none, wheels, fixes, 1.0 / config.output.rate_hz)
    first, last = wheels[0, 0], wheels[-1, 0]
    while not replay.done:
        replay.run(replay.time_s + CHUNK_S)
        progress(min(1.0, (replay.time_s - first) / (last - first)))
    states = replay.states
    if not len(states):
        raise UsageError(f"{drive.gnss.path}: no fix came while the wheels of {drive.wheels.path} were recorded")
    how = f"{states[0, 0]:.2f} s: at the first fix"
    return Run(states, replay.covariances, replay.checks, None, filter_.counts(), (how,))


def solve(config: Config, drive: Drive, progress: Progress) -> Solution:
    """One pass for each phase of the outages."""
    shifts = phases(config.outages)
    spans = tuple(tuple(windows(config, drive, shift_s)) for shift_s in shifts)
    runs = []
    for k, its in enumerate(spans):

        def done(share: float, base: float = float(k)) -> None:
            progress((base + share) / len(spans))

        runs.append(one_pass(config, drive, its, done))
    settings: dict[str, Any] = dict(vars(config.gps_dr))
    return Solution(tuple(runs), spans, settings, ())
