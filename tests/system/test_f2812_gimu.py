"""The thesis's system in one run: sensor, firmware, blocks to the host; the tables of the sensor reach the part."""

import numpy as np
import pytest
from conftest import timeless

from libins import _run, score

SITE = """
[track]
latitude_deg = 24.8
longitude_deg = 121.0
height_m = 30.0
"""
THESIS = """schema = 1
board = "f2812"
firmware = "thesis.f2812"
stop_s = 4.0
{site}
[gimu]
preset = "{preset}"
{keys}
[sci.a]
to = "gimu"

[sci.b]
to = "host"
baud = 19200
mode = "nav"
"""
LATITUDE_M = 110_755.0
"""Of a degree of the meridian at latitude 24.8 (WGS-84)."""
LONGITUDE_M = 101_136.0
"""Of a degree of the parallel there."""


@pytest.fixture
def scenario_of(tmp_path):
    def make(preset: str = "ideal", keys: str = "", site: str = SITE):
        path = tmp_path / "thesis.toml"
        path.write_text(THESIS.format(preset=preset, keys=keys, site=site), encoding="utf-8")
        return path

    return make


def test_the_whole_chain_and_the_same_twice(summary, scenario_of):
    path = scenario_of()
    first, second = summary(path), summary(path)
    assert timeless(first) == timeless(second)
    assert first["gimus"]["gimu"] == {"packets": 24, "sentences": 8, "clipped": 0, "octets": 24 * 15 + 4 * 3}
    assert first["link"]["lost"] == 0 and first["link"]["ok"] == first["solution"]["seq"] >= 23
    assert first["link"] == first["hosts"]["scib"]["link"]
    assert first["reports"] == [] and first["hosts"]["scib"]["framing_errors"] == 0
    assert 0 < first["solution"]["at_s"] - first["solution"]["t_s"] < 0.1


def test_solutions_are_not_published_as_states(ins, scenario_of):
    done = ins("run", scenario_of(), "--dds", "--domain", 79)
    assert done.returncode == 2 and "ins-navd --input nav" in done.stderr, done.stderr


def test_what_a_host_outside_would_say_is_not_judged(summary, scenario_of, tmp_path):
    path = scenario_of()
    values = ("link.ok", "solution.seq", "hosts.scib.link.ok", "hosts.scib.octets_received")
    expects = "".join(f'[[expect]]\nvalue = "{value}"\nat_least = 1\n' for value in values)
    path.write_text(path.read_text(encoding="utf-8") + expects, encoding="utf-8")
    result = summary(path, "--serial", f"scib=file:{tmp_path / 'octets'}", "--speed", 10, "--stop-s", 1)
    assert result["not_judged"] == list(values[:3]) and result["link"] is None
    assert (tmp_path / "octets").stat().st_size == result["hosts"]["scib"]["octets_received"] > 0
    assert summary(path)["not_judged"] == []


def test_states_are_the_blocks(ins, scenario_of, tmp_path):
    out = tmp_path / "s.csv"
    done = ins("run", scenario_of(), "--states", out)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "received" in done.stdout
    header, *rows = out.read_text(encoding="ascii").splitlines()
    assert header.split(",") == list(_run.SOLUTION_COLUMNS)
    at = [float(row.split(",")[0]) for row in rows]
    assert np.diff(at) == pytest.approx(1 / 6, abs=0.02)


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ("vcc_v = 5.0", ("gimu.vcc_v", "5.0", "3.6")),
        ("sensitivity = [0, 1, 1, 1, 1, 1]", ("sensitivity",)),
        ("baud = 12.0", ("gimu.baud", "12.0", "50")),
    ],
)
def test_bad_sensors(ins, scenario_of, keys, words):
    done = ins("run", scenario_of(keys=keys))
    assert done.returncode == 2 and len(done.stderr.strip().splitlines()) == 1, done.stderr
    assert all(word in done.stderr for word in words), done.stderr


