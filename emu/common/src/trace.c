/// A probe: the watcher that knows its wire's name.
/// SPDX-License-Identifier: MIT
#include "emu/trace.h"

static void changed(void* ctx, bool level, emu_time_t at)
{
    const emu_trace_probe_t* const self = ctx;
    self->trace->put(self->trace->ctx, self->wire->name, level, at);
}

int emu_trace_watch(emu_trace_probe_t* probe, const emu_trace_t* trace, emu_wire_t* wire, emu_time_t at)
{
    *probe = (emu_trace_probe_t){.trace = trace, .wire = wire};
    if (emu_wire_watch(wire, changed, probe) != 0)
    {
        return -1;
    }
    changed(probe, wire->level, at);
    return 0;
}
