"""`ins debug` in a terminal: the debugger by gdb's words, typed or from a file."""

import re
import shlex
import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from types import FrameType

from libins import debug_views
from libins.breakpoints import Breakpoint, Stop
from libins.debugger import Debugger
from libins.errors import UsageError
from libins.run import PS_PER_S
from libins.terminal_show import Shown

PROMPT = "(ins) "
ALIASES = {
    **{"b": "break", "tb": "tbreak", "c": "continue", "n": "next", "s": "step", "si": "stepi", "fin": "finish"},
    **{"p": "print", "i": "info", "l": "list", "bt": "backtrace", "u": "until", "d": "delete", "q": "quit"},
    **{"rs": "reverse-step", "rsi": "reverse-stepi", "rn": "reverse-next", "rc": "reverse-continue"},
    **{"where": "backtrace", "disas": "disassemble", "h": "help"},
}
REPEATED = ("step", "stepi", "next", "continue", "list", "reverse-step", "reverse-stepi", "reverse-next", "x")
_CONDITION = re.compile(r"(?P<place>.*?)(?:(?:^|\s)if\b(?P<condition>.*))?$")


class Terminal(Shown):
    """One session. The text after do_ of each method is what help shows."""

    prompt = PROMPT
    doc_header = "Commands (help COMMAND); a unique beginning of a name is enough:"

    def __init__(self, debugger: Debugger, folders: Iterable[Path] = ()) -> None:
        """`folders`: where sources are looked for first."""
        super().__init__()
        self.d = debugger
        self.sources = debug_views.Sources(debugger, list(folders))
        self._interrupted = False
        self._running = False
        self._typed = False
        debugger.wants_to_stop = self._wants_to_stop

    # The words

    def onecmd(self, line: str) -> bool:
        """One line; a word may be abbreviated."""
        word, _, rest = line.strip().partition(" ")
        word, slash, form = word.partition("/")
        if not word or word.startswith("#"):
            return bool(line.strip() == "" and self.emptyline())
        name = self._named(ALIASES.get(word, word))
        if name != "help" and name in REPEATED:
            self.lastcmd = line
        else:
            self.lastcmd = ""
        if name == "help":
            self.do_help(rest)
            return False
        method = getattr(self, "do_" + name.replace("-", "_"))
        method((slash + form + " " + rest).strip() if slash else rest.strip())
        return False

    def _named(self, word: str) -> str:
        names = [name[3:].replace("_", "-") for name in self.get_names() if name.startswith("do_")]
        found = [word] if word in names else [name for name in names if name.startswith(word)]
        if len(found) != 1:
            what = f"may be {', '.join(found)}" if found else "is no command; help lists them"
            raise UsageError(f"{word}: {what}")
        return found[0]

    def emptyline(self) -> bool:
        """An empty line steps or lists again."""
        return bool(self.lastcmd) and self.onecmd(self.lastcmd)

    # Breakpoints

    def do_break(self, rest: str) -> None:
        """Break [file.c:90 | 90 | function | *0x123] [if CONDITION]: stop there. Without a place: here."""
        self._break(rest, temporary=False)

    def do_tbreak(self, rest: str) -> None:
        """Tbreak PLACE [if CONDITION]: as break, once."""
        self._break(rest, temporary=True)

    def _break(self, rest: str, temporary: bool) -> None:
        place, condition = _conditional(rest)
        added = self.d.add_code(place or f"*{self.d.pc:#x}", temporary, condition)
        self.say(f"Breakpoint {added.number} at {', '.join(self.d.where(a) for a in added.addresses)}")

    def do_watch(self, rest: str) -> None:
        """Watch EXPRESSION [if CONDITION]: stop when its value has changed by what the program wrote."""
        self._watch(rest, "change")

    def do_rwatch(self, rest: str) -> None:
        """Rwatch LVALUE [if CONDITION]: stop behind an instruction that reads it: a variable, SBUF, xdata:0x100."""
        self._watch(rest, "read")

    def do_awatch(self, rest: str) -> None:
        """Awatch LVALUE [if CONDITION]: stop behind an instruction that reads or writes it."""
        self._watch(rest, "access")

    def _watch(self, rest: str, kind: str) -> None:
        expression, condition = _conditional(rest)
        added = self.d.add_watch(expression, kind, condition)
        self.say(f"Watchpoint {added.number}: {added.text}")

    def do_catch(self, rest: str) -> None:
        """Catch edge WIRE [rising|falling] | catch octet [VALUE] | catch time SECONDS; [if CONDITION]."""
        what, condition = _conditional(rest)
        words = shlex.split(what)
        if words[:1] == ["edge"] and len(words) in (2, 3) and words[2:] in ([], ["rising"], ["falling"]):
            added = self.d.add_edge(words[1], words[2:] != ["falling"], words[2:] != ["rising"], condition)
        elif words[:1] == ["octet"] and len(words) <= 2:
            octet = int(self.number(words[1])) & 0xFF if len(words) == 2 else None
            added = self.d.add_octet(octet, condition)
        elif words[:1] == ["time"] and len(words) == 2:
            added = self.d.add_time(float(self.number(words[1])))
        else:
            raise UsageError("catch: edge WIRE [rising|falling], octet [VALUE] or time SECONDS is needed")
        self.say(f"Catchpoint {added.number} ({added.kind}: {added.text})")

    def do_delete(self, rest: str) -> None:
        """Delete [NUMBER ...]: without numbers, all."""
        for number in [int(self.number(word)) for word in rest.split()] or list(self.d.breakpoints):
            self.d.delete(number)

    def do_enable(self, rest: str) -> None:
        """Enable NUMBER ..."""
        self._enable(rest, True)

    def do_disable(self, rest: str) -> None:
        """Disable NUMBER ...: keep it, but do not stop."""
        self._enable(rest, False)

    def _enable(self, rest: str, on: bool) -> None:
        for word in rest.split():
            self._breakpoint(word).enabled = on

    def do_condition(self, rest: str) -> None:
        """Condition NUMBER [EXPRESSION]: stop there only when it holds; without, always."""
        number, _, text = rest.partition(" ")
        each = self._breakpoint(number)
        scope = each.addresses[0] if each.addresses else None
        each.condition = self.d.expression(text, scope) if text.strip() else None

    def do_ignore(self, rest: str) -> None:
        """Ignore NUMBER COUNT: pass it so many times; counted forwards only."""
        number, _, count = rest.partition(" ")
        self._breakpoint(number).ignore = max(0, int(self.number(count)))

    def _breakpoint(self, word: str) -> Breakpoint:
        number = int(self.number(word))
        if number not in self.d.breakpoints:
            raise UsageError(f"{word}: no such breakpoint; info breakpoints lists them")
        return self.d.breakpoints[number]

    # Running

    def do_continue(self, rest: str) -> None:
        """continue: run until something stops it, or the scenario ends."""
        self._go(self.d.resume)

    def do_step(self, rest: str) -> None:
        """Step [COUNT]: to another line of C, into functions."""
        self._repeat(rest, self.d.step)

    def do_next(self, rest: str) -> None:
        """Next [COUNT]: to another line of C, over functions."""
        self._repeat(rest, lambda: self.d.step(over=True))

    def do_stepi(self, rest: str) -> None:
        """Stepi [COUNT]: so many instructions."""
        count = self._count(rest)
        self._go(lambda: self.d.step_instruction(count), instruction=True)

    def do_finish(self, rest: str) -> None:
        """finish: until the function or interrupt that runs now has returned."""
        self._go(self.d.finish)

    def do_until(self, rest: str) -> None:
        """Until PLACE: run to there. until 0.5s: run to that instant."""
        if m := re.fullmatch(r"(\d+\.?\d*(?:e-?\d+)?)\s*s", rest.strip()):
            self._go(lambda: self.d.resume(round(float(m[1]) * PS_PER_S)))
        else:
            self._go(lambda: self.d.run_to(rest))

    def do_reverse_continue(self, rest: str) -> None:
        """reverse-continue: back to the last stop of any breakpoint before now, or to the start."""
        self._go(self.d.reverse_resume)

    def do_reverse_step(self, rest: str) -> None:
        """reverse-step [COUNT]: back to the begin of the line before, into functions."""
        self._repeat(rest, self.d.reverse_step)

    def do_reverse_next(self, rest: str) -> None:
        """reverse-next [COUNT]: back to the begin of the line before, over functions."""
        self._repeat(rest, lambda: self.d.reverse_step(over=True))

    def do_reverse_stepi(self, rest: str) -> None:
        """reverse-stepi [COUNT]: so many instructions back."""
        count = self._count(rest)
        self._go(lambda: self.d.reverse_step_instruction(count), instruction=True)

    def _count(self, rest: str) -> int:
        return max(1, int(self.number(rest))) if rest else 1

    def _repeat(self, rest: str, go: Callable[[], Stop]) -> None:
        stop = Stop("step")
        for _ in range(self._count(rest)):
            stop = self._carried_out(go)
            if stop.reason != "step":
                break
        self._told(stop)

    def _go(self, go: Callable[[], Stop], instruction: bool = False) -> None:
        self._told(self._carried_out(go), instruction)

    def _carried_out(self, go: Callable[[], Stop]) -> Stop:
        self._running = True
        try:
            return go()
        finally:
            self._running = self._interrupted = False

    def interrupt(self, signal_number: int, frame: FrameType | None) -> None:
        """Ctrl-C: stops the run, of a script the one that runs next; or else the line that is being typed."""
        if not self._running and self._typed:
            raise KeyboardInterrupt
        self._interrupted = True

    def _wants_to_stop(self) -> bool:
        return self._interrupted

    def _told(self, stop: Stop, instruction: bool = False) -> None:
        """Why it stopped, and where."""
        heads = {
            "end": ["End of the scenario"],
            "limit": [],
            "asleep": ["Asleep: no instruction was executed"],
            "interrupted": ["Interrupted"],
        }
        for number, note in zip(stop.numbers, stop.notes, strict=True) if stop.numbers else ():
            kind = self.d.breakpoints[number].kind if number in self.d.breakpoints else "code"
            self.say(f"Breakpoint {number}" if kind == "code" else f"Watchpoint {number}: {note}")
        for head in heads.get(stop.reason, [] if stop.numbers else [n.capitalize() for n in stop.notes]):
            self.say(head)
        self.listed = None
        self.say(f"{self.d.where()}  [{debug_views.time(self.d)}]")
        line = self.d.line()
        shown = self.sources.text(line.file, line.number, line.number) if line else []
        if instruction or not shown:
            self.say(next(iter(debug_views.disassembly(self.d, self.d.pc, self.d.pc + 1))))
        for number, text in shown:
            self.say(f"{number}\t{text}")

    # Sessions

    def session(self, lines: Iterable[str], echo: bool) -> int:
        """Commands of a file or pipe, up to the first that fails. Returns the exit code."""
        for number, line in enumerate(lines, 1):
            if echo:
                self.say(f"{PROMPT}{line.rstrip()}")
                self.stdout.flush()
            try:
                self.onecmd(line)
            except SystemExit as leave:
                return int(leave.code or 0)
            except (UsageError, ValueError) as error:
                self.stdout.flush()
                print(f"ins debug: command {number}: {line.strip()}: {error}", file=sys.stderr)
                return 1
            self.stdout.flush()
        return 0

    def dialogue(self) -> int:
        """Commands as they are typed. Returns the exit code."""
        self._typed = True
        while True:
            try:
                self.onecmd(input(PROMPT))
            except SystemExit as leave:
                return int(leave.code or 0)
            except EOFError:
                self.say("")
                return 0
            except KeyboardInterrupt:
                self.say("^C (quit leaves)")
            except (UsageError, ValueError) as error:
                self.say(error)


def _conditional(rest: str) -> tuple[str, str]:
    """A place and its condition."""
    m = _CONDITION.match(rest.strip())
    assert m is not None
    condition = (m["condition"] or "").strip()
    if m["condition"] is not None and not condition:
        raise UsageError("if: an expression is needed behind it")
    return m["place"].strip(), condition
