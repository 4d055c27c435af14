/// A running clock: an instant that is known exactly moves along with the present, and ticks are counted from there.
/// SPDX-License-Identifier: MIT
#include "emu/ticker.h"

#define BILLION    UINT64_C(1000000000)
#define DIGITS     9                   ///< of a billion
#define NEAR_PS    ((uint64_t)1 << 56) ///< 20 hours: from any instant up to half of all time this fits
#define NEAR_PARTS ((uint64_t)1 << 62)
#define BEFORE     16u ///< ticks that the known one stays behind the present

static uint64_t common(uint64_t a, uint64_t b)
{
    while (b != 0)
    {
        const uint64_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

/// A tick lasts divider * 1e12 * 1e9 / (hz * (1e9 + ppb)) ps; the 1e9 is brought down digit by digit, so that it fits.
static void set_rate(emu_ticker_t* self, int32_t ppb)
{
    const uint64_t parts = self->clock.hz * (uint64_t)((int64_t)BILLION + ppb);
    const uint64_t dividend = self->clock.divider * (uint64_t)EMU_PS_PER_S;
    uint64_t step = dividend / parts, rest = dividend % parts;
    for (unsigned i = 0; i < DIGITS; i++)
    {
        rest *= 10u;
        step = step * 10u + rest / parts;
        rest %= parts;
    }
    const uint64_t divisor = common(parts, rest);
    self->ppb = ppb;
    self->step = step;
    self->step_rest = rest / divisor;
    self->parts = parts / divisor;
    const uint64_t whole = NEAR_PS / (step + 1u), fine = NEAR_PARTS / self->parts;
    self->near = whole < fine ? whole : fine;
    self->ticks_per_ps = 1.0 / ((double)step + (double)self->step_rest / (double)self->parts);
}

void emu_ticker_init(emu_ticker_t* self, const emu_clock_t* clock)
{
    *self = (emu_ticker_t){.clock = *clock};
    set_rate(self, 0);
}

/// (self->rest + ticks * self->step_rest) / parts and its remainder, bit by bit, for any number of ticks.
static uint64_t fine_steps(const emu_ticker_t* self, uint64_t ticks, uint64_t* rest)
{
    uint64_t quotient = 0, r = 0;
    for (unsigned bit = 64; bit-- > 0;)
    {
        r = 2u * r + ((ticks >> bit & 1u) != 0 ? self->step_rest : 0u);
        quotient = 2u * quotient + r / self->parts;
        r %= self->parts;
    }
    r += self->rest;
    *rest = r % self->parts;
    return quotient + r / self->parts;
}

/// Of a tick at or after the known one.
static emu_time_t later(const emu_ticker_t* self, uint64_t tick, uint64_t* rest)
{
    const uint64_t ticks = tick - self->tick;
    if (ticks <= self->near)
    {
        const uint64_t fine = self->rest + ticks * self->step_rest;
        *rest = fine % self->parts;
        return self->at + (emu_time_t)(ticks * self->step + fine / self->parts);
    }
    if (ticks >= (uint64_t)(EMU_TIME_MAX - self->at) / (self->step + 1u))
    {
        *rest = 0;
        return EMU_TIME_MAX;
    }
    return self->at + (emu_time_t)(ticks * self->step + fine_steps(self, ticks, rest));
}

static emu_time_t instant(const emu_ticker_t* self, uint64_t tick)
{
    uint64_t rest;
    if (tick >= self->tick)
    {
        return later(self, tick, &rest);
    }
    const uint64_t ticks = self->tick - tick, fine = ticks * self->step_rest;
    const uint64_t short_of = fine > self->rest ? (fine - self->rest + self->parts - 1u) / self->parts : 0;
    return self->at - (emu_time_t)(ticks * self->step + short_of);
}

emu_time_t emu_ticker_time(emu_ticker_t* self, uint64_t tick)
{
    const uint64_t ticks = tick - self->tick;
    if (ticks <= self->near / 2u)
    {
        return self->at + (emu_time_t)(ticks * self->step + (self->rest + ticks * self->step_rest) / self->parts);
    }
    if (tick > self->tick && tick - self->tick > self->near / 2u + BEFORE)
    {
        uint64_t rest;
        self->at = later(self, tick - BEFORE, &rest);
        self->rest = rest;
        self->tick = tick - BEFORE;
    }
    return instant(self, tick);
}

uint64_t emu_ticker_tick(const emu_ticker_t* self, emu_time_t t)
{
    if (t > EMU_TIME_LOADED_MAX)
    {
        return UINT64_MAX;
    }
    const double guess = (double)(t - self->at) * self->ticks_per_ps;
    uint64_t tick = guess > 0.0 ? self->tick + (uint64_t)guess : self->tick;
    emu_time_t at = instant(self, tick);
    while (tick > 0 && at >= t)
    {
        at = instant(self, --tick);
    }
    while (at < t)
    {
        at = instant(self, ++tick);
    }
    return tick;
}

emu_time_t emu_ticker_ahead(const emu_ticker_t* self, uint64_t tick)
{
    return instant(self, tick);
}

void emu_ticker_rate(emu_ticker_t* self, uint64_t tick, int32_t ppb)
{
    self->at = instant(self, tick);
    self->tick = tick;
    self->rest = 0;
    set_rate(self, ppb);
}

void emu_ticker_clock(emu_ticker_t* self, uint64_t tick, const emu_clock_t* clock)
{
    const uint64_t parts = self->parts;
    uint64_t rest;
    self->at = later(self, tick, &rest);
    self->tick = tick;
    self->clock = *clock;
    set_rate(self, self->ppb);
    // As long as the product fits, so that ticks of two clocks that coincide go on doing so.
    self->rest = parts <= UINT32_MAX && self->parts <= UINT32_MAX ? rest * self->parts / parts : 0;
}

void emu_ticker_state(emu_ticker_t* self, emu_state_t* io)
{
    emu_time_t at = self->at;
    int64_t ppb = self->ppb;
    emu_state_i64(io, &ppb);
    emu_state_u64(io, &self->tick);
    emu_state_i64(io, &at);
    emu_state_u64(io, &self->rest);
    emu_state_check(io, ppb >= -EMU_PPB_MAX && ppb <= EMU_PPB_MAX && emu_state_time(at));
    if (emu_state_loading(io) && !io->bad)
    {
        self->at = at;
        set_rate(self, (int32_t)ppb);
        emu_state_check(io, self->rest < self->parts);
    }
}
