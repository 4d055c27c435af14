"""What scenario files of every board have in common: the motion, sensors, a line, a navigator, expectations, files.

A table is a dataclass; the names of its keys carry their unit (rad, s, Hz, V). docs/scenarios.md lists every key.
"""

import csv
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from libins import faults
from libins.errors import UsageError
from libins.schema import Document, Place, field

PACKAGE = Path(__file__).absolute().parent
"""In the build tree the modules are links: what was built lies beside the links."""
IMAGES = (".ihx", ".hex", ".ihex", ".f2812")
VARYING = ("matrix", "campaign")
"""Tables that say which keys are varied."""
MOTION_COLUMNS = ("t_s", "yaw_rad", "pitch_rad", "roll_rad")
VOLTS_COLUMNS = ("t_s", "volts")
FLASH_OCTETS = {"at89s51": 4096, "at89s52": 8192}
RAM_OCTETS = {"at89s51": 128, "at89s52": 256}
ACQUISITION = ("8051_tlc2543", "8051_tlc2543_six")
"""Kinds of acquisition boards."""
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

    kind: str = field(choices=("still", "constant_rate", "sinusoids", "coning", "csv", "fixture"))
    ramp_s: float = field(0.0, minimum=0.0)
    yaw: Sinusoid = field(Sinusoid)
    pitch: Sinusoid = field(Sinusoid)
    roll: Sinusoid = field(Sinusoid)
    rate_rad_s: list[float] = field([0.0, 0.0, 0.0])
    half_angle_rad: float = field(0.0, minimum=0.0, maximum=math.pi / 2)
    frequency_hz: float = field(0.0, minimum=0.0, maximum=1000.0)
    csv: str = field("")
    up_b: list[list[float]] = field([])
    rest_s: float = field(5.0, minimum=0.1, maximum=1e5)
    turn_s: float = field(1.0, minimum=0.1, maximum=1e5)


@dataclass(frozen=True)
class Gyro:
    """The three rate gyros and their amplifiers; keys left out keep the preset's values."""

    preset: str = field("ideal", choices=("ideal", "cg_l53"))
    bandwidth_hz: float | None = field(None, minimum=0.0)
    noise_rad_s_rthz: float | None = field(None, minimum=0.0)
    bias_rad_s: list[float] | None = field(None)
    drift_rad_s2: list[float] | None = field(None)


@dataclass(frozen=True)
class FrontEnd:
    """Between sensors and converter; a stage whose figure is 0 is a wire. See ins_truth/front_end.h."""

    sensor_hz: float = field(0.0, minimum=0.0, maximum=1e6)
    sensor_damping: float = field(0.0, minimum=0.0, maximum=20.0)
    amplifier_hz: float = field(0.0, minimum=0.0, maximum=1e8)
    slew_v_s: float = field(0.0, minimum=0.0, maximum=1e9)
    rc_s: float = field(0.0, minimum=0.0, maximum=10.0)


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


@dataclass(frozen=True, kw_only=True)
class Common:
    """Keys that every scenario has."""

    schema: int = field(choices=(1,))
    stop_s: float = field(above=0.0, maximum=1e6)
    seed: int = field(1, minimum=0, maximum=2**63 - 1)
    stop_samples: int | None = field(None, minimum=1)
    motion: Motion
    fault: list[faults.Fault] = field([])
    expect: list[Expect] = field([])


@dataclass(frozen=True, kw_only=True)
class Acquisition:
    """Keys of an acquisition board: AT89S51, TLC2543, gyros."""

    firmware: str
    part: str = field("at89s51", choices=tuple(FLASH_OCTETS))
    code_octets: int = field(0, minimum=0, maximum=65536)
    xdata_octets: int = field(0, minimum=0, maximum=65536)
    clock_hz: int = field(11_059_200, minimum=1_000_000, maximum=33_000_000)
    gyro: Gyro = field(Gyro)
    front_end: FrontEnd | None = field(None)
    analog: list[Analog] = field([])


@dataclass(frozen=True)
class Loaded:
    """A scenario with its files read: everything a run needs."""

    path: Path
    tables: Common
    firmware: Path
    """Of several boards, the first's."""
    csv: np.ndarray[Any, Any] | None
    """The motion's file."""
    combination: Mapping[str, Any]
    """What the matrix sets, by dotted name."""
    table: Mapping[str, Any]
    """As written, with what replaced a key."""

    def serial(self) -> list[str]:
        """Names of the lines' ends that the outside may have."""
        return ["uart"]

    def contents(self) -> list[object]:
        """Of the files that the scenario names."""
        return [] if self.csv is None else [self.csv.tolist()]

    @property
    def text(self) -> str:
        """The file's, for a report; empty for an image alone."""
        return "" if is_image(self.path) else self.path.read_text(encoding="utf-8")

    @property
    def name(self) -> str:
        """The file's, with the combination in brackets: default[link.baud=9600, seed=2]."""
        inside = ", ".join(f"{key}={value}" for key, value in self.combination.items())
        return self.path.stem + (f"[{inside}]" if inside else "")


