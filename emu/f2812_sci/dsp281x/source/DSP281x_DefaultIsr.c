/// The interrupt functions of DSP281x_DefaultISR.h: an interrupt without one of the program's own stops it.
/// SPDX-License-Identifier: MIT
#include "DSP281x_Device.h"
#include "DSP281x_Examples.h"

#define DSP281x_STOP(NAME)                                                                                             \
    interrupt void NAME(void)                                                                                          \
    {                                                                                                                  \
        ESTOP0;                                                                                                        \
        for (;;)                                                                                                       \
        {                                                                                                              \
        }                                                                                                              \
    }

// clang-format off
DSP281x_STOP(INT13_ISR)
DSP281x_STOP(INT14_ISR)
DSP281x_STOP(DATALOG_ISR)
DSP281x_STOP(RTOSINT_ISR)
DSP281x_STOP(EMUINT_ISR)
DSP281x_STOP(NMI_ISR)
DSP281x_STOP(ILLEGAL_ISR)
DSP281x_STOP(USER1_ISR)
DSP281x_STOP(USER2_ISR)
DSP281x_STOP(USER3_ISR)
DSP281x_STOP(USER4_ISR)
DSP281x_STOP(USER5_ISR)
DSP281x_STOP(USER6_ISR)
DSP281x_STOP(USER7_ISR)
DSP281x_STOP(USER8_ISR)
DSP281x_STOP(USER9_ISR)
DSP281x_STOP(USER10_ISR)
DSP281x_STOP(USER11_ISR)
DSP281x_STOP(USER12_ISR)
DSP281x_STOP(PDPINTA_ISR)
DSP281x_STOP(PDPINTB_ISR)
DSP281x_STOP(XINT1_ISR)
DSP281x_STOP(XINT2_ISR)
DSP281x_STOP(ADCINT_ISR)
DSP281x_STOP(TINT0_ISR)
DSP281x_STOP(WAKEINT_ISR)
DSP281x_STOP(CMP1INT_ISR)
DSP281x_STOP(CMP2INT_ISR)
DSP281x_STOP(CMP3INT_ISR)
DSP281x_STOP(T1PINT_ISR)
DSP281x_STOP(T1CINT_ISR)
DSP281x_STOP(T1UFINT_ISR)
DSP281x_STOP(T1OFINT_ISR)
DSP281x_STOP(T2PINT_ISR)
DSP281x_STOP(T2CINT_ISR)
DSP281x_STOP(T2UFINT_ISR)
DSP281x_STOP(T2OFINT_ISR)
DSP281x_STOP(CAPINT1_ISR)
DSP281x_STOP(CAPINT2_ISR)
DSP281x_STOP(CAPINT3_ISR)
DSP281x_STOP(CMP4INT_ISR)
DSP281x_STOP(CMP5INT_ISR)
DSP281x_STOP(CMP6INT_ISR)
DSP281x_STOP(T3PINT_ISR)
DSP281x_STOP(T3CINT_ISR)
DSP281x_STOP(T3UFINT_ISR)
DSP281x_STOP(T3OFINT_ISR)
DSP281x_STOP(T4PINT_ISR)
DSP281x_STOP(T4CINT_ISR)
DSP281x_STOP(T4UFINT_ISR)
DSP281x_STOP(T4OFINT_ISR)
DSP281x_STOP(CAPINT4_ISR)
DSP281x_STOP(CAPINT5_ISR)
DSP281x_STOP(CAPINT6_ISR)
DSP281x_STOP(SPIRXINTA_ISR)
DSP281x_STOP(SPITXINTA_ISR)
DSP281x_STOP(MRINTA_ISR)
DSP281x_STOP(MXINTA_ISR)
DSP281x_STOP(SCIRXINTA_ISR)
DSP281x_STOP(SCITXINTA_ISR)
DSP281x_STOP(SCIRXINTB_ISR)
DSP281x_STOP(SCITXINTB_ISR)
DSP281x_STOP(ECAN0INTA_ISR)
DSP281x_STOP(ECAN1INTA_ISR)
DSP281x_STOP(PIE_RESERVED)
DSP281x_STOP(rsvd_ISR)
    // clang-format on

    /// For an interrupt that is to be ignored; it acknowledges nothing.
    interrupt void EMPTY_ISR(void)
{
}
