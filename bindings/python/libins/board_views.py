"""What one reads and pokes on a board: memories, registers, pins, volts and C variables."""

import difflib
import re
from collections.abc import Callable, Iterator, MutableMapping
from typing import Any

from libins import cdb_types
from libins.cdb import Cdb, Symbol
from libins.disasm import SFR
from libins.errors import UsageError
from libins.places import SPACES

Do = Callable[..., Any]
"""Carries out a change by name and arguments, and notes it, so that a run can be repeated."""


class Memory:
    """One address space: board.iram[0x30], board.xdata[0x100:0x110]; assignable by int or bytes."""

    def __init__(self, name: str, size: int, read: Callable[[str, int, int], bytes], do: Do) -> None:
        """The octets from 0 to size."""
        self._name, self._size, self._read, self._do = name, size, read, do

    def __len__(self) -> int:
        """Octets."""
        return self._size

    def _span(self, key: int | slice) -> tuple[int, int]:
        start, stop = (key.start or 0, key.stop) if isinstance(key, slice) else (key, key + 1)
        stop = self._size if stop is None else stop
        if isinstance(key, slice) and key.step not in (None, 1):
            raise UsageError(f"{self._name}: a slice has no step here")
        if not 0 <= start <= stop <= self._size:
            raise UsageError(f"{self._name}[{start:#x}:{stop:#x}]: this part has {self._size} octets of {self._name}")
        return start, stop - start

    def __getitem__(self, key: int | slice) -> Any:
        """An octet as int, or a slice as bytes."""
        octets = self._read(self._name, *self._span(key))
        return octets if isinstance(key, slice) else octets[0]

    def __setitem__(self, key: int | slice, value: int | bytes) -> None:
        """An octet, or a slice of as many octets as it is long."""
        start, count = self._span(key)
        octets = bytes([value]) if isinstance(value, int) else bytes(value)
        if len(octets) != count:
            raise UsageError(f"{self._name}[{start:#x}]: {len(octets)} octets for a place of {count}")
        self._do("write", self._name, start, octets)


def sfr_address(name: str) -> int:
    """Of a special function register by the data sheet's name. Raises UsageError."""
    if name.upper() in SFR:
        return SFR[name.upper()]
    near = difflib.get_close_matches(name.upper(), SFR, n=1)
    hint = f"did you mean {near[0]}?" if near else f"there are {', '.join(SFR)}"
    raise UsageError(f"{name}: no special function register; {hint}")


class Registers:
    """Special function registers by the data sheet's name or by address; of a port, its latch."""

    def __init__(self, read: Callable[[str, int, int], bytes], do: Do) -> None:
        """Of one CPU."""
        self._read, self._do = read, do

    def __getitem__(self, name: str | int) -> int:
        """Its value, without the side effects of reading it."""
        return self._read("sfr", self._address(name), 1)[0]

    def __setitem__(self, name: str | int, value: int) -> None:
        """Put a value, as a debugger does."""
        self._do("write", "sfr", self._address(name), bytes([value]))

    @staticmethod
    def _address(name: str | int) -> int:
        address = sfr_address(name) if isinstance(name, str) else name
        if not 0x80 <= address <= 0xFF:
            raise UsageError(f"sfr[{address:#x}]: special function registers lie in 0x80 .. 0xff")
        return address


class Volts(MutableMapping[int, float]):
    """What is put on an analogue input instead of its own signal: volts[0] = 1.25; del volts[0] takes it away."""

    def __init__(self, channels: int, do: Do) -> None:
        """Nothing put on yet."""
        self._channels, self._do = channels, do
        self.held: dict[int, float] = {}

    def __getitem__(self, channel: int) -> float:
        """What was put there. KeyError: the board's own signal is."""
        return self.held[channel]

    def __setitem__(self, channel: int, volts: float) -> None:
        """From this instant on."""
        if not 0 <= channel < self._channels:
            raise UsageError(f"volts[{channel}]: this board has AIN0 to AIN{self._channels - 1}")
        self._do("set_volts", channel, float(volts))

    def __delitem__(self, channel: int) -> None:
        """Give the input back to the board's own signal."""
        if channel not in self.held:
            raise KeyError(channel)
        self._do("clear_volts", channel)

    def __iter__(self) -> Iterator[int]:
        """Channels held."""
        return iter(self.held)

    def __len__(self) -> int:
        """How many are held."""
        return len(self.held)


