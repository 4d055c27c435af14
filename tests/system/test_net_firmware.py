"""Firmware of a net that is compiled here: what is told of reads that take, and firmware that never comes back."""

import subprocess
import sys
import textwrap
from collections.abc import Callable
from pathlib import Path

import pytest
from net_kit import MS, PS_PER_S, go
from test_net_programs import PATIENCE_S, alive, children, gone

from libins import _run

ROOT = Path(__file__).resolve().parents[2]
F2812_CC = ROOT / "emu/f2812_sci/f2812-cc"
RUNTIME = ROOT / "build/release/f2812"
SOURCES = ROOT / "tests/data/f2812/net"
BAUD = 30e6 / 2 / 4 / 8 / 49
"""Of drain.c."""


@pytest.fixture
def firmware(tmp_path: Path) -> Callable[[str], str]:
    def compiled(name: str) -> str:
        out = tmp_path / f"{name}.f2812"
        subprocess.run([F2812_CC, "--lib", RUNTIME, SOURCES / f"{name}.c", "-o", out], check=True)
        return str(out)

    return compiled


def test_each_character_that_is_taken_is_told_and_each_look_once(firmware):
    net = _run.Net(1)
    net.f2812("dsp", firmware("drain"))
    net.host("pc", BAUD)
    net.line("dsp.SCIA", "pc", BAUD)
    net.record("dsp", True, True)
    go(net, 0.01)
    net.send("pc", b"\x21" * 8)
    go(net, 0.03)
    assert net.take_octets("pc") == bytes([0x21 * 4 & 0xFF, 0x21 * 8 & 0xFF])
    rxbuf, _ = _run.f2812_register("SCIRXBUFA")
    ffrx, _ = _run.f2812_register("SCIFFRXA")
    records = net.take_records("dsp").tolist()
    assert [value for _, what, address, value in records if (what, address) == (0, rxbuf)] == [0x21] * 8
    levels = [value >> 8 & 31 for _, what, address, value in records if (what, address) == (0, ffrx)]
    assert levels == [0, 1, 2, 3, 4] * 2 + [0], "not one for each turn of the loop"
    net.set_break("dsp", "SCIRXBUFA", "read")
    net.send("pc", b"\x21" * 4)
    stops = 0
    while not net.until(60 * MS):
        stops += 1
    assert stops == 1, "it stops where an interrupt could come, which is after the four"


def test_firmware_that_does_not_come_back_is_found(firmware):
    program = firmware("stuck")
    before = children()
    net = _run.Net(1)
    net.f2812("dsp", program)
    net.set_patience(PATIENCE_S)
    with pytest.raises(
        _run.ProgramError, match=r"station dsp, .*stuck.f2812, at 0.0.* s: no answer for 1 s.*patience_s"
    ):
        net.until(PS_PER_S)
    assert children() == before


def test_nor_does_it_outlive_a_run_that_is_killed(firmware):
    code = f"""
    from libins import _run
    net = _run.Net(1)
    net.f2812("dsp", {firmware("stuck")!r})
    print(net.firmware("dsp")[2], flush=True)
    net.until(10**18)
    """
    run = subprocess.Popen([sys.executable, "-c", textwrap.dedent(code)], stdout=subprocess.PIPE, text=True)
    assert run.stdout is not None
    pid = int(run.stdout.readline())
    assert alive(pid)
    run.kill()
    run.wait()
    run.stdout.close()
    assert gone(pid), pid
