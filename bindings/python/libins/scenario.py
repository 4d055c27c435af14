"""Scenario files: board, firmware, the motion fed in, what the line does, who navigates and what must come out.

TOML without loops or expressions; logic belongs in pytest. Names carry their unit (rad, s, Hz, V).
docs/scenarios.md lists every key.
"""

import copy
import itertools
import math
import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from libins import faults, hexfile, knobs, net_scenario, sixacc_calibration, sixacc_tables
from libins.errors import UsageError
from libins.schema import Document, field
from libins.sensor_tables import Gps, Track, check_lengths, check_outages, read_track
from libins.sixacc_tables import Calibration, GyroFree, SixAcc
from libins.tables import (
    ACQUISITION,
    FLASH_OCTETS,
    PACKAGE,
    RAM_OCTETS,
    Acquisition,
    Common,
    Link,
    Loaded,
    Nav,
    check_acquisition,
    check_common,
    check_cuts,
    check_motion,
    check_nav,
    is_image,
    read_motion,
    read_volts,
    resolve,
    settle,
)

BARE: dict[str, Any] = {"schema": 1, "board": "8051_tlc2543", "stop_s": 60.0, "motion": {"kind": "still"}}
"""The board alone, without a scenario file: gyros at rest, and nobody at the other end of the line."""
ROOMS = ("scenarios", "scenarios_f2812")
"""Folders of the package with scenarios."""
MATRIX_LIMIT = 10_000
"""Combinations of one scenario; more are a campaign's."""


@dataclass(frozen=True, kw_only=True)
class Tables(Acquisition, Common):
    """A scenario file of the acquisition board, as written."""

    board: str = field(choices=ACQUISITION)
    link: Link = field(Link)
    nav: Nav | None = field(None)
    sixacc: SixAcc | None = field(None)
    calibration: Calibration | None = field(None)
    track: Track = field(Track)
    gps: Gps = field(Gps)
    gyro_free: GyroFree = field(GyroFree)
    knob: list[knobs.Knob] = field([])
    send: list[knobs.Send] = field([])


@dataclass(frozen=True)
class Scenario(Loaded):
    """Of the acquisition board."""

    tables: Tables
    image: list[tuple[int, bytes]]
    volts: Mapping[int, np.ndarray[Any, Any]]
    """Files of [[analog]] tables, by their place."""
    path_csv: np.ndarray[Any, Any] | None
    """The track's file."""

    def contents(self) -> list[object]:
        """Of the files that the scenario names."""
        path = [] if self.path_csv is None else [self.path_csv.tolist()]
        return [*super().contents(), self.image, *(table.tolist() for table in self.volts.values()), *path]


def find(name: str) -> Path:
    """A scenario by path, or by the name of one that comes with the package ("default")."""
    path = Path(name)
    if path.exists() or path.parent != Path():
        return path
    return next((found for found in (PACKAGE / room / f"{path.stem}.toml" for room in ROOMS) if found.exists()), path)


def load(
    path: Path,
    firmware: Path | None = None,
    settings: Mapping[str, Any] | None = None,
    combination: Mapping[str, Any] | None = None,
    origin: str = "matrix",
) -> Loaded:
    """Read and check a scenario and the files it names. Raises UsageError.

    A program in the place of a scenario runs on a bare board. settings and combination replace keys by dotted name:
    from the command line, and from the table called origin.
    """
    document = _document(path, settings)
    document.override(combination or {}, origin)
    if net_scenario.is_net(document):
        return net_scenario.read(document, _image(path, firmware), combination or {})
    return read(document, _image(path, firmware), combination or {})


def load_board(path: Path, firmware: Path | None = None, settings: Mapping[str, Any] | None = None) -> Scenario:
    """As load, of the acquisition board alone. Raises UsageError."""
    return read(_document(path, settings), _image(path, firmware))


def schema_of(document: Document) -> type[Common]:
    """The dataclass of the document's tables."""
    return net_scenario.schema_of(document) if net_scenario.is_net(document) else Tables


