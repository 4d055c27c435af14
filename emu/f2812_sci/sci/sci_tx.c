/// Transmitter of the SCI: SCITXBUF or its FIFO, TXSHF, and the pin. (TI SPRU051, "SCI Communication Format", "SCI FIFO Description".)
/// SPDX-License-Identifier: MIT
#include "sci_internal.h"

#define WAKE_BITS 11u ///< of idle line that mark the next frame as an address

static bool waiting(const sci_t* self)
{
    return sci_has_fifo(self) ? self->tx.fifo.count > 0 : self->tx.full;
}

void sci_tx_flags(sci_t* self)
{
    const sci_tx_t* const tx = &self->tx;
    sci_set(self, SCICTL2, SCICTL2_TXRDY, sci_has_fifo(self) ? tx->fifo.count < SCI_FIFO : !tx->full);
    sci_set(self, SCICTL2, SCICTL2_TXEMPTY, !waiting(self) && tx->state != SCI_TX_SHIFT);
}

static bool blocked(const sci_t* self)
{
    return sci_is(self, SCIFFCT, SCIFFCT_ABD) && !self->env.switches->sci_abd;
}

void sci_tx_interrupt(sci_t* self, bool evaluate)
{
    const unsigned released = SCIFFTX_SCIRST | SCIFFTX_SCIFFENA | SCIFFTX_TXFIFOXRESET;
    if (evaluate && (self->reg[SCIFFTX] & released) == released &&
        self->tx.fifo.count <= (self->reg[SCIFFTX] & SCIFF_IL))
    {
        sci_set(self, SCIFFTX, SCIFF_INT, true);
    }
    const unsigned both = SCIFF_INT | SCIFF_IENA;
    const bool level = sci_has_fifo(self) && (self->reg[SCIFFTX] & both) == both && !blocked(self);
    const bool rises = level && !self->tx.interrupt;
    self->tx.interrupt = level;
    if (rises)
    {
        self->env.interrupt(self->env.ctx, true);
    }
}

void sci_tx_drive(sci_t* self)
{
    const sci_tx_t* const tx = &self->tx;
    const bool loop = sci_is(self, SCICCR, SCICCR_LOOPBKENA);
    const bool level = tx->level || (loop && self->env.switches->sci_loop_txd);
    emu_wire_drive(self->env.txd, tx->driver,
                   !tx->pin ? EMU_Z
                   : level  ? EMU_STRONG1
                            : EMU_STRONG0,
                   self->env.sched->now);
    sci_rx_input(self);
}

/// Ones up to bit n.
static uint32_t ones(unsigned n)
{
    return (UINT32_C(1) << n) - 1u;
}

static void make_frame(sci_t* self, uint16_t word)
{
    sci_tx_t* const tx = &self->tx;
    const uint16_t ccr = self->reg[SCICCR];
    const bool wake = sci_is(self, SCICTL1, SCICTL1_TXWAKE);
    sci_set(self, SCICTL1, SCICTL1_TXWAKE, false);
    if (wake && !(ccr & SCICCR_ADDRIDLE_MODE))
    {
        tx->frame = ones(WAKE_BITS);
        tx->bits = WAKE_BITS;
        return;
    }
    unsigned bits = sci_characters(self);
    uint32_t frame = word & ones(bits);
    if (ccr & SCICCR_ADDRIDLE_MODE)
    {
        frame |= (uint32_t)wake << bits++;
    }
    if (ccr & SCICCR_PARITYENA)
    {
        frame |= (uint32_t)(sci_odd(frame) == ((ccr & SCICCR_PARITY) != 0)) << bits++;
    }
    const unsigned stop = ccr & SCICCR_STOPBITS ? 2u : 1u;
    tx->frame = (frame | ones(stop) << bits) << 1;
    tx->bits = (uint8_t)(1u + bits + stop);
}

/// TXSHF takes a word; its frame begins at SCICLK tx.start.
static void load(sci_t* self)
{
    sci_tx_t* const tx = &self->tx;
    const bool fifo = sci_has_fifo(self);
    if (!sci_is(self, SCICTL1, SCICTL1_TXENA))
    {
        tx->owed--;
    }
    tx->state = SCI_TX_SHIFT;
    tx->bit = 0;
    if (fifo)
    {
        make_frame(self, sci_fifo_take(&tx->fifo));
        sci_fifo_show(self, SCIFFTX, &tx->fifo);
    }
    else
    {
        make_frame(self, self->reg[SCITXBUF]);
        tx->full = false;
    }
    sci_tx_flags(self);
    sci_tx_interrupt(self, true);
    if (!fifo && sci_is(self, SCICTL2, SCICTL2_TXINTENA) && !blocked(self))
    {
        self->env.interrupt(self->env.ctx, true);
    }
}

