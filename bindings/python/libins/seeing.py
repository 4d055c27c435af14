"""What `ins run` offers to look at firmware: the command line's part of it."""

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from libins.errors import UsageError
from libins.net_scenario import NetScenario
from libins.scenario import Scenario
from libins.tables import Loaded

if TYPE_CHECKING:
    from libins.run import Watch

ANALOG_US = 1000.0
OF_8051 = ("itrace", "lcov", "profile", "cdb")
"""Options that look at 8051 code."""


def add_options(command: argparse.ArgumentParser) -> None:
    """To `ins run`."""
    group = command.add_argument_group("looking at the firmware", "docs/seeing.md; * needs SDCC's .cdb or .rst")
    group.add_argument("--vcd", type=Path, metavar="F", help="write pins, nets, volts, octets and interrupts (GTKWave)")
    group.add_argument(
        "--vcd-sfr",
        action="append",
        default=[],
        metavar="NAME",
        help="with --vcd: a register, e.g. TCON; of an F2812 SCIFFRXA, as the firmware reads and writes it",
    )
    group.add_argument(
        "--access-log", type=Path, metavar="F.jsonl", help="write every register access and interrupt of an F2812"
    )
    group.add_argument(
        "--vcd-analog-us",
        type=float,
        default=ANALOG_US,
        metavar="US",
        help=f"with --vcd: grid of the volts ({ANALOG_US:g})",
    )
    group.add_argument("--itrace", type=Path, metavar="F", help="write every instruction and the registers it changed")
    group.add_argument("--profile", type=Path, metavar="F", help="*write where the cycles went ('-': standard output)")
    group.add_argument("--lcov", type=Path, metavar="F.info", help="*write line and branch coverage for genhtml")
    group.add_argument("--cdb", type=Path, metavar="F.cdb", help="the .cdb or .rst, if it is not beside the image")
    group.add_argument(
        "--report-at", type=float, metavar="S", help="with --report: instant of its pictures (the middle of the run)"
    )
    group.add_argument(
        "--source", type=Path, action="append", default=[], metavar="DIR", help="where the firmware's C files are"
    )


def observation(loaded: Loaded, options: argparse.Namespace, place: Callable[[Path], Path]) -> "Watch | None":
    """What was asked for, or None; `place` gives a file its name in this run. Raises UsageError."""
    stop_s = loaded.tables.stop_s
    if options.report_at is not None and not 0 <= options.report_at <= stop_s:
        raise UsageError(f"--report-at {options.report_at:g}: must lie in 0 .. {stop_s:g}, the simulated seconds")
    view_s = (stop_s / 2 if options.report_at is None else options.report_at) if options.report else None

    def placed(path: Path | None) -> Path | None:
        return None if path is None else place(path)

    if isinstance(loaded, NetScenario):
        return _of_net(options, placed, view_s)
    if options.access_log is not None:
        raise UsageError("--access-log: needs a board with an F2812; of the 8051 --itrace shows every instruction")
    if not (options.vcd or options.itrace or options.lcov or options.profile or options.report):
        return None
    from libins import observe  # pyvcd only where it is needed

    assert isinstance(loaded, Scenario)
    wanted = observe.Wanted(
        vcd=placed(options.vcd),
        sfrs=options.vcd_sfr,
        analog_us=options.vcd_analog_us,
        itrace=placed(options.itrace),
        lcov=placed(options.lcov),
        profile=options.profile is not None,
        cdb=options.cdb,
        source=options.source,
        view_s=view_s,
    )
    return observe.Observation(loaded, wanted)


def _of_net(
    options: argparse.Namespace, placed: Callable[[Path | None], Path | None], view_s: float | None
) -> "Watch | None":
    for name in OF_8051:
        if getattr(options, name):
            raise UsageError(f"--{name}: reads 8051 code; firmware for the F2812 is compiled for this machine")
    if not (options.vcd or options.access_log or options.report):
        return None
    from libins import net_observe

    wanted = net_observe.Wanted(placed(options.vcd), options.vcd_sfr, placed(options.access_log), view_s)
    return net_observe.Observation(wanted)
