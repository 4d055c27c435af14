"""`./dev demo`: the emulated board on a pty at real-time speed, ins-navd on its other end, DDS to another process.

With --fast the same firmware, board, link and navigator run in one process in virtual time.
"""

import argparse
import json
import math
import os
import queue
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.live import Live
from rich.table import Table

from libins import page, report, run, scenario
from libins.cli import EXIT_USAGE, navd_path
from libins.endpoint import Pty
from libins.errors import UsageError
from libins.machine import AcquisitionMachine
from libins.run import AXES, COLUMNS, PS_PER_S, Array, Result
from libins.scenario import Scenario

ERROR_LIMIT_RAD = 3e-3
RECEIVED_LIMIT = 0.95
"""Share of the published states that must arrive over DDS; the first ones may come before the reader is known."""
LOST_LIMIT = 0.2
"""Share of the scans that may be lost: on a loaded machine ins-navd is sometimes later than the board waits."""
REFRESH_S = 0.1


class Child:
    """A process that is ended with the demo. Its lines of JSON land in a queue, its standard error in a log file."""

    def __init__(self, name: str, command: list[str], folder: Path) -> None:
        """Start it."""
        self.name = name
        self.log = folder / f"{name}.log"
        self.lines: queue.SimpleQueue[dict[str, Any]] = queue.SimpleQueue()
        with self.log.open("wb") as log:
            self.process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=log)
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self.lines.put(json.loads(line))

    def check(self) -> None:
        """Raises UsageError when it has ended."""
        if self.process.poll() is not None:
            said = self.log.read_text(encoding="utf-8", errors="replace").strip()
            raise UsageError(f"{self.name} ended with {self.process.returncode}: {said}")

    def end(self) -> None:
        """Ask it to stop; insist after 5 s."""
        self.process.terminate()
        try:
            self.process.wait(timeout=5)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        self._reader.join(timeout=5)


def view(t: float, row: Array | None, counts: dict[str, int]) -> Table:
    """What is on the screen while it runs."""
    table = Table(title=f"libins: firmware -> board -> link -> navigator -> DDS   t = {t:5.1f} s", title_justify="left")
    for heading in ("angle", "truth, deg", "estimate, deg", "error, mrad"):
        table.add_column(heading, justify="left" if heading == "angle" else "right", min_width=14)
    for axis in AXES:
        cells = ("-", "-", "-")
        if row is not None:
            truth, estimate, error = (
                row[COLUMNS[key]] for key in (f"true_{axis}_rad", f"{axis}_rad", f"error_{axis}_rad")
            )
            cells = (f"{math.degrees(truth):+.3f}", f"{math.degrees(estimate):+.3f}", f"{error * 1e3:+.3f}")
        table.add_row(axis, *cells)
    table.caption = "   ".join(f"{name} {count}" for name, count in counts.items())
    return table


class Screen:
    """The live view on a terminal, a line every two seconds elsewhere."""

    def __init__(self) -> None:
        """Nothing is drawn yet."""
        self.console = Console()
        self.live = Live(console=self.console, auto_refresh=False) if self.console.is_terminal else None
        self._drawn = -math.inf
        self._period = REFRESH_S if self.live is not None else 2.0

    def __enter__(self) -> "Screen":
        """Start drawing."""
        if self.live is not None:
            self.live.start()
        return self

    def __exit__(self, *exc: object) -> None:
        """Stop drawing."""
        if self.live is not None:
            self.live.stop()

    def draw(self, t: float, row: Array | None, counts: dict[str, int]) -> None:
        """Draw, unless it was done just now."""
        now = time.monotonic()
        if now - self._drawn < self._period:
            return
        self._drawn = now
        if self.live is not None:
            self.live.update(view(t, row, counts), refresh=True)
        else:
            error = "" if row is None else " ".join(f"{a} {row[COLUMNS[f'error_{a}_rad']] * 1e3:+.2f}" for a in AXES)
            counted = ", ".join(f"{name} {count}" for name, count in counts.items())
            self.console.print(f"t = {t:5.1f} s   error [mrad] {error}   {counted}", highlight=False, markup=False)


