"""Campaigns on a Dask cluster of this machine: the table of local processes, also when a worker is killed midway.

INS_BENCH=1: 1,000 runs, and the throughput of two workers beside that of one.
"""

import contextlib
import os
import signal
import time
from collections.abc import Iterator

import distributed
from campaign_kit import alive, children, rows, start, tables, write

BENCH = "INS_BENCH" in os.environ
RUNS = 1000 if BENCH else 24
STOP_S = 1.0
PATIENCE_S = 600


@contextlib.contextmanager
def cluster(workers: int) -> Iterator[distributed.LocalCluster]:
    with distributed.LocalCluster(
        n_workers=workers, threads_per_worker=1, host="127.0.0.1", dashboard_address=None, worker_dashboard_address=None
    ) as started:
        yield started


def timed(*arguments: object) -> float:
    """Wall seconds of a whole campaign."""
    begun = time.monotonic()
    process = start(*arguments)
    out, error = process.communicate(timeout=PATIENCE_S)
    assert process.returncode in (0, 1), out + error
    return time.monotonic() - begun


def test_the_table_is_that_of_local_processes_though_a_worker_is_killed(tmp_path):
    path = write(tmp_path, stop_s=STOP_S)
    options = (path, "--runs", RUNS, "--out")
    timed(*options, tmp_path / "local", "--jobs", 2)
    with cluster(2) as started:
        process = start(*options, tmp_path / "dask", "--dask", started.scheduler_address)
        killed = 0
        while process.poll() is None:
            time.sleep(0.005)
            if not killed and (tmp_path / "dask/rows.jsonl").exists() and len(rows(tmp_path / "dask")) >= RUNS // 4:
                killed = started.workers[0].pid
                orphans = children(killed)
                os.kill(killed, signal.SIGKILL)
                assert len(rows(tmp_path / "dask")) < RUNS
        out, error = process.communicate(timeout=PATIENCE_S)
        assert killed and orphans and process.returncode in (0, 1), out + error
        assert started.workers[0].pid != killed
    assert not any(map(alive, orphans))
    assert tables(tmp_path / "local") == tables(tmp_path / "dask")


def test_a_cluster_of_its_own_gives_the_same_table(tmp_path):
    path = write(tmp_path, stop_s=STOP_S)
    alone = timed(path, "--runs", RUNS, "--out", tmp_path / "one", "--dask", "local:1")
    both = timed(path, "--runs", RUNS, "--out", tmp_path / "two", "--dask", "local:2")
    assert tables(tmp_path / "one") == tables(tmp_path / "two")
    print(f"{RUNS} runs of {STOP_S} s: {RUNS / alone:.1f} a second by one worker, {RUNS / both:.1f} by two")
