/// Autobaud on SCI-A: the host sends 'A' or 'a' at a baud of its own; the hardware sets SCIHBAUD and SCILBAUD from it, the program greets at that
/// baud and echoes. A character 1Bh (ESC) starts the search again.
/// SPDX-License-Identifier: MIT
#include "DSP281x_Device.h"
#include "DSP281x_Examples.h"

#define ESCAPE 0x1B

static void autobaud_lock(void)
{
    Uint16 character;

    SciaRegs.SCICTL1.all = 0x0003;
    SciaRegs.SCIHBAUD = 0x0000;
    SciaRegs.SCILBAUD = 0x0001; // anything >= 1 starts it
    SciaRegs.SCICTL1.all = 0x0023;
    SciaRegs.SCIFFCT.bit.CDC = 1;
    SciaRegs.SCIFFCT.bit.ABDCLR = 1;

    while (SciaRegs.SCIFFCT.bit.ABD != 1)
    {
        if (SciaRegs.SCIRXST.bit.RXERROR) // what came before was no 'A'
        {
            SciaRegs.SCICTL1.bit.SWRESET = 0;
            SciaRegs.SCICTL1.bit.SWRESET = 1;
        }
    }
    SciaRegs.SCIFFCT.bit.ABDCLR = 1;
    SciaRegs.SCIFFCT.bit.CDC = 0;

    while (SciaRegs.SCIRXST.bit.RXRDY != 1)
    {
    }
    character = SciaRegs.SCIRXBUF.bit.RXDT; // the 'A' itself
    while (SciaRegs.SCICTL2.bit.TXRDY == 0)
    {
    }
    SciaRegs.SCITXBUF = character;
}

void main(void)
{
    Uint16 character;

    InitSysCtrl();
    InitGpio();
    DINT;
    SciaRegs.SCICCR.all = 0x0007;
    SciaRegs.SCICTL2.all = 0x0000;
    SciaRegs.SCIFFTX.all = 0x8000; // FIFO off, channel out of reset

    autobaud_lock();
    for (;;)
    {
        while (SciaRegs.SCIRXST.bit.RXRDY != 1)
            ;
        character = SciaRegs.SCIRXBUF.bit.RXDT;
        if (character == ESCAPE)
        {
            while (SciaRegs.SCICTL2.bit.TXEMPTY == 0)
                ;
            autobaud_lock();
            continue;
        }
        while (SciaRegs.SCICTL2.bit.TXRDY == 0)
            ;
        SciaRegs.SCITXBUF = character;
    }
}
