"""What a run drives: the acquisition board, or stations on lines, behind the same few calls."""

import math
from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from typing import Any, Protocol

import numpy as np

from libins import _run, faults, gyro_free, knobs, sixacc, sixacc_calibration
from libins.errors import UsageError
from libins.motions import motion_of
from libins.program import Program
from libins.scenario import Scenario
from libins.sensors import track_of
from libins.tables import Acquisition, Gyro, Nav

PS_PER_S = 10**12
AXES = ("roll", "pitch", "yaw")
COLUMNS = {name: i for i, name in enumerate(_run.STATE_COLUMNS)}

Array = np.ndarray[Any, Any]


class Machine(Protocol):
    """A run at some instant of virtual time."""

    wires: Sequence[str]
    """Of a trace, by index."""
    columns: Sequence[str]
    """Of the states."""
    scan_columns: Sequence[str]
    """Of the scans."""
    navigates: bool
    """Somebody in the run makes states of what the firmware sends."""

    @property
    def subject(self) -> Any:
        """What a Watch is given."""
        ...

    @property
    def now_ps(self) -> int:
        """Virtual time."""
        ...

    def until(self, t_ps: int) -> bool:
        """Run to an instant; False: something stopped it before, and running again goes on."""
        ...

    def take_states(self) -> tuple[Array, list[bytes]]:
        """New states: a row each, and as DDS publishes them."""
        ...

    def take_edges(self) -> Array:
        """New edges of all wires, in the order of time: instant [ps], index in `wires`, level."""
        ...

    def send(self, line: str, octets: bytes) -> None:
        """From the outside at a line's end."""
        ...

    def take_octets(self, line: str) -> bytes:
        """What a line's end has received since the last call."""
        ...

    def output(self) -> bytes:
        """What the program wrote to its console since the last call."""
        ...

    def ended(self) -> str | None:
        """How the firmware ended; None: it runs on."""
        ...

    def program(self) -> dict[str, Any] | None:
        """End and exit code of a firmware that is one to end."""
        ...

    def measured(self, states: Array) -> dict[str, Any]:
        """The part of the summary that is the same for the same scenario and seed."""
        ...

    def reports(self) -> list[dict[str, Any]]:
        """What the firmware did wrong, and what the emulator does not model."""
        ...

    def fault_hits(self) -> Sequence[tuple[str, int]]:
        """Kind of each fault, and how often it has acted."""
        ...

    def scans(self) -> Array:
        """Of an acquisition board."""
        ...

    def close(self) -> None:
        """Nothing of it is left running."""
        ...


def gyro_of(tables: Gyro, seed: int) -> Any:
    """The gyros of a board."""
    gyro = _run.gyro_cg_l53() if tables.preset == "cg_l53" else _run.gyro_ideal()
    gyro.seed = seed
    for key in ("bandwidth_hz", "noise_rad_s_rthz"):
        if (value := getattr(tables, key)) is not None:
            gyro.set(key, [value] * 3)
    for key in ("bias_rad_s", "drift_rad_s2"):
        if (values := getattr(tables, key)) is not None:
            gyro.set(key, values)
    return gyro


def config_of(
    tables: Acquisition,
    image: Iterable[tuple[int, bytes]],
    volts: Mapping[int, Array],
    six: bool,
    seed: int,
) -> Any:
    """What an acquisition board is made of; the line and the host are left as they are."""
    config = _run.RunConfig()
    config.part = tables.part
    config.code_octets = tables.code_octets
    config.xdata_octets = tables.xdata_octets
    config.crystal_hz = tables.clock_hz
    config.seed = seed
    if (stages := tables.front_end) is not None:
        config.set_front_end(stages.sensor_hz, stages.sensor_damping, stages.amplifier_hz, stages.slew_v_s, stages.rc_s)
    config.six = six
    for place, signal in enumerate(tables.analog):
        t_s, values = volts[place].T.tolist() if signal.csv else ([], [])
        wave = (signal.volts, signal.amplitude_v, signal.frequency_hz, signal.phase_rad)
        config.add_signal(signal.channel, wave, t_s, values)
    for address, octets in image:
        config.add_segment(address, octets)
    return config


def nav_of(nav: Nav, gyro: Any) -> Any:
    """A receiver and navigator."""
    skew_s = nav.skew_s[: len(AXES)]
    return _run.nav(nav.period_s, nav.block_len, nav.sequence, nav.form, nav.rate_order, skew_s, gyro)


