"""Images in Intel HEX: what is loaded is what was written, and nothing but a UsageError comes of any other file."""

import os
import tempfile
from pathlib import Path

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from intelhex import IntelHex
from libins.errors import UsageError

from libins import hexfile

EXAMPLES = 5_000 if os.environ.get("INS_BENCH") else 300
CODE = 0x1000
BLOCK = ":0400000001020304F2\n:00000001FF\n"

records = st.builds(
    lambda count, address, kind, data, sum_off: _record(count or len(data), address, kind, data, sum_off),
    st.one_of(st.just(0), st.integers(0, 255)),
    st.integers(0, 0xFFFF),
    st.integers(0, 7),
    st.binary(max_size=20),
    st.sampled_from([0, 0, 0, 1]),
)


def _record(count: int, address: int, kind: int, data: bytes, sum_off: int) -> bytes:
    body = bytes([count, address >> 8, address & 255, kind]) + data
    return b":" + (body + bytes([(-sum(body) + sum_off) & 255])).hex().upper().encode() + b"\n"


def load(octets: bytes) -> list[tuple[int, bytes]] | None:
    """The segments, or None where the file was refused in one sentence that names it."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "image.ihx"
        path.write_bytes(octets)
        try:
            return hexfile.load(path, CODE)
        except UsageError as error:
            assert str(error).startswith(f"{path}: ") and "\n" not in str(error)
            return None


@settings(max_examples=EXAMPLES, deadline=None, derandomize=True)
@given(st.dictionaries(st.integers(0, CODE - 1), st.integers(0, 255), min_size=1, max_size=40))
def test_what_was_written_is_loaded(memory: dict[int, int]) -> None:
    image = IntelHex()
    image.fromdict(dict(memory))
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "image.ihx"
        image.write_hex_file(str(path))
        segments = load(path.read_bytes())
    assert segments is not None
    assert {start + i: octet for start, octets in segments for i, octet in enumerate(octets)} == memory


@settings(max_examples=EXAMPLES, deadline=None, derandomize=True)
@given(st.binary(max_size=200))
@example(b"")
@example(b":")
@example(b":00000001FF")
@example(b"\xff\xfe:\x000\x00")
@example(BLOCK.replace("F2", "F3").encode())
def test_any_octets_are_loaded_or_refused(octets: bytes) -> None:
    segments = load(octets)
    assert segments is None or all(start >= 0 and start + len(data) <= CODE for start, data in segments)


@settings(max_examples=EXAMPLES, deadline=None, derandomize=True)
@given(st.lists(records, max_size=6), st.booleans())
def test_any_records_are_loaded_or_refused(lines: list[bytes], ended: bool) -> None:
    segments = load(b"".join(lines) + (b":00000001FF\n" if ended else b""))
    assert segments is None or all(start >= 0 and start + len(data) <= CODE for start, data in segments)


@settings(max_examples=EXAMPLES, deadline=None, derandomize=True)
@given(st.integers(0, len(BLOCK) - 2), st.integers(0, 255))
def test_one_wrong_octet_never_loads_other_data(place: int, octet: int) -> None:
    damaged = BLOCK.encode()[:place] + bytes([octet]) + BLOCK.encode()[place + 1 :]
    segments = load(damaged)
    assert segments in (None, [(0, b"\x01\x02\x03\x04")])


@pytest.mark.parametrize("length", range(len(BLOCK) - 1))
def test_a_truncated_file_is_refused(length: int) -> None:
    assert load(BLOCK.encode()[:length]) is None
