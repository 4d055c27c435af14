"""Each control of the page of `ins view`, clicked in a browser before the real engine: what the engine then does."""

import math
import re

import pytest
from page_kit import Desk, chromium, serving

from libins import scenario

pytestmark = pytest.mark.wall_clock

WARM_S = 0.3
"""Simulated, after which blocks pass."""
LINE = "ins_hs_board_tx"
"""In a line of acq.c that has code."""


@pytest.fixture(scope="module")
def desk():
    with serving("default") as (_, url), chromium() as browser:
        opened = Desk(browser, url)
        opened.run_for(WARM_S)
        yield opened
        assert opened.complaints == []


def broken_lines(desk):
    return [each["line"]["number"] for each in desk.state("breaks") if each["line"]]


def test_run_and_pause(desk):
    before = desk.state("t_ps")
    desk.page.click("#do-run")
    desk.until(f"insView.state.running && insView.state.t_ps > {before} + 2e11")
    assert desk.find("#do-step").is_disabled() and desk.find("#do-run").inner_text() == "Pause"
    desk.page.click("#do-run")
    desk.settle()
    stands = desk.state("t_ps")
    assert desk.ask("registers")["ok"] and desk.state("t_ps") == stands
    assert desk.find("#status-time").inner_text() == f"{stands * 1e-12:.9f} s"
    assert desk.find("#status-state").inner_text().startswith("stopped")


def test_steps_and_the_way_back(desk):
    begin = desk.state("t_ps")
    first = desk.press_and_settle("#do-step")
    place = desk.state("place")
    second = desk.press_and_settle("#do-step_over")
    assert begin < first < second
    assert desk.press_and_settle("#do-step_back") == first and desk.state("place") == place
    assert desk.press_and_settle("#do-step_over_back") < first
    desk.show("disassembly")
    at, pc = desk.state("t_ps"), desk.state("pc")
    assert desk.press_and_settle("#do-stepi") > at
    assert desk.press_and_settle("#do-stepi-back") == at and desk.state("pc") == pc
    desk.show("source")


def test_a_line_is_a_breakpoint_by_click_and_by_key(desk):
    desk.find("#panel-source input[aria-label='Follow the board']").uncheck()
    desk.find("#source-file").select_option("acq.c")
    desk.until("document.querySelector('#panel-source .code .has') !== null")
    number = int(desk.find("#panel-source .code .has", has_text=LINE).locator(".number").inner_text())
    desk.js(f"document.getElementById('source-{number - 1}').scrollIntoView()")
    desk.page.click(f"#source-{number - 1} .gutter")
    desk.until("insView.state.breaks.length === 1")
    assert broken_lines(desk) == [number]
    desk.until(f"document.getElementById('source-{number - 1}').dataset.break === 'true'")
    desk.page.click(f"#source-{number - 1} .number")
    desk.press("b", "#panel-source .code")
    desk.until("insView.state.breaks.length === 0")
    desk.press("ArrowDown", "#panel-source .code")
    chosen = desk.find("#panel-source .cursor").get_attribute("id")
    assert chosen == f"source-{number}"
    desk.find("#panel-source input[aria-label='Follow the board']").check()


def test_breakpoints_stop_the_board_forwards_and_backwards(desk):
    desk.show("breakpoints")
    desk.find("#break-at").fill("transmit")
    desk.find("#break-condition").fill("sampled > 2")
    desk.page.click("#break-add")
    desk.until("insView.state.breaks.length === 1")
    first = desk.press_and_settle("#do-run")
    assert desk.state("stop.kind") == "breakpoint" and "transmit" in desk.state("place")
    second = desk.press_and_settle("#do-run")
    hits = desk.state("breaks")[0]["hits"]
    assert desk.find("#panel-breakpoints td.number").inner_text() == str(hits) and hits >= 2
    assert desk.press_and_settle("#do-run_back") == first < second
    assert "transmit" in desk.state("place")
    assert desk.press_and_settle("#do-finish") > first and "transmit" not in desk.state("place")
    desk.page.click("#panel-breakpoints button:text('Remove')")
    desk.until("insView.state.breaks.length === 0")
    desk.show("source")
    line = desk.state("line")["number"]
    desk.until(f"document.getElementById('source-{line - 1}').classList.contains('here')")


def test_a_breakpoint_that_cannot_be_is_said(desk):
    desk.show("breakpoints")
    desk.find("#break-at").fill("no_such_function")
    desk.page.click("#break-add")
    desk.until("!document.getElementById('message').hidden")
    assert "no_such_function" in desk.find("#message").inner_text()
    desk.page.click("#message button")
    assert desk.find("#message").is_hidden()
    desk.find("#break-at").fill("")


