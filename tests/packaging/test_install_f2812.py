"""f2812-cc and add_f2812_firmware() installed, moved, and used from outside: the example, and the compiler alone."""

import json
from pathlib import Path

import pytest
from packaging_kit import EXAMPLES, ROOT, run

OFF = [f"-DINS_BUILD_{part}=OFF" for part in ("TESTS", "DDS", "PYTHON")]
CORE_USER = """#include "DSP281x_Device.h"
#include "ins/quat.h"

void main(void)
{
    ins_real q_nb[4] = {1, 0, 0, 0};
    if (ins_quat_normalise(q_nb) != INS_OK)
        ESTOP0;
}
"""


@pytest.fixture(scope="module")
def prefix(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("f2812")
    run("cmake", "-G", "Ninja", "-S", ROOT, "-B", folder / "build", *OFF, "-DCMAKE_BUILD_TYPE=Release")
    targets = ("ins_core", "ins_coref", "ins_emu", "f2812_runtime")
    run("cmake", "--build", folder / "build", "-j2", "--target", *targets)
    run("cmake", "--install", folder / "build", "--prefix", folder / "as_installed")
    return (folder / "as_installed").rename(folder / "as_used")


def test_the_example_passes_and_can_fail(prefix: Path, tmp_path: Path) -> None:
    source = EXAMPLES / "f2812_c"
    run("cmake", "-G", "Ninja", "-S", source, "-B", tmp_path, f"-DCMAKE_PREFIX_PATH={prefix}")
    run("cmake", "--build", tmp_path)
    assert "100% tests passed, 0 tests failed out of 2" in run("ctest", "--test-dir", tmp_path)
    heard = tmp_path / "heard"
    assert heard.read_text(encoding="utf-8").splitlines() == [f"count {n}" for n in range(10)]
    heard.write_text("count 1\n", encoding="utf-8")
    run("ctest", "--test-dir", tmp_path, "-R", "counter_heard", "-FS", "heard", code=8)


@pytest.mark.parametrize("bits", ["-m32", "-m64"])
def test_the_compiler_alone_links_the_core(prefix: Path, tmp_path: Path, bits: str) -> None:
    (tmp_path / "app.c").write_text(CORE_USER, encoding="utf-8")
    run(prefix / "bin/f2812-cc", bits, "--core", "app.c", "-o", "app.f2812", cwd=tmp_path)
    assert json.loads(run(tmp_path / "app.f2812"))["ended"] == "main() returned"
