/// \file   timers.c
/// \brief  Timers 0 and 1 (MCS-51 hardware description, "Timer/Counters"): modes 0 to 3, gate, counter pins. Unit: machine cycle.
///
/// A timer costs nothing while it counts: TL and TH are brought up to date when they are read, written or due, in closed form.
/// SPDX-License-Identifier: MIT
#include "../cpu/mcs51_internal.h"

enum
{
    TMOD_COUNTER = 0x04,
    TMOD_GATE = 0x08
};

static inline unsigned mode(const mcs51_t* self, unsigned n)
{
    return self->mem[TMOD] >> 4 * n & 3u;
}

/// With timer 0 in mode 3, TH0 has taken TR1 and TF1; timer 1 runs free unless it is in mode 3 itself, and only makes baud.
static inline bool split(const mcs51_t* self)
{
    return mode(self, 0) == 3;
}

static inline bool enabled(const mcs51_t* self, unsigned n)
{
    const unsigned tmod = self->mem[TMOD];
    if (n == 1 && ((tmod & 3u) == 3u || (tmod & 0x30u) == 0x30u))
    {
        return (tmod & 0x30u) != 0x30u;
    }
    return (self->mem[TCON] >> (4 + 2 * n) & 1u) &&
           (!(tmod >> 4 * n & TMOD_GATE) || (self->p3_sampled >> (2 + n) & 1u));
}

static inline bool counts_cycles(const mcs51_t* self, unsigned n)
{
    return (unsigned)self->counting >> n & 1u;
}

static inline bool th0_runs(const mcs51_t* self)
{
    return self->counting & COUNTING_TH0;
}

void mcs51_timers_mode(mcs51_t* self)
{
    self->counting = split(self) && (self->mem[TCON] & TCON_TR1) ? COUNTING_TH0 : 0;
    for (unsigned n = 0; n < 2; ++n)
    {
        if (!(self->mem[TMOD] >> 4 * n & TMOD_COUNTER) && enabled(self, n))
        {
            self->counting |= (uint8_t)(1u << n);
        }
    }
}

static inline mcs51_counter_t counter(const mcs51_t* self, unsigned n)
{
    const unsigned tl = self->mem[TL0 + n], th = self->mem[TH0 + n];
    switch (mode(self, n))
    {
    case 0:
        return (mcs51_counter_t){0x2000u - (th << 5 | (tl & 0x1Fu)), 0x2000u};
    case 1:
        return (mcs51_counter_t){0x10000u - (th << 8 | tl), 0x10000u};
    case 2:
        return (mcs51_counter_t){0x100u - tl, 0x100u - th};
    default:
        return (mcs51_counter_t){0x100u - tl, 0x100u};
    }
}

/// Counts after the last overflow, or without one, back into the registers. Mode 0 clears the upper bits of TL ([U]: indeterminate).
static inline void store(mcs51_t* self, unsigned n, const mcs51_counter_t* c)
{
    uint8_t* const tl = &self->mem[TL0 + n];
    uint8_t* const th = &self->mem[TH0 + n];
    switch (mode(self, n))
    {
    case 0:
        *tl = (0x2000u - c->left) & 0x1Fu;
        *th = (uint8_t)((0x2000u - c->left) >> 5);
        break;
    case 1:
        *tl = (uint8_t)(0x10000u - c->left);
        *th = (uint8_t)((0x10000u - c->left) >> 8);
        break;
    default:
        *tl = (uint8_t)(0x100u - c->left);
        break;
    }
}

uint64_t mcs51_advance(mcs51_counter_t* c, uint64_t k, uint64_t* first)
{
    *first = c->left;
    if (k < c->left)
    {
        c->left -= k;
        return 0;
    }
    k -= c->left;
    if (k < c->period)
    {
        c->left = c->period - k;
        return 1u;
    }
    c->left = c->period - k % c->period;
    return 1u + k / c->period;
}

