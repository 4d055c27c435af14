/// Echo on SCI-A at 9600-8-N-1 without FIFO: receives by interrupt, sends back each character from the main loop, and greets at the start.
/// Overrun or framing errors set GPIOF14 (XF) and the receiver anew.
/// SPDX-License-Identifier: MIT
#include "DSP281x_Device.h"
#include "DSP281x_Examples.h"

#define RING     64
#define BRR_9600 487 // 37.5 MHz / (8 x 488) = 9605 Bd

static volatile Uint16 ring[RING];
static volatile Uint16 head;
static volatile Uint16 tail;

interrupt void scia_rx_isr(void)
{
    if (SciaRegs.SCIRXST.bit.RXERROR)
    {
        GpioDataRegs.GPFSET.bit.GPIOF14 = 1;
        SciaRegs.SCICTL1.bit.SWRESET = 0;
        SciaRegs.SCICTL1.bit.SWRESET = 1;
    }
    else
    {
        ring[head] = SciaRegs.SCIRXBUF.bit.RXDT;
        head = (head + 1) % RING;
    }
    PieCtrlRegs.PIEACK.all = PIEACK_GROUP9;
}

static void scia_xmit(Uint16 a)
{
    while (SciaRegs.SCICTL2.bit.TXRDY == 0)
    {
    }
    SciaRegs.SCITXBUF = a & 0xFF;
}

static void scia_msg(const char* msg)
{
    while (*msg != '\0')
    {
        scia_xmit(*msg++);
    }
}

static void scia_init(void)
{
    SciaRegs.SCICCR.all = 0x0007;
    SciaRegs.SCICTL1.all = 0x0003;
    SciaRegs.SCICTL2.bit.RXBKINTENA = 1;
    SciaRegs.SCIHBAUD = BRR_9600 >> 8;
    SciaRegs.SCILBAUD = BRR_9600 & 0xFF;
    SciaRegs.SCICTL1.all = 0x0023;
}

void main(void)
{
    InitSysCtrl();
    DINT;
    InitPieCtrl();
    IER = 0x0000;
    IFR = 0x0000;
    InitPieVectTable();
    InitGpio();
    EALLOW;
    GpioMuxRegs.GPFDIR.bit.GPIOF14 = 1;
    PieVectTable.RXAINT = &scia_rx_isr;
    EDIS;
    scia_init();
    PieCtrlRegs.PIEIER9.bit.INTx1 = 1;
    IER |= M_INT9;
    EINT;
    ERTM;

    scia_msg("echo ready\r\n");
    while (1)
    {
        if (tail != head)
        {
            scia_xmit(ring[tail]);
            tail = (tail + 1) % RING;
        }
    }
}
