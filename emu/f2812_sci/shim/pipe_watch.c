/// What a run is told of a program's accesses and interrupts: records, and stops at registers.
/// SPDX-License-Identifier: MIT
#include "pipe_internal.h"

#define SCIRXBUFA 0x7057u ///< reading it takes a character
#define SCIRXBUFB 0x7757u

void f2812_pipe_flush(pipe_t* self)
{
    if (self->records.u.records.count > 0)
    {
        self->records.kind = F2812_LINK_RECORDS_ARE;
        f2812_pipe_send(self, &self->records);
        self->records.u.records.count = 0;
    }
}

static void put_record(pipe_t* self, f2812_link_what_t what, uint16_t address, uint16_t value, emu_time_t at)
{
    if (self->records.u.records.count == F2812_LINK_RECORDS)
    {
        f2812_pipe_flush(self);
    }
    self->records.u.records.records[self->records.u.records.count++] =
        (f2812_link_record_t){.at = at, .what = (uint8_t)what, .address = address, .value = value};
}

/// Whether a read gives what the one before gave, nothing having been written or interrupted since, and no other read having given
/// something new: a turn of a waiting loop. How many of them there are depends on how time was cut, so none but the first is told.
static bool repeated(pipe_t* self, uint16_t address, uint16_t value, bool write)
{
    const bool takes = address == SCIRXBUFA || address == SCIRXBUFB;
    const bool known = self->seen[address] == self->change && !write;
    if (known && self->value[address] == value && !takes)
    {
        return true;
    }
    self->change += write || takes || known;
    self->seen[address] = self->change;
    self->value[address] = value;
    return false;
}

static void on_interrupt(void* ctx, unsigned vector, bool enter, emu_time_t at)
{
    pipe_t* const self = ctx;
    self->change++;
    if (self->record_interrupts)
    {
        put_record(self, enter ? F2812_INTERRUPT_BEGAN : F2812_INTERRUPT_ENDED, (uint16_t)vector, 0, at);
    }
}

static void on_access(void* ctx, uint16_t address, uint16_t value, bool write, emu_time_t at)
{
    pipe_t* const self = ctx;
    const unsigned access = write ? F2812_ACCESS_WRITE : F2812_ACCESS_READ;
    if (repeated(self, address, value, write))
    {
        return;
    }
    if (self->record_accesses)
    {
        put_record(self, write ? F2812_WAS_WRITTEN : F2812_WAS_READ, address, value, at);
    }
    for (unsigned i = 0; i < self->break_count && !self->broken; i++)
    {
        const f2812_link_access_t* const b = &self->breaks[i];
        if (b->address == address && (b->access & access) != 0 && ((b->value ^ value) & b->mask) == 0)
        {
            self->broken = true;
            self->out.u.done.access =
                (f2812_link_access_t){.address = address, .value = value, .access = (uint8_t)access};
            f2812_shim_break(self->shim);
        }
    }
}

/// An observer costs time: there is one only while somebody wants what it sees.
static void observe(pipe_t* self)
{
    const bool accesses = self->record_accesses || self->break_count > 0;
    const f2812_observer_t observer = {.ctx = self, .access = accesses ? on_access : NULL, .interrupt = on_interrupt};
    self->change++;
    f2812_observe(self->device, accesses || self->record_interrupts ? &observer : NULL);
}

void f2812_pipe_set_break(pipe_t* self)
{
    const f2812_link_access_t wanted = self->in.u.at;
    if (wanted.access != 0 && self->break_count == BREAKS)
    {
        f2812_pipe_refuse(self, "break", "there are 64 already; take one away");
        return;
    }
    if (wanted.access != 0)
    {
        self->breaks[self->break_count++] = wanted;
    }
    else
    {
        unsigned kept = 0;
        for (unsigned i = 0; i < self->break_count; i++)
        {
            if (self->breaks[i].address != wanted.address)
            {
                self->breaks[kept++] = self->breaks[i];
            }
        }
        self->break_count = kept;
    }
    observe(self);
    f2812_pipe_answer(self, F2812_LINK_READY);
}

void f2812_pipe_record(pipe_t* self)
{
    self->record_accesses = self->in.u.record.accesses;
    self->record_interrupts = self->in.u.record.interrupts;
    observe(self);
    f2812_pipe_answer(self, F2812_LINK_READY);
}
