"""What the tests of campaigns share: a campaign's scenario, the command as a process, its files and its children."""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

from conftest import SCENARIOS

PLAN = """
[campaign]
link.bit_error = { uniform = [0.0, 1e-3] }
link.baud = { normal = [9600, 120] }
clock_hz = { uniform = [11_000_000, 11_100_000] }
firmware = { list = ["acq_default.ihx", "acq_80ms_seq.ihx"] }
motion = { choice = [{ kind = "still" }, { kind = "coning", half_angle_rad = 0.1, frequency_hz = 2.0 }] }
nav.sequence = { chance = 0.7 }
"""
TABLES = ("table.csv", "table.parquet", "index.html")


def write(folder: Path, plan: str = PLAN, stop_s: float = 0.3, name: str = "varied.toml") -> Path:
    """A campaign over the default scenario, without its bounds on the accuracy."""
    text = (SCENARIOS / "default.toml").read_text(encoding="utf-8").replace("stop_s = 24.0", f"stop_s = {stop_s}")
    path = folder / name
    path.write_text(text.replace("at_most = 3e-3", "at_most = 0.2") + plan, encoding="utf-8")
    return path


def start(*arguments: object) -> "subprocess.Popen[str]":
    command = [sys.executable, "-m", "libins", "campaign", *map(str, arguments)]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True)


def tables(folder: Path) -> dict[str, bytes]:
    return {name: (folder / name).read_bytes() for name in TABLES}


def rows(folder: Path) -> list[dict[str, Any]]:
    """The finished runs, in the order they came."""
    lines = (folder / "rows.jsonl").read_text(encoding="utf-8").split("\n")
    return [json.loads(line) for line in lines[1:-1]]


def children(pid: int) -> list[int]:
    """Processes that a process started and that still are."""
    found = []
    for task in Path(f"/proc/{pid}/task").iterdir():
        found += [int(child) for child in (task / "children").read_text().split()]
    return found


def alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return "\nState:\tZ" not in Path(f"/proc/{pid}/status").read_text()