def wrapped(angle: float) -> float:
    """Into -pi .. pi."""
    return math.remainder(angle, 2.0 * math.pi)


def scored(message: dict[str, Any], scans: Array, motion: Any, taken_ns: list[int]) -> Array | None:
    """A received state beside the truth at its own scan, as a row of states. None if the board knows no such scan."""
    # The firmware numbers its scans from 1, the navigator its samples from 0 at the first one it used.
    scan = int(message["index"]) + (int(message["seq"]) - 1 - int(message["index"])) % 256
    if scan >= len(scans):
        return None
    t = float(scans[scan, 0])
    row = np.zeros(len(COLUMNS))
    truth, estimate = motion.euler(t), message["euler_rad"]
    values = {
        "index": message["index"],
        "scan": scan,
        "t_s": t,
        "age_s": (message["published_ns"] - taken_ns[scan]) * 1e-9,
        "seq": message["seq"],
        "bridged": message["bridged"],
        **{f"true_{axis}_rad": truth[i] for i, axis in enumerate(AXES)},
        **{f"{axis}_rad": estimate[i] for i, axis in enumerate(AXES)},
        **{f"error_{axis}_rad": wrapped(estimate[i] - truth[i]) for i, axis in enumerate(AXES)},
    }
    for name, value in values.items():
        row[COLUMNS[name]] = value
    return row


def real_time(loaded: Scenario, stop_s: float, domain: int, folder: Path) -> Result:
    """The three processes, at the speed of the real board. Raises UsageError when one of them ends early."""
    nav = loaded.tables.nav
    assert nav is not None
    dds = ["--domain", str(domain)]
    pty = Pty()
    children: list[Child] = []
    rows: list[Array] = []
    received = 0
    latest: dict[str, Any] = {}
    taken_ns: list[int] = []  # wall clock of each scan, to a slice of the pacer
    try:
        subscriber = Child("ins-sub", [sys.executable, "-m", "libins", "sub", *dds], folder)
        children.append(subscriber)
        skew = ",".join(f"{s * 1e6:.9g}" for s in nav.skew_s)
        options = ["--device", pty.path, "--baud", f"{loaded.tables.link.baud:.0f}", "--period", f"{nav.period_s:.9g}"]
        options += ["--skew-us", skew, "--attitude-deg", "0,0,0", f"--dds={domain}", "--quiet"]
        navd = Child("ins-navd", [str(navd_path()), *options], folder)
        children.append(navd)
        time.sleep(1.0)  # discovery; a late reader would only miss the first states
        machine = AcquisitionMachine(loaded, loaded.tables.seed, outside=True, trace=False)
        board = machine.run
        motion = run.motion_of(loaded)
        start = time.monotonic()
        pacer = run.Pacer(1.0)
        stop_ps = round(stop_s * PS_PER_S)
        with Screen() as screen:
            while board.now_ps < stop_ps:
                pacer.step(machine, stop_ps, {"uart": pty})
                taken_ns += [time.time_ns()] * (board.counters()["sampled"] - len(taken_ns))
                while not subscriber.lines.empty():
                    latest = subscriber.lines.get()
                    received += 1
                    row = scored(latest, board.scans(), motion, taken_ns)
                    if row is not None:
                        rows.append(row)
                counts = {"scans": board.counters()["sampled"], "received over DDS": received}
                counts |= {key: latest.get("link", {}).get(key, 0) for key in ("lost", "duplicates", "corrupt")}
                screen.draw(board.now_ps / PS_PER_S, rows[-1] if rows else None, counts)
                for child in children:
                    child.check()
    finally:
        for child in reversed(children):
            child.end()
        pty.close()
    return _judged(loaded, board, rows, received, latest, time.monotonic() - start)


