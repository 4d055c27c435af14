/// \file   DSP281x_CpuTimers.h
/// \brief  CPU timers 0, 1, 2: CpuTimer0Regs at 0C00h, CpuTimer1Regs at 0C08h, CpuTimer2Regs at 0C10h, and their functions.
/// SPDX-License-Identifier: MIT
#ifndef DSP281x_CPU_TIMERS_H
#define DSP281x_CPU_TIMERS_H

// clang-format off
DSP281x_REG(TCR, rsvd1:4, TSS:1, TRB:1, rsvd2:4, SOFT:1, FREE:1, rsvd3:2, TIE:1, TIF:1);
DSP281x_REG(TPR, TDDR:8, PSC:8);
DSP281x_REG(TPRH, TDDRH:8, PSCH:8);
// clang-format on

struct TIM_REG
{
    Uint16 LSW, MSW;
};
union TIM_GROUP
{
    Uint32 all;
    struct TIM_REG half;
};
struct PRD_REG
{
    Uint16 LSW, MSW;
};
union PRD_GROUP
{
    Uint32 all;
    struct PRD_REG half;
};

struct CPUTIMER_REGS
{
    union TIM_GROUP TIM;
    union PRD_GROUP PRD;
    union TCR_REG TCR;
    Uint16 rsvd1;
    union TPR_REG TPR;
    union TPRH_REG TPRH;
};

/// What ConfigCpuTimer() keeps of a timer.
struct CPUTIMER_VARS
{
    volatile struct CPUTIMER_REGS* RegsAddr;
    Uint32 InterruptCount;
    float CPUFreqInMHz;
    float PeriodInUSec;
};

extern volatile struct CPUTIMER_REGS CpuTimer0Regs;
extern volatile struct CPUTIMER_REGS CpuTimer1Regs;
extern volatile struct CPUTIMER_REGS CpuTimer2Regs;
extern struct CPUTIMER_VARS CpuTimer0;
extern struct CPUTIMER_VARS CpuTimer1;
extern struct CPUTIMER_VARS CpuTimer2;

void InitCpuTimers(void);
void ConfigCpuTimer(struct CPUTIMER_VARS* Timer, float Freq, float Period);

#define StartCpuTimer0()       CpuTimer0Regs.TCR.bit.TSS = 0
#define StopCpuTimer0()        CpuTimer0Regs.TCR.bit.TSS = 1
#define ReloadCpuTimer0()      CpuTimer0Regs.TCR.bit.TRB = 1
#define ReadCpuTimer0Counter() CpuTimer0Regs.TIM.all
#define ReadCpuTimer0Period()  CpuTimer0Regs.PRD.all
#define StartCpuTimer1()       CpuTimer1Regs.TCR.bit.TSS = 0
#define StopCpuTimer1()        CpuTimer1Regs.TCR.bit.TSS = 1
#define ReloadCpuTimer1()      CpuTimer1Regs.TCR.bit.TRB = 1
#define ReadCpuTimer1Counter() CpuTimer1Regs.TIM.all
#define ReadCpuTimer1Period()  CpuTimer1Regs.PRD.all
#define StartCpuTimer2()       CpuTimer2Regs.TCR.bit.TSS = 0
#define StopCpuTimer2()        CpuTimer2Regs.TCR.bit.TSS = 1
#define ReloadCpuTimer2()      CpuTimer2Regs.TCR.bit.TRB = 1
#define ReadCpuTimer2Counter() CpuTimer2Regs.TIM.all
#define ReadCpuTimer2Period()  CpuTimer2Regs.PRD.all

#endif // DSP281x_CPU_TIMERS_H
