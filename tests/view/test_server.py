"""`ins view` over its real WebSocket: who may come in, and every command against the real engine."""

import base64
import tomllib
from pathlib import Path

import aiohttp
import pytest
from libins.board import Board
from libins.view_history import WIRES
from view_kit import Client, Server, played

from libins import cli, run, scenario

pytestmark = pytest.mark.wall_clock

SOURCE = Path(__file__).parents[2] / "emu/8051_tlc2543/firmware"


def test_only_who_has_the_token_on_this_host_and_from_this_page_gets_in() -> None:
    async def scene(server: Server) -> None:
        assert await server.status() == 403
        assert await server.status("style.css") == 403
        assert await server.status("?token=wrong") == 403
        assert await server.status("style.css?token=" + server.token) == 403  # only the first load has it so
        assert await server.status(Authorization="Bearer wrong") == 403
        assert await server.status(**server.bearer) == 200
        for host in ("evil.example", "127.0.0.1", f"evil.example:{server.host.rpartition(':')[2]}"):
            assert await server.status(**server.bearer, Host=host) == 403
        for origin in ("http://evil.example", "null", "http://127.0.0.1:1", f"https://{server.host}"):
            assert await server.status(**server.bearer, Origin=origin) == 403
            with pytest.raises(aiohttp.WSServerHandshakeError) as refused:
                await server.http.ws_connect(server.base + "ws", headers={**server.bearer, "Origin": origin})
            assert refused.value.status == 403
        with pytest.raises(aiohttp.WSServerHandshakeError):
            await server.http.ws_connect(server.base + "ws")
        async with server.page(Origin=f"http://{server.host}") as page:
            assert page.hello["kind"] == "8051"

    played(scene)


def test_the_token_becomes_a_cookie_and_the_page_may_load_nothing_foreign() -> None:
    async def scene(server: Server) -> None:
        first = await server.http.get(f"{server.base}?token={server.token}", allow_redirects=False)
        assert (first.status, first.headers["Location"]) == (303, "/")
        cookie = first.headers["Set-Cookie"]
        assert "HttpOnly" in cookie and "SameSite=Strict" in cookie and server.token in cookie
        page = await server.http.get(server.base, headers={"Cookie": cookie.partition(";")[0]})
        assert page.status == 200 and "text/html" in page.headers["Content-Type"]
        policy = page.headers["Content-Security-Policy"]
        assert "default-src 'none'" in policy and "script-src 'self';" in policy and "unsafe" not in policy
        assert page.headers["Referrer-Policy"] == "no-referrer" and page.headers["X-Content-Type-Options"] == "nosniff"
        for path in ("../cli.py", "%2e%2e/cli.py", "..%2fcli.py"):
            assert await server.status(path, **server.bearer) in (403, 404), path

    played(scene)


def test_it_ends_cleanly_with_pages_open_and_the_board_running() -> None:
    async def scene(server: Server) -> None:
        async with server.page() as page:
            await page.ask("run")
            code, error = await server.end()
            assert (code, error) == (0, "")

    played(scene)


async def look(page: Client) -> None:
    """Everything that can be asked of a board that stands."""
    assert page.hello["wires"] == list(WIRES) and page.hello["clock_hz"] == 11_059_200
    assert {part["kind"] for part in page.hello["parts"]} >= {"at89s51", "tlc2543", "gyro", "crystal", "max232", "host"}
    assert page.frame["t_ps"] == 0 and not page.frame["running"] and page.frame["nets"]["TXD"] == 1
    answer = await page.ask("disassembly", address=0, count=2)
    assert answer["instructions"][0]["text"] == "ljmp 0x0029"
    assert (await page.ask("files"))["files"] == page.hello["files"] and "acq.c" in page.hello["files"]
    source = await page.ask("source", file="acq.c")
    assert source["lines"][0].startswith("/*") or source["lines"][0].startswith("//")
    assert all(source["lines"][int(number) - 1].strip() for number in source["addresses"])
    octets = (await page.ask("memory", space="code", address=0, count=3))["octets"]
    assert octets == "020029"
    registers = await page.ask("registers")
    assert registers["registers"]["sp"] == 7 == registers["sfrs"]["SP"]


