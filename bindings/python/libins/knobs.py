"""What a hand does to a board while it runs, declared: the [[knob]] and [[send]] tables of a scenario.

docs/scenarios.md lists the keys. `ins view` writes these tables when it saves what was done.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from libins import _run
from libins.schema import Document, field

PS_PER_S = 10**12
TIME_MAX_S = 1e6
AXES = 3
SEND_MAX = 4096
"""Octets of one [[send]]."""
KINDS = {
    "rate_rad_s": "rate",
    "euler_rad": "attitude",
    "volts": "volts",
    "release": "release",
    "bias_rad_s": "bias",
    "noise_rad_s_rthz": "noise",
}
"""The key that says what is done, and what the emulator calls it."""
OF_GYROS = ("rate_rad_s", "euler_rad", "bias_rad_s", "noise_rad_s_rthz")
OF_INPUTS = ("volts", "release")


@dataclass(frozen=True)
class Knob:
    """One thing done at an instant: exactly one of the keys of KINDS."""

    at_s: float = field(minimum=0.0, maximum=TIME_MAX_S)
    rate_rad_s: list[float] | None = field(None, minimum=-100.0, maximum=100.0)
    euler_rad: list[float] | None = field(None, minimum=-100.0, maximum=100.0)
    turn_s: float = field(0.5, minimum=1e-3, maximum=1e5)
    channel: int | None = field(None, minimum=0, maximum=10)
    volts: float | None = field(None, minimum=-100.0, maximum=100.0)
    release: bool | None = field(None, choices=(True,))
    bias_rad_s: list[float] | None = field(None, minimum=-100.0, maximum=100.0)
    noise_rad_s_rthz: float | None = field(None, minimum=0.0, maximum=100.0)


@dataclass(frozen=True)
class Send:
    """Octets from the host to the board at an instant: hex or text."""

    at_s: float = field(minimum=0.0, maximum=TIME_MAX_S)
    hex: str | None = field(None)
    text: str | None = field(None)

    def octets(self) -> bytes:
        """What is sent. Raises ValueError."""
        return self.text.encode() if self.text is not None else bytes.fromhex(self.hex or "")


def check(document: Document, knobs: Sequence[Knob], sends: Sequence[Send], gyros: bool) -> None:
    """What one key alone cannot show. Raises UsageError."""
    for i, knob in enumerate(knobs):
        place = ("knob", str(i))
        given = [name for name in KINDS if getattr(knob, name) is not None]
        if len(given) != 1:
            found = " and ".join(given) or "none"
            raise document.refuse(place, f"found {found}, but exactly one of {', '.join(KINDS)} is needed")
        name = given[0]
        if name in OF_GYROS and not gyros:
            raise document.refuse((*place, name), f"this board has no gyros: {' and '.join(OF_INPUTS)} are possible")
        value = getattr(knob, name)
        if isinstance(value, list) and len(value) != AXES:
            raise document.refuse((*place, name), f"found {value!r}, but {AXES} numbers are needed")
        if (name in OF_INPUTS) != (knob.channel is not None):
            needed = "is missing" if name in OF_INPUTS else f"means nothing to {name}"
            raise document.refuse((*place, "channel"), f"{needed}; volts and release have one")
    for i, send in enumerate(sends):
        place = ("send", str(i))
        if (send.hex is None) == (send.text is None):
            raise document.refuse(place, "exactly one of hex and text is needed")
        try:
            count = len(send.octets())
        except ValueError as error:
            raise document.refuse((*place, "hex"), f"found {send.hex!r}: {error}; two digits an octet") from error
        if not 0 < count <= SEND_MAX:
            raise document.refuse(place, f"found {count} octets, but 1 to {SEND_MAX} are needed")


def built(done: Knob | Send) -> Any:
    """The emulator's."""
    at_ps = round(done.at_s * PS_PER_S)
    if isinstance(done, Send):
        made = _run.Knob("send", at_ps)
        made.octets = done.octets()
        return made
    name = next(name for name in KINDS if getattr(done, name) is not None)
    made = _run.Knob(KINDS[name], at_ps)
    value = getattr(done, name)
    made.values = value if isinstance(value, list) else [float(value)] * AXES
    made.channel = done.channel or 0
    made.lasts_ps = round(done.turn_s * PS_PER_S)
    return made
