/// \file   DSP281x_XIntrupt.h
/// \brief  External interrupts: XIntruptRegs at 7070h.
/// SPDX-License-Identifier: MIT
#ifndef DSP281x_XINTRUPT_H
#define DSP281x_XINTRUPT_H

// clang-format off
DSP281x_REG(XINTCR, ENABLE:1, rsvd1:1, POLARITY:1, rsvd2:13);
DSP281x_REG(XNMICR, ENABLE:1, SELECT:1, POLARITY:1, rsvd2:13);
// clang-format on

struct XINTRUPT_REGS
{
    union XINTCR_REG XINT1CR;
    union XINTCR_REG XINT2CR;
    Uint16 rsvd1[5];
    union XNMICR_REG XNMICR;
    Uint16 XINT1CTR;
    Uint16 XINT2CTR;
    Uint16 rsvd2[5];
    Uint16 XNMICTR;
};

extern volatile struct XINTRUPT_REGS XIntruptRegs;

#endif // DSP281x_XINTRUPT_H
