/* Waits for four characters in the FIFO of SCI-A and reads them at once, then for ever. SPDX-License-Identifier: MIT */
#include "DSP281x_Device.h"

#define LEVEL 4

void main(void)
{
    Uint16 sum = 0;
    EALLOW;
    SysCtrlRegs.WDCR = 0x0068;
    SysCtrlRegs.PCLKCR.bit.SCIAENCLK = 1;
    GpioMuxRegs.GPFMUX.all |= 0x0030;
    EDIS;
    SciaRegs.SCICCR.all = 0x0007;
    SciaRegs.SCICTL1.all = 0x0003;
    SciaRegs.SCIHBAUD = 0;
    SciaRegs.SCILBAUD = 48; /* 30 MHz / 2 / 4 / 8 / 49 = 9566 Bd */
    SciaRegs.SCIFFTX.all = 0xE040;
    SciaRegs.SCIFFRX.all = 0x6044;
    SciaRegs.SCICTL1.all = 0x0023;
    for (;;)
    {
        while (SciaRegs.SCIFFRX.bit.RXFIFST < LEVEL)
        {
        }
        sum += SciaRegs.SCIRXBUF.bit.RXDT;
        sum += SciaRegs.SCIRXBUF.bit.RXDT;
        sum += SciaRegs.SCIRXBUF.bit.RXDT;
        sum += SciaRegs.SCIRXBUF.bit.RXDT;
        SciaRegs.SCITXBUF = sum & 0xFF;
    }
}
