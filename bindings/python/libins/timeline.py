"""A run that can be taken back: snapshots as it goes, and deterministic replay from the nearest.

What the outside does to the board is noted with its instant and repeated by a replay; what is done anew drops the
future that was there. Snapshots lie each SPACING cycles, closer behind the newest; where they would pass the budget,
every second one is dropped and the spacing doubled.
"""

from bisect import bisect_left, bisect_right
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol

from libins.run import PS_PER_S

SPACING = 100_000
"""Machine cycles between snapshots."""
FINER = 16
"""Snapshots within the newest spacing."""
BUDGET = 256 << 20
"""Octets of snapshots."""
CLOCKS_PER_CYCLE = 12
RECEIVED_KEPT = 1 << 16
"""Octets of the host that trim() leaves."""


class Position(NamedTuple):
    """An instant of the run, and how many inputs were carried out before it."""

    at_ps: int
    inputs: int


@dataclass(frozen=True)
class Mark:
    """A snapshot."""

    position: Position
    number: int
    """Of its place in the grid."""
    state: bytes
    followed: object
    """What the follower had to keep."""


@dataclass(frozen=True)
class Input:
    """Something the outside did."""

    at_ps: int
    change: Callable[[Any], object]


class Follower(Protocol):
    """Takes what a run puts out while it passes, and goes back with it."""

    def follow(self, run: Any, received: list[tuple[int, int, bool]]) -> None:
        """The run has come to another instant, no further than the next snapshot; what the host received meanwhile."""
        ...

    def cut(self, at_ps: int) -> None:
        """What came after an instant is no longer: something else was done there."""
        ...

    def save(self) -> object:
        """What restore() needs."""
        ...

    def restore(self, saved: object, at_ps: int) -> None:
        """The run was taken back, or on, to an instant of which save() was asked."""
        ...


