"""What a page does to the acquisition board by hand: knobs, faults, octets; and all of it as a scenario.

Each deed is an input of the timeline, so the way back repeats it, and a table of a scenario ([[knob]], [[send]],
[[fault]]), so `ins run` repeats it too, bit for bit: it acts between the same two instructions.
"""

import copy
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from libins import faults, knobs, toml_text
from libins.debugger import Debugger
from libins.errors import UsageError
from libins.faults import Fault
from libins.schema import Document
from libins.tables import PACKAGE, RAM_OCTETS
from libins.view_session import Asked, Json

NS_PER_S = 1e9
PS_PER_NS = 1000
RATE_MAX, TILT_RATE, TILT_LEAST_S = 3.0, 1.0, 0.05
"""Of the knobs that turn the board [rad/s]; how fast a tilt turns it, and how long it takes at least [s]."""
BIAS_MAX, NOISE_MAX, VOLTS_MAX = 0.2, 0.05, 5.0
INPUTS = 11
RESET_S = 1e-3
AXES = "xyz"
LINE = "uart"
"""The host's."""
EULER = ("roll", "pitch", "yaw")


@dataclass(frozen=True)
class Deed:
    """One thing done, as a table of a scenario, and on a run."""

    table: str
    """knob, send or fault."""
    keys: Mapping[str, Any]
    act: Callable[[Any], object]

    def __call__(self, run: Any) -> object:
        """Do it."""
        return self.act(run)


@dataclass(frozen=True)
class End(Deed):
    """A fault ends; `keys` has its index and the instant."""


