"""Debug information of SDCC: the .cdb file that `sdcc --debug` writes beside an image.

Format: "CDB File Format", SDCC 2003, and what SDCC 4.2 writes.

    table = cdb.load(Path("acq_default_debug.cdb"))
    table.function_at(0x0123).name        # "tick"
    table.line_at(0x0123)                 # Line(address=0x011f, file="acq.c", number=90)
    table.addresses("acq.c", 90)          # where the code of a line begins
    table.find("sampled").address         # 0x10, in Space.DATA

SDCC moves and joins code, so a line may begin at several addresses, and several lines at one. A local variable whose
record SDCC leaves out (most of those overlaid with others) has an address but no type. The address of a __bit variable
is only in the linked listing of its module (.rst); without it beside the .cdb, it is None.
"""

import re
from bisect import bisect_right
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from enum import StrEnum
from functools import cached_property
from pathlib import Path

from libins.cdb_types import CdbError, Member, Type, parse_members, parse_type

ADDRESS_END = 0x10000


class Space(StrEnum):
    """Where a symbol lives, by SDCC's letter."""

    XSTACK = "A"
    STACK = "B"
    CODE = "C"
    CONSTANT = "D"
    DATA = "E"
    XDATA = "F"
    IDATA = "G"
    BIT = "H"
    SFR = "I"
    SBIT = "J"
    PDATA = "P"
    REGISTER = "R"
    UNDEFINED = "Z"


@dataclass(frozen=True)
class Symbol:
    """A variable, or a name of code. `address` is None where the linker did not say it."""

    name: str
    module: str
    function: str | None
    """Of a local or static local variable."""
    static: bool
    block: str
    """SDCC's level and block, "1_0$3": tells apart equal names within a function."""
    type: Type | None
    space: Space
    address: int | None
    stack: int | None
    """Offset from the frame pointer, on the stack only."""
    registers: tuple[str, ...]


@dataclass(frozen=True)
class Function:
    """Code from `begin` up to `end`, exclusive. `interrupt` is its vector's number."""

    name: str
    module: str
    static: bool
    begin: int
    end: int
    interrupt: int | None
    bank: int
    type: Type


@dataclass(frozen=True, order=True)
class Line:
    """The code of source line `number` of `file` begins at `address`. Of an assembler line, `file` is the module."""

    address: int
    file: str
    number: int


@dataclass
class Cdb:
    """What a .cdb file says, sorted by address where it has one."""

    path: Path
    modules: list[str] = field(default_factory=list)
    functions: list[Function] = field(default_factory=list)
    symbols: list[Symbol] = field(default_factory=list)
    structs: dict[tuple[str, str], tuple[Member, ...]] = field(default_factory=dict)
    """By module and tag."""
    c_lines: list[Line] = field(default_factory=list)
    asm_lines: list[Line] = field(default_factory=list)
    """One for each instruction."""
    paths: dict[str, Path] = field(default_factory=dict)
    """Of the C files, by name, where they are known."""

    @cached_property
    def _starts(self) -> tuple[list[int], list[int], list[int]]:
        return (
            [f.begin for f in self.functions],
            [line.address for line in self.c_lines],
            [line.address for line in self.asm_lines],
        )

    def function_at(self, address: int) -> Function | None:
        """The function whose code is at the address; None in start-up, constants and libraries."""
        i = bisect_right(self._starts[0], address) - 1
        return self.functions[i] if i >= 0 and address < self.functions[i].end else None

    def asm_line_at(self, address: int) -> Line | None:
        """The assembler line of the instruction that begins exactly there."""
        i = bisect_right(self._starts[2], address) - 1
        return self.asm_lines[i] if i >= 0 and self.asm_lines[i].address == address else None

    def lines_at(self, address: int) -> list[Line]:
        """The C lines that begin at the nearest place before an instruction; the last of them made the code."""
        i = bisect_right(self._starts[1], address) - 1
        if i < 0 or not self._same_code(self.c_lines[i].address, address):
            return []
        first = i
        while first > 0 and self.c_lines[first - 1].address == self.c_lines[i].address:
            first -= 1
        return self.c_lines[first : i + 1]

    def line_at(self, address: int) -> Line | None:
        """The C line an instruction belongs to, or None."""
        lines = self.lines_at(address)
        return lines[-1] if lines else None

    def addresses(self, file: str, number: int) -> list[int]:
        """Where the code of a C line begins; empty when it made none."""
        return [line.address for line in self.c_lines if line.file == file and line.number == number]

    def files(self) -> list[str]:
        """Names of the C files with code."""
        return sorted({line.file for line in self.c_lines})

    def function(self, name: str) -> Function:
        """By name. Raises CdbError."""
        for function in self.functions:
            if function.name == name:
                return function
        raise CdbError(f"{self.path}: has no function {name}; it has {', '.join(f.name for f in self.functions)}")

    def find(self, name: str, address: int | None = None) -> Symbol:
        """A variable by its C name as the code at `address` sees it: locals first, then the module's, then global ones.

        Raises CdbError.
        """
        inside = self.function_at(address) if address is not None else None
        named = [s for s in self.symbols if s.name == name]
        local = [s for s in named if inside and s.function == inside.name and s.module == inside.module]
        own = [s for s in named if inside and s.function is None and s.module == inside.module]
        visible = [s for s in named if s.function is None]
        for candidates in (local, own, visible):
            if candidates:
                return candidates[-1]
        raise CdbError(f"{self.path}: has no variable {name}{f' in {inside.name}()' if inside else ''}")

    def locals(self, function: Function) -> list[Symbol]:
        """Parameters and local variables of a function."""
        return [s for s in self.symbols if s.function == function.name and s.module == function.module]

    def members(self, module: str, kind: Type) -> tuple[Member, ...]:
        """Members of a struct or union type as a module declares it. Raises CdbError."""
        if (module, kind.tag) not in self.structs:
            raise CdbError(f"{self.path}: module {module} declares no struct or union {kind.tag}")
        return self.structs[module, kind.tag]

    def correct_lines(self, code: Callable[[int], int]) -> None:
        """With the code memory of the image: a line that begins with JC, JNC, JZ or JNZ begins behind it.

        SDCC's peephole optimiser moves such a jump behind the mark of the following line, although no C statement
        begins by jumping on what another one has left in A or CY.
        """
        moved = []
        for i, line in enumerate(self.c_lines):
            last = i + 1 == len(self.c_lines) or self.c_lines[i + 1].address != line.address
            inside = self.function_at(line.address)
            if last and inside and inside.begin < line.address and code(line.address) in _JUMPS_ON_STATE:
                line = replace(line, address=line.address + 2)
            moved.append(line)
        self.c_lines = sorted(moved)
        self.__dict__.pop("_starts", None)

    def _same_code(self, a: int, b: int) -> bool:
        """Whether two addresses lie in one function, or outside of all in one module's start-up code."""
        functions = self.function_at(a), self.function_at(b)
        if functions != (None, None):
            return functions[0] is functions[1]
        lines = self.asm_line_at(a), self.asm_line_at(b)
        return lines[0] is not None and lines[1] is not None and lines[0].file == lines[1].file


