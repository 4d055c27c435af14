"""Several boards in one virtual time: edges arrive exactly their delay later, wherever time was cut."""

import numpy as np
import pytest
from net_kit import BAUD, BIT_PS, BRR, ECHO, ECHO_BIT_PS, GREETING, MS, PS_PER_S, add_acquisition, echo_net, fault, go

from libins import _run

SEED = 20060701
TEXT = bytes(range(32, 127))
STEPS = 613
"""Calls that cut the same time in other places."""


def levels(edges: np.ndarray, trace: int) -> list[list[int]]:
    return edges[edges[:, 1] == trace][:, [0, 2]].tolist()


def spoken(steps: int, **line) -> tuple:
    """All that two seconds of an echo show."""
    net = echo_net(SEED, **line)
    traces = [net.trace(*wire) for wire in (("dsp", "SCITXDA"), ("pc", "RXD"), ("pc", "TXD"), ("dsp", "SCIRXDA"))]
    net.record("dsp", True, True)
    go(net, 0.1, steps)
    assert net.send("pc", TEXT) == len(TEXT)
    go(net, 0.5, steps)
    edges = net.take_edges()
    records = net.take_records("dsp").tolist()
    wires = [levels(edges, trace) for trace in traces]
    return net.take_received("pc"), records, net.reports("dsp"), net.host_counters("pc"), wires, net.line_counters(0)


def test_firmware_echoes_over_a_line_between_processes():
    received, records, reports, counters, _, _ = spoken(1)
    assert bytes(octet for _, octet, _ in received) == GREETING + TEXT
    assert all(framing_ok for *_, framing_ok in received)
    assert reports == []
    assert counters["octets_sent"] == len(TEXT)
    what = [_run.RECORD_WHAT[row[1]] for row in records]
    scitxbuf, _ = _run.f2812_register("SCITXBUFA")
    written = [row[3] for row in records if row[1] == 1 and row[2] == scitxbuf]
    assert bytes(written) == GREETING + TEXT
    assert what.count("interrupt") == what.count("return") == len(TEXT)


@pytest.mark.parametrize("delay_s", [0.0, 0.01, 1e-9])
def test_an_edge_arrives_exactly_its_delay_after_it_left(delay_s):
    *_, (txd, pc_rxd, pc_txd, rxd), _ = spoken(1, delay_s=delay_s)
    delay = round(delay_s * PS_PER_S) or BIT_PS
    late = [[at + delay, level] for at, level in txd]
    assert len(late) > len(GREETING + TEXT) and pc_rxd == late
    assert rxd == [[at + delay, level] for at, level in pc_txd]


@pytest.mark.parametrize(
    "line", [{}, {"delay_s": 1e-9}, {"bit_error": 2e-3, "octet_loss": 0.02, "cuts_s": [[0.2, 0.25]]}]
)
def test_no_result_depends_on_where_time_is_cut(line):
    once, often = spoken(1, **line), spoken(STEPS, **line)
    assert once == often
    if "bit_error" in line:
        assert once[-1]["slots_inverted"] > 0 and once[-1]["octets_swallowed"] > 0, "the line is as bad as meant"


def test_both_boards_and_both_hosts_in_one_run():
    def made(dsp: bool, acq: bool, steps: int) -> tuple:
        net = echo_net(SEED) if dsp else _run.Net(SEED)
        board = add_acquisition(net) if acq else None
        go(net, 0.1)
        said = net.send("pc", TEXT) if dsp else 0
        go(net, 3.0, steps)
        return (
            (said, net.take_received("pc"), net.reports("dsp")) if dsp else (),
            (net.take_states("navd")[1], net.host_counters("navd"), board.scans().tolist()) if board else (),
        )

    both = made(True, True, 1)
    assert both == made(True, True, STEPS), "where time was cut"
    assert both[0] == made(True, False, 1)[0], "boards that share no line do not feel each other"
    assert both[1] == made(False, True, 1)[1]
    assert bytes(octet for _, octet, _ in both[0][1]) == GREETING + TEXT
    states, counters, scans = both[1]
    assert len(states) == counters["accepted"] >= len(scans) - 2 > 100
    assert counters["lost"] == counters["corrupt_accepted"] == 0


def test_a_host_scores_the_board_as_a_run_does():
    net = _run.Net(SEED)
    add_acquisition(net)
    go(net, 4.0)
    states, _ = net.take_states("navd")
    column = _run.STATE_COLUMNS.index
    for axis in ("roll", "pitch", "yaw"):
        assert np.abs(states[:, column(f"error_{axis}_rad")]).max() < 3e-3
    assert np.abs(states[:, column("true_yaw_rad")]).max() > 0.5, "it moves"


