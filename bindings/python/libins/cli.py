"""The `ins` command."""

import argparse
import contextlib
import os
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

from libins import (
    allan_cli,
    calib_cli,
    campaign,
    dds_options,
    debug_cli,
    endpoint,
    export_cli,
    keys_cli,
    play_cli,
    record_cli,
    replay_cli,
    report,
    run,
    scenario,
    seeing,
    sim_cli,
    view_cli,
)
from libins.dds_security import for_daemon
from libins.errors import CrashError, UsageError
from libins.program import CONSOLES, Program, address, exit_place
from libins.tables import PACKAGE, Loaded
from libins.whole_file import write

EXIT_USAGE = 2
EXIT_CRASH = 3


def parser() -> argparse.ArgumentParser:
    """The command line's grammar."""
    grammar = argparse.ArgumentParser(
        prog="ins", description="Inertial navigation from the sensor's volts to a message on the network."
    )
    commands = grammar.add_subparsers(dest="command", required=True, metavar="COMMAND")

    r = commands.add_parser(
        "run",
        help="run a scenario on an emulated board",
        description="Exit codes: 0 all expectations met, 1 one failed, 2 bad usage or scenario, "
        "3 the firmware did something wrong (with --strict) or crashed, 42 the simulated time ran out. "
        "A scenario with a [matrix] is run once for each combination; its files are numbered F.1.csv, F.2.csv ..., "
        "--json is a list, and the exit code the largest.",
    )
    r.add_argument(
        "scenario",
        help="a TOML file, the name of one that comes with the package (default), or a program alone (F.ihx, F.f2812)",
    )
    r.add_argument(
        "--firmware",
        type=Path,
        action="append",
        default=[],
        metavar="F.ihx",
        help="another image than the scenario's; given again, one run each",
    )
    r.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="KEY=VALUE",
        help="another value for a key of the scenario, for example link.baud=19200",
    )
    r.add_argument(
        "--switch",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="of the F2812, where TI's papers leave something open; docs/f2812.md lists them",
    )
    r.add_argument("--json", type=Path, metavar="F", help="write the summary there ('-': standard output)")
    r.add_argument("--junit", type=Path, metavar="F.xml", help="write a test case for every expectation")
    r.add_argument("--report", type=Path, metavar="F.html", help="write a report with plots")
    r.add_argument("--states", type=Path, metavar="F.csv", help="write every navigation state beside its truth")
    r.add_argument("--scans", type=Path, metavar="F.csv", help="write every scan of the board: instants and codes")
    r.add_argument("--trace", type=Path, metavar="F.csv", help="write every edge of every traced wire")
    seeing.add_options(r)
    r.add_argument("--seed", type=int, metavar="N")
    r.add_argument("--stop-s", type=float, metavar="S", help="simulated seconds, instead of the scenario's stop_s")
    r.add_argument(
        "--speed", default=None, metavar="max|X", help="simulated seconds a wall second (max; 1 with --serial)"
    )
    r.add_argument("--strict", action="store_true", help="exit 3 when the firmware did something wrong")
    r.add_argument("--dds", action="store_true", help="publish the navigation states while they come")
    r.add_argument(
        "--ros",
        nargs="?",
        const="/",
        metavar="NAMESPACE",
        help="publish them as ROS 2 topics, on ROS_DOMAIN_ID, else on --domain",
    )
    r.add_argument(
        "--serial",
        action="append",
        default=[],
        metavar="NAME=pty[:LINK]|tcp:PORT|file:F",
        help="tie a UART of the board to the outside: uart; of an F2812 scia, scib; of several boards a host's name",
    )
    r.add_argument(
        "--wait", action="store_true", help="with --serial: power the board when somebody opens the other end"
    )
    dds_options.options(r)
    dds_options.decimation(r)
    _program_options(r)

    c = commands.add_parser(
        "campaign",
        help="run a scenario many times with seeded variations, into a table",
        description="Exit codes: 0 every run passed, 1 not every one, 2 bad usage or scenario. Interrupted, the same "
        "command goes on.",
    )
    campaign.add_options(c)

    g = commands.add_parser(
        "debug",
        help="stop a board, look at it, step and run back",
        description="A debugger with gdb's words; help lists them. Exit codes: 0, 1 a command of a script failed, "
        "2 bad usage, or what quit says.",
    )
    debug_cli.options(g)

    allan_cli.options(commands.add_parser("allan", help="noise coefficients of a sensor that was recorded at rest"))
    sim_cli.options(commands.add_parser("sim", help="a known motion and what sensors on it say, as CSV"))
    calib_cli.options(
        commands.add_parser("calib", help="calibrate accelerometers, or a triad with gyros, from readings in poses")
    )

    p = commands.add_parser("replay", help="run a recorded drive through a filter: docs/replay.md")
    replay_cli.options(p)
    dds_options.options(p)
    dds_options.decimation(p)

    commands.add_parser("nav", help="start ins-navd; every option is its own (ins nav --help)", add_help=False)
    commands.add_parser("gpsdr", help="start ins-gpsdr; every option is its own (ins gpsdr --help)", add_help=False)

    m = commands.add_parser("record", help="record DDS topics as MCAP, which viewers of ROS 2 read")
    record_cli.options(m)
    dds_options.options(m, topic=False)
    y = commands.add_parser("play", help="publish a recording again, with its spacing")
    play_cli.options(y)
    dds_options.options(y, topic=False)
    export_cli.options(commands.add_parser("export", help="a recording as CSV or for NumPy"))

    view_cli.options(commands.add_parser("view", help="a board or a recording as a page in the browser: docs/view.md"))
    keys_cli.options(commands.add_parser("keys", help="make certificates and permissions for DDS Security"))

    s = commands.add_parser("sub", help="print navigation states that arrive over DDS, one line of JSON each")
    kinds = {
        "solution": "what a navigating board says (NavSolution) instead of states (NavState)",
        "status": "how far a source is to be believed (Status)",
        "innovations": "measurements beside what a filter expected (Innovations)",
        "raw-imu": "what the sensors said (RawImu)",
    }
    for kind, text in kinds.items():
        s.add_argument(f"--{kind}", dest="kind", action="store_const", const=kind.replace("-", "_"), help=text)
    s.set_defaults(kind="state")
    s.add_argument("--limit", type=int, metavar="N", help="stop after N of them")
    s.add_argument("--timeout-s", type=float, metavar="S", help="exit 1 when nothing arrives for so long")
    s.add_argument("--exclusive", action="store_true", help="of publishers with --strength the strongest alive")
    dds_options.options(s)
    return grammar


