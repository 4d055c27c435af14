"""Faults, declared: the [[fault]] tables of a scenario, and what a test breaks on a Board. docs/faults.md.

Every fault has a random stream of its own, from the scenario's seed and the fault's place: another fault, or one that
is off, does not change what it does.
"""

import hashlib
import re
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from libins import _run
from libins.schema import Document, Place, field

PS_PER_S = 10**12
NEVER_PS = 2**63 - 1
TIME_MAX_S = 1e6
F2812_LINES = ("SCITXDA", "SCIRXDA", "SCITXDB", "SCIRXDB")
LINES = {"to_board": "RXD", "to_host": "HOST RXD", **{line: line for line in F2812_LINES}}
NETS = r"P[0-3]\.[0-7]|RXD|TXD|HOST RXD|(EOC|I/O CLOCK|DATA IN|DATA OUT|/CS)( [2-4])?"
"""Those that some board has; whether this one does is seen when it is built."""
F2812_NETS = "SCI[TR]XD[AB]"
WINDOW = {"from_s", "to_s"}
INSTANT = {"at_s", "rate_per_s", "from_s", "to_s"}
FLIP = ({"address", "bit"} | INSTANT, set[str]())
RESET = ({"for_s"} | INSTANT, set[str]())
KINDS: Mapping[str, tuple[set[str], set[str]]] = {
    "adc_stuck": (WINDOW | {"channel", "probability"}, {"bit", "value"}),
    "adc_flip": (WINDOW | {"channel", "bit"}, {"probability"}),
    "adc_noise": (WINDOW | {"channel", "probability"}, {"lsb"}),
    "adc_offset": (WINDOW | {"channel", "probability"}, {"lsb"}),
    "eoc_late": (WINDOW | {"channel", "probability"}, {"delay_s"}),
    "eoc_missing": (WINDOW | {"channel", "probability"}, set()),
    "volts_stuck": (WINDOW | {"channel"}, {"volts"}),
    "volts_offset": (WINDOW | {"channel"}, {"volts"}),
    "volts_noise": (WINDOW | {"channel"}, {"volts"}),
    "wire_cut": (WINDOW, {"net"}),
    "wire_short": (WINDOW, {"net", "to"}),
    "break": (WINDOW, {"line"}),
    "baud": (WINDOW, {"ppm"}),
    "crystal": (WINDOW | {"ppm", "drift_ppm_s"}, set()),
    "reset": RESET,
    "power": RESET,
    "brown_out": RESET,
    "iram_flip": FLIP,
    "sfr_flip": FLIP,
    "xdata_flip": FLIP,
    "code_flip": FLIP,
}
"""Keys that a kind may have, and those that it must have, beside kind and on."""
F2812_KINDS = ("crystal", "reset", "power", "wire_cut", "wire_short", "break")
HOST_KINDS = ("baud",)
NO_MEMORY = (
    "firmware for the F2812 is compiled for this machine, so its memory has no faults; there is no TLC2543 beside it"
)
VALUES = ("value", "lsb", "delay_s", "volts", "ppm")
"""What is one number to the emulator."""


@dataclass(frozen=True)
class Fault:
    """One thing that breaks."""

    kind: str = field(choices=tuple(KINDS))
    on: bool = field(True)
    at_s: float | None = field(None, minimum=0.0, maximum=TIME_MAX_S)
    from_s: float | None = field(None, minimum=0.0, maximum=TIME_MAX_S)
    to_s: float | None = field(None, above=0.0, maximum=TIME_MAX_S)
    rate_per_s: float | None = field(None, minimum=0.0, maximum=1e4)
    for_s: float | None = field(None, above=0.0, maximum=TIME_MAX_S)
    probability: float | None = field(None, minimum=0.0, maximum=1.0)
    channel: int | None = field(None, minimum=0, maximum=13)
    address: int | None = field(None, minimum=0, maximum=0xFFFF)
    bit: int | None = field(None, minimum=0, maximum=11)
    value: int | None = field(None, minimum=0, maximum=1)
    lsb: float | None = field(None, minimum=-4095.0, maximum=4095.0)
    delay_s: float | None = field(None, minimum=0.0, maximum=1.0)
    volts: float | None = field(None, minimum=-100.0, maximum=100.0)
    ppm: float | None = field(None, minimum=-100_000.0, maximum=100_000.0)
    drift_ppm_s: float | None = field(None, minimum=-100_000.0, maximum=100_000.0)
    net: str | None = field(None)
    to: str | None = field(None)
    line: str | None = field(None, choices=tuple(LINES))
    station: str | None = field(None)


