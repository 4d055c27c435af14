"""The `ins sim` command's grammar, progress bar and files."""

import argparse
import sys
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

from libins import scenario, sim
from libins.errors import UsageError
from libins.growing_file import GrowingFile


def options(command: argparse.ArgumentParser) -> None:
    """Adds the grammar of `ins sim`."""
    command.add_argument(
        "file", type=Path, help="a TOML file: where it goes, what its sensors are like (docs/truth.md)"
    )
    command.add_argument("--imu", type=Path, metavar="F.csv", help="write the IMU's increments there")
    command.add_argument("--truth", type=Path, metavar="F.csv", help="position, velocity, attitude, rates, biases")
    command.add_argument("--gps", type=Path, metavar="F.csv", help="the receiver's fixes")
    command.add_argument("--events", type=Path, metavar="F.csv", help="when each [[event]] happened")
    command.add_argument("--seed", type=int, metavar="N", help="another seed than the file's")
    command.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="another value for a key")


def _write(file: GrowingFile | None, rows: np.ndarray) -> None:
    if file is not None:
        np.savetxt(file.text, rows, fmt="%.17g", delimiter=",")


def run(parsed: argparse.Namespace) -> int:
    """Returns the exit code. Raises UsageError."""
    wanted = {
        "imu": (parsed.imu, sim.IMU_COLUMNS),
        "truth": (parsed.truth, sim.TRUTH_COLUMNS),
        "gps": (parsed.gps, sim.GPS_COLUMNS),
        "events": (parsed.events, sim.EVENT_COLUMNS),
    }
    if all(path is None for path, _ in wanted.values()):
        raise UsageError("ins sim: nothing to write; give one of --imu, --truth, --gps, --events")
    settings = dict(map(scenario.setting, parsed.set))
    if parsed.seed is not None:
        settings["seed"] = parsed.seed
    made = sim.Sim(parsed.file, settings)
    files: dict[str, GrowingFile] = {}
    console = Console(stderr=True)
    try:
        for name, (path, columns) in wanted.items():
            if path is not None:
                files[name] = GrowingFile(path)
                print(",".join(columns), file=files[name].text)
        with Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            TextColumn("{task.completed:.0f} of {task.total:.0f} samples"),
            TimeRemainingColumn(),
            console=console,
            disable=not console.is_terminal,
            transient=True,
        ) as progress:
            task = progress.add_task(parsed.file.stem, total=made.samples)
            for imu, truth in made.imu() if "imu" in files or "truth" in files else ():
                _write(files.get("imu"), imu)
                _write(files.get("truth"), truth)
                progress.advance(task, len(imu))
        fixes = made.fixes()
        _write(files.get("gps"), fixes)
        _write(files.get("events"), np.array(made.happenings).reshape(-1, 3))
        for file in files.values():
            file.done()
    finally:
        for file in files.values():
            file.drop()
    print(
        f"{made.duration_s:g} s, {made.samples} IMU samples, {len(fixes)} fixes, {len(made.happenings)} events, "
        f"{made.errors.saturated} components clipped, seed {made.tables.seed}",
        file=sys.stderr,
    )
    return 0
