/// \file   uart.c
/// \brief  Serial port, modes 0 to 3, bit by bit on TXD and RXD (MCS-51 hardware description, "Serial Interface").
///
/// The divider by 16 of the transmitter runs free: a frame starts at the next rollover after SBUF is written and TI goes up as the stop
/// bit begins, the 10th rollover in mode 1. The receiver's divider starts at the fall of RXD; each bit is the majority of samples at
/// ticks 7, 8, 9 of 16, and a start bit that is then high is dropped. Baud ticks: overflows of timer 1 (modes 1, 3) or two oscillator
/// periods (mode 2), taken by two while SMOD is 0; on the AT89S52 TCLK and RCLK put overflows of timer 2 in the place of timer 1's.
/// SPDX-License-Identifier: MIT
#include "../cpu/mcs51_internal.h"

enum
{
    TICKS_PER_CYCLE = 6, ///< mode 2
    SHIFT_BITS = 8,      ///< mode 0
    BIT_TICKS = 16,
    FIRST_SAMPLE = 7,
    SAMPLES = 3,
    STOP_BIT = 9 ///< in modes 2 and 3 the ninth
};

static unsigned uart_mode(const mcs51_t* self)
{
    return self->mem[SCON] >> 6;
}

/// `clock` is T2CON_TCLK or T2CON_RCLK, for the transmitter or the receiver, here and below.
static bool by_t2(const mcs51_t* self, unsigned clock)
{
    return (self->mem[T2CON] & clock) && (uart_mode(self) & 1u);
}

/// Baud-clock ticks per 1/16 bit.
static unsigned unit(const mcs51_t* self, unsigned clock)
{
    return (self->mem[PCON] & PCON_SMOD) || by_t2(self, clock) ? 1u : 2u;
}

/// Tick number at a cycle.
static uint64_t tick(mcs51_t* self, bool t2, uint64_t at)
{
    if (uart_mode(self) == 2)
    {
        return TICKS_PER_CYCLE * (at - self->frozen);
    }
    if (t2)
    {
        mcs51_t2_sync(self, at);
        return self->t2_overflows;
    }
    mcs51_timer_sync(self, 1, at);
    return self->t1_overflows;
}

/// First multiple of n/16 bit after a cycle.
static uint64_t rollover(mcs51_t* self, unsigned clock, unsigned n, uint64_t at)
{
    n *= unit(self, clock);
    return (tick(self, by_t2(self, clock), at) / n + 1u) * n;
}

static uint64_t cycle_of(const mcs51_t* self, unsigned clock, uint64_t due)
{
    if (due == MCS51_NEVER)
    {
        return MCS51_NEVER;
    }
    switch (uart_mode(self))
    {
    case 0:
        return due + self->frozen;
    case 2:
        return (due + TICKS_PER_CYCLE - 1u) / TICKS_PER_CYCLE + self->frozen;
    default:
        return by_t2(self, clock) ? mcs51_t2_time(self, due) : mcs51_t1_time(self, due);
    }
}

/// On to the next bit that changes TXD from `level` or ends the frame; the ones before leave it as it is.
static void plan_tx(mcs51_t* self, bool level)
{
    uart_t* const u = &self->uart;
    if (u->tx_due != MCS51_NEVER && uart_mode(self) != 0)
    {
        const uint32_t differs = u->tx_frame ^ (level ? UINT32_MAX : 0u);
        unsigned n = u->tx_bit;
        while (n + 1u < u->tx_bits && !(differs >> n & 1u))
        {
            ++n;
        }
        const unsigned passed = n - u->tx_bit;
        u->tx_due += (uint64_t)passed * BIT_TICKS * unit(self, T2CON_TCLK);
        u->tx_bit = (uint8_t)n;
        u->tx_passed = (uint8_t)(u->tx_passed + passed);
    }
    self->tx_at = cycle_of(self, T2CON_TCLK, u->tx_due);
}

/// From the next sample to the last one of the frame: before it, nothing shows that RXD does not show.
static unsigned rx_quiet_ticks(const mcs51_t* self)
{
    const uart_t* const u = &self->uart;
    switch (u->rx_state)
    {
    case RX_WATCH:
        return (FIRST_SAMPLE + STOP_BIT * BIT_TICKS + SAMPLES - 1u) * unit(self, T2CON_RCLK);
    case RX_SAMPLE:
        return (((unsigned)STOP_BIT - u->rx_bit) * BIT_TICKS + SAMPLES - 1u - u->rx_samples) * unit(self, T2CON_RCLK);
    default:
        return 0;
    }
}

static void plan_rx(mcs51_t* self)
{
    const uint64_t due = self->uart.rx_due;
    self->rx_at = due == MCS51_NEVER ? due : cycle_of(self, T2CON_RCLK, due + rx_quiet_ticks(self));
}

void mcs51_uart_plan(mcs51_t* self)
{
    plan_tx(self, self->alternate[3] & P3_TXD);
    plan_rx(self);
}

