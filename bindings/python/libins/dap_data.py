"""What a Debug Adapter Protocol client looks at while the board stands: frames, variables, memory, instructions."""

import base64
import binascii
import re
from pathlib import Path
from typing import Any

from libins import debug_views, disasm, values
from libins.cdb_types import Kind
from libins.debugger import Debugger
from libins.errors import UsageError
from libins.places import MEMORIES, Value, pointed

THREAD = 1
MEMORY_MAX = 0x10000
INSTRUCTIONS_MAX = 4096
_REFERENCE = re.compile(r"(?:(?P<space>\w+):)?(?P<address>0[xX][0-9a-fA-F]{1,8}|\d{1,6})")
_CODE_REFERENCE = 0x10000
"""References to disassembly in the place of a source are this plus the function's begin."""

Json = dict[str, Any]
Rows = list[tuple[str, Value | str]]


def text(arguments: Json, name: str, default: str | None = None) -> str:
    """An argument that is a string. Raises UsageError."""
    value = arguments.get(name, default)
    if not isinstance(value, str):
        raise UsageError(f"argument {name!r}: found {value!r}, but a string is needed")
    return value


def whole(arguments: Json, name: str, default: int | None = None) -> int:
    """An argument that is a whole number. Raises UsageError."""
    value = arguments.get(name, default)
    if not isinstance(value, int) or isinstance(value, bool) or abs(value) > 2**53:
        raise UsageError(f"argument {name!r}: found {value!r}, but a whole number is needed")
    return value


def rows(arguments: Json, name: str) -> list[Json]:
    """An argument that is a list of objects; none is empty. Raises UsageError."""
    value = arguments.get(name)
    value = [] if value is None else value
    if not isinstance(value, list) or not all(isinstance(each, dict) for each in value):
        raise UsageError(f"argument {name!r}: a list of objects is needed")
    return value


def reference(word: str) -> tuple[str, int]:
    """Memory and address of "iram:0x30"; of "0x0123", code. Raises UsageError."""
    m = _REFERENCE.fullmatch(word)
    if m is None or (m["space"] or "code") not in MEMORIES:
        raise UsageError(f"{word!r}: no place; iram:0x30, sfr:0x90, xdata:0x100 or 0x0123 in code is needed")
    return m["space"] or "code", int(m["address"], 0 if m["address"][:2].lower() == "0x" else 10)


