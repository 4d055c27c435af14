"""Planted bugs of the F2812's device and SCI: the tests of tests/emu_f2812 find each of them.

    python bench/f2812/mutants.py [NAME...]

Each table of mutants*.toml is one wrong line: `file` below emu/f2812_sci, the text `before` that is there once, the
text `after` that takes its place, and the `rule` that it breaks, as docs/f2812.md says it. The changed file is compiled
and linked with the objects of test_f2812, or test_f2812_shim for shim/, as the release preset built them. A row that
no longer fits, does not compile or is found by no test makes the exit code 1.
"""

import argparse
import re
import subprocess
import sys
import tempfile
import tomllib
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
ROOM = ROOT / "emu/f2812_sci"
BUILD = ROOT / "build/release"
TESTS = BUILD / "tests/emu_f2812/CMakeFiles"
PROGRAMS = ("cases", "echo", "loopback_fifo", "autobaud", "modem")
FIRMWARE = [BUILD / f"firmware/{name}.64.o" for name in PROGRAMS]
SHIM = BUILD / "emu/f2812_sci/libf2812_shim.a"
ARCHIVES = [BUILD / "emu/f2812_sci/libemu_f2812.a", BUILD / "emu/common/libemu_common.a"]
FLAGS = ["-O1", "-std=c11", "-w", "-I", str(ROOM / "include"), "-I", str(ROOT / "emu/common/include")]
LIBRARIES = ["-lgtest_main", "-lgtest", "-lpthread"]
CPU_LIMIT_S = 30  # a mutant may never end


@dataclass(frozen=True)
class Mutant:
    name: str
    rule: str
    file: str
    before: str
    after: str


def run(*command: object, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    return subprocess.run([str(word) for word in command], cwd=cwd, capture_output=True, text=True, check=False)


def failed_tests(objects: list[Path], folder: Path, shim: bool) -> list[str]:
    """Tests that fail when these objects stand before the library's; also what a program that dies was at."""
    program = folder / "test"
    tests = TESTS / ("test_f2812_shim.dir" if shim else "test_f2812.dir")
    more = [*FIRMWARE, *objects, SHIM] if shim else objects
    linked = run("c++", *sorted(tests.glob("*.o")), *more, *ARCHIVES, *LIBRARIES, "-o", program)
    if linked.returncode != 0:
        sys.exit(f"does not link; build test_f2812 and test_f2812_shim of the release preset first\n{linked.stderr}")
    done = run("prlimit", f"--cpu={CPU_LIMIT_S}", program, "--gtest_color=no", cwd=folder)
    failed = re.findall(r"^\[  FAILED  \] (\w+\.\w+) \(", done.stdout, re.MULTILINE)
    if done.returncode != 0 and not failed:
        failed = re.findall(r"^\[ RUN      \] (\w+\.\w+)$", done.stdout, re.MULTILINE)[-1:]
    return failed


def plant(mutant: Mutant, folder: Path) -> str:
    """What is wrong with a row, or the tests that found it."""
    source = ROOM / mutant.file
    text = source.read_text(encoding="utf-8")
    if text.count(mutant.before) != 1:
        return f"WRONG: `{mutant.before}` is in {mutant.file} {text.count(mutant.before)} times"
    changed = folder / "changed.c"
    changed.write_text(text.replace(mutant.before, mutant.after), encoding="utf-8")
    made = run("cc", *FLAGS, "-iquote", source.parent, "-c", changed, "-o", folder / "changed.o")
    if made.returncode != 0:
        return f"WRONG: does not compile\n{made.stderr}"
    found = failed_tests([folder / "changed.o"], folder, mutant.file.startswith("shim/"))
    return f"{len(found)} tests, as {found[0]}" if found else "SURVIVED"


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help="rows of mutants*.toml; all without one")
    names = parser.parse_args().names
    table: dict[str, dict[str, str]] = {}
    for path in sorted(HERE.glob("mutants*.toml")):
        table |= tomllib.loads(path.read_text(encoding="utf-8"))
    mutants = [Mutant(name=name, **row) for name, row in table.items() if not names or name in names]
    unknown = set(names) - set(table)
    if unknown:
        parser.error(f"mutants*.toml have no {', '.join(sorted(unknown))}")
    bad = 0
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        failed = failed_tests([], folder, False) + failed_tests([], folder, True)
        if failed:
            sys.exit(f"{failed[0]} fails before any bug is planted: build both programs of the release preset first")
        for mutant in mutants:
            result = plant(mutant, folder)
            bad += result.startswith(("WRONG", "SURVIVED"))
            print(f"{mutant.name:<28} {result}", flush=True)
    print(f"{len(mutants) - bad} of {len(mutants)} planted bugs found")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
