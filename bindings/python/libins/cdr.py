"""Octets of CDR by the ROS definition of their message: its fields as columns, named with their units.

A column is one field: `t_s`, `angular_velocity.x_rad_s` of a message inside, `transforms.0.child_frame_id` of a
sequence; an array of numbers is one column of many numbers, labelled in `Column.labels`. Units come from the
definition's comments, such as `# [rad/s]`, where the name does not say them already.

Source: OMG DDS-XTypes 1.3, 7.4.1 (plain CDR; alignment counts from behind the header of four octets).
"""

import re
import struct
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby
from typing import Any

from libins.errors import UsageError

CODES = {
    "bool": "?", "byte": "B", "char": "B", "int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i",
    "uint32": "I", "int64": "q", "uint64": "Q", "float32": "f", "float64": "d",
}  # fmt: skip
ENDIAN = {0: ">", 1: "<", 6: ">", 7: "<"}
"""By the header: XCDR1, and XCDR2 of a final type."""
XCDR2 = (6, 7)
HEADER = 4
AXES = {3: "xyz", 4: "wxyz"}
FIELD = re.compile(
    r"^(?P<type>[\w/]+)(?P<bound><=\d+)?(?P<array>\[(?P<size>\d*)(?:<=\d+)?\])?\s+(?P<name>\w+)\s*(?P<rest>[^#\n]*)"
    r"(?:#\s*(?P<comment>.*))?$"
)
ALIASES = {"time": "builtin_interfaces/Time", "duration": "builtin_interfaces/Duration"}
Value = Any
"""A number, a text, or a tuple of numbers."""


@dataclass(frozen=True)
class Field:
    """Of a definition."""

    type: str
    name: str
    count: int | None
    """Of a fixed array; None: a single one, -1: a sequence."""
    comment: str


@dataclass(frozen=True)
class Column:
    """What a path of the message is called in a table."""

    name: str
    unit: str
    labels: tuple[str, ...] = ()
    units: tuple[str, ...] = ()
    """Of each number of an array."""

    def heads(self) -> list[str]:
        """One for each number."""
        if not self.labels:
            return [_with_unit(self.name, "", self.unit)]
        return [_with_unit(self.name, label, unit) for label, unit in zip(self.labels, self.units, strict=True)]


def _slug(unit: str) -> str:
    """rad/s is rad_s, "ns since 1970" ns."""
    return re.sub(r"\W+", "_", unit.split(" ")[0].replace("^", "")).strip("_")


def _with_unit(name: str, label: str, unit: str) -> str:
    """The unit last, and once."""
    slug = _slug(unit)
    base = name.removesuffix(f"_{slug}") if slug else name
    return "_".join(part for part in (base, label, slug) if part)


def column(name: str, field: Field, unit: str) -> Column:
    """`latitude, longitude [rad], height above WGS-84 [m]` labels three numbers, and gives each its unit."""
    own = re.findall(r"\[([^\]]+)\]", field.comment)
    unit = own[0] if len(set(own)) == 1 else unit
    if field.count is None or field.count < 0:
        return Column(name, unit)
    items = [item.strip() for item in field.comment.split(",")]
    if field.count > 1 and len(items) == field.count and all(re.match(r"[a-z]", item) for item in items):
        following = [next(iter(re.findall(r"\[([^\]]+)\]", ",".join(items[i:]))), unit) for i in range(len(items))]
        return Column(name, unit, tuple(re.match(r"\w+", item)[0] for item in items), tuple(following))  # type: ignore[index]
    labels = AXES.get(field.count, [str(i) for i in range(field.count)])
    return Column(name, unit, tuple(labels), (unit,) * field.count)


