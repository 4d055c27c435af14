/// \file   emu/ticker.h
/// \brief  A clock that runs: its ticks on virtual time, at a rate that may be off and may change at any tick.
///
/// Each tick lies at its exact instant, rounded down to a picosecond; the tick at which the rate changes begins there. A drift is a
/// change now and then. With the rate never changed, ticks lie where emu_clock_time() says. Around the present a conversion costs
/// one division.
/// SPDX-License-Identifier: MIT
#ifndef EMU_TICKER_H_INCLUDED
#define EMU_TICKER_H_INCLUDED
#include "emu/state.h"
#ifdef __cplusplus
extern "C" {
#endif

#define EMU_PPB_MAX 100000000 ///< a rate is off by a tenth at most

/// Members are private.
typedef struct emu_ticker_t
{
    emu_clock_t clock;
    int32_t ppb;
    uint64_t tick; ///< one near the present; it lies at `at` + rest / parts
    emu_time_t at;
    uint64_t rest;
    uint64_t step, step_rest, parts; ///< a tick lasts step + step_rest / parts ps
    uint64_t near;                   ///< so many ticks on, products still fit 64 bits
    double ticks_per_ps;
} emu_ticker_t;

/// Tick 0 at instant 0, at the nominal rate. clock: hz 1 .. 1e9, divider 1 .. 1e6.
EMU_API void emu_ticker_init(emu_ticker_t* self, const emu_clock_t* clock);
/// From tick on the rate is hz * (1 + ppb / 1e9). |ppb| <= EMU_PPB_MAX. \param[in] tick the present, or later
EMU_API void emu_ticker_rate(emu_ticker_t* self, uint64_t tick, int32_t ppb);
/// From tick on it is another clock, as far off as before; no part of a picosecond is lost. \param[in] tick the present, or later
EMU_API void emu_ticker_clock(emu_ticker_t* self, uint64_t tick, const emu_clock_t* clock);
/// Instant of a tick of the present: not before a change of rate, and no more than a few ticks before another call's.
EMU_API emu_time_t emu_ticker_time(emu_ticker_t* self, uint64_t tick);
/// Instant of a tick that may lie ahead, however far: at or after the present.
EMU_API emu_time_t emu_ticker_ahead(const emu_ticker_t* self, uint64_t tick);
/// First tick at or after instant t, which is the present or later; UINT64_MAX after EMU_TIME_LOADED_MAX.
EMU_API uint64_t emu_ticker_tick(const emu_ticker_t* self, emu_time_t t);
/// Save or load, see emu/state.h. The clock's frequency is configuration.
EMU_API void emu_ticker_state(emu_ticker_t* self, emu_state_t* io);

#ifdef __cplusplus
}
#endif
#endif // EMU_TICKER_H_INCLUDED
