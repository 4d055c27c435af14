"""MCS-51 instructions as text in SDCC's assembler syntax, and the names of the special function registers.

Source: Intel, MCS-51 Programmer's Guide and Instruction Set; Atmel 2487D and 1919D for the registers.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

SFR = {
    **{f"P{n}": 0x80 + 16 * n for n in range(4)},
    **{"SP": 0x81, "DPL": 0x82, "DPH": 0x83, "DP1L": 0x84, "DP1H": 0x85, "PCON": 0x87},
    **{"TCON": 0x88, "TMOD": 0x89, "TL0": 0x8A, "TL1": 0x8B, "TH0": 0x8C, "TH1": 0x8D, "AUXR": 0x8E},
    **{"SCON": 0x98, "SBUF": 0x99, "AUXR1": 0xA2, "WDTRST": 0xA6, "IE": 0xA8, "IP": 0xB8},
    **{"T2CON": 0xC8, "T2MOD": 0xC9, "RCAP2L": 0xCA, "RCAP2H": 0xCB, "TL2": 0xCC, "TH2": 0xCD},
    **{"PSW": 0xD0, "ACC": 0xE0, "B": 0xF0},
}
"""Address of each special function register of the AT89S51 and AT89S52."""
SFR_NAMES = {address: name for name, address in SFR.items()}


@dataclass(frozen=True)
class Opcode:
    """One of the 256.

    Operands in `text`: {d} a direct address, {s} a direct source, {b} a bit, {i} {j} constants of 8 and 16 bits,
    {r} {p} {w} targets: relative, in the page, anywhere.
    """

    text: str

    @cached_property
    def operands(self) -> str:
        """Letters of the operands in the order of their octets."""
        letters = "".join(re.findall(r"\{(.)\}", self.text))
        return "sd" if letters == "ds" else letters  # MOV direct,direct has its source first

    @cached_property
    def length(self) -> int:
        """Octets, the opcode included."""
        return 1 + sum(2 if letter in "jw" else 1 for letter in self.operands)

    @property
    def branches(self) -> bool:
        """Whether it goes on at one of two places, by a condition."""
        return "{r}" in self.text and not self.text.startswith("sjmp")


_INDIRECT = ("@r0", "@r1")
_BY_ROW: tuple[tuple[str, ...], ...] = (
    ("nop", "ljmp {w}", "rr a", "inc a", "inc {d}", "inc *"),
    ("jbc {b},{r}", "lcall {w}", "rrc a", "dec a", "dec {d}", "dec *"),
    ("jb {b},{r}", "ret", "rl a", "add a,{i}", "add a,{d}", "add a,*"),
    ("jnb {b},{r}", "reti", "rlc a", "addc a,{i}", "addc a,{d}", "addc a,*"),
    ("jc {r}", "orl {d},a", "orl {d},{i}", "orl a,{i}", "orl a,{d}", "orl a,*"),
    ("jnc {r}", "anl {d},a", "anl {d},{i}", "anl a,{i}", "anl a,{d}", "anl a,*"),
    ("jz {r}", "xrl {d},a", "xrl {d},{i}", "xrl a,{i}", "xrl a,{d}", "xrl a,*"),
    ("jnz {r}", "orl c,{b}", "jmp @a+dptr", "mov a,{i}", "mov {d},{i}", "mov *,{i}"),
    ("sjmp {r}", "anl c,{b}", "movc a,@a+pc", "div ab", "mov {d},{s}", "mov {d},*"),
    ("mov dptr,{j}", "mov {b},c", "movc a,@a+dptr", "subb a,{i}", "subb a,{d}", "subb a,*"),
    ("orl c,/{b}", "mov c,{b}", "inc dptr", "mul ab", ".db 0xa5", "mov *,{d}"),
    ("anl c,/{b}", "cpl {b}", "cpl c", "cjne a,{i},{r}", "cjne a,{d},{r}", "cjne *,{i},{r}"),
    ("push {d}", "clr {b}", "clr c", "swap a", "xch a,{d}", "xch a,*"),
    ("pop {d}", "setb {b}", "setb c", "da a", "djnz {d},{r}", "djnz *,{r}"),
    ("movx a,@dptr", "movx a,@r0", "movx a,@r1", "clr a", "mov a,{d}", "mov a,*"),
    ("movx @dptr,a", "movx @r0,a", "movx @r1,a", "cpl a", "mov {d},a", "mov *,a"),
)
"""By the high nibble: opcodes x0, x2, x3, x4, x5; x6 to xF, with @r0 .. r7 for the star. x1 are the jumps in a page."""


def _opcode(code: int) -> Opcode:
    row, column = _BY_ROW[code >> 4], code & 15
    if column == 1:
        return Opcode("acall {p}" if code & 0x10 else "ajmp {p}")
    if column < 6:
        return Opcode(row[max(column - 1, 0)])
    if code in (0xD6, 0xD7):
        return Opcode(f"xchd a,{_INDIRECT[code & 1]}")
    return Opcode(row[5].replace("*", _INDIRECT[column - 6] if column < 8 else f"r{column - 8}"))


OPCODES = tuple(_opcode(code) for code in range(256))


def direct_name(address: int) -> str:
    """A direct address: the register's name, or a number."""
    return SFR_NAMES.get(address, f"0x{address:02x}")


def bit_name(bit: int) -> str:
    """A bit address: "P1.4", or "0x20.3" in RAM."""
    octet = bit & 0xF8 if bit >= 0x80 else 0x20 + (bit >> 3)
    return f"{direct_name(octet)}.{bit & 7}"


@dataclass(frozen=True)
class Instruction:
    """What stands at an address of code memory."""

    address: int
    octets: bytes
    text: str


def decode(
    code: Callable[[int], int],
    address: int,
    direct: Callable[[int], str] = direct_name,
    bit: Callable[[int], str] = bit_name,
    target: Callable[[int], str] = "0x{:04x}".format,
) -> Instruction:
    """The instruction at an address of the code memory `code`; operands are named by the three functions."""
    opcode = OPCODES[code(address)]
    octets = bytes(code(address + i & 0xFFFF) for i in range(opcode.length))
    following = address + opcode.length & 0xFFFF
    shown: dict[str, str] = {}
    at = 1
    for letter in opcode.operands:
        value = octets[at]
        if letter in "jw":
            value = octets[at] << 8 | octets[at + 1]
            at += 1
        at += 1
        if letter in "ds":
            shown[letter] = direct(value)
        elif letter == "b":
            shown[letter] = bit(value)
        elif letter in "ij":
            shown[letter] = f"#0x{value:02x}"
        elif letter == "r":
            shown[letter] = target(following + (value ^ 0x80) - 0x80 & 0xFFFF)
        elif letter == "p":
            shown[letter] = target(following & 0xF800 | (octets[0] & 0xE0) << 3 | value)
        else:
            shown[letter] = target(value)
    return Instruction(address, octets, opcode.text.format(**shown))
