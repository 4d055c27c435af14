/// \file   engine.c
/// \brief  Interpreter: one switch over ops.h, nothing tested per instruction but `left`.
/// SPDX-License-Identifier: MIT
#include "mcs51_internal.h"

/// The state in locals, as functions outside the engine expect it, and back.
#define OUT (self->pc = pc, self->left = left, self->cy = cy, self->fx = fx)
#define IN  (left = self->left, cy = self->cy, fx = self->fx, bank = mem + (mem[PSW] & 0x18u))

#define PC   pc
#define A    mem[ACC]
#define CY   cy
#define FX   fx
#define RI   bank[N]
#define O1   ((unsigned)code[pc - LENGTH + 1u])
#define O2   ((unsigned)code[pc - LENGTH + 2u])
#define DPTR (mem[self->dptr] | (unsigned)mem[self->dptr + 1u] << 8)

#define OP(opcode, length, cycles, ...)                                                                                \
    case (opcode):                                                                                                     \
    {                                                                                                                  \
        enum                                                                                                           \
        {                                                                                                              \
            LENGTH = (length),                                                                                         \
            CYCLES = (cycles)                                                                                          \
        };                                                                                                             \
        pc += (length);                                                                                                \
        left -= (cycles);                                                                                              \
        __VA_ARGS__;                                                                                                   \
    }                                                                                                                  \
    break;
#define OPN(opcode, n, length, cycles, ...) OP((opcode) + (n), length, cycles, enum {N = (n)}; __VA_ARGS__)
#define OP2(opcode, ...)                    OPN(opcode, 0, __VA_ARGS__) OPN(opcode, 1, __VA_ARGS__)
#define OP8(opcode, ...)                                                                                               \
    OP2(opcode, __VA_ARGS__)                                                                                           \
    OPN(opcode, 2, __VA_ARGS__)                                                                                        \
    OPN(opcode, 3, __VA_ARGS__)                                                                                        \
    OPN(opcode, 4, __VA_ARGS__)                                                                                        \
    OPN(opcode, 5, __VA_ARGS__)                                                                                        \
    OPN(opcode, 6, __VA_ARGS__)                                                                                        \
    OPN(opcode, 7, __VA_ARGS__)
#define PAGE_TARGET ((pc & 0xF800u) | (unsigned)N << 8 | O1)
#define OP_PAGE(opcode, length, cycles, ...)                                                                           \
    OP_IN_PAGE(opcode, 0, length, cycles, __VA_ARGS__)                                                                 \
    OP_IN_PAGE(opcode, 1, length, cycles, __VA_ARGS__)                                                                 \
    OP_IN_PAGE(opcode, 2, length, cycles, __VA_ARGS__)                                                                 \
    OP_IN_PAGE(opcode, 3, length, cycles, __VA_ARGS__)                                                                 \
    OP_IN_PAGE(opcode, 4, length, cycles, __VA_ARGS__)                                                                 \
    OP_IN_PAGE(opcode, 5, length, cycles, __VA_ARGS__)                                                                 \
    OP_IN_PAGE(opcode, 6, length, cycles, __VA_ARGS__)                                                                 \
    OP_IN_PAGE(opcode, 7, length, cycles, __VA_ARGS__)
#define OP_IN_PAGE(opcode, n, length, cycles, ...)                                                                     \
    OP((opcode) + 0x20 * (n), length, cycles, enum {N = (n)}; __VA_ARGS__)

#define RN_GET(x) (x = bank[N])
#define RN_SET(x) (bank[N] = U8(x))
#define BRANCH_IF(condition, o)                                                                                        \
    if (condition)                                                                                                     \
    {                                                                                                                  \
        BRANCH(o);                                                                                                     \
    }

#define READ_BY(limit, function, x, d)                                                                                 \
    {                                                                                                                  \
        const unsigned d_ = (d);                                                                                       \
        if (left > limit[d_])                                                                                          \
        {                                                                                                              \
            x = mem[d_];                                                                                               \
        }                                                                                                              \
        else                                                                                                           \
        {                                                                                                              \
            OUT;                                                                                                       \
            x = function(self, d_);                                                                                    \
            left = self->left;                                                                                         \
        }                                                                                                              \
    }
