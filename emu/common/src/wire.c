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

/// What a driver's four bits are, by emu_drive_t.
static const uint8_t strength[] = {0, 1, 2, 4, 8};
#define CONTENTION 12u

/// Strengths that are there.
static unsigned present(uint32_t drives)
{
    drives |= drives >> 16;
    drives |= drives >> 8;
    return (drives | drives >> 4) & 15u;
}

/// Level by set of strengths that is not empty. Strong over weak, low over high.
static const uint8_t resolved[] = {0, 0, 1, 0, 0, 0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 0};

static void set_level(emu_wire_t* self, bool level, emu_time_t at)
{
    self->level = level;
    self->changed = at;
    for (unsigned i = 0; i < self->watchers; i++)
    {
        self->watch[i].fn(self->watch[i].ctx, level, at);
    }
}

/// Both supplies at once: ground.
static void settle(emu_wire_t* self, emu_time_t at)
{
    const emu_wire_t* const other = self->bridge != NULL ? self->bridge : self;
    const unsigned set = present(self->drives) | present(other->drives);
    const bool gnd = self->rail == EMU_RAIL_GND || other->rail == EMU_RAIL_GND;
    const bool vcc = self->rail == EMU_RAIL_VCC || other->rail == EMU_RAIL_VCC;
    self->floating = !gnd && !vcc && set == 0;
    const bool level = gnd || vcc ? !gnd : set == 0 ? self->level : resolved[set] != 0;
    if (level != self->level)
    {
        set_level(self, level, at);
    }
}

static void settle_shorted(emu_wire_t* self, emu_time_t at)
{
    settle(self, at);
    if (self->bridge != NULL)
    {
        settle(self->bridge, at);
    }
}

void emu_wire_drive(emu_wire_t* self, int driver, emu_drive_t drive, emu_time_t at)
{
    const unsigned shift = 4u * (unsigned)driver;
    const uint32_t before = self->drives, drives = (before & ~(15u << shift)) | (uint32_t)strength[drive] << shift;
    const unsigned set = present(drives), level = resolved[set];
    self->drives = drives;
    self->floating = set == 0;
    if (set >= CONTENTION && (present(before) & CONTENTION) != CONTENTION)
    {
        self->contentions++;
    }
    if (self->shorted)
    {
        settle_shorted(self, at);
    }
    else if (level != self->level && set != 0)
    {
        set_level(self, level != 0, at);
    }
}

void emu_wire_short(emu_wire_t* self, emu_rail_t rail, emu_time_t at)
{
    self->rail = (uint8_t)rail;
    self->shorted = rail != EMU_RAIL_NONE || self->bridge != NULL;
    settle_shorted(self, at);
}

int emu_wire_bridge(emu_wire_t* self, emu_wire_t* other, emu_time_t at)
{
    if (self == other || self->bridge != NULL || other->bridge != NULL)
    {
        return -1;
    }
    self->bridge = other;
    other->bridge = self;
    self->shorted = other->shorted = true;
    settle_shorted(self, at);
    return 0;
}

void emu_wire_unbridge(emu_wire_t* self, emu_time_t at)
{
    emu_wire_t* const other = self->bridge;
    if (other != NULL)
    {
        self->bridge = other->bridge = NULL;
        self->shorted = self->rail != EMU_RAIL_NONE;
        other->shorted = other->rail != EMU_RAIL_NONE;
        settle(self, at);
        settle(other, at);
    }
}

void emu_wire_state(emu_wire_t* self, emu_state_t* io)
{
    uint8_t drivers = self->drivers;
    emu_state_u8(io, &drivers);
    emu_state_u32(io, &self->drives);
    bool good = drivers == self->drivers;
    for (unsigned i = 0; good && i < EMU_WIRE_DRIVERS; i++)
    {
        const uint32_t bits = self->drives >> 4 * i & 15u;
        good = (bits & (bits - 1)) == 0 && (i < self->drivers || bits == 0);
    }
    emu_state_check(io, good);
    emu_state_bool(io, &self->level);
    emu_state_bool(io, &self->floating);
    emu_state_i64(io, &self->changed);
    emu_state_u64(io, &self->contentions);
}
