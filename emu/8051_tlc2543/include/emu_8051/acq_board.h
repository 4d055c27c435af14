/// \file   emu_8051/acq_board.h
/// \brief  The acquisition board of Zheng and Zhou (2010): AT89S51 + TLC2543 + three gyro channels, UART on P3.0/P3.1.
///
/// Wiring: P1.0 EOC, P1.1 I/O CLOCK, P1.2 DATA IN, P1.3 DATA OUT, P1.4 /CS; 11.0592 MHz. AIN0..2 are X, Y, Z.
/// SPDX-License-Identifier: MIT
#ifndef EMU_8051_ACQ_BOARD_H_INCLUDED
#define EMU_8051_ACQ_BOARD_H_INCLUDED
#include "emu_8051/mcs51.h"
#include "emu_8051/tlc2543.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct acq_board_t acq_board_t;

typedef struct acq_board_config_t
{
    uint64_t crystal_hz;  ///< 11059200; 1 to 1e9
    tlc2543_config_t adc; ///< analog, sampled and report included
    emu_report_t report;
    mcs51_part_t part; ///< these as in mcs51_config_t
    uint32_t code_octets;
    uint32_t xdata_octets;
    uint8_t stack_limit;
} acq_board_config_t;

/// 11.0592 MHz, the converter of tlc2543_default_config(), no reports.
EMU_API void acq_board_default_config(acq_board_config_t* config);
/// The board lives on a run's scheduler, from instant 0, and is its executor (it sets sched->earlier). \return NULL when memory is out or config is bad.
EMU_API acq_board_t* acq_board_create(const acq_board_config_t* config, emu_sched_t* sched);
/// NULL is allowed.
EMU_API void acq_board_destroy(acq_board_t* self);
/// Run firmware and events up to instant t; sched->now is t afterwards, or up to 3 machine cycles later where an instruction that
/// touched a pin ended there. A power-down passes in time like the rest; MCS51_HALTED only says that nothing more will happen.
/// MCS51_STOPPED: returned where the CPU stopped, before t; run again to go on.
EMU_API mcs51_stop_t acq_board_run(acq_board_t* self, emu_time_t t);
/// The board's own CPU, to load and to inspect.
EMU_API mcs51_t* acq_board_cpu(acq_board_t* self);
/// By schematic name: "EOC", "I/O CLOCK", "DATA IN", "DATA OUT", "/CS", "TXD", "RXD". NULL if there is none.
EMU_API emu_wire_t* acq_board_wire(acq_board_t* self, const char* name);
/// Level of a pin of the CPU, port 0..3 and bit 0..7, on a net or not.
EMU_API bool acq_board_pin(const acq_board_t* self, unsigned port, unsigned bit);
/// What a probe on that pin drives from now on, between runs; EMU_Z takes it away.
EMU_API void acq_board_drive_pin(acq_board_t* self, unsigned port, unsigned bit, emu_drive_t drive);

#ifdef __cplusplus
}
#endif
#endif // EMU_8051_ACQ_BOARD_H_INCLUDED
