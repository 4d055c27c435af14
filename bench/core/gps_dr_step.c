/// \file   gps_dr_step.c
/// \brief  A load for callgrind: N seconds of the GPS/DR pair, ten steps and a fix each: a car in a circle. Units: m, s, rad.
/// SPDX-License-Identifier: MIT
#include "ins/ins.h"
#include <stdio.h>
#include <stdlib.h>

#define STEPS   10 ///< a second
#define CIRCLE  80 ///< seconds to a turn
#define PI      INS_C(3.14159265358979)
#define SPEED   INS_C(8.)
#define RADIUS  (SPEED * CIRCLE / (2 * PI))
#define SETTLED 20 ///< fixes until which it may still look for its heading

int main(int argc, char** argv)
{
    const unsigned long seconds = argc > 1 ? strtoul(argv[1], NULL, 10) : 100;
    static ins_gps_dr_t pair;
    ins_gps_dr_config_t cfg;
    ins_gps_dr_config_default(&cfg);
    if (ins_gps_dr_init(&pair, &cfg) != INS_OK)
    {
        return 1;
    }
    for (unsigned long k = 1; k <= seconds; k++)
    {
        for (int i = 0; i < STEPS; i++)
        {
            if (ins_gps_dr_step(&pair, INS_C(1.) / STEPS, 2 * PI / CIRCLE, SPEED / STEPS) != INS_OK)
            {
                return 1;
            }
        }
        const ins_real heading = (ins_real)(k % CIRCLE) * (2 * PI / CIRCLE);
        const ins_gps_dr_fix_t fix = {.east = RADIUS * (1 - ins_cos(heading)),
                                      .north = RADIUS * ins_sin(heading),
                                      .sigma = 3,
                                      .hdop = 1,
                                      .course = heading,
                                      .speed = SPEED,
                                      .valid = 1,
                                      .sats = 8,
                                      .has_course = 1};
        if (ins_gps_dr_fix(&pair, &fix) != INS_OK || (k > SETTLED && ins_gps_dr_source(&pair) != INS_GPS_DR_GPS))
        {
            return 1;
        }
    }
    printf("%lu of %lu fixes used\n", (unsigned long)pair.used, seconds);
    return pair.used == seconds ? 0 : 1;
}
