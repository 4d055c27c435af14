/// \file   cpu/ops.h
/// \brief  Every opcode of the MCS-51 once: OP(opcode, octets, machine cycles, body). Intel MCS-51 Programmer's Guide.
///
/// An engine includes this inside its switch (or table) and supplies:
///   OP, OP2, OP8      one opcode; two with N = 0, 1 (@Ri); eight with N = 0..7 (Rn)
///   OP_PAGE           the eight opcodes of AJMP or ACALL
///   PC                address of the next instruction; O1, O2 operand octets; A, CY (0 or 1), FX (see fx)
///   RN_GET(x), RN_SET(x)  register N;  RI  register N as a pointer;  BRANCH_IF(c, o)  conditional branch
///   READ, LATCH(x,d)  x = direct d, seen from the pins or from the latches;  WRITE(d,v)
///   IREAD(x,i)        x = RAM at i;  IWRITE(i,v);  PUSHED(i,v): by the stack;  CODE(x,a);  XREAD(x,a);  XWRITE(a)
///   DPTR, DPTR_SET    the selected data pointer;  RETI_DONE;  RESERVED;  SPIN_IF(c): the instruction jumps to itself
/// SPDX-License-Identifier: MIT

#define U8(x)       ((uint8_t)(x))
#define U16(x)      ((uint16_t)(x))
#define GOTO(t)     (PC = U16(t))
#define BRANCH(o)   (PC = U16(PC + (uint16_t)(int8_t)(o)))
#define BIT_BYTE(b) ((b) < 0x80 ? 0x20u + ((b) >> 3) : (b)&0xF8u)
#define BIT_MASK(b) (1u << ((b)&7u))
#define CARRY(x)    (CY = (x))

#define ADD(x, c)                                                                                                      \
    {                                                                                                                  \
        const unsigned x_ = (x), r_ = A + x_ + (c);                                                                    \
        FX = A ^ x_ ^ r_;                                                                                              \
        CARRY(r_ >> 8);                                                                                                \
        A = U8(r_);                                                                                                    \
    }
#define SUBB(x)                                                                                                        \
    {                                                                                                                  \
        const unsigned x_ = (x), r_ = A - x_ - CY;                                                                     \
        FX = A ^ x_ ^ r_;                                                                                              \
        CARRY((r_ >> 8) & 1u);                                                                                         \
        A = U8(r_);                                                                                                    \
    }
#define CJNE(a, x, rel)                                                                                                \
    {                                                                                                                  \
        const unsigned a_ = (a), x_ = (x);                                                                             \
        CARRY(a_ < x_);                                                                                                \
        BRANCH_IF(a_ != x_, rel);                                                                                      \
    }
/// The operand forms of A op x: immediate, direct, @Ri, Rn.
#define ALU(base, operation)                                                                                           \
    OP(base + 4, 2, 1, operation(O1))                                                                                  \
    OP(base + 5, 2, 1, unsigned v; READ(v, O1); operation(v))                                                          \
    OP2(base + 6, 1, 1, unsigned v; IREAD(v, RI); operation(v))                                                        \
    OP8(base + 8, 1, 1, unsigned v; RN_GET(v); operation(v))
#define LOGIC(base, op)                                                                                                \
    OP(base + 2, 2, 1, unsigned v; LATCH(v, O1); WRITE(O1, v op A))                                                    \
    OP(base + 3, 3, 2, unsigned v; LATCH(v, O1); WRITE(O1, v op O2))                                                   \
    OP(base + 4, 2, 1, A = U8(A op O1))                                                                                \
    OP(base + 5, 2, 1, unsigned v; READ(v, O1); A = U8(A op v))                                                        \
    OP2(base + 6, 1, 1, unsigned v; IREAD(v, RI); A = U8(A op v))                                                      \
    OP8(base + 8, 1, 1, unsigned v; RN_GET(v); A = U8(A op v))
/// INC and DEC by d of direct, @Ri, Rn.
#define STEP(base, d)                                                                                                  \
    OP(base + 4, 1, 1, A = U8(A + d))                                                                                  \
    OP(base + 5, 2, 1, unsigned v; LATCH(v, O1); WRITE(O1, v + d))                                                     \
    OP2(base + 6, 1, 1, unsigned v; IREAD(v, RI); IWRITE(RI, v + d))                                                   \
    OP8(base + 8, 1, 1, unsigned v; RN_GET(v); RN_SET(v + d))
#define BIT_READ(b)                                                                                                    \
    unsigned v;                                                                                                        \
    READ(v, BIT_BYTE(b));                                                                                              \
    v = (v >> ((b)&7u)) & 1u
