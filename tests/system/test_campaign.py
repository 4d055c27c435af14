"""Campaigns: the same seeds give the same table, whoever runs them, however often it is interrupted."""

import csv
import os
import shlex
import signal
import subprocess
import time

import polars
import pytest
from campaign_kit import PLAN, TABLES, alive, children, rows, start, tables, write
from test_bad_input import refused

from libins import cli

RUNS = 200 if "INS_BENCH" in os.environ else 16
DRAWS = 200_000 if "INS_BENCH" in os.environ else 20_000
PATIENCE_S = 60


@pytest.fixture
def campaign(capsys):
    """`ins campaign ARGUMENTS...` in this process."""

    def call(*arguments: object) -> "subprocess.CompletedProcess[str]":
        words = ["campaign", *map(str, arguments)]
        code = cli.main(words)
        out, error = capsys.readouterr()
        return subprocess.CompletedProcess(words, code, out, error)

    return call


def image(path, octets: bytes) -> None:
    """A program at address 0."""
    record = bytes([len(octets), 0, 0, 0]) + octets
    path.write_text(f":{record.hex()}{-sum(record) & 0xFF:02x}\n:00000001FF\n".upper(), encoding="ascii")


def wait_for(process, seen) -> None:
    end = time.monotonic() + PATIENCE_S
    while not seen():
        assert process.poll() is None and time.monotonic() < end, process.communicate()
        time.sleep(0.005)


def test_the_seeds_alone_make_the_table(campaign, tmp_path):
    path = write(tmp_path)
    for jobs in (1, 3):
        done = campaign(path, "--runs", RUNS, "--jobs", jobs, "--out", tmp_path / f"jobs{jobs}")
        assert done.returncode in (0, 1), done.stderr
    assert tables(tmp_path / "jobs1") == tables(tmp_path / "jobs3")
    frame = polars.read_parquet(tmp_path / "jobs1/table.parquet")
    assert frame["seed"].to_list() == list(range(1, RUNS + 1))
    with (tmp_path / "jobs1/table.csv").open(newline="") as file:
        lines = list(csv.DictReader(file))
    for name in ("set.link.baud", "set.link.bit_error", "cpu.cycles"):
        assert [float(line[name]) for line in lines] == frame[name].to_list()
    assert frame["trace_sha256"].n_unique() == RUNS
    assert set(frame["set.firmware"]) == {"acq_default.ihx", "acq_80ms_seq.ihx"}
    assert frame["set.nav.sequence"].dtype == polars.Boolean and frame["set.clock_hz"].dtype == polars.Int64
    times = (tmp_path / "jobs1/times.csv").read_text().splitlines()
    assert [line.split(",")[0] for line in times] == ["seed", *map(str, range(1, RUNS + 1))]
    assert all(float(line.split(",")[1]) > 0 for line in times[1:])


def test_another_first_seed_is_another_window_on_the_same_runs(campaign, tmp_path):
    path = write(tmp_path)
    for first, runs, out in ((1, 5, "a"), (4, 3, "b"), (4, 3, "a")):
        campaign(path, "--runs", runs, "--seed", first, "--out", tmp_path / out)
    assert tables(tmp_path / "a") == tables(tmp_path / "b")
    assert [row["seed"] for row in rows(tmp_path / "a")[:5]] != [] and len(rows(tmp_path / "a")) == 6


