"""[sixacc]: the codes that the firmware of six accelerometers scans are the motion's, each at its own instant."""

import math

import numpy as np
import pytest
from libins.errors import UsageError

from libins import machine, motions, run, scenario

SEED = 5
NULL_CODE = 2048
RATE = [0.5, 1.0, -2.0]
THESIS_G = 9.8
PLACES = np.array([[0, 0, -1], [0, -1, 0], [-1, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
AXES = np.array([[1, 1, 0], [1, 0, 1], [0, 1, 1], [0, -1, 1], [-1, 0, 1], [-1, 1, 0]]) / math.sqrt(2)
"""Table 1 of Hung, Fang, Wang and Lee."""
TURNING = {
    "motion.kind": "constant_rate",
    "motion.rate_rad_s": RATE,
    "track.gravity": "thesis",
    "track.rotating": False,
    "sixacc.noise_lsb": 0.0,
    "sixacc.turn_on_m_s2": 0.0,
    "sixacc.rho_m": 0.2,
}


def scans(settings, stop_s=2.0):
    """The scenario, and each channel's instants and codes."""
    loaded = scenario.load(scenario.find("sixacc"), None, settings)
    result = run.execute(loaded, run.Options(seed=SEED, stop_s=stop_s))
    assert list(result.scan_columns) == [f"a{j}{what}" for what in ("_s", "_code") for j in range(1, 7)]
    assert result.summary["reports"] == []
    return loaded, result.scans[:, :6], result.scans[:, 6:]


def specific_force(q, place):
    """At a place of a body that turns at RATE, its origin at rest; q is q_nb."""
    w, x, y, z = q
    down_b = np.array([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)])
    return -THESIS_G * down_b + np.cross(RATE, np.cross(RATE, place))


def test_codes_are_those_of_the_motion():
    loaded, t_s, codes = scans(TURNING)
    motion = motions.motion_of(loaded)
    assert len(codes) >= 198
    for instants, row in zip(t_s, codes, strict=True):
        for j in range(6):
            f = specific_force(motion.attitude(instants[j]), 0.2 * PLACES[j])
            exact = NULL_CODE + AXES[j] @ f / loaded.tables.sixacc.lsb_m_s2
            assert row[j] == pytest.approx(exact, abs=0.501), f"accelerometer {j + 1} at {instants[j]} s"


def test_errors_are_in_the_codes():
    settings = {**TURNING, "motion.kind": "still"}
    _, _, codes = scans(settings, 0.2)
    errors = {
        "sixacc.bias_m_s2": [0.5, 0, 0, 0, 0, 0],
        "sixacc.scale_error": [0, 0.1, 0, 0, 0, 0],
        "sixacc.misalignment_rad": [[0, 0], [0, 0], [0, 0.1], [0, 0], [0.1, 0], [0, 0]],
    }
    loaded, _, wrong = scans({**settings, **errors}, 0.2)
    lsb = loaded.tables.sixacc.lsb_m_s2
    f = THESIS_G * math.sqrt(0.5)
    # 3, [0, 1, 1], is turned by 0.1 towards e2 = [0, -1, 1]; 5 towards its arm, which is level
    turned = -(1 + 0.1 - math.sqrt(1.01)) / math.sqrt(1.01) * f
    shortened = -(1 / math.sqrt(1.01) - 1) * f
    expected = [0.5, -0.1 * f, turned, 0.0, shortened, 0.0]
    assert np.allclose((wrong - codes).mean(axis=0) * lsb, expected, atol=1.01 * lsb)


def test_noise_dithers_the_codes():
    loaded, _, codes = scans({"sixacc.noise_lsb": 0.5}, 20.0)
    sigma = math.sqrt(0.5**2 + 1 / 12)
    assert codes.std(axis=0, ddof=1) == pytest.approx(sigma, rel=4 / math.sqrt(2 * len(codes))), f"seed {SEED}"
    assert abs(np.corrcoef(codes.T) - np.eye(6)).max() < 5 / math.sqrt(len(codes))
    again = scans({"sixacc.noise_lsb": 0.5}, 20.0)[2]
    assert (codes == again).all()


def test_each_start_has_biases_of_its_own():
    still = {"sixacc.turn_on_m_s2": 0.5}
    codes = scans(still, 0.5)[2].mean(axis=0)
    assert (abs(codes - scans({"sixacc.turn_on_m_s2": 0.0}, 0.5)[2].mean(axis=0)) > 2.0).all(), f"seed {SEED}"


@pytest.mark.parametrize(
    ("settings", "problem"),
    [
        ({"sixacc.bias_m_s2": [1.0]}, "found 1 entries, but 6 are needed"),
        ({"sixacc.misalignment_rad": [[0.0]] * 6}, "2 numbers are needed"),
        ({"sixacc.rho_m": 0.0}, "sixacc.rho_m"),
        ({"sixacc.axis": [[9.0, 0.0, 0.0]] * 6}, "the length of axis"),
        ({"track.kind": "circle", "track.radius_m": 0.0}, "radius"),
    ],
)
def test_refuses(settings, problem):
    with pytest.raises(UsageError, match=problem):
        machine.build(scenario.load(scenario.find("sixacc"), None, settings), 1, outside=True, trace=False)


def test_a_track_needs_accelerometers():
    with pytest.raises(UsageError, match=r"track: needs a \[sixacc\] table"):
        scenario.load(scenario.find("default"), None, {"track.kind": "still"})
