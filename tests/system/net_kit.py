"""Nets for the tests: the board programs that come with the package, and the acquisition board with its host."""

from pathlib import Path
from typing import Any

import libins
from libins import _run, machine, motions, scenario

FIRMWARE = Path(libins.__file__).parent / "firmware"
ECHO = str(FIRMWARE / "echo.f2812")
GREETING = b"echo ready\r\n"
PS_PER_S = 10**12
MS = PS_PER_S // 1000
BAUD = 9600
BIT_PS = round(PS_PER_S / BAUD)
BRR = 487
"""What echo.c sets: its bit is 8 (BRR + 1) periods of 37.5 MHz."""
ECHO_BIT_PS = 8 * (BRR + 1) * PS_PER_S / 37_500_000


def echo_net(seed: int = 1, program: str = ECHO, **line: Any) -> Any:
    """The echo firmware on SCI-A, a host on its line."""
    net = _run.Net(seed)
    net.f2812("dsp", program)
    net.host("pc", BAUD)
    net.line("dsp.SCIA", "pc", BAUD, **line)
    return net


def add_acquisition(net: Any, seed: int = 1) -> Any:
    """The 8051 board with its default firmware, and its host, on a line of their own."""
    loaded = scenario.read(scenario.Document(scenario.find("default")), None)
    tables = loaded.tables
    gyro = machine.gyro_of(tables.gyro, seed)
    config = _run.RunConfig()
    config.seed = seed
    config.crystal_hz = tables.clock_hz
    config.baud = tables.link.baud
    for address, octets in loaded.image:
        config.add_segment(address, octets)
    board = net.acq("acq", config, motions.motion_of(loaded), gyro)
    n = tables.nav
    assert n is not None
    nav = _run.nav(n.period_s, n.block_len, n.sequence, n.form, n.rate_order, n.skew_s, gyro)
    net.host_codes("navd", tables.link.baud, "acq", nav)
    net.line("acq", "navd", tables.link.baud)
    return board


def go(net: Any, to_s: float, steps: int = 1) -> None:
    """To that instant, in so many calls."""
    begin, end = net.now_ps, round(to_s * PS_PER_S)
    for k in range(1, steps + 1):
        assert net.until(begin + (end - begin) * k // steps)


def fault(kind: str, **keys: Any) -> Any:
    made = _run.Fault(kind)
    for key, value in keys.items():
        setattr(made, key, value)
    return made
