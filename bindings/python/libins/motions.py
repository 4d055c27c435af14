"""The true motion of a scenario's sensors."""

from typing import Any

import numpy as np

from libins import _run
from libins.errors import UsageError
from libins.tables import Loaded, Sinusoid


def motion_of(scenario: Loaded) -> Any:
    """The scenario's motion. Raises UsageError."""

    def sine(s: Sinusoid) -> list[float]:
        return [s.offset_rad, s.amplitude_rad, s.frequency_hz, s.phase_rad]

    motion = scenario.tables.motion
    try:
        if motion.kind == "csv":
            assert scenario.csv is not None
            t = scenario.csv[:, 0].tolist()
            yaw, pitch, roll = (column.tolist() for column in np.unwrap(scenario.csv[:, 1:], axis=0).T)
            return _run.motion_table(t, yaw, pitch, roll, motion.ramp_s)
        if motion.kind == "coning":
            return _run.motion_coning(motion.half_angle_rad, motion.frequency_hz, motion.ramp_s)
        if motion.kind == "sinusoids":
            return _run.motion_euler(sine(motion.yaw), sine(motion.pitch), sine(motion.roll), motion.ramp_s)
        rate = motion.rate_rad_s if motion.kind == "constant_rate" else [0.0, 0.0, 0.0]
        return _run.motion_rate(rate, motion.ramp_s)
    except ValueError as error:
        raise UsageError(f"{scenario.path}: motion: {error}") from error
