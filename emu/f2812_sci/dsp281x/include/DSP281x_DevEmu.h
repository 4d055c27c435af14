/// \file   DSP281x_DevEmu.h
/// \brief  Device emulation: DevEmuRegs at 0880h. The RAM-DFT members are written by programs for silicon before revision C.
/// SPDX-License-Identifier: MIT
#ifndef DSP281x_DEV_EMU_H
#define DSP281x_DEV_EMU_H

// clang-format off
DSP281x_REG32(DEVICECNF, rsvd1:3, VMAPS:1, rsvd2:1, XRSn:1, rsvd3:10, rsvd4:3, ENPROT:1, rsvd5:12);
DSP281x_REG32(DEVICEID, PARTID:16, REVID:16);
// clang-format on

struct DEV_EMU_REGS
{
    union DEVICECNF_REG DEVICECNF; // 0880h
    union DEVICEID_REG DEVICEID;
    Uint16 PROTSTART;
    Uint16 PROTRANGE;
    Uint16 rsvd2[202];
    Uint16 M0RAMDFT; // 0950h
    Uint16 M1RAMDFT;
    Uint16 L0RAMDFT;
    Uint16 L1RAMDFT;
    Uint16 H0RAMDFT;
    Uint16 rsvd3[171];
};

extern volatile struct DEV_EMU_REGS DevEmuRegs;

#endif // DSP281x_DEV_EMU_H
