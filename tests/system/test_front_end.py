"""[front_end]: what the real firmware reads when sensors reach the converter through an amplifier and an RC."""

from pathlib import Path

import numpy as np
import pytest
from libins.board import Board
from libins.errors import UsageError

from libins import run, scenario

BASE = """schema = 1
board = "8051_tlc2543"
firmware = "acq_default.ihx"
stop_s = 3.0
[motion]
kind = "sinusoids"
yaw = { amplitude_rad = 0.02, frequency_hz = 5.0 }
pitch = { amplitude_rad = 0.03, frequency_hz = 4.0 }
[nav]
period_s = 0.02
skew_s = [0.0, 125.868e-6, 260.417e-6]
"""
BANDWIDTH = "[gyro]\nbandwidth_hz = 25.0\n"
SENSOR = "[front_end]\nsensor_hz = 25.0\n"
CHAIN = "[front_end]\nsensor_hz = 80.0\nsensor_damping = 0.7\namplifier_hz = 1e5\nslew_v_s = 1e5\nrc_s = 1e-3\n"


def scans(tmp_path: Path, more: str) -> np.ndarray:
    path = tmp_path / "front_end.toml"
    path.write_text(BASE + more, encoding="utf-8")
    result = run.execute(scenario.load(path), run.Options())
    assert result.summary["link"]["lost"] == 0
    return np.asarray(result.scans)


def test_a_sensor_stage_is_the_gyros_bandwidth(tmp_path):
    filtered, staged, wide = (scans(tmp_path, more) for more in (BANDWIDTH, SENSOR, ""))
    settled = filtered[:, 0] > 0.2  # the stage starts at rest, the bandwidth has the motion's past
    assert np.array_equal(filtered[:, :3], staged[:, :3]), "the same instants"
    assert np.abs(filtered[settled, 3:] - staged[settled, 3:]).max() <= 1
    assert np.abs(wide[settled, 3:] - staged[settled, 3:]).max() > 20


def test_two_runs_are_the_same_to_the_code(tmp_path):
    noise = "[gyro]\nnoise_rad_s_rthz = 1e-3\n"
    assert np.array_equal(scans(tmp_path, noise + CHAIN), scans(tmp_path, noise + CHAIN))


def test_a_board_goes_on_from_a_snapshot_with_the_same_codes(tmp_path):
    path = tmp_path / "chain.toml"
    path.write_text(BASE + CHAIN, encoding="utf-8")
    board = Board(path)
    board.run_until(1.0)
    snap = board.snapshot()
    board.run_until(2.0)
    once = board._run.scans()
    board.restore(snap)
    board.run_until(2.0)
    assert len(once) == pytest.approx(100, abs=2)
    assert np.array_equal(board._run.scans(), once)


def test_a_refusal_names_the_key(tmp_path):
    with pytest.raises(
        UsageError, match=r"front_end.toml:\d+: front_end.rc_s: found -1.0, but it must lie in 0.0 .. 10.0"
    ):
        scans(tmp_path, "[front_end]\nrc_s = -1.0\n")
    with pytest.raises(UsageError, match="slew_v_s is 10 and amplifier_hz 0: give the amplifier a bandwidth too"):
        scans(tmp_path, "[front_end]\nslew_v_s = 10.0\n")
