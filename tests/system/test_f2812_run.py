"""`ins run` and `ins campaign` on boards with an F2812: the same instrument as for the 8051 board."""

import csv
import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path

import pytest
from conftest import ROOT, timeless
from f2812_kit import CARELESS, build
from vcdvcd import VCDVCD

SCENARIO = ROOT / "emu/f2812_sci/scenarios/echo.toml"
GREETING = b"echo ready\r\n"
BIT_PS = 10**12 / (37.5e6 / (8 * 488))
BOTH = """schema = 1
stop_s = 0.5

[[board]]
name = "dsp"
kind = "f2812"
firmware = "echo.f2812"

[[board]]
name = "acq"
kind = "8051_tlc2543"
firmware = "acq_default.ihx"

[motion]
kind = "sinusoids"
ramp_s = 0.2
yaw = { amplitude_rad = 0.3, frequency_hz = 0.5 }

[[host]]
name = "pc"

[[host]]
name = "arm"
mode = "codes"
nav = { period_s = 0.02, skew_s = [0.0, 125.868e-6, 260.417e-6] }

[[line]]
ends = ["dsp.SCIA", "pc"]

[[line]]
ends = ["acq.UART", "arm"]
"""


@pytest.fixture
def write(tmp_path):
    def make(text: str, name: str = "net.toml") -> Path:
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return make


@pytest.fixture
def variant(write):
    """The echo scenario with lines at its end."""
    return lambda tail: write(SCENARIO.read_text(encoding="utf-8") + tail)


def test_the_summary_and_the_same_twice(summary):
    first, second = summary("echo"), summary("echo")
    assert timeless(first) == timeless(second)
    assert first["sim_s"] == 1.0 and first["seed"] == 1 and first["verdict"] == "pass"
    assert first["cpu"]["starts"] == 1 and first["cpu"]["accesses"] > 1000 and first["cpu"]["interrupts"] == 0
    assert first["hosts"] == {
        "scia": {
            "octets_sent": 0,
            "octets_received": len(GREETING),
            "framing_errors": 0,
            "false_starts": 0,
            "overflow": 0,
        }
    }
    assert first["reports"] == [] and first["link"] is None


def test_a_program_alone(summary):
    from libins import scenario

    alone = summary(scenario.PACKAGE / "firmware/echo.f2812", "--stop-s", 0.2)
    assert alone["firmware"] == "echo.f2812" and alone["sim_s"] == 0.2
    assert alone["hosts"]["scia"]["octets_received"] == len(GREETING)


def test_both_boards_in_one_run(summary, write):
    path = write(BOTH)
    first, second = summary(path), summary(path)
    assert timeless(first) == timeless(second)
    assert set(first["boards"]) == {"dsp", "acq"} and "cpu" not in first
    assert first["boards"]["acq"]["samples"] == 24 and first["boards"]["acq"]["cpu"]["cycles"] > 400_000
    assert first["hosts"]["pc"]["octets_received"] == len(GREETING)
    link = first["link"]
    assert link == first["hosts"]["arm"]["link"] and link["lost"] == 0 and link["ok"] >= 20
    assert link["sent"] == link["before_first"] + link["ok"] + link["lost"] + link["in_flight"] == 24
    assert 0 < first["attitude"]["max_rad"]["yaw"] < 3e-3


def test_the_trace_is_what_the_digest_is_of(summary, tmp_path):
    trace = tmp_path / "t.csv"
    digest = summary("echo", "--trace", trace)["trace_sha256"]
    rows = list(csv.DictReader(trace.open(encoding="ascii")))
    assert {row["wire"] for row in rows} == {"dsp.SCITXDA"}
    falls = [int(row["t_ps"]) for row in rows if row["level"] == "0"]
    assert falls[1] - falls[0] == pytest.approx(round((falls[1] - falls[0]) / BIT_PS) * BIT_PS, abs=30_000)
    other = summary("echo", "--switch", "clock_off=take", "--set", "oscclk_hz=29_990_000")["trace_sha256"]
    assert other != digest


def test_expectations_junit_and_strict(ins, variant, tmp_path):
    path = variant('[[expect]]\nvalue = "hosts.scia.octets_received"\nat_most = 3\n')
    done = ins("run", path, "--junit", tmp_path / "j.xml", "--strict")
    assert done.returncode == 1, done.stdout + done.stderr
    assert "hosts.scia.octets_received = 12, expected at most 3" in done.stdout
    text = (tmp_path / "j.xml").read_text(encoding="utf-8")
    assert 'failures="1"' in text and "expected at most 3" in text and "the firmware does nothing wrong" in text


