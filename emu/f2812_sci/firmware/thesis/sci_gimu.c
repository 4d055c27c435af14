/// \file   sci_gimu.c
/// \brief  SCI-A: octets of the GIMU at 19200 Bd 8N1 through the receive FIFO and its interrupt into a ring.
///
/// The FIFO interrupts at one octet: the last of a packet would else wait for the next packet, 167 ms later.
/// Source: the thesis, section 4.4.
/// SPDX-License-Identifier: MIT
#include "thesis.h"

#define RING 64 // a power of two; the longest packet has 23

static volatile Uint16 Ring[RING];
static volatile Uint16 Head; // of the interrupt
static volatile Uint16 Tail; // of the main loop
static volatile Uint16 Errors;
static volatile Uint32 LastMs;
static Uint16 ErrorsSeen;

interrupt void GimuReceived(void)
{
    if (SciaRegs.SCIRXST.bit.RXERROR)
    {
        Errors++; // framing, parity, overrun or break stays until the port is reset
        SciaRegs.SCICTL1.bit.SWRESET = 0;
        SciaRegs.SCICTL1.bit.SWRESET = 1;
    }
    if (SciaRegs.SCIFFRX.bit.RXFFOVF)
    {
        Errors++;
        SciaRegs.SCIFFRX.bit.RXFFOVRCLR = 1;
    }
    while (SciaRegs.SCIFFRX.bit.RXFIFST > 0)
    {
        const Uint16 Octet = SciaRegs.SCIRXBUF.all & 0x00FF;
        const Uint16 Next = (Head + 1) & (RING - 1);
        if (Next == Tail)
        {
            Errors++;
            continue;
        }
        Ring[Head] = Octet;
        Head = Next;
    }
    LastMs = Milliseconds();
    SciaRegs.SCIFFRX.bit.RXFFINTCLR = 1;
    PieCtrlRegs.PIEACK.all = PIEACK_GROUP9;
}

void GimuInit(void)
{
    SciaRegs.SCICTL1.all = 0x0000;
    SciaRegs.SCICCR.all = 0x0007; // one stop bit, no parity, 8 bits, idle line
    SciaRegs.SCIHBAUD = BRR_19200 >> 8;
    SciaRegs.SCILBAUD = BRR_19200 & 0x00FF;
    SciaRegs.SCICTL2.all = 0x0000;
    SciaRegs.SCIFFTX.all = 0xC000; // FIFOs on; nothing is sent
    SciaRegs.SCIFFRX.all = 0x0021; // interrupt at one octet; held in reset
    SciaRegs.SCIFFCT.all = 0x0000;
    SciaRegs.SCICTL1.all = 0x0021; // RXENA, SWRESET
    SciaRegs.SCIFFRX.bit.RXFIFORESET = 1;

    EALLOW;
    PieVectTable.RXAINT = &GimuReceived;
    EDIS;
    PieCtrlRegs.PIEIER9.bit.INTx1 = 1;
    IER |= M_INT9;
}

int GimuRead(void)
{
    if (Tail == Head)
    {
        return -1;
    }
    const int Octet = (int)Ring[Tail];
    Tail = (Tail + 1) & (RING - 1);
    return Octet;
}

Uint16 GimuErrors(void)
{
    const Uint16 Now = Errors;
    const Uint16 More = Now != ErrorsSeen;
    ErrorsSeen = Now;
    return More;
}

Uint32 GimuSilence(void)
{
    Uint32 Last;
    do // 32 bits are two accesses on this CPU, and the interrupt writes them
    {
        Last = LastMs;
    } while (Last != LastMs);
    return Milliseconds() - Last;
}
