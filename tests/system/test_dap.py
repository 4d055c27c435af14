"""The Debug Adapter Protocol server: a real client (npm), damaged frames, requests that make no sense."""

import json
import os
import shutil
import socket
import subprocess
import sys
from pathlib import Path

import pytest
import steps
from hypothesis import given, settings
from hypothesis import strategies as st
from libins.dap import Session
from libins.dap_wire import CONTENT_MAX, FrameError, Framer, frame

EXAMPLES = 3000 if os.environ.get("INS_BENCH") == "1" else 60
WALL_LIMIT_S = 300
CLIENT = Path(__file__).parent / "dap_client"
MODULES = Path(__file__).resolve().parents[2] / "build/dap_client"
COMMANDS = (
    *("initialize", "launch", "attach", "setBreakpoints", "setFunctionBreakpoints", "setInstructionBreakpoints"),
    *("setDataBreakpoints", "dataBreakpointInfo", "configurationDone", "threads", "stackTrace", "scopes", "variables"),
    *("setVariable", "evaluate", "next", "stepIn", "stepBack", "pause", "disassemble", "readMemory", "writeMemory"),
    *("source", "gotoTargets", "goto", "terminate", "fly", ""),
)
ARGUMENTS = (
    *("source", "path", "name", "breakpoints", "line", "condition", "hitCondition", "instructionReference", "offset"),
    *("memoryReference", "instructionCount", "instructionOffset", "count", "data", "variablesReference", "frameId"),
    *("value", "expression", "dataId", "accessType", "granularity", "levels", "startFrame", "targetId", "threadId"),
)
LEAVES = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-(2**60), 2**60),
    st.integers(-2, 300),
    st.floats(),
    st.text(max_size=20),
    st.sampled_from(["steps.c", "iram:0x30", "0x0100", "xdata:0xffff", "total", "values[1]", "AAAA", "iram:0x30:1:x"]),
)
BODIES = st.recursive(
    LEAVES,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.sampled_from(ARGUMENTS), inner, max_size=5),
    max_leaves=10,
)
REQUESTS = st.lists(
    st.tuples(st.sampled_from(COMMANDS), st.dictionaries(st.sampled_from(ARGUMENTS), BODIES, max_size=6) | BODIES),
    max_size=12,
)


@pytest.fixture(scope="module")
def image(tmp_path_factory):
    return steps.image(tmp_path_factory.mktemp("steps"))


@given(
    messages=st.lists(st.dictionaries(st.text(max_size=5), LEAVES.filter(lambda x: x == x), max_size=4), max_size=5),
    cuts=st.lists(st.integers(1, 50), min_size=1, max_size=20),
)
@settings(max_examples=EXAMPLES, deadline=None)
def test_frames_come_out_as_they_went_in_however_they_are_cut(messages, cuts):
    octets = b"".join(map(frame, messages))
    framer, found, at = Framer(), [], 0
    for i in range(len(octets)):
        size = cuts[i % len(cuts)]
        found += framer.feed(octets[at : at + size])
        at += size
    assert found == json.loads(json.dumps(messages))


@given(octets=st.lists(st.binary(max_size=60) | st.just(b"Content-Length: 2\r\n\r\n{}"), max_size=8).map(b"".join))
@settings(max_examples=10 * EXAMPLES, deadline=None)
def test_any_octets_are_messages_or_errors(octets):
    framer = Framer()
    found = list(framer.feed(octets))
    fatal = [each for each in found if isinstance(each, FrameError) and each.fatal]
    assert len(fatal) <= 1
    assert not fatal or found[-1] is fatal[0]


@pytest.mark.parametrize(
    ("octets", "said", "fatal"),
    [
        (b"Content-Length: 5\r\n\r\n{oops", "no JSON", False),
        (b"Content-Length: 2\r\n\r\n[]", "an object is needed", False),
        (b"Content-Length: %d\r\n\r\n" % (CONTENT_MAX + 1), "0 to", True),
        (b"Content-Length: -1\r\n\r\n", "0 to", True),
        (b"Length: 3\r\n\r\n", "no Content-Length", True),
        (b"hello\r\n\r\n", "is no header", True),
        (b"x" * 5000, "no empty line", True),
        (b"Content-Length: 40000\r\n\r\n" + b"[" * 40000, "no JSON", False),
    ],
)
def test_a_damaged_frame_is_named(octets, said, fatal):
    (error,) = Framer().feed(octets)
    assert isinstance(error, FrameError)
    assert said in str(error)
    assert error.fatal == fatal


