"""The whole path in virtual time: real firmware on the board, the link, the navigator, scored against the motion."""

import csv
import re
from pathlib import Path

import pytest
from conftest import timeless

AXES = ("roll", "pitch", "yaw")
S3_LIMIT_RAD = 1.5e-3
# glibc picks FMA variants of sin, cos, ... by CPU; a run must not notice.
NO_FMA = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2,-AVX2_Usable,-FMA_Usable"}


def test_default_scenario_passes(summary):
    s = summary("default")
    assert s["verdict"] == "pass"
    assert s["link"]["lost"] == s["link"]["corrupt_accepted"] == s["link"]["corrupt"] == 0
    assert s["samples"] == pytest.approx(24.0 / 0.02, abs=2)
    assert s["link"]["before_first"] + s["link"]["ok"] + s["link"]["in_flight"] == s["samples"]
    assert max(s["attitude"]["max_rad"].values()) < 3e-3
    # The exchange at 9600 Bd is ten octets of ten bits and the scan.
    assert 0.0104 < s["age_s"]["min"] <= s["age_s"]["max"] < 0.02
    for key in ("sim_s", "wall_s", "speed", "seed", "cpu", "dds"):
        assert key in s
    assert s["cpu"]["cycles"] == pytest.approx(24.0 * 921_600, abs=10)


def test_s3_paper_within_its_limit(summary):
    s = summary("s3_paper")
    worst = max(s["attitude"]["max_rad"].values())
    print(f"S3, T = 0.08 s: max error {worst:.3e} rad, {s['attitude']['max_rad']}")
    assert worst <= S3_LIMIT_RAD
    assert s["link"]["ok"] >= 298


def test_skew_compensation_is_worth_it(summary, scenario):
    """Without it, the three channels of a scan are taken as simultaneous."""
    on = summary("s3_paper")
    off = summary(scenario("s3_paper", ("start = ", "skew_s = [0.0, 0.0, 0.0]\nstart = "), *_without_skew()))
    worst_on, worst_off = (max(s["attitude"]["max_rad"].values()) for s in (on, off))
    print(f"skew compensation on {worst_on:.3e} rad, off {worst_off:.3e} rad")
    assert worst_off > 1.5 * worst_on


def _without_skew():
    text = (Path(__file__).resolve().parents[2] / "emu/8051_tlc2543/scenarios/s3_paper.toml").read_text(
        encoding="utf-8"
    )
    line = re.search(r"^skew_s = .*\n", text, re.MULTILINE)
    assert line, "s3_paper.toml compensates the skew"
    return [(line[0], "")]


def test_states_are_scored_at_their_own_instant(ins, tmp_path):
    out = tmp_path / "states.csv"
    assert ins("run", "s3_paper", "--states", out).returncode == 0
    with out.open(newline="") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        for axis in AXES:
            difference = float(row[f"{axis}_rad"]) - float(row[f"true_{axis}_rad"])
            assert difference == pytest.approx(float(row[f"error_{axis}_rad"]), abs=1e-12)
            assert abs(difference) <= S3_LIMIT_RAD
    periods = [float(b["t_s"]) - float(a["t_s"]) for a, b in zip(rows, rows[1:], strict=False)]
    assert sum(periods) / len(periods) == pytest.approx(0.08, abs=1e-7)


@pytest.mark.parametrize("name", ["default", "s3_paper"])
def test_same_seed_same_bytes(ins, tmp_path, summary, name):
    files = {}
    for run, env in (("a", None), ("b", None), ("no fma", NO_FMA)):
        paths = [tmp_path / f"{run}.{kind}" for kind in ("html", "csv", "trace")]
        s = summary(name, "--report", paths[0], "--states", paths[1], "--trace", paths[2], env=env)
        files[run] = (timeless(s), [path.read_bytes() for path in paths])
    assert files["a"] == files["b"] == files["no fma"]
    assert files["a"][1][2].count(b"\n") > 1000


NOISY = ('preset = "ideal"', 'preset = "ideal"\nnoise_rad_s_rthz = 2e-4')


def test_another_seed_is_another_run_with_noise(summary, scenario):
    path = scenario("default", NOISY)
    first, again, other = (summary(path, "--stop-s", 3, "--seed", seed) for seed in (1, 1, 2))
    assert timeless(first) == timeless(again)
    assert first["attitude"] != other["attitude"]


@pytest.mark.parametrize(
    ("motion", "limit"),
    [
        ('kind = "still"', 2e-3),
        ('kind = "constant_rate"\nrate_rad_s = [0.3, -0.2, 0.5]\nramp_s = 1.0', 5e-3),
        ('kind = "coning"\nhalf_angle_rad = 0.05\nfrequency_hz = 1.0\nramp_s = 2.0', 5e-3),
    ],
)
def test_named_motions(summary, scenario, motion, limit):
    text = (Path(__file__).resolve().parents[2] / "emu/8051_tlc2543/scenarios/default.toml").read_text(encoding="utf-8")
    table = text[text.index("[motion]") + len("[motion]\n") : text.index("[gyro]")]
    s = summary(scenario("default", (table, motion + "\n\n")), "--stop-s", 6, code=0)
    assert max(s["attitude"]["max_rad"].values()) < limit


def test_motion_from_csv(summary, scenario, tmp_path):
    import math

    rows = ["t_s,yaw_rad,pitch_rad,roll_rad"]
    for k in range(121):
        t = k / 20
        rows.append(f"{t},{0.4 * math.sin(t)!r},{0.2 * math.sin(1.3 * t)!r},{0.1 * math.cos(t)!r}")
    (tmp_path / "drive.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
    text = (Path(__file__).resolve().parents[2] / "emu/8051_tlc2543/scenarios/default.toml").read_text(encoding="utf-8")
    table = text[text.index("[motion]") + len("[motion]\n") : text.index("[gyro]")]
    path = scenario("default", (table, 'kind = "csv"\ncsv = "drive.csv"\n\n'))
    s = summary(path, "--stop-s", 5)
    assert max(s["attitude"]["max_rad"].values()) < 3e-3


def test_expectation_failed_is_exit_1(summary, scenario):
    tail = '\n[[expect]]\nvalue = "attitude.max_rad.yaw"\nat_most = 1e-9\n'
    s = summary(scenario("default", tail=tail), "--stop-s", 2, code=1)
    assert s["verdict"] == "fail"
    assert "attitude.max_rad.yaw" in s["failed"][0]


def test_time_ran_out_is_exit_42(summary, scenario):
    path = scenario("default", ("stop_s = 24.0", "stop_s = 1.0\nstop_samples = 100"))
    assert summary(path, code=42)["verdict"] == "fail"
    path = scenario("default", ("stop_s = 24.0", "stop_s = 3.0\nstop_samples = 100"))
    assert summary(path)["sim_s"] < 2.5


def test_guest_error_is_exit_3_under_strict(ins, tmp_path):
    """A firmware that runs into the reserved opcode A5."""
    image = tmp_path / "a5.ihx"
    image.write_text(":02000000A50059\n:00000001FF\n", encoding="ascii")
    done = ins("run", "default", "--firmware", image, "--stop-s", 0.1, "--strict")
    assert done.returncode == 3, done.stdout + done.stderr
    assert "guest_error" in done.stdout
    assert ins("run", "default", "--firmware", image, "--stop-s", 0.1).returncode == 1
