"""Scenario files: board, firmware, the motion fed in, what the line does, who navigates and what must come out.

TOML without loops or expressions; logic belongs in pytest. Names carry their unit (rad, s, Hz, V).
docs/scenarios.md lists every key.
"""

import copy
import csv
import itertools
import math
import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from libins import faults, hexfile
from libins.errors import UsageError
from libins.schema import Document, field

PACKAGE = Path(__file__).absolute().parent
"""In the build tree the modules are links: what was built lies beside the links."""
FLASH_OCTETS = {"at89s51": 4096, "at89s52": 8192}
RAM_OCTETS = {"at89s51": 128, "at89s52": 256}
BARE: dict[str, Any] = {"schema": 1, "board": "8051_tlc2543", "stop_s": 60.0, "motion": {"kind": "still"}}
"""The board alone, without a scenario file: gyros at rest, and nobody at the other end of the line."""
IMAGES = (".ihx", ".hex", ".ihex")
BOARDS = ("8051_tlc2543", "8051_tlc2543_six")
MOTION_COLUMNS = ("t_s", "yaw_rad", "pitch_rad", "roll_rad")
VOLTS_COLUMNS = ("t_s", "volts")
VARYING = ("matrix", "campaign")
"""Tables that say which keys are varied."""
MATRIX_LIMIT = 10_000
"""Combinations of one scenario; more are a campaign's."""
FORMS = ("one", "hist1", "hist2_fit", "hist2_opt", "hist3_fit", "hist3_opt")


@dataclass(frozen=True)
class Sinusoid:
    """angle(t) = offset + amplitude * sin(2 pi frequency t + phase)."""

    offset_rad: float = field(0.0)
    amplitude_rad: float = field(0.0)
    frequency_hz: float = field(0.0, minimum=0.0, maximum=1000.0)
    phase_rad: float = field(0.0)


@dataclass(frozen=True)
class Motion:
    """The true motion. `kind` says which of the other keys count."""

    kind: str = field(choices=("still", "constant_rate", "sinusoids", "coning", "csv"))
    ramp_s: float = field(0.0, minimum=0.0)
    yaw: Sinusoid = field(Sinusoid)
    pitch: Sinusoid = field(Sinusoid)
    roll: Sinusoid = field(Sinusoid)
    rate_rad_s: list[float] = field([0.0, 0.0, 0.0])
    half_angle_rad: float = field(0.0, minimum=0.0, maximum=math.pi / 2)
    frequency_hz: float = field(0.0, minimum=0.0, maximum=1000.0)
    csv: str = field("")


@dataclass(frozen=True)
class Gyro:
    """The three rate gyros and their amplifiers; keys left out keep the preset's values."""

    preset: str = field("ideal", choices=("ideal", "cg_l53"))
    bandwidth_hz: float | None = field(None, minimum=0.0)
    noise_rad_s_rthz: float | None = field(None, minimum=0.0)
    bias_rad_s: list[float] | None = field(None)
    drift_rad_s2: list[float] | None = field(None)


@dataclass(frozen=True)
class Analog:
    """What is on an input instead of a gyro: volts + amplitude_v sin(2 pi frequency_hz t + phase_rad) + the file."""

    channel: int = field(minimum=0, maximum=255)
    volts: float = field(0.0)
    amplitude_v: float = field(0.0)
    frequency_hz: float = field(0.0, minimum=0.0, maximum=1e5)
    phase_rad: float = field(0.0)
    csv: str = field("")


@dataclass(frozen=True)
class Link:
    """The serial line between the board and its host, and what goes wrong on it."""

    baud: float = field(9600.0, minimum=50.0, maximum=4e6)
    bit_error: float = field(0.0, minimum=0.0, maximum=0.5)
    octet_loss: float = field(0.0, minimum=0.0, maximum=0.5)
    cuts_s: list[list[float]] = field([])


@dataclass(frozen=True)
class Nav:
    """The receiver and navigator at the host's end. The period, block length and sequence number are the firmware's."""

    period_s: float = field(above=0.0, maximum=10.0)
    block_len: int = field(6, minimum=6, maximum=32)
    sequence: bool = field(True)
    form: str = field("hist2_opt", choices=FORMS)
    rate_order: int = field(4, minimum=2, maximum=5)
    skew_s: list[float] = field([0.0, 0.0, 0.0], minimum=0.0, maximum=1.0)
    start: str = field("truth", choices=("truth", "level"))


@dataclass(frozen=True)
class Expect:
    """One check on the summary: a dotted name in it, and a bound."""

    value: str
    at_most: float | None = field(None)
    at_least: float | None = field(None)


