"""Tables of numbers from CSV files, also gzipped, whose columns the configuration names."""

import gzip
from pathlib import Path

import numpy as np

from libins.errors import UsageError
from libins.recording import GPS_EPOCH_S, WEEK_S, Array, Findings, unwrapped_tow

BAD_SHARE_MAX = 0.01
"""A file with more unreadable lines than this is another kind of file."""
COMMENTS = ("#", "%", "//")
UNUSED = ("", "-")


def text_of(path: Path) -> str:
    """The file's text. Raises UsageError."""
    try:
        raw = path.read_bytes()
        return (gzip.decompress(raw) if path.suffix == ".gz" else raw).decode("utf-8-sig")
    except OSError as error:
        raise UsageError(f"{path}: cannot be read: {error}; give the path of a recording") from error
    except (UnicodeDecodeError, EOFError) as error:
        raise UsageError(f"{path}: not text: {error}; give a CSV file, or one that gzip has packed") from error


def _numbers(path: Path, lines: list[tuple[int, str]], delimiter: str | None, width: int, findings: Findings) -> Array:
    """Rows of at least `width` numbers; an empty field is NaN."""
    try:
        rows = np.loadtxt([line for _, line in lines], delimiter=delimiter, ndmin=2)
        if rows.shape[1] >= width:
            return rows
    except ValueError:
        pass
    kept: list[list[float]] = []
    bad: list[tuple[int, str]] = []
    for number, line in lines:
        try:
            row = [float(field) if field.strip() else float("nan") for field in line.split(delimiter)][:width]
        except ValueError:
            row = []
        if len(row) == width:
            kept.append(row)
        else:
            bad.append((number, line))
    if len(bad) > BAD_SHARE_MAX * len(lines):
        number, line = bad[0]
        raise UsageError(
            f"{path}:{number}: found {line[:60]!r}, but {width} numbers are needed in a line, as `columns` says; "
            f"{len(bad)} of {len(lines)} lines are not like that"
        )
    findings.add(f"{path.name}: lines that cannot be read", len(bad), f"first line {bad[0][0]}" if bad else "")
    return np.array(kept).reshape(-1, width)


def table(path: Path, columns: list[str], allowed: tuple[str, ...], findings: Findings) -> dict[str, Array]:
    """Column by name. Raises UsageError, naming file and line."""
    unknown = [name for name in columns if name not in allowed and name not in UNUSED]
    if unknown:
        raise UsageError(
            f"{path}: columns: {unknown[0]!r} is not known here; known: {', '.join(allowed)}, '-' (unused)"
        )
    lines = [(n, line) for n, line in enumerate(text_of(path).splitlines(), start=1) if line.strip()]
    lines = [(n, line) for n, line in lines if not line.lstrip().startswith(COMMENTS)]
    first = lines[0][1] if lines else ""
    delimiter = next((d for d in (",", ";", "\t") if d in first), None)
    try:
        [float(field) for field in first.split(delimiter)[: len(columns)] if field.strip()]
    except ValueError:
        lines = lines[1:]  # names of columns
    if len(lines) < 2:
        raise UsageError(f"{path}: holds no table of numbers; {len(columns)} columns are needed: {', '.join(columns)}")
    rows = _numbers(path, lines, delimiter, len(columns), findings)
    return {name: rows[:, i] for i, name in enumerate(columns) if name not in UNUSED}


def need(path: Path, found: dict[str, Array], *names: str) -> list[Array]:
    """These columns. Raises UsageError for one that the configuration does not name."""
    missing = [name for name in names if name not in found]
    if missing:
        raise UsageError(f"{path}: columns: {', '.join(missing)} missing; columns given: {', '.join(found)}")
    return [found[name] for name in names]


def times(path: Path, found: dict[str, Array], kind: str, leap_s: float, scale: float = 1.0) -> Array:
    """Seconds since 1970 on GPS's clock; of `seconds` and `gps_tow`, since what the caller knows."""
    if kind == "gps_week":
        week, tow = need(path, found, "week", "tow")
        return GPS_EPOCH_S + WEEK_S * week + scale * tow
    (t,) = need(path, found, "time")
    if kind == "gps_tow":
        return unwrapped_tow(scale * t)
    return scale * t + (leap_s if kind == "unix_utc" else 0.0)
