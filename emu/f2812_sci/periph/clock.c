/// Ticks of a divided clock lie on cycles of SYSCLKOUT, so that they move with it.
/// SPDX-License-Identifier: MIT
#include "clock.h"

void f2812_clock_init(f2812_clock_t* self, const emu_ticker_t* sysclk, uint64_t divider)
{
    *self = (f2812_clock_t){.sysclk = sysclk, .divider = divider};
}

uint64_t f2812_clock_tick_of_cycle(const f2812_clock_t* self, uint64_t cycle)
{
    return cycle <= self->cycle ? self->tick : self->tick + (cycle - self->cycle + self->divider - 1u) / self->divider;
}

void f2812_clock_divide(f2812_clock_t* self, uint64_t cycle, uint64_t divider)
{
    self->tick = f2812_clock_tick_of_cycle(self, cycle);
    self->cycle = cycle;
    self->divider = divider;
}

emu_time_t f2812_clock_time(const f2812_clock_t* self, uint64_t tick)
{
    const uint64_t ticks = tick - self->tick;
    if (ticks > (UINT64_MAX - self->cycle) / self->divider)
    {
        return EMU_TIME_MAX;
    }
    return emu_ticker_ahead(self->sysclk, self->cycle + ticks * self->divider);
}

uint64_t f2812_clock_tick(const f2812_clock_t* self, emu_time_t t)
{
    const uint64_t cycle = emu_ticker_tick(self->sysclk, t);
    return cycle == UINT64_MAX ? UINT64_MAX : f2812_clock_tick_of_cycle(self, cycle);
}
