/// \file   emu_f2812/config.h
/// \brief  What an F2812 is made with: the crystal, and a switch for each thing that TI's papers leave open or contradict.
///
/// A switch that is 0 is at its default, the one that firmware in the field needs. docs/f2812.md names source and test of each.
/// SPDX-License-Identifier: MIT
#ifndef EMU_F2812_CONFIG_H_INCLUDED
#define EMU_F2812_CONFIG_H_INCLUDED
#include "emu/report.h"
#ifdef __cplusplus
extern "C" {
#endif

#define F2812_OSCCLK_HZ     UINT64_C(30000000)  ///< crystal of the eZdsp F2812 and of most boards
#define F2812_OSCCLK_HZ_MIN UINT64_C(4000000)   ///< data sheet SPRS174, XCLKIN with the PLL
#define F2812_OSCCLK_HZ_MAX UINT64_C(150000000) ///< data sheet SPRS174, XCLKIN with the PLL bypassed

/// Values of f2812_switches_t.clock_off: an access to a peripheral whose bit in PCLKCR is 0. Always a guest error.
enum
{
    F2812_CLOCK_OFF_DROP = 0, ///< "drop": writes are lost, reads give 0
    F2812_CLOCK_OFF_TAKE      ///< "take": registers are read and written as if there were a clock
};

/// Each member takes the values of the enumeration of its name.
typedef struct f2812_switches_t
{
    uint8_t clock_off; ///< F2812_CLOCK_OFF_*
} f2812_switches_t;

/// Set a switch by its name, as "clock_off", to a value by its name, as "take". \return NULL, or what is wrong.
EMU_API const char* f2812_switch_set(f2812_switches_t* self, const char* name, const char* value);

typedef struct f2812_config_t
{
    uint64_t oscclk_hz;
    f2812_switches_t switches;
    emu_report_t report;
} f2812_config_t;

/// 30 MHz, all switches at their default, no reports.
EMU_API void f2812_default_config(f2812_config_t* config);

#ifdef __cplusplus
}
#endif
#endif // EMU_F2812_CONFIG_H_INCLUDED