@dataclass(frozen=True)
class Tables:
    """A scenario file, as written."""

    firmware: str
    motion: Motion
    schema: int = field(choices=(1,))
    board: str = field(choices=BOARDS)
    stop_s: float = field(above=0.0, maximum=1e6)
    part: str = field("at89s51", choices=tuple(FLASH_OCTETS))
    code_octets: int = field(0, minimum=0, maximum=65536)
    xdata_octets: int = field(0, minimum=0, maximum=65536)
    clock_hz: int = field(11_059_200, minimum=1_000_000, maximum=33_000_000)
    seed: int = field(1, minimum=0, maximum=2**63 - 1)
    stop_samples: int | None = field(None, minimum=1)
    gyro: Gyro = field(Gyro)
    analog: list[Analog] = field([])
    link: Link = field(Link)
    nav: Nav | None = field(None)
    fault: list[faults.Fault] = field([])
    expect: list[Expect] = field([])


@dataclass(frozen=True)
class Scenario:
    """A scenario with its files read: everything a run needs."""

    path: Path
    tables: Tables
    image: list[tuple[int, bytes]]
    firmware: Path
    csv: np.ndarray[Any, Any] | None
    combination: Mapping[str, Any]
    """What the matrix sets, by dotted name."""
    table: Mapping[str, Any]
    """As written, with what replaced a key."""
    volts: Mapping[int, np.ndarray[Any, Any]]
    """Files of [[analog]] tables, by their place."""

    def tables_read(self) -> list[np.ndarray[Any, Any]]:
        """Every CSV file that the scenario names."""
        return [*([] if self.csv is None else [self.csv]), *self.volts.values()]

    @property
    def text(self) -> str:
        """The file's, for a report; empty for an image alone."""
        return "" if is_image(self.path) else self.path.read_text(encoding="utf-8")

    @property
    def name(self) -> str:
        """The file's, with the combination in brackets: default[link.baud=9600, seed=2]."""
        inside = ", ".join(f"{key}={value}" for key, value in self.combination.items())
        return self.path.stem + (f"[{inside}]" if inside else "")


def is_image(path: Path) -> bool:
    """Whether it is an Intel HEX file by its name."""
    return path.suffix.lower() in IMAGES


def find(name: str) -> Path:
    """A scenario by path, or by the name of one that comes with the package ("default")."""
    path = Path(name)
    built_in = PACKAGE / "scenarios" / f"{path.stem}.toml"
    return built_in if not path.exists() and path.parent == Path() and built_in.exists() else path


def load(
    path: Path,
    firmware: Path | None = None,
    settings: Mapping[str, Any] | None = None,
    combination: Mapping[str, Any] | None = None,
    origin: str = "matrix",
) -> Scenario:
    """Read and check a scenario and the files it names. Raises UsageError.

    An Intel HEX image in the place of a scenario runs on a bare board. settings and combination replace keys by dotted
    name: from the command line, and from the table called origin.
    """
    if is_image(path):
        document, firmware = Document(path, copy.deepcopy(BARE)), firmware or path
    else:
        document = Document(path)
    document.override(settings or {}, "--set")
    return read(document, firmware, combination, origin)


def read(
    document: Document,
    firmware: Path | None,
    combination: Mapping[str, Any] | None = None,
    origin: str = "matrix",
) -> Scenario:
    """A scenario from its document. Raises UsageError."""
    document.override(combination or {}, origin)
    for varying in VARYING:
        document.table.pop(varying, None)
    if firmware is not None:
        document.table.setdefault("firmware", firmware.name)
    tables = document.parse(Tables, document.table)
    _check(document, tables)
    image_path = firmware or _resolve(document, ("firmware",), tables.firmware, PACKAGE / "firmware")
    table = None
    if tables.motion.kind == "csv":
        table = read_csv(_resolve(document, ("motion", "csv"), tables.motion.csv, None), MOTION_COLUMNS, 4)
    volts = {
        i: read_csv(_resolve(document, ("analog", str(i), "csv"), signal.csv, None), VOLTS_COLUMNS, 2)
        for i, signal in enumerate(tables.analog)
        if signal.csv
    }
    image = hexfile.load(image_path, tables.code_octets or FLASH_OCTETS[tables.part])
    return Scenario(document.path, tables, image, image_path, table, combination or {}, document.table, volts)


def load_all(path: Path, firmware: Sequence[Path] = (), settings: Mapping[str, Any] | None = None) -> list[Scenario]:
    """Every combination of the [matrix] and of the images, all checked before any runs. Raises UsageError.

    A key that settings or firmware give is no longer varied.
    """
    document = Document(path, BARE if is_image(path) else None)
    given = {*(settings or {}), *(("firmware",) if firmware else ())}
    axes = {key: v for key, v in _axes(document, (), document.table.get("matrix", {})) if key not in given}
    count = math.prod(map(len, axes.values())) * max(1, len(firmware))
    if count > MATRIX_LIMIT:
        raise document.refuse(("matrix",), f"makes {count} runs, but {MATRIX_LIMIT} is the most; shorten a list")
    combinations = [dict(zip(axes, values, strict=True)) for values in itertools.product(*axes.values())]
    loaded = [load(path, image, settings, each) for image in firmware or (None,) for each in combinations]
    if len(firmware) > 1:
        loaded = [replace(each, combination={"firmware": str(each.firmware), **each.combination}) for each in loaded]
    return loaded


