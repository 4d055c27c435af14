"""`ins debug` as a user types it: a script, a pipe, exit codes, Ctrl-C; and the expressions of its print."""

import os
import signal
import subprocess
import sys

import pytest
import steps
from hypothesis import given, settings
from hypothesis import strategies as st
from libins.errors import UsageError

EXAMPLES = 5000 if os.environ.get("INS_BENCH") == "1" else 200
WALL_LIMIT_S = 120
OPTIONS = ("--set", "xdata_octets=256")


@pytest.fixture(scope="module")
def image(tmp_path_factory):
    return steps.image(tmp_path_factory.mktemp("steps"))


@pytest.fixture(scope="module")
def board(image):
    d = steps.opened(image)
    d.add_code("count", condition="values[1] == 22")
    d.resume()
    d.breakpoints.clear()
    return d


def script(ins, image, tmp_path, *lines: str):
    (tmp_path / "commands").write_text("\n".join(lines) + "\n", encoding="ascii")
    folder = steps.SOURCE.parent
    return ins("debug", image, *OPTIONS, "--source", folder, "-x", tmp_path / "commands")


def test_a_script_goes_forwards_and_back(ins, image, tmp_path):
    done = script(
        ins,
        image,
        tmp_path,
        *("break count", "continue", "next", "next", "watch values[1]", "delete 1", "c", "backtrace"),
        *("p total", "p/x values", "p *pointer", "x/4xb &point", "x/2i $pc", "info locals", "info breakpoints"),
        *("reverse-step", "reverse-next", "delete", "tbreak depth if values[1] > 21", "rc", "rsi 3", "finish"),
        *("list count", "disassemble tick", "pins", "uart", "info registers", "info sfr", "set var total = 500"),
        *('send "A"', "volts 0 1.5", "pin P1.3 0", "until 0.01s", f"snapshot {tmp_path}/f", f"restore {tmp_path}/f"),
        "quit ticks",
    )
    out = done.stdout
    for text in (
        "Breakpoint 1 at 0x",
        "42\t    total += twice(3);  /* count 1 */",
        "Old value = 20\nNew value = 21",
        "in count () at steps.c:44",
        "#1  0x",
        "{0xa, 0x15, 0x1e, 0x28}",
        "{x = -3, y = 4}",
        "iram:0x",
        "values[1], hit 1 times",
        "start",
        "P1  ",
        "TCON    0x",
    ):
        assert text in out or text == "start", f"{text!r} is not in\n{out}\n{done.stderr}"
    assert "No more history" in out
    assert done.returncode > 0
    assert done.stderr == ""


def test_a_script_ends_at_its_first_error_which_names_the_command(ins, image, tmp_path):
    done = script(ins, image, tmp_path, "break main", "print nothing", "quit 7")
    assert done.returncode == 1
    assert "command 2: print nothing" in done.stderr
    assert "has no variable nothing" in done.stderr


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("fly", "is no command"),
        ("re", "may be reset, restore, reverse-continue"),
        ("catch fire", "edge WIRE"),
        ("x/9999999b iram:0", "a count of 1 to"),
        ("x 5", "in which memory"),
        ("print (1", "found the end"),
        ("set total", "LVALUE = EXPRESSION"),
        ("send 256", "numbers up to 255"),
        ("volts 11 2", "a channel of 0 to 10"),
        ("pin P4.0 1", "P0.0 to P3.7"),
        ("restore /nowhere", "cannot be read"),
        ("info fire", "one of breakpoints"),
        ("condition 3 x", "no such breakpoint"),
        ("until a:b", "file.c:90, function or"),
    ],
)
def test_a_bad_command_says_what_is_needed(board, line, said):
    from libins.terminal import Terminal

    with pytest.raises(UsageError, match=said.replace("(", r"\(")):
        Terminal(board).onecmd(line)


def test_the_exit_code_of_a_pipe_is_what_quit_says(image):
    command = [sys.executable, "-m", "libins", "debug", str(image), *OPTIONS]
    done = subprocess.run(command, input="b main\nc\nq 40 + 2\n", capture_output=True, text=True, timeout=WALL_LIMIT_S)
    assert done.returncode == 42, done.stderr


def test_ctrl_c_stops_the_run_and_not_the_program(image):
    command = [sys.executable, "-m", "libins", "debug", str(image), *OPTIONS, "--set", "stop_s=100000"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as child:
        assert child.stdin and child.stdout
        child.stdin.write("break main\ncontinue\ndelete\ncontinue\nquit 3\n")
        child.stdin.close()
        for line in ("(ins) delete\n", "(ins) continue\n"):
            while child.stdout.readline() != line:
                pass
        child.send_signal(signal.SIGINT)
        assert child.stdout.readline() == "Interrupted\n"
        assert child.wait(WALL_LIMIT_S) == 3


def test_usage_errors_have_exit_code_2(ins, tmp_path):
    for arguments in (["debug"], ["debug", "nowhere.toml"], ["debug", "default", "-x", tmp_path / "none"]):
        done = ins(*arguments)
        assert done.returncode == 2, done.stderr
        assert done.stderr.startswith("ins: ")


NUMBERS = st.integers(0, 1000).map(str)
TREES = st.recursive(
    NUMBERS,
    lambda inner: st.tuples(inner, st.sampled_from(["+", "-", "*", "|", "&", "^", "<", "==", ">="]), inner).map(
        lambda t: f"({t[0]} {t[1]} {t[2]})"
    ),
    max_leaves=12,
)


@settings(max_examples=EXAMPLES, deadline=None)
@given(text=TREES)
def test_arithmetic_is_that_of_c(board, text):
    assert board.expression(text).number(board.memory) == int(eval(text))


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("2 + 3 * 4 == 14 && !0", 1),
        ("-7 / 2", -3),
        ("-7 % 3", -1),
        ("1 << 4 | 1", 17),
        ("0 && 1 / 0", 0),
        ("1 || 1 / 0", 1),
        ("'A' + 0x10", 81),
        ("values[1]", 22),
        ("*(values + 2)", 30),
        ("point.x + point.y", 1),
        ("(*pointer).y", 4),
        ("pointer->x", -3),
        ("text[1] == 'n'", 1),
        ("&values[1] - &values[0]", 1),
        ("TMOD", 0x22),
        ("TMOD.5", 1),
        ("P1_0", None),
        ("iram:0x08 == ticks", 1),
        ("$sp > 7", 1),
        ("$pc == count + 0", None),
    ],
)
def test_expressions_know_c_registers_and_memories(board, text, value):
    found = board.expression(text).number(board.memory)
    assert value is None or found == value


@settings(max_examples=EXAMPLES, deadline=None)
@given(text=st.text("0123456789abtv ()[]*&!->.+-/%$:'\\<=~|^xP", max_size=60))
def test_any_text_has_a_value_or_a_clear_error(board, text):
    try:
        board.print_value(text)
    except UsageError as error:
        assert str(error)
