/// Receiver of the SCI, from the line to RXSHF: start bit, majority of three samples, stop bit, break.
/// (TI SPRU051, "SCI Communication Format": a start bit is four SCICLK of 0 after a fall; a bit is the majority of SCICLK 4, 5 and 6.)
/// SPDX-License-Identifier: MIT
#include "sci_internal.h"

enum
{
    START_SAMPLES = 4,
    VOTE_FIRST = 4,
    VOTE_LAST = 6,
    READY = 7,          ///< SCICLK of the stop bit at which a frame is handed over: seven eighths
    SYNC_SYSCLK = 3,    ///< cycles of SYSCLKOUT until the CPU sees it
    IDLE_BITS = 10,     ///< before a frame mark it as an address
    BREAK_10_BITS = 80, ///< SCICLK after a missing stop bit
    BREAK_9_625_BITS = 77
};

bool sci_rx_listens(const sci_t* self)
{
    return sci_released(self) && !sci_auto_listens(self) &&
           !(sci_is(self, SCIRXST, SCIRXST_BRKDT) && !self->env.switches->sci_break_hold);
}

static bool address_mode(const sci_t* self)
{
    return sci_is(self, SCICCR, SCICCR_ADDRIDLE_MODE);
}

/// Of a frame with its start and one stop bit.
static unsigned frame_bits(const sci_t* self)
{
    return 2u + sci_characters(self) + address_mode(self) + sci_is(self, SCICCR, SCICCR_PARITYENA);
}

/// SCICLK 0 of a frame whose first low sample is n.
static uint64_t origin_of(const sci_t* self, uint64_t n)
{
    return self->env.switches->sci_start_count ? n : n - 1u;
}

static uint64_t ready_at(uint64_t origin, unsigned bits)
{
    return origin + SCI_PER_BIT * (bits - 1u) + READY;
}

static void begin_frame(sci_t* self)
{
    sci_rx_t* const rx = &self->rx;
    rx->in_frame = true;
    rx->last = false;
    rx->idle = rx->next >= rx->idle_from + IDLE_BITS * SCI_PER_BIT;
    rx->origin = origin_of(self, rx->next);
    rx->bits = (uint8_t)frame_bits(self);
    rx->frame = 0;
    rx->votes = 0;
}

/// Samples up to SCICLK `end` while a fall is looked for.
static void search(sci_t* self, uint64_t end)
{
    sci_rx_t* const rx = &self->rx;
    if (!rx->level && rx->last && !self->finishing)
    {
        begin_frame(self);
        return;
    }
    if (rx->level && !rx->last)
    {
        rx->idle_from = rx->next;
        rx->breaking = false;
    }
    rx->last = rx->level;
    rx->next = end;
}

/// The last bit that is looked at has its value. The search for the next fall begins with its last sample.
static void end_frame(sci_t* self, bool stop)
{
    sci_rx_t* const rx = &self->rx;
    const uint64_t end = rx->origin + SCI_PER_BIT * rx->bits;
    rx->in_frame = false;
    rx->done.any = true;
    rx->done.idle = rx->idle;
    rx->done.framing_error = !stop;
    rx->done.frame = rx->frame;
    rx->done.at = ready_at(rx->origin, rx->bits);
    rx->last = stop;
    rx->breaking = !stop;
    rx->idle_from = end + 1u;
    rx->break_at = end + (self->env.switches->sci_break_bits ? BREAK_9_625_BITS : BREAK_10_BITS);
}

static void skip_to(sci_t* self, uint64_t count, uint64_t end)
{
    const uint64_t n = self->rx.origin + count;
    self->rx.next = n < end ? n : end;
}

