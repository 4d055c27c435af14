/// \file   plain.c
/// \brief  The engine that looks at each instruction: one switch over ops.h, with observers, breakpoints and coverage.
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
#define O1   ((unsigned)code[U16(pc - LENGTH + 1u)])
#define O2   ((unsigned)code[U16(pc - LENGTH + 2u)])
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

/// A callback may shorten the run: it sees `left`, and can change it.
#define SEEN(space, address, value, write)                                                                             \
    if (self->observer.access)                                                                                         \
    {                                                                                                                  \
        OUT;                                                                                                           \
        mcs51_seen(self, (space), U16(address), U8(value), (write));                                                   \
        left = self->left;                                                                                             \
    }
#define SPACE(d) ((d) < 0x80u ? MCS51_IRAM : MCS51_SFR)
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
        SEEN(SPACE(d_), d_, x, false)                                                                                  \
    }
#define READ(x, d)  READ_BY(mcs51_read_limit, mcs51_read, x, d)
#define LATCH(x, d) READ_BY(mcs51_latch_limit, mcs51_read_latch, x, d)
#define WRITE(d, v)                                                                                                    \
    {                                                                                                                  \
        const unsigned w_ = (d), written_ = (v);                                                                       \
        if (left > mcs51_write_limit[w_])                                                                              \
        {                                                                                                              \
            mem[w_] = U8(written_);                                                                                    \
        }                                                                                                              \
        else                                                                                                           \
        {                                                                                                              \
            OUT;                                                                                                       \
            mcs51_write(self, w_, U8(written_));                                                                       \
            IN;                                                                                                        \
        }                                                                                                              \
        SEEN(SPACE(w_), w_, written_, true)                                                                            \
    }
#define RN_GET(x)                                                                                                      \
    {                                                                                                                  \
        x = bank[N];                                                                                                   \
        SEEN(MCS51_IRAM, (unsigned)(bank - mem) + N, x, false)                                                         \
    }
#define RN_SET(x)                                                                                                      \
    {                                                                                                                  \
        bank[N] = U8(x);                                                                                               \
        SEEN(MCS51_IRAM, (unsigned)(bank - mem) + N, bank[N], true)                                                    \
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
            left = self->left;                                                                                         \
        }                                                                                                              \
        SEEN(MCS51_IRAM, i_, x, false)                                                                                 \
    }
#define IWRITE(i, v)                                                                                                   \
    {                                                                                                                  \
        const unsigned i_ = (i), stored_ = (v);                                                                        \
        if (i_ < self->ram_octets)                                                                                     \
        {                                                                                                              \
            mem[i_ + (i_ & 0x80u)] = U8(stored_);                                                                      \
        }                                                                                                              \
        else                                                                                                           \
        {                                                                                                              \
            OUT;                                                                                                       \
            mcs51_absent_ram(self, i_);                                                                                \
            left = self->left;                                                                                         \
        }                                                                                                              \
        SEEN(MCS51_IRAM, i_, stored_, true)                                                                            \
    }
#define PUSHED(i, v)                                                                                                   \
    {                                                                                                                  \
        const unsigned p_ = (i), pushed_ = (v);                                                                        \
        if (p_ - 1u < self->stack_top)                                                                                 \
        {                                                                                                              \
            mem[p_ + (p_ & 0x80u)] = U8(pushed_);                                                                      \
        }                                                                                                              \
        else                                                                                                           \
        {                                                                                                              \
            OUT;                                                                                                       \
            mcs51_push_beyond(self, p_, U8(pushed_));                                                                  \
            left = self->left;                                                                                         \
        }                                                                                                              \
        SEEN(MCS51_IRAM, p_, pushed_, true)                                                                            \
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
            left = self->left;                                                                                         \
        }                                                                                                              \
        SEEN(MCS51_CODE, a_, x, false)                                                                                 \
    }
#define XREAD(x, a)                                                                                                    \
    {                                                                                                                  \
        const unsigned a_ = (a);                                                                                       \
        OUT;                                                                                                           \
        x = mcs51_xread(self, a_);                                                                                     \
        left = self->left;                                                                                             \
        SEEN(MCS51_XDATA, a_, x, false)                                                                                \
    }
#define XWRITE(a)                                                                                                      \
    {                                                                                                                  \
        const unsigned a_ = (a);                                                                                       \
        OUT;                                                                                                           \
        mcs51_xwrite(self, a_, A);                                                                                     \
        left = self->left;                                                                                             \
        SEEN(MCS51_XDATA, a_, A, true)                                                                                 \
    }
#define DPTR_SET(v)                                                                                                    \
    {                                                                                                                  \
        const unsigned v_ = (v);                                                                                       \
        mem[self->dptr] = U8(v_);                                                                                      \
        mem[self->dptr + 1u] = U8(v_ >> 8);                                                                            \
        SEEN(MCS51_SFR, self->dptr, v_, true)                                                                          \
        SEEN(MCS51_SFR, self->dptr + 1u, v_ >> 8, true)                                                                \
    }
#define RETI_DONE (OUT, mcs51_reti(self), left = self->left)
#define RESERVED  (OUT, mcs51_reserved_opcode(self), left = self->left)
#define SPIN_IF(condition)                                                                                             \
    if (condition)                                                                                                     \
    {                                                                                                                  \
        pc -= LENGTH;                                                                                                  \
        left += CYCLES;                                                                                                \
        self->self_jump = true;                                                                                        \
        goto leave;                                                                                                    \
    }
#define BRANCH_IF(condition, o)                                                                                        \
    {                                                                                                                  \
        const bool taken_ = (condition) != 0;                                                                          \
        if (self->covering)                                                                                            \
        {                                                                                                              \
            *mark |= taken_ ? MARK_TAKEN : MARK_NOT_TAKEN;                                                             \
        }                                                                                                              \
        if (taken_)                                                                                                    \
        {                                                                                                              \
            BRANCH(o);                                                                                                 \
        }                                                                                                              \
    }

void mcs51_plain(mcs51_t* self)
{
    uint8_t* const mem = self->mem;
    const uint8_t* const code = self->code;
    uint8_t* bank;
    uint8_t* mark;
    uint32_t pc = self->pc, cy, fx;
    int32_t left;

    IN;
    while (left > 0)
    {
        pc &= 0xFFFFu;
        if (self->watched)
        {
            OUT;
            if (!mcs51_enter(self))
            {
                break;
            }
            left = self->left;
        }
        mark = &self->marks[pc];
        switch (code[pc])
        {
#include "ops.h"
        }
        ++self->instructions;
    }
leave:
    OUT;
}