async def go(page: Client) -> None:
    """Breakpoints, steps, and the way back."""
    main = await page.done("break_add", at="main")
    await page.done("run")
    stood = await page.until(lambda f: f["stop"] is not None and not f["running"])
    assert stood["stop"]["kind"] == "breakpoint" and stood["pc"] in main["breaks"][0]["addresses"]
    assert stood["line"]["file"] == "acq.c"
    pc, registers = stood["pc"], stood["registers"]
    assert (await page.done("step"))["stop"]["kind"] == "step" and page.frame["line"] != stood["line"]
    await page.done("step_back")
    assert (page.frame["pc"], page.frame["registers"]) == (pc, registers)
    cycle = page.frame["cycle"]
    await page.done("step", instruction=True)
    assert page.frame["cycle"] > cycle
    await page.done("step_back", instruction=True)
    assert page.frame["cycle"] == cycle
    assert (await page.done("step_over"))["stop"]["kind"] == "step"
    await page.done("step_over_back")
    assert page.frame["pc"] == pc
    assert (await page.done("break_remove", number=main["number"]))["breaks"] == []
    changed = await page.done("break_add", condition="P1.4 == 0")
    assert changed["breaks"][0]["kind"] == "change"
    await page.done("break_remove", number=changed["number"])
    inside = await page.done("break_add", at="tick")
    await page.done("run")
    await page.until(lambda f: f["stop"] is not None)
    await page.done("break_remove", number=inside["number"])
    assert (await page.done("finish"))["stop"]["kind"] == "step"
    triggered = await page.done("trigger", wire="EOC", edge="fall")
    await page.done("run")
    frame = await page.until(lambda f: f["stop"] is not None)
    assert frame["stop"]["notes"] == ["EOC fell"] and frame["nets"]["EOC"] == 0
    assert page.edges[-1][1:] == [WIRES.index("EOC"), 0]
    assert (await page.done("trigger", wire="EOC", edge=None))["number"] is None and triggered["number"]
    assert (await page.done("run_back"))["stop"]["kind"] == "start" and page.frame["t_ps"] == 0 and page.edges == []


def test_looks_steps_breakpoints_triggers_and_the_way_back() -> None:
    async def scene(server: Server) -> None:
        async with server.page() as page:
            await look(page)
            await go(page)

    played(scene, "default", "--source", str(SOURCE))


def test_runs_paced_pauses_changes_speed_and_all_pages_see_the_same() -> None:
    async def scene(server: Server) -> None:
        async with server.page() as one, server.page() as two:
            await one.done("speed", value=0.5)
            await two.until(lambda f: f["speed"] == 0.5)
            await one.ask("run")
            running = await two.until(lambda f: f["running"] and f["t_ps"] > 10**11)
            assert running["achieved"] is None or running["achieved"] < 0.6
            refused = await two.ask("step")
            assert "pause it first" in refused["error"]
            await one.done("speed", value="max")
            await two.until(lambda f: f["t_ps"] > 2 * 10**12)
            await two.ask("pause")
            stood = await one.until(lambda f: not f["running"] and f["stop"] is not None)
            assert stood["stop"]["kind"] == "interrupted"
            await two.until(lambda f: f["t_ps"] == stood["t_ps"])
            assert abs(stood["error"][2]) < 3e-3 and stood["link"]["accepted"] > 90
            uart = stood["uart"]["uart"]
            assert uart["tx_from"] + len(uart["tx"]) // 2 == stood["link"]["octets_received"]
            assert (await two.done("watch", expressions=["P1", "nothing"]))["watch"][1]["error"]
            assert one.frame.get("watch") or await one.until(lambda f: "watch" in f)
            kept = await one.ask("edges", wires=["EOC"], from_ps=10**12, to_ps=10**12 + 10**11)
            fell = [edge for edge in kept["edges"] if edge[2] == 0]
            assert len(fell) == 20 and {edge[1] for edge in fell} == {0}  # 5 scans of four conversions
            async with server.page() as late:
                assert late.frame["t_ps"] == stood["t_ps"] and late.frame["edges"] and late.frame["uart"]["uart"]["tx"]

    played(scene)


