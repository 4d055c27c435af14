"""The pictures of docs/view.md: the page of `ins view` before the default scenario, light and dark.

PYTHONPATH=build/release/python .venv/bin/python bench/view/screenshots.py
"""

import io
import sys
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/view"))

from page_kit import Desk, chromium, serving  # noqa: E402

FIGURES = ROOT / "docs/figures"
OCTETS_MOST = 150_000
COLOURS = 128
AT_S = 8.0
FASTER = 2.0
PLACE = "acq.c:221"


def main() -> None:
    """Writes view_light.png and view_dark.png."""
    with serving("default") as (_, url), chromium() as browser:
        desk = Desk(browser, url)
        desk.ask("speed", value=FASTER)
        desk.ask("run")
        desk.until(f"insView.state.t_ps > {AT_S * 1e12}")
        desk.ask("pause")
        desk.settle()
        desk.ask("break_add", at=PLACE)
        desk.press_and_settle("#do-run")
        desk.page.click("#live")
        desk.js("insView.panel('analyser').setCursor('A', insView.state.t_ps - 4e10)")
        desk.js("insView.panel('analyser').setCursor('C', insView.state.t_ps - 2e10)")
        for scheme in ("light", "dark"):
            desk.page.emulate_media(color_scheme=scheme)
            desk.settle()
            picture = Image.open(io.BytesIO(desk.page.screenshot())).convert("RGB")
            octets = io.BytesIO()
            picture.quantize(COLOURS, dither=Image.Dither.NONE).save(octets, "PNG", optimize=True)
            assert len(octets.getvalue()) <= OCTETS_MOST, f"{scheme}: {len(octets.getvalue())} octets"
            (FIGURES / f"view_{scheme}.png").write_bytes(octets.getvalue())


if __name__ == "__main__":
    main()
