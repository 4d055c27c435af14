"""The report of a run: one page that needs nothing else, and what it shows around failures is what was on the lines."""

import re
import shutil
from html.parser import HTMLParser

import numpy as np
import pytest
from conftest import ROOT
from libins.cli import main
from libins.machine import COLUMNS

from libins import moments, observe, run, scenario, uart

STOP_S = 4.0
CUT_S = 3.0
SPAN_PS = round(moments.SPAN_S * 1e12)
OCTETS_MAX = 1_000_000
BROKEN = f"""
[[expect]]
value = "age_s.max"
at_most = 1e-3

[[fault]]
kind = "wire_cut"
net = "TXD"
from_s = {CUT_S}
to_s = {CUT_S + 0.1}
"""
CALIB = ROOT / "tests/data/imu_tk_xsens/xsens.toml"


@pytest.fixture(scope="module")
def broken(tmp_path_factory):
    """A run whose line is cut for a while: its result, all edges of its wires, and its page."""
    folder = tmp_path_factory.mktemp("broken")
    path = folder / "broken.toml"
    text = scenario.find("default").read_text(encoding="utf-8").replace("stop_s = 24.0", f"stop_s = {STOP_S}")
    path.write_text(text + BROKEN, encoding="utf-8")
    loaded = scenario.load(path)
    edges: dict[str, list] = {}

    def trace(wires, block):
        for at, wire, level in block.tolist():
            edges.setdefault(wires[wire], []).append((at, bool(level)))

    watch = observe.Observation(loaded, observe.Wanted(view_s=1.0))
    result = run.execute(loaded, run.Options(explain=True, trace=trace, watch=watch))
    page = folder / "broken.html"
    assert main(["run", str(path), "--report", str(page)]) == 1
    return result, edges, page.read_text(encoding="utf-8"), watch


def test_a_failed_run_shows_its_fault_and_what_it_did(broken):
    result, _, _, _ = broken
    titles = [moment.title for moment in result.moments]
    assert f"fault 0, wire_cut on TXD, begins at {CUT_S:.6f} s" in titles
    assert any(title.startswith("link.lost = ") and "the first sample that did not come" in title for title in titles)
    assert any(title.startswith("age_s.max = ") for title in titles)
    at = [moment.view.at_ps for moment in result.moments]
    assert at == sorted(at)


def test_the_lines_around_an_instant_are_those_of_the_trace(broken):
    result, edges, _, _ = broken
    assert len(result.moments) >= 3
    for moment in result.moments:
        begin, end = moment.view.at_ps - SPAN_PS, moment.view.at_ps + SPAN_PS
        assert any(len(shown) > 1 for shown in moment.view.nets.values())
        for net, shown in moment.view.nets.items():
            inside = [edge for edge in edges[net] if begin <= edge[0] <= end]
            before = [level for at, level in edges[net] if at < begin]
            assert shown[1:] == inside, (moment.title, net)
            assert not before or shown[0][1] == before[-1]


def test_their_octets_are_those_of_the_line(broken):
    result, edges, page, _ = broken
    end_ps = round(STOP_S * 1e12)
    whole = {net: list(uart.Decoder(9600).feed(edges[net], end_ps)) for net in ("TXD", "RXD")}
    for moment in result.moments:
        for net, frames in whole.items():
            near = [frame for frame in frames if abs(frame.begin_ps - moment.view.at_ps) <= SPAN_PS]
            assert moment.view.frames[net] == near
    for net, frames in whole.items():
        line = result.lines[net]
        begins = [frame.begin_ps for frame in frames]
        assert (line.octets, line.bad) == (len(frames), sum(not frame.framing_ok for frame in frames))
        assert line.shortest_ps == min(np.diff(begins))
        assert f"<td>{net}</td><td>9600</td><td>{len(frames)}</td>" in page


def test_the_worst_instant_is_that_of_the_states(broken):
    result, _, _, _ = broken
    ages = result.states[:, COLUMNS["age_s"]]
    worst = result.states[ages.argmax(), COLUMNS["t_s"]]
    (moment,) = [moment for moment in result.moments if moment.title.startswith("age_s.max")]
    assert moment.view.at_ps == round(worst * 1e12)
    (gap,) = [moment for moment in result.moments if moment.title.startswith("link.lost")]
    first = np.flatnonzero(result.states[:, COLUMNS["bridged"]])[0]
    before = result.states[first - 1, COLUMNS["t_s"]]
    assert gap.view.at_ps == pytest.approx((before + 0.02 + moments.SPAN_S / 2) * 1e12, abs=1e6)


