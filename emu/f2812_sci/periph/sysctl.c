/// \file   sysctl.c
/// \brief  Clock tree: PLLCR with its lock time, LOSPCP, PCLKCR (TI SPRS174, SPRU078; PLLCR.DIV as in SPRS357, the F28044's).
///
/// PLLCR.DIV = 0: SYSCLKOUT = OSCCLK / 2; 1 .. 10: OSCCLK * DIV / 2, once the PLL has locked. LSPCLK = SYSCLKOUT / (LOSPCP, 0: 1; n: 2 n).
/// SPDX-License-Identifier: MIT
#include "../cpu/device.h"

#define LOCK_OSCCLK      131072u ///< after a change of PLLCR; the CPU runs at OSCCLK / 2 meanwhile
#define DIV_MAX          10u
#define PCLKCR_CYCLES    2u ///< from the write to the clock
#define SYSCLKOUT_HZ_MAX UINT64_C(150000000)

uint64_t f2812_osc_tick(const f2812_t* self)
{
    return emu_ticker_tick(&self->osc, self->sched->now + 1) - 1u;
}

static emu_clock_t rate(const f2812_t* self, unsigned div)
{
    return (emu_clock_t){.hz = self->config.oscclk_hz * (div != 0 ? div : 1u), .divider = 2};
}

static void run_at(f2812_t* self, unsigned div)
{
    const emu_clock_t clock = rate(self, div);
    emu_ticker_clock(&self->sysclk, self->cycle, &clock);
    f2812_rate_changed(self);
}

static void locked(void* ctx, emu_time_t at)
{
    (void)at;
    f2812_t* const self = ctx;
    run_at(self, self->mem[PLLCR]);
}

static void clocks_change(void* ctx, emu_time_t at)
{
    (void)at;
    f2812_t* const self = ctx;
    self->clocks = self->mem[PCLKCR];
    f2812_map_clocks(self);
    f2812_serial_clocks(self);
}

void f2812_sysctl_init(f2812_t* self)
{
    const emu_clock_t osc = {.hz = self->config.oscclk_hz, .divider = 1}, sysclk = rate(self, 0);
    emu_ticker_init(&self->osc, &osc);
    emu_ticker_init(&self->sysclk, &sysclk);
    f2812_clock_init(&self->lspclk, &self->sysclk, 1);
    self->lock = (emu_event_t){.fire = locked, .ctx = self};
    self->clocks_change = (emu_event_t){.fire = clocks_change, .ctx = self};
}

static void divide(f2812_t* self)
{
    const unsigned n = self->mem[LOSPCP];
    f2812_clock_divide(&self->lspclk, self->cycle, n != 0 ? 2u * n : 1u);
}

void f2812_sysctl_reset(f2812_t* self)
{
    const emu_clock_t clock = rate(self, 0);
    emu_sched_cancel(self->sched, &self->lock);
    emu_sched_cancel(self->sched, &self->clocks_change);
    emu_ticker_clock(&self->sysclk, self->cycle, &clock);
    self->clocks = 0;
    f2812_map_clocks(self);
    divide(self);
}

void f2812_sysctl_plan(f2812_t* self)
{
    if (self->lock.pending)
    {
        emu_sched_at(self->sched, &self->lock, emu_ticker_ahead(&self->osc, self->lock_tick));
    }
}

static void write_pllcr(f2812_t* self, unsigned div)
{
    if (div > DIV_MAX)
    {
        f2812_report(self, EMU_GUEST_ERROR, PLLCR, "DIV of 11 to 15 is reserved; the write is lost");
        return;
    }
    if (div == self->mem[PLLCR])
    {
        return;
    }
    if (self->config.oscclk_hz * div > 2u * SYSCLKOUT_HZ_MAX)
    {
        f2812_report(self, EMU_GUEST_ERROR, PLLCR, "SYSCLKOUT will be above 150 MHz");
    }
    self->mem[PLLCR] = (uint16_t)div;
    emu_sched_cancel(self->sched, &self->lock);
    if (div != 0)
    {
        self->lock_tick = f2812_osc_tick(self) + LOCK_OSCCLK;
        emu_sched_at(self->sched, &self->lock, emu_ticker_ahead(&self->osc, self->lock_tick));
    }
    run_at(self, 0);
}

void f2812_sysctl_write(f2812_t* self, uint16_t address, uint16_t value)
{
    value &= self->map[address].writable;
    (void)f2812_sync(self);
    if (address == PLLCR)
    {
        write_pllcr(self, value);
        return;
    }
    self->mem[address] = value;
    if (address == LOSPCP)
    {
        divide(self);
        f2812_rate_changed(self);
    }
    else
    {
        emu_sched_at(self->sched, &self->clocks_change, emu_ticker_ahead(&self->sysclk, self->cycle + PCLKCR_CYCLES));
    }
}
