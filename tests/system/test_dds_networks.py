"""DDS in networks of its own: the examples and ROS 2 topics beside ins-navd, on loopback alone and across a cable."""

import contextlib
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest
from conftest import ROOT
from namespaces import ADDRESSES, Namespace, alone, cable
from test_daemon import NATIVE, WALL_LIMIT_S, board, ended
from test_ros import PROGRAMS, TYPES, judge, stamp_ns

pytestmark = pytest.mark.wall_clock
EXAMPLES = ROOT / "examples"
RUST = ROOT / "build/rust_dds"  # of cargo, kept from one run to the next
BUILD_LIMIT_S = 1800
STRICT = "-Wall -Wextra -Wpedantic -Wconversion -Wdouble-promotion -Wshadow -Werror"
STOP_S = 300  # of a board, which is ended before
STATES = 20
INSTANTS = 20  # whose lines a pipe holds
CABLE = f"""<CycloneDDS><Domain><General><Interfaces><NetworkInterface name="cable1"/></Interfaces></General>
<Discovery><Peers><Peer address="{ADDRESSES[0]}"/></Peers></Discovery></Domain></CycloneDDS>"""
ROS = {
    "rt/car/imu/data": "sensor_msgs/msg/Imu",
    "rt/car/gnss/fix": "sensor_msgs/msg/NavSatFix",
    "rt/car/odometry": "nav_msgs/msg/Odometry",
}
GRAPH = {"ros_discovery_info": "rmw_dds_common/msg/ParticipantEntitiesInfo"}
BOARD = {"rt/board/imu/data": "sensor_msgs/msg/Imu"}


def run(*command: object, **environment: str) -> None:
    words = [str(word) for word in command]
    assert shutil.which(words[0]), f"{words[0]} is missing: ./dev test installs it (list of packages at the top of dev)"
    done = subprocess.run(words, capture_output=True, text=True, timeout=BUILD_LIMIT_S, env=os.environ | environment)
    assert done.returncode == 0, f"{' '.join(words)}\n{done.stdout}{done.stderr}"


@pytest.fixture(scope="module")
def subscribers(tmp_path_factory: pytest.TempPathFactory) -> dict[str, list[object]]:
    """Commands of the four examples, those in C and C++ built from an installed prefix."""
    folder = tmp_path_factory.mktemp("examples")
    for part in ("libins/core", "packaging/dds"):
        run("cmake", "--install", ROOT / "build/release" / part, "--prefix", folder / "prefix")
    for language in ("c", "cpp"):
        flags = [f"-DCMAKE_C{'XX' if language == 'cpp' else ''}_FLAGS={STRICT}", f"-DCMAKE_PREFIX_PATH={folder}/prefix"]
        run("cmake", "-G", "Ninja", "-S", EXAMPLES / f"dds_subscribe_{language}", "-B", folder / language, *flags)
        run("cmake", "--build", folder / language)
    ignored = shutil.ignore_patterns("target", "Cargo.lock")
    crate = shutil.copytree(EXAMPLES / "dds_subscribe_rust", RUST / "crate", ignore=ignored, dirs_exist_ok=True)
    run("cargo", "build", "--manifest-path", crate / "Cargo.toml", CARGO_TARGET_DIR=str(RUST), RUSTFLAGS="-Dwarnings")
    return {
        "C": [folder / "c/subscribe"],
        "C++": [folder / "cpp/subscribe"],
        "Python": [sys.executable, EXAMPLES / "dds_subscribe_python/subscribe.py"],
        "Rust": [RUST / "debug/dds-subscribe"],
    }


@contextlib.contextmanager
def vehicle(network: Namespace, states: Path, *options: str) -> Iterator[None]:
    """ins-navd in the network on the pty of an emulated board, as source "vehicle"; its states also in a file."""
    with board("default", "uart=pty", STOP_S) as (_, pty):
        command = [NATIVE, "--device", pty, "--source", "vehicle", "--json", states, *options]
        with ended(subprocess.Popen(network.inside(command), stderr=subprocess.PIPE, text=True)):
            yield


def expect_states(printed: str, states: Path) -> None:
    """Every line is a state of the daemon's file, and they are in order."""
    said = {}
    for line in states.read_text(encoding="utf-8").splitlines():
        state = json.loads(line)
        roll, pitch, yaw = state["euler_rad"]
        said[state["index"]] = f"vehicle {state['index']}: roll {roll:.6f} pitch {pitch:.6f} yaw {yaw:.6f} rad"
    lines = printed.splitlines()
    indices = [int(line.split(":")[0].split()[1]) for line in lines]
    assert len(lines) == STATES and indices == sorted(set(indices))
    assert lines == [said.get(index) for index in indices]


def hear(network: Namespace, command: list[object], **environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        network.inside(command), capture_output=True, text=True, timeout=WALL_LIMIT_S, env=os.environ | environment
    )


