"""Firmware images: Intel HEX by the intelhex library, refused in one sentence when they are not whole."""

import functools
import io
from pathlib import Path

from intelhex import HexReaderError, IntelHex

from libins.errors import UsageError


@functools.lru_cache(maxsize=64)
def _segments(text: str) -> tuple[tuple[int, bytes], ...]:
    """Of a file's text, which a campaign loads thousands of times. Raises HexReaderError."""
    image = IntelHex()
    image.loadhex(io.StringIO(text))
    return tuple((start, bytes(image.tobinarray(start=start, end=end - 1))) for start, end in image.segments())


def load(path: Path, code_size: int) -> list[tuple[int, bytes]]:
    """Segments (address, octets) of an Intel HEX file.

    Raises UsageError for a missing, truncated or corrupt file, and for an image larger than the code memory.
    """
    try:
        text = path.read_text(encoding="ascii")
        segments = _segments(text)
    except OSError as error:
        raise UsageError(f"{path}: cannot be read: {error.strerror}; build the firmware or give its path") from error
    except (HexReaderError, UnicodeDecodeError) as error:
        raise UsageError(f"{path}: not a whole Intel HEX file: {error}; build it again") from error
    if ":00000001FF" not in text.upper():
        raise UsageError(f"{path}: truncated: the end-of-file record (:00000001FF) is missing; build it again")
    if not segments:
        raise UsageError(f"{path}: holds no data; build it again")
    last = segments[-1][0] + len(segments[-1][1]) - 1
    if last >= code_size:
        raise UsageError(
            f"{path}: an octet at address {last:#06x} lies beyond the code memory ({code_size} octets); make"
            " the firmware smaller, or take part = 'at89s52' (8192 octets) or more code_octets (external memory)"
        )
    return list(segments)