def test_every_key_of_the_tables_reaches_the_part(scenario_of):
    """Changed one by one, the samples, the cadence or the octets change."""
    from libins.net_machine import NetMachine

    from libins import scenario

    def octets(keys: str = "", tail: str = ""):
        path = scenario_of("ideal", keys, SITE + tail)
        loaded = scenario.load(path, settings={"sci.a.to": "gimu", "sci.b": {"to": "nmea"}})
        machine = NetMachine(loaded, 1)
        machine.until(3 * 10**12)
        samples = machine.net.take_samples("gimu").tolist()
        edges = machine.take_edges().tolist()
        machine.close()
        return samples, edges

    plain = octets()
    assert plain == octets()
    for keys in (
        "null_v = [1.3, 1.3, 1.3, 1.6, 1.6, 1.6]",
        "drift_v_s = [0.01, 0, 0, 0, 0, 0]",
        "scale_error = [0, 0, 0, 0, 0, 0.1]",
        "sensitivity = [0.2, 0.2, 0.2, 0.1, 0.1, 0.1]",
        "noise_density = [1e-3, 0, 0, 0, 0, 0]\nbandwidth_hz = [50, 50, 50, 50, 50, 50]",
        "vcc_v = 3.0",
        "power_up_s = 0.07",
        "clock_ppm = 100.0",
        "baud = 9600",
        "nmea_baud = 9600",
        "nmea_delay_s = 0.35",
        'order = "latitude"',
        "geoid_m = 20.0",
        "utc_s = 1000000000",
    ):
        assert octets(keys) != plain, keys
    for tail in (
        '[gps]\npreset = "single_frequency"\n',
        '[gps]\npreset = "none"\n',
        "[gps]\nlatency_s = 0.5\n",
        "[gps]\nwhite_m = [30, 30, 30]\n",
        "[gps]\nmarkov_m = [300, 300, 300]\n",
        "[gps]\nvelocity_m_s = [3, 3, 3]\n",
        "[gps]\nsats = 5\n",
        "[gps]\nhdop = 3.0\n",
        "[gps]\nfirst_fix_s = 2.5\n",
        "[gps]\noutages_s = [[1.0, 2.5]]\n",
        'gravity = "normal"\n',
        "[motion]\nkind = 'constant_rate'\nrate_rad_s = [0.1, 0.2, 0.3]\n",
        'kind = "circle"\nspeed_m_s = 20.0\naccelerate_s = 0.5\n',
        'kind = "line"\nheading_rad = 1.0\nclimb_rad = 0.2\naccelerate_s = 0.5\n',
        'kind = "eight"\nlength_m = 30.0\naccelerate_s = 0.5\n',
    ):
        assert octets(tail=tail) != plain, tail
    slow = "[gps]\nmarkov_m = [300, 300, 300]\n"
    assert octets(tail=slow + "markov_tau_s = 1.0\n") != octets(tail=slow)
    assert octets('no_fix = "zeros"', "[gps]\noutages_s = [[1.0, 9.0]]\n") != octets(
        tail="[gps]\noutages_s = [[1.0, 9.0]]\n"
    )


def test_distances_and_angles_of_a_score():
    """Against the tabulated length of a degree, and a rotation written out."""
    here = np.radians([24.8, 121.0])
    north = score.distance_m(here[0] + np.radians(0.01), here[1], [*here, 0.0])
    east = score.distance_m(here[0], here[1] + np.radians(0.01), [*here, 0.0])
    assert north == pytest.approx(LATITUDE_M / 100, rel=1e-3) and east == pytest.approx(LONGITUDE_M / 100, rel=1e-3)
    half = [0.5 * angle for angle in (0.3, -0.4, 2.0)]
    (cr, sr), (cp, sp), (cy, sy) = [(np.cos(h), np.sin(h)) for h in half]
    q = [
        cy * cp * cr + sy * sp * sr,
        cy * cp * sr - sy * sp * cr,
        cy * sp * cr + sy * cp * sr,
        sy * cp * cr - cy * sp * sr,
    ]
    assert score.euler(q) == pytest.approx((0.3, -0.4, 2.0), abs=1e-12)
    assert score.wrapped(3.5) == pytest.approx(3.5 - 2 * np.pi)
