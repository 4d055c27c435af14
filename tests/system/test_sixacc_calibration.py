"""[calibration]: from the codes of a board in a fixture to the numbers of Hung, Fang, Wang and Lee's table 7."""

import math
import os

import numpy as np
import pytest
from libins.errors import UsageError

from libins import cli, fixture, machine, motions, run, scenario

SEEDS = 50 if os.environ.get("INS_BENCH") == "1" else 2
SIGMAS = 4.5
LSB = 2 * 4.0 * 9.80665 / 4096
MEAN = LSB * math.sqrt(0.5**2 + 1 / 12) / math.sqrt(2000)
"""Standard deviation of the mean of a rest's codes, noise and rounding [m/s^2]."""


def result(settings=None, seed=1, stop_s=None):
    loaded = scenario.load(scenario.find("s2_table7"), None, settings or {})
    return run.execute(loaded, run.Options(seed=seed, stop_s=stop_s))


@pytest.mark.parametrize("seed", range(1, SEEDS + 1))
def test_table_7_comes_out_of_the_codes(seed):
    done = result(seed=seed)
    assert done.summary["failed"] == [] and done.exit_code == 0, f"seed {seed}"
    assert len(done.checks) == 25
    found = done.summary["calibration"]
    # Of 12 readings 4 numbers are made: a bias is their mean, an axis is 4 of them against g = 9.8 m/s^2 at length SF.
    for j, sf in zip("123456", (0.5, 2.5, 0.5, 2.5, 2.5, 2.5), strict=True):
        assert found["bias_error_m_s2"][j] < SIGMAS * MEAN / math.sqrt(12), f"accelerometer {j}, seed {seed}"
        assert found["axis_error"][j] < SIGMAS * MEAN * math.sqrt(3) / (2 * 9.8 * sf), f"accelerometer {j}, seed {seed}"
        assert 0.3 * MEAN < found["residual_rms_m_s2"][j] < 1.8 * MEAN, f"accelerometer {j}, seed {seed}"


@pytest.mark.parametrize(
    ("settings", "value"),
    [
        ({"sixacc.scale_error": [-0.5, 1.501, -0.5, 1.5, 1.5, 1.5]}, "calibration.paper.sf.2"),
        ({"sixacc.bias_m_s2": [0.0049, 0.0245, 0.0049, 0.0245, 0.0255, 0.0245]}, "calibration.paper.bias_g.5"),
        ({"sixacc.misalignment_rad": [[0, 0]] * 3 + [[0, 3e-4]] + [[0, 0]] * 2}, "calibration.paper.angle_deg.alpha_y"),
    ],
)
def test_another_imu_is_not_table_7(settings, value):
    failed = result(settings).summary["failed"]
    assert failed and any(line.startswith(value) for line in failed), failed


def test_a_fixture_rests_and_turns_smoothly():
    loaded = scenario.load(scenario.find("s2_table7"))
    motion = motions.motion_of(loaded)
    rests = fixture.rests(loaded.tables.motion)
    assert len(rests) == 12 and rests[-1] == (236.5, 257.0)
    for (begin, end), up in zip(rests, loaded.tables.motion.up_b, strict=True):
        for t in (begin + 0.5, (begin + end) / 2, end):
            w, x, y, z = motion.attitude(t)
            up_b = -np.array([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)])
            assert up_b == pytest.approx(np.array(up) / np.linalg.norm(up), abs=1e-6)
    turning = [motion.attitude(20.5 + 0.01 * k) for k in range(101)]
    steps = [2 * math.acos(min(1.0, abs(np.dot(p, q)))) for p, q in zip(turning, turning[1:], strict=False)]
    assert max(steps) < 0.1 and steps[0] < 1e-4 and steps[-1] < 1e-4


@pytest.mark.parametrize(
    ("settings", "problem"),
    [
        ({"motion.up_b": [[0, 0, 1]]}, r"motion.up_b: entry 0 must be \[-0.707107, 0.0, 0.707107\]"),
        ({"motion.up_b": [[0, 1]]}, "found .0.0, 1.0., but 3 numbers, not all 0, are needed"),
        ({"motion.up_b": []}, "up_b: is missing"),
        ({"motion.kind": "still"}, 'needs a .sixacc. table and motion.kind = "fixture"'),
        ({"calibration.settle_s": 30.0}, "which is all of motion.rest_s"),
    ],
)
def test_refuses(settings, problem):
    with pytest.raises(UsageError, match=problem):
        machine.build(scenario.load(scenario.find("s2_table7"), None, settings), 1, outside=True, trace=False)


def test_a_run_that_ends_too_early_is_refused():
    with pytest.raises(UsageError, match="no scan lies in the rest from 21.5 to 42 s; stop_s must reach 257"):
        result(stop_s=21.0)


def test_the_command_says_what_it_found(capsys):
    assert cli.main(["run", "s2_table7"]) == 0
    out = capsys.readouterr().out
    assert "#2        SF 2.49" in out and "angles    beta_xy 0.59" in out and "verdict   pass" in out
