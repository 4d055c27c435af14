"""Builds one libFuzzer target with clang's sanitizers and runs it a counted number of times from the committed corpus.

SPDX-License-Identifier: MIT

fuzz.py TARGET FOLDER
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
CORE = ROOT / "libins" / "core"
RUNS = 100_000
RUNS_BENCH = 20_000_000  # with INS_BENCH set
SEED = 1
LONGEST = 1024  # octets of an input
SOURCES = {
    "parsers": ["nmea", "gimu", "handshake_board", "handshake_host", "link_board", "link_host"]
    + ["nav_block", "quat", "rotvec"],
    "nmea": ["nmea"],
    "attitude": ["attitude", "attitude_any", "hist2", "sculling", "sculling_any", "coning", "quat", "rotvec", "q31"],
}
EMULATOR = {"wirelink": ["common/src/state", "f2812_sci/wirelink/wirelink"]}


def main() -> None:
    target, folder = sys.argv[1], Path(sys.argv[2])
    clang = shutil.which("clang")
    if clang is None:
        sys.exit("clang is missing; install it: sudo apt-get install --no-install-recommends clang libclang-rt-14-dev")
    program = folder / f"fuzz_{target}"
    sanitize = ["-fsanitize=fuzzer,address,undefined,bounds", "-fno-sanitize-recover=all"]
    options = ["-std=c11", "-g", "-O1", "-Wall", "-Wextra", "-Werror", f"-I{CORE}/include", f"-I{HERE.parent}/proof"]
    options += [f"-I{ROOT}/emu/common/include", f"-I{ROOT}/emu/f2812_sci/include"]
    sources = [CORE / "src" / f"{name}.c" for name in SOURCES.get(target, [])]
    sources += [ROOT / "emu" / f"{name}.c" for name in EMULATOR.get(target, [])]
    files = [str(HERE / f"fuzz_{target}.c"), *map(str, sources), "-lm"]
    subprocess.run([clang, *options, *sanitize, *files, "-o", str(program)], check=True)
    runs = RUNS_BENCH if os.environ.get("INS_BENCH") else RUNS
    corpus = HERE / "corpus" / target
    assert any(corpus.iterdir()), f"no corpus in {corpus}"
    with tempfile.TemporaryDirectory() as found:  # new inputs go there, not into the committed corpus
        limits = [f"-runs={runs}", f"-seed={SEED}", f"-max_len={LONGEST}", f"-artifact_prefix={folder}/"]
        command = [str(program), *limits, "-print_final_stats=1", found, str(corpus)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}\n{done.stderr[-8000:]}")
    assert f"Done {runs} runs" in done.stderr, done.stderr[-2000:]
    print(f"{target}: {runs} runs, seed {SEED}")


main()
