/// \file   DSP281x_SysCtrl.h
/// \brief  System control (SysCtrlRegs at 7010h), flash (FlashRegs at 0A80h) and code security (CsmRegs at 0AE0h, CsmPwl at 3F7FF8h).
/// SPDX-License-Identifier: MIT
#ifndef DSP281x_SYS_CTRL_H
#define DSP281x_SYS_CTRL_H

// clang-format off
DSP281x_REG(HISPCP, HSPCLK:3, rsvd1:13);
DSP281x_REG(LOSPCP, LSPCLK:3, rsvd1:13);
DSP281x_REG(PCLKCR, EVAENCLK:1, EVBENCLK:1, rsvd1:1, ADCENCLK:1, rsvd2:4, SPIENCLK:1, rsvd3:1, SCIAENCLK:1, SCIBENCLK:1,
            MCBSPENCLK:1, rsvd4:1, ECANENCLK:1, rsvd5:1);
DSP281x_REG(LPMCR0, LPM:2, QUALSTDBY:6, rsvd1:8);
DSP281x_REG(LPMCR1, XINT1:1, XNMI:1, WDINT:1, T1CTRIP:1, T2CTRIP:1, T3CTRIP:1, T4CTRIP:1, C1TRIP:1, C2TRIP:1, C3TRIP:1, C4TRIP:1,
            C5TRIP:1, C6TRIP:1, SCIRXA:1, SCIRXB:1, CANRX:1);
DSP281x_REG(PLLCR, DIV:4, rsvd1:12);
DSP281x_REG(FOPT, ENPIPE:1, rsvd:15);
DSP281x_REG(FPWR, PWR:2, rsvd:14);
DSP281x_REG(FSTATUS, PWRS:2, STDBYWAITS:1, ACTIVEWAITS:1, rsvd1:4, V3STAT:1, rsvd2:7);
DSP281x_REG(FSTDBYWAIT, STDBYWAIT:9, rsvd:7);
DSP281x_REG(FACTIVEWAIT, ACTIVEWAIT:9, rsvd:7);
DSP281x_REG(FBANKWAIT, RANDWAIT:4, rsvd1:4, PAGEWAIT:4, rsvd2:4);
DSP281x_REG(FOTPWAIT, OTPWAIT:5, rsvd:11);
DSP281x_REG(CSMSCR, SECURE:1, rsvd1:14, FORCESEC:1);
// clang-format on

struct SYS_CTRL_REGS
{
    Uint16 rsvd1[10]; // 7010h
    union HISPCP_REG HISPCP;
    union LOSPCP_REG LOSPCP;
    union PCLKCR_REG PCLKCR;
    Uint16 rsvd2;
    union LPMCR0_REG LPMCR0;
    union LPMCR1_REG LPMCR1;
    Uint16 rsvd3; // 7020h
    union PLLCR_REG PLLCR;
    Uint16 SCSR;
    Uint16 WDCNTR;
    Uint16 rsvd4;
    Uint16 WDKEY;
    Uint16 rsvd5[3];
    Uint16 WDCR; // 7029h
    Uint16 rsvd6[6];
};

struct FLASH_REGS
{
    union FOPT_REG FOPT;
    Uint16 rsvd1;
    union FPWR_REG FPWR;
    union FSTATUS_REG FSTATUS;
    union FSTDBYWAIT_REG FSTDBYWAIT;
    union FACTIVEWAIT_REG FACTIVEWAIT;
    union FBANKWAIT_REG FBANKWAIT;
    union FOTPWAIT_REG FOTPWAIT;
};

struct CSM_REGS
{
    Uint16 KEY0, KEY1, KEY2, KEY3, KEY4, KEY5, KEY6, KEY7;
    Uint16 rsvd1[7];
    union CSMSCR_REG CSMSCR;
};

struct CSM_PWL
{
    Uint16 PSWD0, PSWD1, PSWD2, PSWD3, PSWD4, PSWD5, PSWD6, PSWD7;
};

extern volatile struct SYS_CTRL_REGS SysCtrlRegs;
extern volatile struct FLASH_REGS FlashRegs;
extern volatile struct CSM_REGS CsmRegs;
extern volatile struct CSM_PWL CsmPwl;

#define STANDBY() asm(" IDLE")
#define HALT()    asm(" IDLE")

#endif // DSP281x_SYS_CTRL_H
