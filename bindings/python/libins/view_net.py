"""Stations on lines behind a page: the machine of `ins run`, forwards only."""

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from libins import faults, net_scenario, score
from libins.errors import UsageError
from libins.machine import COLUMNS, PS_PER_S, Array
from libins.net_machine import PINS, NetMachine, told
from libins.net_scenario import NetScenario
from libins.net_tables import AcquisitionBoard, F2812Board
from libins.schema import Document
from libins.uart import Decoder
from libins.view_forms import fault_forms
from libins.view_history import EDGES_KEPT, OCTETS_KEPT, Rows
from libins.view_session import Asked, Json, Move

EDGES_TOLD = 2000
EDGES_ASKED = 200_000
LINK = ("accepted", "lost", "duplicates", "corrupt", "timeouts", "octets_received", "framing_errors")


class Way:
    """One direction of a board's serial port."""

    def __init__(self, wire: int, baud: float) -> None:
        """wire: of the machine's."""
        self.wire, self.octets = wire, Rows(OCTETS_KEPT, 2, np.int64)
        self._decoder = Decoder(baud)

    def follow(self, edges: Array, now_ps: int) -> None:
        """The edges of all wires since the last call."""
        mine = ((at, bool(level)) for at, wire, level in edges.tolist() if wire == self.wire)
        frames = [(frame.begin_ps, frame.octet) for frame in self._decoder.feed(mine, now_ps)]
        self.octets.add(np.array(frames, np.int64).reshape(-1, 2))


