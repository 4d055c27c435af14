"""Places in the board's memories with their C types: reading, writing, pointers, and where a variable is."""

import re
import struct
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from libins import disasm
from libins.cdb import Cdb, Space, Symbol
from libins.cdb_types import CdbError, Kind, Type, scalar
from libins.errors import UsageError

MEMORIES = ("iram", "sfr", "xdata", "code")
SPACES = {
    Space.DATA: "iram",
    Space.IDATA: "iram",
    Space.SFR: "sfr",
    Space.XDATA: "xdata",
    Space.PDATA: "xdata",
    Space.CODE: "code",
    Space.CONSTANT: "code",
}
POINTED = {"data": "iram", "idata": "iram", "xdata": "xdata", "pdata": "xdata", "code": "code"}
GENERIC = {0x00: "xdata", 0x40: "iram", 0x60: "xdata", 0x80: "code"}
"""What the third octet of SDCC's generic pointer says."""
BYTE = Type(Kind.INTEGER, 1)
INT = Type(Kind.INTEGER, 2, signed=True)
Number = int | float


class ExpressionError(UsageError):
    """An expression cannot be read, or has no value here."""


@dataclass(frozen=True)
class Place:
    """Where an lvalue's first octet is; or with `registers` each, as (memory, address), lowest first."""

    space: str
    address: int
    registers: tuple[tuple[str, int], ...] = ()


@dataclass(frozen=True)
class Value:
    """A value computed, or (with `place`) something in memory."""

    type: Type
    number: Number = 0
    place: Place | None = None
    module: str = ""
    """Whose structs the type means."""


class Memory:
    """What expressions read and write: one board. Notes what was read, for watching it."""

    def __init__(self, run: Any, write: Callable[[str, int, bytes], object]) -> None:
        """`run` is a libins._run.Run; `write` carries out a poke."""
        self.run = run
        self.write = write
        self.touched: dict[tuple[str, int, int], None] = {}
        """Places that were read, each once, in the order of the first time."""

    def read(self, space: str, address: int, count: int) -> bytes:
        """Octets of a memory."""
        self.touched[space, address, count] = None
        return bytes(self.run.read(space, address, count))

    def octets(self, value: Value) -> bytes:
        """What is at an lvalue."""
        if value.place is None:
            raise ExpressionError("this is no place in memory")
        if value.place.registers:
            return b"".join(self.read(space, address, 1) for space, address in value.place.registers)
        return self.read(value.place.space, value.place.address, value.type.size)

    def number(self, value: Value) -> Number:
        """Its value; of an array or function, its address. Raises ExpressionError."""
        if value.place is None:
            return value.number
        if value.type.kind in (Kind.ARRAY, Kind.FUNCTION):
            return value.place.address
        try:
            return scalar(value.type, self.octets(value))
        except CdbError as error:
            raise ExpressionError(str(error)) from error

    def put(self, value: Value, number: Number) -> None:
        """Assign to an lvalue. Raises ExpressionError."""
        place, kind = value.place, value.type
        if place is None or kind.kind not in (Kind.INTEGER, Kind.BOOLEAN, Kind.POINTER, Kind.FLOAT):
            raise ExpressionError("only a number in memory can be assigned to; name a member or an element")
        if kind.kind is Kind.FLOAT:
            octets = struct.pack("<f", number)
        else:
            whole = int(number)
            if kind.bits is not None:
                offset, width = kind.bits
                mask = (1 << width) - 1 << offset
                whole = int.from_bytes(self.octets(value), "little") & ~mask | whole << offset & mask
            octets = (whole & (1 << 8 * kind.size) - 1).to_bytes(kind.size, "little")
        if place.registers:
            for (space, address), octet in zip(place.registers, octets, strict=True):
                self.write(space, address, bytes([octet]))
        else:
            self.write(place.space, place.address, octets)