class Timeline:
    """The history of one run; `run` is what libins.run.build() makes, with listen=True, and nobody else moves it."""

    def __init__(self, run: Any, crystal_hz: int, spacing: int = SPACING, budget: int = BUDGET) -> None:
        """From where the run is now, which is as far back as it can be taken."""
        self.run = run
        self._cycle_ps = CLOCKS_PER_CYCLE * PS_PER_S / crystal_hz
        self._grid_ps = max(1, self.ps(spacing) // FINER)
        self._budget = budget
        self._follower: Follower | None = None
        self.begin()

    def follow(self, follower: Follower) -> None:
        """From now on, which must be the begin."""
        self._follower = follower
        self.begin()

    def begin(self) -> None:
        """Forget all that was before now."""
        self._inputs: list[Input] = []
        self._applied = 0
        self._stride = 1
        self._near: Mark | None = None
        self._marks = [self._take()]
        self._octets = len(self._marks[0].state)
        self.received: list[tuple[int, int, bool]] = []
        """Octets that the host received: instant [ps], value, whether the stop bit was there."""

    def ps(self, cycles: int) -> int:
        """A number of machine cycles as time."""
        return round(cycles * self._cycle_ps)

    @property
    def position(self) -> Position:
        """Now."""
        return Position(int(self.run.now_ps), self._applied)

    @property
    def start(self) -> Position:
        """As far back as there is history."""
        return self._marks[0].position

    @property
    def end_ps(self) -> int:
        """The last input of the known future, or now."""
        return max([int(self.run.now_ps), *(each.at_ps for each in self._inputs[self._applied :])])

    @property
    def changes(self) -> list[tuple[int, Callable[[Any], object]]]:
        """What the outside did, the known future included: instants [ps] and changes."""
        return [(each.at_ps, each.change) for each in self._inputs]

    def trim(self) -> None:
        """Forget octets that the host received long ago."""
        del self.received[:-RECEIVED_KEPT]

    def marks(self) -> list[Position]:
        """Where the snapshots are."""
        return [mark.position for mark in self._marks]

    def do(self, change: Callable[[Any], object]) -> Any:
        """The outside does something now. What would have come after is forgotten."""
        now = self.position
        del self._inputs[now.inputs :]
        later = bisect_right([mark.position for mark in self._marks], now)
        self._octets -= sum(len(mark.state) for mark in self._marks[later:])
        del self._marks[later:]
        if self._near is not None and self._near.position > now:
            self._near = None
        if self._follower is not None:
            self._follower.cut(now.at_ps)
        result = change(self.run)  # one that is refused has not been
        self._inputs.append(Input(now.at_ps, change))
        self._applied += 1
        return result

    def advance(self, goal_ps: int, to_octet: bool = False) -> bool:
        """Run on, inputs of the known future included. Returns False where the run stopped before the goal."""
        while self.run.now_ps < goal_ps:
            following = self._inputs[self._applied] if self._applied < len(self._inputs) else None
            if following is not None and following.at_ps <= self.run.now_ps:
                self._apply()
            elif not self._pass(min(goal_ps, following.at_ps) if following else goal_ps, to_octet):
                self.run.watcher.settle()
                return False
        self.run.watcher.settle()
        return True

    def go(self, to: Position) -> None:
        """Take the run to a position in its history, or in its known future."""
        mark = self._marks[self._after(to) - 1]
        if self._near is not None and mark.position < self._near.position <= to:
            mark = self._near
        if not mark.position <= self.position <= to:
            self._restore(mark)
        self.replay(to)

    def replay(self, to: Position) -> None:
        """From here to a later position in the history or the known future, through all that lies between."""
        while self._applied < to.inputs:
            self._reach(self._inputs[self._applied].at_ps)
            self._apply()
        self._reach(to.at_ps)

    def go_near(self, at_ps: int) -> None:
        """Back to about an instant, and remember the place: the next time it is at hand."""
        at_ps = max(at_ps, self.start.at_ps)
        self.go(Position(at_ps, bisect_left([each.at_ps for each in self._inputs], at_ps)))
        self._near = self._take()

    @property
    def near(self) -> Position | None:
        """The place that is at hand."""
        return self._near.position if self._near is not None else None

    def _after(self, position: Position) -> int:
        return bisect_right(self._marks, position, key=lambda mark: mark.position)

    def _take(self) -> Mark:
        followed = self._follower.save() if self._follower is not None else None
        return Mark(self.position, int(self.run.now_ps) // self._grid_ps, self.run.save(), followed)

    def _restore(self, mark: Mark) -> None:
        self.run.restore(mark.state)
        self._applied = mark.position.inputs
        if self._follower is not None:
            self._follower.restore(mark.followed, mark.position.at_ps)
        del self.received[bisect_right(self.received, mark.position.at_ps, key=lambda octet: octet[0]) :]

    def _apply(self) -> None:
        self.run.watcher.settle()  # as it was when the input was carried out
        self._inputs[self._applied].change(self.run)
        self._applied += 1

    def _reach(self, goal_ps: int) -> None:
        """Run to an instant, whatever stops on the way."""
        while self.run.now_ps < goal_ps:
            self._pass(goal_ps, to_octet=False)
        self.run.watcher.settle()

    def _pass(self, goal_ps: int, to_octet: bool) -> bool:
        """Run to an instant, but no further than the next snapshot."""
        due_ps = (self.run.now_ps // self._grid_ps + 1) * self._grid_ps
        reached = bool((self.run.until_octet if to_octet else self.run.until)(min(goal_ps, due_ps)))
        received = self.run.take_received()
        self.received += received
        if self._follower is not None:
            self._follower.follow(self.run, received)
        else:
            self.run.take_states()
        if self.run.now_ps >= due_ps:
            self._keep()
        return reached

    def _keep(self) -> None:
        at = self._after(self.position)
        if at < len(self._marks) or self._marks[-1].position == self.position:
            return  # this stretch has its snapshots
        mark = self._take()
        self._marks.append(mark)
        self._octets += len(mark.state)
        if mark.number % FINER == 0:
            self._thin(mark.number)

    def _thin(self, newest: int) -> None:
        """Drop what is too close together for its age, and more while the budget is passed."""
        self._sift(max(1, len(self._marks) - 3 * FINER), newest)
        while self._octets > self._budget and len(self._marks) > 2 * FINER:
            self._stride *= 2
            self._sift(1, newest)

    def _sift(self, first: int, newest: int) -> None:
        step = FINER * self._stride
        kept = [mark for mark in self._marks[first:] if mark.number % step == 0 or mark.number > newest - FINER]
        self._octets -= sum(len(mark.state) for mark in self._marks[first:]) - sum(len(mark.state) for mark in kept)
        self._marks[first:] = kept