def test_matrix(ins, variant, tmp_path):
    path = variant("\n[matrix]\nsci.a.baud = [9600, 4800]\n")
    done = ins("run", path, "--json", tmp_path / "m.json")
    assert done.returncode == 1, done.stdout + done.stderr
    both = json.loads((tmp_path / "m.json").read_text(encoding="utf-8"))
    assert [run["verdict"] for run in both] == ["pass", "fail"]
    assert both[1]["matrix"] == {"sci.a.baud": 4800} and both[1]["hosts"]["scia"]["framing_errors"] > 0


def test_vcd(ins, tmp_path):
    path = tmp_path / "e.vcd"
    done = ins("run", "echo", "--vcd", path, "--vcd-sfr", "SCICTL2A", "--stop-s", 0.1)
    assert done.returncode == 0, done.stdout + done.stderr
    dump = VCDVCD(str(path))
    falls = [at for at, level in dump["dsp.SCITXDA"].tv if level == "0" and at > 0]
    text = path.read_text(encoding="ascii")
    key = re.search(r"\$var string 1 (\S+) SCITXDA_octet \$end", text)[1]
    octets = re.findall(rf"^s([0-9A-F]{{2}}!?) {re.escape(key)}$", text, re.MULTILINE)
    assert bytes.fromhex("".join(octets)) == GREETING
    assert falls[0] > 4_000_000_000  # the PLL has locked by then
    states = {int(value, 2) & 0xC0 for _, value in dump["dsp.SCICTL2A"].tv if "x" not in value}
    assert {0x00, 0xC0} <= states, states


def test_access_log_of_an_interrupt(variant, ins, tmp_path):
    log = tmp_path / "a.jsonl"
    done = ins("run", "echo", "--access-log", log, "--stop-s", 0.02)
    assert done.returncode == 0, done.stderr
    entries = [json.loads(line) for line in log.read_text(encoding="utf-8").splitlines()]
    assert {"t_ps", "board", "what", "register", "address", "value"} == set(entries[0])
    names = {e["register"] for e in entries if "register" in e}
    assert {"PLLCR", "LOSPCP", "PCLKCR", "PIECTRL", "PIEIER9", "SCICCRA", "SCILBAUDA", "SCITXBUFA"} <= names
    sent = bytes(e["value"] for e in entries if e.get("register") == "SCITXBUFA" and e["what"] == "write")
    assert GREETING.startswith(sent) and len(sent) > 3
    assert [e["t_ps"] for e in entries] == sorted(e["t_ps"] for e in entries)


def test_report_of_a_board_that_navigates_shows_where_it_went(ins, tmp_path):
    page, still = tmp_path / "went.html", tmp_path / "still.html"
    assert ins("run", "thesis", "--stop-s", 50, "--report", page).returncode in (0, 1)
    assert ins("run", "echo", "--report", still).returncode == 0
    shown = [each.read_text(encoding="utf-8").partition("<h2>Navigation</h2>")[2] for each in (page, still)]
    assert "easting [m]" in shown[0].partition("</svg>")[0] and shown[1] == ""


def test_report(ins, tmp_path):
    page = tmp_path / "r.html"
    assert ins("run", "echo", "--report", page, "--report-at", 0.012).returncode == 0
    text = page.read_text(encoding="utf-8")
    assert "On the lines" in text and "register accesses" in text and ">65<" in text  # 'e'
    assert "board = &#34;f2812&#34;" in text


def test_strict_and_the_kinds_of_reports(ins, tmp_path):
    program = build(CARELESS, tmp_path)
    options = ("--stop-s", 0.01, "--junit", tmp_path / "j.xml")
    assert ins("run", program, *options).returncode == 0
    done = ins("run", program, *options, "--strict")
    assert done.returncode == 3, done.stdout + done.stderr
    assert "guest_error: " in done.stdout and "(0x7021), 1 times, first at 0.0000" in done.stdout
    assert "not_modelled: " in done.stdout and "(0x7100)" in done.stdout
    text = (tmp_path / "j.xml").read_text(encoding="utf-8")
    assert 'failures="2"' in text and "0x7021" in text


