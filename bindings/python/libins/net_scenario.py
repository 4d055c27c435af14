"""Scenarios with an F2812 on them, docs/f2812_scenarios.md: read, and checked as a whole."""

import hashlib
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from libins import faults, hexfile
from libins.net_tables import (
    BOARDS,
    F2812,
    PORTS,
    AcquisitionBoard,
    F2812Board,
    Host,
    Many,
    Places,
    Single,
    places_of,
    spread,
)
from libins.schema import Document, Place
from libins.sensor_tables import Gimu, check_lengths, check_outages, read_track
from libins.tables import (
    FLASH_OCTETS,
    PACKAGE,
    RAM_OCTETS,
    Common,
    Loaded,
    check_acquisition,
    check_common,
    check_cuts,
    check_motion,
    check_nav,
    read_motion,
    read_volts,
    resolve,
    settle,
)

PROGRAM = ".f2812"
BARE: dict[str, Any] = {
    "schema": 1,
    "board": F2812,
    "stop_s": 60.0,
    "sci": {"a": {"to": "host"}, "b": {"to": "host"}},
}
"""The board alone, without a scenario file: hosts at 9600 baud that say nothing."""
NO_STATE = (
    "this needs the 8051 board: firmware for the F2812 is compiled for this machine, so there is no instruction to "
    "stop at, no snapshot and no step back; ins run and F2812Board take it, with --access-log and breaks on registers"
)
ENDS = {F2812: tuple(PORTS.values()), "gimu": ("T", "R"), "host": (), "acquisition": ("UART",)}
"""Names of the ends that lines may be tied to, of each kind of station; a host is an end itself."""
ELF = b"\x7fELF"


@dataclass(frozen=True)
class NetScenario(Loaded):
    """Of stations on serial lines."""

    tables: Many
    flat: bool
    """Written in the short form: the summary is that of the one board."""
    programs: Mapping[str, Path]
    """Of the F2812 boards, by name."""
    images: Mapping[str, list[tuple[int, bytes]]]
    """Of the acquisition boards, by name."""
    volts: Mapping[str, Mapping[int, np.ndarray[Any, Any]]]
    """Of the acquisition boards: files of their [[analog]] tables, by their place."""
    path_csv: np.ndarray[Any, Any] | None
    """The track's file."""

    def serial(self) -> list[str]:
        """Names of the lines' ends that the outside may have."""
        return [host.name for host in self.tables.host]

    def contents(self) -> list[object]:
        """Of the files that the scenario names."""
        programs = [hashlib.sha256(path.read_bytes()).hexdigest() for path in self.programs.values()]
        volts = [table.tolist() for tables in self.volts.values() for table in tables.values()]
        path = [] if self.path_csv is None else self.path_csv.tolist()
        return [*super().contents(), programs, self.images, volts, path]


def is_net(document: Document) -> bool:
    """Whether the scenario has an F2812, or several boards. Raises UsageError for a board that does not exist."""
    board = document.table.get("board")
    if isinstance(board, str) and board not in BOARDS:
        kinds = ", ".join(map(repr, BOARDS))
        raise document.refuse(("board",), f"found {board!r}, but one of {kinds} is needed, or [[board]] tables")
    return board == F2812 or isinstance(board, list)


def schema_of(document: Document) -> type[Common]:
    """The dataclass of the document's tables."""
    return Single if document.table["board"] == F2812 else Many


def read(document: Document, firmware: Path | None = None, combination: Mapping[str, Any] | None = None) -> NetScenario:
    """From its document. Raises UsageError."""
    settle(document)
    flat = document.table["board"] == F2812
    if firmware is not None:
        if not flat:
            raise document.refuse(("board",), "holds several boards; give board.0.firmware=F with --set")
        document.table.setdefault("firmware", firmware.name)
    if flat:
        single = document.parse(Single, document.table)
        _check_ports(document, single)
        tables, places = spread(single)
    else:
        tables = document.parse(Many, document.table)
        places = places_of(tables)
    _check(document, tables, places)
    programs: dict[str, Path] = {}
    images: dict[str, list[tuple[int, bytes]]] = {}
    volts: dict[str, Mapping[int, np.ndarray[Any, Any]]] = {}
    firmwares: list[Path] = []
    for board, place in zip(tables.board, places.board, strict=True):
        path = firmware or resolve(document, (*place, "firmware"), board.firmware, PACKAGE / "firmware")
        firmwares.append(path)
        if isinstance(board, F2812Board):
            programs[board.name] = _program(document, (*place, "firmware"), path)
        else:
            images[board.name] = hexfile.load(path, board.code_octets or FLASH_OCTETS[board.part])
            volts[board.name] = read_volts(document, place, board)
    csv = read_motion(document, tables.motion)
    path_csv = read_track(document, tables.track)
    return NetScenario(
        document.path,
        tables,
        firmwares[0],
        csv,
        combination or {},
        document.table,
        flat,
        programs,
        images,
        volts,
        path_csv,
    )


def _program(document: Document, place: Place, path: Path) -> Path:
    """A built board program."""
    remedy = "build it with add_f2812_firmware or f2812-cc (docs/f2812.md)"
    if path.suffix == ".c":
        raise document.refuse(place, f"found {path.name!r}, which is C source; {remedy} and name the {PROGRAM} file")
    try:
        with path.open("rb") as file:
            head = file.read(len(ELF))
    except OSError as error:
        raise document.refuse(place, f"{path}: cannot be read: {error.strerror}; {remedy}") from error
    if head != ELF:
        raise document.refuse(place, f"{path}: is no program for an F2812 board; {remedy}")
    return path


