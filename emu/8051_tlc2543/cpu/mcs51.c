/// \file   mcs51.c
/// \brief  The part as a whole: creation, the run loop, idle, power-down, debug access. Atmel 2487D.
/// SPDX-License-Identifier: MIT
#include "engine.h"
#include <stdlib.h>
#include <string.h>

#define LONGEST_SLICE 0x40000000u ///< cycles; `left` has 32 bits, and so has the count of instructions

mcs51_t* mcs51_create(const mcs51_config_t* config)
{
    mcs51_t* const self = calloc(1, sizeof *self);
    if (!self)
    {
        return NULL;
    }
    self->config = *config;
    memset(self->outside, 0xFF, sizeof self->outside);
    memset(self->out, 0xFF, sizeof self->out);
    if (mcs51_memory_create(self) != 0 ||
        !(self->entries = malloc((self->code_octets + MCS51_BEYOND) * sizeof *self->entries)))
    {
        mcs51_destroy(self);
        return NULL;
    }
    self->rst_due = MCS51_NEVER;
    mcs51_forget(self);
    mcs51_reset(self, true);
    return self;
}

void mcs51_destroy(mcs51_t* self)
{
    if (self)
    {
        free(self->xdata);
        free(self->entries);
        free(self);
    }
}

void mcs51_report(mcs51_t* self, emu_report_kind_t kind, uint32_t once, const char* text, uint32_t detail)
{
    if (self->once & once)
    {
        return;
    }
    self->once |= once;
    if (self->config.report.put)
    {
        self->config.report.put(self->config.report.ctx, kind, text, detail,
                                emu_clock_time(&self->config.clock, mcs51_cycle(self)));
    }
}

static uint64_t earlier(uint64_t a, uint64_t b)
{
    return a < b ? a : b;
}

uint64_t mcs51_cycle(const mcs51_t* self)
{
    return mcs51_now(self);
}

uint64_t mcs51_instructions(const mcs51_t* self)
{
    return self->instructions + (uint32_t)self->budget;
}

uint64_t mcs51_passes(const mcs51_t* self)
{
    return self->passes;
}

uint64_t mcs51_interrupts(const mcs51_t* self)
{
    return self->interrupts;
}

void mcs51_look_at(mcs51_t* self, uint64_t cycle)
{
    if (cycle <= self->horizon)
    {
        const uint64_t now = mcs51_now(self);
        self->horizon = cycle - 1u;
        mcs51_set_left(self, (int64_t)(cycle - now) - 1);
    }
}

void mcs51_shorten(mcs51_t* self, uint64_t cycle)
{
    if (cycle < self->until)
    {
        self->until = cycle;
        self->attend_at = earlier(self->attend_at, cycle);
        mcs51_look_at(self, cycle);
    }
}

/// First boundary after this one at which an interrupt is to be looked at.
static uint64_t request_after(const mcs51_t* self, uint64_t now)
{
    return mcs51_requested(self) ? now + 1u : MCS51_NEVER;
}

static void set_horizon(mcs51_t* self, uint64_t now, uint64_t request)
{
    uint64_t next = earlier(earlier(self->attend_at, now + LONGEST_SLICE), earlier(request, self->periph_at));
    next = earlier(next, self->overflow_known ? self->overflow_boundary : mcs51_overflow_next(self));
    self->horizon = (next > now ? next : now) - 1u;
    self->instructions += (uint32_t)self->budget;
    self->budget = (int64_t)(self->horizon - now) * (INT64_C(1) << 32);
}

void mcs51_look_ahead(mcs51_t* self, uint64_t now)
{
    if (mcs51_left(self) < 0)
    {
        mcs51_look_at(self, now);
    }
    else
    {
        set_horizon(self, now, request_after(self, now));
    }
}

/// The oscillator stands still: nothing counts for that long.
static void freeze(mcs51_t* self, uint64_t now, uint64_t until)
{
    for (unsigned n = 0; n < TIMERS; ++n)
    {
        self->timer_at[n] += until - now;
    }
    self->overflow_known = false;
    self->frozen += until - now;
    self->wdt_due += self->wdt_due == MCS51_NEVER ? 0 : until - now;
    self->pins_due += self->pins_due == MCS51_NEVER ? 0 : until - now;
    self->horizon = until - 1u;
    mcs51_set_left(self, -1);
    mcs51_plan(self);
}

/// What the run loop does next.
typedef enum step_t
{
    GO_ON, ///< execute
    AGAIN, ///< look at everything once more
    LEAVE  ///< return *stop
} step_t;

