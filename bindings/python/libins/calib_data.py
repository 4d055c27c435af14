"""Columns of numbers from text files: comma, semicolon or white space between them, a header or none, gzip or not."""

import csv
import gzip
import io
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from libins.errors import UsageError

Array = NDArray[np.float64]


def _text(path: Path) -> str:
    try:
        raw = path.read_bytes()
        return (gzip.decompress(raw) if path.suffix == ".gz" else raw).decode("utf-8")
    except OSError as error:
        raise UsageError(f"{path}: cannot be read: {error.strerror or error}") from error
    except (EOFError, UnicodeDecodeError, gzip.zlib.error) as error:  # type: ignore[attr-defined]
        raise UsageError(f"{path}: is not text, nor text packed with gzip: {error}") from error


def _rows(text: str) -> list[tuple[int, list[str]]]:
    """Line number and fields; lines that are empty or begin with # are left out."""
    lines = [(n, line.strip()) for n, line in enumerate(text.splitlines(), start=1)]
    lines = [(n, line) for n, line in lines if line and not line.startswith("#")]
    separator = next((c for c in ",;" if lines and c in lines[0][1]), None)
    if separator is None:
        return [(n, line.split()) for n, line in lines]
    fields = csv.reader(io.StringIO("\n".join(line for _, line in lines)), delimiter=separator, skipinitialspace=True)
    return [(n, [part.strip() for part in row]) for (n, _), row in zip(lines, fields, strict=True)]


def _place(path: Path, header: list[str] | None, column: str, width: int) -> int:
    if header is not None and column in header:
        return header.index(column)
    if header is None and re.fullmatch(r"[0-9]+", column) and 1 <= int(column) <= width:
        return int(column) - 1
    have = f"its columns are {', '.join(header)}" if header else f"it has no header; give numbers from 1 to {width}"
    raise UsageError(f"{path}: no column {column!r}; {have}")


def read(path: Path, columns: Sequence[str]) -> Array:
    """(rows, columns) of finite numbers. Raises UsageError that names file, line and column."""
    rows = _rows(_text(path))
    header = None
    if rows and not _is_number(rows[0][1][0]):
        header = rows.pop(0)[1]
    if not rows:
        raise UsageError(f"{path}: holds no rows of numbers")
    width = len(rows[0][1])
    places = [_place(path, header, column, width) for column in columns]
    values: list[list[float]] = []
    for line, row in rows:
        if len(row) != width:
            raise UsageError(f"{path}:{line}: {len(row)} columns, but the first row has {width}")
        values.append([_number(path, line, column, row[at]) for column, at in zip(columns, places, strict=True)])
    return np.array(values)


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _number(path: Path, line: int, column: str, text: str) -> float:
    value: Any = float(text) if _is_number(text) else np.nan
    if not np.isfinite(value):
        raise UsageError(f"{path}:{line}: column {column}: found {text!r}, but a finite number is needed")
    return float(value)


STEP_SPREAD = 0.5
"""Largest deviation of one step of time from their mean, of that mean."""


def period(path: Path, t: Array) -> float:
    """Of samples at even steps. Raises UsageError."""
    steps = np.diff(t)
    mean = float(np.mean(steps)) if len(steps) else 0.0
    worst = int(np.argmax(np.abs(steps - mean))) if len(steps) else 0
    if not mean > 0 or abs(steps[worst] - mean) > STEP_SPREAD * mean:
        found = f"{steps[worst]:.6g} s after row {worst + 1}" if len(steps) else "no step"
        raise UsageError(f"{path}: samples must be {mean:.6g} s apart, evenly; found {found}")
    return mean