static void rx_stop(uart_t* u)
{
    u->rx_state = RX_IDLE;
    u->rx_due = MCS51_NEVER;
}

void mcs51_uart_reset(mcs51_t* self)
{
    self->uart.tx_due = MCS51_NEVER;
    rx_stop(&self->uart);
}

void mcs51_uart_sbuf(mcs51_t* self, uint8_t value, uint64_t now)
{
    uart_t* const u = &self->uart;
    const unsigned mode = uart_mode(self);
    if (u->tx_due != MCS51_NEVER)
    {
        mcs51_report(self, EMU_GUEST_ERROR, 0, "SBUF written before TI: the octet being sent is cut off", value);
    }
    u->tx_bit = u->tx_passed = 0;
    if (mode == 0)
    {
        u->tx_frame = value;
        u->tx_due = now - self->frozen + 1u;
        return;
    }
    u->tx_frame = 1u << 10 | (mode == 1 || (self->mem[SCON] & SCON_TB8) ? 1u << 9 : 0u) | (unsigned)value << 1;
    u->tx_bits = mode == 1 ? 10 : 11;
    u->tx_due = rollover(self, T2CON_TCLK, BIT_TICKS, now);
}

/// Mode 0: one bit a cycle; the shift clock falls and rises within it, RXD is driven or sampled in between.
static void shift_out(mcs51_t* self, uint64_t at)
{
    uart_t* const u = &self->uart;
    if (u->tx_bit == SHIFT_BITS)
    {
        u->tx_due = self->tx_at = MCS51_NEVER;
        mcs51_alternate(self, 3, P3_RXD, true, at);
        mcs51_raise(self, IRQ_SERIAL, SCON, SCON_TI, at);
        return;
    }
    const bool level = u->tx_frame >> u->tx_bit & 1u;
    ++u->tx_bit;
    ++u->tx_due;
    self->tx_at = at + 1u;
    mcs51_alternate(self, 3, P3_RXD, level, at);
    mcs51_alternate(self, 3, P3_TXD, false, at);
    mcs51_alternate(self, 3, P3_TXD, true, at);
}

void mcs51_uart_tx(mcs51_t* self, uint64_t at)
{
    uart_t* const u = &self->uart;
    if (uart_mode(self) == 0)
    {
        shift_out(self, at);
        return;
    }
    const bool level = u->tx_frame >> u->tx_bit & 1u;
    u->tx_passed = 0;
    if (++u->tx_bit == u->tx_bits)
    {
        u->tx_due = MCS51_NEVER;
        mcs51_raise(self, IRQ_SERIAL, SCON, SCON_TI, at);
    }
    else
    {
        u->tx_due += BIT_TICKS * unit(self, T2CON_TCLK);
    }
    plan_tx(self, level);
    mcs51_alternate(self, 3, P3_TXD, level, at);
}

static void received(mcs51_t* self, uint8_t octet, bool ninth, uint64_t at)
{
    uint8_t* const scon = &self->mem[SCON];
    if ((*scon & SCON_SM2) && !ninth)
    {
        return;
    }
    if (*scon & SCON_RI)
    {
        mcs51_report(self, EMU_GUEST_ERROR, 0, "serial overrun: RI is still set, this octet is lost", octet);
        return;
    }
    self->mem[SBUF] = octet;
    *scon = (uint8_t)((*scon & ~SCON_RB8) | (ninth ? SCON_RB8 : 0));
    mcs51_raise(self, IRQ_SERIAL, SCON, SCON_RI, at);
}

static void shift_in(mcs51_t* self, uint64_t at)
{
    uart_t* const u = &self->uart;
    if (u->rx_bit == SHIFT_BITS)
    {
        rx_stop(u);
        self->rx_at = MCS51_NEVER;
        self->mem[SBUF] = (uint8_t)u->rx_frame;
        mcs51_raise(self, IRQ_SERIAL, SCON, SCON_RI, at);
        return;
    }
    ++u->rx_due;
    self->rx_at = at + 1u;
    mcs51_alternate(self, 3, P3_TXD, false, at);
    u->rx_frame = u->rx_frame | (mcs51_port_pins(self, 3) & (uint32_t)P3_RXD) << u->rx_bit++;
    mcs51_alternate(self, 3, P3_TXD, true, at);
}

/// A bit has its three samples.
static void rx_bit(mcs51_t* self, bool level, uint64_t at)
{
    uart_t* const u = &self->uart;
    u->rx_samples = 0;
    u->rx_votes = 0;
    if (u->rx_bit == 0 && level)
    {
        rx_stop(u); // no start bit
        return;
    }
    u->rx_frame = u->rx_frame | (uint32_t)level << u->rx_bit;
    if (u->rx_bit < STOP_BIT)
    {
        ++u->rx_bit;
        u->rx_due += (BIT_TICKS - SAMPLES + 1u) * unit(self, T2CON_RCLK);
        return;
    }
    if (uart_mode(self) == 1)
    {
        rx_stop(u);
    }
    else
    {
        u->rx_state = RX_WAIT;
        u->rx_due += BIT_TICKS * unit(self, T2CON_RCLK);
    }
    received(self, (uint8_t)(u->rx_frame >> 1), level, at);
}

