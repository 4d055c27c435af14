"""ins record and ins play against real publishers: octets, topics, a recorder that is killed."""

import contextlib
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import mcap_kit
import numpy as np
import pytest
from conftest import ROOT, WALL_LIMIT_S
from libins.cli import main
from libins.recorder import CHUNK_OCTETS
from libins.recording_mcap import Recording
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory

from libins import _dds

pytestmark = pytest.mark.wall_clock
DOMAIN = 100 + (os.getpid() + 50) % 100
SEED = 20260802
COUNT = 60
PLAYED = 200
SPACING_NS = 2_000_000
TOPICS = {name.removeprefix("rt") for name in mcap_kit.NAMES.values()}


@contextlib.contextmanager
def recorder(path: Path, *options: object, topics: int = 0) -> Iterator[subprocess.Popen[str]]:
    """ins record, in the block with so many topics found."""
    command = [sys.executable, "-m", "libins", "record", str(path), "--domain", str(DOMAIN), *map(str, options)]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        assert process.stderr is not None
        for _ in range(topics):
            assert "recording" in process.stderr.readline()
        yield process
    finally:
        process.kill()
        process.communicate()


def play(path: Path, *options: object) -> subprocess.Popen[str]:
    command = [sys.executable, "-m", "libins", "play", str(path), "--domain", str(DOMAIN), *map(str, options)]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


@pytest.fixture(scope="module")
def played(tmp_path_factory: pytest.TempPathFactory) -> tuple[list[tuple], Path, float]:
    """What a recording said, the recording of its play, and how long it was played."""
    folder = tmp_path_factory.mktemp("played")
    said = mcap_kit.write(folder / "first.mcap", PLAYED, SEED, SPACING_NS)
    begin = time.monotonic()
    with recorder(folder / "second.mcap", "--limit", PLAYED, "--timeout-s", WALL_LIMIT_S) as listener:
        player = play(folder / "first.mcap", "--wait")
        out, errors = player.communicate(timeout=WALL_LIMIT_S)
        took_s = time.monotonic() - begin
        assert player.returncode == 0, errors
        assert f"{PLAYED} messages of {len(TOPICS)} topics played" in out
        out, errors = listener.communicate(timeout=WALL_LIMIT_S)
        assert listener.returncode == 0, errors
        assert f"{PLAYED} messages of {len(TOPICS)} topics" in out
    return said, folder / "second.mcap", took_s


def test_what_is_played_is_recorded_octet_for_octet(played):
    said, path, _ = played
    with Recording(path) as recording:
        assert recording.problem is None
        for topic in TOPICS:
            heard = [taken.octets for taken in recording.messages([topic])]
            assert heard == [octets for name, _, _, octets in said if name == topic], topic


def test_spacing_and_order_are_those_of_the_recording(played):
    said, path, took_s = played
    assert took_s > PLAYED * SPACING_NS * 1e-9
    with Recording(path) as recording:
        published = [taken.published_ns for taken in recording.messages()]
        logged = [taken.log_ns for taken in recording.messages()]
    assert logged == sorted(logged)
    assert published[-1] - published[0] > (PLAYED - 1) * SPACING_NS * 0.9
    assert len(set(published)) == len(said)


def test_topics_come_again_as_they_were_offered(played, tmp_path):
    with Recording(played[1]) as recording:
        tf = recording.topics["/tf"].metadata
        assert "durability: transient_local" in tf["offered_qos_profiles"]
        assert tf["topic_type_hash"] == "RIHS01_00"
        assert "sec: 1\n    nsec: 500000000" in tf["offered_qos_profiles"]
        assert "libins_strength" not in tf


