# SPDX-License-Identifier: MIT
"""What firmware costs on the emulated F2812: host instructions a register access, simulated seconds a host second.

    bench_f2812.py --build BUILD [--json F]

BUILD holds the runtime of f2812-cc. An access is the slope over rounds of a hundred, less the same rounds without them
and less the one instruction that a plain volatile access is. Speeds are over processor time, so that they do not depend
on what else runs. Exit 1: a budget is exceeded or a minimum missed.
"""

import argparse
import json
import re
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
F2812_CC = ROOT / "emu/f2812_sci/f2812-cc"
FIRMWARE = ROOT / "bench/f2812/firmware"
ACCESSES = 100
ROUNDS = (100, 1100)
SIM_S = 5.0
# KIND of firmware/access.c, the kind with all but the accesses, budget. Of the writes only txbuf's changes anything; a
# field's cost includes the two instructions that change its word.
ACCESS_KINDS = {
    "sci.access": (1, 0, 80.0),
    "sci.access.write": (2, 0, 80.0),
    "sci.access.field": (3, 0, 82.0),
    "sci.access.write.ctl1": (4, 0, 80.0),
    "sci.access.write.fftx": (5, 0, 160.0),
    "sci.access.write.ffrx": (6, 0, 160.0),
    "pie.access.write.ack": (7, 0, 105.0),
    "gpio.access.write.dat": (8, 0, 120.0),
    "sci.access.write.txbuf": (9, 10, 160.0),
}
BUDGETS = {f"{what}.host_instructions": budget for what, (_, _, budget) in ACCESS_KINDS.items()}
MINIMA = {
    "f2812.interrupts_19200.sim_per_cpu": 10.0,
    "f2812.polling.sim_per_cpu": 2.0,
    "f2812.polling.executed.sim_per_cpu": 2.0,
}
Row = dict[str, object]


def compiled(build: Path, out: Path, source: str, bits: int, **defines: int) -> Path:
    flags = [f"-D{name}={value}" for name, value in defines.items()]
    command = [F2812_CC, "--lib", build / "f2812", f"-m{bits}", *flags, FIRMWARE / source, "-o", out]
    subprocess.run(command, check=True)
    return out


def callgrind(folder: Path, program: Path) -> int:
    command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={folder}/out", program]
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=True)
    except FileNotFoundError:
        sys.exit("bench_f2812: valgrind is missing: apt-get install --no-install-recommends valgrind")
    found = re.search(r"Collected : (\d+)", done.stderr)
    assert found and '"main() returned"' in done.stdout, done.stdout + done.stderr
    return int(found[1])


def per_round(folder: Path, build: Path, kind: int) -> float:
    counts = [
        callgrind(folder, compiled(build, folder / "access.f2812", "access.c", 64, KIND=kind, N=n)) for n in ROUNDS
    ]
    return (counts[1] - counts[0]) / (ROUNDS[1] - ROUNDS[0])


def speed(program: Path, *options: object) -> float:
    """Simulated seconds a second of processor time; the program must not stop by itself."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = [program, "--stop-s", SIM_S, *options]
    said = subprocess.run([*map(str, command)], capture_output=True, text=True, check=True).stdout
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    result = json.loads(said)
    assert result["ended"] is None and not result["reports"], said
    spent = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
    return float(result["sim_s"]) / spent


def measure(build: Path) -> list[Row]:
    figures: dict[str, tuple[float, str]] = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        rest = {kind: per_round(folder, build, kind) for kind in {without for _, without, _ in ACCESS_KINDS.values()}}
        for what, (kind, without, _) in ACCESS_KINDS.items():
            cost = (per_round(folder, build, kind) - rest[without]) / ACCESSES - 1
            figures[f"{what}.host_instructions"] = (cost, "instructions")
        interrupts = compiled(build, folder / "interrupts.f2812", "line.c", 32, POLLING=0)
        polling = compiled(build, folder / "polling.f2812", "line.c", 32, POLLING=1)
        unit = "simulated/processor"
        figures["f2812.interrupts_19200.sim_per_cpu"] = (speed(interrupts), unit)
        figures["f2812.polling.sim_per_cpu"] = (speed(polling), unit)
        figures["f2812.polling.executed.sim_per_cpu"] = (speed(polling, "--no-skip"), unit)
        figures["f2812.modem.sim_per_cpu"] = (speed(build / "firmware/modem.f2812"), unit)
    return [
        {"name": n, "value": round(v, 2), "unit": u, "peer": None, "peer_value": None, "budget": BUDGETS.get(n)}
        | ({"minimum": MINIMA[n]} if n in MINIMA else {})
        for n, (v, u) in figures.items()
    ]


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", type=Path, required=True)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    rows = measure(options.build)
    missed = 0
    for r in rows:
        value, budget, minimum = float(str(r["value"])), r["budget"], r.get("minimum")
        bad = (isinstance(budget, float) and value > budget) or (isinstance(minimum, float) and value < minimum)
        missed += bad
        print(f"{r['name']}: {value} {r['unit']}, budget {budget}, minimum {minimum}{'  MISSED' if bad else ''}")
    if options.json:
        options.json.write_text(json.dumps(rows, indent=2) + "\n", encoding="utf-8")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