def _check_ports(document: Document, single: Single) -> None:
    """What the short form alone can get wrong."""
    for letter in PORTS:
        port = getattr(single.sci, letter)
        for key in ("mode", "baud"):
            if getattr(port, key) is not None and port.to != "host":
                raise document.refuse(("sci", letter, key), f'is the host\'s, but to = "{port.to}"')


def _stations(tables: Many, places: Places) -> Iterator[tuple[Any, Place]]:
    for kind in ("board", "gimu", "host"):
        yield from zip(getattr(tables, kind), getattr(places, kind), strict=True)


def _ends_of(station: F2812Board | AcquisitionBoard | Gimu | Host) -> list[str]:
    """Of a station, as a line names them."""
    if isinstance(station, Host):
        return [station.name]
    kind = F2812 if isinstance(station, F2812Board) else "gimu" if isinstance(station, Gimu) else "acquisition"
    return [f"{station.name}.{end}" for end in ENDS[kind]]


def _check(document: Document, tables: Many, places: Places) -> None:
    """What one key alone cannot show."""
    if not tables.board:
        raise document.refuse(("board",), "needs a table, one a board")
    names: set[str] = set()
    known: list[str] = []
    for station, place in _stations(tables, places):
        if not re.fullmatch(r"[A-Za-z]\w*", station.name):
            raise document.refuse((*place, "name"), f"found {station.name!r}, but letters and digits are needed")
        if station.name in names:
            raise document.refuse((*place, "name"), f"found {station.name!r} again; each station has a name of its own")
        names.add(station.name)
        known += _ends_of(station)
        if isinstance(station, AcquisitionBoard):
            check_acquisition(document, place, station)
    taken: set[str] = set()
    for line, place in zip(tables.line, places.line, strict=True):
        if len(line.ends) != 2:
            raise document.refuse((*place, "ends"), f'found {line.ends!r}, but two are needed: ["dsp.SCIA", "pc"]')
        for end in dict.fromkeys(line.ends):
            if end not in known:
                raise document.refuse((*place, "ends"), f"found {end!r}, but there are {', '.join(known)}")
            if end in taken:
                raise document.refuse((*place, "ends"), f"{end} is on another line already")
            taken.add(end)
        check_cuts(document, place, line.cuts_s)
    for station, place in _stations(tables, places):
        if isinstance(station, Host) and station.name not in taken:
            raise document.refuse((*place, "name"), f"{station.name} is on no line")
        if isinstance(station, Host):
            _check_host(document, place, station, tables)
    check_motion(document, tables.motion)
    check_lengths(document, ("gps",), tables.gps)
    check_outages(document, tables.gps.outages_s)
    for gimu, place in zip(tables.gimu, places.gimu, strict=True):
        check_lengths(document, place, gimu)
    if tables.stop_samples is not None and all(host.mode == "octets" for host in tables.host):
        raise document.refuse(("stop_samples",), "counts a navigator's samples, but no host has one")
    _check_faults(document, tables)
    check_common(document, tables)


def _check_faults(document: Document, tables: Many) -> None:
    """Each against the station that has it."""
    targets = targets_of(tables)
    mine: dict[str, list[tuple[Place, faults.Fault]]] = {name: [] for name in targets}
    for i, fault in enumerate(tables.fault):
        mine[station_of(document, ("fault", str(i)), fault, tables)].append((("fault", str(i)), fault))
    for name, its in mine.items():
        faults.check_of(document, its, targets[name])


def targets_of(tables: Many) -> dict[str, faults.Target]:
    """What may break, by station."""
    targets: dict[str, faults.Target] = {}
    for board in tables.board:
        if isinstance(board, F2812Board):
            targets[board.name] = faults.F2812
        else:
            targets[board.name] = faults.acquisition(RAM_OCTETS[board.part])
    talkers: list[Host | Gimu] = [*tables.host, *tables.gimu]
    return targets | dict.fromkeys((each.name for each in talkers), faults.HOST)


def candidates(tables: Many, fault: faults.Fault) -> list[str]:
    """Who may have a fault that names nobody: of a baud a host, else a board."""
    return [station.name for station in (tables.host if fault.kind == "baud" else tables.board)]


def station_of(document: Document, place: Place, fault: faults.Fault, tables: Many) -> str:
    """Who has a fault: the one named, or the one there is. Raises UsageError."""
    there = candidates(tables, fault)
    known = list(targets_of(tables))
    if fault.station is None and len(there) != 1:
        raise document.refuse((*place, "station"), f"is missing; one of {', '.join(known)} is needed")
    if fault.station is not None and fault.station not in known:
        raise document.refuse((*place, "station"), f"found {fault.station!r}, but one of {', '.join(known)} is needed")
    return fault.station or there[0]


def _check_host(document: Document, place: Place, host: Host, tables: Many) -> None:
    if (host.nav is not None) != (host.mode == "codes"):
        problem = 'a host with mode = "codes" needs it' if host.nav is None else 'is of mode = "codes"'
        raise document.refuse((*place, "nav"), problem)
    if host.nav is not None:
        check_nav(document, (*place, "nav"), host.nav)
        if opposite(tables, host) not in [b.name for b in tables.board if isinstance(b, AcquisitionBoard)]:
            raise document.refuse((*place, "mode"), 'found "codes", but the line leads to no acquisition board')


def opposite(tables: Many, host: Host) -> str:
    """Name of the station at the other end of a host's line; empty without a line."""
    ends = next((line.ends for line in tables.line if host.name in line.ends), [])
    return next((end.partition(".")[0] for end in ends if end != host.name), "")
