"""Stations on serial lines, as a run drives them: the F2812 boards in processes of their own."""

import contextlib
from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from libins import _run, faults
from libins.errors import CrashError, UsageError
from libins.machine import Array, accuracy, config_of, gyro_of, link_of, nav_of
from libins.motions import motion_of
from libins.net_scenario import NetScenario, candidates, opposite
from libins.net_tables import HOST_BAUD, AcquisitionBoard, F2812Board, Host, Line
from libins.net_vcd import Wire
from libins.score import solved
from libins.sensors import gimu_of, gps_of, track_of

Records = list[tuple[int, int, int, int]]
"""Instant [ps], what (registers.KINDS), address or vector, value."""
PINS = {"SCIA": ("SCITXDA", "SCIRXDA"), "SCIB": ("SCITXDB", "SCIRXDB"), "UART": ("TXD", "RXD")}
"""Of a board's serial port: from it and to it."""

CUT_UP = "skipped"
"""A count of the process that depends on how far the run went at a time."""

HOST_COUNTS = ("octets_sent", "octets_received", "framing_errors", "false_starts", "overflow")


@contextlib.contextmanager
def told(place: object) -> Iterator[None]:
    """What the emulator says, as exceptions of this package; place: of what is wrong."""
    try:
        yield
    except _run.ProgramError as error:
        raise CrashError(str(error)) from error
    except ValueError as error:
        raise UsageError(f"{place}: {error}") from error


