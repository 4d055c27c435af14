"""Typed tables from TOML: a dataclass is the schema; a refusal names file, line, key, value and what would be right."""

import dataclasses
import difflib
import functools
import math
import re
import tomllib
import types
import typing
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar

from libins.errors import UsageError

T = TypeVar("T")
Place = tuple[str, ...]
"""Of a key or table in a document: ("expect", "0", "at_most")."""


def field(default: Any = dataclasses.MISSING, **limits: Any) -> Any:
    """A dataclass field with limits: minimum, maximum, above (exclusive), choices."""
    if isinstance(default, (list, dict)) or (dataclasses.is_dataclass(default) and isinstance(default, type)):
        factory = default if isinstance(default, type) else lambda: type(default)(default)
        return dataclasses.field(default_factory=factory, metadata=limits)
    return dataclasses.field(default=default, metadata=limits)


@functools.cache
def _hints(schema: Any) -> dict[str, Any]:
    """Types of a class's fields, which a campaign asks for thousands of times."""
    return typing.get_type_hints(schema)


def parts(hint: Any) -> list[Any]:
    """What a type may be, None left out."""
    is_union = isinstance(hint, types.UnionType)
    return [part for part in typing.get_args(hint) if part is not types.NoneType] if is_union else [hint]


def kind(schema: Any, key: Sequence[str]) -> Any:
    """The type of the scalar of that name, array places as numbers ("expect", "0", "at_most"); None: no such scalar."""
    hint: Any = schema
    for name in (*key, ""):
        choices = parts(hint)
        hint = next(
            (
                part
                for part in choices
                if isinstance(part, type) and dataclasses.is_dataclass(part) and name in _hints(part)
            ),
            choices[0],
        )
        if dataclasses.is_dataclass(hint):
            hint = _hints(hint).get(name)  # type: ignore[arg-type]
        elif typing.get_origin(hint) is list and name.isdigit():
            (hint,) = typing.get_args(hint)
        elif typing.get_origin(hint) is dict and name:
            _, hint = typing.get_args(hint)
        elif name:
            return None
    return hint


