"""The installed library as its users meet it: symbols, find_package, pkg-config, the wrong header, another version."""

import re
from pathlib import Path

import pytest
from packaging_kit import EXAMPLES, LIBRARY, REALS, ROOT, STRICT, Prefix, configure, run

KINDS = ("static", "shared")
TARGET = {"double": "libins::core", "float": "libins::coref"}
# Level at 25 deg N for 1 s: gravity of 9.79 m/s^2, and gyros that do not see the Earth turn.
AT_REST = "0 0 0 0 0 -0.0979\n" * 100
GGA = (
    "$GPGGA,000001.00,2501.5000000,N,12133.6000000,E,4,12,0.8,30.000,M,15.000,M,,*53\r\n",
    "$GPGGA,000002.00,2501.6000000,N,12133.6000000,E,4,12,0.8,29.000,M,15.000,M,,*5B\r\n",
)
MERIDIAN_M_PER_MINUTE = 1846.3  # at 25 deg N


def run_installed(prefix: Path, *command: object, stdin: str = "", code: int = 0) -> str:
    return run(*command, stdin=stdin, code=code, LD_LIBRARY_PATH=str(prefix / "lib"))


def pkg_config(prefix: Path, *arguments: str) -> list[str]:
    return run("pkg-config", *arguments, PKG_CONFIG_PATH=str(prefix / "lib/pkgconfig")).split()


@pytest.mark.parametrize("real", REALS)
def test_the_shared_library_exports_the_api_and_nothing_else(prefix: Prefix, real: str) -> None:
    library = prefix("shared") / f"lib/{LIBRARY[real]}.so"
    exported = sorted(line.split()[2] for line in run("nm", "-D", "--defined-only", library).splitlines())
    listed = (ROOT / "tests/packaging/symbols.txt").read_text(encoding="utf-8").split()
    assert exported == listed, (
        f"new: {sorted(set(exported) - set(listed))}, gone: {sorted(set(listed) - set(exported))}. "
        "If that is meant, bring tests/packaging/symbols.txt up to date; what is gone needs a new minor version"
    )


@pytest.mark.parametrize("real", REALS)
def test_the_soname_has_the_minor_version(prefix: Prefix, real: str) -> None:
    library = prefix("shared") / f"lib/{LIBRARY[real]}.so"
    major, minor, _ = pkg_config(prefix("shared"), "--modversion", LIBRARY[real])[0].split(".")
    assert f"[{LIBRARY[real]}.so.{major}.{minor}]" in run("readelf", "-d", library)


@pytest.mark.parametrize("real", REALS)
@pytest.mark.parametrize("kind", KINDS)
def test_the_find_package_example_navigates(prefix: Prefix, tmp_path: Path, kind: str, real: str) -> None:
    configure(
        EXAMPLES / "linux_find_package",
        tmp_path,
        f"-DCMAKE_PREFIX_PATH={prefix(kind)}",
        f"-DINS_TARGET={TARGET[real]}",
        f"-DCMAKE_C_FLAGS={' '.join(STRICT)}",
    )
    run("cmake", "--build", tmp_path)
    said = run_installed(prefix(kind), tmp_path / "imu_strapdown", "25", "121.56", "30", "0.01", stdin=AT_REST)
    numbers = [float(word) for word in re.findall(r"-?\d+\.\d+", said)]
    assert said.startswith("steps 100 "), said
    assert all(abs(metres) < 5e-3 for metres in numbers[0:3]), said
    assert all(abs(speed) < 5e-3 for speed in numbers[3:6]), said
    assert numbers[6] == pytest.approx(1, abs=1e-7)
    # The Earth's rate, (cos, 0, -sin) 25 deg in NED, turns n under the still body: half an angle of 1 s, backwards.
    assert numbers[7] == pytest.approx(-3.304e-5, abs=2e-7), said
    assert numbers[9] == pytest.approx(1.541e-5, abs=2e-7), said
    refused = run_installed(prefix(kind), tmp_path / "imu_strapdown", "25", "0", "0", "0.01", stdin="0 0 0\n", code=1)
    assert "increment 1: six numbers" in refused


