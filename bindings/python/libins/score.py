"""What a navigating board has sent, beside the truth at the instant at which it had come: its age is in the error."""

import math
from typing import Any

from libins import _run
from libins.machine import AXES, Array

COLUMN = {name: i for i, name in enumerate(_run.SOLUTION_COLUMNS)}
EULER = ("roll_rad", "pitch_rad", "heading_rad")
ALIGNED = 0x001
"""Of a block's status; docs/nav_block.md."""
SEMI_MAJOR_M = 6378137.0
FLATTENING = 1 / 298.257223563
"""WGS-84."""


def solved(states: Array, track: Any) -> dict[str, Any]:
    """The summary's `solution`, the last one by its columns, `attitude` and `position`; None where there is nothing."""
    if not len(states):
        return {"solution": None, "attitude": None, "position": None}
    last = {name: float(states[-1, i]) for name, i in COLUMN.items()}
    if track is None:
        return {"solution": last, "attitude": None, "position": None}
    turned: list[list[float]] = []
    moved: list[float] = []
    for row in states.tolist():
        truth = track.at(row[COLUMN["at_s"]])
        if int(row[COLUMN["status"]]) & ALIGNED:
            angles = euler(truth["q_local"])
            turned.append([wrapped(row[COLUMN[name]] - angle) for name, angle in zip(EULER, angles, strict=True)])
        if row[COLUMN["zone"]]:
            moved.append(distance_m(row[COLUMN["lat_rad"]], row[COLUMN["lon_rad"]], truth["llh"]))
    attitude = None
    if turned:
        errors = dict(zip(AXES, zip(*turned, strict=True), strict=True))
        attitude = {
            "rms_rad": {axis: rms(values) for axis, values in errors.items()},
            "max_rad": {axis: max(map(abs, values)) for axis, values in errors.items()},
        }
    position = {"count": len(moved), "rms_m": rms(moved), "max_m": max(moved), "last_m": moved[-1]} if moved else None
    return {"solution": last, "attitude": attitude, "position": position}


def rms(values: Any) -> float:
    """Root of the mean square."""
    return math.sqrt(math.fsum(value * value for value in values) / len(values))


def wrapped(angle: float) -> float:
    """To -pi .. pi."""
    return math.remainder(angle, 2 * math.pi)


def euler(q: Any) -> tuple[float, float, float]:
    """Roll, pitch, yaw (ZYX) of q_nb, scalar first."""
    w, x, y, z = q
    roll = math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    pitch = math.asin(max(-1.0, min(1.0, 2 * (w * y - z * x))))
    return roll, pitch, math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


def distance_m(latitude: float, longitude: float, llh: Any) -> float:
    """Horizontal, of two places near each other."""
    return math.hypot(*away_m(latitude, longitude, llh))


def away_m(latitude: float, longitude: float, llh: Any) -> tuple[float, float]:
    """How far north and east a place is of another near it: along meridian and parallel of that."""
    squared = FLATTENING * (2 - FLATTENING)
    w = math.sqrt(1 - squared * math.sin(llh[0]) ** 2)
    meridian, normal = SEMI_MAJOR_M * (1 - squared) / w**3, SEMI_MAJOR_M / w
    north = (latitude - llh[0]) * (meridian + llh[2])
    east = wrapped(longitude - llh[1]) * (normal + llh[2]) * math.cos(llh[0])
    return north, east
