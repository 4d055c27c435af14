"""What a calibration is told: a TOML file beside the data. Keys left out keep their defaults."""

from dataclasses import dataclass
from pathlib import Path

from libins.errors import UsageError
from libins.schema import Document, field

AXES = 3
FULL_NAMES = ("b", "SF", "m1", "m2", "k2", "r")
PAPER_COUNT = 6


@dataclass(frozen=True, kw_only=True)
class Accelerometer:
    """Nominal: as it is meant to be mounted."""

    axis: list[float] = field()
    place_m: list[float] = field([0.0, 0.0, 0.0])


@dataclass(frozen=True, kw_only=True)
class Poses:
    """A file with one row a pose: where up is in b, how it spins, what is read. Columns by name, or number from 1."""

    file: str = field()
    readings: list[str] = field()
    up: list[str] = field([])
    rate: list[str] = field([])
    rate_unit: str = field("rad/s", choices=("rad/s", "deg/s"))


@dataclass(frozen=True, kw_only=True)
class Model:
    """Of the full model."""

    noise_m_s2: float = field(1e-3, above=0.0, maximum=10.0)
    fixture_deg: float = field(0.0, minimum=0.0, maximum=10.0)
    robust_sigmas: float = field(0.0, minimum=0.0, maximum=100.0)
    fixed: list[str] = field([], choices=FULL_NAMES)


@dataclass(frozen=True, kw_only=True)
class Group:
    """Of the paper's estimator."""

    numbers: int = field(146, choices=(146, 235))
    T_s: float = field(1.0, above=0.0)


@dataclass(frozen=True, kw_only=True)
class Sensor:
    """Samples of one triad, one row an instant."""

    file: str = field()
    columns: list[str] = field()
    time: str = field()


@dataclass(frozen=True, kw_only=True)
class Gyro(Sensor):
    """`scale` is the nominal one, where the search begins."""

    scale_rad_s: float = field(above=0.0)


@dataclass(frozen=True, kw_only=True)
class Still:
    """How stillness is told from motion."""

    initial_s: float = field(30.0, above=0.0)
    window_s: float = field(1.0, above=0.0)


@dataclass(frozen=True, kw_only=True)
class Known:
    """Accelerometers in known attitudes: `linear`, `full` and `paper`."""

    method: str = field(choices=("linear", "full", "paper"))
    g_m_s2: float = field(above=0.0, maximum=100.0)
    poses: Poses = field()
    rho_m: float | None = field(None, above=0.0, maximum=10.0)
    accelerometer: list[Accelerometer] = field([])
    full: Model = field(Model)
    paper: Group = field(Group)


@dataclass(frozen=True, kw_only=True)
class Triad:
    """Three accelerometers and, if there are, three gyros, moved by hand: `triad`."""

    method: str = field(choices=("triad",))
    g_m_s2: float = field(above=0.0, maximum=100.0)
    accel: Sensor = field()
    gyro: Gyro | None = field(None)
    still: Still = field(Still)


Declaration = Known | Triad


def read(path: Path) -> tuple[Document, Declaration]:
    """Raises UsageError."""
    document = Document(path)
    if document.table.get("method") == "triad":
        triad = document.parse(Triad, document.table)
        for name, sensor in (("accel", triad.accel), ("gyro", triad.gyro)):
            if sensor is not None:
                _count(document, (name, "columns"), sensor.columns, AXES)
        return document, triad
    known = document.parse(Known, document.table)
    count = len(known.poses.readings)
    if known.method == "paper":
        _count(document, ("poses", "readings"), known.poses.readings, AXES)
        return document, known
    _count(document, ("poses", "up"), known.poses.up, AXES)
    if known.poses.rate:
        _count(document, ("poses", "rate"), known.poses.rate, AXES)
    if known.method == "full":
        nominal = PAPER_COUNT if known.rho_m is not None else len(known.accelerometer)
        if nominal != count or (known.rho_m is not None and known.accelerometer):
            raise _refuse_geometry(document, count, nominal)
        for i, each in enumerate(known.accelerometer):
            _count(document, ("accelerometer", str(i), "axis"), each.axis, AXES)
            _count(document, ("accelerometer", str(i), "place_m"), each.place_m, AXES)
            if not any(each.axis):
                raise document.refuse(("accelerometer", str(i), "axis"), "is 0; give the direction that it senses")
    return document, known


def _count(document: Document, key: tuple[str, ...], found: list[str] | list[float], needed: int) -> None:
    if len(found) != needed:
        raise document.refuse(key, f"found {len(found)} entries, but {needed} are needed")


def _refuse_geometry(document: Document, count: int, nominal: int) -> UsageError:
    return document.refuse(
        ("poses", "readings"),
        f"{count} columns, but {nominal} nominal accelerometers; give rho_m (the paper's six) or one "
        f"[[accelerometer]] with axis and place_m for each column, not both",
    )
