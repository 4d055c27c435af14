"""docs/fidelity.md names tests and choices that there are."""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs/fidelity.md").read_text(encoding="utf-8")
RULES, CHOICES = PAGE.split("## Choices")
LEAST_RULES = 90  # so that a page that is no longer read as tables is noticed


def rows(text: str) -> list[list[str]]:
    lines = [line for line in text.splitlines() if line.startswith("| ")]
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    return [row for row in cells if row[0] not in ("rule", "open")]


def test_every_rule_has_a_test_that_exists():
    sources = sorted((ROOT / "tests/emu_8051").glob("*/*.cpp"))
    tests = {
        ".".join(found)
        for path in sources
        for found in re.findall(r"^TEST(?:_F)?\((\w+),\s*(\w+)\)", path.read_text(), re.M)
    }
    rules = rows(RULES)
    assert len(rules) >= LEAST_RULES
    named = {row[0]: re.findall(r"`(\w+\.\w+)`", row[2]) for row in rules}
    assert [rule for rule, found in named.items() if not found] == []
    assert [name for found in named.values() for name in found if name not in tests] == []


def test_every_choice_is_named_in_the_sources():
    folders = ("emu/8051_tlc2543", "tests/emu_8051/cpu")
    paths = [path for folder in folders for path in (ROOT / folder).rglob("*.[ch]*") if path.is_file()]
    text = "\n".join(path.name + "\n" + path.read_text(encoding="utf-8") for path in paths)
    names = [name for row in rows(CHOICES.split("## Not modelled")[0]) for name in re.findall(r"`([\w.]+)`", row[2])]
    assert len(names) >= 10
    assert [name for name in names if not re.search(rf"\b{re.escape(name)}\b", text)] == []
