/// \file   gimu_internal.h
/// \brief  What the sources of the GIMU share.
/// SPDX-License-Identifier: MIT
#ifndef EMU_F2812_GIMU_INTERNAL_H_INCLUDED
#define EMU_F2812_GIMU_INTERNAL_H_INCLUDED
#include "emu_f2812/gimu_part.h"
#include <stddef.h>

#define GIMU_PI        3.14159265358979323846
#define GIMU_FULL_CODE 4095

/// \return false: config is refused, why says so.
bool gimu_check(const gimu_config_t* config, char* why, size_t why_size);
/// All channels at one instant.
void gimu_sample(gimu_t* self, emu_time_t at, uint16_t raw[GIMU_CHANNELS]);
/// The newest fix at an instant; without one of_ps is the whole second before, unless the module says better.
bool gimu_newest_fix(const gimu_t* self, emu_time_t at, gimu_fix_t* fix);
/// |angle| as the GIMU and NMEA write it: degrees times 10^6 plus minutes times 10^4.
uint32_t gimu_coordinate(double angle);
/// GGA and RMC of the newest fix at `at` into pin R's queue.
void gimu_send_nmea(gimu_t* self, emu_time_t at);

#endif // EMU_F2812_GIMU_INTERNAL_H_INCLUDED
