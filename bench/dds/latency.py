"""How late a state is at its subscribers, and what a reader that stands still costs the publisher.

    python bench/dds/latency.py [--build build/release] [--json F] [--count N]

From the arrival of a block's last octet in ins-navd (time_ns of the state) to the return of the subscriber's take:
driven by a sender on a pty at 1 kHz, and by the emulated 8051 board at its own rate, with 1 and 10 subscribers.
Beside it, in the same run and at the same rates, Cyclone alone: from just before dds_write() of the same message to
the same subscribers. Then the time that the publishing call takes while its reader has been sent SIGSTOP.
"""

import argparse
import contextlib
import json
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DOMAIN = 197
BOARD_PERIOD_US = 20000
SENDER_PERIOD_US = 1000
SUBSCRIBERS = (1, 10)
Process = subprocess.Popen[str]


@contextlib.contextmanager
def started(*command: object, **options: object) -> Iterator[Process]:
    """Killed at the end."""
    process = subprocess.Popen([str(part) for part in command], text=True, **options)  # type: ignore[call-overload]
    try:
        yield process
    finally:
        process.kill()
        process.wait()


def line_of(stream: object) -> str:
    line = stream.readline().strip()  # type: ignore[attr-defined]
    if not line:
        raise SystemExit("a program of the measurement ended before it had begun")
    return str(line)


@contextlib.contextmanager
def listeners(build: Path, number: int, count: int) -> Iterator[list[Process]]:
    with contextlib.ExitStack() as all_of_them:
        found = []
        for _ in range(number):
            command = (build / "bench/dds/bench_dds_listen", DOMAIN, count)
            each = all_of_them.enter_context(started(*command, stdout=subprocess.PIPE, stderr=subprocess.PIPE))
            assert line_of(each.stderr) == "ready"
            found.append(each)
        yield found


def told(listening: list[Process]) -> dict[str, float]:
    """The median of the listeners' quantiles, and the worst maximum."""
    figures = [json.loads(line_of(each.stdout)) for each in listening]
    middle = len(figures) // 2
    quantiles = {key: sorted(f[key] for f in figures)[middle] for key in ("p50_us", "p99_us")}
    return quantiles | {"max_us": max(f["max_us"] for f in figures)}


@contextlib.contextmanager
def sender(build: Path, folder: Path) -> Iterator[tuple[str, int]]:
    with started(build / "bench/dds/bench_dds_board", SENDER_PERIOD_US, stdout=subprocess.PIPE) as board:
        yield line_of(board.stdout), SENDER_PERIOD_US


@contextlib.contextmanager
def emulated(build: Path, folder: Path) -> Iterator[tuple[str, int]]:
    link = folder / "uart"
    command = [sys.executable, "-m", "libins", "run", "default", "--serial", f"uart=pty:{link}", "--stop-s", "1000"]
    with started(*command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as board:
        while "uart" not in line_of(board.stderr):
            pass
        yield str(link), BOARD_PERIOD_US


def navd(build: Path, device: str, period_us: int) -> contextlib.AbstractContextManager[Process]:
    period = ("--period", period_us * 1e-6, "--octet-timeout-ms", 15)
    program = build / "python/libins/bin/ins-navd"
    return started(program, "--device", device, *period, f"--dds={DOMAIN}", "--quiet", stdin=subprocess.DEVNULL)


def stalled(build: Path, count: int) -> list[dict[str, float]]:
    with listeners(build, 1, 10**7) as (reader,):
        command = (build / "bench/dds/bench_dds_stall", DOMAIN, 1, count)
        pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
        with started(*command, **pipes) as writer:
            assert line_of(writer.stderr) == "ready"
            reader.send_signal(signal.SIGSTOP)
            out, _ = writer.communicate("\n")
            reader.send_signal(signal.SIGCONT)
    return [json.loads(line) for line in out.splitlines()]


def row(name: str, figures: dict[str, float]) -> list[dict[str, object]]:
    print(
        f"{name:<34} p50 {figures['p50_us']:>9.1f}   p99 {figures['p99_us']:>9.1f}   max {figures['max_us']:>9.1f} us"
    )
    return [
        {
            "name": f"dds.{name}.{key}",
            "value": figures[key],
            "unit": "us",
            "peer": None,
            "peer_value": None,
            "budget": None,
        }
        for key in ("p50_us", "p99_us", "max_us")
    ]


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--build", type=Path, default=ROOT / "build/release", metavar="D")
    parser.add_argument("--json", type=Path, metavar="F", help="write the rows there")
    parser.add_argument(
        "--count", type=int, default=10000, metavar="N", help="states at 1 kHz; a tenth at 50 Hz (10000)"
    )
    given = parser.parse_args()
    os.environ["PYTHONPATH"] = str(given.build / "python")
    rows: list[dict[str, object]] = []
    for source, board in (("sender_1khz", sender), ("board_50hz", emulated)):
        for number in SUBSCRIBERS:
            count = given.count if board is sender else given.count // 10
            with (
                tempfile.TemporaryDirectory() as folder,
                board(given.build, Path(folder)) as (device, period_us),
                listeners(given.build, number, count) as listening,
                navd(given.build, device, period_us),
            ):
                rows += row(f"{source}.{number}", told(listening))
            raw = (given.build / "bench/dds/bench_dds_raw", 10**7, period_us, DOMAIN)
            with listeners(given.build, number, count) as listening, started(*raw):
                rows += row(f"{source}.{number}.cyclone", told(listening))
    for figures in stalled(given.build, given.count):
        if figures["name"] == "counts":
            print(f"published {figures['published']}, dropped {figures['dropped']}")
        else:
            rows += row(f"stalled_reader.{figures['name']}", figures)
    if given.json is not None:
        given.json.write_text(json.dumps(rows, indent=2) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
