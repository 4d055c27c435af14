"""Where a replay starts: attitude, velocity, position and gyro bias from the first seconds of IMU and fixes.

Velocity changes between fixes, gravity taken off, are the turned integrals of specific force: the turn between the two
is Wahba's problem (M. Wu et al., Aerospace Science and Technology 15(1), 2011, 1-17: optimisation-based alignment). It
needs no level, no standstill and no knowledge of which way the body faces, but a few changes of velocity. A car's
heading is its course.
"""

from dataclasses import dataclass

import numpy as np

from libins import core
from libins.errors import UsageError
from libins.recording import Array, Gnss

STILL_S = 1.0
STILL_RATE = 0.02
"""Standard deviation of a rate within STILL_S at rest [rad/s]."""
STILL_FORCE = 0.15
"""[m/s^2]"""
STILL_MEAN = 0.05
"""Of the rate itself: more is a turn [rad/s]."""
STILL_SPEED = 0.3
SPAN_S = 1.0
"""Between the fixes of a pair."""
WINDOW_S = 30.0
"""Of pairs: longer, and the gyros' drift counts."""
PAIRS_MIN = 4
HEADING_GOOD = 0.1
"""Standard deviation of the heading to start with [rad]; HEADING_MAX when there never is a better one."""
HEADING_MAX = 0.5
HEADING_TRUST = 2.0
"""Errors of pairs are not independent: the heading's is taken for so many times larger."""
COURSE_SPEED = 4.0
"""Of a car whose course is its heading [m/s]."""
COURSE_SIGMA = 0.06
SIDEWAYS, SIDEWAYS_SURE = 0.8, 0.35
"""A car does not drive so far from its heading; where that is known so well, another axis is forward [rad]."""
TILT_SIGMA = 0.03
BIAS_STILL, BIAS_UNKNOWN = 5e-4, 1e-2
"""Standard deviation of the gyros' bias after a rest, and without one [rad/s]."""
FORCE_BIAS = 0.3
"""[m/s^2]"""


@dataclass(frozen=True)
class Increments:
    """Integrals of rate and specific force over `period` until t. Frame: b."""

    t: Array
    period: Array
    theta: Array
    v: Array


@dataclass(frozen=True)
class Start:
    """A filter's first state; sigma: attitude, velocity, position in n, gyro and accelerometer bias."""

    t: float
    q_nb: Array
    v_n: Array
    position: Array
    gyro_bias: Array
    sigma: Array
    how: str


def still(increments: Increments, fixes: Gnss) -> Array:
    """Which samples are in a block of STILL_S at rest."""
    period = float(np.median(increments.period))
    rows = max(2, round(STILL_S / period))
    blocks = len(increments.t) // rows
    mask = np.zeros(len(increments.t), bool)
    values = np.hstack([increments.theta, increments.v]) / increments.period[:, None]
    part = values[: blocks * rows].reshape(blocks, rows, 6)
    sigma, mean = part.std(axis=1), part.mean(axis=1)
    quiet = (sigma[:, :3] < STILL_RATE).all(axis=1) & (sigma[:, 3:] < STILL_FORCE).all(axis=1)
    quiet &= (np.abs(mean[:, :3]) < STILL_MEAN).all(axis=1)
    if np.any(fixes.sigma_v[:, 0] > 0.0):
        speed = np.interp(increments.t[: blocks * rows], fixes.t, np.linalg.norm(fixes.velocity[:, :2], axis=1))
        quiet &= speed.reshape(blocks, rows).max(axis=1) < STILL_SPEED
    mask[: blocks * rows] = np.repeat(quiet, rows)
    return mask


def velocities(fixes: Gnss) -> tuple[Array, Array]:
    """Those of the receiver, or of the places before and after; and their standard deviations."""
    known = fixes.sigma_v[:, 0] > 0.0
    if known.all():
        return fixes.velocity, fixes.sigma_v
    radius = 6.371e6
    place = fixes.position * np.column_stack(
        [np.full(len(fixes.t), radius), radius * np.cos(fixes.position[:, 0]), np.full(len(fixes.t), -1.0)]
    )
    v = np.gradient(place, fixes.t, axis=0)
    sigma = fixes.sigma_p / np.gradient(fixes.t)[:, None]
    return np.where(known[:, None], fixes.velocity, v), np.where(known[:, None], fixes.sigma_v, sigma)


def _turn(a: Array, b: Array) -> Array:
    """C with b = C a in the least squares sense."""
    u, _, v = np.linalg.svd(b.T @ a)
    return np.asarray(u @ np.diag([1.0, 1.0, np.linalg.det(u) * np.linalg.det(v)]) @ v)


def _fit(alpha: Array, beta: Array, sigma_v: float) -> tuple[Array, float]:
    """C_nb0 and the standard deviation of its heading, of velocities with sigma_v [m/s]."""
    c = _turn(alpha, beta)
    misfit = beta - alpha @ c.T
    noise = max(np.sum(misfit[:, :2] ** 2) / max(1, 2 * len(beta) - 3), 2.0 * sigma_v**2)
    seen = np.sum((beta[:, :2]) ** 2)
    return c, float(HEADING_TRUST * np.sqrt(noise / seen)) if seen > 0.0 else np.inf


