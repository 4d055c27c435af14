"""Six accelerometers from end to end: errors grow as the covariance of noise, quantisation and bias says."""

import math
import os

import numpy as np
import pytest
from libins.errors import UsageError
from libins.gyro_free import PLACE

from libins import run, scenario

FULL = bool(os.environ.get("INS_BENCH"))
RUNS = 50 if FULL else 6
FACTOR = 1.5
"""Between the errors of the runs and what their covariances say."""
GROUPS = {"attitude": ("phi_n_rad", "phi_e_rad", "phi_d_rad"), "position": ("p_n_m", "p_e_m", "p_d_m")}
AT_REST = {"gyro_free.still_s": 5.0}
ON_AN_EIGHT = {"gyro_free.still_s": 5.0, "track.start_s": 5.0}


def executed(name, settings, stop_s, seed=1):
    loaded = scenario.load(scenario.find(name), None, settings)
    return run.execute(loaded, run.Options(seed=seed, stop_s=stop_s))


def values(states, what, names):
    return states[:, [PLACE[f"{what}_{name}"] for name in names]]


@pytest.mark.parametrize(
    ("name", "settings", "instants_s"),
    [
        ("sixacc", AT_REST, (6.0, 8.0, 12.0)),
        ("sixacc_eight", {**ON_AN_EIGHT, "gps.preset": "none"}, (6.0, 8.0, 12.0)),
        ("sixacc_eight", ON_AN_EIGHT, (8.0, 12.0, 16.0) + ((30.0, 60.0) if FULL else ())),
    ],
    ids=["unaided_at_rest", "unaided_on_an_eight", "aided_on_an_eight"],
)
def test_errors_grow_as_their_covariance_says(name, settings, instants_s):
    errors = {group: [] for group in GROUPS}
    sigmas = {group: [] for group in GROUPS}
    for seed in range(1, RUNS + 1):
        states = executed(name, settings, instants_s[-1] + 0.1, seed).states
        rows = states[np.searchsorted(states[:, PLACE["t_s"]], instants_s)]
        for group, names in GROUPS.items():
            errors[group].append(values(rows, "error", names))
            sigmas[group].append(values(rows, "sigma", names))
    for group in GROUPS:
        error, sigma = np.array(errors[group]), np.array(sigmas[group])
        for k, t_s in enumerate(instants_s):
            ratio = math.sqrt(np.mean((error[:, k] / sigma[:, k]) ** 2))
            spread = math.sqrt(np.mean(error[:, k] ** 2))
            said = math.sqrt(np.mean(sigma[:, k] ** 2))
            figures = f"rms {spread:.4g}, sigma {said:.4g}, ratio {ratio:.2f}"
            print(f"{group} at {t_s:g} s, {RUNS} runs, seeds from 1: {figures}")
            assert 1 / FACTOR < ratio < FACTOR
    grown = np.sqrt(np.mean(np.square(errors["attitude"]), axis=(0, 2)))
    assert "gps.preset" in settings or name == "sixacc_eight" or grown[-1] > 5 * grown[0], "unaided, it grows"


def test_lost_samples_are_bridged_and_the_filter_holds():
    cut = {**ON_AN_EIGHT, "link.cuts_s": [[9.0, 9.1]], "link.bit_error": 1e-4, "expect": []}
    result = executed("sixacc_eight", cut, 15.0)
    assert result.summary["link"]["lost"] >= 8
    states = result.states
    assert states[:, PLACE["bridged"]].max() >= 8
    last = slice(-1, None)
    for names in GROUPS.values():
        assert (abs(values(states[last], "error", names)) < 5 * values(states[last], "sigma", names)).all()


def test_a_fix_far_off_is_refused_and_survived():
    gated = {**ON_AN_EIGHT, "gyro_free.gate": 16.0, "gyro_free.gps_m": [0.02, 0.02, 0.02]}
    summary = executed("sixacc_eight", gated, 12.0).summary
    assert summary["gyro_free"]["refused"] > 10, "fixes of 1 m, taken for 0.02 m"
    held = executed("sixacc_eight", {**ON_AN_EIGHT, "gyro_free.gate": 16.0}, 12.0).summary
    assert held["gyro_free"]["refused"] <= 2
    assert held["gyro_free"]["fixes"] >= 55


def test_the_same_seed_gives_the_same_bits():
    once, again = (executed("sixacc_eight", ON_AN_EIGHT, 8.0).states.tobytes() for _ in range(2))
    assert once == again


@pytest.mark.parametrize(
    ("settings", "problem"),
    [
        ({"nav.skew_s": [0.0, 0.0, 0.0]}, "6 delays, one a channel"),
        ({"nav.block_len": 6}, "6 channels need two octets each"),
        ({"gyro_free.attitude_rad": [0.1]}, "3 numbers"),
        ({"gps.white_m": [1.0]}, "3 numbers"),
        ({"sixacc.axis": [[1.0, 0.0, 0.0]] * 6}, "do not see all of a motion"),
    ],
)
def test_refuses(settings, problem):
    with pytest.raises(UsageError, match=problem):
        executed("sixacc_eight", settings, 0.1)
