"""Scenario files with an F2812 on them: both forms mean the same; errors name file, line, key and remedy."""

import re
import textwrap
from pathlib import Path

import pytest
from conftest import ROOT

SHORT = """schema = 1
board = "f2812"
firmware = "p.f2812"
stop_s = 2.0
oscclk_hz = 20_000_000

[switches]
sci_rxffovf = "newest"

[gimu]
preset = "thesis"

[sci.a]
to = "gimu"

[sci.b]
to = "host"
baud = 19200
mode = "nav"
bit_error = 1e-3
"""
LONG = """schema = 1
stop_s = 2.0

[[board]]
name = "dsp"
kind = "f2812"
firmware = "p.f2812"
oscclk_hz = 20_000_000
switches = { sci_rxffovf = "newest" }

[[board]]
name = "acq"
kind = "8051_tlc2543"
firmware = "acq_default.ihx"
part = "at89s52"

[[gimu]]
preset = "thesis"

[[host]]
name = "scib"
baud = 19200
mode = "nav"

[[host]]
name = "pc"
mode = "codes"
nav = { period_s = 0.02 }

[[line]]
ends = ["dsp.SCIA", "gimu.T"]

[[line]]
ends = ["dsp.SCIB", "scib"]
baud = 19200
bit_error = 1e-3

[[line]]
ends = ["acq.UART", "pc"]
"""


@pytest.fixture
def write(tmp_path):
    """A scenario with text replaced, and a file beside it that begins as a program does."""
    (tmp_path / "p.f2812").write_bytes(b"\x7fELF")
    (tmp_path / "p.c").write_text("int main(void);\n", encoding="ascii")
    (tmp_path / "p.txt").write_text("text\n", encoding="ascii")

    def make(text: str, *replacements: tuple[str, str]) -> Path:
        for old, new in replacements:
            assert old in text, old
            text = text.replace(old, new)
        path = tmp_path / "net.toml"
        path.write_text(text, encoding="utf-8")
        return path

    return make


def refused(path, *words):
    from libins.errors import UsageError

    from libins import scenario

    with pytest.raises(UsageError) as caught:
        scenario.load(path)
    for word in words:
        assert word in str(caught.value), caught.value


def test_the_short_form_is_the_long_one_of_one_board(write):
    from libins import scenario

    short, long = scenario.load(write(SHORT)), scenario.load(write(LONG))
    assert short.flat and not long.flat
    assert short.tables.board[0] == long.tables.board[0]
    assert (short.tables.gimu, short.tables.host) == (long.tables.gimu, long.tables.host[:1])
    assert [line.ends for line in short.tables.line] == [line.ends for line in long.tables.line[:2]]
    assert short.tables.line[1] == long.tables.line[1]
    assert short.serial() == ["scib"] and long.serial() == ["scib", "pc"]
    assert list(long.images) == ["acq"] and list(long.programs) == ["dsp"]


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('board = "f2812"', 'board = "f28335"', (":2: board", "'f28335'", "'f2812'", "'8051_tlc2543'")),
        ('firmware = "p.f2812"', 'firmware = "p.c"', (":3: firmware", "'p.c'", "C source", "f2812-cc", ".f2812")),
        ('firmware = "p.f2812"', 'firmware = "p.txt"', (":3: firmware", "no program", "add_f2812_firmware")),
        ('firmware = "p.f2812"', 'firmware = "none.f2812"', (":3: firmware", "'none.f2812'", "no such file")),
        ("oscclk_hz = 20_000_000", "oscclk_hz = 20", ("oscclk_hz", "4000000")),
        ('to = "gimu"', 'to = "imu"', (":14: sci.a.to", "'imu'", "'gimu'")),
        ('to = "gimu"', 'to = "gimu"\nbaud = 19200', ("sci.a.baud", "is the host's")),
        ("[sci.b]", "[sci.c]", ("sci.c", "unknown key", "a, b")),
        ('mode = "nav"', 'mode = "codes"', ("sci.b.mode", "'codes'", "'nav'")),
        ("bit_error = 1e-3", "bit_error = 0.6", ("sci.b.bit_error", "0.5")),
        ("bit_error = 1e-3", "cuts_s = [[2, 1]]", ("sci.b.cuts_s.0", "from < to")),
        ("bit_error = 1e-3", "delay_s = 0", ("sci.b.delay_s", "above 0")),
        ('preset = "thesis"', 'preset = "theses"', (":11: gimu.preset", "'thesis'")),
        ('preset = "thesis"', "null_v = [1.0, 1.0]", ("gimu.null_v", "6 numbers", "P, Q, R, AX, AY, AZ")),
        ("[gimu]", "[gps]\nwhite_m = [1.0]\n\n[gimu]", ("gps.white_m", "3 numbers")),
        ("[gimu]", "[gps]\noutages_s = [[3, 2]]\n\n[gimu]", ("gps.outages_s.0", "[from, to]")),
        ("[gimu]", '[track]\nkind = "csv"\n\n[gimu]', ("track.csv", "no such file")),
        ("stop_s = 2.0", "stop_s = 2.0\nclock_hz = 11059200", ("clock_hz", "unknown key", "'oscclk_hz'")),
        ('sci_rxffovf = "newest"', "sci_rxffovf = 1", ("switches.sci_rxffovf", "a string")),
    ],
)
def test_wrong_keys_of_the_short_form(write, old, new, words):
    refused(write(SHORT, (old, new)), "net.toml", *words)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('kind = "f2812"', 'kind = "f2810"', (":6: board.0.kind", "'f2810'", "'f2812'", "'8051_tlc2543_six'")),
        ('kind = "f2812"\n', "", ("board.0.kind", "is missing", "'f2812'")),
        ('part = "at89s52"', "oscclk_hz = 30_000_000", ("board.1.oscclk_hz", "unknown key", "clock_hz")),
        ('name = "acq"', 'name = "dsp"', (":12: board.1.name", "'dsp'", "a name of its own")),
        ('name = "acq"', 'name = "a b"', ("board.1.name", "'a b'", "letters")),
        ('ends = ["acq.UART", "pc"]', 'ends = ["acq.UART"]', ("line.2.ends", "two")),
        ('ends = ["acq.UART", "pc"]', 'ends = ["acq.TXD", "pc"]', ("line.2.ends", "'acq.TXD'", "acq.UART, gimu.T")),
        ('ends = ["acq.UART", "pc"]', 'ends = ["acq.UART", "scib"]', ("line.2.ends", "scib is on another line")),
        ('ends = ["acq.UART", "pc"]', 'ends = ["acq.UART", "acq.UART"]', ("host.1.name", "pc is on no line")),
        ("nav = { period_s = 0.02 }", "", ("host.1.nav", 'mode = "codes" needs it')),
        ('mode = "nav"', 'mode = "nav"\nnav = { period_s = 1 }', ("host.0.nav", 'is of mode = "codes"')),
        ('mode = "nav"', 'mode = "codes"\nnav = { period_s = 1 }', ("host.0.mode", "no acquisition board")),
        ("nav = { period_s = 0.02 }", "nav = { period_s = 1, skew_s = [1, 0, 0] }", ("host.1.nav.skew_s", "below")),
        ('part = "at89s52"', 'part = "at89s53"', (":15: board.1.part", "'at89s53'")),
        ("stop_s = 2.0", "stop_s = 2.0\nfirmware = 1", ("firmware", "unknown key")),
    ],
)
def test_wrong_keys_of_the_long_form(write, old, new, words):
    refused(write(LONG, (old, new)), "net.toml", *words)


