"""The `ins sim` command: a known motion, what an IMU and a GPS receiver on it say, and the truth, as CSV.

TOML; names carry their unit, except in [imu.gyro] and [imu.accel], which are ins_imu_triad_t (rad, m, s, K).
"""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np

from libins import _truth
from libins.errors import UsageError
from libins.motions import built_motion
from libins.schema import Document, Place, field
from libins.sensor_tables import Gps, Track, check_lengths, check_outages, read_track
from libins.sensors import built_gps, built_track, site_of
from libins.tables import Motion, check_motion, read_csv, read_motion, resolve

Array = np.ndarray[Any, Any]
DRIVE_COLUMNS = ("t_s", "w_x_rad_s", "w_y_rad_s", "w_z_rad_s", "f_x_m_s2", "f_y_m_s2", "f_z_m_s2")
IMU_COLUMNS = ("t_s", "theta_x_rad", "theta_y_rad", "theta_z_rad", "v_x_m_s", "v_y_m_s", "v_z_m_s")
TRUTH_COLUMNS = (
    *("t_s", "latitude_rad", "longitude_rad", "height_m", "v_north_m_s", "v_east_m_s", "v_down_m_s"),
    *("q_w", "q_x", "q_y", "q_z", "north_m", "east_m", "down_m", *DRIVE_COLUMNS[1:]),
    *(f"gyro_bias_{axis}_rad_s" for axis in "xyz"),
    *(f"accel_bias_{axis}_m_s2" for axis in "xyz"),
)
GPS_COLUMNS = (*TRUTH_COLUMNS[:7], "sats")
EVENT_COLUMNS = ("t_s", "event", "direction")
CHUNK_S = 5.0
"""Simulated between two looks at the progress bar."""
QUANTITIES: Mapping[str, Callable[[Any, Any, Any], float]] = {
    "north_m": lambda p, v, q: float(p[0]),
    "east_m": lambda p, v, q: float(p[1]),
    "up_m": lambda p, v, q: -float(p[2]),
    "speed_m_s": lambda p, v, q: math.hypot(*v),
    "climb_m_s": lambda p, v, q: -float(v[2]),
    "roll_rad": lambda p, v, q: math.atan2(2 * (q[2] * q[3] + q[0] * q[1]), 1 - 2 * (q[1] ** 2 + q[2] ** 2)),
    "pitch_rad": lambda p, v, q: math.asin(max(-1.0, min(1.0, 2 * (q[0] * q[2] - q[1] * q[3])))),
}
DIRECTIONS = {"rising": 1, "falling": -1, "both": 0}


@dataclass(frozen=True)
class Triad:
    """Three gyros or accelerometers."""

    bias: list[float] | None = field(None)
    turn_on: list[float] | None = field(None)
    scale: list[float] | None = field(None)
    misalignment: list[float] | None = field(None)
    random_walk: list[float] | None = field(None)
    bias_instability: list[float] | None = field(None)
    rate_random_walk: list[float] | None = field(None)
    markov: list[float] | None = field(None)
    markov_tau_s: float | None = field(None)
    bias_per_k: list[float] | None = field(None)
    scale_per_k: list[float] | None = field(None)
    quantum: float | None = field(None)
    range: float | None = field(None)


@dataclass(frozen=True)
class Imu:
    """Increments at rate_hz, and what is wrong with them; temperature: above_k + warm_up_k (1 - exp(-t / tau))."""

    rate_hz: float = field(100.0, minimum=1e-2, maximum=1e5)
    gyro: Triad = field(Triad)
    accel: Triad = field(Triad)
    g_sensitivity: list[float] | None = field(None)
    above_k: float = field(0.0, minimum=-300.0, maximum=300.0)
    warm_up_k: float = field(0.0, minimum=-300.0, maximum=300.0)
    warm_up_tau_s: float = field(300.0, minimum=1e-3, maximum=1e6)


@dataclass(frozen=True)
class Receiver(Gps):
    """Of a scenario, and how often."""

    period_s: float = field(1.0, minimum=0.01, maximum=100.0)