#define BIT_CHANGE(b, expression)                                                                                      \
    unsigned v;                                                                                                        \
    LATCH(v, BIT_BYTE(b));                                                                                             \
    WRITE(BIT_BYTE(b), expression)
#define PUSH(v)                                                                                                        \
    {                                                                                                                  \
        const unsigned value_ = (v), at_ = U8(mem[SP] + 1u);                                                           \
        mem[SP] = U8(at_);                                                                                             \
        PUSHED(at_, value_);                                                                                           \
    }
#define POP(x)                                                                                                         \
    {                                                                                                                  \
        IREAD(x, mem[SP]);                                                                                             \
        mem[SP] = U8(mem[SP] - 1u);                                                                                    \
    }
#define CALL(t)                                                                                                        \
    {                                                                                                                  \
        const unsigned target_ = (t);                                                                                  \
        PUSH(PC & 0xFFu);                                                                                              \
        PUSH(PC >> 8);                                                                                                 \
        GOTO(target_);                                                                                                 \
    }
#define RETURN                                                                                                         \
    {                                                                                                                  \
        unsigned h_, l_;                                                                                               \
        POP(h_);                                                                                                       \
        POP(l_);                                                                                                       \
        GOTO(h_ << 8 | l_);                                                                                            \
    }
/// AC is kept: it is bit 4 of FX; bit 7 alone makes OV.
#define SET_OV(x) (FX = (FX & 0x10u) | ((x) ? 0x80u : 0u))
#define ADD0(x)   ADD(x, 0u)
#define ADDC(x)   ADD(x, CY)

// clang-format off
OP(0x00, 1, 1, )
OP_PAGE(0x01, 2, 2, SPIN_IF(PAGE_TARGET == PC - 2u) GOTO(PAGE_TARGET))
OP_PAGE(0x11, 2, 2, CALL(PAGE_TARGET))
OP(0x02, 3, 2, const unsigned t = O1 * 256u + O2; SPIN_IF(t == PC - 3u) GOTO(t))
OP(0x12, 3, 2, CALL(O1 * 256u + O2))
OP(0x22, 1, 2, RETURN)
OP(0x32, 1, 2, RETURN RETI_DONE)
OP(0x73, 1, 2, GOTO(A + DPTR))
OP(0x80, 2, 2, SPIN_IF(O1 == 0xFE) BRANCH(O1))

OP(0x10, 3, 2, const unsigned rel = O2; unsigned v; LATCH(v, BIT_BYTE(O1));
    if (v & BIT_MASK(O1)) { WRITE(BIT_BYTE(O1), v & ~BIT_MASK(O1)) } BRANCH_IF(v & BIT_MASK(O1), rel))
OP(0x20, 3, 2, BIT_READ(O1); BRANCH_IF(v, O2))
OP(0x30, 3, 2, BIT_READ(O1); BRANCH_IF(!v, O2))
OP(0x40, 2, 2, BRANCH_IF(CY, O1))
OP(0x50, 2, 2, BRANCH_IF(!CY, O1))
OP(0x60, 2, 2, BRANCH_IF(!A, O1))
OP(0x70, 2, 2, BRANCH_IF(A, O1))
OP(0xB4, 3, 2, CJNE(A, O1, O2))
OP(0xB5, 3, 2, unsigned v; READ(v, O1); CJNE(A, v, O2))
OP2(0xB6, 3, 2, unsigned v; IREAD(v, RI); CJNE(v, O1, O2))
OP8(0xB8, 3, 2, unsigned v; RN_GET(v); CJNE(v, O1, O2))
OP(0xD5, 3, 2, const unsigned rel = O2; unsigned v; LATCH(v, O1); v = U8(v - 1u); WRITE(O1, v); BRANCH_IF(v, rel))
OP8(0xD8, 2, 2, unsigned v; RN_GET(v); v = U8(v - 1u); RN_SET(v); BRANCH_IF(v, O1))

