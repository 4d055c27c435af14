"""The link when things go wrong on the line: nothing is integrated twice, what is lost is counted and bridged."""

import csv
import json
import os
from pathlib import Path

import pytest

PERIOD_S = 0.02
# The board waits 8 ticks of 1024 machine cycles for a reply, the host 6 ms for an octet; each may be served once.
TIMEOUTS_S = 8 * 1024 / 921_600 + 0.006
SEEDS = range(1, 101 if "INS_BENCH" in os.environ else 6)


def run(ins, path: Path, out: Path, *options):
    done = ins("run", path, "--json", out / "s.json", "--states", out / "states.csv", *options)
    assert done.returncode in (0, 1), done.stdout + done.stderr
    with (out / "states.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    return json.loads((out / "s.json").read_text()), rows


def adds_up(s, rows) -> None:
    link = s["link"]
    assert link["before_first"] + link["ok"] + link["lost"] + link["in_flight"] == link["sent"], link
    indices = [int(float(row["index"])) for row in rows]
    assert indices == sorted(set(indices)), "a block was integrated twice, or out of order"
    scans = [int(float(row["scan"])) for row in rows]
    if link["corrupt_accepted"] == 0:
        assert [scan - scans[0] for scan in scans] == indices
    bridged = sum(int(float(row["bridged"])) for row in rows)
    assert bridged == link["lost"]
    assert all((int(float(row["status"])) & 2 != 0) == (float(row["bridged"]) > 0) for row in rows)


@pytest.mark.parametrize("seed", SEEDS)
def test_bit_errors_and_lost_octets(ins, scenario, tmp_path, seed):
    path = scenario("default", ("baud = 9600", "baud = 9600\nbit_error = 1e-4\noctet_loss = 1e-3"))
    s, rows = run(ins, path, tmp_path, "--seed", seed)
    print(f"seed {seed}: {s['link']}")
    assert s["link"]["bits_inverted"] > 0
    assert s["link"]["octets_swallowed"] > 0
    assert s["link"]["retried"] > 0
    adds_up(s, rows)


def test_a_cut_of_two_seconds(ins, scenario, tmp_path):
    path = scenario("default", ("baud = 9600", "baud = 9600\ncuts_s = [[5.0, 7.0]]"))
    s, rows = run(ins, path, tmp_path)
    adds_up(s, rows)
    times = [float(row["t_s"]) + float(row["age_s"]) for row in rows]
    last = max(t for t in times if t <= 5.02)
    back = min(t for t in times if t > 5.02)
    print(f"cut: last state {last:.4f} s, first after {back:.4f} s, lost {s['link']['lost']}")
    assert back - 7.0 <= PERIOD_S + TIMEOUTS_S
    assert 95 <= s["link"]["lost"] <= 105
    bridges = [int(float(row["bridged"])) for row in rows if float(row["bridged"]) > 0]
    assert max(bridges) >= 95


def test_another_baud_is_counted_not_believed(ins, scenario, tmp_path):
    """A host at 4800 or 19200 Bd hears framing errors and wrong octets; no state comes out of them."""
    for baud in (4800, 19200):
        s, rows = run(ins, scenario("default", ("baud = 9600", f"baud = {baud}")), tmp_path, "--stop-s", 3)
        link = s["link"]
        assert link["framing_errors"] + link["stray"] + link["timeouts"] + link["corrupt"] > 0, link
        assert len(rows) <= 1
        assert s["verdict"] == "fail"


def test_without_sequence_number_a_resent_block_is_taken_twice(ins, scenario, tmp_path):
    """The paper's bytes: what the option is for. A 00 lost makes the host integrate the same block again."""
    path = scenario("s3_paper", ("baud = 9600", "baud = 9600\noctet_loss = 0.01"))
    taken = 0
    for seed in SEEDS:
        s, rows = run(ins, path, tmp_path, "--seed", seed)
        scans = [int(float(row["scan"])) for row in rows]
        taken += len(scans) - len(set(scans))
    assert taken > 0
