/// \file   watchdog.c
/// \brief  Watchdog: an 8-bit counter of OSCCLK / 512 / prescale that resets the device or interrupts (TI SPRU078, SPRUI07 section 1.3.4).
///
/// 55h and, as the next write, AAh to WDKEY clear the counter; anything else there does nothing. WDCHK other than 101 trips at once, as does
/// an overflow: /XRS goes low for 512 OSCCLK, or with WDENINT WAKEINT comes and WDINTS is 0 for as long. WDDIS can be written while
/// WDOVERRIDE is 1, which is cleared by writing 1. Clearing the counter and another prescale begin the prescaler anew: no source at hand.
/// SPDX-License-Identifier: MIT
#include "../cpu/device.h"

#define WD_OSCCLK   512u ///< of one WDCLK, and of a pulse
#define WD_COUNTS   256u
#define WDCHK_GOOD  5u
#define WD_VECTOR   (F2812_VECTOR_PIE + 7u) ///< WAKEINT, 1.8
#define WDOVERRIDE  0x0001u
#define WDENINT     0x0002u
#define WDINTS      0x0004u
#define WDPS        0x0007u
#define WDDIS       0x0040u
#define WDFLAG      0x0080u
#define WDCHK_SHIFT 3

static uint64_t step(const f2812_t* self)
{
    const unsigned wdps = self->mem[WDCR] & WDPS;
    return (uint64_t)WD_OSCCLK << (wdps != 0 ? wdps - 1u : 0u);
}

static bool counts(const f2812_t* self)
{
    return (self->mem[WDCR] & WDDIS) == 0 && !self->in_reset;
}

static uint8_t count(const f2812_t* self)
{
    const f2812_watchdog_t* const w = &self->watchdog;
    return (uint8_t)(counts(self) ? w->count + (f2812_osc_tick(self) - w->at) / step(self) : w->count);
}

void f2812_watchdog_plan(f2812_t* self)
{
    f2812_watchdog_t* const w = &self->watchdog;
    emu_sched_cancel(self->sched, &w->overflow);
    if (counts(self))
    {
        const uint64_t tick = w->at + (WD_COUNTS - w->count) * step(self);
        emu_sched_at(self->sched, &w->overflow, emu_ticker_ahead(&self->osc, tick));
    }
    if (w->pulse.pending)
    {
        emu_sched_at(self->sched, &w->pulse, emu_ticker_ahead(&self->osc, w->pulse_tick));
    }
}

static void begin(f2812_t* self, uint8_t from)
{
    self->watchdog.count = from;
    self->watchdog.at = f2812_osc_tick(self);
}

static void trip(f2812_t* self, const char* why)
{
    f2812_watchdog_t* const w = &self->watchdog;
    w->pulse_tick = f2812_osc_tick(self) + WD_OSCCLK;
    emu_sched_at(self->sched, &w->pulse, emu_ticker_ahead(&self->osc, w->pulse_tick));
    if ((self->mem[SCSR] & WDENINT) != 0)
    {
        self->mem[SCSR] &= (uint16_t)~WDINTS;
        f2812_pie_request(self, WD_VECTOR);
        return;
    }
    f2812_report(self, EMU_GUEST_ERROR, WDCR, why);
    w->resets = true;
    emu_wire_drive(&self->xrs, self->xrs_driver, EMU_STRONG0, self->sched->now);
}

static void overflowed(void* ctx, emu_time_t at)
{
    (void)at;
    f2812_t* const self = ctx;
    begin(self, 0);
    f2812_watchdog_plan(self);
    trip(self, "the watchdog was not served in time: reset");
}

static void pulse_ended(void* ctx, emu_time_t at)
{
    f2812_t* const self = ctx;
    self->mem[SCSR] |= WDINTS;
    if (self->watchdog.resets)
    {
        emu_wire_drive(&self->xrs, self->xrs_driver, EMU_WEAK1, at);
        self->watchdog.resets = false;
    }
}

void f2812_watchdog_init(f2812_t* self)
{
    self->watchdog.overflow = (emu_event_t){.fire = overflowed, .ctx = self};
    self->watchdog.pulse = (emu_event_t){.fire = pulse_ended, .ctx = self};
}

void f2812_watchdog_reset(f2812_t* self, f2812_reset_t cause)
{
    if (!self->watchdog.resets)
    {
        emu_sched_cancel(self->sched, &self->watchdog.pulse);
    }
    self->watchdog.armed = false;
    self->mem[WDCR] = cause == F2812_RESET_WATCHDOG ? WDFLAG : 0;
    begin(self, 0);
}

uint16_t f2812_watchdog_peek(const f2812_t* self, uint16_t address)
{
    return address == WDCNTR ? count(self) : self->mem[WDCR]; // WDKEY reads as WDCR
}

static void write_key(f2812_t* self, unsigned key)
{
    if (key == 0xAAu && self->watchdog.armed)
    {
        begin(self, 0);
        f2812_watchdog_plan(self);
    }
    self->watchdog.armed = key == 0x55u;
}

static void write_wdcr(f2812_t* self, unsigned value)
{
    if ((value >> WDCHK_SHIFT & 7u) != WDCHK_GOOD)
    {
        trip(self, "WDCHK is not 101: reset");
        return;
    }
    begin(self, count(self));
    unsigned wddis = self->mem[WDCR] & WDDIS;
    if ((self->mem[SCSR] & WDOVERRIDE) != 0)
    {
        wddis = value & WDDIS;
    }
    else if ((value & WDDIS) != wddis)
    {
        f2812_report(self, EMU_GUEST_ERROR, WDCR, "WDDIS written while WDOVERRIDE is 0; it stays");
    }
    const unsigned wdflag = self->mem[WDCR] & ~value & WDFLAG;
    self->mem[WDCR] = (uint16_t)(wdflag | wddis | (value & WDPS));
    f2812_watchdog_plan(self);
}

static void write_scsr(f2812_t* self, unsigned value)
{
    const unsigned kept = self->mem[SCSR] & (WDINTS | (WDOVERRIDE & ~value));
    self->mem[SCSR] = (uint16_t)(kept | (value & WDENINT));
}

void f2812_watchdog_write(f2812_t* self, uint16_t address, uint16_t value)
{
    value &= self->map[address].writable;
    (void)f2812_sync(self);
    if (address == WDKEY)
    {
        write_key(self, value);
    }
    else if (address == WDCR)
    {
        write_wdcr(self, value);
    }
    else if (address == SCSR)
    {
        write_scsr(self, value);
    }
}
