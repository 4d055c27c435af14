/// \file   ports.c
/// \brief  Ports 0 to 3: quasi-bidirectional latches, alternate functions of P3, and the order of everything that happens by itself.
///
/// A pin is latch AND outside. P3 inputs are sampled once a machine cycle (S5P2): a change at cycle c is seen by INT0/1, T0/1, RXD
/// and the gates at c + 1, and one that is taken back within its cycle is not seen. So are T2 and T2EX on P1, where there is a timer 2.
/// SPDX-License-Identifier: MIT
#include "../cpu/mcs51_internal.h"

enum
{
    SAMPLED = 0x3D ///< RXD, INT0, INT1, T0, T1
};

static uint64_t earlier(uint64_t a, uint64_t b)
{
    return a < b ? a : b;
}

uint8_t mcs51_port_pins(const mcs51_t* self, unsigned port)
{
    return (uint8_t)(mcs51_port_drives(self, port) & self->outside[port]);
}

static void inputs_changed(mcs51_t* self, unsigned port, uint64_t at)
{
    const unsigned changed = port == 3 ? (mcs51_port_pins(self, 3) ^ self->p3_sampled) & SAMPLED
                                       : (mcs51_port_pins(self, 1) ^ self->p1_sampled) & self->p1_watched;
    if (changed && self->pins_due == MCS51_NEVER)
    {
        self->pins_due = at + 1u;
        self->periph_at = earlier(self->periph_at, self->pins_due);
        mcs51_look_at(self, at + 1u);
    }
}

void mcs51_port_drive(mcs51_t* self, unsigned port, uint64_t at)
{
    const uint8_t out = mcs51_port_drives(self, port), changed = out ^ self->out[port];
    if (!changed)
    {
        return;
    }
    self->out[port] = out;
    if (port == 3 || (port == 1 && self->p1_watched))
    {
        inputs_changed(self, port, at);
    }
    if (self->config.port)
    {
        self->config.port(self->config.ctx, port, out, changed, at);
    }
}

void mcs51_write_port(mcs51_t* self, unsigned address, uint8_t value)
{
    const uint64_t now = mcs51_now(self);
    mcs51_before_write(self, now);
    self->mem[address] = value;
    mcs51_port_drive(self, PORT_AT(address), now);
}

void mcs51_alternate(mcs51_t* self, unsigned port, uint8_t mask, bool level, uint64_t at)
{
    uint8_t* const out = &self->alternate[port];
    *out = (uint8_t)(level ? *out | mask : *out & ~mask);
    mcs51_port_drive(self, port, at);
}

/// A level-triggered request flag follows its pin.
void mcs51_level_requests(mcs51_t* self, uint64_t at)
{
    for (unsigned n = 0; n < 2; ++n)
    {
        const uint8_t edge = (uint8_t)(1u << 2 * n), flag = (uint8_t)(2u << 2 * n);
        if (self->mem[TCON] & edge)
        {
            continue;
        }
        if ((unsigned)self->p3_sampled >> (2 + n) & 1u)
        {
            self->mem[TCON] &= (uint8_t)~flag;
        }
        else
        {
            mcs51_raise(self, n ? IRQ_INT1 : IRQ_INT0, TCON, flag, at);
        }
    }
}

static void pins_sample(mcs51_t* self, uint64_t at)
{
    const uint8_t pins = mcs51_port_pins(self, 3), fell = (uint8_t)(self->p3_sampled & ~pins);
    mcs51_uart_pins_change(self, at);
    mcs51_timers_sync(self, at); // with the old gates
    self->pins_due = MCS51_NEVER;
    self->overflow_known = false;
    self->p3_sampled = pins;
    mcs51_timers_mode(self);
    for (unsigned n = 0; n < 2; ++n)
    {
        if (((unsigned)fell >> (2 + n) & 1u) && ((unsigned)self->mem[TCON] >> 2 * n & 1u))
        {
            mcs51_raise(self, n ? IRQ_INT1 : IRQ_INT0, TCON, (uint8_t)(2u << 2 * n), at);
        }
    }
    mcs51_level_requests(self, at);
    mcs51_timers_fell(self, fell);
    if (fell & P3_RXD)
    {
        mcs51_uart_rxd_fell(self, at);
    }
    if (self->p1_watched)
    {
        mcs51_t2_sampled(self, mcs51_port_pins(self, 1), at);
    }
}

static void plan_next(mcs51_t* self)
{
    self->periph_at = earlier(earlier(self->pins_due, self->t2_edge_at), earlier(self->tx_at, self->rx_at));
}

void mcs51_plan(mcs51_t* self)
{
    mcs51_uart_plan(self);
    self->t2_edge_at = mcs51_t2_edge_time(self);
    plan_next(self);
}

void mcs51_sync_events(mcs51_t* self, uint64_t t)
{
    while (self->periph_at <= t)
    {
        const uint64_t at = self->periph_at;
        self->periph_at = MCS51_NEVER; // callbacks may come back here
        if (self->pins_due <= at)
        {
            pins_sample(self, at);
            mcs51_uart_plan(self); // a gate may have moved the baud
        }
        else if (self->t2_edge_at <= at)
        {
            mcs51_t2_edge(self, at);
        }
        else if (self->tx_at <= at)
        {
            mcs51_uart_tx(self, at);
        }
        else
        {
            mcs51_uart_rx(self, at);
        }
        plan_next(self);
    }
}

/// An enabled external interrupt ends power-down: its pin goes low, which starts the oscillator, and then high, which starts the clocks
/// and requests it, whatever its type. (Atmel, watchdog timer in power-down; [U] the oscillator starts at once.)
static void wake(mcs51_t* self, uint8_t before, uint64_t at)
{
    const unsigned ie = self->mem[IE], pins = mcs51_port_pins(self, 3);
    for (unsigned n = 0; n < 2; ++n)
    {
        const unsigned pin = 4u << n;
        const bool woken = self->config.wake_at_low ? !(pins & pin) : (pins & ~(unsigned)before & pin) != 0;
        if (!(self->mem[PCON] & PCON_PD) || !(ie & IE_EA) || !(ie >> 2 * n & 1u) || !woken)
        {
            continue;
        }
        self->mem[PCON] &= (uint8_t)~PCON_PD;
        if (!self->config.wake_at_low)
        {
            mcs51_raise(self, n ? IRQ_INT1 : IRQ_INT0, TCON, (uint8_t)(2u << 2 * n), at - 1u);
        }
    }
}

void mcs51_set_pins(mcs51_t* self, unsigned port, uint8_t outside, uint64_t cycle)
{
    const bool sampled = port == 3 || (port == 1 && self->p1_watched);
    if (sampled)
    {
        mcs51_sync(self, cycle);
    }
    const uint8_t before = mcs51_port_pins(self, 3);
    self->outside[port & 3u] = outside;
    if (sampled)
    {
        wake(self, before, cycle);
        inputs_changed(self, port, cycle);
    }
}

uint8_t mcs51_port_out(const mcs51_t* self, unsigned port)
{
    return self->out[port & 3u];
}
