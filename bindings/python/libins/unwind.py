"""Who called whom: the return addresses on an 8051's stack, told from data by what stands before them in the code.

A return address follows an LCALL or ACALL of the function that runs (or of one that jumped to it); that of an interrupt
is the place of any instruction. The frames of a function that SDCC knows are searched from the top of the stack for one
from which the whole rest can be explained; where nothing can, the search ends.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from libins import disasm
from libins.cdb import Cdb, Function

FRAMES_MAX = 64
STACK_MAX = 128
"""Octets looked at: the stack wraps at 256, and 128 is more than any frame."""
LCALL, ACALL, PUSH, POP, RETI = 0x12, 0x11, 0xC0, 0xD0, 0x32


@dataclass(frozen=True)
class Frame:
    """One call: where it stands, and the stack pointer as it was before the call that made the frame."""

    pc: int
    sp: int
    function: Function | None


class Unwinder:
    """Over a board's code and RAM, read by two functions."""

    def __init__(self, code: Callable[[int], int], ram: Callable[[int], int], table: Cdb | None) -> None:
        """`table` may be None: then only the innermost frame is known."""
        self._code, self._ram, self._table = code, ram, table

    def frames(self, pc: int, sp: int) -> list[Frame]:
        """The innermost first."""
        if self._table is None:
            return [Frame(pc, sp, None)]
        found = self._explain(pc, sp, FRAMES_MAX)
        return found[0]

    def _explain(self, pc: int, sp: int, left: int) -> tuple[list[Frame], bool]:
        """Frames from here on, and whether they end where a program begins."""
        function = self._table.function_at(pc) if self._table is not None else None
        here = [Frame(pc, sp, function)]
        if left == 0 or function is None:
            return here, False
        if function.name == "main" and function.interrupt is None:
            return here, True
        best = here
        places: Iterable[int] = range(sp, max(sp - STACK_MAX, 8), -1)
        if function.interrupt is not None:
            places = (sp - self._saved(function, pc), *places)
        for at in places:
            target = self._ram(at) << 8 | self._ram(at - 1)
            if self._returns_from(function, target):
                frames, whole = self._explain(target, at - 2, left - 1)
                if whole:
                    return here + frames, True
                best = max(best, here + frames, key=len)
        return best, False

    def _returns_from(self, function: Function, target: int) -> bool:
        """Whether a RET or RETI of the function may lead there."""
        assert self._table is not None
        if function.interrupt is not None:
            return self._table.asm_line_at(target) is not None and self._table.function_at(target) is not None
        called = self._called_before(target)
        if called is None:
            return False
        if called == function.begin:
            return True
        caller, other = self._table.function_at(target), self._table.function_at(called)
        if other is None or other.begin != called:
            return other is caller  # by pointer: LCALL to a PUSH, PUSH, RET of the caller's own
        return self._jumps(other, function)

    def _saved(self, function: Function, pc: int) -> int:
        """Registers that an interrupt has pushed and not popped yet."""
        at, left = pc, 0
        while self._code(at) == POP:
            at, left = at + 2, left + 1
        if self._code(at) == RETI:
            return left
        at, pushed = function.begin, 0
        while at < pc and self._code(at) == PUSH:
            at, pushed = at + 2, pushed + 1
        return pushed

    def _called_before(self, target: int) -> int | None:
        if self._code(target - 3 & 0xFFFF) == LCALL:
            return self._code(target - 2 & 0xFFFF) << 8 | self._code(target - 1 & 0xFFFF)
        opcode = self._code(target - 2 & 0xFFFF)
        if opcode & 0x1F == ACALL:
            return target & 0xF800 | (opcode & 0xE0) << 3 | self._code(target - 1 & 0xFFFF)
        return None

    def _jumps(self, function: Function, to: Function) -> bool:
        """Whether there is a LJMP from one function to the begin of another."""
        at = function.begin
        while at < function.end:
            opcode = self._code(at)
            if opcode == 0x02 and self._code(at + 1) << 8 | self._code(at + 2) == to.begin:
                return True
            at += disasm.OPCODES[opcode].length
        return False