class Client:
    """A session within this process."""

    def __init__(self) -> None:
        self.sent: list[dict] = []
        self.session = Session(self.sent.append, lambda: None)
        self._seq = 0

    def ask(self, command, arguments=None) -> dict:
        self._seq += 1
        before = len(self.sent)
        message = {"seq": self._seq, "type": "request", "command": command, "arguments": arguments}
        self.session.handle(json.loads(json.dumps(message)))
        answers = [m for m in self.sent[before:] if m["type"] == "response"]
        assert [m["request_seq"] for m in answers] == [self._seq], "each request is answered once"
        json.dumps(self.sent[before:])
        return answers[0]


@given(requests=REQUESTS, launched=st.booleans())
@settings(max_examples=EXAMPLES, deadline=None)
def test_any_requests_in_any_order_are_answered(image, requests, launched):
    client = Client()
    if launched:
        client.ask("initialize", {})
        assert client.ask("launch", {"program": str(image), "stopOnEntry": True, "set": {"stop_s": 0.001}})["success"]
        client.ask("configurationDone")
    for command, arguments in requests:
        answer = client.ask(command, arguments)
        assert answer["success"] or answer["message"]


def test_requests_out_of_order_say_what_must_come_first(image):
    client = Client()
    assert "initialize must come first" in client.ask("threads")["message"]
    client.ask("initialize", {})
    assert "launch must come first" in client.ask("stackTrace", {"threadId": 1})["message"]
    assert "cannot be read" in client.ask("launch", {"program": "nowhere.toml"})["message"]
    assert client.ask("launch", {"program": str(image)})["success"]
    assert "configurationDone must come first" in client.ask("continue", {"threadId": 1})["message"]
    assert "does not have it" in client.ask("fly")["message"]
    assert "came already" in client.ask("launch", {"program": str(image)})["message"]


def test_a_broken_stream_ends_the_server_with_an_error_and_an_ended_one_without(image):
    command = [sys.executable, "-m", "libins", "debug", "--dap"]
    broken = subprocess.run(command, input=b"hello\r\n\r\n", capture_output=True, timeout=WALL_LIMIT_S)
    assert broken.returncode == 1
    assert b"is no header" in broken.stdout
    ended = subprocess.run(command, input=b"", capture_output=True, timeout=WALL_LIMIT_S)
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, b"", b"")


def test_a_port_takes_one_client_on_the_loopback(image):
    command = [sys.executable, "-m", "libins", "debug", "--dap-port", "0"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        assert server.stdout
        host, _, port = server.stdout.readline().strip().rpartition(" ")[2].rpartition(":")
        assert host == "127.0.0.1"
        with socket.create_connection((host, int(port)), timeout=WALL_LIMIT_S) as client:
            client.sendall(frame({"seq": 1, "type": "request", "command": "initialize", "arguments": {}}))
            client.sendall(frame({"seq": 2, "type": "request", "command": "disconnect"}))
            octets = b"".join(iter(lambda: client.recv(4096), b""))
        assert [m["command"] for m in Framer().feed(octets)] == ["initialize", "disconnect"]
        assert server.wait(WALL_LIMIT_S) == 0


def test_a_client_of_visual_studio_codes_makers_debugs_the_firmware(image, tmp_path):
    npm, node = shutil.which("npm"), shutil.which("node")
    assert npm and node, "npm and node are missing: apt-get install --no-install-recommends nodejs npm"
    MODULES.mkdir(parents=True, exist_ok=True)
    manifest = (CLIENT / "package.json").read_bytes()
    stamp = MODULES / "installed.json"
    if not stamp.exists() or stamp.read_bytes() != manifest:
        shutil.copy(CLIENT / "package.json", MODULES)
        install = [npm, "install", "--no-audit", "--no-fund", "--no-package-lock", "--no-update-notifier"]
        done = subprocess.run(install, cwd=MODULES, capture_output=True, text=True, timeout=WALL_LIMIT_S)
        assert done.returncode == 0, f"npm could not install (no network?): {done.stdout}{done.stderr}"
        stamp.write_bytes(manifest)
    adapter = tmp_path / "adapter.py"
    adapter.write_text("from libins.cli import main\n\nraise SystemExit(main(['debug', '--dap']))\n", encoding="ascii")
    shutil.copy(CLIENT / "debug.test.js", MODULES)
    marks = {mark: steps.line_of(mark) for mark in ("count 1", "by pointer", "count 3", "twice 1", "loop 2")}
    told = {
        "INS_PYTHON": sys.executable,
        "INS_ADAPTER": str(adapter),
        "INS_IMAGE": str(image),
        "INS_SOURCE": str(steps.SOURCE),
        "INS_LINES": json.dumps(marks),
    }
    mocha = [node, "node_modules/mocha/bin/mocha.js", "--timeout", "60000", "--exit", "debug.test.js"]
    done = subprocess.run(
        mocha, cwd=MODULES, env={**os.environ, **told}, capture_output=True, text=True, timeout=WALL_LIMIT_S
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "8 passing" in done.stdout, done.stdout