class NetMachine:
    """See machine.Machine."""

    scan_columns: Sequence[str] = _run.SCAN_COLUMNS

    def __init__(
        self, scenario: NetScenario, seed: int, outside: Collection[str] = (), keep_states: bool = True
    ) -> None:
        """At time 0. outside: hosts that somebody outside plays. keep_states: for measured().

        Raises UsageError, CrashError.
        """
        self._keep_states = keep_states
        self.scenario = scenario
        self.boards = list(scenario.programs)
        self._tables = scenario.tables
        self._acquisition: dict[str, Any] = {}
        self._lines: list[int] = []
        self._track: Any = None
        self._gimu_bauds: dict[str, float] = {}
        self._states: dict[str, list[Array]] = {}
        """Of each navigator."""
        self.traced: list[Wire] = []
        with told(scenario.path):
            self.net: Any = _run.Net(seed)
            for board in self._tables.board:
                self._add_board(board, seed)
            self._add_gimus(seed)
            for host in self._tables.host:
                self._add_host(host, seed, host.name in outside)
            for line in self._tables.line:
                self._add_line(line)
            for board in self._tables.board:
                self._trace(board)
        for place, fault in enumerate(self._tables.fault):
            with told(f"{scenario.path}: fault.{place}"):
                self.add_fault(fault, seed, place)
        self.navigates = bool(self._states)
        self.columns: Sequence[str] = self._columns(next(iter(self._states), None))
        self.wires: Sequence[str] = [f"{wire.station}.{wire.name}" for wire in self.traced]

    def _add_board(self, board: F2812Board | AcquisitionBoard, seed: int) -> None:
        if isinstance(board, F2812Board):
            program = str(self.scenario.programs[board.name])
            self.net.f2812(board.name, program, board.oscclk_hz, board.switches)
            return
        scenario = self.scenario
        gyro = gyro_of(board.gyro, seed)
        six = board.kind == "8051_tlc2543_six"
        config = config_of(board, scenario.images[board.name], scenario.volts[board.name], six, seed)
        self._acquisition[board.name] = self.net.acq(board.name, config, motion_of(scenario), gyro)

    def _add_gimus(self, seed: int) -> None:
        """All on the one track, each with noise of its own."""
        self._track = track_of(self.scenario) if self._tables.gimu else None
        gps = gps_of(self._tables.gps, seed)
        for number, gimu in enumerate(self._tables.gimu):
            made = gimu_of(gimu, seed + number)
            self._gimu_bauds |= {f"{gimu.name}.T": made.baud, f"{gimu.name}.R": made.nmea_baud}
            self.net.gimu(gimu.name, made, self._track, gps)

    def _add_host(self, host: Host, seed: int, outside: bool) -> None:
        if host.mode == "octets" or outside:
            self.net.host(host.name, host.baud)
            return
        self._states[host.name] = []
        if host.nav is None:
            self.net.host_nav(host.name, host.baud)
            return
        board = next(b for b in self._tables.board if b.name == opposite(self._tables, host))
        assert isinstance(board, AcquisitionBoard)
        nav = nav_of(host.nav, gyro_of(board.gyro, seed))
        self.net.host_codes(host.name, host.baud, board.name, nav, host.nav.start == "truth")

    def _columns(self, navigator: str | None) -> Sequence[str]:
        """Of the states of a host."""
        modes = {host.name: host.mode for host in self._tables.host}
        return {"codes": _run.STATE_COLUMNS, "nav": _run.SOLUTION_COLUMNS}.get(modes.get(navigator or "", ""), ())

    def _add_line(self, line: Line) -> None:
        a, b = line.ends
        baud, delay_s = self._baud(line), line.delay_s or 0.0
        cuts_s = [(begin, end) for begin, end in line.cuts_s]
        self._lines.append(self.net.line(a, b, baud, delay_s, line.bit_error, line.octet_loss, cuts_s))

    def _baud(self, line: Line) -> float:
        """Of the line, or of the host or sensor on it."""
        bauds = {host.name: host.baud for host in self._tables.host} | self._gimu_bauds
        return line.baud or next((bauds[end] for end in line.ends if end in bauds), HOST_BAUD)

    def _trace(self, board: F2812Board | AcquisitionBoard) -> None:
        """What a board sends, on a line or not, and what it receives."""
        ports = ("SCIA", "SCIB") if isinstance(board, F2812Board) else ("UART",)
        for port in ports:
            line = next((line for line in self._tables.line if f"{board.name}.{port}" in line.ends), None)
            for pin in PINS[port] if line is not None else PINS[port][:1]:
                self.net.trace(board.name, pin)
                self.traced.append(Wire(board.name, pin, self._baud(line) if line is not None else HOST_BAUD))

    def add_fault(self, fault: faults.Fault, seed: int, place: int, now_s: float = 0.0) -> None:
        """Raises ValueError."""
        station = fault.station or candidates(self._tables, fault)[0]
        self.net.add_fault(station, faults.built(fault, seed, place, now_s))

    # See Machine

    @property
    def track(self) -> Any:
        """Where the GPS-enabled IMUs go; None: there are none."""
        return self._track

    @property
    def subject(self) -> "NetMachine":
        """See Machine."""
        return self

    @property
    def now_ps(self) -> int:
        """See Machine."""
        return int(self.net.now_ps)

    def until(self, t_ps: int) -> bool:
        """See Machine."""
        with told(self.scenario.path):
            return bool(self.net.until(t_ps))

    def until_octet(self, host: str, t_ps: int) -> bool:
        """As until, but no further than the first octet that the host receives."""
        with told(self.scenario.path):
            return bool(self.net.until_octet(host, t_ps))

    def take_received(self, host: str) -> list[tuple[int, int, bool]]:
        """New octets of a host: instant [ps], value, whether the stop bit was there."""
        octets: list[tuple[int, int, bool]] = self.net.take_received(host)
        return octets

    def take_states(self) -> tuple[Array, list[bytes]]:
        """See Machine: those of the first navigator."""
        first: tuple[Array, list[bytes]] | None = None
        for host, kept in self._states.items():
            take = self.net.take_states if self._columns(host) is _run.STATE_COLUMNS else self.net.take_solutions
            states, raw = take(host)
            if self._keep_states:
                kept.append(states)
            first = first or (states, raw)
        return first or (np.empty((0, 0)), [])

    def take_edges(self) -> Array:
        """See Machine."""
        edges: Array = self.net.take_edges()
        return edges

    def send(self, line: str, octets: bytes) -> None:
        """See Machine; what the transmitter has no room for is lost, as on a cable."""
        self.net.send(line, octets)

    def take_octets(self, line: str) -> bytes:
        """See Machine."""
        octets: bytes = self.net.take_octets(line)
        return octets

    def output(self) -> bytes:
        """See Machine."""
        return b""

    def ended(self) -> str | None:
        """See Machine: all boards have ended."""
        if self._acquisition:
            return None
        ends = [str(self.net.ended(board)) for board in self.boards]
        return ", ".join(ends) if all(ends) else None

    def program(self) -> dict[str, Any] | None:
        """See Machine: firmware of an F2812 need not end."""
        end = self.ended()
        return None if end is None else {"ended": end, "exit_code": 0}

    def record(self, accesses: bool, interrupts: bool) -> None:
        """From now on keep what take_records() gives, of every F2812."""
        for board in self.boards:
            self.net.record(board, accesses, interrupts)

    def take_records(self, board: str) -> Records:
        """New register accesses and interrupts of an F2812."""
        return [(at, what, address, value) for at, what, address, value in self.net.take_records(board).tolist()]

    def measured(self, states: Array) -> dict[str, Any]:
        """See Machine; what one navigator alone makes stands at the top as well."""
        counted = self.counted()
        navigated = {host: self._navigated(host) for host in self._states}
        for host, made in navigated.items():
            counted["hosts"][host] |= made
        nothing = {"link": None, "attitude": None, "age_s": None}
        return {**counted, **nothing, **(next(iter(navigated.values())) if len(navigated) == 1 else {})}

    def _navigated(self, host: str) -> dict[str, Any]:
        """What a navigator has made of what came."""
        keys = next(each for each in self._tables.host if each.name == host)
        states = np.concatenate([np.empty((0, len(self._columns(host)))), *self._states[host]])
        counters = self.net.host_counters(host)
        if keys.mode == "nav":
            return {"link": blocks_of(counters), **solved(states, self._track)}
        line = next(i for i, line in enumerate(self._tables.line) if host in line.ends)
        run = self._acquisition[opposite(self._tables, keys)]
        counters |= run.counters() | counters | self.net.line_counters(self._lines[line])
        return {"link": link_of(counters, states), **accuracy(states)}

    def counted(self) -> dict[str, Any]:
        """What boards, hosts and lines have counted so far."""
        boards = {name: self._of_f2812(name) for name in self.boards}
        for name, run in self._acquisition.items():
            c = run.counters()
            boards[name] = {
                "cpu": {key: c[key] for key in ("instructions", "cycles", "interrupts")},
                "samples": c["sampled"],
            }
        hosts = {host.name: self.net.host_counters(host.name) for host in self._tables.host}
        return {
            **(boards[self.boards[0]] if self.scenario.flat else {"boards": boards}),
            "hosts": {name: {key: counts[key] for key in HOST_COUNTS} for name, counts in hosts.items()},
            **({"gimus": {g.name: self.net.gimu_counters(g.name) for g in self._tables.gimu}} if self._track else {}),
            "lines": [self.net.line_counters(line) for line in self._lines],
        }

    def _of_f2812(self, board: str) -> dict[str, Any]:
        """What the process of an F2812 has counted: names with dots are tables, the others the CPU's."""
        counted: dict[str, Any] = {"cpu": {}}
        for name, value in self.net.statistics(board).items():
            if name == CUT_UP:
                continue
            *tables, last = name.split(".")
            place = counted
            for table in tables or ("cpu",):
                place = place.setdefault(table, {})
            place[last] = value
        return counted

    def reports(self) -> list[dict[str, Any]]:
        """See Machine; each has the board's name."""
        names = [board.name for board in self._tables.board]
        found = [{"board": name, **report} for name in names for report in self.net.reports(name)]
        return [{k: v for k, v in r.items() if k != "board"} for r in found] if self.scenario.flat else found

    def fault_hits(self) -> Sequence[tuple[str, int]]:
        """See Machine."""
        hits: list[tuple[str, int]] = self.net.fault_hits()
        return hits

    def scans(self) -> Array:
        """See Machine: those of acquisition boards are their own."""
        return np.empty((0, len(self.scan_columns)))

    def close(self) -> None:
        """See Machine."""
        self.net = None


def blocks_of(c: Mapping[str, int]) -> dict[str, int]:
    """The summary's `link` of a host of navigation blocks."""
    kinds = ("duplicates", "corrupt", "timeouts", "stray", "invalid")
    retried = c["duplicates"] + c["corrupt"] + c["timeouts"]
    return {"ok": c["accepted"], "retried": retried, "lost": c["lost"], **{key: c[key] for key in kinds}}
