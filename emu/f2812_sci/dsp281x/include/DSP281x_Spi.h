/// \file   DSP281x_Spi.h
/// \brief  Serial peripheral interface: SpiaRegs at 7040h. Firmware compiles; the device does not model it.
/// SPDX-License-Identifier: MIT
#ifndef DSP281x_SPI_H
#define DSP281x_SPI_H

// clang-format off
DSP281x_REG(SPICCR, SPICHAR:4, SPILBK:1, rsvd1:1, CLKPOLARITY:1, SPISWRESET:1, rsvd2:8);
DSP281x_REG(SPICTL, SPIINTENA:1, TALK:1, MASTER_SLAVE:1, CLK_PHASE:1, OVERRUNINTENA:1, rsvd1:11);
DSP281x_REG(SPISTS, rsvd1:5, BUFFULL_FLAG:1, INT_FLAG:1, OVERRUN_FLAG:1, rsvd2:8);
DSP281x_REG(SPIFFTX, TXFFIL:5, TXFFIENA:1, TXINTCLR:1, TXFFINT:1, TXFFST:5, TXFIFO:1, SPIFFENA:1, SPIRST:1);
DSP281x_REG(SPIFFRX, RXFFIL:5, RXFFIENA:1, RXFFINTCLR:1, RXFFINT:1, RXFFST:5, RXFIFORESET:1, RXFFOVFCLR:1, RXFFOVF:1);
DSP281x_REG(SPIFFCT, TXDLY:8, rsvd1:8);
DSP281x_REG(SPIPRI, rsvd1:4, FREE:1, SOFT:1, PRIORITY:1, rsvd2:9);
// clang-format on

struct SPI_REGS
{
    union SPICCR_REG SPICCR;
    union SPICTL_REG SPICTL;
    union SPISTS_REG SPISTS;
    Uint16 rsvd1;
    Uint16 SPIBRR;
    Uint16 rsvd2;
    Uint16 SPIRXEMU;
    Uint16 SPIRXBUF;
    Uint16 SPITXBUF;
    Uint16 SPIDAT;
    union SPIFFTX_REG SPIFFTX;
    union SPIFFRX_REG SPIFFRX;
    union SPIFFCT_REG SPIFFCT;
    Uint16 rsvd3[2];
    union SPIPRI_REG SPIPRI;
};

extern volatile struct SPI_REGS SpiaRegs;

#endif // DSP281x_SPI_H
