/// \file   f2812_guest.h
/// \brief  Stands before each firmware source (f2812-cc -include): TI's keywords, asm(), loops that tick, data types of the C28x's size.
/// SPDX-License-Identifier: MIT
#ifndef F2812_GUEST_H_INCLUDED
#define F2812_GUEST_H_INCLUDED

/// Firmware may ask for this to know that it runs on the emulator.
#define F2812_EMULATED  1
#define __TMS320C2000__ 1
#define __TMS320C28XX__ 1
#define _TMS320C2000    1
#define TMS320C28XX     1

#define interrupt
#define __interrupt
#define cregister
#define far
#define near
#define ioport
#define main f2812_main

/// One CPU instruction in words; those that the emulator knows are listed in docs/f2812.md.
void f2812_asm(const char* instruction);
#define asm(instruction) f2812_asm(instruction)
#define __asm(instruction) f2812_asm(instruction)

/// A turn of a loop: an empty loop makes no basic block that the compiler would tell of.
void f2812_tick(void);
// clang-format off
#define for(...) for (__VA_ARGS__) if (f2812_tick(), 0) {} else
#define while(...) while (f2812_tick(), (__VA_ARGS__))
// clang-format on

#define DSP28_DATA_TYPES
typedef short int16;
typedef unsigned short Uint16;
typedef int int32;
typedef unsigned int Uint32;
typedef long long int64;
typedef unsigned long long Uint64;
typedef float float32;
typedef double float64;

#endif // F2812_GUEST_H_INCLUDED
