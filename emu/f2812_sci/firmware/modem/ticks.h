/// \file   ticks.h
/// \brief  Milliseconds since the start, by CPU timer 0.
/// SPDX-License-Identifier: MIT
#ifndef TICKS_H
#define TICKS_H
#include "DSP281x_Device.h"

typedef struct
{
    Uint32 start;
    Uint32 length;
} timeout_t;

void ticks_open(float sysclk_mhz);
Uint32 ticks_ms(void);
void timeout_set(timeout_t* t, Uint32 ms);
Uint16 timeout_over(const timeout_t* t);

interrupt void ticks_isr(void);

#endif /* TICKS_H */
