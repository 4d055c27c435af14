/// Snapshot and restore of a board: a header that says what it is of, then every part in turn.
///
/// | octets | |
/// |---|---|
/// | 8 | "ACQB", version |
/// | 8 | octets that follow these two numbers |
/// | 8 | FNV-1a of them |
/// | rest | configuration that has to be the same, then the board |
/// SPDX-License-Identifier: MIT
#include "board_internal.h"
#include <stdlib.h>

#define VERSION 1u
#define HEADER  24u

/// Fowler, Noll and Vo (1991), 64 bits.
static uint64_t fnv1a(const uint8_t* octets, size_t size)
{
    uint64_t hash = UINT64_C(0xCBF29CE484222325);
    for (size_t i = 0; i < size; i++)
    {
        hash = (hash ^ octets[i]) * UINT64_C(0x100000001B3);
    }
    return hash;
}

static void same(emu_state_t* io, uint64_t value)
{
    uint64_t loaded = value;
    emu_state_u64(io, &loaded);
    emu_state_check(io, loaded == value);
}

static void walk(acq_board_t* self, emu_state_t* io)
{
    const acq_board_config_t* const c = &self->config;
    same(io, c->part);
    same(io, c->code_octets);
    same(io, c->xdata_octets);
    same(io, c->crystal_hz);
    same(io, c->adc_count);
    emu_sched_state(self->sched, io);
    emu_ticker_state(&self->clock, io);
    for (unsigned i = 0; i < ACQ_PINS && !io->bad; i++)
    {
        emu_wire_state(&self->nets[i / 8u][i % 8u].wire, io);
        emu_state_bool(io, &self->nets[i / 8u][i % 8u].cut);
    }
    emu_state_octets(io, self->outside, sizeof self->outside);
    mcs51_state(self->cpu, io);
    for (unsigned n = 0; n < c->adc_count; n++)
    {
        tlc2543_state(self->adcs[n], io);
    }
    if (emu_state_loading(io) && !io->bad)
    {
        self->synced = mcs51_cycle(self->cpu);
        self->synced_at = emu_ticker_time(&self->clock, self->synced);
    }
}

static void header(emu_state_t* io, uint64_t size, uint64_t hash)
{
    emu_state_tag(io, "ACQB", VERSION);
    same(io, size);
    same(io, hash);
}

size_t acq_board_save(acq_board_t* self, uint8_t* octets, size_t size)
{
    emu_state_t body = {.to = size > HEADER ? octets + HEADER : NULL, .size = size > HEADER ? size - HEADER : 0};
    walk(self, &body);
    if (body.to != NULL && !body.bad)
    {
        emu_state_t head = {.to = octets, .size = HEADER};
        header(&head, body.at, fnv1a(octets + HEADER, body.at));
    }
    if (body.bad) // a walk ends where there is no room
    {
        body = (emu_state_t){0};
        walk(self, &body);
    }
    return body.at + HEADER;
}

/// \return whether all of it was taken.
static bool load(acq_board_t* self, const uint8_t* octets, size_t size)
{
    emu_state_t body = {.from = octets, .size = size};
    walk(self, &body);
    return !body.bad && body.at == body.size;
}

int acq_board_restore(acq_board_t* self, const uint8_t* octets, size_t size)
{
    if (size < HEADER)
    {
        return -1;
    }
    emu_state_t head = {.from = octets, .size = HEADER};
    header(&head, size - HEADER, fnv1a(octets + HEADER, size - HEADER));
    emu_state_t now = {0};
    walk(self, &now);
    emu_state_t before = {.to = head.bad ? NULL : malloc(now.at), .size = now.at};
    if (before.to == NULL)
    {
        return -1;
    }
    walk(self, &before);
    const bool loaded = load(self, octets + HEADER, size - HEADER);
    if (!loaded)
    {
        (void)load(self, before.to, before.size);
    }
    free(before.to);
    return loaded ? 0 : -1;
}