def _judged(
    loaded: Scenario, board: Any, rows: list[Array], received: int, latest: dict[str, Any], wall_s: float
) -> Result:
    states = np.array(rows) if rows else np.empty((0, len(COLUMNS)))
    scans = board.scans()
    c = board.counters()
    counts = latest.get("link", {})
    measured = run.accuracy(states)
    failed = []
    if not rows:
        failed.append("no state came over DDS")
    else:
        worst = max(measured["attitude"]["max_rad"].values())
        if not worst <= ERROR_LIMIT_RAD:
            failed.append(f"attitude error {worst:.2e} rad, expected at most {ERROR_LIMIT_RAD:g}")
    published = latest.get("used", 0)
    if received < RECEIVED_LIMIT * published:
        failed.append(f"{received} of {published} states came over DDS, expected at least {RECEIVED_LIMIT:.0%}")
    if counts.get("lost", 0) > LOST_LIMIT * len(scans):
        failed.append(f"{counts['lost']} of {len(scans)} scans were lost, expected at most {LOST_LIMIT:.0%}")
    link = {
        "sent": len(scans),
        "ok": counts.get("accepted", 0),
        "lost": counts.get("lost", 0),
        "corrupt_accepted": None,
    }
    link["retried"] = sum(counts.get(key, 0) for key in ("duplicates", "corrupt", "timeouts"))
    summary = {
        "scenario": loaded.path.name,
        "firmware": loaded.firmware.name,
        "sim_s": board.now_ps / PS_PER_S,
        "wall_s": wall_s,
        "speed": board.now_ps / PS_PER_S / wall_s,
        "seed": loaded.tables.seed,
        "cpu": {key: c[key] for key in ("instructions", "cycles", "interrupts")},
        "samples": len(scans),
        "link": link,
        **measured,
        "dds": {"published": published, "received": received},
        "trace_sha256": None,
        "reports": board.reports(),
        "not_judged": [],
        "failed": failed,
        "verdict": "fail" if failed else "pass",
    }
    return Result(summary, states, scans, 1 if failed else 0, list(COLUMNS))


def virtual(loaded: Scenario, stop_s: float) -> Result:
    """Everything in this process, as fast as it goes."""
    last: list[Array] = []
    with Screen() as screen:

        def progress(t: float, states: Array) -> None:
            if len(states):
                last[:] = [states[-1]]
            screen.draw(t, last[0] if last else None, {"accepted": int(last[0][COLUMNS["accepted"]]) if last else 0})

        return run.execute(loaded, run.Options(stop_s=stop_s, progress=progress))


def main(arguments: list[str] | None = None) -> int:
    """Entry point. Returns the exit code."""
    parser = argparse.ArgumentParser(prog="./dev demo", description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--fast", action="store_true", help="virtual time, one process, no DDS")
    parser.add_argument("--seconds", type=float, default=24.0, metavar="S", help="simulated seconds (24)")
    parser.add_argument("--domain", type=int, default=42, metavar="N", help="DDS domain id (42)")
    parser.add_argument("--folder", type=Path, default=Path("build/demo"), metavar="D", help="for the report and logs")
    options = parser.parse_args(arguments)
    try:
        loaded = scenario.load_board(scenario.find("default"))
        options.folder.mkdir(parents=True, exist_ok=True)
        if options.fast:
            result = virtual(loaded, options.seconds)
        else:
            result = real_time(loaded, options.seconds, options.domain, options.folder)
        written = options.folder / "report.html"
        written.write_text(page.html(loaded, result), encoding="utf-8")
    except UsageError as error:
        print(f"demo: {error}", file=sys.stderr)
        return EXIT_USAGE
    print(report.text(result.summary))
    print(f"report    {os.path.relpath(written)}")
    return result.exit_code


if __name__ == "__main__":
    sys.exit(main())
