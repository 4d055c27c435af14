/// \file   emu/analog.h
/// \brief  Analogue nets as functions of time: volts = fn(ctx, channel, t_ps).
///
/// The function is plain C with no type of the emulator in it, so that a motion model that knows nothing of boards can be one.
/// SPDX-License-Identifier: MIT
#ifndef EMU_ANALOG_H_INCLUDED
#define EMU_ANALOG_H_INCLUDED
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif

typedef double (*emu_analog_fn)(void* ctx, unsigned channel, int64_t t_ps);

typedef struct emu_analog_t
{
    emu_analog_fn volts;
    void* ctx;
} emu_analog_t;

#ifdef __cplusplus
}
#endif
#endif // EMU_ANALOG_H_INCLUDED
