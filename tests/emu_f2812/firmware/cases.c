/// Firmware that does one thing at a time, for test_shim*.cpp.
/// SPDX-License-Identifier: MIT
#include "cases.h"
#include "DSP281x_Device.h"
#include "DSP281x_Examples.h"
#include <stdlib.h>
#include <string.h>

static void tell(Uint16 value)
{
    CpuTimer1Regs.PRD.half.LSW = value;
}

#define RESET_VALUE 0 // of TIMER1PRDH: after a reset there is no case

volatile Uint16 flag;
volatile Uint32 shared;
Uint16 taken;
Uint16 begun = 5;
Uint16 plain; // of the linker's: each store is made
static Uint16 block[64];

static interrupt void count_isr(void)
{
    taken++;
    shared += 1;
    PieCtrlRegs.PIEACK.all = PIEACK_GROUP1;
}

static interrupt void flag_isr(void)
{
    flag = 1;
    PieCtrlRegs.PIEACK.all = PIEACK_GROUP1;
}

/// Timer 0 with so many cycles, its interrupt to a function.
static void every(Uint32 cycles, PINT function)
{
    InitPieCtrl();
    InitPieVectTable();
    EALLOW;
    PieVectTable.TINT0 = function;
    EDIS;
    CpuTimer0Regs.PRD.all = cycles;
    CpuTimer0Regs.TCR.all = 0x4030; // TIE, TRB, TSS
    CpuTimer0Regs.TCR.bit.TSS = 0;
    PieCtrlRegs.PIECRTL.bit.ENPIE = 1;
    PieCtrlRegs.PIEIER1.bit.INTx7 = 1;
    IER |= M_INT1;
}

static void fields(void)
{
    SciaRegs.SCICCR.all = 0xA7;
    SciaRegs.SCICCR.bit.SCICHAR = 2;
    tell(SciaRegs.SCICCR.all); // A2
    SciaRegs.SCICCR.bit.PARITY = 1;
    tell(SciaRegs.SCICCR.all); // E2
    SciaRegs.SCICCR.all |= 0x08;
    tell(SciaRegs.SCICCR.all); // EA
    SciaRegs.SCICCR.all &= ~0x80;
    tell(SciaRegs.SCICCR.all); // 6A
    SciaRegs.SCIFFTX.all = 0xC009;
    tell(SciaRegs.SCIFFTX.bit.SCIRST + 2 * SciaRegs.SCIFFTX.bit.TXFFILIL); // 1 + 18
    tell(sizeof(struct SCI_REGS) / sizeof(Uint16));
    CpuTimer2Regs.PRD.all = 0x12345678UL;
    tell(CpuTimer2Regs.PRD.half.MSW); // 1234
    tell((Uint16)(CpuTimer2Regs.PRD.all & 0xFFFF));
    ((unsigned char*)&SciaRegs.SCILBAUD)[0] = 0x5C; // not volatile, one byte
    tell(SciaRegs.SCILBAUD);
}

static void atomic(void)
{
    Uint32 i;

    every(701, &count_isr);
    EINT;
    for (i = 0; i < 20000; i++)
    {
        shared += 1;
    }
    DINT;
    tell(taken > 100);
    tell(shared == 20000 + (Uint32)taken);
}

static void interrupts(void)
{
    IER = 0x0105;
    IER |= M_INT2;
    IER &= ~M_INT1;
    tell(IER); // 0106
    IFR = 0x0000;
    tell(IFR);
    every(1000, &count_isr);
    DSP28x_usDelay(400); // 2009 cycles, INTM is set
    tell(taken);         // 0
    tell(IFR & M_INT1);  // 1
    IFR &= ~M_INT1;
    EINT;
    tell(taken); // 0: the PIE has not let another through
    PieCtrlRegs.PIEACK.all = 0x0001;
    DSP28x_usDelay(400);
    DINT;
    tell(taken > 0);
}

static void protected_table(void)
{
    every(1000, &count_isr);
    PieVectTable.TINT0 = &flag_isr; // no EALLOW: lost
    EINT;
    DSP28x_usDelay(400);
    DINT;
    tell(flag);
    tell(taken > 0);
}

static interrupt void slow_isr(void)
{
    taken += 100;
    IER |= M_INT1;
    PieCtrlRegs.PIEACK.all = 0xFFFF;
    EINT;
    DSP28x_usDelay(1000);
    tell(taken); // the timer came in between
    DINT;
}

static void nested(void)
{
    every(2000, &count_isr);
    EALLOW;
    PieVectTable.TXAINT = &slow_isr;
    SysCtrlRegs.PCLKCR.bit.SCIAENCLK = 1;
    EDIS;
    asm(" RPT #9 || NOP");
    SciaRegs.SCIFFTX.all = 0xE020;
    SciaRegs.SCICTL1.all = 0x0022;
    PieCtrlRegs.PIEIER9.bit.INTx2 = 1;
    IER |= M_INT9;
    EINT;
    DSP28x_usDelay(100);
    DINT;
    tell(taken);
}

static Uint16 ready(void)
{
    return SciaRegs.SCICTL2.bit.TXEMPTY;
}

