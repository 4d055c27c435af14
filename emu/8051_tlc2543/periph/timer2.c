/// \file   timer2.c
/// \brief  Timer 2 of the AT89S52 (Atmel 1919D, "Timer 2"): capture, auto-reload up and up/down, baud rates, clock-out. Unit: machine cycle.
///
/// It counts cycles, or falls of T2 (P1.0); while it makes baud rates or a clock, one count is two oscillator periods. As in timers.c
/// nothing happens per count. TF2 goes up half a cycle earlier than TF0 and TF1 do and is polled in the cycle of the overflow.
/// Counting down, [U] the count that makes it equal to RCAP2 underflows. [U] The clock on P1.0 begins high.
/// SPDX-License-Identifier: MIT
#include "../cpu/mcs51_internal.h"

enum
{
    P1_T2 = 0x01,
    P1_T2EX = 0x02,
    COUNTS_PER_CYCLE = 6 ///< of a clock generator
};

typedef enum t2_mode_t
{
    RELOAD,
    CAPTURE,
    UP_DOWN,
    CLOCK ///< baud rates or clock-out: auto-reload, no TF2
} t2_mode_t;

static bool clock_out(const mcs51_t* self)
{
    return (self->mem[T2MOD] & T2MOD_T2OE) && !(self->mem[T2CON] & T2CON_COUNTER);
}

static t2_mode_t mode(const mcs51_t* self)
{
    if ((self->mem[T2CON] & (T2CON_RCLK | T2CON_TCLK)) || clock_out(self))
    {
        return CLOCK;
    }
    if (self->mem[T2CON] & T2CON_CAPTURE)
    {
        return CAPTURE;
    }
    return self->mem[T2MOD] & T2MOD_DCEN ? UP_DOWN : RELOAD;
}

static bool down(const mcs51_t* self)
{
    return mode(self) == UP_DOWN && !(self->p1_sampled & P1_T2EX);
}

static uint32_t word(const mcs51_t* self, unsigned low)
{
    return self->mem[low] | (uint32_t)self->mem[low + 1u] << 8;
}

static void set_word(mcs51_t* self, unsigned low, uint32_t value)
{
    self->mem[low] = (uint8_t)value;
    self->mem[low + 1u] = (uint8_t)(value >> 8);
}

static mcs51_counter_t counter(const mcs51_t* self)
{
    const uint32_t count = word(self, TL2), bound = word(self, RCAP2L);
    if (down(self))
    {
        return (mcs51_counter_t){count - bound + (count > bound ? 0u : 0x10000u),
                                 bound == 0xFFFFu ? 0x10000u : 0xFFFFu - bound};
    }
    return (mcs51_counter_t){0x10000u - count, mode(self) == CAPTURE ? 0x10000u : 0x10000u - bound};
}

static void count(mcs51_t* self, uint64_t k, uint64_t from)
{
    mcs51_counter_t c = counter(self);
    uint64_t first;
    const uint64_t overflows = mcs51_advance(&c, k, &first);
    const uint32_t left = (uint32_t)c.left;
    set_word(self, TL2, down(self) ? word(self, RCAP2L) + left : 0x10000u - left);
    self->t2_overflows += overflows;
    if (overflows && mode(self) != CLOCK)
    {
        if (mode(self) == UP_DOWN && (overflows & 1u))
        {
            self->mem[T2CON] ^= T2CON_EXF2; // a 17th bit
        }
        mcs51_raise(self, IRQ_T2, T2CON, T2CON_TF2, from + first - 1u);
    }
}

static bool counts_cycles(const mcs51_t* self)
{
    return (self->mem[T2CON] & (T2CON_TR2 | T2CON_COUNTER)) == T2CON_TR2;
}

static unsigned rate(const mcs51_t* self)
{
    return mode(self) == CLOCK ? COUNTS_PER_CYCLE : 1u;
}

void mcs51_t2_sync(mcs51_t* self, uint64_t t)
{
    const uint64_t from = self->timer_at[2];
    if (t > from)
    {
        self->timer_at[2] = t;
        if (counts_cycles(self))
        {
            count(self, rate(self) * (t - from), from);
        }
    }
}

uint8_t mcs51_t2_requests(const mcs51_t* self)
{
    return mode(self) == UP_DOWN ? T2CON_TF2 : T2CON_TF2 | T2CON_EXF2;
}

uint64_t mcs51_t2_next(const mcs51_t* self)
{
    return counts_cycles(self) && mode(self) != CLOCK ? self->timer_at[2] + counter(self).left : MCS51_NEVER;
}

uint64_t mcs51_t2_time(const mcs51_t* self, uint64_t number)
{
    if (number <= self->t2_overflows)
    {
        return self->timer_at[2];
    }
    if (!counts_cycles(self))
    {
        return MCS51_NEVER;
    }
    const mcs51_counter_t c = counter(self);
    const uint64_t counts = c.left + (number - self->t2_overflows - 1u) * c.period;
    return self->timer_at[2] + (counts + rate(self) - 1u) / rate(self);
}

uint64_t mcs51_t2_edge_time(const mcs51_t* self)
{
    return clock_out(self) ? mcs51_t2_time(self, self->t2_told + 1u) : MCS51_NEVER;
}

void mcs51_t2_edge(mcs51_t* self, uint64_t at)
{
    mcs51_t2_sync(self, at);
    const bool high = self->alternate[1] & P1_T2, odd = (self->t2_overflows - self->t2_told) & 1u;
    self->t2_told = self->t2_overflows;
    self->t2_edge_at = mcs51_t2_edge_time(self);
    mcs51_alternate(self, 1, P1_T2, high != odd, at);
}

void mcs51_t2_sampled(mcs51_t* self, uint8_t pins, uint64_t at)
{
    const uint8_t fell = (uint8_t)(self->p1_sampled & ~pins), t2con = self->mem[T2CON];
    self->p1_sampled = pins;
    if ((fell & P1_T2) && (t2con & T2CON_COUNTER) && (t2con & T2CON_TR2))
    {
        count(self, 1, at - 1u);
    }
    if (!(fell & P1_T2EX) || !(t2con & T2CON_EXEN2) || mode(self) == UP_DOWN)
    {
        return;
    }
    if (mode(self) == CAPTURE)
    {
        set_word(self, RCAP2L, word(self, TL2));
    }
    else if (mode(self) == RELOAD)
    {
        set_word(self, TL2, word(self, RCAP2L));
    }
    mcs51_raise(self, IRQ_T2, T2CON, T2CON_EXF2, at);
}

void mcs51_t2_mode_changed(mcs51_t* self, uint64_t now)
{
    const bool watches = (self->mem[T2CON] & (T2CON_COUNTER | T2CON_EXEN2)) || (self->mem[T2MOD] & T2MOD_DCEN);
    if (watches && !self->p1_watched)
    {
        self->p1_sampled = mcs51_port_pins(self, 1);
    }
    self->p1_watched = watches ? P1_T2 | P1_T2EX : 0;
    self->t2_told = self->t2_overflows;
    if (!clock_out(self))
    {
        mcs51_alternate(self, 1, P1_T2, true, now);
    }
}
