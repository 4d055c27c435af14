"""Every C example compiles in both number types: ```c blocks of README and docs, usage examples of public headers."""

import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).resolve().parent
INCLUDES = [
    "libins/core/include",
    "libins/host/truth/include",
    "libins/host/navd/include",
    "libins/host/dds/include",
    "libins/host/calib/include",
    "emu/common/include",
    "emu/8051_tlc2543/include",
    "emu/f2812_sci/include",
]
GCC = ["gcc", "-std=c11", "-Wall", "-Wextra", "-Werror", "-Wno-unused-variable", *[f"-I{ROOT / i}" for i in INCLUDES]]
TYPES = {"double": ([], "libins.a"), "float": (["-DINS_REAL_FLOAT"], "libinsf.a")}
# Names that an example uses with another type than prelude.h gives them.
OWN_NAMES = {
    "ins/accelfit.h": "static ins_real u0[3], e1[3], e2[3], p_guess[8], reading[N], tolerance;"
    "static ins_accelfit_motion_t motion[N];",
    "ins/batch.h": "ins_real q_nb0[4 * N] = {0}, dtheta_b[3 * N] = {0};",
    "ins/gps_axis.h": "ins_real var[4] = {0};",
    "ins/gnss.h": "static ins_gnss_fix_t fix; static int64_t tow_ms, imu_t_ns; use(&fix);",
    "ins/gps_ins.h": "static ins_gps_ins_config_t cfg; static ins_gps_ins_start_t start; static ins_gnss_fix_t fix;"
    "static int64_t t_ns; static int new_fix;",
    "ins/gyro_free.h": "static ins_gyro_free_config_t config; static ins_accel_t accels[6];"
    "static ins_position_t start, fix_position; static ins_real sigma_m[3], l_b[3];",
    "ins/gps_ins_align.h": "static ins_gps_ins_config_t cfg; static ins_gps_ins_start_t start;"
    "static ins_gnss_fix_t fix; static ins_gps_ins_align_config_t how; static ins_gps_ins_t n;"
    "static int64_t t_ns; static int new_fix;",
    "ins/kf15.h": "static ins_strapdown_t s; static ins_real sigma[15]; static ins_kf15_sensors_t sensors;",
    "ins/kf15_scale.h": "static ins_kf15_scale_sensors_t sensors; static ins_kf15_t f; static ins_kf15_model_t m;"
    "static ins_real h[15], h_s[6]; static ins_innovation_t z;",
    "ins/q31.h": "int32_t q_nb0[4] = {0}, dtheta_b[3] = {0};",
    "ins_nav/six.h": "static ins_nav_six_t six; static ins_nav_six_config_t config; static ins_nav_six_state_t state;"
    "static ins_nav_link_t link; static ins_nav_sample_t sample; static double lat_lon_height[3], age_s, sigma_m[3];",
    "ins_nav/vehicle.h": "static ins_vehicle_t v; static int port; static ins_nav_solution_t solution;",
    "ins_truth/body.h": "static ins_track_site_t site; static ins_drive_t* drive;",
    "ins_truth/drive.h": "static ins_track_site_t site; static ins_body_input_t input;",
    "ins_truth/exact.h": "static double t0, t1, dtheta_b[3], dv_b[3];",
    "ins_truth/front_end.h": "static ins_gyro_t gyro;",
    "ins_truth/imu.h": "static double theta[3], v[3], dt;",
    "ins/still.h": "static ins_still_config_t config;",
}


def pages() -> list[Path]:
    return [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]


def blocks_of_page(text: str) -> list[str]:
    return re.findall(r"^```c\n(.*?)^```", text, re.DOTALL | re.MULTILINE)


