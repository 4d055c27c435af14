"""`ins keys`: files for DDS Security, from a test authority of one's own."""

import argparse
from pathlib import Path

from libins.errors import UsageError

DAYS = 365
EXTRA = "ins keys needs the Python package cryptography: pip install 'libins[security]'"


def options(parser: argparse.ArgumentParser) -> None:
    """What it takes."""
    parser.add_argument("folder", type=Path, help="the authority's place; its CA is made there the first time")
    parser.add_argument("participant", help="whose certificate, key and permissions to make, in FOLDER/PARTICIPANT")
    parser.add_argument("--publish", action="append", default=[], metavar="TOPIC", help="may publish it; * and ? match")
    parser.add_argument("--subscribe", action="append", default=[], metavar="TOPIC", help="may subscribe to it")
    parser.add_argument("--days", type=int, default=DAYS, metavar="N", help=f"validity from now on ({DAYS})")


def run(arguments: argparse.Namespace) -> int:
    """Raises UsageError."""
    try:
        from libins.keys import Authority
    except ImportError as error:
        raise UsageError(EXTRA) from error
    if arguments.days < 1:
        raise UsageError(f"--days {arguments.days}: must be 1 or more")
    try:
        authority = Authority(arguments.folder, arguments.days)
        made = authority.participant(arguments.participant, arguments.publish, arguments.subscribe)
    except OSError as error:
        raise UsageError(f"{error.filename}: cannot be written: {error.strerror}") from error
    print(f"{made}: give it by --security; keep {authority.folder / 'ca' / 'ca_key.pem'} to yourself")
    return 0
