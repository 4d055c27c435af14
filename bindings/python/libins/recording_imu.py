"""An IMU's or a vehicle's CSV as a recording in b, SI; refused when its units or axes cannot be."""

import itertools
from pathlib import Path

import numpy as np

from libins import recording_csv
from libins.errors import UsageError
from libins.recording import Array, Findings, Imu, Wheels, in_order
from libins.replay_config import ImuFile, WheelsFile

G = 9.80665
UNITS = {"m/s^2": 1.0, "g": G, "mg": G * 1e-3, "rad/s": 1.0, "deg/s": np.pi / 180.0}
FORCE_MEDIAN = (8.5, 11.5)
"""Of its norm, over a recording: nobody accelerates for half of it [m/s^2]."""
RATE_RMS_MAX = 10.0
"""[rad/s]"""
STUCK_S = 1.0
GAP_PERIODS = 5.0
TILT_MAX = np.cos(np.deg2rad(60.0))
COLUMNS = ("time", "week", "tow", "fx", "fy", "fz", "wx", "wy", "wz")
WHEEL_COLUMNS = ("time", "week", "tow", "speed", "distance", "counts", "yaw_rate")


def rotation(path: Path, axes: str, key: str) -> Array:
    """C of body = C sensor: "y,x,-z" has the sensor's y forward, its x to the right, its -z down. Raises UsageError."""
    names = [name.strip() for name in axes.split(",")]
    matrix = np.zeros((3, 3))
    if len(names) == 3 and all(name.lstrip("+-") in ("x", "y", "z") for name in names):
        for row, name in enumerate(names):
            matrix[row, "xyz".index(name[-1])] = -1.0 if name[0] == "-" else 1.0
    if np.linalg.det(matrix) < 0.5:
        what = "is a reflection" if np.linalg.det(matrix) < -0.5 else "is no rotation"
        raise UsageError(
            f"{path}: imu.{key} = {axes!r} {what}: it must say which of the sensor's axes points forward, right and "
            f'down, as "x,y,z" or, of a sensor with x forward, y left, z up, "x,-y,-z"'
        )
    return matrix


def _proposal(mean: Array) -> str:
    """Axes that would have gravity where it belongs, the sensor's x or y as forward."""
    for order in itertools.permutations(range(3)):
        for signs in itertools.product((1.0, -1.0), repeat=3):
            matrix = np.zeros((3, 3))
            matrix[range(3), order] = signs
            good = np.linalg.det(matrix) > 0 and (matrix @ mean)[2] < -TILT_MAX * np.linalg.norm(mean)
            if good and signs[0] > 0:
                return ",".join(("-" if s < 0 else "") + "xyz"[o] for s, o in zip(signs, order, strict=True))
    return "x,y,z"


def _check_force(path: Path, force: Array, unit: str) -> None:
    median = float(np.median(np.linalg.norm(force, axis=1)))
    if not FORCE_MEDIAN[0] < median < FORCE_MEDIAN[1]:
        raw = median / UNITS[unit]
        fits = [u for u in ("m/s^2", "g", "mg") if FORCE_MEDIAN[0] < raw * UNITS[u] < FORCE_MEDIAN[1]]
        remedy = f'force_unit = "{fits[0]}" fits' if fits else "no unit known here fits: kind or columns are others"
        raise UsageError(
            f"{path}: imu.force_unit: the median of the specific force is {raw:.4g} {unit}, {median / G:.3g} times "
            f"gravity; {remedy}"
        )


