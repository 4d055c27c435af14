"""The command `ins record`: DDS topics into an MCAP file, as octets."""

import argparse
import contextlib
import signal
import sys
import time
from pathlib import Path
from typing import Any

from rich.console import Console

from libins.errors import UsageError

POLL_S = 0.1
INFO = "ros_discovery_info"
"""Says who is there; it is nothing to be recorded."""
NOTHING = 1


def options(parser: argparse.ArgumentParser) -> None:
    """The command's grammar."""
    parser.description = (
        "Without --topic all topics of types that libins knows, those that come later included. Exit codes: 0, "
        "1 nothing was recorded, 2 bad usage."
    )
    parser.add_argument("file", type=Path, metavar="F.mcap")
    parser.add_argument(
        "--topic", action="append", default=[], metavar="T", help="record this one: libins/nav_state, /imu/data"
    )
    parser.add_argument("--ros", action="store_true", help="the domain is ROS_DOMAIN_ID, where that is set")
    parser.add_argument("--limit", type=int, metavar="N", help="stop after N messages")
    parser.add_argument("--duration", type=float, metavar="S", help="stop S seconds after the first message")
    parser.add_argument("--timeout-s", type=float, metavar="S", help="stop when nothing arrives for so long")
    parser.add_argument("--compression", choices=("zstd", "none"), default="zstd", help="of the file's chunks (zstd)")


class Listener:
    """Finds topics, and hands what they bring to a recorder."""

    def __init__(self, handle: Any, recorder: Any, wanted: list[str]) -> None:
        """wanted: names as viewers know them; none: all."""
        from libins import _dds

        self._handle = handle
        self._recorder = recorder
        self._wanted = {name.removeprefix("rt") if name.startswith("rt/") else name for name in wanted}
        self._types = frozenset(_dds.raw_types())
        self._seen: set[tuple[str, str, str, bool, bool]] = set()
        self._number: dict[int, int] = {}
        self._log_ns = 0
        self.count = 0

    def look(self) -> None:
        """Subscribe what has appeared."""
        from libins.recorder import ros_topic

        for topic in self._handle.found():
            name = ros_topic(topic.name, topic.type)
            key = (name, topic.type, topic.partition, topic.exclusive, topic.best_effort)
            if key in self._seen or topic.name == INFO or (self._wanted and name not in self._wanted):
                continue
            self._seen.add(key)
            if topic.type not in self._types:
                print(f"not recorded: {name}: libins does not know its type {topic.type}", file=sys.stderr)
                continue
            try:
                number = self._handle.subscribe(topic)
            except RuntimeError as error:
                print(f"not recorded: {name}: {error}", file=sys.stderr)
                continue
            self._number[number] = self._recorder.topic(topic)
            print(f"recording {name} ({topic.type})", file=sys.stderr, flush=True)

    def take(self, most: int | None) -> None:
        """What is there, in the order of publication, at most so many."""
        batch = self._handle.take(POLL_S)
        self._log_ns = max(self._log_ns, time.time_ns())
        for number, published_ns, octets in sorted(batch, key=lambda message: message[1]):
            if most is not None and self.count >= most:
                break
            self._recorder.add(self._number[number], self._log_ns, published_ns, octets)
            self.count += 1


def _loop(args: argparse.Namespace, listener: Listener, recorder: Any) -> None:
    """Until a limit is reached, or somebody interrupts."""
    console = Console(stderr=True)
    begin: float | None = None
    last, count = time.monotonic(), 0
    with console.status("waiting for topics") if console.is_terminal else contextlib.nullcontext() as status:
        while args.limit is None or listener.count < args.limit:
            listener.look()
            listener.take(args.limit)
            recorder.flush()
            now = time.monotonic()
            if listener.count > count:
                begin, last, count = now if begin is None else begin, now, listener.count
                if status is not None:
                    status.update(f"{count} messages, {recorder.octets / 1e6:.1f} MB, {now - begin:.0f} s")
            if begin is not None and args.duration is not None and now - begin >= args.duration:
                return
            if args.timeout_s is not None and now - last > args.timeout_s:
                return


def _stop(*_: object) -> None:
    raise KeyboardInterrupt


def run(args: argparse.Namespace) -> int:
    """Exit code; raises UsageError."""
    for name in ("limit", "duration", "timeout_s"):
        value = getattr(args, name)
        if value is not None and not value > 0:
            raise UsageError(f"--{name.replace('_', '-')} {value}: must lie above 0")
    try:
        from libins.recorder import Recorder
    except ImportError as error:
        raise UsageError(f"ins record: {error.name} is missing; pip install 'libins[record]'") from error
    from libins.dds_options import open_raw

    with contextlib.closing(open_raw(args)) as handle:
        recorder = Recorder(args.file, args.compression)
        listener = Listener(handle, recorder, args.topic)
        before = signal.signal(signal.SIGTERM, _stop)
        try:
            with contextlib.suppress(KeyboardInterrupt):
                _loop(args, listener, recorder)
        finally:
            signal.signal(signal.SIGTERM, before)
            if listener.count == 0:
                recorder.drop()
            else:
                recorder.close()
    if listener.count == 0:
        print("ins record: nothing arrived, nothing was written", file=sys.stderr)
        return NOTHING
    print(f"{args.file}: {listener.count} messages of {len(recorder.counts)} topics")
    return 0
