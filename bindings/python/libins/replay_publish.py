"""`ins replay --dds --ros`: what a filter made of a recorded drive, at the pace at which it was recorded.

States with their covariance, what fixes were beside them, a status each second, the IMU's samples. Instants are GNSS
time, as UTC; the publisher's clock is this computer's.
"""

import argparse
import contextlib
import heapq
import math
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from libins import dds_options
from libins.recording import Array
from libins.replay import CHECK, STATE, Drive, Run, increments
from libins.replay_config import Config

STATUS_S = 1.0
AIDED_S = 2.0
"""A fix that is older makes it dead reckoning."""
CLOCK = "gnss"
FIGURES = (
    ("position", ("dp_n_before", "dp_e_before", "dp_d_before"), ("sigma_n", "sigma_e", "sigma_d"), "nis_", "n e d", 7),
    (
        "velocity",
        ("dv_n_before", "dv_e_before", "dv_d_before"),
        ("sigma_vn", "sigma_ve", "sigma_vd"),
        "nis_v",
        "n e d",
        56,
    ),
)
"""Of a check: what was measured, filter less fix, its deviation, its NIS, its axes, its bits in `refused`."""


@dataclass
class Tally:
    """Of fixes, since the start."""

    used: int = 0
    position_refused: int = 0
    velocity_refused: int = 0
    last_s: float = -math.inf
    """When the last was used."""
    alert: bool = False
    """The last was refused."""


class Stream:
    """The messages of one run."""

    def __init__(self, outlets: "Outlets", config: Config, drive: Drive, run: Run, source: str) -> None:
        self.outlets, self.drive, self.run, self.source = outlets, drive, run, source
        self.offset_s = drive.epoch_s - config.leap_s
        self.tally = Tally()
        self.published = 0
        self.known = bool(run.covariances.any())
        # The run's states are in the mount's frame where there is one, the samples in the IMU's.
        self.motion: tuple[Array, Array, Array] | None = None
        if drive.imu is not None and config.filter == "gps_ins" and config.vehicle != "car":
            given = increments(drive.imu)
            period = given.period[:, None]
            self.motion = (given.t, given.theta / period, given.v / period)

    def _head(self, t: float) -> tuple[int, str]:
        return round((self.offset_s + t) * 1e9), CLOCK

    def _motion(self, t: float, state: list[float]) -> tuple[list[float] | None, list[float] | None]:
        """Rate and specific force, biases taken off."""
        if self.motion is None:
            return None, None
        times, rates, forces = self.motion
        at = max(int(np.searchsorted(times, t, side="right")) - 1, 0)
        gyro = np.array(state[STATE["bg_x_rad_s"] : STATE["bg_z_rad_s"] + 1])
        accel = np.array(state[STATE["ba_x_m_s2"] : STATE["ba_z_m_s2"] + 1])
        return (rates[at] - gyro).tolist(), (forces[at] - accel).tolist()

    def state(self, index: int) -> None:
        """One of the run's states, and each second a status."""
        from libins import _dds

        row = self.run.states[index].tolist()
        t = row[0]
        position = row[STATE["latitude_rad"] : STATE["height_m"] + 1]
        w_ib_b, f_b = self._motion(t, row)
        instant = _dds.Navigation(
            *self._head(t),
            q_nb=row[STATE["q_w"] : STATE["q_z"] + 1],
            v_n=row[STATE["v_n_m_s"] : STATE["v_d_m_s"] + 1],
            llh=position,
            P=self.run.covariances[index].tolist() if self.known else None,
            w_ib_b=w_ib_b,
            f_b=f_b,
        )
        self.published += 1
        if self.outlets.node is not None:
            self.outlets.node.publish_navigation(instant)
        if self.outlets.handle is None:
            return
        self.outlets.handle.publish_navigation(instant, index, t, self.source, time.time_ns())
        period = max(
            1, round(STATUS_S * (len(self.run.states) - 1) / max(self.run.states[-1, 0] - self.run.states[0, 0], 1e-9))
        )
        if index % period == 0:
            tally = self.tally
            age = t - tally.last_s
            self.outlets.handle.publish_status(
                instant, age <= AIDED_S, tally.alert, age if math.isfinite(age) else math.nan, tally.used,
                [tally.position_refused, tally.velocity_refused], self.published, self.source, time.time_ns(),
            )  # fmt: skip

    def check(self, index: int) -> None:
        """What one fix was beside the filter."""
        row = self.run.checks[index].tolist()
        refused, withheld = int(row[CHECK["refused"]]), row[CHECK["withheld"]] != 0.0
        tally = self.tally
        if not withheld:
            tally.position_refused += refused & 7 != 0
            tally.velocity_refused += refused & 56 != 0
            tally.alert = refused & 7 != 0
            if not tally.alert:
                tally.used += 1
                tally.last_s = row[0]
        if self.outlets.handle is None:
            return
        for kind, differences, deviations, nis, axes, bits in FIGURES:
            innovation = [-row[CHECK[name]] for name in differences]
            known = [k for k, value in enumerate(innovation) if math.isfinite(value)]
            if not known:
                continue
            parts = [row[CHECK[nis + axis]] for axis in axes.split()]
            verdict = "withheld" if withheld else "gate" if refused & bits else "used"
            self.outlets.handle.publish_innovations(
                *self._head(row[0]), kind, verdict, [innovation[k] for k in known],
                [row[CHECK[deviations[k]]] for k in known], sum(parts[k] for k in known), self.source, time.time_ns(),
            )  # fmt: skip

    def sample(self, index: int) -> None:
        """One of the IMU."""
        imu = self.drive.imu
        assert imu is not None
        t = float(imu.t[index])
        dt = t - float(imu.t[index - 1]) if index > 0 else math.nan
        self.outlets.handle.publish_raw_imu(
            *self._head(t), index, t, dt, imu.increments, imu.rate[index].tolist(), imu.force[index].tolist(),
            self.source, time.time_ns(),
        )  # fmt: skip


