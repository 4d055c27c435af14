/// \file   cpu/ops.h
/// \brief  Every opcode of the MCS-51 once: octets, machine cycles, what it touches, what it does. Intel MCS-51 Programmer's Guide.
///
/// Whoever includes this supplies, for opcode (two hexadecimal digits; row A with a small a: A is the accumulator), octets, cycles and
/// a body:
///   OP(x, octets, cycles, body)               goes on with the next instruction
///   OPD(x, access, octets, cycles, body)      the same with a direct operand (engine.h: access)
///   JOP(x, target, octets, cycles, body)      may go elsewhere (engine.h: target)
///   JOPD(x, access, octets, cycles, body)     conditional branch with a direct operand
/// and, for the bodies (N: number of the register):
///   PC                address of the next instruction; O1, O2 operand octets; A, CY (0 or 1), FX (see fx)
///   BIT, MASK         octet that holds the bit operand, and its place in it
///   RN_GET(x), RN_SET(x)  register N;  RI  register N as a pointer
///   READ, LATCH(x,d)  x = direct d, seen from the pins or from the latches;  READ_BIT(x): BIT, for MASK;  WRITE(d,v)
///   IREAD(x,i)        x = RAM at i;  IWRITE(i,v);  PUSHED(i,v): by the stack;  CODE(x,a);  XREAD(x,a);  XWRITE(a)
///   ROOM(n), HOLDS(n) n octets are about to be pushed, popped
///   DPTR, DPTR_SET    the selected data pointer;  RETI_DONE;  RESERVED;  SPIN_IF_SELF: a jump to itself
///   GO                to the target;  GO_IF(c);  GO_TO(address)
/// SPDX-License-Identifier: MIT

#define U8(x)    ((uint8_t)(x))
#define U16(x)   ((uint16_t)(x))
#define CARRY(x) (CY = (x))

#define ADD(x, c)                                                                                                      \
    {                                                                                                                  \
        const unsigned x_ = (x), r_ = A + x_ + (c);                                                                    \
        FX = A ^ x_ ^ r_;                                                                                              \
        CARRY(r_ >> 8);                                                                                                \
        A = U8(r_);                                                                                                    \
    }
#define ADD0(x) ADD(x, 0u)
#define ADDC(x) ADD(x, CY)
#define SUBB(x)                                                                                                        \
    {                                                                                                                  \
        const unsigned x_ = (x), r_ = A - x_ - CY;                                                                     \
        FX = A ^ x_ ^ r_;                                                                                              \
        CARRY((r_ >> 8) & 1u);                                                                                         \
        A = U8(r_);                                                                                                    \
    }
#define CJNE(a, x)                                                                                                     \
    {                                                                                                                  \
        const unsigned a_ = (a), x_ = (x);                                                                             \
        CARRY(a_ < x_);                                                                                                \
        GO_IF(a_ != x_)                                                                                                \
    }
#define PUSH(v)                                                                                                        \
    {                                                                                                                  \
        const unsigned value_ = (v), at_ = U8(mem[SP] + 1u);                                                           \
        mem[SP] = U8(at_);                                                                                             \
        PUSHED(at_, value_)                                                                                            \
    }
#define POP(x)                                                                                                         \
    {                                                                                                                  \
        IREAD(x, mem[SP])                                                                                              \
        mem[SP] = U8(mem[SP] - 1u);                                                                                    \
    }
#define CALL                                                                                                           \
    {                                                                                                                  \
        const unsigned return_ = PC;                                                                                   \
        ROOM(2)                                                                                                        \
        PUSH(return_ & 0xFFu)                                                                                          \
        PUSH(return_ >> 8 & 0xFFu)                                                                                     \
        GO                                                                                                             \
    }
#define RETURN(done)                                                                                                   \
    {                                                                                                                  \
        unsigned h_, l_;                                                                                               \
        HOLDS(2)                                                                                                       \
        POP(h_)                                                                                                        \
        POP(l_)                                                                                                        \
        done GO_TO(h_ << 8 | l_)                                                                                       \
    }
/// AC is kept: it is bit 4 of FX; bit 7 alone makes OV.
#define SET_OV(x) (FX = (FX & 0x10u) | ((x) ? 0x80u : 0u))

