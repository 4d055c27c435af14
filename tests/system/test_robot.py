"""The Robot Framework library: the example's suite passes, and what is wrong fails with a text that helps."""

import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
from sdcc_kit import build

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
WALL_LIMIT_S = 120


@pytest.fixture(scope="module")
def image(tmp_path_factory) -> Path:
    source = EXAMPLES / "board_pytest/meter.c"
    return build(source, tmp_path_factory.mktemp("meter"), "--debug", "--iram-size", "128")


def robot(suite: Path, image: Path, out: Path) -> tuple[int, dict[str, str]]:
    """Exit code (how many failed), and by test its message, empty for those that passed."""
    options = ["--outputdir", out, "--report", "NONE", "--log", "NONE", "--variable", f"IMAGE:{image}"]
    done = subprocess.run(
        [sys.executable, "-m", "robot", *map(str, options), str(suite)],
        capture_output=True,
        text=True,
        timeout=WALL_LIMIT_S,
    )
    assert (out / "output.xml").exists(), done.stdout + done.stderr
    tests = ET.parse(out / "output.xml").getroot().iter("test")
    return done.returncode, {str(t.get("name")): (t.find("status").text or "").strip() for t in tests}


def test_the_example_passes(image, tmp_path):
    code, messages = robot(EXAMPLES / "board_robot/meter.robot", image, tmp_path)
    assert code == 0, messages
    assert len(messages) == 5


FAILING = {
    "Wrong Line": (
        ["Write To Uart    ?", "Wait For Line On Uart    AIN0 9999 mV    timeout=0.1"],
        "came instead, 14 octets:",
    ),
    "Comes After All": (
        ["Write To Uart    ?", "Should Not Be On Uart    2500 mV    timeout=0.1"],
        "'2500 mV' came on the UART",
    ),
    "Is Not Idle": (["Write To Uart    ?", "Test Uart Is Idle    0.1"], "came on the UART within 0.1 s"),
    "Pin": (["Pin Should Be    P2.0    ${False}    timeout=0.01"], "P2.0 did not become False within 0.01 s"),
    "Unknown Command": (["Execute Command    machine LoadPlatform"], "known are: sysbus LoadHEX"),
    "Unknown Uart": (["Create Terminal Tester    sysbus.usart2"], "one UART, named uart"),
    "Never Provided": (["Requires    nothing"], "no test before this one has it in Provides"),
    "No Machine": (["Reset Emulation", "Run For    0.1"], "Create Machine and Start Emulation first"),
    "No Image": (["Create Machine    firmware=no.ihx", "Start Emulation"], "found 'no.ihx'"),
}


def test_what_is_wrong_fails_and_says_why(image, tmp_path):
    setup = ["Reset Emulation", f"Create Machine    firmware={image}", "Start Emulation"]
    setup.append("Wait For Line On Uart    READY    timeout=0.5")
    lines = ["*** Settings ***", "Library    libins.robot", "*** Test Cases ***"]
    for name, (steps, _) in FAILING.items():
        lines += [name, *(f"    {step}" for step in setup + steps)]
    suite = tmp_path / "wrong.robot"
    suite.write_text("\n".join(lines) + "\n", encoding="utf-8")
    code, messages = robot(suite, image, tmp_path)
    assert code == len(FAILING)
    for name, (_, text) in FAILING.items():
        assert text in messages[name], name


F2812 = """*** Settings ***
Library    libins.robot
*** Test Cases ***
Echoes On Its Port
    Create Machine    firmware=echo.f2812
    Start Emulation
    Create Terminal Tester    sysbus.scia    timeout=0.5
    Wait For Line On Uart    echo ready
    Write To Uart    x
    ${read} =    Run Until Register Access    SCIRXBUFA    read
    Should Be Equal As Integers    ${read}[value]    ${{ ord("x") }}
    Wait For Prompt On Uart    x
    ${brr} =    Get Register    SCILBAUDA
    Should Be Equal As Integers    ${brr}    ${{ 487 & 255 }}
Reads No Variables
    Create Machine    echo
    Start Emulation
    Get Variable    sampled
Has No Such Port
    Create Machine    echo
    Create Terminal Tester    scic
    Start Emulation
    Write To Uart    x
"""


def test_a_board_with_an_f2812(tmp_path):
    suite = tmp_path / "f2812.robot"
    suite.write_text(F2812, encoding="utf-8")
    code, messages = robot(suite, Path("none"), tmp_path)
    assert code == 2 and messages["Echoes On Its Port"] == ""
    assert "compiled for this machine" in messages["Reads No Variables"]
    assert "scic: this board has the UARTs scia" in messages["Has No Such Port"]
