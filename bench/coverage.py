"""Branch coverage of the core by the core's own tests.

    python bench/coverage.py [--jobs 2] [--json F]

Builds the preset `coverage` (gcc -O0 --coverage), runs tests/core and counts with gcovr, over the double library's
sources and private headers and q31's second build, by products of 16 bits. Every branch gcc makes of the C counts: no
branch, line or file is left out, marked or not. The branches never taken are listed; fewer than MINIMUM taken is
exit code 1.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BUILD = ROOT / "build" / "coverage"
OBJECTS = ("libins/core/CMakeFiles/ins_core.dir", "tests/core/CMakeFiles/test_q31_split.dir")
MINIMUM = 95.0  # %


@dataclass(frozen=True)
class Line:
    file: str
    number: int
    branches: int
    taken: int


def run(*command: str | Path) -> None:
    done = subprocess.run([str(word) for word in command], cwd=ROOT, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{done.stdout[-4000:]}{done.stderr[-4000:]}{command[0]} failed ({done.returncode}), see above")


def measure(jobs: int) -> list[Line]:
    if shutil.which("gcovr") is None:
        sys.exit("gcovr is missing: apt-get install gcovr")
    python = f"-DPython_EXECUTABLE={sys.executable}"
    run("cmake", "--preset", "coverage", python)
    run("cmake", "--build", "--preset", "coverage", "-j", str(jobs), "--target", "tests/core/all")
    for old in BUILD.rglob("*.gcda"):
        old.unlink()
    run("ctest", "--test-dir", BUILD / "tests" / "core", "-j", str(jobs), "--output-on-failure")
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "coverage.json"
        objects = [BUILD / name for name in OBJECTS]
        run("gcovr", "--no-markers", "--root", ROOT, "--filter", "libins/core/", "--json", out, *objects)
        files = json.loads(out.read_text(encoding="utf-8"))["files"]
    seen = {Path(file["file"]).name for file in files}
    missed = sorted(path.name for path in (ROOT / "libins/core/src").glob("*.c") if path.name not in seen)
    if missed:
        sys.exit(f"no count of {', '.join(missed)}: is it in libins/core/CMakeLists.txt, and does a test link it?")
    return [
        Line(file["file"], line["line_number"], len(line["branches"]), sum(b["count"] > 0 for b in line["branches"]))
        for file in files
        for line in file["lines"]
        if line["branches"]
    ]


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--json", type=Path, metavar="F", help="write the row for bench/run.py there")
    options = parser.parse_args()
    lines = measure(options.jobs)
    for line in lines:
        if line.taken < line.branches:
            print(f"{line.file}:{line.number}: {line.branches - line.taken} of {line.branches} branches never taken")
    branches, taken = sum(line.branches for line in lines), sum(line.taken for line in lines)
    percent = 100 * taken / branches
    print(f"{taken} of {branches} branches taken: {percent:.2f} %, minimum {MINIMUM:g} %")
    if options.json is not None:
        row = {"name": "core.branch_coverage", "value": percent, "unit": "%", "minimum": MINIMUM}
        rows = [{**row, "peer": None, "peer_value": None, "budget": None}]
        options.json.write_text(json.dumps(rows, indent=2) + "\n", encoding="utf-8")
    return 0 if percent >= MINIMUM else 1


if __name__ == "__main__":
    sys.exit(main())
