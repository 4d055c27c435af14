"""Mutation of the core: changes one line at a time and asks whether the tests of the core notice.

    python bench/mutation.py [--count 2000] [--seed 1] [--jobs 2] [--only NAME | --again F] [--json F]

Mutants come from universalmutator's rules, a seeded sample over all sources and private headers of libins/core/src.
A mutant that does not compile, or whose objects equal the original's (a comment, an equivalent expression), counts as
no mutant. The others are linked with the tests' own objects (`build/release`, double) and run, the nearest tests first;
killed means that a test failed, crashed or took ten times the processor time.
"""

import argparse
import contextlib
import io
import json
import math
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from queue import Queue

from rich.progress import track
from universalmutator.mutator import mutants_regexp

ROOT = Path(__file__).resolve().parents[1]
CORE = ROOT / "libins" / "core"
BUILD = ROOT / "build" / "release"
FLAGS = ["-O1", "-std=c11", "-fPIC", "-ffp-contract=off", "-fvisibility=hidden", "-w", "-I../include"]
LINK = ["-lgtest_main", "-lgtest", "-lpthread", "-lm"]
RULES = ["universal.rules", "c_like.rules", "c.rules"]
KILLED_MIN = 0.90
TIMEOUT_FACTOR, TIMEOUT_MIN_S = 10.0, 3.0


@dataclass(frozen=True)
class Mutant:
    file: str
    line: int
    before: str
    after: str


@dataclass
class Outcome:
    uncompilable: int = 0
    equivalent: int = 0
    killed: int = 0
    survived: list[Mutant] = field(default_factory=list)


@dataclass(frozen=True)
class Test:
    name: str
    objects: list[str]
    seconds: float


def run(command: list[str], cwd: Path, timeout: float = 600.0) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run(command, cwd=cwd, capture_output=True, timeout=timeout, check=False)


def compile_object(folder: Path, source: str, out: str) -> bytes | None:
    done = run(["cc", *FLAGS, "-c", source, "-o", out], folder)
    return (folder / out).read_bytes() if done.returncode == 0 else None


def all_mutants(only: str | None) -> list[Mutant]:
    found = []
    for path in sorted((CORE / "src").iterdir()):
        if path.suffix not in (".c", ".h") or (only is not None and path.stem not in (only, f"{only}_internal")):
            continue
        lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
        with contextlib.redirect_stdout(io.StringIO()):
            mutants = mutants_regexp(
                lines, RULES, ignorePatterns=[r"^\s*//", r"^#include", r"^#(if|endif|else|error|define INS_\w+_H_)"]
            )
        found += [Mutant(path.name, m[0], lines[m[0] - 1].rstrip("\n"), m[1].rstrip("\n")) for m in mutants]
    return found


def stands_now(mutant: Mutant) -> Mutant:
    """The same change where its line stands today, the nearest if there are several."""
    lines = (CORE / "src" / mutant.file).read_text(encoding="utf-8").splitlines()
    places = [k + 1 for k, line in enumerate(lines) if line == mutant.before]
    if not places:
        sys.exit(f"{mutant.file}:{mutant.line} is no longer `{mutant.before.strip()}`: draw a new sample")
    return Mutant(mutant.file, min(places, key=lambda k: abs(k - mutant.line)), mutant.before, mutant.after)


class Core:
    """The sources as they are: who includes whom, the objects, and which test links which object."""

    def __init__(self, folder: Path) -> None:
        shutil.copytree(CORE / "src", folder / "src")
        shutil.copytree(CORE / "include", folder / "include")
        src = folder / "src"
        self.objects: dict[str, bytes] = {}
        self.users: dict[str, list[str]] = defaultdict(list)
        symbols: dict[str, str] = {}
        for path in sorted(src.glob("*.c")):
            made = compile_object(src, path.name, f"{path.stem}.o")
            assert made is not None, f"{path.name} does not compile"
            self.objects[path.name] = made
            for word in run(["cc", *FLAGS, "-MM", path.name], src).stdout.decode().split():
                if "/" not in word and word.endswith((".c", ".h")):
                    self.users[word].append(path.name)
            for line in run(["nm", "-g", "--defined-only", f"{path.stem}.o"], src).stdout.decode().splitlines():
                symbols[line.split()[-1]] = path.name
        self.archive = folder / "libcore.a"
        run(["ar", "rcs", str(self.archive), *(p.name for p in sorted(src.glob("*.o")))], src)
        self.tests_of: dict[str, list[Test]] = defaultdict(list)
        tests = []
        for program in sorted((BUILD / "tests" / "core").glob("test_*")):
            if program.suffix or not program.is_file() or program.name.endswith("_f32"):
                continue
            start = time.monotonic()
            done = run([str(program), "--gtest_brief=1"], folder)
            if done.returncode != 0:
                sys.exit(f"{program.name} fails before any mutation: build and test the release preset first")
            objects = sorted(str(o) for o in (program.parent / "CMakeFiles" / f"{program.name}.dir").rglob("*.o"))
            tests.append((program, Test(program.name, objects, time.monotonic() - start)))
        if not tests:
            sys.exit(f"no tests in {BUILD}: run cmake --build --preset release first")
        for program, test in sorted(tests, key=lambda t: t[1].seconds):
            linked = {line.split()[-1] for line in run(["nm", str(program)], folder).stdout.decode().splitlines()}
            for name in sorted({symbols[s] for s in linked if s in symbols}):
                self.tests_of[name].append(test)

    def tests(self, sources: list[str], near: str) -> list[Test]:
        """Those that link one of the sources; the ones named after the mutated file first, then the quick ones."""
        found = {test.name: test for source in sources for test in self.tests_of[source]}
        return sorted(found.values(), key=lambda t: (near not in t.name, t.seconds))