@pytest.mark.parametrize("real", REALS)
@pytest.mark.parametrize("kind", KINDS)
def test_the_pkg_config_example_gives_metres(prefix: Prefix, tmp_path: Path, kind: str, real: str) -> None:
    for name in ("Makefile", "main.c"):
        (tmp_path / name).write_text((EXAMPLES / "linux_pkg_config" / name).read_text(encoding="utf-8"), "utf-8")
    run("make", f"PACKAGE={LIBRARY[real]}", cwd=tmp_path, PKG_CONFIG_PATH=str(prefix(kind) / "lib/pkgconfig"))
    said = run_installed(prefix(kind), tmp_path / "nmea_ned", stdin="".join(GGA))
    rows = [[float(word) for word in line.split()] for line in said.splitlines()[:2]]
    assert rows[0] == [1, 0, 0, 0, 12]
    assert rows[1] == pytest.approx([2, MERIDIAN_M_PER_MINUTE / 10, 0, 1, 12], abs=0.05)
    assert "2 taken, 0 wrong checksum" in said


def test_both_types_in_one_program_do_not_configure(prefix: Prefix, tmp_path: Path) -> None:
    said = configure(
        EXAMPLES / "linux_find_package",
        tmp_path,
        f"-DCMAKE_PREFIX_PATH={prefix('static')}",
        "-DINS_TARGET=libins::core;libins::coref",
        code=1,
    )
    assert "INTERFACE_INS_REAL" in said


@pytest.mark.parametrize(
    ("wanted", "words"),
    [("0.1 COMPONENTS emu", "without the component 'emu'"), ("0.2", "0.2"), ("1.0", "1.0")],
)
def test_what_is_not_there_is_said(prefix: Prefix, tmp_path: Path, wanted: str, words: str) -> None:
    (tmp_path / "CMakeLists.txt").write_text(
        f"cmake_minimum_required(VERSION 3.25)\nproject(x LANGUAGES C)\nfind_package(libins {wanted} REQUIRED)\n"
    )
    assert words in configure(tmp_path, tmp_path / "build", f"-DCMAKE_PREFIX_PATH={prefix('static')}", code=1)


CHECK = '#include "ins/ins.h"\nint main(void) { return INS_ABI_CHECK() == INS_OK ? 0 : 7; }\n'


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("program", REALS)
@pytest.mark.parametrize("library", REALS)
def test_the_header_of_the_other_type_is_refused(
    prefix: Prefix, tmp_path: Path, kind: str, program: str, library: str
) -> None:
    (tmp_path / "check.c").write_text(CHECK)
    flags = [*REALS[program], f"-I{prefix(kind) / 'include'}"]
    libs = [f"-L{prefix(kind) / 'lib'}", f"-l{LIBRARY[library][3:]}", "-lm"]
    run("gcc", *flags, tmp_path / "check.c", *libs, "-o", tmp_path / "check")
    run_installed(prefix(kind), tmp_path / "check", code=0 if program == library else 7)


@pytest.mark.parametrize(("part", "code"), [("MAJOR", 7), ("MINOR", 7), ("PATCH", 0)])
def test_the_header_of_another_version_is_refused(prefix: Prefix, tmp_path: Path, part: str, code: int) -> None:
    """A program that was compiled with other headers, and meets this shared library."""
    installed = prefix("shared")
    for header in (installed / "include/ins").iterdir():
        text = header.read_text(encoding="utf-8")
        if header.name == "version.h":
            text, changed = re.subn(rf"(#define INS_VERSION_{part}) (\d+)", lambda m: f"{m[1]} {int(m[2]) + 1}", text)
            assert changed == 1
        (tmp_path / "include/ins").mkdir(parents=True, exist_ok=True)
        (tmp_path / "include/ins" / header.name).write_text(text, encoding="utf-8")
    (tmp_path / "check.c").write_text(CHECK)
    run(
        "gcc",
        f"-I{tmp_path / 'include'}",
        tmp_path / "check.c",
        f"-L{installed / 'lib'}",
        "-lins",
        "-o",
        tmp_path / "check",
    )
    run_installed(installed, tmp_path / "check", code=code)
