"""A debugger of the emulated board: breakpoints, steps, and the same backwards.

    d = libins.debugger.open_scenario("default")
    d.add_code("acq.c:90")
    print(d.resume(), d.print_value("sampled"))
    d.reverse_resume()

Everything is simulated time; what is done to the board is repeated when the run is taken back and goes on again.
"""

import zipfile
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from libins import cdb, scenario, snapshot
from libins.breakpoints import Stop
from libins.control import Control
from libins.errors import UsageError
from libins.snapshot import Snapshot
from libins.timeline import Position

WINDOW_CYCLES = 256
"""How far back a step back looks first."""
WIDER = 8
"""And how much further each time that this was not enough."""
NO_CYCLE = 2**64 - 1

_Places = list[tuple[int, int, int]]
"""Machine cycle, address, number of the frame."""
_Frames = list[tuple[int, bool, bool]]
"""Number of the caller's frame, whether it is an interrupt's, whether it was left before now."""


class Debugger(Control):
    """One run under control, forwards and backwards."""

    def reverse_resume(self) -> Stop:
        """Back to the last stop of any breakpoint before now, or to the start."""
        now = self.timeline.position
        end = now
        for start in reversed([mark for mark in self.timeline.marks() if mark < now]):
            stop = self._last_stop(start, end, now)
            if stop is not None:
                return stop
            if self.wants_to_stop():
                self.timeline.go(now)
                return Stop("interrupted")
            end = start
        return self._at_start()

    def _last_stop(self, start: Position, end: Position, now: Position) -> Stop | None:
        """Replay from start to end; if breakpoints stopped it, go to the last place where one did."""
        self.timeline.go(start)
        self._resumed_ps = -1
        last: tuple[Position, Stop] | None = None
        self._arm()
        try:
            reached = False
            while not reached:
                before, seen = int(self.run.now_ps), len(self.timeline.received)
                octets = any(each.kind == "octet" and each.enabled for each in self.breakpoints.values())
                reached = self.timeline.advance(end.at_ps, octets)
                events = self._events(reached, before, seen)
                if events and self.timeline.position < now:
                    numbers = [each.number for each, _ in events]
                    last = self.timeline.position, Stop("breakpoint", [note for _, note in events], numbers)
        finally:
            self._disarm()
        if last is None:
            return None
        self.timeline.go(last[0])
        return last[1]

    def reverse_step_instruction(self, count: int = 1) -> Stop:
        """To where it was before the last instruction."""
        for _ in range(count):
            if not self._back("before", int(self.run.cycle), lambda: self._before()):
                return self._at_start()
        return Stop("step")

    def _before(self) -> int | None:
        cycle = int(self.run.watcher.last_before)
        return None if cycle == NO_CYCLE else cycle

    def reverse_step(self, over: bool = False) -> Stop:
        """To the begin of the line that was executed before; over: not into functions that have returned."""
        if self.table is None:
            return self.reverse_step_instruction()
        now = int(self.run.cycle)

        def chosen() -> int | None:
            self.run.watcher.end()
            places: _Places = self.run.watcher.places()
            frames: _Frames = self.run.watcher.frames()
            for cycle, _, frame in reversed(places):
                if cycle < now and not _left(frames, frame, calls=over):
                    return cycle
            return None

        return Stop("step") if self._back("record", 1, chosen) else self._at_start()

    def _back(self, goal: str, n: int, choose: Callable[[], int | None]) -> bool:
        """Go to the instruction boundary that is chosen from what a replay of ever more of the past notes."""
        timeline, watcher = self.timeline, self.run.watcher
        now = timeline.position
        window_ps = timeline.ps(WINDOW_CYCLES)
        near = timeline.near
        if near is not None and not 0 < now.at_ps - near.at_ps <= window_ps:
            near = None
        while True:
            if near is not None:
                timeline.go(near)
            else:
                timeline.go_near(now.at_ps - window_ps)
            from_start = timeline.position.at_ps <= timeline.start.at_ps
            place = timeline.position
            watcher.begin(goal, n)
            timeline.replay(now)
            cycle = choose()
            watcher.begin("none", 0)
            if cycle is not None:
                timeline.go(place)
                watcher.begin("cycle", cycle)
                timeline.advance(now.at_ps)
                watcher.begin("none", 0)
                return True
            if from_start:
                return False
            window_ps *= 1 if near is not None else WIDER
            near = None

    def restore(self, snap: Snapshot) -> None:
        """Go on from a snapshot; its past is not known. Raises UsageError when it is another board's."""
        if (snap.scenario.tables, snap.scenario.image) != (self.scenario.tables, self.scenario.image):
            raise UsageError("restore: the snapshot is of a board with another configuration or image")
        if snap.navigator != self.navigator:
            raise UsageError("restore: in the snapshot the navigator plays the host, or here and not there")
        try:
            self.run.restore(snap.state)
        except ValueError as error:
            raise UsageError(f"restore: {error}") from error
        self.timeline.begin()

    def _at_start(self) -> Stop:
        self.timeline.go(self.timeline.start)
        return Stop("start", ["no more history: this is as far back as it goes"])


def _left(frames: _Frames, frame: int, calls: bool) -> bool:
    """Whether a frame, or one around it, is over: an interrupt's, or with `calls` any."""
    while True:
        parent, interrupt, left = frames[frame]
        if left and (calls or interrupt):
            return True
        if parent == frame or not left:
            return False
        frame = parent


def open_scenario(
    name: str,
    firmware: Path | None = None,
    settings: Mapping[str, Any] | None = None,
    navigator: bool = True,
    seen: bool = False,
) -> Debugger:
    """A scenario, an image alone or a snapshot's file, from its start; seen: as of Control. Raises UsageError.

    Of an image without a .cdb beside it, the one built with --debug (NAME_debug.ihx) is taken where there is one.
    """
    if zipfile.is_zipfile(name):
        snap = snapshot.read(Path(name))
        debugger = Debugger(snap.scenario, _table(snap.scenario.firmware), snap.navigator, seen)
        debugger.restore(snap)
        return debugger
    path = scenario.find(name)
    loaded = scenario.load_board(path, firmware, settings)
    image = loaded.firmware
    debug = image.with_name(f"{image.stem}_debug{image.suffix}")
    if not image.with_suffix(".cdb").exists() and debug.exists() and debug.with_suffix(".cdb").exists():
        loaded = scenario.load_board(path, debug, settings)
    return Debugger(loaded, _table(loaded.firmware), navigator, seen)


def _table(image: Path) -> cdb.Cdb | None:
    path = image.with_suffix(".cdb")
    return cdb.load(path) if path.exists() else None