def test_a_snapshot_is_a_board_and_can_be_viewed(tmp_path: Path) -> None:
    async def take(server: Server) -> None:
        async with server.page() as page:
            await page.run_to(0.5)
            answer = await page.ask("snapshot")
            (tmp_path / answer["name"]).write_bytes(base64.b64decode(answer["base64"]))

    played(take)
    file = next(tmp_path.iterdir())
    board = Board.from_snapshot(file)
    assert board.now_ps >= 5 * 10**11

    async def view(server: Server) -> None:
        async with server.page() as page:
            assert page.frame["t_ps"] == board.now_ps and page.frame["pc"] == board.pc
            assert "before the snapshot" in (await page.ask("save"))["error"]
            assert "before the history" in (await page.ask("to", t_ps=0))["error"]

    played(view, str(file))


REFUSED = [
    ({"do": "nonsense"}, "no command; attach, "),
    ({"do": 5}, "do: found 5"),
    ({}, "do: found None"),
    ({"do": "speed", "value": 0}, "value: found 0"),
    ({"do": "speed", "value": "fast"}, "value: found 'fast'"),
    ({"do": "speed", "value": True}, "value: found True"),
    ({"do": "to", "t_ps": -1}, "t_ps: found -1"),
    ({"do": "to", "t_ps": 1e30}, "t_ps: found "),
    ({"do": "break_add", "at": "nowhere"}, "nowhere"),
    ({"do": "break_add"}, "''"),
    ({"do": "break_remove", "number": 99}, "99: no such breakpoint"),
    ({"do": "trigger", "wire": "EOC", "edge": "up"}, "one of rise, fall, level"),
    ({"do": "trigger", "wire": "P9.9", "edge": "rise"}, "no wire of this board"),
    ({"do": "watch", "expressions": "P1"}, "a list of at most 64 strings"),
    ({"do": "source", "file": "/etc/passwd"}, "file: found '/etc/passwd'"),
    ({"do": "disassembly", "address": 0, "count": 10**6}, "count: found 1000000"),
    ({"do": "memory", "space": "disk", "address": 0, "count": 1}, "one of iram, sfr, xdata, code"),
    ({"do": "edges", "wires": ["X"], "from_ps": 0, "to_ps": 1}, "wires: found 'X'"),
    ({"do": "uart_send", "line": "usb", "hex": "00"}, "only line is 'uart'"),
    ({"do": "uart_send", "hex": "0"}, "two digits an octet"),
    ({"do": "uart_send", "text": ""}, "1 to 4096"),
    ({"do": "knob", "name": "rate.q", "value": 1}, "one of rate.x"),
    ({"do": "knob", "name": "rate.x", "value": 99}, "value: found 99"),
    ({"do": "knob", "name": "rate.x", "value": None}, "value: found None"),
    ({"do": "fault_add", "kind": "gremlin"}, "found 'gremlin'"),
    ({"do": "fault_add", "kind": "adc_noise"}, "lsb: is missing"),
    ({"do": "fault_add", "kind": "adc_noise", "lsb": 1, "net": "TXD"}, "net: means nothing to adc_noise"),
    ({"do": "fault_add", "kind": "wire_cut", "net": "P1.4", "from_s": 1e9}, "from_s: found"),
    ({"do": "fault_remove", "index": 0}, "index: found 0"),
]


