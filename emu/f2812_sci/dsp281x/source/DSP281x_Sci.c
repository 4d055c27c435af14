/// InitSci(): both ports at 9600 Bd, 8 data bits, no parity, one stop bit, FIFOs on, no interrupts; LSPCLK is 37.5 MHz.
/// SPDX-License-Identifier: MIT
#include "DSP281x_Device.h"
#include "DSP281x_Examples.h"

#define BRR_9600 487 // 37.5 MHz / (8 x 488) = 9605 Bd

static void Prepare(volatile struct SCI_REGS* Sci)
{
    Sci->SCICTL1.all = 0; // held in reset while it is set
    Sci->SCICCR.all = 0x0007;
    Sci->SCIHBAUD = BRR_9600 >> 8;
    Sci->SCILBAUD = BRR_9600 & 0xFF;
    Sci->SCICTL2.all = 0;
    Sci->SCIFFTX.all = 0xE040;
    Sci->SCIFFRX.all = 0x204F;
    Sci->SCIFFCT.all = 0;
    Sci->SCICTL1.all = 0x0023; // TXENA, RXENA, SWRESET
}

void InitScia(void)
{
    Prepare(&SciaRegs);
}

void InitScib(void)
{
    Prepare(&ScibRegs);
}

void InitSci(void)
{
    InitScia();
    InitScib();
}

void InitPeripherals(void)
{
    InitCpuTimers();
    InitSci();
}
