"""ROS 2 topics on another DDS stack (Fast DDS), decoded by another library (rosbags)."""

import contextlib
import json
import math
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import IO

import numpy as np
import pytest
from conftest import ROOT
from rosbags.typesys import Stores, get_typestore
from test_daemon import WALL_LIMIT_S, board

pytestmark = pytest.mark.wall_clock

PROGRAMS = ROOT / "build/release/tests/dds"
DOMAIN = 100 + os.getpid() % 100
COUNT = 60
TWIST_EVERY = 5  # in ros_publisher.c
TOPICS = {
    "rt/car/imu/data": "sensor_msgs/msg/Imu",
    "rt/car/gnss/fix": "sensor_msgs/msg/NavSatFix",
    "rt/car/odometry": "nav_msgs/msg/Odometry",
    "rt/car/twist": "geometry_msgs/msg/TwistWithCovarianceStamped",
    "rt/tf": "tf2_msgs/msg/TFMessage",
    "rt/diagnostics": "diagnostic_msgs/msg/DiagnosticArray",
}
SAMPLES = 4 * COUNT + COUNT // TWIST_EVERY + 1
"""Of all topics: an Imu, NavSatFix, Odometry and TFMessage an instant."""
TYPES = get_typestore(Stores.ROS2_JAZZY)
EARTH_RATE = 7.292115e-5
A, F = 6378137.0, 1 / 298.257223563
NED_TO_ENU = np.array([[0, 1, 0], [1, 0, 0], [0, 0, -1.0]])
FRD_TO_FLU = np.diag([1, -1, -1.0])


def wire(message: str) -> str:
    package, _, name = message.split("/")
    return f"{package}::msg::dds_::{name}_"


class Heard:
    """What the other stack hears and finds, as it comes."""

    def __init__(self, lines: IO[str]):
        self._lines = lines

    def all(self) -> list[dict]:
        self._lines.seek(0)
        return [json.loads(line) for line in self._lines if line.endswith("\n")]

    def samples(self) -> int:
        return sum("topic" in line for line in self.all())

    def wait(self, samples: int) -> None:
        end = time.monotonic() + WALL_LIMIT_S
        while self.samples() < samples:
            assert time.monotonic() < end, f"{self.samples()} of {samples} samples came in {WALL_LIMIT_S} s"
            time.sleep(0.05)


@contextlib.contextmanager
def judge(
    topics: dict[str, str],
    kind: str = "reliable",
    domain: int = DOMAIN,
    inside: Callable[[list[str]], list[str]] = list,
    **environment: str,
) -> Iterator[Heard]:
    """Another stack that listens while the block runs. inside: makes its command one in a network."""
    program = PROGRAMS / "fastdds_judge"
    assert program.exists(), f"{program} is missing: install libfastrtps-dev and build the tests"
    pairs = [text for topic, message in topics.items() for text in (topic, wire(message))]
    command = inside([str(program), str(domain), str(WALL_LIMIT_S), kind, *pairs])
    with tempfile.TemporaryDirectory() as folder, (Path(folder) / "heard").open("w+") as lines:
        with (Path(folder) / "heard").open("w") as out:
            listener = subprocess.Popen(
                command, stdout=out, stderr=subprocess.PIPE, text=True, env=os.environ | environment
            )
        try:
            assert listener.stderr is not None
            assert listener.stderr.readline() == "ready\n"
            yield Heard(lines)
        finally:
            listener.terminate()
            listener.communicate(timeout=10)


def published(
    count: int, samples: int, kind: str = "reliable", topics: dict[str, str] = TOPICS, readers: int = len(TOPICS)
) -> tuple[list[dict], list[dict]]:
    """What was said, and what was heard when so many samples had come."""
    command = [str(PROGRAMS / "ros_publisher"), str(DOMAIN), str(readers), str(count)]
    with judge(topics, kind) as heard, tempfile.TemporaryFile("w+") as said:
        publisher = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=said, stderr=subprocess.PIPE, text=True)
        try:
            heard.wait(samples)
            _, errors = publisher.communicate(timeout=WALL_LIMIT_S)  # closes its standard input
        finally:
            publisher.kill()
        assert publisher.returncode == 0, errors
        said.seek(0)
        return [json.loads(line) for line in said], heard.all()