def align(increments: Increments, fixes: Gnss, car: bool, lever_arm: Array) -> Start:
    """The first instant of a fix at which enough is known. Raises UsageError."""
    resting = still(increments, fixes)
    v, sigma_v = velocities(fixes)
    inside = np.flatnonzero((fixes.t > increments.t[0]) & (fixes.t <= increments.t[-1]))
    if len(inside) < 2 * PAIRS_MIN:
        raise UsageError(
            f"{fixes.path}: {len(inside)} fixes within the IMU's time; {2 * PAIRS_MIN} at least are needed"
        )
    place = np.clip(np.searchsorted(increments.t, fixes.t[inside]), 0, len(increments.t) - 1)
    down = np.array([0.0, 0.0, core.earth_gravity(np.sin(fixes.position[inside[0], 0]), fixes.position[inside[0], 2])])
    best: tuple[float, int, Array, Array, int] | None = None
    bias, rests = np.zeros(3), -1
    q_bb0 = dv = np.zeros(0)
    for k in range(1, len(inside)):
        rested = resting[: place[k] + 1]
        if rested[-1]:
            continue
        if rests != int(rested.sum()):
            rests = int(rested.sum())
            if rests:
                bias = (
                    increments.theta[: place[k] + 1][rested].sum(axis=0)
                    / increments.period[: place[k] + 1][rested].sum()
                )
            theta = increments.theta - bias * increments.period[:, None]
            q_bb0 = core.Attitude(core.CONING_HIST1, [1.0, 0.0, 0.0, 0.0]).step(theta)
            dv = np.cumsum(core.quat_rotate(q_bb0, increments.v - 0.5 * np.cross(theta, increments.v)), axis=0)
        now = fixes.t[inside[k]]
        pairs = [
            (i, j)
            for j in range(1, k + 1)
            if fixes.t[inside[j]] >= now - WINDOW_S
            for i in [int(np.searchsorted(fixes.t[inside], fixes.t[inside[j]] - SPAN_S + 1e-6))]
            if i < j and fixes.t[inside[j]] - fixes.t[inside[i]] > 0.5 * SPAN_S
        ][:: max(1, round(SPAN_S / 4 / np.median(np.diff(fixes.t))))]
        if len(pairs) < PAIRS_MIN:
            continue
        i, j = np.array(pairs).T
        alpha = dv[place[j]] - dv[place[i]]
        beta = v[inside[j]] - v[inside[i]] - down * (increments.t[place[j]] - increments.t[place[i]])[:, None]
        c, sigma = _fit(alpha, beta, float(np.median(sigma_v[inside[j], :2])))
        speed = float(np.hypot(*v[inside[k], :2]))
        course = np.arctan2(v[inside[k], 1], v[inside[k], 0])
        heading = core.quat_to_euler(core.quat_mul(core.quat_from_dcm(c), q_bb0[place[k]]))[2]
        sideways = sigma < SIDEWAYS_SURE and abs(np.angle(np.exp(1j * (course - heading)))) > SIDEWAYS
        if car and speed > COURSE_SPEED and not sideways:
            return _start(increments, fixes, inside[k], place[k], c, q_bb0, bias, rests > 0, v, sigma_v, lever_arm,
                          COURSE_SIGMA, True)  # fmt: skip
        if best is None or sigma < best[0]:
            best = (sigma, k, c, q_bb0, rests)
        if sigma < HEADING_GOOD:
            break
    if best is None or best[0] > HEADING_MAX:
        raise UsageError(
            f"{fixes.path}: nothing shows which way the IMU faces: velocity has to change, at least for some seconds; "
            "take a part of the recording that moves"
        )
    sigma, k, c, q_bb0, rests = best
    return _start(
        increments, fixes, inside[k], place[k], c, q_bb0, bias, rests > 0, v, sigma_v, lever_arm, sigma, False
    )


def _start(
    increments: Increments, fixes: Gnss, fix: int, sample: int, c: Array, q_bb0: Array, bias: Array, rested: bool,
    v: Array, sigma_v: Array, lever_arm: Array, heading_sigma: float, by_course: bool,
) -> Start:  # fmt: skip
    q_nb = np.asarray(core.quat_mul(core.quat_from_dcm(c), q_bb0[sample]))
    how = f"heading from changes of velocity, standard deviation {np.rad2deg(heading_sigma):.1f} deg"
    if by_course:
        roll, pitch, _ = core.quat_to_euler(q_nb)
        q_nb = np.asarray(core.quat_from_euler(np.array([roll, pitch, np.arctan2(v[fix, 1], v[fix, 0])])))
        how = "heading from the course"
    lever_n = core.quat_rotate(q_nb, lever_arm)
    radii = core.earth_radii(np.sin(fixes.position[fix, 0]))
    height = fixes.position[fix, 2]
    metres = np.array([radii[0] + height, (radii[1] + height) * np.cos(fixes.position[fix, 0]), -1.0])
    late = increments.t[sample] - fixes.t[fix]
    position = fixes.position[fix] + (v[fix] * late - lever_n) / metres
    sigma = np.concatenate(
        [
            [TILT_SIGMA, TILT_SIGMA, max(heading_sigma, TILT_SIGMA)],
            np.maximum(np.where(sigma_v[fix] > 0.0, sigma_v[fix], 1.0), 0.1),
            np.maximum(np.where(fixes.sigma_p[fix] > 0.0, fixes.sigma_p[fix], 10.0), 0.1),
            np.full(3, BIAS_STILL if rested else BIAS_UNKNOWN),
            np.full(3, FORCE_BIAS),
        ]
    )
    rest = "gyro bias from rest" if rested else "gyro bias unknown"
    return Start(float(increments.t[sample]), q_nb, v[fix], position, bias, sigma, f"{how}, {rest}")
