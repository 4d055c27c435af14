"""Every header of the core has a page, every public function says what it does, no page has a dead link."""

import re
from pathlib import Path

import pytest
from test_examples import ROOT, headers, name, pages

DECLARATION = re.compile(r"^(?:[A-Z_]+_API (?!extern)|static inline )[^;{]*?(\w+)\(", re.MULTILINE)


def undocumented(text: str) -> list[str]:
    """Functions with neither a /// comment before them nor a ///< after them."""
    found = []
    for match in DECLARATION.finditer(text):
        before = text[: match.start()].rsplit("\n", 2)[-2]
        statement = text[match.start() :].split(";", 1)[1].split("\n", 1)[0]
        if not before.startswith("///") and "///<" not in statement:
            found.append(match[1])
    return found


@pytest.mark.parametrize("header", headers(), ids=name)
def test_every_function_says_what_it_does(header: Path) -> None:
    assert undocumented(header.read_text(encoding="utf-8")) == []


def test_a_function_without_a_comment_is_found() -> None:
    text = "/// Does.\nINS_API int a(int x,\n    int y);\nINS_API int b(void);\nINS_API void c(void); ///< Does.\n\n"
    assert undocumented(text) == ["b"]


@pytest.mark.parametrize("header", headers(), ids=name)
def test_a_param_has_one_name(header: Path) -> None:
    """Two with a comma between them cannot be shown on the site."""
    assert re.findall(r"\\param(?:\[[a-z,]+\])?\s+\w+,.*", header.read_text(encoding="utf-8")) == []


def test_every_header_of_the_core_has_a_page() -> None:
    modules = [page.read_text(encoding="utf-8") for page in (ROOT / "docs").glob("*.md")]
    core = [name(header) for header in headers() if name(header).startswith("ins/")]
    missing = [header for header in core if not any(f"`{header}`" in text for text in modules)]
    assert missing == [], "name each in backticks on the page that explains it"


def test_every_header_is_on_an_api_page() -> None:
    listed = [
        header
        for page in sorted((ROOT / "docs/api").glob("*.md"))
        for header in re.findall(
            r"^## (\S+)\n\n```\{doxygenfile\} \S+$", page.read_text(encoding="utf-8"), re.MULTILINE
        )
    ]
    assert sorted(listed) == sorted(name(header) for header in headers())


def test_every_link_of_a_page_leads_somewhere() -> None:
    dead = [
        f"{page.relative_to(ROOT)}: {target}"
        for page in pages()
        for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", page.read_text(encoding="utf-8"))
        if "://" not in target and not (page.parent / target).exists()
    ]
    assert dead == []


def test_every_page_is_listed_once() -> None:
    listed = re.findall(r"^([\w/]+)$", (ROOT / "docs/index.md").read_text(encoding="utf-8"), re.MULTILINE)
    present = [str(page.relative_to(ROOT / "docs").with_suffix("")) for page in pages() if page.parent != ROOT]
    assert sorted([*listed, "index"]) == sorted(present), "put the page in a toctree of docs/index.md"