def test_stop_samples_needs_a_navigator(write):
    refused(write('schema = 1\nboard = "f2812"\nfirmware = "p.f2812"\nstop_s = 1\nstop_samples = 3\n'), "stop_samples")


def test_a_matrix_and_a_campaign_reach_every_key(write):
    """By dotted name, and integers stay integers."""
    from libins import campaign, scenario

    tail = "\n[matrix]\nsci.b.baud = [9600, 19200]\nswitches.sci_rxffovf = ['first', 'newest']\n"
    runs = scenario.load_all(write(SHORT + tail))
    assert [run.tables.host[0].baud for run in runs] == [9600, 9600, 19200, 19200]
    assert runs[1].tables.board[0].switches == {"sci_rxffovf": "newest"}
    assert runs[1].name == "net[sci.b.baud=9600, switches.sci_rxffovf=newest]"
    tail = (
        "\n[campaign]\noscclk_hz = { uniform = [19_990_000, 20_010_000] }\nsci.b.bit_error = { uniform = [0, 1e-3] }\n"
    )
    plan = campaign.Campaign(str(write(SHORT + tail)), None, {})
    drawn = [plan.load(seed).tables.board[0].oscclk_hz for seed in range(1, 9)]
    assert len(set(drawn)) > 4 and all(isinstance(hz, int) for hz in drawn)
    tail = "\n[campaign]\nboard.0.oscclk_hz = { normal = [20_000_000, 1000] }\n"
    plan = campaign.Campaign(str(write(LONG + tail)), None, {})
    assert isinstance(plan.load(1).tables.board[0].oscclk_hz, int)


def test_another_program_makes_another_campaign(write, tmp_path):
    from libins import campaign

    path = write(SHORT + "\n[campaign]\nsci.b.bit_error = { uniform = [0, 1e-3] }\n")
    before = campaign.Campaign(str(path), None, {}).identity["files"]
    (tmp_path / "p.f2812").write_bytes(b"\x7fELF changed")
    assert campaign.Campaign(str(path), None, {}).identity["files"] != before


@pytest.mark.parametrize("name", ["net.toml", "p.f2812"])
def test_steps_and_snapshots_are_refused_with_the_reason(ins, write, name):
    path = write(SHORT).with_name(name)
    done = ins("debug", path)
    assert done.returncode == 2
    assert "8051" in done.stderr and "compiled for this machine" in done.stderr, done.stderr


def test_the_board_of_the_8051_does_not_take_an_f2812(write):
    from libins.board import Board
    from libins.errors import UsageError

    with pytest.raises(UsageError, match="compiled for this machine"):
        Board(write(SHORT))


def test_the_scenarios_of_the_page_are_scenarios(tmp_path):
    from libins import scenario

    page = (ROOT / "docs/f2812_scenarios.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^    schema = 1\n(?:    .*\n|\n)+", page, re.MULTILINE)
    assert len(blocks) == 2
    for number, block in enumerate(blocks):
        path = tmp_path / f"{number}.toml"
        path.write_text(textwrap.dedent(block), encoding="utf-8")
        assert scenario.load(path).programs
