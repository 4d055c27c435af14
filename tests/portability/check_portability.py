"""The core against the rules of machines it is not built on in CI: octets and int of 16 bits, an 8051, gcc's analyzer.

SPDX-License-Identifier: MIT

check_portability.py CHECK FOLDER [CC]
"""

import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).resolve().parent
CORE = ROOT / "libins" / "core"
SOURCES = sorted((CORE / "src").glob("*.c"))
NUMBERS = ([], ["-DINS_REAL_FLOAT"])
WARNINGS = ["-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror", f"-I{CORE}/include"]
PARSERS = [
    "handshake_board",
    "handshake_host",
    "link_board",
    "link_host",
    "gimu",
    "nmea",
    "nav_block",
    "quat",
    "rotvec",
]
# (file, a mask of an octet that comes in, the same without it): each must change the transcript of dirty octets.
MASKS = [
    ("handshake_board.c", "octet = block[i] & 0xFFu;", "octet = block[i];"),
    ("handshake_board.c", "octet &= 0xFFu;", ""),
    ("handshake_host.c", "octet &= 0xFFu;", ""),
    ("handshake_host.c", "(block[2 * i] & 0x0Fu)", "block[2 * i]"),
    ("handshake_host.c", "(block[2 * i + 1] & 0xFFu)", "block[2 * i + 1]"),
    ("link_board.c", "seq & 0xFFu;", "seq;"),
    ("link_board.c", "block[i] & 0xFFu;", "block[i];"),
    ("link_board.c", "octet &= 0xFFu;", ""),
    ("link_host.c", "octet &= 0xFFu;", ""),
    ("gimu.c", "octet & 0xFFu;", "octet;"),
    ("nmea.c", "octet &= 0xFFu;", ""),
    ("nav_block.c", "(at[i] & 0xFFu);", "at[i];"),
    ("nav_block.c", "(block[0] & 0xFFu) >> 2", "block[0] >> 2"),
    ("nav_block.c", "nav->sats = block[1] & 0xFFu;", "nav->sats = block[1];"),
    ("nav_block.c", "nav->fix_age = block[31] & 0xFFu;", "nav->fix_age = block[31];"),
]


def tool(name: str, package: str) -> str:
    found = shutil.which(name)
    if found is None:
        sys.exit(f"{name} is missing; install it: sudo apt-get install --no-install-recommends {package}")
    return found


def run_all(commands: list[list[str]]) -> list[str]:
    """Run each, two at a time; their outputs, or the end of the program with the first that fails."""
    assert commands
    with ThreadPoolExecutor(2) as pool:
        done = list(pool.map(lambda c: subprocess.run(c, capture_output=True, text=True, check=False), commands))
    for command, result in zip(commands, done, strict=True):
        if result.returncode != 0:
            sys.exit(f"{' '.join(command)}\n{result.stdout}{result.stderr}")
    return [result.stdout for result in done]


def each(command: list[str], numbers: tuple[list[str], ...] = NUMBERS) -> None:
    run_all([[*command, *number, str(source)] for number in numbers for source in SOURCES])


def no_octet_type(folder: Path, cc: str) -> None:
    """A stdint.h without 8-bit types."""
    own = run_all([[cc, "-print-file-name=include"]])[0].strip()  # float.h, stddef.h
    shim = ["-nostdinc", "-isystem", str(HERE / "shim16"), "-isystem", own, "-fsyntax-only"]
    each([cc, *WARNINGS, "-Wsign-conversion", "-Wdouble-promotion", *shim])
    bad = folder / "octet_type.c"
    bad.write_text("#include <stdint.h>\nuint8_t octet;\n", encoding="utf-8")
    assert subprocess.run([cc, *shim, str(bad)], capture_output=True).returncode != 0, "the shim has a uint8_t"


