r"""Keywords for Robot Framework, by the names that Renode's users know.

    *** Settings ***
    Library           libins.robot
    Test Setup        Reset Emulation

    *** Test Cases ***
    Reads A Volt And A Quarter
        Create Machine           firmware=meter.ihx
        Start Emulation
        Wait For Line On Uart    READY
        Set Volts                0    1.25
        Write To Uart            ?
        Wait For Line On Uart    AIN0 (\\d+) mV    treatAsRegex=true

Time is simulated, and passes only while a keyword waits or runs; a timeout is simulated seconds.
"""

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from robot.api import logger
from robot.api.deco import keyword, library

from libins.board import Board, Snapshot
from libins.errors import UsageError
from libins.f2812_board import F2812Board, HostEnd, is_f2812
from libins.net_scenario import NO_STATE

UART_TIMEOUT_S = 8.0
"""As Renode's."""
UARTS = ("uart", "sysbus.uart")
LINE_END = "\r"
COMMANDS = {
    r"sysbus LoadHEX @?(?P<path>.+)": "another image, from power-on",
    r"machine Reset": "pulse the RST pin",
    r'emulation RunFor "(?P<seconds>[0-9.]+)"': "let time pass",
    r"cpu PC": "address of the next instruction",
    r"start": "nothing: time passes while keywords wait",
    r"pause": "nothing",
}


@dataclass(frozen=True)
class Found:
    """What a Wait For keyword gives: ${found.line}, ${found.groups}, ${found.timestamp} [s]."""

    line: str
    groups: tuple[str, ...]
    timestamp: float


