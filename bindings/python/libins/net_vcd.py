"""A run of stations on lines as a value change dump; see vcd.py.

A scope a station: its wires, and each octet from its start bit to the middle of its stop bit, at the baud of its line.
Of an F2812 also `interrupt`, the one in service, and the registers asked for, as the firmware reads or writes them.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TextIO

from libins import uart, vcd

BITS = 16


@dataclass(frozen=True)
class Wire:
    """A traced wire of a station."""

    station: str
    name: str
    baud: float
    """Of its line."""


class Dump:
    """Takes a run slice by slice and writes it as it comes."""

    def __init__(
        self, file: TextIO, begin_ps: int, wires: Sequence[Wire], registers: Mapping[str, Mapping[int, str]]
    ) -> None:
        """registers: name by address, of each F2812 by its name."""
        self._writer = vcd.Writer(file, begin_ps, min((wire.baud for wire in wires), default=50.0))
        self._wires = wires
        self._nets = [self._variable(w.station, w.name, "wire", 1, 1) for w in wires]
        self._octets = [self._variable(w.station, f"{w.name}_octet", "string", None, "") for w in wires]
        self._decoders = [uart.Decoder(wire.baud) for wire in wires]
        self._interrupts = {board: self._variable(board, "interrupt", "string", None, "") for board in registers}
        self._registers = {
            (board, address): self._variable(board, name, "reg", BITS, None)
            for board, names in registers.items()
            for address, name in names.items()
        }

    def _variable(self, scope: str, name: str, kind: str, size: int | None, value: Any) -> Any:
        return self._writer.variable(scope, name, kind, size, value)

    def edges(self, edges: Any, now_ps: int) -> None:
        """Those since the last call, up to now."""
        put = self._writer.put
        for at, wire, level in edges.tolist():
            put(at, self._nets[wire], level)
        for number, decoder in enumerate(self._decoders):
            mine = ((at, bool(level)) for at, wire, level in edges.tolist() if wire == number)
            for frame in decoder.feed(mine, now_ps):
                self._writer.octet(frame, self._octets[number])

    def access(self, board: str, at: int, address: int, value: int) -> None:
        """A register was read or written."""
        variable = self._registers.get((board, address))
        if variable is not None:
            self._writer.put(at, variable, value)

    def interrupt(self, board: str, at: int, name: str) -> None:
        """In service from now on; "": none."""
        self._writer.put(at, self._interrupts[board], name)

    def write(self, now_ps: int) -> None:
        """What is certain."""
        self._writer.write(now_ps)

    def close(self, now_ps: int) -> None:
        """Write what is still held back, and the end's instant."""
        self._writer.close(now_ps)
