"""A recorded drive through a filter, with fixes withheld on a schedule, and how far off it was.

Times in tables are seconds since `Drive.epoch_s`, that on GPS's clock since 1970.
"""

import functools
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from libins import _post, alignment, mounting, recording_check, recording_gnss, recording_imu
from libins.alignment import Increments
from libins.errors import UsageError
from libins.recording import Array, Findings, Gnss, Imu, Wheels, choose, shifted
from libins.replay_config import Config, Outages

STATE = {name: n for n, name in enumerate(_post.STATE_COLUMNS)}
CHECK = {name: n for n, name in enumerate(_post.CHECK_COLUMNS)}
SEGMENT_GAP_S = 1.0
"""A longer gap of the IMU ends a segment: after it, alignment starts again."""
SEGMENT_MIN_S = 10.0
CHUNK_S = 5.0
"""Of a drive between two calls of `progress`."""
SIGMA_FLOOR_M = {1: (0.02, 0.02, 0.04), 2: (0.1, 0.1, 0.2)}
"""By quality, RTKLIB's: receivers take their errors for independent from fix to fix, which they are not."""
SIGMA_FLOOR_OTHER_M = (0.5, 0.5, 1.0)
SIGMA_VELOCITY_FLOOR_M_S = (0.05, 0.05, 0.1)
NHC_PERIOD_S = 0.1
NIS_COUNT_MIN = 40
MEMS = {
    "arw": 1.5e-4, "vrw": 2e-3, "bg_sigma": 1.5e-3, "bg_tau": 300.0, "ba_sigma": 0.1, "ba_tau": 300.0,
    "nhc": 0.3, "zupt": 0.02, "zaru": 1e-3, "refused_max": 8, "gap_max": SEGMENT_GAP_S,
}  # fmt: skip
"""0.5 deg/sqrt(h) and 0.12 m/s/sqrt(h): a usual MEMS part, with what its scale factors do to it while turning."""
Progress = Callable[[float], None]
"""Gets the share done, 0 .. 1."""


@dataclass(frozen=True)
class Drive:
    """What was recorded, checked, on one clock."""

    epoch_s: float
    imu: Imu | None
    gnss: Gnss
    wheels: Wheels | None
    reference: Gnss | None
    notes: tuple[str, ...]
    findings: Findings

    @property
    def span(self) -> tuple[float, float]:
        """What all recordings cover."""
        parts = [part.t for part in (self.imu, self.wheels, self.gnss) if part is not None]
        return max(t[0] for t in parts), min(t[-1] for t in parts)


@dataclass(frozen=True)
class Run:
    """One pass."""

    states: Array
    covariances: Array
    """Of the states, (N, 45): the upper triangle of attitude, velocity and position; 0: not known."""
    checks: Array
    smoothed: Array | None
    counts: dict[str, int]
    starts: tuple[str, ...]
    scales: tuple[str, ...] = ()


def read(config: Config, folder: Path) -> Drive:
    """All files of a configuration. Raises UsageError."""
    findings = Findings()
    notes: list[str] = []
    gnss = recording_gnss.load(folder / config.gnss.file, config.gnss, config.leap_s, findings)
    imu = wheels = reference = None
    if config.imu is not None:
        imu = recording_imu.load(folder / config.imu.csv, config.imu, config.leap_s, findings)
    if config.wheels is not None:
        wheels = recording_imu.load_wheels(folder / config.wheels.csv, config.wheels, config.leap_s, findings)
    for other in (imu, wheels):
        if other is not None:
            gnss = recording_check.rollover(gnss, other.t, findings)
            recording_check.overlap(gnss, other)
            if isinstance(other, Imu) or np.isfinite(other.yaw_rate).any():
                notes.append(recording_check.yaw_against_course(gnss, other))
    if config.reference is not None:
        reference = recording_gnss.load(folder / config.reference.file, config.reference, config.leap_s, findings)
    epoch = float(np.floor(min(part.t[0] for part in (gnss, imu, wheels) if part is not None)))
    return Drive(
        epoch,
        None if imu is None else shifted(imu, -epoch),
        weighted(shifted(gnss, -epoch), config),
        None if wheels is None else shifted(wheels, -epoch),
        None if reference is None else shifted(reference, -epoch),
        tuple(notes),
        findings,
    )