#define READ(x, d)  READ_BY(mcs51_read_limit, mcs51_read, x, d)
#define LATCH(x, d) READ_BY(mcs51_latch_limit, mcs51_read_latch, x, d)
#define WRITE(d, v)                                                                                                    \
    {                                                                                                                  \
        const unsigned w_ = (d);                                                                                       \
        if (left > mcs51_write_limit[w_])                                                                              \
        {                                                                                                              \
            mem[w_] = U8(v);                                                                                           \
        }                                                                                                              \
        else                                                                                                           \
        {                                                                                                              \
            OUT;                                                                                                       \
            mcs51_write(self, w_, U8(v));                                                                              \
            IN;                                                                                                        \
        }                                                                                                              \
    }
#define IREAD(x, i)                                                                                                    \
    {                                                                                                                  \
        const unsigned i_ = (i);                                                                                       \
        if (i_ < self->ram_octets)                                                                                     \
        {                                                                                                              \
            x = mem[i_ + (i_ & 0x80u)];                                                                                \
        }                                                                                                              \
        else                                                                                                           \
        {                                                                                                              \
            OUT;                                                                                                       \
            x = mcs51_absent_ram(self, i_);                                                                            \
        }                                                                                                              \
    }
#define IWRITE(i, v)                                                                                                   \
    {                                                                                                                  \
        const unsigned i_ = (i);                                                                                       \
        if (i_ < self->ram_octets)                                                                                     \
        {                                                                                                              \
            mem[i_ + (i_ & 0x80u)] = U8(v);                                                                            \
        }                                                                                                              \
        else                                                                                                           \
        {                                                                                                              \
            OUT;                                                                                                       \
            mcs51_absent_ram(self, i_);                                                                                \
        }                                                                                                              \
    }
#define CODE(x, a)                                                                                                     \
    {                                                                                                                  \
        const unsigned a_ = (a);                                                                                       \
        if (a_ < self->code_octets)                                                                                    \
        {                                                                                                              \
            x = code[a_];                                                                                              \
        }                                                                                                              \
        else                                                                                                           \
        {                                                                                                              \
            OUT;                                                                                                       \
            x = mcs51_absent_code(self, a_);                                                                           \
        }                                                                                                              \
    }
#define XREAD(x, a) (OUT, (x) = mcs51_xread(self, (a)), left = self->left)
#define XWRITE(a)   (OUT, mcs51_xwrite(self, (a), A), left = self->left)
#define PUSHED(a, v)                                                                                                   \
    {                                                                                                                  \
        const unsigned p_ = (a);                                                                                       \
        if (p_ - 1u < self->stack_top)                                                                                 \
        {                                                                                                              \
            mem[p_ + (p_ & 0x80u)] = U8(v);                                                                            \
        }                                                                                                              \
        else                                                                                                           \
        {                                                                                                              \
            OUT;                                                                                                       \
            mcs51_push_beyond(self, p_, U8(v));                                                                        \
        }                                                                                                              \
    }
#define DPTR_SET(v)                                                                                                    \
    {                                                                                                                  \
        const unsigned v_ = (v);                                                                                       \
        mem[self->dptr] = U8(v_);                                                                                      \
        mem[self->dptr + 1u] = U8(v_ >> 8);                                                                            \
    }
#define RETI_DONE (OUT, mcs51_reti(self), left = self->left)
#define RESERVED  (OUT, mcs51_reserved_opcode(self), pc = U16(pc))
#define SPIN_IF(condition)                                                                                             \
    if (condition)                                                                                                     \
    {                                                                                                                  \
        pc -= LENGTH;                                                                                                  \
        left += CYCLES;                                                                                                \
        self->self_jump = true;                                                                                        \
        goto leave;                                                                                                    \
    }

void mcs51_code_changed(mcs51_t* self, unsigned address)
{
    (void)self, (void)address; // nothing is made of it ahead of time
}

void mcs51_engine(mcs51_t* self)
{
    uint8_t* const mem = self->mem;
    const uint8_t* const code = self->code;
    uint8_t* bank;
    uint32_t pc = self->pc, cy, fx;
    int32_t left;
    uint64_t count = self->instructions;

    IN;
    while (left > 0)
    {
        switch (code[pc])
        {
#include "ops.h"
        }
        ++count;
    }
leave:
    OUT;
    self->instructions = count;
}
