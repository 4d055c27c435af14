/// \file   plain.c
/// \brief  The engine that looks at each instruction: one switch over ops.h, with observers, breakpoints and coverage.
/// SPDX-License-Identifier: MIT
#include "engine.h"

/// The state in locals, as functions outside the engine expect it, and back.
#define OUT (self->pc = pc, self->budget = budget, self->cy = cy, self->fx = fx)
#define IN  (budget = self->budget, cy = self->cy, fx = self->fx, bank = mem + (mem[PSW] & 0x18u))

#define PC   pc
#define A    mem[ACC]
#define CY   cy
#define FX   fx
#define RI   bank[N]
#define O1   ((unsigned)code[U16(pc - OCTETS + 1u)])
#define O2   ((unsigned)code[U16(pc - OCTETS + 2u)])
#define BIT  BIT_BYTE(O1)
#define MASK BIT_MASK(O1)
#define DPTR (mem[self->dptr] | (unsigned)mem[self->dptr + 1u] << 8)

#define JOP(opcode, kind, octets, cycles, ...)                                                                         \
    case 0x##opcode:                                                                                                   \
    {                                                                                                                  \
        enum                                                                                                           \
        {                                                                                                              \
            OCTETS = (octets),                                                                                         \
            CYCLES = (cycles),                                                                                         \
            KIND = (kind)                                                                                              \
        };                                                                                                             \
        pc += (octets);                                                                                                \
        budget -= MCS51_SPENT(CYCLES, 1);                                                                              \
        __VA_ARGS__;                                                                                                   \
    }                                                                                                                  \
    break;
#define OP(opcode, ...)           JOP(opcode, NOWHERE, __VA_ARGS__)
#define OPD(opcode, access, ...)  JOP(opcode, NOWHERE, __VA_ARGS__)
#define JOPD(opcode, access, ...) JOP(opcode, BRANCH, __VA_ARGS__)

#define TARGET mcs51_target(KIND, pc, code[U16(pc - OCTETS)], O1, code[U16(pc - 1u)])
#define GO     (pc = TARGET);
#define GO_IF(condition)                                                                                               \
    {                                                                                                                  \
        const bool taken_ = (condition) != 0;                                                                          \
        if (self->covering)                                                                                            \
        {                                                                                                              \
            self->marks[U16(pc - OCTETS)] |= taken_ ? MARK_TAKEN : MARK_NOT_TAKEN;                                     \
        }                                                                                                              \
        if (taken_)                                                                                                    \
        {                                                                                                              \
            GO                                                                                                         \
        }                                                                                                              \
    }
#define GO_TO(address) (pc = (address));
#define SPIN_IF_SELF                                                                                                   \
    if (TARGET == pc - OCTETS)                                                                                         \
    {                                                                                                                  \
        pc -= OCTETS;                                                                                                  \
        budget += MCS51_SPENT(CYCLES, 1);                                                                              \
        self->self_jump = true;                                                                                        \
        goto leave;                                                                                                    \
    }
#define ROOM(n)
#define HOLDS(n)

/// A callback may shorten the run: it sees `left`, and can change it.
#define SEEN(space, address, value, write)                                                                             \
    if (self->observer.access)                                                                                         \
    {                                                                                                                  \
        OUT;                                                                                                           \
        mcs51_seen(self, (space), U16(address), U8(value), (write));                                                   \
        budget = self->budget;                                                                                         \
    }
#define SPACE(d) ((d) < 0x80u ? MCS51_IRAM : MCS51_SFR)
#define READ_BY(limit, function, x, d)                                                                                 \
    {                                                                                                                  \
        const unsigned d_ = (d);                                                                                       \
        if ((int32_t)(budget >> 32) > limit[d_])                                                                       \
        {                                                                                                              \
            x = mem[d_];                                                                                               \
        }                                                                                                              \
        else                                                                                                           \
        {                                                                                                              \
            OUT;                                                                                                       \
            x = function(self, d_);                                                                                    \
            budget = self->budget;                                                                                     \
        }                                                                                                              \
        SEEN(SPACE(d_), d_, x, false)                                                                                  \
    }
#define ALL_BITS(self, d) mcs51_read(self, d, 0xFFu)
#define THE_BIT(self, d)  mcs51_read(self, d, MASK)
#define READ(x, d)        READ_BY(mcs51_read_limit, ALL_BITS, x, d)
#define READ_BIT(x)       READ_BY(mcs51_read_limit, THE_BIT, x, BIT)
#define LATCH(x, d)       READ_BY(mcs51_latch_limit, mcs51_read_latch, x, d)
#define WRITE(d, v)                                                                                                    \
    {                                                                                                                  \
        const unsigned w_ = (d), written_ = (v);                                                                       \
        if ((int32_t)(budget >> 32) > mcs51_write_limit[w_])                                                           \
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
            budget = self->budget;                                                                                     \
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
            budget = self->budget;                                                                                     \
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
            budget = self->budget;                                                                                     \
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
            budget = self->budget;                                                                                     \
        }                                                                                                              \
        SEEN(MCS51_CODE, a_, x, false)                                                                                 \
    }
#define XREAD(x, a)                                                                                                    \
    {                                                                                                                  \
        const unsigned a_ = (a);                                                                                       \
        OUT;                                                                                                           \
        x = mcs51_xread(self, a_);                                                                                     \
        budget = self->budget;                                                                                         \
        SEEN(MCS51_XDATA, a_, x, false)                                                                                \
    }
#define XWRITE(a)                                                                                                      \
    {                                                                                                                  \
        const unsigned a_ = (a);                                                                                       \
        OUT;                                                                                                           \
        mcs51_xwrite(self, a_, A);                                                                                     \
        budget = self->budget;                                                                                         \
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
#define RETI_DONE (OUT, mcs51_reti(self), budget = self->budget);
#define RESERVED  (OUT, mcs51_reserved_opcode(self), budget = self->budget)

void mcs51_plain(mcs51_t* self, bool one)
{
    uint8_t* const mem = self->mem;
    const uint8_t* const code = self->code;
    uint8_t* bank;
    uint32_t pc = self->pc, cy, fx;
    int64_t budget;

    IN;
    while (budget >= 0)
    {
        pc &= 0xFFFFu;
        if (self->watched)
        {
            OUT;
            if (!mcs51_enter(self))
            {
                break;
            }
            budget = self->budget;
        }
        switch (code[pc])
        {
#include "ops.h"
        }
        if (one)
        {
            break;
        }
    }
leave:
    OUT;
}
