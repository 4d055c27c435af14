/// \file   fast.c
/// \brief  The engine that runs decoded blocks: a handler for each opcode, called by the one before as its last act.
///
/// A block is paid for as a whole where it is entered, if it ends before the horizon; if it does not, the plain engine takes over. In a
/// block there is nothing to look at: no event is due, and what has side effects ends it. Where the compiler makes jumps of such calls
/// (MCS51_TAIL_CALLS; a test looks at the object) the state stays in registers; elsewhere handlers return to a loop.
/// SPDX-License-Identifier: MIT
#include "engine.h"

#define ARGUMENTS mcs51_t *self, const entry_t *ip, uint32_t a, uint32_t cy, uint32_t fx, uint8_t *bank
#define PASSED    self, ip, a, cy, fx, bank

#ifdef MCS51_TAIL_CALLS
#define CONTINUE                                                                                                       \
    {                                                                                                                  \
        ip->run(PASSED);                                                                                               \
        return;                                                                                                        \
    }
#else
#define CONTINUE                                                                                                       \
    {                                                                                                                  \
        self->next = (mcs51_next_t){ip, a, cy, fx, bank};                                                              \
        return;                                                                                                        \
    }
#endif
#define STOP                                                                                                           \
    {                                                                                                                  \
        self->next.ip = NULL;                                                                                          \
        return;                                                                                                        \
    }
#define INSTEAD(handler)                                                                                               \
    {                                                                                                                  \
        handler(PASSED);                                                                                               \
        return;                                                                                                        \
    }
/// Begin a block.
#define ENTER                                                                                                          \
    {                                                                                                                  \
        self->budget -= ip->sum;                                                                                       \
        if (self->budget < 0)                                                                                          \
        {                                                                                                              \
            INSTEAD(mcs51_leave)                                                                                       \
        }                                                                                                              \
        CONTINUE                                                                                                       \
    }

/// The state as functions outside the engine expect it, and back.
#define OUT(octets)                                                                                                    \
    (self->pc = (uint32_t)(ip - self->entries) + (octets), mem[ACC] = (uint8_t)a, self->cy = cy, self->fx = fx)
#define IN (a = mem[ACC], cy = self->cy, fx = self->fx, bank = mem + (mem[PSW] & 0x18u))

#define PC   ((uint32_t)(ip - self->entries) + OCTETS)
#define A    a
#define CY   cy
#define FX   fx
#define RI   bank[N]
#define O1   ((unsigned)ip->o1)
#define O2   ((unsigned)ip->o2)
#define BIT  O1
#define MASK O2
#define DPTR (mem[self->dptr] | (unsigned)mem[self->dptr + 1u] << 8)

#define RN_GET(x) (x = bank[N]);
#define RN_SET(x) (bank[N] = U8(x));

/// What is not there is left to the plain engine, before anything is changed.
#define COLD(condition)                                                                                                \
    if (condition)                                                                                                     \
    {                                                                                                                  \
        INSTEAD(mcs51_one)                                                                                             \
    }
#define RAM(i)                                                                                                         \
    unsigned i_ = (i);                                                                                                 \
    if (i_ & 0x80u)                                                                                                    \
    {                                                                                                                  \
        COLD(i_ >= self->ram_octets)                                                                                   \
        i_ += 0x80u;                                                                                                   \
    }
#define IREAD(x, i)                                                                                                    \
    {                                                                                                                  \
        RAM(i)                                                                                                         \
        x = mem[i_];                                                                                                   \
    }
#define IWRITE(i, v)                                                                                                   \
    {                                                                                                                  \
        RAM(i)                                                                                                         \
        mem[i_] = U8(v);                                                                                               \
    }
#define ROOM(n)      COLD((unsigned)mem[SP] + (n) > self->stack_top)
#define HOLDS(n)     COLD(mem[SP] - 1u >= self->ram_octets - 1u)
#define PUSHED(i, v) (mem[(i) + ((i)&0x80u)] = U8(v));
#define CODE(x, at)                                                                                                    \
    {                                                                                                                  \
        const unsigned at_ = (at);                                                                                     \
        COLD(at_ >= self->code_octets)                                                                                 \
        x = self->code[at_];                                                                                           \
    }
