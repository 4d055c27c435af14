"""The command `ins export`: an MCAP recording as CSV files, or as arrays for NumPy."""

import argparse
import csv
import io
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from libins import play_cli
from libins.errors import UsageError
from libins.whole_file import write

if TYPE_CHECKING:
    from libins.recording_mcap import Recording


def options(parser: argparse.ArgumentParser) -> None:
    """The command's grammar."""
    parser.add_argument("file", type=Path, metavar="F.mcap")
    parser.add_argument("--csv", type=Path, metavar="FOLDER", help="a file for each topic")
    parser.add_argument("--npz", type=Path, metavar="F.npz", help="all columns, named topic/column, for numpy.load()")
    parser.add_argument("--topic", action="append", default=[], metavar="T", help="this one alone")
    parser.add_argument("--from", dest="from_s", type=float, default=0.0, metavar="S", help="begin there (0)")
    parser.add_argument("--to", dest="to_s", type=float, metavar="S", help="end there, seconds from the first message")


def _csv(recording: "Recording", topics: list[str], part: tuple[float, float | None], folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(f"{folder}: cannot be made: {error.strerror}; choose another --csv") from error
    for topic in topics:
        heads, rows = recording.table(topic, *part)
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(heads)
        writer.writerows(rows)
        path = folder / f"{topic.strip('/').replace('/', '_')}.csv"
        write(path, text.getvalue())
        print(f"{path}: {text.getvalue().count(chr(10)) - 1} rows, {len(heads)} columns")


def _npz(recording: "Recording", topics: list[str], part: tuple[float, float | None], path: Path) -> None:
    columns = {
        f"{topic.strip('/')}/{name}": array
        for topic in topics
        for name, array in recording.arrays(topic, *part).items()
    }
    octets = io.BytesIO()
    np.savez_compressed(octets, **columns)  # type: ignore[arg-type]
    temporary = path.with_name(path.name + ".part")
    try:
        temporary.write_bytes(octets.getvalue())
        temporary.replace(path)
    except OSError as error:
        raise UsageError(f"{path}: cannot be written: {error.strerror}; choose another --npz") from error
    print(f"{path}: {len(columns)} arrays")


def run(args: argparse.Namespace) -> int:
    """Exit code 0; raises UsageError."""
    if args.csv is None and args.npz is None:
        raise UsageError("ins export: --csv FOLDER or --npz F.npz is needed")
    try:
        from libins.recording_mcap import Recording
    except ImportError as error:
        raise UsageError(f"ins export: {error.name} is missing; pip install 'libins[record]'") from error
    with Recording(args.file) as recording:
        if recording.problem:
            print(f"ins export: {args.file} {recording.problem}; what is whole is exported", file=sys.stderr)
        part = play_cli.span(args, recording)
        topics = recording.chosen(args.topic)
        if args.csv is not None:
            _csv(recording, topics, part, args.csv)
        if args.npz is not None:
            _npz(recording, topics, part, args.npz)
    return 0
