"""libins.board.Board: firmware built by SDCC, played with from outside as on the desk."""

import re
from pathlib import Path

import pytest
from libins.board import Board, ExpectError
from libins.errors import UsageError
from sdcc_kit import build

METER = Path(__file__).resolve().parents[2] / "examples/board_pytest/meter.c"
CYCLE_S = 12 / 11_059_200
OCTET_S = 10 / 9600
LSB_MV = 5000 / 4096


@pytest.fixture(scope="module")
def image(tmp_path_factory) -> Path:
    return build(METER, tmp_path_factory.mktemp("meter"), "--debug", "--iram-size", "128")


@pytest.fixture
def board(image: Path) -> Board:
    board = Board(firmware=image)
    board.expect(b"READY\r\n", within_s=0.5)
    return board


def test_expect_stops_at_the_octet_that_completes_it(image):
    board = Board(firmware=image)
    match = board.expect(re.compile(rb"RE(.)D"), within_s=0.5)
    assert match[1] == b"A"
    ready_s = board.now_s
    assert board.received[-1].value == ord("D")
    assert 0 <= ready_s - board.received[-1].at_ps * 1e-12 < 4 * CYCLE_S
    # Self-test of 250 ms, then four octets; the decision falls at 9/16 of the stop bit.
    assert ready_s == pytest.approx(0.250 + 4 * OCTET_S, abs=0.01)
    board.expect(b"Y\r\n", within_s=4 * OCTET_S)
    assert board.unread == b""


def test_what_came_before_counts_once(board):
    board.send(b"??")
    board.run_for(0.1)
    for _ in range(2):
        now = board.now_s
        board.expect(b"AIN0 2500 mV\r\n", within_s=0)
        assert board.now_s == now
    with pytest.raises(ExpectError):
        board.expect(b"AIN0", within_s=0)


def test_the_text_of_a_failure(board):
    board.send(b"7?")
    with pytest.raises(ExpectError) as failed:
        board.expect(re.compile(rb"AIN7 9\d+"), within_s=0.1)
    first, second, third = str(failed.value).splitlines()
    assert re.fullmatch(
        r"b'AIN7 9\\\\d\+' did not come from 0\.2\d+ s to 0\.3\d+ s; pc 0x[0-9a-f]{4} in \w+\(\) meter\.c:\d+", first
    )
    assert second == "came instead, 14 octets:"
    assert third.endswith("b'AIN7 0000 mV\\r\\n'")
    at_s = float(third.split()[0])
    octet = next(octet for octet in board.received if octet.value == ord("A") and octet.at_ps > 0.265e12)
    assert at_s == pytest.approx(octet.at_ps * 1e-12, abs=1e-6)
    with pytest.raises(ExpectError, match=r"nothing came; the last octet came at 0\.\d+ s"):
        board.expect(b"AIN7 0000 mV\r\n", within_s=0) and board.expect(b"more", within_s=0.01)


def test_the_wrong_baud_is_hinted_at(image):
    board = Board(firmware=image, link={"baud": 19200})
    with pytest.raises(ExpectError, match=r"had no stop bit: is the board's line at 19200 Bd\?"):
        board.expect(b"READY", within_s=0.5)


def test_pins_both_ways(board):
    assert board.pin("P2.0") and board.pins["P3.2"]
    board.pins["P3.2"] = False
    assert not board.pin("P3.2")
    board.expect(b"KEY\r\n", within_s=0.01)
    board.pins["P3.2"] = None
    assert board.pin("P3.2")
    board.run_for(0.01)
    assert board.unread == b"", "once a press"
    board.pins["P1.4"] = False  # on a net: the converter is selected, the CPU's 1 is weak
    assert not board.pin("P1.4")
    board.pins["P1.4"] = None
    assert board.pin("P1.4")


def test_variables_by_their_c_names(board):
    assert board.variables["limit_mv"] == 4000 and board.variables["measured"] == 0
    board.variables["limit_mv"] = 2499
    board.send(b"?")
    board.expect(b"2500 mV\r\n")
    assert not board.pin("P2.0"), "2500 mV is above the limit now"
    assert board.variables["measured"] == 1
    address = board.symbols.find("measured").address
    assert board.iram[address : address + 2] == b"\x01\x00"
    board.iram[address] = 0x34
    assert board.variables["measured"] == 0x34


