"""The logic analyser's decoder of a serial line."""

import random

import pytest
from libins.uart import Decoder, Frame

BAUD = 9600
BIT_PS = 10**12 / BAUD
SEED = 5


def edges_of(octets: bytes, start_ps: int, baud: float, gap_bits: int = 0, stop: bool = True) -> list[tuple[int, bool]]:
    """Edges of frames that follow each other."""
    levels = []
    for octet in octets:
        levels += [False, *(bool(octet >> i & 1) for i in range(8)), stop, *[True] * gap_bits]
    edges, level = [], True
    for i, wanted in enumerate([*levels, True]):
        if wanted != level:
            edges.append((start_ps + round(i * 1e12 / baud), wanted))
            level = wanted
    return edges


@pytest.mark.parametrize("gap_bits", [0, 1, 7])
@pytest.mark.parametrize("error", [-0.04, 0.0, 0.04])
def test_octets_at_any_slicing(gap_bits, error):
    chance = random.Random(SEED)
    octets = chance.randbytes(60)
    edges = edges_of(octets, 1000, BAUD * (1 + error), gap_bits=gap_bits + (error > 0))
    decoder, seen, now = Decoder(BAUD), [], 0
    while now < edges[-1][0] + 10 * BIT_PS:
        until = now + chance.randrange(1, round(12 * BIT_PS))
        seen += decoder.feed([(t, level) for t, level in edges if now < t <= until], until)
        now = until
    assert bytes(frame.octet for frame in seen) == octets
    assert all(frame.framing_ok for frame in seen)


def test_instants_of_a_frame():
    (frame,) = Decoder(BAUD).feed(edges_of(b"\x5a", 1000, BAUD), 10**10)
    assert frame == Frame(1000, 1000 + round(9.5 * BIT_PS), 0x5A, framing_ok=True)
    assert str(frame) == "5A"


def test_nothing_before_the_stop_bit():
    edges = edges_of(b"\x5a", 0, BAUD)
    decoder = Decoder(BAUD)
    assert list(decoder.feed(edges, round(9.5 * BIT_PS) - 1)) == []
    assert [frame.octet for frame in decoder.feed([], round(9.5 * BIT_PS))] == [0x5A]


def test_break_and_glitch():
    low_for = round(9.7 * BIT_PS)
    (frame,) = Decoder(BAUD).feed([(0, False), (low_for, True)], 2 * low_for)
    assert (frame.octet, frame.framing_ok, str(frame)) == (0, False, "00!")
    glitch = [(0, False), (round(0.4 * BIT_PS), True)]
    assert list(Decoder(BAUD).feed(glitch, 2 * low_for)) == []
