/// \file   reset.c
/// \brief  Reset by pin, by power and by the watchdog (Atmel 2487D, "Program Memory", "Watchdog Timer", "Power Off Flag").
///
/// RST is taken after two machine cycles high, at once where the oscillator stands; [U] its start-up takes no time. The part leaves
/// reset in the cycle in which RST falls. Callbacks may ask for a reset at any time: it comes at the next instruction boundary.
/// SPDX-License-Identifier: MIT
#include "engine.h"
#include <string.h>

#define RST_CYCLES 2u ///< RST must be high for as long

static void reset(mcs51_t* self, bool power_on)
{
    static const uint8_t ports[4] = {P0, P1, P2, P3};
    const uint64_t now = mcs51_cycle(self);
    uint8_t* const mem = self->mem;
    const uint8_t pof = power_on ? PCON_POF : mem[PCON] & PCON_POF;
    const uint8_t received = mem[SBUF]; // SBUF is undefined after reset: kept

    mcs51_timers_sync(self, now); // overflows so far are where the divider for the baud stands
    memset(mem + 0x80, 0, 0x80);
    mem[SP] = 0x07;
    mem[PCON] = pof;
    mem[SBUF] = power_on ? 0 : received;
    for (unsigned i = 0; i < 4; ++i)
    {
        mem[ports[i]] = 0xFF;
    }
    self->pc = 0;
    self->cy = 0;
    self->fx = 0;
    self->dptr = DP0L;
    self->in_service = 0;
    self->passed_pc = NO_PC;
    self->self_jump = false;
    self->halted = false;
    self->overflow_at = MCS51_NEVER;
    self->overflow_known = false;
    self->gate_at = 0;
    memset(self->flag_at, 0, sizeof self->flag_at);
    self->wdt_due = MCS51_NEVER;
    self->wdt_armed = false;
    self->once = 0;
    memset(self->absent_sfr, 0, sizeof self->absent_sfr);
    memset(self->floating, 0, sizeof self->floating);
    memset(self->alternate, 0xFF, sizeof self->alternate);
    self->p1_watched = 0;
    self->pins_due = MCS51_NEVER;
    self->p3_sampled = mcs51_port_pins(self, 3);
    mcs51_uart_reset(self);
    for (unsigned i = 0; i < 4; ++i)
    {
        mcs51_port_drive(self, i, now);
    }
    mcs51_timers_mode(self);
    mcs51_requests_change(self);
    mcs51_level_requests(self, now);
    mcs51_plan(self);
    mcs51_look_at(self, now);
}

static void request(mcs51_t* self, mcs51_reset_t kind, uint64_t seed)
{
    self->reset_request = kind;
    self->reset_seed = seed;
    self->attend_at = 0;
    if (self->running)
    {
        mcs51_look_at(self, mcs51_cycle(self));
    }
    else
    {
        mcs51_reset_due(self, mcs51_cycle(self));
    }
}

void mcs51_reset(mcs51_t* self, bool power_on)
{
    request(self, power_on ? RESET_POWER : RESET_PIN, self->config.ram_seed);
}

void mcs51_brown_out(mcs51_t* self, uint64_t seed)
{
    request(self, RESET_BROWN_OUT, seed);
}

void mcs51_hold_reset(mcs51_t* self, bool high)
{
    const uint64_t now = mcs51_cycle(self);
    if (high && self->rst_due == MCS51_NEVER && !self->in_reset)
    {
        self->rst_due = self->mem[PCON] & PCON_PD ? now : now + RST_CYCLES;
        self->attend_at = 0;
        mcs51_look_at(self, self->rst_due);
    }
    else if (!high)
    {
        const bool was_high = self->in_reset || self->rst_due <= now;
        self->rst_due = MCS51_NEVER;
        if (was_high)
        {
            self->in_reset = false;
            request(self, RESET_PIN, 0);
        }
    }
}

bool mcs51_reset_due(mcs51_t* self, uint64_t now)
{
    if (now >= self->rst_due)
    {
        self->rst_due = MCS51_NEVER;
        self->in_reset = true;
        self->reset_request = self->reset_request ? self->reset_request : RESET_PIN;
    }
    const mcs51_reset_t kind = self->reset_request;
    if (kind == RESET_NONE)
    {
        return false;
    }
    self->reset_request = RESET_NONE;
    if (kind == RESET_POWER)
    {
        mcs51_memory_clear(self);
    }
    if (kind == RESET_POWER || self->reset_seed)
    {
        mcs51_memory_randomise(self, self->reset_seed);
    }
    reset(self, kind != RESET_PIN);
    return true;
}

static void drive_rst(mcs51_t* self, bool high, uint64_t at)
{
    if (self->config.rst)
    {
        self->config.rst(self->config.ctx, high, at);
    }
}

void mcs51_watchdog_reset(mcs51_t* self)
{
    const bool told = !(self->mem[AUXR] & AUXR_DISRTO);
    const uint64_t now = mcs51_cycle(self);
    mcs51_report(self, EMU_GUEST_ERROR, 0, "watchdog overflow: the part resets itself, from this address", self->pc);
    if (told)
    {
        drive_rst(self, true, now);
    }
    self->budget -= MCS51_SPENT(MCS51_WDT_RESET, 0);
    reset(self, false);
    if (told)
    {
        drive_rst(self, false, now + MCS51_WDT_RESET);
    }
}
