"""Packages for firmware package managers: metadata against the managers' own parsers, every file there, compiled.

The managers themselves (PlatformIO, Arduino, ESP-IDF, Zephyr's west) do not build here: they fetch their toolchains.
The commands of their CMake are defined here from their manuals, so that our CMakeLists.txt run as written.
"""

import json
import re
import sys
from pathlib import Path

import kconfiglib
import pytest
import yaml
from packaging_kit import CORE, ROOT, run
from platformio.package.manifest.parser import ManifestParserFactory
from platformio.package.manifest.schema import ManifestSchema

URL = "https://example.org/libins"
ARM = ("arm-none-eabi-gcc", "--specs=picolibc.specs", "-mthumb", "-mcpu=cortex-m3")
WARNINGS = ("-Wall", "-Wextra", "-Wpedantic", "-Werror")

# Arduino library specification 1.5 (rev. 2.2), "Library metadata": the fields, and the values of category.
ARDUINO_FIELDS = {
    "name",
    "version",
    "author",
    "maintainer",
    "sentence",
    "paragraph",
    "category",
    "url",
    "architectures",
}
ARDUINO_OPTIONAL = {"depends", "dot_a_linkage", "includes", "precompiled", "ldflags"}
ARDUINO_CATEGORIES = {"Display", "Communication", "Signal Input/Output", "Sensors", "Device Control", "Timing"} | {
    "Data Storage",
    "Data Processing",
    "Other",
}

# ESP-IDF build system, "Component CMakeLists Files": idf_component_register, COMPONENT_LIB.
ESP_IDF = """cmake_minimum_required(VERSION 3.25)
project(app LANGUAGES C)
set(CONFIG_INS_REAL_FLOAT {real})
macro(idf_component_register)
  cmake_parse_arguments(ARG "" "" "SRC_DIRS;INCLUDE_DIRS" ${{ARGN}})
  set(COMPONENT_LIB libins)
  set(found)
  foreach(folder IN LISTS ARG_SRC_DIRS)
    file(GLOB in_folder ${{CMAKE_CURRENT_LIST_DIR}}/${{folder}}/*.c)
    list(APPEND found ${{in_folder}})
  endforeach()
  add_library(${{COMPONENT_LIB}} STATIC ${{found}})
  target_include_directories(${{COMPONENT_LIB}} PUBLIC ${{ARG_INCLUDE_DIRS}})
endmacro()
add_subdirectory({package} libins)
"""
# Zephyr, cmake/modules/extensions.cmake: zephyr_library_*, zephyr_include_*, zephyr_compile_definitions_ifdef.
ZEPHYR = """cmake_minimum_required(VERSION 3.25)
project(app LANGUAGES C)
set(CONFIG_LIBINS y)
set(CONFIG_LIBINS_FLOAT {real})
macro(zephyr_library_named name)
  set(ZEPHYR_CURRENT_LIBRARY ${{name}})
  add_library(${{name}} STATIC)
endmacro()
macro(zephyr_library_sources)
  target_sources(${{ZEPHYR_CURRENT_LIBRARY}} PRIVATE ${{ARGN}})
endmacro()
macro(zephyr_library_compile_options)
  target_compile_options(${{ZEPHYR_CURRENT_LIBRARY}} PRIVATE ${{ARGN}})
endmacro()
macro(zephyr_include_directories)
  include_directories(${{ARGN}})
endmacro()
macro(zephyr_compile_definitions_ifdef feature)
  if(${{feature}})
    add_compile_definitions(${{ARGN}})
  endif()
endmacro()
add_subdirectory({package} libins)
"""
SKETCH = """#include <ins_all.h>
static ins_attitude_t attitude;
static const ins_real level[4] = {1, 0, 0, 0};
int main()
{
    const ins_real dtheta_b[3] = {0.01f, 0, 0};
    ins_attitude_init(&attitude, INS_CONING_HIST2_OPT, level);
    for (;;)
    {
        ins_attitude_step(&attitude, dtheta_b);
    }
}
"""
RISCV = "--specs=picolibc.specs -march=rv32imc -mabi=ilp32"  # of an ESP32-C3


def version() -> str:
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    found = re.search(r"^project\(libins VERSION (\S+) ", text, re.MULTILINE)
    assert found
    return found[1]


def assemble(kind: str, folder: Path, *options: str) -> Path:
    run("python3", ROOT / "tools/package.py", kind, folder, *options)
    return folder


def names(folder: Path) -> set[str]:
    return {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file()}


def cross_build(tmp_path: Path, app: str, package: Path, real: str, compiler: str, flags: str) -> str:
    (tmp_path / "app").mkdir()
    (tmp_path / "app/CMakeLists.txt").write_text(app.format(package=package, real=real))
    target = (
        "-DCMAKE_SYSTEM_NAME=Generic",
        f"-DCMAKE_C_COMPILER={compiler}",
        f"-DCMAKE_C_FLAGS={flags} {' '.join(WARNINGS)}",
    )
    check = "-DCMAKE_TRY_COMPILE_TARGET_TYPE=STATIC_LIBRARY"
    run("cmake", "-G", "Ninja", "-S", tmp_path / "app", "-B", tmp_path / "build", *target, check)
    run("cmake", "--build", tmp_path / "build", "-j2")
    symbols = run("nm", tmp_path / "build/libins/liblibins.a")
    assert len(re.findall(r"\.c\.o(?:bj)?:$", symbols, re.MULTILINE)) == len(list((CORE / "src").glob("*.c")))
    return symbols


