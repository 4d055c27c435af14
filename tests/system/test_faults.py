"""Each declared fault, seen where it would be on the desk: by a voltmeter's firmware, its serial line and its pins."""

import os
import re
import statistics
from pathlib import Path

import pytest
from libins.board import Board, ExpectError
from libins.board_views import sfr_address
from libins.run import PS_PER_S
from sdcc_kit import build

METER = Path(__file__).resolve().parents[2] / "examples/board_pytest/meter.c"
READINGS = 2000 if "INS_BENCH" in os.environ else 300
CYCLE_S = 12 / 11_059_200
ANSWER_S = 0.05
CLOCK_IN_CONVERSION = "I/O CLOCK during a conversion"


@pytest.fixture(scope="module")
def image(tmp_path_factory) -> Path:
    return build(METER, tmp_path_factory.mktemp("meter"), "--debug", "--iram-size", "128")


@pytest.fixture
def board(image) -> Board:
    """It has said READY, with 2.5 V on its first two inputs."""
    board = Board(firmware=image)
    board.expect(b"READY\r\n", within_s=0.5)
    board.volts[0] = board.volts[1] = 2.5
    return board


def read_mv(board: Board) -> int:
    board.send(b"?")
    return int(board.expect(re.compile(rb"AIN\d (\d+) mV\r\n"), within_s=ANSWER_S)[1])


def silent(board: Board) -> bool:
    board.send(b"?")
    try:
        board.expect(b"mV\r\n", within_s=ANSWER_S)
    except ExpectError:
        return True
    return False


def told(board: Board) -> str:
    return " ".join(report["text"] for report in board.reports)


@pytest.mark.parametrize(
    ("kind", "keys", "mv"),
    [
        ("adc_stuck", {"bit": 11, "value": 0}, 0),
        ("adc_stuck", {"bit": 0, "value": 1}, 2501),
        ("adc_flip", {"bit": 4, "probability": 1.0}, 2520),
        ("adc_offset", {"lsb": 100}, 2622),
        ("adc_offset", {"lsb": -4000}, 0),
        ("volts_stuck", {"volts": 1.0}, 1000),
        ("volts_offset", {"volts": 0.5}, 3000),
        ("wire_cut", {"net": "DATA OUT"}, 4999),
        ("wire_cut", {"net": "P1.4"}, 4999),
        ("wire_short", {"net": "DATA OUT", "to": "gnd"}, 0),
        ("wire_short", {"net": "DATA OUT", "to": "vcc"}, 4999),
        ("wire_short", {"net": "P1.3", "to": "I/O CLOCK"}, 0),
    ],
)
def test_a_reading_is_wrong_while_it_lasts(board, kind, keys, mv):
    start = board.now_s
    board.faults.add(kind, from_s=start + 0.1, to_s=start + 0.2, **keys)
    assert read_mv(board) == 2500
    board.run_until(start + 0.11)
    read_mv(board)  # the first conversion of a fault that garbles the command may be another input's
    assert read_mv(board) == mv
    board.run_until(start + 0.21)
    read_mv(board)
    assert read_mv(board) == 2500
    ((name, hits),) = board.faults.hits()
    assert name == kind and hits > 0


def test_a_fault_of_one_channel_leaves_the_others(board):
    board.faults.add("adc_offset", channel=1, lsb=100)
    assert read_mv(board) == 2500
    board.send(b"1")
    assert read_mv(board) == 2622


@pytest.mark.parametrize(("kind", "keys"), [("adc_noise", {"lsb": 16.0}), ("volts_noise", {"volts": 16 * 5 / 4096})])
def test_noise_has_the_spread_it_says(board, kind, keys):
    board.faults.add(kind, **keys)
    readings = [read_mv(board) * 4096 / 5000 for _ in range(READINGS)]
    assert abs(statistics.mean(readings) - 2048) < 5 * 16 / READINGS**0.5
    assert abs(statistics.stdev(readings) - 16) < 5 * 16 / (2 * READINGS) ** 0.5
    assert len({round(reading) for reading in readings}) > 20


