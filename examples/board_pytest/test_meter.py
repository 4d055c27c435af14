"""Tests of meter.c on the emulated board. SDCC builds the image beside this file: make, then pytest."""

import re

import pytest

FIRMWARE = "meter.ihx"
READING = re.compile(rb"AIN(\d) (\d+) mV\r\n")
pytestmark = pytest.mark.board(firmware=FIRMWARE, boot=b"READY\r\n", strict=True)


@pytest.mark.parametrize("volts", [0.0, 1.25, 2.5, 4.999])
def test_reading_within_one_step(board, volts):
    board.volts[3] = volts
    board.send(b"3?")
    reading = board.expect(READING, within_s=0.05)
    assert reading[1] == b"3"
    assert int(reading[2]) == pytest.approx(1000 * volts, abs=5000 / 4096)


def test_lamp_shows_the_limit_exceeded(board):
    board.variables["limit_mv"] = 3000
    for volts, dark in ((2.9, True), (3.1, False), (2.9, True)):
        board.volts[0] = volts
        board.send(b"?")
        board.expect(READING, within_s=0.05)
        assert board.pin("P2.0") is dark


def test_key_says_so_once_a_press(board):
    for _ in range(3):
        board.pins["P3.2"] = False
        board.expect(b"KEY\r\n", within_s=0.01)
        board.pins["P3.2"] = None
        board.run_for(0.01)
    assert board.unread == b""


def test_ready_after_any_reset(board):
    board.send(b"?")
    board.run_for(0.005)  # in the middle of a reading
    board.reset()
    board.expect(b"READY\r\n", within_s=0.3)


def test_a_reading_begins_within_six_milliseconds(board):
    board.send(b"?")
    board.run_to("measure", within_s=0.002)
    board.expect(b"A", within_s=0.006)