@pytest.mark.parametrize("kind", ["platformio", "esp_idf", "zephyr"])
def test_a_package_has_the_files_of_the_library(tmp_path: Path, kind: str) -> None:
    """The list in CMake, the folder and the package agree: a source that is in one of them only is found here."""
    package = assemble(kind, tmp_path / kind)
    assert names(package / "src") == names(CORE / "src")
    assert names(package / "include") == names(CORE / "include")
    assert (package / "LICENSE").read_text("utf-8") == (ROOT / "LICENSE").read_text("utf-8")
    refused = run("python3", ROOT / "tools/package.py", kind, package, code=1)
    assert "is not empty" in refused


def platformio_manifest(path: Path) -> dict[str, object]:
    manifest: dict[str, object] = ManifestParserFactory.new_from_file(str(path)).as_dict()
    # The schema looks licences up over the network; the others are checked as they are.
    assert manifest.pop("license", "MIT") == "MIT"
    ManifestSchema().load_manifest(manifest)
    return manifest


@pytest.mark.parametrize("options", [(), ("--url", URL)])
def test_platformio_takes_its_manifest(tmp_path: Path, options: tuple[str, ...]) -> None:
    package = assemble("platformio", tmp_path / "libins", *options)
    manifest = platformio_manifest(package / "library.json")
    assert (manifest["name"], manifest["version"]) == ("libins", version())
    assert manifest.get("homepage") == (URL if options else None)
    assert (package / "include" / manifest["headers"][0]).is_file()
    build = json.loads((package / "library.json").read_text("utf-8"))["build"]
    objects = tmp_path / "objects"
    objects.mkdir()
    if options:
        sources = sorted((package / build["srcDir"]).glob("*.c"))
        command = [*ARM, *WARNINGS, *build["flags"], f"-I{package / build['includeDir']}", "-c", *sources]
        run(*command, cwd=objects)
        assert len(names(objects)) == len(sources)


def test_arduino_takes_its_properties_and_an_8_bit_board_the_sources(tmp_path: Path) -> None:
    package = assemble("arduino", tmp_path / "libins", "--url", URL)
    lines = (package / "library.properties").read_text("utf-8").splitlines()
    fields = dict(line.split("=", 1) for line in lines)
    assert len(fields) == len(lines)
    assert ARDUINO_FIELDS <= set(fields) <= ARDUINO_FIELDS | ARDUINO_OPTIONAL
    assert fields["category"] in ARDUINO_CATEGORIES
    assert fields["version"] == version()
    assert (package / "src" / fields["includes"]).is_file()
    assert platformio_manifest(package / "library.properties")["homepage"] == URL
    # As the Arduino build does: GNU C11, sections, no define of ours.
    avr = (
        "avr-gcc",
        "-mmcu=atmega2560",
        "-std=gnu11",
        "-Os",
        "-ffunction-sections",
        "-fdata-sections",
        "-Wall",
        "-Werror",
    )
    run(*avr, "-c", package / "src/ins_all.c", "-o", tmp_path / "ins_all.o")
    (tmp_path / "sketch.cpp").write_text(SKETCH, encoding="utf-8")
    sketch = ("avr-g++", "-mmcu=atmega2560", "-std=gnu++11", "-Os", "-Wall", "-Werror", "-Wl,--gc-sections")
    command = [*sketch, f"-I{package / 'src'}", tmp_path / "sketch.cpp", tmp_path / "ins_all.o", "-lm"]
    run(*command, "-o", tmp_path / "sketch.elf")
    assert "ins_attitude_step" in run("avr-nm", tmp_path / "sketch.elf")


def test_esp_idf_packs_the_component_and_riscv_builds_it(tmp_path: Path) -> None:
    package = assemble("esp_idf", tmp_path / "libins", "--url", URL)
    packed = tmp_path / "packed"
    compote = (sys.executable, "-m", "idf_component_manager")
    run(*compote, "component", "pack", "--name", "libins", "--project-dir", package, "--dest-dir", packed)
    assert (packed / f"libins_{version()}.tgz").is_file()
    options = kconfiglib.Kconfig(str(package / "Kconfig"), warn_to_stderr=False)
    assert options.warnings == []
    assert {symbol.name: symbol.str_value for symbol in options.unique_defined_syms} == {"INS_REAL_FLOAT": "y"}
    symbols = cross_build(tmp_path, ESP_IDF, package, "y", "riscv64-unknown-elf-gcc", RISCV)
    assert "__addsf3" in symbols and "ins_kalman" in symbols


def test_zephyr_finds_the_module_and_arm_builds_it(tmp_path: Path) -> None:
    package = assemble("zephyr", tmp_path / "libins")
    module = yaml.safe_load((package / "zephyr/module.yml").read_text("utf-8"))
    # Zephyr, scripts/zephyr_module.py, METADATA_SCHEMA and process_cmake(): cmake is a folder, kconfig a file.
    assert set(module) == {"name", "build"} and set(module["build"]) == {"cmake", "kconfig"}
    assert (package / module["build"]["cmake"] / "CMakeLists.txt").is_file()
    options = kconfiglib.Kconfig(str(package / module["build"]["kconfig"]), warn_to_stderr=False)
    assert options.warnings == []
    assert [symbol.name for symbol in options.unique_defined_syms] == ["LIBINS", "LIBINS_FLOAT"]
    options.syms["LIBINS"].set_value("y")
    assert options.syms["LIBINS_FLOAT"].str_value == "y"
    symbols = cross_build(tmp_path, ZEPHYR, package, "", ARM[0], " ".join(ARM[1:]))
    assert "__aeabi_dadd" in symbols and "__aeabi_fadd" not in symbols
