"""A scenario, run: in virtual time or paced, with the host inside the run or outside on a serial endpoint."""

import hashlib
import json
import math
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from libins import _run, faults
from libins.endpoint import Endpoint
from libins.errors import UsageError
from libins.program import Program
from libins.scenario import Expect, Scenario, Sinusoid

if TYPE_CHECKING:
    from libins.observe import Observation

PS_PER_S = 10**12
SLICE_S = 0.1
"""Virtual time between two looks at the results, unpaced."""
PACED_SLICE_S = 0.001
INSIDE = ("link.", "attitude.", "age_s.")
"""Values that need the navigator inside the run; with a host outside, expectations on them are not judged."""
BOUNDS = ("at_least", "at_most")
AXES = ("roll", "pitch", "yaw")
COLUMNS = {name: i for i, name in enumerate(_run.STATE_COLUMNS)}

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class Check:
    """One expectation of the scenario, as judged."""

    name: str
    failure: str | None
    judged: bool = True


@dataclass
class Result:
    """What came out of a run. `states` has the columns _run.STATE_COLUMNS, `scans` _run.SCAN_COLUMNS."""

    summary: dict[str, Any]
    states: Array
    scans: Array
    exit_code: int
    checks: list[Check] = field(default_factory=list)


@dataclass
class Options:
    """How to run, beside what the scenario says."""

    seed: int | None = None
    stop_s: float | None = None
    speed: float | None = None
    """Simulated seconds a wall second; None = as fast as it goes."""
    strict: bool = False
    endpoint: Endpoint | None = None
    publish: Callable[[bytes], None] | None = None
    trace: Callable[[Array], None] | None = None
    program: Program | None = None
    console: Callable[[bytes], None] | None = None
    """Takes what the program writes to its console."""
    watch: "Observation | None" = None
    """What looks at the firmware meanwhile."""
    progress: Callable[[float, Array], None] | None = None
    """Called with the simulated time and the new states."""


def motion_of(scenario: Scenario) -> Any:
    """The scenario's motion. Raises UsageError."""

    def sine(s: Sinusoid) -> list[float]:
        return [s.offset_rad, s.amplitude_rad, s.frequency_hz, s.phase_rad]

    motion = scenario.tables.motion
    try:
        if motion.kind == "csv":
            assert scenario.csv is not None
            t = scenario.csv[:, 0].tolist()
            yaw, pitch, roll = (column.tolist() for column in np.unwrap(scenario.csv[:, 1:], axis=0).T)
            return _run.motion_table(t, yaw, pitch, roll, motion.ramp_s)
        if motion.kind == "coning":
            return _run.motion_coning(motion.half_angle_rad, motion.frequency_hz, motion.ramp_s)
        if motion.kind == "sinusoids":
            return _run.motion_euler(sine(motion.yaw), sine(motion.pitch), sine(motion.roll), motion.ramp_s)
        rate = motion.rate_rad_s if motion.kind == "constant_rate" else [0.0, 0.0, 0.0]
        return _run.motion_rate(rate, motion.ramp_s)
    except ValueError as error:
        raise UsageError(f"{scenario.path}: motion: {error}") from error


def gyro_of(scenario: Scenario, seed: int) -> Any:
    """The scenario's gyros."""
    tables = scenario.tables.gyro
    gyro = _run.gyro_cg_l53() if tables.preset == "cg_l53" else _run.gyro_ideal()
    gyro.seed = seed
    for key in ("bandwidth_hz", "noise_rad_s_rthz"):
        if (value := getattr(tables, key)) is not None:
            gyro.set(key, [value] * 3)
    for key in ("bias_rad_s", "drift_rad_s2"):
        if (values := getattr(tables, key)) is not None:
            gyro.set(key, values)
    return gyro