def test_the_page_has_verdicts_timing_and_coverage(broken):
    result, _, page, watch = broken
    verdicts = re.findall(r'<span class="outcome (pass|fail)">', page)
    assert verdicts == ["fail" if check.failure else "pass" for check in result.checks]
    assert page.count("<h2>Around failures</h2>") == 1
    sampled = np.diff(result.scans[:, 0]) * 1e6
    assert f"<td>from one scan to the next [us]</td><td>{sampled.min():.3f}</td>" in page
    covered = result.summary["observed"]["coverage"]
    assert f"<td>lines</td><td>{covered['lines']}</td><td>{covered['lines_covered']}</td>" in page
    for name, file in watch.files.items():
        listed = re.search(rf"<td>{name}</td><td>\d+</td><td>\d+</td><td>([^<]*)</td>", page)[1]
        spans = [part.split("-") for part in listed.split(", ") if part]
        numbers = {n for span in spans for n in range(int(span[0]), int(span[-1]) + 1)}
        assert {n for n, ran in file.lines.items() if not ran} <= numbers
        assert not numbers & {n for n, ran in file.lines.items() if ran}


def test_a_run_that_passes_has_no_failures_to_show(tmp_path):
    page = tmp_path / "good.html"
    assert main(["run", "default", "--stop-s", "1", "--report", str(page)]) == 0
    text = page.read_text(encoding="utf-8")
    assert "Around failures" not in text and "<h2>Link</h2>" in text


def test_what_has_no_instant_of_its_own_shows_the_end(tmp_path):
    page = tmp_path / "end.html"
    assert main(["run", "thesis", "--stop-s", "2", "--report", str(page)]) == 1
    text = page.read_text(encoding="utf-8")
    assert "expected at least 770: the end of what the run had on its lines" in text
    assert "its compiler's: gcov" in text


def test_without_debug_information_instructions_are_counted(tmp_path):
    image = tmp_path / "bare.ihx"
    shutil.copy(scenario.load(scenario.find("default")).firmware, image)
    page, trace, table = tmp_path / "r.html", tmp_path / "i.txt", tmp_path / "j.json"
    options = ["--firmware", image, "--stop-s", 0.5, "--report", page, "--itrace", trace, "--json", table]
    assert main(["run", "default", *map(str, options)]) == 0
    addresses = {line.split()[1] for line in trace.read_text(encoding="utf-8").splitlines() if not line.startswith("#")}
    shown = re.search(r"instructions \(no debug[^<]*</td><td>-</td><td>(\d+)</td>", page.read_text(encoding="utf-8"))
    assert shown and int(shown[1]) == len(addresses)


class Assets(HTMLParser):
    """What a page would load, and what it runs."""

    def __init__(self) -> None:
        super().__init__()
        self.found: list[str] = []
        self.pictures = 0

    def handle_starttag(self, tag: str, attrs: list) -> None:
        self.pictures += tag == "svg"
        if tag in ("script", "link", "iframe", "object", "embed", "img"):
            self.found.append(tag)
        for name, value in attrs:
            if name in ("src", "href", "xlink:href", "data", "srcset", "action") and not str(value).startswith("#"):
                self.found.append(f"{tag} {name}={value}")
            if re.search(r"url\((?!['\"]?#)", str(value)):
                self.found.append(f"{tag} {name}={value}")

    def handle_data(self, data: str) -> None:
        if re.search(r"@import|url\((?!['\"]?#)", data):
            self.found.append(data)


@pytest.fixture(scope="module")
def pages(broken, tmp_path_factory):
    folder = tmp_path_factory.mktemp("pages")
    commands = {
        "net": ["run", "echo", "--report-at", "0.012", "--report"],
        "calib": ["calib", str(CALIB), "--out", str(folder / "c.toml"), "--report"],
    }
    texts = {"run": broken[2]}
    for name, command in commands.items():
        page = folder / f"{name}.html"
        assert main([*command, str(page)]) == 0
        texts[name] = page.read_text(encoding="utf-8")
    page = folder / "replay.html"
    walk = ROOT / "tests/data/walk_0827/walk.toml"
    assert main(["replay", str(walk), "--html", str(page)]) == 0
    return texts | {"replay": page.read_text(encoding="utf-8")}


@pytest.mark.parametrize("name", ["run", "net", "calib", "replay"])
def test_a_page_needs_nothing_else_and_is_readable_light_and_dark(pages, name):
    text = pages[name]
    assets = Assets()
    assets.feed(text)
    assert assets.found == []
    assert assets.pictures >= 1
    assert "prefers-color-scheme: dark" in text and "#000000" not in text
    assert len(text.encode()) < OCTETS_MAX
