"""Firmware of the tests, compiled by SDCC where a test needs it."""

import subprocess
from pathlib import Path

FIRMWARE = Path(__file__).resolve().parents[1] / "data/firmware"


def build(source: Path, folder: Path, *flags: str, model: str = "small") -> Path:
    """The .ihx of one C file in `folder`; the .cdb is beside it when --debug is among the flags."""
    image = folder / f"{source.stem}.ihx"
    command = ["sdcc", "-mmcs51", f"--model-{model}", "--std-sdcc11", *flags, str(source), "-o", str(image)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode == 0, f"{' '.join(command)}\n{done.stdout}{done.stderr}"
    return image
