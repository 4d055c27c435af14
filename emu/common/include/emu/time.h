/// \file   emu/time.h
/// \brief  Virtual time: integer picoseconds, and clock domains whose ticks land on it with exact remainders.
///
/// Tick k of a domain of `hz` ticks a second lies at floor(k * 1e12 / hz) ps: no error piles up, however long the run.
/// emu_ticker_t (emu/ticker.h) is a clock that is off, and drifts.
/// SPDX-License-Identifier: MIT
#ifndef EMU_TIME_H_INCLUDED
#define EMU_TIME_H_INCLUDED
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif

#define EMU_API       __attribute__((visibility("default")))
#define EMU_PS_PER_S  INT64_C(1000000000000)
#define EMU_PS_PER_US INT64_C(1000000)
#define EMU_TIME_MAX  INT64_MAX ///< "never"; simulated time ends after 106 days

typedef int64_t emu_time_t; ///< [ps] since the run began

/// A clock of hz / divider ticks a second (a machine cycle of an MCS-51 is hz = crystal, divider = 12).
typedef struct emu_clock_t
{
    uint64_t hz;      ///< 1 .. 1e9
    uint64_t divider; ///< 1 .. 1e6
} emu_clock_t;

/// Instant of tick k [ps], rounded down.
EMU_API emu_time_t emu_clock_time(const emu_clock_t* self, uint64_t tick);
/// First tick at or after instant t >= 0.
EMU_API uint64_t emu_clock_tick(const emu_clock_t* self, emu_time_t t);

#ifdef __cplusplus
}
#endif
#endif // EMU_TIME_H_INCLUDED
