"""Nets at random, each run twice, its time cut in other places: stations, delays, bauds, faults, traces."""

import os
import random

import pytest
from net_kit import BAUD, ECHO, MS, PS_PER_S, add_acquisition, fault

from libins import _run

SEED = 20061122
NETS = 100 if os.environ.get("INS_BENCH") else 6
SIM_MS = 300
CUTS_MOST = 400
SENDS = 12
CHOICES = ("crystal", "reset", "wire_cut", "break", "baud")


def built(rng: random.Random):
    """One, two or three boards, and who hosts them."""
    net = _run.Net(rng.randrange(1 << 32))
    hosts = []

    def line() -> dict:
        bad = {"bit_error": 2e-3, "octet_loss": 0.05, "cuts_s": [[0.05, 0.06]]} if rng.random() < 0.4 else {}
        delay_s = rng.choice([0.0, 1e-9 * rng.randrange(10_000, 100_000), 1e-3 * rng.random() + 1e-5])
        return {"delay_s": delay_s, **bad}

    for name in ("left", "right")[: rng.randrange(1, 3)]:
        net.f2812(name, ECHO, oscclk_hz=rng.choice([30_000_000, 29_999_999, 30_300_000]))
        net.host(f"{name} pc", BAUD * rng.choice([1.0, 0.98, 1.02]))
        hosts.append(f"{name} pc")
        net.line(f"{name}.SCIA", f"{name} pc", BAUD, **line())
        if rng.random() < 0.5:
            net.record(name, True, True)
    if len(hosts) == 2 and rng.random() < 0.5:
        net.line("left.SCIB", "right.SCIB", BAUD, **line())
    board = add_acquisition(net, rng.randrange(1 << 32)) if rng.random() < 0.5 else None
    for host in hosts:
        name = host.removesuffix(" pc")
        for wire in ((name, "SCITXDA"), (name, "SCIRXDA"), (host, "TXD")):
            net.trace(*wire)
        kind = rng.choice(CHOICES)
        from_ps = rng.randrange(SIM_MS * MS)
        keys = {"from_ps": from_ps, "to_ps": from_ps + rng.randrange(1, 50 * MS), "seed": rng.randrange(1 << 32)}
        keys |= {"net": rng.choice(["SCITXDA", "SCIRXDA"])} if kind in ("wire_cut", "break") else {}
        keys |= {"other": "gnd"} if kind == "break" else {}
        keys |= {"value": rng.uniform(-3e4, 3e4), "drift": rng.choice([0.0, 1e4])} if kind == "crystal" else {}
        keys |= {"value": rng.uniform(-5e4, 5e4)} if kind == "baud" else {}
        keys |= {"lasts_ps": rng.randrange(1, 5 * MS), "rate_hz": rng.choice([0.0, 20.0])} if kind == "reset" else {}
        net.add_fault(host if kind == "baud" else name, fault(kind, **keys))
    return net, hosts, board


def shown(seed: int, cuts: list[int]) -> tuple:
    """All that a net shows, with its time cut there too."""
    rng = random.Random(seed)
    net, hosts, board = built(rng)
    sends = sorted(
        (rng.randrange(SIM_MS * MS), rng.choice(hosts), rng.randbytes(rng.randrange(1, 9))) for _ in range(SENDS)
    )
    told = dict.fromkeys(cuts)
    for at, host, octets in [*sends, (SIM_MS * MS, hosts[0], b"")]:
        for cut in [cut for cut in told if cut < at]:
            assert net.until(cut)
            del told[cut]
        assert net.until(at)
        net.send(host, octets)
    names = [host.removesuffix(" pc") for host in hosts]
    return (
        [net.take_received(host) for host in hosts],
        [net.host_counters(host) for host in hosts],
        net.take_edges().tolist(),
        [net.take_records(name).tolist() for name in names],
        [net.reports(name) for name in names],
        [net.fault_hits(name) for name in [*names, *hosts]],
        (net.take_states("navd")[1], board.scans().tolist(), net.reports("acq")) if board else (),
    )


@pytest.mark.parametrize("seed", range(SEED, SEED + NETS))
def test_a_net_shows_the_same_wherever_its_time_is_cut(seed):
    rng = random.Random(-seed)
    cuts = sorted(rng.sample(range(SIM_MS * PS_PER_S // 1000), rng.randrange(1, CUTS_MOST)))
    once, often = shown(seed, []), shown(seed, cuts)
    assert len(once[2]) > 50, "somebody spoke"
    for what, (a, b) in enumerate(zip(once, often, strict=True)):
        assert a == b, (seed, what)
