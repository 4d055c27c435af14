"""The documentation names what there is."""

import dataclasses
import re
import subprocess
import typing
from pathlib import Path

import pytest

from libins import cli, net_tables, scenario

ROOT = Path(__file__).resolve().parents[2]


def keys(schema: type) -> set[str]:
    found = set()
    for name, hint in typing.get_type_hints(schema).items():
        found.add(name)
        for part in (hint, *typing.get_args(hint)):
            if dataclasses.is_dataclass(part):
                found |= keys(part)
    return found


@pytest.mark.parametrize("schema", [scenario.Tables, net_tables.Single, net_tables.Many])
def test_every_scenario_key_is_documented(schema):
    pages = ["scenarios.md", "faults.md", *([] if schema is scenario.Tables else ["f2812_scenarios.md"])]
    page = "".join((ROOT / "docs" / name).read_text(encoding="utf-8") for name in pages)
    missing = [
        key
        for key in sorted(keys(schema))
        if f"`{key}`" not in page and f"`[{key}]`" not in page and f"`[[{key}]]`" not in page
    ]
    assert missing == []


def test_the_commands_of_the_readme_exist(tmp_path):
    """Every `ins ...` line is taken by the command's own parser; those of `ins nav` and `ins gpsdr` by the daemons'."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    block = "\n".join(re.findall(r"```sh\n(.*?)```", text, re.DOTALL))
    lines = [line.split("#")[0].strip().rstrip("&").split() for line in block.splitlines()]
    commands = [line[1:] for line in lines if line[:1] == ["ins"]]
    assert len(commands) >= 5
    daemons = {"nav": "ins-navd", "gpsdr": "ins-gpsdr"}
    for command in commands:
        if command[0] in daemons:
            program = ROOT / "build/release/python/libins/bin" / daemons[command[0]]
            known = subprocess.run([program, "--help"], capture_output=True, text=True)
            assert all(option.split("=")[0] in known.stdout for option in command if option.startswith("--"))
        else:
            cli.parser().parse_args(command)