def test_two_programs_on_one_line():
    def made(steps: int) -> tuple:
        net = _run.Net(SEED)
        for name in ("left", "right"):
            net.f2812(name, ECHO)
        net.line("left.SCIA", "right.SCIA", BAUD)
        traces = [net.trace("left", "SCITXDA"), net.trace("right", "SCITXDA"), net.trace("left", "SCIRXDA")]
        go(net, 0.2, steps)
        edges = net.take_edges()
        return [levels(edges, trace) for trace in traces], net.reports("left"), net.reports("right")

    (left, right, left_rxd), *reports = made(1)
    assert [left, right, left_rxd] == made(STEPS)[0]
    assert left == right and reports == [[], []], "the same program at the same time"
    sent = [[at + BIT_PS, level] for at, level in right]
    assert len(sent) > 100 and left_rxd == [row for row in sent if row[0] <= 0.2 * PS_PER_S]


def test_a_host_stops_at_an_octet_and_answers_at_that_instant():
    net = echo_net(SEED)
    sent = net.trace("pc", "TXD")
    assert not net.until_octet("pc", PS_PER_S)
    assert net.stopped()["station"] == "pc"
    (at, octet, _), *more = net.take_received("pc")
    assert (octet, more) == (GREETING[0], []) and net.station_ps("pc") == at
    net.send("pc", b"x")
    go(net, 0.5)
    assert levels(net.take_edges(), sent)[0] == [at, 0]
    assert net.take_octets("pc") == GREETING[1:] + b"x"