def test_disassembly_breaks_at_an_instruction(desk):
    desk.show("disassembly")
    pc = desk.state("pc")
    desk.until("document.querySelector('#panel-disassembly .here') !== null")
    assert desk.find("#panel-disassembly .here .number").inner_text() == f"{pc:04X}"
    desk.page.click("#panel-disassembly .here .gutter")
    desk.until("insView.state.breaks.length === 1")
    assert desk.state("breaks")[0]["addresses"] == [pc]
    desk.press("b", "#panel-disassembly .code")
    desk.until("insView.state.breaks.length === 0")


def test_registers_and_memory_are_the_engines(desk):
    desk.show("registers")
    desk.until("document.querySelector('#registers b').textContent !== ''")
    shown = dict(
        zip(desk.find("#registers span").all_inner_texts(), desk.find("#registers b").all_inner_texts(), strict=True)
    )
    assert {name: int(text, 16) for name, text in shown.items()} == desk.ask("registers")["registers"]
    desk.show("memory")
    desk.find("#memory-space").select_option("code")
    desk.find("#memory-address").fill("10")
    desk.find("#memory-count").fill("16")
    desk.press("Enter", "#memory-count")
    want = bytes.fromhex(desk.ask("memory", space="code", address=16, count=16)["octets"])
    desk.until("document.querySelector('#memory-octets').textContent.split('\\n').length === 2")
    rows = desk.find("#memory-octets").inner_text().split("\n")
    found = bytes.fromhex("".join(re.match(r"[0-9A-F]{4}  ((?:[0-9A-F]{2} )+)", row)[1] for row in rows))
    assert found == want and rows[0].startswith("0010")


def test_watched_expressions(desk):
    desk.show("watch")
    desk.find("#watch-input").fill("sampled")
    desk.page.click("#watch-add")
    desk.until("document.querySelector('#watches td.number') !== null")
    before = int(desk.find("#watches td.number").inner_text())
    desk.run_for(0.1)
    desk.until(f"Number(document.querySelector('#watches td.number').textContent) > {before}")
    desk.find("#watch-input").fill("no_such_name")
    desk.page.click("#watch-add")
    desk.until("document.querySelectorAll('#watches tr').length === 2")
    assert "no_such_name" in desk.find("#watches td.bad").inner_text()
    desk.page.click("#watches tr:nth-child(2) button")
    desk.page.click("#watches tr:nth-child(1) button")
    desk.until("document.querySelectorAll('#watches tr').length === 0")


def test_the_terminal_sends_and_shows(desk):
    desk.find("#terminal-input").fill("06 1")
    desk.page.click("#terminal-send")
    desk.until("!document.getElementById('message').hidden")
    assert "06 1" in desk.find("#message").inner_text()
    desk.page.click("#message button")
    desk.find("#terminal-input").fill("51 52 53")
    desk.press("Enter", "#terminal-input")
    desk.until("document.getElementById('terminal-input').value === ''")
    desk.run_for(0.1)
    desk.find("#terminal-who").select_option("rx")
    desk.until("document.getElementById('terminal-out').textContent.includes('51 52 53')")
    desk.find("#terminal-who").select_option("tx")
    desk.until("!document.getElementById('terminal-out').textContent.includes('→ board')")
    desk.find("#terminal-form").select_option("text")
    assert desk.find("#terminal-end").is_visible()
    desk.find("#terminal-who").select_option("rx")
    desk.until("document.getElementById('terminal-out').textContent.includes('QRS')")
    desk.page.click("#panel-terminal button:text('Clear')")
    desk.until("document.getElementById('terminal-out').textContent === ''")
    desk.find("#terminal-form").select_option("hex")
    desk.find("#terminal-who").select_option("both")


def test_the_schematic_shows_pins_and_chooses_wires(desk):
    desk.settle()
    pins = desk.state("pins")
    shown = desk.js(
        """Object.fromEntries([...document.querySelectorAll('.schematic g')].flatMap((part) => {
            const texts = [...part.querySelectorAll(':scope > text')].map((text) => text.textContent);
            if (!texts.includes('AT89S51')) return [];
            const levels = [...part.querySelectorAll('.level')].map((node) => node.dataset.level);
            return texts.filter((text) => /^P\\d/.test(text)).map((text, i) => [text.slice(0, 4), Number(levels[i])]);
        }))"""
    )
    assert shown == {f"P{port}.{bit}": pins[f"P{port}"] >> bit & 1 for port in range(4) for bit in range(8)}
    volts = desk.find(".schematic .volts").all_text_contents()
    assert volts[0] == f"{desk.state('volts')['0']:.4f} V"
    assert volts[1] == f"code {desk.state('codes')['0']:03X}h"
    net = ".schematic .net[aria-label^='EOC:']"
    assert desk.find(net).get_attribute("aria-pressed") == "true"
    desk.press("Enter", net)
    desk.until("!insView.panel('analyser').wires.includes('EOC')")
    desk.find(f"{net} .hit").click(force=True)
    desk.until("insView.panel('analyser').wires.includes('EOC')")
    box = desk.find("svg.schematic").get_attribute("viewBox")
    desk.page.click("#panel-schematic button[aria-label='Zoom in']")
    assert desk.find("svg.schematic").get_attribute("viewBox") != box
    desk.press("0", "svg.schematic")
    assert desk.find("svg.schematic").get_attribute("viewBox") == box


