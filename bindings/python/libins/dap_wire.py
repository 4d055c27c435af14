"""Frames of the Debug Adapter Protocol: "Content-Length: N", an empty line, N octets of JSON."""

import json
from collections.abc import Iterator
from typing import Any

HEADER_MAX = 4096
CONTENT_MAX = 16 << 20
_END = b"\r\n\r\n"


class FrameError(Exception):
    """What arrived is no message. `fatal`: nor can be said where the next begins."""

    def __init__(self, text: str, fatal: bool) -> None:
        """The text says what was found and what is needed."""
        super().__init__(text)
        self.fatal = fatal


class Framer:
    """Octets in, messages out."""

    def __init__(self) -> None:
        """At the begin of a frame."""
        self._octets = bytearray()
        self._length: int | None = None
        self._broken = False

    def feed(self, octets: bytes) -> Iterator[dict[str, Any] | FrameError]:
        """Messages that are whole now, and errors in their places; behind a fatal one, nothing."""
        self._octets += octets
        while not self._broken:
            try:
                content = self._next()
            except FrameError as error:
                self._broken = error.fatal
                yield error
                continue
            if content is None:
                return
            yield _message(content)

    def _next(self) -> bytes | None:
        if self._length is None:
            end = self._octets.find(_END)
            if end < 0 and len(self._octets) <= HEADER_MAX:
                return None
            if not 0 <= end <= HEADER_MAX:
                raise FrameError(f"no empty line ends the header within {HEADER_MAX} octets", fatal=True)
            self._length = _length(bytes(self._octets[:end]))
            del self._octets[: end + len(_END)]
        if len(self._octets) < self._length:
            return None
        content = bytes(self._octets[: self._length])
        del self._octets[: self._length]
        self._length = None
        return content


def _length(header: bytes) -> int:
    for line in header.split(b"\r\n"):
        name, colon, value = line.partition(b":")
        if not colon:
            raise FrameError(f"{line[:40]!r} is no header; 'Content-Length: N' is needed", fatal=True)
        if name.strip().lower() == b"content-length":
            digits = value.strip()
            if not digits.isdigit() or len(digits) > 9 or int(digits) > CONTENT_MAX:
                raise FrameError(f"Content-Length {digits[:40]!r}: 0 to {CONTENT_MAX} is possible", fatal=True)
            return int(digits)
    raise FrameError("the header has no Content-Length", fatal=True)


def _message(content: bytes) -> dict[str, Any] | FrameError:
    try:
        message = json.loads(content)
    except (ValueError, RecursionError) as error:
        return FrameError(f"a message is no JSON: {error}", fatal=False)
    if not isinstance(message, dict):
        return FrameError(f"a message is {type(message).__name__}, but an object is needed", fatal=False)
    return message


def frame(message: dict[str, Any]) -> bytes:
    """A message as it is sent."""
    content = json.dumps(message, separators=(",", ":")).encode()
    return b"Content-Length: %d\r\n\r\n%s" % (len(content), content)