def test_breaks_at_registers_stop_where_the_firmware_is_and_change_nothing():
    free, net = echo_net(SEED), echo_net(SEED)
    address, name = _run.f2812_register("SCITXBUFA")
    net.set_break("dsp", "SCITXBUFA", "write", value=GREETING[5])
    assert not net.until(PS_PER_S // 2)
    stop = net.stopped()
    assert stop | {"t_ps": 0} == {
        "station": "dsp", "t_ps": 0, "address": address, "register": name, "access": "write", "value": GREETING[5],
    }  # fmt: skip
    assert net.station_ps("dsp") == stop["t_ps"] > 0
    net.clear_break("dsp", address)
    go(net, 0.5), go(free, 0.5)
    assert net.take_received("pc") == free.take_received("pc")
    assert net.peek("dsp", "SCILBAUDA") == [BRR & 0xFF] == net.peek("dsp", address - 6)


def test_a_break_matches_by_access_and_mask():
    net = echo_net(SEED)
    net.set_break("dsp", "SCIRXBUFA", "read", value=0x40, mask=0x60)
    net.set_break("dsp", "SCIRXBUFA", "write")
    go(net, 0.1)
    net.send("pc", b" 0AZaz")
    stops = []
    while not net.until(PS_PER_S // 2):
        stops.append((net.stopped()["access"], net.stopped()["value"]))
    assert stops == [("read", ord("A")), ("read", ord("Z"))]


def bit_of(edges: list[list[int]]) -> float:
    """Length of a bit, from the start bit of the greeting's first character to that of its last but one [ps]."""
    starts = [at for at, level in edges if not level]
    first, last = starts[0], edges[-1][0]
    bits = 10 * (len(GREETING) - 1) + 9 - trailing_ones(GREETING[-1])
    return (last - first) / bits


def trailing_ones(octet: int) -> int:
    """Bits of the character after which its line stays high."""
    return len(f"{octet:08b}") - len(f"{octet:08b}".lstrip("1"))


@pytest.mark.parametrize("ppm", [0.0, 100.0, -40_000.0])
def test_a_crystal_that_is_off_stretches_every_bit(ppm):
    net = echo_net(SEED)
    trace = net.trace("dsp", "SCITXDA")
    net.add_fault("dsp", fault("crystal", value=ppm))
    go(net, 0.2)
    assert bit_of(levels(net.take_edges(), trace)) == pytest.approx(ECHO_BIT_PS / (1 + ppm * 1e-6), rel=2e-6)
    assert net.fault_hits("dsp") == [("crystal", 1)]


def test_a_crystal_drifts_from_bit_to_bit():
    net = echo_net(SEED)
    trace = net.trace("dsp", "SCITXDA")
    net.add_fault("dsp", fault("crystal", drift=10_000.0))
    go(net, 1.0)
    net.take_edges()
    net.send("pc", b"U")
    go(net, 1.1)
    edges = levels(net.take_edges(), trace)
    assert [level for _, level in edges] == [0, 1] * 5
    assert (edges[-1][0] - edges[0][0]) / 9 == pytest.approx(ECHO_BIT_PS / 1.01, rel=2e-4), "10 000 ppm/s, 1 s later"


def test_a_reset_begins_the_firmware_again():
    net = echo_net(SEED)
    net.add_fault("dsp", fault("reset", from_ps=100 * MS, lasts_ps=MS))
    go(net, 0.3)
    assert net.take_octets("pc") == GREETING * 2
    assert net.statistics("dsp")["starts"] == 2
    assert net.fault_hits("dsp") == [("reset", 1)]


WIRES = [("dsp", "SCITXDA", True), ("pc", "RXD", True), ("dsp", "SCIRXDA", False), ("pc", "TXD", False)]


@pytest.mark.parametrize(("station", "net_name", "to_host"), WIRES)
@pytest.mark.parametrize(
    ("kind", "keys"), [("wire_cut", {}), ("wire_short", {"other": "vcc"}), ("break", {"other": "gnd"})]
)
def test_a_wire_fault_acts_on_its_direction_while_it_lasts(station, net_name, to_host, kind, keys):
    net = echo_net(SEED)
    go(net, 0.1)
    assert net.take_octets("pc") == GREETING
    net.add_fault(station, fault(kind, net=net_name, from_ps=200 * MS, to_ps=300 * MS, **keys))
    go(net, 0.21)
    net.send("pc", b"lost")
    go(net, 0.29)
    heard = net.take_received("pc")
    assert [octet for _, octet, framing_ok in heard if framing_ok] == []
    assert bool(heard) == (kind == "break" and to_host), "a break is a character without a stop bit"
    reported = [report["text"] for report in net.reports("dsp")]
    go(net, 0.4)
    net.take_octets("pc")
    net.send("pc", b"back")
    go(net, 0.5)
    assert net.take_octets("pc") == b"back", reported
    assert net.fault_hits(station) == [(kind, 1)]


def test_a_host_that_is_too_fast_is_not_understood():
    net = echo_net(SEED)
    net.add_fault("pc", fault("baud", value=90_000.0, from_ps=200 * MS, to_ps=300 * MS))
    go(net, 0.21)
    net.send("pc", b"\x00\x00")
    go(net, 0.29)
    assert net.peek("dsp", "GPFDAT")[0] >> 14 & 1 == 1, "the firmware saw framing errors"
    go(net, 0.31)
    net.take_octets("pc")
    net.send("pc", TEXT)
    go(net, 0.5)
    assert net.take_octets("pc") == TEXT


def test_random_faults_come_from_their_seed():
    def made(seed: int, steps: int) -> tuple:
        net = echo_net(SEED)
        net.add_fault("dsp", fault("reset", rate_hz=5.0, lasts_ps=MS, seed=seed))
        go(net, 2.0, steps)
        return net.take_received("pc"), net.fault_hits("dsp")

    assert made(1, 1) == made(1, STEPS) != made(2, 1)
    assert made(1, 1)[1][0][1] > 3


def test_what_a_net_cannot_have_is_refused():
    net = echo_net(SEED)
    net.host("other", BAUD)
    refused = [
        (lambda: net.host("pc", BAUD), "one of its own"),
        (lambda: net.host("a.b", BAUD), "without a dot"),
        (lambda: net.host("slow", 1.0), "baud must be 50 .. 4e6"),
        (lambda: net.line("dsp.SCIC", "other", BAUD), "dsp.SCIA, dsp.SCIB"),
        (lambda: net.line("dsp.SCIA", "other", BAUD), "has a line already"),
        (lambda: net.line("other", "other", BAUD), "one station"),
        (lambda: net.line("dsp.SCIB", "nobody", BAUD), "no such station"),
        (lambda: net.line("dsp.SCIB", "other", 1.0), "baud: 50 .. 4e6"),
        (lambda: net.line("dsp.SCIB", "other", BAUD, delay_s=-1.0), "delay_s"),
        (lambda: net.line("dsp.SCIB", "other", BAUD, bit_error=0.7), "0 .. 0.5"),
        (lambda: net.trace("dsp", "GPIOZ9"), "no such wire"),
        (lambda: net.trace("pc", "CTS"), "no wire CTS"),
        (lambda: net.peek("dsp", "SCIXYZ"), "no register"),
        (lambda: net.set_break("dsp", "PIEACK", "both"), "read, write or any"),
        (lambda: net.peek("pc", "PIEACK"), "another kind"),
        (lambda: net.add_fault("dsp", fault("iram_flip")), "its memory has no faults"),
        (lambda: net.add_fault("dsp", fault("wire_cut", net="SCIRXDB")), "SCITXDA SCIRXDA"),
        (lambda: net.add_fault("dsp", fault("wire_short", net="SCIRXDA", other="SCITXDA")), "gnd or vcc"),
        (lambda: net.add_fault("pc", fault("reset")), "a host has a baud"),
        (lambda: _run.Net(1).f2812("dsp", ECHO, 1), "oscillator"),
        (lambda: _run.Net(1).f2812("dsp", ECHO, switches={"clock_off": "maybe"}), "clock_off"),
        (lambda: _run.Net(1).f2812("dsp", ECHO, switches={"no_such": "1"}), "no_such"),
    ]
    for call, text in refused:
        with pytest.raises(ValueError, match=text):
            call()
    go(net, 0.1)
    with pytest.raises(ValueError, match="time has gone on"):
        net.line("dsp.SCIB", "other", BAUD)
    with pytest.raises(ValueError, match="time has gone on"):
        net.host("late", BAUD)
    assert net.take_octets("pc") == GREETING, "and nothing was harmed"
