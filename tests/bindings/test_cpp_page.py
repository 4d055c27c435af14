"""The C++ headers and the example of their page: both compilers, both number types, without exceptions and RTTI."""

import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
EXAMPLE = ROOT / "bindings/cpp/examples/navigate.cpp"
INCLUDES = [f"-I{ROOT}/bindings/cpp/include", f"-I{ROOT}/libins/core/include", "-isystem", "/usr/include/eigen3"]
WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wdouble-promotion", "-Wshadow", "-Werror"]
FIRMWARE = ["-std=c++17", "-fno-exceptions", "-fno-rtti"]


def run(command: list[str]) -> str:
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.mark.parametrize("real", [[], ["-DINS_REAL_FLOAT"]], ids=["double", "float"])
@pytest.mark.parametrize("compiler", ["g++", "clang++"])
def test_headers_compile(compiler: str, real: list[str]) -> None:
    run([compiler, *FIRMWARE, *WARNINGS, *real, *INCLUDES, "-fsyntax-only", str(EXAMPLE)])


def test_each_header_stands_alone(tmp_path: Path) -> None:
    """Each in a program of its own: what it uses it includes. Eigen is parsed once for all."""
    eigen = tmp_path / "eigen.hpp"
    eigen.write_text("#include <Eigen/Core>\n#include <Eigen/Geometry>\n", encoding="utf-8")
    run(["g++", *FIRMWARE, *INCLUDES, "-x", "c++-header", str(eigen), "-o", f"{eigen}.gch"])
    headers = sorted((ROOT / "bindings/cpp/include/ins").glob("*.hpp"))
    assert len(headers) > 10
    for header in headers:
        source = tmp_path / f"{header.stem}.cpp"
        source.write_text(f'#include "ins/{header.name}"\n', encoding="utf-8")
        run(["g++", *FIRMWARE, *INCLUDES, "-include", str(eigen), "-fsyntax-only", str(source)])


def test_the_example_of_the_page_runs(tmp_path: Path) -> None:
    assert f"```cpp\n{EXAMPLE.read_text(encoding='utf-8')}```" in (ROOT / "docs/cpp.md").read_text(encoding="utf-8")
    binary = tmp_path / "navigate"
    library = ROOT / "build/release/libins/core/libins.a"
    run(["g++", *FIRMWARE, "-O1", *INCLUDES, str(EXAMPLE), str(library), "-lm", "-o", str(binary)])
    assert run([str(binary)]) == "heading 1.996 rad\n"
