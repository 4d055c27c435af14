"""One engine on a thread of its own: commands one after the other, pacing, and frames 30 times a second.

docs/view_protocol.md says what a page asks and gets.
"""

import queue
import sys
import threading
import time
import traceback
from collections.abc import Callable, Mapping
from typing import Any, Protocol

from libins.errors import UsageError

Json = dict[str, Any]
Reply = Callable[[Json], None]
Move = Callable[["Asked", Callable[[], bool]], Json]
"""Runs the engine until it stops, or the callable says so; the answer."""

FRAME_S = 1 / 30
LAG_S = 0.2
"""More than that behind the wall clock is given up, not caught up."""
SLICE_S = FRAME_S / 4
"""Wall time between two looks at what is asked, about."""
ACHIEVED_S = 1.0
"""Over which the achieved speed is measured."""
BACK = ("step_back", "step_over_back", "run_back", "to")
"""Moves of which a page sees the end only."""
OCTETS_MAX = 4096
"""Of one command."""
SPEED_MIN, SPEED_MAX = 1e-4, 1e4


class Asked:
    """A command with its arguments. Reading one that is missing or of another kind raises UsageError."""

    def __init__(self, message: Mapping[str, Any]) -> None:
        """A message of a page."""
        self.message = message
        self.name = self.text("do")

    def has(self, name: str) -> bool:
        """Whether it is there and not null."""
        return self.message.get(name) is not None

    def text(self, name: str, default: str | None = None) -> str:
        """A string."""
        value = self.message.get(name, default)
        if not isinstance(value, str):
            raise self._refused(name, value, "a string")
        return value

    def whole(self, name: str, low: int, high: int, default: int | None = None) -> int:
        """A whole number in low .. high."""
        value = self.message.get(name, default)
        if isinstance(value, float) and value.is_integer():
            value = int(value)
        if not isinstance(value, int) or isinstance(value, bool) or not low <= value <= high:
            raise self._refused(name, value, f"a whole number of {low} .. {high}")
        return value

    def number(self, name: str, low: float, high: float) -> float:
        """A number in low .. high."""
        value = self.message.get(name)
        if not isinstance(value, (int, float)) or isinstance(value, bool) or not low <= value <= high:
            raise self._refused(name, value, f"a number of {low:g} .. {high:g}")
        return float(value)

    def texts(self, name: str, most: int) -> list[str]:
        """A list of strings, no longer than that."""
        value = self.message.get(name)
        if not isinstance(value, list) or len(value) > most or not all(isinstance(each, str) for each in value):
            raise self._refused(name, value, f"a list of at most {most} strings")
        return value

    def octets(self) -> bytes:
        """Of `hex` or `text`."""
        if not self.has("hex"):
            found = self.text("text").encode()
        else:
            try:
                found = bytes.fromhex(self.text("hex"))
            except ValueError as error:
                raise self._refused("hex", self.text("hex"), f"two digits an octet ({error})") from error
        if not 0 < len(found) <= OCTETS_MAX:
            raise UsageError(f"{self.name}: found {len(found)} octets, but 1 to {OCTETS_MAX} are needed")
        return found

    def _refused(self, name: str, found: object, needed: str) -> UsageError:
        place = f"{self.name}: {name}" if hasattr(self, "name") else name
        return UsageError(f"{place}: found {found!r}, but {needed} is needed")


class Engine(Protocol):
    """A board, several boards, or a recording."""

    moves: Mapping[str, Move]
    """Commands that make its time pass; `run` is paced."""
    commands: Mapping[str, Callable[[Asked], Json]]
    """The others."""

    @property
    def now_ps(self) -> int:
        """Virtual time."""
        ...

    def hello(self) -> Json:
        """What it is made of."""
        ...

    def frame(self, whole: bool) -> Json:
        """What is now, and what passed since the last frame; whole: all that is kept, for a page that has just come."""
        ...

    def slice(self, ps: int) -> None:
        """From now on it asks whether to go on about each so much virtual time."""
        ...

    def close(self) -> None:
        """Nothing of it is left running."""
        ...


