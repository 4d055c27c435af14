"""Checks of the core's sources and objects: headers alone, symbols, words, SDCC.  SPDX-License-Identifier: MIT"""

import re
import subprocess
import sys
from pathlib import Path

CORE = Path(__file__).resolve().parents[2] / "libins" / "core"
INCLUDE = CORE / "include"
# Beside the core's own: the libm it may use, and what compilers, sanitizers and coverage add by themselves.
ALLOWED = re.compile(
    r"(sqrt|sin|cos|sincos|atan2)f?$|mem(cpy|set|move)$|__(a|ub)san_|__stack_chk_fail|_GLOBAL_OFFSET_TABLE_|_?_gcov_"
)
SDCC_BOARD_CODE_MAX = 768  # octets of 8051 code for the board side, blocks of 6 in internal RAM


def run(command: list[str]) -> str:
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}\n{done.stdout}{done.stderr}")
    return done.stdout


def headers(c_compiler: str, cxx_compiler: str) -> None:
    flags = ["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror", "-fsyntax-only", f"-I{INCLUDE}"]
    found = sorted(INCLUDE.glob("ins/*.h"))
    assert found, f"no headers in {INCLUDE}"
    for header in found:
        for compiler, language in (
            (c_compiler, ["-std=c99", "-x", "c"]),
            (c_compiler, ["-std=c11", "-x", "c"]),
            (cxx_compiler, ["-std=c++17", "-x", "c++"]),
        ):
            for number in ([], ["-DINS_REAL_FLOAT"]):
                run([compiler, *language, *flags, *number, "-include", str(header), "/dev/null"])


def symbols(nm: str, library: str) -> None:
    defined, undefined = set(), set()
    for line in run([nm, library]).splitlines():
        fields = line.split()
        if len(fields) >= 2 and len(fields[-2]) == 1:
            (undefined if fields[-2] in "Uw" else defined).add(fields[-1])
    assert "ins_attitude_step" in defined, f"{library} is not the core"
    foreign = sorted(s for s in undefined - defined if not ALLOWED.match(s))
    if foreign:
        sys.exit(f"{library} needs {', '.join(foreign)}: the core may use sqrt, sin, cos and atan2 only")


def words() -> None:
    banned = re.compile(
        r"\bu?int8_t\b|#pragma|__attribute__\(\(packed|\b(malloc|free|printf|assert|mem(cpy|set|move|cmp))\("
        r"|\bunion\b|\b(int|unsigned|u?int\w*_t)\s+\w+\s*:\s*\d"  # the layout of an object is no wire format
        r"|\bsizeof\b(?!\(ins_real\))"  # counts of octets are numbers: sizeof counts what the machine calls a char
        r"|(?<![\w.])(0x[0-9A-Fa-f]+|\d+)\s*<<\s*(1[5-9]|[2-9]\d)"  # an int may have 16 bits
    )
    sources = sorted(p for p in CORE.rglob("*") if p.suffix in (".c", ".h"))
    assert len(sources) > 10, f"no sources in {CORE}"
    bad = [
        f"{path}:{number}: {line}"
        for path in sources
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if banned.search(line.split("//")[0])
    ]
    if bad:
        sys.exit("not portable (docs/portability.md), or not for a library without heap:\n" + "\n".join(bad))


def sdcc(compiler: str, folder: str) -> None:
    size = {}
    for side in ("board", "host"):
        for memory in ("", "__idata"):
            out = Path(folder) / f"handshake_{side}.rel"
            command = [compiler, "-mmcs51", "--std-c11", "--opt-code-size", "--Werror", "-DINS_REAL_FLOAT"]
            command += ["-DINS_HS_BLOCK_MAX=6", f"-DINS_HS_MEM={memory}", f"-I{INCLUDE}", "-c"]
            run([*command, str(CORE / "src" / f"handshake_{side}.c"), "-o", str(out)])
            area = re.search(r"^A CSEG size ([0-9A-F]+)", out.read_text(encoding="utf-8"), re.M)
            assert area, f"no code area in {out}"
            size[side, memory] = int(area[1], 16)
    print("8051 code, octets:", size)
    if size["board", "__idata"] > SDCC_BOARD_CODE_MAX:
        sys.exit(f"the board side takes {size['board', '__idata']} octets, budget {SDCC_BOARD_CODE_MAX}")


if __name__ == "__main__":
    {"headers": headers, "symbols": symbols, "words": words, "sdcc": sdcc}[sys.argv[1]](*sys.argv[2:])