#define XDATA(at)                                                                                                      \
    const unsigned at_ = (at);                                                                                         \
    COLD(mem[P0] != 0xFFu || at_ >= self->config.xdata_octets)
#define XREAD(x, at)                                                                                                   \
    {                                                                                                                  \
        XDATA(at)                                                                                                      \
        x = self->xdata[at_];                                                                                          \
    }
#define XWRITE(at)                                                                                                     \
    {                                                                                                                  \
        XDATA(at)                                                                                                      \
        self->xdata[at_] = U8(A);                                                                                      \
    }
#define DPTR_SET(v)                                                                                                    \
    {                                                                                                                  \
        const unsigned v_ = (v);                                                                                       \
        mem[self->dptr] = U8(v_);                                                                                      \
        mem[self->dptr + 1u] = U8(v_ >> 8);                                                                            \
    }
#define RETI_DONE (mcs51_reti(self));
#define RESERVED  COLD(true)
#define SPIN_IF_SELF
#define GO (ip = ip->target);
#define GO_IF(condition)                                                                                               \
    {                                                                                                                  \
        if (condition)                                                                                                 \
        {                                                                                                              \
            ip = ip->target;                                                                                           \
            ENTER                                                                                                      \
        }                                                                                                              \
        ip += OCTETS;                                                                                                  \
    }
#define GO_TO(address)                                                                                                 \
    {                                                                                                                  \
        const unsigned to_ = (address);                                                                                \
        if (to_ >= self->code_octets)                                                                                  \
        {                                                                                                              \
            OUT(0);                                                                                                    \
            self->pc = to_;                                                                                            \
            STOP                                                                                                       \
        }                                                                                                              \
        ip = self->entries + to_;                                                                                      \
    }

#define HANDLER(name, octets, ...)                                                                                     \
    static void name(ARGUMENTS)                                                                                        \
    {                                                                                                                  \
        enum                                                                                                           \
        {                                                                                                              \
            OCTETS = (octets)                                                                                          \
        };                                                                                                             \
        uint8_t* const mem = self->mem;                                                                                \
        (void)mem;                                                                                                     \
        __VA_ARGS__                                                                                                    \
    }
