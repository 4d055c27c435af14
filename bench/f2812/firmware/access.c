/// N rounds of a hundred accesses of one register in a row, by KIND; for the last two kinds the transmit FIFO is emptied after every ten.
/// The transmitter is busy all the while with a character at the lowest rate, so that no write moves a line or an event.
/// SPDX-License-Identifier: MIT
#include "DSP281x_Device.h"
#include "DSP281x_Examples.h"

#define NONE        0
#define READ        1
#define WRITE       2
#define FIELD       3
#define CTL1        4
#define FFTX_CLEAR  5
#define FFRX_CLEAR  6
#define ACKNOWLEDGE 7
#define PORT        8
#define TXBUF       9
#define EMPTY_ONLY  10

#if KIND == READ
#define ONE (void)SciaRegs.SCIRXST.all;
#elif KIND == WRITE
#define ONE SciaRegs.SCILBAUD = 0xFF;
#elif KIND == FIELD
#define ONE SciaRegs.SCICTL2.bit.TXINTENA = 1;
#elif KIND == CTL1
#define ONE SciaRegs.SCICTL1.all = 0x22;
#elif KIND == FFTX_CLEAR
#define ONE SciaRegs.SCIFFTX.all = 0xE040;
#elif KIND == FFRX_CLEAR
#define ONE SciaRegs.SCIFFRX.all = 0x204F;
#elif KIND == ACKNOWLEDGE
#define ONE PieCtrlRegs.PIEACK.all = PIEACK_GROUP9;
#elif KIND == PORT
#define ONE GpioDataRegs.GPADAT.all = 0x1234;
#elif KIND == TXBUF
#define ONE SciaRegs.SCITXBUF = 0x55;
#else
#define ONE
#endif
#if KIND == TXBUF || KIND == EMPTY_ONLY
#define EMPTY                                                                                                          \
    SciaRegs.SCIFFTX.all = 0xC000;                                                                                     \
    SciaRegs.SCIFFTX.all = 0xE000;
#else
#define EMPTY
#endif
#define TEN ONE ONE ONE ONE ONE ONE ONE ONE ONE ONE EMPTY

static void round_of_accesses(void)
{
    TEN TEN TEN TEN TEN TEN TEN TEN TEN TEN
}

void main(void)
{
    Uint32 i;

    DisableDog();
    InitPeripheralClocks();
    SciaRegs.SCIHBAUD = 0xFF;
    SciaRegs.SCILBAUD = 0xFF;
    SciaRegs.SCICTL1.all = 0x22; // SWRESET, TXENA
    SciaRegs.SCIFFTX.all = 0xE000;
    SciaRegs.SCITXBUF = 0;
    for (i = 0; i < N; i++)
    {
        round_of_accesses();
    }
}