static void overflowed(mcs51_t* self, unsigned n, uint64_t at)
{
    const uint8_t flag = (uint8_t)(0x20u << 2 * n);
    if (!(self->mem[TCON] & flag))
    {
        mcs51_raise(self, n ? IRQ_T1 : IRQ_T0, TCON, flag, at);
    }
}

static inline void count(mcs51_t* self, unsigned n, uint64_t k, uint64_t from)
{
    mcs51_counter_t c = counter(self, n);
    if (k < c.left)
    {
        c.left -= k;
        store(self, n, &c);
        return;
    }
    uint64_t first;
    const uint64_t overflows = mcs51_advance(&c, k, &first);
    store(self, n, &c);
    if (n == 1)
    {
        self->t1_overflows += overflows;
    }
    if (!(n == 1 && split(self)))
    {
        overflowed(self, n, from + first);
    }
}

void mcs51_timer_sync(mcs51_t* self, unsigned n, uint64_t t)
{
    if (t <= self->timer_at[n])
    {
        return;
    }
    const uint64_t from = self->timer_at[n], k = t - from;
    self->timer_at[n] = t;
    if (counts_cycles(self, n))
    {
        count(self, n, k, from);
    }
    if (n == 0 && th0_runs(self))
    {
        mcs51_counter_t c = {0x100u - self->mem[TH0], 0x100u};
        uint64_t first;
        if (mcs51_advance(&c, k, &first))
        {
            overflowed(self, 1, from + first);
        }
        self->mem[TH0] = (uint8_t)(0x100u - c.left);
    }
}

void mcs51_timers_sync(mcs51_t* self, uint64_t t)
{
    mcs51_timer_sync(self, 0, t);
    mcs51_timer_sync(self, 1, t);
    mcs51_t2_sync(self, t);
}

void mcs51_timers_fell(mcs51_t* self, uint8_t fell)
{
    for (unsigned n = 0; n < 2; ++n)
    {
        if (((unsigned)fell >> (4 + n) & 1u) && enabled(self, n) && !counts_cycles(self, n))
        {
            count(self, n, 1, self->timer_at[n] - 1u);
        }
    }
}

uint64_t mcs51_timer_next(const mcs51_t* self, unsigned n)
{
    if (n == 1 && split(self))
    {
        return th0_runs(self) ? self->timer_at[0] + 0x100u - self->mem[TH0] : MCS51_NEVER;
    }
    return counts_cycles(self, n) ? self->timer_at[n] + counter(self, n).left : MCS51_NEVER;
}

uint64_t mcs51_overflow_next(mcs51_t* self)
{
    const unsigned ie = self->mem[IE];
    uint64_t boundary = MCS51_NEVER;
    self->overflow_at = MCS51_NEVER;
    for (unsigned n = 0; n < 2 && (ie & IE_EA); ++n)
    {
        const uint64_t at =
            (ie >> (1 + 2 * n) & 1u) && !(self->mem[TCON] & 0x20u << 2 * n) ? mcs51_timer_next(self, n) : MCS51_NEVER;
        if (at < self->overflow_at)
        {
            self->overflow_at = at;
            boundary = at + 1u; // the flag is polled in the next cycle
        }
    }
    if ((ie & IE_EA) && (ie & IE_ET2) && !(self->mem[T2CON] & T2CON_TF2))
    {
        const uint64_t at = mcs51_t2_next(self);
        self->overflow_at = at < self->overflow_at ? at : self->overflow_at;
        boundary = at < boundary ? at : boundary;
    }
    self->overflow_boundary = boundary;
    self->overflow_known = true;
    return boundary;
}

uint64_t mcs51_t1_time(const mcs51_t* self, uint64_t number)
{
    if (number <= self->t1_overflows)
    {
        return self->timer_at[1];
    }
    if (!counts_cycles(self, 1))
    {
        return MCS51_NEVER;
    }
    const mcs51_counter_t c = counter(self, 1);
    return self->timer_at[1] + c.left + (number - self->t1_overflows - 1u) * c.period;
}
