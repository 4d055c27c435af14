r"""The pytest plugin: emulated boards as fixtures, boots shared between tests, artifacts of failures.

@pytest.mark.board(firmware="meter.ihx", boot=b"READY\r\n")
def test_lamp(board):
    board.volts[0] = 4.5
    board.send(b"?")
    board.expect(b"AIN0 4500 mV\r\n", within_s=0.1)
    assert not board.pin("P2.0")
"""

import inspect
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, TypeVar

import pytest

from libins import artifacts
from libins.bench import Bench
from libins.board import Board, Snapshot
from libins.errors import UsageError
from libins.f2812_board import F2812Board

BOOT_S = 1.0
KEEP_MS = "20"
BOARDS = pytest.StashKey[list[Bench]]()
BOOTS = pytest.StashKey[dict[str, Snapshot]]()

B = TypeVar("B", bound=Bench)
Boot = bytes | re.Pattern[bytes] | Callable[[Board], object]


def pytest_addoption(parser: pytest.Parser) -> None:
    """Options of the command line and of pytest.ini."""
    group = parser.getgroup("libins", "emulated boards")
    group.addoption("--board-artifacts", metavar="DIR", help="write what is needed to look at a failure again there")
    group.addoption("--board-seed", type=int, metavar="N", help="seed of every board that names none itself")
    group.addoption("--board-firmware", metavar="F.ihx", help="image of every board that names none itself")
    group.addoption("--board-scenario", metavar="F.toml", help="scenario of every board that names none itself")
    parser.addini("board_firmware", "as --board-firmware, relative to the root directory")
    parser.addini("board_scenario", "as --board-scenario, relative to the root directory")
    parser.addini("board_artifacts", "as --board-artifacts, relative to the root directory")
    parser.addini("board_keep_ms", "simulated time before a failure that its artifacts hold, at least", default=KEEP_MS)


def pytest_configure(config: pytest.Config) -> None:
    """The marker."""
    config.addinivalue_line(
        "markers",
        "board(scenario=None, *, firmware=None, boot=None, boot_within_s=1.0, strict=False, navigator=False, **keys): "
        "of `board` and `make_board`; keys as in a scenario file. boot: octets to wait for after power-on, or a call "
        "of the board, done once a session. strict: a report about the firmware fails the test.",
    )
    config.addinivalue_line(
        "markers",
        "f2812_board(scenario=None, *, firmware=None, boot=None, boot_within_s=1.0, strict=False, **keys): of "
        "`f2812_board` and `make_f2812_board`, as `board`; boot is done for each test, since there are no snapshots.",
    )
    config.stash[BOOTS] = {}


def _maker(request: pytest.FixtureRequest, marker: str, booted: Callable[..., B]) -> Iterator[Callable[..., B]]:
    """Makes boards: the arguments of a marker, and its as defaults."""
    made: list[Bench] = request.node.stash.setdefault(BOARDS, [])
    strict: list[Bench] = []

    def make(scenario: str | Path | None = None, **keys: Any) -> B:
        keys = _defaults(request, marker, scenario) | keys
        is_strict = keys.pop("strict", False)
        board = booted(request, keys)
        made.append(board)
        strict.extend([board] if is_strict else [])
        return board

    yield make
    said = [f"{r['kind']}: {r['text']} ({r['detail']:#x})" for each in strict for r in each.reports]
    if said:
        pytest.fail("the board has reports:\n" + "\n".join(said), pytrace=False)


@pytest.fixture
def make_board(request: pytest.FixtureRequest) -> Iterator[Callable[..., Board]]:
    """Makes boards: the arguments of the marker `board`, and its as defaults."""
    yield from _maker(request, "board", _booted)


@pytest.fixture
def board(make_board: Callable[..., Board]) -> Board:
    """The board of the marker, or of the options."""
    return make_board()


@pytest.fixture
def make_f2812_board(request: pytest.FixtureRequest) -> Iterator[Callable[..., F2812Board]]:
    """Makes boards with an F2812: the arguments of the marker `f2812_board`, and its as defaults."""
    yield from _maker(request, "f2812_board", _powered)


@pytest.fixture
def f2812_board(make_f2812_board: Callable[..., F2812Board]) -> F2812Board:
    """The board of the marker, or of the options."""
    return make_f2812_board()


