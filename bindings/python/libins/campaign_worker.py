"""Where the runs of a campaign happen: each in a process beside, so that a crash is a row, in threads here or on Dask.

A thread that runs, of the local pool or of a Dask worker, keeps one child process and talks to it in pickles.
"""

import contextlib
import functools
import hashlib
import os
import pickle
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from pathlib import Path
from typing import Any

from libins.errors import UsageError
from libins.tables import Loaded

IGNORED = ("scenario", "matrix", "seed", "wall_s", "speed", "reports", "not_judged", "failed", "verdict", "dds")
"""Of a run's summary: not measured, or in a column of its own."""

_thread = threading.local()
_children: set["subprocess.Popen[bytes]"] = set()


@functools.cache
def build() -> str:
    """Which emulator this is: runs of two builds do not belong in one table."""
    from libins import _run

    return hashlib.sha256(Path(_run.__file__).read_bytes()).hexdigest()


def lost(outcome: str, error: str) -> dict[str, Any]:
    """The row of a run that measured nothing."""
    return {"outcome": outcome, "error": error, "measured": {}, "wall_s": 0.0}


def run_in_child(scenario: Loaded, needed: str) -> dict[str, Any]:
    """Outcome, error, measured and wall_s of a run, by this thread's child. Raises UsageError in another build."""
    if build() != needed:
        raise UsageError("a worker has another build of libins than the campaign; install the same on both")
    child: subprocess.Popen[bytes] | None = getattr(_thread, "child", None)
    if child is None or child.poll() is not None:
        words = [sys.executable, "-m", "libins.campaign_worker"]
        pipe = subprocess.PIPE
        # In a session of its own: the terminal's ctrl-C is the parent's, who then closes the pipe.
        child = _thread.child = subprocess.Popen(words, stdin=pipe, stdout=pipe, start_new_session=True)
        _children.add(child)
    assert child.stdin is not None and child.stdout is not None
    try:
        pickle.dump(scenario, child.stdin)
        child.stdin.flush()
        row: dict[str, Any] = pickle.load(child.stdout)
        return row
    except (EOFError, BrokenPipeError, pickle.UnpicklingError):
        code = child.wait()
        _children.discard(child)
        reason = signal.Signals(-code).name if code < 0 else f"exit code {code}"
        return lost("crash", f"the process of the run ended by {reason}")


def measure(scenario: Loaded) -> dict[str, Any]:
    """The run itself, here."""
    from libins import report, run

    try:
        result = run.execute(scenario, run.Options())
    except UsageError as error:
        return lost("refused", str(error))
    except Exception as error:  # whatever it is, the campaign goes on and the row tells
        return lost("crash", f"{type(error).__name__}: {error}")
    reports = result.summary["reports"]
    kinds = {each["kind"] for each in reports}
    if "not_modelled" in kinds:
        outcome = "not modelled"
    elif "guest_error" in kinds:
        outcome = "firmware error"
    elif result.exit_code == 42:
        outcome = "time limit"
    else:
        outcome = "fail" if result.summary["failed"] else "pass"
    texts = [*result.summary["failed"], *map(report.report_line, reports)]
    measured = dict(_flat("", {key: v for key, v in result.summary.items() if key not in IGNORED}))
    return {"outcome": outcome, "error": "; ".join(texts), "measured": measured, "wall_s": result.summary["wall_s"]}


def _flat(name: str, value: Any) -> Iterator[tuple[str, Any]]:
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from _flat(f"{name}.{key}" if name else key, inner)
    elif value is not None:
        yield name, value


class Pool:
    """Runs scenarios at a time."""

    def __init__(self, executor: Executor, width: Callable[[], int]) -> None:
        """executor: of threads here, or of a Dask client; width: how many runs it should hold."""
        self._executor = executor
        self.width = width

    def submit(self, scenario: Loaded, needed: str) -> "Future[dict[str, Any]]":
        """Begin a run."""
        return self._executor.submit(run_in_child, scenario, needed)

    def result(self, future: "Future[dict[str, Any]]", seed: int) -> dict[str, Any]:
        """Of a run that has ended. Raises UsageError when the cluster gave it up."""
        try:
            return future.result()
        except UsageError:
            raise
        except Exception as error:
            raise UsageError(f"the cluster gave up seed {seed}: {error}; the same command goes on") from error


@contextlib.contextmanager
def pool(dask: str | None, jobs: int) -> Iterator[Pool]:
    """Threads with a child each, or a Dask cluster. Raises UsageError."""
    if dask is not None:
        with _dask(dask) as client:
            threads = client.get_executor(pure=False)
            yield Pool(threads, lambda: 3 * max(1, sum(client.nthreads().values())))
        return
    executor = ThreadPoolExecutor(jobs)
    try:
        yield Pool(executor, lambda: 2 * jobs)
    finally:
        executor.shutdown(wait=False, cancel_futures=True)
        for child in list(_children):
            child.kill()
        executor.shutdown()


@contextlib.contextmanager
def _dask(place: str) -> Iterator[Any]:
    try:
        import distributed
    except ImportError as error:
        raise UsageError("--dask needs distributed: pip install 'libins[campaign]'") from error
    with contextlib.ExitStack() as stack:
        if place.startswith("local:"):
            local = distributed.LocalCluster(
                n_workers=int(place.removeprefix("local:")),
                threads_per_worker=1,
                host="127.0.0.1",
                dashboard_address=None,
                worker_dashboard_address=None,
            )
            address = stack.enter_context(local).scheduler_address
        else:
            address = place
        try:
            client = stack.enter_context(distributed.Client(address, timeout="10s", set_as_default=False))
        except OSError as error:
            raise UsageError(f"--dask {place}: no scheduler answers there; start it, or use local:N") from error
        yield client


def main() -> None:
    """The child: a pickled scenario in, a pickled row out, until the parent is gone."""
    rows = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    with contextlib.suppress(EOFError, BrokenPipeError):
        while True:
            pickle.dump(measure(pickle.load(sys.stdin.buffer)), rows)
            rows.flush()


if __name__ == "__main__":
    main()
