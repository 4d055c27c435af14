/// Resolution of a net from its drivers.
/// SPDX-License-Identifier: MIT
#include "emu/wire.h"

void emu_wire_init(emu_wire_t* self, const char* name, bool level)
{
    *self = (emu_wire_t){.name = name, .level = level, .floating = true};
}

int emu_wire_add_driver(emu_wire_t* self)
{
    return self->drivers < EMU_WIRE_DRIVERS ? self->drivers++ : -1;
}

int emu_wire_watch(emu_wire_t* self, emu_wire_fn fn, void* ctx)
{
    if (self->watchers == EMU_WIRE_WATCHERS)
    {
        return -1;
    }
    self->watch[self->watchers].fn = fn;
    self->watch[self->watchers].ctx = ctx;
    self->watchers++;
    return 0;
}

static unsigned present(const emu_wire_t* self)
{
    unsigned set = 0;
    for (unsigned i = 0; i < self->drivers; i++)
    {
        set |= 1u << self->drive[i];
    }
    return set;
}

static bool contends(unsigned set)
{
    const unsigned both = 1u << EMU_STRONG0 | 1u << EMU_STRONG1;
    return (set & both) == both;
}

void emu_wire_drive(emu_wire_t* self, int driver, emu_drive_t drive, emu_time_t at)
{
    const unsigned before = present(self);
    self->drive[driver] = (uint8_t)drive;
    const unsigned set = present(self);
    if (contends(set) && !contends(before))
    {
        self->contentions++;
    }
    self->floating = (set & ~(1u << EMU_Z)) == 0;
    bool level = self->level;
    if ((set & 1u << EMU_STRONG0) != 0)
    {
        level = false;
    }
    else if ((set & 1u << EMU_STRONG1) != 0)
    {
        level = true;
    }
    else if ((set & 1u << EMU_WEAK0) != 0)
    {
        level = false;
    }
    else if ((set & 1u << EMU_WEAK1) != 0)
    {
        level = true;
    }
    if (level != self->level)
    {
        self->level = level;
        for (unsigned i = 0; i < self->watchers; i++)
        {
            self->watch[i].fn(self->watch[i].ctx, level, at);
        }
    }
}

void emu_wire_state(emu_wire_t* self, emu_state_t* io)
{
    uint8_t drivers = self->drivers;
    emu_state_u8(io, &drivers);
    emu_state_check(io, drivers == self->drivers);
    for (unsigned i = 0; i < self->drivers; i++)
    {
        emu_state_u8(io, &self->drive[i]);
        emu_state_check(io, self->drive[i] <= EMU_STRONG1);
    }
    emu_state_bool(io, &self->level);
    emu_state_bool(io, &self->floating);
    emu_state_u64(io, &self->contentions);
}
