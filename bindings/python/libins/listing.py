"""Functions and lines of an image from SDCC's linked listings (.rst), which the linker writes with or without --debug.

    table = listing.load([Path("acq.rst"), Path("handshake_board.rst")])

So the very image that is shipped can be profiled and its coverage measured, although SDCC makes other code with
--debug. A listing has no types: the table has no symbols. `paths` of its C files are as the compiler was given them.
"""

import re
from dataclasses import replace
from pathlib import Path

from libins.cdb import Cdb, Function, Line
from libins.cdb_types import CdbError, parse_type

_INSTRUCTION = re.compile(
    r" {6}(?P<address>[0-9A-F]{6}) (?P<octets>(?:[0-9A-F]{2} )+) *\[ ?\d+\] *(?P<number>\d+) \t(?P<text>.*)$"
)
_C_LINE = re.compile(r" {32,} *\d+ ;\t(.+):(\d+): ")
_FUNCTION = re.compile(r" {32,} *\d+ ;\t function (\w+)$")
_AREA = re.compile(r" {32,} *\d+ \t\.area\s+(\w+)")
_JUMP = re.compile(r"ljmp\t_(\w+)$")
_RESULT = parse_type("{2}DF,SV:S")
"""Of every function: a listing does not say it."""
VECTORS = {8 * irq + 3: irq for irq in range(6)}


class _Reader:
    """One module's listing."""

    def __init__(self, table: Cdb, module: str) -> None:
        self.table = table
        self.module = module
        self.marks: list[tuple[str, int]] = []
        """C lines that begin at the next instruction."""
        self.name = ""
        self.begin = -1
        self.end = -1

    def line(self, text: str, handlers: dict[str, int]) -> None:
        """A line of it. Jumps at vectors are handlers."""
        if m := _INSTRUCTION.match(text):
            self._instruction(m, handlers)
        elif m := _C_LINE.match(text):
            path = Path(m[1])
            self.table.paths[path.name] = path
            self.marks.append((path.name, int(m[2])))
        elif m := _FUNCTION.match(text):
            self.function_ends()
            self.name = m[1]
        elif _AREA.match(text):
            self.function_ends()
            self.marks = []

    def _instruction(self, m: re.Match[str], handlers: dict[str, int]) -> None:
        address, octets, number = int(m["address"], 16), len(m["octets"].split()), int(m["number"])
        if address in VECTORS and (jump := _JUMP.match(m["text"])):
            handlers[jump[1]] = VECTORS[address]
        self.table.asm_lines.append(Line(address, self.module, number))
        self.table.c_lines += [Line(address, file, number) for file, number in self.marks]
        self.marks = []
        self.begin = address if self.name and self.begin < 0 else self.begin
        self.end = address + octets

    def function_ends(self) -> None:
        """At the next function, area or the end of the listing."""
        if self.name and self.begin >= 0:
            self.table.functions.append(Function(self.name, self.module, False, self.begin, self.end, None, 0, _RESULT))
        self.name, self.begin = "", -1


def beside(image: Path) -> list[Path]:
    """The listings of an image: NAME.rst, or NAME.MODULE.rst of each module."""
    return sorted({*image.parent.glob(f"{image.stem}.rst"), *image.parent.glob(f"{image.stem}.*.rst")})


def load(paths: list[Path]) -> Cdb:
    """The table of all modules. Raises CdbError, which names the file and the remedy."""
    table = Cdb(paths[0])
    handlers: dict[str, int] = {}
    for path in paths:
        try:
            text = path.read_text(encoding="utf-8")
        except OSError as error:
            raise CdbError(f"{path}: cannot be read: {error.strerror}; link the firmware again") from error
        except UnicodeDecodeError as error:
            raise CdbError(f"{path}: octet {error.start} is no text; give SDCC's linked listing, .rst") from error
        reader = _Reader(table, path.stem.rpartition(".")[2])
        table.modules.append(reader.module)
        for line in text.splitlines():
            reader.line(line, handlers)
        reader.function_ends()
        if not any(line.file == reader.module for line in table.asm_lines):
            raise CdbError(f"{path}: no instruction in it; give SDCC's linked listing, .rst")
    table.functions = sorted(
        (replace(f, interrupt=handlers.get(f.name)) for f in table.functions), key=lambda f: f.begin
    )
    table.c_lines.sort()
    table.asm_lines.sort()
    return table
