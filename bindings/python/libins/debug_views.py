"""What a debugger shows of a board: registers, disassembly, source, memory, pins."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from libins import _run, disasm, values
from libins.cdb_types import Kind, Type
from libins.control import Control
from libins.disasm import Instruction
from libins.errors import UsageError
from libins.places import MEMORIES, ExpressionError, Value, bank, located

PORTS = 4
UNITS = {"b": 1, "h": 2, "w": 4}
COUNT_MAX = 0x10000
_EXAMINE = re.compile(r"(?P<count>\d*)(?P<letters>[xduotcsibhw]*)")
_POINTED = {"data": "iram", "idata": "iram", "pdata": "xdata"}
NAMES = ("a", "b", "psw", "sp", "dptr", "r0", "r1", "r2", "r3", "r4", "r5", "r6", "r7")


def registers(d: Control) -> list[tuple[str, str]]:
    """Names and values, pc first."""
    shown = [("pc", f"{d.pc:#06x}")]
    for name in NAMES:
        value = d.expression("$" + name).value(d.memory)
        shown.append((name, f"{d.memory.number(value):#0{2 + 2 * value.type.size}x}"))
    psw = int(d.expression("$psw").number(d.memory))
    flags = "".join(letter if psw >> bit & 1 else "-" for letter, bit in (("C", 7), ("A", 6), ("O", 2), ("P", 0)))
    return [*shown, ("bank", f"{bank(d.memory) >> 3} {flags}"), ("cycle", str(d.run.cycle)), ("time", time(d))]


def time(d: Control) -> str:
    """Simulated time now."""
    return f"{d.run.now_ps * 1e-12:.9f} s"


def sfrs(d: Control) -> list[tuple[str, int]]:
    """Every special function register; of ports, the latch."""
    return [(name, d.run.read("sfr", address, 1)[0]) for name, address in disasm.SFR.items()]


def variables(d: Control, local: bool) -> list[tuple[str, Value | str]]:
    """The function's that runs, or the program's; of one without a place, why."""
    if d.table is None:
        return []
    function = d.table.function_at(d.pc)
    if local:
        symbols = d.table.locals(function) if function is not None else []
    else:
        symbols = [s for s in d.table.symbols if s.function is None and s.space.name not in ("SFR", "SBIT")]
    shown: dict[str, Value | str] = {}
    for symbol in symbols:
        try:
            shown[symbol.name] = located(symbol, d.table, d.memory)
        except ExpressionError as error:
            shown[symbol.name] = str(error)
    return list(shown.items())


def value_text(d: Control, value: Value | str, form: str = "") -> str:
    """A variable, or why it has no value."""
    if isinstance(value, str):
        return f"<{value}>"
    try:
        return values.text(value, d.memory, d.table, form)
    except ExpressionError as error:
        return f"<{error}>"


def instructions(d: Control, address: int, count: int) -> list[Instruction]:
    """So many from an address on."""
    code = d.run.read("code", 0, COUNT_MAX)
    found = []
    for _ in range(count):
        found.append(disasm.decode(code.__getitem__, address))
        address = address + len(found[-1].octets) & 0xFFFF
    return found


def instructions_before(d: Control, address: int, count: int) -> list[Instruction]:
    """So many that end where an address begins, as far as the code can be read backwards."""
    function = d.table.function_at(address) if d.table is not None else None
    first = [function.begin] if function is not None and function.begin + count < address else []
    for start in (*first, *range(max(0, address - 3 * count - 8), address)):
        found = []
        at = start
        while at < address:
            found.append(instructions(d, at, 1)[0])
            at += len(found[-1].octets)
        if at == address and len(found) >= count:
            return found[-count:]
    return []


def disassembly(d: Control, address: int, end: int) -> Iterator[str]:
    """Lines of text; the next instruction is marked."""
    code = d.run.read("code", 0, COUNT_MAX)
    while address < end:
        each = disasm.decode(code.__getitem__, address)
        mark = "=>" if address == d.pc else "  "
        yield f"{mark} {address:#06x}  {each.octets.hex(' '):<9} {each.text}"
        address += len(each.octets)


@dataclass(frozen=True)
class Examined:
    """What `x` was asked for: how many, in which form, of how many octets each."""

    count: int
    form: str
    size: int


def examine_format(text: str) -> Examined:
    """From "8xb"; raises UsageError."""
    m = _EXAMINE.fullmatch(text)
    if m is None:
        raise UsageError(f"x/{text}: a count, one of x d u o t c s i, and b, h or w are possible")
    forms = [c for c in m["letters"] if c in "xduotcsi"]
    units = [c for c in m["letters"] if c in UNITS]
    count = int(m["count"] or 1)
    if len(forms) > 1 or len(units) > 1 or not 0 < count <= COUNT_MAX:
        raise UsageError(f"x/{text}: one form, one unit and a count of 1 to {COUNT_MAX} are possible")
    return Examined(count, (forms or ["x"])[0], UNITS[(units or ["b"])[0]])


def examine(d: Control, how: Examined, text: str) -> Iterator[str]:
    """Memory, as gdb's x shows it; the address is iram:0x30, an lvalue, or a pointer."""
    value = d.expression(text).value(d.memory)
    space, address = address_of(d, value, "code" if how.form == "i" else "")
    if how.form == "i":
        for each in instructions(d, address, how.count):
            mark = "=>" if each.address == d.pc else "  "
            yield f"{mark} {each.address:#06x}  {each.octets.hex(' '):<9} {each.text}"
        return
    if how.form == "s":
        yield f"{space}:{address:#06x}\t{values.string(d.run.read(space, address, how.count))}"
        return
    octets = d.run.read(space, address, how.count * how.size)
    kind = Type(Kind.INTEGER, how.size)
    row = 16 // how.size
    for at in range(0, how.count, row):
        shown = []
        for i in range(at, min(at + row, how.count)):
            number = int.from_bytes(octets[i * how.size : (i + 1) * how.size], "little")
            shown.append(
                f"{number:#0{2 + 2 * how.size}x}" if how.form == "x" else values.number_text(number, kind, how.form)
            )
        yield f"{space}:{address + at * how.size:#06x}\t" + "\t".join(shown)