def transcript(folder: Path, cc: str, wide: bool, fault: tuple[str, str, str] | None = None) -> str:
    """What octets.c says, dirty if octets are wide."""
    files = []
    for name in PARSERS:
        path = CORE / "src" / f"{name}.c"
        if fault and fault[0] == path.name:
            text = path.read_text(encoding="utf-8")
            assert fault[1] in text, f"{fault[0]} has no {fault[1]!r} to break: bring the list of masks up to date"
            path = folder / path.name
            path.write_text(text.replace(fault[1], fault[2], 1), encoding="utf-8")
        files.append(str(path))
    program = folder / f"octets_{'wide' if wide else 'narrow'}"
    octets = ["-include", str(HERE / "wide_octets.h")] if wide else []
    options = ["-std=c11", "-O1", "-Wall", "-Wextra", "-Wpedantic", "-Werror", f"-I{CORE}/include"]
    sanitize = ["-fsanitize=undefined", "-fno-sanitize-recover=all"]
    run_all(
        [
            [
                cc,
                *octets,
                *options,
                *([] if fault else sanitize),
                str(HERE / "octets.c"),
                *files,
                "-o",
                str(program),
                "-lm",
            ]
        ]
    )
    done = subprocess.run([str(program), *(["dirty"] if wide else [])], capture_output=True, text=True, check=False)
    if done.returncode != 0 and fault is None:
        sys.exit(done.stderr)
    return done.stdout


def dirty_octets(folder: Path, cc: str) -> None:
    want = transcript(folder, cc, wide=False)
    got = transcript(folder, cc, wide=True)
    for number, (a, b) in enumerate(zip(want.splitlines(), got.splitlines(), strict=False), 1):
        if a != b:
            sys.exit(f"line {number} of the transcript, clean octets of 8 bits:\n{a}\ndirty octets of 16 bits:\n{b}")
    assert want == got and len(want) > 100000, "the transcripts differ in length, or say nothing"
    for fault in MASKS:
        if transcript(folder, cc, wide=True, fault=fault) == want:
            sys.exit(f"{fault[0]} without its mask {fault[1]!r} was not found out")
    print(f"{len(want)} characters of transcript, equal; {len(MASKS)} masks taken away, each found out")


def cppcheck(folder: Path, _: str) -> None:
    """Int and octets of 16 bits: shifts, overflows and conversions as a C28x would have them."""
    command = [tool("cppcheck", "cppcheck"), "--quiet", "--error-exitcode=1", "--std=c11", "--language=c", "-j", "2"]
    command += ["--enable=warning,performance,portability", "--inline-suppr", "--suppress=missingIncludeSystem"]
    command += [f"--platform={ROOT}/tools/c28x.xml", "-D__GNUC__=12", f"-I{CORE}/include"]
    for number in ("-DDBL_MANT_DIG=53", "-DINS_REAL_FLOAT=1"):
        run_all([[*command, number, str(CORE / "src")]])
    bad = folder / "shift.c"
    bad.write_text("long wide(void) { return 1 << 16; }\n", encoding="utf-8")
    assert subprocess.run([*command, str(bad)], capture_output=True).returncode == 1, "int has more than 16 bits there"


def avr(_: Path, __: str) -> None:
    """Int of 16 bits, and a double that is a float."""
    compiler = tool("avr-gcc", "gcc-avr avr-libc")
    each([compiler, "-mmcu=atmega1284p", "-O1", *WARNINGS, "-c", "-o", "/dev/null"], (["-DINS_REAL_FLOAT"],))
    run = [compiler, "-mmcu=atmega1284p", "-fsyntax-only", f"-I{CORE}/include", str(CORE / "src/version.c")]
    done = subprocess.run(run, capture_output=True, text=True)
    assert "build with -DINS_REAL_FLOAT" in done.stderr, "a double of 32 bits is not refused"


def sdcc(folder: Path, _: str) -> None:
    """All of the core for an 8051 with external memory: compiled, not run."""
    command = [tool("sdcc", "sdcc"), "-mmcs51", "--model-large", "--std-c11", "--Werror", f"-I{CORE}/include"]
    command += ["--disable-warning", "110", "--disable-warning", "126"]  # of conditions that are constant
    command += ["--nogcse", "-o", f"{folder}/", "-c"]  # without that optimisation it compiles in a seventh of the time
    each(command, (["-DINS_REAL_FLOAT"],))


def analyzer(_: Path, cc: str) -> None:
    """Paths through one function after the other: null, uninitialised, out of bounds, division by zero."""
    each([cc, *WARNINGS, "-O2", "-fanalyzer", "-c", "-o", "/dev/null"])


if __name__ == "__main__":
    checks = {f.__name__: f for f in (no_octet_type, dirty_octets, cppcheck, avr, sdcc, analyzer)}
    work = Path(sys.argv[2]) / sys.argv[1]
    work.mkdir(parents=True, exist_ok=True)
    checks[sys.argv[1]](work, sys.argv[3] if len(sys.argv) > 3 else "cc")