def judge(mutant: Mutant, core: Core, folder: Path) -> str:
    src = folder / "src"
    original = (CORE / "src" / mutant.file).read_text(encoding="utf-8")
    lines = original.splitlines(keepends=True)
    lines[mutant.line - 1] = mutant.after + "\n"
    (src / mutant.file).write_text("".join(lines), encoding="utf-8")
    try:
        changed = []
        for source in core.users[mutant.file]:
            made = compile_object(src, source, f"mutant_{Path(source).stem}.o")
            if made is None:
                return "uncompilable"
            if made != core.objects[source]:
                changed.append(source)
        if not changed:
            return "equivalent"
        objects = [f"mutant_{Path(source).stem}.o" for source in changed]
        near = mutant.file.split(".")[0].removesuffix("_internal").split("_")[0]
        for test in core.tests(changed, near):
            program = str(folder / "mutant")
            done = run(["c++", *test.objects, *objects, str(core.archive), *LINK, "-o", program], src)
            if done.returncode != 0:
                return "uncompilable"
            limit = math.ceil(max(TIMEOUT_MIN_S, TIMEOUT_FACTOR * test.seconds))
            command = ["prlimit", f"--cpu={limit}", program, "--gtest_brief=1", "--gtest_fail_fast"]
            if run(command, folder).returncode != 0:
                return "killed"
        return "survived"
    finally:
        (src / mutant.file).write_text(original, encoding="utf-8")


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--count", type=int, default=2000, help="mutants drawn, those that do not compile included")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--only", metavar="NAME", help="one module, as attitude")
    parser.add_argument(
        "--again", type=Path, metavar="F", help="the survivors of an earlier run's --json, after new tests"
    )
    parser.add_argument("--json", type=Path, metavar="F", help="write the counts and the survivors there")
    options = parser.parse_args()
    if options.again is not None:
        sample = [stands_now(Mutant(**m)) for m in json.loads(options.again.read_text(encoding="utf-8"))["survived"]]
        print(f"{len(sample)} that survived in {options.again}")
    else:
        everything = all_mutants(options.only)
        sample = random.Random(options.seed).sample(everything, min(options.count, len(everything)))
        print(f"seed {options.seed}: {len(sample)} of {len(everything)} mutants", flush=True)
    outcome = Outcome()
    with tempfile.TemporaryDirectory() as temporary:
        core = Core(Path(temporary) / "core")
        folders: Queue[Path] = Queue()
        for k in range(options.jobs):
            folder = Path(temporary) / str(k)
            shutil.copytree(CORE / "src", folder / "src")
            shutil.copytree(CORE / "include", folder / "include")
            folders.put(folder)

        def one(mutant: Mutant) -> str:
            folder = folders.get()
            try:
                return judge(mutant, core, folder)
            finally:
                folders.put(folder)

        with ThreadPoolExecutor(options.jobs) as pool:
            for mutant, result in track(zip(sample, pool.map(one, sample), strict=True), "mutants", len(sample)):
                if result == "survived":
                    outcome.survived.append(mutant)
                else:
                    setattr(outcome, result, getattr(outcome, result) + 1)
    real = outcome.killed + len(outcome.survived)
    share = outcome.killed / real if real else 0.0
    for mutant in sorted(outcome.survived, key=lambda m: (m.file, m.line)):
        print(f"survived {mutant.file}:{mutant.line}\n  - {mutant.before.strip()}\n  + {mutant.after.strip()}")
    print(f"{outcome.uncompilable} do not compile, {outcome.equivalent} give the same object")
    print(f"of {real} others {outcome.killed} killed: {share:.1%}")
    if options.json is not None:
        options.json.write_text(json.dumps(outcome, default=vars, indent=2) + "\n", encoding="utf-8")
    return 0 if share >= KILLED_MIN else 1


if __name__ == "__main__":
    sys.exit(main())