def test_killed_and_started_again_the_table_is_the_same(campaign, tmp_path):
    path = write(tmp_path, stop_s=1.0)
    options = (path, "--runs", RUNS, "--jobs", 2, "--out")
    whole = campaign(*options, tmp_path / "whole")
    process = start(*options, tmp_path / "cut")
    lines = tmp_path / "cut/rows.jsonl"
    wait_for(process, lambda: lines.exists() and lines.read_bytes().count(b"\n") > RUNS // 4)
    orphans = children(process.pid)
    process.kill()
    process.communicate()
    before = lines.read_bytes()
    assert before.count(b"\n") < RUNS and orphans
    lines.write_bytes(before + b'{"seed": 3, "outco')  # as killed in the middle of a line
    again = campaign(*options, tmp_path / "cut")
    assert again.returncode == whole.returncode, again.stderr
    assert f"({before.count(10) - 1} were there)" in again.stdout
    after = lines.read_bytes()
    assert after.startswith(before) and after.count(b"\n") == RUNS + 1
    assert tables(tmp_path / "cut") == tables(tmp_path / "whole")
    wait_for(Nobody, lambda: not any(map(alive, orphans)))


class Nobody:  # whom wait_for asks when no process is waited for
    @staticmethod
    def poll() -> None:
        return None

    @staticmethod
    def communicate() -> str:
        return "children of the killed campaign are still there"


def test_interrupted_by_ctrl_c_no_row_is_a_crash(campaign, tmp_path):
    path = write(tmp_path, stop_s=2.0)
    options = (path, "--runs", RUNS, "--jobs", 2, "--out", tmp_path / "out")
    process = start(*options)
    wait_for(process, lambda: (tmp_path / "out/rows.jsonl").exists() and len(rows(tmp_path / "out")) > 1)
    os.killpg(process.pid, signal.SIGINT)  # as a terminal does: to the whole group
    out, error = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 130 and "Traceback" not in error, error
    done = rows(tmp_path / "out")
    assert len(done) < RUNS and not [row for row in done if row["outcome"] == "crash"]


def test_a_crash_is_a_row_and_not_the_end(tmp_path):
    path = write(tmp_path, stop_s=4.0)
    process = start(path, "--runs", 4, "--jobs", 1, "--out", tmp_path / "out")
    wait_for(process, lambda: (tmp_path / "out/rows.jsonl").exists() and len(rows(tmp_path / "out")) == 1)
    (child,) = children(process.pid)
    os.kill(child, signal.SIGSEGV)
    out, error = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 1 and "1 crash" in out, out + error
    frame = polars.read_csv(tmp_path / "out/table.csv")
    crashed = frame.filter(polars.col("outcome") == "crash")
    assert crashed["error"].to_list() == ["the process of the run ended by SIGSEGV"]
    assert frame["seed"].to_list() == [1, 2, 3, 4] and frame["trace_sha256"].null_count() == 1
    command = next(line for line in (tmp_path / "out/index.html").read_text().splitlines() if "ins run" in line)
    assert f"--seed {crashed['seed'][0]} " in command


def test_every_outcome_has_its_class(campaign, tmp_path):
    image(tmp_path / "a5.ihx", bytes([0xA5, 0x80, 0xFE]))  # the reserved opcode
    image(tmp_path / "movx.ihx", bytes([0x90, 0, 0, 0xE0, 0x80, 0xFE]))  # external memory that the board has not
    plan = """
[campaign]
firmware = { list = ["acq_default.ihx", "acq_default.ihx", "acq_default.ihx", "a5.ihx", "movx.ihx"] }
stop_samples = { list = [2, 2, 1000, 2, 2] }
"expect.1.at_most" = { list = [1.0, 1e-12, 1.0, 1.0, 1.0] }
"""
    done = campaign(write(tmp_path, plan), "--runs", 5, "--seed", 5, "--out", tmp_path / "out")
    assert done.returncode == 1, done.stderr
    frame = polars.read_csv(tmp_path / "out/table.csv")
    assert frame["outcome"].to_list() == ["pass", "fail", "time limit", "firmware error", "not modelled"]
    errors = frame["error"].to_list()
    assert not errors[0] and "attitude.max_rad.yaw" in errors[1] and "of 1000 samples" in errors[2]
    assert "A5h" in errors[3] and "MOVX" in errors[4]


def test_a_value_out_of_range_in_some_run_is_a_row(campaign, tmp_path):
    plan = "\n[campaign]\nlink.bit_error = { normal = [0.0, 0.01] }\n"
    campaign(write(tmp_path, plan), "--runs", 8, "--out", tmp_path / "out")
    frame = polars.read_csv(tmp_path / "out/table.csv")
    below = frame["set.link.bit_error"] < 0
    assert 0 < below.sum() < 8
    assert ((frame["outcome"] == "refused") == below).all()
    assert all("link.bit_error: found -" in error for error in frame.filter(below)["error"])


def test_the_command_beside_a_row_runs_it_alone(summary, campaign, tmp_path):
    path = write(tmp_path, PLAN + '"expect.0.at_most" = { list = [-1] }\n')
    campaign(path, "--runs", 2, "--set", "stop_s=0.25", "--set", "link.baud=9600", "--out", tmp_path / "out")
    page = (tmp_path / "out/index.html").read_text().replace("&#39;", "'").replace("&#34;", '"')
    commands = [shlex.split(line[5:-6]) for line in page.splitlines() if line.startswith("<pre>")]
    assert len(commands) == 2 and all(words[:2] == ["ins", "run"] for words in commands)
    hashes = [summary(*words[2:], code=1)["trace_sha256"] for words in commands]
    frame = polars.read_parquet(tmp_path / "out/table.parquet")
    assert hashes == frame["trace_sha256"].to_list()
    assert "set.clock_hz" in frame.columns and "set.link.baud" not in frame.columns  # what is set is no longer varied


def test_a_plan_beside_is_the_same_campaign(campaign, tmp_path):
    (tmp_path / "plan.toml").write_text(PLAN, encoding="utf-8")
    inside = write(tmp_path)
    campaign(inside, "--runs", 2, "--out", tmp_path / "a")
    bare = write(tmp_path, "", name="bare.toml")
    campaign(bare, "--plan", tmp_path / "plan.toml", "--runs", 2, "--out", tmp_path / "b")
    assert (tmp_path / "a/table.csv").read_bytes() == (tmp_path / "b/table.csv").read_bytes()


def test_draws_follow_their_distribution():
    from libins.campaign import Vary

    n = DRAWS
    sigma = n**-0.5

    def draws(how, given, integer=False):
        return [Vary("link.baud", how, given, integer).draw(seed) for seed in range(n)]

    values = draws("uniform", [2.0, 6.0])
    assert 2.0 < min(values) < 2.01 and 5.99 < max(values) < 6.0
    assert abs(sum(values) / n - 4.0) < 5 * sigma * 4 / 12**0.5
    steps = max(abs((i + 0.5) / n - (value - 2.0) / 4.0) for i, value in enumerate(sorted(values)))
    assert steps < 1.95 * sigma  # Kolmogorov and Smirnov, one in a thousand
    values = draws("normal", [-1.0, 3.0])
    mean = sum(values) / n
    assert (
        abs(mean + 1.0) < 5 * sigma * 3 and abs((sum((v - mean) ** 2 for v in values) / n) ** 0.5 - 3.0) < 5 * sigma * 3
    )
    assert abs(sum(v > 5.0 for v in values) / n - 0.02275) < 5 * sigma * 0.15  # beyond two sigma
    values = draws("uniform", [1, 3], integer=True)
    assert {type(v) for v in values} == {int}
    assert all(abs(values.count(v) / n - 1 / 3) < 5 * sigma * 0.48 for v in (1, 2, 3))
    assert all(type(v) is int for v in draws("normal", [100.0, 5.0], integer=True))
    assert abs(sum(draws("chance", 0.2)) / n - 0.2) < 5 * sigma * 0.4
    values = draws("choice", ["a", "b"])
    assert abs(values.count("a") / n - 0.5) < 5 * sigma * 0.5
    assert draws("list", [7, 8, 9])[:4] == [7, 8, 9, 7]
    one, other = (Vary(key, "uniform", [-1.0, 1.0], False) for key in ("a", "b"))
    assert abs(sum(one.draw(seed) * other.draw(seed) for seed in range(n)) / n) < 5 * sigma / 3  # keys are independent


@pytest.mark.parametrize(
    ("lines", "words"),
    [
        ("link.baud = [9600]", (":46:", "campaign.link.baud", "[9600]", "uniform")),
        ("link.baud = { uniform = [9600] }", (":46:", "campaign.link.baud", "uniform", "low and high")),
        ("link.baud = { uniform = [2, 1] }", ("campaign.link.baud", "[2, 1]", "low and high")),
        ("link.baud = { normal = [9600, -1] }", ("campaign.link.baud", "mean and sigma")),
        ("link.baud = { normal = [9600, true] }", ("campaign.link.baud", "mean and sigma")),
        ("link.baud = { choice = [] }", ("campaign.link.baud", "one value or more")),
        ("link.baud = { choice = [9600, 9] }", (":46: campaign: link.baud", "found 9.0", "50")),
        ("link.baud = { uniform = [9600, inf] }", ("campaign.link.baud", "low and high")),
        ("link.baud = { normal = [9600, 1], list = [1] }", ("campaign.link.baud", "alone")),
        ("nav.sequence = { chance = 1.5 }", ("campaign.nav.sequence", "0 .. 1")),
        ("link.baud = { chance = 0.5 }", ("campaign: link.baud", "False", "a number")),
        ("link.bawd = { list = [9600] }", (":46: campaign: link.bawd", "unknown key", "'baud'")),
        ("clock_hz = { uniform = [11e6, 12e6] }", ("campaign.clock_hz", "integers")),
        ("seed = { list = [1] }", ("campaign.seed", "--seed")),
        ("link.baud = { list = [9600] }\n[matrix]\nseed = [1, 2]", ("[matrix]", "[campaign]")),
    ],
)
def test_a_bad_campaign_is_refused_before_anything_runs(campaign, tmp_path, lines, words):
    path = write(tmp_path, f"\n[campaign]\n{lines}\n")
    refused(campaign(path, "--runs", 2, "--out", tmp_path / "out"), "varied.toml", *words)
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--runs", 0), ("--runs 0", "1 .. ")),
        (("--runs", 2, "--seed", -1), ("--seed -1", "0 .. ")),
        (("--runs", 2, "--jobs", 0), ("--jobs 0",)),
        (("--runs", 2, "--dask", "local:0"), ("--dask local:0", "local:N")),
        (("--runs", 2, "--dask", "tcp://127.0.0.1:9"), ("tcp://127.0.0.1:9", "no scheduler")),
    ],
)
def test_bad_options_are_refused(campaign, tmp_path, options, words):
    refused(campaign(write(tmp_path), *options, "--out", tmp_path / "out"), *words)


