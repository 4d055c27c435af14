"""Octets of an asynchronous line, 8N1, from its edges alone: what a logic analyser shows."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

PS_PER_S = 10**12
BITS = 10
"""Of a frame: start, eight of data, stop."""


@dataclass(frozen=True)
class Frame:
    """An octet on the line, from the edge of its start bit to the middle of its stop bit."""

    begin_ps: int
    end_ps: int
    octet: int
    framing_ok: bool
    """The stop bit was high."""

    def __str__(self) -> str:
        return f"{self.octet:02X}" + ("" if self.framing_ok else "!")


class Decoder:
    """Takes edges as they come; a frame is complete when the middle of its stop bit has passed."""

    def __init__(self, baud: float) -> None:
        """The line is idle, high, until its first edge."""
        self._bit_ps = PS_PER_S / baud
        self._level = True
        self._begin: int | None = None
        self._bits: list[bool] = []

    def feed(self, edges: Iterable[tuple[int, bool]], now_ps: int) -> Iterator[Frame]:
        """Frames that end up to now, from the edges (instant, level) since the last call up to now."""
        for at, level in edges:
            yield from self._pass(at)
            if self._begin is None and self._level and not level:
                self._begin, self._bits = at, []
            self._level = level
        yield from self._pass(now_ps + 1)

    def _pass(self, at: int) -> Iterator[Frame]:
        """Sample the middles of all bits before the instant `at`."""
        while self._begin is not None:
            middle = self._begin + round((len(self._bits) + 0.5) * self._bit_ps)
            if middle >= at:
                return
            self._bits.append(self._level)
            if self._bits[0]:  # no start bit, but a glitch
                self._begin = None
            elif len(self._bits) == BITS:
                octet = sum(bit << i for i, bit in enumerate(self._bits[1:-1]))
                yield Frame(self._begin, middle, octet, self._bits[-1])
                self._begin = None
