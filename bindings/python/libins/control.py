"""A run under control, forwards: places and values by C name, breakpoints, steps. libins.debugger adds the way back."""

from array import array
from collections.abc import Callable
from typing import Any

from libins import _run, run, scenario, values
from libins.breakpoints import Breakpoint, Stop
from libins.cdb import ADDRESS_END, Cdb, Function, Line
from libins.errors import UsageError
from libins.places import Memory, Value
from libins.run import PS_PER_S
from libins.timeline import BUDGET, SPACING, Timeline
from libins.unwind import Frame, Unwinder
from libins.watch import Expression

SLICE_CYCLES = 1_000_000
"""Between two looks at whether the user wants to stop."""
SLEEP_CYCLES = 1_000_000
"""A step waits no longer for an instruction to be executed."""
SCANS_KEPT = 128
"""So that a snapshot late in a run is no larger than an early one."""
SEEN_SPACING, SEEN_BUDGET = 4 * SPACING, 48 << 20
"""Machine cycles between snapshots where a follower has work at each, and octets of them."""
SP = 0x81


class Control:
    """One run under control. Raises UsageError for what cannot be."""

    def __init__(self, loaded: scenario.Scenario, table: Cdb | None, navigator: bool = True, seen: bool = False):
        """`table`: the program's names and lines. navigator: the scenario's plays the host.

        seen: every edge and sample is kept, for a follower of the timeline that takes them.
        """
        tables = loaded.tables
        self.scenario, self.table = loaded, table
        self.navigator = navigator and tables.nav is not None
        self.run: Any = run.build(
            loaded, tables.seed, not self.navigator, trace=seen, listen=True, seen=seen, scans_kept=SCANS_KEPT
        )
        self.end_ps = round(tables.stop_s * PS_PER_S)
        spacing, budget = (SEEN_SPACING, SEEN_BUDGET) if seen else (SPACING, BUDGET)
        self.timeline = Timeline(self.run, tables.clock_hz, spacing, budget)
        self.memory = Memory(self.run, self._write)
        self.breakpoints: dict[int, Breakpoint] = {}
        self.wants_to_stop: Callable[[], bool] = lambda: False
        """Asked between slices of a run."""
        self.slice_cycles = SLICE_CYCLES
        self._number = 0
        self._set: set[int] = set()
        self._resumed_ps = 0
        if table is not None:
            self.run.watcher.set_lines(_lines(table))

    # Where

    @property
    def pc(self) -> int:
        """Address of the next instruction."""
        return int(self.run.pc)

    def line(self, pc: int | None = None) -> Line | None:
        """The C line of an address, or of pc."""
        return self.table.line_at(self.pc if pc is None else pc) if self.table is not None else None

    def where(self, pc: int | None = None) -> str:
        """An address, or pc, for people: 0x0123 in tick () at acq.c:90."""
        pc = self.pc if pc is None else pc
        function = self.table.function_at(pc) if self.table is not None else None
        line = self.line(pc)
        at = f" at {line.file}:{line.number}" if line else ""
        return f"{pc:#06x}" + (f" in {function.name} ()" if function else "") + at

    def frames(self) -> list[Frame]:
        """Who called whom, the innermost first."""
        unwinder = Unwinder(self._octet("code"), self._octet("iram"), self.table)
        return unwinder.frames(self.pc, self._octet("sfr")(SP))

    def locate(self, text: str) -> tuple[int, ...]:
        """Addresses of a place: *0x123, function (its first statement), file.c:90, or 90 in the file of pc."""
        text = text.strip()
        if text.startswith("*"):
            return (int(self.expression(text[1:]).number(self.memory)) & 0xFFFF,)
        if self.table is None:
            raise UsageError(f"{text}: without a .cdb beside the image, only addresses are known: *0x0123")
        file, colon, number = text.rpartition(":")
        if number.isdigit():
            here = self.line()
            name = file if colon else here.file if here else self.table.files()[0]
            return self.line_addresses(name, int(number))
        if colon:
            raise UsageError(f"{text}: file.c:90, function or *0x0123 is needed")
        return (_body(self.table, self.table.function(text)),)

    def line_addresses(self, file: str, number: int) -> tuple[int, ...]:
        """Where a line's code begins; of a line without code, the next one's. Of several in one function, the first."""
        assert self.table is not None
        if file not in self.table.files():
            raise UsageError(f"{file}: no code is from this file; there are {', '.join(self.table.files())}")
        after = sorted({line.number for line in self.table.c_lines if line.file == file and line.number >= number})
        if not after:
            raise UsageError(f"{file}:{number}: there is no code from here to the end of the file")
        firsts: dict[str, int] = {}
        for address in self.table.addresses(file, after[0]):
            function = self.table.function_at(address)
            firsts.setdefault(function.name if function else "", address)
        return tuple(firsts.values())

    # Values

    def expression(self, text: str, pc: int | None = None) -> Expression:
        """Bind names as the code at pc sees them."""
        return Expression(text, self.table, self.pc if pc is None else pc)

    def print_value(self, text: str, form: str = "") -> str:
        """A value in one line."""
        return values.text(self.expression(text).value(self.memory), self.memory, self.table, form)

    def assign(self, text: str, value: str) -> None:
        """Poke a variable, register or place."""
        if text.strip() == "$pc":
            pc = int(self.expression(value).number(self.memory)) & 0xFFFF
            self.do(lambda r: r.set_pc(pc))
            return
        target: Value = self.expression(text).value(self.memory)
        self.memory.put(target, self.expression(value).number(self.memory))

    def do(self, change: Callable[[Any], object]) -> Any:
        """Something from outside, now: done again when the run is taken back and goes on."""
        return self.timeline.do(change)

    # Breakpoints

    def add_code(self, text: str, temporary: bool = False, condition: str = "") -> Breakpoint:
        """At an instruction, line or function."""
        addresses = self.locate(text)
        return self._add("code", text, condition, addresses[0], addresses=addresses, temporary=temporary)

    def add_watch(self, text: str, kind: str = "change", condition: str = "") -> Breakpoint:
        """A change of an expression's value; or read, write, access of an lvalue."""
        expression = self.expression(text)
        spans: tuple[tuple[str, int, int], ...] = ()
        if kind == "change":
            self.memory.touched.clear()
            values.text(expression.value(self.memory), self.memory, self.table)
            if not self.memory.touched:
                raise UsageError(f"{text}: a constant never changes")
        else:
            value = expression.value(self.memory)
            if value.place is None:
                raise UsageError(f"{text}: only a place in memory can be watched for being read or written")
            place = value.place
            spans = tuple((space, at, 1) for space, at in place.registers)
            spans = spans or ((place.space, place.address, max(1, value.type.size)),)
        return self._add(kind, text, condition, self.pc, expression=expression, spans=spans)

    def add_place(self, kind: str, text: str, span: tuple[str, int, int], condition: str = "") -> Breakpoint:
        """A read, write or access of a number of octets from an address of a memory."""
        return self._add(kind, text, condition, self.pc, spans=(span,))

    def add_addresses(self, text: str, addresses: tuple[int, ...], condition: str = "") -> Breakpoint:
        """At instructions."""
        return self._add("code", text, condition, addresses[0], addresses=addresses)

    def add_edge(self, wire: str, rising: bool = True, falling: bool = True, condition: str = "") -> Breakpoint:
        """An edge on a wire of the board."""
        name = wire.upper()
        if self.run.level(name) is None:
            raise UsageError(f"{wire}: no wire of this board; P0.0 to P3.7 and {', '.join(_run.WIRES)} are")
        return self._add("edge", name, condition, None, wire=name, rising=rising, falling=falling)

    def add_octet(self, octet: int | None = None, condition: str = "") -> Breakpoint:
        """An octet that the board sent; None: any."""
        return self._add("octet", "any octet" if octet is None else f"octet {octet:#04x}", condition, None, octet=octet)

    def add_time(self, at_s: float) -> Breakpoint:
        """An instant [s]."""
        return self._add("time", f"{at_s:g} s", "", None, at_ps=round(at_s * PS_PER_S), temporary=True)

    def _add(self, kind: str, text: str, condition: str, scope: int | None, **members: Any) -> Breakpoint:
        bound = self.expression(condition, scope) if condition else None
        self._number += 1
        added = Breakpoint(self._number, kind, text.strip(), condition=bound, **members)
        self.breakpoints[added.number] = added
        return added

    def delete(self, number: int) -> None:
        """Take a breakpoint away."""
        if number not in self.breakpoints:
            raise UsageError(f"{number}: no such breakpoint")
        del self.breakpoints[number]

    # Forwards

    def resume(self, limit_ps: int | None = None) -> Stop:
        """Run until something stops it."""
        return self._go("none", 0, limit_ps)

    def step_instruction(self, count: int = 1) -> Stop:
        """So many instructions; into calls and interrupts."""
        return self._go("instructions", count, asleep=True)

    def step(self, over: bool = False) -> Stop:
        """To another C line; over: no deeper than here. Interrupts are passed over."""
        if self.line() is None and not over:
            return self.step_instruction()
        return self._go("over" if over else "line", 0)

    def finish(self) -> Stop:
        """Until the function or interrupt that runs now has returned."""
        return self._go("out", 0)

    def run_to(self, text: str) -> Stop:
        """Until a place is reached, or another breakpoint."""
        temporary = self.add_code(text, temporary=True)
        try:
            return self.resume()
        finally:
            self.breakpoints.pop(temporary.number, None)

    def _go(self, goal: str, n: int, limit_ps: int | None = None, asleep: bool = False) -> Stop:
        self._resumed_ps = int(self.run.now_ps)
        sleep_ps = self._resumed_ps + self.timeline.ps(SLEEP_CYCLES) * n if asleep else self.end_ps
        limit = min(self.end_ps if limit_ps is None else limit_ps, max(self.end_ps, self._resumed_ps), sleep_ps)
        was_halted = bool(self.run.halted)
        self._arm()
        self.run.watcher.begin(goal, n)
        try:
            while True:
                stop = self._slice(limit)
                if stop is not None:
                    return stop
                if self.run.halted and not was_halted:
                    return Stop("halted", ["a jump to itself with interrupts off: nothing more will happen"])
                if self.run.now_ps >= limit:
                    return Stop("asleep" if limit == sleep_ps < self.end_ps else "end" if limit_ps is None else "limit")
                if self.wants_to_stop():
                    return Stop("interrupted")
        finally:
            self.run.watcher.begin("none", 0)
            self._disarm()

    def _slice(self, limit_ps: int) -> Stop | None:
        now = int(self.run.now_ps)
        self.timeline.trim()
        armed = [each for each in self.breakpoints.values() if each.enabled]
        times = [each.at_ps for each in armed if each.kind == "time" and each.at_ps > now]
        seen = len(self.timeline.received)
        goal = min([limit_ps, now + self.timeline.ps(self.slice_cycles), *times])
        reached = self.timeline.advance(goal, any(each.kind == "octet" for each in armed))
        events = self._events(reached, now, seen)
        stopping = [(each, note) for each, note in events if self._counts(each)]
        for each, _ in stopping:
            if each.temporary:
                self.breakpoints.pop(each.number, None)
        if stopping:
            return Stop("breakpoint", [note for _, note in stopping], [each.number for each, _ in stopping])
        return Stop("step") if self.run.watcher.reached else None

    def _events(self, reached: bool, before_ps: int, seen: int) -> list[tuple[Breakpoint, str]]:
        """Breakpoints that are met here, whose conditions hold."""
        now = int(self.run.now_ps)
        found: dict[int, str] = {}
        for number, written, address, value, _ in self.run.watcher.take_hits():
            each = self.breakpoints[number]
            if each.kind == "change":
                old, each.was = each.was, each.look(self.memory)
                if old != each.was:
                    found[number] = f"{each.text}\n\nOld value = {_shown(old)}\nNew value = {_shown(each.was)}"
            elif each.kind == "edge":
                found[number] = f"{each.text} {'rose' if value else 'fell'}"
            else:
                found[number] = f"{each.text} was {'written' if written else 'read'}: {value:#04x} at {address:#06x}"
        for each in self.breakpoints.values():
            if not each.enabled:
                continue
            if each.kind == "code" and not reached and self.pc in each.addresses and now != self._resumed_ps:
                found[each.number] = self.where()
            elif each.kind == "time" and before_ps < each.at_ps <= now:
                found[each.number] = each.text
            elif each.kind == "octet":
                octets = [o for o in self.timeline.received[seen:] if each.octet in (None, o[1])]
                if octets:
                    found[each.number] = f"the host received {octets[0][1]:#04x}"
        return [(self.breakpoints[n], note) for n, note in sorted(found.items()) if self._holds(self.breakpoints[n])]

    def _holds(self, each: Breakpoint) -> bool:
        return each.condition is None or bool(each.condition.number(self.memory))

    def _counts(self, each: Breakpoint) -> bool:
        each.hits += 1
        if each.ignore:
            each.ignore -= 1
            return False
        return True

    def rearm(self) -> None:
        """Breakpoints were changed between two slices of a run."""
        for address in self._set:
            self.run.set_break(address, False)
        self._arm()

    def _arm(self) -> None:
        watcher = self.run.watcher
        watcher.clear()
        for each in self.breakpoints.values():
            if each.enabled:
                each.prepare(self.memory, watcher)
        self._set = {address for each in self.breakpoints.values() if each.enabled for address in each.addresses}
        for address in self._set:
            self.run.set_break(address, True)
        watcher.arm(True)

    def _disarm(self) -> None:
        self.run.watcher.arm(False)
        for address in self._set:
            self.run.set_break(address, False)

    def _write(self, space: str, address: int, octets: bytes) -> None:
        self.do(lambda r: r.write(space, address, octets))

    def _octet(self, space: str) -> Callable[[int], int]:
        return lambda address: int(self.run.read(space, address & (0xFFFF if space == "code" else 0xFF), 1)[0])


def _shown(value: object) -> str:
    return value.hex(" ") if isinstance(value, bytes) else str(value)


def _body(table: Cdb, function: Function) -> int:
    """Where the first statement of a function begins: behind what SDCC puts on the line of its declaration."""
    if len(table.lines_at(function.begin)) > 1:
        return function.begin
    behind = [line.address for line in table.c_lines if function.begin < line.address < function.end]
    return min(behind, default=function.begin)


def _lines(table: Cdb) -> bytes:
    """For the watcher: of each address twice the number of its line, plus one where its code begins.

    A function begins, for steps, with its first statement.
    """
    numbers: dict[tuple[str, int], int] = {}
    begins = {line.address for line in table.c_lines}
    begins -= {f.begin for f in table.functions if _body(table, f) != f.begin}
    lines = array("I", bytes(4 * ADDRESS_END))
    for instruction in table.asm_lines:
        line = table.line_at(instruction.address)
        if line is not None:
            number = numbers.setdefault((line.file, line.number), len(numbers) + 1)
            lines[instruction.address] = 2 * number + (instruction.address in begins)
    return lines.tobytes()
