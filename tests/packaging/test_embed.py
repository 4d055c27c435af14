"""libins inside another project, and as a copied folder: nothing of it leaks, nothing but the core is built."""

import shutil
from pathlib import Path

import pytest
from packaging_kit import CORE, EXAMPLES, ROOT, configure, run

# The consumer's own file would not pass libins' warnings (an unused parameter, a missing prototype, GNU C).
SLOPPY = """#include "ins/ins.h"
int helper(int unused) { typeof(unused) x = 0; return x; }
int main(void) { return INS_ABI_CHECK() == INS_OK ? helper(1) : 7; }
"""
CONSUMER = """cmake_minimum_required(VERSION 3.25)
project(consumer LANGUAGES C)
{fetch}
add_executable(consumer main.c)
target_link_libraries(consumer PRIVATE libins::{target})
get_directory_property(targets DIRECTORY "{folder}" BUILDSYSTEM_TARGETS)
get_property(in_cache CACHE INS_INSTALL PROPERTY VALUE)
get_property(languages GLOBAL PROPERTY ENABLED_LANGUAGES)
message(STATUS "seen: languages=${{languages}} install=${{in_cache}} targets=${{targets}} std=${{CMAKE_C_STANDARD}} "
               "visibility=${{CMAKE_C_VISIBILITY_PRESET}} commands=${{CMAKE_EXPORT_COMPILE_COMMANDS}} "
               "tests=${{INS_BUILD_TESTS}}")
"""
FETCH = """include(FetchContent)
FetchContent_Declare(libins SOURCE_DIR "{root}")
FetchContent_MakeAvailable(libins)"""
SEEN = "seen: languages=C install=OFF targets=ins_core;ins_coref std= visibility= commands= tests="


def consumer(folder: Path, fetch: str, target: str) -> Path:
    (folder / "CMakeLists.txt").write_text(CONSUMER.format(fetch=fetch, target=target, folder=CORE))
    (folder / "main.c").write_text(SLOPPY)
    return folder


@pytest.mark.parametrize(
    ("fetch", "target"),
    [
        (FETCH.format(root=ROOT), "core"),
        (f'add_subdirectory("{ROOT}" libins)', "coref"),
        (f'add_subdirectory("{CORE}" core)', "coref"),
    ],
    ids=["FetchContent", "add_subdirectory", "core alone"],
)
def test_in_another_project(tmp_path: Path, fetch: str, target: str) -> None:
    said = configure(consumer(tmp_path, fetch, target), tmp_path / "build")
    assert SEEN in said
    flags = (
        (tmp_path / "build/build.ninja").read_text(encoding="utf-8").split("build CMakeFiles/consumer.dir/main.c.o")[1]
    )
    flags = flags.split("\n\n")[0]
    assert "-W" not in flags and "-fvisibility" not in flags and "-ffp-contract" not in flags, flags
    assert not any("file(INSTALL" in path.read_text("utf-8") for path in tmp_path.rglob("cmake_install.cmake"))
    if target == "core":
        run("cmake", "--build", tmp_path / "build", "--target", "consumer", "-j2")
        run(tmp_path / "build/consumer")


def test_the_minimal_example_beside_a_copied_folder(tmp_path: Path) -> None:
    shutil.copytree(CORE, tmp_path / "core")
    for name in ("Makefile", "main.c"):
        shutil.copy(EXAMPLES / "minimal_c" / name, tmp_path)
    run("make", "-j2", "CORE=core", "REAL=-DINS_REAL_FLOAT", cwd=tmp_path)
    assert "q_nb = -0.80114" in run(tmp_path / "minimal")


@pytest.mark.parametrize(("number", "archive"), [("-O2", "libins.a"), ("-DINS_REAL_FLOAT", "libinsf.a")])
def test_the_navigator_of_the_example_holds_through_its_outage(number: str, archive: str, tmp_path: Path) -> None:
    library = ROOT / "build/release/libins/core" / archive
    assert library.exists(), f"{library} is missing: run ./dev test"
    main, program = EXAMPLES / "gps_ins_c/main.c", tmp_path / "gps_ins"
    run("gcc", "-std=c11", "-Wall", "-Werror", number, f"-I{CORE}/include", main, library, "-lm", "-o", program)
    said = run(program).splitlines()
    off = [line.split()[2:7:4] for line in said if "sigma" in line]
    assert len(off) == 10
    assert all(float(error) <= float(sigma) for error, sigma in off), said
    assert said[-1] == "9700 samples, 66 fixes, 0 rests used"
