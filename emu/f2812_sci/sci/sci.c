/// Registers of the SCI: what writing does. Reading does something in SCIRXBUF only. (TI SPRU051, chapter "SCI Registers".)
/// SPDX-License-Identifier: MIT
#include "sci_internal.h"
#include <stdio.h>

#define REPORT_TEXT 120

void sci_report(const sci_t* self, const char* text, uint32_t detail)
{
    if (self->env.report.put != NULL)
    {
        char line[REPORT_TEXT];
        (void)snprintf(line, sizeof line, "%s: %s", self->env.name, text);
        self->env.report.put(self->env.report.ctx, EMU_GUEST_ERROR, line, detail, self->env.sched->now);
    }
}

bool sci_odd(uint32_t bits)
{
    bool odd = false;
    for (; bits != 0; bits &= bits - 1u)
    {
        odd = !odd;
    }
    return odd;
}

uint16_t sci_fifo_take(sci_fifo_t* fifo)
{
    const uint16_t word = fifo->word[fifo->head];
    fifo->head = (uint8_t)((fifo->head + 1u) % SCI_FIFO);
    fifo->count--;
    return word;
}

uint16_t sci_peek(const sci_t* self, unsigned offset)
{
    return self->reg[offset % SCI_REGISTERS];
}

uint16_t sci_read(sci_t* self, unsigned offset)
{
    const uint16_t value = self->reg[offset % SCI_REGISTERS];
    if (offset == SCIRXBUF)
    {
        sci_rx_read(self);
    }
    return value;
}

/// The format or the baud is another.
static void reconfigured(sci_t* self, const char* text, uint16_t value)
{
    sci_rx_catch_up(self);
    if (self->tx.state == SCI_TX_SHIFT || self->rx.in_frame)
    {
        sci_report(self, text, value);
    }
}

static void write_ccr(sci_t* self, uint16_t value)
{
    if (self->reg[SCICCR] != value)
    {
        reconfigured(self, "SCICCR changed amid a frame", value);
        self->reg[SCICCR] = value;
        sci_tx_drive(self);
    }
}

static void write_baud(sci_t* self, unsigned offset, uint16_t value)
{
    if (self->reg[offset] != value)
    {
        reconfigured(self, offset == SCIHBAUD ? "SCIHBAUD changed amid a frame" : "SCILBAUD changed amid a frame",
                     value);
        self->reg[offset] = value;
        sci_divide(self);
    }
}

static void write_ctl1(sci_t* self, uint16_t value)
{
    const bool was_on = sci_is(self, SCICTL1, SCICTL1_TXENA);
    self->reg[SCICTL1] = value & SCICTL1_WRITABLE;
    if (was_on && !(value & SCICTL1_TXENA))
    {
        self->tx.owed = sci_has_fifo(self) ? self->tx.fifo.count : self->tx.full;
    }
    if (!(value & SCICTL1_SWRESET))
    {
        self->reg[SCIRXST] = 0;
        sci_tx_stop(self);
    }
}

static void empty_tx(sci_t* self)
{
    self->tx.fifo.count = self->tx.owed = 0;
    sci_fifo_show(self, SCIFFTX, &self->tx.fifo);
    sci_tx_flags(self);
}

static void store_fftx(sci_t* self, uint16_t value)
{
    const unsigned kept = (SCIFF_ST | SCIFF_INT) & ~((value & (unsigned)SCIFF_INTCLR) << 1);
    self->reg[SCIFFTX] = (uint16_t)((self->reg[SCIFFTX] & kept) | (value & SCIFFTX_WRITABLE));
    self->tx.interrupt = self->tx.interrupt && !(value & SCIFF_INTCLR);
}

/// Resets and enable stay as they are, and none holds.
static bool write_fftx_flags(sci_t* self, uint16_t value)
{
    const unsigned resets = SCIFFTX_SCIRST | SCIFFTX_TXFIFOXRESET;
    if ((value & resets) != resets || ((value ^ self->reg[SCIFFTX]) & (resets | SCIFFTX_SCIFFENA)) != 0)
    {
        return false;
    }
    store_fftx(self, value);
    sci_tx_interrupt(self, !self->env.switches->sci_ffint);
    return true;
}

static void write_fftx(sci_t* self, uint16_t value)
{
    store_fftx(self, value);
    if (!(value & SCIFFTX_SCIRST))
    {
        sci_set(self, SCIFFTX, SCIFF_INT, false);
        sci_set(self, SCIFFRX, SCIFF_INT | SCIFFRX_RXFFOVF, false);
        sci_tx_stop(self);
        sci_rx_empty(self);
        sci_rx_interrupt(self, false, false);
    }
    if (!(value & SCIFFTX_SCIRST) || !(value & SCIFFTX_TXFIFOXRESET))
    {
        empty_tx(self);
    }
    sci_tx_flags(self);
    sci_tx_interrupt(self, !self->env.switches->sci_ffint);
    sci_rx_interrupt(self, !self->env.switches->sci_ffint, false);
}

