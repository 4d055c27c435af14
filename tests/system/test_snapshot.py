"""Run.save and Run.restore: a run goes on from any instant as it did, and refuses what is not its own."""

import os
import random

import numpy as np
import pytest

from libins import run, scenario

SEED = 20100501
END_PS = 2 * 10**12
INSTANTS = 1000 if os.environ.get("INS_BENCH") else 25
FLIPS = 5000 if os.environ.get("INS_BENCH") else 200
HEADER = 24


def made(**keys) -> object:
    """The default scenario on a bad line."""
    document = scenario.Document(scenario.find("default"))
    document.override({"link.bit_error": 1e-3, "link.octet_loss": 1e-3, "link.cuts_s": [[0.7, 0.9]], **keys}, "test")
    return run.build(scenario.read(document, None), SEED, False, True)


def outcome(it) -> tuple:
    """All that a run shows. Reading it takes it away."""
    states, raw = it.take_states()
    return states.tolist(), raw, it.take_edges().tolist(), it.scans().tolist(), it.counters(), it.reports()


def test_goes_on_from_any_instant_as_it_did():
    whole = made()
    whole.until(END_PS)
    states, raw, edges, *rest = outcome(whole)
    end = whole.save()
    assert rest[1]["slots_inverted"] > 0 and rest[1]["lost"] > 0, "the line is as bad as meant"
    rng = random.Random(SEED)
    first, second = made(), made()
    for at_ps in sorted(rng.randrange(END_PS) for _ in range(INSTANTS)):
        first.until(at_ps)
        snap = first.save()
        second.restore(snap)
        assert second.save() == snap, (SEED, at_ps)
        assert second.now_ps == first.now_ps
        first.take_states(), first.take_edges()
        second.until(END_PS)
        after = outcome(second)
        assert second.save() == end, (SEED, at_ps)
        assert after[1] == raw[len(raw) - len(after[1]) :], (SEED, at_ps)
        assert after[2] == [edge for edge in edges if edge[0] > snap_time(edges, after[2])], (SEED, at_ps)
        assert np.array_equal(after[0], states[len(states) - len(after[0]) :]), (SEED, at_ps)
        assert list(after[3:]) == rest, (SEED, at_ps)


def snap_time(edges: list, after: list) -> int:
    """The instant of the last edge before those after the snapshot; edges of one instant are not split."""
    return edges[len(edges) - len(after) - 1][0] if len(after) < len(edges) else -1


def test_refuses_what_is_not_its_own_and_stays_as_it_was():
    it = made()
    it.until(700_000_000_000)
    snap = it.save()
    it.until(800_000_000_000)
    now = it.save()
    rng = random.Random(SEED)
    for n in range(FLIPS):
        at = n // 8 if n < 8 * HEADER else rng.randrange(len(snap))
        changed = bytearray(snap)
        changed[at] ^= 1 << n % 8
        with pytest.raises(ValueError, match="no snapshot|another configuration"):
            it.restore(bytes(changed))
        with pytest.raises(ValueError, match="no snapshot"):
            it.restore(snap[: rng.randrange(len(snap))])
    for keys in ({"clock_hz": 12_000_000}, {"part": "at89s52"}, {"firmware": "acq_57600.ihx"}):
        with pytest.raises(ValueError, match="another configuration"):
            made(**keys).restore(snap)
    assert it.save() == now
    it.restore(snap)
    assert it.save() == snap


def test_volts_set_by_hand_come_back():
    it, other = made(), made()
    it.set_volts(1, 1.25)
    it.until(100_000_000_000)
    snap = it.save()
    it.clear_volts(1)
    it.until(200_000_000_000)
    cleared = it.scans()[-1, 4]
    other.restore(snap)
    other.until(200_000_000_000)
    assert other.scans()[-1, 4] == round(1.25 / 5 * 4096)
    assert cleared != other.scans()[-1, 4]