def test_a_board_on_ros_is_recorded_for_independent_readers(tmp_path):
    path = tmp_path / "car.mcap"
    names = ["/car/imu/data", "/car/odometry", "/tf", "/car/gnss/fix", "/car/twist"]
    options = [option for name in names for option in ("--topic", name)]
    publisher = [ROOT / "build/release/tests/dds/ros_publisher", str(DOMAIN), "1", str(COUNT)]
    with recorder(path, *options) as listener:
        said = subprocess.run(publisher, capture_output=True, text=True, timeout=WALL_LIMIT_S)
        assert said.returncode == 0, said.stderr
        listener.send_signal(signal.SIGINT)
        _, errors = listener.communicate(timeout=WALL_LIMIT_S)
        assert listener.returncode == 0, errors
    instants = {line["time_ns"]: line for line in map(json.loads, said.stdout.splitlines())}
    seen = dict.fromkeys(names, 0)
    with path.open("rb") as file:
        heard = list(make_reader(file, decoder_factories=[DecoderFactory()]).iter_decoded_messages())
    for _, channel, _, value in heard:
        topic = channel.topic
        seen[topic] += 1
        stamp = (value.transforms[0] if topic == "/tf" else value).header.stamp
        line = instants[stamp.sec * 10**9 + stamp.nanosec]
        if topic == "/car/imu/data":
            w = value.angular_velocity
            np.testing.assert_allclose([w.x, -w.y, -w.z], line["w_ib_b"], rtol=1e-15)
        elif topic == "/car/gnss/fix":
            np.testing.assert_allclose([value.latitude, value.longitude], np.degrees(line["llh"]), rtol=1e-14)
            assert value.altitude == line["height"]
    assert seen["/car/imu/data"] == COUNT
    assert all(count >= (COUNT // 5 if name == "/car/twist" else COUNT) - 5 for name, count in seen.items()), seen


def test_a_killed_recorder_leaves_what_it_had(tmp_path, capsys):
    path, part = tmp_path / "killed.mcap", tmp_path / "killed.mcap.part"
    source = _dds.Raw(DOMAIN + 1, None)
    number = source.publish(_dds.raw_topic("libins/nav_state", "libins::NavState"))
    octets = mcap_kit.write(tmp_path / "one.mcap", 1, SEED)[0][3]
    written = 0
    with contextlib.closing(source), recorder(path, "--domain", DOMAIN + 1, topics=1) as listener:
        while not part.exists() or part.stat().st_size < 2000:
            assert written * len(octets) < CHUNK_OCTETS / 2, "nothing is written before a chunk is full"
            source.write(number, octets)
            written += 1
            time.sleep(0.005)
        listener.kill()
    assert not path.exists()
    with Recording(part) as recording:
        heard = [taken.octets for taken in recording.messages()]
        assert recording.problem is not None and "its end was never written" in recording.problem
    assert 0 < len(heard) <= written and set(heard) == {octets}
    assert main(["play", str(part), "--domain", str(DOMAIN + 1), "--speed", "max"]) == 0
    said = capsys.readouterr()
    assert f"is cut off or damaged after {len(heard)} messages" in said.err
    assert f"{len(heard)} messages of 1 topics played" in said.out
    assert main(["record", str(path), "--domain", str(DOMAIN + 1), "--timeout-s", "0.1"]) == 2
    assert "killed.mcap.part: is there, of a recording that goes on or was killed" in capsys.readouterr().err


def test_nothing_is_written_of_nothing(tmp_path, capsys):
    path = tmp_path / "empty.mcap"
    assert main(["record", str(path), "--domain", str(DOMAIN + 1), "--timeout-s", "0.2"]) == 1
    assert "nothing arrived" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("command", "text"),
    [
        (("play", "--speed", "0"), "--speed 0: 'max' or a number"),
        (("play", "--from", "-1"), "--from -1: must lie in 0 .. 0.018"),
        (("play", "--topic", "/imu"), "has no topic /imu; it has libins/nav_state"),
        (("play", "--domain", "231"), "--domain 231: must lie in 0 .. 230"),
        (("record", "--limit", "0"), "--limit 0: must lie above 0"),
        (("record", "--duration", "nan"), "--duration nan: must lie above 0"),
    ],
)
def test_bad_usage_is_said(tmp_path, capsys, command, text):
    path = tmp_path / "short.mcap"
    mcap_kit.write(path, 10, SEED, SPACING_NS)
    assert main([command[0], str(path), "--domain", str(DOMAIN + 1), *command[1:]]) == 2
    assert text in capsys.readouterr().err
    assert [each.name for each in tmp_path.iterdir()] == ["short.mcap"]
