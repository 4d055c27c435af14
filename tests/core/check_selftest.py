"""The self-test finds what it is for: builds the core with one fault at a time and asks ins_selftest().

SPDX-License-Identifier: MIT

check_selftest.py CC FOLDER
"""

import subprocess
import sys
from pathlib import Path

CORE = Path(__file__).resolve().parents[2] / "libins" / "core"
CONING, STEP, FITER, RATES, FIXED = 0x02, 0x04, 0x08, 0x10, 0x20
# (file, what stands there, the fault, bits that must be set)
FAULTS = [
    (
        "coning_internal.h",
        "ins_vec_add_scaled(phi, 1, cross);\n    if",
        "if",
        CONING | STEP,
    ),  # the term is silently zero
    ("coning_internal.h", "ins_vec_cross(w, t0, cross)", "ins_vec_cross(t0, w, cross)", CONING | STEP),
    ("coning_internal.h", "R(7, 60), R(-1, 60)", "R(7, 60), R(1, 60)", CONING | STEP),
    ("coning.c", "R(473, 1890)", "R(437, 1890)", CONING),
    ("coning.c", "R(33, 80)", "R(57, 80)", CONING),
    ("quat_internal.h", "(p[3] * q[2] -", "(-p[3] * q[2] -", STEP | FITER),
    ("rotvec_internal.h", "-0.0208333333333286722", "-0.0218333333333286722", STEP),
    ("fiter.c", "{3, 13, -5, 1}", "{3, 13, -4, 1}", FITER),
    ("fiter.c", "2 * k", "k", FITER),
    ("rates.c", "{9, 19, -5, 1}", "{9, 19, 5, 1}", RATES),
    ("q31_long_internal.h", "theta[0] + q31_high(y, theta[2]) - q31_high(z, theta[1])", "theta[0]", FIXED),
    ("q31_long_internal.h", "- q31_high(z, theta[1])", "+ q31_high(z, theta[1])", FIXED),
]


def selftest(compiler: str, folder: Path, fault: tuple[str, str, str] | None) -> int:
    source = folder / "src"
    source.mkdir(exist_ok=True)
    for path in (CORE / "src").iterdir():
        text = path.read_text(encoding="utf-8")
        if fault and path.name == fault[0]:
            assert fault[1] in text, f"{fault[0]} has no {fault[1]!r} to break: bring the list of faults up to date"
            text = text.replace(fault[1], fault[2], 1)
        (source / path.name).write_text(text, encoding="utf-8")
    main = folder / "main.c"
    main.write_text('#include "ins/selftest.h"\nint main(void) { return (int)ins_selftest(); }\n', encoding="utf-8")
    program = folder / "selftest"
    needed = ["selftest", "attitude", "attitude_any", "coning", "fiter", "q31", "quat", "rates", "rotvec", "version"]
    files = [str(source / f"{name}.c") for name in needed]
    command = [compiler, "-std=c11", "-O1", "-ffp-contract=off", f"-I{CORE / 'include'}", str(main), *files, "-lm"]
    subprocess.run([*command, "-o", str(program)], check=True)
    return subprocess.run([str(program)], check=False).returncode


def main() -> None:
    folder = Path(sys.argv[2]) / "selftest"
    folder.mkdir(exist_ok=True)
    assert selftest(sys.argv[1], folder, None) == 0, "the core as it is fails its own test"
    for name, old, new, bits in FAULTS:
        found = selftest(sys.argv[1], folder, (name, old, new))
        print(f"{found:#04x}  {name}: {old!r} -> {new!r}")
        if found & bits != bits:
            sys.exit(f"not found: wanted {bits:#04x}")


main()
