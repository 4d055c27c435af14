"""The page of `ins view` as it is looked at and reached: contrast, keyboard, panels, what it loads, its end."""

import pytest
from page_kit import Desk, chromium, serving

pytestmark = pytest.mark.wall_clock

CONTRAST = 4.5
"""WCAG 2.2, 1.4.3."""
PANELS = ("disassembly", "breakpoints", "memory", "watch", "map", "verdicts", "knobs", "faults")
TABS_MOST = 400
TEXTS = """() => {
    const split = (text) => text.match(/[\\d.]+/g).map(Number);
    const behind = (node) => {
        for (let at = node; at; at = at.parentElement) {
            const [r, g, b, a = 1] = split(getComputedStyle(at).backgroundColor);
            if (a === 1) return [r, g, b];
        }
    };
    const found = [];
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    while (walker.nextNode()) {
        const text = walker.currentNode.data.trim();
        const node = walker.currentNode.parentElement;
        if (!text || node.closest("svg") || !node.checkVisibility({ visibilityProperty: true })) continue;
        found.push([text.slice(0, 40), split(getComputedStyle(node).color).slice(0, 3), behind(node)]);
    }
    for (const text of document.querySelectorAll("svg.schematic text")) {
        const fill = split(getComputedStyle(text).fill).slice(0, 3);
        const body = document.querySelector(".schematic .box");
        found.push([text.textContent, fill, split(getComputedStyle(body).fill).slice(0, 3)]);
        found.push([text.textContent, fill, behind(text.closest("svg"))]);
    }
    return found;
}"""
INKS = """() => {
    const style = getComputedStyle(document.documentElement);
    const pairs = (name) => style.getPropertyValue(`--${name}`).match(/[0-9a-f]{2}/gi);
    const colour = (name) => pairs(name).map((pair) => parseInt(pair, 16));
    const names = ["text", "muted", "accent", "bad", "outline", ...[0, 1, 2, 3, 4, 5].map((i) => `trace-${i}`)];
    return names.map((name) => [`--${name} on a canvas`, colour(name), colour("panel")]);
}"""
CONTROLS = """() => [...document.querySelectorAll(
    "button, select, input, summary, [tabindex='0'], [role=separator], [role=application], [role=listbox], .schematic"
)].filter((node) => node.checkVisibility({ visibilityProperty: true }) && !node.disabled && !node.closest("dialog")
    && (node.tabIndex >= 0 || node.getAttribute("role") !== "tab")
)"""


