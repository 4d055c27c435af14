"""ins-navd navigating by six accelerometers: the emulated board at rest on its pty, at a quarter of real time."""

import subprocess

import numpy as np
import pytest
from test_daemon import NATIVE, WALL_LIMIT_S, board, lines

pytestmark = pytest.mark.wall_clock
PLACE_DEG = (24.757, 120.951)
HEIGHT_M = 60.0
SPEED = 0.25
OCTET_TIMEOUT_MS = 50
"""Of a host that is late: the board waits 4 ms of its own time, which are 16 here."""
SAMPLES = 120
SKEW_US = "0,125.868,260.417,394.965,529.514,664.063"
COMMAND = [
    NATIVE, "--input", "six", "--position-deg", f"{PLACE_DEG[0]},{PLACE_DEG[1]},{HEIGHT_M}", "--accel-arm-m", "0.1",
    "--still-s", "0.5", "--skew-us", SKEW_US, "--octet-timeout-ms", OCTET_TIMEOUT_MS, "--timeout-s", "20",
]  # fmt: skip
RADIUS_M = 6.37e6


def navigated(*options):
    with board("sixacc", "uart=pty", 60, "--speed", SPEED) as (_, path):
        command = [*COMMAND, "--device", path, "--limit", SAMPLES, *options]
        done = subprocess.run([*map(str, command)], capture_output=True, text=True, timeout=2 * WALL_LIMIT_S)
    assert done.returncode == 0, done.stderr
    return lines(done.stdout)


def errors(state):
    """Of attitude, velocity and position at rest, in the order of sigma."""
    lat, lon, height = state["lat_lon_height"]
    north, east = RADIUS_M * (np.array([lat, lon]) - np.deg2rad(PLACE_DEG)) * [1.0, np.cos(lat)]
    q = np.array(state["q_nb"])
    return np.concatenate([2.0 * q[1:] * np.sign(q[0]), state["v_n"], [north, east, HEIGHT_M - height]])


def test_the_daemon_navigates_without_gyros():
    states = navigated()
    last = states[-1]
    link = last["link"]
    assert len(states) == SAMPLES
    assert last["used"] + last["missed"] == last["index"] + 1 == link["accepted"] + link["lost"]
    assert np.all(np.abs(errors(last)) < 5.0 * np.array(last["sigma"][:9])), "surer than it may be"
    sigma = np.array([state["sigma"] for state in states])
    assert sigma[-1, 6:9].max() < 0.2
    assert np.all(sigma[-1, 12:15] < 0.1 * sigma[0, 12:15]), "rest calibrates the angular acceleration"
    assert last["fixes"] == 0
    assert abs(np.array(last["w_ib_b"])).max() < 0.05


def test_another_place_of_the_accelerometers_is_not_right():
    """What --accel says is used: two of the six exchanged."""
    half = np.sqrt(0.5)
    axes = [(1, 1, 0), (1, 0, 1), (0, 1, 1), (0, -1, 1), (-1, 0, 1), (-1, 1, 0)]
    places = [(0, 0, -1), (0, -1, 0), (-1, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    order = [1, 0, 2, 3, 4, 5]
    accels = []
    for k, j in enumerate(order, start=1):
        figures = [k, 0.0, *(half * a for a in axes[j]), *(0.1 * r for r in places[j])]
        accels += ["--accel", ",".join(f"{x:.17g}" for x in figures)]
    last = navigated(*accels)[-1]
    assert np.any(np.abs(errors(last)) > 5.0 * np.array(last["sigma"][:9]))
