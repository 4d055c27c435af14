/// One end of an asynchronous serial line, 8N1: shifts octets out at its own baud, samples the other wire at its own baud.
/// SPDX-License-Identifier: MIT
#include "emu/serial.h"
#include <stddef.h>

#define FRAME_BITS   10 ///< start, 8 data (LSB first), stop
#define SAMPLE_FIRST 7  ///< of 16 per bit; three samples vote
#define SAMPLES      3

static emu_time_t bits_ps(double bits, double baud)
{
    return (emu_time_t)(bits * 1e12 / baud + 0.5);
}

static bool tx_level(const emu_serial_end_t* self, unsigned bit)
{
    return ((unsigned)self->tx_frame >> bit & 1u) != 0;
}

/// Put bit tx_bit on the wire, until the next one that differs from it or the end of the frame.
static void tx_drive(emu_serial_end_t* self, emu_time_t at)
{
    const bool one = tx_level(self, self->tx_bit);
    emu_wire_drive(self->tx, self->tx_driver, one ? EMU_STRONG1 : EMU_STRONG0, at);
    do
    {
        self->tx_bit++;
    } while (self->tx_bit < FRAME_BITS && tx_level(self, self->tx_bit) == one);
    emu_sched_at(self->sched, &self->tx_event, self->tx_start + bits_ps(self->tx_bit, self->baud));
}

static void tx_begin(emu_serial_end_t* self, emu_time_t at)
{
    const uint8_t octet = self->fifo[self->fifo_head];
    self->fifo_head = (self->fifo_head + 1) % EMU_SERIAL_FIFO;
    self->fifo_count--;
    self->tx_frame = (uint16_t)(1u << (FRAME_BITS - 1) | (unsigned)octet << 1);
    self->tx_bit = 0;
    self->tx_busy = true;
    self->tx_start = at;
    tx_drive(self, at);
}

static void tx_bit_end(void* ctx, emu_time_t at)
{
    emu_serial_end_t* const self = ctx;
    if (self->tx_bit < FRAME_BITS)
    {
        tx_drive(self, at);
        return;
    }
    self->octets_sent++;
    self->tx_busy = false;
    if (self->fifo_count > 0)
    {
        tx_begin(self, at);
    }
}

bool emu_serial_end_send(emu_serial_end_t* self, uint8_t octet)
{
    if (self->tx == NULL || self->fifo_count == EMU_SERIAL_FIFO)
    {
        self->overflow++;
        return false;
    }
    self->fifo[(self->fifo_head + self->fifo_count) % EMU_SERIAL_FIFO] = octet;
    self->fifo_count++;
    if (!self->tx_busy)
    {
        tx_begin(self, self->sched->now);
    }
    return true;
}

static emu_time_t rx_time(const emu_serial_end_t* self, unsigned bit, unsigned sample)
{
    return self->rx_start + bits_ps(bit + (SAMPLE_FIRST + sample) / 16.0, self->baud);
}

static void rx_decide(emu_serial_end_t* self)
{
    const bool one = self->rx_votes * 2 > SAMPLES;
    self->rx_sample = self->rx_votes = 0;
    if (self->rx_bit == 0 && one)
    {
        self->false_starts++;
        self->rx_busy = false;
        emu_sched_cancel(self->sched, &self->rx_event);
        return;
    }
    self->rx_bits = (uint16_t)(self->rx_bits | (unsigned)one << self->rx_bit);
    self->rx_bit++;
}

/// Take the samples up to instant t, before which the wire has had that level since the last ones. Nobody can see a sample before the
/// wire changes or the frame ends, so they are not events.
static void rx_catch_up(emu_serial_end_t* self, bool level, emu_time_t t)
{
    while (self->rx_busy && self->rx_bit < FRAME_BITS)
    {
        const unsigned first = self->rx_sample;
        const bool whole = rx_time(self, self->rx_bit, SAMPLES - 1) <= t;
        while (self->rx_sample < SAMPLES && (whole || rx_time(self, self->rx_bit, self->rx_sample) <= t))
        {
            self->rx_sample++;
        }
        self->rx_votes = (uint8_t)(self->rx_votes + level * (self->rx_sample - first));
        if (!whole)
        {
            return;
        }
        rx_decide(self);
    }
}

static void rx_arm(emu_serial_end_t* self)
{
    emu_sched_at(self->sched, &self->rx_event, rx_time(self, FRAME_BITS - 1, SAMPLES - 1));
}

