"""A window of a run, kept while the run passes: edges, samples, octets and volts around an instant, for pictures."""

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


class Recorder:
    """Keeps the view of a run while it passes."""

    def __init__(self, run: Any, at_s: float, baud: float) -> None:
        """The run must be at its begin."""
        self._decoders = {net: Decoder(baud) for net in LINES}
        begin = [(run.now_ps, bool(run.level(i))) for i in range(len(_run.WIRES))]
        self.view = View(round(at_s * PS_PER_S), {net: [begin[i]] for i, net in enumerate(_run.WIRES)})
        self.view.frames = {net: [] for net in LINES}

    def slice(self, run: Any, edges: Any, samples: list[tuple[int, int, int, float]]) -> None:
        """What happened since the last call."""
        view = self.view
        for wire, net in enumerate(_run.WIRES):
            mine = [(at, bool(level)) for at, w, level in edges.tolist() if w == wire]
            if net in LINES:
                view.frames[net] += [f for f in self._decoders[net].feed(mine, run.now_ps) if self._near(f.begin_ps)]
            before = [edge for edge in mine if edge[0] < view.at_ps - SPAN_S * PS_PER_S]
            view.nets[net] = (before[-1:] or view.nets[net]) + [edge for edge in mine if self._near(edge[0])]
        view.samples += [sample for sample in samples if self._near(sample[0])]

    def _near(self, at: int) -> bool:
        return abs(at - self.view.at_ps) <= SPAN_S * PS_PER_S

    def end(self, run: Any) -> None:
        """Ask for the volts, which are a function of time."""
        at = self.view.at_ps
        begin, end = max(0, at - SPAN_S * PS_PER_S), min(run.now_ps, at + SPAN_S * PS_PER_S)
        instants = np.linspace(begin, end, CURVE_POINTS)
        self.view.volts = np.array(
            [[t / PS_PER_S, *(_run.volts(run, c, int(t)) for c in range(len(CHANNELS)))] for t in instants]
        )
