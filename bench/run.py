"""`./dev bench`: instruction counts against peers and budgets, then the suite at the counts too long for `./dev test`.

    ./dev bench [--json F] [--no-long]

A figure above its budget or below its minimum, or a long test that fails, makes the exit code 1.
"""

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BUILD = ROOT / "build/release"
# 2 % above what was measured (gcc 12.2, -O2).
BUDGETS = {
    "attitude.hist2.f64.x86.instructions": 129.5,
    "attitude.hist2.f32.x86.instructions": 116.3,
    "sculling.f64.x86.instructions": 206,
    "sculling.f32.x86.instructions": 188.7,
    "strapdown.step.f64.x86.instructions": 488,
    "strapdown.step.f32.x86.instructions": 459,
    "kf15.propagate.f64.x86.instructions": 3527,
    "kf15.propagate.f32.x86.instructions": 2804,
    "kf15.update6.f64.x86.instructions": 6242,
    "kf15.update6.f32.x86.instructions": 3880,
    "kf15.lever6.f64.x86.instructions": 8298,
    "kf15.lever6.f32.x86.instructions": 5357,
    "kf15_ud.propagate.f64.x86.instructions": 13885,
    "kf15_ud.propagate.f32.x86.instructions": 10231,
    "kf15_ud.update6.f64.x86.instructions": 6484,
    "kf15_ud.update6.f32.x86.instructions": 5288,
    "gps_ins.step.f64.x86.instructions": 4019,
    "gps_ins.step.f32.x86.instructions": 3286,
    "gps_ins.gnss.f64.x86.instructions": 11590,
    "gps_ins.gnss.f32.x86.instructions": 9154,
    "gps_ins.gnss_late.f64.x86.instructions": 17563,
    "gps_ins.gnss_late.f32.x86.instructions": 14367,
    "gps_ins_scale.step.f64.x86.instructions": 8809,
    "gps_ins_scale.step.f32.x86.instructions": 8043,
    "gps_ins_scale.gnss_late.f64.x86.instructions": 30110,
    "gps_ins_scale.gnss_late.f32.x86.instructions": 26513,
    "gps_dr.step.f64.x86.instructions": 6844,
    "gps_dr.step.f32.x86.instructions": 6687,
    "gps_dr.fix.f64.x86.instructions": 18043,
    "gps_dr.fix.f32.x86.instructions": 17810,
    "batch.f64.x86_64_v3.instructions": 27.5,
    "batch.f32.x86_64_v3.instructions": 12.97,
    "dds.publish.instructions": 8875,
    "dds.publish.ratio": 1.25,
}
# Name, load, function counted from its entry to its return, steps of the two runs, updates a step, the same with Eigen.
CORE = (
    ("attitude.hist2.f64.x86", "attitude_f64", "ins_attitude_step", (1000, 11000), 1, "eigen_attitude_f64"),
    ("attitude.hist2.f32.x86", "attitude_f32", "ins_attitude_step", (1000, 11000), 1, "eigen_attitude_f32"),
    ("sculling.f64.x86", "sculling_f64", "ins_sculling_step", (1000, 11000), 1, "eigen_sculling"),
    ("sculling.f32.x86", "sculling_f32", "ins_sculling_step", (1000, 11000), 1, None),
    ("strapdown.step.f64.x86", "strapdown_f64", "ins_strapdown_step", (1000, 11000), 1, "eigen_strapdown"),
    ("strapdown.step.f32.x86", "strapdown_f32", "ins_strapdown_step", (1000, 11000), 1, None),
    *(
        (f"{form}.{what}.{number}.x86", f"kf15_{number}", f"bench_{form}_{what}", (20, 220), 1, peer)
        for form in ("kf15", "kf15_ud")
        for number in ("f64", "f32")
        for what, peer in (
            ("propagate", "eigen_kf15_propagate" if number == "f64" else None),
            ("update6", "eigen_kf15_update6" if number == "f64" else None),
        )
    ),
    ("kf15.lever6.f64.x86", "kf15_f64", "bench_kf15_lever6", (20, 220), 1, "eigen_kf15_update6"),
    ("kf15.lever6.f32.x86", "kf15_f32", "bench_kf15_lever6", (20, 220), 1, None),
    ("gps_ins.step.f64.x86", "gps_ins_f64", "ins_gps_ins_step", (50, 150), 20, "eigen_kf15_propagate"),
    ("gps_ins.step.f32.x86", "gps_ins_f32", "ins_gps_ins_step", (50, 150), 20, None),
    ("gps_ins.gnss.f64.x86", "gps_ins_f64", "ins_gps_ins_gnss", (50, 150), 1, "eigen_kf15_update6"),
    ("gps_ins.gnss.f32.x86", "gps_ins_f32", "ins_gps_ins_gnss", (50, 150), 1, None),
    ("gps_ins.gnss_late.f64.x86", "gps_ins_late_f64", "ins_gps_ins_gnss", (50, 150), 1, "eigen_kf15_update6"),
    ("gps_ins.gnss_late.f32.x86", "gps_ins_late_f32", "ins_gps_ins_gnss", (50, 150), 1, None),
    ("gps_ins_scale.step.f64.x86", "gps_ins_scale_f64", "ins_gps_ins_step", (50, 150), 20, "eigen_kf21_propagate"),
    ("gps_ins_scale.step.f32.x86", "gps_ins_scale_f32", "ins_gps_ins_step", (50, 150), 20, None),
    ("gps_ins_scale.gnss_late.f64.x86", "gps_ins_scale_f64", "ins_gps_ins_gnss", (50, 150), 1, "eigen_kf21_update6"),
    ("gps_ins_scale.gnss_late.f32.x86", "gps_ins_scale_f32", "ins_gps_ins_gnss", (50, 150), 1, None),
    ("gps_dr.step.f64.x86", "gps_dr_f64", "ins_gps_dr_step", (100, 300), 10, None),
    ("gps_dr.step.f32.x86", "gps_dr_f32", "ins_gps_dr_step", (100, 300), 10, None),
    ("gps_dr.fix.f64.x86", "gps_dr_f64", "ins_gps_dr_fix", (100, 300), 1, None),
    ("gps_dr.fix.f32.x86", "gps_dr_f32", "ins_gps_dr_fix", (100, 300), 1, None),
    ("batch.f64.x86_64_v3", "batch_f64", "ins_batch_step", (100, 300), 256, None),
    ("batch.f32.x86_64_v3", "batch_f32", "ins_batch_step", (100, 300), 256, None),
)
Row = dict[str, object]


