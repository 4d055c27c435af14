"""The `ins debug` command: a terminal, a script, or a Debug Adapter Protocol server."""

import argparse
import signal
import sys
from pathlib import Path

from libins import scenario
from libins.debugger import open_scenario
from libins.errors import UsageError
from libins.terminal import Terminal


def options(command: argparse.ArgumentParser) -> None:
    """Adds the grammar of `ins debug`."""
    command.add_argument(
        "scenario",
        nargs="?",
        help="a TOML file, the name of one that comes with the package, an image alone (F.ihx), or a snapshot",
    )
    command.add_argument("--firmware", type=Path, metavar="F.ihx", help="another image than the scenario's")
    command.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="as in ins run")
    command.add_argument("--source", type=Path, action="append", default=[], metavar="DIR", help="where C files are")
    command.add_argument("--no-navigator", action="store_true", help="nobody answers the board but `send`")
    command.add_argument("-x", dest="script", type=Path, metavar="FILE", help="commands, up to the first that fails")
    command.add_argument("--dap", action="store_true", help="Debug Adapter Protocol on standard input and output")
    command.add_argument("--dap-port", type=int, metavar="N", help="the same for one client on this port of 127.0.0.1")


def run(parsed: argparse.Namespace) -> int:
    """Returns the exit code. Raises UsageError."""
    if parsed.dap or parsed.dap_port is not None:
        from libins import dap_server

        return dap_server.serve(parsed.dap_port)
    if parsed.scenario is None:
        raise UsageError("ins debug: a scenario or an image is needed (or --dap)")
    debugger = open_scenario(
        parsed.scenario, parsed.firmware, dict(map(scenario.setting, parsed.set)), not parsed.no_navigator
    )
    terminal = Terminal(debugger, parsed.source)
    signal.signal(signal.SIGINT, terminal.interrupt)
    print(f"{debugger.scenario.firmware}, {'names from its .cdb' if debugger.table else 'no .cdb: addresses only'}")
    if parsed.script is not None:
        try:
            lines = parsed.script.read_text(encoding="utf-8").splitlines()
        except (OSError, UnicodeDecodeError) as error:
            raise UsageError(f"{parsed.script}: cannot be read: {error}") from error
        return terminal.session(lines, echo=True)
    if not sys.stdin.isatty():
        return terminal.session(sys.stdin, echo=True)
    return terminal.dialogue()