def _axes(document: Document, key: tuple[str, ...], table: Any) -> Iterator[tuple[str, list[Any]]]:
    """Dotted name and values of each list of the [matrix], written link.baud, "link.baud" or as a table."""
    if isinstance(table, dict):
        for name, value in table.items():
            yield from _axes(document, (*key, *name.split(".")), value)
    elif not isinstance(table, list) or not table:
        raise document.refuse(("matrix", *key), f"found {table!r}, but a list of one value or more is needed")
    else:
        yield ".".join(key), table


def setting(text: str) -> tuple[str, Any]:
    """KEY=VALUE of the command line; the value as TOML would read it, or else a string. Raises UsageError."""
    key, equals, value = text.partition("=")
    if not equals or not re.fullmatch(r"[\w-]+(\.[\w-]+)*", key):
        raise UsageError(f"--set {text}: KEY=VALUE is needed, for example link.baud=19200")
    try:
        return key, tomllib.loads(f"value = {value}")["value"]
    except tomllib.TOMLDecodeError:
        return key, value


def _resolve(document: Document, key: tuple[str, ...], name: str, built_in: Path | None) -> Path:
    beside = document.path.parent / name
    if name and beside.is_file():
        return beside
    if name and built_in is not None and (built_in / name).is_file():
        return built_in / name
    places = f"{document.path.parent}" + (f" and {built_in}" if built_in else "")
    raise document.refuse(key, f"found {name!r}, but there is no such file in {places}")


def _check(document: Document, tables: Tables) -> None:
    """What one key alone cannot show."""
    if 0 < tables.code_octets < FLASH_OCTETS[tables.part]:
        raise document.refuse(("code_octets",), f"found {tables.code_octets}, less than the flash of the {tables.part}")
    motion = tables.motion
    for key, length in (("rate_rad_s", 3),):
        if len(getattr(motion, key)) != length:
            raise document.refuse(("motion", key), f"found {getattr(motion, key)!r}, but {length} numbers are needed")
    for key in ("bias_rad_s", "drift_rad_s2"):
        if (value := getattr(tables.gyro, key)) is not None and len(value) != 3:
            raise document.refuse(("gyro", key), f"found {value!r}, but 3 numbers (X, Y, Z) are needed")
    if tables.nav is not None:
        if len(tables.nav.skew_s) != 3 or max(tables.nav.skew_s) >= tables.nav.period_s:
            raise document.refuse(("nav", "skew_s"), "three delays (X, Y, Z) below period_s are needed")
    elif tables.stop_samples is not None:
        raise document.refuse(("stop_samples",), "counts the navigator's samples, but there is no [nav] table")
    faults.check(document, tables.fault, RAM_OCTETS[tables.part])
    channels = [signal.channel for signal in tables.analog]
    for i, channel in enumerate(channels):
        if channel in channels[:i]:
            raise document.refuse(("analog", str(i), "channel"), f"found {channel} again; one table a channel")
    end = 0.0
    for i, cut in enumerate(tables.link.cuts_s):
        if len(cut) != 2 or not end <= cut[0] < cut[1]:
            needed = f"[from, to] with {end} <= from < to"
            raise document.refuse(("link", "cuts_s", str(i)), f"found {cut!r}, but {needed} is needed")
        end = cut[1]
    for i, expect in enumerate(tables.expect):
        if expect.at_most is None and expect.at_least is None:
            raise document.refuse(("expect", str(i)), "needs at_most or at_least")


def read_csv(path: Path, columns: Sequence[str], least: int) -> np.ndarray[Any, Any]:
    """A table of numbers by time, with that header and at least so many rows. Raises UsageError with the line."""
    try:
        with path.open(newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
    except (OSError, UnicodeDecodeError) as error:
        raise UsageError(f"{path}: cannot be read: {error}") from error
    if not rows or [name.strip() for name in rows[0]] != list(columns):
        found = ",".join(rows[0]) if rows else "nothing"
        raise UsageError(f"{path}:1: found {found!r}, but the header must be {','.join(columns)}")
    values: list[list[float]] = []
    for number, row in enumerate(rows[1:], start=2):
        try:
            numbers = [float(cell) for cell in row]
        except ValueError as error:
            raise UsageError(f"{path}:{number}: {error}") from error
        if len(numbers) != len(columns) or not all(map(math.isfinite, numbers)):
            raise UsageError(f"{path}:{number}: found {','.join(row)!r}, but {len(columns)} finite numbers are needed")
        if values and numbers[0] <= values[-1][0]:
            raise UsageError(f"{path}:{number}: t_s = {numbers[0]} does not come after {values[-1][0]}")
        values.append(numbers)
    if len(values) < least:
        raise UsageError(f"{path}: {len(values)} rows, but at least {least} are needed")
    return np.array(values)
