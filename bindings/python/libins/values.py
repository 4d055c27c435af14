"""Values as gdb shows them: numbers in several bases, arrays, structs, strings."""

from dataclasses import replace
from typing import Any

from libins.cdb import Cdb
from libins.cdb_types import CdbError, Kind, Type
from libins.places import ExpressionError, Memory, Number, Place, Value

ELEMENTS_MAX = 200
FORMATS = "xduotc"
"""Of print and x: hexadecimal, signed, unsigned, octal, binary, character."""


def text(value: Value, memory: Memory, table: Cdb | None, form: str = "") -> str:
    """A value in one line."""
    kind, place = value.type, value.place
    if place is not None and kind.kind is Kind.ARRAY and kind.target is not None:
        if not form and kind.target.kind is Kind.INTEGER and kind.target.size == 1:
            octets = memory.octets(value)
            if all(32 <= c < 127 for c in octets.rstrip(b"\0")) and octets.strip(b"\0"):
                return string(octets)
        shown = [text(each, memory, table, form) for _, each in parts(value, table)]
        more = ["..."] if kind.length > ELEMENTS_MAX else []
        return "{" + ", ".join(shown + more) + "}"
    if place is not None and kind.kind is Kind.STRUCT:
        return "{" + ", ".join(f"{name} = {text(v, memory, table, form)}" for name, v in parts(value, table)) + "}"
    number = memory.number(value)
    if not form and (kind.kind in (Kind.POINTER, Kind.FUNCTION)):
        return f"({kind}) {number:#x}"
    return number_text(number, kind, form)


def number_text(number: Number, kind: Type, form: str) -> str:
    """A number; form: one letter of FORMATS, or none."""
    if isinstance(number, float) or not form:
        return repr(number)
    bits = 8 * (kind.size or 2)
    unsigned = number & (1 << bits) - 1
    if form == "d":
        return str(unsigned - (1 << bits) if unsigned >> bits - 1 else unsigned)
    if form == "c":
        return f"{unsigned & 0xFF} {string(bytes([unsigned & 0xFF]), quote=chr(39))}"
    return {"x": f"{unsigned:#x}", "u": str(unsigned), "o": f"0{unsigned:o}", "t": f"{unsigned:b}"}[form]


def string(octets: bytes, quote: str = '"') -> str:
    """Octets as a C string, up to the zeros at the end."""
    end = octets.rstrip(b"\0") or octets[:1]
    return quote + "".join(chr(c) if 32 <= c < 127 and chr(c) not in '"\\' else f"\\x{c:02x}" for c in end) + quote


def parts(value: Value, table: Cdb | None) -> list[tuple[str, Value]]:
    """Elements of an array, members of a struct; of anything else, nothing."""
    kind, place = value.type, value.place
    if place is None:
        return []
    if kind.kind is Kind.ARRAY and kind.target is not None:
        each = kind.target
        places = [replace(place, address=place.address + i * each.size) for i in range(min(kind.length, ELEMENTS_MAX))]
        return [(f"[{i}]", Value(each, place=at, module=value.module)) for i, at in enumerate(places)]
    if kind.kind is Kind.STRUCT and table is not None:
        try:
            members = table.members(value.module, kind)
        except CdbError as error:
            raise ExpressionError(str(error)) from error
        at: Any = place.address
        return [(m.name, Value(m.type, place=Place(place.space, at + m.offset), module=value.module)) for m in members]
    return []
