"""What a calibration leaves behind as text: TOML, a C header, lines for a terminal."""

import re
from pathlib import Path
from typing import Any

import numpy as np

from libins.calibration import Result
from libins.errors import UsageError


def _value(value: Any) -> str:
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {_value(each)}" for key, each in value.items()) + " }"
    if isinstance(value, np.ndarray):
        return "[" + ", ".join(_value(each) for each in value) + "]"
    return repr(value) if isinstance(value, int) else repr(float(value))


def toml(result: Result, g: float, source: str) -> str:
    """Applied as docs/calib.md says; every number with all its digits."""
    lines = [f'method = "{result.method}"', f'source = "{source}"', f"g_m_s2 = {g!r}"]
    for name, table in result.tables.items():
        rows = table if isinstance(table, list) else [table]
        for row in rows:
            lines += ["", f"[[{name}]]" if isinstance(table, list) else f"[{name}]"]
            lines += [f"{key} = {_value(value)}" for key, value in row.items()]
    return "\n".join(lines) + "\n"


def header(result: Result, path: Path) -> str:
    """Tables in C for firmware that links the core."""
    name = re.sub(r"\W", "_", path.stem).lower()
    guard = f"{name.upper()}_H_INCLUDED"
    if name[0].isdigit():
        raise UsageError(f"--header {path}: a C name is made of it, so it must not begin with a digit")

    def numbers(values: Any) -> str:
        return "{" + ", ".join(f"INS_C({float(v)!r})" for v in np.ravel(values)) + "}"

    def real(of: str, values: Any) -> str:
        return f"static const ins_real {name}_{of}[{np.size(values)}] = {numbers(values)};"

    lines = [f"/* Calibration by ins calib, method {result.method}. */", f"#ifndef {guard}", f"#define {guard}"]
    if "accelerometer" in result.tables:
        rows = result.tables["accelerometer"]
        lines += ['#include "ins/sixacc.h"', "", f"static const ins_accel_t {name}[{len(rows)}] = {{"]
        lines += [
            f"    {{INS_C({float(row['bias'])!r}), {numbers(row['axis'])}, {numbers(row['place_m'])}}}," for row in rows
        ]
        lines += ["};"]
        if "k2_s2_m" in rows[0]:
            lines += ["", "/* quadratic terms, for ins_accel_linear() */", real("k2", [row["k2_s2_m"] for row in rows])]
    else:
        lines += ['#include "ins/config.h"', "", "/* matrix (reading - bias), for gyros less g_sensitivity f too */"]
        for sensor, table in result.tables.items():
            lines += [
                real(f"{sensor}_{key}", table[key]) for key in ("matrix", "bias", "g_sensitivity") if key in table
            ]
    return "\n".join([*lines, "#endif", ""])


def summary(result: Result) -> str:
    """For a terminal."""
    lines = [f"method    {result.method}"]
    for name, table in result.tables.items():
        for i, row in enumerate(table if isinstance(table, list) else [table], start=1):
            which = f"{name} {row.get('number', i)}" if isinstance(table, list) else name
            shown = [key for key in ("bias", "axis", "place_m", "k2_s2_m", "matrix", "g_sensitivity") if key in row]
            lines.append(f"{which}: " + "; ".join(f"{key} {short(row[key])}" for key in shown))
    lines += [f"{name}: {short(value)}" for name, value in result.figures.items()]
    return "\n".join(lines)


def short(value: Any) -> str:
    """Six digits."""
    if isinstance(value, np.ndarray):
        return "(" + ", ".join(f"{v:.6g}" for v in np.ravel(value)) + ")"
    return value if isinstance(value, str) else f"{value:.6g}"
