/// Clock domains on integer picoseconds. Products are split at 1e6 so that all of it is exact in 64 bits.
/// SPDX-License-Identifier: MIT
#include "emu/time.h"

#define MILLION UINT64_C(1000000)

emu_time_t emu_clock_time(const emu_clock_t* self, uint64_t tick)
{
    if (tick > UINT64_MAX / self->divider)
    {
        return EMU_TIME_MAX;
    }
    const uint64_t periods = tick * self->divider;
    const uint64_t seconds = periods / self->hz;
    if (seconds >= (uint64_t)(EMU_TIME_MAX / EMU_PS_PER_S))
    {
        return EMU_TIME_MAX;
    }
    const uint64_t us = periods % self->hz * MILLION;
    const uint64_t ps = us % self->hz * MILLION;
    return (emu_time_t)(seconds * (uint64_t)EMU_PS_PER_S + us / self->hz * MILLION + ps / self->hz);
}

uint64_t emu_clock_tick(const emu_clock_t* self, emu_time_t t)
{
    const uint64_t seconds = (uint64_t)t / (uint64_t)EMU_PS_PER_S;
    const uint64_t us = (uint64_t)t % (uint64_t)EMU_PS_PER_S / MILLION;
    const uint64_t ps = (uint64_t)t % MILLION;
    // Oscillator periods, rounded up: a ceiling of a ceiling is the ceiling.
    const uint64_t fine = us * self->hz + (ps * self->hz + MILLION - 1) / MILLION;
    const uint64_t periods = seconds * self->hz + (fine + MILLION - 1) / MILLION;
    return (periods + self->divider - 1) / self->divider;
}