def build(scenario: Scenario, seed: int, outside: bool, trace: bool, listen: bool = False, seen: bool = False) -> Any:
    """The run itself, at time 0. Raises UsageError."""
    tables = scenario.tables
    gyro = gyro_of(scenario, seed)
    config = _run.RunConfig()
    config.part = tables.part
    config.code_octets = tables.code_octets
    config.xdata_octets = tables.xdata_octets
    config.crystal_hz = tables.clock_hz
    config.seed = seed
    config.baud = tables.link.baud
    config.bit_error = tables.link.bit_error
    config.octet_loss = tables.link.octet_loss
    config.cuts_s = [(a, b) for a, b in tables.link.cuts_s]
    config.trace = trace
    config.listen = listen
    config.seen = seen
    config.six = tables.board == "8051_tlc2543_six"
    for place, signal in enumerate(tables.analog):
        t_s, volts = scenario.volts[place].T.tolist() if signal.csv else ([], [])
        wave = (signal.volts, signal.amplitude_v, signal.frequency_hz, signal.phase_rad)
        config.add_signal(signal.channel, wave, t_s, volts)
    for address, octets in scenario.image:
        config.add_segment(address, octets)
    if tables.nav is not None and not outside:
        n = tables.nav
        config.nav = _run.nav(n.period_s, n.block_len, n.sequence, n.form, n.rate_order, n.skew_s, gyro)
        config.start_at_truth = n.start == "truth"
    try:
        run = _run.Run(config, motion_of(scenario), gyro)
    except ValueError as error:
        raise UsageError(f"{scenario.path}: {error}") from error
    for place, fault in enumerate(tables.fault):
        try:
            run.add_fault(faults.built(fault, seed, place))
        except ValueError as error:
            raise UsageError(f"{scenario.path}: fault.{place}.{error}") from error
    return run


def execute(scenario: Scenario, options: Options) -> Result:
    """Run to the end and judge. Raises UsageError."""
    tables = scenario.tables
    seed = tables.seed if options.seed is None else options.seed
    stop_s = tables.stop_s if options.stop_s is None else options.stop_s
    if tables.motion.kind == "csv" and scenario.csv is not None and scenario.csv[-1, 0] < stop_s:
        raise UsageError(f"{scenario.path}: the motion ends at {scenario.csv[-1, 0]} s, before stop_s = {stop_s}")
    run = build(scenario, seed, options.endpoint is not None, trace=True, seen=options.watch is not None)
    if options.watch is not None:
        options.watch.begin(run)
    speed = options.speed if options.endpoint is None or options.speed is not None else 1.0
    digest = hashlib.sha256()
    blocks: list[Array] = []
    published = 0
    used = 0
    started = time.monotonic()
    stop_ps = round(stop_s * PS_PER_S)
    reached_samples = False
    pacer = Pacer(speed or 1.0)
    program = options.program
    if program is not None:
        program.start(run)
    end: str | None = None
    while run.now_ps < stop_ps and not reached_samples and end is None:
        if speed is None:
            run.until(min(stop_ps, run.now_ps + round(SLICE_S * PS_PER_S)))
        else:
            pacer.step(run, stop_ps, options.endpoint)
        if program is not None:
            end = program.ended(run)
            if options.console is not None:
                options.console(program.output(run))
        states, raw = run.take_states()
        edges = run.take_edges()
        digest.update(edges)
        if options.trace is not None:
            options.trace(edges)
        if options.watch is not None:
            options.watch.slice(run, edges)
        if options.publish is not None:
            for state in raw:
                options.publish(state)
                published += 1
        if len(states):
            blocks.append(states)
            used += len(states)
        if options.progress is not None:
            options.progress(run.now_ps / PS_PER_S, states)
        reached_samples = tables.stop_samples is not None and used >= tables.stop_samples
    wall_s = time.monotonic() - started
    states = np.concatenate(blocks) if blocks else np.empty((0, len(COLUMNS)))
    summary = {
        "scenario": scenario.path.name,
        **({"matrix": dict(scenario.combination)} if scenario.combination else {}),
        "firmware": scenario.firmware.name,
        "sim_s": run.now_ps / PS_PER_S,
        "wall_s": wall_s,
        "speed": run.now_ps / PS_PER_S / wall_s if wall_s > 0 else None,
        "seed": seed,
        **_measured(scenario, run, states, outside=options.endpoint is not None),
        **({"program": {"ended": end, "exit_code": program.exit_code(run)}} if program is not None else {}),
        "dds": {"published": published, "received": None} if options.publish is not None else None,
        "trace_sha256": digest.hexdigest(),
        "reports": run.reports(),
        **({"faults": faults.counted(run.fault_hits())} if tables.fault else {}),
        **(options.watch.end(run) if options.watch is not None else {}),
    }
    checks = [_judged(expect, summary) for expect in tables.expect]
    if tables.stop_samples is not None:
        few = f"stop_samples: {len(states)} of {tables.stop_samples} samples came in {stop_s} s simulated"
        checks.append(Check(f"stop_samples {tables.stop_samples}", None if reached_samples else few))
    failed = [check.failure for check in checks if check.failure]
    summary["not_judged"] = [e.value for e, check in zip(tables.expect, checks, strict=False) if not check.judged]
    summary["failed"] = failed
    code = 1 if failed else 0
    if program is not None and end is not None:
        code = program.exit_code(run) or code
    if (tables.stop_samples is not None and not reached_samples) or (program is not None and end is None):
        code = 42
    if options.strict and summary["reports"]:
        code = 3
    summary["verdict"] = "fail" if code else "pass"
    return Result(summary, states, run.scans(), code, checks)


