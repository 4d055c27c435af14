"""What passed on a board's nets, inputs and line: kept for a page within bounds, and taken back with the run."""

from collections import deque
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
    """Rows of numbers by instant, the first column: the newest so many, numbered from the begin."""

    def __init__(self, kept: int, columns: int, kind: Any) -> None:
        """Nothing yet."""
        self._kept, self._empty = kept, np.empty((0, columns), kind)
        self._blocks: deque[Array] = deque()
        self.gone = 0
        """No longer kept."""
        self.count = 0
        """All since the begin."""
        self.told = 0
        """Those that pages know."""

    def add(self, rows: Array) -> None:
        """In the order of time, behind those that are there."""
        if len(rows):
            self._blocks.append(rows)
            self.count += len(rows)
            while self.count - self.gone - len(self._blocks[0]) >= self._kept:
                self.gone += len(self._blocks.popleft())

    def cut(self, at: int) -> None:
        """Nothing later than an instant has been."""
        while self._blocks and self._blocks[-1][-1, 0] > at:
            last = self._blocks.pop()
            self.count -= len(last)
            self.add(last[: np.searchsorted(last[:, 0], at, side="right")])
        self.told = min(self.told, self.count)

    def until(self, at: int) -> int:
        """How many since the begin are no later than an instant."""
        count = self.count
        for block in reversed(self._blocks):
            if block[-1, 0] <= at:
                break
            count -= len(block) - int(np.searchsorted(block[:, 0], at, side="right"))
        return count

    def part(self, first: int, end: int) -> Array:
        """Those with the numbers first .. end - 1, as far as they are kept."""
        blocks: list[Array] = []
        begin = self.count
        for block in reversed(self._blocks):
            if begin <= first:
                break
            begin -= len(block)
            if begin < end:
                blocks.append(block)
        kept = np.concatenate([self._empty, *reversed(blocks)])
        return kept[max(0, first - begin) : max(0, end - begin)]

    @property
    def begin(self) -> int | None:
        """The first instant that is kept; None: nothing is."""
        return int(self._blocks[0][0, 0]) if self._blocks else None


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


class History:
    """Follows the timeline of a run that keeps edges and samples, the known future included; see timeline.Follower."""

    def __init__(self) -> None:
        """Nothing yet."""
        self.edges = Rows(EDGES_KEPT, 3, np.int64)
        """Instant [ps], index in WIRES, level."""
        self.samples = Rows(SAMPLES_KEPT, 4, np.float64)
        """Instant [ps], channel, code, volts."""
        self.tx, self.rx = Rows(OCTETS_KEPT, 2, np.int64), Rows(OCTETS_KEPT, 2, np.int64)
        """What the board sent, and what it was sent: instant [ps], value."""
        self.totals = Totals()
        self.rewound: int | None = None
        """Since the last frame the run was taken back to that instant, and went on from it."""
        self._all = (self.edges, self.samples, self.tx, self.rx)
        self._now_ps = self._until_ps = -1
        """Where the run is, and until when all that passed is here: a replay brings nothing new."""

    def follow(self, run: Any, received: list[tuple[int, int, bool]]) -> None:
        """See timeline.Follower."""
        pins = _run.take_pin_edges(run)
        pins[:, 1] = _WIRE_OF_PIN[pins[:, 1]]
        edges = np.concatenate([run.take_edges(), pins[pins[:, 1] >= 0]])
        samples = np.array(_run.take_samples(run), np.float64).reshape(-1, 4)
        sent = run.take_sent()
        passed = (edges[np.argsort(edges[:, 0], kind="stable")], samples, _octets(received), _octets(sent))
        begin, self._now_ps = self._now_ps, int(run.now_ps)
        if self._now_ps > self._until_ps:
            for rows, new in zip(self._all, passed, strict=True):
                if begin < self._until_ps:  # what came at that very instant comes again
                    rows.cut(self._until_ps - 1)
                    new = new[np.searchsorted(new[:, 0], self._until_ps) :]
                rows.add(new)
            self._until_ps = self._now_ps
        states, _ = run.take_states()
        if len(states):
            self.totals = self.totals.add(states)

    def cut(self, at_ps: int) -> None:
        """See timeline.Follower."""
        for rows in self._all:
            rows.cut(at_ps)
        self._until_ps = min(self._until_ps, at_ps)

    def save(self) -> object:
        """See timeline.Follower."""
        return self.totals

    def restore(self, saved: object, at_ps: int) -> None:
        """See timeline.Follower."""
        assert isinstance(saved, Totals)
        self.totals = saved
        self._now_ps = at_ps
        for rows in self._all:
            rows.told = min(rows.told, rows.until(at_ps))
        self.rewound = at_ps if self.rewound is None else min(self.rewound, at_ps)


def _octets(octets: list[tuple[int, int, bool]]) -> Array:
    return np.array([(at, value) for at, value, _ in octets], np.int64).reshape(-1, 2)