def luminance(rgb):
    parts = [each / 255 for each in rgb]
    linear = [each / 12.92 if each <= 0.04045 else ((each + 0.055) / 1.055) ** 2.4 for each in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(ink, paper):
    light, dark = sorted((luminance(ink), luminance(paper)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


@pytest.fixture(scope="module")
def browser():
    with chromium() as started:
        yield started


@pytest.fixture(scope="module")
def url():
    with serving("default") as (_, address):
        yield address


@pytest.fixture(scope="module")
def desk(browser, url):
    opened = Desk(browser, url)
    yield opened
    assert opened.complaints == []


def test_contrast_is_what_the_standard_says():
    assert contrast((255, 255, 255), (0, 0, 0)) == pytest.approx(21.0)
    assert contrast((0x76, 0x76, 0x76), (255, 255, 255)) == pytest.approx(4.54, abs=0.01)


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_every_text_can_be_read(desk, scheme):
    desk.page.emulate_media(color_scheme=scheme)
    desk.run_for(0.1)
    weak = []
    for panel in (None, *PANELS):
        if panel and desk.find(f"#tab-{panel}").is_visible():
            desk.show(panel)
        texts = desk.js(f"({TEXTS})()") + desk.js(f"({INKS})()")
        assert len(texts) > 200
        weak += [(text, ink, paper) for text, ink, paper in texts if contrast(ink, paper) < CONTRAST]
    assert weak == []
    desk.page.emulate_media(color_scheme="light")


def test_the_two_schemes_differ(desk):
    colours = []
    for scheme in ("light", "dark"):
        desk.page.emulate_media(color_scheme=scheme)
        colours.append(desk.js("getComputedStyle(document.body).backgroundColor"))
    assert len(set(colours)) == 2
    desk.page.emulate_media(color_scheme="light")


@pytest.mark.parametrize("size", [(1280, 800), (2200, 1200)])
def test_nothing_is_cut_off_or_scrolls_sideways(desk, size):
    desk.page.set_viewport_size({"width": size[0], "height": size[1]})
    cut = desk.js(
        """() => [...document.querySelectorAll("#toolbar :is(button, select), .tabs button, .row :is(button, select)")]
            .filter((node) => node.checkVisibility())
            .filter((node) => {
                const box = node.getBoundingClientRect();
                const slot = (node.closest(".slot") ?? document.body).getBoundingClientRect();
                const outside = box.right > slot.right + 1 || box.left < slot.left - 1;
                return outside || (node.tagName === "BUTTON" && node.scrollWidth > node.clientWidth + 1);
            }).map((node) => node.id || node.textContent)"""
    )
    assert cut == []
    assert desk.js(
        "document.documentElement.scrollWidth <= innerWidth && document.documentElement.scrollHeight <= innerHeight"
    )
    desk.page.set_viewport_size({"width": 1280, "height": 800})


def test_every_control_is_reached_by_tab_with_a_focus_that_is_seen_and_a_name(desk):
    count = desk.js(f"({CONTROLS})().map((node, i) => (node.dataset.control = i)).length")
    assert count > 60
    desk.js("document.activeElement.blur()")
    reached, unseen = set(), []
    for _ in range(TABS_MOST):
        desk.page.keyboard.press("Tab")
        at = desk.js(
            """() => {
                const node = document.activeElement;
                const style = getComputedStyle(node);
                const wire = node.querySelector?.(":scope > .wire");
                const thick = wire && parseFloat(getComputedStyle(wire).strokeWidth) >= 3;
                const seen = style.outlineStyle !== "none" || node.matches(".separator") || Boolean(thick);
                return [node.dataset?.control ?? null, seen, node.outerHTML.slice(0, 80)];
            }"""
        )
        if at[0] in reached:
            break
        if at[0] is not None:
            reached.add(at[0])
            unseen += [] if at[1] else [at[2]]
    missing = desk.page.evaluate(
        f"""(reached) => ({CONTROLS})().filter((node) => !reached.includes(node.dataset.control))
            .map((node) => node.outerHTML)""",
        list(reached),
    )
    assert missing == [] and unseen == []
    nameless = desk.js(
        f"""({CONTROLS})().filter((node) => {{
            const label = node.getAttribute("aria-label") || node.labels?.[0]?.textContent || node.textContent;
            return !label.trim();
        }}).map((node) => node.outerHTML.slice(0, 80))"""
    )
    assert nameless == []


def test_keys_do_what_the_list_of_keys_says(desk):
    begin = desk.state("t_ps")
    desk.press("s")
    desk.until(f"insView.state.t_ps > {begin}")
    desk.settle()
    at = desk.state("t_ps")
    desk.press("s")
    desk.until(f"insView.state.t_ps > {at}")
    desk.settle()
    desk.press("S")
    desk.until(f"insView.state.t_ps === {at}")
    desk.press("r")
    desk.until("insView.state.running")
    desk.press("r")
    desk.settle()
    desk.press("3")
    assert desk.js("document.activeElement.id") == "tab-source"
    desk.page.keyboard.press("ArrowRight")
    assert desk.js("document.activeElement.id") == "tab-disassembly" and desk.find("#panel-disassembly").is_visible()
    desk.press("?")
    desk.until("document.querySelector('dialog').open")
    desk.page.locator("dialog input").uncheck()
    desk.page.keyboard.press("Escape")
    desk.until("!document.querySelector('dialog').open")
    at = desk.state("t_ps")
    desk.press("s")
    assert desk.ask("registers")["ok"] and desk.state("t_ps") == at
    desk.js("document.querySelector('dialog input').click()")
    desk.find("#watch-input").evaluate("(node) => node.blur()")


def test_panels_close_open_fill_and_move(desk):
    desk.show("errors")
    desk.page.click("#panel-errors >> xpath=ancestor::section >> button[aria-label='Close this panel']")
    assert desk.find("#tab-errors").is_hidden() and desk.find("#panel-verdicts").is_visible()
    desk.page.click("#panels summary")
    assert not desk.find("#open-errors").is_checked()
    desk.find("#open-errors").check()
    assert desk.find("#panel-errors").is_visible()
    desk.press("Escape")
    desk.page.click("#panel-schematic >> xpath=ancestor::section >> button[aria-label^='Fill']")
    assert desk.js("document.querySelector('.slot.full').offsetWidth") > 1200
    desk.press("Escape")
    assert desk.js("document.querySelector('.slot.full')") is None
    bar = desk.find(".separator[aria-orientation='vertical']").first
    before, width = bar.get_attribute("aria-valuenow"), desk.js("document.querySelector('.column').offsetWidth")
    bar.press("ArrowLeft")
    assert bar.get_attribute("aria-valuenow") != before
    assert desk.js("document.querySelector('.column').offsetWidth") < width
    bar.press("ArrowRight")
    assert bar.get_attribute("aria-valuenow") == before


def test_nothing_leaves_this_machine_and_the_policy_holds(desk):
    host = desk.url.split("/")[2]
    assert len(desk.requests) > 20
    assert {address.split("/")[2] for address in desk.requests} == {host}
    violated = desk.js(
        """() => new Promise((done) => {
            const found = [];
            document.addEventListener("securitypolicyviolation", (event) => found.push(event.effectiveDirective));
            const script = document.createElement("script");
            script.textContent = "window.injected = true";
            document.body.append(script);
            fetch("http://127.0.0.2:9/").catch(() => setTimeout(() => done([found, window.injected ?? null]), 200));
        })"""
    )
    assert set(violated[0]) == {"script-src-elem", "connect-src"} and violated[1] is None
    refused = [each for each in desk.complaints if "Content Security Policy" in each]
    assert len(refused) >= 2
    for each in refused:
        desk.complaints.remove(each)


def test_the_end_of_the_engine_is_said(browser):
    with serving("default") as (process, url):
        desk = Desk(browser, url)
        process.terminate()
        process.wait(timeout=60)
        desk.until("!document.getElementById('message').hidden")
        assert "Start it again" in desk.find("#message").inner_text()
        assert desk.find("#status-state").inner_text() == "not connected"
        assert desk.find("#do-run").is_disabled() and desk.find("#do-step").is_disabled()
        desk.context.close()
