/// \file   DSP281x_Examples.h
/// \brief  What programs beside the registers use: functions, and a delay in microseconds at 150 MHz.
/// SPDX-License-Identifier: MIT
#ifndef DSP281x_EXAMPLES_H
#define DSP281x_EXAMPLES_H

#ifndef CPU_RATE
#define CPU_RATE 6.667L // [ns] of a cycle of SYSCLKOUT
#endif

#include "DSP281x_GlobalPrototypes.h"

#define DELAY_US(A) DSP28x_usDelay((Uint32)(((((long double)(A)*1000.0L) / (long double)CPU_RATE) - 9.0L) / 5.0L))

#endif // DSP281x_EXAMPLES_H