// clang-format off
// Registers: @R0 and @R1 in columns x and y of the opcode map, R0 to R7 in the right half of a row.
#define OP_RI(x, y, o, c, ...)     OP(x, o, c, enum { N = 0 }; __VA_ARGS__) OP(y, o, c, enum { N = 1 }; __VA_ARGS__)
#define OPD_RI(x, y, d, o, c, ...) OPD(x, d, o, c, enum { N = 0 }; __VA_ARGS__) OPD(y, d, o, c, enum { N = 1 }; __VA_ARGS__)
#define JOP_RI(x, y, t, o, c, ...) JOP(x, t, o, c, enum { N = 0 }; __VA_ARGS__) JOP(y, t, o, c, enum { N = 1 }; __VA_ARGS__)
#define OP_RN(row, o, c, ...) \
    OP_RI(row##8, row##9, o, c, __VA_ARGS__) \
    OP(row##A, o, c, enum { N = 2 }; __VA_ARGS__) OP(row##B, o, c, enum { N = 3 }; __VA_ARGS__) \
    OP(row##C, o, c, enum { N = 4 }; __VA_ARGS__) OP(row##D, o, c, enum { N = 5 }; __VA_ARGS__) \
    OP(row##E, o, c, enum { N = 6 }; __VA_ARGS__) OP(row##F, o, c, enum { N = 7 }; __VA_ARGS__)
#define OPD_RN(row, d, o, c, ...) \
    OPD_RI(row##8, row##9, d, o, c, __VA_ARGS__) \
    OPD(row##A, d, o, c, enum { N = 2 }; __VA_ARGS__) OPD(row##B, d, o, c, enum { N = 3 }; __VA_ARGS__) \
    OPD(row##C, d, o, c, enum { N = 4 }; __VA_ARGS__) OPD(row##D, d, o, c, enum { N = 5 }; __VA_ARGS__) \
    OPD(row##E, d, o, c, enum { N = 6 }; __VA_ARGS__) OPD(row##F, d, o, c, enum { N = 7 }; __VA_ARGS__)
#define JOP_RN(row, t, o, c, ...) \
    JOP_RI(row##8, row##9, t, o, c, __VA_ARGS__) \
    JOP(row##A, t, o, c, enum { N = 2 }; __VA_ARGS__) JOP(row##B, t, o, c, enum { N = 3 }; __VA_ARGS__) \
    JOP(row##C, t, o, c, enum { N = 4 }; __VA_ARGS__) JOP(row##D, t, o, c, enum { N = 5 }; __VA_ARGS__) \
    JOP(row##E, t, o, c, enum { N = 6 }; __VA_ARGS__) JOP(row##F, t, o, c, enum { N = 7 }; __VA_ARGS__)

// Operand forms of A op x: immediate, direct, @Ri, Rn; then of x op A. INC and DEC by n.
#define ALU(row, operation) \
    OP(row##4, 2, 1, operation(O1)) \
    OPD(row##5, READS, 2, 1, unsigned v; READ(v, O1) operation(v)) \
    OP_RI(row##6, row##7, 1, 1, unsigned v; IREAD(v, RI) operation(v)) \
    OP_RN(row, 1, 1, unsigned v; RN_GET(v) operation(v))
#define LOGIC(row, op) \
    OPD(row##2, CHANGES, 2, 1, unsigned v; LATCH(v, O1) WRITE(O1, v op A)) \
    OPD(row##3, CHANGES, 3, 2, unsigned v; LATCH(v, O1) WRITE(O1, v op O2)) \
    OP(row##4, 2, 1, A = U8(A op O1)) \
    OPD(row##5, READS, 2, 1, unsigned v; READ(v, O1) A = U8(A op v)) \
    OP_RI(row##6, row##7, 1, 1, unsigned v; IREAD(v, RI) A = U8(A op v)) \
    OP_RN(row, 1, 1, unsigned v; RN_GET(v) A = U8(A op v))
#define STEP(row, n) \
    OP(row##4, 1, 1, A = U8(A + n)) \
    OPD(row##5, CHANGES, 2, 1, unsigned v; LATCH(v, O1) WRITE(O1, v + n)) \
    OP_RI(row##6, row##7, 1, 1, unsigned v; IREAD(v, RI) IWRITE(RI, v + n)) \
    OP_RN(row, 1, 1, unsigned v; RN_GET(v) RN_SET(v + n))
#define BIT_READ \
    unsigned v; READ_BIT(v) v &= MASK;
#define BIT_CHANGE(expression) \
    unsigned v; LATCH(v, BIT) WRITE(BIT, expression)
#define AJMP(x)  JOP(x, IN_PAGE, 2, 2, SPIN_IF_SELF GO)
#define ACALL(x) JOP(x, IN_PAGE, 2, 2, CALL)

OP(00, 1, 1, )
AJMP(01) AJMP(21) AJMP(41) AJMP(61) AJMP(81) AJMP(A1) AJMP(C1) AJMP(E1)
ACALL(11) ACALL(31) ACALL(51) ACALL(71) ACALL(91) ACALL(B1) ACALL(D1) ACALL(F1)
JOP(02, ANYWHERE, 3, 2, SPIN_IF_SELF GO)
JOP(12, ANYWHERE, 3, 2, CALL)
JOP(22, COMPUTED, 1, 2, RETURN())
JOP(32, COMPUTED, 1, 2, RETURN(RETI_DONE))
JOP(73, COMPUTED, 1, 2, GO_TO(U16(A + DPTR)))
JOP(80, NEARBY, 2, 2, SPIN_IF_SELF GO)

JOPD(10, CHANGES | BITS, 3, 2, unsigned v; LATCH(v, BIT) if (v & MASK) { WRITE(BIT, v & ~MASK) } GO_IF(v & MASK))
JOPD(20, READS | BITS, 3, 2, BIT_READ GO_IF(v))
JOPD(30, READS | BITS, 3, 2, BIT_READ GO_IF(!v))
JOP(40, BRANCH, 2, 2, GO_IF(CY))
JOP(50, BRANCH, 2, 2, GO_IF(!CY))
JOP(60, BRANCH, 2, 2, GO_IF(!A))
JOP(70, BRANCH, 2, 2, GO_IF(A))
JOP(B4, BRANCH, 3, 2, CJNE(A, O1))
JOPD(B5, READS, 3, 2, unsigned v; READ(v, O1) CJNE(A, v))
JOP_RI(B6, B7, BRANCH, 3, 2, unsigned v; IREAD(v, RI) CJNE(v, O1))
JOP_RN(B, BRANCH, 3, 2, unsigned v; RN_GET(v) CJNE(v, O1))
JOPD(D5, CHANGES, 3, 2, unsigned v; LATCH(v, O1) v = U8(v - 1u); WRITE(O1, v) GO_IF(v))
JOP_RN(D, BRANCH, 2, 2, unsigned v; RN_GET(v) v = U8(v - 1u); RN_SET(v) GO_IF(v))

STEP(0, 1u)
STEP(1, 0xFFu)
ALU(2, ADD0)
ALU(3, ADDC)
ALU(9, SUBB)
LOGIC(4, |)
LOGIC(5, &)
LOGIC(6, ^)
OP(03, 1, 1, A = U8(A >> 1 | A << 7))
OP(13, 1, 1, const unsigned c = A & 1u; A = U8(A >> 1 | CY << 7); CARRY(c))
OP(23, 1, 1, A = U8(A << 1 | A >> 7))
OP(33, 1, 1, const unsigned c = A >> 7; A = U8((unsigned)A << 1 | CY); CARRY(c))
OP(C4, 1, 1, A = U8(A << 4 | A >> 4))
OP(E4, 1, 1, A = 0)
OP(F4, 1, 1, A = U8(~A))
OP(A3, 1, 2, DPTR_SET(DPTR + 1u))
OP(A4, 1, 4, unsigned p; READ(p, B) p *= A; A = U8(p); WRITE(B, p >> 8) CARRY(0); SET_OV(p > 0xFFu))
// Divisor 0: OV, and A and B are undefined; they are kept.
OP(84, 1, 4, const unsigned n = A; unsigned d; READ(d, B) CARRY(0); SET_OV(d == 0); if (d) { A = U8(n / d); WRITE(B, n % d) })
OP(D4, 1, 1, unsigned r = A;
    if ((r & 15u) > 9u || (FX & 0x10u)) { r += 6u; }
    if (r > 0xFFu) { CARRY(1u); }
    if ((r & 0xF0u) > 0x90u || CY) { r += 0x60u; }
    if (r > 0xFFu) { CARRY(1u); }
    A = U8(r))

OPD(72, READS | BITS, 2, 2, BIT_READ CARRY(CY | (v != 0)))
OPD(82, READS | BITS, 2, 2, BIT_READ CARRY(CY & (v != 0)))
OPD(A0, READS | BITS, 2, 2, BIT_READ CARRY(CY | (v == 0)))
OPD(B0, READS | BITS, 2, 2, BIT_READ CARRY(CY & (v == 0)))
OPD(A2, READS | BITS, 2, 1, BIT_READ CARRY(v != 0))
OPD(92, CHANGES | BITS, 2, 2, BIT_CHANGE((v & ~MASK) | ((0u - CY) & MASK)))
OPD(B2, CHANGES | BITS, 2, 1, BIT_CHANGE(v ^ MASK))
OPD(C2, CHANGES | BITS, 2, 1, BIT_CHANGE(v & ~MASK))
OPD(D2, CHANGES | BITS, 2, 1, BIT_CHANGE(v | MASK))
OP(B3, 1, 1, CARRY(CY ^ 1u))
OP(C3, 1, 1, CARRY(0))
OP(D3, 1, 1, CARRY(1u))

OP(74, 2, 1, A = U8(O1))
OPD(E5, READS, 2, 1, unsigned v; READ(v, O1) A = U8(v))
OP_RI(E6, E7, 1, 1, unsigned v; IREAD(v, RI) A = U8(v))
OP_RN(E, 1, 1, unsigned v; RN_GET(v) A = U8(v))
OPD(75, WRITES, 3, 2, WRITE(O1, O2))
OPD(F5, WRITES, 2, 1, WRITE(O1, A))
OPD(85, READS | WRITES, 3, 2, unsigned v; READ(v, O1) WRITE(O2, v))
OPD_RI(86, 87, WRITES, 2, 2, unsigned v; IREAD(v, RI) WRITE(O1, v))
OPD_RN(8, WRITES, 2, 2, unsigned v; RN_GET(v) WRITE(O1, v))
OP_RI(76, 77, 2, 1, IWRITE(RI, O1))
OPD_RI(A6, A7, READS, 2, 2, unsigned v; READ(v, O1) IWRITE(RI, v))
OP_RI(F6, F7, 1, 1, IWRITE(RI, A))
OP_RN(7, 2, 1, RN_SET(O1))
OPD_RN(a, READS, 2, 2, unsigned v; READ(v, O1) RN_SET(v))
OP_RN(F, 1, 1, RN_SET(A))
OP(90, 3, 2, DPTR_SET(O1 * 256u + O2))
OPD(C0, READS, 2, 2, unsigned v; READ(v, O1) ROOM(1) PUSH(v))
OPD(D0, WRITES, 2, 2, unsigned v; POP(v) WRITE(O1, v))
OPD(C5, CHANGES, 2, 1, const unsigned old = A; unsigned v; LATCH(v, O1) A = U8(v); WRITE(O1, old))
OP_RI(C6, C7, 1, 1, const unsigned old = A; unsigned v; IREAD(v, RI) A = U8(v); IWRITE(RI, old))
OP_RN(C, 1, 1, const unsigned old = A; unsigned v; RN_GET(v) A = U8(v); RN_SET(old))
OP_RI(D6, D7, 1, 1, const unsigned old = A; unsigned v; IREAD(v, RI) A = U8((old & 0xF0u) | (v & 15u)); IWRITE(RI, (v & 0xF0u) | (old & 15u)))
OP(83, 1, 2, CODE(A, U16(A + PC)))
OP(93, 1, 2, CODE(A, U16(A + DPTR)))
OP(E0, 1, 2, XREAD(A, DPTR))
OP_RI(E2, E3, 1, 2, XREAD(A, mem[P2] * 256u + RI))
OP(F0, 1, 2, XWRITE(DPTR))
OP_RI(F2, F3, 1, 2, XWRITE(mem[P2] * 256u + RI))
OP(A5, 1, 1, RESERVED)
    // clang-format on
