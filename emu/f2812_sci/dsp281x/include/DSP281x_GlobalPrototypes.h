/// \file   DSP281x_GlobalPrototypes.h
/// \brief  The functions that come with the headers.
/// SPDX-License-Identifier: MIT
#ifndef DSP281x_GLOBALPROTOTYPES_H
#define DSP281x_GLOBALPROTOTYPES_H

void InitSysCtrl(
    void); ///< watchdog off, PLL x10/2, HSPCLK = SYSCLKOUT/2, LSPCLK = SYSCLKOUT/4, every peripheral's clock on
void InitPeripherals(void);
void InitPeripheralClocks(void);
void InitPll(Uint16 val);
void DisableDog(void);
void KickDog(void);
void ServiceDog(void);
void InitFlash(void);
void MemCopy(Uint16* SourceAddr, Uint16* SourceEndAddr, Uint16* DestAddr);

void InitPieCtrl(void);
void InitPieVectTable(void);
void EnableInterrupts(void);

void InitGpio(void); ///< SCI-A and SCI-B on their pins
void InitSci(void);
void InitScia(void); ///< 9600 Bd 8N1 at LSPCLK 37.5 MHz, FIFOs on
void InitScib(void);

/// Waits 9 + 5 Count cycles.
void DSP28x_usDelay(Uint32 Count);

extern Uint16 RamfuncsLoadStart;
extern Uint16 RamfuncsLoadEnd;
extern Uint16 RamfuncsRunStart;

#endif // DSP281x_GLOBALPROTOTYPES_H
