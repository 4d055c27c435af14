/// \file   display.h
/// \brief  The GPS/DR paper's LCD: position, time, speed, heading and where they come from, four lines each second.
///
///      52 30.6321 N   13 22.4821 E
///     2026-05-03 12:34:56 UTC
///     23.4 km/h    heading 123.4
///     GPS   8 satellites   +-12 m
///
/// On a terminal the four lines are written over; elsewhere they follow each other, with an empty line between.
/// SPDX-License-Identifier: MIT
#ifndef GPSDR_DISPLAY_H_INCLUDED
#define GPSDR_DISPLAY_H_INCLUDED
#include "ins_nav/vehicle.h"
#include <stddef.h>

#define DISPLAY_MAX 256

/// \return length of the four lines without the final 0.
size_t display_text(const ins_vehicle_t* vehicle, const ins_nav_solution_t* solution, char* text, size_t size);
/// To standard output. \param[in] again  not the first time. \return 0; -1 when it cannot be written.
int display_show(const ins_vehicle_t* vehicle, const ins_nav_solution_t* solution, int again);
/// NONE, ALIGN, DR, GPS: of INS_GPS_DR_NONE ...
const char* display_source(int source);

#endif // GPSDR_DISPLAY_H_INCLUDED