class Definition:
    """Of a message and all in it, from the text of a ros2msg schema."""

    def __init__(self, name: str, text: str) -> None:
        """Raises UsageError for a text that is none."""
        self.name = name
        self._messages: dict[str, list[Field]] = {}
        head, *others = re.split(r"^=+\n", text, flags=re.MULTILINE)
        self._messages[_short(name)] = list(_fields(name, head))
        for part in others:
            title, _, body = part.partition("\n")
            inside = title.removeprefix("MSG:").strip()
            self._messages[_short(inside)] = list(_fields(inside, body))
        self._plans: dict[str, list[list[Field]]] = {}
        self.columns: dict[str, Column] = {}
        """By the path of what has been read."""

    def read(self, octets: bytes) -> dict[str, Value]:
        """Each field by its path. Raises UsageError for what is no message of this kind."""
        kind = octets[1] if len(octets) >= HEADER and octets[0] == 0 else -1
        if kind not in ENDIAN:
            raise UsageError(f"{self.name}: header {octets[:HEADER].hex()} is not that of plain CDR")
        reader = _Reader(octets, ENDIAN[kind], 4 if kind in XCDR2 else 8)
        found: dict[str, Value] = {}
        try:
            self._message(reader, _short(self.name), "", "", found)
        except (struct.error, IndexError, UnicodeDecodeError) as error:
            raise UsageError(f"{self.name}: {len(octets)} octets do not hold it: {error}") from error
        return found

    def _message(self, reader: "_Reader", name: str, prefix: str, unit: str, found: dict[str, Value]) -> None:
        for fields in self._plan(name):
            if _is_number(fields[0]):
                self._numbers(reader, fields, prefix, unit, found)
            else:
                self._other(reader, fields[0], prefix, unit, found)

    def _plan(self, name: str) -> list[list[Field]]:
        """The fields, numbers that follow each other together."""
        if name not in self._plans:
            if name not in self._messages:
                raise UsageError(f"{self.name}: its definition lacks {name}")
            groups = groupby(enumerate(self._messages[name]), lambda f: -1 if _is_number(f[1]) else f[0])
            self._plans[name] = [[field for _, field in group] for _, group in groups]
        return self._plans[name]

    def _numbers(self, reader: "_Reader", fields: list[Field], prefix: str, unit: str, found: dict[str, Value]) -> None:
        values = reader.numbers(tuple(CODES[f.type] * (f.count or 1) for f in fields))
        at = 0
        for field in fields:
            path = prefix + field.name
            if path not in self.columns:
                self.columns[path] = column(path, field, unit)
            if field.count is None:
                found[path] = values[at]
            else:
                found[path] = values[at : at + field.count]
            at += field.count or 1

    def _other(self, reader: "_Reader", field: Field, prefix: str, unit: str, found: dict[str, Value]) -> None:
        """A text, a message, or many of one."""
        path = prefix + field.name
        count = reader.numbers(("I",))[0] if field.count == -1 else field.count
        if count is not None and count > len(reader):
            raise IndexError(f"{path} says that it has {count} elements")
        inside = column(path, field, unit).unit
        for place in [path] if count is None else [f"{path}.{i}" for i in range(count)]:
            if field.type == "string":
                self.columns.setdefault(place, Column(place, ""))
                found[place] = reader.text()
            elif field.type in CODES:
                self.columns.setdefault(place, Column(place, inside))
                (found[place],) = reader.numbers((CODES[field.type],))
            else:
                self._message(reader, _short(field.type), place + ".", inside, found)


class _Reader:
    """Goes through the octets of one message."""

    _structs: dict[tuple[tuple[str, ...], int, str, int], struct.Struct] = {}
    """Of runs of numbers that begin at an offset, with their padding."""

    def __init__(self, octets: bytes, endian: str, widest: int) -> None:
        """widest: what numbers are aligned to at most."""
        self._octets = octets
        self._at = HEADER
        self._endian = endian
        self._widest = widest

    def __len__(self) -> int:
        """Octets that are left."""
        return len(self._octets) - self._at

    def numbers(self, codes: tuple[str, ...]) -> tuple[Any, ...]:
        """Those that follow."""
        key = (codes, (self._at - HEADER) % 8, self._endian, self._widest)
        if key not in self._structs:
            self._structs[key] = self._struct(*key[:2])
        plan = self._structs[key]
        values = plan.unpack_from(self._octets, self._at)
        self._at += plan.size
        return values

    def _struct(self, codes: tuple[str, ...], offset: int) -> struct.Struct:
        begin, format_ = offset, self._endian
        for run in codes:
            size = struct.calcsize(f"={run[0]}")
            padding = -offset % min(size, self._widest)
            format_ += "x" * padding + f"{len(run)}{run[0]}"
            offset += padding + size * len(run)
        made = struct.Struct(format_)
        assert made.size == offset - begin
        return made

    def text(self) -> str:
        """A string: its length with the end that it has, its octets."""
        (length,) = self.numbers(("I",))
        raw = self._octets[self._at : self._at + length]
        if len(raw) != length:
            raise IndexError(f"a text of {length} octets goes beyond the end")
        self._at += length
        return raw.removesuffix(b"\0").decode("utf-8")


def _is_number(field: Field) -> bool:
    return field.type in CODES and field.count != -1


def _short(name: str) -> str:
    """geometry_msgs/msg/Point and geometry_msgs/Point are one."""
    return name.replace("/msg/", "/")


def _fields(name: str, text: str) -> Iterator[Field]:
    package = name.partition("/")[0]
    for line in text.splitlines():
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        found = FIELD.match(line.strip())
        if found is None:
            raise UsageError(f"{name}: its definition has the line {line!r}, which is no field")
        if found["rest"].startswith("="):
            continue  # a constant is not in the octets
        kind = ALIASES.get(found["type"], found["type"])
        if kind not in CODES and kind != "string" and "/" not in kind:
            kind = "std_msgs/Header" if kind == "Header" else f"{package}/{kind}"
        count = None if found["array"] is None else int(found["size"]) if found["size"] else -1
        yield Field(kind, found["name"], count, (found["comment"] or "").strip())
