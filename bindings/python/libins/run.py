"""A scenario, run: in virtual time or paced, with the host inside the run or outside on a serial endpoint."""

import contextlib
import hashlib
import json
import time
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from libins import _run, faults
from libins.coverage import File
from libins.endpoint import Endpoint
from libins.errors import UsageError
from libins.machine import AXES, COLUMNS, PS_PER_S, AcquisitionMachine, Array, Machine, accuracy, build
from libins.moments import Line, Moment, Moments
from libins.motions import motion_of
from libins.net_machine import NetMachine
from libins.net_scenario import NetScenario
from libins.program import Program
from libins.scenario import Scenario
from libins.tables import Expect, Loaded

__all__ = ["AXES", "COLUMNS", "PS_PER_S", "Array", "accuracy", "build", "execute", "motion_of"]

SLICE_S = 0.1
"""Virtual time between two looks at the results, unpaced."""
PACED_SLICE_S = 0.001
INSIDE = ("link.", "attitude.", "age_s.", "position.", "solution.")
"""Values that need the navigator inside the run; with a host outside, expectations on them are not judged."""
NO_SOLUTIONS = (
    "--dds and --ros publish what a navigator makes of codes; of a board that navigates itself, tie the host to a pty "
    "by --serial and let ins-navd --input nav publish"
)
BOUNDS = ("at_least", "at_most")


@dataclass(frozen=True)
class Check:
    """One expectation of the scenario, as judged."""

    name: str
    failure: str | None
    judged: bool = True


@dataclass
class Result:
    """What came out of a run. `states` and `scans` have the columns named."""

    summary: dict[str, Any]
    states: Array
    scans: Array
    exit_code: int
    columns: Sequence[str]
    checks: list[Check] = field(default_factory=list)
    scan_columns: Sequence[str] = tuple(_run.SCAN_COLUMNS)
    moments: list[Moment] = field(default_factory=list)
    """With Options.explain: the lines around the instants that explain the verdict."""
    lines: Mapping[str, Line] = field(default_factory=dict)
    """And what they carried."""


@dataclass
class Options:
    """How to run, beside what the scenario says."""

    seed: int | None = None
    stop_s: float | None = None
    speed: float | None = None
    """Simulated seconds a wall second; None = as fast as it goes."""
    strict: bool = False
    endpoints: Mapping[str, Endpoint] = field(default_factory=dict)
    """The outside, by the name of the line's end that it has."""
    publish: Callable[[bytes], None] | None = None
    trace: Callable[[Sequence[str], Array], None] | None = None
    program: Program | None = None
    console: Callable[[bytes], None] | None = None
    """Takes what the program writes to its console."""
    watch: "Watch | None" = None
    """What looks at the firmware meanwhile."""
    explain: bool = False
    """Keep what a report shows of failures."""
    progress: Callable[[float, Array], None] | None = None
    """Called with the simulated time and the new states."""


class Watch(Protocol):
    """What looks at a run meanwhile; see observe.Observation."""

    def begin(self, run: Any) -> None:
        """At the run's begin."""
        ...

    def slice(self, run: Any, edges: Array) -> None:
        """The edges of the traced wires since the last call."""
        ...

    def end(self, run: Any) -> dict[str, Any]:
        """What the summary gets; files get their names."""
        ...

    @property
    def view(self) -> Any:
        """What the report's pictures show, or None."""
        ...

    @property
    def files(self) -> Mapping[str, File]:
        """What ran of each C file."""
        ...

    def close(self) -> None:
        """Take away what an interrupted run has left."""
        ...


def machine_of(scenario: Loaded, seed: int, options: Options) -> Machine:
    """The run itself, at time 0. Raises UsageError."""
    if isinstance(scenario, NetScenario):
        return NetMachine(scenario, seed, list(options.endpoints))
    assert isinstance(scenario, Scenario)
    return AcquisitionMachine(
        scenario, seed, bool(options.endpoints), seen=options.watch is not None, program=options.program
    )


def execute(scenario: Loaded, options: Options) -> Result:
    """Run to the end and judge. Raises UsageError; CrashError when a board's process came to its end."""
    seed = scenario.tables.seed if options.seed is None else options.seed
    stop_s = scenario.tables.stop_s if options.stop_s is None else options.stop_s
    if scenario.csv is not None and scenario.csv[-1, 0] < stop_s:
        raise UsageError(f"{scenario.path}: the motion ends at {scenario.csv[-1, 0]} s, before stop_s = {stop_s}")
    with contextlib.closing(machine_of(scenario, seed, options)) as machine:
        return _execute(scenario, options, machine, seed, stop_s)


