# SPDX-License-Identifier: MIT
"""Builds the target programs for one machine and number type, runs them, reads what they print (report.h, tape.h)."""

import functools
import hashlib
import struct
import subprocess
import sys
import threading
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from machines import CORE, MACHINES, NUMBER, WARNINGS, Machine, MachineError

ROOT = Path(__file__).resolve().parents[2]

HERE = ROOT / "tests/targets"
BUILD = ROOT / "build/targets"
OPTIMISATION = ("-O2",)
SEPARATE = ("arm920t",)
PROGRAMS = {
    "bits_attitude": ("bits_attitude", "attitude", "attitude_other", "octets"),
    "bits_navigation": ("bits_navigation", "navigation", "libm"),
    "bits_filters": ("bits_filters", "filters", "vehicle"),
    "vectors": (
        "vectors",
        "tape",
        "vectors_attitude",
        "vectors_navigation",
        "vectors_filters",
        "vectors_vehicle",
        "vectors_octets",
    ),
}


@dataclass
class Report:
    """What the programs of one machine printed."""

    same: dict[str, str] = field(default_factory=dict)
    near: dict[str, list[list[float]]] = field(default_factory=dict)
    vectors: dict[str, tuple[int, float, float]] = field(default_factory=dict)
    exits: dict[str, int] = field(default_factory=dict)


def number_of(pattern: str) -> float:
    value: float = struct.unpack(">d" if len(pattern) == 16 else ">f", bytes.fromhex(pattern))[0]
    return value


def read(program: str, printed: str, report: Report) -> None:
    for line in printed.splitlines():
        match line.rstrip(".").split():
            case ["same", name, *rest]:
                report.same[name] = " ".join(rest)
            case ["near", name, *words]:
                report.near.setdefault(name, []).append([number_of(word) for word in words])
            case ["vector", name, count, worst, limit]:
                report.vectors[name] = (int(count), number_of(worst), number_of(limit))
            case ["exit", code]:
                report.exits[program] = int(code)


@functools.cache
def table(shift: int | None = None) -> Path:
    """The C source of the reference vectors."""
    out = BUILD / f"tape_{'as_it_is' if shift is None else shift}.c"
    out.parent.mkdir(parents=True, exist_ok=True)
    extra = [] if shift is None else ["--shift", str(shift)]
    part = own(out)
    subprocess.run([sys.executable, HERE / "vectors_table.py", part, *extra], check=True, capture_output=True)
    return part.rename(out)


def own(out: Path) -> Path:
    """A name that no other thread writes to, until the file is whole."""
    return out.with_suffix(f".{threading.get_ident()}")


@functools.cache
def headers() -> bytes:
    found = sorted([*CORE.rglob("*.h"), *HERE.glob("*.h")])
    return b"".join(path.read_bytes() for path in found)


def unit(name: str, sources: Sequence[Path]) -> Path:
    """One translation unit of several sources: half the time of compiling each."""
    out = BUILD / "units" / f"{name}.c"
    out.parent.mkdir(parents=True, exist_ok=True)
    part = own(out)
    part.write_text("".join(f'#include "{source}"\n' for source in sources), encoding="utf-8")
    return part.rename(out)


def compiled(machine: Machine, name: str, sources: Sequence[Path], options: Sequence[str]) -> Path:
    """The object of these sources, compiled once for the same contents, compiler and options."""
    words = [machine.tool("gcc"), *machine.cpu, *options]
    key = headers() + "\n".join([*words, str(Path(words[0]).stat())]).encode()
    key += b"".join(source.read_bytes() for source in sources)
    out = BUILD / machine.name / f"{name}-{hashlib.sha256(key).hexdigest()[:16]}.o"
    if not out.exists():
        out.parent.mkdir(parents=True, exist_ok=True)
        part = own(out)
        machine.compile(unit(name, sources), part, [*options, f"-I{HERE}"])
        part.rename(out)
    return out


def core_objects(machine: Machine, options: Sequence[str]) -> list[Path]:
    """The core: source by source on the machine where each object is looked at, as one unit on the others."""
    sources = sorted((CORE / "src").glob("*.c"))
    if machine.name in SEPARATE:
        return [compiled(machine, source.stem, [source], options) for source in sources]
    return [compiled(machine, "core", sources, options)]


def build(machine: Machine, number: str, program: str, options: Sequence[str] = (), tape: Path | None = None) -> Path:
    flags = [*OPTIMISATION, *NUMBER[number], *options]
    port = "port_avr" if machine.name == "avr" else "port"
    parts = [HERE / f"{part}.c" for part in ("report", port, *PROGRAMS[program])]
    warnings = [w for w in WARNINGS if w != "-Wdouble-promotion" or machine.name != "avr"]  # double is float there
    objects = [*core_objects(machine, flags), compiled(machine, f"{program}_{port}", parts, [*flags, *warnings])]
    if program == "vectors":
        data = tape or table()
        objects.append(compiled(machine, data.stem, [data], flags))
    out = BUILD / machine.name / f"{program}-{hashlib.sha256(''.join(map(str, objects)).encode()).hexdigest()[:16]}.elf"
    if not out.exists():
        part = own(out)
        machine.connect(objects, part)
        part.rename(out)
    return out


def run(name: str, number: str) -> Report:
    """All programs on one machine."""
    machine = MACHINES[name]
    report = Report()
    for program in PROGRAMS:
        code, printed = machine.start(build(machine, number, program))
        read(program, printed, report)
        if report.exits.get(program) is None:
            raise MachineError(
                f"{name} {number} {program}: exit code {code} before its last line; it printed:\n{printed}"
            )
        if machine.name != "avr" and (code == 0) != (report.exits[program] == 0):
            raise MachineError(f"{name} {number} {program}: exit code {code}, but it printed {report.exits[program]}")
    return report
