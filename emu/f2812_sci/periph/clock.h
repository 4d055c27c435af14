/// \file   periph/clock.h
/// \brief  SYSCLKOUT and what is divided from it, as clock domains whose rate changes while they run. Not installed.
///
/// Ticks are numbered on over a change. The first tick at or after a change is moved to its cycle; from there on instants are exact.
/// SPDX-License-Identifier: MIT
#ifndef F2812_CLOCK_H_INCLUDED
#define F2812_CLOCK_H_INCLUDED
#include "emu/ticker.h"

typedef struct f2812_clock_t
{
    const emu_ticker_t* sysclk; ///< whose ticks are cycles of SYSCLKOUT
    uint64_t cycle, tick;       ///< tick `tick` lies at that cycle: the last change
    uint64_t divider;
} f2812_clock_t;

/// Tick 0 at cycle 0.
void f2812_clock_init(f2812_clock_t* self, const emu_ticker_t* sysclk, uint64_t divider);
/// Another divider from a cycle of the present on.
void f2812_clock_divide(f2812_clock_t* self, uint64_t cycle, uint64_t divider);
/// Instant of a tick at or after the last change of rate.
emu_time_t f2812_clock_time(const f2812_clock_t* self, uint64_t tick);
/// First tick at or after t, which is the present or later; UINT64_MAX after EMU_TIME_LOADED_MAX.
uint64_t f2812_clock_tick(const f2812_clock_t* self, emu_time_t t);
/// First tick at or after a cycle of SYSCLKOUT.
uint64_t f2812_clock_tick_of_cycle(const f2812_clock_t* self, uint64_t cycle);

#endif // F2812_CLOCK_H_INCLUDED
