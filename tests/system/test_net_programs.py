"""Whatever a program of a net is or does, the run says who, when and what to do, and no process is left."""

import os
import signal
import struct
import subprocess
import sys
import textwrap
import threading
import time
from pathlib import Path

import pytest
from net_kit import ECHO, GREETING, MS, PS_PER_S, echo_net, go

from libins import _run

PATIENCE_S = 1.0
"""Of wall clock, where a program hangs on purpose."""
GONE_MOST_S = 20.0
"""By then a process whose run was killed is gone; it looks twice a second."""
VERSION = 1
HELLO = b"\0F28W" + VERSION.to_bytes(4, "little") + bytes([64, 3]) + b"bad"
OTHER = HELLO.replace(bytes([VERSION, 0]), bytes([VERSION + 1, 0]), 1)
READY = b"\x09"
LATE = b"\x0a" + struct.pack("<qqB", PS_PER_S * 1000, PS_PER_S * 1000 + 1, 0) + bytes(10)

SCRIPT = """\
#!{python}
import os, signal, socket, struct, sys, time
run = socket.socket(fileno=3)
print("about to misbehave", file=sys.stderr, flush=True)
{greet}
kind = None
while kind != {kind}:
    message = run.recv(65536)
    if not message:
        sys.exit(0)
    kind = message[0]
    if kind != {kind}:
        run.send({ready!r})
{then}
"""
START, RUN = 1, 3


@pytest.fixture
def bad(tmp_path: Path):
    """A program that greets, answers until a message of that kind comes, and then does something else."""

    def make(then: str, greet: str = f"run.send({HELLO!r})", kind: int = RUN) -> str:
        path = tmp_path / "bad.f2812"
        path.write_text(SCRIPT.format(python=sys.executable, greet=greet, kind=kind, ready=READY, then=then))
        path.chmod(0o755)
        return str(path)

    return make


