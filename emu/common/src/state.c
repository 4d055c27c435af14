/// Fields as little-endian octets, one function for saving and loading.
/// SPDX-License-Identifier: MIT
#include "emu/state.h"
#include <string.h>

bool emu_state_loading(const emu_state_t* io)
{
    return io->from != NULL;
}

void emu_state_check(emu_state_t* io, bool good)
{
    io->bad = io->bad || (emu_state_loading(io) && !good);
}

bool emu_state_time(emu_time_t t)
{
    return t >= 0 && t <= EMU_TIME_LOADED_MAX;
}

/// Pass `count` octets. \return whether they are there, to read or to write, from io->at - count on.
static bool pass(emu_state_t* io, size_t count)
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
    if (emu_state_loading(io))
    {
        memcpy(octets, io->from + (io->at - count), count);
    }
    else
    {
        memcpy(io->to + (io->at - count), octets, count);
    }
}

/// An unsigned number of `count` octets. \return what is there when loading, else the value.
static uint64_t number(emu_state_t* io, uint64_t value, size_t count)
{
    if (!pass(io, count))
    {
        return value;
    }
    const size_t begin = io->at - count;
    uint64_t loaded = 0;
    for (size_t i = 0; i < count; i++)
    {
        if (emu_state_loading(io))
        {
            loaded |= (uint64_t)io->from[begin + i] << 8 * i;
        }
        else
        {
            io->to[begin + i] = (uint8_t)(value >> 8 * i & 0xFFu);
        }
    }
    return emu_state_loading(io) ? loaded : value;
}

void emu_state_bool(emu_state_t* io, bool* value)
{
    const uint64_t loaded = number(io, *value, 1);
    emu_state_check(io, loaded <= 1);
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