def load(path: Path, config: ImuFile, leap_s: float, findings: Findings) -> Imu:
    """Read, convert, check. Raises UsageError."""
    found = recording_csv.table(path, config.columns, COLUMNS, findings)
    t = recording_csv.times(path, found, config.time, leap_s, config.time_scale) + config.time_offset_s
    turn = rotation(path, config.axes, "axes")
    turn_force = turn if config.force_axes is None else rotation(path, config.force_axes, "force_axes")
    force = np.column_stack(recording_csv.need(path, found, "fx", "fy", "fz")) * UNITS[config.force_unit] @ turn_force.T
    rate = np.column_stack(recording_csv.need(path, found, "wx", "wy", "wz")) * UNITS[config.rate_unit] @ turn.T
    imu = in_order(Imu(path, t, force, rate, config.kind == "increments"), findings)
    if len(imu.t) < 100:
        raise UsageError(f"{path}: holds {len(imu.t)} samples; at least 100 are needed")
    period = np.median(np.diff(imu.t))
    if not 1e-4 <= period <= 0.1:
        raise UsageError(
            f"{path}: imu.time: samples are {period:.4g} s apart, but 1e-4 .. 0.1 is usable; with times in "
            "milliseconds time_scale = 1e-3 is right"
        )
    scale = period if imu.increments else 1.0
    _check_force(path, imu.force / scale, config.force_unit)
    if (rms := float(np.sqrt(np.mean(imu.rate**2))) / scale) > RATE_RMS_MAX:
        raise UsageError(
            f'{path}: imu.rate_unit: the rates\' rms is {rms:.4g} rad/s as "{config.rate_unit}"; no vehicle turns so, '
            'rate_unit = "deg/s" may be right'
        )
    mean = np.median(imu.force, axis=0)
    if not -mean[2] > TILT_MAX * np.linalg.norm(mean):
        at_sensor = turn_force.T @ mean / scale
        along, axes = at_sensor.round(2).tolist(), _proposal(at_sensor)
        raise UsageError(
            f"{path}: imu.axes = {config.axes!r}: at rest the specific force points along {along} m/s^2 of the "
            f'sensor\'s axes, so these are not forward, right, down; axes = "{axes}" would be, if its first is forward'
        )
    _find_gaps(imu, float(period), findings)
    _find_stuck(imu, float(period), findings)
    return imu


def _find_gaps(imu: Imu, period: float, findings: Findings) -> None:
    steps = np.diff(imu.t)
    gaps = steps > GAP_PERIODS * period
    where = f"{steps[gaps].sum():.3f} s in all, longest {steps.max():.3f} s, first at {imu.t[:-1][gaps][:1].tolist()}"
    findings.add(f"{imu.path.name}: gaps", int(gaps.sum()), where)


def _find_stuck(imu: Imu, period: float, findings: Findings) -> None:
    """An axis that gives the same figure for STUCK_S while another one moves."""
    rows = max(2, round(STUCK_S / period))
    values = np.hstack([imu.force, imu.rate])
    same = np.vstack([np.zeros((1, 6), bool), np.diff(values, axis=0) == 0.0])
    for axis, name in enumerate(("fx", "fy", "fz", "wx", "wy", "wz")):
        alone = same[:, axis] & ~same.all(axis=1)
        edges = np.flatnonzero(np.diff(np.concatenate([[False], alone, [False]]).astype(int)))
        lengths = edges[1::2] - edges[::2]
        stuck = lengths >= rows
        if stuck.any():
            at = imu.t[edges[::2][stuck][0]]
            where = f"{lengths[stuck].sum() * period:.1f} s in all, first at {at:.3f}"
            findings.add(f"{imu.path.name}: {name} stuck", int(stuck.sum()), where)


def load_wheels(path: Path, config: WheelsFile, leap_s: float, findings: Findings) -> Wheels:
    """Speeds, or what a distance or a count makes of them. Raises UsageError."""
    found = recording_csv.table(path, config.columns, WHEEL_COLUMNS, findings)
    t = recording_csv.times(path, found, config.time, leap_s) + config.time_offset_s
    nothing = np.full(len(t), np.nan)
    yaw_rate = found.get("yaw_rate", nothing) * UNITS[config.rate_unit]
    yaw_rate = -yaw_rate if config.yaw_rate_positive == "left" else yaw_rate
    speed = found.get("speed", nothing)
    for name, metres in (("distance", 1.0), ("counts", config.metres_per_count)):
        if name in found:
            speed = np.diff(found[name], prepend=found[name][:1]) * metres / np.diff(t, prepend=2 * t[0] - t[1])
    if not (np.isfinite(speed).any() or np.isfinite(yaw_rate).any()):
        raise UsageError(f"{path}: wheels.columns: neither speed, distance, counts nor yaw_rate is among them")
    wheels = in_order(Wheels(path, t, speed, yaw_rate), findings)
    if (fastest := np.nanmax(np.abs(wheels.speed), initial=0.0)) > 150.0:
        raise UsageError(
            f"{path}: wheels.columns: {fastest:.4g} m/s is found, but a vehicle does not pass 150; is it km/h, or "
            "metres_per_count wrong?"
        )
    return wheels
