"""The disassembler against SDCC's assembler: what is printed, assembled again, gives the same octets."""

import random
import subprocess
from pathlib import Path

import pytest
from intelhex import IntelHex

from libins import disasm

SEED = 20260
PROGRAMS = 20
RESERVED = 0xA5


def assembled(text: list[str], folder: Path) -> IntelHex:
    """The octets, from SDCC's assembler and linker."""
    (folder / "program.asm").write_text("\t.area CODE (ABS,CODE)\n" + "\n".join(text) + "\n", encoding="ascii")
    for command in (["sdas8051", "-o", "program.asm"], ["sdld", "-i", "program"]):
        done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder)
        assert done.returncode == 0, done.stdout + done.stderr
    return IntelHex(str(folder / "program.ihx"))


@pytest.mark.parametrize("program", range(PROGRAMS))
def test_every_opcode_assembles_back(tmp_path, program):
    """All 256 in random order with random operands; numbers in place of names, which the assembler does not know."""
    chance = random.Random(SEED + program)
    memory = bytearray()
    begins = []
    for code in chance.sample(range(256), 256):
        begins.append(len(memory))
        memory += bytes([code]) + chance.randbytes(disasm.OPCODES[code].length - 1)
    plain = "0x{:02x}".format
    text = []
    for begin in begins:
        here = disasm.decode(
            memory.__getitem__, begin, plain, plain, lambda to, at=begin: f". + {(to - at + 0x8000) % 0x10000 - 0x8000}"
        )
        text.append(f"\t.org 0x{begin:04x}\n\t{here.text}")
    octets = assembled(text, tmp_path)
    for begin, end, line in zip(begins, [*begins[1:], len(memory)], text, strict=True):
        assert bytes(octets.tobinarray(start=begin, end=end - 1)) == memory[begin:end], f"{line}, program {program}"


def test_names():
    def shown(*octets: int, at: int = 0x0100) -> str:
        return disasm.decode(lambda address: octets[address - at], at).text

    assert shown(0x75, 0x90, 0xFF) == "mov P1,#0xff"
    assert shown(0x85, 0x30, 0x99) == "mov SBUF,0x30"
    assert shown(0xC2, 0x94) == "clr P1.4"
    assert shown(0xD2, 0x0B) == "setb 0x21.3"
    assert shown(0x80, 0xFE) == "sjmp 0x0100"
    assert shown(0xE1, 0x23, at=0x17FE) == "ajmp 0x1f23"
    assert shown(RESERVED) == ".db 0xa5"


def test_conditional_branches():
    branching = {code for code, opcode in enumerate(disasm.OPCODES) if opcode.branches}
    assert branching == {0x10, 0x20, 0x30, 0x40, 0x50, 0x60, 0x70, 0xD5, *range(0xB4, 0xC0), *range(0xD8, 0xE0)}
