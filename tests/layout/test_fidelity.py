"""docs/fidelity.md and docs/f2812.md name tests, choices and switches that there are."""

import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs/fidelity.md").read_text(encoding="utf-8")
RULES, CHOICES = PAGE.split("## Choices")
F2812 = (ROOT / "docs/f2812.md").read_text(encoding="utf-8")
LEAST_RULES, LEAST_RULES_F2812 = 90, 60  # so that a page that is no longer read as tables is noticed


def rows(text: str) -> list[list[str]]:
    lines = [line for line in text.splitlines() if line.startswith("| ")]
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    return [row for row in cells if row[0] not in ("rule", "open", "switch")]


def check_tests(rules: list[list[str]], folder: str) -> None:
    """The last cell of each row names tests, all of which are in the folder."""
    tests = {
        ".".join(found)
        for path in sorted((ROOT / folder).rglob("*.cpp"))
        for found in re.findall(r"^TEST(?:_F)?\((\w+),\s*(\w+)\)", path.read_text(), re.M)
    }
    named = {row[0]: re.findall(r"`(\w+\.\w+)`", row[-1]) for row in rules}
    assert [rule for rule, found in named.items() if not found] == []
    assert [name for found in named.values() for name in found if name not in tests] == []


def test_every_rule_has_a_test_that_exists():
    rules = rows(RULES)
    assert len(rules) >= LEAST_RULES
    check_tests(rules, "tests/emu_8051")


def test_every_rule_of_the_f2812_has_a_test_that_exists():
    rules = rows(F2812)
    assert len(rules) >= LEAST_RULES_F2812
    check_tests(rules, "tests/emu_f2812")


def test_every_switch_of_the_f2812_is_on_its_page_with_its_values():
    source = (ROOT / "emu/f2812_sci/cpu/switches.c").read_text(encoding="utf-8")
    switches = re.findall(r'^    \{"(\w+)", offsetof\([^)]*\), \{([^}]*)\}\},$', source, re.M)
    assert len(switches) == source.count("offsetof(f2812_switches_t")
    page = {row[0].strip("`"): re.findall(r"`([^`]+)`", row[1]) for row in rows(F2812.split("## Switches")[1])}
    assert {name: re.findall(r'"([^"]+)"', values) for name, values in switches} == page


def test_every_planted_bug_of_the_f2812_still_fits():
    """bench/f2812/mutants.py shows that the tests find them."""
    table: dict[str, dict[str, str]] = {}
    for path in (ROOT / "bench/f2812").glob("mutants*.toml"):
        table |= tomllib.loads(path.read_text(encoding="utf-8"))
    assert len(table) >= 50
    room = ROOT / "emu/f2812_sci"
    texts = {file: (room / file).read_text(encoding="utf-8") for file in {row["file"] for row in table.values()}}
    assert [name for name, row in table.items() if texts[row["file"]].count(row["before"]) != 1] == []


def test_every_choice_is_named_in_the_sources():
    folders = ("emu/8051_tlc2543", "tests/emu_8051/cpu")
    paths = [path for folder in folders for path in (ROOT / folder).rglob("*.[ch]*") if path.is_file()]
    text = "\n".join(path.name + "\n" + path.read_text(encoding="utf-8") for path in paths)
    names = [name for row in rows(CHOICES.split("## Not modelled")[0]) for name in re.findall(r"`([\w.]+)`", row[2])]
    assert len(names) >= 10
    assert [name for name in names if not re.search(rf"\b{re.escape(name)}\b", text)] == []
