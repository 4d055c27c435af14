"""The `ins view` command: a board, or a recording, as a page in the browser."""

import argparse
import threading
import webbrowser
import zipfile
from pathlib import Path

from libins import scenario
from libins.debugger import open_scenario
from libins.errors import UsageError
from libins.net_scenario import NetScenario
from libins.view_board import BoardEngine
from libins.view_net import NetEngine
from libins.view_recording import SUFFIXES, RecordingEngine
from libins.view_session import SPEED_MAX, SPEED_MIN, Engine


def options(command: argparse.ArgumentParser) -> None:
    """Adds the grammar of `ins view`."""
    command.add_argument(
        "scenario",
        nargs="?",
        default="default",
        help="a TOML file, the name of one that comes with the package (default), an image alone (F.ihx), a "
        "snapshot, or a recording: F.mcap of ins record, F.csv of ins replay",
    )
    command.add_argument("--firmware", type=Path, metavar="F.ihx", help="another image than the scenario's")
    command.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="as in ins run")
    command.add_argument("--source", type=Path, action="append", default=[], metavar="DIR", help="where C files are")
    command.add_argument("--no-navigator", action="store_true", help="nobody answers the board but the page")
    command.add_argument("--port", type=int, default=0, metavar="N", help="on 127.0.0.1; 0, the default: a free one")
    command.add_argument("--no-browser", action="store_true", help="print the address, and open nothing")
    command.add_argument(
        "--speed", default="1", metavar="max|X", help="simulated seconds a wall second; the page can change it"
    )


def run(parsed: argparse.Namespace) -> int:
    """Returns the exit code. Raises UsageError."""
    try:
        from libins.view_server import Server
    except ImportError as error:
        raise UsageError(f"ins view needs {error.name}: pip install 'libins[view]'") from error
    speed = _speed(parsed.speed)
    server = Server(_engine(parsed), parsed.port, speed)

    def started() -> None:
        print(server.url, flush=True)
        if not parsed.no_browser:
            threading.Thread(target=webbrowser.open, args=(server.url,), daemon=True).start()

    server.serve(started)
    return 0


def _engine(parsed: argparse.Namespace) -> Engine:
    if Path(parsed.scenario).suffix in SUFFIXES:
        return RecordingEngine(Path(parsed.scenario))
    settings = dict(map(scenario.setting, parsed.set))
    if not zipfile.is_zipfile(parsed.scenario):
        loaded = scenario.load(scenario.find(parsed.scenario), parsed.firmware, settings)
        if isinstance(loaded, NetScenario):
            return NetEngine(loaded)
    debugger = open_scenario(parsed.scenario, parsed.firmware, settings, not parsed.no_navigator, seen=True)
    return BoardEngine(debugger, parsed.source)


def _speed(text: str) -> float | None:
    """None: max. Raises UsageError."""
    if text == "max":
        return None
    try:
        speed = float(text)
    except ValueError:
        speed = 0.0
    if not SPEED_MIN <= speed <= SPEED_MAX:
        raise UsageError(f"--speed {text}: 'max' or a number of {SPEED_MIN:g} .. {SPEED_MAX:g} is needed")
    return speed
