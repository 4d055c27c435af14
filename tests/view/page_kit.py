"""What the tests of the page share: `ins view` as a user starts it, and Debian's Chromium before it."""

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, Page, sync_playwright

ROOT = Path(__file__).resolve().parents[2]
FIRMWARE = ROOT / "emu/8051_tlc2543/firmware"
CHROMIUM = Path("/usr/bin/chromium")
LIMIT_MS = 60_000
"""Of any wait, on a slow and loaded machine."""
END_S = 30
SIZE = {"width": 1280, "height": 800}


@contextmanager
def serving(*arguments: str) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """`ins view`, and the address that it printed."""
    command = [sys.executable, "-m", "libins", "view", *arguments, "--no-browser", "--source", str(FIRMWARE)]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=os.environ)
    try:
        assert process.stdout is not None
        yield process, process.stdout.readline().strip()
    finally:
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=END_S)


@contextmanager
def chromium() -> Iterator[Browser]:
    """The browser, headless."""
    if not CHROMIUM.exists():
        pytest.fail(f"{CHROMIUM} is missing: apt-get install chromium")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=str(CHROMIUM), args=["--no-sandbox"])
        yield browser
        browser.close()


class Desk:
    """One page before one engine, and all that it asked for and complained of."""

    def __init__(self, browser: Browser, url: str, **context: Any) -> None:
        """Opened, and the first frame drawn."""
        self.url = url
        self.requests: list[str] = []
        self.complaints: list[str] = []
        self.context = browser.new_context(viewport=SIZE, **context)
        self.context.set_default_timeout(LIMIT_MS)
        self.context.on("request", lambda request: self.requests.append(request.url))
        self.context.on("console", lambda message: self._hear(message.type, message.text))
        self.context.on("weberror", lambda error: self.complaints.append(str(error.error)))
        self.page = self.context.new_page()
        self.page.on("websocket", lambda socket: self.requests.append(socket.url))
        self.page.goto(url)
        self.until("insView.drawn > 0")

    def _hear(self, kind: str, text: str) -> None:
        if kind in ("error", "warning"):
            self.complaints.append(text)

    def state(self, name: str) -> Any:
        """Of the newest frame."""
        return self.page.evaluate(f"insView.state.{name}")

    def js(self, expression: str) -> Any:
        """What an expression is worth in the page."""
        return self.page.evaluate(expression)

    def ask(self, name: str, **arguments: Any) -> Any:
        """The engine, beside the page's own controls."""
        return self.page.evaluate("([name, arguments]) => insView.link.ask(name, arguments)", [name, arguments])

    def until(self, condition: str, page: Page | None = None) -> None:
        """Wait for it, here or in another page of the same engine.

        A function, since the policy of the page forbids to evaluate text.
        """
        (page or self.page).wait_for_function(f"() => ({condition})")

    def find(self, selector: str, **filters: Any) -> Locator:
        """In the page."""
        return self.page.locator(selector, **filters)

    def show(self, panel: str) -> None:
        """Bring a panel to the front."""
        self.page.click(f"#tab-{panel}")

    def press(self, key: str, on: str = "body") -> None:
        """A key, on what a selector finds."""
        if on == "body":
            self.page.evaluate("document.activeElement.blur()")
            self.page.keyboard.press(key)
        else:
            self.find(on).press(key)

    def run_for(self, seconds: float) -> None:
        """So much simulated time from here, as fast as it goes."""
        self.ask("to", t_ps=round(self.state("t_ps") + seconds * 1e12))
        self.settle()

    def settle(self) -> None:
        """Wait until the engine stands, and the page shows it."""
        self.until("insView.state.running === false")
        self.page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def press_and_settle(self, selector: str) -> int:
        """Click what moves the engine; the instant at which it then stands."""
        before = self.state("t_ps")
        self.page.click(selector)
        self.until(f"insView.state.t_ps !== {before}")
        self.settle()
        return int(self.state("t_ps"))
