"""Looking at stations on lines while they run: --vcd, --access-log and --report of `ins run`, put together."""

import contextlib
import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from libins import net_vcd
from libins.coverage import File
from libins.growing_file import GrowingFile
from libins.machine import Array
from libins.net_machine import NetMachine
from libins.registers import BEGAN, ENDED, KINDS, address_of, interrupt_name, name_of
from libins.views import Nets


@dataclass
class Wanted:
    """What to look at, and where to write it. None: not asked for."""

    vcd: Path | None = None
    registers: list[str] = field(default_factory=list)
    """In the VCD."""
    access_log: Path | None = None
    view_s: float | None = None
    """Instant around which the report's pictures are."""


class Observation:
    """Of one run: begin() at its begin, slice() after each piece of it, end() at its end, close() in any case."""

    def __init__(self, wanted: Wanted) -> None:
        """Raises UsageError for what cannot be looked at."""
        self._wanted = wanted
        self._registers = {address_of(name): name for name in wanted.registers}
        self._files: list[GrowingFile] = []
        self._dump: net_vcd.Dump | None = None
        self._log: GrowingFile | None = None
        self._recorder: Nets | None = None
        self.files: dict[str, File] = {}
        """Coverage of firmware that is compiled for this machine is its compiler's."""
        self._in_service: dict[str, list[str]] = {}
        """Interrupts of each F2812, nested."""

    def begin(self, run: NetMachine) -> None:
        """At the run's begin."""
        w = self._wanted
        self._in_service = {board: [] for board in run.boards}
        if w.vcd:
            registers = {board: self._registers for board in run.boards}
            self._dump = net_vcd.Dump(self._open(w.vcd).text, run.now_ps, run.traced, registers)
        if w.access_log:
            self._log = self._open(w.access_log)
        if w.view_s is not None:
            names = [f"{wire.station}.{wire.name}" for wire in run.traced]
            bauds = dict(zip(names, [wire.baud for wire in run.traced], strict=True))
            self._recorder = Nets(dict.fromkeys(names, (run.now_ps, True)), bauds, w.view_s)
        run.record(accesses=bool(w.access_log or self._registers), interrupts=bool(w.vcd or w.access_log))

    def _open(self, path: Path) -> GrowingFile:
        self._files.append(GrowingFile(path))
        return self._files[-1]

    def slice(self, run: NetMachine, edges: Array) -> None:
        """The edges of the traced wires since the last call."""
        if self._recorder:
            self._recorder.slice(edges, run.now_ps)
        for board in run.boards:
            records = run.take_records(board)
            if self._log:
                self._log.text.writelines(log_lines(board, records))
            if self._dump:
                self._dump_records(self._dump, board, records)
        if self._dump:
            self._dump.edges(edges, run.now_ps)
            self._dump.write(run.now_ps)

    def _dump_records(self, dump: net_vcd.Dump, board: str, records: Sequence[tuple[int, int, int, int]]) -> None:
        in_service = self._in_service[board]
        for at, what, address, value in records:
            if what == BEGAN:
                in_service.append(interrupt_name(address))
            elif what == ENDED and in_service:
                in_service.pop()
            else:
                dump.access(board, at, address, value)
                continue
            dump.interrupt(board, at, in_service[-1] if in_service else "")

    def end(self, run: NetMachine) -> dict[str, Any]:
        """Files get their names."""
        if self._dump:
            self._dump.close(run.now_ps)
        for file in self._files:
            file.done()
        return {}

    @property
    def view(self) -> Any:
        """What the report's pictures show, or None."""
        return self._recorder.view if self._recorder else None

    def close(self) -> None:
        """Take away what an interrupted run has left."""
        for file in self._files:
            with contextlib.suppress(OSError):
                file.drop()


def log_lines(board: str, records: Sequence[tuple[int, int, int, int]]) -> Iterator[str]:
    """JSON Lines of an access log."""
    for at, what, address, value in records:
        entry: dict[str, Any] = {"t_ps": at, "board": board, "what": KINDS[what]}
        if what in (BEGAN, ENDED):
            entry["interrupt"] = interrupt_name(address)
        else:
            entry |= {"register": name_of(address), "address": address, "value": value}
        yield json.dumps(entry) + "\n"
