"""Tables of a scenario: where it goes, what its GPS says, and what the sensors of the GPS-enabled IMU are like.

Keys left out keep the preset's value. Names carry their unit; see ins_truth/track.h, ins_truth/gps.h,
emu_f2812/gimu_part.h.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from libins.schema import Document, Place, field
from libins.tables import read_csv, resolve

TRACK_COLUMNS = ("t_s", "north_m", "east_m", "up_m")
CHANNELS = 6
"""P, Q, R, AX, AY, AZ."""
AXES = 3
OUTAGES = 32


@dataclass(frozen=True, kw_only=True)
class Track:
    """Where the vehicle goes. `kind` says which of the other keys count."""

    kind: str = field("still", choices=("still", "line", "circle", "eight", "csv"))
    latitude_deg: float = field(0.0, minimum=-90.0, maximum=90.0)
    longitude_deg: float = field(0.0, minimum=-360.0, maximum=360.0)
    height_m: float = field(0.0, minimum=-1e4, maximum=1e5)
    gravity: str = field("thesis", choices=("thesis", "normal"))
    rotating: bool = field(False)
    attitude: str | None = field(None, choices=("motion", "path"))
    heading_rad: float = field(0.0)
    climb_rad: float = field(0.0, minimum=-math.pi / 2, maximum=math.pi / 2)
    radius_m: float = field(100.0, minimum=-1e6, maximum=1e6)
    length_m: float = field(100.0, above=0.0, maximum=1e6)
    width_m: float = field(50.0, above=0.0, maximum=1e6)
    speed_m_s: float = field(10.0, minimum=0.0, maximum=1e4)
    start_s: float = field(0.0, minimum=-1e9, maximum=1e9)
    accelerate_s: float = field(5.0, minimum=1e-2, maximum=1e6)
    cruise_s: float | None = field(None, minimum=0.0, maximum=1e9)
    brake_s: float = field(5.0, minimum=1e-2, maximum=1e6)
    csv: str = field("")

    @property
    def by_motion(self) -> bool:
        """The attitude is the motion's; else that of the path."""
        return self.attitude == "motion" or (self.attitude is None and self.kind == "still")


@dataclass(frozen=True, kw_only=True)
class Gps:
    """The receiver's errors."""

    preset: str = field("ideal", choices=("ideal", "single_frequency", "none"))
    period_s: float | None = field(None, minimum=0.01, maximum=100.0)
    latency_s: float | None = field(None, minimum=0.0, maximum=10.0)
    white_m: list[float] | None = field(None, minimum=0.0)
    markov_m: list[float] | None = field(None, minimum=0.0)
    markov_tau_s: float | None = field(None, minimum=1e-3, maximum=1e6)
    velocity_m_s: list[float] | None = field(None, minimum=0.0)
    sats: int | None = field(None, minimum=3, maximum=32)
    hdop: float | None = field(None, minimum=0.5, maximum=50.0)
    first_fix_s: float | None = field(None, minimum=0.0, maximum=1e6)
    outages_s: list[list[float]] = field([])


@dataclass(frozen=True, kw_only=True)
class Gimu:
    """The sensors, the converter, and the two lines. Lists are of P, Q, R, AX, AY, AZ."""

    name: str = field("gimu")
    preset: str = field("ideal", choices=("ideal", "thesis"))
    null_v: list[float] | None = field(None)
    drift_v_s: list[float] | None = field(None)
    scale_error: list[float] | None = field(None)
    sensitivity: list[float] | None = field(None)
    bandwidth_hz: list[float] | None = field(None, minimum=0.0)
    noise_density: list[float] | None = field(None, minimum=0.0)
    vcc_v: float | None = field(None, minimum=3.0, maximum=3.6)
    power_up_s: float | None = field(None, minimum=0.0, maximum=1e6)
    clock_ppm: float | None = field(None, minimum=-1e5, maximum=1e5)
    baud: float | None = field(None, minimum=50.0, maximum=4e6)
    nmea_baud: float | None = field(None, minimum=50.0, maximum=4e6)
    nmea_delay_s: float | None = field(None, minimum=0.0, maximum=1.0)
    order: str | None = field(None, choices=("longitude", "latitude"))
    no_fix: str | None = field(None, choices=("last", "zeros"))
    geoid_m: float | None = field(None, minimum=-200.0, maximum=200.0)
    utc_s: int | None = field(None, minimum=0)


def read_track(document: Document, track: Track) -> np.ndarray[Any, Any] | None:
    """The file that a track of kind csv names. Raises UsageError."""
    if track.kind != "csv":
        return None
    return read_csv(resolve(document, ("track", "csv"), track.csv, None), TRACK_COLUMNS, 4)


def check_lengths(document: Document, place: Place, table: Gps | Gimu) -> None:
    """As many numbers as there are channels or axes. Raises UsageError."""
    count = CHANNELS if isinstance(table, Gimu) else AXES
    what = "P, Q, R, AX, AY, AZ" if isinstance(table, Gimu) else "north, east, down"
    for name, value in vars(table).items():
        if isinstance(value, list) and name != "outages_s" and len(value) != count:
            raise document.refuse((*place, name), f"found {value!r}, but {count} numbers ({what}) are needed")


def check_outages(document: Document, outages_s: Sequence[Sequence[float]]) -> None:
    """Pairs of instants. Raises UsageError."""
    for i, outage in enumerate(outages_s):
        if len(outage) != 2 or not outage[0] < outage[1]:
            raise document.refuse(("gps", "outages_s", str(i)), f"found {outage!r}, but [from, to] is needed")
    if len(outages_s) > OUTAGES:
        raise document.refuse(("gps", "outages_s"), f"found {len(outages_s)} windows, but {OUTAGES} is the most")
