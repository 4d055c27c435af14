"""The documentation names what there is."""

import dataclasses
import typing
from pathlib import Path

from libins import scenario

ROOT = Path(__file__).resolve().parents[2]


def keys(schema: type) -> set[str]:
    found = set()
    for name, hint in typing.get_type_hints(schema).items():
        found.add(name)
        for part in (hint, *typing.get_args(hint)):
            if dataclasses.is_dataclass(part):
                found |= keys(part)
    return found


def test_every_scenario_key_is_documented():
    page = (ROOT / "docs/scenarios.md").read_text(encoding="utf-8")
    missing = [
        key
        for key in sorted(keys(scenario.Tables))
        if f"`{key}`" not in page and f"`[{key}]`" not in page and f"`[[{key}]]`" not in page
    ]
    assert missing == []