def _document(path: Path, settings: Mapping[str, Any] | None) -> Document:
    document = Document(path, copy.deepcopy(bare(path)) if is_image(path) else None)
    document.override(settings or {}, "--set")
    return document


def bare(path: Path) -> dict[str, Any]:
    """The scenario of a program alone."""
    return net_scenario.BARE if path.suffix.lower() == net_scenario.PROGRAM else BARE


def _image(path: Path, firmware: Path | None) -> Path | None:
    return firmware or (path if is_image(path) else None)


def read(document: Document, firmware: Path | None = None, combination: Mapping[str, Any] | None = None) -> Scenario:
    """A scenario of the acquisition board from its document. Raises UsageError."""
    if net_scenario.is_net(document):
        raise document.refuse(("board",), net_scenario.NO_STATE)
    settle(document)
    if firmware is not None:
        document.table.setdefault("firmware", firmware.name)
    tables = document.parse(Tables, document.table)
    check_motion(document, tables.motion)
    check_acquisition(document, (), tables)
    if tables.sixacc is not None:
        sixacc_tables.check(document, tables.sixacc)
        sixacc_tables.check_gyro_free(document, tables.gyro_free)
        check_lengths(document, ("gps",), tables.gps)
        check_outages(document, tables.gps.outages_s)
    for name in ("track", "gps", "gyro_free"):
        if name in document.table and tables.sixacc is None:
            raise document.refuse((name,), "needs a [sixacc] table: gyros do not feel where the board goes")
    if tables.calibration is not None:
        sixacc_calibration.check(document, tables.calibration, tables.motion, tables.sixacc)
    if tables.nav is not None:
        check_nav(document, ("nav",), tables.nav, 3 if tables.sixacc is None else sixacc_tables.COUNT)
    elif tables.stop_samples is not None:
        raise document.refuse(("stop_samples",), "counts the navigator's samples, but there is no [nav] table")
    faults.check(document, tables.fault, faults.acquisition(RAM_OCTETS[tables.part]))
    knobs.check(document, tables.knob, tables.send, gyros=tables.sixacc is None)
    check_cuts(document, ("link",), tables.link.cuts_s)
    check_common(document, tables)
    image_path = firmware or resolve(document, ("firmware",), tables.firmware, PACKAGE / "firmware")
    csv, volts = read_motion(document, tables.motion), read_volts(document, (), tables)
    path_csv = read_track(document, tables.track)
    image = hexfile.load(image_path, tables.code_octets or FLASH_OCTETS[tables.part])
    return Scenario(document.path, tables, image_path, csv, combination or {}, document.table, image, volts, path_csv)


def load_all(path: Path, firmware: Sequence[Path] = (), settings: Mapping[str, Any] | None = None) -> list[Loaded]:
    """Every combination of the [matrix] and of the images, all checked before any runs. Raises UsageError.

    A key that settings or firmware give is no longer varied.
    """
    document = Document(path, bare(path) if is_image(path) else None)
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


def switch(text: str) -> tuple[str, Any]:
    """NAME=VALUE of the command line: a switch of the one F2812. Raises UsageError."""
    name, equals, value = text.partition("=")
    if not equals or not re.fullmatch(r"\w+", name) or not value:
        raise UsageError(f"--switch {text}: NAME=VALUE is needed, for example sci_rxffovf=newest")
    return f"switches.{name}", value


def setting(text: str) -> tuple[str, Any]:
    """KEY=VALUE of the command line; the value as TOML would read it, or else a string. Raises UsageError."""
    key, equals, value = text.partition("=")
    if not equals or not re.fullmatch(r"[\w-]+(\.[\w-]+)*", key):
        raise UsageError(f"--set {text}: KEY=VALUE is needed, for example link.baud=19200")
    try:
        return key, tomllib.loads(f"value = {value}")["value"]
    except tomllib.TOMLDecodeError:
        return key, value
