"""The words of `ins debug` that look at the board, and that do something to it from outside."""

import ast
import cmd
import re
import shlex
from pathlib import Path
from typing import Any

from libins import debug_views, snapshot, values
from libins.breakpoints import Breakpoint
from libins.debugger import Debugger
from libins.errors import UsageError

LIST_LINES = 10
UART_SHOWN = 32
CHANNELS = 11
_PIN = re.compile(r"[Pp]([0-3])\.([0-7])")


class Shown(cmd.Cmd):
    """Looking and poking; the text of each method is what help shows."""

    d: Debugger
    sources: debug_views.Sources
    listed: tuple[str, int] | None = None
    """File and line that `list` goes on with."""

    def say(self, text: object) -> None:
        """A line to the user."""
        self.stdout.write(f"{text}\n")

    def number(self, text: str) -> int | float:
        """The value of an expression. Raises UsageError."""
        if not text.strip():
            raise UsageError("a number is needed")
        return self.d.expression(text).number(self.d.memory)

    # Looking

    def do_print(self, rest: str) -> None:
        """print[/x|d|u|o|t|c] EXPRESSION: of C, with $registers, SFRs and iram:0x30."""
        form, text = _form(rest)
        if form and form not in values.FORMATS:
            raise UsageError(f"print/{form}: one of {' '.join(values.FORMATS)} is needed")
        self.say(self.d.print_value(text, form))

    def do_x(self, rest: str) -> None:
        """x[/COUNT FORM UNIT] PLACE: memory. FORM x d u o t c s i, UNIT b h w; x/16xb iram:0x20, x/5i $pc."""
        form, text = _form(rest)
        for line in debug_views.examine(self.d, debug_views.examine_format(form), text):
            self.say(line)

    def do_info(self, rest: str) -> None:
        """Info breakpoints | registers | sfr | locals | variables | functions | sources | frame | reports."""
        words = ("breakpoints", "registers", "sfr", "locals", "variables", "functions", "sources", "frame", "reports")
        found = [word for word in words if rest.strip() and word.startswith(rest.strip())]
        if len(found) != 1:
            raise UsageError(f"info {rest}: one of {', '.join(words)} is needed")
        getattr(self, "_info_" + found[0])()

    def _info_breakpoints(self) -> None:
        for each in self.d.breakpoints.values():
            self.say(f"{each.number:<4}{each.kind:<8}{'y' if each.enabled else 'n'}  {self._what(each)}")

    def _what(self, each: Breakpoint) -> str:
        where = ", ".join(self.d.where(address) for address in each.addresses) or each.text
        condition = f", if {each.condition.text}" if each.condition else ""
        return f"{where}{condition}, hit {each.hits} times" + (f", {each.ignore} to be passed" if each.ignore else "")

    def _info_registers(self) -> None:
        for name, value in debug_views.registers(self.d):
            self.say(f"{name:<8}{value}")

    def _info_sfr(self) -> None:
        for name, value in debug_views.sfrs(self.d):
            self.say(f"{name:<8}{value:#04x}  {value:08b}")

    def _info_locals(self) -> None:
        self._say_variables(local=True)

    def _info_variables(self) -> None:
        self._say_variables(local=False)

    def _say_variables(self, local: bool) -> None:
        for name, value in debug_views.variables(self.d, local):
            self.say(f"{name} = {debug_views.value_text(self.d, value)}")

    def _info_functions(self) -> None:
        for function in self.d.table.functions if self.d.table else ():
            self.say(f"{function.begin:#06x}  {function.name}")

    def _info_sources(self) -> None:
        for file in self.d.table.files() if self.d.table else ():
            self.say(f"{file}  {self.sources.find(file) or 'not found; give its folder with --source'}")

    def _info_frame(self) -> None:
        self.say(f"{self.d.where()}, cycle {self.d.run.cycle}, {debug_views.time(self.d)}")

    def _info_reports(self) -> None:
        for each in self.d.run.reports():
            self.say(
                f"{each['first_s']:.6f} s  {each['kind']}: {each['text']} ({each['detail']:#x}), {each['count']} times"
            )

    def do_backtrace(self, rest: str) -> None:
        """backtrace: who called whom, the innermost first."""
        for number, frame in enumerate(self.d.frames()):
            self.say(f"#{number}  {self.d.where(frame.pc)}")

    def do_disassemble(self, rest: str) -> None:
        """Disassemble [FUNCTION | PLACE]: a function, or some instructions from there."""
        begin = self.d.locate(rest)[0] if rest else self.d.pc
        function = self.d.table.function_at(begin) if self.d.table else None
        first, end = (function.begin, function.end) if function else (begin, begin + 32)
        for line in debug_views.disassembly(self.d, first, end):
            self.say(line)

    def do_list(self, rest: str) -> None:
        """List [function | [file.c:]90]: lines of the source around there; again: those behind."""
        if rest or self.listed is None:
            line = self.d.line(self.d.locate(rest)[0] if rest else None)
            if line is None:
                raise UsageError("list: no source of this place is known")
            self.listed = line.file, max(1, line.number - LIST_LINES // 2)
        file, first = self.listed
        if self.sources.find(file) is None:
            raise UsageError(
                f"{file}: not found in {', '.join(map(str, self.sources.folders))}; give its folder with --source"
            )
        for number, text in self.sources.text(file, first, first + LIST_LINES - 1):
            self.say(f"{number}\t{text}")
        self.listed = file, first + LIST_LINES

    def do_pins(self, rest: str) -> None:
        """pins: the level of every port pin, and of the wires."""
        for line in debug_views.pins(self.d):
            self.say(line)

    def do_uart(self, rest: str) -> None:
        """Uart [COUNT]: the last octets that the host received."""
        for line in debug_views.received(self.d, int(self.number(rest)) if rest else UART_SHOWN):
            self.say(line)

    # What the outside does

    def do_set(self, rest: str) -> None:
        """Set [var] LVALUE = EXPRESSION: poke a variable, a register ($pc, $a, P1) or a place (iram:0x30)."""
        target, equals, value = rest.removeprefix("var ").partition("=")
        if not equals or not value.strip():
            raise UsageError("set: LVALUE = EXPRESSION is needed")
        self.d.assign(target, value)

    def do_send(self, rest: str) -> None:
        """Send "text" | 0x55 0x01 ...: octets from the host to the board, from now on."""
        words = [rest] if rest.startswith(('"', "b'", 'b"')) else rest.split()
        try:
            octets = b"".join(_octets(word) for word in words)
        except (ValueError, SyntaxError) as error:
            raise UsageError(f"send {rest}: numbers up to 255, or one quoted text, are needed") from error
        if self.d.do(lambda r: r.send(octets)) != len(octets):
            raise UsageError(
                f"send: the host's transmitter has no room for {len(octets)} octets; let the run go on first"
            )

    def do_volts(self, rest: str) -> None:
        """Volts CHANNEL VOLTS | CHANNEL off: what is on an analogue input, instead of its own signal."""
        words = rest.split()
        if len(words) != 2 or not words[0].isdigit() or int(words[0]) >= CHANNELS:
            raise UsageError(f"volts: a channel of 0 to {CHANNELS - 1}, then volts or off are needed")
        channel = int(words[0])
        if words[1] == "off":
            self.d.do(lambda r: r.clear_volts(channel))
        else:
            volts = float(self.number(words[1]))
            self.d.do(lambda r: r.set_volts(channel, volts))

    def do_pin(self, rest: str) -> None:
        """Pin P1.3 [0|1|z]: its level; or drive it from outside, z lets go."""
        words = rest.split()
        m = _PIN.fullmatch(words[0]) if words else None
        if m is None or words[1:] not in ([], ["0"], ["1"], ["z"]):
            raise UsageError("pin: P0.0 to P3.7, then 0, 1 or z, is needed")
        port, bit = int(m[1]), int(m[2])
        if words[1:]:
            level = None if words[1] == "z" else words[1] == "1"
            self.d.do(lambda r: r.drive_pin(port, bit, level))
        self.say(f"{words[0]} {int(self.d.run.pin(port, bit))}")

    def do_reset(self, rest: str) -> None:
        """Reset [power]: a pulse of the RST pin, or of the supply."""
        power = rest.strip() == "power"
        if rest.strip() and not power:
            raise UsageError(f"reset {rest}: nothing or 'power' is needed")
        self.d.do(lambda r: r.reset(power))

    def do_snapshot(self, rest: str) -> None:
        """Snapshot FILE: the whole board, for `restore`, `ins debug FILE` or Board.from_snapshot()."""
        d = self.d
        state = d.run.save()
        now = int(d.run.now_ps)
        snapshot.Snapshot(d.scenario, d.navigator, now, state, (), 0, {}).write(_path(rest, "snapshot"))

    def do_restore(self, rest: str) -> None:
        """Restore FILE: go on from a snapshot of the same board and image; what was before is forgotten."""
        self.d.restore(snapshot.read(_path(rest, "restore")))
        self.say(f"{self.d.where()}  [{debug_views.time(self.d)}]")

    def do_quit(self, rest: str) -> None:
        """Quit [EXPRESSION]: leave; its value is the exit code."""
        raise SystemExit(int(self.number(rest)) & 0xFF if rest else 0)


def _form(rest: str) -> tuple[str, str]:
    """The letters behind a slash, and the rest."""
    if not rest.startswith("/"):
        return "", rest
    form, _, text = rest[1:].partition(" ")
    return form, text


def _octets(word: str) -> bytes:
    value: Any = ast.literal_eval(word)
    return value.encode("latin-1") if isinstance(value, str) else value if isinstance(value, bytes) else bytes([value])


def _path(rest: str, word: str) -> Path:
    words = shlex.split(rest)
    if len(words) != 1:
        raise UsageError(f"{word}: the name of a file is needed")
    return Path(words[0])