@dataclass(frozen=True)
class Manoeuvre:
    """One of a drive's; see ins_truth/drive.h."""

    name: str = field(choices=("hold", "accelerate", "turn", "roll", "pitch", "yaw"))
    duration_s: float = field(minimum=1e-3, maximum=1e6)
    amount: float = field(0.0, minimum=-1e4, maximum=1e4)


@dataclass(frozen=True)
class Event:
    """An instant that is looked for."""

    quantity: str = field(choices=tuple(QUANTITIES))
    value: float = field(0.0)
    direction: str = field("both", choices=tuple(DIRECTIONS))
    stops: bool = field(False)


@dataclass(frozen=True)
class Body:
    """Integrated from the site on, by [[manoeuvre]] or by a file of body rates and specific force."""

    csv: str = field("")
    heading_rad: float = field(0.0)
    pitch_rad: float = field(0.0)
    roll_rad: float = field(0.0)
    speed_m_s: float = field(0.0, minimum=-1e4, maximum=1e4)
    tolerance: float = field(1e-12, minimum=1e-14, maximum=1e-3)


@dataclass(frozen=True, kw_only=True)
class Tables:
    """The file, as written."""

    duration_s: float = field(above=0.0, maximum=1e6)
    seed: int = field(1, minimum=0, maximum=2**63 - 1)
    track: Track = field(Track)
    motion: Motion | None = field(None)
    body: Body | None = field(None)
    manoeuvre: list[Manoeuvre] = field([])
    event: list[Event] = field([])
    imu: Imu = field(Imu)
    gps: Receiver = field(Receiver)


