/// \file   DSP28_Device.h
/// \brief  The same for firmware written to the older headers (v0.57): one file to include, and the names that were others then.
/// SPDX-License-Identifier: MIT
#ifndef DSP28_DEVICE_H
#define DSP28_DEVICE_H
#include "DSP281x_Device.h"
#include "DSP281x_Examples.h"

#define PieCtrl   PieCtrlRegs
#define SCIENCLKA SCIAENCLK
#define SCIENCLKB SCIBENCLK

#endif // DSP28_DEVICE_H
