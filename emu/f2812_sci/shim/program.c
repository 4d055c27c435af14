/// \file   program.c
/// \brief  What f2812-cc links with the firmware: its name, its variables, and where its register objects lie on the device.
///
/// Addresses and sizes: SPRS174, memory map; DSP281x header names. An object the firmware does not have is NULL here.
/// SPDX-License-Identifier: MIT
#include "shim.h"

void f2812_main(void);

/// The CPU's registers that TI's C names without declaring where they are.
volatile uint32_t IER;
volatile uint32_t IFR;
/// Bounds of code that TI's linker would copy to RAM: nothing is copied.
uint16_t RamfuncsLoadStart, RamfuncsLoadEnd, RamfuncsRunStart;

/// Bounds of the firmware's variables, from prelink.ld.
extern uint8_t f2812_data_begin[], f2812_data_finish[];

#define OBJECTS(X)                                                                                                     \
    X(DevEmuRegs, 0x0880, 0x180)                                                                                       \
    X(FlashRegs, 0x0A80, 0x8)                                                                                          \
    X(CsmRegs, 0x0AE0, 0x10)                                                                                           \
    X(XintfRegs, 0x0B20, 0x20)                                                                                         \
    X(CpuTimer0Regs, 0x0C00, 0x8)                                                                                      \
    X(CpuTimer1Regs, 0x0C08, 0x8)                                                                                      \
    X(CpuTimer2Regs, 0x0C10, 0x8)                                                                                      \
    X(PieCtrlRegs, 0x0CE0, 0x1A)                                                                                       \
    X(PieCtrl, 0x0CE0, 0x1A)                                                                                           \
    X(ECanaRegs, 0x6000, 0x34)                                                                                         \
    X(ECanaLAMRegs, 0x6040, 0x40)                                                                                      \
    X(ECanaMOTSRegs, 0x6080, 0x40)                                                                                     \
    X(ECanaMOTORegs, 0x60C0, 0x40)                                                                                     \
    X(ECanaMboxes, 0x6100, 0x100)                                                                                      \
    X(SysCtrlRegs, 0x7010, 0x20)                                                                                       \
    X(SpiaRegs, 0x7040, 0x10)                                                                                          \
    X(SciaRegs, 0x7050, 0x10)                                                                                          \
    X(XIntruptRegs, 0x7070, 0x10)                                                                                      \
    X(GpioMuxRegs, 0x70C0, 0x20)                                                                                       \
    X(GpioDataRegs, 0x70E0, 0x20)                                                                                      \
    X(AdcRegs, 0x7100, 0x20)                                                                                           \
    X(EvaRegs, 0x7400, 0x32)                                                                                           \
    X(EvbRegs, 0x7500, 0x32)                                                                                           \
    X(ScibRegs, 0x7750, 0x10)                                                                                          \
    X(McbspaRegs, 0x7800, 0x25)

#define DECLARE(NAME, ADDRESS, WORDS) extern uint8_t NAME[] __attribute__((weak));
OBJECTS(DECLARE)
extern uint8_t PieVectTable[] __attribute__((weak));

#define ENTRY(NAME, ADDRESS, WORDS) {NAME, ADDRESS, WORDS},
#define IER_ADDRESS                 1 // F2812_MAP_IER of shim_internal.h
#define IFR_ADDRESS                 2
static const f2812_object_t objects[] = {
    {(void*)&IER, IER_ADDRESS, 2}, // TI declares them unsigned int: 32 bits on the host
    {(void*)&IFR, IFR_ADDRESS, 2},
    OBJECTS(ENTRY)};

const f2812_program_t f2812_program = {.name = F2812_PROGRAM_NAME,
                                       .main = f2812_main,
                                       .data = f2812_data_begin,
                                       .data_end = f2812_data_finish,
                                       .objects = objects,
                                       .object_count = sizeof objects / sizeof objects[0],
                                       .vectors = (void (**)(void))(void*)PieVectTable};
