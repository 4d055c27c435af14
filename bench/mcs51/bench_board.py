# SPDX-License-Identifier: MIT
"""Host instructions of the whole board: a second of the default run, an edge of a pin, a snapshot (callgrind counts).

    bench_board.py --build BUILD [--json F]

BUILD holds bench_default_run, bench_board_edge, bench_step_back, bench_cpu.bin and the firmware. Start-up is
subtracted: each figure is the difference of two runs. Exit 1: a budget is exceeded.
"""

import argparse
import json
import re
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

# 2 % above what was measured (gcc 12.2).
BUDGETS = {
    "board.default.instructions_per_s": 13_160_000,
    "board.default.traced_instructions_per_s": 13_740_000,
    "board.edge.pin.instructions": 288.7,
    "board.edge.clock.instructions": 397.9,
    "board.save.instructions": 26_750,
    "board.restore.instructions": 59_650,
    "mcs51.step_back.instructions": 288_100,
}
Row = dict[str, object]


def callgrind(program: Path, *arguments: object) -> tuple[int, str]:
    """Host instructions, and what the program printed."""
    with tempfile.TemporaryDirectory() as folder:
        tool = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={folder}/out"]
        command = [*tool, str(program), *map(str, arguments)]
        try:
            done = subprocess.run(command, capture_output=True, text=True, check=True)
        except FileNotFoundError:
            sys.exit("bench_board: valgrind is missing: apt-get install --no-install-recommends valgrind")
        except subprocess.CalledProcessError as error:
            sys.exit(f"bench_board: {' '.join(command)} failed:\n{error.stdout}{error.stderr}")
    found = re.search(r"Collected : (\d+)", done.stderr)
    assert found, done.stderr
    return int(found[1]), done.stdout


def slope(run: Callable[[int], int], few: int, many: int) -> float:
    """What one more costs."""
    return (run(many) - run(few)) / (many - few)


def measure(build: Path) -> list[Row]:
    load, image = build / "bench/mcs51/bench_default_run", build / "firmware/acq_default.ihx"
    edge = build / "bench/mcs51/bench_board_edge"
    figures: dict[str, tuple[float, str]] = {}

    def put(name: str, value: float, unit: str) -> None:
        figures[name] = (value, unit)

    for name, more in (("", ()), ("traced_", ("trace",))):
        cost = slope(lambda n, more=more: callgrind(load, image, n, *more)[0], 1, 5)  # type: ignore[misc]
        put(f"board.default.{name}instructions_per_s", cost, "instructions/simulated s")
    for what in ("save", "restore"):
        cost = slope(lambda n, what=what: callgrind(load, image, 1, what, n)[0], 10, 110)  # type: ignore[misc]
        put(f"board.{what}.instructions", cost, "instructions")
    printed = callgrind(load, image, 1)[1]
    found = re.search(r"snapshot (\d+)", printed)
    assert found, printed
    put("board.snapshot.octets", float(found[1]), "octets")
    back, program = build / "bench/mcs51/bench_step_back", build / "tests/emu_8051/cpu/bench_cpu.bin"
    put("mcs51.step_back.instructions", slope(lambda n: callgrind(back, program, n)[0], 10, 110), "instructions")
    wall = subprocess.run([back, program, "1000"], capture_output=True, text=True, check=True).stdout.split()
    put("mcs51.step_back.mean_us", float(wall[3]), "us")
    ram = slope(lambda n: callgrind(edge, "ram", n)[0], 1000, 101000)
    for what in ("pin", "clock"):
        with_edges = slope(lambda n, what=what: callgrind(edge, what, n)[0], 1000, 101000)  # type: ignore[misc]
        few, many = (int(callgrind(edge, what, n)[1].split()[1]) for n in (1000, 101000))
        put(f"board.edge.{what}.instructions", (with_edges - ram) * 100000 / (many - few), "instructions")
    return [
        {"name": n, "value": round(v, 1), "unit": u, "peer": None, "peer_value": None, "budget": BUDGETS.get(n)}
        for n, (v, u) in figures.items()
    ]


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", type=Path, required=True)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    rows = measure(options.build)
    over = [r for r in rows if isinstance(r["budget"], (int, float)) and float(str(r["value"])) > r["budget"]]
    for r in rows:
        print(f"{r['name']}: {r['value']} {r['unit']}, budget {r['budget']}{'  EXCEEDED' if r in over else ''}")
    if options.json:
        options.json.write_text(json.dumps(rows, indent=2) + "\n", encoding="utf-8")
    return 1 if over else 0


if __name__ == "__main__":
    sys.exit(main())
