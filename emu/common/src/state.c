/// Fields as little-endian octets, one function for saving and loading.
/// SPDX-License-Identifier: MIT
#include "emu/state.h"
#include <string.h>

static inline bool loads(const emu_state_t* io)
{
    return io->from != NULL;
}

static inline void check(emu_state_t* io, bool good)
{
    io->bad = io->bad || (loads(io) && !good);
}

bool emu_state_loading(const emu_state_t* io)
{
    return loads(io);
}

void emu_state_check(emu_state_t* io, bool good)
{
    check(io, good);
}

bool emu_state_time(emu_time_t t)
{
    return t >= 0 && t <= EMU_TIME_LOADED_MAX;
}

/// Pass `count` octets. \return whether they are there, to read or to write, from io->at - count on.
static inline bool pass(emu_state_t* io, size_t count)
{
    const bool counting = io->to == NULL && io->from == NULL;
    const bool fits = io->at <= io->size && count <= io->size - io->at;
    io->bad = io->bad || (!counting && !fits);
    io->at += count;
    return !counting && !io->bad;
}

void emu_state_octets(emu_state_t* io, void* octets, size_t count)
{
    if (count == 0 || !pass(io, count))
    {
        return;
    }
    if (loads(io))
    {
        memcpy(octets, io->from + (io->at - count), count);
    }
    else
    {
        memcpy(io->to + (io->at - count), octets, count);
    }
}

static uint64_t get16(const uint8_t* from)
{
    return from[0] | (uint64_t)from[1] << 8;
}

static uint64_t get32(const uint8_t* from)
{
    return get16(from) | get16(from + 2) << 16;
}

static void put16(uint8_t* to, uint64_t value)
{
    to[0] = (uint8_t)value;
    to[1] = (uint8_t)(value >> 8);
}

static void put32(uint8_t* to, uint64_t value)
{
    put16(to, value);
    put16(to + 2, value >> 16);
}

static uint64_t get(const uint8_t* from, size_t count)
{
    return count == 1 ? from[0] : count == 2 ? get16(from) : get32(from) | (count == 8 ? get32(from + 4) << 32 : 0);
}

static void put(uint8_t* to, uint64_t value, size_t count)
{
    switch (count)
    {
    case 1:
        *to = (uint8_t)value;
        break;
    case 2:
        put16(to, value);
        break;
    case 8:
        put32(to + 4, value >> 32); // and the lower half
        // fall through
    default:
        put32(to, value);
        break;
    }
}

/// An unsigned number of 1, 2, 4 or 8 octets. \return what is there when loading, else the value.
static inline uint64_t number(emu_state_t* io, uint64_t value, size_t count)
{
    if (!pass(io, count))
    {
        return value;
    }
    if (loads(io))
    {
        return get(io->from + (io->at - count), count);
    }
    put(io->to + (io->at - count), value, count);
    return value;
}

void emu_state_bool(emu_state_t* io, bool* value)
{
    const uint64_t loaded = number(io, *value, 1);
    check(io, loaded <= 1);
    *value = loaded != 0;
}

void emu_state_u8(emu_state_t* io, uint8_t* value)
{
    *value = (uint8_t)number(io, *value, sizeof *value);
}

void emu_state_u16(emu_state_t* io, uint16_t* value)
{
    *value = (uint16_t)number(io, *value, sizeof *value);
}

void emu_state_u32(emu_state_t* io, uint32_t* value)
{
    *value = (uint32_t)number(io, *value, sizeof *value);
}

void emu_state_u64(emu_state_t* io, uint64_t* value)
{
    *value = number(io, *value, sizeof *value);
}

void emu_state_i64(emu_state_t* io, int64_t* value)
{
    uint64_t bits;
    memcpy(&bits, value, sizeof bits);
    bits = number(io, bits, sizeof bits);
    memcpy(value, &bits, sizeof bits);
}

void emu_state_f64(emu_state_t* io, double* value)
{
    uint64_t bits;
    memcpy(&bits, value, sizeof bits);
    bits = number(io, bits, sizeof bits);
    memcpy(value, &bits, sizeof bits);
}

void emu_state_tag(emu_state_t* io, const char name[4], uint32_t version)
{
    char loaded_name[4];
    uint32_t loaded_version = version;
    memcpy(loaded_name, name, sizeof loaded_name);
    emu_state_octets(io, loaded_name, sizeof loaded_name);
    emu_state_u32(io, &loaded_version);
    emu_state_check(io, memcmp(loaded_name, name, sizeof loaded_name) == 0 && loaded_version == version);
}
