"""What passed on a board's nets, inputs and line: kept for a page within bounds, and taken back with the run."""

from collections import deque
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from libins import _run
from libins.machine import COLUMNS, Array

EDGES_KEPT = 1 << 20
SAMPLES_KEPT = 1 << 16
OCTETS_KEPT = 1 << 14
CHANNELS = 11
ERRORS = tuple(COLUMNS[f"error_{axis}_rad"] for axis in ("roll", "pitch", "yaw"))

PINS = {"P1.0": "EOC", "P1.1": "I/O CLOCK", "P1.2": "DATA IN", "P1.3": "DATA OUT", "P1.4": "/CS"}
LINE_PINS = {"P3.0": "RXD", "P3.1": "TXD"}
NET_OF_PIN = PINS | LINE_PINS
"""Port pins with a net that has a name of its own."""
OTHERS = tuple(
    (8 * port + bit, f"P{port}.{bit}") for port in range(4) for bit in range(8) if f"P{port}.{bit}" not in NET_OF_PIN
)
WIRES: tuple[str, ...] = (*_run.WIRES, *(name for _, name in OTHERS))
"""Every net of the board once: those with names, then the other port pins."""
_WIRE_OF_PIN = np.full(32, -1)
for _place, (_pin, _) in enumerate(OTHERS, start=len(_run.WIRES)):
    _WIRE_OF_PIN[_pin] = _place


class Rows:
    """Rows of numbers by instant, the first column: the newest so many, and how many of them were told."""

    def __init__(self, kept: int, columns: int, kind: Any) -> None:
        """Nothing yet."""
        self._kept, self._empty = kept, np.empty((0, columns), kind)
        self._blocks: deque[Array] = deque()
        self._count = 0
        """Of rows in the blocks."""
        self._fresh = 0
        """Added and not told, those that are no longer kept included."""

    def add(self, rows: Array) -> None:
        """In the order of time, behind those that are there."""
        if not len(rows):
            return
        self._blocks.append(rows)
        self._count += len(rows)
        self._fresh += len(rows)
        while self._count - len(self._blocks[0]) >= self._kept:
            self._count -= len(self._blocks.popleft())

    def cut(self, at: int) -> None:
        """Nothing later than an instant has been."""
        before = self._count
        while self._blocks and self._blocks[-1][-1, 0] > at:
            last = self._blocks.pop()
            self._count -= len(last)
            rest = last[: np.searchsorted(last[:, 0], at, side="right")]
            if len(rest):
                self._blocks.append(rest)
                self._count += len(rest)
        self._fresh = max(0, self._fresh - (before - self._count))

    def take_fresh(self, most: int) -> tuple[Array, int]:
        """What was not told, or the newest of it, and how many rows that leaves out."""
        fresh, self._fresh = self._fresh, 0
        rows = self.last(min(fresh, most))
        return rows, fresh - len(rows)

    def last(self, most: int) -> Array:
        """The newest."""
        blocks: list[Array] = []
        count = 0
        for block in reversed(self._blocks):
            if count >= most:
                break
            blocks.insert(0, block)
            count += len(block)
        return np.concatenate([self._empty, *blocks])[max(0, count - most) :]

    def between(self, begin: int, end: int) -> Array:
        """Those of an interval."""
        blocks = [block for block in self._blocks if block[-1, 0] >= begin and block[0, 0] <= end]
        rows = np.concatenate([self._empty, *blocks])
        return rows[(rows[:, 0] >= begin) & (rows[:, 0] <= end)]

    @property
    def begin(self) -> int | None:
        """The first instant that is kept; None: nothing is."""
        return int(self._blocks[0][0, 0]) if self._blocks else None


