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

void mcs51_requests_change(mcs51_t* self)
{
    const unsigned ie = self->mem[IE], above = self->in_service ? self->mem[IP] : 0xFFu;
    const unsigned able = (ie & IE_EA) && !(self->in_service & 2u) ? ie & above : 0u;
    self->ask_tcon = (uint8_t)((able & 5u) << 1 | (able & 10u) << 4);
    self->ask_scon = able & 1u << IRQ_SERIAL ? SCON_RI | SCON_TI : 0u;
    self->ask_t2con = able & 1u << IRQ_T2 ? mcs51_t2_requests(self) : 0u;
}

/// By bit of IE.
static unsigned requests(const mcs51_t* self)
{
    const unsigned tcon = self->mem[TCON] & self->ask_tcon;
    return (tcon >> 1 & 5u) | (tcon >> 4 & 10u) | (self->mem[SCON] & self->ask_scon ? 1u << IRQ_SERIAL : 0u) |
           (self->mem[T2CON] & self->ask_t2con ? 1u << IRQ_T2 : 0u);
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

bool mcs51_interrupt(mcs51_t* self, uint64_t now)
{
    unsigned due = self->gate_at < now ? requests(self) : 0u;
    for (unsigned i = 0; due >> i; ++i)
    {
        due &= self->flag_at[i] < now ? UINT32_MAX : ~(1u << i);
    }
    if (!due)
    {
        return false;
    }
    const unsigned high = due & self->mem[IP], candidates = high ? high : due;
    unsigned irq = 0;
    while (!(candidates >> irq & 1u))
    {
        ++irq;
    }
    if (irq == IRQ_T0 || irq == IRQ_T1) // what has overflowed meanwhile is the same request
    {
        mcs51_timer_sync(self, 0, now); // it has TF1 in mode 3
        mcs51_timer_sync(self, 1, now);
    }
    // The vector clears the flag, except those of the serial port and timer 2 and a level-triggered external one.
    static const uint8_t cleared[IRQ_COUNT] = {0x02, 0x20, 0x08, 0x80, 0, 0};
    const bool external = irq == IRQ_INT0 || irq == IRQ_INT1;
    if (!external || (self->mem[TCON] & (cleared[irq] >> 1)))
    {
        self->mem[TCON] &= (uint8_t)~cleared[irq];
    }
    self->overflow_known = false;
    self->in_service |= high ? 2u : 1u;
    mcs51_requests_change(self);
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
    mcs51_requests_change(self);
    if (mcs51_requested(self))
    {
        mcs51_look_at(self, now + 1u);
    }
}
