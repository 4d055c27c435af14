"""The C++ headers installed from the root of the project: find_package(libins COMPONENTS cpp), both number types."""

import re
from pathlib import Path

import pytest
from packaging_kit import ROOT, run

OFF = [f"-DINS_BUILD_{part}=OFF" for part in ("TESTS", "EMU", "DDS", "PYTHON")]
TARGET = {"double": "libins::cpp", "float": "libins::cppf"}


@pytest.fixture(scope="module")
def prefix(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("cpp")
    run("cmake", "-G", "Ninja", "-S", ROOT, "-B", folder / "build", *OFF)
    run("cmake", "--build", folder / "build", "-j2", "--target", "ins_core", "ins_coref")
    run("cmake", "--install", folder / "build", "--prefix", folder / "prefix")
    return folder / "prefix"


@pytest.mark.parametrize("real", TARGET)
def test_the_example_of_the_page_builds_and_navigates(prefix: Path, tmp_path: Path, real: str) -> None:
    page = (ROOT / "docs/cpp.md").read_text(encoding="utf-8")
    example = re.search(r"```cpp\n(.*?)```", page, re.S)
    assert example, "docs/cpp.md has no example"
    (tmp_path / "main.cpp").write_text(example[1], encoding="utf-8")
    (tmp_path / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.25)\nproject(x LANGUAGES CXX)\n"
        "find_package(libins REQUIRED COMPONENTS cpp)\n"
        f"add_executable(heading main.cpp)\ntarget_link_libraries(heading PRIVATE {TARGET[real]})\n"
    )
    run("cmake", "-G", "Ninja", "-S", tmp_path, "-B", tmp_path / "build", f"-DCMAKE_PREFIX_PATH={prefix}")
    run("cmake", "--build", tmp_path / "build")
    assert run(tmp_path / "build/heading") == "heading 1.996 rad\n"  # 0.2 rad/s over 499 periods of 20 ms
