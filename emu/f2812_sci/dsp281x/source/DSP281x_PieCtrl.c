/// InitPieCtrl() and EnableInterrupts().
/// SPDX-License-Identifier: MIT
#include "DSP281x_Device.h"
#include "DSP281x_Examples.h"

/// PIE off, no enable bit, no flag.
void InitPieCtrl(void)
{
    volatile union PIEIER_REG* Register = &PieCtrlRegs.PIEIER1;
    int16 i;

    DINT;
    PieCtrlRegs.PIECRTL.bit.ENPIE = 0;
    for (i = 0; i < 24; i++) // PIEIER1, PIEIFR1 ... PIEIFR12
    {
        Register[i].all = 0;
    }
}

/// PIE on, every group acknowledged, INTM = 0.
void EnableInterrupts(void)
{
    PieCtrlRegs.PIECRTL.bit.ENPIE = 1;
    PieCtrlRegs.PIEACK.all = 0xFFFF;
    EINT;
}
