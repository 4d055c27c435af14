"""The emulated board installed: find_package(libins COMPONENTS emu), headers, symbols, the C example with ctest."""

import re
from pathlib import Path

import pytest
from packaging_kit import EXAMPLES, ROOT, STRICT, run

OFF = [f"-DINS_BUILD_{part}=OFF" for part in ("TESTS", "DDS", "PYTHON", "FIRMWARE")]
KINDS = {"static": "OFF", "shared": "ON"}
ROOMS = ("common", "8051_tlc2543")
"""What libins_emu holds; the F2812's is a runtime of board programs (test_install_f2812.py)."""
HEADERS = [p for room in ROOMS for p in (ROOT / "emu" / room / "include").glob("*/*.h")]


@pytest.fixture(scope="module", params=KINDS)
def installed(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[str, Path]:
    """From the root of the project, without a tool for firmware, and moved after that."""
    folder = tmp_path_factory.mktemp(request.param)
    shared = f"-DBUILD_SHARED_LIBS={KINDS[request.param]}"
    options = ["-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_C_FLAGS_RELEASE=-O1", "-DINS_SDCC=INS_SDCC-NOTFOUND", shared]
    run("cmake", "-G", "Ninja", "-S", ROOT, "-B", folder / "build", *OFF, *options)
    run("cmake", "--build", folder / "build", "-j2", "--target", "ins_core", "ins_coref", "ins_emu")
    run("cmake", "--install", folder / "build", "--prefix", folder / "as_installed")
    return request.param, (folder / "as_installed").rename(folder / "as_used")


def test_the_c_example_passes_and_can_fail(installed: tuple[str, Path], tmp_path: Path) -> None:
    kind, prefix = installed
    flags = f"-DCMAKE_C_FLAGS={' '.join(STRICT)}"
    run("cmake", "-G", "Ninja", "-S", EXAMPLES / "board_c", "-B", tmp_path, f"-DCMAKE_PREFIX_PATH={prefix}", flags)
    run("cmake", "--build", tmp_path)
    where = {"LD_LIBRARY_PATH": str(prefix / "lib")} if kind == "shared" else {}
    said = run("ctest", "--test-dir", tmp_path, **where)
    assert "100% tests passed, 0 tests failed out of 3" in said
    image = (tmp_path / "meter.bin").read_bytes()
    assert image.count(b"READY") == 1
    (tmp_path / "wrong.bin").write_bytes(image.replace(b"READY", b"REDDY"))
    said = run(tmp_path / "test_meter", tmp_path / "wrong.bin", "reading", code=1, **where)
    assert "'READY\n' did not come within 500 ms, but 'REDDY\n'" in said


def test_every_header_is_installed_and_compiles_alone(installed: tuple[str, Path], tmp_path: Path) -> None:
    _, prefix = installed
    for header in HEADERS:
        name = "/".join(header.parts[-2:])
        (tmp_path / "alone.c").write_text(f'#include "{name}"\n', encoding="utf-8")
        for standard in ("c11", "c++17"):
            language = "c++" if standard == "c++17" else "c"
            command = ["gcc", "-x", language, f"-std={standard}", "-Wall", "-Wextra", "-Wpedantic", "-Werror"]
            run(*command, f"-I{prefix / 'include'}", "-fsyntax-only", tmp_path / "alone.c")
    assert len(HEADERS) >= 10


def test_the_shared_library_exports_the_api_and_nothing_else(installed: tuple[str, Path]) -> None:
    kind, prefix = installed
    listed = (ROOT / "tests/packaging/symbols_emu.txt").read_text(encoding="utf-8").split()
    declared = {
        name
        for header in HEADERS
        for name in re.findall(r"^EMU_API [^;{]*?(\w+)\(", header.read_text(encoding="utf-8"), re.MULTILINE)
    }
    assert sorted(declared) == listed, (
        f"new: {sorted(declared - set(listed))}, gone: {sorted(set(listed) - declared)}. "
        "If that is meant, bring tests/packaging/symbols_emu.txt up to date; what is gone needs a new minor version"
    )
    if kind == "shared":
        library = prefix / "lib/libins_emu.so"
        exported = [line.split()[2] for line in run("nm", "-D", "--defined-only", library).splitlines()]
        assert sorted(exported) == listed
        assert re.search(r"\[libins_emu\.so\.\d+\.\d+\]", run("readelf", "-d", library))
