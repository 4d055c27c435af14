/// \file   interrupts.c
/// \brief  Interrupt flow of the C28x CPU: IFR, IER, INTM, context (TI SPRUHE8E p. 104, SPRUI07 section 1.6, SPRU430).
///
/// Of the requests that IER lets through the lowest-numbered is taken. As it is, its bits of IFR and IER are cleared, INTM and DBGM set,
/// EALLOW cleared; IRET brings ST1 and IER back. While ENPIE = 0 vectors would come from the boot ROM: not modelled, so none is taken.
/// SPDX-License-Identifier: MIT
#include "device.h"

#define ENPIE 0x0001u

void f2812_interrupts_reset(f2812_t* self)
{
    self->cpu = (f2812_cpu_t){.intm = true, .dbgm = true};
}

void f2812_update_pending(f2812_t* self)
{
    const bool due = !self->cpu.intm && (self->cpu.ifr & self->cpu.ier) != 0;
    const bool enpie = (self->mem[PIECTRL] & ENPIE) != 0;
    if (due && !enpie)
    {
        f2812_report_once(self, EMU_NOT_MODELLED, F2812_ONCE_ENPIE, PIECTRL,
                          "an interrupt with ENPIE = 0 has its vector in the boot ROM; it is not taken");
    }
    self->pending = self->restart || (due && enpie);
}

void f2812_cpu_request(f2812_t* self, unsigned line)
{
    self->cpu.ifr |= (uint16_t)(1u << line);
    f2812_update_pending(self);
}

bool f2812_interrupt_pending(const f2812_t* self)
{
    return self->pending;
}

static unsigned lowest(unsigned set)
{
    unsigned bit = 0;
    while ((set >> bit & 1u) == 0)
    {
        bit++;
    }
    return bit;
}

int f2812_take_interrupt(f2812_t* self, f2812_context_t* saved)
{
    if (!self->pending)
    {
        return F2812_NO_VECTOR;
    }
    if (self->restart)
    {
        self->restart = false;
        f2812_update_pending(self);
        return F2812_VECTOR_RESET;
    }
    f2812_cpu_t* const cpu = &self->cpu;
    const unsigned line = lowest(cpu->ifr & cpu->ier);
    *saved = (f2812_context_t){.ier = cpu->ier, .intm = cpu->intm, .dbgm = cpu->dbgm, .eallow = cpu->eallow};
    cpu->ifr &= (uint16_t) ~(1u << line);
    cpu->ier &= (uint16_t) ~(1u << line);
    cpu->intm = cpu->dbgm = true;
    cpu->eallow = false;
    const unsigned vector = line < F2812_GROUPS ? f2812_pie_fetch(self, line) : line + 1u;
    saved->vector = (uint8_t)vector;
    self->mem[PIECTRL] = (uint16_t)((PIEVECT + 2u * vector) | ENPIE);
    f2812_update_pending(self);
    if (self->observer.interrupt != NULL)
    {
        self->observer.interrupt(self->observer.ctx, vector, true, f2812_sync(self));
    }
    return (int)vector;
}

void f2812_iret(f2812_t* self, const f2812_context_t* saved)
{
    self->cpu.ier = saved->ier;
    self->cpu.intm = saved->intm;
    self->cpu.dbgm = saved->dbgm;
    self->cpu.eallow = saved->eallow;
    f2812_update_pending(self);
    if (self->observer.interrupt != NULL)
    {
        self->observer.interrupt(self->observer.ctx, saved->vector, false, f2812_sync(self));
    }
}

const f2812_cpu_t* f2812_cpu(const f2812_t* self)
{
    return &self->cpu;
}

void f2812_set_ier(f2812_t* self, uint16_t ier)
{
    self->cpu.ier = ier;
    f2812_update_pending(self);
}

void f2812_set_ifr(f2812_t* self, uint16_t ifr)
{
    self->cpu.ifr = ifr;
    f2812_update_pending(self);
}

void f2812_set_intm(f2812_t* self, bool intm)
{
    self->cpu.intm = intm;
    f2812_update_pending(self);
}

void f2812_set_dbgm(f2812_t* self, bool dbgm)
{
    self->cpu.dbgm = dbgm;
}

void f2812_set_eallow(f2812_t* self, bool eallow)
{
    self->cpu.eallow = eallow;
}
