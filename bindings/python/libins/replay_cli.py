"""The command `ins replay`: a recorded drive through a filter, and what came of it as files."""

import argparse
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

from libins import replay_live, replay_publish
from libins.errors import UsageError
from libins.schema import Document
from libins.whole_file import write

FILES = ("csv", "kml", "geojson", "html", "json")


def options(parser: argparse.ArgumentParser) -> None:
    """The command's grammar."""
    parser.add_argument("config", type=Path, metavar="CONFIG.toml", help="docs/replay.md lists its keys")
    parser.add_argument(
        "--set", action="append", default=[], metavar="KEY=VALUE",
        help="another value for a key of the configuration, for example outages.length_s=30",
    )  # fmt: skip
    parser.add_argument("--smooth", action="store_true", help="run the fixed-interval smoother as well")
    helps = {
        "csv": "write the solution: time, position, velocity, attitude, biases, standard deviations",
        "kml": "write the path for a globe",
        "geojson": "write the path for a map",
        "html": "write a report with map, errors, outages and innovations",
        "json": "write the summary ('-': standard output)",
    }
    for name, text in helps.items():
        parser.add_argument(f"--{name}", type=Path, metavar=f"F.{name}", help=text)
    parser.add_argument(
        "--dds", action="store_true", help="publish states, innovations, status and raw IMU samples, paced by --speed"
    )
    parser.add_argument(
        "--ros", nargs="?", const="/", metavar="NAMESPACE",
        help="publish the states as ROS 2 topics, on ROS_DOMAIN_ID, else on --domain",
    )  # fmt: skip
    parser.add_argument(
        "--speed", type=float, default=1.0, metavar="X",
        help="with --dds, --ros and --live: recorded seconds a second (1)",
    )  # fmt: skip
    replay_live.options(parser)


def run(args: argparse.Namespace) -> int:
    """Exit code 0; raises UsageError."""
    from libins import replay, replay_config, replay_files, replay_reckoning, replay_score, scenario

    overrides = dict(map(scenario.setting, args.set))
    if args.live is not None:
        return replay_live.run(args, replay_live.load(args.config, overrides))
    config = replay_config.load(args.config, overrides | ({"smooth": True} if args.smooth else {}))
    places = {name: _place(args, config, name) for name in FILES}
    if places["html"] is not None:
        page = _page()
    if not args.speed > 0.0:
        raise UsageError(f"--speed {args.speed}: a number above 0 is needed")
    with replay_publish.outlets(args) as outlets:
        drive = replay.read(config, args.config.parent)
        with Progress(
            TextColumn("{task.description}"), BarColumn(), TextColumn("{task.percentage:3.0f} %"),
            TimeRemainingColumn(), console=Console(stderr=True), transient=True,
        ) as bar:  # fmt: skip
            task = bar.add_task(args.config.stem, total=1.0)
            solve = replay.solve if config.filter == "gps_ins" else replay_reckoning.solve
            solution = solve(config, drive, lambda share: bar.update(task, completed=share))
        result = replay_score.summary(config, drive, solution)
        states = solution.runs[0].states if solution.runs[0].smoothed is None else solution.runs[0].smoothed
        hidden = replay.within(states[:, 0], solution.spans[0])
        makers: dict[str, Callable[[], str]] = {
            "csv": lambda: replay_files.csv(states, drive.epoch_s, hidden),
            "kml": lambda: replay_files.kml(states, hidden, args.config.stem),
            "geojson": lambda: replay_files.geojson(states, hidden, {"name": args.config.stem}),
            "html": lambda: page.html(args.config.stem, Document(args.config).text, result, drive, solution),
            "json": lambda: json.dumps(result, indent=2) + "\n",
        }
        for name, path in places.items():
            if path is not None:
                write(path, makers[name]())
        if str(places["json"]) != "-":
            print(replay_score.text(result))
        outlets.publish(config, drive, solution.runs[0], args.config.stem, args.speed)
    return 0


def _place(args: argparse.Namespace, config: Any, name: str) -> Path | None:
    """The option's, or that of the configuration, which lies beside it."""
    given: Path | None = getattr(args, name)
    configured = getattr(config.output, name)
    return given if given is not None or configured is None else args.config.parent / configured


def _page() -> Any:
    """Missing before the replay rather than after it."""
    try:
        from libins import replay_page
    except ImportError as error:
        raise UsageError(f"--html needs {error.name}: pip install 'libins[report]'") from error
    return replay_page
