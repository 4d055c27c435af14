"""C types as SDCC's .cdb writes them ("type chain records"), and values of them from the octets of memory.

`{6}DA3d,SI:U` is an array of three unsigned int, six octets in all. Little endian; float is IEEE single.
"""

import re
import struct
from dataclasses import dataclass
from enum import StrEnum

from libins.errors import UsageError

DEPTH_MAX = 32
"""Of arrays, pointers and functions in one type: more is no program's, but damage."""


class CdbError(UsageError):
    """A .cdb file is damaged, or does not have what was asked for."""


class Kind(StrEnum):
    """What a type is at its outermost."""

    VOID = "void"
    INTEGER = "integer"
    BOOLEAN = "boolean"
    FLOAT = "float"
    STRUCT = "struct"
    ARRAY = "array"
    POINTER = "pointer"
    FUNCTION = "function"


@dataclass(frozen=True)
class Type:
    """A C type. `size` in octets; 0 where SDCC does not say it (void, a struct behind a pointer)."""

    kind: Kind
    size: int
    signed: bool = False
    target: "Type | None" = None
    """Element of an array, what a pointer points to, result of a function."""
    length: int = 0
    """Of an array."""
    space: str = ""
    """Of a pointer: "generic", "code", "xdata", "data", "pdata" or "idata"."""
    tag: str = ""
    """Of a struct or union."""
    bits: tuple[int, int] | None = None
    """Of a bit-field or __bit: offset of the lowest bit, and width."""

    def __str__(self) -> str:
        """As in C, read from the inside: "unsigned int [3]", "struct node *", "char ()*"."""
        marks, at = "", self
        while at.target is not None:  # the bounds of an array of arrays stand in C's order, outermost first
            bounds = ""
            while at.kind is Kind.ARRAY and at.target is not None:
                bounds, at = f"{bounds}[{at.length}]", at.target
            if not bounds:
                bounds, at = "()" if at.kind is Kind.FUNCTION else "*", at.target or at
            marks = bounds + marks
        if marks:
            return f"{at} {marks}"
        if self.kind is Kind.STRUCT:
            return f"struct {self.tag}"
        if self.kind is Kind.INTEGER:
            name = {1: "char", 2: "int", 4: "long", 8: "long long"}.get(self.size, f"integer of {self.size} octets")
            return name if self.signed else f"unsigned {name}"
        return {Kind.BOOLEAN: "_Bool", Kind.FLOAT: "float", Kind.VOID: "void"}[self.kind]


@dataclass(frozen=True)
class Member:
    """Of a struct or union, `offset` octets from its begin."""

    name: str
    offset: int
    type: Type


_SIZED = re.compile(r"\{(\d{1,6})\}(.*):([SU])$")
_MEMBER = re.compile(r"\(\{(\d{1,6})\}S:S\$([^$()]+)\$[^$()]+\$[^$()]+\((\{\d{1,6}\}[^()]*)\),Z,0,0\)")
_BASES = {
    "SC": (Kind.INTEGER, 1),
    "SS": (Kind.INTEGER, 2),
    "SI": (Kind.INTEGER, 2),
    "SL": (Kind.INTEGER, 4),
    "SF": (Kind.FLOAT, 4),
    "SV": (Kind.VOID, 0),
    "SX": (Kind.BOOLEAN, 1),
    "": (Kind.BOOLEAN, 1),
}
_POINTERS = {"DG": "generic", "DC": "code", "DX": "xdata", "DD": "data", "DP": "pdata", "DI": "idata"}
_POINTER_SIZES = {"generic": 3, "code": 2, "xdata": 2}
_BIT_FIELD = re.compile(r"SB(\d{1,2})\$(\d{1,2})$")
_ARRAY = re.compile(r"DA(\d{0,6})d$")


def parse_type(text: str) -> Type:
    """A type chain with its size, `{2}DF,SI:S`. Raises CdbError."""
    m = _SIZED.match(text)
    if m is None:
        raise CdbError(f"not a whole type: {text[:60]!r}")
    chain = m[2].split(",")
    if len(chain) > DEPTH_MAX:
        raise CdbError(f"a type {len(chain)} levels deep: {text[:60]!r}")
    return _chain(chain, int(m[1]), m[3] == "S")


def _chain(chain: list[str], size: int | None, signed: bool) -> Type:
    """The type of the chain's first link; size None: what its kind alone says."""
    head, rest = chain[0], chain[1:]
    if array := _ARRAY.match(head):
        length = int(array[1] or 0)
        element = _inner(chain, rest, size // length if size is not None and length else None, signed)
        return Type(Kind.ARRAY, length * element.size if size is None else size, target=element, length=length)
    if head == "DF":
        return Type(Kind.FUNCTION, 0, target=_inner(chain, rest, None, signed))
    if head in _POINTERS:
        space = _POINTERS[head]
        own = _POINTER_SIZES.get(space, 1) if size is None else size
        return Type(Kind.POINTER, own, target=_inner(chain, rest, None, signed), space=space)
    if rest:
        raise CdbError(f"type {head!r} cannot be followed by {rest[0]!r}")
    if field := _BIT_FIELD.match(head):
        return Type(Kind.INTEGER, size or 1, signed, bits=(int(field[1]), int(field[2])))
    if head.startswith("ST") and len(head) > 2:
        return Type(Kind.STRUCT, size or 0, tag=head[2:])
    if head not in _BASES:
        raise CdbError(f"type {head!r} is none of SDCC's")
    kind, usual = _BASES[head]
    return Type(kind, usual if size is None or kind is Kind.VOID else size, signed and kind is Kind.INTEGER)


def _inner(chain: list[str], rest: list[str], size: int | None, signed: bool) -> Type:
    if not rest:
        raise CdbError(f"type ends after {chain[0]!r}")
    return _chain(rest, size, signed)


def parse_members(text: str) -> tuple[Member, ...]:
    """What stands between the brackets of a T record. Raises CdbError."""
    members = []
    at = 0
    while at < len(text):
        m = _MEMBER.match(text, at)
        if m is None:
            raise CdbError(f"not a whole member: {text[at : at + 60]!r}")
        members.append(Member(m[2], int(m[1]), parse_type(m[3])))
        at = m.end()
    return tuple(members)


def scalar(kind: Type, octets: bytes) -> int | float:
    """The value of an integer, boolean, float or pointer, or the bits of a bit-field. Raises CdbError."""
    if kind.kind not in (Kind.INTEGER, Kind.BOOLEAN, Kind.FLOAT, Kind.POINTER):
        raise CdbError(f"{kind} has no value of its own; name a member or an element")
    if len(octets) != kind.size:
        raise CdbError(f"{kind} has {kind.size} octets, not {len(octets)}")
    if kind.kind is Kind.FLOAT and kind.size == 4:
        return float(struct.unpack("<f", octets)[0])
    value = int.from_bytes(octets, "little")
    width = 8 * kind.size
    if kind.bits is not None:
        offset, width = kind.bits
        value = value >> offset & (1 << width) - 1
    return value - (1 << width) if kind.signed and width and value >> (width - 1) else value
