/// The messages of emu_f2812/wirelink.h: one walk a kind, which saves and loads.
/// SPDX-License-Identifier: MIT
#include "emu_f2812/wirelink.h"
#include <string.h>

/// What another member of the union has left there may be no bool.
static void walk_flag(emu_state_t* io, bool* flag)
{
    *flag = emu_state_loading(io) ? false : *flag;
    emu_state_bool(io, flag);
}

static size_t length_of(const char* text, size_t most)
{
    const char* const end = memchr(text, '\0', most);
    return end != NULL ? (size_t)(end - text) : most;
}

/// A length, then the characters, none of them 0.
static void walk_text(emu_state_t* io, char* text, size_t size)
{
    uint8_t length = (uint8_t)(emu_state_loading(io) ? 0 : length_of(text, size - 1));
    emu_state_u8(io, &length);
    emu_state_check(io, length < size);
    if (io->bad)
    {
        return;
    }
    emu_state_octets(io, text, length);
    text[length] = '\0';
    emu_state_check(io, strlen(text) == length);
}

/// \return how many of an array follow; 0 when that cannot be.
static unsigned walk_count(emu_state_t* io, uint16_t* count, unsigned most)
{
    emu_state_u16(io, count);
    emu_state_check(io, *count <= most);
    return io->bad ? 0 : *count;
}

static void walk_instant(emu_state_t* io, emu_time_t* at)
{
    emu_state_i64(io, at);
    emu_state_check(io, emu_state_time(*at));
}

static void walk_octet(emu_state_t* io, uint8_t* value, unsigned most)
{
    emu_state_u8(io, value);
    emu_state_check(io, *value <= most);
}

static void walk_edges(emu_state_t* io, uint16_t* count, f2812_link_edge_t* edges)
{
    const unsigned n = walk_count(io, count, F2812_LINK_EDGES);
    emu_time_t last = 0;
    for (unsigned i = 0; i < n && !io->bad; i++)
    {
        walk_instant(io, &edges[i].at);
        walk_octet(io, &edges[i].wire, F2812_LINK_WIRES - 1);
        walk_flag(io, &edges[i].level);
        emu_state_check(io, edges[i].at >= last);
        last = edges[i].at;
    }
}

static void walk_access(emu_state_t* io, f2812_link_access_t* access)
{
    emu_state_u16(io, &access->address);
    emu_state_u16(io, &access->value);
    emu_state_u16(io, &access->mask);
    walk_octet(io, &access->access, F2812_ACCESS_READ | F2812_ACCESS_WRITE);
}

static void walk_start(f2812_link_t* self, emu_state_t* io)
{
    emu_state_u64(io, &self->u.start.oscclk_hz);
    const unsigned n = walk_count(io, &self->u.start.count, F2812_LINK_SWITCHES);
    for (unsigned i = 0; i < n && !io->bad; i++)
    {
        walk_text(io, self->u.start.switches[i].name, F2812_LINK_NAME);
        walk_text(io, self->u.start.switches[i].value, F2812_LINK_NAME);
    }
}

static void walk_done(f2812_link_t* self, emu_state_t* io)
{
    walk_instant(io, &self->u.done.reached);
    emu_state_i64(io, &self->u.done.quiet);
    emu_state_check(io, self->u.done.quiet > self->u.done.reached);
    walk_octet(io, &self->u.done.why, F2812_WHYS - 1);
    walk_access(io, &self->u.done.access);
    walk_text(io, self->u.done.end, F2812_LINK_TEXT);
    walk_edges(io, &self->u.done.count, self->u.done.edges);
}

static void walk_clock(f2812_link_t* self, emu_state_t* io)
{
    uint32_t bits = (uint32_t)self->u.clock.ppb;
    emu_state_u32(io, &bits);
    if (!io->bad)
    {
        self->u.clock.ppb = (int32_t)bits;
    }
}

static void walk_values(f2812_link_t* self, emu_state_t* io)
{
    const unsigned n = walk_count(io, &self->u.values.count, F2812_LINK_VALUES);
    for (unsigned i = 0; i < n; i++)
    {
        emu_state_u16(io, &self->u.values.values[i]);
    }
}

