/// \file   emu_f2812/f2812_config.h
/// \brief  What an F2812 is made with: the crystal, and a switch for each thing that TI's papers leave open or contradict.
///
/// A switch that is 0 is at its default, the one that firmware in the field needs. docs/f2812.md names source and test of each.
/// SPDX-License-Identifier: MIT
#ifndef EMU_F2812_F2812_CONFIG_H_INCLUDED
#define EMU_F2812_F2812_CONFIG_H_INCLUDED
#include "emu/report.h"
#ifdef __cplusplus
extern "C" {
#endif

#define F2812_OSCCLK_HZ     UINT64_C(30000000)  ///< crystal of the eZdsp F2812 and of most boards
#define F2812_OSCCLK_HZ_MIN UINT64_C(4000000)   ///< data sheet SPRS174, XCLKIN with the PLL
#define F2812_OSCCLK_HZ_MAX UINT64_C(150000000) ///< data sheet SPRS174, XCLKIN with the PLL bypassed

/// Values of f2812_switches_t.clock_off: an access to a peripheral whose bit in PCLKCR is 0. Always a guest error.
enum
{
    F2812_CLOCK_OFF_DROP = 0, ///< "drop": writes are lost, reads give 0
    F2812_CLOCK_OFF_TAKE      ///< "take": registers are read and written as if there were a clock
};

/// Values of f2812_switches_t.sci_start_count: the first SCICLK that finds the line low.
enum
{
    F2812_SCI_START_COUNT_1 = 0, ///< "1": is the first of the start bit, four of them validate it
    F2812_SCI_START_COUNT_0      ///< "0": is the fall, the four follow it
};

/// Values of f2812_switches_t.sci_break_bits: low after a missing stop bit, until BRKDT.
enum
{
    F2812_SCI_BREAK_BITS_10 = 0, ///< "10"
    F2812_SCI_BREAK_BITS_9_625   ///< "9.625"
};

/// Values of f2812_switches_t.sci_break_hold: after BRKDT nothing is received until
enum
{
    F2812_SCI_BREAK_HOLD_SWRESET = 0, ///< "swreset": SWRESET was 0
    F2812_SCI_BREAK_HOLD_OFF          ///< "off": it is received
};

/// Values of f2812_switches_t.sci_rxffovf: the word that is lost when a 17th arrives.
enum
{
    F2812_SCI_RXFFOVF_FIRST = 0, ///< "first"
    F2812_SCI_RXFFOVF_NEWEST     ///< "newest"
};

/// Values of f2812_switches_t.sci_tx_load: a word written to an idle transmitter leaves SCITXBUF or the FIFO
enum
{
    F2812_SCI_TX_LOAD_WRITE = 0, ///< "write": at once
    F2812_SCI_TX_LOAD_START      ///< "start": as its start bit begins, up to an SCICLK later
};

/// Values of f2812_switches_t.sci_fftxdly: bits that FFTXDLY = FFh means.
enum
{
    F2812_SCI_FFTXDLY_255 = 0, ///< "255"
    F2812_SCI_FFTXDLY_256      ///< "256"
};

/// Values of f2812_switches_t.sci_ffint: TXFFINT and RXFFINT are set
enum
{
    F2812_SCI_FFINT_LEVEL = 0, ///< "level": whenever TXFFST <= TXFFIL, RXFFST >= RXFFIL, at once after a clear
    F2812_SCI_FFINT_EVENT      ///< "event": when a word leaves or arrives, and it is so then
};

/// Values of f2812_switches_t.sci_errors: FE, OE and PE are cleared by
enum
{
    F2812_SCI_ERRORS_SWRESET = 0, ///< "swreset": SWRESET = 0
    F2812_SCI_ERRORS_READ         ///< "read": that, and reading SCIRXBUF
};

/// Values of f2812_switches_t.sci_addr_erratum: no stop bit is looked at in address-bit mode (SPRZ193, all revisions).
enum
{
    F2812_SCI_ADDR_ERRATUM_ON = 0, ///< "on"
    F2812_SCI_ADDR_ERRATUM_OFF     ///< "off"
};

/// Values of f2812_switches_t.sci_abd: while ABD is set, TXINT
enum
{
    F2812_SCI_ABD_BLOCKS = 0, ///< "blocks": does not come
    F2812_SCI_ABD_PASSES      ///< "passes": comes as ever
};

/// Values of f2812_switches_t.sci_loop_txd: in loopback the pin SCITXD
enum
{
    F2812_SCI_LOOP_TXD_SENDS = 0, ///< "sends": as ever
    F2812_SCI_LOOP_TXD_IDLE       ///< "idle": stays high
};

/// Values of f2812_switches_t.sci_loop_rxd: in loopback the pin SCIRXD
enum
{
    F2812_SCI_LOOP_RXD_CUT = 0, ///< "cut": is not heard
    F2812_SCI_LOOP_RXD_JOINED   ///< "joined": is heard too, low wins
};

/// Each member takes the values of the enumeration of its name.
typedef struct f2812_switches_t
{
    uint8_t clock_off; ///< F2812_CLOCK_OFF_*
    uint8_t sci_start_count;
    uint8_t sci_break_bits;
    uint8_t sci_break_hold;
    uint8_t sci_rxffovf;
    uint8_t sci_tx_load;
    uint8_t sci_fftxdly;
    uint8_t sci_ffint;
    uint8_t sci_errors;
    uint8_t sci_addr_erratum;
    uint8_t sci_abd;
    uint8_t sci_loop_txd;
    uint8_t sci_loop_rxd;
} f2812_switches_t;

/// Set a switch by its name, as "clock_off", to a value by its name, as "take". \return NULL, or what is wrong.
EMU_API const char* f2812_switch_set(f2812_switches_t* self, const char* name, const char* value);

typedef struct f2812_config_t
{
    uint64_t oscclk_hz;
    f2812_switches_t switches;
    emu_report_t report;
} f2812_config_t;

/// 30 MHz, all switches at their default, no reports.
EMU_API void f2812_default_config(f2812_config_t* config);

#ifdef __cplusplus
}
#endif
#endif // EMU_F2812_F2812_CONFIG_H_INCLUDED
