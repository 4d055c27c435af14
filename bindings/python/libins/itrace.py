"""An instruction trace as text: cycle, address, octets, instruction, and the registers it changed.

    1234  0123  75 90 ff  mov P1,#0xff
    1236  0126  e5 30     mov a,0x30                  A=5a

Registers of the bank in use are called R0 to R7; P, the parity, is seen in PSW.
"""

from collections.abc import Callable
from typing import TextIO

import numpy as np
import numpy.typing as npt

from libins import disasm

REGISTERS = ("A", "B", "PSW", "SP", "DPL", "DPH", *(f"R{n}" for n in range(8)))
BANK = 0x18
"""RS1 and RS0 in PSW."""
PSW_COLUMN = REGISTERS.index("PSW")
NEWS_COLUMN = 54

Trace = tuple[npt.NDArray[np.uint64], npt.NDArray[np.uint16], npt.NDArray[np.uint8]]
"""Cycle, address, registers before each instruction: Observer.take_trace()."""


class Writer:
    """Writes the trace of a run as it comes: an instruction when the next one is known, with what it changed."""

    def __init__(self, file: TextIO, code: Callable[[int], int]) -> None:
        """Code memory does not change during the run."""
        self._file = file
        self._code = code
        self._texts: dict[int, str] = {}
        self._last: Trace | None = None

    def _text(self, address: int) -> str:
        if address not in self._texts:
            i = disasm.decode(self._code, address)
            self._texts[address] = f"{address:04x}  {i.octets.hex(' '):<8}  {i.text}"
        return self._texts[address]

    def slice(self, trace: Trace) -> None:
        """The instructions since the last call."""
        cycles, addresses, registers = trace
        if self._last is not None:
            cycles = np.concatenate((self._last[0], cycles))
            addresses = np.concatenate((self._last[1], addresses))
            registers = np.concatenate((self._last[2], registers))
        if not len(cycles):
            return
        changed = registers[1:] != registers[:-1]
        other_bank = (registers[1:, PSW_COLUMN] ^ registers[:-1, PSW_COLUMN]) & BANK != 0
        changed[other_bank, len(REGISTERS) - 8 :] = False
        news: dict[int, str] = {}
        rows, columns = np.nonzero(changed)
        for row, column, value in zip(rows.tolist(), columns.tolist(), registers[1:][changed].tolist(), strict=True):
            news[row] = f"{news.get(row, '')} {REGISTERS[column]}={value:02x}"
        places = zip(cycles[:-1].tolist(), addresses[:-1].tolist(), strict=True)
        for row, (cycle, address) in enumerate(places):
            line = f"{cycle:>10}  {self._text(address)}"
            self._file.write(f"{line:<{NEWS_COLUMN}}{news[row]}\n" if row in news else line + "\n")
        self._last = (cycles[-1:], addresses[-1:], registers[-1:])

    def close(self) -> None:
        """Write the last instruction, whose end nobody saw."""
        if self._last is not None:
            self._file.write(f"{self._last[0][0]:>10}  {self._text(int(self._last[1][0]))}\n")
