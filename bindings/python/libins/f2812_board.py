r"""Boards with an F2812 as an object: the test plays the hosts, all in simulated time.

    from libins.f2812_board import F2812Board

    with F2812Board(firmware="modem.f2812") as board:
        board.hosts["scia"].send(b"AT\r")
        board.hosts["scia"].expect(b"OK\r\n", within_s=0.1)
        board.run_until(register="SCIFFRXA", access="write")
        assert board.registers["SCIFFRXA"] & 0x1F == 1

The same calls give the same octets and accesses on every machine. The firmware is compiled for
this machine and runs in a process of its own: no instruction to stop at, no snapshot and no step back.
"""

import contextlib
import copy
import re
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

from libins import faults, net_scenario
from libins.bench import Bench, Input, never
from libins.board_uart import Inbox, Octet, Pattern, seconds, shown
from libins.errors import UsageError
from libins.machine import PS_PER_S
from libins.net_machine import NetMachine, told
from libins.net_observe import Observation, Wanted
from libins.net_tables import F2812Board as Keys
from libins.report import report_line
from libins.scenario import find
from libins.schema import Document, leaves

RESET_S = 1e-6
"""How long reset() holds /XRS low."""
OF_8051 = (
    *("snapshot", "restore", "from_snapshot", "keep", "past", "pc", "cycles", "run_to", "symbols", "variables"),
    *("iram", "xdata", "code", "sfr", "volts", "pins", "pin"),
)
"""What a Board of the 8051 has, and this one cannot have."""


class HostEnd:
    """A host at the other end of a line."""

    def __init__(self, name: str, baud: float, do: Callable[..., Any], expect: Callable[..., re.Match[bytes]]) -> None:
        """do: a change from outside; expect: of a board, of one of its hosts."""
        self.name, self.baud = name, baud
        self._do, self._expect = do, expect
        self.inbox = Inbox()

    def send(self, octets: bytes) -> None:
        """To the board, at the host's baud, from this instant on."""
        if self._do("send", self.name, octets) != len(octets):
            raise UsageError(f"send: {self.name} has no room for {len(octets)} octets; run the board first")

    def expect(self, pattern: Pattern, within_s: float = 1.0) -> re.Match[bytes]:
        """Run until octets have come that match: bytes as they are, or a compiled pattern of bytes.

        What was received before and not matched counts. Stops at the octet that completes the match.
        Raises ExpectError.
        """
        __tracebackhide__ = True
        return self._expect(self.name, self.inbox, pattern, within_s, self.baud)

    @property
    def received(self) -> list[Octet]:
        """What came, with its times; of what was matched, the last few thousand octets."""
        return list(self.inbox.octets)

    @property
    def unread(self) -> bytes:
        """What came and no expect() has matched yet."""
        return self.inbox.unread()


class Registers:
    """Registers of an F2812 by TI's name or by word address, to look at: no side effects of a read."""

    def __init__(self, machine: NetMachine, board: str) -> None:
        """Of one board."""
        self._machine, self._board = machine, board

    def __getitem__(self, register: str | int) -> int:
        """Its value now."""
        with told(f"registers[{register!r}]"):
            values: list[int] = self._machine.net.peek(self._board, register)
        return values[0]


