/// InitSysCtrl() and its parts: watchdog, PLL, clocks (TI SPRU078).
/// SPDX-License-Identifier: MIT
#include "DSP281x_Device.h"
#include "DSP281x_Examples.h"

void InitSysCtrl(void)
{
    DisableDog();
    InitPll(0xA); // 30 MHz x 10 / 2
    InitPeripheralClocks();
}

void DisableDog(void)
{
    EALLOW;
    SysCtrlRegs.WDCR = 0x0068;
    EDIS;
}

void KickDog(void)
{
    EALLOW;
    SysCtrlRegs.WDKEY = 0x0055;
    SysCtrlRegs.WDKEY = 0x00AA;
    EDIS;
}

void ServiceDog(void)
{
    KickDog();
}

/// The clock is OSCCLK/2 while the PLL locks, for 131072 OSCCLK: that is waited for.
void InitPll(Uint16 val)
{
    if (SysCtrlRegs.PLLCR.bit.DIV != val)
    {
        EALLOW;
        SysCtrlRegs.PLLCR.bit.DIV = val;
        EDIS;
        DisableDog();
        DSP28x_usDelay(131072 / 2 / 5);
    }
}

void InitPeripheralClocks(void)
{
    EALLOW;
    SysCtrlRegs.HISPCP.all = 0x0001; // SYSCLKOUT / 2
    SysCtrlRegs.LOSPCP.all = 0x0002; // SYSCLKOUT / 4
    SysCtrlRegs.PCLKCR.bit.EVAENCLK = 1;
    SysCtrlRegs.PCLKCR.bit.EVBENCLK = 1;
    SysCtrlRegs.PCLKCR.bit.SCIAENCLK = 1;
    SysCtrlRegs.PCLKCR.bit.SCIBENCLK = 1;
    SysCtrlRegs.PCLKCR.bit.MCBSPENCLK = 1;
    SysCtrlRegs.PCLKCR.bit.SPIENCLK = 1;
    SysCtrlRegs.PCLKCR.bit.ECANENCLK = 1;
    SysCtrlRegs.PCLKCR.bit.ADCENCLK = 1;
    EDIS;
}

/// Wait states of the flash at 150 MHz. The program runs from the host's memory whatever they say.
void InitFlash(void)
{
    EALLOW;
    FlashRegs.FOPT.bit.ENPIPE = 1;
    FlashRegs.FBANKWAIT.bit.RANDWAIT = 5;
    FlashRegs.FBANKWAIT.bit.PAGEWAIT = 5;
    FlashRegs.FOTPWAIT.bit.OTPWAIT = 8;
    FlashRegs.FSTDBYWAIT.bit.STDBYWAIT = 0x01FF;
    FlashRegs.FACTIVEWAIT.bit.ACTIVEWAIT = 0x01FF;
    EDIS;
    asm(" RPT #7 || NOP");
}

void MemCopy(Uint16* SourceAddr, Uint16* SourceEndAddr, Uint16* DestAddr)
{
    while (SourceAddr < SourceEndAddr)
    {
        *DestAddr++ = *SourceAddr++;
    }
}
