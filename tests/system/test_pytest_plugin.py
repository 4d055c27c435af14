"""The pytest plugin as its user meets it: pytester runs pytest on real firmware, also on tests that fail."""

import importlib.metadata
import json
import shutil
from pathlib import Path

import pytest
from libins.board import Board, ExpectError
from libins.errors import UsageError
from sdcc_kit import build

from libins import artifacts, snapshot

EXAMPLE = Path(__file__).resolve().parents[2] / "examples/board_pytest"
pytest_plugins = ["pytester"]
# Where the package is installed with its entry point, pytest finds the plugin by itself; in the build tree it is named.
INSTALLED = any(e.value == "libins.pytest_plugin" for e in importlib.metadata.entry_points(group="pytest11"))
PLUGIN = [] if INSTALLED else ["-p", "libins.pytest_plugin"]


@pytest.fixture(scope="session")
def image(tmp_path_factory) -> Path:
    return build(EXAMPLE / "meter.c", tmp_path_factory.mktemp("meter"), "--debug", "--iram-size", "128")


@pytest.fixture
def run(pytester, image):
    """Run pytest in a folder with the image and one test file."""
    for path in (image, image.with_suffix(".cdb")):
        shutil.copy(path, pytester.path)

    def go(text: str, *options: object) -> pytest.RunResult:
        pytester.makepyfile(test_it=text)
        return pytester.runpytest_subprocess(*PLUGIN, "-p", "no:cacheprovider", *map(str, options))

    return go


HEAD = """
import pytest
pytestmark = pytest.mark.board(firmware="meter.ihx", boot=b"READY\\r\\n")
"""
FAILS = (
    HEAD
    + """
def test_wrong(board):
    board.run_for(0.1)
    board.volts[0] = 3.0
    board.variables["limit_mv"] = 2000
    board.send(b"?")
    board.run_for(0.004)
    board.pins["P3.2"] = False
    board.motion = {"kind": "constant_rate", "rate_rad_s": [0.0, 0.1, 0.0]}
    board.expect(b"AIN0 9999 mV", within_s=0.015)
"""
)


def test_the_example_passes(run):
    result = run((EXAMPLE / "test_meter.py").read_text(encoding="utf-8"), "--strict-markers")
    result.assert_outcomes(passed=8)


def test_a_boot_runs_once_a_session_and_tests_do_not_meet(run):
    result = run(
        """
import pytest
boots = []

def boot(board):
    boots.append(board)
    board.expect(b"READY\\r\\n", within_s=0.5)

@pytest.mark.board(firmware="meter.ihx", boot=boot)
@pytest.mark.parametrize("turn", range(4))
def test_each_begins_where_the_boot_ended(board, turn):
    assert len(boots) == 1
    assert board.variables["measured"] == 0 and not board.volts
    assert board.now_ps == boots[0].now_ps and board.cycles == boots[0].cycles
    board.volts[0] = 1.0
    board.send(b"?")
    board.expect(b"AIN0 1000 mV\\r\\n", within_s=0.05)
    assert board.variables["measured"] == 1

@pytest.mark.board(firmware="meter.ihx", boot=boot, seed=2)
def test_another_board_has_a_boot_of_its_own(board):
    assert len(boots) == 2

@pytest.mark.board(firmware="meter.ihx")
def test_without_boot_it_is_power_on(board):
    assert board.now_ps == 0
"""
    )
    result.assert_outcomes(passed=6)


def test_a_failure_says_where_the_board_is(run):
    result = run(FAILS)
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(
        [
            "E * b'AIN0 9999 mV' did not come from * s to * s; pc 0x*() meter.c:*",
            "*b'AIN0 3000 mV*",
            "*board 1 at call*",
            "meter.ihx on at89s51, seed 1, 0.3* s, pc 0x* in *() meter.c:*",
            "*--board-artifacts DIR*",
        ]
    )


def test_artifacts_lead_to_the_failure_again(run, pytester):
    result = run(FAILS, "--board-artifacts", "kept", "--board-seed", "7")
    result.assert_outcomes(failed=1)
    folder = pytester.path / "kept/test_it.py__test_wrong"
    result.stdout.fnmatch_lines([f"artifact {Path('kept') / folder.name / 'before.snapshot'}"])
    at = snapshot.read(folder / artifacts.FAILURE)
    before = snapshot.read(folder / artifacts.BEFORE)
    inputs = json.loads((folder / artifacts.INPUTS).read_text(encoding="utf-8"))["inputs"]
    assert 20e9 <= at.now_ps - before.now_ps <= 41e9, "20 ms at least"
    assert before.scenario.tables.seed == 7
    assert [each["what"] for each in inputs] == ["set_volts", "write", "send", "drive_pin", "set_motion"]
    again = artifacts.replay(folder)
    assert again.now_ps == at.now_ps
    assert again.snapshot() == at, "the same octets, state and inputs"
    with pytest.raises(ExpectError):
        again.expect(b"AIN0 9999 mV", within_s=0)
    assert not again.pin("P3.2") and again.volts[0] == 3.0
    dump = (folder / artifacts.TRACE).read_text(encoding="utf-8")
    times = [int(line[1:]) for line in dump.splitlines() if line.startswith("#")]
    assert times == sorted(times) and before.now_ps <= times[0] and times[-1] <= at.now_ps
    assert " TXD " in dump
    trace = (folder / artifacts.INSTRUCTIONS).read_text(encoding="utf-8").splitlines()
    cycles = [int(line.split()[0]) for line in trace]
    assert cycles == sorted(cycles) and cycles[-1] == pytest.approx(again.cycles, abs=4) and len(cycles) > 5000