def blocks_of_header(text: str) -> list[str]:
    """The indented blocks of the comment at the top that call this project's functions; other blocks are diagrams."""
    top = text.split("#ifndef", 1)[0]
    found = re.findall(r"((?:^///     .*\n)+)", top, re.MULTILINE)
    examples = ["".join(line[8:] + "\n" for line in block.splitlines()) for block in found]
    return [example for example in examples if re.search(r"\b(ins|emu|acq_board|mcs51|tlc2543|f2812)_\w+\(", example)]


def headers() -> list[Path]:
    return sorted(path for include in INCLUDES for path in (ROOT / include).rglob("*.h"))


def name(header: Path) -> str:
    return str(header.relative_to(next(ROOT / i for i in INCLUDES if header.is_relative_to(ROOT / i))))


PAGE_EXAMPLES = [
    pytest.param(block, id=f"{page.relative_to(ROOT)}-{n}")
    for page in pages()
    for n, block in enumerate(blocks_of_page(page.read_text(encoding="utf-8")), start=1)
]
HEADER_EXAMPLES = [
    pytest.param(header, block, id=f"{name(header)}-{n}")
    for header in headers()
    for n, block in enumerate(blocks_of_header(header.read_text(encoding="utf-8")), start=1)
]


def only_double(example: str) -> bool:
    """The host's and the emulator's libraries have one number type."""
    return (
        re.search(
            r"\b(ins_(nav(?!_block)|vehicle|dds|ros|motion|gyro|accels|imu|truth|track|gps(?!_axis|_ins))|emu|acq_board)_\w+",
            example,
        )
        is not None
    )


def compile_body(tmp_path: Path, example: str, own_names: str, flags: list[str]) -> None:
    source = tmp_path / "example.c"
    source.write_text(
        f'#include "{HERE}/prelude.h"\nvoid example(void);\nvoid example(void)\n{{\n{own_names}\n{{\n{example}}}\n}}\n',
        encoding="utf-8",
    )
    done = subprocess.run([*GCC, *flags, "-c", source, "-o", tmp_path / "example.o"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("number", TYPES)
@pytest.mark.parametrize(("header", "example"), HEADER_EXAMPLES)
def test_the_example_of_a_header_compiles(header: Path, example: str, number: str, tmp_path: Path) -> None:
    if number == "float" and only_double(example):
        return
    compile_body(tmp_path, example, OWN_NAMES.get(name(header), ""), TYPES[number][0])


@pytest.mark.parametrize("number", TYPES)
@pytest.mark.parametrize("example", PAGE_EXAMPLES)
def test_the_example_of_a_page_compiles(example: str, number: str, tmp_path: Path) -> None:
    """One with a main() is linked and run as well."""
    flags, archive = TYPES[number]
    if number == "float" and only_double(example):
        return
    if "int main(" not in example:
        compile_body(tmp_path, example, "", flags)
        return
    source, program = tmp_path / "example.c", tmp_path / "example"
    source.write_text(example, encoding="utf-8")
    library = ROOT / "build/release/libins/core" / archive
    assert library.exists(), f"{library} is missing: run ./dev test"
    done = subprocess.run([*GCC, *flags, source, library, "-lm", "-o", program], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    subprocess.run([program], check=True, timeout=10)


def test_there_are_examples() -> None:
    """Guards the extraction: these headers show how they are used, and README is a program."""
    shown = {name(p.values[0]) for p in HEADER_EXAMPLES}
    assert {"ins/attitude.h", "ins/kalman.h", "ins/strapdown.h", "ins/tm.h", "ins_nav/nav.h"} <= shown
    assert any("README" in str(p.id) and "int main(" in p.values[0] for p in PAGE_EXAMPLES)


def test_a_wrong_example_is_found(tmp_path: Path) -> None:
    [block] = blocks_of_header(
        "/// \\file x\n///\n///     ins_attitude_t a;\n///     ins_attitude_start(&a);\n#ifndef X\n"
    )
    with pytest.raises(AssertionError, match="ins_attitude_start"):
        compile_body(tmp_path, block, "", [])
