"""A run as a value change dump (IEEE 1364-2005, clause 18) with GTKWave's strings, by pyvcd. Timescale 1 ps.

Scopes: `board.cpu` the pins of the ports (what the CPU would read), SFRs and the interrupt in service; `board.tlc2543`
its nets, and channel and code of each sample; `board.uart` the line, and each octet from its start bit to the middle of
its stop bit; `board.analog` the volts at the inputs, on a grid and at each sample.
"""

from bisect import bisect_right
from collections.abc import Callable
from dataclasses import dataclass, field
from operator import itemgetter
from typing import Any, TextIO

from vcd import VCDWriter

from libins import _run, uart

PS_PER_US = 10**6
PORTS = 4
CHANNELS = 3
"""Analogue inputs with something connected."""
Samples = list[tuple[int, int, int, float]]
"""Instant [ps], channel, code, volts."""
LINES = ("TXD", "RXD")
HELD_BITS = 11
"""Changes wait for so many bits of the line: an octet is known at its end and shown from its begin."""


def identifier(net: str) -> str:
    """A net's name as a VCD has it: "/CS" is CS_n, "I/O CLOCK" IO_CLOCK."""
    plain = net.removeprefix("/").replace("/", "").replace(" ", "_")
    return f"{plain}_n" if net.startswith("/") else plain


@dataclass
class Settings:
    """What to show beside the nets."""

    baud: float
    sfrs: list[str] = field(default_factory=list)
    analog_us: float = 1000.0
    """Grid of the analogue nets."""
    interrupt_name: Callable[[int], str] = "interrupt {}".format
    """Of a bit of IE."""


class Writer:
    """Changes of variables as they come, sorted and held back until nothing earlier can come."""

    def __init__(self, file: TextIO, begin_ps: int, baud: float) -> None:
        """baud: of the slowest line with octets."""
        self._writer = VCDWriter(file, timescale="1 ps", date="", version="libins", init_timestamp=begin_ps)
        self._pending: list[tuple[int, Any, Any]] = []
        """Instant, variable, value: held back."""
        self._held_ps = round(HELD_BITS * uart.PS_PER_S / baud)

    def variable(self, scope: str, name: str, kind: str, size: int | None, value: Any) -> Any:
        """A new one; scope: with dots."""
        return self._writer.register_var(scope, name, kind, size, value)

    def put(self, at: int, variable: Any, value: Any) -> None:
        """It changes then."""
        self._pending.append((at, variable, value))

    def octet(self, frame: uart.Frame, variable: Any) -> None:
        """From its start bit to the middle of its stop bit."""
        self.put(frame.begin_ps, variable, str(frame))
        self.put(frame.end_ps, variable, "")

    def write(self, now_ps: int) -> None:
        """What is certain at that instant."""
        self._write(now_ps - self._held_ps)

    def _write(self, until: int) -> None:
        self._pending.sort(key=itemgetter(0))
        due = bisect_right(self._pending, until, key=itemgetter(0))
        change = self._writer.change
        for at, variable, value in self._pending[:due]:
            change(variable, at, value)
        del self._pending[:due]

    def close(self, now_ps: int) -> None:
        """Write what is still held back, and the end's instant."""
        self._write(now_ps)
        self._writer.close(now_ps)


class Dump:
    """Takes a run slice by slice and writes it as it comes."""

    def __init__(self, file: TextIO, run: Any, settings: Settings) -> None:
        """The run must be at its begin, with config.seen and config.trace on."""
        self._run = run
        self._settings = settings
        self._writer = Writer(file, run.now_ps, settings.baud)
        self._put = self._writer.put
        self._next_analog_ps = run.now_ps
        self._decoders = {net: uart.Decoder(settings.baud) for net in LINES}
        self._pins = [sum(run.pin(n, bit) << bit for bit in range(8)) for n in range(PORTS)]
        self._nets = [self._net(net, run) for net in _run.WIRES]
        self._ports = [self._variable("cpu", f"P{n}", "wire", 8, self._pins[n]) for n in range(PORTS)]
        self._sfrs = [self._variable("cpu", name, "reg", 8, None) for name in settings.sfrs]
        self._interrupt = self._variable("cpu", "interrupt", "string", None, "")
        self._octets = {net: self._variable("uart", f"{net}_octet", "string", None, "") for net in LINES}
        self._channel = self._variable("tlc2543", "channel", "integer", 8, None)
        self._code = self._variable("tlc2543", "code", "integer", 16, None)
        self._sampled = self._variable("tlc2543", "sampled", "event", None, None)
        self._volts = [
            self._variable("analog", f"AIN{n}", "real", None, _run.volts(run, n, run.now_ps)) for n in range(CHANNELS)
        ]

    def _net(self, net: str, run: Any) -> Any:
        """A wire's variable, at its level now."""
        level = int(run.level(_run.WIRES.index(net)))
        return self._variable("uart" if net in LINES else "tlc2543", identifier(net), "wire", 1, level)

    def _variable(self, scope: str, name: str, kind: str, size: int | None, value: Any) -> Any:
        return self._writer.variable(f"board.{scope}", name, kind, size, value)

    def slice(self, edges: Any, pins: Any, changes: Any, samples: Samples) -> None:
        """What happened since the last call, up to the run's present: `changes` are what an Observer has seen."""
        now = self._run.now_ps
        for at, wire, level in edges.tolist():
            self._put(at, self._nets[wire], level)
        for at, pin, level in pins.tolist():
            port, bit = divmod(pin, 8)
            self._pins[port] = self._pins[port] & ~(1 << bit) | level << bit
            self._put(at, self._ports[port], self._pins[port])
        for at, what, value in changes.tolist():
            if what < 0:
                self._put(at, self._interrupt, self._settings.interrupt_name(value) if value >= 0 else "")
            else:
                self._put(at, self._sfrs[what], value)
        for net, decoder in self._decoders.items():
            wire = _run.WIRES.index(net)
            for frame in decoder.feed(((at, bool(level)) for at, w, level in edges.tolist() if w == wire), now):
                self._writer.octet(frame, self._octets[net])
        for at, channel, code, volts in samples:
            if channel < len(self._volts):
                self._put(at, self._volts[channel], volts)
            self._put(at, self._channel, channel)
            self._put(at, self._code, code)
            self._put(at, self._sampled, True)
        while self._next_analog_ps <= now:
            for channel, variable in enumerate(self._volts):
                self._put(self._next_analog_ps, variable, _run.volts(self._run, channel, self._next_analog_ps))
            self._next_analog_ps += round(self._settings.analog_us * PS_PER_US)
        self._writer.write(now)

    def close(self) -> None:
        """Write what is still held back, and the end's instant."""
        self._writer.close(self._run.now_ps)
