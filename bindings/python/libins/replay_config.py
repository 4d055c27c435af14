"""The TOML file of `ins replay`: recordings, their columns and units, the filter, where fixes are withheld.

docs/replay.md lists every key. Names carry their unit.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from libins.schema import Document, field

TIMES = ("unix_gps", "unix_utc", "gps_week", "gps_tow", "seconds")
"""Seconds since 1970 on GPS's or UTC's clock; columns week and tow; seconds of the week alone; or since anything."""
FILTERS = ("gps_ins", "gps_dr", "gps_dr_paper")
VEHICLES = ("car", "walk", "free")


@dataclass(frozen=True, kw_only=True)
class ImuFile:
    """Three gyros and three accelerometers."""

    csv: str
    columns: list[str] = field(["time", "fx", "fy", "fz", "wx", "wy", "wz"])
    time: str = field("unix_gps", choices=TIMES)
    time_scale: float = field(1.0, above=0.0)
    time_offset_s: float = field(0.0, minimum=-1e10, maximum=1e10)
    kind: str = field("rates", choices=("rates", "increments"))
    force_unit: str = field("m/s^2", choices=("m/s^2", "g", "mg"))
    rate_unit: str = field("rad/s", choices=("rad/s", "deg/s"))
    axes: str = field("x,y,z")
    force_axes: str | None = field(None)


@dataclass(frozen=True, kw_only=True)
class GnssFile:
    """Fixes of the antenna."""

    file: str
    format: str = field("auto", choices=("auto", "pos", "csv", "nmea", "ubx"))
    columns: list[str] = field([])
    time: str | None = field(None, choices=TIMES)
    time_offset_s: float = field(0.0, minimum=-1e10, maximum=1e10)
    lever_arm_m: list[float] = field([0.0, 0.0, 0.0])
    sigma_scale: float = field(1.0, above=0.0, maximum=1e3)
    sigma_floor_m: list[float] | None = field(None, minimum=0.0)
    sigma_velocity_floor_m_s: list[float] | None = field(None, minimum=0.0)
    use_velocity: bool = field(True)
    velocity_late_s: float | None = field(None, minimum=-0.5, maximum=0.45)


@dataclass(frozen=True, kw_only=True)
class WheelsFile:
    """A vehicle's speed, or counts of its odometer, and its yaw rate."""

    csv: str
    columns: list[str] = field(["time", "speed", "yaw_rate"])
    time: str = field("unix_gps", choices=TIMES)
    time_offset_s: float = field(0.0, minimum=-1e10, maximum=1e10)
    metres_per_count: float = field(1.0, above=0.0)
    rate_unit: str = field("rad/s", choices=("rad/s", "deg/s"))
    yaw_rate_positive: str = field("right", choices=("right", "left"))
    lever_arm_m: list[float] = field([0.0, 0.0, 0.0])


@dataclass(frozen=True, kw_only=True)
class Noise:
    """Of the IMU; what is left out is measured at standstills, or that of a usual MEMS part.

    scale_g, scale_a: standard deviations of scale factors, 0.01 is a hundredth; 0: none are estimated.
    """

    arw_rad_rts: float | None = field(None, above=0.0)
    vrw_m_s_rts: float | None = field(None, above=0.0)
    bias_g_rad_s: float | None = field(None, above=0.0)
    bias_a_m_s2: float | None = field(None, above=0.0)
    tau_g_s: float | None = field(None, above=0.0)
    tau_a_s: float | None = field(None, above=0.0)
    scale_g: float = field(0.0, minimum=0.0, maximum=0.1)
    scale_a: float = field(0.0, minimum=0.0, maximum=0.1)


@dataclass(frozen=True, kw_only=True)
class GpsDr:
    """Of the filters gps_dr and gps_dr_paper; the paper's own read uere_m and reading only."""

    reading: str = field("corrected", choices=("printed", "corrected"))
    uere_m: float = field(5.0, above=0.0, maximum=1e4)
    tau_fix_s: float = field(20.0, minimum=0.0, maximum=1e4)
    gyro_bias_rad_s: float = field(5e-3, minimum=0.0, maximum=1.0)
    odometer_scale: float = field(0.02, minimum=0.0, maximum=1.0)