STEP(0x00, 1u)
STEP(0x10, 0xFFu)
ALU(0x20, ADD0)
ALU(0x30, ADDC)
ALU(0x90, SUBB)
LOGIC(0x40, |)
LOGIC(0x50, &)
LOGIC(0x60, ^)
OP(0x03, 1, 1, A = U8(A >> 1 | A << 7))
OP(0x13, 1, 1, const unsigned c = A & 1u; A = U8(A >> 1 | CY << 7); CARRY(c))
OP(0x23, 1, 1, A = U8(A << 1 | A >> 7))
OP(0x33, 1, 1, const unsigned c = A >> 7; A = U8((unsigned)A << 1 | CY); CARRY(c))
OP(0xC4, 1, 1, A = U8(A << 4 | A >> 4))
OP(0xE4, 1, 1, A = 0)
OP(0xF4, 1, 1, A = U8(~A))
OP(0xA3, 1, 2, DPTR_SET(DPTR + 1u))
OP(0xA4, 1, 4, unsigned p; READ(p, B); p *= A; A = U8(p); WRITE(B, p >> 8); CARRY(0); SET_OV(p > 0xFFu))
// Divisor 0: OV, and A and B are undefined; they are kept.
OP(0x84, 1, 4, const unsigned n = A; unsigned d; READ(d, B); CARRY(0); SET_OV(d == 0); if (d) { A = U8(n / d); WRITE(B, n % d); })
OP(0xD4, 1, 1, unsigned r = A;
    if ((r & 15u) > 9u || (FX & 0x10u)) { r += 6u; }
    if (r > 0xFFu) { CARRY(1u); }
    if ((r & 0xF0u) > 0x90u || CY) { r += 0x60u; }
    if (r > 0xFFu) { CARRY(1u); }
    A = U8(r))

OP(0x72, 2, 2, BIT_READ(O1); CARRY(CY | v))
OP(0x82, 2, 2, BIT_READ(O1); CARRY(CY & v))
OP(0xA0, 2, 2, BIT_READ(O1); CARRY(CY | (v ^ 1u)))
OP(0xB0, 2, 2, BIT_READ(O1); CARRY(CY & (v ^ 1u)))
OP(0xA2, 2, 1, BIT_READ(O1); CARRY(v))
OP(0x92, 2, 2, BIT_CHANGE(O1, (v & ~BIT_MASK(O1)) | CY << (O1 & 7u)))
OP(0xB2, 2, 1, BIT_CHANGE(O1, v ^ BIT_MASK(O1)))
OP(0xC2, 2, 1, BIT_CHANGE(O1, v & ~BIT_MASK(O1)))
OP(0xD2, 2, 1, BIT_CHANGE(O1, v | BIT_MASK(O1)))
OP(0xB3, 1, 1, CARRY(CY ^ 1u))
OP(0xC3, 1, 1, CARRY(0))
OP(0xD3, 1, 1, CARRY(1u))

OP(0x74, 2, 1, A = U8(O1))
OP(0xE5, 2, 1, unsigned v; READ(v, O1); A = U8(v))
OP2(0xE6, 1, 1, unsigned v; IREAD(v, RI); A = U8(v))
OP8(0xE8, 1, 1, unsigned v; RN_GET(v); A = U8(v))
OP(0x75, 3, 2, WRITE(O1, O2))
OP(0xF5, 2, 1, WRITE(O1, A))
OP(0x85, 3, 2, unsigned v; READ(v, O1); WRITE(O2, v))
OP2(0x86, 2, 2, unsigned v; IREAD(v, RI); WRITE(O1, v))
OP8(0x88, 2, 2, unsigned v; RN_GET(v); WRITE(O1, v))
OP2(0x76, 2, 1, IWRITE(RI, O1))
OP2(0xA6, 2, 2, unsigned v; READ(v, O1); IWRITE(RI, v))
OP2(0xF6, 1, 1, IWRITE(RI, A))
OP8(0x78, 2, 1, RN_SET(O1))
OP8(0xA8, 2, 2, unsigned v; READ(v, O1); RN_SET(v))
OP8(0xF8, 1, 1, RN_SET(A))
OP(0x90, 3, 2, DPTR_SET(O1 * 256u + O2))
OP(0xC0, 2, 2, unsigned v; READ(v, O1); PUSH(v))
OP(0xD0, 2, 2, unsigned v; POP(v); WRITE(O1, v))
OP(0xC5, 2, 1, const unsigned a = A; unsigned v; LATCH(v, O1); A = U8(v); WRITE(O1, a))
OP2(0xC6, 1, 1, const unsigned a = A; unsigned v; IREAD(v, RI); A = U8(v); IWRITE(RI, a))
OP8(0xC8, 1, 1, const unsigned a = A; unsigned v; RN_GET(v); A = U8(v); RN_SET(a))
OP2(0xD6, 1, 1, const unsigned a = A; unsigned v; IREAD(v, RI); A = U8((a & 0xF0u) | (v & 15u)); IWRITE(RI, (v & 0xF0u) | (a & 15u)))
OP(0x83, 1, 2, CODE(A, U16(A + PC)))
OP(0x93, 1, 2, CODE(A, U16(A + DPTR)))
OP(0xE0, 1, 2, XREAD(A, DPTR))
OP2(0xE2, 1, 2, XREAD(A, mem[P2] * 256u + RI))
OP(0xF0, 1, 2, XWRITE(DPTR))
OP2(0xF2, 1, 2, XWRITE(mem[P2] * 256u + RI))
OP(0xA5, 1, 1, RESERVED)
// clang-format on
