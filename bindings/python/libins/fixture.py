"""A calibration fixture: rests in known attitudes, with smooth turns between them. Frames: b, n (NED); rad, s."""

from typing import Any

import numpy as np

from libins.tables import Motion

Array = np.ndarray[Any, np.dtype[np.float64]]

ROW_S = 0.05
"""Between the rows that the motion's spline joins."""


def rests(motion: Motion) -> list[tuple[float, float]]:
    """Begin and end of each rest."""
    starts = [i * (motion.rest_s + motion.turn_s) for i in range(len(motion.up_b))]
    return [(start, start + motion.rest_s) for start in starts]


def rows(motion: Motion) -> tuple[Array, Array, Array, Array]:
    """Rows of t, yaw, pitch, roll. Yaw is 0; a turn has neither a jump nor a corner in its rate."""
    up = np.array(motion.up_b) / np.linalg.norm(motion.up_b, axis=1, keepdims=True)
    pitch, roll = np.arcsin(up[:, 0]), np.unwrap(np.arctan2(-up[:, 1], -up[:, 2]))
    period = motion.rest_s + motion.turn_s
    t = np.linspace(0.0, period * len(up), max(4, round(period * len(up) / ROW_S)) + 1)
    at = np.minimum((t / period).astype(int), len(up) - 1)
    x = np.clip((t - at * period - motion.rest_s) / motion.turn_s, 0.0, 1.0)
    part = x**3 * (10 - 15 * x + 6 * x**2)
    after = np.minimum(at + 1, len(up) - 1)
    return (
        t,
        np.zeros(len(t)),
        pitch[at] + part * (pitch[after] - pitch[at]),
        roll[at] + part * (roll[after] - roll[at]),
    )