static void rx_edge(void* ctx, bool level, emu_time_t at)
{
    emu_serial_end_t* const self = ctx;
    rx_catch_up(self, !level, at);
    if (self->rx_busy || level)
    {
        return;
    }
    self->rx_busy = true;
    self->rx_start = at;
    self->rx_bit = self->rx_sample = self->rx_votes = 0;
    self->rx_bits = 0;
    rx_arm(self);
}

/// At the last sample of the stop bit.
static void rx_end(void* ctx, emu_time_t at)
{
    emu_serial_end_t* const self = ctx;
    rx_catch_up(self, self->rx->level, at);
    if (!self->rx_busy)
    {
        return;
    }
    const bool stop = ((unsigned)self->rx_bits >> (FRAME_BITS - 1) & 1u) != 0;
    self->rx_busy = false;
    self->octets_received++;
    self->framing_errors += !stop;
    if (self->received != NULL)
    {
        self->received(self->ctx, (uint8_t)(self->rx_bits >> 1 & 0xFFu), stop, at);
    }
}

bool emu_serial_end_set_baud(emu_serial_end_t* self, double baud)
{
    if (!(baud >= EMU_BAUD_MIN && baud <= EMU_BAUD_MAX))
    {
        return false;
    }
    if (self->rx_busy)
    {
        rx_catch_up(self, self->rx->level, self->sched->now);
    }
    self->baud = baud;
    if (self->rx_busy)
    {
        rx_arm(self);
    }
    return true;
}

int emu_serial_end_init(emu_serial_end_t* self, emu_sched_t* sched, emu_wire_t* tx, emu_wire_t* rx, double baud,
                        emu_serial_rx_fn received, void* ctx)
{
    *self = (emu_serial_end_t){
        .sched = sched,
        .tx = tx,
        .rx = rx,
        .baud = baud,
        .received = received,
        .ctx = ctx,
        .tx_event = {.fire = tx_bit_end, .ctx = self},
        .rx_event = {.fire = rx_end, .ctx = self},
    };
    if (!(baud >= EMU_BAUD_MIN && baud <= EMU_BAUD_MAX) || (rx != NULL && emu_wire_watch(rx, rx_edge, self) != 0))
    {
        return -1;
    }
    if (tx != NULL)
    {
        self->tx_driver = emu_wire_add_driver(tx);
        if (self->tx_driver < 0)
        {
            return -1;
        }
        emu_wire_drive(tx, self->tx_driver, EMU_STRONG1, sched->now);
    }
    return 0;
}

static void fifo_state(emu_serial_end_t* self, emu_state_t* io)
{
    uint32_t count = self->fifo_count;
    emu_state_u32(io, &count);
    emu_state_check(io, count <= EMU_SERIAL_FIFO);
    if (io->bad)
    {
        return;
    }
    self->fifo_head = emu_state_loading(io) ? 0 : self->fifo_head;
    self->fifo_count = count;
    for (uint32_t i = 0; i < count; i++)
    {
        emu_state_u8(io, &self->fifo[(self->fifo_head + i) % EMU_SERIAL_FIFO]);
    }
}

void emu_serial_end_state(emu_serial_end_t* self, emu_state_t* io)
{
    emu_state_tag(io, "SEND", 1);
    emu_state_f64(io, &self->baud);
    emu_state_check(io, self->baud >= EMU_BAUD_MIN && self->baud <= EMU_BAUD_MAX);
    emu_state_u16(io, &self->tx_frame);
    emu_state_u8(io, &self->tx_bit);
    emu_state_bool(io, &self->tx_busy);
    emu_state_i64(io, &self->tx_start);
    emu_event_state(self->sched, &self->tx_event, io);
    emu_state_u16(io, &self->rx_bits);
    emu_state_u8(io, &self->rx_bit);
    emu_state_u8(io, &self->rx_sample);
    emu_state_u8(io, &self->rx_votes);
    emu_state_bool(io, &self->rx_busy);
    emu_state_i64(io, &self->rx_start);
    emu_event_state(self->sched, &self->rx_event, io);
    emu_state_check(io, self->tx_bit <= FRAME_BITS && self->rx_bit <= FRAME_BITS && self->rx_sample < SAMPLES);
    emu_state_check(io, self->tx_busy == self->tx_event.pending && self->rx_busy == self->rx_event.pending);
    emu_state_check(io, (self->tx != NULL || !self->tx_busy) && (self->rx != NULL || !self->rx_busy));
    emu_state_check(io, emu_state_time(self->tx_start) && emu_state_time(self->rx_start));
    fifo_state(self, io);
    emu_state_u64(io, &self->octets_sent);
    emu_state_u64(io, &self->octets_received);
    emu_state_u64(io, &self->framing_errors);
    emu_state_u64(io, &self->false_starts);
    emu_state_u64(io, &self->overflow);
}
