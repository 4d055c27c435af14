"""`ins replay --live`: a recorded drive as sentences on serial lines, at its own pace, for ins-gpsdr or the hardware.

Each 100 ms `$PINSD,<clock ms>,<odometer counts>,<yaw-rate code>`, each second GGA and RMC of the newest fix, as a
receiver and an odometer board would send them (docs/gpsdr_daemon.md). A second without a fix is GGA of quality 0.
"""

import argparse
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from functools import reduce
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from libins import recording_gnss, recording_imu, replay_config
from libins.endpoint import opened
from libins.errors import UsageError
from libins.recording import Findings

Array = np.ndarray[Any, np.dtype[np.float64]]
TICK_S = 0.1
FIX_TICKS = 10
HDOP_MAX = 99.0
KNOT_M_S = 1852.0 / 3600.0
SILENCE_S = 0.05
"""Between looks whether somebody is there."""
DRAIN_S = 1.0
"""What has been written is still to be read."""


class Fixes(Protocol):
    """Of recording.Gnss, what a receiver's sentences say."""

    @property
    def t(self) -> Array: ...  # noqa: D102
    @property
    def position(self) -> Array: ...  # noqa: D102
    @property
    def sigma_p(self) -> Array: ...  # noqa: D102
    @property
    def velocity(self) -> Array: ...  # noqa: D102
    @property
    def sigma_v(self) -> Array: ...  # noqa: D102
    @property
    def sats(self) -> Array: ...  # noqa: D102


class Wheels(Protocol):
    """Of recording.Wheels, what an odometer board senses."""

    @property
    def t(self) -> Array: ...  # noqa: D102
    @property
    def speed(self) -> Array: ...  # noqa: D102
    @property
    def yaw_rate(self) -> Array: ...  # noqa: D102


@dataclass(frozen=True)
class Board:
    """The odometer board, and the receiver's deviation per unit of HDOP: presets of ins-gpsdr, but for the counts."""

    metres_per_count: float = 0.04
    lsb_deg_s: float = 180.0 / 4096.0
    null_code: int = 2048
    code_max: int = 4095
    uere_m: float = 5.0

    def arguments(self) -> str:
        """What ins-gpsdr has to be told."""
        return f"--metres-per-count {self.metres_per_count:g}"


def sentence(body: str) -> bytes:
    """With $, checksum and line end."""
    return f"${body}*{reduce(lambda a, b: a ^ b, body.encode()):02X}\r\n".encode()


def _angle(rad: float, digits: int, positive: str, negative: str) -> str:
    minutes = round(abs(float(np.rad2deg(rad))) * 60e7)
    whole, rest = divmod(minutes, 600_000_000)
    return f"{whole:0{digits}d}{rest / 1e7:010.7f},{positive if rad >= 0 else negative}"


def _fix_sentences(utc: datetime, gnss: Fixes, i: int, board: Board) -> bytes:
    at = gnss.position[i]
    where = f"{_angle(at[0], 2, 'N', 'S')},{_angle(at[1], 3, 'E', 'W')}"
    clock = f"{utc:%H%M%S}.{utc.microsecond // 10000:02d}"
    level = float(np.sqrt(np.mean(gnss.sigma_p[i, :2] ** 2)))
    hdop = min(level / board.uere_m, HDOP_MAX) if level > 0 else 1.0
    gga = f"GPGGA,{clock},{where},1,{int(gnss.sats[i]):02d},{hdop:.2f},{at[2]:.2f},M,0.0,M,,"
    speed = course = ""
    if gnss.sigma_v[i, 0] > 0:
        v_n, v_e = gnss.velocity[i, :2]
        speed = f"{np.hypot(v_n, v_e) / KNOT_M_S:.3f}"
        course = f"{np.rad2deg(np.arctan2(v_e, v_n)) % 360:.2f}"
    return sentence(gga) + sentence(f"GPRMC,{clock},A,{where},{speed},{course},{utc:%d%m%y},,,A")


def _when(gnss: Fixes, withheld: Sequence[tuple[float, float]], begin: float, ticks: int) -> dict[int, int | None]:
    """The newest fix of each second, at the first tick that is not before it; None: the second has no fix."""
    held = np.zeros(len(gnss.t), bool)
    for first, last in withheld:
        held |= (gnss.t >= first) & (gnss.t < last)
    usable = np.flatnonzero(~held)
    told: dict[int, int | None] = {}
    for second in range(FIX_TICKS, ticks, FIX_TICKS):
        n = int(np.searchsorted(gnss.t[usable], begin + TICK_S * second + 1e-6, "right")) - 1
        tick = int(np.ceil((gnss.t[usable[n]] - begin) / TICK_S - 1e-6)) if n >= 0 else -1
        told |= {tick: int(usable[n])} if tick > second - FIX_TICKS else {second: None}
    return told