def test_run_to_a_function_and_until_a_condition(board):
    board.send(b"?")
    board.run_to("measure", within_s=0.01)
    assert board.pc == board.symbols.function("measure").begin
    assert "in measure()" in board.where()
    board.run_until(lambda: board.variables["measured"] == 1, within_s=0.1)
    assert board.variables["measured"] == 1
    board.run_until(1.0)
    assert board.now_s == pytest.approx(1.0, abs=4 * CYCLE_S)
    with pytest.raises(TimeoutError, match="measure was not reached within 0.01 s"):
        board.run_to("measure", within_s=0.01)
    with pytest.raises(TimeoutError, match="did not hold within 0.01 s"):
        board.run_until(lambda: False, within_s=0.01)


def test_reset_and_power(board):
    board.variables["measured"] = 7
    board.reset()
    board.expect(b"READY\r\n", within_s=0.5)
    assert board.variables["measured"] == 0, "SDCC's start-up clears it"
    board.sfr["PCON"] = board.sfr["PCON"] & ~0x10
    board.reset(power_on=True)
    assert board.sfr["PCON"] & 0x10, "power-off flag"


def test_motion_is_what_the_gyros_feel(board):
    board.motion = {"kind": "constant_rate", "rate_rad_s": [0.5, 0.0, 0.0]}
    board.send(b"?")
    mv = int(board.expect(re.compile(rb"AIN0 (\d+) mV"))[1])
    assert mv == pytest.approx(2500 + 0.5 * 5000 / 3.14159265, abs=LSB_MV)  # 5 / pi V/(rad/s)
    with pytest.raises(UsageError, match="motion.kind: found 'wobble'"):
        board.motion = {"kind": "wobble"}


def test_the_same_calls_give_the_same_cycles(image):
    def play() -> tuple:
        board = Board(firmware=image, seed=3, link={"octet_loss": 0.05, "bit_error": 1e-4})
        for _ in range(20):
            board.send(b"?")
            board.run_for(0.02)
        return board.cycles, board.received, board.iram[:]

    assert play() == play()


def test_another_image_and_the_52(image, tmp_path):
    board = Board(firmware=image, part="at89s52", xdata_octets=1024)
    board.expect(b"READY\r\n", within_s=0.5)
    board.iram[0xFF] = 1
    board.xdata[0x3FF] = 2
    assert (board.iram[0xFF], board.xdata[0x3FF], len(board.iram), len(board.xdata)) == (1, 2, 256, 1024)
    blank = tmp_path / "loop.ihx"
    blank.write_text(":0200000080FE80\n:00000001FF\n", encoding="ascii")
    board.load(blank)
    assert board.now_s == 0 and board.code[0:2] == b"\x80\xfe"
    board.run_for(0.1)
    assert board.pc == 0 and board.received == []


def test_the_navigator_of_a_scenario_may_play_the_host():
    board = Board("default", navigator=True)
    board.run_for(1.0)
    states = board.states()
    assert len(states) > 40
    assert len(board.received) >= 10 * len(states) * 0.8, "what the board sent is seen as well"


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda image: Board(), "firmware= or a scenario"),
        (lambda image: Board(firmware="no.ihx"), "Board: firmware: found 'no.ihx'"),
        (lambda image: Board(firmware=image, link={"bawd": 1}), "Board: link.bawd: unknown key"),
        (lambda image: Board(firmware=image, clock_hz="fast"), "Board: clock_hz: found 'fast'"),
        (lambda image: Board(firmware=image, part="at89c2051"), "'at89s52'"),
        (lambda image: Board(firmware=image, code_octets=100), "less than the flash"),
        (lambda image: Board(firmware=image).pins["P4.0"], "P0.0 to P3.7"),
        (lambda image: Board(firmware=image).sfr["TMODE"], "did you mean TMOD"),
        (lambda image: Board(firmware=image).iram[128], "128 octets of iram"),
        (lambda image: Board(firmware=image).xdata[0], "0 octets of xdata"),
        (lambda image: Board(firmware=image).variables["volts"], "no variable volts"),
        (lambda image: Board(firmware=image).volts.__setitem__(11, 1.0), "AIN0 to AIN10"),
        (lambda image: Board(firmware=image).run_for(-1), "run_for(-1)"),
        (lambda image: Board("default").variables["sampled"], "sdcc --debug"),
    ],
)
def test_what_cannot_be_is_said(image, make, words):
    with pytest.raises(UsageError, match=re.escape(words)):
        make(image)
