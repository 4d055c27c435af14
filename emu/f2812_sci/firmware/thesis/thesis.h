/// \file   thesis.h
/// \brief  What the files of this firmware that touch registers offer each other. Unit: ms.
/// SPDX-License-Identifier: MIT
#ifndef THESIS_H_INCLUDED
#define THESIS_H_INCLUDED
#include "DSP281x_Device.h"
#include "DSP281x_Examples.h"

#define BRR_19200 0x00F3 // LSPCLK 37.5 MHz: 19211 Bd, table 4.3 of the thesis

/// main.c: milliseconds since the start, counted by CPU timer 0.
Uint32 Milliseconds(void);

/// sci_gimu.c: SCI-A hears the GIMU. Its interrupt moves each octet into a ring.
void GimuInit(void);
/// \return an octet, or -1: none has come.
int GimuRead(void);
/// 1: since the last call of this an octet was lost or damaged.
Uint16 GimuErrors(void);
/// Since the newest octet.
Uint32 GimuSilence(void);

/// sci_pc.c: SCI-B talks to the PC, polled.
void PcInit(void);
int PcRead(void);
Uint16 PcRoom(void);
void PcWrite(Uint16 Octet);

#endif // THESIS_H_INCLUDED