class Pacer:
    """Keeps virtual time to the wall clock, never ahead of it, and never catching up.

    A machine that stalls stops the board's time as well, so that the host at the other end has the whole time-outs.
    """

    def __init__(self, speed: float) -> None:
        """Speed: simulated seconds a wall second."""
        self._speed = speed
        self._origin = time.monotonic()
        """The wall clock at which virtual time would have been 0."""

    def step(self, run: Any, stop_ps: int, endpoint: Endpoint | None) -> None:
        """Wait for the end of the next slice, run it, and exchange octets with the outside."""
        end_ps = min(stop_ps, run.now_ps + round(PACED_SLICE_S * self._speed * PS_PER_S))
        ahead_s = self._origin + end_ps / PS_PER_S / self._speed - time.monotonic()
        if ahead_s > 0:
            time.sleep(ahead_s)
        else:
            self._origin -= ahead_s
        if endpoint is not None and (octets := endpoint.read()):
            run.send(octets)
        run.until(end_ps)
        if endpoint is not None and (octets := run.take_octets()):
            endpoint.write(octets)


def _measured(scenario: Scenario, run: Any, states: Array, outside: bool) -> dict[str, Any]:
    """The part of the summary that is the same for the same scenario and seed."""
    c = run.counters()
    cpu = {key: c[key] for key in ("instructions", "cycles", "interrupts")}
    if scenario.tables.nav is None or outside:
        return {"cpu": cpu, "samples": c["sampled"], "link": None, "attitude": None, "age_s": None}
    first = int(states[0, COLUMNS["scan"]]) if len(states) else c["sampled"]
    last = int(states[-1, COLUMNS["scan"]]) if len(states) else first - 1
    link = {
        "sent": c["sampled"],
        "ok": c["accepted"],
        "retried": c["duplicates"] + c["corrupt"] + c["timeouts"],
        "lost": c["lost"],
        "corrupt_accepted": c["corrupt_accepted"],
        "before_first": first,
        "in_flight": c["sampled"] - 1 - last,
        **{
            key: c[key]
            for key in ("duplicates", "corrupt", "timeouts", "stray", "invalid", "framing_errors", "octets_received")
        },
        "bits_inverted": c["slots_inverted"],
        "octets_swallowed": c["octets_swallowed"],
    }
    return {"cpu": cpu, "samples": c["sampled"], "link": link, **accuracy(states)}


def accuracy(states: Array) -> dict[str, Any]:
    """The summary's `attitude` and `age_s`; None without states."""
    if not len(states):
        return {"attitude": None, "age_s": None}
    errors = {axis: states[:, COLUMNS[f"error_{axis}_rad"]].tolist() for axis in AXES}
    ages = states[:, COLUMNS["age_s"]].tolist()
    return {
        "attitude": {
            "rms_rad": {axis: math.sqrt(math.fsum(e * e for e in errors[axis]) / len(states)) for axis in AXES},
            "max_rad": {axis: max(map(abs, errors[axis])) for axis in AXES},
        },
        "age_s": {"min": min(ages), "mean": math.fsum(ages) / len(states), "max": max(ages)},
    }


def _judged(expect: Expect, summary: dict[str, Any]) -> Check:
    """An expectation against the summary; with the host outside, what needs the navigator is not judged."""
    bounds = [
        f"{word.replace('_', ' ')} {getattr(expect, word):g}" for word in BOUNDS if getattr(expect, word) is not None
    ]
    judged = summary["link"] is not None or not expect.value.startswith(INSIDE)
    return Check(f"{expect.value} {' and '.join(bounds)}", _failure(expect, summary) if judged else None, judged)


def _failure(expect: Expect, summary: dict[str, Any]) -> str | None:
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