def test_a_noisy_bit_is_wrong_as_often_as_it_says(board):
    board.faults.add("adc_flip", bit=4, probability=0.3)
    wrong = [read_mv(board) for _ in range(READINGS)].count(2520)
    assert abs(wrong / READINGS - 0.3) < 5 * (0.3 * 0.7 / READINGS) ** 0.5
    ((_, hits),) = board.faults.hits()
    assert hits > wrong  # two conversions a reading, of which the first is thrown away


def test_a_late_end_of_conversion_delays_the_answer_by_so_much(board):
    def answered_s() -> float:
        asked = board.now_ps
        board.send(b"?")
        board.expect(b"A", within_s=ANSWER_S)
        at = board.received[-1].at_ps - asked
        board.expect(b"mV\r\n", within_s=ANSWER_S)
        return at / PS_PER_S

    prompt = answered_s()
    board.faults.add("eoc_late", delay_s=5e-3)
    assert answered_s() - prompt == pytest.approx(5e-3, abs=4 * CYCLE_S)
    assert told(board) == ""


@pytest.mark.parametrize("keys", [{"kind": "eoc_missing"}, {"kind": "wire_cut", "net": "EOC"}])
def test_without_eoc_the_firmware_clocks_into_a_conversion(image, keys):
    board = Board(firmware=image, trace=True)
    board.expect(b"READY\r\n", within_s=0.5)
    board.faults.add("eoc_late", delay_s=1e-4)
    assert read_mv(board) == 2500 and told(board) == ""
    assert len(edges_of(board, "EOC")) == 4
    board.faults.add(**keys)
    assert not silent(board)
    assert CLOCK_IN_CONVERSION in told(board)
    assert bool(len(edges_of(board, "EOC"))) == (keys["kind"] == "wire_cut")  # the converter's own end still moves


def edges_of(board: Board, wire: str):
    from libins import _run

    edges = board.edges()
    return edges[edges[:, 1] == _run.WIRES.index(wire)]


def test_an_eoc_held_low_hangs_the_firmware_until_it_is_mended(board):
    board.faults.add("wire_short", net="EOC", to="gnd", to_s=board.now_s + 0.2)
    assert silent(board) and not board.pin("P1.0")
    board.expect(b"AIN0 2500 mV\r\n", within_s=0.3)


def test_a_supply_wins_over_a_pin_and_two_pins_are_one(board):
    board.faults.add("wire_short", net="P2.0", to="vcc", to_s=board.now_s + 0.1)
    board.volts[0] = 4.5
    assert read_mv(board) == 4500 and board.pin("P2.0")  # the firmware has put the lamp on, and it stays off
    board.run_for(0.1)
    assert not board.pin("P2.0")
    board.faults.add("wire_short", net="P3.2", to="P2.0")
    board.expect(b"KEY\r\n", within_s=ANSWER_S)  # the lamp's low level presses the key
    board.volts[0] = 2.5
    read_mv(board)
    assert board.pin("P2.0") and board.pin("P3.2")
    board.pins["P3.2"] = False
    board.run_for(1e-3)
    assert not board.pin("P2.0")


def test_a_cut_line_and_a_break(board):
    start = board.now_s
    board.faults.add("wire_cut", net="TXD", to_s=start + 0.1)
    assert silent(board)
    board.run_until(start + 0.15)
    assert read_mv(board) == 2500
    before = len(board.received)
    board.faults.add("break", line="to_host", to_s=board.now_s + 0.1)
    board.run_for(0.15)
    (octet,) = board.received[before:]
    assert octet.value == 0 and not octet.framing_ok
    board.faults.add("break", line="to_board", to_s=board.now_s + 0.1)
    board.run_for(1e-3)
    assert silent(board) and not board.pin("P3.0")
    board.run_for(0.1)
    assert read_mv(board) == 2500


def test_a_host_whose_baud_is_off(board):
    board.faults.add("baud", ppm=20_000, to_s=board.now_s + 0.1)
    assert read_mv(board) == 2500
    board.run_for(0.1)
    board.faults.add("baud", ppm=-70_000, to_s=board.now_s + 0.1)
    assert silent(board)
    board.run_for(0.1)
    assert read_mv(board) == 2500


