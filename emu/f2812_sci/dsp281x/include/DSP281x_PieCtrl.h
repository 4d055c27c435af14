/// \file   DSP281x_PieCtrl.h
/// \brief  Peripheral interrupt expansion, control: PieCtrlRegs at 0CE0h. PIECRTL is spelt as firmware spells it.
/// SPDX-License-Identifier: MIT
#ifndef DSP281x_PIE_CTRL_H
#define DSP281x_PIE_CTRL_H

// clang-format off
DSP281x_REG(PIECTRL, ENPIE:1, PIEVECT:15);
DSP281x_REG(PIEACK, ACK1:1, ACK2:1, ACK3:1, ACK4:1, ACK5:1, ACK6:1, ACK7:1, ACK8:1, ACK9:1, ACK10:1, ACK11:1, ACK12:1, rsvd:4);
DSP281x_REG(PIEIER, INTx1:1, INTx2:1, INTx3:1, INTx4:1, INTx5:1, INTx6:1, INTx7:1, INTx8:1, rsvd:8);
DSP281x_REG(PIEIFR, INTx1:1, INTx2:1, INTx3:1, INTx4:1, INTx5:1, INTx6:1, INTx7:1, INTx8:1, rsvd:8);
// clang-format on

struct PIE_CTRL_REGS
{
    union PIECTRL_REG PIECRTL;
    union PIEACK_REG PIEACK;
    union PIEIER_REG PIEIER1;
    union PIEIFR_REG PIEIFR1;
    union PIEIER_REG PIEIER2;
    union PIEIFR_REG PIEIFR2;
    union PIEIER_REG PIEIER3;
    union PIEIFR_REG PIEIFR3;
    union PIEIER_REG PIEIER4;
    union PIEIFR_REG PIEIFR4;
    union PIEIER_REG PIEIER5;
    union PIEIFR_REG PIEIFR5;
    union PIEIER_REG PIEIER6;
    union PIEIFR_REG PIEIFR6;
    union PIEIER_REG PIEIER7;
    union PIEIFR_REG PIEIFR7;
    union PIEIER_REG PIEIER8;
    union PIEIFR_REG PIEIFR8;
    union PIEIER_REG PIEIER9;
    union PIEIFR_REG PIEIFR9;
    union PIEIER_REG PIEIER10;
    union PIEIFR_REG PIEIFR10;
    union PIEIER_REG PIEIER11;
    union PIEIFR_REG PIEIFR11;
    union PIEIER_REG PIEIER12;
    union PIEIFR_REG PIEIFR12;
};

// The semicolons belong to them: sources are written to that.
#define PIEACK_GROUP1  0x0001;
#define PIEACK_GROUP2  0x0002;
#define PIEACK_GROUP3  0x0004;
#define PIEACK_GROUP4  0x0008;
#define PIEACK_GROUP5  0x0010;
#define PIEACK_GROUP6  0x0020;
#define PIEACK_GROUP7  0x0040;
#define PIEACK_GROUP8  0x0080;
#define PIEACK_GROUP9  0x0100;
#define PIEACK_GROUP10 0x0200;
#define PIEACK_GROUP11 0x0400;
#define PIEACK_GROUP12 0x0800;

extern volatile struct PIE_CTRL_REGS PieCtrlRegs;

#endif // DSP281x_PIE_CTRL_H
