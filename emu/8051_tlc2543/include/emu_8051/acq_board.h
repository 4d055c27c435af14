/// \file   emu_8051/acq_board.h
/// \brief  The acquisition board of Zheng and Zhou (2010) and its variants: an MCS-51, TLC2543s on its pins, UART on P3.0/P3.1.
///
/// Every port pin is a net that the outside may drive and watch. Which pins the converters are on is the configuration's.
/// SPDX-License-Identifier: MIT
#ifndef EMU_8051_ACQ_BOARD_H_INCLUDED
#define EMU_8051_ACQ_BOARD_H_INCLUDED
#include "emu_8051/mcs51.h"
#include "emu_8051/tlc2543.h"
#ifdef __cplusplus
extern "C" {
#endif

#define ACQ_ADCS_MAX 4

typedef struct acq_board_t acq_board_t;

typedef struct acq_pin_t
{
    uint8_t port, bit; ///< P1.4: {1, 4}
} acq_pin_t;

/// One converter. Pins may be shared: clocks and data in always, /CS where converters work in step, DATA OUT where they do not.
typedef struct acq_adc_t
{
    acq_pin_t eoc, io_clock, data_in, data_out, cs_n;
    uint8_t first_channel; ///< AIN0 is this channel of config.adc's analog and sampled
} acq_adc_t;

typedef struct acq_board_config_t
{
    uint64_t crystal_hz;  ///< 11059200; 1 to 1e9
    tlc2543_config_t adc; ///< of each; analog, sampled and report included
    acq_adc_t adcs[ACQ_ADCS_MAX];
    unsigned adc_count; ///< 0..ACQ_ADCS_MAX
    emu_report_t report;
    mcs51_part_t part; ///< these as in mcs51_config_t
    uint32_t code_octets;
    uint32_t xdata_octets;
    uint8_t stack_limit;
} acq_board_config_t;

/// 11.0592 MHz, one converter as tlc2543_default_config() says: P1.0 EOC, P1.1 I/O CLOCK, P1.2 DATA IN, P1.3 DATA OUT, P1.4 /CS;
/// AIN0..2 are X, Y, Z. No reports.
EMU_API void acq_board_default_config(acq_board_config_t* config);
/// The same for six accelerometers, by wiring alone: a second converter in step with the first, on the same clock, DATA IN and /CS, with
/// EOC on P1.5 and DATA OUT on P1.6. Both sample in the same instant; channels 0..2 are AIN0..2 of the first, 3..5 of the second.
EMU_API void acq_board_six_config(acq_board_config_t* config);
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
/// Instant of a cycle of the present, also inside callbacks.
EMU_API emu_time_t acq_board_time(acq_board_t* self, uint64_t cycle);
/// By pin, "P1.4", or by what is on it: "EOC", "I/O CLOCK", "DATA IN", "DATA OUT", "/CS", of a further converter "/CS 2"; "TXD", "RXD".
/// NULL if there is none.
EMU_API emu_wire_t* acq_board_wire(acq_board_t* self, const char* name);
/// Level of a pin of the CPU, port 0..3 and bit 0..7.
EMU_API bool acq_board_pin(const acq_board_t* self, unsigned port, unsigned bit);
/// What a probe on that pin drives from now on, between runs; EMU_Z takes it away.
EMU_API void acq_board_drive_pin(acq_board_t* self, unsigned port, unsigned bit, emu_drive_t drive);
/// Cut a net at the CPU's pin, named as in acq_board_wire, or mend it; between runs. The CPU then reads what it drives itself (port 0,
/// which has no pull-ups: the last level), and the others see nobody there. \return 0, or -1 where there is no such net.
EMU_API int acq_board_cut(acq_board_t* self, const char* name, bool cut);
/// From now on the crystal is off by so many 1e-9 of crystal_hz; |ppb| <= EMU_PPB_MAX.
EMU_API void acq_board_set_crystal(acq_board_t* self, int32_t ppb);

/// All of the board, and the clock of its scheduler, as octets; between runs.
/// \return the octets needed. If size is less, what was written means nothing.
EMU_API size_t acq_board_save(acq_board_t* self, uint8_t* octets, size_t size);
/// Into a board of the same configuration. Whatever else is on the board's wires and scheduler is its owner's to restore, afterwards.
/// \return 0; -1 and the board unchanged: other magic, version, part, memory, crystal or converters, wrong length, octets changed since, or no memory.
EMU_API int acq_board_restore(acq_board_t* self, const uint8_t* octets, size_t size);

#ifdef __cplusplus
}
#endif
#endif // EMU_8051_ACQ_BOARD_H_INCLUDED