def test_a_crystal_that_is_off_and_drifts(image):
    nominal = Board(firmware=image)
    nominal.run_for(2.0)
    off = Board(firmware=image, fault=[{"kind": "crystal", "ppm": 10_000}])
    off.run_for(2.0)
    assert off.cycles / nominal.cycles == pytest.approx(1.01, abs=1e-5)
    assert off.received[0].at_ps / nominal.received[0].at_ps == pytest.approx(1 / 1.01, abs=1e-4)
    drifts = Board(firmware=image, fault=[{"kind": "crystal", "drift_ppm_s": 1000, "from_s": 1.0, "to_s": 1.5}])
    drifts.run_for(2.0)
    late = 0.5 * 1000e-6 * 0.5**2 * 921_600  # cycles too many: half of drift times time squared
    assert drifts.cycles - nominal.cycles == pytest.approx(late, rel=0.03)


def test_resets_by_pin_and_by_power(board):
    board.iram[0x7F] = 0x5A
    start = board.now_s
    board.sfr["PCON"] = 0
    board.faults.add("reset", at_s=start + 0.001, for_s=1e-3)
    board.run_until(start + 0.0015)
    assert board.pc == 0 and board.pin("P1.4")  # held, its pins high
    board.run_until(start + 0.002 + 5 * CYCLE_S)
    assert board.iram[0x7F] == 0x5A and not board.sfr["PCON"] & 0x10
    board.expect(b"READY\r\n", within_s=0.5)
    board.iram[0x7F] = 0x5A
    start = board.now_s
    board.faults.add("brown_out", for_s=1e-3)
    board.run_until(start + 0.001 + 5 * CYCLE_S)
    assert board.sfr["PCON"] & 0x10 and len(set(board.iram[0x40:0x80])) > 20
    board.expect(b"READY\r\n", within_s=0.5)
    board.iram[0x7F] = 0x5A
    start = board.now_s
    board.faults.add("power", for_s=1e-3)
    board.run_until(start + 0.001 + 5 * CYCLE_S)
    assert board.sfr["PCON"] & 0x10 and board.iram[0x7F] == 0
    board.expect(b"READY\r\n", within_s=0.5)


def test_flipped_bits(board, image):
    high = board.symbols.find("limit_mv").address + 1
    board.faults.add("iram_flip", address=high, bit=3)
    assert read_mv(board) == 2500
    assert board.variables["limit_mv"] == 4000 ^ 0x0800 and not board.pin("P2.0")
    board.faults.add("sfr_flip", address=sfr_address("P2"), bit=0)
    board.run_for(1e-3)
    assert board.pin("P2.0")
    text = bytes(board.code[0:0x1000]).index(b"KEY\0")
    board.faults.add("code_flip", address=text, bit=2)
    board.pins["P3.2"] = False
    board.expect(b"OEY\r\n", within_s=ANSWER_S)
    large = Board(firmware=image, part="at89s52", xdata_octets=256)
    large.faults.add("xdata_flip", address=5, bit=7, at_s=0.01)
    large.run_for(0.02)
    assert bytes(large.xdata[4:7]) == b"\0\x80\0"


def test_a_rate_is_kept_and_its_places_are_random(image):
    board = Board(firmware=image, part="at89s52", xdata_octets=4096)
    rate, seconds = 2000.0, 2.0
    board.faults.add("xdata_flip", rate_per_s=rate, from_s=0.5, to_s=0.5 + seconds)
    board.run_for(0.499)
    assert board.faults.hits() == [("xdata_flip", 0)]
    board.run_for(3.0)
    ((_, hits),) = board.faults.hits()
    assert abs(hits - rate * seconds) < 5 * (rate * seconds) ** 0.5
    flipped = bytes(board.xdata[0:4096])
    bits = [sum(octet >> bit & 1 for octet in flipped) for bit in range(8)]
    odd = 4096 * (1 - 2.718281828 ** (-2 * hits / 32768)) / 2  # places of a bit that were hit an odd number of times
    assert all(abs(count - odd) < 5 * odd**0.5 for count in bits)
    assert sum(map(bool, flipped[:2048])) == pytest.approx(sum(map(bool, flipped[2048:])), rel=0.2)


