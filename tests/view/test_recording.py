"""Recordings behind a page: what ins replay and ins record write, played, sought; refused when it is none."""

import math
import random
import sys
from pathlib import Path

import numpy as np
import pytest
from libins.errors import UsageError
from libins.view_recording import RecordingEngine
from libins.view_session import Asked

from libins import _post, core, replay_files

sys.path.insert(0, str(Path(__file__).parents[1] / "system"))
import mcap_kit  # noqa: E402
from mcap_kit import Recorder, _dds, idl  # noqa: E402

ROWS = 101
STEP_S = 0.1
SPEED_M_S = 10.0
METRES_A_RADIAN_NORTH = 6_335_439.3
"""Of the meridian at the equator, WGS-84."""


def attitudes() -> np.ndarray:
    yaw = np.linspace(0.0, 1.0, ROWS)
    return np.column_stack([np.cos(yaw / 2), 0 * yaw, 0 * yaw, np.sin(yaw / 2)])


def solution(folder: Path) -> Path:
    """Northwards from the equator, turning."""
    states = np.zeros((ROWS, len(_post.STATE_COLUMNS)))
    column = {name: i for i, name in enumerate(_post.STATE_COLUMNS)}
    states[:, column["t_s"]] = STEP_S * np.arange(ROWS)
    states[:, column["latitude_rad"]] = SPEED_M_S * states[:, 0] / METRES_A_RADIAN_NORTH
    states[:, column["q_w"] : column["q_z"] + 1] = attitudes()
    path = folder / "drive.csv"
    path.write_text(replay_files.csv(states, 1.7e9, np.zeros(ROWS)), encoding="utf-8")
    return path


def mcap(folder: Path) -> Path:
    """NavState with those attitudes, and another topic before it."""
    rng, path = random.Random(20261122), folder / "drive.mcap"
    recorder = Recorder(path)
    kinds = {"sensor_msgs::msg::dds_::NavSatFix_": "rt/gnss/fix", "libins::NavState": "libins/nav_state"}
    topics = {kind: _dds.raw_topic(name, kind, user="typehash=RIHS01_00;") for kind, name in kinds.items()}
    numbers = {kind: recorder.topic(topic) for kind, topic in topics.items()}
    for i, q in enumerate(attitudes()):
        at = mcap_kit.BEGIN_NS + round(i * STEP_S * 1e9)
        for kind, number in numbers.items():
            value = mcap_kit.message(idl.ros_name(kind), rng)
            if kind == "libins::NavState":
                value.q_nb[:] = q
                value.llh[:] = [SPEED_M_S * STEP_S * i / METRES_A_RADIAN_NORTH, 0.0, 0.0]
            recorder.add(number, at, at, mcap_kit.octets_of(idl.ros_name(kind), value))
    recorder.close()
    return path


def play(engine: RecordingEngine, name: str, stop_at_ps: int = 10**18, **arguments: object) -> dict:
    moves = engine.moves[name]
    return moves(Asked({"do": name, **arguments}), lambda: engine.now_ps >= stop_at_ps)


@pytest.mark.parametrize("make", [solution, mcap])
def test_plays_seeks_and_shows_what_was_written(make, tmp_path: Path) -> None:
    engine = RecordingEngine(make(tmp_path))
    hello = engine.hello()
    assert hello["kind"] == "recording" and hello["stop_s"] == pytest.approx(STEP_S * (ROWS - 1))
    assert len(hello["path"]) == ROWS and hello["path"][-1][1] == pytest.approx(100.0, abs=0.01)
    engine.slice(10**10)
    assert play(engine, "run", 5 * 10**12)["stop"]["kind"] == "interrupted"
    frame = engine.frame(False)
    assert frame["t_ps"] == 5 * 10**12 and frame["row"] == 50
    assert frame["estimate"]["euler"][2] == pytest.approx(0.5, abs=1e-8)
    assert frame["position"]["en"] == pytest.approx([0.0, 50.0], abs=0.01)
    assert "rewound" not in frame
    play(engine, "to", t_ps=10**12)
    assert (frame := engine.frame(False))["rewound"] == 10**12 and frame["row"] == 10
    assert "rewound" not in engine.frame(False)
    assert play(engine, "run")["stop"]["kind"] == "end"
    want = core.quat_to_euler(attitudes())[-1]
    assert engine.frame(False)["estimate"]["euler"] == pytest.approx(want.tolist(), abs=1e-8)
    with pytest.raises(UsageError, match="t_ps: found"):
        play(engine, "to", t_ps=11 * 10**12)


def test_what_is_no_recording_is_refused_with_place_and_value(tmp_path: Path) -> None:
    path = solution(tmp_path)
    lines = path.read_text(encoding="utf-8").splitlines()
    for text, said in (
        ("a,b\n1,2\n", "drive.csv:1: found a,b"),
        ("", "drive.csv:1: found "),
        ("\n".join([*lines[:3], lines[3].replace("1.7e", "x").replace(",", ",x,", 1)]), "no solution of ins replay"),
        ("\n".join([lines[0], *reversed(lines[1:])]), "times that do not go back"),
        ("\n".join(lines[:2]), "two rows or more"),
    ):
        path.write_text(text, encoding="utf-8")
        with pytest.raises(UsageError) as refused:
            RecordingEngine(path)
        assert said in str(refused.value)
    twice = lines[5].split(",")
    place = lines[0].split(",").index("q_w")
    twice[place] = str(2.0 * math.copysign(1.0, float(twice[place])))
    path.write_text("\n".join([*lines[:5], ",".join(twice), *lines[6:]]), encoding="utf-8")
    with pytest.raises(UsageError, match="row 5: its quaternion has length 2"):
        RecordingEngine(path)
    empty = tmp_path / "nothing.mcap"
    empty.write_bytes(b"")
    with pytest.raises(UsageError, match="no MCAP file"):
        RecordingEngine(empty)