def test_what_is_wrong_is_said_and_ends_nothing() -> None:
    async def scene(server: Server) -> None:
        async with server.page() as page:
            for message, said in REFUSED:
                answer = await page.ask("", **{"do": None, **message})
                assert said in answer["error"], (message, answer)
            for text in ("no json", "[1]", "[" * 100_000, '{"id": 7}'):
                await page._socket.send_str(text)
                while "error" not in (answer := await page.take()):
                    pass
            assert (await page.done("step", instruction=True))["stop"]["kind"] == "step"
            code, error = await server.end()
            assert (code, error) == (0, "")

    played(scene)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["default", "--speed", "fast"], "--speed fast: 'max' or a number"),
        (["default", "--speed", "nan"], "--speed nan"),
        (["nothing.toml"], "nothing.toml: cannot be read"),
        (["default", "--port", "70000"], "--port 70000"),
        (["default", "--set", "link.baud=1"], "link.baud"),
    ],
)
def test_bad_arguments_are_refused(arguments: list[str], said: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["view", "--no-browser", *arguments]) == 2
    assert said in capsys.readouterr().err


def test_what_was_done_is_saved_as_a_scenario_that_ins_run_repeats_bit_for_bit(tmp_path: Path) -> None:
    async def scene(server: Server) -> None:
        async with server.page() as page:
            await page.done("knob", name="rate.z", value=0.3)
            await page.run_to(0.4)
            await page.done("fault_add", kind="eoc_late", delay_s=20e-6)
            await page.done("knob", name="tilt.pitch", value=0.4)
            await page.run_to(0.9)
            await page.done("fault_remove", index=0)
            await page.done("uart_send", line="uart", text="?")
            frame = await page.run_to(1.3)
            assert frame["knobs"]["tilt.pitch"] == pytest.approx(0.4) and frame["knobs"]["rate.z"] == 0.0
            assert frame["faults"][0]["hits"] and not frame["faults"][0]["on"]
            saved = await page.ask("save")
            (tmp_path / saved["name"]).write_text(saved["toml"], encoding="utf-8")
            edges = (await page.ask("edges", from_ps=0, to_ps=frame["t_ps"]))["edges"]
            loaded = scenario.load(tmp_path / saved["name"])
            lines: list[list[int]] = []
            options = run.Options(trace=lambda wires, rows: lines.extend(rows.tolist()))
            run.execute(loaded, options)
            assert lines == [edge for edge in edges if edge[1] < 7]
            assert len(tomllib.loads(saved["toml"])["knob"]) == 2

    played(scene)


def test_an_f2812_greets_answers_breaks_and_begins_again() -> None:
    async def scene(server: Server) -> None:
        async with server.page() as page:
            assert (page.hello["kind"], page.hello["lines"]) == ("net", ["dsp.SCIA", "dsp.SCIB"])
            await page.run_to(0.1)
            greeting = bytes.fromhex(page.frame["uart"]["dsp.SCIA"]["tx"])
            assert greeting and page.frame["link"]["scia.octets_received"] == len(greeting)
            await page.done("uart_send", line="dsp.SCIA", text="A")
            await page.run_to(0.2)
            uart = page.frame["uart"]["dsp.SCIA"]
            assert (uart["rx"], uart["tx"], uart["tx_from"]) == ("41", "41", len(greeting))
            assert (await page.done("fault_add", kind="wire_cut", net="SCIRXDA", station="dsp"))["index"] == 0
            await page.done("uart_send", line="dsp.SCIA", text="B")
            await page.run_to(0.3)
            assert page.frame["uart"]["dsp.SCIA"]["tx"] == "" and page.frame["faults"][0]["hits"] == 1
            assert "forwards only" in (await page.ask("to", t_ps=0))["error"]
            assert "is no line to a host" in (await page.ask("uart_send", line="x", text="A"))["error"]
            await page.done("reset")
            assert (page.frame["t_ps"], page.frame["rewound"], page.edges) == (0, 0, [])
            await page.run_to(0.1)
            assert bytes.fromhex(page.frame["uart"]["dsp.SCIA"]["tx"]) == greeting

    played(scene, "echo")