static void waits(void)
{
    Uint16 i, n;

    EALLOW;
    SysCtrlRegs.PCLKCR.all = 0x0C00;
    EDIS;
    asm(" RPT #9 || NOP");
    SciaRegs.SCICCR.all = 0x17; // looped back
    SciaRegs.SCILBAUD = 100;
    SciaRegs.SCICTL1.all = 0x23;
    for (i = 0; i < 3; i++) // an empty loop with its body nowhere
    {
        SciaRegs.SCITXBUF = 0x40 + i;
        while (!SciaRegs.SCICTL2.bit.TXRDY)
            ;
        while (!ready())
        {
        }
        do
        {
        } while (SciaRegs.SCIRXST.bit.RXRDY == 0);
        tell(SciaRegs.SCIRXBUF.all);
    }
    every(50000, &flag_isr);
    EINT;
    for (i = 0; i < 3; i++)
    {
        flag = 0;
        for (;;) // with a loop in the loop
        {
            for (n = 0; n < 3; n++)
            {
                if (flag)
                    break;
            }
            if (flag)
                break;
        }
        tell(i);
    }
    DINT;
}

static void not_waits(void)
{
    volatile Uint16* watch = &flag;
    Uint32 i;
    Uint16 n, sum;

    every(100000, &flag_isr);
    EINT;
    for (i = 0; i < 2000 && !flag; i++) // a time-out in a register
        ;
    tell((Uint16)i); // 2000
    i = 0;
    while (!*watch)
    {
        i++; // a count
    }
    tell((Uint16)i);
    flag = 0;
    srand(1);
    while (!flag && rand() % 1000 != 7) // a function that is not instrumented has a state
        ;
    tell((Uint16)rand());
    flag = 0;
    n = 0;
    while (!flag)
    {
        memset(block, n++, sizeof block); // stores by one
    }
    tell(n);
    flag = 0;
    while (!flag)
    {
        if (plain) // a variable, whose value no register keeps
        {
            plain = 0;
            asm(" NOP");
        }
        else
        {
            plain = 1;
            asm(" RPT #1 || NOP");
        }
    }
    tell(plain);
    DINT;
    while (CpuTimer0Regs.TIM.all > 5000) // a counter
        ;
    tell((Uint16)CpuTimer0Regs.TIM.all);
    SciaRegs.SCIFFRX.all = 0x2000;
    sum = 0;
    for (n = 0; n < 100; n++)
    {
        sum += SciaRegs.SCIRXBUF.all; // has an effect
    }
    tell(sum);
    while (CpuTimer0Regs.TCR.bit.TIF == 0) // a flag of a timer
        ;
    tell((Uint16)(CpuTimer0Regs.TIM.all >> 4));
}

static void cost(void)
{
    Uint16 i;

    tell(0);
    asm(" NOP");
    tell(1);
    DSP28x_usDelay(100);
    tell(2);
    for (i = 0; i < 10; i++)
        ;
    tell(3);
    asm(" RPT #99 || NOP");
    tell(4);
    (void)rand();
    tell(5);
    plain = 1;
    tell(6);
}

static interrupt void tell_isr(void)
{
    tell(1);
    PieCtrlRegs.PIEACK.all = PIEACK_GROUP1;
}

static void interrupt_cost(void)
{
    every(5000, &tell_isr);
    EINT;
    DSP28x_usDelay(1500);
}

void main(void)
{
    Uint16 which = CpuTimer1Regs.PRD.half.MSW;

    if (which != CASE_DOG && which != RESET_VALUE)
        DisableDog();
    begun++;
    switch (which)
    {
    case CASE_RETURN:
        return;
    case CASE_FIELDS:
        InitPeripheralClocks();
        DSP28x_usDelay(10);
        fields();
        break;
    case CASE_ATOMIC:
        atomic();
        break;
    case CASE_IER:
        interrupts();
        break;
    case CASE_EALLOW:
        protected_table();
        break;
    case CASE_NESTED:
        nested();
        break;
    case CASE_WAITS:
        waits();
        break;
    case CASE_NO_FUNCTION:
        every(1000, &count_isr);
        EALLOW;
        PieVectTable.TINT0 = 0;
        EDIS;
        EINT;
        for (;;)
            ;
    case CASE_ASM:
        asm(" MOV AL, #1");
        asm(" SETC OBJMODE");
        asm("\tclrc INTM, DBGM ; both");
        tell(7);
        break;
    case CASE_FOREVER:
        every(30000, &count_isr);
        EINT;
        for (;;)
            ;
    case CASE_IDLE:
        every(30000, &count_isr);
        EINT;
        asm(" IDLE");
        tell(taken);
        break;
    case CASE_NOT_WAITS:
        EALLOW;
        SysCtrlRegs.PCLKCR.all = 0x0C00;
        EDIS;
        not_waits();
        break;
    case CASE_COST:
        cost();
        break;
    case CASE_INTERRUPT_COST:
        interrupt_cost();
        break;
    default: // after the watchdog, or about to meet it
        tell(begun);
        tell((SysCtrlRegs.WDCR & 0x80) != 0);
        for (;;)
            ;
    }
    ESTOP0;
}
