"""The thesis's whole system over a net: the GIMU in a car, the firmware in its process, a PC that takes blocks."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from libins import _run

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "build/release/firmware/thesis.f2812"
PS_PER_S = 10**12
BAUD = 19200.0
STOP_S = 85
NOISE_S = 34
CALIBRATED_S = 30.0
SPEED = (10.0, 35.0, 10.0, math.inf, 10.0)
"""Speed, start, seconds to it, cruise, brake."""
EASTING_M, NORTHING_M = 250000.0, 2743625.50
"""TWD97 TM2 of 24.8 N 121 E, by ins_tm_forward() in double."""
TOL_POSITION_M = 2.0
TOL_HEADING_RAD = 0.03
SETTLED_S = 20.0
"""After the start: the first course has been seen and taken."""


def solutions(stop_s: int, **line: Any) -> tuple[Any, list[dict[str, float]], dict[str, int], list[Any]]:
    net = _run.Net(1)
    site = _run.Site(math.radians(24.8), math.radians(121.0), 60.0)
    track = _run.track_circle(site, 0.0, 100.0, SPEED)
    net.gimu("gimu", _run.gimu_thesis(), track, _run.gps_ideal())
    assert PROGRAM.exists(), f"{PROGRAM} is missing: cmake --build --preset release --target firmware_thesis"
    net.f2812("dsp", str(PROGRAM))
    net.host_nav("pc", BAUD)
    net.line("gimu.T", "dsp.SCIA", BAUD)
    net.line("dsp.SCIB", "pc", BAUD, **line)
    assert net.until(stop_s * PS_PER_S)
    rows, _ = net.take_solutions("pc")
    found = [dict(zip(_run.SOLUTION_COLUMNS, row, strict=True)) for row in rows.tolist()]
    return track, found, net.host_counters("pc"), net.reports("dsp")


def test_a_car_on_a_circle_is_where_the_board_says() -> None:
    track, found, counters, reports = solutions(STOP_S)
    assert reports == []
    assert counters["lost"] == counters["corrupt"] == counters["timeouts"] == counters["stray"] == 0
    assert len(found) == STOP_S * 6
    first = next(s for s in found if s["zone"])
    assert CALIBRATED_S - 1 < first["at_s"] < CALIBRATED_S + 1
    off, turned = [], []
    for s in found:
        if s["at_s"] < SPEED[1] + SETTLED_S:
            continue
        truth = track.at(s["t_s"])
        north, east, _ = truth["p_n"]
        off.append(math.hypot(s["easting_m"] - EASTING_M - east, s["northing_m"] - NORTHING_M - north))
        w, x, y, z = truth["q_nb"]
        heading = math.atan2(2 * (x * y + w * z), w * w + x * x - y * y - z * z)
        turned.append(abs(math.remainder(s["heading_rad"] - heading, 2 * math.pi)))
    print(f"{len(off)} states: largest position error {max(off):.2f} m, largest heading error {max(turned):.3f} rad")
    assert max(off) < TOL_POSITION_M
    assert max(turned) < TOL_HEADING_RAD


def test_a_noisy_line_costs_time_and_no_truth() -> None:
    _, clean, _, _ = solutions(NOISE_S)
    _, noisy, counters, reports = solutions(NOISE_S, bit_error=2e-4)
    assert reports == []
    assert counters["corrupt"] + counters["timeouts"] + counters["duplicates"] > 0, "the line was noisy"
    names = [n for n in _run.SOLUTION_COLUMNS if n not in ("at_s", "index", "lost") and not n.endswith("_total")]
    want = {s["t_s"]: [s[n] for n in names] for s in clean}
    assert len(noisy) > 0.9 * len(clean)
    differ = [s for s in noisy if not np.array_equal([s[n] for n in names], want.get(s["t_s"]))]
    assert len(differ) <= counters["corrupt"] / 100, "a wrong block passes the sum once in 256 at most"


@pytest.mark.parametrize("name", ["thesis", "thesis_rest", "thesis_rest_raw", "thesis_turns"])
def test_the_experiments_are_scenarios_that_hold(name: str, summary: Any) -> None:
    result = summary(ROOT / f"emu/f2812_sci/scenarios/{name}.toml", "--strict")
    assert result["verdict"] == "pass"
    assert result["link"]["ok"] > 500
    assert result["reports"] == []
