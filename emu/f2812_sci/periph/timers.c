/// \file   timers.c
/// \brief  CPU timers 0, 1, 2 (TI SPRU078, SPRUI07 section 1.4): 32-bit counters of SYSCLKOUT / (TDDRH:TDDR + 1), down.
///
/// One tick after zero the counter is loaded from the period, so that zeros are PRD + 1 ticks apart. At zero TIF is set and, with TIE,
/// an interrupt comes: TINT0 is INT1.7, TINT1 INT13, TINT2 INT14. Counters are found from the cycle when someone looks at them.
/// SPDX-License-Identifier: MIT
#include "../cpu/device.h"

enum
{
    TIM,
    TIMH,
    PRD,
    PRDH,
    TCR,
    TPR = 6,
    TPRH,
    TIMER_WORDS
};
#define TCR_TSS 0x0010u
#define TCR_TRB 0x0020u
#define TCR_TIE 0x4000u
#define TCR_TIF 0x8000u
#define TINT0   (F2812_VECTOR_PIE + 6u)
#define INT13   12u ///< bit of IFR

typedef struct view_t
{
    uint32_t tim, psc;
    bool zero; ///< it came to zero
} view_t;

static const uint16_t* registers(const f2812_t* self, unsigned n)
{
    return &self->mem[TIMER0TIM + TIMER_WORDS * n];
}

static uint64_t period(const uint16_t* reg)
{
    return ((uint64_t)reg[PRDH] << 16 | reg[PRD]) + 1u;
}

static uint64_t divider(const uint16_t* reg)
{
    return ((reg[TPRH] & 0xFFu) << 8 | (reg[TPR] & 0xFFu)) + 1u;
}

static view_t view(const f2812_t* self, unsigned n)
{
    const f2812_timer_t* const t = &self->timer[n];
    const uint16_t* const reg = registers(self, n);
    const uint64_t cycles = (reg[TCR] & TCR_TSS) != 0 ? 0 : self->cycle - t->at;
    if (cycles <= t->psc)
    {
        return (view_t){t->tim, (uint32_t)(t->psc - cycles), false};
    }
    const uint64_t div = divider(reg), since = cycles - t->psc - 1u, ticks = 1u + since / div;
    const uint32_t psc = (uint32_t)(div - 1u - since % div);
    if (ticks < t->tim)
    {
        return (view_t){(uint32_t)(t->tim - ticks), psc, false};
    }
    const uint64_t behind = (ticks - t->tim) % period(reg); // ticks behind a zero
    return (view_t){behind == 0 ? 0 : (uint32_t)(period(reg) - behind), psc, t->tim != 0 || ticks >= period(reg)};
}

static void sync(f2812_t* self, unsigned n)
{
    f2812_timer_t* const t = &self->timer[n];
    const view_t now = view(self, n);
    t->at = self->cycle;
    t->tim = now.tim;
    t->psc = now.psc;
    self->mem[TIMER0TIM + TIMER_WORDS * n + TCR] |= (uint16_t)(now.zero ? TCR_TIF : 0);
}

static void plan(f2812_t* self, unsigned n)
{
    f2812_timer_t* const t = &self->timer[n];
    const uint16_t* const reg = registers(self, n);
    emu_sched_cancel(self->sched, &t->event);
    if ((reg[TCR] & (TCR_TIE | TCR_TSS)) == TCR_TIE)
    {
        const uint64_t ticks = t->tim != 0 ? t->tim : period(reg);
        const uint64_t cycle = t->at + t->psc + 1u + (ticks - 1u) * divider(reg);
        emu_sched_at(self->sched, &t->event, emu_ticker_ahead(&self->sysclk, cycle));
    }
}

void f2812_timers_plan(f2812_t* self)
{
    for (unsigned n = 0; n < F2812_TIMERS; n++)
    {
        plan(self, n);
    }
}

static void zero(void* ctx, emu_time_t at)
{
    (void)at;
    f2812_timer_t* const t = ctx;
    f2812_t* const self = t->device;
    const unsigned n = (unsigned)(t - self->timer);
    sync(self, n);
    plan(self, n);
    if (n == 0)
    {
        f2812_pie_request(self, TINT0);
    }
    else
    {
        f2812_cpu_request(self, INT13 + n - 1u);
    }
}

void f2812_timers_init(f2812_t* self)
{
    for (unsigned n = 0; n < F2812_TIMERS; n++)
    {
        self->timer[n].device = self;
        self->timer[n].event = (emu_event_t){.fire = zero, .ctx = &self->timer[n]};
    }
}

void f2812_timers_reset(f2812_t* self)
{
    for (unsigned n = 0; n < F2812_TIMERS; n++)
    {
        f2812_timer_t* const t = &self->timer[n];
        const uint16_t* const reg = registers(self, n);
        t->at = self->cycle;
        t->tim = (uint32_t)reg[TIMH] << 16 | reg[TIM];
        t->psc = 0;
    }
}

uint16_t f2812_timer_peek(const f2812_t* self, uint16_t address)
{
    const unsigned n = ((unsigned)address - TIMER0TIM) / TIMER_WORDS;
    const view_t now = view(self, n);
    switch (((unsigned)address - TIMER0TIM) % TIMER_WORDS)
    {
    case TIM:
        return (uint16_t)now.tim;
    case TIMH:
        return (uint16_t)(now.tim >> 16);
    case TCR:
        return (uint16_t)(self->mem[address] | (now.zero ? TCR_TIF : 0));
    case TPR:
        return (uint16_t)((now.psc & 0xFFu) << 8 | self->mem[address]);
    default: // TPRH
        return (uint16_t)((now.psc >> 8) << 8 | self->mem[address]);
    }
}

void f2812_timer_write(f2812_t* self, uint16_t address, uint16_t value)
{
    const unsigned n = ((unsigned)address - TIMER0TIM) / TIMER_WORDS;
    f2812_timer_t* const t = &self->timer[n];
    (void)f2812_sync(self);
    sync(self, n);
    const uint16_t tif = self->mem[address] & ~value & TCR_TIF;
    const uint16_t writable = self->map[address].writable;
    switch (((unsigned)address - TIMER0TIM) % TIMER_WORDS)
    {
    case TIM:
        t->tim = (t->tim & 0xFFFF0000u) | value;
        break;
    case TIMH:
        t->tim = (t->tim & 0xFFFFu) | (uint32_t)value << 16;
        break;
    case TCR:
        self->mem[address] = (uint16_t)(tif | (value & writable & ~(TCR_TIF | TCR_TRB)));
        if ((value & TCR_TRB) != 0)
        {
            t->tim = (uint32_t)(period(registers(self, n)) - 1u);
            t->psc = (uint32_t)(divider(registers(self, n)) - 1u);
        }
        break;
    default: // PRD, PRDH, TPR, TPRH: taken over at the next reload
        self->mem[address] = value & writable;
        break;
    }
    plan(self, n);
}
