/// SCICLK: LSPCLK by BRR + 1, free running, and what makes it stand. (TI SPRU051, "SCI Baud Rate Calculation"; for BRR = 0 LSPCLK / 16.)
/// SPDX-License-Identifier: MIT
#include "sci_internal.h"

static bool runs(const sci_t* self)
{
    return self->clocked && !self->halted;
}

uint64_t sci_tick(const sci_t* self)
{
    return f2812_clock_tick(self->env.lspclk, self->env.sched->now + 1);
}

uint64_t sci_sciclk(const sci_t* self)
{
    const uint64_t tick = runs(self) ? sci_tick(self) : 0;
    return tick <= self->tick ? self->sciclk : self->sciclk + (tick - self->tick + self->divider - 1u) / self->divider;
}

emu_time_t sci_sciclk_time(const sci_t* self, uint64_t n)
{
    return runs(self) ? f2812_clock_time(self->env.lspclk, self->tick + (n - self->sciclk) * self->divider)
                      : EMU_TIME_MAX;
}

static void rearm(sci_t* self)
{
    sci_tx_arm(self);
    sci_rx_arm(self, true);
}

void sci_divide(sci_t* self)
{
    const uint32_t brr = (uint32_t)self->reg[SCIHBAUD] << 8 | self->reg[SCILBAUD];
    self->sciclk = sci_sciclk(self);
    self->divider = brr == 0 ? 2u : brr + 1u;
    self->tick = self->divider - 1u + (runs(self) ? sci_tick(self) : 0u);
    rearm(self);
}

void sci_run(sci_t* self, bool* what, bool on)
{
    const bool ran = runs(self);
    sci_rx_catch_up(self);
    const uint64_t next = sci_sciclk(self), tick = self->tick + (next - self->sciclk) * self->divider;
    *what = on;
    if (runs(self) != ran)
    {
        self->sciclk = next;
        self->tick = ran ? tick - sci_tick(self) : tick + sci_tick(self);
        rearm(self);
    }
}

void sci_clock(sci_t* self, bool enabled)
{
    sci_run(self, &self->clocked, enabled);
}

void sci_clock_changed(sci_t* self)
{
    rearm(self);
}

void sci_emulation_stop(sci_t* self, bool stopped)
{
    sci_rx_catch_up(self);
    self->finishing = stopped && (self->reg[SCIPRI] & (SCIPRI_FREE | SCIPRI_SOFT)) == SCIPRI_SOFT;
    sci_run(self, &self->halted, stopped && !sci_is(self, SCIPRI, SCIPRI_FREE | SCIPRI_SOFT));
    sci_rx_arm(self, false);
    sci_tx_go(self);
}