/// A tick for which the receiver waits, in modes 1 to 3.
static void rx_tick(mcs51_t* self, uint64_t at)
{
    uart_t* const u = &self->uart;
    const bool level = self->p3_sampled & P3_RXD;
    switch (u->rx_state)
    {
    case RX_WATCH:
        if (level)
        {
            rx_stop(u);
            break;
        }
        u->rx_state = RX_SAMPLE;
        u->rx_bit = u->rx_samples = u->rx_votes = 0;
        u->rx_frame = 0;
        u->rx_due += FIRST_SAMPLE * unit(self, T2CON_RCLK);
        break;
    case RX_SAMPLE:
        u->rx_votes = (uint8_t)(u->rx_votes + level);
        if (++u->rx_samples == SAMPLES)
        {
            rx_bit(self, u->rx_votes > SAMPLES / 2u, at);
        }
        else
        {
            u->rx_due += unit(self, T2CON_RCLK);
        }
        break;
    default:
        rx_stop(u);
        break;
    }
}

/// Take the samples up to a cycle, since which RXD has been as it is.
static void rx_catch_up(mcs51_t* self, uint64_t at)
{
    uart_t* const u = &self->uart;
    if (u->rx_due != MCS51_NEVER && u->rx_state != RX_SHIFT)
    {
        const uint64_t until = tick(self, by_t2(self, T2CON_RCLK), at);
        while (u->rx_due <= until)
        {
            rx_tick(self, at);
        }
    }
}

void mcs51_uart_rx(mcs51_t* self, uint64_t at)
{
    if (self->uart.rx_state == RX_SHIFT)
    {
        shift_in(self, at);
        return;
    }
    rx_catch_up(self, at);
    plan_rx(self);
}

void mcs51_uart_pins_change(mcs51_t* self, uint64_t at)
{
    rx_catch_up(self, at - 1u);
}

void mcs51_uart_rxd_fell(mcs51_t* self, uint64_t at)
{
    uart_t* const u = &self->uart;
    if (u->rx_state == RX_IDLE && uart_mode(self) != 0 && (self->mem[SCON] & SCON_REN))
    {
        u->rx_state = RX_WATCH;
        u->rx_due = rollover(self, T2CON_RCLK, 1u, at);
    }
}

/// What has begun goes on with the new clock; bits that plan_tx() has passed over have not.
void mcs51_uart_clock_changes(mcs51_t* self, uint64_t now)
{
    uart_t* const u = &self->uart;
    if (u->tx_due != MCS51_NEVER && uart_mode(self) != 0)
    {
        const uint64_t bit = BIT_TICKS * unit(self, T2CON_TCLK), begun = tick(self, by_t2(self, T2CON_TCLK), now);
        for (; u->tx_passed > 0 && u->tx_due > begun + bit; --u->tx_passed)
        {
            u->tx_due -= bit;
            --u->tx_bit;
        }
        u->tx_passed = 0;
    }
    rx_catch_up(self, now);
}

void mcs51_uart_scon(mcs51_t* self, uint8_t old, uint64_t now)
{
    uart_t* const u = &self->uart;
    const uint8_t scon = self->mem[SCON];
    if ((old ^ scon) >> 6)
    {
        u->tx_due = MCS51_NEVER; // [U] a change of mode cuts a frame off
        rx_stop(u);
        mcs51_alternate(self, 3, P3_RXD | P3_TXD, true, now);
    }
    if (!(scon & SCON_REN))
    {
        rx_stop(u);
    }
    else if (uart_mode(self) == 0 && !(scon & SCON_RI) && u->rx_state == RX_IDLE)
    {
        u->rx_state = RX_SHIFT;
        u->rx_bit = 0;
        u->rx_frame = 0;
        u->rx_due = now - self->frozen + 1u;
    }
}

/// [U] A frame under way goes on with as many ticks of the new clock as it had left of the old.
static void change_clock(mcs51_t* self, uint64_t* due, bool t2, uint64_t at)
{
    if (*due != MCS51_NEVER && (uart_mode(self) & 1u))
    {
        *due += tick(self, t2, at) - tick(self, !t2, at);
    }
}

void mcs51_uart_t2con(mcs51_t* self, uint8_t old, uint64_t at)
{
    const uint8_t now = self->mem[T2CON], changed = now ^ old;
    if (changed & T2CON_TCLK)
    {
        change_clock(self, &self->uart.tx_due, now & T2CON_TCLK, at);
    }
    if (changed & T2CON_RCLK)
    {
        change_clock(self, &self->uart.rx_due, now & T2CON_RCLK, at);
    }
}
