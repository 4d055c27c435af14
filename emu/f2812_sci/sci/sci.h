/// \file   sci/sci.h
/// \brief  Serial communications interface of the F281x, one port: registers, frames bit by bit on two wires (TI SPRU051). Not installed.
///
/// SCICLK is LSPCLK / (BRR + 1), or LSPCLK / 2 for BRR = 0, and runs freely; a bit is 8 of it. Nothing happens at an SCICLK by itself: the
/// transmitter sets an event for each change of its pin, the receiver one for the end of a frame, and takes its samples when the line
/// moves or that event comes. Registers hold what a read gives at any time.
/// SPDX-License-Identifier: MIT
#ifndef F2812_SCI_H_INCLUDED
#define F2812_SCI_H_INCLUDED
#include "../periph/clock.h"
#include "emu/sched.h"
#include "emu/wire.h"
#include "emu_f2812/f2812_config.h"

#define SCI_FIFO      16u ///< words
#define SCI_REGISTERS 16u ///< words of address space
#define SCI_AUTO      6u  ///< edges of 'A' and of 'a'

typedef struct sci_env_t
{
    emu_sched_t* sched;
    const f2812_clock_t* lspclk;
    const f2812_switches_t* switches;
    emu_wire_t *txd, *rxd;
    void (*present)(void* ctx); ///< a write calls it before it looks at sched->now; NULL: that is right anyway
    void (*interrupt)(void* ctx, bool tx); ///< one call is one edge at the PIE: TXINT or RXINT
    void* ctx;
    emu_report_t report;
    const char* name; ///< "SCI-A", for reports
} sci_env_t;

/// Words in the order of their coming.
typedef struct sci_fifo_t
{
    uint16_t word[SCI_FIFO];
    uint8_t head, count;
} sci_fifo_t;

typedef enum sci_tx_state_t
{
    SCI_TX_IDLE,
    SCI_TX_WAIT, ///< until SCICLK `start`: then TXSHF is loaded
    SCI_TX_SHIFT ///< TXSHF is loaded; its start bit begins at SCICLK `start`
} sci_tx_state_t;

/// SCICLK n: the n-th edge of SCICLK since init.
typedef struct sci_tx_t
{
    emu_event_t event;
    sci_fifo_t fifo;
    int driver;
    bool pin;       ///< SCITXD is connected
    bool level;     ///< of the transmitter
    bool full;      ///< SCITXBUF holds a word, without FIFO
    bool interrupt; ///< level of the FIFO's interrupt
    uint8_t owed;   ///< words written before TXENA was cleared
    uint8_t state;  ///< sci_tx_state_t
    uint8_t bits, bit;
    uint32_t frame;
    uint64_t start;
    uint64_t free; ///< SCICLK before which no word is loaded
} sci_tx_t;

typedef struct sci_rx_t
{
    emu_event_t event;
    uint64_t armed; ///< SCICLK of the event; SCI_NEVER
    sci_fifo_t fifo;
    bool pin;           ///< SCIRXD is connected
    bool level;         ///< at the input now
    bool last;          ///< of the last sample
    bool in_frame;      ///< else looking for a falling edge
    bool breaking;      ///< no sample was high since a missing stop bit
    bool idle;          ///< the frame came after ten bits of idle line
    bool interrupt;     ///< level of the FIFO's interrupt
    uint8_t votes;      ///< of the bit
    uint8_t bits;       ///< of a frame, with start and one stop bit
    uint32_t frame;     ///< bits so far, start bit first
    uint64_t next;      ///< SCICLK of the next sample
    uint64_t origin;    ///< SCICLK 0 of the frame
    uint64_t idle_from; ///< SCICLK since which the line is idle
    uint64_t break_at;
    /// A frame that is complete, up to seven eighths of its stop bit.
    struct
    {
        bool any, idle, framing_error;
        uint32_t frame;
        uint64_t at;
    } done;
} sci_rx_t;

typedef struct sci_auto_t
{
    bool armed;
    uint8_t edges;
    uint64_t tick[SCI_AUTO]; ///< of LSPCLK, at each edge
} sci_auto_t;

/// Owned by the caller; members are private.
typedef struct sci_t
{
    sci_env_t env;
    uint16_t reg[SCI_REGISTERS]; ///< what a read gives
    bool clocked;                ///< by PCLKCR
    bool halted;                 ///< by the emulator, at once
    bool finishing;              ///< by the emulator, after the frame
    uint32_t divider;            ///< LSPCLK in an SCICLK
    uint64_t sciclk;             ///< this one lies at LSPCLK `tick`, or `tick` after LSPCLK runs again
    uint64_t tick;
    sci_tx_t tx;
    sci_rx_t rx;
    sci_auto_t autobaud;
} sci_t;

/// As after a reset of the device, without clock and pins. \return 0, or -1 when a wire has no room.
int sci_init(sci_t* self, const sci_env_t* env);
/// Reset of the device: registers, FIFOs, autobaud. Clock and pins are PCLKCR's and GPxMUX's.
void sci_reset(sci_t* self);
/// offset 0 .. F from 7050 or 7750.
uint16_t sci_read(sci_t* self, unsigned offset);
uint16_t sci_peek(const sci_t* self, unsigned offset);
void sci_write(sci_t* self, unsigned offset, uint16_t value);
/// LSPCLK comes, or comes no longer.
void sci_clock(sci_t* self, bool enabled);
/// LSPCLK has just got another rate.
void sci_clock_changed(sci_t* self);
/// Which pins are the SCI's. A pin that is not reads idle, and is not driven.
void sci_pins(sci_t* self, bool tx_is_sci, bool rx_is_sci);
/// The debugger stops the CPU, or lets it go: SCIPRI says what the SCI does.
void sci_emulation_stop(sci_t* self, bool stopped);

#endif // F2812_SCI_H_INCLUDED