@pytest.mark.parametrize("option", [("--itrace", "i.txt"), ("--profile", "-"), ("--lcov", "l.info")])
def test_what_reads_8051_code_is_refused(ins, tmp_path, option):
    done = ins("run", "echo", option[0], tmp_path / option[1])
    assert done.returncode == 2 and "compiled for this machine" in done.stderr, done.stderr


def test_bad_options(ins, tmp_path):
    for options, words in (
        (("--vcd", tmp_path / "v", "--vcd-sfr", "TCON"), ("TCON", "SCIFFRXA")),
        (("--switch", "sci_rxffovf"), ("--switch", "NAME=VALUE")),
        (("--switch", "rxffovf=newest"), ("rxffovf",)),
        (("--serial", "uart=pty"), ("'uart'", "'scia'")),
        (("--serial", "scia=pty", "--serial", "scia=pty"), ("scia",)),
    ):
        done = ins("run", "echo", *options)
        assert done.returncode == 2 and len(done.stderr.strip().splitlines()) == 1, done.stderr
        assert all(word in done.stderr for word in words), done.stderr
    done = ins("run", "default", "--access-log", tmp_path / "a")
    assert done.returncode == 2 and "F2812" in done.stderr and "--itrace" in done.stderr
    assert list(tmp_path.iterdir()) == []


def test_faults_of_a_scenario(summary, variant):
    tail = """
[[fault]]
kind = "reset"
at_s = 0.1

[[fault]]
kind = "wire_short"
net = "SCITXDA"
to = "gnd"
from_s = 0.2
to_s = 0.21

[[fault]]
kind = "baud"
ppm = 1000.0

[[expect]]
value = "faults.1.wire_short"
at_least = 1
"""
    result = summary(variant(tail), code=1)
    assert result["faults"] == {"0": {"reset": 1}, "1": {"wire_short": 1}, "2": {"baud": 1}}
    assert result["cpu"]["starts"] == 2
    host = result["hosts"]["scia"]
    assert host["octets_received"] == 2 * len(GREETING) + 1 and host["framing_errors"] == 1
    assert result["failed"] == ["hosts.scia.framing_errors = 1, expected at most 0"]


@pytest.mark.parametrize(
    ("lines", "words"),
    [
        ('kind = "iram_flip"\nat_s = 1', ("fault.0.kind", "'iram_flip'", "compiled for this machine")),
        ('kind = "adc_noise"\nlsb = 1.0', ("fault.0.kind", "TLC2543", "wire_short")),
        ('kind = "wire_cut"\nnet = "P1.0"', ("fault.0.net", "'P1.0'", "SCIRXDA")),
        ('kind = "wire_short"\nnet = "SCITXDA"\nto = "SCIRXDA"', ("fault.0.to", "'SCIRXDA'", "gnd or vcc")),
        ('kind = "break"\nline = "to_board"', ("fault.0.line", "'to_board'", "'SCIRXDA'")),
        ('kind = "baud"\nppm = 1.0\nstation = "dsp"', ("fault.0.kind", "'baud'")),
        ('kind = "reset"\nat_s = 1.0\nstation = "d"', ("fault.0.station", "'d'", "dsp, scia")),
        ('kind = "wire_cut"\nnet = "SCIRXDB"', ("fault.0", "SCIRXDB", "with a line")),
    ],
)
def test_bad_faults(ins, variant, lines, words):
    done = ins("run", variant(f"\n[[fault]]\n{lines}\n"))
    assert done.returncode == 2 and len(done.stderr.strip().splitlines()) == 1, done.stderr
    assert all(word in done.stderr for word in words), done.stderr


