/// \file   interrupts.c
/// \brief  Five sources, six on the AT89S52, two priorities (MCS-51 hardware description, "Interrupts"). Unit: machine cycle.
///
/// A flag that is up at cycle t is polled in the cycle that begins at t; the vector is taken at the first instruction boundary after it
/// unless the instruction that ends there is RETI or wrote IE or IP. The hardware LCALL takes 2 cycles: 3 to 8 from flag to handler.
/// SPDX-License-Identifier: MIT
#include "engine.h"

void mcs51_raise(mcs51_t* self, unsigned irq, unsigned sfr, uint8_t flag, uint64_t at)
{
    const uint8_t shared = irq == IRQ_SERIAL ? SCON_RI | SCON_TI : irq == IRQ_T2 ? mcs51_t2_requests(self) : flag;
    if (!(self->mem[sfr] & shared))
    {
        self->flag_at[irq] = at;
    }
    self->mem[sfr] |= flag;
}

/// Requests that are enabled and not held back by a handler in progress, by bit of IE; `high` tells those of high priority.
static unsigned requests(const mcs51_t* self, unsigned* high)
{
    const uint8_t* const mem = self->mem;
    const unsigned tcon = mem[TCON], ie = mem[IE];
    if (!(ie & IE_EA) || (self->in_service & 2u))
    {
        return 0;
    }
    unsigned flags = (tcon >> 1 & 1u) | (tcon >> 4 & 2u) | (tcon >> 1 & 4u) | (tcon >> 4 & 8u);
    flags |= mem[SCON] & (SCON_RI | SCON_TI) ? 16u : 0u;
    flags |= mem[T2CON] && (mem[T2CON] & mcs51_t2_requests(self)) ? 32u : 0u;
    flags &= ie & 0x3Fu;
    if (!flags)
    {
        return 0;
    }
    *high = flags & mem[IP];
    return self->in_service ? *high : flags;
}

uint64_t mcs51_interrupt_next(mcs51_t* self, uint64_t now)
{
    unsigned high;
    return requests(self, &high) ? now + 1u : MCS51_NEVER;
}

static void push(mcs51_t* self, unsigned octet)
{
    const uint8_t at = ++self->mem[SP];
    if (at - 1u < self->stack_top)
    {
        self->mem[at + (at & 0x80u)] = (uint8_t)octet;
    }
    else
    {
        mcs51_push_beyond(self, at, (uint8_t)octet);
    }
    mcs51_seen(self, MCS51_IRAM, at, (uint8_t)octet, true);
}

bool mcs51_interrupt(mcs51_t* self, uint64_t now, uint64_t* next)
{
    unsigned high = 0, due = requests(self, &high);
    *next = due ? now + 1u : MCS51_NEVER;
    if (!due || self->gate_at >= now)
    {
        return false;
    }
    for (unsigned i = 0; i < IRQ_COUNT; ++i)
    {
        if (self->flag_at[i] >= now)
        {
            due &= ~(1u << i);
        }
    }
    if (!due)
    {
        return false;
    }
    const bool is_high = (due & high) != 0;
    const unsigned candidates = is_high ? due & high : due;
    unsigned irq = 0;
    while (!(candidates >> irq & 1u))
    {
        ++irq;
    }
    // The vector clears the flag, except those of the serial port and timer 2 and a level-triggered external one.
    static const uint8_t cleared[IRQ_COUNT] = {0x02, 0x20, 0x08, 0x80, 0, 0};
    const bool external = irq == IRQ_INT0 || irq == IRQ_INT1;
    if (!external || (self->mem[TCON] & (cleared[irq] >> 1)))
    {
        self->mem[TCON] &= (uint8_t)~cleared[irq];
    }
    self->overflow_known = false;
    self->in_service |= is_high ? 2u : 1u;
    self->mem[PCON] &= (uint8_t)~PCON_IDL;
    if (self->observer.vector)
    {
        self->observer.vector(self->observer.ctx, irq, (uint16_t)self->pc, now);
    }
    self->budget -= MCS51_SPENT(2, 0);
    push(self, self->pc & 0xFFu);
    push(self, self->pc >> 8);
    self->pc = 8u * irq + 3u;
    ++self->interrupts;
    return true;
}

void mcs51_reti(mcs51_t* self)
{
    const uint64_t now = mcs51_now(self);
    self->in_service &= self->in_service & 2u ? 1u : 0u;
    self->gate_at = now;
    mcs51_look_at(self, mcs51_interrupt_next(self, now));
}
