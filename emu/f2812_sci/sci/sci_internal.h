/// \file   sci/sci_internal.h
/// \brief  What the files of the SCI offer each other.
/// SPDX-License-Identifier: MIT
#ifndef F2812_SCI_INTERNAL_H_INCLUDED
#define F2812_SCI_INTERNAL_H_INCLUDED
#include "sci.h"
#include "sci_bits.h"

#define SCI_NEVER   UINT64_MAX
#define SCI_PER_BIT 8u ///< SCICLK in a bit

static inline bool sci_is(const sci_t* self, unsigned offset, unsigned bits)
{
    return (self->reg[offset] & bits) != 0;
}

static inline void sci_set(sci_t* self, unsigned offset, unsigned bits, bool on)
{
    self->reg[offset] = (uint16_t)(on ? self->reg[offset] | bits : self->reg[offset] & ~bits);
}

/// Neither SWRESET nor SCIRST holds transmitter and receiver.
static inline bool sci_released(const sci_t* self)
{
    return sci_is(self, SCICTL1, SCICTL1_SWRESET) && sci_is(self, SCIFFTX, SCIFFTX_SCIRST);
}

static inline bool sci_has_fifo(const sci_t* self)
{
    return sci_is(self, SCIFFTX, SCIFFTX_SCIFFENA);
}

/// Data bits of a character.
static inline unsigned sci_characters(const sci_t* self)
{
    return (self->reg[SCICCR] & SCICCR_SCICHAR) + 1u;
}

static inline void sci_fifo_put(sci_fifo_t* fifo, uint16_t word)
{
    fifo->word[(fifo->head + fifo->count++) % SCI_FIFO] = word;
}

/// Put a count into a register's SCIFF_ST.
static inline void sci_fifo_show(sci_t* self, unsigned offset, const sci_fifo_t* fifo)
{
    self->reg[offset] = (uint16_t)((self->reg[offset] & ~(unsigned)SCIFF_ST) | (unsigned)fifo->count * SCIFF_ST_ONE);
}

void sci_report(const sci_t* self, const char* text, uint32_t detail); ///< the firmware did something wrong
bool sci_odd(uint32_t bits);                                           ///< number of ones
uint16_t sci_fifo_take(sci_fifo_t* fifo);

void sci_write_present(sci_t* self, unsigned offset, uint16_t value); ///< a write for which the present matters

// SCICLK
uint64_t sci_tick(const sci_t* self);                      ///< first LSPCLK after now
uint64_t sci_sciclk(const sci_t* self);                    ///< first SCICLK after now
emu_time_t sci_sciclk_time(const sci_t* self, uint64_t n); ///< EMU_TIME_MAX while SCICLK stands
void sci_divide(sci_t* self);                              ///< the divider of BRR, its period begins now
void sci_run(sci_t* self, bool* what, bool on);            ///< change `clocked` or `halted`

// Transmitter
void sci_tx_stop(sci_t* self); ///< held in reset
void sci_tx_go(sci_t* self);   ///< begin what can begin
void sci_tx_arm(sci_t* self);  ///< SCICLK has other instants
void sci_tx_write(sci_t* self, uint8_t word);
bool sci_tx_queue(sci_t* self, uint8_t word);      ///< put it into the FIFO, if that is all there is to it
void sci_tx_flags(sci_t* self);                    ///< TXRDY and TXEMPTY
void sci_tx_interrupt(sci_t* self, bool evaluate); ///< TXFFINT and its interrupt
void sci_tx_drive(sci_t* self);                    ///< the pin
void sci_tx_fire(void* ctx, emu_time_t at);

// Receiver
bool sci_rx_listens(const sci_t* self);  ///< takes samples
void sci_rx_begin(sci_t* self);          ///< that has changed
void sci_rx_catch_up(sci_t* self);       ///< take the samples up to now
void sci_rx_arm(sci_t* self, bool anew); ///< anew: SCICLK has other instants
void sci_rx_input(sci_t* self);          ///< what makes the input's level may have changed
void sci_rx_fire(void* ctx, emu_time_t at);
void sci_rx_edge(void* ctx, bool level, emu_time_t at);

// What the program sees of the receiver
void sci_rx_hand_over(sci_t* self); ///< rx.done goes to SCIRXBUF or the FIFO
void sci_rx_break(sci_t* self);     ///< BRKDT
void sci_rx_read(sci_t* self);      ///< SCIRXBUF was read
void sci_rx_empty(sci_t* self);     ///< FIFO reset
void sci_rx_interrupt(sci_t* self, bool evaluate,
                      bool also); ///< RXFFINT and its interrupt; also: there is an edge anyway

// Autobaud
bool sci_auto_listens(const sci_t* self);
void sci_auto_edge(sci_t* self);

#endif // F2812_SCI_INTERNAL_H_INCLUDED