@pytest.fixture(scope="module")
def exchange() -> tuple[list[dict], dict[str, list], list[dict]]:
    said, heard = published(COUNT, SAMPLES)
    messages: dict[str, list] = {topic: [] for topic in TOPICS}
    for line in heard:
        if "topic" in line:
            octets = bytes.fromhex(line["cdr"])
            assert octets[:2] == b"\0\1", "rmw_cyclonedds reads XCDR1, little endian, alone"
            messages[line["topic"]].append(TYPES.deserialize_cdr(octets, TOPICS[line["topic"]]))
    return said, messages, heard


def stamp_ns(message) -> int:
    return message.header.stamp.sec * 10**9 + message.header.stamp.nanosec


def rotation(euler: list[float]) -> np.ndarray:
    """c_nb of roll, pitch, yaw (ZYX)."""
    (sr, cr), (sp, cp), (sy, cy) = ((math.sin(x), math.cos(x)) for x in euler)
    z = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    y = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    x = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    return z @ y @ x


def turned(phi: np.ndarray) -> np.ndarray:
    """exp(-[phi x]), what an attitude error phi, truth less estimate, makes of a true attitude."""
    angle = np.linalg.norm(phi)
    k = np.array([[0, -phi[2], phi[1]], [phi[2], 0, -phi[0]], [-phi[1], phi[0], 0]]) / max(angle, 1e-30)
    return np.eye(3) - math.sin(angle) * k + (1 - math.cos(angle)) * k @ k


def of_quaternion(q) -> np.ndarray:
    w, x, y, z = q.w, q.x, q.y, q.z
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def vector(v) -> np.ndarray:
    return np.array([v.x, v.y, v.z])


def ecef(lat: float, lon: float, height: float) -> np.ndarray:
    e2 = F * (2 - F)
    n = A / math.sqrt(1 - e2 * math.sin(lat) ** 2)
    x = (n + height) * math.cos(lat)
    return np.array([x * math.cos(lon), x * math.sin(lon), (n * (1 - e2) + height) * math.sin(lat)])


def enu_axes(lat: float, lon: float) -> np.ndarray:
    """Rows: east, north, up in ECEF."""
    (sa, ca), (so, co) = (math.sin(lat), math.cos(lat)), (math.sin(lon), math.cos(lon))
    return np.array([[-so, co, 0], [-sa * co, -sa * so, ca], [ca * co, ca * so, sa]])


def numeric(function: Callable[[np.ndarray], np.ndarray], covariance: np.ndarray) -> np.ndarray:
    """Covariance of function(error) by central differences."""
    step = 1e-5
    columns = [(function(step * e) - function(-step * e)) / (2 * step) for e in np.eye(len(covariance))]
    jacobian = np.array(columns).T
    return jacobian @ covariance @ jacobian.T


def small(r: np.ndarray) -> np.ndarray:
    """Rotation vector of a small rotation."""
    return np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]]) / 2


def test_every_instant_comes_once_and_in_order(exchange):
    said, messages, _ = exchange
    times = [line["time_ns"] for line in said]
    assert len(times) == COUNT
    for topic in ("rt/car/imu/data", "rt/car/gnss/fix", "rt/car/odometry"):
        assert [stamp_ns(m) for m in messages[topic]] == times, topic
    assert [stamp_ns(m) for m in messages["rt/car/twist"]] == times[::TWIST_EVERY]
    assert [stamp_ns(m.transforms[0]) for m in messages["rt/tf"]] == times


def test_imu_is_in_enu_and_flu_with_its_covariances(exchange):
    said, messages, _ = exchange
    for line, imu in zip(said, messages["rt/car/imu/data"], strict=True):
        assert imu.header.frame_id == "imu_link"
        want = NED_TO_ENU @ rotation(line["euler"]) @ FRD_TO_FLU
        np.testing.assert_allclose(of_quaternion(imu.orientation), want, atol=1e-12)
        np.testing.assert_allclose(vector(imu.angular_velocity), FRD_TO_FLU @ line["w_ib_b"], atol=1e-15)
        np.testing.assert_allclose(vector(imu.linear_acceleration), FRD_TO_FLU @ line["f_b"], atol=1e-15)
        p = np.array(line["P"]).reshape(9, 9)
        turn = numeric(lambda e, want=want: small(NED_TO_ENU @ turned(e[:3]) @ NED_TO_ENU.T @ want @ want.T), p)
        np.testing.assert_allclose(imu.orientation_covariance.reshape(3, 3), turn, atol=1e-12)
        np.testing.assert_allclose(np.diag(imu.angular_velocity_covariance.reshape(3, 3)), 0.003**2)
        np.testing.assert_allclose(np.diag(imu.linear_acceleration_covariance.reshape(3, 3)), 0.04**2)