def _program_options(command: argparse.ArgumentParser) -> None:
    group = command.add_argument_group("programs of other makers", "their memory, console, end and exit code")
    group.add_argument("--part", metavar="NAME", help="at89s51 or at89s52")
    group.add_argument("--code-octets", type=int, metavar="N", help="code memory, flash and external, up to 65536")
    group.add_argument("--xdata-octets", type=int, metavar="N", help="external RAM from address 0, up to 65536")
    group.add_argument(
        "--console",
        choices=CONSOLES,
        help="standard output is what the program writes to SBUF in mode 0, or sends on its line; the rest goes to "
        "standard error",
    )
    group.add_argument("--stop-on-xdata-read", metavar="ADDR", help="reading this address ends the program")
    group.add_argument(
        "--exit-from",
        metavar="PLACE",
        help="iram:0xNN, xdata:0xNNNN or a register (ACC): the exit code of the program, which `ins run` returns",
    )


def _program(options: argparse.Namespace) -> Program | None:
    """Raises UsageError."""
    if {options.console, options.stop_on_xdata_read, options.exit_from} == {None}:
        return None
    stop = options.stop_on_xdata_read
    return Program(
        options.console,
        None if stop is None else address(stop, "--stop-on-xdata-read"),
        None if options.exit_from is None else exit_place(options.exit_from),
    )