def sentences(
    gnss: Fixes, wheels: Wheels, withheld: Sequence[tuple[float, float]], board: Board, leap_s: float
) -> Iterator[tuple[float, str, bytes]]:
    """(time, "gps" or "board", octets) in order of time: what each line carries at each tick of 100 ms."""
    begin, end = float(wheels.t[0]), float(wheels.t[-1])
    ticks = begin + TICK_S * np.arange(1, int((end - begin) / TICK_S) + 1)
    fine = np.concatenate([[begin], ticks])
    way = np.concatenate([[0.0], np.cumsum(TICK_S * np.interp(ticks - TICK_S / 2, wheels.t, wheels.speed))])
    codes = np.interp(fine, wheels.t, np.rad2deg(wheels.yaw_rate)) / board.lsb_deg_s + board.null_code
    codes = np.clip(np.round(codes), 0, board.code_max)
    if not (np.isfinite(way).all() and np.isfinite(codes).all()):
        raise UsageError("--live: the recording has no speeds or no yaw rates over its whole length")
    told = _when(gnss, withheld, begin, len(fine))
    for k, t in enumerate(fine.tolist()):
        if k in told:
            i = told[k]
            utc = datetime(1970, 1, 1, tzinfo=UTC) + timedelta(seconds=(t if i is None else float(gnss.t[i])) - leap_s)
            none = sentence(f"GPGGA,{utc:%H%M%S}.{utc.microsecond // 10000:02d},,,,,0,00,,,M,,M,,")
            yield t, "gps", none if i is None else _fix_sentences(utc, gnss, i, board)
        counts = int(way[k] / board.metres_per_count)
        yield t, "board", sentence(f"PINSD,{round(1000 * TICK_S * k)},{counts},{int(codes[k])}")


def options(command: argparse.ArgumentParser) -> None:
    """Adds what `ins replay` takes for this."""
    command.add_argument(
        "--live",
        metavar="LINE",
        help="only send the drive as sentences, paced by --speed: pty[:LINK], tcp:PORT or file:PATH",
    )
    command.add_argument("--live-board", metavar="LINE", help="the odometer board's on a line of its own")


@dataclass(frozen=True)
class Drive:
    """What is sent; times of withheld spans as those of the recordings."""

    gnss: Fixes
    wheels: Wheels
    withheld: Sequence[tuple[float, float]]
    leap_s: float


def load(path: Path, overrides: Mapping[str, Any]) -> Drive:
    """Read and check. Raises UsageError."""
    config = replay_config.load(path, overrides)
    if config.wheels is None:
        raise UsageError(f"{path}: wheels: is missing; --live sends what an odometer board would: speed and yaw_rate")
    findings = Findings()
    gnss = recording_gnss.load(path.parent / config.gnss.file, config.gnss, config.leap_s, findings)
    wheels = recording_imu.load_wheels(path.parent / config.wheels.csv, config.wheels, config.leap_s, findings)
    for note in findings.notes:
        print(note, file=sys.stderr)
    begin = float(wheels.t[0])
    return Drive(gnss, wheels, [(begin + o.from_s, begin + o.to_s) for o in config.outage], config.leap_s)


def run(parsed: argparse.Namespace, drive: Drive) -> int:
    """Sends the whole drive once somebody has opened the lines. Returns the exit code. Raises UsageError."""
    if not parsed.speed > 0:
        raise UsageError(f"--speed {parsed.speed}: must be above 0; 1 is real time")
    board = Board()
    line = {"gps": opened(f"--live {parsed.live}", parsed.live)}
    line["board"] = line["gps"]
    if parsed.live_board is not None:
        line["board"] = opened(f"--live-board {parsed.live_board}", parsed.live_board)
    lines = list({id(x): x for x in line.values()}.values())
    try:
        labels = ", ".join(x.label for x in lines)
        print(f"live: {labels}; start ins gpsdr with {board.arguments()}", file=sys.stderr, flush=True)
        while not all(x.connected() for x in lines):
            time.sleep(SILENCE_S)
        begin = time.monotonic()
        first = float(drive.wheels.t[0])
        for t, to, octets in sentences(drive.gnss, drive.wheels, drive.withheld, board, drive.leap_s):
            delay = begin + (t - first) / parsed.speed - time.monotonic()
            if delay > 0:
                time.sleep(delay)
            line[to].write(octets)
        time.sleep(DRAIN_S)
    finally:
        for x in lines:
            x.close()
    return 0