@pytest.mark.parametrize("language", ["C", "C++", "Python", "Rust"])
def test_an_example_hears_the_daemon_on_loopback_alone(subscribers, tmp_path, language) -> None:
    with alone() as network:
        with vehicle(network, tmp_path / "states", "--dds"):
            done = hear(network, [*subscribers[language], 0, STATES])
        assert done.returncode == 0, done.stderr
        expect_states(done.stdout, tmp_path / "states")


def test_three_stacks_hear_the_daemon_across_a_cable(subscribers, tmp_path) -> None:
    """Cyclone 0.10 and 11, RustDDS; who stays on loopback hears nothing meanwhile."""
    sub = [sys.executable, "-m", "libins", "sub"]
    with cable() as (here, there):
        stays = subprocess.Popen(there.inside(sub), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        with (
            ended(stays),
            ThreadPoolExecutor() as at_once,
            vehicle(here, tmp_path / "states", "--dds", "--dds-interface", "cable0", "--dds-peer", ADDRESSES[1]),
        ):
            python = at_once.submit(hear, there, [*subscribers["Python"], 0, STATES], CYCLONEDDS_URI=CABLE)
            rust = at_once.submit(hear, there, [*subscribers["Rust"], 0, STATES])
            asks = ["--dds-interface", "cable1", "--dds-peer", ADDRESSES[0]]
            named = hear(there, [*sub, *asks, "--limit", STATES])
            heard = [python.result(), rust.result()]
            assert stays.poll() is None, stays.communicate()[1]
            stays.terminate()
            assert stays.communicate()[0] == "", "the loopback configuration left the machine"
    for done in heard:
        assert done.returncode == 0, done.stderr
        expect_states(done.stdout, tmp_path / "states")
    assert [json.loads(line)["source"] for line in named.stdout.splitlines()] == ["vehicle"] * STATES, named.stderr


def messages(heard: list[dict], topic: str, kind: str) -> list[Any]:
    return [TYPES.deserialize_cdr(bytes.fromhex(m["cdr"]), kind) for m in heard if m.get("topic") == topic]


@pytest.mark.parametrize("joined", [False, True], ids=["loopback", "cable"])
def test_ros_topics_reach_another_stack(tmp_path, joined) -> None:
    """Fast DDS, reliable, best effort and latched, hears a node with positions and the daemon's on a board."""
    with contextlib.ExitStack() as opened:
        pair = opened.enter_context(cable()) if joined else (opened.enter_context(alone()),) * 2
        here, there = pair
        where = (
            {"JUDGE_ADDRESS": ADDRESSES[1], "JUDGE_PEER": ADDRESSES[1]} if joined else {}
        )  # it is asked, and asks nobody
        options = ["--dds-interface", "cable0", "--dds-peer", ADDRESSES[1]] if joined else []
        listeners = {
            name: opened.enter_context(judge(topics, kind, 0, there.inside, **where))
            for name, kind, topics in (
                ("reliable", "reliable", ROS),
                ("best_effort", "best_effort", ROS),
                ("latched", "latched", GRAPH),
                ("board", "reliable", BOARD),
            )
        }
        node = [PROGRAMS / "ros_publisher", 0, 2 * len(ROS), INSTANTS, *options[1::2]]
        with (
            vehicle(here, tmp_path / "states", "--ros=/board", *options),
            subprocess.Popen(
                here.inside(node), stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
            ) as publisher,
        ):
            listeners["reliable"].wait(len(ROS) * INSTANTS)
            listeners["board"].wait(STATES)
            listeners["best_effort"].wait(len(ROS) * INSTANTS // 2)
            listeners["latched"].wait(2)
            out, errors = publisher.communicate(timeout=WALL_LIMIT_S)  # closes its standard input
            assert publisher.returncode == 0, errors
        heard = {kind: listener.all() for kind, listener in listeners.items()}
    said = [json.loads(line) for line in out.splitlines()]
    times = [line["time_ns"] for line in said]
    for topic, kind in ROS.items():
        assert [stamp_ns(m) for m in messages(heard["reliable"], topic, kind)] == times, topic
        some = [stamp_ns(m) for m in messages(heard["best_effort"], topic, kind)]
        assert some == sorted(set(some)) and set(some) <= set(times), topic
    fixes = messages(heard["reliable"], "rt/car/gnss/fix", ROS["rt/car/gnss/fix"])
    assert [fix.altitude for fix in fixes] == [line["height"] for line in said]
    odometry = messages(heard["reliable"], "rt/car/odometry", ROS["rt/car/odometry"])
    assert {(m.header.frame_id, m.child_frame_id) for m in odometry} == {("odom", "base_link")}
    for imu in messages(heard["board"], *next(iter(BOARD.items()))):
        q = imu.orientation
        assert q.w**2 + q.x**2 + q.y**2 + q.z**2 == pytest.approx(1, abs=1e-12)
    infos = messages(heard["latched"], *next(iter(GRAPH.items())))
    nodes = {(n.node_namespace, n.node_name) for info in infos for n in info.node_entities_info_seq}
    assert nodes == {("/car", "libins"), ("/board", "ins_navd")}
