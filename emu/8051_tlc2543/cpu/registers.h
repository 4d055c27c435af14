/// \file   cpu/registers.h
/// \brief  Special function registers of the AT89S51 and AT89S52 and their bits (Atmel 2487D, 1919D). Not installed.
/// SPDX-License-Identifier: MIT
#ifndef MCS51_REGISTERS_H_INCLUDED
#define MCS51_REGISTERS_H_INCLUDED

enum
{
    P0 = 0x80,
    SP = 0x81,
    DP0L = 0x82,
    DP0H = 0x83,
    DP1L = 0x84,
    DP1H = 0x85,
    PCON = 0x87,
    TCON = 0x88,
    TMOD = 0x89,
    TL0 = 0x8A,
    TL1 = 0x8B,
    TH0 = 0x8C,
    TH1 = 0x8D,
    AUXR = 0x8E,
    P1 = 0x90,
    SCON = 0x98,
    SBUF = 0x99,
    P2 = 0xA0,
    AUXR1 = 0xA2,
    WDTRST = 0xA6,
    IE = 0xA8,
    P3 = 0xB0,
    IP = 0xB8,
    T2CON = 0xC8,
    T2MOD = 0xC9,
    RCAP2L = 0xCA,
    RCAP2H = 0xCB,
    TL2 = 0xCC,
    TH2 = 0xCD,
    PSW = 0xD0,
    ACC = 0xE0,
    B = 0xF0
};

enum
{
    PCON_IDL = 0x01,
    PCON_PD = 0x02,
    PCON_POF = 0x10,
    PCON_SMOD = 0x80,
    TCON_TR1 = 0x40,
    AUXR_DISRTO = 0x08,
    AUXR_WDIDLE = 0x10,
    IE_ET2 = 0x20,
    IE_EA = 0x80,
    SCON_RI = 0x01,
    SCON_TI = 0x02,
    SCON_RB8 = 0x04,
    SCON_TB8 = 0x08,
    SCON_REN = 0x10,
    SCON_SM2 = 0x20,
    T2CON_CAPTURE = 0x01, ///< CP/RL2
    T2CON_COUNTER = 0x02, ///< C/T2
    T2CON_TR2 = 0x04,
    T2CON_EXEN2 = 0x08,
    T2CON_TCLK = 0x10,
    T2CON_RCLK = 0x20,
    T2CON_EXF2 = 0x40,
    T2CON_TF2 = 0x80,
    T2MOD_DCEN = 0x01,
    T2MOD_T2OE = 0x02,
    P3_RXD = 0x01,
    P3_TXD = 0x02
};

#endif // MCS51_REGISTERS_H_INCLUDED