static void walk_records(f2812_link_t* self, emu_state_t* io)
{
    const unsigned n = walk_count(io, &self->u.records.count, F2812_LINK_RECORDS);
    for (unsigned i = 0; i < n && !io->bad; i++)
    {
        f2812_link_record_t* const record = &self->u.records.records[i];
        walk_instant(io, &record->at);
        walk_octet(io, &record->what, F2812_WHATS - 1);
        emu_state_u16(io, &record->address);
        emu_state_u16(io, &record->value);
    }
}

static void walk_counts(f2812_link_t* self, emu_state_t* io)
{
    const unsigned n = walk_count(io, &self->u.counts.count, F2812_LINK_COUNTS);
    for (unsigned i = 0; i < n && !io->bad; i++)
    {
        walk_text(io, self->u.counts.counts[i].name, F2812_LINK_NAME);
        emu_state_u64(io, &self->u.counts.counts[i].value);
    }
}

static void walk_report(f2812_link_t* self, emu_state_t* io)
{
    walk_instant(io, &self->u.report.at);
    emu_state_u32(io, &self->u.report.detail);
    walk_octet(io, &self->u.report.kind, EMU_NOT_MODELLED);
    walk_text(io, self->u.report.text, F2812_LINK_TEXT);
}

static void walk_body(f2812_link_t* self, emu_state_t* io)
{
    switch ((f2812_link_kind_t)self->kind)
    {
    case F2812_LINK_HELLO:
        emu_state_tag(io, "F28W", F2812_LINK_VERSION);
        walk_octet(io, &self->u.hello.bits, UINT8_MAX);
        walk_text(io, self->u.hello.name, F2812_LINK_NAME);
        break;
    case F2812_LINK_START:
        walk_start(self, io);
        break;
    case F2812_LINK_WIRE:
        walk_flag(io, &self->u.wire.driven);
        walk_flag(io, &self->u.wire.answered);
        walk_text(io, self->u.wire.name, F2812_LINK_NAME);
        break;
    case F2812_LINK_RUN:
        walk_instant(io, &self->u.run.until);
        walk_instant(io, &self->u.run.answer);
        walk_edges(io, &self->u.run.count, self->u.run.edges);
        break;
    case F2812_LINK_PEEK:
        emu_state_u16(io, &self->u.peek.address);
        (void)walk_count(io, &self->u.peek.count, F2812_LINK_VALUES);
        break;
    case F2812_LINK_BREAK:
        walk_access(io, &self->u.at);
        break;
    case F2812_LINK_RECORD:
        walk_flag(io, &self->u.record.accesses);
        walk_flag(io, &self->u.record.interrupts);
        break;
    case F2812_LINK_CLOCK:
        walk_clock(self, io);
        break;
    case F2812_LINK_DONE:
        walk_done(self, io);
        break;
    case F2812_LINK_VALUES_ARE:
        walk_values(self, io);
        break;
    case F2812_LINK_RECORDS_ARE:
        walk_records(self, io);
        break;
    case F2812_LINK_EDGES_ARE:
        walk_edges(io, &self->u.edges.count, self->u.edges.edges);
        break;
    case F2812_LINK_COUNTS_ARE:
        walk_counts(self, io);
        break;
    case F2812_LINK_REPORT:
        walk_report(self, io);
        break;
    case F2812_LINK_REFUSED:
        walk_text(io, self->u.refused.text, F2812_LINK_TEXT);
        break;
    case F2812_LINK_STATISTICS:
    case F2812_LINK_READY:
    case F2812_LINK_KINDS:
        break;
    }
}

size_t f2812_link_walk(f2812_link_t* self, emu_state_t* io)
{
    const size_t begin = io->at;
    walk_octet(io, &self->kind, F2812_LINK_KINDS - 1);
    if (!io->bad)
    {
        walk_body(self, io);
    }
    emu_state_check(io, io->at == io->size);
    return io->bad ? 0 : io->at - begin;
}

void f2812_link_text(char* to, size_t size, const char* from)
{
    const size_t length = length_of(from, size - 1);
    memcpy(to, from, length);
    to[length] = '\0';
}
