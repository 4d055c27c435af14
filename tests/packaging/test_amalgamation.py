"""ins_all.h and ins_all.c, the core in two files: the same each time, every compiler takes them, the library's bits."""

from pathlib import Path

import pytest
from packaging_kit import LIBRARY, REALS, ROOT, STRICT, Prefix, run

ARM = ("arm-none-eabi-gcc", "--specs=picolibc.specs", "-mthumb")
COMPILERS = {
    "gcc, C99": ("gcc", "-std=c99"),
    "gcc, C11": ("gcc", "-std=c11"),
    "clang, C11": ("clang", "-std=c11"),
    "Cortex-M0, C99": (*ARM, "-mcpu=cortex-m0", "-std=c99"),
    "Cortex-M4F, C11": (*ARM, "-mcpu=cortex-m4", "-mfloat-abi=hard", "-mfpu=fpv4-sp-d16", "-std=c11"),
}
BITS = Path(__file__).parent / "bits.c"


@pytest.fixture(scope="module")
def amalgamation(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("amalgamation")
    run("python3", ROOT / "tools/amalgamate.py", folder)
    return folder


def test_it_is_the_same_every_time_and_alone(amalgamation: Path, tmp_path: Path) -> None:
    run("python3", ROOT / "tools/amalgamate.py", tmp_path, cwd=tmp_path, PYTHONHASHSEED="7", LC_ALL="C")
    run("cmake", "--build", ROOT / "build/release", "--target", "ins_amalgamation")
    for name in ("ins_all.h", "ins_all.c"):
        by_target = ROOT / "build/release/amalgamation" / name
        assert by_target.read_bytes() == (tmp_path / name).read_bytes()
        text = (amalgamation / name).read_text(encoding="utf-8")
        assert text == (tmp_path / name).read_text(encoding="utf-8")
        assert "Permission is hereby granted" in text
        assert '#include "' not in text.replace('#include "ins_all.h"', "")


@pytest.mark.parametrize("real", REALS)
@pytest.mark.parametrize("compiler", COMPILERS)
def test_it_compiles(amalgamation: Path, tmp_path: Path, compiler: str, real: str) -> None:
    command = [*COMPILERS[compiler], *STRICT, *REALS[real], "-c", amalgamation / "ins_all.c", "-o", tmp_path / "x.o"]
    run(*command)


@pytest.mark.parametrize("real", REALS)
def test_it_has_the_bits_of_the_library(amalgamation: Path, prefix: Prefix, tmp_path: Path, real: str) -> None:
    flags = ["-std=c11", "-O1", "-ffp-contract=off", *REALS[real]]
    installed = prefix("static")
    library = (f"-L{installed / 'lib'}", f"-l{LIBRARY[real][3:]}", "-lm")
    run("gcc", *flags, f"-I{installed / 'include'}", BITS, *library, "-o", tmp_path / "library")
    all_c = amalgamation / "ins_all.c"
    run("gcc", *flags, "-DAMALGAMATED", f"-I{amalgamation}", BITS, all_c, "-lm", "-o", tmp_path / "all")
    said = run(tmp_path / "all")
    assert len(said.split()) == 10
    assert said == run(tmp_path / "library")


def test_float_can_be_fixed_in_the_header(tmp_path: Path) -> None:
    run("python3", ROOT / "tools/amalgamate.py", tmp_path, "--float")
    (tmp_path / "main.c").write_text(
        '#include "ins_all.h"\nint main(void) { return INS_ABI_CHECK() == INS_OK ? (int)sizeof(ins_real) : 7; }\n'
    )
    run("gcc", *STRICT, "-c", tmp_path / "ins_all.c", "-o", tmp_path / "ins_all.o")
    run("gcc", tmp_path / "main.c", tmp_path / "ins_all.o", "-lm", "-o", tmp_path / "main")
    run(tmp_path / "main", code=4)


def test_a_macro_that_would_be_cut_short_is_refused(tmp_path: Path) -> None:
    """A source that redefines a macro of an internal header would end it for the sources after."""
    copy = tmp_path / "repository"
    for name in ("tools", "libins/core", "LICENSE"):
        (copy / name).parent.mkdir(parents=True, exist_ok=True)
        run("cp", "-r", ROOT / name, copy / name)
    victim = copy / "libins/core/src/version.c"
    victim.write_text(victim.read_text(encoding="utf-8") + "#define HALF_U_MAX 1\n", encoding="utf-8")
    said = run("python3", copy / "tools/amalgamate.py", tmp_path / "out", code=1)
    assert "macro HALF_U_MAX is also in rotvec_internal.h" in said
