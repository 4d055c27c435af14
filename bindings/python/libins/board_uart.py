"""The host's end of the board's serial line, as a test plays it: what came, when, and what was expected instead."""

import re
from collections.abc import Iterator
from typing import NamedTuple

Pattern = bytes | re.Pattern[bytes]
KEPT = 4096
"""Octets that are kept after they were matched, to be shown when a later one does not come."""
SHOWN = 40
"""Lines of a failure's text."""
PAUSE_OCTETS = 3
"""An idle line of so many octets' time begins a new line of a failure's text."""
BITS = 10
"""Of an octet on the line: start, eight, stop."""


class Octet(NamedTuple):
    """One octet the host received."""

    at_ps: int
    """In its stop bit."""
    value: int
    framing_ok: bool


class ExpectError(AssertionError):
    """The board did not send what was expected in time."""


class Inbox:
    """Octets received, and how far they were matched."""

    def __init__(self) -> None:
        """Nothing came."""
        self.octets: list[Octet] = []
        self.read = 0

    def add(self, octets: list[Octet]) -> None:
        """At the end; what was matched long ago is dropped."""
        self.octets += octets
        if self.read > 2 * KEPT:
            del self.octets[: self.read - KEPT]
            self.read = KEPT

    def unread(self) -> bytes:
        """What has not been matched yet."""
        return bytes(octet.value for octet in self.octets[self.read :])

    def take(self, pattern: Pattern) -> re.Match[bytes] | None:
        """The first match in what is unread; it and what stands before it are read then."""
        match = re.search(re.escape(pattern) if isinstance(pattern, bytes) else pattern, self.unread())
        if match is not None:
            self.read += match.end()
        return match


def failure(wanted: str, inbox: Inbox, from_ps: int, now_ps: int, baud: float, where: str) -> str:
    """Why an expectation was not met: what came instead, decoded, and when."""
    span = f"from {seconds(from_ps)} to {seconds(now_ps)}"
    came = inbox.octets[inbox.read :]
    if not came:
        last = f"; the last octet came at {seconds(inbox.octets[-1].at_ps)}" if inbox.octets else ""
        return f"{wanted} did not come {span}: nothing came{last}; {where}"
    bad = sum(not octet.framing_ok for octet in came)
    hint = f"; {bad} of {len(came)} octets had no stop bit: is the board's line at {baud:g} Bd?" if bad else ""
    lines = [f"{wanted} did not come {span}; {where}{hint}", f"came instead, {len(came)} octets:"]
    return "\n".join([*lines, *shown(came, baud)])


def shown(octets: list[Octet], baud: float) -> list[str]:
    """The last lines of what came, decoded, each with its first octet's instant."""
    lines = [f"  {seconds(line[0].at_ps)}  {_decoded(line)}" for line in _lines(octets, baud)] if octets else []
    return lines if len(lines) <= SHOWN else [f"  ... {len(lines) - SHOWN} lines before", *lines[-SHOWN:]]


def seconds(at_ps: int) -> str:
    """An instant, for a message."""
    return f"{at_ps * 1e-12:.6f} s"


def _lines(octets: list[Octet], baud: float) -> Iterator[list[Octet]]:
    """Parted after a line feed and at pauses."""
    pause_ps = PAUSE_OCTETS * BITS * 1e12 / baud
    line: list[Octet] = []
    for octet in octets:
        if line and (line[-1].value == ord("\n") or octet.at_ps - line[-1].at_ps > pause_ps):
            yield line
            line = []
        line.append(octet)
    yield line


def _decoded(octets: list[Octet]) -> str:
    """As bytes in Python; octets without a stop bit are named."""
    text = repr(bytes(octet.value for octet in octets))
    bad = [str(i) for i, octet in enumerate(octets) if not octet.framing_ok]
    return text + (f"  (no stop bit: octet {', '.join(bad)})" if bad else "")
