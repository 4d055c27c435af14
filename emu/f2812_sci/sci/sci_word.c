/// What the program sees of the receiver: SCIRXST, SCIRXBUF, the FIFO and RXINT. (TI SPRU051, "SCIRXST", "SCI FIFO Description".)
/// SPDX-License-Identifier: MIT
#include "sci_internal.h"

void sci_rx_interrupt(sci_t* self, bool evaluate, bool also)
{
    const uint16_t ffrx = self->reg[SCIFFRX];
    const bool held = !sci_is(self, SCIFFTX, SCIFFTX_SCIRST) || !(ffrx & SCIFFRX_RXFIFORESET);
    if (evaluate && sci_has_fifo(self) && !held && self->rx.fifo.count >= (ffrx & SCIFF_IL))
    {
        sci_set(self, SCIFFRX, SCIFF_INT, true);
    }
    const unsigned both = SCIFF_INT | SCIFF_IENA;
    const bool level = sci_has_fifo(self) && (self->reg[SCIFFRX] & both) == both;
    const bool rises = level && !self->rx.interrupt;
    self->rx.interrupt = level;
    if (rises || also)
    {
        self->env.interrupt(self->env.ctx, false);
    }
}

/// Set error flags. \return an interrupt comes of it
static bool set_errors(sci_t* self, unsigned errors)
{
    const bool new = errors != 0 && !sci_is(self, SCIRXST, SCIRXST_RXERROR);
    sci_set(self, SCIRXST, errors | (errors != 0 ? SCIRXST_RXERROR : 0u), true);
    return new&& sci_is(self, SCICTL1, SCICTL1_RXERRINTENA);
}

/// What SCIRXEMU and SCIRXBUF give: the word at the top of the FIFO, or the last one there was.
static void show(sci_t* self)
{
    const sci_fifo_t* const fifo = &self->rx.fifo;
    sci_fifo_show(self, SCIFFRX, fifo);
    if (fifo->count > 0)
    {
        self->reg[SCIRXBUF] = fifo->word[fifo->head];
        self->reg[SCIRXEMU] = self->reg[SCIRXBUF] & 0xFFu;
    }
}

static void put(sci_t* self, uint16_t word)
{
    sci_fifo_t* const fifo = &self->rx.fifo;
    if (fifo->count == SCI_FIFO)
    {
        if (!sci_is(self, SCIFFRX, SCIFFRX_RXFFOVF))
        {
            sci_set(self, SCIFFRX, SCIFFRX_RXFFOVF, true);
            sci_report(self, "receive FIFO overflow: 16 words were not read, one is lost", word & 0xFFu);
        }
        if (self->env.switches->sci_rxffovf)
        {
            return;
        }
        (void)sci_fifo_take(fifo);
    }
    sci_fifo_put(fifo, word);
    show(self);
}

void sci_rx_hand_over(sci_t* self)
{
    const uint16_t ccr = self->reg[SCICCR];
    const unsigned bits = sci_characters(self), addressed = (ccr & SCICCR_ADDRIDLE_MODE) != 0;
    const uint32_t frame = self->rx.done.frame >> 1, looked_at = (UINT32_C(2) << (bits + addressed)) - 1u;
    const bool wake = addressed ? (frame >> bits & 1u) != 0 : self->rx.done.idle;
    if (!sci_is(self, SCICTL1, SCICTL1_RXENA) || (sci_is(self, SCICTL1, SCICTL1_SLEEP) && !wake))
    {
        return;
    }
    const uint16_t data = (uint16_t)(frame & ((1u << bits) - 1u));
    const bool fe = self->rx.done.framing_error;
    const bool pe = (ccr & SCICCR_PARITYENA) && sci_odd(frame & looked_at) == ((ccr & SCICCR_PARITY) != 0);
    const bool fifo = sci_has_fifo(self), held = fifo && !sci_is(self, SCIFFRX, SCIFFRX_RXFIFORESET);
    const bool oe = !held && sci_is(self, SCIRXST, SCIRXST_RXRDY) && (!fifo || self->rx.fifo.count == 0);
    const bool first_oe = oe && !sci_is(self, SCIRXST, SCIRXST_OE);
    const bool error = set_errors(self, (fe ? SCIRXST_FE : 0u) | (pe ? SCIRXST_PE : 0u) | (oe ? SCIRXST_OE : 0u));
    if (first_oe)
    {
        sci_report(self, "overrun: the character before it was not read", data);
    }
    if (!held)
    {
        sci_set(self, SCIRXST, SCIRXST_RXRDY, true);
        if (wake || !fifo)
        {
            sci_set(self, SCIRXST, SCIRXST_RXWAKE, wake);
        }
        if (fifo)
        {
            put(self, (uint16_t)(data | (fe ? SCIRXBUF_SCIFFFE : 0u) | (pe ? SCIRXBUF_SCIFFPE : 0u)));
        }
        else
        {
            self->reg[SCIRXBUF] = self->reg[SCIRXEMU] = data;
        }
    }
    sci_rx_interrupt(self, true, error || (!fifo && sci_is(self, SCICTL2, SCICTL2_RXBKINTENA)));
}

void sci_rx_break(sci_t* self)
{
    if (!sci_is(self, SCICTL1, SCICTL1_RXENA))
    {
        return;
    }
    const bool error = set_errors(self, SCIRXST_BRKDT);
    sci_rx_interrupt(self, false, error || sci_is(self, SCICTL2, SCICTL2_RXBKINTENA));
    if (!sci_rx_listens(self))
    {
        sci_rx_begin(self);
    }
}

void sci_rx_read(sci_t* self)
{
    sci_fifo_t* const fifo = &self->rx.fifo;
    const bool pops = sci_has_fifo(self) && fifo->count > 0;
    if (pops)
    {
        (void)sci_fifo_take(fifo);
        show(self);
        sci_rx_interrupt(self, !self->env.switches->sci_ffint, false);
    }
    sci_set(self, SCIRXST, SCIRXST_RXWAKE, false);
    if (!pops || fifo->count == 0)
    {
        sci_set(self, SCIRXST, SCIRXST_RXRDY, false);
    }
    if (self->env.switches->sci_errors)
    {
        sci_set(self, SCIRXST, SCIRXST_FE | SCIRXST_OE | SCIRXST_PE, false);
        sci_set(self, SCIRXST, SCIRXST_RXERROR, sci_is(self, SCIRXST, SCIRXST_ERRORS));
    }
}

void sci_rx_empty(sci_t* self)
{
    self->rx.fifo.count = 0;
    sci_fifo_show(self, SCIFFRX, &self->rx.fifo);
    if (sci_has_fifo(self))
    {
        sci_set(self, SCIRXST, SCIRXST_RXRDY, false);
    }
}