void sci_tx_arm(sci_t* self)
{
    sci_tx_t* const tx = &self->tx;
    if (tx->state == SCI_TX_IDLE)
    {
        return;
    }
    const uint64_t n = tx->start + (tx->state == SCI_TX_SHIFT ? SCI_PER_BIT * tx->bit : 0u);
    const emu_time_t at = sci_sciclk_time(self, n);
    if (at == EMU_TIME_MAX)
    {
        emu_sched_cancel(self->env.sched, &tx->event);
    }
    else
    {
        emu_sched_at(self->env.sched, &tx->event, at);
    }
}

/// Put a bit on the line, and those behind it that are as it is.
static void shift(sci_t* self)
{
    sci_tx_t* const tx = &self->tx;
    tx->level = (tx->frame >> tx->bit & 1u) != 0;
    do
    {
        tx->bit++;
    } while (tx->bit < tx->bits && ((tx->frame >> tx->bit & 1u) != 0) == tx->level);
    sci_tx_arm(self);
    sci_tx_drive(self);
}

static bool may_load(const sci_t* self)
{
    return waiting(self) && sci_released(self) && !self->finishing &&
           (sci_is(self, SCICTL1, SCICTL1_TXENA) || self->tx.owed > 0);
}

void sci_tx_go(sci_t* self)
{
    sci_tx_t* const tx = &self->tx;
    if (tx->state != SCI_TX_IDLE || !may_load(self))
    {
        return;
    }
    const uint64_t next = sci_sciclk(self);
    tx->start = next < tx->free ? tx->free : next;
    if (next < tx->free || self->env.switches->sci_tx_load)
    {
        tx->state = SCI_TX_WAIT;
    }
    else
    {
        load(self);
    }
    sci_tx_arm(self);
}

/// SCICLK tx.start is now.
static void start(sci_t* self)
{
    if (may_load(self))
    {
        load(self);
        shift(self);
    }
}

static uint64_t delay(const sci_t* self)
{
    const unsigned bits = self->reg[SCIFFCT] & SCIFFCT_FFTXDLY;
    const bool more = bits == SCIFFCT_FFTXDLY && self->env.switches->sci_fftxdly;
    return sci_has_fifo(self) ? SCI_PER_BIT * (bits + more) : 0u;
}

void sci_tx_fire(void* ctx, emu_time_t at)
{
    sci_t* const self = ctx;
    sci_tx_t* const tx = &self->tx;
    (void)at;
    if (tx->state == SCI_TX_WAIT)
    {
        tx->state = SCI_TX_IDLE;
        start(self);
        return;
    }
    if (tx->bit < tx->bits)
    {
        shift(self);
        return;
    }
    tx->state = SCI_TX_IDLE;
    tx->start += SCI_PER_BIT * tx->bits;
    tx->free = tx->start + delay(self);
    sci_tx_flags(self);
    if (tx->free == tx->start)
    {
        start(self);
    }
    else
    {
        sci_tx_go(self);
    }
}

void sci_tx_stop(sci_t* self)
{
    sci_tx_t* const tx = &self->tx;
    emu_sched_cancel(self->env.sched, &tx->event);
    tx->state = SCI_TX_IDLE;
    tx->full = false;
    tx->owed = 0;
    tx->free = 0;
    tx->level = true;
    sci_tx_flags(self);
    sci_tx_drive(self);
}

bool sci_tx_queue(sci_t* self, uint8_t word)
{
    sci_tx_t* const tx = &self->tx;
    const unsigned takes = SCIFFTX_SCIFFENA | SCIFFTX_TXFIFOXRESET;
    if (tx->state == SCI_TX_IDLE || (self->reg[SCIFFTX] & takes) != takes || tx->fifo.count == SCI_FIFO)
    {
        return false;
    }
    self->reg[SCITXBUF] = word;
    sci_fifo_put(&tx->fifo, word);
    sci_fifo_show(self, SCIFFTX, &tx->fifo);
    sci_tx_flags(self);
    return true;
}

void sci_tx_write(sci_t* self, uint8_t word)
{
    sci_tx_t* const tx = &self->tx;
    self->reg[SCITXBUF] = word;
    if (!sci_has_fifo(self))
    {
        if (!sci_released(self))
        {
            sci_report(self, "SCITXBUF written while the SCI is held in reset: the word is lost", word);
            return;
        }
        if (tx->full)
        {
            sci_report(self, "SCITXBUF written before TXRDY: the word before it is lost", word);
        }
        tx->full = true;
    }
    else if (!sci_is(self, SCIFFTX, SCIFFTX_TXFIFOXRESET))
    {
        sci_report(self, "SCITXBUF written while TXFIFOXRESET holds the FIFO: the word is lost", word);
    }
    else if (tx->fifo.count == SCI_FIFO)
    {
        sci_report(self, "SCITXBUF written with 16 words in the FIFO: the word is lost", word);
    }
    else
    {
        sci_fifo_put(&tx->fifo, word);
        sci_fifo_show(self, SCIFFTX, &tx->fifo);
    }
    sci_tx_flags(self);
}
