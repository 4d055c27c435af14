/// \file   DSP281x_Xintf.h
/// \brief  External interface: XintfRegs at 0B20h. Firmware compiles; the device has no external bus.
/// SPDX-License-Identifier: MIT
#ifndef DSP281x_XINTF_H
#define DSP281x_XINTF_H

// clang-format off
DSP281x_REG32(XTIMING, XWRTRAIL:2, XWRACTIVE:3, XWRLEAD:2, XRDTRAIL:2, XRDACTIVE:3, XRDLEAD:2, USEREADY:1, READYMODE:1,
              XSIZE:2, rsvd1:4, X2TIMING:1, rsvd3:9);
DSP281x_REG32(XINTCNF2, WRBUFF:2, CLKMODE:1, CLKOFF:1, rsvd1:2, WLEVEL:2, MPNMC:1, HOLD:1, HOLDS:1, HOLDAS:1, rsvd2:4,
              XTIMCLK:3, rsvd3:13);
DSP281x_REG(XBANK, BANK:3, BCYC:3, rsvd1:10);
// clang-format on

struct XINTF_REGS
{
    union XTIMING_REG XTIMING0;
    union XTIMING_REG XTIMING1;
    union XTIMING_REG XTIMING2;
    Uint32 rsvd1[3];
    union XTIMING_REG XTIMING6;
    union XTIMING_REG XTIMING7;
    Uint32 rsvd2[2];
    union XINTCNF2_REG XINTCNF2;
    Uint32 rsvd3;
    union XBANK_REG XBANK;
    Uint16 rsvd4;
    Uint16 XREVISION;
    Uint16 rsvd5[5];
};

extern volatile struct XINTF_REGS XintfRegs;

#endif // DSP281x_XINTF_H
