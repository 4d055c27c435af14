"""What stops a run: an instruction, a change or access of memory, an edge on a wire, an octet of the line, a time."""

from dataclasses import dataclass, field
from typing import Any

from libins.places import Memory, Number
from libins.watch import Expression

ANY = None


@dataclass
class Breakpoint:
    """One, by the number the user sees."""

    number: int
    kind: str
    """code, change, read, write, access, edge, octet or time."""
    text: str
    """As asked for."""
    temporary: bool = False
    enabled: bool = True
    condition: Expression | None = None
    ignore: int = 0
    """To be passed so many times yet."""
    hits: int = 0
    addresses: tuple[int, ...] = ()
    """Of code."""
    expression: Expression | None = None
    """What is watched."""
    spans: tuple[tuple[str, int, int], ...] = ()
    """Memory, address and length of that; for a change, found anew each time the run goes on."""
    was: Number | bytes | None = None
    wire: str = ""
    rising: bool = True
    falling: bool = True
    octet: int | None = ANY
    at_ps: int = 0

    def look(self, memory: Memory) -> Number | bytes:
        """The watched value. Raises ExpressionError."""
        assert self.expression is not None
        value = self.expression.value(memory)
        aggregate = value.place is not None and value.type.kind.value in ("array", "struct")
        return memory.octets(value) if aggregate else memory.number(value)

    def prepare(self, memory: Memory, watcher: Any) -> None:
        """Tell the watcher what to look at."""
        if self.kind == "change":
            memory.touched.clear()
            self.was = self.look(memory)
            self.spans = tuple(memory.touched)
        if self.kind == "edge":
            watcher.edge(self.number, self.wire, self.rising, self.falling)
        for space, address, length in self.spans:
            watcher.watch(self.number, self.kind, space, address, length)


@dataclass
class Stop:
    """Why the run stands where it stands."""

    reason: str
    """breakpoint, step, end (of the scenario), start (of the history), halted, asleep, interrupted or limit."""
    notes: list[str] = field(default_factory=list)
    """For the user, one for each breakpoint."""
    numbers: list[int] = field(default_factory=list)
