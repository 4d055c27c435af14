/// \file   emu/sched.h
/// \brief  The event queue of one run. Events are structs owned by the part that sets them; equal times fire in the order they were set.
/// SPDX-License-Identifier: MIT
#ifndef EMU_SCHED_H_INCLUDED
#define EMU_SCHED_H_INCLUDED
#include "emu/state.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct emu_event_t
{
    void (*fire)(void* ctx, emu_time_t at);
    void* ctx;
    emu_time_t at;
    bool pending;
    struct emu_event_t* next; ///< private
    uint64_t order;           ///< private: number of the setting
} emu_event_t;

typedef struct emu_sched_t
{
    emu_time_t now;    ///< instant of the event being fired, or of the executor that runs; never goes back
    emu_event_t* head; ///< private, sorted by instant and order
    uint64_t order;    ///< private: settings so far
    /// Called when the earliest pending event became earlier: an executor that is in the middle of a slice shortens it.
    void (*earlier)(void* ctx, emu_time_t at);
    void* earlier_ctx;
} emu_sched_t;

/// No events, instant 0.
EMU_API void emu_sched_init(emu_sched_t* self);
/// Set or move an event. `at` before self->now means now.
EMU_API void emu_sched_at(emu_sched_t* self, emu_event_t* event, emu_time_t at);
/// As emu_sched_at(), but it fires before all else of that instant: what comes from outside acts the same whenever it was announced.
EMU_API void emu_sched_first(emu_sched_t* self, emu_event_t* event, emu_time_t at);
/// Take an event out; nothing happens when it is not pending.
EMU_API void emu_sched_cancel(emu_sched_t* self, emu_event_t* event);
/// Instant of the earliest event, or EMU_TIME_MAX.
EMU_API emu_time_t emu_sched_next(const emu_sched_t* self);
/// Fire everything due at or before t, in order; self->now is each event's instant while it fires, and t afterwards.
EMU_API void emu_sched_advance(emu_sched_t* self, emu_time_t t);

/// The clock of the queue. Its events are their owners': one that is not loaded stays set as it was.
EMU_API void emu_sched_state(emu_sched_t* self, emu_state_t* io);
/// One event, after emu_sched_state: loaded events of equal times fire in the order they were set before the snapshot.
EMU_API void emu_event_state(emu_sched_t* sched, emu_event_t* event, emu_state_t* io);

#ifdef __cplusplus
}
#endif
#endif // EMU_SCHED_H_INCLUDED