class Sim:
    """A simulation that is ready to be written out."""

    def __init__(self, path: Path, settings: Mapping[str, Any], origin: str = "--set") -> None:
        """Read the file and those that it names. Raises UsageError."""
        self._document = Document(path)
        self._document.override(settings, origin)
        self.tables = self._document.parse(Tables, self._document.table)
        check_lengths(self._document, ("gps",), self.tables.gps)
        check_outages(self._document, self.tables.gps.outages_s)
        imu = self.tables.imu
        self.errors = self._guard(("imu",), lambda: _truth.ImuErrors(self._errors(imu)))
        self.gps = built_gps(_truth, self.tables.gps, self.tables.seed)
        if self.gps is not None:
            self.gps.period_s = self.tables.gps.period_s
        self.track = self._body(self.tables.body) if self.tables.body is not None else self._track()
        self.happenings: list[tuple[float, int, int]] = _truth.happenings(self.track)
        stops = [t for t, event, _ in self.happenings if self.tables.event[event].stops]
        self.duration_s = min([self.tables.duration_s, *stops])
        self.samples = math.floor(self.duration_s * imu.rate_hz * (1.0 + 1e-12))

    def imu(self) -> Iterator[tuple[Array, Array]]:
        """Rows of IMU_COLUMNS and of TRUTH_COLUMNS, chunk by chunk. Row k is of the sample that ends at its t_s."""
        imu = self.tables.imu
        step = max(1, round(CHUNK_S * imu.rate_hz))
        for first in range(0, self.samples, step):
            t = np.arange(first, min(first + step, self.samples) + 1) / imu.rate_hz
            warm = imu.above_k + imu.warm_up_k * (1.0 - np.exp(-t[1:] / imu.warm_up_tau_s))
            theta, v = self.track.increments(t)
            sensed = self.errors.apply(theta, v, 1.0 / imu.rate_hz, warm.tolist())
            s = self.track.at(t[1:].copy())
            where = [s["llh"], s["v_local"], s["q_local"], s["p_n"], s["w_ib_b"], s["f_b"]]
            yield (
                np.column_stack([t[1:], sensed["theta"], sensed["v"]]),
                np.column_stack([t[1:], *where, sensed["gyro_bias"], sensed["accel_bias"]]),
            )

    def fixes(self) -> Array:
        """Rows of GPS_COLUMNS: the valid fixes, at the instants they are of."""
        if self.gps is None:
            return np.empty((0, len(GPS_COLUMNS)))
        count = math.floor(self.duration_s / self.tables.gps.period_s * (1.0 + 1e-12)) + 1
        found = self._guard(("gps",), lambda: _truth.gps_fixes(self.gps, self.track, 0, count))
        rows = np.column_stack([found[name] for name in ("t", "llh", "v_n", "sats")])
        return np.asarray(rows[found["valid"][:, 0] == 1.0])

    def _guard(self, place: Place, call: Callable[[], Any]) -> Any:
        try:
            return call()
        except ValueError as error:
            raise self._document.refuse(place, str(error)) from error
        except RuntimeError as error:
            raise UsageError(f"{self._document.path}: {'.'.join(place)}: {error}") from error

    def _errors(self, imu: Imu) -> Any:
        config = _truth.ImuConfig()
        config.seed = self.tables.seed
        for triad, table in ((config.gyro, imu.gyro), (config.accel, imu.accel)):
            for each in fields(table):
                if (value := getattr(table, each.name)) is not None:
                    setattr(triad, each.name, value)
        if imu.g_sensitivity is not None:
            config.g_sensitivity = imu.g_sensitivity
        return config

    def _track(self) -> Any:
        tables = self.tables
        for name in ("manoeuvre", "event"):
            if getattr(tables, name):
                raise self._document.refuse((name, "0"), "is of a body: give a table [body]")
        attitude = None
        if tables.motion is not None:
            motion = tables.motion
            check_motion(self._document, motion)
            rows = read_motion(self._document, motion)
            attitude = self._guard(("motion",), lambda: built_motion(_truth, motion, rows))
        elif tables.track.attitude == "motion":
            raise self._document.refuse(("track", "attitude"), "found 'motion', but there is no table [motion]")
        attitude = attitude if tables.track.by_motion else None
        path = read_track(self._document, tables.track)
        return self._guard(("track",), lambda: built_track(_truth, tables.track, attitude, path))

    def _body(self, body: Body) -> Any:
        tables = self.tables
        if (body.csv == "") == (not tables.manoeuvre):
            raise self._document.refuse(("body",), "needs either csv or [[manoeuvre]] tables, and not both")
        site = site_of(_truth, tables.track)
        if body.csv:
            t, *columns = read_csv(resolve(self._document, ("body", "csv"), body.csv, None), DRIVE_COLUMNS, 4).T
            w, f = (np.column_stack(part) for part in (columns[:3], columns[3:]))
            drive = self._guard(("body", "csv"), lambda: _truth.drive_table(t.copy(), w, f))
        else:
            plan = [(m.name, m.duration_s, m.amount) for m in tables.manoeuvre]
            drive = self._guard(("manoeuvre",), lambda: _truth.drive_manoeuvres(site, plan, 0.0, body.speed_m_s))
        yaw, pitch, roll = ((angle, 0.0, 0.0, 0.0) for angle in (body.heading_rad, body.pitch_rad, body.roll_rad))
        q = self._guard(("body",), lambda: _truth.motion_euler(yaw, pitch, roll, 0.0)).attitude(0.0)
        ahead = np.array(
            [1 - 2 * (q[2] ** 2 + q[3] ** 2), 2 * (q[1] * q[2] + q[0] * q[3]), 2 * (q[1] * q[3] - q[0] * q[2])]
        )
        events = [(_value(event), DIRECTIONS[event.direction], event.stops) for event in tables.event]
        v_n = (body.speed_m_s * ahead).tolist()
        where = ((0.0, 0.0, 0.0), v_n, q, 0.0, tables.duration_s, body.tolerance)
        return self._guard(("body",), lambda: _truth.track_body(site, drive, *where, events))


def _value(event: Event) -> Callable[[float, Any, Any, Any], float]:
    quantity = QUANTITIES[event.quantity]
    return lambda t, p, v, q: quantity(p, v, q) - event.value