def settle(document: Document) -> None:
    """Leave out the tables that say which keys are varied."""
    for varying in VARYING:
        document.table.pop(varying, None)


def check_common(document: Document, tables: Common) -> None:
    """What one key alone cannot show. Raises UsageError."""
    for i, expect in enumerate(tables.expect):
        if expect.at_most is None and expect.at_least is None:
            raise document.refuse(("expect", str(i)), "needs at_most or at_least")


def check_motion(document: Document, motion: Motion) -> None:
    """As check_common."""
    if len(motion.rate_rad_s) != 3:
        raise document.refuse(("motion", "rate_rad_s"), f"found {motion.rate_rad_s!r}, but 3 numbers are needed")
    if motion.kind == "fixture" and not motion.up_b:
        raise document.refuse(("motion", "up_b"), "is missing; a fixture needs the upward vertical in b of each rest")
    for i, up in enumerate(motion.up_b):
        if len(up) != 3 or not any(up):
            raise document.refuse(("motion", "up_b", str(i)), f"found {up!r}, but 3 numbers, not all 0, are needed")


def check_acquisition(document: Document, place: Place, board: Acquisition) -> None:
    """As check_common."""
    if 0 < board.code_octets < FLASH_OCTETS[board.part]:
        found = f"found {board.code_octets}, less than the flash of the {board.part}"
        raise document.refuse((*place, "code_octets"), found)
    for key in ("bias_rad_s", "drift_rad_s2"):
        if (value := getattr(board.gyro, key)) is not None and len(value) != 3:
            raise document.refuse((*place, "gyro", key), f"found {value!r}, but 3 numbers (X, Y, Z) are needed")
    channels = [signal.channel for signal in board.analog]
    for i, channel in enumerate(channels):
        if channel in channels[:i]:
            raise document.refuse((*place, "analog", str(i), "channel"), f"found {channel} again; one table a channel")


def check_nav(document: Document, place: Place, nav: Nav, channels: int = 3) -> None:
    """As check_common."""
    if len(nav.skew_s) != channels or max(nav.skew_s) >= nav.period_s:
        raise document.refuse((*place, "skew_s"), f"{channels} delays, one a channel, below period_s are needed")
    if nav.block_len < 2 * channels:
        raise document.refuse(
            (*place, "block_len"), f"found {nav.block_len}, but {channels} channels need two octets each"
        )


def check_cuts(document: Document, place: Place, cuts_s: Sequence[Sequence[float]]) -> None:
    """As check_common."""
    end = 0.0
    for i, cut in enumerate(cuts_s):
        if len(cut) != 2 or not end <= cut[0] < cut[1]:
            needed = f"[from, to] with {end} <= from < to"
            raise document.refuse((*place, "cuts_s", str(i)), f"found {cut!r}, but {needed} is needed")
        end = cut[1]


def read_volts(document: Document, place: Place, board: Acquisition) -> dict[int, np.ndarray[Any, Any]]:
    """Files of [[analog]] tables, by their place. Raises UsageError."""
    return {
        i: read_csv(resolve(document, (*place, "analog", str(i), "csv"), signal.csv, None), VOLTS_COLUMNS, 2)
        for i, signal in enumerate(board.analog)
        if signal.csv
    }


def read_motion(document: Document, motion: Motion) -> np.ndarray[Any, Any] | None:
    """The file that a motion of kind csv names. Raises UsageError."""
    if motion.kind != "csv":
        return None
    return read_csv(resolve(document, ("motion", "csv"), motion.csv, None), MOTION_COLUMNS, 4)


def is_image(path: Path) -> bool:
    """Whether it is a program for a board by its name."""
    return path.suffix.lower() in IMAGES


def resolve(document: Document, place: Place, name: str, built_in: Path | None) -> Path:
    beside = document.path.parent / name
    if name and beside.is_file():
        return beside
    if name and built_in is not None and (built_in / name).is_file():
        return built_in / name
    places = f"{document.path.parent}" + (f" and {built_in}" if built_in else "")
    raise document.refuse(place, f"found {name!r}, but there is no such file in {places}")


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