class Session(threading.Thread):
    """Serves one engine; `publish` gets every frame."""

    def __init__(self, engine: Engine, speed: float | None, publish: Callable[[Json], None]) -> None:
        """speed: simulated seconds a wall second; None: as fast as it goes."""
        super().__init__(name="ins view", daemon=True)
        self._engine, self._speed, self._publish = engine, speed, publish
        self._queue: queue.SimpleQueue[tuple[Mapping[str, Any], Reply] | None] = queue.SimpleQueue()
        self._moving = self._paced = self._shown = self._pause = self._closing = False
        self._due_s = 0.0
        """Of the next frame, by the wall clock."""
        self._looked: list[tuple[float, int]] = []
        """Wall and virtual time of frames in the last ACHIEVED_S."""
        self._own: Mapping[str, Callable[[Asked], Json]] = {
            "attach": self._attach,
            "pause": self._on_pause,
            "speed": self._set_speed,
        }
        self._begin_pacing()

    # From other threads

    def submit(self, message: Mapping[str, Any], reply: Reply) -> None:
        """Carry a command out in its turn; `reply` is called on the session's thread."""
        self._queue.put((message, reply))

    def close(self) -> None:
        """End the thread, and then the engine."""
        self._queue.put(None)
        self.join()
        self._engine.close()

    # The thread

    def run(self) -> None:
        """Until it is closed."""
        while not self._closing:
            self._next(None)

    def _next(self, wait_s: float | None) -> bool:
        """Carry out the next command; wait_s: no longer for one, None: for ever. Returns whether there was one."""
        try:
            asked = self._queue.get(timeout=wait_s) if wait_s is None or wait_s > 0 else self._queue.get_nowait()
        except queue.Empty:
            return False
        if asked is None:
            self._closing = self._pause = True
        else:
            self._carry_out(*asked)
        return True

    def _carry_out(self, message: Mapping[str, Any], reply: Reply) -> None:
        try:
            asked = Asked(message)
            if asked.name in self._engine.moves:
                self._move(asked, reply)
                return
            known = {**self._engine.commands, **self._own}
            if asked.name not in known:
                raise UsageError(f"{asked.name}: no command; {', '.join(sorted([*known, *self._engine.moves]))} are")
            reply({"ok": True, **known[asked.name](asked)})
        except UsageError as error:
            reply({"error": str(error)})
        except Exception as error:  # the session outlives what is wrong with one command
            traceback.print_exc(file=sys.stderr)
            reply({"error": f"{type(error).__name__}: {error}; the terminal that ins view was started in says where"})
        if not self._moving:
            self._push()

    def _move(self, asked: Asked, reply: Reply) -> None:
        if self._moving:
            raise UsageError(f"{asked.name}: the engine runs; pause it first")
        self._moving, self._pause = True, False
        self._paced, self._shown = asked.name == "run", asked.name not in BACK
        self._begin_pacing()
        if self._paced:
            reply({"ok": True})
        try:
            answer = self._engine.moves[asked.name](asked, self._between)
        finally:
            self._moving = self._paced = self._shown = False
        if asked.name != "run":
            reply({"ok": True, **answer})
        self._push()

    def _between(self) -> bool:
        """Between two slices: keep to the wall clock, do what is asked, tell what is new. Returns whether to stop."""
        if self._paced:
            while not self._pause and (ahead_s := self._ahead_s()) > 0 and self._next(ahead_s):
                pass
        while not self._pause and self._next(0):
            pass
        if self._shown and time.monotonic() >= self._due_s:
            self._push()
            self._fit_slice()
        return self._pause

    # Pace

    def _begin_pacing(self) -> None:
        """From now on, virtual time is where it should be."""
        speed = 1.0 if self._speed is None else self._speed
        self._origin_s = time.monotonic() - self._engine.now_ps * 1e-12 / speed
        self._looked = []
        self._engine.slice(max(1, round(SLICE_S * speed * 1e12)))

    def _ahead_s(self) -> float:
        """How long to wait; lag beyond LAG_S is given up."""
        if self._speed is None:
            return 0.0
        ahead_s = self._origin_s + self._engine.now_ps * 1e-12 / self._speed - time.monotonic()
        if ahead_s < -LAG_S:
            self._origin_s -= ahead_s
        return ahead_s

    def _fit_slice(self) -> None:
        """As fast as it goes, a slice is what takes about SLICE_S."""
        if (self._speed is None or not self._paced) and (achieved := self._achieved()) is not None:
            self._engine.slice(max(1, round(SLICE_S * achieved * 1e12)))

    def _achieved(self) -> float | None:
        """Simulated seconds a wall second, lately."""
        if len(self._looked) < 2:
            return None
        (begin_s, begin_ps), (end_s, end_ps) = self._looked[0], self._looked[-1]
        return (end_ps - begin_ps) * 1e-12 / (end_s - begin_s) if end_s > begin_s else None

    def _push(self) -> None:
        """A frame to all."""
        now_s = time.monotonic()
        self._due_s = max(self._due_s, now_s - FRAME_S) + FRAME_S
        if self._shown:
            self._looked.append((now_s, self._engine.now_ps))
            while self._looked[0][0] < now_s - ACHIEVED_S:
                self._looked.pop(0)
        self._publish(self._frame(False))

    def _frame(self, whole: bool) -> Json:
        achieved = self._achieved() if self._shown else None
        pace = {"running": self._moving, "speed": "max" if self._speed is None else self._speed, "achieved": achieved}
        return {**pace, **self._engine.frame(whole)}

    # Commands

    def _attach(self, asked: Asked) -> Json:
        return {"hello": self._engine.hello(), "frame": self._frame(True)}

    def _on_pause(self, asked: Asked) -> Json:
        self._pause = True
        return {}

    def _set_speed(self, asked: Asked) -> Json:
        fastest = asked.message.get("value") == "max"
        self._speed = None if fastest else asked.number("value", SPEED_MIN, SPEED_MAX)
        self._begin_pacing()
        return {}