@dataclass(frozen=True, kw_only=True)
class Reference:
    """What errors are told against; without it, the fixes themselves, also those withheld."""

    file: str
    format: str = field("auto", choices=("auto", "pos", "csv", "nmea", "ubx"))
    columns: list[str] = field([])
    time: str | None = field(None, choices=TIMES)
    time_offset_s: float = field(0.0, minimum=-1e10, maximum=1e10)


@dataclass(frozen=True, kw_only=True)
class Outages:
    """Fixes are withheld for length_s every period_s, first at start_s (period_s) after the recordings begin.

    phases: the drive is replayed so many times, the schedule shifted by a part of its period, and the table pools them.
    """

    length_s: float = field(above=0.0, maximum=1e5)
    period_s: float = field(above=0.0, maximum=1e5)
    start_s: float | None = field(None, minimum=0.0, maximum=1e6)
    phases: int = field(1, minimum=1, maximum=100)


@dataclass(frozen=True, kw_only=True)
class Outage:
    """One more, from the first sample on."""

    from_s: float = field(minimum=0.0, maximum=1e6)
    to_s: float = field(minimum=0.0, maximum=1e6)


@dataclass(frozen=True, kw_only=True)
class Output:
    """Where results go, beside the configuration; an option of the command line stands above its key."""

    rate_hz: float = field(10.0, above=0.0, maximum=1e4)
    csv: str | None = field(None)
    kml: str | None = field(None)
    geojson: str | None = field(None)
    html: str | None = field(None)
    json: str | None = field(None)


@dataclass(frozen=True, kw_only=True)
class Config:
    """One replay."""

    schema: int = field(choices=(1,))
    filter: str = field("gps_ins", choices=FILTERS)
    vehicle: str = field("car", choices=VEHICLES)
    leap_s: float = field(18.0, minimum=0.0, maximum=100.0)
    smooth: bool = field(False)
    imu: ImuFile | None = field(None)
    gnss: GnssFile
    wheels: WheelsFile | None = field(None)
    gps_dr: GpsDr = field(GpsDr)
    noise: Noise = field(Noise)
    reference: Reference | None = field(None)
    outages: Outages | None = field(None)
    outage: list[Outage] = field([])
    output: Output = field(Output)


def _check_filter(document: Document, config: Config) -> None:
    """Each has the recordings that it needs, and is asked for nothing that it does not do. Raises UsageError."""
    if config.filter == "gps_ins":
        if config.imu is None:
            raise document.refuse(("imu",), 'is missing; filter = "gps_ins" needs it, "gps_dr" needs [wheels] instead')
        return
    if config.wheels is None:
        raise document.refuse(("wheels",), f'is missing; filter = "{config.filter}" needs it: speed and yaw_rate')
    if config.smooth:
        told = f'filter = "{config.filter}" has no smoother, "gps_ins" has; leave --smooth and smooth out'
        raise document.refuse(("smooth",), told)


def load(path: Path, overrides: Mapping[str, Any]) -> Config:
    """Read and check, with these values in the place of the file's, by dotted name. Raises UsageError."""
    document = Document(path)
    document.override(overrides, "--set")
    config = document.parse(Config, document.table)
    _check_filter(document, config)
    for i, outage in enumerate(config.outage):
        if outage.to_s <= outage.from_s:
            raise document.refuse(("outage", str(i), "to_s"), f"found {outage.to_s}, but it must be after from_s")
    if config.outages is not None and config.outages.period_s <= config.outages.length_s:
        found = f"found {config.outages.period_s}, not more than length_s: nothing would be left between the outages"
        raise document.refuse(("outages", "period_s"), found)
    if config.smooth and (config.noise.scale_g > 0.0 or config.noise.scale_a > 0.0):
        key = "scale_g" if config.noise.scale_g > 0.0 else "scale_a"
        found = (
            f"found {getattr(config.noise, key)}, but the smoother knows no scale factors: take smooth away, or them"
        )
        raise document.refuse(("noise", key), found)
    for table, names in (
        (config.gnss, ("lever_arm_m", "sigma_floor_m", "sigma_velocity_floor_m_s")),
        (config.wheels, ("lever_arm_m",)),
    ):
        for name in names:
            if table is not None and (value := getattr(table, name)) is not None and len(value) != 3:
                place = "gnss" if table is config.gnss else "wheels"
                raise document.refuse((place, name), f"found {value!r}, but 3 numbers are needed")
    return config