@pytest.mark.wall_clock
def test_the_outside_plays_the_host(tmp_path):
    """Over a pty at real time: the greeting comes, and what is sent comes back."""
    command = [sys.executable, "-m", "libins", "run", "echo", "--serial", f"scia=pty:{tmp_path / 'tty'}", "--wait"]
    run = subprocess.Popen([*command, "--stop-s", "2"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        while not (tmp_path / "tty").exists():
            assert run.poll() is None, run.stderr.read()
            time.sleep(0.02)
        line = os.open(tmp_path / "tty", os.O_RDWR | os.O_NOCTTY)
        came = b""
        while GREETING not in came:
            came += os.read(line, 64)
        os.write(line, b"over the pty")
        while b"over the pty" not in came:
            came += os.read(line, 64)
        os.close(line)
    finally:
        out, err = run.communicate(timeout=60)
    assert run.returncode == 0, out + err


def test_a_program_that_dies_is_named(ins, write, tmp_path):
    script = tmp_path / "dies.f2812"
    script.write_bytes(Path("/bin/false").read_bytes())
    script.chmod(0o755)
    done = ins("run", write('schema = 1\nboard = "f2812"\nfirmware = "dies.f2812"\nstop_s = 1.0\n'))
    assert done.returncode == 3, done.stdout + done.stderr
    assert "dies.f2812" in done.stderr and "dsp" in done.stderr and "Traceback" not in done.stderr


def test_a_program_that_ends_ends_the_run(summary, write):
    path = write('schema = 1\nboard = "f2812"\nfirmware = "loopback_fifo.f2812"\nstop_s = 60.0\n')
    ended = summary(path)
    assert ended["program"] == {"ended": "main() returned", "exit_code": 0}
    assert 0.01 < ended["sim_s"] < 60 and ended["cpu"]["interrupts"] > 0 and ended["reports"] == []


def test_vcd_of_both_boards(ins, write, tmp_path):
    path = tmp_path / "both.vcd"
    done = ins("run", write(BOTH), "--vcd", path, "--stop-s", 0.1)
    assert done.returncode == 0, done.stdout + done.stderr
    nets = set(VCDVCD(str(path)).signals)
    assert {"dsp.SCITXDA", "dsp.SCIRXDA", "dsp.SCITXDB", "acq.TXD", "acq.RXD"} <= nets and "dsp.SCIRXDB" not in nets
    text = path.read_text(encoding="ascii")
    key = re.search(r"\$var string 1 (\S+) RXD_octet \$end", text)[1]
    answers = re.findall(rf"^s([0-9A-F]{{2}}!?) {re.escape(key)}$", text, re.MULTILINE)
    assert set(answers) == {"BB", "00"}  # the host lets each block come and takes it


def test_a_campaign_goes_on_after_a_program_that_dies(ins, write, tmp_path):
    program = tmp_path / "dies.f2812"
    program.write_bytes(Path("/bin/false").read_bytes())
    program.chmod(0o755)
    head = 'schema = 1\nboard = "f2812"\nfirmware = "dies.f2812"\nstop_s = 0.1\n\n[campaign]\n'
    path = write(head + 'firmware = { list = ["dies.f2812", "echo.f2812"] }\n')
    done = ins("campaign", path, "--runs", 4, "--jobs", 1, "--out", tmp_path / "c")
    assert done.returncode == 1 and "2 pass, 2 crash" in done.stdout, done.stdout + done.stderr
    rows = list(csv.DictReader((tmp_path / "c/table.csv").open(encoding="utf-8")))
    assert [row["outcome"] for row in rows] == ["pass", "crash"] * 2
    assert "dies.f2812" in rows[1]["error"]


def test_campaign_with_processes_and_dask_is_the_same(ins, variant, tmp_path):
    path = variant("\n[campaign]\nsci.a.bit_error = { uniform = [0.0, 2e-3] }\nsci.a.baud = { normal = [9600, 300] }\n")
    tables = []
    for name, options in (("one", ["--jobs", 1]), ("two", ["--jobs", 2]), ("dask", ["--dask", "local:1"])):
        done = ins("campaign", path, "--runs", 6, "--out", tmp_path / name, "--set", "stop_s=0.1", *options)
        assert done.returncode in (0, 1), done.stdout + done.stderr
        tables.append((tmp_path / name / "table.csv").read_bytes())
    assert tables[0] == tables[1] == tables[2]
    rows = list(csv.DictReader(tables[0].decode().splitlines()))
    assert len(rows) == 6 and {row["outcome"] for row in rows} <= {"pass", "fail"}
    assert len({row["set.sci.a.baud"] for row in rows}) == 6
    assert all(int(row["hosts.scia.octets_received"]) > 0 for row in rows)


def test_no_process_is_left(ins):
    assert ins("run", "echo", "--stop-s", 0.1).returncode == 0
    left = [p for p in Path("/proc").glob("[0-9]*/cmdline") if b"echo.f2812" in _read(p)]
    mine = [p for p in left if str(os.getpid()) in _read(p.with_name("status")).decode(errors="replace")]
    assert mine == []


def _read(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError:
        return b""