/// What comes before the events that are due.
static step_t attend_first(mcs51_t* self, uint64_t now, mcs51_stop_t* stop)
{
    if ((self->reset_request != RESET_NONE || self->rst_due <= now) && mcs51_reset_due(self, earlier(now, self->until)))
    {
        return AGAIN;
    }
    if (!(self->mem[PCON] & PCON_PD) || self->stop)
    {
        return GO_ON;
    }
    if (now < self->until)
    {
        freeze(self, now, self->until);
    }
    *stop = MCS51_POWER_DOWN;
    return LEAVE;
}

/// What comes after them.
static step_t attend(mcs51_t* self, uint64_t now, mcs51_stop_t* stop)
{
    if (self->stop)
    {
        self->stop = false;
        *stop = MCS51_STOPPED;
        return LEAVE;
    }
    if (now >= self->until)
    {
        *stop = self->halted ? MCS51_HALTED : MCS51_RAN;
        return LEAVE;
    }
    self->attend_at = earlier(self->until, earlier(self->wdt_due, self->rst_due));
    if (self->in_reset)
    {
        set_horizon(self, now, MCS51_NEVER);
        mcs51_set_left(self, -1);
        self->attend_at = 0;
        return AGAIN;
    }
    if (now >= self->wdt_due)
    {
        mcs51_watchdog_reset(self);
        return AGAIN;
    }
    if (self->reset_request != RESET_NONE)
    {
        self->attend_at = 0;
    }
    return GO_ON;
}

static mcs51_stop_t run(mcs51_t* self)
{
    mcs51_stop_t stop = MCS51_RAN;
    for (;; ++self->passes)
    {
        const uint64_t now = mcs51_now(self), limit = earlier(now, self->until);
        step_t step = now >= self->attend_at ? attend_first(self, now, &stop) : GO_ON;
        if (step == GO_ON)
        {
            mcs51_sync(self, limit);
            if (limit >= self->overflow_at)
            {
                mcs51_timers_sync(self, limit);
                self->overflow_at = MCS51_NEVER;
                self->overflow_known = false;
            }
            step = now >= self->attend_at ? attend(self, now, &stop) : GO_ON;
        }
        if (step == LEAVE)
        {
            return stop;
        }
        if (step == AGAIN || (mcs51_requested(self) && mcs51_interrupt(self, now)))
        {
            continue;
        }
        set_horizon(self, now, request_after(self, now));
        if (self->mem[PCON] & PCON_IDL)
        {
            if ((self->mem[AUXR] & AUXR_WDIDLE) && self->wdt_due != MCS51_NEVER)
            {
                self->wdt_due += self->horizon + 1u - now;
            }
            mcs51_set_left(self, -1);
            continue;
        }
        if (!self->observed)
        {
            mcs51_fast(self);
        }
        if (self->budget >= 0 && !self->stop && !self->self_jump)
        {
            mcs51_plain(self, false);
        }
        if (self->self_jump)
        {
            self->self_jump = false;
            const bool was_halted = self->halted;
            self->halted = !(self->mem[IE] & IE_EA) && self->wdt_due == MCS51_NEVER;
            if (self->halted && !was_halted)
            {
                return MCS51_HALTED;
            }
            const bool each = self->observer.step || (self->marks[self->pc] & MARK_BREAK);
            self->budget -= (each ? 1 : mcs51_left(self) / 2 + 1) * MCS51_SPENT(2, 1);
        }
    }
}

mcs51_stop_t mcs51_run(mcs51_t* self, uint64_t until_cycle)
{
    self->until = until_cycle;
    self->attend_at = 0;
    self->running = true;
    self->overflow_known = false;
    const mcs51_stop_t stop = run(self);
    self->running = false;
    return stop;
}

uint16_t mcs51_pc(const mcs51_t* self)
{
    return (uint16_t)self->pc;
}

void mcs51_set_pc(mcs51_t* self, uint16_t pc)
{
    self->pc = pc;
    self->passed_pc = NO_PC;
    self->halted = false;
}

uint8_t mcs51_sfr(mcs51_t* self, uint8_t address)
{
    if (address < 0x80u)
    {
        return MCS51_ABSENT_SFR;
    }
    if (address == PSW)
    {
        return mcs51_psw(self);
    }
    // cppcheck-suppress arrayIndexOutOfBoundsCond  // 256 is no uint8_t
    if (mcs51_read_limit[address] != INT32_MIN) // not plain memory at any time
    {
        const uint64_t limit = earlier(mcs51_cycle(self), self->until);
        mcs51_sync(self, limit);
        mcs51_timers_sync(self, limit);
    }
    return self->mem[address];
}

void mcs51_set_sfr(mcs51_t* self, uint8_t address, uint8_t value)
{
    if (address >= 0x80u)
    {
        mcs51_write(self, address, value);
    }
}