def _defaults(request: pytest.FixtureRequest, name: str, scenario: str | Path | None) -> dict[str, Any]:
    """The marker's arguments, then the options; files beside the test come before those of the root directory."""
    marker = request.node.get_closest_marker(name)
    if marker is not None and len(marker.args) > 1:
        raise pytest.UsageError(f"{name}{marker.args}: one argument, the scenario, has no name")
    keys = dict(marker.kwargs) if marker is not None else {}
    if marker is not None and marker.args:
        keys["scenario"] = marker.args[0]
    if scenario is not None:
        keys["scenario"] = scenario
    config = request.config
    for name in ("scenario", "firmware"):
        if name in keys:
            keys[name] = _near(request, str(keys[name]))
        elif option := config.getoption(f"--board-{name}"):
            keys[name] = str(Path(option).absolute()) if Path(option).exists() else option
        elif ini := config.getini(f"board_{name}"):
            keys[name] = str(config.rootpath / ini) if (config.rootpath / ini).exists() else ini
    seed = config.getoption("--board-seed")
    if seed is not None:
        keys.setdefault("seed", seed)
    return keys


def _near(request: pytest.FixtureRequest, name: str) -> str:
    for folder in (request.path.parent, request.config.rootpath):
        if (folder / name).is_file():
            return str(folder / name)
    return name


def _booted(request: pytest.FixtureRequest, keys: dict[str, Any]) -> Board:
    """From power-on; or from the boot's snapshot, made by the first test of the session that needs it."""
    boot: Boot | None = keys.pop("boot", None)
    within_s = keys.pop("boot_within_s", BOOT_S)
    scenario = keys.pop("scenario", None)
    keep_s = float(request.config.getini("board_keep_ms")) * 1e-3
    try:
        if boot is None:
            board = Board(scenario, **keys)
        else:
            boots = request.config.stash[BOOTS]
            name = repr((scenario, _stamp(keys.get("firmware")), sorted(keys.items()), _boot_name(boot), within_s))
            if name not in boots:
                first = Board(scenario, **keys)
                request.node.stash[BOARDS].append(first)  # a boot that fails has artifacts too
                first.keep(keep_s)
                if isinstance(boot, (bytes, re.Pattern)):
                    first.expect(boot, within_s=within_s)
                else:
                    boot(first)
                request.node.stash[BOARDS].remove(first)
                boots[name] = first.snapshot()
            board = Board.from_snapshot(boots[name])
    except UsageError as error:
        raise pytest.UsageError(str(error)) from error
    board.keep(keep_s)
    return board


def _powered(request: pytest.FixtureRequest, keys: dict[str, Any]) -> F2812Board:
    """From power-on, and booted each time: there are no snapshots."""
    boot: Any = keys.pop("boot", None)
    within_s = keys.pop("boot_within_s", BOOT_S)
    try:
        board = F2812Board(keys.pop("scenario", None), **keys)
    except UsageError as error:
        raise pytest.UsageError(str(error)) from error
    request.node.stash[BOARDS].append(board)  # a boot that fails has artifacts too
    if isinstance(boot, (bytes, re.Pattern)):
        board.expect(boot, within_s=within_s)
    elif boot is not None:
        boot(board)
    request.node.stash[BOARDS].remove(board)
    return board


def _stamp(firmware: str | None) -> tuple[str | None, int]:
    return firmware, Path(firmware).stat().st_mtime_ns if firmware and Path(firmware).exists() else 0


def _boot_name(boot: Boot) -> object:
    return (inspect.getsourcefile(boot), boot.__qualname__, id(boot)) if inspect.isfunction(boot) else boot


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item: pytest.Item, call: pytest.CallInfo[None]) -> Any:
    """Where each board of a failed test is, what it last sent, and its artifacts."""
    report: pytest.TestReport = yield
    boards: list[Bench] = item.stash.get(BOARDS, [])
    if report.failed:
        for number, board in enumerate(boards, start=1):
            report.sections.append((f"board {number} at {report.when}", _section(item, board, number)))
    if report.when == "teardown":
        for board in boards:
            board.close()
    return report


def _section(item: pytest.Item, board: Bench, number: int) -> str:
    lines = [board.describe()]
    option, ini = item.config.getoption("--board-artifacts"), item.config.getini("board_artifacts")
    if option or ini:
        folder = Path(option) if option else item.config.rootpath / ini
        folder = folder / (artifacts.folder_of(item.nodeid) + (f".{number}" if number > 1 else ""))
        try:
            keep_s = float(item.config.getini("board_keep_ms")) * 1e-3
            lines += [f"artifact {path}" for path in artifacts.write(board, folder, keep_s)]
        except (UsageError, OSError) as error:
            lines.append(f"no artifacts: {error}")
    else:
        lines.append("--board-artifacts DIR keeps what brings the board there again, and the trace")
    return "\n".join(lines)
