"""libins._truth: arrays of states and increments belong together, errors of an IMU, fixes, refusals."""

import math
import re

import numpy as np
import pytest

from libins import _truth

SITE = _truth.Site(0.43, 2.11, 50.0, "normal", rotating=True)
SPEED = (10.0, 0.0, 5.0, 60.0, 5.0)


def circle():
    return _truth.track_circle(SITE, 0.3, 50.0, SPEED)


def test_rows_are_the_single_instants():
    track = circle()
    t = np.linspace(-1.0, 80.0, 7)
    together = track.at(t)
    for k, instant in enumerate(t):
        for name, value in track.at(float(instant)).items():
            assert np.array_equal(together[name][k], value), name


def test_increments_are_means_of_rate_and_specific_force():
    track = circle()
    t = np.arange(0.0, 75.0, 1e-3)
    theta, v = track.increments(t)
    middle = track.at(t[:-1] + 0.5e-3)
    assert np.abs(theta / 1e-3 - middle["w_ib_b"]).max() < 1e-7
    assert np.abs(v / 1e-3 - middle["f_b"]).max() < 1e-6
    assert len(theta) == len(v) == len(t) - 1


def test_an_attitude_may_be_a_motion():
    cone = _truth.motion_coning(0.02, 3.0, 0.0)
    track = _truth.track_still(SITE, cone)
    assert np.array_equal(track.at(1.7)["q_nb"], cone.attitude(1.7))


def test_errors_are_those_of_the_configuration_and_go_on_from_call_to_call():
    config = _truth.ImuConfig()
    config.gyro.bias = [0.01, 0.0, -0.01]
    config.accel.scale[1] = 0.5
    config.gyro.random_walk = [1e-4] * 3
    theta, v = circle().increments(np.arange(201) * 0.01)
    whole = _truth.ImuErrors(config).apply(theta, v, 0.01)
    parts = _truth.ImuErrors(config)
    halves = [parts.apply(theta[k : k + 100], v[k : k + 100], 0.01) for k in (0, 100)]
    for name, rows in whole.items():
        assert np.array_equal(rows, np.concatenate([half[name] for half in halves])), name
    assert np.array_equal(whole["v"], v * [1.0, 1.5, 1.0])
    noise = whole["theta"] - theta - np.array([1e-4, 0.0, -1e-4])
    assert np.abs(noise.std() / 1e-5 - 1.0) < 0.15
    assert np.array_equal(whole["gyro_bias"][0], [0.01, 0.0, -0.01])
    config.seed += 1
    assert not np.array_equal(_truth.ImuErrors(config).apply(theta, v, 0.01)["theta"], whole["theta"])


def test_ideal_fixes_are_the_truth():
    track = circle()
    fixes = _truth.gps_fixes(_truth.gps_ideal(), track, 3, 5)
    truth = track.at(fixes["t"][:, 0].copy())
    assert fixes["t"][:, 0].tolist() == [3.0, 4.0, 5.0, 6.0, 7.0]
    assert np.abs(fixes["llh"] - truth["llh"]).max() < 1e-9
    assert np.array_equal(fixes["v_n"], truth["v_local"])


def test_refusals_name_the_argument():
    theta, v = circle().increments(np.arange(4) * 0.01)
    imu = _truth.ImuErrors(_truth.ImuConfig())
    config = _truth.ImuConfig()
    config.gyro.markov = [0.0, -1.0, 0.0]
    for text, call in {
        "theta has 3 rows and v 2, give as many of each": lambda: imu.apply(theta, v[:2], 0.01),
        "dt_s: above 0": lambda: imu.apply(theta, v, math.nan),
        "gyro: markov[1] is -1, give 0 to 1000": lambda: _truth.ImuErrors(config),
        "bias: 2 numbers, give 3": lambda: setattr(config.gyro, "bias", [1.0, 2.0]),
        "t: 1 instants, give the 2 or more": lambda: circle().increments(np.zeros(1)),
    }.items():
        with pytest.raises(ValueError, match=re.escape(text)):
            call()


def test_a_body_driven_by_a_function_is_integrated():
    rate = 0.3

    def spin(t, p_n, v_n, q_nb):
        return (0.0, 0.0, rate), (0.0, 0.0, -9.8)

    def quarter(t, p_n, v_n, q_nb):
        return q_nb[3] - math.sin(math.pi / 4)

    site = _truth.Site(0.43, 2.11)
    body = _truth.track_body(site, spin, (0, 0, 0), (0, 0, 0), (1, 0, 0, 0), 0.0, 20.0, 1e-12, [(quarter, 1, False)])
    t = np.linspace(0.0, 20.0, 100)
    q = body.at(t)["q_nb"]
    assert np.abs(q[:, 0] - np.cos(0.5 * rate * t)).max() < 1e-10
    (instant, event, direction), *_ = _truth.happenings(body)
    assert (event, direction) == (0, 1)
    assert abs(instant - math.pi / 2 / rate) < 1e-9
    theta, _ = body.increments(t)
    assert np.abs(theta[:, 2] - rate * np.diff(t)).max() < 1e-14


def test_a_body_driven_by_manoeuvres_or_rows_is_the_same():
    site = _truth.Site(0.43, 2.11, 0.0, "normal", rotating=True)
    plan = [("hold", 2.0, 0.0), ("turn", 5.0, 1.0), ("roll", 3.0, 0.5)]
    start = ((0, 0, 0), (20.0, 0, 0), (1, 0, 0, 0), 0.0)
    one = _truth.track_body(site, _truth.drive_manoeuvres(site, plan, 0.0, 20.0), *start, 12.0)
    t = np.arange(0.0, 12.0, 0.01)
    sensed = one.at(t)
    two = _truth.track_body(site, _truth.drive_table(t, sensed["w_ib_b"], sensed["f_b"]), *start, 11.9)
    at = np.array([11.5])
    assert np.abs(one.at(at)["p_n"] - two.at(at)["p_n"]).max() < 1e-4


def test_what_a_drive_raises_comes_out_and_refusals_say_why():
    site = _truth.Site(0.43, 2.11)
    rest = ((0, 0, 0), (0, 0, 0), (1, 0, 0, 0), 0.0, 1.0)

    def broken(t, p_n, v_n, q_nb):
        raise KeyError("of the drive")

    with pytest.raises(KeyError, match="of the drive"):
        _truth.track_body(site, broken, *rest)
    with pytest.raises(ValueError, match=re.escape("tolerance is 1, give 1e-14 to 0.001")):
        _truth.track_body(site, broken, *rest, 1.0)
    with pytest.raises(ValueError, match="manoeuvre: found 'fly', but hold or accelerate or turn"):
        _truth.drive_manoeuvres(site, [("fly", 1.0, 1.0)], 0.0, 0.0)