/// One sample of a frame, or the way to the next one that counts.
static void sample(sci_t* self, uint64_t end)
{
    sci_rx_t* const rx = &self->rx;
    const uint64_t count = rx->next - rx->origin; // 1: first SCICLK of the start bit
    if (count <= START_SAMPLES)
    {
        rx->in_frame = !rx->level; // else it was none, and the sample is one of the search
        rx->next += !rx->level;
        return;
    }
    const unsigned bit = (unsigned)((count - 1u) / SCI_PER_BIT), sub = (unsigned)((count - 1u) % SCI_PER_BIT) + 1u;
    if (bit == 0 || sub > VOTE_LAST)
    {
        skip_to(self, SCI_PER_BIT * (bit + 1u) + VOTE_FIRST, end);
        return;
    }
    if (sub < VOTE_FIRST)
    {
        skip_to(self, SCI_PER_BIT * bit + VOTE_FIRST, end);
        return;
    }
    rx->votes = (uint8_t)(rx->votes + rx->level);
    if (sub == VOTE_LAST)
    {
        const bool one = rx->votes >= 2, no_stop = address_mode(self) && !self->env.switches->sci_addr_erratum;
        rx->votes = 0;
        rx->frame |= (uint32_t)one << bit;
        if (bit + 1u + no_stop == rx->bits)
        {
            end_frame(self, one || no_stop);
            return;
        }
    }
    rx->next++;
}

void sci_rx_catch_up(sci_t* self)
{
    sci_rx_t* const rx = &self->rx;
    const uint64_t end = sci_sciclk(self);
    if (!sci_rx_listens(self))
    {
        rx->next = end;
    }
    while (rx->next < end)
    {
        if (rx->in_frame)
        {
            sample(self, end);
        }
        else
        {
            search(self, end);
        }
    }
}

void sci_rx_begin(sci_t* self)
{
    sci_rx_t* const rx = &self->rx;
    rx->in_frame = rx->breaking = rx->done.any = false;
    rx->last = rx->level;
    rx->next = rx->idle_from = sci_sciclk(self);
    sci_rx_arm(self, false);
}

/// SCICLK at which something is seen if the line stays as it is.
static uint64_t due(const sci_t* self)
{
    const sci_rx_t* const rx = &self->rx;
    if (rx->done.any)
    {
        return rx->done.at;
    }
    if (!sci_rx_listens(self))
    {
        return SCI_NEVER;
    }
    if (rx->in_frame)
    {
        return ready_at(rx->origin, rx->bits);
    }
    if (!rx->level && rx->last && !self->finishing)
    {
        return ready_at(origin_of(self, rx->next), frame_bits(self));
    }
    return rx->breaking ? rx->break_at : SCI_NEVER;
}

void sci_rx_arm(sci_t* self, bool anew)
{
    sci_rx_t* const rx = &self->rx;
    const uint64_t n = due(self);
    if (n == rx->armed && !anew)
    {
        return;
    }
    rx->armed = n;
    const emu_time_t at = n == SCI_NEVER ? EMU_TIME_MAX : sci_sciclk_time(self, n);
    if (at == EMU_TIME_MAX)
    {
        emu_sched_cancel(self->env.sched, &rx->event);
        return;
    }
    const emu_ticker_t* const sysclk = self->env.lspclk->sysclk;
    emu_sched_at(self->env.sched, &rx->event, emu_ticker_ahead(sysclk, emu_ticker_tick(sysclk, at) + SYNC_SYSCLK));
}

void sci_rx_fire(void* ctx, emu_time_t at)
{
    sci_t* const self = ctx;
    sci_rx_t* const rx = &self->rx;
    (void)at;
    sci_rx_catch_up(self);
    const uint64_t now = sci_sciclk(self);
    if (rx->done.any && rx->done.at < now)
    {
        rx->done.any = false;
        sci_rx_hand_over(self);
    }
    if (rx->breaking && rx->break_at < now)
    {
        rx->breaking = false;
        sci_rx_break(self);
    }
    sci_rx_arm(self, true);
}

void sci_rx_input(sci_t* self)
{
    sci_rx_t* const rx = &self->rx;
    const bool pin = !rx->pin || self->env.rxd->level;
    const bool loop = sci_is(self, SCICCR, SCICCR_LOOPBKENA);
    const bool level = loop ? self->tx.level && (pin || !self->env.switches->sci_loop_rxd) : pin;
    if (level == rx->level)
    {
        return;
    }
    sci_rx_catch_up(self);
    rx->level = level;
    if (sci_auto_listens(self))
    {
        sci_auto_edge(self);
    }
    sci_rx_arm(self, false);
}

void sci_rx_edge(void* ctx, bool level, emu_time_t at)
{
    (void)level;
    (void)at;
    sci_rx_input(ctx);
}