def row(name: str, value: float, unit: str) -> Row:
    return {"name": name, "value": value, "unit": unit, "peer": None, "peer_value": None, "budget": BUDGETS.get(name)}


def callgrind(program: Path, argument: int, function: str | None) -> int:
    """Instructions of one run, or those from each entry of a function to its return."""
    with tempfile.TemporaryDirectory() as folder:
        command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={folder}/out"]
        command += [f"--toggle-collect={function}"] if function else []
        done = subprocess.run([*command, str(program), str(argument)], capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{program.name} {argument} failed:\n{done.stdout}{done.stderr}")
    found = re.search(r"Collected : (\d+)", done.stderr)
    assert found, done.stderr
    return int(found[1])


def per_step(program: str, few: int, many: int, function: str | None = None) -> float:
    path = BUILD / "bench" / program
    return (callgrind(path, many, function) - callgrind(path, few, function)) / (many - few)


def measure_core() -> list[Row]:
    """Steps alone, beside Eigen's; then what a step costs with the loop of the load around it."""
    rows = []
    for name, load, function, runs, updates, eigen in CORE:
        alone = row(f"{name}.instructions", per_step(f"core/bench_{load}", *runs, function) / updates, "instructions")
        covariance = load.startswith(("kf15", "gps_"))
        if eigen:
            peer = "core/bench_eigen_kf15" if covariance else "core/bench_eigen"
            alone |= {"peer": "Eigen", "peer_value": per_step(peer, 100, 300, eigen)}
        if covariance:
            rows.append(alone)
            continue
        whole = row(f"{name}.with_loop", per_step(f"core/bench_{load}", *runs) / updates, "instructions")
        rows += [alone] if updates > 1 else [alone, whole]
    return rows


def measure_dds() -> list[Row]:
    """A publication beside a dds_write() of the same message; latencies and stalls by the wall clock."""
    ours = per_step("dds/bench_dds_publish", 100, 1100)
    raw = per_step("dds/bench_dds_raw", 100, 1100)
    rows = [
        row("dds.publish.instructions", ours, "instructions") | {"peer": "Cyclone DDS", "peer_value": raw},
        row("dds.publish.ratio", ours / raw, "of a dds_write"),
    ]
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "latency.json"
        script = ROOT / "bench/dds/latency.py"
        subprocess.run([sys.executable, script, "--build", BUILD, "--json", out], check=True)
        return rows + json.loads(out.read_text())


def measure() -> list[Row]:
    rows = [
        *measure_core(),
        *measure_dds(),
    ]
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "s.json"
        command = [sys.executable, "-m", "libins", "run", "default", "--json", out]
        subprocess.run(command, check=True, capture_output=True)
        rows.append(row("mcs51.default.sim_per_wall", json.loads(out.read_text())["speed"], "simulated/wall"))
        mcs51 = Path(folder) / "mcs51.json"
        script = ROOT / "bench/mcs51/bench_mcs51.py"
        done = subprocess.run([sys.executable, script, "--build", BUILD, "--json", mcs51])
        if not mcs51.exists():
            raise SystemExit(f"{script.name} gave no figures (exit code {done.returncode})")
        rows += json.loads(mcs51.read_text())
        board = Path(folder) / "board.json"
        script = ROOT / "bench/mcs51/bench_board.py"
        done = subprocess.run([sys.executable, script, "--build", BUILD, "--json", board])
        if not board.exists():
            raise SystemExit(f"{script.name} gave no figures (exit code {done.returncode})")
        rows += json.loads(board.read_text())
        f2812 = Path(folder) / "f2812.json"
        script = ROOT / "bench/f2812/bench_f2812.py"
        done = subprocess.run([sys.executable, script, "--build", BUILD, "--json", f2812])
        if not f2812.exists():
            raise SystemExit(f"{script.name} gave no figures (exit code {done.returncode})")
        rows += json.loads(f2812.read_text())
        calib = Path(folder) / "calib.json"
        script = ROOT / "bench/calib/bench_calib.py"
        done = subprocess.run([sys.executable, script, "--json", calib])
        if not calib.exists():
            raise SystemExit(f"{script.name} gave no figures (exit code {done.returncode})")
        rows += json.loads(calib.read_text())
        targets = Path(folder) / "targets.json"
        subprocess.run([sys.executable, ROOT / "bench/targets/measure.py", "--json", targets], check=True)
        rows += json.loads(targets.read_text())
        coverage = Path(folder) / "coverage.json"
        done = subprocess.run([sys.executable, ROOT / "bench/coverage.py", "--json", coverage])
        if not coverage.exists():
            raise SystemExit(f"coverage.py gave no figure (exit code {done.returncode})")
        rows += json.loads(coverage.read_text())
    return rows


def show(rows: list[Row]) -> bool:
    """Print the table. True when every budget and every minimum is kept."""
    kept = True
    for r in rows:
        value, budget, minimum, peer = r["value"], r["budget"], r.get("minimum"), r["peer_value"]
        over = isinstance(budget, (int, float)) and isinstance(value, (int, float)) and value > budget
        under = isinstance(minimum, (int, float)) and isinstance(value, (int, float)) and value < minimum
        kept = kept and not over and not under
        beside = f"   {r['peer']} {peer:.6g}" if isinstance(peer, (int, float)) else ""
        limit = f"   budget {budget:g}{' EXCEEDED' if over else ''}" if isinstance(budget, (int, float)) else ""
        limit += f"   minimum {minimum:g}{' MISSED' if under else ''}" if isinstance(minimum, (int, float)) else ""
        print(f"{r['name']:<44} {value:>12.6g} {r['unit']}{beside}{limit}")
    return kept


def main() -> int:
    parser = argparse.ArgumentParser(prog="./dev bench", description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--json", type=Path, metavar="F", help="write the figures there")
    parser.add_argument("--no-long", action="store_true", help="measure only")
    options = parser.parse_args()
    rows = measure()
    kept = show(rows)
    if options.json is not None:
        options.json.write_text(json.dumps(rows, indent=2) + "\n", encoding="utf-8")
    if options.no_long:
        return 0 if kept else 1
    environment = {**os.environ, "INS_BENCH": "1"}
    long = subprocess.run(["ctest", "--preset", "release", "--output-on-failure"], cwd=ROOT, env=environment)
    tests = [path for room in ("system", "view") for path in sorted((ROOT / "tests" / room).glob("test_*.py"))]
    counted = [path for path in tests if "INS_BENCH" in path.read_text()]
    system = subprocess.run([sys.executable, "-m", "pytest", "-q", *counted], cwd=ROOT, env=environment)
    mutation = subprocess.run([sys.executable, ROOT / "bench/mutation.py"])
    planted = subprocess.run([sys.executable, ROOT / "bench/f2812/mutants.py"])
    proof = subprocess.run([sys.executable, ROOT / "tests/proof/prove.py"])
    return 0 if kept and all(part.returncode == 0 for part in (long, system, mutation, planted, proof)) else 1


if __name__ == "__main__":
    sys.exit(main())