class Octets:
    """One direction of a line."""

    def __init__(self) -> None:
        """Nothing yet."""
        self.count = 0
        """Since the begin."""
        self._kept: deque[tuple[int, int]] = deque(maxlen=OCTETS_KEPT)
        self._told = 0

    def add(self, octets: Iterable[tuple[int, int]]) -> None:
        """Instants and values."""
        before = self.count
        for octet in octets:
            self._kept.append(octet)
            before += 1
        self.count = before

    def cut(self, at: int, count: int) -> None:
        """Nothing later than an instant has been; count: of what was before."""
        while self._kept and self._kept[-1][0] > at:
            self._kept.pop()
        self.count = count
        self._told = min(self._told, count)

    def take_fresh(self, whole: bool) -> tuple[str, int]:
        """What was not told, or all that is kept, in hexadecimal; and the number of its first octet."""
        wanted = len(self._kept) if whole else min(len(self._kept), self.count - self._told)
        octets = bytes(value for _, value in list(self._kept)[len(self._kept) - wanted :])
        self._told = self._told if whole else self.count
        return octets.hex(), self.count - wanted


@dataclass
class Totals:
    """Of the navigation states so far: what expectations are judged by."""

    count: int = 0
    first_scan: int = 0
    last: Array | None = None
    """The newest state's row."""
    squares: Array = field(default_factory=lambda: np.zeros(3))
    largest: Array = field(default_factory=lambda: np.zeros(3))
    ages: tuple[float, float, float] = (np.inf, 0.0, 0.0)
    """Least, sum, most."""

    def add(self, states: Array) -> "Totals":
        """With more of them."""
        errors, ages = np.abs(states[:, ERRORS]), states[:, COLUMNS["age_s"]]
        return Totals(
            self.count + len(states),
            self.first_scan if self.count else int(states[0, COLUMNS["scan"]]),
            states[-1],
            self.squares + (errors**2).sum(axis=0),
            np.maximum(self.largest, errors.max(axis=0)),
            (min(self.ages[0], ages.min()), self.ages[1] + ages.sum(), max(self.ages[2], ages.max())),
        )


@dataclass(frozen=True)
class _Saved:
    tx: int
    rx: int
    totals: Totals


class History:
    """Follows the timeline of a run that keeps edges and samples; see timeline.Follower."""

    def __init__(self) -> None:
        """Nothing yet."""
        self.edges = Rows(EDGES_KEPT, 3, np.int64)
        """Instant [ps], index in WIRES, level."""
        self.samples = Rows(SAMPLES_KEPT, 4, np.float64)
        """Instant [ps], channel, code, volts."""
        self.tx, self.rx = Octets(), Octets()
        """What the board sent, and what it was sent."""
        self.totals = Totals()
        self.rewound: int | None = None
        """Since the last frame the run was taken back to that instant, and went on from it."""
        self.latest: dict[int, tuple[float, int]] = {}
        """Volts and code of each channel's newest sample."""

    def follow(self, run: Any, received: list[tuple[int, int, bool]]) -> None:
        """See timeline.Follower."""
        pins = _run.take_pin_edges(run)
        pins[:, 1] = _WIRE_OF_PIN[pins[:, 1]]
        both = np.concatenate([run.take_edges(), pins[pins[:, 1] >= 0]])
        self.edges.add(both[np.argsort(both[:, 0], kind="stable")])
        samples = _run.take_samples(run)
        self.samples.add(np.array(samples, np.float64).reshape(-1, 4))
        for _, channel, code, volts in samples:
            self.latest[channel] = (volts, code)
        self.tx.add((at, value) for at, value, _ in received)
        self.rx.add((at, value) for at, value, _ in run.take_sent())
        states, _ = run.take_states()
        if len(states):
            self.totals = self.totals.add(states)

    def save(self) -> object:
        """See timeline.Follower."""
        return _Saved(self.tx.count, self.rx.count, self.totals)

    def restore(self, saved: object, at_ps: int) -> None:
        """See timeline.Follower."""
        assert isinstance(saved, _Saved)
        self.edges.cut(at_ps)
        self.samples.cut(at_ps)
        self.tx.cut(at_ps, saved.tx)
        self.rx.cut(at_ps, saved.rx)
        self.totals = saved.totals
        self.latest = {int(row[1]): (float(row[3]), int(row[2])) for row in self.samples.last(2 * CHANNELS)}
        self.rewound = at_ps if self.rewound is None else min(self.rewound, at_ps)
