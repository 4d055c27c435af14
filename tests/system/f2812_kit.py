"""Programs for the F2812 board from a few lines of C, as a user builds them."""

import subprocess
from pathlib import Path

from conftest import ROOT

WALL_LIMIT_S = 120
CARELESS = """
    SysCtrlRegs.PLLCR.all = 5; // protected, and no EALLOW before it
    EALLOW;
    SysCtrlRegs.WDCR = 0x0068;
    SysCtrlRegs.PCLKCR.bit.ADCENCLK = 1;
    SysCtrlRegs.SCSR = AdcRegs.ADCTRL1.all;
    EDIS;
    for (;;) { }
"""
"""A main() that does something wrong and uses what is not modelled."""


def build(body: str, folder: Path, name: str = "app") -> Path:
    """A program whose main() is these lines."""
    source, out = folder / f"{name}.c", folder / f"{name}.f2812"
    source.write_text(f'#include "DSP281x_Device.h"\nvoid main(void)\n{{\n{body}\n}}\n', encoding="ascii")
    command = [ROOT / "emu/f2812_sci/f2812-cc", source, "-o", out]
    done = subprocess.run([*map(str, command)], capture_output=True, text=True, timeout=WALL_LIMIT_S)
    assert done.returncode == 0, done.stdout + done.stderr
    return out
