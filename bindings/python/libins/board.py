r"""The acquisition board as an object: firmware runs in it, the test plays the outside, all in simulated time.

    from libins.board import Board

    board = Board(firmware="blink.ihx", part="at89s52")
    board.expect(b"READY\r\n", within_s=0.5)
    board.volts[0] = 1.25
    board.send(b"?")
    assert board.expect(re.compile(rb"AIN0 (\d+) mV"), within_s=0.1)[1] == b"1250"

The same calls give the same cycles, octets and pins on every machine.
"""

import contextlib
import copy
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import Any

from libins import cdb, faults, run, scenario, snapshot
from libins.bench import Bench, Input, never
from libins.board_uart import ExpectError, Inbox, Octet, Pattern, seconds, shown
from libins.board_views import Memory, Pins, Registers, Variables, Volts
from libins.errors import UsageError
from libins.observe import Observation, Wanted
from libins.report import report_line
from libins.run import PS_PER_S
from libins.schema import Document, leaves
from libins.snapshot import Snapshot
from libins.tables import RAM_OCTETS, Motion

__all__ = ["Board", "ExpectError", "Snapshot"]

CHANNELS = 11
ADDRESSES = 0x10000


class Board(Bench):
    """One board and its firmware, from power-on. Raises UsageError for what cannot be."""

    def __init__(
        self,
        scenario_file: str | Path | scenario.Scenario | None = None,
        *,
        firmware: str | Path | None = None,
        navigator: bool = False,
        trace: bool = False,
        **keys: Any,
    ) -> None:
        """A scenario by name or file, or a bare board with `firmware`.

        keys: of a scenario file, tables as dicts: part="at89s52", clock_hz=12_000_000, link={"baud": 19200}.
        navigator: the scenario's plays the host; otherwise the test does. trace: keep every edge of the traced wires.
        """
        if not isinstance(scenario_file, scenario.Scenario):
            if scenario_file is None:
                document = Document(Path("Board"), copy.deepcopy(scenario.BARE))
                if firmware is None:
                    raise UsageError("Board: firmware= or a scenario is needed")
            else:
                document = Document(scenario.find(str(scenario_file)))
            if firmware is not None:
                document.override({"firmware": _image(firmware)}, "Board")
            document.override(dict(leaves(keys)), "Board")
            scenario_file = scenario.read(document)
        elif keys or firmware is not None:
            raise UsageError("Board: a scenario that is loaded takes no keys")
        self.scenario = scenario_file
        self._navigator, self._trace = navigator, trace
        self._watch: Observation | None = None
        self._keep_ps = 0
        self._past: list[tuple[Snapshot, list[Input]]] = []
        self._power_on()

    def _power_on(self) -> None:
        tables = self.scenario.tables
        self._run = run.build(self.scenario, tables.seed, not self._navigator, self._trace, listen=True)
        self._inbox = Inbox()
        self.iram = Memory("iram", RAM_OCTETS[tables.part], self._run.read, self._do)
        self.xdata = Memory("xdata", tables.xdata_octets, self._run.read, self._do)
        self.code = Memory("code", ADDRESSES, self._run.read, self._do)
        self.sfr = Registers(self._run.read, self._do)
        self.volts = Volts(CHANNELS, self._do)
        self.pins = Pins(self._run.pin, self._do)
        self.faults = faults.Faults(self._do, self._run.fault_hits)
        self._past = []
        self._keep()

    def load(self, firmware: str | Path) -> None:
        """Another image, from power-on."""
        document = Document(self.scenario.path, copy.deepcopy(dict(self.scenario.table)))
        document.override({"firmware": _image(firmware)}, "Board.load")
        self.scenario = scenario.read(document)
        self.__dict__.pop("symbols", None)
        self._power_on()

    # Time

    @property
    def now_ps(self) -> int:
        """Simulated time since power-on [ps]."""
        return int(self._run.now_ps)

    @property
    def cycles(self) -> int:
        """Machine cycles since power-on."""
        return int(self._run.counters()["cycles"])

    @property
    def pc(self) -> int:
        """Address of the next instruction."""
        return int(self._run.pc)

    def run_to(self, place: int | str, within_s: float = 1.0) -> None:
        """Until the instruction at an address, or the first of a C function, is the next one.

        Raises TimeoutError when it is not reached within_s from now.
        """
        __tracebackhide__ = True
        address = self.symbols.function(place).begin if isinstance(place, str) else place
        end = self.now_ps + round(within_s * PS_PER_S)
        self._run.set_break(address, True)
        try:
            reached = self._advance(end, lambda: self.pc == address)
        finally:
            self._run.set_break(address, False)
        if not reached:
            raise TimeoutError(f"{place} was not reached within {within_s:g} s; {self.where()}")

    def _advance(self, end_ps: int, done: Callable[[], bool] = never, octet_at: str | None = None) -> bool:
        """To an instant, or until the run stops with `done` true. Returns whether it was done."""
        go = self._run.until if octet_at is None else self._run.until_octet
        while self.now_ps < end_ps:
            goal = min(end_ps, self._next_keep_ps())
            reached = go(goal)
            self._inbox.add([Octet(*octet) for octet in self._run.take_received()])
            if self._watch is not None:
                self._watch.slice(self._run, self._run.take_edges())
            if reached and self.now_ps >= self._next_keep_ps():
                self._keep()
            if not reached and done():
                return True
        return False

    # The serial line

    def send(self, octets: bytes) -> None:
        """From the host to the board, at the host's baud, from this instant on."""
        if self._do("send", octets) != len(octets):
            raise UsageError(f"send: the host's transmitter has no room for {len(octets)} octets; run the board first")

    def expect(self, pattern: Pattern, within_s: float = 1.0) -> re.Match[bytes]:
        """Run until the board has sent octets that match: bytes as they are, or a compiled pattern of bytes.

        What was received before and not matched counts. Stops at the octet that completes the match.
        Raises ExpectError.
        """
        __tracebackhide__ = True
        return self._expect("uart", self._inbox, pattern, within_s, self.scenario.tables.link.baud)

    @property
    def received(self) -> list[Octet]:
        """What the host received, with its times; of what was matched, the last few thousand octets."""
        return list(self._inbox.octets)

    @property
    def unread(self) -> bytes:
        """What the host received and no expect() has matched yet."""
        return self._inbox.unread()

    # The board's own

    def pin(self, name: str) -> bool:
        """Level now of a port pin, named as in "P1.3"."""
        return self.pins[name]

    @property
    def motion(self) -> Motion:
        """The true motion of the sensors. Assign the keys of a [motion] table to change it from this instant on."""
        return self.scenario.tables.motion

    @motion.setter
    def motion(self, keys: Mapping[str, Any]) -> None:
        self._do("set_motion", dict(keys))

    @cached_property
    def symbols(self) -> cdb.Cdb:
        """Names and lines of the firmware: the .cdb that sdcc --debug writes beside the image."""
        path = self.scenario.firmware.with_suffix(".cdb")
        if not path.exists():
            raise UsageError(f"{path}: is missing, so there are no C names; build the firmware with sdcc --debug")
        return cdb.load(path)

    @property
    def variables(self) -> Variables:
        """C variables by name, as the code at pc sees them."""
        return Variables(self.symbols, self._run.read, self._do, lambda: self.pc)

    @property
    def reports(self) -> list[dict[str, Any]]:
        """What the firmware did wrong, and what the emulator does not model."""
        return list(self._run.reports())

    def where(self) -> str:
        """The place in the firmware, for a message."""
        pc = self.pc
        if not self.scenario.firmware.with_suffix(".cdb").exists():
            return f"pc {pc:#06x}"
        function, line = self.symbols.function_at(pc), self.symbols.line_at(pc)
        names = [f"in {function.name}()"] if function else []
        names += [f"{line.file}:{line.number}"] if line else []
        return " ".join([f"pc {pc:#06x}", *names])

    def describe(self) -> str:
        """Where the board is, what it has to say about the firmware, and the last lines that the host received."""
        tables = self.scenario.tables
        firmware = self.scenario.firmware.name
        lines = [f"{firmware} on {tables.part}, seed {tables.seed}, {seconds(self.now_ps)}, {self.where()}"]
        lines += [f"{r['kind']}: {report_line(r)}" for r in self.reports]
        octets = self._inbox.octets
        lines += [f"received, {len(octets)} octets kept:", *shown(octets, tables.link.baud)]
        return "\n".join(lines)

    def states(self) -> run.Array:
        """With the navigator, its new states; columns as in libins._run.STATE_COLUMNS."""
        states: run.Array = self._run.take_states()[0]
        return states

    def edges(self) -> run.Array:
        """With trace=True, the new edges: instant [ps], index in libins._run.WIRES, level."""
        edges: run.Array = self._run.take_edges()
        return edges

    def reset(self, power_on: bool = False) -> None:
        """Pulse the RST pin; or the supply, which also clears RAM."""
        self._do("reset", power_on)

    @contextlib.contextmanager
    def record(self, **wanted: Any) -> Iterator[dict[str, Any]]:
        """Write down what happens inside the with statement: vcd=, itrace=, lcov= a file, profile=True.

        The board needs trace=True. Gives a dict that holds the profile and the totals of the coverage in the end.
        """
        if not self._trace:
            raise UsageError("record: the edges of the wires are needed; make the board with trace=True")
        watch = Observation(self.scenario, Wanted(**wanted))
        observed: dict[str, Any] = {}
        try:
            watch.begin(self._run)
            self._watch = watch
            yield observed
            observed.update(watch.end(self._run))
        finally:
            self._watch = None
            watch.close()

    # Snapshots

    def snapshot(self) -> Snapshot:
        """The whole board at this instant."""
        received = tuple(self._inbox.octets)
        state = self._run.save()
        return Snapshot(
            self.scenario, self._navigator, self.now_ps, state, received, self._inbox.read, dict(self.volts.held)
        )

    def restore(self, snap: Snapshot) -> None:
        """Go on from there: a board of the same configuration and image. Raises UsageError."""
        same = replace(snap.scenario, tables=replace(snap.scenario.tables, motion=self.motion), csv=self.scenario.csv)
        if (same.tables, same.image, snap.navigator) != (self.scenario.tables, self.scenario.image, self._navigator):
            raise UsageError("restore: the snapshot is of a board with another configuration or image")
        try:
            self._run.restore(snap.state)
        except ValueError as error:
            raise UsageError(f"restore: {error}") from error
        self._run.set_motion(run.motion_of(snap.scenario), keep=True)
        self.scenario = snap.scenario
        self._inbox.octets, self._inbox.read = list(snap.received), snap.read
        self.volts.held = dict(snap.volts)
        self._past = []
        self._keep()

    @classmethod
    def from_snapshot(cls, snap: Snapshot | str | Path, trace: bool = False) -> "Board":
        """A board of the snapshot's configuration at its instant; from an object, or from a file."""
        snap = snap if isinstance(snap, Snapshot) else snapshot.read(Path(snap))
        board = cls(snap.scenario, navigator=snap.navigator, trace=trace)
        board.restore(snap)
        return board

    # What came before, for a report of a failure

    def keep(self, seconds: float) -> None:
        """From now on, remember enough to repeat at least the last so many seconds; 0: remember nothing."""
        self._keep_ps = round(seconds * PS_PER_S)
        self._past = []
        self._keep()

    def _next_keep_ps(self) -> int:
        return self._past[-1][0].now_ps + self._keep_ps if self._past else 2**63 - 1

    def _keep(self) -> None:
        if self._keep_ps:
            self._past = [*self._past[-1:], (self.snapshot(), [])]

    def past(self) -> tuple[Snapshot, list[Input]]:
        """A snapshot before now, and what the outside did since; see keep()."""
        if not self._past:
            raise UsageError("past: nothing was remembered; call keep() first")
        return self._past[0][0], [each for _, inputs in self._past for each in inputs]

    def _do(self, what: str, *arguments: Any) -> Any:
        """Every change from outside passes here."""
        note = Input(self.now_ps, what, arguments)
        if what == "set_motion":
            document = Document(Path("Board.motion"), {**self.scenario.table, "motion": arguments[0]})
            self.scenario = replace(scenario.read(document, self.scenario.firmware), path=self.scenario.path)
            arguments = (run.motion_of(self.scenario),)
        elif what == "add_fault":
            tables = self.scenario.tables
            target = faults.acquisition(RAM_OCTETS[tables.part])
            fault = faults.parsed(arguments[0], self.now_s, lambda *_: target)
            arguments = (faults.built(fault, tables.seed, len(self._run.fault_hits()), self.now_s),)
        try:
            result = getattr(self._run, what)(*arguments)
        except ValueError as error:
            raise UsageError(f"Board: {error}") from error
        if what == "set_volts":
            self.volts.held[arguments[0]] = arguments[1]
        elif what == "clear_volts":
            del self.volts.held[arguments[0]]
        if self._past:
            self._past[-1][1].append(note)
        return result


def _image(firmware: str | Path) -> str:
    """Where it is from here, or the name of one that comes with the package."""
    path = Path(firmware)
    return str(path.absolute() if path.is_file() else path)
