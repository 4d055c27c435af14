"""The command `ins play`: an MCAP recording onto DDS again, the octets as they were taken."""

import argparse
import contextlib
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

from libins.errors import UsageError

if TYPE_CHECKING:
    from libins.recording_mcap import Recording, Topic

DELIVER_S = 10.0
"""What the end waits for readers."""
LATCHED = "durability: transient_local"


def options(parser: argparse.ArgumentParser) -> None:
    """The command's grammar."""
    parser.description = (
        "Of a recording that was cut off, what is whole is played. Times within messages stay what they were."
    )
    parser.add_argument("file", type=Path, metavar="F.mcap")
    parser.add_argument("--topic", action="append", default=[], metavar="T", help="play this one alone")
    parser.add_argument("--from", dest="from_s", type=float, default=0.0, metavar="S", help="begin there (0)")
    parser.add_argument("--to", dest="to_s", type=float, metavar="S", help="end there, seconds from the first message")
    parser.add_argument("--speed", default="1", metavar="max|X", help="recorded seconds a second (1)")
    parser.add_argument("--wait", action="store_true", help="begin when every topic has a reader")
    parser.add_argument("--loop", action="store_true", help="begin again at the end, until interrupted")
    parser.add_argument("--ros", action="store_true", help="the domain is ROS_DOMAIN_ID, where that is set")


def span(args: argparse.Namespace, recording: "Recording") -> tuple[float, float | None]:
    """From and to. Raises UsageError."""
    end = args.to_s
    if not 0.0 <= args.from_s <= recording.duration_s or (end is not None and not end > args.from_s):
        until = "" if end is None else f" --to {end:g}"
        raise UsageError(
            f"--from {args.from_s:g}{until}: must lie in 0 .. {recording.duration_s:g}, the seconds of "
            f"{recording.path}, and one before the other"
        )
    return args.from_s, end


def _deadline_s(profile: str) -> float:
    """Of offered_qos_profiles; 0: none."""
    lines = [line.strip() for line in profile.partition("deadline:")[2].splitlines()[1:3]]
    found = dict(line.split(": ") for line in lines if ": " in line)
    seconds = int(found.get("sec", 0)) + int(found.get("nsec", 0)) * 1e-9
    return seconds if seconds < 1e6 else 0.0


def raw_topic(topic: "Topic", dds: Any) -> Any:
    """How it was offered when it was recorded."""
    from libins import idl
    from libins.recorder import dds_topic

    kind = idl.dds_name(topic.type)
    profile = topic.metadata.get("offered_qos_profiles", "")
    strength = topic.metadata.get("libins_strength")
    return dds.raw_topic(
        dds_topic(topic.name, kind),
        kind,
        topic.metadata.get("libins_partition", ""),
        f"typehash={topic.metadata['topic_type_hash']};" if "topic_type_hash" in topic.metadata else "",
        LATCHED in profile,
        strength is not None,
        int(strength or 0),
        _deadline_s(profile),
        "reliability: best_effort" in profile,
    )


def _topics(recording: "Recording", wanted: list[str], handle: Any) -> dict[str, int]:
    """Number of the writer of each topic that is played."""
    from libins import _dds

    numbers: dict[str, int] = {}
    types = _dds.raw_types()
    for name in recording.chosen(wanted):
        topic = raw_topic(recording.topics[name], _dds)
        if topic.type not in types:
            print(f"not played: {name}: libins does not know its type {recording.topics[name].type}", file=sys.stderr)
            continue
        try:
            numbers[name] = handle.publish(topic)
        except RuntimeError as error:
            raise UsageError(f"DDS: {error}") from error
    if not numbers:
        raise UsageError(f"{recording.path}: has nothing to play")
    return numbers


def run(args: argparse.Namespace) -> int:
    """Exit code 0; raises UsageError."""
    try:
        from libins.recording_mcap import Recording
    except ImportError as error:
        raise UsageError(f"ins play: {error.name} is missing; pip install 'libins[record]'") from error
    from libins.cli import speed_of
    from libins.dds_options import open_raw

    speed = speed_of(args.speed)
    with Recording(args.file) as recording, contextlib.closing(open_raw(args)) as handle:
        if recording.problem:
            print(f"ins play: {args.file} {recording.problem}; what is whole is played", file=sys.stderr)
        from_s, to_s = span(args, recording)
        numbers = _topics(recording, args.topic, handle)
        while args.wait and not all(handle.matched(number) for number in numbers.values()):
            time.sleep(0.01)
        count = _play(recording, numbers, (from_s, to_s), speed, handle)
        while args.loop:
            count += _play(recording, numbers, (from_s, to_s), speed, handle)
    print(f"{args.file}: {count} messages of {len(numbers)} topics played")
    return 0


def _play(
    recording: "Recording", numbers: dict[str, int], part: tuple[float, float | None], speed: float | None, handle: Any
) -> int:
    count = 0
    begin = time.monotonic()
    first_ns = recording.begin_ns + round(part[0] * 1e9)
    for message in recording.messages(numbers, *part):
        if speed is not None:
            ahead = begin + (message.log_ns - first_ns) * 1e-9 / speed - time.monotonic()
            if ahead > 0:
                time.sleep(ahead)
        try:
            handle.write(numbers[message.topic], message.octets)
        except RuntimeError as error:
            raise UsageError(f"{recording.path}: topic {message.topic}, message {count + 1}: {error}") from error
        count += 1
    try:
        handle.delivered(DELIVER_S)
    except RuntimeError as error:
        print(f"ins play: {error}", file=sys.stderr)
    return count