SOME = """
[[fault]]
kind = "adc_noise"
lsb = 2.0
[[fault]]
kind = "eoc_late"
delay_s = 2e-5
probability = 0.01
[[fault]]
kind = "iram_flip"
rate_per_s = 1.0
[[fault]]
kind = "wire_short"
net = "/CS"
to = "DATA IN"
from_s = 1.0
to_s = 1.1
[[fault]]
kind = "reset"
rate_per_s = 0.5
"""


def test_the_same_seed_breaks_the_same(summary, scenario):
    path = scenario("default", tail=SOME)
    one, again, other = (summary(path, "--stop-s", 3, "--seed", seed, code=1) for seed in (3, 3, 4))
    assert one["trace_sha256"] == again["trace_sha256"] != other["trace_sha256"]
    assert one["faults"] == again["faults"]
    assert one["faults"]["0"]["adc_noise"] > 300 and one["faults"]["3"] == {"wire_short": 1}


def test_a_fault_that_never_comes_changes_nothing(summary, scenario):
    never = (
        SOME.replace("lsb = 2.0", "lsb = 0.0").replace("0.01", "0.0").replace("rate_per_s = 1.0", "rate_per_s = 0.0")
    )
    never = never.replace("to_s = 1.1", "to_s = 1.1\non = false").replace("rate_per_s = 0.5", "rate_per_s = 0.0")
    whole = summary(scenario("default", tail=never), "--stop-s", 2)
    assert whole["trace_sha256"] == summary("default", "--stop-s", 2)["trace_sha256"]
    assert {count for fault in whole["faults"].values() for count in fault.values()} == {0}


def test_one_fault_less_leaves_the_others_as_they_were(summary, scenario):
    tail = '\n[[fault]]\nkind = "volts_noise"\nvolts = 0.01\n[[fault]]\nkind = "adc_flip"\nprobability = 0.1\n'
    path = scenario("default", tail=tail)
    both = summary(path, "--stop-s", 1, code=1)
    alone = summary(path, "--stop-s", 1, "--set", "fault.0.on=false", code=1)
    assert alone["faults"]["0"]["volts_noise"] == 0 < both["faults"]["0"]["volts_noise"]
    assert alone["faults"]["1"] == both["faults"]["1"]


def test_equal_faults_are_independent(board):
    board.faults.add("adc_flip", bit=4, probability=0.5)
    board.faults.add("adc_flip", bit=6, probability=0.5)
    readings = [read_mv(board) for _ in range(READINGS)]
    counts = [readings.count(((2048 ^ code) * 5000 + 2048) // 4096) for code in (0, 0x10, 0x40, 0x50)]
    assert sum(counts) == READINGS
    assert all(abs(count - READINGS / 4) < 5 * (READINGS * 3 / 16) ** 0.5 for count in counts)


def test_a_snapshot_holds_the_faults(board):
    board.faults.add("adc_noise", lsb=30)
    board.faults.add("wire_short", net="P3.2", to="P2.0", to_s=board.now_s + 0.3)
    board.faults.add("wire_cut", net="P2.1", to_s=board.now_s + 0.3)
    board.faults.add("iram_flip", rate_per_s=5.0, address=0x7F)
    board.run_for(0.05)
    snap = board.snapshot()

    def goes_on(board: Board) -> object:
        board.volts[0] = 4.5
        board.send(b"?")
        board.expect(b"KEY\r\n", within_s=ANSWER_S)  # by the lamp that is shorted to the key
        board.sfr["P2"] = 0xFC
        board.run_for(1e-3)
        cut = board.pin("P2.1")
        readings = [read_mv(board) for _ in range(5)]
        board.run_for(0.3)
        return readings, cut, board.pin("P2.1"), board.pin("P3.2"), board.faults.hits(), board.iram[0x7F], board.cycles

    first = goes_on(board)
    assert first[1:4] == (True, False, True)
    board.faults.add("wire_short", net="P3.2", to="vcc")
    board.run_for(0.1)
    board.restore(snap)
    assert goes_on(board) == first
    assert goes_on(Board.from_snapshot(snap)) == first