def address_of(d: Control, value: Value, default: str) -> tuple[str, int]:
    """Memory and address that a pointer points to, or where an lvalue is. Raises UsageError."""
    if value.place is not None and value.place.space in MEMORIES and value.type.kind is not Kind.POINTER:
        return value.place.space, value.place.address
    space = _POINTED.get(value.type.space, value.type.space) or default
    if space not in MEMORIES:
        raise UsageError("in which memory? Write iram:0x30, sfr:0x90, xdata:0x100 or code:0x200")
    return space, int(d.memory.number(value)) & 0xFFFF


@cache
def source_lines(path: Path) -> list[str]:
    """Of a source file."""
    return path.read_text(encoding="utf-8", errors="replace").splitlines()


class Sources:
    """Finds the C files of a program: beside the image, in the folder above it, here, and where the user says."""

    def __init__(self, d: Control, folders: list[Path]) -> None:
        """`folders`: those of the user, looked at first."""
        image = d.scenario.firmware.absolute().parent
        self.folders = [*folders, image, image.parent, Path.cwd()]

    def find(self, file: str) -> Path | None:
        """By the name the .cdb knows it by."""
        places = [Path(file), *(folder / name for folder in self.folders for name in (file, Path(file).name))]
        return next((place for place in places if place.is_file()), None)

    def text(self, file: str, first: int, last: int) -> list[tuple[int, str]]:
        """Numbers and lines, as many of them as there are."""
        path = self.find(file)
        if path is None:
            return []
        lines = source_lines(path)
        return [(n, lines[n - 1]) for n in range(max(1, first), min(last, len(lines)) + 1)]


def pins(d: Control) -> Iterator[str]:
    """Levels of every port pin, bit 7 first, and of the wires."""
    for port in range(PORTS):
        levels = "".join(str(int(d.run.pin(port, bit))) for bit in range(7, -1, -1))
        yield f"P{port}  {levels}"
    for wire in _run.WIRES:
        yield f"{wire:<10} {int(d.run.level(wire))}"


def received(d: Control, count: int) -> Iterator[str]:
    """The last octets that the host received."""
    for at_ps, octet, framing_ok in d.timeline.received[-count:]:
        error = "" if framing_ok else "  framing error"
        yield f"{at_ps * 1e-12:.9f} s  {octet:#04x} {values.string(bytes([octet]), chr(39))}{error}"