def instant_before(now_ps: int) -> float:
    """An instant [s] within the last instruction, so that what acts then acts now."""
    return max(0, now_ps - PS_PER_NS // 2) // PS_PER_NS / NS_PER_S


def instant_after(now_ps: int) -> float:
    """The next instant [s] that a scenario can name exactly."""
    return (now_ps + 3 * PS_PER_NS // 2) // PS_PER_NS / NS_PER_S


class Hand:
    """Of one debugger."""

    def __init__(self, debugger: Debugger) -> None:
        """At the begin."""
        self._d = debugger
        self._given = [dict(each) for each in debugger.scenario.table.get("fault", [])]
        self._gyros = debugger.scenario.tables.sixacc is None
        self.commands: Mapping[str, Callable[[Asked], Json]] = {
            "knob": self._knob,
            "fault_add": self._fault_add,
            "fault_remove": self._fault_remove,
            "uart_send": self._send,
            "reset": self._reset,
            "save": lambda asked: {"name": self._name(), "toml": self.text()},
        }

    @property
    def _now_ps(self) -> int:
        return int(self._d.run.now_ps)

    # Knobs

    def knobs(self) -> list[Json]:
        """For the hello."""

        def knob(name: str, label: str, unit: str, low: float, high: float, step: float, group: str) -> Json:
            value = self.values()[name]
            return {
                "name": name, "label": label, "unit": unit, "min": low, "max": high, "step": step, "value": value,
                "group": group,
            }  # fmt: skip

        volts = [knob(f"volts.{i}", f"AIN{i}", "V", 0.0, VOLTS_MAX, 0.01, "Inputs by hand") for i in range(INPUTS)]
        if not self._gyros:
            return volts
        turned = [knob(f"rate.{a}", f"Rate {a}", "rad/s", -RATE_MAX, RATE_MAX, 0.01, "Turn the board") for a in AXES]
        tilted = [
            knob(f"tilt.{name}", name.capitalize(), "rad", -limit, limit, 0.01, "Tilt the board")
            for name, limit in zip(EULER, (math.pi, math.pi / 2, math.pi), strict=True)
        ]
        errors = [knob(f"bias.{a}", f"Bias {a}", "rad/s", -BIAS_MAX, BIAS_MAX, 0.001, "Gyro errors") for a in AXES]
        noise = knob("noise", "Noise", "rad/s/sqrt(Hz)", 0.0, NOISE_MAX, 0.0001, "Gyro errors")
        return [*turned, *tilted, *errors, noise, *volts]

    def values(self) -> Json:
        """Of all knobs now; None: the input follows its sensor."""
        hand = self._d.run.hand()
        held = {f"volts.{i}": hand["volts"].get(i) for i in range(INPUTS)}
        if not self._gyros:
            return held
        rate = hand["rate"] or [0.0] * len(AXES)
        tilt = self._d.run.motion.euler(self._now_ps * 1e-12)
        return {
            **{f"rate.{a}": value for a, value in zip(AXES, rate, strict=True)},
            **{f"tilt.{name}": value for name, value in zip(EULER, tilt, strict=True)},
            **{f"bias.{a}": value for a, value in zip(AXES, hand["bias"], strict=True)},
            "noise": hand["noise"][0],
            **held,
        }

    def _knob(self, asked: Asked) -> Json:
        known = {each["name"]: each for each in self.knobs()}
        name = asked.text("name")
        if name not in known:
            raise UsageError(f"knob: name: found {name!r}, but one of {', '.join(known)} is needed")
        if name.startswith("volts.") and not asked.has("value"):
            channel = int(name.removeprefix("volts."))
            if channel in self._d.run.hand()["volts"]:
                self._turn({"channel": channel, "release": True})
            return {"knobs": self.values()}
        value = asked.number("value", known[name]["min"], known[name]["max"])
        kind, _, which = name.partition(".")
        self._turn(self._keys(kind, which, value))
        return {"knobs": self.values()}

    def _keys(self, kind: str, which: str, value: float) -> Json:
        """Of the [[knob]] table; what the knob leaves as it is, it names too."""
        hand = self._d.run.hand()
        if kind == "volts":
            return {"channel": int(which), "volts": value}
        if kind == "noise":
            return {"noise_rad_s_rthz": value}
        if kind == "bias":
            return {"bias_rad_s": _with(hand["bias"], AXES.index(which), value)}
        if kind == "rate":
            return {"rate_rad_s": _with(hand["rate"] or [0.0] * len(AXES), AXES.index(which), value)}
        now_s = self._now_ps * 1e-12
        motion = self._d.run.motion
        resting = hand["rate"] is not None and not any(hand["rate"])
        goal = motion.euler(knobs.TIME_MAX_S if resting else now_s)
        tilt = _with(goal, EULER.index(which), value)
        most = max(abs(math.remainder(a - b, math.tau)) for a, b in zip(tilt, motion.euler(now_s), strict=True))
        return {"euler_rad": tilt, "turn_s": max(TILT_LEAST_S, most / TILT_RATE)}

    def _turn(self, keys: Json) -> None:
        table = {"at_s": instant_before(self._now_ps), **keys}
        made = knobs.built(Document(Path("knob"), {}).parse(knobs.Knob, table, ("knob", "0")))
        self._do(Deed("knob", table, lambda run: run.add_knob(made)))

    # The line

    def _send(self, asked: Asked) -> Json:
        if asked.text("line", LINE) != LINE:
            raise UsageError(f"uart_send: line: found {asked.text('line')!r}, but this board's only line is {LINE!r}")
        octets, room = asked.octets(), int(self._d.run.send_room)
        if len(octets) > room:
            raise UsageError(f"uart_send: there is room for {room} of {len(octets)} octets; let the board run first")
        sent = knobs.Send(instant_before(self._now_ps), hex=octets.hex())
        table = {"at_s": sent.at_s, "hex": sent.hex}
        made = knobs.built(sent)
        self._do(Deed("send", table, lambda run: run.add_knob(made)))
        return {}

    # Faults

    def _reset(self, asked: Asked) -> Json:
        self._fail({"kind": "power" if asked.message.get("power") else "reset", "for_s": RESET_S})
        return {}

    def _fault_add(self, asked: Asked) -> Json:
        self._fail(
            {key: value for key, value in asked.message.items() if key not in ("id", "do") and value is not None}
        )
        return {"index": len(self._d.run.fault_hits()) - 1}

    def _fail(self, keys: Json) -> None:
        """Break something, from now on where the keys do not say when."""
        kind = str(keys.get("kind"))
        may = faults.KINDS[kind][0] if kind in faults.KINDS else set()
        at = {"at_s": instant_after(self._now_ps)}
        begin = at if "at_s" in may and "rate_per_s" not in keys else {"from_s": at["at_s"]}
        table = {**keys, **({} if {"at_s", "from_s"} & set(keys) else begin)}
        place = len(self._d.run.fault_hits())
        tables = self._d.scenario.tables
        known = self.faults()
        document = Document(Path("fault_add"), {"fault": [*known, table]})
        parsed = [document.parse(Fault, each, ("fault", str(i))) for i, each in enumerate([*known, table])]
        faults.check(document, parsed, faults.acquisition(RAM_OCTETS[tables.part]))
        made = faults.built(parsed[-1], tables.seed, place)
        self._do(Deed("fault", table, lambda run: run.add_fault(made)))

    def _fault_remove(self, asked: Asked) -> Json:
        place = asked.whole("index", 0, len(self._d.run.fault_hits()) - 1)
        at_s = instant_after(self._now_ps)
        at_ps = round(at_s * knobs.PS_PER_S)
        self._do(End("fault", {"place": place, "at_s": at_s}, lambda run: run.end_fault(place, at_ps)))
        return {}

    def faults(self) -> list[Json]:
        """The [[fault]] tables: the scenario's and those that were added, with the ends that they were given."""
        found = copy.deepcopy(self._given)
        for deed in self._deeds():
            if isinstance(deed, End):
                _end(found[deed.keys["place"]], deed.keys["at_s"])
            elif deed.table == "fault":
                found.append(dict(deed.keys))
        return found

    def fault_states(self) -> list[Json]:
        """For a frame."""
        run, now = self._d.run, self._now_ps
        both = zip(run.fault_hits(), run.fault_windows(), strict=True)
        return [
            {"index": i, "kind": kind, "on": from_ps <= now < to_ps, "hits": hits}
            for i, ((kind, hits), (from_ps, to_ps)) in enumerate(both)
        ]

    # All of it

    def _do(self, deed: Deed) -> None:
        try:
            self._d.do(deed)
        except ValueError as error:
            raise UsageError(f"{deed.table}: {error}") from error

    def _deeds(self) -> list[Deed]:
        return [change for _, change in self._d.timeline.changes if isinstance(change, Deed)]

    def text(self) -> str:
        """The scenario with everything that was done, up to now, for `ins run`. Raises UsageError."""
        d = self._d
        if d.timeline.start.at_ps:
            raise UsageError("save: what was before the snapshot is not known; save a snapshot instead")
        s = d.scenario
        table = copy.deepcopy(dict(s.table))
        for key in ("stop_samples", *(() if d.navigator else ("nav",))):
            table.pop(key, None)
        table["firmware"] = s.firmware.name if _packaged(s.firmware) else str(s.firmware.absolute())
        _place_files(table, s.path.parent)
        done = self._deeds()
        if self._now_ps:
            table["stop_s"] = self._now_ps * 1e-12
        for name in ("knob", "send"):
            table[name] = [*table.get(name, []), *(dict(deed.keys) for deed in done if deed.table == name)]
        table["fault"] = self.faults()
        return toml_text.dumps({key: value for key, value in table.items() if value != []})

    def _name(self) -> str:
        return f"{self._d.scenario.path.stem}_done.toml"


def _with(values: Any, place: int, value: float) -> list[float]:
    return [value if i == place else float(old) for i, old in enumerate(values)]


def _end(table: Json, at_s: float) -> None:
    """As if the fault had been declared to end then."""
    begin = float(table.get("at_s") or table.get("from_s") or 0.0)
    if begin >= at_s:
        table["on"] = False
    elif "at_s" not in table:
        table["to_s"] = min(at_s, table.get("to_s", at_s))


def _packaged(image: Path) -> bool:
    return image.parent == PACKAGE / "firmware"


def _place_files(table: Json, folder: Path) -> None:
    """Files beside the scenario are named from the root, so that the new one may lie anywhere."""
    places = [table.get("motion", {}), table.get("track", {}), *table.get("analog", [])]
    for each in places:
        if each.get("csv"):
            each["csv"] = str((folder / each["csv"]).absolute())
