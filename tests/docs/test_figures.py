"""Figures and tables of docs are what the library does today, and agree with what was found without it."""

import os
import sys

import pytest
from test_examples import ROOT

sys.path.insert(0, str(ROOT / "bench/figures"))
import make  # noqa: E402

# Drift on a cone [deg/h]: closed forms in 40-digit arithmetic.
CONING = {
    "ONE": ("1.30e-1", "9.36", "74.1", "1849"),
    "BLOCK2": ("1.03e-4", ".128", "3.99", "99.3"),
    "BLOCK3_FIT": ("7.67e-5", ".0925", "2.59", "62.4"),
    "BLOCK3_OPT": ("7.7e-8", "1.89e-3", ".233", "7.8"),
    "BLOCK4_FIT": ("2.5e-7", "5.2e-3", ".61", "4.7"),
    "BLOCK4_OPT": ("7.5e-8", "2.8e-4", ".032", "12.0"),
    "HIST1": ("1.03e-4", ".128", "3.99"),
    "HIST2_FIT": ("1.62e-4", ".197", "5.72", "143"),
    "HIST2_OPT": ("8.5e-8", "1.87e-3", ".229", "5.7"),
    "HIST3_OPT": ("1.2e-9", "2.7e-5", ".0136", ".31"),
    "misread": ("3.37", "237", "1727", "43050"),
}
# Largest attitude error [rad] of motions A, B, D at 80 ms: an independent implementation in double.
MOTION = {
    "one": ("1.3e-3", "3.4e-3", ".56"),
    "three_poly": ("1.2e-5", "1.5e-4", "5.0e-2"),
    "three_opt": ("1.0e-5", "1.4e-4", "3.8e-2"),
    "reuse_fit": ("1.2e-5", "1.6e-4", "5.0e-2"),
    "thesis": ("1.7e-5", "1.2e-4", "2.7e-2"),
    "hist2_poly": ("4.8e-6", "2.2e-5", "4.1e-2"),
    "hist2_opt": ("9.8e-6", "6.9e-5", "9.6e-3"),
    "two": ("1.5e-6", "2.4e-5", "2.0e-2"),
    "fiter_block3": ("2.2e-6", "1.1e-5", "1.8e-2"),
    "fhist3": ("3.6e-7", "4.4e-6", "8.6e-3"),
    "fhist4": ("4.8e-8", "8.3e-7", "7.1e-3"),
    "rectangle": (".069", ".12", ".39"),
    "AM2": ("1.6e-3", "4.0e-3", ".56"),
    "AM3": ("9.5e-5", "3.0e-4", ".035"),
    "AM4": ("1.7e-5", "6.8e-5", ".044"),
    "rk4_2T": ("4.4e-6", "2.6e-5", "2.6e-2"),
    "rk4_T": ("2.8e-7", "1.6e-6", "1.8e-3"),
    "rate4": ("1.0e-5", "3.7e-5", ".040"),
    "rate5": ("1.1e-6", "8.1e-6", ".0094"),
}


def unit(text: str) -> float:
    """What one in the last digit is worth."""
    mantissa, _, exponent = text.partition("e")
    decimals = len(mantissa.partition(".")[2])
    return 10.0 ** (int(exponent or 0) - decimals)


@pytest.fixture(scope="module")
def points() -> make.Points:
    return make.run(ROOT / "build/release", few="INS_BENCH" not in os.environ)


def test_what_is_committed_is_what_the_library_does(points: make.Points) -> None:
    assert make.differences(points, make.read_points()) == [], "if it is meant: ./dev docs figures"


def test_figures_and_tables_are_made_from_the_points() -> None:
    assert make.stale() == [], "if it is meant: ./dev docs figures"


@pytest.mark.parametrize(("figure", "expected"), [("table_coning", CONING), ("table_motion", MOTION)])
def test_the_tables_agree_with_independent_figures(
    figure: str, expected: dict[str, tuple[str, ...]], points: make.Points
) -> None:
    wrong = [
        f"{row}, column {x:g}: {points[figure][row][x]:g}, independent {text}"
        for row, texts in expected.items()
        for x, text in enumerate(texts)
        if abs(points[figure][row][x] - float(text)) > unit(text)
    ]
    assert wrong == []


def test_every_figure_is_on_a_page() -> None:
    text = "".join(page.read_text(encoding="utf-8") for page in (ROOT / "docs").glob("*.md"))
    drawn = {path.name for path in make.FIGURES.glob("*.svg")}
    assert drawn == {f"{name}.svg" for name in make.SPECS}
    assert [name for name in sorted(drawn) if f"(figures/{name})" not in text] == []


def test_a_changed_point_is_found() -> None:
    was = make.read_points()
    changed = make.read_points()
    changed["coning_step"]["HIST2_OPT"][0.08] *= 1.1
    del changed["rates_step"]["order 3"]
    changed["rotvec"]["double"] = {x: 100 * y for x, y in was["rotvec"]["double"].items()}
    found = make.differences(changed, was)
    assert [line.split(":")[0] for line in found] == [
        "coning_step, HIST2_OPT at 0.08",
        "rates_step, order 3",
        "rotvec, double",
    ]
