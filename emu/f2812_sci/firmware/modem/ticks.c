/// The 32-bit count is written by the interrupt and read twice, in case it changed between its words.
/// SPDX-License-Identifier: MIT
#include "ticks.h"
#include "DSP281x_Examples.h"

static volatile Uint32 count;

void ticks_open(float sysclk_mhz)
{
    InitCpuTimers();
    ConfigCpuTimer(&CpuTimer0, sysclk_mhz, 1000.0f);
    StartCpuTimer0();
}

Uint32 ticks_ms(void)
{
    Uint32 first, second;

    do
    {
        first = count;
        second = count;
    } while (first != second);
    return first;
}

void timeout_set(timeout_t* t, Uint32 ms)
{
    t->start = ticks_ms();
    t->length = ms;
}

Uint16 timeout_over(const timeout_t* t)
{
    return ticks_ms() - t->start >= t->length;
}

interrupt void ticks_isr(void)
{
    count++;
    PieCtrlRegs.PIEACK.all = PIEACK_GROUP1;
}
