"""`ins sim`: files that belong together, errors that were asked for, events, refusals that name the place."""

import csv
import math

import numpy as np
import pytest
from libins.cli import main

from libins import _truth, sim

DRIVE = """
duration_s = 40.0
[track]
latitude_deg = 24.8
longitude_deg = 121.0
gravity = "normal"
rotating = true
[body]
heading_rad = 0.5
speed_m_s = 10.0
[[manoeuvre]]
name = "accelerate"
duration_s = 10.0
amount = 10.0
[[manoeuvre]]
name = "turn"
duration_s = 20.0
amount = 1.5
[[event]]
quantity = "speed_m_s"
value = 15.0
direction = "rising"
[imu]
rate_hz = 50.0
warm_up_k = 10.0
warm_up_tau_s = 20.0
[imu.gyro]
random_walk = [3e-5, 3e-5, 3e-5]
bias_per_k = [1e-5, 0.0, 0.0]
[imu.accel]
bias = [0.01, 0.02, -0.01]
[gps]
preset = "single_frequency"
period_s = 0.5
"""
EIGHT = """
duration_s = 20.0
[track]
kind = "eight"
speed_m_s = 8.0
[imu]
rate_hz = 20.0
"""


def read(path):
    rows = list(csv.reader(path.read_text(encoding="utf-8").splitlines()))
    return {
        name: np.array(column, dtype=float) for name, column in zip(rows[0], zip(*rows[1:], strict=True), strict=True)
    }


def simulated(tmp_path, text, *options):
    file = tmp_path / "sim.toml"
    file.write_text(text, encoding="utf-8")
    names = ("imu", "truth", "gps", "events")
    code = main(["sim", str(file), *[f"--{n}={tmp_path / n}.csv" for n in names], *options])
    assert code == 0
    return file, {name: tmp_path / f"{name}.csv" for name in names}


def test_the_files_of_a_drive_belong_together(tmp_path, capsys):
    _, files = simulated(tmp_path, DRIVE)
    imu, truth, gps, events = (read(files[name]) for name in ("imu", "truth", "gps", "events"))
    assert np.array_equal(imu["t_s"], truth["t_s"])
    assert len(imu["t_s"]) == 2000
    warm = 1e-4 * (1 - np.exp(-truth["t_s"] / 20.0))
    assert np.abs(truth["gyro_bias_x_rad_s"] - warm).max() < 1e-18
    white = imu["theta_x_rad"] - 0.02 * (0.5 * (truth["w_x_rad_s"] + np.roll(truth["w_x_rad_s"], 1)) + warm)
    assert white[1:].std() / (3e-5 * math.sqrt(0.02)) == pytest.approx(1.0, abs=0.1)
    assert truth["accel_bias_y_m_s2"].tolist() == [0.02] * 2000
    turned = np.unwrap(2 * np.arctan2(truth["q_z"], truth["q_w"]))[-1]
    assert turned == pytest.approx(2.0, abs=1e-4), "0.5 + 1.5, less the frame's own turn on the way"
    speed = np.sqrt(truth["v_north_m_s"] ** 2 + truth["v_east_m_s"] ** 2)
    assert speed[-1] == pytest.approx(20.0, abs=1e-3)
    assert len(gps["t_s"]) == 81
    at = np.searchsorted(truth["t_s"], gps["t_s"][1:] - 1e-9)
    north_m = (gps["latitude_rad"][1:] - truth["latitude_rad"][at]) * 6.35e6
    assert 1.0 < north_m.std() + abs(north_m.mean()) < 10.0
    assert events["event"].tolist() == [0.0]
    assert events["t_s"][0] == pytest.approx(5.0, abs=1e-9), "half of the acceleration by symmetry"
    assert "2000 IMU samples, 81 fixes, 1 events" in capsys.readouterr().err


def test_the_same_seed_gives_the_same_bytes_and_another_does_not(tmp_path):
    seeds = ("--seed=3", "--seed=3", "--seed=4")
    octets = [simulated(tmp_path, DRIVE, seed)[1]["imu"].read_bytes() for seed in seeds]
    assert octets[0] == octets[1] != octets[2]


