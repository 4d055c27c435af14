# SPDX-License-Identifier: MIT
"""Host instructions of the MCS-51 per emulated instruction and per machine cycle, beside uCsim's (callgrind counts).

    bench_mcs51.py --build BUILD [--json F]

BUILD holds mcs51_run_bin and the images of tests/data/bench. What a program spends before and after the run is
subtracted: ours by a run of no cycles, uCsim's by the difference of two shorter loads, because under callgrind the
whole one takes it an hour.
Exit 1: a budget is exceeded, or bench_cpu ends after other numbers of instructions or cycles than on uCsim.
"""

import argparse
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUDGET = {"bench_cpu": 28, "bench_board": 28}
UCSIM_N = (4, 24)


def need(name: str, package: str) -> str:
    path = shutil.which(name)
    if path is None:
        sys.exit(f"bench_mcs51: {name} is missing: apt-get install --no-install-recommends {package}")
    return path


def callgrind(folder: Path, *command: str, stdin: str = "") -> tuple[int, str]:
    """Host instructions, and what the program printed."""
    tool = [need("valgrind", "valgrind"), "--tool=callgrind", f"--callgrind-out-file={folder}/out"]
    done = subprocess.run([*tool, *command], input=stdin, capture_output=True, text=True, check=True)
    found = re.search(r"Collected : (\d+)", done.stderr)
    assert found, done.stderr
    return int(found[1]), done.stdout


def ours(folder: Path, build: Path, load: str, unit: str) -> float:
    tests = build / "tests/emu_8051/cpu"
    run, image = str(tests / "mcs51_run_bin"), str(tests / f"{load}.bin")
    whole, printed = callgrind(folder, run, image)
    start, _ = callgrind(folder, run, image, "0")
    found = re.search(rf"stop 1 .*{unit} (\d+)", printed)
    assert found, printed
    return (whole - start) / int(found[1])


def halt_of(folder: Path, load: str) -> str:
    found = re.search(r"([0-9A-F]{8})\s+_halt", (folder / f"{load}.map").read_text())
    assert found, f"no _halt in {load}.map"
    return found[1]


def console(folder: Path, load: str) -> str:
    """Run up to the halt loop."""
    image = folder / f"{load}.ihx"
    return f'set console noninteractive\nfile "{image}"\nbreak 0x{halt_of(folder, load)}\nrun\nstate\nquit\n'


def counts(printed: str) -> dict[str, int]:
    """uCsim's state as ours counts: without the instruction that it stops on."""
    found = re.search(r"Inst= (\d+)", printed), re.search(r"Total time since last reset= .*\((\d+) clks\)", printed)
    assert found[0] and found[1] and "(104) Breakpoint" in printed, printed
    return {"instructions": int(found[0][1]) - 1, "cycles": int(found[1][1]) // 12}


def ucsim(folder: Path, load: str, unit: str) -> float:
    """(host instructions of the longer load - the shorter) / (emulated of the longer - the shorter)"""
    sdcc, s51 = need("sdcc", "sdcc"), need("s51", "sdcc-ucsim")
    host, emulated = [], []
    for n in UCSIM_N:
        source = ROOT / "tests/data/bench" / f"{load}.c"
        command = [sdcc, "-mmcs51", "--model-small", f"-DN={n}", "-o", f"{load}.ihx", str(source)]
        subprocess.run(command, cwd=folder, check=True, capture_output=True)
        count, printed = callgrind(folder, s51, "-t", "51", stdin=console(folder, load))
        host.append(count)
        emulated.append(counts(printed)[unit])
    return (host[1] - host[0]) / (emulated[1] - emulated[0])


def same_counts(build: Path) -> bool:
    """bench_cpu whole, on both at full speed: instructions and cycles up to the halt loop."""
    tests = build / "tests/emu_8051/cpu"
    run = [str(tests / "mcs51_run_bin"), str(tests / "bench_cpu.bin")]
    printed = subprocess.run(run, capture_output=True, text=True, check=True).stdout
    mine = {unit: int(m[1]) for unit in ("instructions", "cycles") if (m := re.search(rf"{unit} (\d+)", printed))}
    command = [need("s51", "sdcc-ucsim"), "-t", "51"]
    stdin = console(tests, "bench_cpu")
    theirs = counts(subprocess.run(command, input=stdin, capture_output=True, text=True, check=True).stdout)
    print(f"mcs51.bench_cpu: ours {mine}, uCsim {theirs}{'' if mine == theirs else '  DIFFERENT'}")
    return mine == theirs


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", type=Path, required=True)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        for load, unit in (("bench_cpu", "instruction"), ("bench_board", "cycle")):
            value, peer = (f(*a, load, unit + "s") for f, a in ((ours, (folder, options.build)), (ucsim, (folder,))))
            budget = BUDGET[load]
            rows.append(
                {
                    "name": f"mcs51.{load}.host_per_{unit}",
                    "value": round(value, 2),
                    "unit": f"host instructions/{unit}",
                    "peer": "uCsim",
                    "peer_value": round(peer, 1),
                    "budget": budget,
                }
            )
            verdict = "" if value <= budget else "  EXCEEDED"
            name = rows[-1]["name"]
            print(f"{name}: {value:.2f} (uCsim {peer:.0f}, {peer / value:.0f} times), budget {budget}{verdict}")
    if options.json:
        options.json.write_text(json.dumps(rows, indent=2) + "\n", encoding="utf-8")
    return 0 if same_counts(options.build) and all(row["value"] <= row["budget"] for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main())
