"""GyroFree from Python: a bias grows as the paper's geometry says, a standstill finds it, a fix is judged."""

import numpy as np
import pytest
from reference import both

PERIOD_S = 0.01
RHO = 0.1
G = 9.80665


def at_rest(ins, **given):
    """Level and at rest, and what ideal accelerometers read there."""
    bias, axis, r = ins.sixacc_paper(RHO)
    config = ins.GyroFreeConfig()
    config.noise = 1e-3
    config.attitude = [1e-3, 1e-3, 1e-3]
    for key, value in given.items():
        setattr(config, key, value)
    start = ins.Position([0.7, 0.1, 0.0])
    nav = ins.GyroFree(config, bias, axis, r, PERIOD_S, [1, 0, 0, 0], [0, 0, 0], start)
    return nav, axis @ np.array([0, 0, -G], dtype=axis.dtype)


@both
def test_a_bias_turns_the_attitude(ins):
    """Rate after t: S b t / (2 rho), S of unit rows: 1 mg on one accelerometer."""
    nav, readings = at_rest(ins)
    readings[0] += 1e-3 * G
    nav.step(np.tile(readings, (101, 1)))
    expected, _ = ins.Sixacc(*ins.sixacc_paper(RHO), PERIOD_S).resolve(readings, [0, 0, 0])
    np.testing.assert_allclose(nav.w_ib_b, expected * 1.0, atol=2e-4)
    assert np.linalg.norm(nav.w_ib_b) == pytest.approx(1e-3 * G / (2 * RHO), rel=0.01)


@both
def test_a_standstill_finds_the_bias_and_the_deviations_fall(ins):
    nav, readings = at_rest(ins, bias=1e-2 * G)
    readings[0] += 1e-3 * G
    before = nav.sigma
    assert before.shape == (ins.GYRO_FREE_N,)
    for _ in range(500):
        nav.step(readings)
        nav.still(1e-3, 1e-3)
    after = nav.sigma
    assert (after[12:15] < 0.01 * before[12:15]).all()
    nav.step(np.tile(readings, (100, 1)))
    assert np.linalg.norm(nav.w_ib_b) < 0.002, "a second later the rate is still that of rest"
    assert np.linalg.norm(nav.q_nb[1:]) < 0.01


@both
def test_a_fix_far_off_is_refused_and_one_near_is_used(ins):
    nav, readings = at_rest(ins, position=1.0, gate=10.83)
    nav.step(np.tile(readings, (2, 1)))
    far = ins.Position([0.7001, 0.1, 0.0])
    nav.position_fix(far, [1, 1, 1], [0, 0, 0])
    assert nav.refused == 1, "north alone is 600 m off"
    before = nav.sigma[6]
    nav.position_fix(ins.Position([0.7, 0.1, 0.0]), [1, 1, 1], [0, 0, 0])
    assert nav.refused == 1 and nav.sigma[6] < 0.8 * before
    nav.velocity_fix([0, 0, 0], [0.1, 0.1, 0.1])
    np.testing.assert_allclose(nav.v_n, 0, atol=0.01)


@both
def test_what_is_wrong_is_refused(ins):
    bias, axis, r = ins.sixacc_paper(RHO)
    start = ins.Position([0.7, 0.1, 0.0])
    with pytest.raises(ins.RangeError, match="noise > 0"):
        ins.GyroFree(ins.GyroFreeConfig(), bias, axis, r, PERIOD_S, [1, 0, 0, 0], [0, 0, 0], start)
    nav, readings = at_rest(ins)
    readings[3] = np.nan
    with pytest.raises(ins.RangeError):
        nav.step(readings)
