/// \file   options.h
/// \brief  The command line of ins-gpsdr.
/// SPDX-License-Identifier: MIT
#ifndef GPSDR_OPTIONS_H_INCLUDED
#define GPSDR_OPTIONS_H_INCLUDED
#include "../daemon/options.h"
#include "ins_nav/vehicle.h"

typedef struct gpsdr_options_t
{
    ins_vehicle_config_t vehicle;
    const char* device[INS_VEHICLE_PORTS]; ///< the receiver's; the board's, NULL = the same
    long baud[INS_VEHICLE_PORTS];
    options_t shared; ///< json, dds and what belongs to it, limit, timeout_s, quiet
    int display;      ///< 1: on standard output
} gpsdr_options_t;

/// \return -1 to go on, else the exit code: 0 after --help or --version, 2 after a message about what is wrong.
int gpsdr_options_parse(int argc, char** argv, gpsdr_options_t* options);

#endif // GPSDR_OPTIONS_H_INCLUDED