class Pins:
    """Port pins by name: pins["P1.3"] is the level; pins["P3.2"] = False pulls it low from outside, None lets go."""

    def __init__(self, level: Callable[[int, int], bool], do: Do) -> None:
        """Of one CPU."""
        self._level, self._do = level, do

    def __getitem__(self, name: str) -> bool:
        """Level now."""
        return self._level(*self._place(name))

    def __setitem__(self, name: str, level: bool | None) -> None:
        """Drive it from outside, strongly, from this instant on."""
        self._do("drive_pin", *self._place(name), level)

    @staticmethod
    def _place(name: str) -> tuple[int, int]:
        m = re.fullmatch(r"[Pp]([0-3])\.([0-7])", name)
        if m is None:
            raise UsageError(f"{name}: no port pin; P0.0 to P3.7 are")
        return int(m[1]), int(m[2])


class Variables:
    """C variables by name, through the .cdb beside the image: variables["sampled"], "point.x", "table[3]"."""

    def __init__(self, table: Cdb, read: Callable[[str, int, int], bytes], do: Do, pc: Callable[[], int]) -> None:
        """Names are looked up as the code at pc() sees them."""
        self._table, self._read, self._do, self._pc = table, read, do, pc

    def _find(self, name: str) -> tuple[str, int, cdb_types.Type]:
        first, *steps = re.findall(r"\w+|\[\d+\]", name)
        if "".join(re.findall(r"\w+|\[\d+\]|\.", name)) != name:
            raise UsageError(f"{name}: a variable, then .member or [index], is needed")
        symbol = self._table.find(first, self._pc())
        kind, offset = symbol.type, 0
        if symbol.address is None or kind is None or symbol.space not in SPACES:
            raise UsageError(f"{name}: SDCC keeps it in {symbol.space.name.lower()} and says no address or no type")
        for step in steps:
            kind, offset = self._step(name, symbol, kind, step, offset)
        return SPACES[symbol.space], symbol.address + offset, kind

    def _step(
        self, name: str, symbol: Symbol, kind: cdb_types.Type, step: str, offset: int
    ) -> tuple[cdb_types.Type, int]:
        if step.startswith("["):
            index = int(step[1:-1])
            if kind.kind is not cdb_types.Kind.ARRAY or kind.target is None or index >= kind.length:
                raise UsageError(f"{name}: {kind} has no {step}")
            return kind.target, offset + index * kind.target.size
        if kind.kind is cdb_types.Kind.STRUCT:
            for member in self._table.members(symbol.module, kind):
                if member.name == step:
                    return member.type, offset + member.offset
        raise UsageError(f"{name}: {kind} has no member {step}")

    def __getitem__(self, name: str) -> Any:
        """An int or float; bytes of an array or struct."""
        space, address, kind = self._find(name)
        octets = self._read(space, address, kind.size)
        scalar = kind.kind not in (cdb_types.Kind.ARRAY, cdb_types.Kind.STRUCT)
        return cdb_types.scalar(kind, octets) if scalar else octets

    def __setitem__(self, name: str, value: int | bytes) -> None:
        """Whole integers, or the octets of anything."""
        space, address, kind = self._find(name)
        if isinstance(value, int):
            value = (value & (1 << 8 * kind.size) - 1).to_bytes(kind.size, "little")
        if len(value) != kind.size or kind.bits is not None:
            raise UsageError(f"{name}: {kind} is written as {kind.size} octets, or as an int")
        self._do("write", space, address, value)