_JUMPS_ON_STATE = (0x40, 0x50, 0x60, 0x70)
_NAME = r"(?P<scope>G|F[^$]*|L[^$]*)\$(?P<name>[^$]+)\$(?P<block>[^$]+\$[^:({]+)"
_SYMBOL = re.compile(
    _NAME + r"\((?P<type>\{\d{1,6}\}[^()]*)\),(?P<space>[A-JPRZ]),[01],(?P<stack>-?\d{1,6})(?P<rest>.*)$"
)
_FUNCTION_REST = re.compile(r",(?P<interrupt>[01]),(?P<vector>\d{1,3}),(?P<bank>\d)$")
_REGISTERS = re.compile(r",\[(?P<names>[a-z0-9,]*)\]$")
_TYPE = re.compile(r"F(?P<module>[^$]*)\$(?P<tag>[^\[]+)\[(?P<members>.*)\]$")
_LINKED = re.compile(r"(?P<end>X?)" + _NAME + r":(?P<address>[0-9A-Fa-f]{1,8})$")
_C_LINE = re.compile(r"C\$(?P<file>.+)\$(?P<number>\d{1,7})\$[^$]+\$[^$:]+:(?P<address>[0-9A-Fa-f]{1,8})$")
_ASM_LINE = re.compile(r"A\$(?P<file>.+)\$(?P<number>\d{1,7}):(?P<address>[0-9A-Fa-f]{1,8})$")

_Key = tuple[str, str, str]
"""Scope, name, block: unique within a file, a global name counting as its own module's."""


