"""The true motion of a scenario's sensors."""

from typing import Any

import numpy as np

from libins import _run, fixture
from libins.errors import UsageError
from libins.tables import Loaded, Motion, Sinusoid


def built_motion(ins: Any, motion: Motion, rows: np.ndarray[Any, Any] | None) -> Any:
    """A motion of the module ins, libins._run or libins._truth; rows: its file. Raises ValueError."""

    def sine(s: Sinusoid) -> list[float]:
        return [s.offset_rad, s.amplitude_rad, s.frequency_hz, s.phase_rad]

    if motion.kind == "csv":
        assert rows is not None
        t = rows[:, 0].tolist()
        yaw, pitch, roll = (column.tolist() for column in np.unwrap(rows[:, 1:], axis=0).T)
        return ins.motion_table(t, yaw, pitch, roll, motion.ramp_s)
    if motion.kind == "fixture":
        t, yaw, pitch, roll = (column.tolist() for column in fixture.rows(motion))
        return ins.motion_table(t, yaw, pitch, roll, motion.ramp_s)
    if motion.kind == "coning":
        return ins.motion_coning(motion.half_angle_rad, motion.frequency_hz, motion.ramp_s)
    if motion.kind == "sinusoids":
        return ins.motion_euler(sine(motion.yaw), sine(motion.pitch), sine(motion.roll), motion.ramp_s)
    rate = motion.rate_rad_s if motion.kind == "constant_rate" else [0.0, 0.0, 0.0]
    return ins.motion_rate(rate, motion.ramp_s)


def motion_of(scenario: Loaded) -> Any:
    """The scenario's motion. Raises UsageError."""
    try:
        return built_motion(_run, scenario.tables.motion, scenario.csv)
    except ValueError as error:
        raise UsageError(f"{scenario.path}: motion: {error}") from error