def leaves(keys: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Dotted name and value of everything in nested tables that is no table itself."""
    for name, value in keys.items():
        if isinstance(value, Mapping):
            yield from leaves(value, f"{prefix}{name}.")
        else:
            yield prefix + name, value


class Document:
    """A parsed TOML file that knows on which line a key stands."""

    def __init__(self, path: Path, table: dict[str, Any] | None = None) -> None:
        """Read and parse, unless the table is given, and path only a name for it.

        Raises UsageError for a missing file or a syntax error (tomllib says the line).
        """
        self.path = path
        self._overrides: dict[tuple[str, ...], str] = {}
        try:
            self.text = path.read_text(encoding="utf-8") if table is None else ""
            self.table = tomllib.loads(self.text) if table is None else table
        except OSError as error:
            raise UsageError(f"{path}: cannot be read: {error.strerror}; give the path of a scenario file") from error
        except (UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
            raise UsageError(f"{path}: not TOML: {error}") from error

    def override(self, values: Mapping[str, Any], origin: str) -> None:
        """Put values in the place of keys by dotted name ("link.baud", "expect.0.at_most").

        origin: the table of the file they come from, or the option. Raises UsageError for a name that leads through
        something that is no table or array.
        """
        for dotted, value in values.items():
            key = tuple(dotted.split("."))
            in_file = f"{self.path}:{self.line_of((origin, *key))}: {origin}"
            self._overrides[key] = in_file if origin in self.table else origin
            place: Any = self.table
            for i, name in enumerate(key):
                if isinstance(place, list) and name.isdigit() and int(name) < len(place):
                    step: Any = int(name)
                elif isinstance(place, dict):
                    step = name
                else:
                    found = f"an array of {len(place)}" if isinstance(place, list) else repr(place)
                    raise self.refuse(key, f"{'.'.join(key[:i])} is {found}, so there is no {name!r} in it")
                if i == len(key) - 1:
                    place[step] = value
                else:
                    place = place[step] if isinstance(place, list) else place.setdefault(step, {})

    def line_of(self, key: tuple[str, ...]) -> int:
        """Line of a key, or of the table that should hold it; 1 when nothing is found."""
        section: tuple[str, ...] = ()
        best = 1
        tables: Counter[tuple[str, ...]] = Counter()
        for number, line in enumerate(self.text.splitlines(), start=1):
            if header := re.match(r"\s*\[+\s*([^\]]+?)\s*\]+", line):
                section = tuple(part.strip() for part in header[1].split("."))
                if line.strip().startswith("[["):
                    tables[section] += 1
                    section = (*section, str(tables[section] - 1))
                if section == key[: len(section)]:
                    best = number
            elif (entry := re.match(r'\s*"?([\w.-]+)"?\s*=', line)) and key:
                full = section + tuple(entry[1].split("."))
                if full == key[: len(full)]:
                    best = number
                    if full == key:
                        return number
        return best

    def refuse(self, key: tuple[str, ...], problem: str) -> UsageError:
        """The error for a key."""
        for override, place in self._overrides.items():
            if key[: len(override)] == override[: len(key)]:
                return UsageError(f"{place}: {'.'.join(key)}: {problem}")
        return UsageError(f"{self.path}:{self.line_of(key)}: {'.'.join(key)}: {problem}")

    def parse(self, schema: type[T], table: Any, key: tuple[str, ...] = ()) -> T:
        """A dataclass instance from a table. Raises UsageError."""
        if not isinstance(table, dict):
            raise self.refuse(key, f"found {table!r}, but a table is needed here")
        hints = _hints(schema)  # type: ignore[arg-type]
        fields = {f.name: f for f in dataclasses.fields(schema)}  # type: ignore[arg-type]
        values: dict[str, Any] = {}
        for name, value in table.items():
            if name not in fields:
                near = difflib.get_close_matches(name, fields, n=1, cutoff=0.5)
                hint = f"did you mean {near[0]!r}? " if near else ""
                raise self.refuse((*key, name), f"unknown key; {hint}keys here: {', '.join(fields)}")
            values[name] = self._value(hints[name], value, (*key, name), fields[name].metadata)
        for name, f in fields.items():
            if name not in values and f.default is dataclasses.MISSING and f.default_factory is dataclasses.MISSING:
                raise self.refuse((*key, name), "is missing, and has no default")
        return schema(**values)

    def _value(self, hint: Any, value: Any, key: tuple[str, ...], limits: Any) -> Any:
        hint = self._chosen(parts(hint), value, key)
        if dataclasses.is_dataclass(hint):
            return self.parse(hint, value, key)  # type: ignore[arg-type]
        if typing.get_origin(hint) is dict:
            if not isinstance(value, dict):
                raise self.refuse(key, f"found {value!r}, but a table is needed here")
            _, item = typing.get_args(hint)
            return {name: self._value(item, entry, (*key, name), limits) for name, entry in value.items()}
        if typing.get_origin(hint) is list:
            if not isinstance(value, list):
                raise self.refuse(key, f"found {value!r}, but an array is needed")
            (item,) = typing.get_args(hint)
            return [self._value(item, entry, (*key, str(i)), limits) for i, entry in enumerate(value)]
        return self._scalar(hint, value, key, limits)

    def _chosen(self, choices: list[Any], value: Any, key: tuple[str, ...]) -> Any:
        """Of several dataclasses, the one whose `kind` takes the value's."""
        if len(choices) == 1:
            return choices[0]
        if not isinstance(value, dict):
            raise self.refuse(key, f"found {value!r}, but a table is needed here")
        kinds = {
            name: choice
            for choice in choices
            for f in dataclasses.fields(choice)
            if f.name == "kind"
            for name in f.metadata["choices"]
        }
        if value.get("kind") not in kinds:
            found = f"found {value['kind']!r}, but" if "kind" in value else "is missing;"
            raise self.refuse((*key, "kind"), f"{found} one of {', '.join(map(repr, kinds))} is needed")
        return kinds[value["kind"]]

    def _scalar(self, hint: type, value: Any, key: tuple[str, ...], limits: Any) -> Any:
        wanted = {float: "a number", int: "an integer", bool: "true or false", str: "a string"}[hint]
        if hint is float and isinstance(value, int) and not isinstance(value, bool):
            value = float(value)
        if type(value) is not hint:
            raise self.refuse(key, f"found {value!r}, but {wanted} is needed")
        if isinstance(value, float) and not math.isfinite(value):
            raise self.refuse(key, f"found {value!r}, but a finite number is needed")
        if "choices" in limits and value not in limits["choices"]:
            raise self.refuse(key, f"found {value!r}, but one of {', '.join(map(repr, limits['choices']))} is needed")
        if ("minimum" in limits and value < limits["minimum"]) or ("maximum" in limits and value > limits["maximum"]):
            low, high = limits.get("minimum", "-inf"), limits.get("maximum", "inf")
            raise self.refuse(key, f"found {value!r}, but it must lie in {low} .. {high}")
        if "above" in limits and not value > limits["above"]:
            raise self.refuse(key, f"found {value!r}, but it must be above {limits['above']}")
        return value
