"""Names of the special function registers: AT89S51 (Atmel 2487D) and AT89S52 (1919D)."""

import difflib

from libins.errors import UsageError

SFRS = {
    **{"P0": 0x80, "SP": 0x81, "DPL": 0x82, "DPH": 0x83, "DP0L": 0x82, "DP0H": 0x83, "DP1L": 0x84, "DP1H": 0x85},
    **{"PCON": 0x87, "TCON": 0x88, "TMOD": 0x89, "TL0": 0x8A, "TL1": 0x8B, "TH0": 0x8C, "TH1": 0x8D, "AUXR": 0x8E},
    **{"P1": 0x90, "SCON": 0x98, "SBUF": 0x99, "P2": 0xA0, "AUXR1": 0xA2, "WDTRST": 0xA6, "IE": 0xA8, "P3": 0xB0},
    **{"IP": 0xB8, "T2CON": 0xC8, "T2MOD": 0xC9, "RCAP2L": 0xCA, "RCAP2H": 0xCB, "TL2": 0xCC, "TH2": 0xCD},
    **{"PSW": 0xD0, "ACC": 0xE0, "B": 0xF0},
}


def address(name: str) -> int:
    """Of a register by its data sheet's name. Raises UsageError."""
    if name.upper() in SFRS:
        return SFRS[name.upper()]
    near = difflib.get_close_matches(name.upper(), SFRS, n=1)
    hint = f"did you mean {near[0]}?" if near else f"there are {', '.join(SFRS)}"
    raise UsageError(f"{name}: no special function register; {hint}")