class F2812Board(Bench):
    """A scenario with an F2812, from power-on. Raises UsageError for what cannot be, CrashError when a program dies."""

    def __init__(
        self,
        scenario_file: str | Path | net_scenario.NetScenario | None = None,
        *,
        firmware: str | Path | None = None,
        **keys: Any,
    ) -> None:
        """A scenario by name or file, or a board alone with `firmware` and a host on each of its ports.

        keys: of a scenario file, tables as dicts: sci={"a": {"baud": 19200}}, switches={"sci_rxffovf": "newest"}.
        """
        if isinstance(scenario_file, net_scenario.NetScenario):
            if keys or firmware is not None:
                raise UsageError("F2812Board: a scenario that is loaded takes no keys")
            self.scenario = scenario_file
        else:
            self.scenario = _loaded(scenario_file, firmware, keys)
        self._power_on()

    def _power_on(self) -> None:
        tables = self.scenario.tables
        self.inputs: list[Input] = []
        self._watch: Observation | None = None
        self.machine = NetMachine(self.scenario, tables.seed)
        self.hosts = {host.name: HostEnd(host.name, host.baud, self._do, self._expect) for host in tables.host}
        self.boards = {name: Registers(self.machine, name) for name in self.machine.boards}
        self.faults = faults.Faults(self._do, self.machine.fault_hits)

    def __enter__(self) -> "F2812Board":
        """Ends its programs in the end."""
        return self

    def __exit__(self, *_: object) -> None:
        """Ends its programs."""
        self.close()

    def __getattr__(self, name: str) -> Any:
        """Why something that a Board has is not here."""
        if name in OF_8051:
            raise UsageError(f"F2812Board.{name}: {net_scenario.NO_STATE}")
        raise AttributeError(f"F2812Board has no {name}")

    def close(self) -> None:
        """End its programs; nothing goes on after it."""
        self.machine.close()

    # Time

    @property
    def now_ps(self) -> int:
        """Simulated time since power-on [ps]."""
        return self.machine.now_ps

    def run_until(  # type: ignore[override]
        self,
        when: float | Callable[[], bool] | None = None,
        within_s: float = 1.0,
        every_s: float = 1e-3,
        *,
        register: str | int | None = None,
        access: str = "any",
        value: int | None = None,
        mask: int = 0xFFFF,
        board: str | None = None,
    ) -> dict[str, Any] | None:
        """Until an instant [s], until a condition holds, or until the firmware accesses a register.

        access: read, write or any; value: only with this value under the mask. Gives the access: t_ps, register,
        access, value. Raises TimeoutError when it does not come within_s from now.
        """
        __tracebackhide__ = True
        if (when is None) == (register is None):
            raise UsageError("run_until: an instant, a condition or register= is needed")
        if when is not None:
            super().run_until(when, within_s, every_s)
            return None
        assert register is not None
        return self._run_to_access(board or self._only(), register, access, value, mask, within_s)

    def _run_to_access(
        self, board: str, register: str | int, access: str, value: int | None, mask: int, within_s: float
    ) -> dict[str, Any]:
        __tracebackhide__ = True
        net = self.machine.net
        end = self.now_ps + round(within_s * PS_PER_S)
        with told(f"run_until(register={register!r})"):
            net.set_break(board, register, access, value, mask)
        try:
            stopped = self._advance(end, lambda: net.stopped() is not None and net.stopped()["station"] == board)
            at: dict[str, Any] = net.stopped() if stopped else {}
        finally:
            net.clear_break(board, register)
        if not stopped:
            raise TimeoutError(f"no {access} access to {register} within {within_s:g} s; {self.where()}")
        return at

    def _advance(self, end_ps: int, done: Callable[[], bool] = never, octet_at: str | None = None) -> bool:
        machine = self.machine
        while machine.now_ps < end_ps:
            before = machine.now_ps
            reached = machine.until(end_ps) if octet_at is None else machine.until_octet(octet_at, end_ps)
            for host in self.hosts.values():
                host.inbox.add([Octet(*octet) for octet in machine.take_received(host.name)])
            if self._watch is not None:
                self._watch.slice(machine, machine.take_edges())
            if not reached and done():
                return True
            if not reached and machine.now_ps == before and machine.ended() is not None:
                break
        return False

    # Hosts

    @property
    def host(self) -> HostEnd:
        """The only one there is."""
        if len(self.hosts) != 1:
            raise UsageError(f"there are hosts {', '.join(self.hosts) or 'nowhere'}: board.hosts[NAME] says which")
        return next(iter(self.hosts.values()))

    def send(self, octets: bytes) -> None:
        """From the only host; see HostEnd."""
        self.host.send(octets)

    def expect(self, pattern: Pattern, within_s: float = 1.0) -> re.Match[bytes]:
        """At the only host; see HostEnd."""
        __tracebackhide__ = True
        return self.host.expect(pattern, within_s)

    @property
    def received(self) -> list[Octet]:
        """Of the only host; see HostEnd."""
        return self.host.received

    @property
    def unread(self) -> bytes:
        """Of the only host; see HostEnd."""
        return self.host.unread

    # The board's own

    def _only(self) -> str:
        if len(self.boards) != 1:
            raise UsageError(f"there are boards {', '.join(self.boards)}: board=NAME says which")
        return next(iter(self.boards))

    @property
    def registers(self) -> Registers:
        """Of the only F2812; of several board.boards[NAME]."""
        return self.boards[self._only()]

    @property
    def reports(self) -> list[dict[str, Any]]:
        """What the firmware did wrong, and what the emulator does not model."""
        return self.machine.reports()

    @property
    def ended(self) -> str | None:
        """How the firmware ended: ESTOP0, main() returned; None: it runs on."""
        return self.machine.ended()

    def statistics(self) -> dict[str, Any]:
        """Counts so far, as in the summary of a run."""
        return self.machine.counted()

    def reset(self) -> None:
        """Pulse /XRS."""
        self.faults.add("reset", at_s=self.now_s, for_s=RESET_S)

    def where(self) -> str:
        """For a message: what is known of the place in the firmware."""
        end = self.ended
        return f"{seconds(self.now_ps)} simulated" + (f", the firmware has ended: {end}" if end else "")

    def describe(self) -> str:
        """What the board has to say about the firmware, and the last lines that each host received."""
        tables = self.scenario.tables
        programs = ", ".join(f"{b.firmware} on {b.name}" for b in tables.board if isinstance(b, Keys))
        lines = [f"{programs}, seed {tables.seed}, {self.where()}"]
        lines += [f"{r['kind']}: {report_line(r)}" for r in self.reports]
        for host in self.hosts.values():
            octets = host.received
            lines += [f"{host.name} received, {len(octets)} octets kept:", *shown(octets, host.baud)]
        return "\n".join(lines)

    @contextlib.contextmanager
    def record(
        self, vcd: Path | None = None, registers: list[str] | None = None, access_log: Path | None = None
    ) -> Iterator[None]:
        """Write down what happens inside the with statement, as `ins run` does."""
        watch = Observation(Wanted(vcd, registers or [], access_log))
        try:
            self.machine.take_edges()
            watch.begin(self.machine)
            self._watch = watch
            yield
            watch.end(self.machine)
        finally:
            self._watch = None
            self.machine.record(accesses=False, interrupts=False)
            watch.close()

    def _do(self, what: str, *arguments: Any) -> Any:
        """Every change from outside passes here."""
        note = Input(self.now_ps, what, arguments)
        if what == "add_fault":
            self._add_fault(dict(arguments[0]))
            result = None
        else:
            with told("F2812Board"):
                result = getattr(self.machine.net, what)(*arguments)
        self.inputs.append(note)
        return result

    def _add_fault(self, keys: Mapping[str, Any]) -> None:
        tables = self.scenario.tables

        def target(document: Document, fault: faults.Fault) -> faults.Target:
            return net_scenario.targets_of(tables)[net_scenario.station_of(document, ("fault",), fault, tables)]

        fault = faults.parsed(keys, self.now_s, target)
        with told("F2812Board.faults.add"):
            self.machine.add_fault(fault, tables.seed, len(self.machine.fault_hits()), self.now_s)


def is_f2812(name: str) -> bool:
    """Whether a scenario or program is for this board, by its file. Raises UsageError."""
    path = find(name)
    is_scenario = path.suffix == ".toml" and path.is_file()
    return path.suffix == net_scenario.PROGRAM or (is_scenario and net_scenario.is_net(Document(path)))


def _loaded(
    scenario_file: str | Path | None, firmware: str | Path | None, keys: Mapping[str, Any]
) -> net_scenario.NetScenario:
    if scenario_file is None:
        document = Document(Path("F2812Board"), copy.deepcopy(net_scenario.BARE))
        if firmware is None:
            raise UsageError("F2812Board: firmware= or a scenario is needed")
    else:
        document = Document(find(str(scenario_file)))
    if firmware is not None:
        path = Path(firmware)
        document.override({"firmware": str(path.absolute() if path.is_file() else path)}, "F2812Board")
    document.override(dict(leaves(keys)), "F2812Board")
    if not net_scenario.is_net(document):
        raise document.refuse(("board",), "this board has no F2812; libins.board.Board takes it")
    return net_scenario.read(document)
