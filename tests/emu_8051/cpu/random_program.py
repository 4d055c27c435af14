# SPDX-License-Identifier: MIT
"""Random MCS-51 programs that end: every opcode but A5h, forward branches, short loops, calls, and a turn count.

RAM: 00-1F banks, 20-2F bits, 30-58 data, 59-5C written by the handlers, 5D-5E turn count, 60-7F stack.
Pointers are masked before use.
Where a rule of silicon and uCsim differ (docs/fidelity.md has the sources' words), the program is written so that
the difference cannot show:
- uCsim keeps the P bit of a direct write to PSW until ACC is next written: such a write is followed by one to ACC;
- uCsim (0.6.4) does not change the register bank when RS0 or RS1 is written as a bit: PSW is written by octet only;
- uCsim takes a request flag at the boundary at which it goes up, Intel's parts poll it in the next cycle, one
  instruction later: flags that software raises are followed by NOPs, one for each handler and more. The return
  addresses on the stack differ by that, so programs with interrupts do not read what lies above the stack pointer;
- uCsim's vector takes one cycle, Intel's LCALL takes two: the comparison adds one cycle for each interrupt;
- of simultaneous requests uCsim takes the first polled, not the one of higher priority: all have one priority;
- with timer 0 in mode 3, timer 1 is stopped by its own mode 3: uCsim lets TR1 stop it, which then belongs to TH0;
- the UART, whose divider uCsim restarts at each write to SBUF, is not used; ports are compared as latches with all
  pins high.
"""

import random

ACC, B, PSW, DPL, DPH, SP, TCON, IE, IP = 0xE0, 0xF0, 0xD0, 0x82, 0x83, 0x81, 0x88, 0xA8, 0xB8
P0, P1, P2, P3 = 0x80, 0x90, 0xA0, 0xB0
DATA_END, HANDLER_CELL, GATE_CELL, TURNS_LOW, TURNS_HIGH, STACK = 0x58, 0x59, 0x5C, 0x5D, 0x5E, 0x5F
CODE_END = 0x0E80  # MOVC A,@A+PC stays inside the flash
READABLE = [ACC, B, PSW, DPL, DPH, SP, P0, P1, P2, P3, IP]
WRITABLE = [ACC, B, DPL, DPH, P0, P1, P2]
BITS_WRITABLE = [
    *range(0x00, 0x80),
    *range(0x90, 0x98),
    0xD1,
    0xD2,
    0xD5,
    0xD6,
    0xD7,
    *range(0xE0, 0xE8),
    *range(0xF0, 0xF8),
]
BITS_READABLE = BITS_WRITABLE + [0xD0, 0xD3, 0xD4, 0xB0, 0xB4]
PLAIN = [0x00, 0x03, 0x13, 0x23, 0x33, 0x04, 0x14, 0xC4, 0xD4, 0xE4, 0xF4, 0xB3, 0xC3, 0xD3, 0xA3, 0xA4, 0x84]
A_ROWS = [0x20, 0x30, 0x90, 0x40, 0x50, 0x60]  # ADD ADDC SUBB ORL ANL XRL
A_ONLY = [[x] for x in (0x03, 0x13, 0x23, 0x33, 0x04, 0x14, 0xC4, 0xD4, 0xF4, 0xB3, 0xC3, 0xD3)]

BEGIN = 0x40
NOPS = bytes(6)
# Octets of each instruction, by column of the opcode map; rows 0-F in each string.
LENGTHS = [
    "1333222223222211",
    "2" * 16,
    "3311222222222211",
    "1111333111111111",
    "1122222212131111",
    "2222222332132322",
    "1111111221231111",
    "1111111221231111",
] + ["1111111221231211"] * 8


def opcodes_of(code, halt):
    """The opcodes between BEGIN and the halt loop; what jumps pass over is code as well."""
    found, at = set(), BEGIN
    while at < halt:
        found.add(code[at])
        at += int(LENGTHS[code[at] & 15][code[at] >> 4])
    assert at == halt
    return found


