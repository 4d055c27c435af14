/// \file   emu_8051/tlc2543.h
/// \brief  TI TLC2543 12-bit serial ADC, 11 inputs, at its edges (SLAS079F): pipeline of the previous result, 8/12/16 bits, MSB or LSB
///         first, unipolar or bipolar, self-test channels, power-down, EOC and conversion time, abort.
///
/// The data sheet's facts, and what is chosen where it is silent, are at the top of parts/tlc2543.c.
/// SPDX-License-Identifier: MIT
#ifndef EMU_8051_TLC2543_H_INCLUDED
#define EMU_8051_TLC2543_H_INCLUDED
#include "emu/analog.h"
#include "emu/report.h"
#include "emu/sched.h"
#include "emu/wire.h"
#ifdef __cplusplus
extern "C" {
#endif

/// A sample was taken: `at` is the end of acquisition (the last falling I/O CLOCK edge), `code` straight binary, 12 bits, whatever
/// the format of the transfer. channel, from config.first_channel: 0..10 are inputs, 11..13 self-test. An abort may still discard it.
typedef void (*tlc2543_sample_fn)(void* ctx, unsigned channel, uint16_t code, double volts, emu_time_t at);

/// What comes of a sample. A fault may change it.
typedef struct tlc2543_outcome_t
{
    uint16_t code;     ///< straight binary, 12 bits
    emu_time_t t_conv; ///< conversion [ps], 0 at least
    bool eoc_missing;  ///< EOC stays high meanwhile
} tlc2543_outcome_t;

typedef void (*tlc2543_fault_fn)(void* ctx, unsigned channel, emu_time_t at, tlc2543_outcome_t* outcome);

typedef struct tlc2543_config_t
{
    double ref_minus_v, ref_plus_v;
    emu_time_t t_conv;   ///< conversion [ps], 8 us typical, 10 us maximum
    emu_time_t t_eoc;    ///< last falling edge to EOC low, 1.5 us typical, 2.2 us maximum
    emu_time_t t_abort;  ///< a /CS fall within this of the last clock's fall aborts the conversion, 5 us maximum
    emu_time_t t_enable; ///< /CS low to DATA OUT driven, 0.7 us typical, 1.3 us maximum
    emu_time_t t_cs;     ///< /CS low to the first clock, 1.425 us at least, or it is reported
    emu_time_t t_clock;  ///< period of I/O CLOCK, 1 / 4.1 MHz at least, or it is reported
    emu_time_t t_setup;  ///< DATA IN stable before a rising edge, 100 ns at least, or it is reported
    emu_time_t t_hold;   ///< and after it, 0; a change in the instant of the edge is reported in any case
    double offset_lsb, gain_lsb; ///< static errors, 0 by default; gain_lsb at full scale
    emu_analog_t analog;         ///< volts NULL: all inputs at REF-
    unsigned first_channel;      ///< AIN0 is this channel to `analog` and `sampled`, the self-tests 11 to 13 after it
    tlc2543_sample_fn sampled;   ///< may be NULL
    void* sampled_ctx;
    tlc2543_fault_fn fault; ///< before `sampled`; NULL: none
    void* fault_ctx;
    emu_report_t report;
    /// What no data sheet at hand says; all zero but power_up_code is the choice that parts/tlc2543.c describes.
    uint16_t power_up_code;     ///< what is read before the first result; random in silicon, A5Ah by default
    uint8_t power_up_lost;      ///< conversions after power-up that give power_up_code instead of a result
    uint8_t wake_lost;          ///< the same after a software power-down
    uint8_t pad;                ///< the four bits below a 16-bit word
    bool early_cs_loses_result; ///< /CS rising inside a transfer: the previous result reads as zeros from then on
} tlc2543_config_t;

typedef struct tlc2543_t tlc2543_t;

/// Typical data-sheet values, 0 .. 5 V reference.
EMU_API void tlc2543_default_config(tlc2543_config_t* config);
/// Connect the five wires. \return NULL when memory is out, a wire has no room, or the reference span is not positive.
EMU_API tlc2543_t* tlc2543_create(const tlc2543_config_t* config, emu_sched_t* sched, emu_wire_t* eoc,
                                  emu_wire_t* io_clock, emu_wire_t* data_in, emu_wire_t* data_out, emu_wire_t* cs_n);
/// NULL is allowed.
EMU_API void tlc2543_destroy(tlc2543_t* self);
/// The transfer, the conversion and the word. After emu_sched_state; its wires are their owner's.
EMU_API void tlc2543_state(tlc2543_t* self, emu_state_t* io);

#ifdef __cplusplus
}
#endif
#endif // EMU_8051_TLC2543_H_INCLUDED
