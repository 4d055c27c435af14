/// \file   emu_8051/mcs51_config.h
/// \brief  What an MCS-51 part is made with: the part, its memory, what the data sheet leaves open, and the outside's callbacks.
/// SPDX-License-Identifier: MIT
#ifndef EMU_8051_MCS51_CONFIG_H_INCLUDED
#define EMU_8051_MCS51_CONFIG_H_INCLUDED
#include "emu/report.h"
#include "emu/time.h"
#include <stdbool.h>
#include <stddef.h>
#ifdef __cplusplus
extern "C" {
#endif

/// What the port drives changed. `out`: latch AND alternate output (TXD on P3.1): 1 = weak high (P0: Z), 0 = strong low.
/// `changed`: bits of `out` that differ from before. Called within the instruction that wrote, cycle = its write; for TXD, the UART's cycle.
typedef void (*mcs51_port_fn)(void* ctx, unsigned port, uint8_t out, uint8_t changed, uint64_t cycle);
/// Before a pin is read, the outside may bring itself up to date (advance its events to `cycle`); may be NULL. What it will do before
/// until_cycle of the run it announces by mcs51_shorten(), or a loop that waits for a pin does not see it.
typedef void (*mcs51_sync_fn)(void* ctx, uint64_t cycle);

/// The watchdog drives RST, high and 98 oscillator periods later low (told in whole machine cycles), unless AUXR.DISRTO; may be NULL.
typedef void (*mcs51_rst_fn)(void* ctx, bool high, uint64_t cycle);

/// Pins of a port that nothing drives while their latch is 1, no pull-up either; NULL: none. Reading one is reported, once after a reset.
typedef uint8_t (*mcs51_undriven_fn)(void* ctx, unsigned port);

typedef enum mcs51_part_t
{
    MCS51_AT89S51 = 0, ///< 4 KB flash, 128 octets of RAM
    MCS51_AT89S52      ///< 8 KB flash, 256 octets of RAM, timer 2
} mcs51_part_t;

/// All zero, but for the clock, is an AT89S51 alone.
typedef struct mcs51_config_t
{
    emu_clock_t clock; ///< hz = crystal, divider = 12; only to stamp reports
    mcs51_port_fn port;
    mcs51_sync_fn sync;
    mcs51_rst_fn rst;
    mcs51_undriven_fn undriven;
    void* ctx; ///< for port, sync, rst, undriven
    emu_report_t report;
    mcs51_part_t part;
    /// Flash and, behind it, external code memory, 65536 at most; 0: the flash alone. /EA low, where all of it is external, runs the
    /// same. The bus does not show on the pins: P0, P2, /RD and /WR are not moved by it, but P0's latch reads FFh after a MOVX.
    uint32_t code_octets;
    uint32_t xdata_octets; ///< external RAM from 0000h, 65536 at most; 0: none, and a MOVX is reported
    uint8_t stack_limit;   ///< last address that the stack may use, beyond it is reported; 0: the top of RAM
    uint64_t ram_seed;     ///< internal RAM is random by it at power-on, as silicon's; 0: zeros
    bool
        wake_at_low; ///< INT0, INT1 end power-down as they go low; else when they are high again, as the data sheet has it
} mcs51_config_t;

#ifdef __cplusplus
}
#endif
#endif // EMU_8051_MCS51_CONFIG_H_INCLUDED
