/// Both SCIs looped back inside the device, FIFO interrupts at level 8: sends a counting pattern and checks every octet.
/// Ends by returning from main() when each port has had OCTETS of them; stops at ESTOP0 at the first that is wrong.
/// Hardware: LSPCLK 37.5 MHz; nothing is connected.
/// SPDX-License-Identifier: MIT
#include "DSP281x_Device.h"
#include "DSP281x_Examples.h"

#define OCTETS     4096UL
#define FIFO_LEVEL 8
#define BRR_115200 39 // 37.5 MHz / (8 x 40) = 117188 Bd

interrupt void sciaTxFifoIsr(void);
interrupt void sciaRxFifoIsr(void);
interrupt void scibTxFifoIsr(void);
interrupt void scibRxFifoIsr(void);
void scia_fifo_init(void);
void scib_fifo_init(void);
void error(void);

Uint16 sdataA; // next to send
Uint16 sdataB;
Uint16 rdata_pointA; // next expected
Uint16 rdata_pointB;
Uint32 receivedA;
Uint32 receivedB;

void main(void)
{
    InitSysCtrl();

    EALLOW;
    GpioMuxRegs.GPFMUX.all = 0x0030;
    GpioMuxRegs.GPGMUX.all = 0x0030;
    EDIS;

    DINT;
    InitPieCtrl();
    IER = 0x0000;
    IFR = 0x0000;
    InitPieVectTable();

    EALLOW;
    PieVectTable.RXAINT = &sciaRxFifoIsr;
    PieVectTable.TXAINT = &sciaTxFifoIsr;
    PieVectTable.RXBINT = &scibRxFifoIsr;
    PieVectTable.TXBINT = &scibTxFifoIsr;
    EDIS;

    scia_fifo_init();
    scib_fifo_init();

    PieCtrlRegs.PIECRTL.bit.ENPIE = 1;
    PieCtrlRegs.PIEIER9.bit.INTx1 = 1; // RXAINT
    PieCtrlRegs.PIEIER9.bit.INTx2 = 1; // TXAINT
    PieCtrlRegs.PIEIER9.bit.INTx3 = 1; // RXBINT
    PieCtrlRegs.PIEIER9.bit.INTx4 = 1; // TXBINT
    IER = 0x100;
    EINT;

    for (;;)
    {
        DINT;
        if (receivedA >= OCTETS && receivedB >= OCTETS)
        {
            return;
        }
        EINT;
    }
}

void error(void)
{
    asm("     ESTOP0");
    for (;;)
        ;
}

interrupt void sciaTxFifoIsr(void)
{
    Uint16 i;

    for (i = 0; i < FIFO_LEVEL; i++)
    {
        SciaRegs.SCITXBUF = sdataA;
        sdataA = (sdataA + 1) & 0x00FF;
    }
    SciaRegs.SCIFFTX.bit.TXINTCLR = 1;
    PieCtrlRegs.PIEACK.all |= 0x100;
}

interrupt void sciaRxFifoIsr(void)
{
    Uint16 i;

    for (i = 0; i < FIFO_LEVEL; i++)
    {
        if (SciaRegs.SCIRXBUF.all != rdata_pointA)
        {
            error();
        }
        rdata_pointA = (rdata_pointA + 1) & 0x00FF;
    }
    receivedA += FIFO_LEVEL;
    SciaRegs.SCIFFRX.bit.RXFFOVRCLR = 1;
    SciaRegs.SCIFFRX.bit.RXFFINTCLR = 1;
    PieCtrlRegs.PIEACK.all |= 0x100;
}

interrupt void scibTxFifoIsr(void)
{
    Uint16 i;

    for (i = 0; i < FIFO_LEVEL; i++)
    {
        ScibRegs.SCITXBUF = sdataB;
        sdataB = (sdataB + 3) & 0x00FF;
    }
    ScibRegs.SCIFFTX.bit.TXINTCLR = 1;
    PieCtrlRegs.PIEACK.all |= 0x100;
}

interrupt void scibRxFifoIsr(void)
{
    Uint16 i;

    for (i = 0; i < FIFO_LEVEL; i++)
    {
        if (ScibRegs.SCIRXBUF.all != rdata_pointB)
        {
            error();
        }
        rdata_pointB = (rdata_pointB + 3) & 0x00FF;
    }
    receivedB += FIFO_LEVEL;
    ScibRegs.SCIFFRX.bit.RXFFOVRCLR = 1;
    ScibRegs.SCIFFRX.bit.RXFFINTCLR = 1;
    PieCtrlRegs.PIEACK.all |= 0x100;
}

void scia_fifo_init(void)
{
    SciaRegs.SCICCR.all = 0x0007;  // 1 stop bit, no parity, 8 bits
    SciaRegs.SCICTL1.all = 0x0003; // TXENA, RXENA
    SciaRegs.SCICTL2.bit.TXINTENA = 1;
    SciaRegs.SCICTL2.bit.RXBKINTENA = 1;
    SciaRegs.SCIHBAUD = 0x0000;
    SciaRegs.SCILBAUD = BRR_115200;
    SciaRegs.SCICCR.bit.LOOPBKENA = 1;
    SciaRegs.SCIFFTX.all = 0xC020 | FIFO_LEVEL;
    SciaRegs.SCIFFRX.all = 0x0020 | FIFO_LEVEL;
    SciaRegs.SCIFFCT.all = 0x00;
    SciaRegs.SCICTL1.all = 0x0023; // out of reset
    SciaRegs.SCIFFTX.bit.TXFIFOXRESET = 1;
    SciaRegs.SCIFFRX.bit.RXFIFORESET = 1;
}

void scib_fifo_init(void)
{
    ScibRegs.SCICCR.all = 0x0007;
    ScibRegs.SCICTL1.all = 0x0003;
    ScibRegs.SCICTL2.bit.TXINTENA = 1;
    ScibRegs.SCICTL2.bit.RXBKINTENA = 1;
    ScibRegs.SCIHBAUD = 0x0000;
    ScibRegs.SCILBAUD = BRR_115200;
    ScibRegs.SCICCR.bit.LOOPBKENA = 1;
    ScibRegs.SCIFFTX.all = 0xC020 | FIFO_LEVEL;
    ScibRegs.SCIFFRX.all = 0x0020 | FIFO_LEVEL;
    ScibRegs.SCIFFCT.all = 0x00;
    ScibRegs.SCICTL1.all = 0x0023;
    ScibRegs.SCIFFTX.bit.TXFIFOXRESET = 1;
    ScibRegs.SCIFFRX.bit.RXFIFORESET = 1;
}
