"""The report's pictures: what they say is what happened."""

import re

import pytest

from libins import observe, run, scenario

AT_S = 1.0
STOP_S = 2.0
PERIOD_S = 0.02
HEADER, ACCEPTED, ANSWER = "AA", "BB", "00"


@pytest.fixture(scope="module")
def seen():
    """The result and view of a run."""
    loaded = scenario.load(scenario.find("default"), settings={"stop_s": STOP_S})
    watch = observe.Observation(loaded, observe.Wanted(view_s=AT_S))
    return run.execute(loaded, run.Options(watch=watch)), watch.view


@pytest.fixture(scope="module")
def report(ins, tmp_path_factory):
    path = tmp_path_factory.mktemp("views") / "r.html"
    done = ins("run", "default", "--stop-s", STOP_S, "--report", path, "--report-at", AT_S)
    assert done.returncode == 0, done.stderr
    return path.read_text(encoding="utf-8")


def texts(page: str, heading: str) -> list[str]:
    """What is written in the picture under a heading."""
    picture = page.partition(f"<h2>{heading}</h2>")[2].partition("</svg>")[0]
    return re.findall(r"<text[^>]*>([^<]+)</text>", picture)


def test_the_scan_shown_is_the_first_after_the_instant(seen, report):
    result, _ = seen
    scan = next(row for row in result.scans if row[0] >= AT_S)
    written = texts(report, "On the pins")
    for channel, code in enumerate(scan[3:6]):
        assert f"AIN{channel} {int(code):03X}h" in written
    assert {"/CS", "I/O CLOCK", "DATA IN", "DATA OUT", "EOC", "TXD", "RXD"} <= set(written)


def test_the_exchange_shown_carries_the_codes_of_the_scan(seen, report):
    result, _ = seen
    scan = next(row for row in result.scans if row[0] >= AT_S)
    written = texts(report, "On the pins")
    octets = [text for text in written[written.index(HEADER) :] if re.fullmatch(r"[0-9A-F]{2}!?", text)]
    lows = [f"{int(code) & 0xFF:02X}" for code in scan[3:6]]
    assert octets[2:7:2] == lows, "after the high octet of each, which has bits of the block's number too"
    assert {ACCEPTED, ANSWER} <= set(written)


def test_the_oscilloscope_has_each_sample_on_its_curve(seen):
    _, view = seen
    assert len(view.samples) == 4 * round(1.0 / PERIOD_S)
    assert view.volts[0, 0] == pytest.approx(AT_S - 0.5)
    assert view.volts[-1, 0] == pytest.approx(AT_S + 0.5)
    for at, channel, _, volts in view.samples:
        after = int((view.volts[:, 0] <= at / 1e12).sum())
        if 0 < after < len(view.volts):
            near = view.volts[after - 1 : after + 1, 1 + channel]
            assert min(near) - 1e-5 <= volts <= max(near) + 1e-5


def test_a_report_has_the_profile(ins, tmp_path):
    path = tmp_path / "p.html"
    options = ["--set", "firmware=acq_default_debug.ihx", "--stop-s", 1, "--profile", tmp_path / "p.txt"]
    done = ins("run", "default", *options, "--report", path)
    assert done.returncode == 0, done.stderr
    page = path.read_text(encoding="utf-8")
    assert (tmp_path / "p.txt").read_text(encoding="utf-8").splitlines()[1] in page
    assert re.search(r"<tr><td>lines</td><td>\d+</td><td>\d+</td></tr>", page)


def test_pictures_only_where_there_is_something_to_show(ins, tmp_path, report):
    assert "<h2>At the converter</h2>" in report
    silent = tmp_path / "silent.html"
    assert ins("run", "default", "--stop-s", 0.01, "--report", silent).returncode in (0, 1)
    assert "<h2>On the pins</h2>" not in silent.read_text(encoding="utf-8")
    outside = ins("run", "default", "--stop-s", 1, "--report", silent, "--report-at", 1.5)
    assert outside.returncode == 2
    assert "--report-at 1.5: must lie in 0 .. 1, the simulated seconds" in outside.stderr
