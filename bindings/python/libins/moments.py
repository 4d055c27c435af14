"""The lines of a run around the instants that explain its verdict, kept while the run passes, and what they carried.

An instant is where the board first reported something of a kind, where a fault begins, where a value that an
expectation is on first went wrong (a sample was lost) or was worst (an error, an age); of a run that failed otherwise
the last that moved. Memory holds a second of edges and the windows found.
"""

from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from libins import faults, uart
from libins.machine import AXES, COLUMNS, PS_PER_S, AcquisitionMachine, Array, Machine
from libins.net_machine import NetMachine
from libins.scenario import Scenario
from libins.tables import Loaded
from libins.views import LINES, View

SPAN_S = 0.02
"""Before and after an instant."""
KEPT_S = 1.0
MOST = 12
"""Windows of a run, the first ones."""
MOST_EDGES = 4000
"""Of a window; what is further from its instant is left out."""
WORST = {f"attitude.{kind}_rad.{axis}": f"error_{axis}_rad" for kind in ("max", "rms") for axis in AXES}
WORST |= {"age_s.max": "age_s", "age_s.mean": "age_s"}
FIRST = {"link.lost": "bridged", "link.ok": "bridged"}


@dataclass
class Moment:
    """A window around an instant."""

    title: str
    view: View


@dataclass
class Line:
    """What a wire has carried."""

    baud: float
    octets: int = 0
    bad: int = 0
    """Stop bits that were low."""
    first_ps: int = 0
    last_ps: int = 0
    shortest_ps: int = 0
    """Between the begins of two octets."""

    def add(self, frame: uart.Frame) -> None:
        """An octet more."""
        if self.octets == 0:
            self.first_ps = frame.begin_ps
        else:
            apart = frame.begin_ps - self.last_ps
            self.shortest_ps = apart if self.octets == 1 else min(self.shortest_ps, apart)
        self.octets += 1
        self.bad += not frame.framing_ok
        self.last_ps = frame.begin_ps

    @property
    def octet_s(self) -> float:
        """What one takes."""
        return uart.BITS / self.baud


def bauds_of(scenario: Loaded, machine: Machine) -> dict[str, float]:
    """Of the wires that carry octets."""
    if isinstance(machine, NetMachine):
        return {f"{wire.station}.{wire.name}": wire.baud for wire in machine.traced}
    assert isinstance(scenario, Scenario)
    return dict.fromkeys(LINES, scenario.tables.link.baud)


def begins_of(every: Sequence[faults.Fault]) -> list[tuple[str, float]]:
    """What to call the faults that begin after the start, and when they do [s]."""
    found = []
    for place, fault in enumerate(every):
        at_s = fault.at_s if fault.at_s is not None else fault.from_s
        if fault.on and fault.rate_per_s is None and at_s:
            where = next((f" on {each}" for each in (fault.net, fault.line) if each), "")
            found.append((f"fault {place}, {fault.kind}{where}, begins at {at_s:.6f} s", at_s))
    return found


