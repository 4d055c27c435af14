"""Drives through a town with a MEMS IMU at 100 Hz and RTK at 4 Hz: truth of ins_truth, errors of a usual part.

The receiver's velocities are means since its fix before, as those out of carrier phases are; the IMU is turned a little
in the car, and stands before the antenna. Every figure is drawn from the seed.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from libins import _truth

RATE_HZ = 100.0
FIX_HZ = 4.0
GPS_S = 1_756_400_000.0
"""Of the first sample, seconds since 1970 on GPS's clock."""
G = 9.80665
AHEAD_M = 1.2
"""The IMU, of the rear axle."""
SITE = (np.deg2rad(40.0966916), np.deg2rad(-105.1471665), 1601.0)
CONFIG = """schema = 1
filter = "gps_ins"
vehicle = "car"

[imu]
csv = "imu.csv"
columns = ["time", "fx", "fy", "fz", "wx", "wy", "wz"]
time = "unix_gps"
force_unit = "g"
rate_unit = "deg/s"
axes = "x,-y,-z"

[gnss]
file = "rtk.pos"
lever_arm_m = [-0.4, 0.0, -1.1]

[outages]
length_s = 15.0
period_s = 45.0
"""


@dataclass(frozen=True)
class Profile:
    """Speed, heading and climb over time."""

    t: np.ndarray[Any, Any]
    speed: np.ndarray[Any, Any]
    heading: np.ndarray[Any, Any]
    climb: np.ndarray[Any, Any]


def _smooth(values: np.ndarray[Any, Any], rows: int) -> np.ndarray[Any, Any]:
    """Three means in a row: no jerk that a car does not have."""
    for _ in range(3):
        padded = np.concatenate([np.full(rows, values[0]), values, np.full(rows, values[-1])])
        values = np.convolve(padded, np.ones(rows) / rows, "same")[rows:-rows]
    return values


def profile(seconds: float, rng: np.random.Generator) -> Profile:
    """Stops, straights, bends and corners."""
    step = 0.1
    speed, rate = [0.0] * round(12.0 / step), [0.0] * round(12.0 / step)
    while len(speed) * step < seconds:
        cruise, length = rng.uniform(8.0, 18.0), rng.uniform(8.0, 25.0)
        bend = rng.normal(0.0, 0.01)
        speed += [cruise] * round(length / step)
        rate += [bend] * round(length / step)
        if rng.random() < 0.8:  # a corner
            slow, angle = rng.uniform(4.0, 8.0), rng.choice([-1.0, 1.0]) * rng.uniform(1.2, 1.8)
            duration = abs(angle) * rng.uniform(8.0, 15.0) / slow
            speed += [slow] * round((duration + 3.0) / step)
            rate += [0.0] * round(1.5 / step) + [angle / duration] * round(duration / step)
            rate += [0.0] * (len(speed) - len(rate))
        if rng.random() < 0.3:  # a light
            wait = rng.uniform(4.0, 15.0)
            speed += [0.0] * round((wait + 5.0) / step)
            rate += [0.0] * round((wait + 5.0) / step)
    rows = round(seconds / step)
    v = np.maximum(_smooth(np.array(speed[:rows]), round(2.0 / step)), 0.0)
    w = _smooth(np.array(rate[:rows]), round(0.6 / step)) * np.clip(v / 3.0, 0.0, 1.0)
    climb = 0.02 * np.sin(np.cumsum(v) * step / 150.0)
    return Profile(np.arange(rows) * step, v, np.cumsum(w) * step + rng.uniform(-3.0, 3.0), climb)


