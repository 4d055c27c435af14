"""A file that is there whole or not at all."""

import sys
from pathlib import Path

from libins.errors import UsageError


def write(path: Path, text: str) -> None:
    """The path `-` is standard output. Raises UsageError."""
    if str(path) == "-":
        sys.stdout.write(text)
        return
    temporary = path.with_name(path.name + ".part")
    try:
        temporary.write_text(text, encoding="utf-8")
        temporary.replace(path)
    except OSError as error:
        raise UsageError(f"{path}: cannot be written: {error.strerror}; choose another place") from error
