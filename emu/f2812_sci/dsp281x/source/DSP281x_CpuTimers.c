/// InitCpuTimers() and ConfigCpuTimer().
/// SPDX-License-Identifier: MIT
#include "DSP281x_Device.h"
#include "DSP281x_Examples.h"

struct CPUTIMER_VARS CpuTimer0;
struct CPUTIMER_VARS CpuTimer1;
struct CPUTIMER_VARS CpuTimer2;

/// Stopped, at the longest period, without prescaler.
static void Prepare(struct CPUTIMER_VARS* Timer, volatile struct CPUTIMER_REGS* Regs)
{
    Timer->RegsAddr = Regs;
    Regs->PRD.all = 0xFFFFFFFF;
    Regs->TPR.all = 0;
    Regs->TPRH.all = 0;
    Regs->TCR.bit.TSS = 1;
    Regs->TCR.bit.TRB = 1;
    Timer->InterruptCount = 0;
}

void InitCpuTimers(void)
{
    Prepare(&CpuTimer0, &CpuTimer0Regs);
    Prepare(&CpuTimer1, &CpuTimer1Regs);
    Prepare(&CpuTimer2, &CpuTimer2Regs);
}

/// Freq: SYSCLKOUT [MHz]; Period [us]. The timer is left stopped, with its interrupt on.
void ConfigCpuTimer(struct CPUTIMER_VARS* Timer, float Freq, float Period)
{
    Timer->CPUFreqInMHz = Freq;
    Timer->PeriodInUSec = Period;
    Timer->RegsAddr->PRD.all = (Uint32)(Freq * Period);
    Timer->RegsAddr->TPR.all = 0;
    Timer->RegsAddr->TPRH.all = 0;
    Timer->RegsAddr->TCR.bit.TSS = 1;
    Timer->RegsAddr->TCR.bit.TRB = 1;
    Timer->RegsAddr->TCR.bit.SOFT = 1;
    Timer->RegsAddr->TCR.bit.FREE = 1;
    Timer->RegsAddr->TCR.bit.TIE = 1;
    Timer->InterruptCount = 0;
}