class Generator:
    def __init__(self, seed, turns):
        self.rng = random.Random(seed)
        self.code = bytearray(b"\xff" * 4096)
        self.at = 0
        self.depth = 0
        self.interrupts = self.rng.random() < 0.5
        self.ram_end = STACK + 1 if self.interrupts else 0x80
        self.turns = turns

    def emit(self, *octets):
        for octet in octets:
            self.code[self.at] = octet
            self.at += 1

    def imm(self):
        return self.rng.choice([0, 1, 0x7F, 0x80, 0xFF, self.rng.randrange(256), self.rng.randrange(256)])

    def source(self):
        return self.rng.choice(READABLE) if self.rng.random() < 0.4 else self.rng.randrange(self.ram_end)

    def target(self):
        return self.rng.choice(WRITABLE) if self.rng.random() < 0.3 else self.rng.randrange(DATA_END + 1)

    def row(self):
        return self.rng.choice(A_ROWS)

    def pointer(self):
        """R0 or R1 of whatever bank, into 00-3F or 19-58."""
        i = self.rng.randrange(2)
        self.emit(0x54, 0x3F)
        if self.rng.random() < 0.5:
            self.emit(0x24, 0x19)
        self.emit(0xF8 + i)
        return i

    def plain(self):
        self.emit(self.rng.choice(PLAIN))

    def immediate(self):
        self.emit(self.rng.choice([self.row() + 4, 0x74]), self.imm())

    def direct(self):
        r = self.rng
        kind = r.randrange(9)
        if kind == 0:
            self.emit(r.choice([self.row() + 5, 0xE5]), self.source())
        elif kind == 1:
            self.emit(r.choice([0x05, 0x15, 0xC5, 0xF5, 0x42, 0x52, 0x62]), self.target())
        elif kind == 2:
            self.emit(r.choice([0x43, 0x53, 0x63, 0x75]), self.target(), self.imm())
        elif kind == 3:
            self.emit(0x85, self.source(), self.target())
        elif kind == 4:
            self.emit(0x88 + r.randrange(8), self.target())
        elif kind == 5:
            self.emit(0xA8 + r.randrange(8), self.source())
        elif kind == 6:
            self.emit(0x90, self.imm(), self.imm())
        elif kind == 7:
            write = r.choice(
                [(0x75, PSW, self.imm()), (0xF5, PSW), (0x42, PSW), (0x53, PSW, self.imm()), (0xC5, PSW), (0x88, PSW)]
            )
            self.emit(*write, 0x74, self.imm())
        else:
            self.emit(0x75, B, r.randrange(256), r.choice([0x84, 0xA4]))

    def register(self):
        r, n = self.rng, self.rng.randrange(8)
        if r.random() < 0.2:
            self.emit(0x78 + n, self.imm())
        else:
            self.emit(r.choice([self.row() + 8, 0x08, 0x18, 0xC8, 0xE8, 0xF8]) + n)

    def indirect(self):
        r, i = self.rng, self.pointer()
        kind = r.randrange(6)
        if r.random() < 0.5:
            self.emit(0xE5, self.source())
        if kind == 0:
            self.emit(0x76 + i, self.imm())
        elif kind == 1:
            self.emit(0x86 + i, self.target())
        elif kind == 2:
            self.emit(0xA6 + i, self.source())
        else:
            self.emit(r.choice([self.row() + 6, 0x06, 0x16, 0xC6, 0xD6, 0xE6, 0xF6]) + i)

    def bit(self):
        r = self.rng
        if r.random() < 0.5:
            self.emit(r.choice([0x72, 0x82, 0xA0, 0xB0, 0xA2]), r.choice(BITS_READABLE))
        else:
            self.emit(r.choice([0x92, 0xB2, 0xC2, 0xD2]), r.choice(BITS_WRITABLE))

    def memory(self):
        """MOVC within the flash; MOVX reads FFh and writes FFh (uCsim's external RAM is filled with it)."""
        r = self.rng
        kind = r.randrange(5)
        if kind == 0:
            self.emit(0x83)
        elif kind == 1:
            self.emit(0x90, r.randrange(0x0E), r.randrange(256), 0x93)
        elif kind == 2:
            self.emit(r.choice([0xE0, 0xE2, 0xE3]))
        else:
            self.emit(0x74, 0xFF, r.choice([0xF0, 0xF2, 0xF3]))

    def body(self, longest=4):
        for _ in range(self.rng.randrange(1, longest)):
            self.block(nested=True)

    def branch(self):
        r = self.rng
        kind = r.randrange(8)
        if kind == 0:
            self.emit(r.choice([0x40, 0x50, 0x60, 0x70, 0x80]))
        elif kind == 1:
            self.emit(r.choice([0x20, 0x30]), r.choice(BITS_READABLE))
        elif kind == 2:
            self.emit(0x10, r.choice(BITS_WRITABLE))
        elif kind == 3:
            self.emit(r.choice([0xB4, 0xB8 + r.randrange(8)]), self.imm())
        elif kind == 4:
            self.emit(0xB5, self.source())
        elif kind == 5:
            self.emit(0xB6 + self.pointer(), self.imm())
        elif kind == 6:
            self.emit(0xD5, self.target())
        else:
            self.emit(0xD8 + r.randrange(8))
        place = self.at
        self.emit(0)
        self.body()
        assert self.at - place - 1 < 128
        self.code[place] = self.at - place - 1

    def jump(self):
        """LJMP, AJMP or JMP @A+DPTR over a body that never runs."""
        start = self.at
        kind = self.rng.randrange(3)
        self.at += (3, 2, 6)[kind]
        self.body()
        end = self.at
        if kind == 1 and (end ^ (start + 2)) & 0xF800:
            kind = 0
            self.at = start + 3
            self.body()
            end = self.at
        self.at = start
        if kind == 0:
            self.emit(0x02, end >> 8, end & 0xFF)
        elif kind == 1:
            self.emit(0x01 | (end >> 3 & 0xE0), end & 0xFF)
        else:
            offset = self.rng.randrange(min(256, end))
            self.emit(0x90, (end - offset) >> 8, (end - offset) & 0xFF, 0x74, offset, 0x73)
        self.at = end

    def call(self):
        """SJMP over; sub: body, RET or RETI; over: LCALL or ACALL sub."""
        self.emit(0x80, 0)
        sub = self.at
        self.depth += 2
        self.body()
        self.depth -= 2
        self.emit(self.rng.choice([0x22, 0x22, 0x32]))
        self.code[sub - 1] = self.at - sub
        if self.rng.random() < 0.5 and not ((self.at + 2) ^ sub) & 0xF800:
            self.emit(0x11 | (sub >> 3 & 0xE0), sub & 0xFF)
        else:
            self.emit(0x12, sub >> 8, sub & 0xFF)

    def stack(self):
        self.emit(0xC0, self.rng.choice([x for x in READABLE if x != SP] + list(range(self.ram_end))))
        self.depth += 1
        self.body()
        self.depth -= 1
        target = self.rng.choice([self.target(), PSW])
        self.emit(0xD0, target)
        if target == PSW:
            self.emit(0x74, self.imm())

    def loop(self):
        n = self.rng.randrange(8)
        self.emit(0x78 + n, self.rng.randrange(1, 40))
        start = self.at
        for _ in range(self.rng.randrange(1, 6)):
            self.emit(*self.rng.choice(A_ONLY))
        self.emit(0xD8 + n, (start - self.at - 2) & 0xFF)

    def request(self):
        """Raise requests by software: order of polling, one instruction after RETI, the gate after a write to IE."""
        flags = self.rng.choice([0x20, 0x80, 0x02, 0x08, 0xA0, 0x2A, 0xAA])
        kind = self.rng.randrange(3)
        if kind == 0:
            self.emit(0x43, TCON, flags)
        elif kind == 1:
            self.emit(0xD2, self.rng.choice([0x98, 0x99]))
        else:
            self.emit(0x75, IE, 0x00, 0x43, TCON, flags, 0x75, IE, 0x9F, 0x05, GATE_CELL)
        self.emit(*NOPS)
        self.emit(0x75, IP, self.rng.choice([0x00, 0x1F]), 0x00)

    def block(self, nested=False):
        simple = [self.plain, self.immediate, self.direct, self.register, self.indirect, self.bit, self.memory]
        deep = self.depth >= 12 or self.at > CODE_END - 400
        if nested and (deep or self.rng.random() < 0.85):
            self.rng.choice(simple)()
            return
        if nested:
            self.depth += 3  # nesting is bounded by the same count as the stack
            self.rng.choice([self.stack, self.loop])()
            self.depth -= 3
            return
        flow = [self.branch, self.branch, self.jump, self.call, self.stack, self.loop]
        if self.interrupts:
            flow.append(self.request)
        self.rng.choice(simple * 3 + flow)()

    def handlers(self):
        for n in range(5):
            self.at = 8 * n + 3
            if n == 4:
                self.emit(0xC2, 0x98, 0xC2, 0x99)
            self.emit(0x75, HANDLER_CELL + 1, n)
            self.emit(*((0x85, GATE_CELL, HANDLER_CELL + 2) if n == 1 else (0x05, HANDLER_CELL)), 0x32)

    def prologue(self):
        self.emit(0x75, SP, STACK)
        for address in range(0x7F, -1, -1):
            if address not in (TURNS_LOW, TURNS_HIGH):
                self.emit(0x75, address, self.rng.randrange(256))
        self.emit(0x75, TURNS_LOW, self.turns & 0xFF or 1, 0x75, TURNS_HIGH, (self.turns >> 8) + 1)
        self.emit(0x90, self.imm(), self.imm(), 0x75, B, self.imm())
        mode0, gates = self.rng.randrange(4), self.rng.choice([0x00, 0x08, 0x80, 0x88])
        mode1 = 3 if mode0 == 3 else self.rng.randrange(3)
        self.emit(0x75, 0x89, gates | mode1 << 4 | mode0)  # TMOD, no counter pins
        for register in (0x8A, 0x8B, 0x8C, 0x8D):
            self.emit(0x75, register, self.rng.randrange(256))
        if self.interrupts:
            self.emit(0x75, TCON, 0x05, 0x75, IE, 0x9F)
        else:
            self.emit(0x75, TCON, 0x55)

    def program(self):
        """-> (image, address of the final jump to itself, RAM that is to be compared)"""
        self.handlers()
        self.at = 0
        self.emit(0x02, BEGIN >> 8, BEGIN & 0xFF)
        self.at = BEGIN
        self.prologue()
        start = self.at
        while self.at < CODE_END - 300:
            self.block()
        # DJNZ low, again; DJNZ high, again; stop; again: LJMP start
        self.emit(0xD5, TURNS_LOW, 6, 0xD5, TURNS_HIGH, 3, 0x02, (self.at + 12) >> 8, (self.at + 12) & 0xFF)
        self.emit(0x02, start >> 8, start & 0xFF)
        self.emit(0x53, TCON, 0xAF, 0x75, IE, 0x00)
        halt = self.at
        self.emit(0x80, 0xFE)
        return bytes(self.code), halt, self.ram_end