def test_fix_is_in_degrees_with_its_covariance_in_enu(exchange):
    said, messages, _ = exchange
    for line, fix in zip(said, messages["rt/car/gnss/fix"], strict=True):
        assert (fix.latitude, fix.longitude) == pytest.approx(np.degrees(line["llh"]), abs=1e-12)
        assert fix.altitude == line["height"]
        assert (fix.status.status, fix.status.service, fix.position_covariance_type) == (0, 1, 3)
        p = np.array(line["P"]).reshape(9, 9)[6:, 6:]
        np.testing.assert_allclose(fix.position_covariance.reshape(3, 3), NED_TO_ENU @ p @ NED_TO_ENU.T, atol=1e-12)


def test_odometry_is_the_pose_in_the_first_place_and_the_twist_in_the_body(exchange):
    said, messages, _ = exchange
    first = said[0]
    origin = ecef(*first["llh"], first["height"])
    axes = enu_axes(*first["llh"])
    for line, odometry in zip(said, messages["rt/car/odometry"], strict=True):
        assert (odometry.header.frame_id, odometry.child_frame_id) == ("odom", "base_link")
        here = ecef(*line["llh"], line["height"])
        np.testing.assert_allclose(vector(odometry.pose.pose.position), axes @ (here - origin), atol=2e-9)
        to_odom = axes @ enu_axes(*line["llh"]).T @ NED_TO_ENU
        c_nb, v_n, p = rotation(line["euler"]), np.array(line["v_n"]), np.array(line["P"]).reshape(9, 9)
        attitude = to_odom @ c_nb @ FRD_TO_FLU
        np.testing.assert_allclose(of_quaternion(odometry.pose.pose.orientation), attitude, atol=1e-12)

        def pose(e, to_odom=to_odom, c_nb=c_nb, attitude=attitude):
            moved = to_odom @ turned(e[:3]) @ c_nb @ FRD_TO_FLU
            return np.concatenate([-to_odom @ e[6:], small(moved @ attitude.T)])

        np.testing.assert_allclose(odometry.pose.covariance.reshape(6, 6), numeric(pose, p), atol=1e-8)
        lat = line["llh"][0]
        earth = c_nb.T @ (EARTH_RATE * np.array([math.cos(lat), 0, -math.sin(lat)]))
        twist = odometry.twist.twist
        np.testing.assert_allclose(vector(twist.linear), FRD_TO_FLU @ c_nb.T @ v_n, atol=1e-12)
        np.testing.assert_allclose(vector(twist.angular), FRD_TO_FLU @ (line["w_ib_b"] - earth), atol=1e-15)

        def velocity(e, c_nb=c_nb, v_n=v_n):
            return FRD_TO_FLU @ (turned(e[:3]) @ c_nb).T @ (v_n - e[3:6])

        got = odometry.twist.covariance.reshape(6, 6)
        np.testing.assert_allclose(got[:3, :3], numeric(velocity, p), atol=1e-8)
        np.testing.assert_allclose(got[3:, 3:], 0.003**2 * np.eye(3))
        assert not got[:3, 3:].any()


def test_tf_is_the_pose_of_the_odometry(exchange):
    _, messages, _ = exchange
    for tf, odometry in zip(messages["rt/tf"], messages["rt/car/odometry"], strict=True):
        (transform,) = tf.transforms
        assert (transform.header.frame_id, transform.child_frame_id) == ("odom", "base_link")
        assert vector(transform.transform.translation) == pytest.approx(vector(odometry.pose.pose.position), abs=0)
        assert transform.transform.rotation == odometry.pose.pose.orientation


def test_diagnostics_say_level_text_and_values(exchange):
    _, messages, _ = exchange
    (array,) = messages["rt/diagnostics"]
    (status,) = array.status
    assert stamp_ns(array) == 1700000009000000001
    assert (status.level, status.name, status.message) == (1, "libins: navigation", "samples are lost")
    assert [(v.key, v.value) for v in status.values] == [("lost", "3"), ("accepted", "12345")]


