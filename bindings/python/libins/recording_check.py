"""Do the recordings belong together: clocks, the sense and unit of yaw rates. What cannot be right is refused."""

import numpy as np

from libins.errors import UsageError
from libins.recording import ROLLOVER_S, WEEK_S, Array, Findings, Gnss, Imu, Wheels, shifted

GRID_S = 0.1
VELOCITY_LATE_S = np.arange(-0.1, 0.451, 0.01)
VELOCITY_GAIN = 0.8
"""Of the misfit of places and velocities: a lateness that brings less is taken for none."""
LAG_MAX_S = 60.0
LAG_ALLOWED_S = 1.0
"""A body turns before its course does: walkers by up to half a second."""
SPEED_MIN = 1.0
"""Below, a course is noise [m/s]."""
SURE = 0.6
"""A correlation from which on something may be concluded."""
UNIT_RATIO = 20.0
OVERLAP_MIN_S = 5.0


def rollover(gnss: Gnss, t: Array, findings: Findings) -> Gnss:
    """With times moved by whole periods of the week number, or weeks, when they are far from the IMU's."""
    apart = t[0] - gnss.t[0]
    for period, what in ((ROLLOVER_S, "periods of 1024 weeks"), (WEEK_S, "weeks")):
        turns = round(apart / period)
        near = abs(apart - turns * period) < WEEK_S / 14
        if turns and near:
            findings.add(f"{gnss.path.name}: {what} that its times were moved by", abs(turns))
            return shifted(gnss, turns * period)
    return gnss


def overlap(gnss: Gnss, other: Imu | Wheels) -> None:
    """Raises UsageError when they were not recorded at the same time."""
    common = min(gnss.t[-1], other.t[-1]) - max(gnss.t[0], other.t[0])
    if common < OVERLAP_MIN_S:
        raise UsageError(
            f"{gnss.path}: {gnss.t[0]:.3f} .. {gnss.t[-1]:.3f} s has {max(common, 0.0):.1f} s in common with "
            f"{other.path}, {other.t[0]:.3f} .. {other.t[-1]:.3f} s (since 1970, on GPS's clock); see time, leap_s and "
            "time_offset_s"
        )


def _course_rates(gnss: Gnss, grid: Array) -> Array:
    """On the grid; NaN where it stands, or nothing is known."""
    if np.any(gnss.sigma_v[:, 0] > 0.0):
        v = gnss.velocity[:, :2]
    else:
        scale = np.column_stack([np.full(len(gnss.t), 6.37e6), 6.37e6 * np.cos(gnss.position[:, 0])])
        v = np.gradient(gnss.position[:, :2], gnss.t, axis=0) * scale
    course = np.unwrap(np.arctan2(v[:, 1], v[:, 0]))
    rates = np.diff(course) / np.diff(gnss.t)
    speed = np.hypot(*v.T)
    usable = (np.minimum(speed[1:], speed[:-1]) > SPEED_MIN) & (np.diff(gnss.t) < 2.0)
    place = np.clip(np.searchsorted(gnss.t, grid) - 1, 0, len(rates) - 1)
    inside = (grid > gnss.t[0]) & (grid < gnss.t[-1]) & usable[place]
    return np.where(inside, rates[place], np.nan)


def _correlations(course: Array, yaw: Array, lags: Array) -> tuple[Array, Array]:
    """Correlation and slope of yaw over course rate for each lag [grid steps]; yaw later by the lag."""
    rs, slopes = np.zeros(len(lags)), np.zeros(len(lags))
    steps = np.arange(len(course))
    for i, lag in enumerate(lags.tolist()):
        at = steps + lag
        inside = (at >= 0) & (at < len(yaw))
        both = inside.copy()
        both[inside] &= np.isfinite(course[inside]) & np.isfinite(yaw[at[inside]])
        if both.sum() > 10.0 / GRID_S:
            c, y = course[both] - course[both].mean(), yaw[at[both]] - yaw[at[both]].mean()
            if c.any() and y.any():
                rs[i], slopes[i] = c @ y / np.sqrt((c @ c) * (y @ y)), c @ y / (c @ c)
    return rs, slopes


