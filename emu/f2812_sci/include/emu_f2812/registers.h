/// \file   emu_f2812/registers.h
/// \brief  Names of the registers of an F2812, as in TI's guides: "SCIFFTXA", "PIEACK", "GPFMUX". A 32-bit register has the name of its
///         low word at its address and, with an H behind it, one for the high word: "TIMER0PRD", "TIMER0PRDH".
/// SPDX-License-Identifier: MIT
#ifndef EMU_F2812_REGISTERS_H_INCLUDED
#define EMU_F2812_REGISTERS_H_INCLUDED
#include "emu/time.h"
#ifdef __cplusplus
extern "C" {
#endif

/// \return NULL where there is no register.
EMU_API const char* f2812_register_name(uint16_t address);
/// \return word address, or -1.
EMU_API int f2812_register_address(const char* name);
/// Name of an entry of the PIE vector table, as "SCIRXINTA" of 96. \return NULL for a reserved one.
EMU_API const char* f2812_vector_name(unsigned vector);

#ifdef __cplusplus
}
#endif
#endif // EMU_F2812_REGISTERS_H_INCLUDED