def _print_octets(octets: bytes) -> None:
    sys.stdout.buffer.write(octets)
    sys.stdout.buffer.flush()


def speed_of(text: str | None) -> float | None:
    """None: as fast as it goes. Raises UsageError."""
    if text is None or text == "max":
        return None
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0.001 <= value <= 1e6:
        raise UsageError(f"--speed {text}: 'max' or a number in 0.001 .. 1e6 is needed")
    return value


def _run_command(options: argparse.Namespace) -> int:
    if options.stop_s is not None and not 0 < options.stop_s <= 1e6:
        raise UsageError(f"--stop-s {options.stop_s}: must lie above 0 and up to 1e6")
    if options.seed is not None and not 0 <= options.seed < 2**63:
        raise UsageError(f"--seed {options.seed}: must lie in 0 .. 2^63 - 1")
    if options.report is not None:
        _page()  # missing before the run rather than after it
    settings = dict(map(scenario.setting, options.set))
    settings |= dict(map(scenario.switch, options.switch))
    given = {key: getattr(options, key) for key in ("seed", "stop_s", "part", "code_octets", "xdata_octets")}
    settings |= {key: value for key, value in given.items() if value is not None}
    log = sys.stdout if options.console is None else sys.stderr
    runs = scenario.load_all(scenario.find(options.scenario), options.firmware, settings)
    if len(runs) > 1 and options.serial:
        raise UsageError(f"--serial: {options.scenario} makes {len(runs)} runs; choose one with --set and --firmware")
    results: list[tuple[str, run.Result]] = []
    with contextlib.ExitStack() as opened:
        handle = (
            opened.enter_context(contextlib.closing(dds_options.open_dds(options, publishes=True)))
            if options.dds
            else None
        )
        node = (
            opened.enter_context(contextlib.closing(dds_options.open_ros(options))) if options.ros is not None else None
        )
        for number, loaded in enumerate(runs, start=1):
            result = _run_one(loaded, options, (handle, node), number if len(runs) > 1 else None)
            results.append((loaded.name, result))
            if str(options.json) != "-":
                print(report.text(result.summary), file=log, flush=True)
    summaries = [result.summary for _, result in results]
    if options.json is not None:
        write(options.json, run.to_json(summaries if len(runs) > 1 else summaries[0]))
    if options.junit is not None:
        from libins import junit

        write(options.junit, junit.xml(results, options.strict))
    worst = max(result.exit_code for _, result in results)
    if len(runs) > 1 and str(options.json) != "-":
        passed = sum(result.exit_code == 0 for _, result in results)
        print(f"{passed} of {len(runs)} runs passed", file=log)
    return worst


def _publisher(handle: Any, node: Any, source: str) -> Callable[[bytes], None] | None:
    if handle is None and node is None:
        return None

    def publish(state: bytes) -> None:
        now_ns = time.time_ns()
        if handle is not None:
            handle.publish(state, source, now_ns)
        if node is not None:
            node.publish(state, now_ns)

    return publish


