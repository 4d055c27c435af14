"""Decentralised GPS and dead reckoning from Python: one drive for both, and what the position rests on."""

import copy
import math

import numpy as np
import pytest
from reference import both

SPEED = 8.0
SIGMA = 3.0
SEED = 4


def drive(navigator, step, seconds, visible, pose, rng):
    """Fixes each second, steps each 100 ms; moves pose, which is east, north, heading."""
    for k in range(seconds * 10):
        rate = 0.25 * math.sin(0.011 * k)
        middle = pose[2] + rate * 0.05
        pose += [0.1 * SPEED * math.sin(middle), 0.1 * SPEED * math.cos(middle), 0.1 * rate]
        step(rate + rng.normal(0, 0.005), 0.1 * SPEED + rng.normal(0, 0.003))
        if k % 10 == 9:
            fix = pose[:2] + rng.normal(0, SIGMA, 2)
            if visible:
                yield fix
            else:
                navigator.no_fix()


@both
def test_ours(ins):
    n = ins.GpsDr(tau_fix=0, sigma_bias=0.01)
    assert n.source == ins.GPS_DR_NONE
    with pytest.raises(ins.StateError, match=r"GpsDr\.state.*a fix before"):
        n.state()
    rng = np.random.default_rng(SEED)
    pose = np.array([0.0, 0.0, 2.5])

    def step(rate, distance):
        n.step(0.1, rate, distance)

    for fix in drive(n, step, 60, True, pose, rng):
        n.fix(*fix, SIGMA, sats=8, hdop=1)
    assert n.source == ins.GPS_DR_GPS
    before = copy.copy(n)
    list(drive(n, step, 60, False, pose, rng))
    assert n.source == ins.GPS_DR_DR
    assert before.source == ins.GPS_DR_GPS
    x, p = n.state()
    error = x[:2] - pose[:2]
    assert error @ np.linalg.solve(p[:2, :2], error) < 13.8, f"seed {SEED}: {error} m"  # chi-squared, 99.9 %
    assert np.hypot(*error) < 30
    with pytest.raises(ins.GateError, match=r"GpsDr\.fix"):
        n.fix(1e6, 0, SIGMA, sats=8, hdop=1)
    assert (n.gross, n.used) == (1, 60)
    with pytest.raises(ValueError, match=r"GpsDr\.step.*dt > 0"):
        n.step(0, 0, 0)
    with pytest.raises(ValueError, match=r"GpsDr.*the other figures >= 0"):
        ins.GpsDr(tau_fix=-1)


@both
def test_the_papers(ins):
    rng = np.random.default_rng(SEED)
    pose = np.array([0.0, 0.0, 2.5])
    p = ins.GpsDrPaper(printed=True)
    for fix in drive(p, p.step, 60, True, pose, rng):
        p.fix(*fix, sats=8, hdop=1)
    assert p.source == ins.GPS_DR_GPS
    x, var = p.state()
    assert np.hypot(*(x[:2] - pose[:2])) < 10
    assert (var > 0).all()
    list(drive(p, p.step, 10, False, pose, rng))
    assert p.source == ins.GPS_DR_DR
    assert np.hypot(*(p.state()[0][:2] - pose[:2])) < 40
    with pytest.raises(ValueError, match="GpsDrPaper.*sigma_fix >= 0"):
        ins.GpsDrPaper(sigma_fix=-1)
