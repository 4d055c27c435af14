/// InitPieVectTable(): every vector to its function of DSP281x_DefaultIsr.c, then the PIE on.
/// SPDX-License-Identifier: MIT
#include "DSP281x_Device.h"
#include "DSP281x_Examples.h"

// clang-format off
const struct PIE_VECT_TABLE PieVectTableInit = {
    PIE_RESERVED, PIE_RESERVED, PIE_RESERVED, PIE_RESERVED, PIE_RESERVED, PIE_RESERVED, PIE_RESERVED, PIE_RESERVED, PIE_RESERVED,
    PIE_RESERVED, PIE_RESERVED, PIE_RESERVED, PIE_RESERVED,
    INT13_ISR, INT14_ISR, DATALOG_ISR, RTOSINT_ISR, EMUINT_ISR, NMI_ISR, ILLEGAL_ISR, USER1_ISR, USER2_ISR, USER3_ISR, USER4_ISR,
    USER5_ISR, USER6_ISR, USER7_ISR, USER8_ISR, USER9_ISR, USER10_ISR, USER11_ISR, USER12_ISR,
    // Group 1
    PDPINTA_ISR, PDPINTB_ISR, rsvd_ISR, XINT1_ISR, XINT2_ISR, ADCINT_ISR, TINT0_ISR, WAKEINT_ISR,
    // Group 2
    CMP1INT_ISR, CMP2INT_ISR, CMP3INT_ISR, T1PINT_ISR, T1CINT_ISR, T1UFINT_ISR, T1OFINT_ISR, rsvd_ISR,
    // Group 3
    T2PINT_ISR, T2CINT_ISR, T2UFINT_ISR, T2OFINT_ISR, CAPINT1_ISR, CAPINT2_ISR, CAPINT3_ISR, rsvd_ISR,
    // Group 4
    CMP4INT_ISR, CMP5INT_ISR, CMP6INT_ISR, T3PINT_ISR, T3CINT_ISR, T3UFINT_ISR, T3OFINT_ISR, rsvd_ISR,
    // Group 5
    T4PINT_ISR, T4CINT_ISR, T4UFINT_ISR, T4OFINT_ISR, CAPINT4_ISR, CAPINT5_ISR, CAPINT6_ISR, rsvd_ISR,
    // Group 6
    SPIRXINTA_ISR, SPITXINTA_ISR, rsvd_ISR, rsvd_ISR, MRINTA_ISR, MXINTA_ISR, rsvd_ISR, rsvd_ISR,
    // Group 7
    rsvd_ISR, rsvd_ISR, rsvd_ISR, rsvd_ISR, rsvd_ISR, rsvd_ISR, rsvd_ISR, rsvd_ISR,
    // Group 8
    rsvd_ISR, rsvd_ISR, rsvd_ISR, rsvd_ISR, rsvd_ISR, rsvd_ISR, rsvd_ISR, rsvd_ISR,
    // Group 9
    SCIRXINTA_ISR, SCITXINTA_ISR, SCIRXINTB_ISR, SCITXINTB_ISR, ECAN0INTA_ISR, ECAN1INTA_ISR, rsvd_ISR, rsvd_ISR,
    // Group 10
    rsvd_ISR, rsvd_ISR, rsvd_ISR, rsvd_ISR, rsvd_ISR, rsvd_ISR, rsvd_ISR, rsvd_ISR,
    // Group 11
    rsvd_ISR, rsvd_ISR, rsvd_ISR, rsvd_ISR, rsvd_ISR, rsvd_ISR, rsvd_ISR, rsvd_ISR,
    // Group 12
    rsvd_ISR, rsvd_ISR, rsvd_ISR, rsvd_ISR, rsvd_ISR, rsvd_ISR, rsvd_ISR, rsvd_ISR,
};
// clang-format on

void InitPieVectTable(void)
{
    const PINT* Source = (const PINT*)&PieVectTableInit;
    PINT* Dest = (PINT*)&PieVectTable;
    int16 i;

    EALLOW;
    for (i = 0; i < 128; i++)
    {
        *Dest++ = *Source++;
    }
    EDIS;
    PieCtrlRegs.PIECRTL.bit.ENPIE = 1;
}
