"""What a test does with an emulated board of either kind: let time pass, and wait for octets of a line."""

import re
from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from libins.board_uart import ExpectError, Inbox, Pattern, failure
from libins.errors import UsageError
from libins.machine import PS_PER_S


@dataclass(frozen=True)
class Input:
    """Something the outside did to a board, so that it can be done again."""

    at_ps: int
    what: str
    arguments: tuple[Any, ...]


def never() -> bool:
    """Go on to the end."""
    return False


class Bench(ABC):
    """A board on the test's bench."""

    @property
    @abstractmethod
    def now_ps(self) -> int:
        """Simulated time since power-on [ps]."""

    @abstractmethod
    def where(self) -> str:
        """The place in the firmware, for a message."""

    @abstractmethod
    def _advance(self, end_ps: int, done: Callable[[], bool] = never, octet_at: str | None = None) -> bool:
        """To an instant, or until the run stops with `done` true. Returns whether it was done.

        octet_at: the host that stops the run with each octet that it receives.
        """

    @abstractmethod
    def _do(self, what: str, *arguments: Any) -> Any:
        """Every change from outside passes here."""

    @abstractmethod
    def describe(self) -> str:
        """Where the board is, what it has to say about the firmware, and what hosts received last."""

    @property
    @abstractmethod
    def reports(self) -> list[dict[str, Any]]:
        """What the firmware did wrong, and what the emulator does not model."""

    def close(self) -> None:
        """Nothing of it is left running."""
        return

    def repeat(self, inputs: list[Input], end_ps: int) -> None:
        """Do again what the outside did, each at its instant, and run to the end."""
        for each in inputs:
            self._advance(each.at_ps)
            self._do(each.what, *each.arguments)
        self._advance(end_ps)

    @property
    def now_s(self) -> float:
        """Simulated time since power-on [s]."""
        return self.now_ps / PS_PER_S

    def run_for(self, seconds: float) -> None:
        """Let simulated time pass."""
        if not 0 <= seconds <= 1e6:
            raise UsageError(f"run_for({seconds}): 0 to 1e6 seconds are possible")
        self._advance(self.now_ps + round(seconds * PS_PER_S))

    def run_until(self, when: float | Callable[[], bool], within_s: float = 1.0, every_s: float = 1e-3) -> None:
        """Until an instant [s], or until a condition holds, which is looked at every so often.

        Raises TimeoutError when it does not hold within_s from now.
        """
        __tracebackhide__ = True
        if not callable(when):
            self.run_for(when - self.now_s)
            return
        end = self.now_ps + round(within_s * PS_PER_S)
        while not when():
            if self.now_ps >= end:
                raise TimeoutError(f"{when} did not hold within {within_s:g} s; {self.where()}")
            self._advance(min(end, self.now_ps + round(every_s * PS_PER_S)))

    def _expect(self, host: str, inbox: Inbox, pattern: Pattern, within_s: float, baud: float) -> re.Match[bytes]:
        """Run until a host has received octets that match. Raises ExpectError."""
        __tracebackhide__ = True
        start = self.now_ps
        end = start + round(within_s * PS_PER_S)
        found: list[re.Match[bytes]] = []

        def matched() -> bool:
            match = inbox.take(pattern)
            found.extend([match] if match else [])
            return match is not None

        if not matched() and not self._advance(end, matched, octet_at=host):
            wanted = repr(pattern if isinstance(pattern, bytes) else pattern.pattern)
            raise ExpectError(failure(wanted, inbox, start, self.now_ps, baud, self.where()))
        return found[0]
