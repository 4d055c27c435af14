/// \file   sci_pc.c
/// \brief  SCI-B: octets to and from the PC at 19200 Bd 8N1, polled, FIFOs of 16 both ways.
/// SPDX-License-Identifier: MIT
#include "thesis.h"

#define FIFO_DEPTH 16

void PcInit(void)
{
    ScibRegs.SCICTL1.all = 0x0000;
    ScibRegs.SCICCR.all = 0x0007;
    ScibRegs.SCIHBAUD = BRR_19200 >> 8;
    ScibRegs.SCILBAUD = BRR_19200 & 0x00FF;
    ScibRegs.SCICTL2.all = 0x0000;
    ScibRegs.SCIFFTX.all = 0xC000;
    ScibRegs.SCIFFRX.all = 0x0000;
    ScibRegs.SCIFFCT.all = 0x0000;
    ScibRegs.SCICTL1.all = 0x0023; // TXENA, RXENA, SWRESET
    ScibRegs.SCIFFTX.bit.TXFIFOXRESET = 1;
    ScibRegs.SCIFFRX.bit.RXFIFORESET = 1;
}

int PcRead(void)
{
    if (ScibRegs.SCIRXST.bit.RXERROR) // what was damaged, the handshake sends again
    {
        ScibRegs.SCICTL1.bit.SWRESET = 0;
        ScibRegs.SCICTL1.bit.SWRESET = 1;
    }
    if (ScibRegs.SCIFFRX.bit.RXFIFST == 0)
    {
        return -1;
    }
    return (int)(ScibRegs.SCIRXBUF.all & 0x00FF);
}

Uint16 PcRoom(void)
{
    return ScibRegs.SCIFFTX.bit.TXFFST < FIFO_DEPTH;
}

void PcWrite(Uint16 Octet)
{
    ScibRegs.SCITXBUF = Octet;
}