@library(scope="SUITE", doc_format="TEXT")
class robot:  # noqa: N801
    """Keywords for an emulated board; Robot Framework looks for a class of the name of its module."""

    def __init__(self) -> None:
        """No machine yet."""
        self._machine: dict[str, Any] | None = None
        self._board: Board | F2812Board | None = None
        self._is_f2812 = False
        self._uart = ""
        self._timeout_s = UART_TIMEOUT_S
        self._provided: dict[str, Snapshot] = {}

    @property
    def running(self) -> Board | F2812Board:
        """The running board. Raises UsageError before Start Emulation."""
        if self._board is None:
            raise UsageError("there is no running board: Create Machine and Start Emulation first")
        return self._board

    @property
    def board(self) -> Board:
        """The running 8051 board. Raises UsageError for another."""
        if not isinstance(self.running, Board):
            raise UsageError(f"this keyword is of the 8051 board: {NO_STATE}")
        return self.running

    @property
    def f2812(self) -> F2812Board:
        """The running F2812 board. Raises UsageError for another."""
        if not isinstance(self.running, F2812Board):
            raise UsageError("this keyword is of boards with an F2812; the 8051 has Get Variable")
        return self.running

    @property
    def end(self) -> Board | HostEnd:
        """Who plays the host of the UART in use."""
        board = self.running
        if isinstance(board, Board):
            return board
        if self._uart and self._uart not in board.hosts:
            raise UsageError(f"{self._uart}: this board has the UARTs {', '.join(board.hosts)}")
        return board.hosts[self._uart] if self._uart else board.host

    @keyword
    def reset_emulation(self) -> None:
        """Forget the machine; what was provided stays."""
        if self._board is not None:
            self._board.close()
        self._machine = self._board = None
        self._uart = ""
        self._timeout_s = UART_TIMEOUT_S

    @keyword
    def create_machine(self, scenario: str | None = None, **keys: str) -> None:
        """A board: a scenario by name or file, or firmware=F.ihx, F.f2812; more keys as of Board, part=at89s52."""
        numbers = {key: int(value) if re.fullmatch(r"\d+", value) else value for key, value in keys.items()}
        self._machine = {"scenario_file": scenario, **numbers}
        self._is_f2812 = is_f2812(scenario or keys.get("firmware", ""))
        self._board = None

    @keyword
    def start_emulation(self) -> None:
        """Power on."""
        if self._machine is None:
            raise UsageError("Start Emulation: Create Machine first")
        self._board = F2812Board(**self._machine) if self._is_f2812 else Board(**self._machine)

    @keyword
    def execute_command(self, command: str) -> str:
        """A few commands of Renode's monitor: see COMMANDS in libins/robot.py."""
        for pattern in COMMANDS:
            if match := re.fullmatch(pattern, command.strip()):
                return self._command(pattern.split()[-2:], match)
        raise UsageError(
            f"Execute Command {command}: known are: {'; '.join(re.sub(r'[(?<>)]', '', c) for c in COMMANDS)}"
        )

    def _command(self, words: list[str], match: re.Match[str]) -> str:
        if "LoadHEX" in words:
            self.board.load(Path(match["path"]))
        elif "Reset" in words:
            self.running.reset()
        elif "RunFor" in words:
            self.running.run_for(float(match["seconds"]))
        elif "PC" in words:
            return f"{self.board.pc:#06x}"
        return ""

    @keyword
    def create_terminal_tester(self, uart: str = "uart", timeout: float = UART_TIMEOUT_S) -> int:
        """The one UART of the 8051 board, or scia, scib ... of an F2812, used from now on; sets the timeout [s]."""
        name = uart.removeprefix("sysbus.")
        if uart not in UARTS and not self._is_f2812:
            raise UsageError(f"Create Terminal Tester {uart}: this board has one UART, named uart")
        self._uart = "" if uart in UARTS else name
        self._timeout_s = timeout
        return 0

    @keyword
    def set_default_uart_timeout(self, timeout: float) -> None:
        """Of the keywords that wait for the UART [s]."""
        self._timeout_s = timeout

    def _wait(self, pattern: str, timeout: float | None) -> Found:
        match = self.end.expect(
            re.compile(pattern.encode("latin-1"), re.MULTILINE), self._timeout_s if timeout is None else timeout
        )
        groups = tuple((group or b"").decode("latin-1") for group in match.groups())
        found = Found(match[0].decode("latin-1").rstrip("\r\n"), groups, self.running.now_s)
        logger.info(f"{found.timestamp:.6f} s: {found.line!r}")
        return found

    @keyword
    def wait_for_line_on_uart(self, content: str, timeout: float | None = None, treatAsRegex: bool = False) -> Found:  # noqa: N803
        """Until a whole line has come that contains the text, or matches the pattern somewhere."""
        wanted = content if treatAsRegex else re.escape(content)
        return self._wait(rf"[^\r\n]*(?:{wanted})[^\r\n]*\r?\n", timeout)

    @keyword
    def wait_for_prompt_on_uart(self, content: str, timeout: float | None = None, treatAsRegex: bool = False) -> Found:  # noqa: N803
        """As Wait For Line On Uart, of a text that no line end follows."""
        return self._wait(content if treatAsRegex else re.escape(content), timeout)

    @keyword
    def should_not_be_on_uart(self, content: str, timeout: float | None = None, treatAsRegex: bool = False) -> None:  # noqa: N803
        """Fails when it comes within the time, which passes; what comes is read."""
        self.running.run_for(self._timeout_s if timeout is None else timeout)
        came = self.end.expect(re.compile(b".*", re.DOTALL), 0)[0].decode("latin-1")
        if re.search(content if treatAsRegex else re.escape(content), came, re.MULTILINE):
            raise AssertionError(f"{content!r} came on the UART: {came!r}")

    @keyword
    def test_uart_is_idle(self, timeout: float) -> None:
        """Fails when an octet comes within the time."""
        before = len(self.end.unread)
        self.running.run_for(timeout)
        if came := self.end.unread[before:]:
            raise AssertionError(f"{came!r} came on the UART within {timeout:g} s")

    @keyword
    def write_to_uart(self, content: str) -> None:
        """Octets to the board, as Latin-1."""
        self.end.send(content.encode("latin-1"))

    @keyword
    def write_line_to_uart(self, content: str = "", lineEnding: str = LINE_END) -> None:  # noqa: N803
        """And a carriage return after them."""
        self.end.send((content + lineEnding).encode("latin-1"))

    @keyword
    def write_char_on_uart(self, character: str) -> None:
        """One of them."""
        self.end.send(character.encode("latin-1"))

    @keyword
    def run_for(self, seconds: float) -> None:
        """Let time pass."""
        self.running.run_for(seconds)

    @keyword
    def set_volts(self, channel: int, volts: float) -> None:
        """At an analogue input, from now on."""
        self.board.volts[channel] = volts

    @keyword
    def set_pin(self, name: str, level: bool | None) -> None:
        """Drive a port pin (P3.2) from outside; None lets go."""
        self.board.pins[name] = level

    @keyword
    def pin_should_be(self, name: str, level: bool, timeout: float = 0.0) -> None:
        """At once, or within the time."""
        board = self.board
        try:
            board.run_until(lambda: board.pin(name) is level, within_s=timeout, every_s=1e-4)
        except TimeoutError:
            raise AssertionError(f"{name} did not become {level} within {timeout:g} s; {board.where()}") from None

    @keyword
    def get_variable(self, name: str) -> Any:
        """A C variable, by the .cdb beside the image."""
        return self.board.variables[name]

    @keyword
    def set_variable_of_firmware(self, name: str, value: int) -> None:
        """Write a C variable."""
        self.board.variables[name] = value

    @keyword
    def get_register(self, name: str) -> int:
        """Of an F2812, by TI's name, without the side effects of a read."""
        return self.f2812.registers[name]

    @keyword
    def run_until_register_access(
        self, register: str, access: str = "any", value: int | None = None, timeout: float = 1.0
    ) -> Any:
        """Of an F2812: until its firmware reads, writes or does any of both; gives t_ps, register, access, value."""
        return self.f2812.run_until(register=register, access=access, value=value, within_s=timeout)

    @keyword
    def provides(self, state: str) -> None:
        """Keep the board as it is under a name."""
        self._provided[state] = self.board.snapshot()

    @keyword
    def requires(self, state: str) -> None:
        """The board as it was when it was kept."""
        if state not in self._provided:
            raise UsageError(f"Requires {state}: no test before this one has it in Provides")
        self._board = Board.from_snapshot(self._provided[state])