class _Reader:
    """Collects the records, then joins what the compiler said with what the linker said."""

    def __init__(self, path: Path) -> None:
        self.table = Cdb(path)
        self.module = ""
        self.functions: dict[tuple[str, str], Function] = {}
        self.variables: dict[_Key, Symbol] = {}
        self.linked: dict[_Key, int] = {}
        self.begins: dict[tuple[str, str], int] = {}
        self.ends: dict[tuple[str, str], int] = {}

    def record(self, text: str) -> None:
        """One line of the file. Raises CdbError."""
        kind, colon, body = text.partition(":")
        if not colon or kind not in ("M", "F", "S", "T", "L"):
            raise CdbError(f"{text[:40]!r} is no record of a .cdb file (M:, F:, S:, T: or L:)")
        if kind == "M":
            self.module = body
            self.table.modules.append(body)
        elif kind == "T":
            m = _matched(_TYPE, body, "type")
            self.table.structs[m["module"], m["tag"]] = parse_members(m["members"])
        elif kind == "L":
            self._link(body)
        elif kind == "F":
            self._function(_matched(_SYMBOL, body, "function"))
        else:
            self._symbol(_matched(_SYMBOL, body, "symbol"))

    def _function(self, m: re.Match[str]) -> None:
        rest = _matched(_FUNCTION_REST, m["rest"], "end of a function record")
        vector = int(rest["vector"]) if rest["interrupt"] == "1" else None
        static, kind = m["scope"] != "G", parse_type(m["type"])
        self.functions[m["scope"], m["name"]] = Function(
            m["name"], self.module, static, 0, 0, vector, int(rest["bank"]), kind
        )

    def _symbol(self, m: re.Match[str]) -> None:
        names = _matched(_REGISTERS, m["rest"], "register list")["names"] if m["rest"] else ""
        space = Space(m["space"])
        self.variables[m["scope"], m["name"], m["block"]] = Symbol(
            name=m["name"],
            module=self.module,
            function=m["scope"].partition(".")[2] if m["scope"][0] == "L" else None,
            static=m["scope"] != "G",
            block=m["block"],
            type=parse_type(m["type"]),
            space=space,
            address=None,
            stack=int(m["stack"]) if space in (Space.STACK, Space.XSTACK) else None,
            registers=tuple(filter(None, names.split(","))),
        )

    def _link(self, body: str) -> None:
        for pattern, lines in ((_C_LINE, self.table.c_lines), (_ASM_LINE, self.table.asm_lines)):
            if m := pattern.match(body):
                lines.append(Line(_address(m), m["file"], int(m["number"])))
                return
        m = _matched(_LINKED, body, "linker record")
        if m["block"] == "0$0":
            (self.ends if m["end"] else self.begins)[m["scope"], m["name"]] = _address(m)
        else:
            self.linked[m["scope"], m["name"], m["block"]] = _address(m)

    def finish(self) -> Cdb:
        """The table, sorted. Raises CdbError."""
        table = self.table
        table.c_lines.sort()
        table.asm_lines.sort()
        table.functions = sorted(self._functions(), key=lambda f: f.begin)
        called = set(self.begins) | set(self.functions)
        table.symbols = [s for key, s in self._symbols() if key[:2] not in called]
        return table

    def _functions(self) -> Iterator[Function]:
        begins = set(self.begins.values())
        module_of = {line.address: line.file for line in self.table.asm_lines}
        for key, function in self.functions.items():
            if key not in self.begins or key not in self.ends:
                continue  # removed by the linker, or a prototype
            begin, end = self.begins[key], self.ends[key]
            # At the last instruction, a RET or RETI of one octet; after a __naked function, behind its code.
            end += module_of.get(end) == function.module and end not in begins - {begin}
            if end <= begin:
                raise CdbError(f"function {function.name} ends at {end:#06x}, before it begins at {begin:#06x}")
            yield replace(function, begin=begin, end=end)

    def _symbols(self) -> Iterator[tuple[_Key, Symbol]]:
        for key, symbol in self.variables.items():
            yield key, replace(symbol, address=self.linked.get(key))
        for (scope, name, block), address in self.linked.items():
            if (scope, name, block) not in self.variables:
                module, _, function = scope[1:].partition(".")
                local = function if scope[0] == "L" else None
                static = scope != "G"
                yield (
                    (scope, name, block),
                    Symbol(name, module, local, static, block, None, Space.UNDEFINED, address, None, ()),
                )


def _matched(pattern: re.Pattern[str], text: str, what: str) -> re.Match[str]:
    if m := pattern.match(text):
        return m
    raise CdbError(f"not a whole {what}: {text[:60]!r}")


def _address(m: re.Match[str]) -> int:
    address = int(m["address"], 16)
    if address >= ADDRESS_END:
        raise CdbError(f"address {address:#x} lies beyond 64 KB")
    return address


def _with_bit(symbol: Symbol, path: Path) -> Symbol:
    """A global or static __bit variable with its address, from the listing of its module."""
    if symbol.space is not Space.BIT or symbol.address is not None or symbol.function is not None:
        return symbol
    for listing in (path.with_name(f"{path.stem}.{symbol.module}.rst"), path.with_name(f"{symbol.module}.rst")):
        if listing.exists():
            label = re.search(
                rf"^ {{6}}([0-9A-F]{{6}}) +\d+ _{re.escape(symbol.name)}::?$",
                listing.read_text(encoding="utf-8", errors="replace"),
                re.MULTILINE,
            )
            return replace(symbol, address=int(label[1], 16)) if label else symbol
    return symbol


def load(path: Path) -> Cdb:
    """Read a .cdb file. Raises CdbError, which names the file, the line and the remedy."""
    try:
        text = path.read_text(encoding="ascii")
    except OSError as error:
        raise CdbError(f"{path}: cannot be read: {error.strerror}; build the firmware with sdcc --debug") from error
    except UnicodeDecodeError as error:
        raise CdbError(
            f"{path}: octet {error.start} is not ASCII: not a .cdb file; give the one beside the image"
        ) from error
    reader = _Reader(path)
    for number, line in enumerate(text.splitlines(), 1):
        try:
            if line:
                reader.record(line)
        except CdbError as error:
            raise CdbError(f"{path}:{number}: {error}; build the firmware again with sdcc --debug") from error
    try:
        table = reader.finish()
        table.symbols = [_with_bit(symbol, path) for symbol in table.symbols]
    except CdbError as error:
        raise CdbError(f"{path}: {error}; build the firmware again with sdcc --debug") from error
    if not table.functions:
        raise CdbError(f"{path}: no function has an address; link the image with sdcc --debug too")
    return table
