"""F2812Board: a program for the F2812 as a test's object, and what it says when something cannot be."""

import json
import re

import pytest
from libins.board_uart import ExpectError
from libins.errors import UsageError
from libins.f2812_board import OF_8051, F2812Board

from libins import artifacts

ECHO = "echo.f2812"
GREETING = b"echo ready\r\n"
BAUD = 37.5e6 / (8 * 488)
"""Of the firmware: LSPCLK / 8 (BRR + 1)."""
OCTET_PS = round(10e12 / BAUD)
RX_VECTOR = "SCIRXINTA"


@pytest.fixture
def board():
    with F2812Board(firmware=ECHO) as made:
        yield made


@pytest.fixture
def greeted(board):
    board.hosts["scia"].expect(GREETING, within_s=0.1)
    return board


def test_it_greets_and_echoes(greeted):
    host = greeted.hosts["scia"]
    host.send(b"Hello, F2812")
    assert host.expect(re.compile(rb"(\w+), (F\d{4})"), within_s=0.1)[2] == b"F2812"
    assert all(octet.framing_ok for octet in host.received)
    assert host.unread == b"" and greeted.hosts["scib"].received == []
    assert greeted.reports == [] and greeted.ended is None


def test_octets_come_at_the_firmwares_own_baud(greeted):
    """Back to back: at most one LSPCLK of rounding each."""
    at = [octet.at_ps for octet in greeted.hosts["scia"].received]
    steps = [b - a for a, b in zip(at, at[1:], strict=False)]
    assert max(abs(step - OCTET_PS) for step in steps[1:]) <= OCTET_PS // 1000, steps


def test_the_same_calls_give_the_same_octets():
    def play():
        with F2812Board(firmware=ECHO) as board:
            host = board.hosts["scia"]
            host.expect(GREETING)
            board.run_for(1.23e-3)
            host.send(b"abc")
            board.run_for(0.01)
            return board.now_ps, host.received, board.statistics()

    assert play() == play()


def test_a_line_that_is_cut_up_into_many_calls_is_the_same():
    def play(pieces):
        with F2812Board(firmware=ECHO) as board:
            for _ in range(pieces):
                board.run_for(0.04 / pieces)
            return board.hosts["scia"].received

    assert play(1) == play(40)


def test_it_stops_at_a_register_access(greeted):
    greeted.hosts["scia"].send(b"z")
    read = greeted.run_until(register="SCIRXBUFA", access="read", within_s=0.01)
    assert (read["register"], read["access"], read["value"] & 0xFF) == ("SCIRXBUFA", "read", ord("z"))
    assert read["t_ps"] <= greeted.now_ps + OCTET_PS
    written = greeted.run_until(register=0x7059, access="write", value=ord("z"), mask=0xFF)
    assert written["register"] == "SCITXBUFA" and written["t_ps"] > read["t_ps"]
    assert greeted.hosts["scia"].expect(b"z", within_s=0.01)
    with pytest.raises(TimeoutError, match="no write access to SCIPRIA within 0.002 s"):
        greeted.run_until(register="SCIPRIA", access="write", within_s=0.002)


def test_a_break_is_gone_after_it(greeted):
    with pytest.raises(TimeoutError):
        greeted.run_until(register="SCIRXBUFA", within_s=0.001)
    greeted.hosts["scia"].send(b"q")
    with pytest.raises(TimeoutError, match="SCIPRIA"):
        greeted.run_until(register="SCIPRIA", within_s=0.005)
    assert greeted.hosts["scia"].unread == b"q"


def test_instants_and_conditions(greeted):
    greeted.run_until(0.05)
    assert greeted.now_s == pytest.approx(0.05, abs=1e-9)
    greeted.hosts["scia"].send(b"12")
    greeted.run_until(lambda: len(greeted.hosts["scia"].unread) == 2, within_s=0.01, every_s=1e-4)
    with pytest.raises(UsageError, match="an instant, a condition or register="):
        greeted.run_until()


def test_registers_are_looked_at_without_side_effects(greeted):
    registers = greeted.registers
    assert (registers["SCIHBAUDA"], registers["SCILBAUDA"]) == (487 >> 8, 487 & 0xFF)
    assert registers[0x7052] == registers["SCIHBAUDA"]
    greeted.hosts["scia"].send(b"k")
    greeted.run_until(register="SCIRXBUFA", access="read", within_s=0.01)
    assert registers["SCIRXBUFA"] == registers["SCIRXBUFA"] == ord("k")
    with pytest.raises(UsageError, match="SCIRXBUGA"):
        registers["SCIRXBUGA"]


def test_what_does_not_come_is_told_with_what_came(greeted):
    host = greeted.hosts["scia"]
    host.send(b"ho")
    with pytest.raises(ExpectError, match=r"b'hi' did not come from .* s;.*\n.*2 octets:\n.*b'ho'"):
        host.expect(b"hi", within_s=0.01)


def test_a_host_at_another_baud_gets_framing_errors():
    with F2812Board(firmware=ECHO, sci={"a": {"baud": 4800}}) as board:
        board.run_for(0.05)
        assert not all(octet.framing_ok for octet in board.hosts["scia"].received)
        with pytest.raises(ExpectError, match="no stop bit: is the board's line at 4800 Bd"):
            board.hosts["scia"].expect(GREETING, within_s=0.001)