def weighted(gnss: Gnss, config: Config) -> Gnss:
    """With standard deviations that a filter can believe."""
    given = config.gnss
    if given.sigma_floor_m is not None:
        floor = np.tile(given.sigma_floor_m, (len(gnss.t), 1))
    else:
        floor = np.array([SIGMA_FLOOR_M.get(int(q), SIGMA_FLOOR_OTHER_M) for q in gnss.quality])
    floor_v = np.array(given.sigma_velocity_floor_m_s or SIGMA_VELOCITY_FLOOR_M_S)
    known = (gnss.sigma_v > 0.0) & given.use_velocity
    return replace(
        gnss,
        sigma_p=np.maximum(gnss.sigma_p, floor) * given.sigma_scale,
        sigma_v=np.where(known, np.maximum(gnss.sigma_v, floor_v) * given.sigma_scale, 0.0),
    )


def increments(imu: Imu) -> Increments:
    """Of rates, by trapezoids; across a gap those of one usual period: the filter sees by the time what is missing."""
    period = np.diff(imu.t)
    usual = float(np.median(period))
    period = np.where(period > recording_imu.GAP_PERIODS * usual, usual, period)
    if imu.increments:
        return Increments(imu.t[1:], period, imu.rate[1:], imu.force[1:])
    theta = 0.5 * (imu.rate[1:] + imu.rate[:-1]) * period[:, None]
    return Increments(imu.t[1:], period, theta, 0.5 * (imu.force[1:] + imu.force[:-1]) * period[:, None])


def part_of(given: Increments, which: Any) -> Increments:
    """Some of its rows."""
    return Increments(given.t[which], given.period[which], given.theta[which], given.v[which])


def turned(given: Increments, c: Array) -> Increments:
    """In another body frame: v' = C v."""
    return Increments(given.t, given.period, given.theta @ c.T, given.v @ c.T)


def windows(config: Config, drive: Drive, shift_s: float = 0.0) -> list[tuple[float, float]]:
    """When fixes are withheld; of the schedule, whole ones within the drive only."""
    first, last = drive.span
    found = [(first + outage.from_s, first + outage.to_s) for outage in config.outage]
    if (plan := config.outages) is not None:
        start = first + (plan.period_s if plan.start_s is None else plan.start_s) + shift_s
        while start + plan.length_s <= last:
            found.append((start, start + plan.length_s))
            start += plan.period_s
    return sorted(found)


def phases(plan: Outages | None) -> Sequence[float]:
    """Shifts of the schedule: each is a pass of its own, and the table pools them."""
    return [0.0] if plan is None else [k * plan.period_s / plan.phases for k in range(plan.phases)]


def within(t: Array, spans: Sequence[tuple[float, float]]) -> Array:
    """Which times lie in one of them."""
    mask = np.zeros(len(t), bool)
    for begin, end in spans:
        mask |= (t >= begin) & (t < end)
    return mask


def fix_rows(drive: Drive, spans: Sequence[tuple[float, float]], ticks: Array, late_s: float) -> Array:
    """Fixes as events, known at the first tick at or after them; of a reference, its own withheld points as well.

    late_s: velocities are that much older than the places they come with.
    """
    gnss = drive.gnss
    withheld = within(gnss.t, spans)
    parts = [(gnss, withheld)]
    if (reference := drive.reference) is not None:
        parts = [(choose(gnss, ~withheld), withheld[~withheld]), (reference, np.ones(len(reference.t), bool))]
    tables = []
    for part, mask in parts:
        known = np.searchsorted(ticks, part.t)
        inside = known < len(ticks)
        kept = choose(part, inside)
        tables.append(
            np.column_stack(
                [
                    ticks[known[inside]],
                    kept.t,
                    kept.t - late_s,
                    kept.position,
                    kept.sigma_p,
                    kept.velocity,
                    kept.sigma_v,
                    kept.hdop,
                    kept.sats,
                    mask[inside],
                ]
            )  # fmt: skip
        )
    merged = np.vstack(tables)
    return np.ascontiguousarray(merged[np.lexsort((merged[:, 1], merged[:, 0]))])


def velocity_late(config: Config, usable: Gnss) -> tuple[float, str]:
    """As configured, or as the fixes say."""
    if config.gnss.velocity_late_s is not None:
        return config.gnss.velocity_late_s, ""
    return recording_check.velocity_late(usable)


def late_taken(gnss: Gnss, late_s: float) -> Gnss:
    """With velocities of the instants of the places."""
    at = np.column_stack([np.interp(gnss.t, gnss.t - late_s, gnss.velocity[:, axis]) for axis in range(3)])
    return replace(gnss, velocity=at)


