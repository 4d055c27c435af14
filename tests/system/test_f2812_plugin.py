"""The fixture f2812_board as its user meets it: pytester runs pytest on a real program, also on tests that fail."""

import importlib.metadata
import json

import pytest
from f2812_kit import CARELESS, build

from libins import artifacts, scenario

pytest_plugins = ["pytester"]
INSTALLED = any(e.value == "libins.pytest_plugin" for e in importlib.metadata.entry_points(group="pytest11"))
PLUGIN = [] if INSTALLED else ["-p", "libins.pytest_plugin"]
ECHO = scenario.PACKAGE / "firmware/echo.f2812"
HEAD = """
import pytest
pytestmark = pytest.mark.f2812_board(firmware="echo.f2812", sci={"b": {"to": "open"}}, boot=b"echo ready\\r\\n")
"""
FAILS = (
    HEAD
    + """
def test_wrong(f2812_board):
    f2812_board.send(b"ping")
    f2812_board.expect(b"pong", within_s=0.01)
"""
)


@pytest.fixture
def run(pytester):
    def go(text: str, *options: object) -> pytest.RunResult:
        pytester.makepyfile(test_it=text)
        return pytester.runpytest_subprocess(*PLUGIN, "-p", "no:cacheprovider", "--strict-markers", *map(str, options))

    return go


def test_boards_are_booted_and_made_by_the_marker(run):
    result = run(
        HEAD
        + """
@pytest.mark.parametrize("turn", range(3))
def test_each_begins_after_the_greeting(f2812_board, turn):
    assert f2812_board.unread == b"" and f2812_board.now_s < 0.1
    f2812_board.send(bytes([65 + turn]))
    f2812_board.expect(bytes([65 + turn]), within_s=0.01)

@pytest.mark.f2812_board(boot=None, strict=True)
def test_two_boards(make_f2812_board):
    one = make_f2812_board(firmware="echo.f2812")
    two = make_f2812_board(firmware="echo.f2812", sci={"a": {"baud": 9700}}, seed=2)
    for board in (one, two):
        board.hosts["scia"].expect(b"ready", within_s=0.1)
    assert one.now_ps != two.now_ps
"""
    )
    result.assert_outcomes(passed=4)


def test_options_name_the_program_and_the_seed(run):
    text = """
def test_it(f2812_board):
    assert f2812_board.scenario.tables.seed == 7
    f2812_board.hosts["scia"].expect(b"ready", within_s=0.1)
"""
    run(text, "--board-firmware", ECHO, "--board-seed", 7).assert_outcomes(passed=1)


def test_a_failure_says_what_came_and_leaves_artifacts(run, pytester):
    result = run(FAILS, "--board-artifacts", pytester.path / "kept")
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*b'pong' did not come*", "*echo.f2812 on dsp, seed 1*", "*artifact *accesses.jsonl"])
    [folder] = (pytester.path / "kept").iterdir()
    inputs = json.loads((folder / "inputs.json").read_text(encoding="utf-8"))["inputs"]
    assert [each["what"] for each in inputs] == ["send"]
    with artifacts.replay(folder) as again:
        assert bytes(octet.value for octet in again.received) == b"echo ready\r\nping"


def test_a_report_fails_a_strict_test(run, pytester):
    build(CARELESS, pytester.path, "careless")
    text = """
import pytest

@pytest.mark.f2812_board(firmware="careless.f2812")
@pytest.mark.parametrize("strict", [False, True])
def test_it(make_f2812_board, strict):
    board = make_f2812_board(strict=strict)
    board.run_for(0.001)
    assert len(board.reports) == 2
"""
    result = run(text)
    result.assert_outcomes(passed=2, errors=1)
    result.stdout.fnmatch_lines(["*the board has reports:*", "*guest_error: *(0x7021)*", "*not_modelled: *"])


def test_usage_errors_are_told_without_a_traceback(run):
    result = run(
        "import pytest\n\n@pytest.mark.f2812_board(firmware='no.f2812')\ndef test_it(f2812_board):\n    pass\n"
    )
    result.assert_outcomes(errors=1)
    result.stdout.fnmatch_lines(["*'no.f2812'*no such file*"])