def _execute(scenario: Loaded, options: Options, machine: Machine, seed: int, stop_s: float) -> Result:
    tables = scenario.tables
    if options.publish is not None and machine.navigates and list(machine.columns[: len(COLUMNS)]) != list(COLUMNS):
        raise UsageError(f"{scenario.path}: {NO_SOLUTIONS}")
    if options.watch is not None:
        options.watch.begin(machine.subject)
    speed = options.speed if not options.endpoints or options.speed is not None else 1.0
    digest = hashlib.sha256()
    blocks: list[Array] = []
    published = 0
    used = 0
    started = time.monotonic()
    stop_ps = round(stop_s * PS_PER_S)
    reached_samples = False
    pacer = Pacer(speed or 1.0)
    moments = Moments(scenario, machine) if options.explain else None
    end: str | None = None
    while machine.now_ps < stop_ps and not reached_samples and end is None:
        if speed is None:
            machine.until(min(stop_ps, machine.now_ps + round(SLICE_S * PS_PER_S)))
        else:
            pacer.step(machine, stop_ps, options.endpoints)
        end = machine.ended()
        if options.console is not None:
            options.console(machine.output())
        states, raw = machine.take_states()
        edges = machine.take_edges()
        digest.update(edges.tobytes())
        if options.trace is not None:
            options.trace(machine.wires, edges)
        if options.watch is not None:
            options.watch.slice(machine.subject, edges)
        if moments is not None:
            moments.slice(machine, edges, states)
        if options.publish is not None:
            for state in raw:
                options.publish(state)
                published += 1
        if len(states):
            blocks.append(states)
            used += len(states)
        if options.progress is not None:
            options.progress(machine.now_ps / PS_PER_S, states)
        reached_samples = tables.stop_samples is not None and used >= tables.stop_samples
    wall_s = time.monotonic() - started
    states = np.concatenate(blocks) if blocks else np.empty((0, len(machine.columns)))
    program = machine.program()
    summary = {
        "scenario": scenario.path.name,
        **({"matrix": dict(scenario.combination)} if scenario.combination else {}),
        "firmware": scenario.firmware.name,
        "sim_s": machine.now_ps / PS_PER_S,
        "wall_s": wall_s,
        "speed": machine.now_ps / PS_PER_S / wall_s if wall_s > 0 else None,
        "seed": seed,
        **machine.measured(states),
        **({"program": program} if program is not None else {}),
        "dds": {"published": published, "received": None} if options.publish is not None else None,
        "trace_sha256": digest.hexdigest(),
        "reports": machine.reports(),
        **({"faults": faults.counted(machine.fault_hits())} if tables.fault else {}),
        **(options.watch.end(machine.subject) if options.watch is not None else {}),
    }
    checks = [_judged(expect, summary, options.endpoints) for expect in tables.expect]
    if tables.stop_samples is not None:
        few = f"stop_samples: {len(states)} of {tables.stop_samples} samples came in {stop_s} s simulated"
        checks.append(Check(f"stop_samples {tables.stop_samples}", None if reached_samples else few))
    failed = [check.failure for check in checks if check.failure]
    summary["not_judged"] = [e.value for e, check in zip(tables.expect, checks, strict=False) if not check.judged]
    summary["failed"] = failed
    code = 1 if failed else 0
    if program is not None and end is not None:
        code = program["exit_code"] or code
    if (tables.stop_samples is not None and not reached_samples) or (program is not None and end is None):
        code = 42
    if options.strict and summary["reports"]:
        code = 3
    summary["verdict"] = "fail" if code else "pass"
    result = Result(summary, states, machine.scans(), code, machine.columns, checks, machine.scan_columns)
    if moments is not None:
        of_value = {e.value: check.failure for e, check in zip(tables.expect, checks, strict=False) if check.failure}
        result.moments = moments.end(machine, of_value or ({"run": failed[0]} if failed else {}))
        result.lines = moments.lines
    return result


class Pacer:
    """Keeps virtual time to the wall clock, never ahead of it, and never catching up.

    A machine that stalls stops the board's time as well, so that the host at the other end has the whole time-outs.
    """

    def __init__(self, speed: float) -> None:
        """Speed: simulated seconds a wall second."""
        self._speed = speed
        self._origin = time.monotonic()
        """The wall clock at which virtual time would have been 0."""

    def step(self, machine: Machine, stop_ps: int, endpoints: Mapping[str, Endpoint]) -> None:
        """Wait for the end of the next slice, run it, and exchange octets with the outside."""
        end_ps = min(stop_ps, machine.now_ps + round(PACED_SLICE_S * self._speed * PS_PER_S))
        ahead_s = self._origin + end_ps / PS_PER_S / self._speed - time.monotonic()
        if ahead_s > 0:
            time.sleep(ahead_s)
        else:
            self._origin -= ahead_s
        for line, endpoint in endpoints.items():
            if octets := endpoint.read():
                machine.send(line, octets)
        machine.until(end_ps)
        for line, endpoint in endpoints.items():
            if octets := machine.take_octets(line):
                endpoint.write(octets)


def _judged(expect: Expect, summary: dict[str, Any], outside: Collection[str]) -> Check:
    """An expectation against the summary; with the host outside, what needs the navigator is not judged."""
    bounds = [
        f"{word.replace('_', ' ')} {getattr(expect, word):g}" for word in BOUNDS if getattr(expect, word) is not None
    ]
    theirs = tuple(f"hosts.{name}.{inside}" for name in outside for inside in INSIDE)
    judged = not expect.value.startswith(theirs if summary["link"] is not None else (*theirs, *INSIDE))
    return Check(f"{expect.value} {' and '.join(bounds)}", failure(expect, summary) if judged else None, judged)


def failure(expect: Expect, summary: dict[str, Any]) -> str | None:
    """Why an expectation is not met, or None."""
    value: Any = summary
    for name in expect.value.split("."):
        value = value.get(name) if isinstance(value, dict) else None
    if not isinstance(value, (int, float)):
        return f"{expect.value}: found {value!r}, which is no number"
    if expect.at_most is not None and not value <= expect.at_most:
        return f"{expect.value} = {value:.6g}, expected at most {expect.at_most:g}"
    if expect.at_least is not None and not value >= expect.at_least:
        return f"{expect.value} = {value:.6g}, expected at least {expect.at_least:g}"
    return None


def to_json(summary: dict[str, Any] | list[dict[str, Any]]) -> str:
    """The summary, or those of a matrix, as JSON; the same bytes for the same run, wall_s and speed aside."""
    return json.dumps(summary, indent=2) + "\n"