@dataclass(frozen=True)
class Outlets:
    """Where it goes."""

    handle: Any
    node: Any

    def publish(self, config: Config, drive: Drive, run: Run, source: str, speed: float) -> None:
        """The whole run, each message at its time: fixes before the state that they made."""
        if self.handle is None and self.node is None:
            return
        stream = Stream(self, config, drive, run, source)
        first, last = float(run.states[0, 0]), float(run.states[-1, 0])

        def within(times: Array, order: int) -> Iterator[tuple[float, int, int]]:
            for k in np.flatnonzero((times >= first) & (times <= last)).tolist():
                yield float(times[k]), order, k

        parts = [within(run.checks[:, 0], 1), within(run.states[:, 0], 2)]
        if self.handle is not None and drive.imu is not None:
            parts.append(within(drive.imu.t, 0))
        what = (stream.sample, stream.check, stream.state)
        begin = time.monotonic()
        for t, order, index in heapq.merge(*parts):
            wait = begin + (t - first) / speed - time.monotonic()
            if wait > 0.0:
                time.sleep(wait)
            what[order](index)
        print(f"dds       {stream.published} published", file=sys.stderr)


@contextlib.contextmanager
def outlets(args: argparse.Namespace) -> Iterator[Outlets]:
    """What --dds and --ros ask for. Raises UsageError."""
    with contextlib.ExitStack() as opened:

        def kept(outlet: Any) -> Any:
            return opened.enter_context(contextlib.closing(outlet))

        also = ("status", "innovations", "raw_imu")
        handle = kept(dds_options.open_dds(args, publishes=True, also=also)) if args.dds else None
        node = kept(dds_options.open_ros(args)) if args.ros is not None else None
        yield Outlets(handle, node)
