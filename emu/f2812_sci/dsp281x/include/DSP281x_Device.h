/// \file   DSP281x_Device.h
/// \brief  What firmware for a TMS320F2812 includes: types, CPU macros and all register objects, by the names of TI's DSP281x headers V1.20.
///
/// Clean-room: names, addresses and field orders are the device's; no text is TI's. Made for the host's compiler with f2812-cc, where an
/// object stands for its registers and each access to it goes to the emulated device. Sizes are the C28x's, in words of two octets.
/// SPDX-License-Identifier: MIT
#ifndef DSP281x_DEVICE_H
#define DSP281x_DEVICE_H

#define TARGET         1
#define F2812          TARGET
#define F2810          0
#define DSP281x        TARGET
#define CPU_FRQ_150MHZ 1

extern cregister volatile unsigned int IFR;
extern cregister volatile unsigned int IER;

#define EINT   asm(" clrc INTM")
#define DINT   asm(" setc INTM")
#define ERTM   asm(" clrc DBGM")
#define DRTM   asm(" setc DBGM")
#define EALLOW asm(" EALLOW")
#define EDIS   asm(" EDIS")
#define ESTOP0 asm(" ESTOP0")

// Bits of IER and IFR.
#define M_INT1  0x0001
#define M_INT2  0x0002
#define M_INT3  0x0004
#define M_INT4  0x0008
#define M_INT5  0x0010
#define M_INT6  0x0020
#define M_INT7  0x0040
#define M_INT8  0x0080
#define M_INT9  0x0100
#define M_INT10 0x0200
#define M_INT11 0x0400
#define M_INT12 0x0800
#define M_INT13 0x1000
#define M_INT14 0x2000
#define M_DLOG  0x4000
#define M_RTOS  0x8000

#define BIT0  0x0001
#define BIT1  0x0002
#define BIT2  0x0004
#define BIT3  0x0008
#define BIT4  0x0010
#define BIT5  0x0020
#define BIT6  0x0040
#define BIT7  0x0080
#define BIT8  0x0100
#define BIT9  0x0200
#define BIT10 0x0400
#define BIT11 0x0800
#define BIT12 0x1000
#define BIT13 0x2000
#define BIT14 0x4000
#define BIT15 0x8000

#ifndef DSP28_DATA_TYPES // f2812-cc defines them: int has 32 bits on the host
#error "compile this with f2812-cc or add_f2812_firmware(): the host's int has 32 bits, the C28x's has 16"
#endif

/// A register of 16 bits with fields, from bit 0 up: union NAME_REG with .all and .bit, struct NAME_BITS.
#define DSP281x_REG(NAME, ...)                                                                                         \
    struct NAME##_BITS                                                                                                 \
    {                                                                                                                  \
        Uint16 __VA_ARGS__;                                                                                            \
    };                                                                                                                 \
    union NAME##_REG                                                                                                   \
    {                                                                                                                  \
        Uint16 all;                                                                                                    \
        struct NAME##_BITS bit;                                                                                        \
    }
/// The same with 32 bits; fields are Uint16, so none lies across the middle.
#define DSP281x_REG32(NAME, ...)                                                                                       \
    struct NAME##_BITS                                                                                                 \
    {                                                                                                                  \
        Uint16 __VA_ARGS__;                                                                                            \
    };                                                                                                                 \
    union NAME##_REG                                                                                                   \
    {                                                                                                                  \
        Uint32 all;                                                                                                    \
        struct NAME##_BITS bit;                                                                                        \
    }

// clang-format off
#include "DSP281x_SysCtrl.h"
#include "DSP281x_DevEmu.h"
#include "DSP281x_Xintf.h"
#include "DSP281x_CpuTimers.h"
#include "DSP281x_PieCtrl.h"
#include "DSP281x_PieVect.h"
#include "DSP281x_Spi.h"
#include "DSP281x_Sci.h"
#include "DSP281x_Mcbsp.h"
#include "DSP281x_ECan.h"
#include "DSP281x_Gpio.h"
#include "DSP281x_Ev.h"
#include "DSP281x_Adc.h"
#include "DSP281x_XIntrupt.h"
#include "DSP281x_DefaultISR.h"
// clang-format on
#endif // DSP281x_DEVICE_H
