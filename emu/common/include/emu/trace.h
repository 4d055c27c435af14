/// \file   emu/trace.h
/// \brief  Where a run records its wires: one function that takes (wire name, level, instant).
///
///     emu_trace_probe_t probe;
///     emu_trace_watch(&probe, &trace, acq_board_wire(board, "/CS"), 0);
/// SPDX-License-Identifier: MIT
#ifndef EMU_TRACE_H_INCLUDED
#define EMU_TRACE_H_INCLUDED
#include "emu/wire.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct emu_trace_t
{
    void (*put)(void* ctx, const char* wire, bool level, emu_time_t at);
    void* ctx;
} emu_trace_t;

/// Owned by the caller; lives as long as the wire.
typedef struct emu_trace_probe_t
{
    const emu_trace_t* trace;
    const emu_wire_t* wire;
} emu_trace_probe_t;

/// Put the wire's level at `at`, then each change. \return 0, or -1 when the wire has no room for a watcher (nothing put).
EMU_API int emu_trace_watch(emu_trace_probe_t* probe, const emu_trace_t* trace, emu_wire_t* wire, emu_time_t at);

#ifdef __cplusplus
}
#endif
#endif // EMU_TRACE_H_INCLUDED
