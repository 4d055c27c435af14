"""The bare-metal example: built by its own Makefile, run on QEMU's Cortex-M0 and Cortex-M4F, where it checks itself."""

import re
import shutil
import struct
from pathlib import Path

import pytest
from packaging_kit import CORE, EXAMPLES, ROOT, run

FIRMWARE = {"attitude_m0.elf": "microbit", "strapdown_m4f.elf": "mps2-an386"}
TABLE = 500 * 24  # octets
FLASH_OF_PAGE = (0.9, 1.02)  # what was saved may wait for the page, growth may not
QEMU = ("timeout", "20", "qemu-system-arm", "-nographic", "-monitor", "none", "-serial", "none")
SEMIHOSTING = ("-semihosting-config", "enable=on,target=native")


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("cortex_m")
    for path in (EXAMPLES / "cortex_m").iterdir():
        if path.suffix != ".elf" and path.is_file():
            shutil.copy(path, folder)
    run("make", "-j2", f"CORE={CORE}", cwd=folder)
    return folder


def test_the_table_is_what_the_script_writes() -> None:
    folder = EXAMPLES / "cortex_m"
    assert run("python3", folder / "make_motion.py") == (folder / "motion.inc").read_text(encoding="utf-8")


def emulate(machine: str, firmware: Path, code: int = 0) -> str:
    return run(*QEMU, "-M", machine, *SEMIHOSTING, "-kernel", firmware, code=code)


@pytest.mark.parametrize("firmware", FIRMWARE)
def test_it_navigates(built: Path, firmware: str) -> None:
    assert emulate(FIRMWARE[firmware], built / firmware).startswith("500 steps, ")


@pytest.mark.parametrize("firmware", FIRMWARE)
def test_it_takes_the_flash_the_page_says(built: Path, firmware: str) -> None:
    page = (ROOT / "docs/linking.md").read_text(encoding="utf-8")
    row = re.search(rf"^\| `{firmware[:-4]}`:[^|]*\| ([\d,]+) \|", page, re.MULTILINE)
    assert row
    text, data = map(int, run("arm-none-eabi-size", built / firmware).splitlines()[1].split()[:2])
    low, high = FLASH_OF_PAGE
    assert low <= (text + data - TABLE) / int(row[1].replace(",", "")) <= high


@pytest.mark.parametrize(("firmware", "column"), [(name, c) for name in FIRMWARE for c in range(6)])
def test_a_lie_of_the_imu_is_seen(built: Path, tmp_path: Path, firmware: str, column: int) -> None:
    """One figure of one reading of 500 off by 140 urad or 1.1 mm/s, in the image: the firmware must say no."""
    table = (built / "motion.inc").read_text(encoding="utf-8")
    row = [int(word) for word in re.findall(r"^    \{(.*)\},$", table, re.MULTILINE)[250].split(", ")]
    image = (built / firmware).read_bytes()
    assert image.count(struct.pack("<6i", *row)) == 1
    lie = row[:column] + [row[column] + 300_000] + row[column + 1 :]
    (tmp_path / firmware).write_bytes(image.replace(struct.pack("<6i", *row), struct.pack("<6i", *lie)))
    reads_force = firmware == "strapdown_m4f.elf"
    emulate(FIRMWARE[firmware], tmp_path / firmware, code=1 if column < 3 or reads_force else 0)
