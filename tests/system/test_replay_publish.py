"""What `ins replay --dds` publishes: states with covariance, innovations, status, raw samples; QoS, decimation."""

import json
import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from libins import _dds, _post, replay, replay_config

pytestmark = pytest.mark.wall_clock

WALK = Path(__file__).resolve().parents[1] / "data/walk_0827"
DOMAIN = 100 + (os.getpid() + 25) % 100
LIMIT_S = 120
SPEED = 20
KINDS = ("status", "innovations", "raw_imu", "state_decimated")
DECIMATE = 4
CHECK = {name: n for n, name in enumerate(_post.CHECK_COLUMNS)}


@pytest.fixture(scope="module")
def heard() -> dict[str, list[dict]]:
    """Everything, by kind: one subscriber from before the replay begins until its publisher has gone."""
    command = [sys.executable, "-m", "libins", "replay", str(WALK / "walk.toml"), "--dds", "--domain", str(DOMAIN)]
    options = ["--ros", "/walk", "--speed", str(SPEED), "--decimate", str(DECIMATE), "--qos", "nav_state=reliable"]
    qos = [f"{topic}=reliable" for topic in ("nav_state", "innovations", "raw_imu", "nav_state_decimated")]
    reader = _dds.Handle(DOMAIN, _dds.TOPICS["state"], None, publishes=False, also=list(KINDS), qos=qos)
    found: dict[str, list[dict]] = {kind: [] for kind in ("state", *KINDS)}
    process = subprocess.Popen([*command, *options], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    end = time.monotonic() + LIMIT_S
    try:
        gone = 0
        while gone < len(found) and time.monotonic() < end:
            for sample in reader.take(0.1):
                gone += sample["gone"] and "json" not in sample
                if "json" in sample:
                    found[sample["kind"]].append(json.loads(sample["json"]))
        assert process.wait(timeout=20) == 0, process.stderr and process.stderr.read()
    finally:
        process.kill()
        reader.close()
    return found


def test_states_have_place_velocity_covariance_and_the_clock_of_the_receiver(heard):
    states = heard["state"]
    assert len(states) > 100
    indices = [state["index"] for state in states]
    assert indices == list(range(indices[0], indices[-1] + 1)), "reliable: none is missing after the first"
    navigation = [state["navigation"] for state in states]
    assert all(n["time_base"] == "gnss" for n in navigation)
    assert set(navigation[0]["valid"]) >= {"attitude", "rate", "force", "velocity", "position", "height", "covariance"}
    steps = np.diff([n["time_ns"] for n in navigation]) * 1e-9
    assert steps == pytest.approx(np.diff([state["t_s"] for state in states]), abs=1e-6)
    assert np.rad2deg(navigation[-1]["llh"][0]) == pytest.approx(40.0967, abs=1e-3)
    for n in navigation[:: len(navigation) // 10]:
        p = np.zeros((9, 9))
        p[np.triu_indices(9)] = n["P"]
        assert (np.linalg.eigvalsh(p, UPLO="U") > 0).all(), "a covariance is positive definite"
        assert np.linalg.norm(n["f_b"]) == pytest.approx(9.8, abs=8.0)


def test_one_state_in_four_is_on_the_decimated_topic_too(heard):
    slow = [state["index"] for state in heard["state_decimated"]]
    assert len(slow) > 20
    assert set(np.diff(slow)) == {DECIMATE}


def test_innovations_stand_beside_their_deviations_and_say_what_became_of_them(heard):
    found = heard["innovations"]
    verdicts = {kind: {i["verdict"] for i in found if i["kind"] == kind} for kind in ("position", "velocity")}
    assert {"used", "withheld"} <= verdicts["position"]
    used = [i for i in found if i["verdict"] == "used" and i["kind"] == "position"]
    assert len(used) > 20
    ratios = np.abs([np.array(i["innovation"]) / i["sigma"] for i in used])
    assert 0.2 < float(np.median(ratios)) < 2.0, "some 0.67 where the filter knows how good it is"
    assert all(i["nis"] >= 0 for i in used)
    assert all(i["nis"] is None for i in found if i["verdict"] == "withheld")


def test_a_status_each_second_says_how_sure_the_filter_is(heard):
    found = heard["status"]
    assert len(found) > 10
    modes = {status["mode"] for status in found}
    assert modes == {"aided", "dead_reckoning"}, "fixes are withheld for 10 s each 30 s"
    worst = {mode: max(s["sigma_horizontal_m"] for s in found if s["mode"] == mode) for mode in modes}
    assert worst["dead_reckoning"] > worst["aided"]
    ages = [status["fix_age_s"] for status in found if status["mode"] == "dead_reckoning"]
    assert all(age is None or age > 2.0 for age in ages), "None: before the first"
    assert found[-1]["fixes"] > found[0]["fixes"]


def test_raw_samples_are_those_of_the_file(heard):
    config = replay_config.load(WALK / "walk.toml", {})
    imu = replay.read(config, WALK).imu
    found = heard["raw_imu"]
    assert len(found) > 1000
    for sample in found[:: len(found) // 20]:
        assert sample["gyro_b"] == imu.rate[sample["index"]].tolist()
        assert sample["accel_b"] == imu.force[sample["index"]].tolist()
        assert sample["temperature_k"] is None
    assert np.diff([sample["index"] for sample in found]).min() == 1


@pytest.mark.parametrize("lever_arm_m", [[0.0, 0.0, 0.0], [4.0, -3.0, 2.0]])
def test_the_first_components_nis_is_that_of_its_deviation(lever_arm_m):
    """The filter's own, of north before east and down are used, which is where both must agree; its P is at most a few
    samples older there."""
    config = replay_config.load(WALK / "walk.toml", {"gnss.lever_arm_m": lever_arm_m})
    drive = replay.read(config, WALK)
    checks = replay.solve(config, drive, lambda _: None).runs[0].checks
    used = checks[(checks[:, CHECK["withheld"]] == 0) & (checks[:, CHECK["refused"]] == 0)]
    wanted = used[:, CHECK["nis_n"]]
    got = (used[:, CHECK["dp_n_before"]] / used[:, CHECK["sigma_n"]]) ** 2
    kept = np.isfinite(wanted) & (wanted > 1e-3)
    assert kept.sum() > 50
    assert float(np.median(np.abs(got[kept] / wanted[kept] - 1.0))) < 5e-3


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--qos", "nav_state=fast"), ("'fast' is no QoS profile", "sensor_data")),
        (("--qos", "imu=default"), ("'imu=default'", "raw_imu")),
        (("--decimate", "-1"), ("--decimate -1",)),
    ],
)
def test_a_wrong_choice_is_refused(ins, options, words):
    done = ins("run", "default", "--stop-s", 0.1, "--dds", "--domain", DOMAIN, *options)
    assert done.returncode == 2
    assert all(word in done.stderr for word in words), done.stderr
