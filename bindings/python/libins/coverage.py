"""Coverage of firmware by the instructions that ran, as lcov's tracefile (geninfo(1)).

A line is covered when any of its instructions ran. Branches are those of the machine's conditional jumps, not taken
and taken, in the line they were compiled from. Counts are 1 or 0: what is noted is the first execution.
"""

from collections import defaultdict
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from itertools import chain
from pathlib import Path
from typing import Any

from libins.cdb import Cdb
from libins.disasm import OPCODES
from libins.errors import UsageError

EXECUTED = 1
NOT_TAKEN = 2
TAKEN = 4
"""Marks of an address, as _run.coverage() gives them."""


@dataclass
class File:
    """What ran of one C file."""

    lines: dict[int, bool] = field(default_factory=dict)
    branches: dict[int, list[tuple[bool, bool] | None]] = field(default_factory=lambda: defaultdict(list))
    """Of each line's conditional jumps: not taken, taken; None where the jump never ran."""
    functions: list[tuple[int, str, bool]] = field(default_factory=list)
    """Line, name, whether it was entered."""


def measure(table: Cdb, marks: Any, code: Callable[[int], int]) -> dict[str, File]:
    """By the name of the C file. `marks` by address, `code` the code memory."""
    files: dict[str, File] = defaultdict(File)
    for instruction in table.asm_lines:
        mark = int(marks[instruction.address])
        lines = table.lines_at(instruction.address)
        for line in lines:
            covered = files[line.file].lines
            covered[line.number] = covered.get(line.number, False) or bool(mark & EXECUTED)
        if lines and OPCODES[code(instruction.address)].branches:
            taken = (bool(mark & NOT_TAKEN), bool(mark & TAKEN)) if mark & EXECUTED else None
            files[lines[-1].file].branches[lines[-1].number].append(taken)
    for function in table.functions:
        if lines := table.lines_at(function.begin):
            entered = bool(marks[function.begin] & EXECUTED)
            files[lines[0].file].functions.append((lines[0].number, function.name, entered))
    return dict(sorted(files.items()))


def totals(files: dict[str, File]) -> dict[str, int]:
    """Lines, branches and functions: all of them, and those covered."""
    jumps = [pair for f in files.values() for jumps in f.branches.values() for pair in jumps]
    return {
        "lines": sum(len(f.lines) for f in files.values()),
        "lines_covered": sum(sum(f.lines.values()) for f in files.values()),
        "branches": 2 * len(jumps),
        "branches_covered": sum(sum(pair) for pair in jumps if pair is not None),
        "functions": sum(len(f.functions) for f in files.values()),
        "functions_covered": sum(entered for f in files.values() for _, _, entered in f.functions),
    }


def instructions(marks: Any, code: Callable[[int], int]) -> dict[str, int]:
    """Without debug information: addresses that ran, and ways of the conditional jumps among them."""
    ran = [address for address, mark in enumerate(marks.tolist()) if mark & EXECUTED]
    jumps = [int(marks[address]) for address in ran if OPCODES[code(address)].branches]
    return {
        "instructions_covered": len(ran),
        "branches": 2 * len(jumps),
        "branches_covered": sum(bool(mark & NOT_TAKEN) + bool(mark & TAKEN) for mark in jumps),
    }


def ranges(numbers: Iterable[int]) -> str:
    """3, 4, 5, 9 as "3-5, 9"."""
    found: list[list[int]] = []
    for number in sorted(numbers):
        if found and number == found[-1][1] + 1:
            found[-1][1] = number
        else:
            found.append([number, number])
    return ", ".join(str(a) if a == b else f"{a}-{b}" for a, b in found)


def sources(table: Cdb, folders: list[Path]) -> dict[str, Path]:
    """Where each C file is: as the table says, or the first of that name in the folders or below. Raises UsageError."""
    found: dict[str, Path] = {}
    for name in table.files():
        known = [path for path in [table.paths.get(name)] if path is not None and path.is_absolute()]
        below = (path for folder in folders for path in sorted(folder.rglob(name)) if path.is_file())
        path = next(chain(known, below), None)
        if path is None:
            raise UsageError(f"{name}: not found in {', '.join(map(str, folders))}; give its folder with --source")
        found[name] = path.resolve()
    return found


def lcov(files: dict[str, File], paths: dict[str, Path]) -> str:
    """The tracefile."""
    out = ["TN:"]
    for name, file in files.items():
        functions = sorted(file.functions)
        out.append(f"SF:{paths[name]}")
        out += [f"FN:{line},{function}" for line, function, _ in functions]
        out += [f"FNDA:{int(entered)},{function}" for _, function, entered in functions]
        out += [f"FNF:{len(functions)}", f"FNH:{sum(entered for _, _, entered in functions)}"]
        branches = hits = 0
        for line, jumps in sorted(file.branches.items()):
            for block, pair in enumerate(jumps):
                for branch in range(2):
                    out.append(f"BRDA:{line},{block},{branch},{'-' if pair is None else int(pair[branch])}")
                    branches += 1
                    hits += pair is not None and pair[branch]
        out += [f"BRF:{branches}", f"BRH:{hits}"]
        out += [f"DA:{line},{int(covered)}" for line, covered in sorted(file.lines.items())]
        out += [f"LF:{len(file.lines)}", f"LH:{sum(file.lines.values())}", "end_of_record"]
    return "\n".join(out) + "\n"
