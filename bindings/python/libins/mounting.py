"""How an IMU sits in a car, from which way it moves: no wheel slips much sideways, and none leaves the road."""

from dataclasses import dataclass

import numpy as np

from libins import core
from libins.recording import Array

SPEED = 5.0
"""From which on a velocity shows it [m/s]."""
SECONDS = 20.0
SLIP_MAX = 0.5
"""More, and it is no car [m/s]."""
WHEEL_MAX_M = 5.0
SIGMA_MIN = 0.2
SLIP_S = 1.0
"""How long a slip lasts."""


@dataclass(frozen=True)
class Mount:
    """Turn from the IMU's axes to the car's, the way to the axle that does not slip, and how little that does."""

    c: Array
    wheel_m: float
    sigma: float
    """Of one non-holonomic constraint, as white noise [m/s]."""


def _line(rows: Array, values: Array) -> tuple[Array, float]:
    """Coefficients without what is far off, and the median deviation as a standard deviation."""
    kept = np.ones(len(values), bool)
    for _ in range(3):
        found = np.linalg.lstsq(rows[kept], values[kept], rcond=None)[0]
        off = np.abs(values - rows @ found)
        spread = 1.4826 * float(np.median(off))
        kept = off <= 3.0 * max(spread, 1e-3)
    return np.array(found), spread


def find(t: Array, v_n: Array, q_nb: Array, aided: Array, rate_hz: float) -> tuple[Mount | None, str]:
    """What the aided states say, and the same in words; None: they do not.

    rate_hz: of the constraint.
    """
    v_b = core.quat_rotate(core.quat_conj(q_nb), v_n)
    turning = np.gradient(np.unwrap(core.quat_to_euler(q_nb)[:, 2]), t)
    speed = np.linalg.norm(v_n, axis=1)
    fast = aided & (speed > SPEED)
    about = float(np.angle(np.sum(v_b[fast, 0] + 1j * v_b[fast, 1])))
    coarse = np.array([[np.cos(about), np.sin(about), 0.0], [-np.sin(about), np.cos(about), 0.0], [0.0, 0.0, 1.0]])
    v_b = v_b @ coarse.T
    fast &= v_b[:, 0] > 0.5 * speed
    if fast.sum() * np.median(np.diff(t)) < SECONDS:
        return None, "not long enough ahead at speed to see how the IMU is mounted: no non-holonomic constraint"
    ahead = v_b[fast, 0]
    (yaw, wheel), sideways = _line(np.column_stack([ahead, turning[fast]]), v_b[fast, 1])
    (pitch,), vertical = _line(ahead[:, None], -v_b[fast, 2])
    told = (
        f"mounted {np.rad2deg(-about - yaw):+.2f} deg to the right, {np.rad2deg(-pitch):+.2f} deg up, {wheel:+.2f} m "
        f"ahead of the axle; slips {sideways:.2f} m/s sideways, {vertical:.2f} m/s upward"
    )
    if max(sideways, vertical) > SLIP_MAX or abs(wheel) > WHEEL_MAX_M:
        return None, f"{told}: no non-holonomic constraint"
    back = np.asarray(core.quat_to_dcm(core.quat_from_euler(np.array([0.0, pitch, yaw])))).reshape(3, 3).T
    coloured = np.sqrt(2.0 * SLIP_S * rate_hz) * max(sideways, vertical)
    return Mount(back @ coarse, float(wheel), max(SIGMA_MIN, float(coloured))), told