def test_cursors_measure_between_edges_of_the_engine(desk):
    for wire in desk.js("insView.panel('analyser').wires"):
        if wire != "/CS":
            desk.js(f"insView.panel('analyser').toggle({wire!r})")
    canvas = "#panel-analyser canvas"
    desk.press("a", canvas)
    desk.press("[", canvas)
    desk.press("c", canvas)
    desk.press("]", canvas)
    begin, end = desk.js("[insView.panel('analyser').begin, insView.panel('analyser').end]")
    edges = [t for t, _, _ in desk.ask("edges", wires=["/CS"], from_ps=int(max(0, begin)), to_ps=int(end))["edges"]]
    middle = (begin + end) / 2
    a, c = max(t for t in edges if t < middle), min(t for t in edges if t > middle)
    text = desk.find("#cursors").inner_text()
    assert desk.js("insView.panel('analyser').cursors") == {"A": a, "C": c}
    amount, prefix = re.search(r"dt ([\d.]+) ([nµm]?)s", text).groups()
    assert float(amount) * {"n": 1e-9, "µ": 1e-6, "m": 1e-3, "": 1}[prefix] == pytest.approx((c - a) * 1e-12, rel=1e-5)
    amount, prefix = re.search(r"1/dt ([\d.]+) ([kM]?)Hz", text).groups()
    assert float(amount) * {"k": 1e3, "M": 1e6, "": 1}[prefix] == pytest.approx(1e12 / (c - a), rel=1e-5)
    desk.page.click("#panel-analyser button[aria-label='Take the cursors away']")
    desk.until("insView.panel('analyser').cursors.A === null")
    desk.page.click("#wires summary")
    desk.page.click("#wires input[data-wire='TXD']")
    assert desk.js("insView.panel('analyser').wires") == ["/CS", "TXD"]
    desk.press("Escape")
    assert desk.find("#wires").get_attribute("open") is None


def test_the_analyser_goes_back_to_what_the_engine_keeps(desk):
    page = desk.context.new_page()
    page.goto(desk.url.split("?")[0])
    desk.until("insView.drawn > 0", page)
    page.locator("#scale").select_option("0.005")
    page.evaluate("insView.panel('analyser').live = false")
    page.evaluate("insView.panel('analyser').end = 1.5e11")
    page.click("#panel-analyser button[aria-label^='Zoom out']")
    desk.until("insView.panel('analyser').archive && insView.panel('analyser').edges('/CS').t[0] < 1e11", page)
    begin = page.evaluate("insView.panel('analyser').archive.from")
    want = desk.ask("edges", wires=["/CS"], from_ps=begin, to_ps=begin + 10**11)["edges"][0][0]
    assert page.evaluate("insView.panel('analyser').edges('/CS').t[0]") == want
    page.click("#live")
    assert page.evaluate("insView.panel('analyser').live")
    page.close()


def test_triggers_hold_the_display_and_stop_the_board(desk):
    desk.find("#trigger-wire").select_option("EOC")
    desk.find("#trigger-edge").select_option("fall")
    desk.find("#trigger").select_option("stop")
    desk.until("insView.state.breaks.some((each) => each.kind === 'edge')")
    desk.press_and_settle("#do-run")
    assert desk.state("stop.kind") == "breakpoint" and desk.state("nets.EOC") == 0
    desk.find("#trigger").select_option("hold")
    desk.until("insView.state.breaks.length === 0")
    desk.find("#scale").select_option("0.001")
    desk.run_for(0.05)
    begin, span = desk.js("[insView.panel('analyser').begin, insView.panel('analyser').span]")
    edges = desk.ask("edges", wires=["EOC"], from_ps=int(begin), to_ps=int(begin + span))["edges"]
    assert min(abs(t - begin - 0.2 * span) for t, _, level in edges if not level) < 2
    desk.find("#trigger").select_option("off")
    desk.find("#scale").select_option("0.005")


def test_speed(desk):
    for value, want in (("0.1", 0.1), ("max", "max"), ("1", 1)):
        desk.find("#speed").select_option(value)
        desk.until(f"insView.state.speed === {want!r}")