class Data:
    """Answers about a board that stands; what variables references mean is forgotten when it has moved."""

    def __init__(self, debugger: Debugger, sources: debug_views.Sources) -> None:
        """Of one session."""
        self.d = debugger
        self.sources = sources
        self._references: list[tuple[Rows, str]] = []
        """Variables, and the form of their numbers."""

    def moved(self) -> None:
        """The board has run."""
        self._references.clear()

    def stack_trace(self, arguments: Json) -> Json:
        """The request stackTrace."""
        frames = self.d.frames()
        first = max(0, whole(arguments, "startFrame", 0))
        count = whole(arguments, "levels", 0) or len(frames)
        shown = [self._frame(number, each.pc) for number, each in enumerate(frames)]
        return {"stackFrames": shown[first : first + max(0, count)], "totalFrames": len(frames)}

    def _frame(self, number: int, pc: int) -> Json:
        function = self.d.table.function_at(pc) if self.d.table else None
        name = function.name if function else f"{pc:#06x}"
        shown: Json = {"id": number, "name": name, "line": 0, "column": 0, "instructionPointerReference": f"{pc:#06x}"}
        line = self.d.line(pc)
        path = self.sources.find(line.file) if line else None
        if line is not None and path is not None:
            return {
                **shown,
                "source": {"name": line.file, "path": str(path.absolute())},
                "line": line.number,
                "column": 1,
            }
        if function is not None:
            source = {"name": f"disassembly of {name}", "sourceReference": _CODE_REFERENCE + function.begin}
            before = sum(1 for _ in debug_views.disassembly(self.d, function.begin, pc))
            return {**shown, "source": source, "line": before + 1, "column": 1}
        return shown

    def source(self, arguments: Json) -> Json:
        """The request source: a file, or disassembly where there is none."""
        given = arguments.get("source")
        inner: Json = given if isinstance(given, dict) else {}
        begin = (whole(inner, "sourceReference", 0) or whole(arguments, "sourceReference", 0)) - _CODE_REFERENCE
        function = self.d.table.function_at(begin) if self.d.table and 0 <= begin < MEMORY_MAX else None
        if function is not None:
            return {"content": "\n".join(debug_views.disassembly(self.d, function.begin, function.end)) + "\n"}
        name = text(inner, "path", inner.get("name", ""))
        path = self.sources.find(name) if name and self.d.table and Path(name).name in self.d.table.files() else None
        if path is None:
            raise UsageError(f"source {name!r}: not found, or not of this program")
        return {"content": "\n".join(debug_views.source_lines(path)) + "\n"}

    def scopes(self, arguments: Json) -> Json:
        """The request scopes."""
        whole(arguments, "frameId")
        registers: Rows = [(f"${name}", self._value(f"${name}")) for name in ("pc", *debug_views.NAMES)]
        sfrs: Rows = [(name, self._value(name)) for name in disasm.SFR]
        found = (
            ("Locals", "locals", debug_views.variables(self.d, local=True), ""),
            ("Globals", "globals", debug_views.variables(self.d, local=False), ""),
            ("Registers", "registers", registers, "x"),
            ("SFRs", "registers", sfrs, "x"),
        )
        return {
            "scopes": [
                {
                    "name": name,
                    "presentationHint": hint,
                    "variablesReference": self._refer(each, form),
                    "expensive": False,
                }
                for name, hint, each, form in found
            ]
        }

    def variables(self, arguments: Json) -> Json:
        """The request variables."""
        first, count = max(0, whole(arguments, "start", 0)), whole(arguments, "count", 0)
        found, form = self._rows(arguments)
        shown = found[first : first + count if count > 0 else None]
        return {"variables": [{"name": name, **self.described(value, form)} for name, value in shown]}

    def set_variable(self, arguments: Json) -> Json:
        """The request setVariable."""
        found, form = self._rows(arguments)
        name, value = text(arguments, "name"), text(arguments, "value")
        target = dict(found).get(name)
        if not isinstance(target, Value):
            raise UsageError(f"{name}: {target or 'no such variable here'}")
        if name == "$pc":
            self.d.assign(name, value)
            return self.described(self._value(name), form)
        self.d.memory.put(target, self.d.expression(value).number(self.d.memory))
        return self.described(target, form)

    def evaluate(self, arguments: Json) -> Json:
        """The request evaluate."""
        value = self.d.expression(text(arguments, "expression")).value(self.d.memory)
        shown = self.described(value)
        return {"result": shown.pop("value"), **shown}

    def described(self, value: Value | str, form: str = "") -> Json:
        """A variable's value, type, children and place."""
        if isinstance(value, str):
            return {"value": f"<{value}>", "variablesReference": 0}
        shown: Json = {
            "value": debug_views.value_text(self.d, value, form),
            "type": str(value.type),
            "variablesReference": 0,
        }
        children: Rows = list(values.parts(value, self.d.table))
        if value.type.kind is Kind.POINTER and value.type.target and value.type.target.kind is not Kind.FUNCTION:
            children = self._pointed(value)
        if children:
            shown["variablesReference"] = self._refer(children)
        place = value.place
        if place is not None and place.space in MEMORIES:
            shown["memoryReference"] = f"{place.space}:{place.address:#06x}"
        return shown

    def _pointed(self, value: Value) -> Rows:
        """What a pointer points to, where there is something."""
        try:
            return [("*", pointed(value, 0, self.d.table, self.d.memory))]
        except UsageError:
            return []

    def _value(self, name: str) -> Value:
        return self.d.expression(name).value(self.d.memory)

    def _refer(self, found: Rows, form: str = "") -> int:
        self._references.append((found, form))
        return len(self._references)

    def _rows(self, arguments: Json) -> tuple[Rows, str]:
        number = whole(arguments, "variablesReference")
        if not 1 <= number <= len(self._references):
            raise UsageError(
                f"variablesReference {number}: unknown, or from before the board ran; ask for scopes again"
            )
        return self._references[number - 1]

    def data_place(self, arguments: Json) -> tuple[str, int, int, str]:
        """Memory, address, length and name of what dataBreakpointInfo asks about. Raises UsageError."""
        name = text(arguments, "name")
        if "variablesReference" in arguments:
            value = dict(self._rows(arguments)[0]).get(name)
        elif _REFERENCE.fullmatch(name):
            return *reference(name), max(1, whole(arguments, "bytes", 1)), name
        else:
            value = self.d.expression(name).value(self.d.memory)
        place = value.place if isinstance(value, Value) else None
        if not isinstance(value, Value) or place is None or place.space not in MEMORIES:
            raise UsageError(f"{name}: is at no place that can be watched")
        return place.space, place.address, max(1, value.type.size), name

    def disassemble(self, arguments: Json) -> Json:
        """The request disassemble."""
        space, address = reference(text(arguments, "memoryReference"))
        count, skip = whole(arguments, "instructionCount"), whole(arguments, "instructionOffset", 0)
        if space != "code" or not 0 < count <= INSTRUCTIONS_MAX or abs(skip) > INSTRUCTIONS_MAX:
            raise UsageError(f"disassemble: code, and 1 to {INSTRUCTIONS_MAX} instructions at once, are possible")
        start = address + whole(arguments, "offset", 0)
        if not 0 <= start < MEMORY_MAX:
            raise UsageError(f"disassemble: {start:#x} lies outside of code")
        before = debug_views.instructions_before(self.d, start, -skip) if skip < 0 else []
        missing = max(0, -skip - len(before))
        padding = [{"address": "-1", "instruction": "", "presentationHint": "invalid"}] * min(missing, count)
        after = debug_views.instructions(self.d, start, count + max(0, skip))[max(0, skip) :]
        return {"instructions": [*padding, *map(self._instruction, [*before, *after])][:count]}

    def _instruction(self, each: disasm.Instruction) -> Json:
        shown: Json = {
            "address": f"{each.address:#06x}",
            "instructionBytes": each.octets.hex(" "),
            "instruction": each.text,
        }
        line = self.d.line(each.address)
        path = self.sources.find(line.file) if line else None
        if line is not None and path is not None:
            shown |= {"location": {"name": line.file, "path": str(path.absolute())}, "line": line.number}
        return shown

    def read_memory(self, arguments: Json) -> Json:
        """The request readMemory."""
        space, address = reference(text(arguments, "memoryReference"))
        address += whole(arguments, "offset", 0)
        count = whole(arguments, "count")
        if count < 0:
            raise UsageError(f"readMemory: count {count}: 0 or more is needed")
        last = 0x10000 if space in ("xdata", "code") else 0x100
        readable = max(0, min(count, last - address)) if address >= 0 else 0
        octets = self.d.run.read(space, address, readable) if readable else b""
        shown = {"address": f"{space}:{max(0, address):#06x}", "unreadableBytes": count - readable}
        return {**shown, "data": base64.b64encode(octets).decode()}

    def write_memory(self, arguments: Json) -> Json:
        """The request writeMemory."""
        space, address = reference(text(arguments, "memoryReference"))
        address += whole(arguments, "offset", 0)
        try:
            octets = base64.b64decode(text(arguments, "data"), validate=True)
        except (binascii.Error, ValueError) as error:
            raise UsageError(f"writeMemory: data is no base64: {error}") from error
        last = 0x10000 if space in ("xdata", "code") else 0x100
        if not 0 <= address <= last - len(octets):
            raise UsageError(f"writeMemory: {len(octets)} octets at {space}:{address:#x} do not fit")
        self.d.memory.write(space, address, octets)
        return {"bytesWritten": len(octets)}