class Moments:
    """Of one run: slice() after each piece of it, end() at its end."""

    def __init__(self, scenario: Loaded, machine: Machine) -> None:
        """At the run's begin."""
        self._wires = list(machine.wires)
        bauds = bauds_of(scenario, machine)
        self.lines = {net: Line(baud) for net, baud in bauds.items()}
        self._decoders = {net: uart.Decoder(baud) for net, baud in bauds.items()}
        level = machine.run.level if isinstance(machine, AcquisitionMachine) else lambda _: True
        self._levels = {net: bool(level(number)) for number, net in enumerate(self._wires)}
        """Before the first edge that is kept."""
        self._edges: Array = np.empty((0, 3), np.int64)
        self._frames: dict[str, deque[uart.Frame]] = {net: deque() for net in bauds}
        self._due: dict[str, tuple[int, str]] = {}
        """Instant and title of windows that are not complete, by what they are of."""
        self._found: dict[str, Moment] = {}
        self._worst: dict[str, float] = {}
        self._last_s = 0.0
        """Of the last state."""
        self._scored = list(machine.columns[: len(COLUMNS)]) == list(COLUMNS)
        self._wanted = {expect.value for expect in scenario.tables.expect}
        self._reported: set[tuple[str, str]] = set()
        for title, at_s in begins_of(scenario.tables.fault):
            self._want(title, round(at_s * PS_PER_S), title)

    def _want(self, key: str, at_ps: int, title: str) -> None:
        if key in self._due or key in self._found or len(self._due) + len(self._found) < MOST:
            self._due[key] = (at_ps, title)

    def slice(self, machine: Machine, edges: Array, states: Array) -> None:
        """What happened since the last call."""
        now_ps = machine.now_ps
        self._keep(edges, now_ps)
        for report in machine.reports():
            kind = (str(report.get("board", "")), str(report["text"]))
            if kind not in self._reported:
                self._reported.add(kind)
                board = f"{kind[0]}: " if kind[0] else ""
                title = f"{report['kind']}: {board}{report['text']}, first at {report['first_s']:.6f} s"
                self._want(title, round(report["first_s"] * PS_PER_S), title)
        if self._scored and len(states):
            self._look(states)
        self._cut(now_ps, final=False)

    def _keep(self, edges: Array, now_ps: int) -> None:
        """Edges and octets of the last second."""
        begin = now_ps - round(KEPT_S * PS_PER_S)
        for number, net in enumerate(self._wires):
            if net in self._decoders:
                mine = edges[edges[:, 1] == number]
                for frame in self._decoders[net].feed(((at, bool(up)) for at, _, up in mine.tolist()), now_ps):
                    self.lines[net].add(frame)
                    self._frames[net].append(frame)
                while self._frames[net] and self._frames[net][0].begin_ps < begin:
                    self._frames[net].popleft()
        self._edges = np.concatenate([self._edges, edges])
        gone = int(np.searchsorted(self._edges[:, 0], begin))
        for number, net in enumerate(self._wires):
            mine = self._edges[:gone][self._edges[:gone, 1] == number]
            if len(mine):
                self._levels[net] = bool(mine[-1, 2])
        self._edges = self._edges[gone:]

    def _look(self, states: Array) -> None:
        """For the first and the worst of what expectations are on."""
        instants = states[:, COLUMNS["t_s"]]
        for value in sorted(self._wanted & WORST.keys()):
            column = np.abs(states[:, COLUMNS[WORST[value]]])
            worst = int(column.argmax())
            if column[worst] > self._worst.get(value, -1.0):
                self._worst[value] = float(column[worst])
                at_s = float(instants[worst])
                self._want(value, round(at_s * PS_PER_S), f"{value} is worst at {at_s:.6f} s: {column[worst]:.6g}")
        for value in sorted(self._wanted & FIRST.keys() - self._worst.keys()):
            gaps = states[:, COLUMNS[FIRST[value]]]
            lost = np.flatnonzero(gaps)
            if len(lost):
                before = float(instants[lost[0] - 1]) if lost[0] > 0 else self._last_s
                at_s = before + (float(instants[lost[0]]) - before) / (float(gaps[lost[0]]) + 1)
                self._worst[value] = at_s
                title = f"{value}: the first sample that did not come is of {at_s:.6f} s"
                self._want(value, round((at_s + SPAN_S / 2) * PS_PER_S), title)
        self._last_s = float(instants[-1])

    def _cut(self, now_ps: int, final: bool) -> None:
        """Windows that are complete, or all."""
        for key, (at_ps, title) in list(self._due.items()):
            if final or at_ps + round(SPAN_S * PS_PER_S) <= now_ps:
                self._found[key] = Moment(title, self._view(at_ps))
                del self._due[key]

    def _view(self, at_ps: int) -> View:
        span = round(SPAN_S * PS_PER_S)
        near = np.abs(self._edges[:, 0] - at_ps) <= span
        if near.sum() > MOST_EDGES:
            apart = np.sort(np.abs(self._edges[near, 0] - at_ps))
            near &= np.abs(self._edges[:, 0] - at_ps) <= apart[MOST_EDGES]
        view = View(at_ps, {})
        first = int(near.argmax()) if near.any() else len(self._edges)
        for number, net in enumerate(self._wires):
            before = self._edges[:first][self._edges[:first, 1] == number]
            level = bool(before[-1, 2]) if len(before) else self._levels[net]
            mine = self._edges[near & (self._edges[:, 1] == number)]
            view.nets[net] = [(at_ps - span, level), *((int(at), bool(up)) for at, _, up in mine.tolist())]
            view.frames[net] = [f for f in self._frames.get(net, ()) if abs(f.begin_ps - at_ps) <= span]
        return view

    def end(self, machine: Machine, failed: Mapping[str, str]) -> list[Moment]:
        """Those that explain the verdict, by time; failed: text by the value of each expectation that was not met."""
        self._cut(machine.now_ps, final=True)
        shown = [m for key, m in self._found.items() if key not in self._wanted]
        for value, text in failed.items():
            if value in self._found:
                moment = self._found[value]
                shown.append(Moment(f"{text}: {moment.title}", moment.view))
        if failed and not shown:
            text = next(iter(failed.values()))
            last_ps = int(self._edges[-1, 0]) if len(self._edges) else machine.now_ps
            shown.append(Moment(f"{text}: the end of what the run had on its lines", self._view(last_ps)))
        return sorted(shown, key=lambda moment: moment.view.at_ps)