def wheel_rows(wheels: Wheels | None) -> Array:
    """As events."""
    if wheels is None:
        return np.zeros((0, len(_post.WHEEL_COLUMNS)))
    period = np.diff(wheels.t, prepend=2 * wheels.t[0] - wheels.t[1])
    return np.ascontiguousarray(np.column_stack([wheels.t, period, wheels.speed, wheels.yaw_rate]))


def noise_settings(config: Config, drive: Drive, given: Increments) -> tuple[dict[str, Any], list[str]]:
    """As configured, else as measured at rest where that is more than a usual part has, else a usual part's."""
    settings: dict[str, Any] = dict(MEMS)
    notes: list[str] = []
    resting = alignment.still(given, drive.gnss)
    if resting.sum() * np.median(given.period) > 2.0:
        for name, values in (("arw", given.theta), ("vrw", given.v)):
            density = float(
                np.median(np.std(np.diff(values[resting], axis=0), axis=0)) / np.sqrt(2 * np.median(given.period))
            )
            settings[name] = max(settings[name], density)
            notes.append(f"{name} at rest {density:.2e}, used {settings[name]:.2e}")
    names = {
        "arw_rad_rts": "arw", "vrw_m_s_rts": "vrw", "bias_g_rad_s": "bg_sigma", "bias_a_m_s2": "ba_sigma",
        "tau_g_s": "bg_tau", "tau_a_s": "ba_tau",
    }  # fmt: skip
    settings |= {"scale_g": config.noise.scale_g, "scale_a": config.noise.scale_a}
    settings |= {to: value for of, to in names.items() if (value := getattr(config.noise, of)) is not None}
    period = float(np.median(given.period))
    settings |= {
        "antenna_b": config.gnss.lever_arm_m,
        "still_samples": max(2, round(0.5 / period)),
        "still_rate_sigma": alignment.STILL_RATE,
        "still_force_sigma": alignment.STILL_FORCE,
        "still_rate_mean": alignment.STILL_MEAN,
        "stuck": max(2, round(recording_imu.STUCK_S / period)),
    }
    if config.wheels is not None:
        settings["wheel_b"] = config.wheels.lever_arm_m
    return settings, notes


def one_pass(
    config: Config, drive: Drive, given: Increments, settings: dict[str, Any], spans: Sequence[tuple[float, float]],
    nhc: bool, smooth: bool, progress: Progress,
) -> Run:  # fmt: skip
    """All segments of the IMU's recording. Raises UsageError when none of them can be aligned."""
    edges = np.flatnonzero(np.diff(given.t) > SEGMENT_GAP_S) + 1
    bounds = [0, *edges.tolist(), len(given.t)]
    usable = choose(drive.gnss, ~within(drive.gnss.t, spans))
    late_s, _ = velocity_late(config, usable)
    parts: list[Run] = []
    problem: UsageError | None = None
    for begin, end in zip(bounds[:-1], bounds[1:], strict=True):
        piece = part_of(given, slice(begin, end))
        if len(piece.t) < 2 or piece.t[-1] - piece.t[0] < SEGMENT_MIN_S:
            continue
        try:
            start = alignment.align(
                piece, late_taken(usable, late_s), config.vehicle == "car", np.array(config.gnss.lever_arm_m)
            )
        except UsageError as error:
            problem = error
            continue
        node_s = 1.0 / config.output.rate_hz if smooth else 0.0
        filter_ = _post.GpsIns(
            settings, start.t, start.q_nb.tolist(), start.v_n.tolist(), start.position.tolist(),
            start.gyro_bias.tolist(), start.sigma.tolist(), nhc_period_s=NHC_PERIOD_S if nhc else 0.0,
            node_period_s=node_s,
        )  # fmt: skip
        rows = np.ascontiguousarray(np.column_stack([piece.t, piece.period, piece.theta, piece.v]))
        fixes = fix_rows(drive, spans, piece.t, late_s)
        replay = _post.Replay(filter_, rows, wheel_rows(drive.wheels), fixes, 1.0 / config.output.rate_hz)
        while not replay.done:
            replay.run(replay.time_s + CHUNK_S)
            progress(min(1.0, (replay.time_s - given.t[0]) / (given.t[-1] - given.t[0])))
        how = f"{start.t:.2f} s: {start.how}"
        smoothed = filter_.smooth() if smooth else None
        told = scale_notes(filter_)
        parts.append(Run(replay.states, replay.covariances, replay.checks, smoothed, filter_.counts(), (how,), told))
    if not parts:
        raise problem or UsageError(f"{drive.gnss.path}: no {SEGMENT_MIN_S:g} s of the IMU without a gap")
    counts: dict[str, int] = {}
    for part in parts:
        for what, count in part.counts.items():
            counts[what] = counts.get(what, 0) + count
    return Run(
        np.vstack([part.states for part in parts]),
        np.vstack([part.covariances for part in parts]),
        np.vstack([part.checks for part in parts]),
        np.vstack([part.smoothed for part in parts if part.smoothed is not None]) if smooth else None,
        counts,
        tuple(how for part in parts for how in part.starts),
        tuple(note for part in parts for note in part.scales),
    )