def alive(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except FileNotFoundError:
        return False


def children() -> set[int]:
    return {int(pid) for pid in Path(f"/proc/{os.getpid()}/task/{os.getpid()}/children").read_text().split()}


def gone(pid: int) -> bool:
    end = time.monotonic() + GONE_MOST_S
    while alive(pid) and time.monotonic() < end:
        time.sleep(0.05)
    return not alive(pid)


def refused(program: str) -> str:
    before = children()
    with pytest.raises(_run.ProgramError) as error:
        _run.Net(1).f2812("dsp", program)
    assert children() == before, "a process is left"
    text = str(error.value)
    assert text.startswith(f"station dsp, program {program}, at 0.000000000 s: ")
    return text


def test_what_is_no_program_is_refused(tmp_path):
    path = tmp_path / "x.f2812"
    assert "no such file; build it" in refused(str(path))
    path.write_bytes(b"\0\1\2\3 no program")
    assert "chmod +x" in refused(str(path))
    path.chmod(0o755)
    assert "no program for this machine; add_f2812_firmware() and f2812-cc make board programs" in refused(str(path))
    assert "chmod +x" in refused(str(tmp_path))
    head = b"\x7fELF\x01\x01\x01" + bytes(9) + (2).to_bytes(2, "little") + (8).to_bytes(2, "little")
    path.write_bytes(head + bytes(100))
    assert "runs no 32-bit programs; build the firmware with BITS 64" in refused(str(path))
    assert "ended with status 0 and did not greet: it is no board program" in refused("/bin/true")


@pytest.mark.parametrize(
    ("greet", "text"),
    [
        ("run.send(b'hello')", "it is no board program: it does not greet as one"),
        (f"run.send({OTHER!r})", "version 2 of the link, this libins version 1; build it again"),
        ("sys.exit(7)", "ended with status 7 and did not greet"),
        ("run.close(); time.sleep(1000)", "closed its socket and went on"),
        (f"run.send({HELLO[:-1]!r})", "13 octets that are no message"),
    ],
)
def test_a_program_that_greets_otherwise_is_refused(bad, greet, text):
    assert text in refused(bad("", greet))


@pytest.mark.parametrize(
    ("then", "text"),
    [
        ("os.kill(os.getpid(), signal.SIGSEGV)", "ended by signal 11 (Segmentation fault)"),
        ("sys.exit(3)", "ended by itself with status 3"),
        ("run.send(b'garbage'); time.sleep(1000)", "7 octets that are no message"),
        ("run.send(b'\\x0a' + bytes(64000)); time.sleep(1000)", "octets that are no message"),
        (f"run.send({READY!r}); time.sleep(1000)", "a window was answered by a message of kind 9"),
        ("run.send(b'\\x10\\x02no'); time.sleep(1000)", "kind 16: no"),
        (f"run.send({LATE!r}); time.sleep(1000)", "outside itself"),
        ("run.send(b'\\x0d\\x01\\0' + struct.pack('<qBB', 5, 9, 1)); time.sleep(1000)", "a wire that nobody looks at"),
        ("time.sleep(1000)", "no answer for 1 s of wall clock"),
    ],
)
def test_a_program_that_fails_in_a_run_ends_it_and_says_so(bad, then, text):
    before = children()
    program = bad(then)
    net = echo_net(1, program)
    net.set_patience(PATIENCE_S)
    with pytest.raises(_run.ProgramError) as error:
        net.until(PS_PER_S)
    assert text in str(error.value)
    assert "dsp" in str(error.value)
    with pytest.raises(_run.ProgramError):
        net.until(PS_PER_S)
    del net
    assert children() == before


def test_an_error_says_when_and_what_the_program_wrote(bad):
    program = bad("os.kill(os.getpid(), signal.SIGKILL)")
    net = echo_net(1, program)
    with pytest.raises(_run.ProgramError) as error:
        net.until(PS_PER_S)
    assert f"station dsp, program {program}, at 0.000000000 s: it was ended by signal 9" in str(error.value)
    assert str(error.value).endswith("it wrote: about to misbehave")


def test_a_program_that_is_killed_in_the_middle_is_reported_at_its_time():
    net = echo_net()
    go(net, 0.25)
    os.kill(net.firmware("dsp")[2], signal.SIGKILL)
    with pytest.raises(_run.ProgramError, match=r"station dsp, program .*echo.f2812, at 0.250000000 s: .*signal 9"):
        net.until(PS_PER_S)


def test_no_process_outlives_its_net():
    before = children()
    nets = [echo_net(seed) for seed in range(3)]
    pids = {net.firmware("dsp")[2] for net in nets}
    assert pids == children() - before
    go(nets[0], 0.1)
    nets.clear()
    assert children() == before and not any(alive(pid) for pid in pids)


@pytest.mark.parametrize("running", [False, True])
def test_no_process_outlives_a_run_that_is_killed(running):
    code = f"""
    from libins import _run
    net = _run.Net(1)
    net.f2812("dsp", {ECHO!r})
    print(net.firmware("dsp")[2], flush=True)
    {"net.until(10**18)" if running else "import time; time.sleep(1000)"}
    """
    run = subprocess.Popen([sys.executable, "-c", textwrap.dedent(code)], stdout=subprocess.PIPE, text=True)
    assert run.stdout is not None
    pid = int(run.stdout.readline())
    assert alive(pid)
    run.kill()
    run.wait()
    run.stdout.close()
    assert gone(pid), pid


def test_a_net_lives_on_when_the_thread_that_made_it_has_ended():
    made = []
    thread = threading.Thread(target=lambda: made.append(echo_net()))
    thread.start()
    thread.join()
    go(made[0], 0.1)
    assert made[0].take_octets("pc") == GREETING


def test_interrupting_the_run_leaves_its_programs_to_it():
    net = echo_net()
    os.kill(net.firmware("dsp")[2], signal.SIGINT)
    go(net, 0.1)
    assert net.take_octets("pc") == GREETING


def test_a_switch_and_a_crystal_reach_the_program():
    net = _run.Net(1)
    net.f2812("dsp", ECHO, oscclk_hz=20_000_000)
    net.host("pc", 9600 * 2 / 3)
    net.line("dsp.SCIA", "pc", 9600 * 2 / 3)
    go(net, 0.1)
    assert net.take_octets("pc") == GREETING, "two thirds of the crystal, two thirds of the baud"
    assert net.firmware("dsp")[:2] == ("echo", 32)
    assert net.ended("dsp") == ""
    assert net.now_ps == 100 * MS
