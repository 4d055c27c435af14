"""The program that the debugger's tests step through, and its lines by their comments."""

from pathlib import Path

from sdcc_kit import FIRMWARE, build

from libins import debugger

SOURCE = FIRMWARE / "steps.c"
XDATA = {"xdata_octets": 256}


def line_of(mark: str) -> int:
    """Number of the one line with this comment."""
    numbers = [
        n for n, line in enumerate(SOURCE.read_text(encoding="ascii").splitlines(), 1) if f"/* {mark} */" in line
    ]
    assert len(numbers) == 1, f"{mark!r} is in lines {numbers}"
    return numbers[0]


def mark_of(number: int) -> str:
    """The comment of a line."""
    return SOURCE.read_text(encoding="ascii").splitlines()[number - 1].rpartition("/* ")[2].removesuffix(" */")


def image(folder: Path) -> Path:
    """Built there, its .cdb beside it."""
    return build(SOURCE, folder, "--debug", "--xram-size", "256")


def opened(path: Path) -> debugger.Debugger:
    """From power-on, nobody at the other end of the line."""
    return debugger.open_scenario(str(path), settings=XDATA)
