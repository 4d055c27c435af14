"""The acquisition board behind a page: libins.debugger drives it, the page's commands are the debugger's words."""

import base64
import tempfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from libins import debug_views, faults, snapshot, view_parts
from libins.board_uart import Octet
from libins.breakpoints import Stop
from libins.debugger import Debugger
from libins.disasm import decode
from libins.errors import UsageError
from libins.machine import COLUMNS
from libins.places import MEMORIES
from libins.tables import is_image
from libins.view_forms import fault_forms
from libins.view_hand import LINE, Hand
from libins.view_history import LINE_PINS, OCTETS_KEPT, WIRES, History, Rows
from libins.view_session import Asked, Json, Move
from libins.view_verdicts import verdicts

FOREVER_PS = 10**18
EDGES_TOLD, SAMPLES_TOLD = 2000, 500
"""Of one frame at most; of more, the newest."""
NEWEST_SAMPLES = 64
"""Among them, the newest of each channel is looked for."""
EDGES_ASKED = 200_000
"""Of one `edges` at most."""
WATCHED_MAX = 64
TRIGGERS: Mapping[str, tuple[bool, bool]] = {"rise": (True, False), "fall": (False, True), "level": (True, True)}


class BoardEngine:
    """One debugger and its history; see view_session.Engine."""

    def __init__(self, debugger: Debugger, folders: Sequence[Path] = ()) -> None:
        """The debugger must keep what passes (seen), and stand at its begin. folders: where C files are."""
        self.d = debugger
        self.history = History()
        self.d.timeline.follow(self.history)
        self.hand = Hand(debugger)
        self.sources = debug_views.Sources(debugger, list(folders))
        motion_end_s = self._motion_end_s()
        self.d.end_ps = FOREVER_PS if motion_end_s is None else round(motion_end_s * 1e12)
        self._stop: Stop | None = None
        self._going = False
        self._watched: list[str] = []
        self._trigger: int | None = None
        self.moves: Mapping[str, Move] = {
            "run": self._moved(lambda asked: self.d.resume()),
            "step": self._moved(lambda asked: self._step(asked, self.d.step, self.d.step_instruction)),
            "step_over": self._moved(lambda asked: self.d.step(over=True)),
            "finish": self._moved(lambda asked: self.d.finish()),
            "step_back": self._moved(
                lambda asked: self._step(asked, self.d.reverse_step, self.d.reverse_step_instruction)
            ),
            "step_over_back": self._moved(lambda asked: self.d.reverse_step(over=True)),
            "run_back": self._moved(lambda asked: self.d.reverse_resume()),
            "to": self._moved(self._to),
        }
        self.commands: Mapping[str, Callable[[Asked], Json]] = {
            "break_add": self._break_add,
            "break_remove": self._break_remove,
            "breaks": lambda asked: {"breaks": self._breaks()},
            "trigger": self._set_trigger,
            "watch": self._watch,
            "source": self._source,
            "disassembly": self._disassembly,
            "memory": self._memory,
            "registers": lambda asked: {"registers": self._registers(), "sfrs": dict(debug_views.sfrs(self.d))},
            "edges": self._edges,
            "snapshot": self._snapshot,
            "files": lambda asked: {"files": self._files()},
            **self.hand.commands,
        }

    @property
    def now_ps(self) -> int:
        """See Engine."""
        return int(self.d.run.now_ps)

    def slice(self, ps: int) -> None:
        """See Engine."""
        self.d.slice_cycles = max(1, ps // self.d.timeline.ps(1))

    def close(self) -> None:
        """See Engine."""

    def _motion_end_s(self) -> float | None:
        """Where the files of the motion end."""
        s = self.d.scenario
        ends = [float(rows[-1, 0]) for rows in (s.csv, s.path_csv) if rows is not None]
        return min(ends, default=None)

    # What is told

    def hello(self) -> Json:
        """See Engine."""
        s = self.d.scenario
        return {
            "title": s.name if not is_image(s.path) else s.firmware.name,
            "kind": "8051",
            "part": s.tables.part,
            "clock_hz": s.tables.clock_hz,
            "stop_s": s.tables.stop_s,
            "wires": list(WIRES),
            "parts": view_parts.parts(s.tables, self.d.run.channels),
            "lines": [LINE],
            "bauds": {LINE: s.tables.link.baud},
            "knobs": self.hand.knobs(),
            "faults": fault_forms(faults.KINDS, ("to_board", "to_host")),
            "files": self._files(),
            "functions": [f.name for f in self.d.table.functions] if self.d.table else [],
            "registers": ["pc", *debug_views.NAMES],
            "memories": list(MEMORIES),
            "has_source": self.d.table is not None,
            "can_step": True,
            "navigator": self.d.navigator,
            "scenario_text": s.text,
        }

    def frame(self, whole: bool) -> Json:
        """See Engine."""
        run, now = self.d.run, self.now_ps
        sampled = self.history.samples.until(now)
        newest = self.history.samples.part(sampled - NEWEST_SAMPLES, sampled).tolist()
        line = self.d.line()
        told: Json = {
            "t_ps": now,
            "cycle": int(run.cycle),
            "pc": self.d.pc,
            "place": self.d.where(),
            "line": {"file": line.file, "number": line.number} if line else None,
            "stop": {"kind": self._stop.reason, "notes": self._stop.notes} if self._stop else None,
            "pins": {f"P{port}": sum(run.pin(port, bit) << bit for bit in range(8)) for port in range(4)},
            "nets": {name: int(run.level(name)) for name in WIRES},
            "registers": self._registers(),
            "volts": {str(int(channel)): volts for _, channel, _, volts in newest},
            "codes": {str(int(channel)): int(code) for _, channel, code, _ in newest},
            "breaks": self._breaks(),
            **self._passed(whole, now),
            **self._attitude(now),
            "link": self._link(),
            "verdicts": verdicts(self.d.scenario, run, self.history.totals),
            "knobs": self.hand.values(),
            "faults": self.hand.fault_states(),
        }
        if self._watched:
            told["watch"] = [self._value(text) for text in self._watched]
        return told

    def _passed(self, whole: bool, now: int) -> Json:
        """What happened since the last frame."""
        h = self.history

        def new(rows: Rows, most: int) -> tuple[Any, int]:
            """Its rows, and the number of the first."""
            end = rows.until(now)
            first = max(rows.gone if whole else rows.told, end - most)
            return rows.part(first, end), first

        (edges, first), (samples, _) = new(h.edges, EDGES_TOLD), new(h.samples, SAMPLES_TOLD)
        (tx, tx_from), (rx, rx_from) = new(h.tx, OCTETS_KEPT), new(h.rx, OCTETS_KEPT)
        line = {"tx": _hex(tx), "tx_from": tx_from, "rx": _hex(rx), "rx_from": rx_from}
        told: Json = {
            "edges": edges.tolist(),
            "dropped": 0 if whole else first - h.edges.told,
            "analog": [[int(at), int(channel), volts] for at, channel, _, volts in samples.tolist()],
            "uart": {LINE: line},
            "led": {name: int(name in self._lit(edges)) for name in LINE_PINS.values()},
        }
        if not whole:
            for rows in (h.edges, h.samples, h.tx, h.rx):
                rows.told = rows.until(now)
            if h.rewound is not None:
                told["rewound"] = h.rewound
            h.rewound = None
        return told

    def _lit(self, edges: Any) -> set[str]:
        """Lines on which something passed."""
        return {WIRES[wire] for wire in set(edges[:, 1].tolist())}

    def _attitude(self, now: int) -> Json:
        """Truth now, and the newest state; of accelerometers on a track, the truth at that state."""
        state = self.history.totals.last

        def columns(*names: str) -> list[float]:
            assert state is not None
            return [float(state[COLUMNS[name]]) for name in names]

        truth: Json | None = None
        if self.d.scenario.tables.sixacc is None:
            motion, t_s = self.d.run.motion, now * 1e-12
            truth = {"q": motion.attitude(t_s), "euler": motion.euler(t_s), "w": motion.rate(t_s)}
        elif state is not None:
            euler = columns("true_roll_rad", "true_pitch_rad", "true_yaw_rad")
            truth = {"q": columns("true_q_w", "true_q_x", "true_q_y", "true_q_z"), "euler": euler, "w": None}
        if state is None:
            return {"truth": truth, "estimate": None, "error": None}
        estimate = {
            "t_s": columns("t_s")[0],
            "q": columns("q_w", "q_x", "q_y", "q_z"),
            "euler": columns("roll_rad", "pitch_rad", "yaw_rad"),
            "w": columns("w_x_rad_s", "w_y_rad_s", "w_z_rad_s"),
        }
        error = columns("error_roll_rad", "error_pitch_rad", "error_yaw_rad")
        return {"truth": truth, "estimate": estimate, "error": error}

    def _link(self) -> Json:
        c = self.d.run.counters()
        names = ("accepted", "lost", "duplicates", "corrupt", "timeouts", "framing_errors")
        return {name: c[name] for name in ("sampled", *(names if self.d.navigator else ()), "octets_received")}

    def _registers(self) -> Json:
        d = self.d
        return {"pc": d.pc, **{name: int(d.expression("$" + name).number(d.memory)) for name in debug_views.NAMES}}

    def _value(self, text: str) -> Json:
        try:
            return {"expression": text, "value": self.d.print_value(text)}
        except UsageError as error:
            return {"expression": text, "error": str(error)}

    def _files(self) -> list[str]:
        return list(self.d.table.files()) if self.d.table else []

    # What moves the run

    def _moved(self, go: Callable[[Asked], Stop]) -> Move:
        def move(asked: Asked, between: Callable[[], bool]) -> Json:
            self._stop, self._going, self.d.wants_to_stop = None, True, between
            try:
                self._stop = go(asked)
            except UsageError as error:  # a condition that has no value there
                self._stop = Stop("error", [str(error)])
                raise
            finally:
                self._going, self.d.wants_to_stop = False, lambda: False
            return {"stop": {"kind": self._stop.reason, "notes": self._stop.notes}}

        return move

    def _step(self, asked: Asked, line: Callable[[], Stop], instruction: Callable[[], Stop]) -> Stop:
        return instruction() if asked.message.get("instruction") else line()

    def _to(self, asked: Asked) -> Stop:
        t_ps = asked.whole("t_ps", 0, FOREVER_PS)
        timeline = self.d.timeline
        if t_ps >= self.now_ps:
            return self.d.resume(t_ps)
        if t_ps < timeline.start.at_ps:
            raise UsageError(f"to: {t_ps} ps is before the history, which begins at {timeline.start.at_ps} ps")
        timeline.go_near(t_ps)
        return Stop("limit")

    # Breakpoints

    def _break_add(self, asked: Asked) -> Json:
        condition = asked.text("condition", "")
        if asked.has("at"):
            added = self.d.add_code(asked.text("at"), condition=condition)
        else:
            added = self.d.add_watch(condition, condition=condition)
        self._rearm()
        return {"number": added.number, "breaks": self._breaks()}

    def _break_remove(self, asked: Asked) -> Json:
        self.d.delete(asked.whole("number", 1, 2**31))
        self._rearm()
        return {"breaks": self._breaks()}

    def _rearm(self) -> None:
        if self._going:
            self.d.rearm()

    def _breaks(self) -> list[Json]:
        def shown(each: Any) -> Json:
            line = self.d.line(each.addresses[0]) if each.addresses else None
            return {
                "number": each.number,
                "kind": each.kind,
                "text": each.text,
                "condition": each.condition.text if each.condition else "",
                "hits": each.hits,
                "addresses": list(each.addresses),
                "line": {"file": line.file, "number": line.number} if line else None,
            }

        return [shown(each) for each in self.d.breakpoints.values()]

    def _set_trigger(self, asked: Asked) -> Json:
        if self._trigger is not None:
            self.d.breakpoints.pop(self._trigger, None)
            self._trigger = None
        if asked.has("edge"):
            edge = asked.text("edge")
            if edge not in TRIGGERS:
                raise UsageError(f"trigger: edge: found {edge!r}, but one of {', '.join(TRIGGERS)} or null is needed")
            rising, falling = TRIGGERS[edge]
            self._trigger = self.d.add_edge(asked.text("wire"), rising, falling).number
        self._rearm()
        return {"number": self._trigger}

    # What is asked

    def _watch(self, asked: Asked) -> Json:
        watched = asked.texts("expressions", WATCHED_MAX)
        self._watched = watched
        return {"watch": [self._value(text) for text in watched]}

    def _source(self, asked: Asked) -> Json:
        file = asked.text("file")
        if self.d.table is None or file not in self.d.table.files():
            raise UsageError(f"source: file: found {file!r}, but one of {self._files()} is needed")
        path = self.sources.find(file)
        if path is None:
            raise UsageError(f"{file}: not found in {', '.join(map(str, self.sources.folders))}; give --source DIR")
        addresses: dict[int, list[int]] = {}
        for line in self.d.table.c_lines:
            if line.file == file:
                addresses[line.number] = self.d.table.addresses(file, line.number)
        return {"lines": debug_views.source_lines(path), "addresses": addresses}

    def _disassembly(self, asked: Asked) -> Json:
        address, count = asked.whole("address", 0, 0xFFFF), asked.whole("count", 1, 1024)
        before = asked.whole("before", 0, 256, 0)
        code = self.d.run.read("code", 0, debug_views.COUNT_MAX)
        found = debug_views.instructions_before(self.d, address, before) if before else []
        for _ in range(count):
            found.append(decode(code.__getitem__, address))
            address = address + len(found[-1].octets) & 0xFFFF
        return {"instructions": [self._instruction(each) for each in found]}

    def _instruction(self, each: Any) -> Json:
        line = self.d.line(each.address)
        function = self.d.table.function_at(each.address) if self.d.table is not None else None
        return {
            "address": each.address,
            "octets": each.octets.hex(),
            "text": each.text,
            "function": function.name if function else None,
            "line": {"file": line.file, "number": line.number} if line else None,
        }

    def _memory(self, asked: Asked) -> Json:
        space = asked.text("space")
        if space not in MEMORIES:
            raise UsageError(f"memory: space: found {space!r}, but one of {', '.join(MEMORIES)} is needed")
        address = asked.whole("address", 0, 0xFFFF)
        count = asked.whole("count", 1, 0x10000)
        return {"octets": bytes(self.d.run.read(space, address, min(count, 0x10000 - address))).hex()}

    def _edges(self, asked: Asked) -> Json:
        begin, end = asked.whole("from_ps", 0, FOREVER_PS), asked.whole("to_ps", 0, FOREVER_PS)
        wires = asked.texts("wires", len(WIRES)) if asked.has("wires") else list(WIRES)
        for wire in wires:
            if wire not in WIRES:
                raise UsageError(f"edges: wires: found {wire!r}, but {', '.join(WIRES)} are possible")
        kept = self.history.edges
        rows = kept.part(kept.until(begin - 1), kept.until(min(end, self.now_ps)))
        places = [WIRES.index(wire) for wire in wires]
        rows = rows[[wire in places for wire in rows[:, 1].tolist()]]
        dropped = max(0, len(rows) - EDGES_ASKED)
        return {"edges": rows[dropped:].tolist(), "dropped": dropped, "kept_from_ps": self.history.edges.begin}

    def _snapshot(self, asked: Asked) -> Json:
        d = self.d
        received = tuple(Octet(*octet) for octet in d.timeline.received)
        snap = snapshot.Snapshot(d.scenario, d.navigator, self.now_ps, d.run.save(), received, len(received), {})
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "snapshot"
            snap.write(path)
            return {"name": f"{d.scenario.path.stem}.snapshot", "base64": base64.b64encode(path.read_bytes()).decode()}


def _hex(octets: Any) -> str:
    return bytes(octets[:, 1].tolist()).hex()