@dataclass(frozen=True)
class Target:
    """What may break on a station."""

    kinds: Collection[str]
    nets: str
    """As a pattern; a net may be shorted to another where `shorts` is true."""
    example: str
    shorts: bool = False
    lines: tuple[str, ...] = ()
    ram_octets: int = 0
    why: str = ""
    """Of a kind that it cannot have."""


def acquisition(ram_octets: int) -> Target:
    """An acquisition board with the host of its line."""
    return Target(KINDS, NETS, "P1.4, EOC, TXD, HOST RXD ...", True, ("to_board", "to_host"), ram_octets)


F2812 = Target(F2812_KINDS, F2812_NETS, ", ".join(F2812_LINES), lines=F2812_LINES, why=NO_MEMORY)
HOST = Target(HOST_KINDS, "", "", why="a host and a GIMU have a baud that may be off")


def check(document: Document, faults: Sequence[Fault], target: Target) -> None:
    """What one key alone cannot show, of faults that are all the one board's. Raises UsageError."""
    check_of(document, [(("fault", str(i)), fault) for i, fault in enumerate(faults)], target)


def check_of(document: Document, faults: Sequence[tuple[Place, Fault]], target: Target) -> None:
    """As check, of some of the faults, each with its place."""
    shorted: list[tuple[str, float, float]] = []
    for key, fault in faults:
        if fault.kind not in target.kinds:
            found = f"found {fault.kind!r}, but {', '.join(target.kinds)} are possible here: {target.why}"
            raise document.refuse((*key, "kind"), found)
        _check_keys(document, key, fault)
        start, end = fault.from_s or 0.0, TIME_MAX_S if fault.to_s is None else fault.to_s
        if end <= start:
            raise document.refuse((*key, "to_s"), f"found {end}, but it must come after from_s = {start}")
        _check_places(document, key, fault, target)
        nets = {"wire_short": (fault.net, fault.to), "break": (LINES.get(fault.line or ""),)}.get(fault.kind, ())
        for net in nets:
            if net is None or net in ("gnd", "vcc") or not fault.on:
                continue
            if any(net == other and start < until and since < end for other, since, until in shorted):
                raise document.refuse(key, f"{net} is shorted by two faults at a time; change from_s, to_s of one")
            shorted.append((net, start, end))


def _check_keys(document: Document, key: Place, fault: Fault) -> None:
    may, must = KINDS[fault.kind]
    given = {name for name, value in vars(fault).items() if value is not None} - {"kind", "on", "station"}
    for name in sorted(must - given):
        raise document.refuse((*key, name), f"is missing; {fault.kind} needs {', '.join(sorted(must))}")
    for name in sorted(given - may - must):
        known = ", ".join(sorted(may | must)) or "none"
        raise document.refuse((*key, name), f"means nothing to {fault.kind}; its keys: {known}")
    if "at_s" in may and ("at_s" in given) == ("rate_per_s" in given):
        raise document.refuse(key, f"{fault.kind} needs either at_s or rate_per_s")
    if "at_s" in given and given & WINDOW:
        raise document.refuse((*key, "at_s"), "is one instant; from_s and to_s go with rate_per_s")