def test_a_reset_begins_again_from_main(greeted):
    greeted.run_for(0.005)
    greeted.reset()
    greeted.hosts["scia"].expect(GREETING, within_s=0.1)
    assert greeted.statistics()["cpu"]["starts"] == 2
    assert greeted.faults.hits() == [("reset", 1)]


def test_faults_while_it_runs(greeted):
    host = greeted.hosts["scia"]
    greeted.faults.add("wire_short", net="SCITXDA", to="gnd")
    host.send(b"x")
    greeted.run_for(0.01)
    assert b"x" not in host.unread
    for keys, words in (
        ({"kind": "iram_flip"}, "iram_flip.*compiled for this machine"),
        ({"kind": "wire_cut", "net": "P1.0"}, "'P1.0'.*SCITXDA"),
        ({"kind": "baud", "ppm": 1.0}, "station|host"),
        ({"kind": "crystal", "ppm": 1.0, "station": "dps"}, "'dps'"),
    ):
        with pytest.raises(UsageError, match=words):
            greeted.faults.add(**keys)
    assert greeted.faults.hits() == [("wire_short", 1)]


def test_a_crystal_that_is_off_moves_the_baud():
    with F2812Board(firmware=ECHO) as board:
        board.faults.add("crystal", ppm=-20_000.0)
        board.hosts["scia"].expect(GREETING, within_s=0.2)
        at = [octet.at_ps for octet in board.hosts["scia"].received]
        assert (at[-1] - at[1]) / (len(at) - 2) == pytest.approx(OCTET_PS / 0.98, rel=1e-4)


def test_what_needs_8051_code_is_refused_with_the_reason(board):
    for name in OF_8051:
        with pytest.raises(UsageError, match=f"F2812Board.{name}: .*compiled for this machine"):
            getattr(board, name)
    with pytest.raises(AttributeError):
        _ = board.nonsense


def test_bad_boards(tmp_path):
    (tmp_path / "x.f2812").write_bytes(b"\x7fELF")
    for keys, words in (
        ({}, "firmware= or a scenario"),
        ({"firmware": "none.f2812"}, "no such file"),
        ({"firmware": ECHO, "switches": {"sci_rxffow": "newest"}}, "sci_rxffow"),
        ({"firmware": ECHO, "sci": {"a": {"boud": 1}}}, "sci.a.boud.*'baud'"),
        ({"scenario_file": "default"}, "no F2812"),
    ):
        with pytest.raises(UsageError, match=words):
            F2812Board(**keys)


def test_the_only_host_needs_no_name():
    with F2812Board(firmware=ECHO, sci={"b": {"to": "open"}}) as board:
        board.expect(GREETING, within_s=0.1)
        board.send(b"!")
        board.expect(b"!", within_s=0.01)
        assert board.unread == b"" and len(board.received) == len(GREETING) + 1
    with F2812Board(firmware=ECHO) as board, pytest.raises(UsageError, match="scia, scib.*hosts"):
        board.send(b"!")


def test_records_of_what_happens_inside(greeted, tmp_path):
    log = tmp_path / "a.jsonl"
    with greeted.record(access_log=log, vcd=tmp_path / "a.vcd", registers=["SCIRXBUFA"]):
        greeted.hosts["scia"].send(b"W")
        greeted.hosts["scia"].expect(b"W", within_s=0.01)
    entries = [json.loads(line) for line in log.read_text(encoding="utf-8").splitlines()]
    [read] = [e for e in entries if e.get("register") == "SCIRXBUFA"]
    assert (read["what"], read["value"], read["board"]) == ("read", ord("W"), "dsp")
    names = [e["interrupt"] for e in entries if e["what"] == "interrupt"]
    assert names == [RX_VECTOR]
    inside = [e["what"] for e in entries if "interrupt" in e or e.get("register") == "SCIRXBUFA"]
    assert inside == ["interrupt", "read", "return"]
    text = (tmp_path / "a.vcd").read_text(encoding="ascii")
    assert "s57 " in text and f"b{ord('W'):b} " in text
    key = re.search(r"\$var string 1 (\S+) interrupt \$end", text)[1]
    assert re.findall(rf"^s(\S*) {re.escape(key)}$", text, re.MULTILINE) == ["", RX_VECTOR, ""]


def test_artifacts_bring_the_board_to_the_failure_again(greeted, tmp_path):
    host = greeted.hosts["scia"]
    host.send(b"one")
    greeted.run_for(0.02)
    greeted.faults.add("crystal", ppm=5000.0)
    host.send(b"two")
    greeted.run_for(0.003)
    names = [path.name for path in artifacts.write(greeted, tmp_path / "f", 0.02)]
    assert names == ["inputs.json", "trace.vcd", "accesses.jsonl", "board.txt"]
    assert all((tmp_path / "f" / name).stat().st_size > 0 for name in names)
    again = artifacts.replay(tmp_path / "f")
    assert (again.now_ps, again.hosts["scia"].received) == (greeted.now_ps, host.received)
    assert again.statistics() == greeted.statistics()
    again.close()
