"""The examples of docs/python.md run, are short, and name what there is."""

import re

import pytest
from reference import ROOT

from libins import core, coref

EXAMPLES = re.findall(r"```python\n(.*?)```", (ROOT / "docs/python.md").read_text(encoding="utf-8"), re.DOTALL)
LINES = 12


def test_there_are_examples():
    assert len(EXAMPLES) >= 5
    assert [e for e in EXAMPLES if len(e.splitlines()) > LINES] == []


@pytest.mark.parametrize("number", range(len(EXAMPLES)))
def test_example(number: int):
    exec(compile(EXAMPLES[number], f"docs/python.md, example {number}", "exec"), {})


def test_every_name_in_the_text_exists():
    text = (ROOT / "docs/python.md").read_text(encoding="utf-8")
    names = set(re.findall(r"\bcore(?:f)?\.([A-Za-z_]\w*)", text)) - {"pyi"}
    assert len(names) > 10
    assert [n for n in sorted(names) if not (hasattr(core, n) and hasattr(coref, n))] == []
