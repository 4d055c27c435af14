/// \file   state.c
/// \brief  Snapshot and restore of one part. Code memory is that of the image, but for octets that mcs51_set_code() changed.
/// SPDX-License-Identifier: MIT
#include "emu/state.h"
#include "emu/random.h"
#include "engine.h"
#include <string.h>

#define VERSION     2
#define FRAME_BITS  11u
#define SAMPLES     3u
#define SHIFT_BITS  8u
#define SLICE_LIMIT 0x40000100        ///< more than `left` ever is
#define OVERDUE     64u               ///< cycles; no event waits longer, as no instruction or reset takes longer
#define LAST_CYCLE  (UINT64_MAX / 4u) ///< there is room to add to it

static void small(emu_state_t* io, unsigned* value, unsigned limit)
{
    uint8_t octet = (uint8_t)*value;
    emu_state_u8(io, &octet);
    emu_state_check(io, octet <= limit);
    *value = octet;
}

/// The image that must be there is told by a sum over its octets, which does not depend on the order of loading.
uint32_t mcs51_image_term(unsigned address, uint8_t octet)
{
    uint64_t state = (uint64_t)address << 8 | octet;
    return (uint32_t)emu_random(&state);
}

static void code(mcs51_t* self, emu_state_t* io)
{
    bool changed = self->code_changed;
    emu_state_bool(io, &changed);
    if (changed)
    {
        emu_state_octets(io, self->code, self->code_octets);
    }
    if (emu_state_loading(io) && !io->bad)
    {
        if (!changed && self->code_changed)
        {
            memcpy(self->code, self->image, sizeof self->code);
        }
        if (changed || self->code_changed)
        {
            mcs51_forget(self);
        }
        self->code_changed = changed;
    }
}

static void memories(mcs51_t* self, emu_state_t* io)
{
    uint32_t part = (uint32_t)self->config.part, octets = self->code_octets, xdata = self->config.xdata_octets;
    uint32_t image = self->image_sum;
    emu_state_u32(io, &part);
    emu_state_u32(io, &octets);
    emu_state_u32(io, &xdata);
    emu_state_u32(io, &image);
    emu_state_check(io, part == (uint32_t)self->config.part && octets == self->code_octets &&
                            xdata == self->config.xdata_octets && image == self->image_sum);
    code(self, io);
    emu_state_octets(io, self->mem, self->ram_octets > 0x80u ? sizeof self->mem : 0x100u);
    emu_state_octets(io, self->xdata, self->config.xdata_octets);
}

static void instants(mcs51_t* self, emu_state_t* io)
{
    uint64_t now = mcs51_cycle(self), instructions = mcs51_instructions(self);
    uint64_t* const cycles[] = {&now,
                                &instructions,
                                &self->until,
                                &self->interrupts,
                                &self->gate_at,
                                &self->timer_at[0],
                                &self->timer_at[1],
                                &self->timer_at[2],
                                &self->t1_overflows,
                                &self->t2_overflows,
                                &self->t2_told,
                                &self->overflow_at,
                                &self->periph_at,
                                &self->frozen,
                                &self->wdt_due,
                                &self->pins_due,
                                &self->rst_due,
                                &self->reset_seed,
                                &self->uart.tx_due,
                                &self->uart.rx_due};
    for (unsigned i = 0; i < sizeof cycles / sizeof cycles[0]; ++i)
    {
        emu_state_u64(io, cycles[i]);
    }
    for (unsigned i = 0; i < IRQ_COUNT; ++i)
    {
        emu_state_u64(io, &self->flag_at[i]);
    }
    emu_state_check(io, now <= LAST_CYCLE);
    if (emu_state_loading(io) && !io->bad)
    {
        self->horizon = now - 1u;
        self->instructions = instructions;
        self->budget = 0;
        mcs51_set_left(self, -1);
    }
}

static void registers(mcs51_t* self, emu_state_t* io)
{
    uint16_t pc = (uint16_t)self->pc;
    unsigned carry = self->cy, pointer = self->dptr == DP1L, in_service = self->in_service,
             request = (unsigned)self->reset_request;
    emu_state_u16(io, &pc);
    self->pc = pc;
    small(io, &carry, 1);
    self->cy = carry;
    emu_state_u32(io, &self->fx);
    small(io, &pointer, 1);
    self->dptr = pointer ? DP1L : DP0L;
    small(io, &in_service, 3);
    self->in_service = (uint8_t)in_service;
    small(io, &request, RESET_BROWN_OUT);
    self->reset_request = (mcs51_reset_t)request;
    emu_state_bool(io, &self->halted);
    emu_state_bool(io, &self->in_reset);
    emu_state_bool(io, &self->wdt_armed);
    emu_state_u32(io, &self->once);
    emu_state_octets(io, self->absent_sfr, sizeof self->absent_sfr);
    emu_state_octets(io, self->floating, sizeof self->floating);
}

static void pins_and_uart(mcs51_t* self, emu_state_t* io)
{
    uart_t* const u = &self->uart;
    emu_state_octets(io, self->outside, sizeof self->outside);
    emu_state_octets(io, self->out, sizeof self->out);
    emu_state_octets(io, self->alternate, sizeof self->alternate);
    emu_state_u8(io, &self->p3_sampled);
    emu_state_u8(io, &self->p1_sampled);
    emu_state_u8(io, &self->p1_watched);
    emu_state_u32(io, &u->tx_frame);
    emu_state_u32(io, &u->rx_frame);
    const unsigned mode = self->mem[SCON] >> 6;
    unsigned tx_bit = u->tx_bit, tx_bits = u->tx_bits, tx_passed = u->tx_passed, rx_bit = u->rx_bit,
             samples = u->rx_samples, votes = u->rx_votes, state = (unsigned)u->rx_state;
    small(io, &tx_bit, FRAME_BITS);
    small(io, &tx_bits, FRAME_BITS);
    small(io, &tx_passed, tx_bit);
    small(io, &rx_bit, FRAME_BITS);
    small(io, &samples, SAMPLES);
    small(io, &votes, SAMPLES);
    small(io, &state, RX_SHIFT);
    emu_state_check(io, u->tx_due == MCS51_NEVER || (mode == 0 ? tx_bit <= SHIFT_BITS : tx_bit < tx_bits));
    emu_state_check(io, u->rx_due == MCS51_NEVER || rx_bit <= (state == RX_SHIFT ? SHIFT_BITS : FRAME_BITS - 2u));
    u->tx_bit = (uint8_t)tx_bit;
    u->tx_bits = (uint8_t)tx_bits;
    u->tx_passed = (uint8_t)tx_passed;
    u->rx_bit = (uint8_t)rx_bit;
    u->rx_samples = (uint8_t)samples;
    u->rx_votes = (uint8_t)votes;
    u->rx_state = (uart_rx_state_t)state;
}

void mcs51_state(mcs51_t* self, emu_state_t* io)
{
    emu_state_tag(io, "MCS5", VERSION);
    memories(self, io);
    instants(self, io);
    registers(self, io);
    pins_and_uart(self, io);
    if (emu_state_loading(io) && !io->bad)
    {
        mcs51_timers_mode(self);
        mcs51_requests_change(self);
        mcs51_plan(self);
        self->overflow_known = false;
        emu_state_check(io, mcs51_cycle(self) < OVERDUE || self->periph_at >= mcs51_cycle(self) - OVERDUE);
        self->passed_pc = NO_PC;
        self->stop = false;
    }
}
