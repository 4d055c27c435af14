/// InitGpio(): all pins inputs, but those of both SCIs.
/// SPDX-License-Identifier: MIT
#include "DSP281x_Device.h"
#include "DSP281x_Examples.h"

void InitGpio(void)
{
    EALLOW;
    GpioMuxRegs.GPAMUX.all = 0;
    GpioMuxRegs.GPBMUX.all = 0;
    GpioMuxRegs.GPDMUX.all = 0;
    GpioMuxRegs.GPFMUX.all = 0x0030; // SCITXDA, SCIRXDA
    GpioMuxRegs.GPEMUX.all = 0;
    GpioMuxRegs.GPGMUX.all = 0x0030; // SCITXDB, SCIRXDB
    GpioMuxRegs.GPADIR.all = 0;
    GpioMuxRegs.GPBDIR.all = 0;
    GpioMuxRegs.GPDDIR.all = 0;
    GpioMuxRegs.GPEDIR.all = 0;
    GpioMuxRegs.GPFDIR.all = 0;
    GpioMuxRegs.GPGDIR.all = 0;
    EDIS;
}
