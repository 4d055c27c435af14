"""ins-navd on the emulated board's pty and TCP port, native and as ARM code under qemu-arm; DDS between processes."""

import contextlib
import json
import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from conftest import ROOT

pytestmark = pytest.mark.wall_clock
WALL_LIMIT_S = 60
ARM_SAMPLES = 60
NATIVE = ROOT / "build/release/python/libins/bin/ins-navd"
ARM = ROOT / "build/armel/libins/host/navd/ins-navd"
DOMAIN = 100 + os.getpid() % 100


def ins_process(*arguments: object, **keywords) -> subprocess.Popen[str]:
    command = [sys.executable, "-m", "libins", *map(str, arguments)]
    return subprocess.Popen(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE, **keywords)


@contextlib.contextmanager
def ended(process: subprocess.Popen[str]) -> Iterator[subprocess.Popen[str]]:
    """The process, ended when the block is left."""
    try:
        yield process
    finally:
        if process.poll() is None:
            process.terminate()
            try:
                process.communicate(timeout=10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.communicate()


@contextlib.contextmanager
def board(
    scenario: object, serial: str, stop_s: float, *options: object
) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """A board in real time with its UART on an endpoint; gives the endpoint's address."""
    command = ("run", scenario, "--serial", serial, "--wait", "--stop-s", stop_s, "--json", "-", *options)
    with ended(ins_process(*command)) as process:
        label = process.stderr.readline()
        address = re.match(r"uart: \w+ (\S+)", label)
        assert address, label + process.stderr.read()
        yield process, address[1]


def lines(text: str) -> list[dict]:
    return [json.loads(line) for line in text.splitlines()]


def navigate(command: list[object], scenario: object) -> list[dict]:
    """States of a daemon started on the pty of an 80 ms board."""
    with board(scenario, "uart=pty", 30) as (_, path):
        done = subprocess.run(
            [
                *map(str, command),
                "--device",
                path,
                "--period",
                "0.08",
                "--limit",
                str(ARM_SAMPLES),
                "--timeout-s",
                "10",
            ],
            capture_output=True,
            text=True,
            timeout=WALL_LIMIT_S,
        )
        assert done.returncode == 0, done.stderr
    return lines(done.stdout)


@pytest.fixture
def slow(scenario):
    """80 ms with sequence numbers: time enough for an emulated ARM host on a loaded machine."""
    return scenario("s3_paper", ("acq_s3_paper.ihx", "acq_80ms_seq.ihx"), ("sequence = false", "sequence = true"))


def test_arm_binary_gives_the_same_bits(slow):
    assert ARM.exists(), f"{ARM} is missing: cmake --preset armel && cmake --build --preset armel"
    assert shutil.which("qemu-arm"), "qemu-arm is missing: apt-get install qemu-user"
    header = (
        subprocess.run(["file", "-b", str(ARM)], capture_output=True, text=True).stdout
        if shutil.which("file")
        else "ARM"
    )
    assert "ARM" in header
    native = navigate([NATIVE], slow)
    arm = navigate(["qemu-arm", "-cpu", "arm926", ARM], slow)
    assert len(native) == len(arm) == ARM_SAMPLES
    # Each board was powered when its daemon opened the line, so both begin with the same sample.
    by_seq = {state["seq"]: state for state in native}
    assert arm[0]["seq"] == native[0]["seq"]
    for state in arm:
        twin = by_seq[state["seq"]]
        for key in ("q_nb", "dtheta_b", "w_ib_b", "t_s"):
            assert state[key] == twin[key], f"sample {state['index']}: {key}"
    assert arm[-1]["q_nb"] != arm[0]["q_nb"]


def test_tcp(scenario):
    with board("default", "uart=tcp:0", 10) as (_, address):
        host, port = address.split(":")
        done = subprocess.run(
            [str(NATIVE), "--device", f"tcp:{host}:{port}", "--limit", "100", "--timeout-s", "5"],
            capture_output=True,
            text=True,
            timeout=WALL_LIMIT_S,
        )
        assert done.returncode == 0, done.stderr
        states = lines(done.stdout)
    assert len(states) == 100
    assert [s["index"] for s in states] == sorted({s["index"] for s in states})


def test_file_takes_what_the_board_sends(ins, tmp_path):
    out = tmp_path / "uart.bin"
    done = ins("run", "default", "--serial", f"uart=file:{out}", "--speed", "max", "--stop-s", 1)
    assert done.returncode in (0, 1), done.stderr
    assert out.read_bytes()[:1] == b"\xaa", "nobody answers, so the board keeps asking"
    assert set(out.read_bytes()) == {0xAA}


def test_line_unplugged_and_plugged_again(tmp_path):
    """The pty goes away with its board; a new board appears at the same path; the daemon goes on."""
    link = tmp_path / "ttyBOARD"
    command = [str(NATIVE), "--device", str(link), "--wait", "--timeout-s", "20", "--json", str(tmp_path / "out.jsonl")]
    with ended(subprocess.Popen(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)) as navd:
        counts = []
        for _ in range(2):
            with board("default", f"uart=pty:{link}", 20):
                before = counts[-1] if counts else 0
                deadline = time.monotonic() + 15
                while time.monotonic() < deadline:
                    text = (tmp_path / "out.jsonl").read_text() if (tmp_path / "out.jsonl").exists() else ""
                    if text.count("\n") > before + 30:
                        break
                    time.sleep(0.05)
                counts.append(text.count("\n"))
        assert counts[0] > 30
        assert counts[1] > counts[0] + 30
        assert navd.poll() is None


def test_run_publishes_over_dds_to_another_process():
    with ended(ins_process("sub", "--domain", DOMAIN, "--limit", 50, "--timeout-s", 20)) as subscriber:
        time.sleep(1.0)
        with ended(ins_process("run", "default", "--dds", "--domain", DOMAIN, "--speed", 5, "--stop-s", 12)) as run:
            out, err = subscriber.communicate(timeout=WALL_LIMIT_S)
            assert subscriber.returncode == 0, err
            run_out, run_err = run.communicate(timeout=WALL_LIMIT_S)
            assert run.returncode == 0, run_out + run_err
    states = lines(out)
    assert len(states) == 50
    assert {s["source"] for s in states} == {"default"}
    indices = [s["index"] for s in states]
    assert indices == list(range(indices[0], indices[0] + 50)), "reliable, in order, none missing"
    for s in states:
        assert sum(q * q for q in s["q_nb"]) == pytest.approx(1.0, abs=1e-12)


def test_sub_says_when_nothing_comes(ins):
    done = ins("sub", "--domain", DOMAIN + 1, "--timeout-s", 0.5)
    assert done.returncode == 1
    assert f"domain {DOMAIN + 1}" in done.stderr


def test_demo_in_real_time(tmp_path):
    command = [
        sys.executable,
        "-m",
        "libins.demo",
        "--seconds",
        "6",
        "--domain",
        str(DOMAIN + 2),
        "--folder",
        str(tmp_path),
    ]
    done = subprocess.run(command, capture_output=True, text=True, timeout=WALL_LIMIT_S)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "verdict   pass" in done.stdout
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "<svg" in page
    assert "estimate - truth [mrad]" in page


def test_demo_fast_is_deterministic(tmp_path):
    pages = []
    for name in ("a", "b"):
        command = [sys.executable, "-m", "libins.demo", "--fast", "--seconds", "8", "--folder", str(tmp_path / name)]
        done = subprocess.run(command, capture_output=True, text=True, timeout=WALL_LIMIT_S)
        assert done.returncode == 0, done.stdout + done.stderr
        pages.append(Path(tmp_path / name / "report.html").read_bytes())
    assert pages[0] == pages[1]