def track(way: Profile, rng: np.random.Generator) -> Any:
    """The profile as positions, and the body's attitude on it: squat, roll in bends, a road that is not even."""
    step = float(way.t[1] - way.t[0])
    north = np.cumsum(way.speed * np.cos(way.heading)) * step + AHEAD_M * np.cos(way.heading)
    east = np.cumsum(way.speed * np.sin(way.heading)) * step + AHEAD_M * np.sin(way.heading)
    up = np.cumsum(way.speed * way.climb) * step
    forward = np.gradient(way.speed, step)
    sideways = way.speed * np.gradient(way.heading, step)
    moving = np.clip(way.speed / 5.0, 0.0, 1.0)
    pitch = way.climb + 0.004 * forward + 0.002 * moving * _smooth(rng.normal(0.0, 3.0, len(way.t)), 4)
    roll = -0.006 * sideways + 0.003 * moving * _smooth(rng.normal(0.0, 3.0, len(way.t)), 4)
    angles = [way.t.tolist(), way.heading.tolist(), pitch.tolist(), roll.tolist()]
    motion = _truth.motion_table(*angles, 0.0)
    site = _truth.Site(*SITE, gravity="normal", rotating=True)
    return _truth.track_waypoints(site, way.t.tolist(), north.tolist(), east.tolist(), up.tolist(), motion)


def imu_config(seed: int) -> Any:
    """A usual MEMS part."""
    config = _truth.ImuConfig()
    config.seed = seed
    rng = np.random.default_rng(seed)
    config.gyro.turn_on = [np.deg2rad(0.3)] * 3
    config.gyro.scale = rng.normal(0.0, 0.004, 3).tolist()
    config.gyro.misalignment = (rng.normal(0.0, 0.004, (3, 3)) * (1 - np.eye(3))).ravel().tolist()
    config.gyro.random_walk = [np.deg2rad(0.3) / 60.0] * 3
    config.gyro.bias_instability = [np.deg2rad(6.0) / 3600.0] * 3
    config.accel.turn_on = [0.02 * G] * 3
    config.accel.scale = rng.normal(0.0, 0.004, 3).tolist()
    config.accel.misalignment = (rng.normal(0.0, 0.004, (3, 3)) * (1 - np.eye(3))).ravel().tolist()
    config.accel.random_walk = [0.1 / 60.0] * 3
    config.accel.bias_instability = [6e-5 * G] * 3
    return config


