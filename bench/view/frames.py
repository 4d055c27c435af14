"""Updates a second of the page of `ins view` in headless Chromium, the board of the default scenario at real time.

    PYTHONPATH=build/release/python .venv/bin/python bench/view/frames.py [SECONDS]

`drawn` counts frames of the engine that were drawn, `merged` those that came while another still waited for the screen;
the processor time is that of the page's main thread, which says what is left on a busy machine.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests/view"))

from page_kit import Desk, chromium, serving  # noqa: E402

SECONDS = 10.0
COUNTS = "[performance.now() / 1000, insView.state.t_ps / 1e12, insView.drawn, insView.merged]"


def main() -> None:
    """Prints the figures."""
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else SECONDS
    with serving("default") as (_, url), chromium() as browser:
        desk = Desk(browser, url)
        desk.ask("run")
        desk.until("insView.state.t_ps > 5e11")
        chrome = desk.context.new_cdp_session(desk.page)
        chrome.send("Performance.enable", {"timeDomain": "threadTicks"})

        def counts() -> list[float]:
            metrics = {each["name"]: each["value"] for each in chrome.send("Performance.getMetrics")["metrics"]}
            return [*desk.js(COUNTS), metrics["TaskDuration"]]

        begin = counts()
        desk.page.wait_for_timeout(1000 * seconds)
        end = counts()
    wall, simulated, drawn, merged, busy = (b - a for a, b in zip(begin, end, strict=True))
    print(f"{wall:.2f} s, {simulated:.2f} s simulated: {drawn / wall:.1f} updates/s drawn, {merged} frames merged")
    print(f"{1000 * busy / drawn:.2f} ms of processor time an update")


if __name__ == "__main__":
    main()