static void write_ffrx(sci_t* self, uint16_t value)
{
    const unsigned cleared = (value & (unsigned)(SCIFF_INTCLR | SCIFFRX_RXFFOVRCLR)) << 1;
    const unsigned kept = (SCIFF_ST | SCIFF_INT | SCIFFRX_RXFFOVF) & ~cleared;
    self->reg[SCIFFRX] = (uint16_t)((self->reg[SCIFFRX] & kept) | (value & SCIFFRX_WRITABLE));
    if (!(value & SCIFFRX_RXFIFORESET))
    {
        sci_rx_empty(self);
    }
    self->rx.interrupt = self->rx.interrupt && !(value & SCIFF_INTCLR);
    sci_rx_interrupt(self, !self->env.switches->sci_ffint, false);
}

static void write_ffct(sci_t* self, uint16_t value)
{
    const bool was_on = sci_is(self, SCIFFCT, SCIFFCT_CDC);
    const uint16_t kept = value & SCIFFCT_ABDCLR ? 0 : SCIFFCT_ABD;
    self->reg[SCIFFCT] = (uint16_t)((self->reg[SCIFFCT] & kept) | (value & SCIFFCT_WRITABLE));
    if (!was_on || !(value & SCIFFCT_CDC))
    {
        self->autobaud = (sci_auto_t){.armed = (value & SCIFFCT_CDC) != 0};
    }
    sci_tx_interrupt(self, false);
}

/// A write that is a matter of flags and interrupts: the present does not matter. \return false: it is not, nothing is done.
static bool write_flags(sci_t* self, unsigned offset, uint16_t value)
{
    switch (offset)
    {
    case SCICTL2:
        self->reg[SCICTL2] =
            (uint16_t)((self->reg[SCICTL2] & ~(unsigned)SCICTL2_WRITABLE) | (value & SCICTL2_WRITABLE));
        return true;
    case SCITXBUF:
        return sci_tx_queue(self, value & 0xFFu);
    case SCIFFTX:
        return write_fftx_flags(self, value);
    case SCIFFRX:
        write_ffrx(self, value);
        return true;
    case SCIPRI:
        self->reg[SCIPRI] = value & (SCIPRI_SOFT | SCIPRI_FREE);
        return true;
    default:
        return false;
    }
}

void sci_write(sci_t* self, unsigned offset, uint16_t value)
{
    if (!write_flags(self, offset, value))
    {
        sci_write_present(self, offset, value);
    }
}

void sci_write_present(sci_t* self, unsigned offset, uint16_t value)
{
    if (self->env.present != NULL)
    {
        self->env.present(self->env.ctx);
    }
    const bool listened = sci_rx_listens(self);
    switch (offset)
    {
    case SCICCR:
        write_ccr(self, value & 0xFFu);
        break;
    case SCICTL1:
        write_ctl1(self, value);
        break;
    case SCIHBAUD:
    case SCILBAUD:
        write_baud(self, offset, value & 0xFFu);
        break;
    case SCITXBUF:
        sci_tx_write(self, value & 0xFFu);
        break;
    case SCIFFTX:
        write_fftx(self, value);
        break;
    case SCIFFCT:
        write_ffct(self, value);
        break;
    default:
        break;
    }
    if (sci_rx_listens(self) != listened)
    {
        sci_rx_begin(self);
    }
    sci_tx_go(self);
}

void sci_reset(sci_t* self)
{
    for (unsigned i = 0; i < SCI_REGISTERS; i++)
    {
        self->reg[i] = 0;
    }
    self->reg[SCIFFTX] = SCIFFTX_SCIRST | SCIFFTX_TXFIFOXRESET;
    self->reg[SCIFFRX] = SCIFFRX_RXFIFORESET | SCIFF_IL;
    self->autobaud.armed = false;
    self->tx.interrupt = self->rx.interrupt = false;
    self->rx.fifo.count = 0;
    sci_divide(self);
    sci_tx_stop(self);
    empty_tx(self);
    sci_rx_begin(self);
}

int sci_init(sci_t* self, const sci_env_t* env)
{
    *self = (sci_t){.env = *env,
                    .divider = 1,
                    .tx = {.event = {.fire = sci_tx_fire, .ctx = self}, .driver = emu_wire_add_driver(env->txd)},
                    .rx = {.event = {.fire = sci_rx_fire, .ctx = self}, .level = true, .armed = SCI_NEVER}};
    if (self->tx.driver < 0 || emu_wire_watch(env->rxd, sci_rx_edge, self) != 0)
    {
        return -1;
    }
    sci_reset(self);
    return 0;
}

void sci_pins(sci_t* self, bool tx_is_sci, bool rx_is_sci)
{
    self->tx.pin = tx_is_sci;
    self->rx.pin = rx_is_sci;
    sci_tx_drive(self);
}
