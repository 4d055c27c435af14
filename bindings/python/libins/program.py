"""Programs that know no board, as SDCC's regression tests: a console, an end, an exit code."""

import re
from dataclasses import dataclass
from typing import Any

from libins.board_views import sfr_address
from libins.errors import UsageError

CONSOLES = ("sbuf0", "uart")
SPACES = {"iram": 0x100, "xdata": 0x10000}


@dataclass(frozen=True)
class Program:
    """What the options of `ins run` say about a program."""

    console: str | None = None
    """sbuf0: SBUF written in mode 0; uart: what the host's end of the line receives."""
    stop_on_read: int | None = None
    """Its end: a read of this XDATA address. A jump to itself with interrupts off is one as well."""
    exit_from: tuple[str, int] | None = None
    """Where the exit code lies at the end: address space and address."""

    def start(self, run: Any) -> None:
        """Look at the program from now on."""
        run.watch_program(self.console == "sbuf0", self.stop_on_read)

    def output(self, run: Any) -> bytes:
        """What it wrote to its console since the last call."""
        octets: bytes = run.take_octets() if self.console == "uart" else run.take_output()
        return octets

    def ended(self, run: Any) -> str | None:
        """How it ended, or None."""
        if run.ended:
            return f"read of xdata {self.stop_on_read:#06x}"
        return "halted" if run.halted else None

    def exit_code(self, run: Any) -> int:
        """0 without a place for it."""
        return run.read(*self.exit_from, 1)[0] if self.exit_from else 0


def address(text: str, option: str, limit: int = 0x10000) -> int:
    """A number of the command line, decimal or 0x. Raises UsageError."""
    if not re.fullmatch(r"0[xX][0-9a-fA-F]+|[0-9]+", text) or not int(text, 0) < limit:
        raise UsageError(f"{option} {text}: an address in 0 .. {limit - 1:#x} is needed")
    return int(text, 0)


def exit_place(text: str) -> tuple[str, int]:
    """From iram:0x30, xdata:0x7654 or a register's name. Raises UsageError."""
    space, colon, number = text.partition(":")
    if colon and space not in SPACES:
        raise UsageError(f"--exit-from {text}: iram:0xNN, xdata:0xNNNN or a register such as ACC is needed")
    return (space, address(number, f"--exit-from {space}:", SPACES[space])) if colon else ("sfr", sfr_address(text))