def test_discovery_tells_types_hashes_and_the_enclave(exchange):
    _, _, heard = exchange
    writers = {line["writer"]: line for line in heard if "writer" in line}
    for topic, message in TOPICS.items():
        assert writers[topic]["type"] == wire(message)
        assert writers[topic]["user"] == f"typehash={TYPES.hash_rihs01(message)};"
    assert {"participant": "enclave=/;"} in heard


def test_ros_discovery_info_names_the_node_and_its_writers():
    topics = {"ros_discovery_info": "rmw_dds_common/msg/ParticipantEntitiesInfo"}
    _, heard = published(1, 1, "latched", topics, readers=0)
    infos = [line for line in heard if line.get("topic") == "ros_discovery_info"]
    assert len(infos) == 1
    info = TYPES.deserialize_cdr(bytes.fromhex(infos[0]["cdr"]), topics["ros_discovery_info"])
    (node,) = info.node_entities_info_seq
    assert (node.node_namespace, node.node_name) == ("/car", "libins")
    gids = [bytes(gid.data) for gid in node.writer_gid_seq]
    assert len(set(gids)) == len(TOPICS) and not node.reader_gid_seq
    assert all(gid[:12] == bytes(info.gid.data)[:12] for gid in gids), "of one participant"


def test_a_best_effort_reader_is_served_too():
    published(20, 15, "best_effort", {"rt/car/imu/data": TOPICS["rt/car/imu/data"]}, readers=1)


def test_the_daemon_publishes_a_boards_attitude():
    """A board in real time, its UART on a TCP port, ins-navd --ros on it."""
    topics = {"rt/imu/data": "sensor_msgs/msg/Imu", "rt/tf": "tf2_msgs/msg/TFMessage"}
    navd = ROOT / "build/release/python/libins/bin/ins-navd"
    with judge(topics) as heard, board("default", "uart=tcp:0", 10) as (_, address):
        daemon = subprocess.run(
            [str(navd), "--device", f"tcp:{address}", "--ros", "--limit", "200", "--timeout-s", "5"],
            env=os.environ | {"ROS_DOMAIN_ID": str(DOMAIN)},
            capture_output=True,
            text=True,
            timeout=WALL_LIMIT_S,
        )
        assert daemon.returncode == 0, daemon.stderr
        assert daemon.stdout == "", "states go to ROS alone"
        octets = [(m["topic"], bytes.fromhex(m["cdr"])) for m in heard.all() if "topic" in m]
    imus = [TYPES.deserialize_cdr(cdr, topics[topic]) for topic, cdr in octets if topic == "rt/imu/data"]
    assert len(imus) > 20
    for imu in imus:
        r = of_quaternion(imu.orientation)
        np.testing.assert_allclose(r @ r.T, np.eye(3), atol=1e-9)
        assert imu.linear_acceleration_covariance[0] == -1, "there is no accelerometer on this board"
    assert sum(topic == "rt/tf" for topic, _ in octets) > 20


def test_a_run_publishes_its_own_navigator_beside_its_states():
    """ins run --dds --ros: both in one domain of one process."""
    topics = {"rt/unit1/imu/data": "sensor_msgs/msg/Imu"}
    command = [sys.executable, "-m", "libins", "run", "default", "--dds", "--ros", "/unit1", "--domain", str(DOMAIN)]
    with judge(topics) as heard:
        environment = {key: value for key, value in os.environ.items() if key != "ROS_DOMAIN_ID"}
        done = subprocess.run(
            [*command, "--stop-s", "4", "--speed", "1", "--json", "-"],
            env=environment,
            capture_output=True,
            text=True,
            timeout=WALL_LIMIT_S,
        )
        assert done.returncode == 0, done.stderr
        assert json.loads(done.stdout)["dds"]["published"] > 100
        assert heard.samples() > 50


def test_a_wrong_namespace_is_refused():
    command = [sys.executable, "-m", "libins", "run", "default", "--ros", "unit 1", "--domain", str(DOMAIN)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=WALL_LIMIT_S)
    assert done.returncode == 2
    assert "ROS namespace 'unit 1'" in done.stderr
