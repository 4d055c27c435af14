"""What was recorded: an IMU, a receiver's fixes, a vehicle's wheels. SI, rad; seconds since 1970 on GPS's clock."""

from bisect import bisect_left
from collections import Counter
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

Array = np.ndarray[Any, Any]
WEEK_S = 604800.0
GPS_EPOCH_S = 315964800.0
"""1980-01-06, since 1970."""
ROLLOVER_S = 1024 * WEEK_S
"""The week in a receiver's message has 10 bits."""
R = TypeVar("R", "Imu", "Gnss", "Wheels")


class Findings:
    """What was wrong with files and was survived, counted."""

    def __init__(self) -> None:
        """Nothing yet."""
        self.counts: Counter[str] = Counter()
        self.notes: list[str] = []

    def add(self, what: str, count: int, note: str = "") -> None:
        """Nothing when count is 0. The note says where it first was."""
        if count:
            self.counts[what] += count
            self.notes.append(f"{what}: {count}" + (f", {note}" if note else ""))


@dataclass(frozen=True)
class Imu:
    """Specific force and angular rate in b (x forward, y right, z down), or their integrals since the sample before."""

    path: Path
    t: Array
    force: Array
    rate: Array
    increments: bool


@dataclass(frozen=True)
class Gnss:
    """Fixes; sigma 0: not known."""

    path: Path
    t: Array
    position: Array
    """Latitude, longitude [rad], height [m]."""
    sigma_p: Array
    """North, east, down [m]."""
    velocity: Array
    """North, east, down [m/s]."""
    sigma_v: Array
    quality: Array
    """As RTKLIB's: 1 fixed, 2 float, 3 SBAS, 4 differential, 5 single, 6 PPP."""
    sats: Array
    hdop: Array


@dataclass(frozen=True)
class Wheels:
    """Speed over the period before and yaw rate, right turn positive; NaN: not measured."""

    path: Path
    t: Array
    speed: Array
    yaw_rate: Array


def choose(recording: R, which: Any) -> R:
    """Some of its rows."""
    return replace(
        recording, **{name: value[which] for name, value in vars(recording).items() if isinstance(value, np.ndarray)}
    )


def shifted(recording: R, seconds: float) -> R:
    """On a clock that is ahead by that much."""
    return replace(recording, t=recording.t + seconds)


def increasing(t: Array) -> Array:
    """Places of the longest strictly increasing part of the times: what is left out stepped back or repeated."""
    if np.all(np.diff(t) > 0):
        return np.arange(len(t))
    tails: list[float] = []
    places: list[int] = []
    before = np.full(len(t), -1)
    for i, value in enumerate(t.tolist()):
        k = bisect_left(tails, value)
        if k == len(tails):
            tails.append(value)
            places.append(i)
        else:
            tails[k], places[k] = value, i
        before[i] = places[k - 1] if k else -1
    chain = np.empty(len(tails), dtype=np.intp)
    at = places[-1]
    for k in range(len(tails) - 1, -1, -1):
        chain[k], at = at, before[at]
    return chain


def in_order(recording: R, findings: Findings) -> R:
    """Rows whose figures are numbers and whose times increase; the others are counted."""
    name = recording.path.name
    bad = ~np.isfinite(recording.t)
    if isinstance(recording, Imu):
        bad |= ~np.isfinite(recording.force).all(axis=1) | ~np.isfinite(recording.rate).all(axis=1)
    elif isinstance(recording, Gnss):
        bad |= ~np.isfinite(recording.position).all(axis=1)
    findings.add(f"{name}: rows that are not numbers", int(bad.sum()), f"first row {int(bad.argmax()) + 1}")
    recording = choose(recording, ~bad)
    kept = increasing(recording.t)
    dropped = np.setdiff1d(np.arange(len(recording.t)), kept)
    if len(dropped):
        repeated = np.isin(recording.t[dropped], recording.t[kept])
        findings.add(f"{name}: times that repeat", int(repeated.sum()))
        backward = dropped[~repeated]
        if len(backward):
            at = f"first at {recording.t[backward[0]]:.3f} after {recording.t[max(backward[0] - 1, 0)]:.3f}"
            findings.add(f"{name}: times that step back", len(backward), at)
    return choose(recording, kept)


def unwrapped_tow(tow: Array) -> Array:
    """Seconds of the week that go on over its end."""
    steps = np.diff(tow, prepend=tow[:1])
    return tow + WEEK_S * np.cumsum(np.where(steps < -WEEK_S / 2, 1.0, np.where(steps > WEEK_S / 2, -1.0, 0.0)))