def test_a_boot_that_fails_leaves_artifacts_too(run, pytester):
    marker = '@pytest.mark.board(firmware="meter.ihx", boot=b"STEADY", boot_within_s=0.4)'
    text = f"import pytest\n{marker}\ndef test(board): pass\n"
    result = run(text, "--board-artifacts", "kept")
    result.assert_outcomes(errors=1)
    result.stdout.fnmatch_lines(["*b'STEADY' did not come*", "*board 1 at setup*"])
    again = artifacts.replay(pytester.path / "kept/test_it.py__test")
    assert again.now_s == pytest.approx(0.4, abs=1e-5)


def test_strict_fails_on_what_the_firmware_does_wrong(run, pytester):
    (pytester.path / "a5.ihx").write_text(":02000000A50059\n:00000001FF\n", encoding="ascii")
    text = "import pytest\n@pytest.mark.board(firmware='a5.ihx', strict={})\ndef test(board): board.run_for(0.001)\n"
    run(text.format(False)).assert_outcomes(passed=1)
    result = run(text.format(True))
    result.assert_outcomes(passed=1, errors=1)
    result.stdout.fnmatch_lines(["*guest_error: *"])


def test_options_and_ini_name_what_the_marker_does_not(run, pytester):
    text = "def test(board): assert board.scenario.tables.seed == 5 and board.scenario.firmware.name == 'meter.ihx'\n"
    run(text, "--board-seed", 5, "--board-firmware", "meter.ihx").assert_outcomes(passed=1)
    pytester.makeini("[pytest]\nboard_firmware = meter.ihx\n")
    run(text, "--board-seed", 5).assert_outcomes(passed=1)
    text = "def test(board): assert board.scenario.path.name == 's3_paper.toml'\n"
    pytester.makeini("[pytest]\nboard_scenario = s3_paper\n")
    run(text).assert_outcomes(passed=1)


def test_two_boards_in_a_test(run):
    text = """
import pytest
@pytest.mark.board(boot=b"READY\\r\\n")
def test(make_board):
    a, b = make_board(firmware="meter.ihx"), make_board(firmware="meter.ihx", seed=2)
    a.send(b"?")
    a.run_for(0.05)
    assert b.unread == b"" and a.unread == b"AIN0 2500 mV\\r\\n"
"""
    run(text).assert_outcomes(passed=1)


@pytest.mark.parametrize(
    ("marker", "words"),
    [
        ("firmware='no.ihx'", "*Board: firmware: found 'no.ihx'*"),
        ("firmware='meter.ihx', bawd=1", "*Board: bawd: unknown key; did you mean 'board'?*"),
        ("'default', 'more'", "*one argument, the scenario*"),
        ("", "*firmware= or a scenario is needed*"),
    ],
)
def test_a_wrong_marker_is_refused(run, marker, words):
    result = run(f"import pytest\n@pytest.mark.board({marker})\ndef test(board): pass\n")
    assert result.parseoutcomes().get("errors") == 1
    result.stdout.fnmatch_lines([words])


def test_snapshots_as_files(image, tmp_path):
    board = Board(firmware=image)
    board.expect(b"READY", within_s=0.5)
    board.volts[0] = 1.0
    board.send(b"??")
    board.run_for(0.0123)  # in the middle of an octet
    path = tmp_path / "s.snapshot"
    board.snapshot().write(path)
    other = Board.from_snapshot(path)
    assert other.snapshot() == board.snapshot()
    for each in (board, other):
        each.run_for(0.1)
    assert other.snapshot() == board.snapshot()
    assert other.unread.count(b"AIN0 1000 mV\r\n") == 2
    octets = path.read_bytes()
    for damaged in (octets[: len(octets) // 2], b"", octets.replace(b"state.bin", b"state.bit")):
        path.write_bytes(damaged)
        with pytest.raises(UsageError, match="no snapshot of a board"):
            snapshot.read(path)
    with pytest.raises(UsageError, match="another configuration or image"):
        Board("default").restore(board.snapshot())