def _run_one(loaded: Loaded, options: argparse.Namespace, outlets: tuple[Any, Any], number: int | None) -> run.Result:
    """One run and its files; outlets: DDS handle and ROS node; number: which of several, for the files' names."""

    def place(path: Path) -> Path:
        return path if number is None else path.with_name(f"{path.stem}.{number}{path.suffix}")

    console = Console(stderr=True)
    endpoints: dict[str, endpoint.Endpoint] = {}
    settings = run.Options(
        endpoints=endpoints,
        speed=speed_of(options.speed),
        strict=options.strict,
        program=_program(options),
        watch=seeing.observation(loaded, options, place),
    )
    if options.console is not None:
        settings.console = _print_octets
    settings.publish = _publisher(*outlets, loaded.name)
    settings.explain = options.report is not None
    trace_lines = ["t_ps,wire,level\n"]
    if options.trace is not None:
        settings.trace = lambda wires, edges: trace_lines.extend(report.trace_lines(wires, edges))
    try:
        for option in options.serial:
            name, opened = endpoint.open_endpoint(option, [name for name in loaded.serial() if name not in endpoints])
            endpoints[name] = opened
        for name, opened in endpoints.items():
            print(f"{name}: {opened.label}", file=sys.stderr, flush=True)
        while options.wait and not all([each.connected() for each in endpoints.values()]):
            time.sleep(0.01)
        with Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            TextColumn("{task.completed:.1f} of {task.total:.1f} s simulated"),
            TimeRemainingColumn(),
            console=console,
            disable=not console.is_terminal,
            transient=True,
        ) as progress:
            task = progress.add_task(loaded.name, total=loaded.tables.stop_s)
            settings.progress = lambda t, _: progress.update(task, completed=t)
            result = run.execute(loaded, settings)
    finally:
        for each in endpoints.values():
            each.close()
        if settings.watch is not None:
            settings.watch.close()
    if options.profile is not None:
        from libins import profile

        write(place(options.profile), profile.text(result.summary["observed"]))
    if options.states is not None:
        write(place(options.states), report.rows_csv(result.columns, result.states))
    if options.scans is not None:
        write(place(options.scans), report.rows_csv(result.scan_columns, result.scans))
    if options.trace is not None:
        write(place(options.trace), "".join(trace_lines))
    if options.report is not None:
        watch = settings.watch
        write(place(options.report), _page().html(loaded, result, watch.view, watch.files) if watch else "")
    return result


def _page() -> Any:
    """The module that draws reports, imported where it is needed: matplotlib takes a second. Raises UsageError."""
    try:
        from libins import page
    except ImportError as error:
        raise UsageError(f"--report: {error.name} is missing; pip install 'libins[report]'") from error
    return page


def navd_path(name: str = "ins-navd") -> Path:
    """Where a daemon's binary is. Raises UsageError."""
    path = PACKAGE / "bin" / name
    if not path.exists():
        raise UsageError(f"{path}: {name} is not built; run ./dev demo or ./dev test once")
    return path


def _sub_command(options: argparse.Namespace) -> int:
    handle = dds_options.open_dds(options, publishes=False, exclusive=options.exclusive, kind=options.kind)
    count = 0
    gone: set[str] = set()
    last = time.monotonic()
    try:
        while options.limit is None or count < options.limit:
            for sample in handle.take(0.1):
                last = time.monotonic()
                if "json" in sample:
                    print(sample["json"], end="", flush=True)
                    count += 1
                if sample["gone"] and sample["source"] not in gone:
                    print(f"{sample['source']}: its publisher has gone", file=sys.stderr)
                (gone.add if sample["gone"] else gone.discard)(sample["source"])
                if count == options.limit:
                    break
            if options.timeout_s is not None and time.monotonic() - last > options.timeout_s:
                print(f"ins sub: nothing arrived for {options.timeout_s} s on domain {options.domain}", file=sys.stderr)
                return 1
    finally:
        handle.close()
    return 0


def main(arguments: list[str] | None = None) -> int:
    """Entry point. Returns the exit code."""
    arguments = sys.argv[1:] if arguments is None else arguments
    try:
        if arguments[:1] in (["nav"], ["gpsdr"]):
            path = navd_path("ins-navd" if arguments[0] == "nav" else "ins-gpsdr")
            os.execv(path, [str(path), *for_daemon(arguments[1:])])
        options = parser().parse_args(arguments)
        commands = {
            "run": _run_command,
            "allan": allan_cli.run,
            "campaign": campaign.command,
            "debug": debug_cli.run,
            "record": record_cli.run,
            "play": play_cli.run,
            "export": export_cli.run,
            "replay": replay_cli.run,
            "keys": keys_cli.run,
            "sim": sim_cli.run,
            "calib": calib_cli.run,
            "sub": _sub_command,
            "view": view_cli.run,
        }
        return commands[options.command](options)
    except UsageError as error:
        print(f"ins: {error}", file=sys.stderr)
        return EXIT_USAGE
    except CrashError as error:
        print(f"ins: {error}", file=sys.stderr)
        return EXIT_CRASH
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