def _check_places(document: Document, key: Place, fault: Fault, target: Target) -> None:
    rails = f"gnd|vcc|{target.nets}" if target.shorts else "gnd|vcc"
    for name, known in (("net", target.nets), ("to", rails)):
        value = getattr(fault, name)
        if value is not None and not re.fullmatch(known, value):
            net = f"a net is needed: {target.example}"
            needed = net if name == "net" else f"gnd, vcc or {net}" if target.shorts else "gnd or vcc is needed"
            raise document.refuse((*key, name), f"found {value!r}, but {needed}")
    if fault.line is not None and fault.line not in target.lines:
        lines = ", ".join(map(repr, target.lines))
        raise document.refuse((*key, "line"), f"found {fault.line!r}, but one of {lines} is needed")
    if fault.kind.endswith("_flip") and fault.kind != "adc_flip" and (fault.bit or 0) > 7:
        raise document.refuse((*key, "bit"), f"found {fault.bit}, but an octet's bits are 0 .. 7")
    low, high = {"iram_flip": (0, target.ram_octets - 1), "sfr_flip": (0x80, 0xFF)}.get(fault.kind, (0, 0xFFFF))
    if fault.address is not None and not low <= fault.address <= high:
        raise document.refuse((*key, "address"), f"found {fault.address:#x}, but it must lie in {low:#x} .. {high:#x}")


def built(fault: Fault, seed: int, place: int, now_s: float = 0.0) -> Any:
    """The emulator's fault; one that does not say when it begins, begins now."""

    def ps(seconds: float) -> int:
        return round(seconds * PS_PER_S)

    made = _run.Fault(fault.kind)
    made.seed = int.from_bytes(hashlib.sha256(f"{seed} fault {place}".encode()).digest()[:8], "little")
    begins = fault.at_s if fault.at_s is not None else fault.from_s
    made.from_ps = ps(now_s if begins is None else begins)
    made.to_ps = NEVER_PS if fault.to_s is None else ps(fault.to_s)
    made.rate_hz = fault.rate_per_s or 0.0
    if not fault.on or fault.rate_per_s == 0.0:
        made.from_ps = NEVER_PS
    if "for_s" in KINDS[fault.kind][0]:
        made.lasts_ps = ps(1e-3 if fault.for_s is None else fault.for_s)
    made.probability = 1.0 if fault.probability is None else fault.probability
    made.value = float(next((v for v in map(vars(fault).get, VALUES) if v is not None), 0.0))
    made.drift = fault.drift_ppm_s or 0.0
    for name in ("channel", "address", "bit"):
        if (number := getattr(fault, name)) is not None:
            setattr(made, name, number)
    made.net = LINES[fault.line] if fault.line is not None else fault.net or ""
    made.other = "gnd" if fault.line is not None else fault.to or ""
    return made


def counted(hits: Sequence[tuple[str, int]]) -> dict[str, dict[str, int]]:
    """How often each fault has acted, by its place: {"0": {"eoc_late": 17}}."""
    return {str(place): {kind: count} for place, (kind, count) in enumerate(hits)}


class Faults:
    """What is broken on a Board."""

    def __init__(self, do: Callable[..., Any], hits: Callable[[], Sequence[tuple[str, int]]]) -> None:
        """do: a change from outside; hits: of the run."""
        self._do = do
        self._hits = hits

    def add(self, kind: str, **keys: Any) -> None:
        """Break something; keys as in a [[fault]] table, from now on where none says when. Raises UsageError."""
        self._do("add_fault", {"kind": kind, **keys})

    def hits(self) -> Sequence[tuple[str, int]]:
        """Kind of each fault, the scenario's first, and how often it has acted."""
        return self._hits()


def parsed(keys: Mapping[str, Any], now_s: float, target_of: Callable[[Document, Fault], Target]) -> Fault:
    """A fault from keys of Python; target_of: of whom. Raises UsageError."""
    document = Document(Path("Board.faults.add"), {"fault": dict(keys)})
    fault = document.parse(Fault, document.table["fault"], ("fault",))
    if "at_s" in KINDS[fault.kind][0] and fault.at_s is None and fault.rate_per_s is None:
        fault = replace(fault, at_s=now_s)
    check(document, [fault], target_of(document, fault))
    return fault