def scale_notes(filter_: Any) -> tuple[str, ...]:
    """The scale factors at the end, and how sure, if there are any."""
    found = filter_.scales()
    if found is None:
        return ()
    parts = (("gyros", found[0], found[2]), ("accelerometers", found[1], found[3]))

    def percent(values: Sequence[float], form: str) -> str:
        return ", ".join(format(100.0 * value, form) for value in values) + " %"

    return tuple(
        f"{name} read {percent(much, '+.3f')} too much, to {percent(to, '.3f')}" for name, much, to in parts if any(to)
    )


def mounted(states: Array, spans: Sequence[tuple[float, float]]) -> tuple[mounting.Mount | None, str]:
    """How the IMU sits in a car, by what it did while aided."""
    t = states[:, STATE["t_s"]]
    v_n = states[:, STATE["v_n_m_s"] : STATE["v_d_m_s"] + 1]
    return mounting.find(t, v_n, states[:, STATE["q_w"] : STATE["q_z"] + 1], ~within(t, spans), 1.0 / NHC_PERIOD_S)


def scales(checks: Array) -> tuple[float, float]:
    """By what factors positions and velocities are worse than they say, at least 1: from the NIS of used fixes."""
    out = []
    for names in (("nis_n", "nis_e", "nis_d"), ("nis_vn", "nis_ve", "nis_vd")):
        nis = checks[:, [CHECK[name] for name in names]]
        used = nis[np.isfinite(nis)]
        out.append(max(1.0, float(np.sqrt(np.median(used) / CHI2_MEDIAN))) if len(used) > NIS_COUNT_MIN else 1.0)
    return out[0], out[1]


CHI2_MEDIAN = 0.4549364
"""Of one degree of freedom: a median is not moved by what the gate is for."""


@dataclass(frozen=True)
class Solution:
    """The last pass of each phase, and what the passes before it found."""

    runs: tuple[Run, ...]
    spans: tuple[tuple[tuple[float, float], ...], ...]
    settings: dict[str, Any]
    notes: tuple[str, ...]


def solve(config: Config, drive: Drive, progress: Progress) -> Solution:
    """Two passes for each phase: the first, as blind as the second, shows how good fixes are and how the IMU sits."""
    assert drive.imu is not None
    given = increments(drive.imu)
    settings, notes = noise_settings(config, drive, given)
    runs: list[Run] = []
    spans_of: list[tuple[tuple[float, float], ...]] = []
    shifts = phases(config.outages)
    for k, shift_s in enumerate(shifts):
        spans = windows(config, drive, shift_s)

        def done(share: float, base: float = 2.0 * k) -> None:
            progress((base + share) / (2.0 * len(shifts)))

        first = one_pass(config, drive, given, settings, spans, False, False, done)
        place, velocity = scales(first.checks)
        mount, told = mounted(first.states, spans) if config.vehicle == "car" else (None, "")
        second = settings
        seen = given
        if mount is not None:
            seen = turned(given, mount.c)
            second = settings | {
                "nhc": mount.sigma,
                "wheel_b": [-mount.wheel_m, 0.0, 0.0],
                "antenna_b": (mount.c @ np.array(config.gnss.lever_arm_m)).tolist(),
            }
        gnss = replace(drive.gnss, sigma_p=drive.gnss.sigma_p * place, sigma_v=drive.gnss.sigma_v * velocity)
        runs.append(
            one_pass(
                config,
                replace(drive, gnss=gnss),
                seen,
                second,
                spans,
                mount is not None,
                config.smooth and k == 0,
                functools.partial(done, base=2.0 * k + 1.0),
            )
        )
        spans_of.append(tuple(spans))
        if k == 0:
            notes += runs[0].scales
            _, late = velocity_late(config, choose(drive.gnss, ~within(drive.gnss.t, spans)))
            notes += [text for text in (late, told) if text]
            if max(place, velocity) > 1.0:
                notes.append(f"places are {place:.2f}, velocities {velocity:.2f} times worse than they say: taken so")
    return Solution(tuple(runs), tuple(spans_of), settings, tuple(notes))
