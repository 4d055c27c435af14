"""Board programs of the F2812 as users have them: 32-bit, run alone; f2812-cc on sources of another hand."""

import json
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build/release"
PROGRAMS = BUILD / "firmware"
F2812_CC = ROOT / "emu/f2812_sci/f2812-cc"
DATA = ROOT / "tests/data/f2812"
WALL_LIMIT_S = 120
ELF32, ELF64 = 1, 2

Cc = Callable[..., Path]


def run(*command: object, code: int = 0) -> subprocess.CompletedProcess[str]:
    done = subprocess.run([*map(str, command)], capture_output=True, text=True, timeout=WALL_LIMIT_S)
    assert done.returncode == code, f"{command}\n{done.stdout}{done.stderr}"
    return done


def summary(program: Path, *options: object) -> dict[str, Any]:
    result: dict[str, Any] = json.loads(run(program, *options).stdout)
    return result


@pytest.fixture
def cc(tmp_path: Path) -> Cc:
    """Compile sources of tests/data/f2812 from a folder that is not the project's."""

    def compile_them(*arguments: object, name: str = "app") -> Path:
        out = tmp_path / f"{name}.f2812"
        command = [F2812_CC, "--lib", BUILD / "f2812", *arguments, "-o", out]
        done = subprocess.run([*map(str, command)], cwd=tmp_path, capture_output=True, text=True, timeout=WALL_LIMIT_S)
        assert done.returncode == 0, f"{command}\n{done.stdout}{done.stderr}"
        return out

    return compile_them


@pytest.mark.parametrize("name", ["loopback_fifo", "echo", "autobaud", "modem"])
def test_a_program_runs_the_same_each_time_and_without_errors(name: str, tmp_path: Path) -> None:
    program = PROGRAMS / f"{name}.f2812"
    assert program.read_bytes()[4] == ELF32
    (tmp_path / "in").write_bytes(b"Around and around and around")
    baud = 115200 if name == "modem" else 9600
    seen = []
    for n in range(2):
        files = [tmp_path / f"{n}.{what}" for what in ("json", "log", "out")]
        host = f"A:{baud}:{tmp_path / 'in'}:{files[2]}"
        run(program, "--stop-s", 0.15, "--strict", "--json", files[0], "--log", files[1], "--host", host)
        seen.append([file.read_bytes() for file in files])
    assert seen[0] == seen[1]
    result = json.loads(seen[0][0])
    assert result["guest_errors"] == 0 and result["starts"] == 1 and not result["reports"]
    assert len(seen[0][1].splitlines()) > 100
    assert (name == "loopback_fifo") or seen[0][2]


def test_loopback_fifo_ends_by_itself_and_waiting_costs_nothing_but_time() -> None:
    program = PROGRAMS / "loopback_fifo.f2812"
    passed_over, executed = summary(program), summary(program, "--no-skip")
    assert passed_over["ended"] == "main() returned"
    assert passed_over == executed


def test_echo_gives_back_what_a_file_holds(tmp_path: Path) -> None:
    sent = bytes(range(256))
    (tmp_path / "in").write_bytes(sent)
    summary(PROGRAMS / "echo.f2812", "--stop-s", 0.5, "--host", f"A:9600:{tmp_path / 'in'}:{tmp_path / 'out'}")
    assert (tmp_path / "out").read_bytes() == b"echo ready\r\n" + sent


def test_sources_with_headers_of_another_hand_compile_and_run(cc: Cc) -> None:
    idiom = DATA / "idiom"
    program = cc("--ignore-case", idiom / "main.c", idiom / "defs.c")
    result = summary(program, "--stop-s", 1)
    assert result["ended"] == "main() returned"
    assert result["interrupts"] == 200
    assert not result["reports"]


def test_64_bits_run_what_does_not_care(cc: Cc) -> None:
    source = ROOT / "emu/f2812_sci/firmware/loopback_fifo/loopback_fifo.c"
    program = cc("-m64", source)
    assert program.read_bytes()[4] == ELF64
    assert summary(program)["ended"] == "main() returned"


@pytest.mark.parametrize("bits", ["-m32", "-m64"])
@pytest.mark.parametrize(
    ("source", "said"),
    [
        ("absolute", "the firmware used the absolute address 7050 (SCICCRA)"),
        ("deep", "the firmware's stack is full"),
    ],
)
def test_what_memory_does_not_allow_ends_with_its_reason(cc: Cc, source: str, said: str, bits: str) -> None:
    program = cc(bits, DATA / f"{source}.c")
    assert said in run(program, code=4).stderr


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["boot.asm"], "boot.asm: assembly and linker command files are not run"),
        (["missing.c"], "no such file: missing.c"),
        (["--speed"], "unknown option --speed"),
        ([], "no input files"),
        ([DATA / "deep.c", "--lib", "/nowhere", "-o", "/dev/null"], "no runtime in /nowhere/32"),
    ],
)
def test_f2812_cc_says_what_is_wrong(arguments: list[object], said: str) -> None:
    assert said in run(F2812_CC, *arguments, code=2).stderr


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--loop", "C"], "--loop C: no such option or value"),
        (["--stop-s", "soon"], '--stop-s wants a number from 0 to 1e7, not "soon"'),
        (["--host", "A:3:-"], "--host wants A:BAUD:IN[:OUT]"),
        (["--host", "A:9600:/nowhere"], "/nowhere: No such file"),
        (["--osc-hz", "1e12"], "a crystal outside 4 to 150 MHz"),
        (["--switch", "loop"], "--switch wants NAME=VALUE"),
        (["--json"], "its value is missing"),
    ],
)
def test_a_program_says_what_is_wrong_with_its_options(arguments: list[str], said: str) -> None:
    assert said in run(PROGRAMS / "echo.f2812", *arguments, code=2).stderr