def pointed(value: Value, index: int, table: Cdb | None, memory: Memory) -> Value:
    """What a pointer points to, or an element of an array. Raises ExpressionError."""
    target = value.type.target
    if value.type.kind not in (Kind.POINTER, Kind.ARRAY) or target is None:
        raise ExpressionError(f"{value.type} points to nothing")
    if target.kind is Kind.STRUCT and not target.size and table is not None:
        try:
            size = max((m.offset + m.type.size for m in table.members(value.module, target)), default=0)
        except CdbError as error:
            raise ExpressionError(str(error)) from error
        target = replace(target, size=size)
    base = int(memory.number(value))
    if value.type.kind is Kind.ARRAY and value.place is not None:
        space = value.place.space
    elif value.type.space == "generic":
        space = GENERIC.get(base >> 16, "")
        base &= 0xFFFF
    else:
        space = POINTED.get(value.type.space, "")
    if not space:
        raise ExpressionError(f"pointer {base:#x} is into no memory that is known")
    return Value(target, place=Place(space, base + index * target.size & 0xFFFF), module=value.module)


def pointer(target: Type, place: Place) -> Type:
    """The type of a pointer to a place."""
    space = {"iram": "idata", "sfr": "data"}.get(place.space, place.space)
    return Type(Kind.POINTER, 2 if place.space in ("xdata", "code") else 1, target=target, space=space)


def decayed(value: Value) -> Value:
    """An array, where it is computed with, is a pointer to its first element."""
    if value.type.kind is not Kind.ARRAY or value.type.target is None or value.place is None:
        return value
    return Value(pointer(value.type.target, value.place), value.place.address, module=value.module)


def bank(memory: Memory) -> int:
    """Address of R0 now."""
    return memory.read("sfr", disasm.SFR["PSW"], 1)[0] & 0x18


def located(symbol: Symbol, table: Cdb | None, memory: Memory) -> Value:
    """A variable as an lvalue. Raises ExpressionError where SDCC does not say its place or type."""
    kind = symbol.type
    if kind is None:
        raise ExpressionError(f"{symbol.name}: SDCC says no type (an overlaid local); read it as iram:{symbol.address}")
    if symbol.space is Space.SBIT and symbol.address is not None:
        octet = symbol.address & 0xF8
        return Value(replace(BYTE, bits=(symbol.address & 7, 1)), place=Place("sfr", octet))
    if symbol.space in SPACES and symbol.address is not None:
        return Value(kind, place=Place(SPACES[symbol.space], symbol.address), module=symbol.module)
    if symbol.space is Space.REGISTER and len(symbol.registers) == kind.size:
        places = tuple(_register_place(name, memory) for name in symbol.registers)
        return Value(kind, place=Place("registers", 0, places), module=symbol.module)
    if symbol.space is Space.STACK and table is not None and symbol.stack is not None and symbol.function is not None:
        pointer = _frame_pointer(table.function(symbol.function).begin, memory)
        if pointer is not None:
            address = memory.read("iram", pointer, 1)[0] + symbol.stack & 0xFF
            return Value(kind, place=Place("iram", address), module=symbol.module)
    raise ExpressionError(f"{symbol.name}: SDCC keeps it in {symbol.space.name.lower()} and says no address")


def _register_place(name: str, memory: Memory) -> tuple[str, int]:
    if re.fullmatch(r"r[0-7]", name):
        return "iram", bank(memory) + int(name[1])
    if name.upper() in disasm.SFR or name == "a":
        return "sfr", disasm.SFR["ACC" if name == "a" else name.upper()]
    raise ExpressionError(f"register {name} is not known")


def _frame_pointer(begin: int, memory: Memory) -> int | None:
    """Address of _bp, from a reentrant function's first instructions: push _bp; mov _bp,sp."""
    octets = memory.run.read("code", begin, 5)
    found = octets[0] == 0xC0 and octets[2:5] == bytes([0x85, disasm.SFR["SP"], octets[1]])
    return int(octets[1]) if found else None
