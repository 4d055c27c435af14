"""[[analog]]: volts on the inputs of one converter and of two, as firmware built by SDCC reads them."""

import math
import struct
from pathlib import Path

import pytest
from libins.board import Board
from libins.errors import UsageError
from sdcc_kit import build

SCAN = Path(__file__).resolve().parents[1] / "emu_8051/board/scan_six.c"
LSB_V = 5 / 4096
STILL = """schema = 1
board = "{board}"
firmware = "{image}"
stop_s = 1.0
[motion]
kind = "still"
"""
SIGNALS = """
[[analog]]
channel = 0
volts = 1.25
[[analog]]
channel = 1
volts = 2.5
amplitude_v = 2.0
frequency_hz = 3.0
phase_rad = 0.7
[[analog]]
channel = 4
volts = 1.0
csv = "volts.csv"
[[analog]]
channel = 5
volts = 4.75
"""


@pytest.mark.parametrize(("board", "flags"), [("8051_tlc2543", ()), ("8051_tlc2543_six", ("-DTWO",))])
def test_firmware_reads_the_volts(tmp_path, board, flags):
    image = build(SCAN, tmp_path, "--debug", "--iram-size", "128", *flags)
    path = tmp_path / "six.toml"
    path.write_text(STILL.format(board=board, image=image) + SIGNALS, encoding="utf-8")
    (tmp_path / "volts.csv").write_text("t_s,volts\n0.1,0\n0.2,2\n0.4,-0.5\n", encoding="utf-8")
    it = Board(path)
    for t in (0.05, 0.15, 0.3, 0.5):
        it.run_until(t)
        file_v = {0.05: 0.0, 0.15: 1.0, 0.3: 0.75, 0.5: -0.5}[t]
        # Rest: the gyros' null, and what a converter without a gyro reads.
        want = {0: 1.25, 1: 2.5 + 2 * math.sin(6 * math.pi * t + 0.7), 2: 2.5, 3: 0.0, 4: 1 + file_v, 5: 4.75}
        codes = struct.unpack("<6H", it.variables["codes"])
        for channel, volts in want.items():
            # The last scan is at most 5 ms old, in which the fastest signal moves 40 V/s.
            assert codes[channel] * LSB_V == pytest.approx(volts, abs=0.2 if channel in (1, 4) else LSB_V), (t, channel)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[[analog]]\nvolts = 1.0\n", "channel: is missing"),
        ("[[analog]]\nchannel = 0\n[[analog]]\nchannel = 0\n", "found 0 again"),
        ('[[analog]]\nchannel = 0\ncsv = "none.csv"\n', "no such file"),
        ('[[analog]]\nchannel = 0\ncsv = "bad.csv"\n', "bad.csv:1: found 't,v'"),
        ('[[analog]]\nchannel = 0\ncsv = "one.csv"\n', "at least 2"),
    ],
)
def test_what_cannot_be_is_said(tmp_path, text, words):
    path = tmp_path / "bad.toml"
    path.write_text(STILL.format(board="8051_tlc2543", image="acq_default.ihx") + text, encoding="utf-8")
    (tmp_path / "bad.csv").write_text("t,v\n0,0\n1,0\n", encoding="utf-8")
    (tmp_path / "one.csv").write_text("t_s,volts\n0,0\n", encoding="utf-8")
    with pytest.raises(UsageError, match=words):
        Board(path)