def test_reset_and_snapshot(desk, tmp_path):
    desk.page.click("#do-reset")
    desk.until("insView.state.faults.some((each) => each.kind === 'reset')")
    desk.run_for(0.01)
    assert [each["hits"] for each in desk.state("faults") if each["kind"] == "reset"] == [1]
    with desk.page.expect_download() as waited:
        desk.page.click("#do-snapshot")
    kept = tmp_path / "kept.snapshot"
    waited.value.save_as(kept)
    with serving(str(kept)) as (_, url):
        other = Desk(desk.context.browser, url)
        assert other.state("t_ps") == desk.state("t_ps")
        assert other.state("registers") == desk.state("registers")
        other.context.close()


def test_plots_follow_the_engine(desk):
    desk.run_for(0.5)
    errors = desk.js("insView.panel('errors').tracks.map((track) => track.v[track.n - 1])")
    assert errors == desk.state("error")
    desk.find("#errors-span").select_option("2")
    assert desk.js("insView.panel('errors').span") == 2
    angles = desk.find("#panel-attitude tr:nth-child(3) td").all_inner_texts()
    assert [float(text) for text in angles] == [
        pytest.approx(each * 57.29577951, abs=0.006) for each in desk.state("estimate.euler")
    ]


def test_knobs_turn_the_board_and_hold_an_input(desk):
    desk.show("knobs")
    desk.find("#knob-rate\\.z").fill("0.5")
    desk.press("Enter", "#knob-rate\\.z")
    desk.until("insView.state.knobs['rate.z'] === 0.5")
    desk.run_for(0.02)
    assert desk.state("truth.w") == pytest.approx([0, 0, 0.5])
    q, begin = desk.state("truth.q"), desk.state("t_ps")
    desk.run_for(0.2)
    turned = 0.5 * (desk.state("t_ps") - begin) * 1e-12
    cosine = sum(a * b for a, b in zip(q, desk.state("truth.q"), strict=True))
    assert turned > 0.09 and abs(cosine) == pytest.approx(math.cos(turned / 2), abs=1e-12)
    slider = "#panel-knobs input[aria-label='Turn the board: Rate z, slider']"
    assert float(desk.find(slider).input_value()) == 0.5
    desk.press("ArrowRight", slider)
    desk.until("insView.state.knobs['rate.z'] === 0.51")
    desk.find("#knob-volts\\.0").fill("1.25")
    desk.press("Enter", "#knob-volts\\.0")
    desk.until("insView.state.knobs['volts.0'] === 1.25")
    desk.run_for(0.1)
    assert (desk.state("volts")["0"], desk.state("codes")["0"]) == (1.25, 1024)
    desk.page.click("#panel-knobs button[aria-label^='Inputs by hand']")
    desk.until("insView.state.knobs['volts.0'] === null")
    desk.page.click("#panel-knobs button[aria-label^='Turn the board']")
    desk.until("insView.state.knobs['rate.z'] === 0")


def test_faults_are_made_by_the_form_counted_and_ended(desk):
    desk.show("faults")
    place = len(desk.state("faults"))
    desk.find("#fault-kind").select_option("adc_offset")
    desk.find("#fault-key-lsb").fill("7")
    desk.page.click("#fault-add")
    desk.until(f"insView.state.faults.length === {place + 1}")
    desk.run_for(0.1)
    assert desk.state("faults")[place]["on"]
    hits = desk.state("faults")[place]["hits"]
    assert hits > 0 and desk.find("#panel-faults td.number").nth(place).inner_text() == str(hits)
    desk.find("#fault-kind").select_option("wire_cut")
    desk.page.click("#fault-add")
    assert desk.find("#fault-key-net:invalid").count() == 1 and len(desk.state("faults")) == place + 1
    desk.find("#panel-faults button:text('Off')").nth(place).click()
    desk.run_for(0.1)
    assert not desk.state("faults")[place]["on"] and desk.state("faults")[place]["hits"] == hits
    assert desk.find("#panel-faults button:text('Off')").nth(place).is_disabled()


def test_what_was_done_is_saved_as_a_scenario(desk, tmp_path):
    with desk.page.expect_download() as waited:
        desk.page.click("#do-save")
    saved = tmp_path / waited.value.suggested_filename
    waited.value.save_as(saved)
    done = scenario.load(saved).tables
    assert [knob.rate_rad_s for knob in done.knob if knob.rate_rad_s][0] == [0.0, 0.0, 0.5]
    assert [fault.kind for fault in done.fault][-1] == "adc_offset"
    assert saved.name in desk.find("#message").inner_text()
    desk.page.click("#message button")


def test_two_pages_see_the_same(desk):
    page = desk.context.new_page()
    page.goto(desk.url.split("?")[0])
    desk.until("insView.drawn > 0", page)
    desk.ask("break_add", at="main")
    desk.until("insView.state.breaks.length === 1", page)
    page.click("#tab-breakpoints")
    page.click("#panel-breakpoints button:text('Remove')")
    desk.until("insView.state.breaks.length === 0")
    page.close()
