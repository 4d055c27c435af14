"""`ins view` at full speed with a page attached: its memory at every simulated half hour. docs/view.md.

PYTHONPATH=build/release/python .venv/bin/python bench/view/long_run.py [--hours 8] [SCENARIO]
"""

import argparse
import asyncio
import os
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tests/view"))
from view_kit import Server, viewing

HOUR_PS = 3600 * 10**12
WARM_PS = 600 * 10**12
"""Until then what is kept fills up to its bounds."""


def resident_mib(process: int) -> float:
    """Of a process."""
    pages = int(Path(f"/proc/{process}/statm").read_text(encoding="ascii").split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 2**20


async def watch(server: Server, hours: float, every_h: float) -> None:
    async with server.page() as page:
        began = time.monotonic()
        await page.done("speed", value="max")
        await page.ask("run")
        due = [WARM_PS, *(round(n * every_h * HOUR_PS) for n in range(1, round(hours / every_h) + 1))]
        for goal in due:
            while page.frame["t_ps"] < goal:
                await page.take()
                page.edges.clear()  # this client's memory is not what is measured
            wall_s = time.monotonic() - began
            mib = resident_mib(server.process.pid)
            print(
                f"{goal / HOUR_PS:5.2f} h simulated  {wall_s:7.0f} s wall  {mib:7.1f} MiB resident  "
                f"{page.frames} frames",
                flush=True,
            )


async def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenario", nargs="?", default="default")
    parser.add_argument("--hours", type=float, default=8.0)
    parser.add_argument("--every", type=float, default=0.5, help="simulated hours between two figures")
    parsed = parser.parse_args()
    async with viewing(parsed.scenario) as server:
        await watch(server, parsed.hours, parsed.every)


if __name__ == "__main__":
    asyncio.run(main())