def _turn(angles: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    roll, pitch, yaw = angles
    x = np.array([[1, 0, 0], [0, np.cos(roll), -np.sin(roll)], [0, np.sin(roll), np.cos(roll)]])
    y = np.array([[np.cos(pitch), 0, np.sin(pitch)], [0, 1, 0], [-np.sin(pitch), 0, np.cos(pitch)]])
    z = np.array([[np.cos(yaw), -np.sin(yaw), 0], [np.sin(yaw), np.cos(yaw), 0], [0, 0, 1]])
    return np.asarray(z @ y @ x)


def mounting(seed: int) -> np.ndarray[Any, Any]:
    """Roll, pitch, yaw of the IMU in the car [rad]."""
    return np.random.default_rng([seed, 1]).normal(0.0, np.deg2rad(1.5), 3)


def write(folder: Path, seed: int, seconds: float) -> Path:
    """imu.csv, rtk.pos, wheels.csv and drive.toml of one drive. Returns the configuration's path."""
    rng = np.random.default_rng(seed)
    way = profile(seconds, rng)
    road = track(way, rng)
    last = seconds - 1.0
    t = np.arange(round(last * RATE_HZ) + 1) / RATE_HZ
    mount = _turn(mounting(seed))
    theta, v = (np.asarray(part) @ mount for part in road.increments(t))
    speed = np.linalg.norm(np.asarray(road.at(t[1:])["v_n"]), axis=1)
    shake = np.minimum(speed / 10.0, 1.5)[:, None]
    theta = theta + np.diff(rng.normal(0.0, 1e-4, (len(t), 3)), axis=0) * shake
    v = v + np.diff(rng.normal(0.0, 4e-3, (len(t), 3)), axis=0) * shake
    errors = _truth.ImuErrors(imu_config(seed))
    read = errors.apply(np.ascontiguousarray(theta), np.ascontiguousarray(v), 1.0 / RATE_HZ)
    sensor = np.diag([1.0, -1.0, -1.0])
    rate = np.rad2deg(np.asarray(read["theta"]) * RATE_HZ) @ sensor
    force = np.asarray(read["v"]) * RATE_HZ / G @ sensor
    stamps = GPS_S + t[1:] - 0.5 / RATE_HZ  # of a mean over a period, the middle
    np.savetxt(folder / "imu.csv", np.column_stack([stamps, force, rate]), delimiter=",", fmt="%.6f")
    _write_pos(folder / "rtk.pos", road, last, mount, rng)
    at = np.arange(1, round(last * 10.0)) / 10.0
    yaw_rate = np.interp(at, way.t, np.gradient(way.heading, way.t)) + rng.normal(0.0, 0.005, len(at))
    wheel = np.interp(at, way.t, way.speed) * 1.004 + rng.normal(0.0, 0.05, len(at))
    np.savetxt(folder / "wheels.csv", np.column_stack([GPS_S + at, wheel, yaw_rate]), delimiter=",", fmt="%.5f")
    path = folder / "drive.toml"
    path.write_text(CONFIG, encoding="utf-8")
    return path


def _write_pos(path: Path, road: Any, last: float, mount: np.ndarray[Any, Any], rng: np.random.Generator) -> None:
    """RTKLIB's file: 1 cm white and 1 cm over 20 s; velocities are the way since the fix before, and 2 cm/s."""
    t = np.arange(2, round(last * FIX_HZ)) / FIX_HZ + 0.0491
    arm = mount @ np.array([-0.4, 0.0, -1.1])

    def antenna(at: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
        state = road.at(at)
        q = np.asarray(state["q_local"])
        w, u = q[:, :1], q[:, 1:]
        turned = arm + 2.0 * np.cross(u, np.cross(u, arm) + w * arm)
        llh = np.asarray(state["llh"])
        radius = np.array([6.3645e6, 6.3872e6 * np.cos(SITE[0])])  # at 40 deg, 1.6 km
        return llh + np.column_stack([turned[:, :2] / radius, -turned[:, 2]])

    here, before = antenna(t), antenna(t - 1.0 / FIX_HZ)
    metres = np.array([6.3645e6, 6.3872e6 * np.cos(SITE[0]), 1.0])
    slow = np.zeros((len(t), 3))
    decay = np.exp(-1.0 / FIX_HZ / 20.0)
    for k in range(1, len(t)):
        slow[k] = decay * slow[k - 1] + rng.normal(0.0, 0.01 * np.sqrt(1.0 - decay**2), 3)
    noise = slow + rng.normal(0.0, 0.01, slow.shape)
    place = here + noise / metres
    v = (here - before) * metres * FIX_HZ + rng.normal(0.0, 0.02, here.shape)
    with path.open("w", encoding="utf-8") as file:
        file.write(
            "%  GPST  latitude(deg) longitude(deg) height(m) Q ns sdn(m) sde(m) sdu(m) sdne(m) sdeu(m) sdun(m) age(s) "
            "ratio vn(m/s) ve(m/s) vu(m/s) sdvn sdve sdvu sdvne sdveu sdvun\n"
        )
        for at, (lat, lon, h), (vn, ve, vu) in zip(t, place, v, strict=True):
            stamp = np.datetime64(round((GPS_S + at) * 1000), "ms").astype(str).replace("-", "/").replace("T", " ")
            file.write(
                f"{stamp} {np.rad2deg(lat):.9f} {np.rad2deg(lon):.9f} {h:.4f} 1 25 0.01 0.01 0.02 0 0 0 0 0 "
                f"{vn:.4f} {ve:.4f} {vu:.4f} 0.05 0.05 0.05 0 0 0\n"
            )
