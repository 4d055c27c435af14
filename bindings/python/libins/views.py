"""A window of a run, kept while the run passes: edges, samples, octets and volts around an instant, for pictures."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from libins import _run
from libins.uart import PS_PER_S, Decoder, Frame

SPAN_S = 0.5
"""Before and after the instant."""
CURVE_POINTS = 1000
LINES = ("TXD", "RXD")
CHANNELS = ("X", "Y", "Z")

Edges = list[tuple[int, bool]]


@dataclass
class View:
    """What happened around an instant."""

    at_ps: int
    nets: dict[str, Edges]
    """Edges of each net, after its level at the begin."""
    samples: list[tuple[int, int, int, float]] = field(default_factory=list)
    """Instant, channel, code, volts."""
    frames: dict[str, list[Frame]] = field(default_factory=dict)
    volts: npt.NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 1 + len(CHANNELS))))
    """Seconds, and volts of each input."""


class Nets:
    """Keeps edges and octets of wires around an instant while a run passes."""

    def __init__(
        self, begin: Mapping[str, tuple[int, bool]], bauds: Mapping[str, float], at_s: float, span_s: float = SPAN_S
    ) -> None:
        """begin: instant and level of each wire, in the order of the edges' numbers; bauds: of those with octets."""
        self._decoders = {net: Decoder(baud) for net, baud in bauds.items()}
        self._span_ps = round(span_s * PS_PER_S)
        self.view = View(round(at_s * PS_PER_S), {net: [edge] for net, edge in begin.items()})
        self.view.frames = {net: [] for net in bauds}

    def slice(self, edges: Any, now_ps: int) -> None:
        """What happened since the last call."""
        view = self.view
        for wire, net in enumerate(view.nets):
            rows = edges[edges[:, 1] == wire]
            if net in self._decoders:
                frames = self._decoders[net].feed(((at, bool(level)) for at, _, level in rows.tolist()), now_ps)
                view.frames[net] += [f for f in frames if self.near(f.begin_ps)]
            before = rows[rows[:, 0] < view.at_ps - self._span_ps][-1:]
            near = rows[np.abs(rows[:, 0] - view.at_ps) <= self._span_ps]
            first, later = ([(at, bool(level)) for at, _, level in part.tolist()] for part in (before, near))
            view.nets[net] = (first or view.nets[net]) + later

    def near(self, at: int) -> bool:
        """Whether an instant is in the window."""
        return abs(at - self.view.at_ps) <= self._span_ps


class Recorder:
    """Keeps the view of a run of the acquisition board while it passes."""

    def __init__(self, run: Any, at_s: float, baud: float) -> None:
        """The run must be at its begin."""
        begin = {net: (run.now_ps, bool(run.level(i))) for i, net in enumerate(_run.WIRES)}
        self._nets = Nets(begin, dict.fromkeys(LINES, baud), at_s)
        self.view = self._nets.view

    def slice(self, run: Any, edges: Any, samples: list[tuple[int, int, int, float]]) -> None:
        """What happened since the last call."""
        self._nets.slice(edges, run.now_ps)
        self.view.samples += [sample for sample in samples if self._nets.near(sample[0])]

    def end(self, run: Any) -> None:
        """Ask for the volts, which are a function of time."""
        at = self.view.at_ps
        begin, end = max(0, at - SPAN_S * PS_PER_S), min(run.now_ps, at + SPAN_S * PS_PER_S)
        instants = np.linspace(begin, end, CURVE_POINTS)
        self.view.volts = np.array(
            [[t / PS_PER_S, *(_run.volts(run, c, int(t)) for c in range(len(CHANNELS)))] for t in instants]
        )
