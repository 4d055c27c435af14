/// SCI-A looped back inside at 19200 Bd, octets back to back; POLLING 0: by FIFO interrupts and an empty main loop, 1: by polling SCIRXST.
/// Stops at ESTOP0 when an octet is wrong.
/// SPDX-License-Identifier: MIT
#include "DSP281x_Device.h"
#include "DSP281x_Examples.h"

#define BRR_19200 0xF3

static Uint16 next;

static void check(Uint16 octet)
{
    if (octet != next)
    {
        ESTOP0;
    }
    next = (next + 1) & 0xFF;
}

static interrupt void rx_isr(void)
{
    while (SciaRegs.SCIFFRX.bit.RXFIFST != 0)
    {
        check(SciaRegs.SCIRXBUF.all);
        SciaRegs.SCITXBUF = (next + 3) & 0xFF;
    }
    SciaRegs.SCIFFRX.bit.RXFFINTCLR = 1;
    PieCtrlRegs.PIEACK.all = PIEACK_GROUP9;
}

void main(void)
{
    InitSysCtrl();
    DINT;
    InitPieCtrl();
    InitPieVectTable();
    EALLOW;
    PieVectTable.RXAINT = &rx_isr;
    EDIS;
    SciaRegs.SCICCR.all = 0x0017;
    SciaRegs.SCILBAUD = BRR_19200;
    SciaRegs.SCICTL1.all = 0x0023;
#if POLLING
    SciaRegs.SCITXBUF = 0;
    for (;;)
    {
        while (SciaRegs.SCICTL2.bit.TXRDY == 0)
            ;
        SciaRegs.SCITXBUF = (next + 1) & 0xFF;
        while (SciaRegs.SCIRXST.bit.RXRDY == 0)
            ;
        check(SciaRegs.SCIRXBUF.all);
    }
#else
    SciaRegs.SCIFFTX.all = 0xE000;
    SciaRegs.SCIFFRX.all = 0x2021;
    PieCtrlRegs.PIEIER9.bit.INTx1 = 1;
    IER |= M_INT9;
    SciaRegs.SCITXBUF = 0;
    SciaRegs.SCITXBUF = 1;
    SciaRegs.SCITXBUF = 2;
    SciaRegs.SCITXBUF = 3;
    EINT;
    for (;;)
        ;
#endif
}