class NetEngine:
    """One machine; see view_session.Engine."""

    def __init__(self, scenario: NetScenario) -> None:
        """At time 0. Raises UsageError, CrashError."""
        self._scenario = scenario
        self._slice_ps = PS_PER_S // 100
        self._power_on()
        self.moves: Mapping[str, Move] = {"run": self._run, "to": self._to}
        self.commands: Mapping[str, Callable[[Asked], Json]] = {
            "reset": self._reset,
            "uart_send": self._send,
            "fault_add": self._fault_add,
            "edges": self._edges_between,
        }

    def _power_on(self) -> None:
        self._machine = NetMachine(self._scenario, self._scenario.tables.seed, keep_states=False)
        self._edges = Rows(EDGES_KEPT, 3, np.int64)
        self._levels = dict.fromkeys(self._machine.wires, 1)
        self._ways = {
            name: Way(i, wire.baud)
            for i, (name, wire) in enumerate(zip(self._machine.wires, self._machine.traced, strict=True))
        }
        self._state: Array | None = None
        self._stop: Json | None = None
        self._restarted = False

    @property
    def now_ps(self) -> int:
        """See Engine."""
        return self._machine.now_ps

    def slice(self, ps: int) -> None:
        """See Engine."""
        self._slice_ps = ps

    def close(self) -> None:
        """See Engine."""
        self._machine.close()

    # What is told

    def _ports(self) -> dict[str, tuple[str, str]]:
        """Serial ports of boards, and the wires from each and to it."""
        found: dict[str, tuple[str, str]] = {}
        for board in self._scenario.tables.board:
            for port, (sends, receives) in PINS.items():
                wires = f"{board.name}.{sends}", f"{board.name}.{receives}"
                if wires[0] in self._ways:
                    found[f"{board.name}.{port}"] = wires
        return found

    def hello(self) -> Json:
        """See Engine."""
        s, tables = self._scenario, self._scenario.tables
        clocks = [b.oscclk_hz if isinstance(b, F2812Board) else b.clock_hz for b in tables.board]
        ways = self._ways
        kinds = {kind for target in net_scenario.targets_of(tables).values() for kind in target.kinds}
        return {
            "title": s.name,
            "kind": "net",
            "clock_hz": clocks[0],
            "stop_s": tables.stop_s,
            "wires": list(self._machine.wires),
            "parts": self._parts(),
            "lines": list(self._ports()),
            "bauds": {port: self._machine.traced[ways[sends].wire].baud for port, (sends, _) in self._ports().items()},
            "knobs": [],
            "faults": fault_forms(kinds, faults.F2812_LINES, [board.name for board in tables.board]),
            "files": [],
            "functions": [],
            "registers": [],
            "memories": [],
            "has_source": False,
            "can_step": False,
            "navigator": self._machine.navigates,
            "scenario_text": s.text,
        }

    def _parts(self) -> list[Json]:
        """Boards, sensors and hosts; a net is a line."""
        tables = self._scenario.tables

        def net(end: str) -> str:
            return next((f"line {i}" for i, line in enumerate(tables.line) if end in line.ends), end)

        def part(name: str, kind: str, ends: Sequence[str]) -> Json:
            pins = [{"name": end.rpartition(".")[2], "net": net(end)} for end in ends]
            return {"name": name, "kind": kind, "pins": pins}

        ports = {F2812Board: ("SCIA", "SCIB"), AcquisitionBoard: ("UART",)}
        boards = [part(b.name, b.kind, [f"{b.name}.{port}" for port in ports[type(b)]]) for b in tables.board]
        gimus = [part(g.name, "gimu", [f"{g.name}.T", f"{g.name}.R"]) for g in tables.gimu]
        return [*boards, *gimus, *[part(host.name, "host", [host.name]) for host in tables.host]]

    def frame(self, whole: bool) -> Json:
        """See Engine."""
        now = self.now_ps
        edges = self._edges
        first = max(edges.gone if whole else edges.told, edges.count - EDGES_TOLD)
        rows = edges.part(first, edges.count)
        lines: Json = {}
        for port, (sends, receives) in self._ports().items():
            lines[port] = {**self._octets(sends, "tx", whole), **self._octets(receives, "rx", whole)}
        lit = {self._machine.wires[wire] for wire in set(rows[:, 1].tolist())}
        told: Json = {
            "t_ps": now,
            "cycle": None,
            "pc": None,
            "place": "",
            "line": None,
            "stop": self._stop,
            "pins": {},
            "nets": dict(self._levels),
            "registers": {},
            "volts": {},
            "codes": {},
            "edges": rows.tolist(),
            "dropped": 0 if whole else first - edges.told,
            "analog": [],
            "uart": lines,
            "led": {wire: int(wire in lit) for wire in self._machine.wires},
            "breaks": [],
            "knobs": {},
            "faults": [
                {"index": i, "kind": kind, "on": True, "hits": hits}
                for i, (kind, hits) in enumerate(self._machine.fault_hits())
            ],
            "link": self._link(),
            **self._solution(now),
        }
        if not whole:
            edges.told = edges.count
            if self._restarted:
                told["rewound"], self._restarted = 0, False
        return told

    def _octets(self, wire: str, way: str, whole: bool) -> Json:
        if wire not in self._ways:
            return {way: "", f"{way}_from": 0}
        rows = self._ways[wire].octets
        first = rows.gone if whole else rows.told
        octets = rows.part(first, rows.count)
        if not whole:
            rows.told = rows.count
        return {way: bytes(octets[:, 1].tolist()).hex(), f"{way}_from": rows.count - len(octets)}

    def _link(self) -> Json:
        counts: Json = {}
        for host in self._scenario.tables.host:
            c = self._machine.net.host_counters(host.name)
            counts |= {f"{host.name}.{name}": c[name] for name in LINK if name in c}
        return counts

    def _solution(self, now: int) -> Json:
        """Truth now, and the newest state beside the truth at its arrival."""
        track, row = self._machine.track, self._state
        there = track.at(now * 1e-12) if track is not None else None
        truth = None
        if there is not None:
            truth = {"q": there["q_local"], "euler": score.euler(there["q_local"]), "w": there["w_ib_b"]}
        told: Json = {"truth": truth, "estimate": None, "error": None, "position": None}
        if there is not None:
            told["position"] = {"llh": there["llh"], "en": [there["p_n"][1], there["p_n"][0]], "estimate": None}
        if row is None:
            return told
        solves = self._machine.columns is not None and "heading_rad" in self._machine.columns
        column = score.COLUMN if solves else COLUMNS

        def values(*names: str) -> list[float]:
            return [float(row[column[name]]) for name in names]

        euler = values(*(score.EULER if solves else ("roll_rad", "pitch_rad", "yaw_rad")))
        q = values("q_w", "q_x", "q_y", "q_z")
        told["estimate"] = {"t_s": values("t_s")[0], "q": q, "euler": euler, "w": None}
        if not solves:
            told["error"] = values("error_roll_rad", "error_pitch_rad", "error_yaw_rad")
        elif there is not None:
            then = track.at(values("at_s")[0])
            told["error"] = [score.wrapped(a - b) for a, b in zip(euler, score.euler(then["q_local"]), strict=True)]
            if row[column["zone"]]:
                latitude, longitude = values("lat_rad", "lon_rad")
                north, east = score.away_m(latitude, longitude, there["llh"])
                en = told["position"]["en"]
                told["position"]["estimate"] = {"en": [en[0] + east, en[1] + north]}
        return told

    # What moves it

    def _run(self, asked: Asked, between: Callable[[], bool]) -> Json:
        return self._go(None, between)

    def _to(self, asked: Asked, between: Callable[[], bool]) -> Json:
        goal = asked.whole("t_ps", 0, 10**18)
        if goal < self.now_ps:
            raise UsageError(f"to: t_ps: found {goal}, but these boards go forwards only; now is {self.now_ps}")
        return self._go(goal, between)

    def _go(self, goal: int | None, between: Callable[[], bool]) -> Json:
        self._stop = None
        kind = "interrupted"
        while goal is None or self.now_ps < goal:
            machine = self._machine
            end_ps = machine.now_ps + self._slice_ps
            machine.until(end_ps if goal is None else min(goal, end_ps))
            self._follow()
            if (end := machine.ended()) is not None:
                self._stop = {"kind": "end", "notes": [end]}
                return {"stop": self._stop}
            if between():
                break
        else:
            kind = "limit"
        self._stop = {"kind": kind, "notes": []}
        return {"stop": self._stop}

    def _follow(self) -> None:
        edges = self._machine.take_edges()
        self._edges.add(edges)
        for _, wire, level in edges.tolist():
            self._levels[self._machine.wires[wire]] = level
        for way in self._ways.values():
            way.follow(edges, self.now_ps)
        states, _ = self._machine.take_states()
        if len(states):
            self._state = states[-1]

    # What is asked

    def _reset(self, asked: Asked) -> Json:
        self._machine.close()
        self._power_on()
        self._restarted = True
        return {}

    def _send(self, asked: Asked) -> Json:
        hosts = {host.name: host for host in self._scenario.tables.host}
        line = asked.text("line")
        ends = next((each.ends for each in self._scenario.tables.line if line in each.ends), [line])
        host = next((end for end in ends if end in hosts), None)
        if host is None or hosts[host].mode != "octets":
            free = ", ".join(h.name for h in hosts.values() if h.mode == "octets") or "none"
            raise UsageError(f"uart_send: {line!r} is no line to a host of octets; such hosts here: {free}")
        self._machine.send(host, asked.octets())
        return {}

    def _fault_add(self, asked: Asked) -> Json:
        tables = self._scenario.tables
        keys = {key: value for key, value in asked.message.items() if key not in ("id", "do") and value is not None}
        now_s = self.now_ps * 1e-12

        def target(document: Document, fault: faults.Fault) -> faults.Target:
            return net_scenario.targets_of(tables)[net_scenario.station_of(document, ("fault",), fault, tables)]

        fault = faults.parsed(keys, now_s, target)
        place = len(self._machine.fault_hits())
        with told("fault_add"):
            self._machine.add_fault(fault, tables.seed, place, now_s)
        return {"index": place}

    def _edges_between(self, asked: Asked) -> Json:
        begin, end = asked.whole("from_ps", 0, 10**18), asked.whole("to_ps", 0, 10**18)
        rows = self._edges.part(self._edges.until(begin - 1), self._edges.until(end))
        if asked.has("wires"):
            wanted = asked.texts("wires", len(self._machine.wires))
            rows = rows[[self._machine.wires[wire] in wanted for wire in rows[:, 1].tolist()]]
        dropped = max(0, len(rows) - EDGES_ASKED)
        return {"edges": rows[dropped:].tolist(), "dropped": dropped, "kept_from_ps": self._edges.begin}