#define GOES_ON(prefix, opcode, octets, cycles, ...)                                                                   \
    HANDLER(prefix##opcode, octets, __VA_ARGS__; ip += OCTETS; CONTINUE)
#define GOES(prefix, opcode, octets, cycles, ...) HANDLER(prefix##opcode, octets, __VA_ARGS__; ENTER)

// A direct operand is memory.
#define READ(x, d)                (x = mem[d]);
#define READ_BIT(x)               READ(x, BIT)
#define LATCH(x, d)               READ(x, d)
#define WRITE(d, v)               (mem[d] = U8(v));
#define OP(opcode, ...)           GOES_ON(plain_, opcode, __VA_ARGS__)
#define OPD(opcode, access, ...)  GOES_ON(plain_, opcode, __VA_ARGS__)
#define JOP(opcode, target, ...)  GOES(plain_, opcode, __VA_ARGS__)
#define JOPD(opcode, access, ...) GOES(plain_, opcode, __VA_ARGS__)
#include "ops.h"

// It is ACC.
#undef READ
#undef WRITE
#undef OP
#undef OPD
#undef JOP
#undef JOPD
#define READ(x, d)  (x = a);
#define WRITE(d, v) (a = U8(v));
#define OP(opcode, ...)
#define OPD(opcode, access, ...) GOES_ON(acc_, opcode, __VA_ARGS__)
#define JOP(opcode, target, ...)
#define JOPD(opcode, access, ...) GOES(acc_, opcode, __VA_ARGS__)
#include "ops.h"

// It is the latch of a port. Nothing is due in a block; where no pin moves, it is memory.
#undef READ
#undef WRITE
#undef OPD
#undef JOPD
#define READ(x, d) (x = mem[d]);
#define WRITE(d, v)                                                                                                    \
    {                                                                                                                  \
        mem[d] = U8(v);                                                                                                \
        if (mcs51_port_drives(self, PORT_AT(d)) != self->out[PORT_AT(d)])                                              \
        {                                                                                                              \
            OUT(OCTETS);                                                                                               \
            mcs51_port_drive(self, PORT_AT(d), mcs51_now(self));                                                       \
            IN;                                                                                                        \
        }                                                                                                              \
    }
#define OPD(opcode, access, octets, cycles, ...) HANDLER(port_##opcode, octets, __VA_ARGS__; ip += OCTETS; ENTER)
#define JOPD(opcode, access, ...)                GOES(port_, opcode, __VA_ARGS__)
#include "ops.h"

// It is what mcs51_read and mcs51_write make of it.
#undef READ
#undef READ_BIT
#undef LATCH
#undef WRITE
#undef OPD
#undef JOPD
#define READ_BY(limit, function, x, d)                                                                                 \
    if (mcs51_left(self) > limit[d])                                                                                   \
    {                                                                                                                  \
        mem[ACC] = (uint8_t)a;                                                                                         \
        x = mem[d];                                                                                                    \
    }                                                                                                                  \
    else                                                                                                               \
    {                                                                                                                  \
        OUT(OCTETS);                                                                                                   \
        x = function(self, d);                                                                                         \
        IN;                                                                                                            \
    }
#define ALL_BITS(self, d) mcs51_read(self, d, 0xFFu)
#define THE_BIT(self, d)  mcs51_read(self, d, MASK)
#define READ(x, d)        READ_BY(mcs51_read_limit, ALL_BITS, x, d)
#define READ_BIT(x)       READ_BY(mcs51_read_limit, THE_BIT, x, BIT)
#define LATCH(x, d)       READ_BY(mcs51_latch_limit, mcs51_read_latch, x, d)
#define WRITE(d, v)                                                                                                    \
    {                                                                                                                  \
        const unsigned written_ = (v);                                                                                 \
        OUT(OCTETS);                                                                                                   \
        if (mcs51_left(self) > mcs51_write_limit[d])                                                                   \
        {                                                                                                              \
            mem[d] = U8(written_);                                                                                     \
        }                                                                                                              \
        else                                                                                                           \
        {                                                                                                              \
            mcs51_write(self, d, U8(written_));                                                                        \
        }                                                                                                              \
        IN;                                                                                                            \
    }
#define OPD(opcode, access, octets, cycles, ...) HANDLER(effect_##opcode, octets, __VA_ARGS__; ip += OCTETS; ENTER)
#define JOPD(opcode, access, ...)                GOES(effect_, opcode, __VA_ARGS__)
#include "ops.h"

#undef OP
#undef OPD
#undef JOP
#undef JOPD
mcs51_handler_fn* const mcs51_handlers[4][256] = {{
#define OP(opcode, ...)   [0x##opcode] = plain_##opcode,
#define OPD(opcode, ...)  [0x##opcode] = plain_##opcode,
#define JOP(opcode, ...)  [0x##opcode] = plain_##opcode,
#define JOPD(opcode, ...) [0x##opcode] = plain_##opcode,
#include "ops.h"
                                                  },
#undef OP
#undef OPD
#undef JOP
#undef JOPD
#define OP(opcode, ...)
#define OPD(opcode, ...) [0x##opcode] = acc_##opcode,
#define JOP(opcode, ...)
#define JOPD(opcode, ...) [0x##opcode] = acc_##opcode,
                                                  {
#include "ops.h"
                                                  },
#undef OPD
#undef JOPD
#define OPD(opcode, ...)  [0x##opcode] = port_##opcode,
#define JOPD(opcode, ...) [0x##opcode] = port_##opcode,
                                                  {
#include "ops.h"
                                                  },
#undef OPD
#undef JOPD
#define OPD(opcode, ...)  [0x##opcode] = effect_##opcode,
#define JOPD(opcode, ...) [0x##opcode] = effect_##opcode,
                                                  {
#include "ops.h"
                                                  }};

void mcs51_leave(ARGUMENTS)
{
    uint8_t* const mem = self->mem;
    (void)bank;
    self->budget += ip->sum;
    OUT(0);
    STOP
}

void mcs51_one(ARGUMENTS)
{
    uint8_t* const mem = self->mem;
    const uint32_t pc = (uint32_t)(ip - self->entries);
    self->budget += ip->sum;
    OUT(0);
    mcs51_plain(self, true);
    mcs51_choose(self, pc);
    if (self->stop || self->self_jump || self->pc >= self->code_octets)
    {
        STOP
    }
    IN;
    ip = self->entries + self->pc;
    ENTER
}

void mcs51_decode_here(ARGUMENTS)
{
    mcs51_decode(self, (uint32_t)(ip - self->entries));
    ENTER
}

/// Cycles to the horizon in which no overflow sets the flag in TCON that is polled.
static uint32_t quiet(const mcs51_t* self, unsigned flag)
{
    const uint32_t cycles = (uint32_t)mcs51_left(self);
    const bool tf0 = flag == 0x20u, tf1 = flag == 0x80u;
    if (!(tf0 || tf1))
    {
        return cycles;
    }
    const uint64_t before = mcs51_timer_next(self, tf1) - 1u - mcs51_now(self);
    return before < cycles ? (uint32_t)before : cycles;
}

static unsigned polled(mcs51_t* self, const entry_t* ip)
{
    const unsigned d = ip->o1;
    return d < 0x80u ? self->mem[d] : ip->opcode == JBC ? mcs51_read_latch(self, d) : mcs51_read(self, d, ip->o2);
}

void mcs51_poll(ARGUMENTS)
{
    const unsigned d = ip->o1;
    ++self->passes;
    if (d == TCON)
    {
        mcs51_timers_sync(self, mcs51_now(self));
    }
    const unsigned octet = (d & 0xCFu) == P0 ? mcs51_port_pins(self, PORT_AT(d)) : self->mem[d];
    if (((octet & ip->o2) != 0) == ip->until)
    {
        INSTEAD(mcs51_handlers[ip->operand][ip->opcode])
    }
    const bool jumps_back = ip->target != ip; // a turn is one instruction of two cycles, or two such
    const uint32_t instructions = (d == TCON ? quiet(self, ip->o2) : (uint32_t)mcs51_left(self)) / 2u;
    self->budget -= (int64_t)((instructions & ~(uint32_t)jumps_back) + jumps_back) * MCS51_SPENT(2, 1);
    if (mcs51_left(self) >= 2)
    {
        ENTER
    }
    // The next poll passes the horizon, and sees what is due until its end, if the jump back has not passed it before.
    uint8_t* const mem = self->mem;
    OUT(0);
    if (self->budget >= 0)
    {
        self->budget -= MCS51_SPENT(2, 1);
        if (((polled(self, ip) & ip->o2) != 0) == ip->until)
        {
            self->budget += MCS51_SPENT(2, 1); // the plain engine executes it
        }
        else
        {
            self->pc += jumps_back ? mcs51_opcodes[JBC].octets : 0u;
        }
    }
    STOP
}

void mcs51_count(ARGUMENTS)
{
    uint8_t* const counter = ip->opcode == 0xD5u ? &self->mem[ip->o1] : &bank[ip->opcode & 7u];
    const unsigned turns = (*counter - 1u) & 0xFFu, fit = (unsigned)mcs51_left(self) / 2u,
                   n = turns < fit ? turns : fit;
    *counter = (uint8_t)(*counter - n);
    self->budget -= (int64_t)n * MCS51_SPENT(2, 1);
    INSTEAD(mcs51_handlers[ip->operand][ip->opcode])
}

static void start(ARGUMENTS)
{
    ENTER
}

void mcs51_fast(mcs51_t* self)
{
    if (self->pc < self->code_octets)
    {
        uint8_t* const mem = self->mem;
        start(self, self->entries + self->pc, mem[ACC], self->cy, self->fx, mem + (mem[PSW] & 0x18u));
#ifndef MCS51_TAIL_CALLS
        while (self->next.ip)
        {
            const mcs51_next_t n = self->next;
            n.ip->run(self, n.ip, n.a, n.cy, n.fx, n.bank);
        }
#endif
    }
}