def test_a_scenario_without_the_table_says_what_is_missing(campaign, tmp_path):
    refused(campaign("default", "--runs", 1, "--out", tmp_path), "default.toml", "campaign", "missing")


def test_another_campaign_in_the_folder_is_refused(campaign, tmp_path):
    out = tmp_path / "out"
    campaign(write(tmp_path), "--runs", 1, "--out", out)
    before = {path.name: path.read_bytes() for path in out.iterdir()}
    refused(campaign(write(tmp_path, stop_s=0.31), "--runs", 1, "--out", out), "another campaign", "scenario")
    refused(campaign(write(tmp_path), "--runs", 1, "--set", "stop_s=0.2", "--out", out), "settings differ")
    assert before == {path.name: path.read_bytes() for path in out.iterdir()}
    (out / "rows.jsonl").write_text(f"{(out / 'rows.jsonl').read_text().splitlines()[0]}\n[]\n")
    refused(campaign(write(tmp_path), "--runs", 1, "--out", out), "rows.jsonl:2", "not a row")


def test_two_campaigns_do_not_write_in_one_folder(campaign, tmp_path):
    options = (write(tmp_path, stop_s=3.0), "--runs", 4, "--jobs", 1, "--out", tmp_path / "out")
    process = start(*options)
    wait_for(process, lambda: (tmp_path / "out/rows.jsonl").exists() and children(process.pid))
    refused(campaign(*options), "another campaign is writing")
    out, error = process.communicate(timeout=PATIENCE_S)
    assert len(rows(tmp_path / "out")) == 4, error
    assert all((tmp_path / "out" / name).stat().st_size for name in TABLES)


def test_faults_come_by_chance_and_are_counted(campaign, tmp_path):
    plan = """
[[fault]]
kind = "wire_short"
net = "DATA OUT"
to = "gnd"
[campaign]
fault.0.on = { chance = 0.5 }
"""
    campaign(write(tmp_path, plan), "--runs", RUNS, "--out", tmp_path / "out")
    frame = polars.read_csv(tmp_path / "out/table.csv")
    broken = frame["set.fault.0.on"]
    assert 0 < broken.sum() < RUNS
    assert frame["faults.0.wire_short"].to_list() == broken.cast(int).to_list()
    whole = frame.filter(~broken)["trace_sha256"]
    assert whole.n_unique() == 1 and whole[0] not in frame.filter(broken)["trace_sha256"]