def test_a_track_needs_no_body_and_an_event_ends_one(tmp_path):
    _, files = simulated(tmp_path, EIGHT)
    truth = read(files["truth"])
    again = sim.Sim(tmp_path / "sim.toml", {})
    assert np.array_equal(again.track.at(truth["t_s"].copy())["p_n"][:, 1], truth["east_m"])
    _, files = simulated(tmp_path, DRIVE, "--set=event.0.stops=true")
    assert read(files["imu"])["t_s"][-1] == pytest.approx(5.0, abs=0.021)


def test_rates_written_by_one_lead_another_along(tmp_path):
    _, files = simulated(tmp_path, DRIVE.replace("rate_hz = 50.0", "rate_hz = 100.0"))
    truth = read(files["truth"])
    table = np.column_stack([truth[name] for name in sim.DRIVE_COLUMNS])
    np.savetxt(
        tmp_path / "rates.csv", table, delimiter=",", header=",".join(sim.DRIVE_COLUMNS), comments="", fmt="%.17g"
    )
    # The rows begin at 0.01 s, where the body still goes straight on: the same drive but for 0.1 m.
    body = DRIVE.split("[[manoeuvre]]")[0].replace("40.0", "39.98") + 'csv = "shifted.csv"\n'
    table[:, 0] -= 0.01
    np.savetxt(
        tmp_path / "shifted.csv", table, delimiter=",", header=",".join(sim.DRIVE_COLUMNS), comments="", fmt="%.17g"
    )
    _, again = simulated(tmp_path, body)
    end = read(again["truth"])
    assert math.hypot(end["north_m"][-1] - truth["north_m"][-2], end["east_m"][-1] - truth["east_m"][-2]) < 0.15


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("amount = 1.5", "amount = 1.5\nspeed = 1", "sim.toml:19: manoeuvre.1.speed: unknown key; keys here: name"),
        ('name = "turn"', 'name = "trun"', "sim.toml:16: manoeuvre.1.name: found 'trun', but one of"),
        ("random_walk = [3e-5, 3e-5, 3e-5]", "random_walk = [3e-5]", "random_walk: 1 numbers, give 3"),
        (
            "random_walk = [3e-5, 3e-5, 3e-5]",
            "random_walk = [-1.0, 0.0, 0.0]",
            "gyro: random_walk[0] is -1, give 0 to 1000",
        ),
        ("[body]", '[body]\ncsv = "no.csv"', "needs either csv or [[manoeuvre]] tables, and not both"),
        ("rate_hz = 50.0", "rate_hz = 0.0", "imu.rate_hz: found 0.0, but it must lie in 0.01 .. 100000.0"),
    ],
)
def test_a_refusal_names_the_place(tmp_path, capsys, old, new, said):
    file = tmp_path / "sim.toml"
    file.write_text(DRIVE.replace(old, new), encoding="utf-8")
    assert main(["sim", str(file), f"--imu={tmp_path / 'imu.csv'}"]) == 2
    assert said in capsys.readouterr().err
    assert not list(tmp_path.glob("imu.csv*"))


def test_nothing_to_write_is_refused(tmp_path, capsys):
    assert main(["sim", "sim.toml"]) == 2
    assert "give one of --imu, --truth, --gps, --events" in capsys.readouterr().err


def test_without_sundials_a_body_says_what_is_missing(tmp_path, capsys, monkeypatch):
    def missing(*_):
        raise RuntimeError(
            "this build has no SUNDIALS, which integrates bodies: install libsundials-dev and build again"
        )

    monkeypatch.setattr(_truth, "track_body", missing)
    file = tmp_path / "sim.toml"
    file.write_text(DRIVE, encoding="utf-8")
    assert main(["sim", str(file), f"--imu={tmp_path / 'imu.csv'}"]) == 2
    assert "install libsundials-dev" in capsys.readouterr().err
