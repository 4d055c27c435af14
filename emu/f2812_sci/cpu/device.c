/// \file   device.c
/// \brief  The device as a whole: creation, reset, passing of time, pins by name.
///
/// The present is a cycle of SYSCLKOUT. Nothing is due before cycle `due`, so until then passing time is an addition; from there on the
/// events are fired one cycle after the other, since each may change the rate at which the cycles after it come.
/// SPDX-License-Identifier: MIT
#include "device.h"
#include <stdlib.h>
#include <string.h>

static void look_ahead(f2812_t* self)
{
    self->due = emu_ticker_tick(&self->sysclk, emu_sched_next(self->sched));
}

static void earlier(void* ctx, emu_time_t at)
{
    f2812_t* const self = ctx;
    self->due = emu_ticker_tick(&self->sysclk, at);
}

/// Fire what is due up to and with the present cycle.
static void fire(f2812_t* self)
{
    const uint64_t cycle = self->cycle;
    self->firing = true;
    while (self->due <= cycle)
    {
        self->cycle = self->due;
        emu_sched_advance(self->sched, emu_ticker_time(&self->sysclk, self->cycle));
        look_ahead(self);
    }
    self->firing = false;
    self->cycle = cycle;
}

void f2812_advance(f2812_t* self, uint32_t cycles)
{
    self->cycle += cycles;
    if (self->cycle >= self->due)
    {
        fire(self);
    }
}

static void go_on(f2812_t* self, emu_time_t limit)
{
    const emu_time_t next = emu_sched_next(self->sched);
    const uint64_t cycle = emu_ticker_tick(&self->sysclk, next < limit ? next : limit);
    if (cycle > self->cycle)
    {
        self->cycle = cycle;
    }
    if (self->cycle >= self->due)
    {
        fire(self);
    }
}

emu_time_t f2812_skip(f2812_t* self, emu_time_t limit)
{
    if (!self->pending)
    {
        go_on(self, limit);
    }
    return f2812_sync(self);
}

emu_time_t f2812_idle(f2812_t* self, emu_time_t limit)
{
    if ((self->mem[LPMCR0] & 3u) != 0)
    {
        f2812_report_once(self, EMU_NOT_MODELLED, F2812_ONCE_LPM, LPMCR0,
                          "not modelled: STANDBY and HALT; IDLE leaves the clocks on");
    }
    while (!self->restart && (self->cpu.ifr & self->cpu.ier) == 0 && f2812_sync(self) < limit)
    {
        go_on(self, limit);
    }
    return f2812_sync(self);
}

emu_time_t f2812_now(f2812_t* self)
{
    return f2812_sync(self);
}

uint64_t f2812_cycle(const f2812_t* self)
{
    return self->cycle;
}

uint64_t f2812_due(const f2812_t* self)
{
    return self->due;
}

void f2812_rate_changed(f2812_t* self)
{
    f2812_sysctl_plan(self);
    f2812_timers_plan(self);
    f2812_watchdog_plan(self);
    f2812_serial_clock_changed(self);
    look_ahead(self);
}

void f2812_set_osc_ppb(f2812_t* self, int32_t ppb)
{
    emu_ticker_rate(&self->osc, emu_ticker_tick(&self->osc, f2812_sync(self)), ppb);
    emu_ticker_rate(&self->sysclk, self->cycle, ppb);
    f2812_rate_changed(self);
}

void f2812_reset(f2812_t* self, f2812_reset_t cause)
{
    (void)f2812_sync(self);
    self->told = 0;
    f2812_map_reset(self);
    f2812_interrupts_reset(self);
    f2812_sysctl_reset(self);
    f2812_timers_reset(self);
    f2812_watchdog_reset(self, cause);
    f2812_gpio_reset(self);
    f2812_serial_reset(self);
    f2812_rate_changed(self);
    self->restart = true;
    f2812_update_pending(self);
}

bool f2812_in_reset(const f2812_t* self)
{
    return self->in_reset;
}

static void xrs_moved(void* ctx, bool level, emu_time_t at)
{
    (void)at;
    f2812_t* const self = ctx;
    self->in_reset = !level;
    // Counted anew from the rising edge as well: the watchdog begins when the reset ends.
    f2812_reset(self, self->watchdog.resets ? F2812_RESET_WATCHDOG : F2812_RESET_XRS);
}

f2812_t* f2812_create(const f2812_config_t* config, emu_sched_t* sched)
{
    if (config->oscclk_hz < F2812_OSCCLK_HZ_MIN || config->oscclk_hz > F2812_OSCCLK_HZ_MAX)
    {
        return NULL;
    }
    f2812_t* const self = calloc(1, sizeof *self);
    if (self == NULL)
    {
        return NULL;
    }
    self->config = *config;
    self->unobserved = F2812_WORDS;
    self->sched = sched;
    sched->earlier = earlier;
    sched->earlier_ctx = self;
    f2812_sysctl_init(self);
    self->cycle = emu_ticker_tick(&self->sysclk, sched->now);
    f2812_timers_init(self);
    f2812_watchdog_init(self);
    f2812_gpio_init(self);
    f2812_xint_init(self);
    (void)f2812_serial_init(self); // nobody else is on the wires yet
    emu_wire_init(&self->xrs, "XRS", true);
    self->xrs_driver = emu_wire_add_driver(&self->xrs);
    emu_wire_drive(&self->xrs, self->xrs_driver, EMU_WEAK1, sched->now);
    (void)emu_wire_watch(&self->xrs, xrs_moved, self);
    f2812_reset(self, F2812_RESET_XRS);
    self->restart = self->pending = false;
    return self;
}

void f2812_destroy(f2812_t* self)
{
    if (self == NULL)
    {
        return;
    }
    emu_event_t* const events[] = {&self->lock, &self->clocks_change, &self->watchdog.overflow, &self->watchdog.pulse};
    for (unsigned i = 0; i < sizeof events / sizeof events[0]; i++)
    {
        emu_sched_cancel(self->sched, events[i]);
    }
    for (unsigned n = 0; n < F2812_TIMERS; n++)
    {
        emu_sched_cancel(self->sched, &self->timer[n].event);
    }
    for (unsigned n = 0; n < F2812_SCIS; n++)
    {
        emu_sched_cancel(self->sched, &self->serial[n].sci.tx.event);
        emu_sched_cancel(self->sched, &self->serial[n].sci.rx.event);
    }
    self->sched->earlier = NULL;
    free(self);
}

emu_wire_t* f2812_wire(f2812_t* self, const char* name)
{
    static const struct
    {
        const char *name, *pin;
    } sci[] = {{"SCITXDA", "GPIOF4"}, {"SCIRXDA", "GPIOF5"}, {"SCITXDB", "GPIOG4"}, {"SCIRXDB", "GPIOG5"}};
    if (strcmp(name, self->xrs.name) == 0)
    {
        return &self->xrs;
    }
    for (unsigned i = 0; i < sizeof sci / sizeof sci[0]; i++)
    {
        name = strcmp(name, sci[i].name) == 0 ? sci[i].pin : name;
    }
    for (unsigned port = 0; port < F2812_PORTS; port++)
    {
        for (unsigned bit = 0; bit < F2812_PORT_PINS; bit++)
        {
            f2812_pin_t* const pin = &self->pin[port][bit];
            if (pin->name[0] != '\0' && strcmp(name, pin->name) == 0)
            {
                return &pin->wire;
            }
        }
    }
    return NULL;
}
