"""Kinds of faults with their keys, for the form of a page."""

from collections.abc import Collection, Sequence
from dataclasses import fields
from typing import Any

from libins import faults

Json = dict[str, Any]
UNITS = {"s": "s", "hz": "Hz", "ppm": "ppm", "lsb": "LSB", "volts": "V", "ppm_s": "ppm/s"}
"""By the end of a key's name."""
NOT_ASKED = ("kind", "on", "station")


def fault_forms(kinds: Collection[str], lines: Sequence[str], stations: Sequence[str] = ()) -> Json:
    """For the hello; lines: whose wire may break; stations: of which one is asked for, where there are several."""
    known = {each.name: each for each in fields(faults.Fault)}

    def key(name: str, must: set[str]) -> Json:
        limits = known[name].metadata
        kind = str(known[name].type)
        shown: Json = {"name": name, "required": name in must, "type": "text" if "str" in kind else "number"}
        unit = next((unit for end, unit in UNITS.items() if name == end or name.endswith(f"_{end}")), None)
        shown |= {"unit": unit} if unit else {}
        shown |= {"min": limits["minimum"]} if "minimum" in limits else {}
        shown |= {"min": limits["above"]} if "above" in limits else {}
        shown |= {"max": limits["maximum"]} if "maximum" in limits else {}
        shown |= {"step": 1} if "int" in kind else {}
        choices = lines if name == "line" else limits.get("choices")
        return shown | ({"choices": list(choices)} if choices else {})

    order = [name for name in known if name not in NOT_ASKED]
    where = [{"name": "station", "required": True, "type": "text", "choices": list(stations)}] if stations else []
    return {
        kind: {"keys": [*where, *(key(name, must) for name in order if name in may | must)]}
        for kind, (may, must) in faults.KINDS.items()
        if kind in kinds
    }