def yaw_against_course(gnss: Gnss, other: Imu | Wheels) -> str:
    """A sentence on clocks and yaw rates. Raises UsageError when a sense, a unit or a clock cannot be right."""
    grid = np.arange(min(gnss.t[0], other.t[0]), max(gnss.t[-1], other.t[-1]), GRID_S)
    if isinstance(other, Imu):
        steps = np.diff(other.t, prepend=other.t[0])
        part = other.rate[:, 2] * (1.0 if other.increments else steps)
        key = "imu"
    else:
        steps = np.diff(other.t, prepend=other.t[0])
        part = np.nan_to_num(other.yaw_rate) * steps
        key = "wheels"
    yaw = np.gradient(np.interp(grid, other.t, np.cumsum(part)), GRID_S)
    yaw[(grid < other.t[0]) | (grid > other.t[-1])] = np.nan
    lags = np.arange(-round(LAG_MAX_S / GRID_S), round(LAG_MAX_S / GRID_S) + 1)
    rs, slopes = _correlations(_course_rates(gnss, grid), yaw, lags)
    best = int(np.argmax(np.abs(rs)))
    lag_s = float(lags[best] * GRID_S)
    if abs(rs[best]) < SURE:
        return f"yaw rate and course say too little of each other to check clocks and axes (correlation {rs[best]:.2f})"
    if rs[best] < 0.0:
        raise UsageError(
            f"{other.path}: {key}: yaw rates go against the course of the fixes (correlation {rs[best]:.2f}); right "
            "turns must be positive about the axis that points down: see axes, or yaw_rate_positive"
        )
    if not 1.0 / UNIT_RATIO < slopes[best] < UNIT_RATIO:
        raise UsageError(
            f"{other.path}: {key}.rate_unit: yaw rates are {slopes[best]:.3g} times those of the fixes' course; "
            f"{'deg/s' if slopes[best] > 1.0 else 'rad/s'} fits"
        )
    if abs(lag_s) > LAG_ALLOWED_S and rs[best] - rs[len(rs) // 2] > 0.2:
        raise UsageError(
            f"{other.path}: {key}.time: its yaw rates come {lag_s:+.1f} s after the course of {gnss.path.name} "
            f"(correlation {rs[best]:.2f}, as the clocks are {rs[len(rs) // 2]:.2f}); GPS is ahead of UTC: see "
            f"time and leap_s, or give time_offset_s = {-lag_s:.1f}"
        )
    told = f"correlation {rs[best]:.2f} at {lag_s:+.1f} s, scale {slopes[best]:.2f}"
    return f"yaw rates follow the course of the fixes: {told}"


def velocity_late(gnss: Gnss) -> tuple[float, str]:
    """By how much the receiver's velocities are older than its places, as both say; 0 when nothing can be said.

    Velocities out of carrier phases are means since the fix before, and so late by half of the time between fixes.
    """
    known: Array = np.all(gnss.sigma_v[:, :2] > 0.0, axis=1)
    usual = float(np.median(np.diff(gnss.t)))
    both: Array = np.asarray(known[1:] & known[:-1] & (np.diff(gnss.t) < 1.5 * usual))
    both &= gnss.quality[1:] == gnss.quality[:-1]
    radius = 6.371e6
    place = (gnss.position - gnss.position[0])[:, :2] * np.array([radius, radius * np.cos(gnss.position[0, 0])])
    way = 0.5 * (gnss.velocity[1:, :2] + gnss.velocity[:-1, :2]) * np.diff(gnss.t)[:, None]
    both = np.where(np.arange(len(both)) < max(2, round(0.5 / usual)), False, both)
    if both.sum() < 40:
        return 0.0, ""
    misfits = []
    for late in VELOCITY_LATE_S.tolist():
        then = np.column_stack([np.interp(gnss.t - late, gnss.t, place[:, axis]) for axis in range(2)])
        misfits.append(float(np.sqrt(np.median(np.sum((np.diff(then, axis=0) - way)[both] ** 2, axis=1)))))
    best = int(np.argmin(misfits))
    none = misfits[int(np.argmin(np.abs(VELOCITY_LATE_S)))]
    if misfits[best] > VELOCITY_GAIN * none or best in (0, len(misfits) - 1):
        return 0.0, ""
    late = float(VELOCITY_LATE_S[best])
    return late, f"velocities of the receiver are {late:.2f} s older than its places: taken so"