def build(
    scenario: Scenario,
    seed: int,
    outside: bool,
    trace: bool,
    listen: bool = False,
    seen: bool = False,
    scans_kept: int = 0,
) -> Any:
    """The run itself, at time 0; scans_kept: of the newest, 0 of all. Raises UsageError."""
    tables = scenario.tables
    gyro = gyro_of(tables.gyro, seed)
    six = tables.board == "8051_tlc2543_six"
    config = config_of(tables, scenario.image, scenario.volts, six, seed)
    config.baud = tables.link.baud
    config.bit_error = tables.link.bit_error
    config.octet_loss = tables.link.octet_loss
    config.cuts_s = [(a, b) for a, b in tables.link.cuts_s]
    config.trace = trace
    config.listen = listen
    config.seen = seen
    config.scans_kept = scans_kept
    if tables.nav is not None and not outside:
        config.nav = nav_of(tables.nav, gyro)
        config.start_at_truth = tables.nav.start == "truth"
    try:
        if tables.sixacc is not None:
            accels = sixacc.accels_of(tables.sixacc, seed)
            config.set_accels(accels, track_of(scenario))
            if config.nav is not None:
                config.set_six_nav(gyro_free.nav_of(scenario, config.nav, accels, seed))
        run = _run.Run(config, motion_of(scenario), gyro)
    except ValueError as error:
        raise UsageError(f"{scenario.path}: {error}") from error
    for place, fault in enumerate(tables.fault):
        try:
            run.add_fault(faults.built(fault, seed, place))
        except ValueError as error:
            raise UsageError(f"{scenario.path}: fault.{place}.{error}") from error
    for turned in tables.knob:
        run.add_knob(knobs.built(turned))
    for sent in tables.send:
        run.add_knob(knobs.built(sent))
    return run


class AcquisitionMachine:
    """The acquisition board of a scenario; see Machine."""

    wires: Sequence[str] = _run.WIRES
    columns: Sequence[str] = _run.STATE_COLUMNS
    scan_columns: Sequence[str] = _run.SCAN_COLUMNS

    def __init__(
        self,
        scenario: Scenario,
        seed: int,
        outside: bool,
        trace: bool = True,
        seen: bool = False,
        program: Program | None = None,
    ) -> None:
        """At time 0. outside: nobody in the run plays the host. Raises UsageError."""
        self.run = build(scenario, seed, outside, trace=trace, seen=seen)
        if scenario.tables.sixacc is not None:
            self.scan_columns = _run.SIX_SCAN_COLUMNS
            self.columns = gyro_free.STATE_COLUMNS
        self._calibration = None
        if scenario.tables.calibration is not None:
            self._calibration = partial(sixacc_calibration.measured, scenario, seed, track_of(scenario))
        self.navigates = scenario.tables.nav is not None and not outside
        self._program = program
        self._end: str | None = None
        if program is not None:
            program.start(self.run)
        self.until, self.take_states, self.take_edges = self.run.until, self.run.take_states, self.run.take_edges
        self.reports, self.fault_hits, self.scans = self.run.reports, self.run.fault_hits, self.run.scans

    @property
    def subject(self) -> Any:
        """See Machine."""
        return self.run

    @property
    def now_ps(self) -> int:
        """See Machine."""
        return int(self.run.now_ps)

    def send(self, line: str, octets: bytes) -> None:
        """See Machine; what the transmitter has no room for is lost, as on a cable."""
        self.run.send(octets)

    def take_octets(self, line: str) -> bytes:
        """See Machine."""
        octets: bytes = self.run.take_octets()
        return octets

    def output(self) -> bytes:
        """See Machine."""
        return self._program.output(self.run) if self._program is not None else b""

    def ended(self) -> str | None:
        """See Machine."""
        if self._program is not None and self._end is None:
            self._end = self._program.ended(self.run)
        return self._end

    def program(self) -> dict[str, Any] | None:
        """See Machine."""
        if self._program is None:
            return None
        return {"ended": self.ended(), "exit_code": self._program.exit_code(self.run)}

    def measured(self, states: Array) -> dict[str, Any]:
        """See Machine."""
        c = self.run.counters()
        ran = {
            "cpu": {key: c[key] for key in ("instructions", "cycles", "interrupts")},
            "samples": c["sampled"],
        }
        if self._calibration is not None:
            ran["calibration"] = self._calibration(self.run)
        if not self.navigates:
            return {**ran, "link": None, "attitude": None, "age_s": None}
        six = gyro_free.solved(states) if self.columns is gyro_free.STATE_COLUMNS else {}
        return {**ran, "link": link_of(c, states), **accuracy(states), **six}

    def close(self) -> None:
        """See Machine."""


def link_of(c: Mapping[str, Any], states: Array) -> dict[str, Any]:
    """The summary's `link`, from the counters of an acquisition board and its navigator."""
    first = int(states[0, COLUMNS["scan"]]) if len(states) else c["sampled"]
    last = int(states[-1, COLUMNS["scan"]]) if len(states) else first - 1
    return {
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
