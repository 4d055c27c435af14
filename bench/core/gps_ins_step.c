/// \file   gps_ins_step.c
/// \brief  A load for callgrind: N times 20 samples of a GPS/INS filter and a fix: a car in a circle. Frames: b, n (NED). SI, rad.
///
/// LATE: the fix is so many samples old, and the antenna is on an arm. SCALE: 1 with scale factors, 0 without.
/// SPDX-License-Identifier: MIT
#include "ins/ins.h"
#include <stdio.h>
#include <stdlib.h>

#define HZ      100
#define SAMPLES 20   ///< to a fix
#define CIRCLE  5000 ///< samples to a turn
#define PI      INS_C(3.14159265358979)
#define SPEED   INS_C(10.)
#define RADIUS  (SPEED * CIRCLE / HZ / (2 * PI))
#define G       INS_C(9.80940)
#define TREMOR  INS_C(1e-5) ///< of the increments, so that no axis looks dead

static const ins_position_t HOME = {{INS_C(.9), INS_C(.2), 100}, {0, 0, 0}};

/// What a receiver at the IMU says of sample k.
static void receive(unsigned long k, ins_gnss_fix_t* fix)
{
    static const ins_gnss_fix_t none = {0, {{0}, {0}}, {0}, {2, 2, 4}, {INS_C(.1), INS_C(.1), INS_C(.2)}};
    const ins_real heading = (ins_real)(k % CIRCLE) * (2 * PI / CIRCLE);
    const ins_real s = ins_sin(heading);
    const ins_real c = ins_cos(heading);
    ins_real radii[2];
    ins_earth_radii(ins_sin(HOME.anchor[0]), radii);
    *fix = none;
    fix->t_ns = (int64_t)k * (1000000000 / HZ);
    fix->position = HOME;
    fix->position.offset[0] = RADIUS * s / (radii[0] + HOME.anchor[2]);
    fix->position.offset[1] = RADIUS * (1 - c) / ((radii[1] + HOME.anchor[2]) * ins_cos(HOME.anchor[0]));
    fix->v_n[0] = SPEED * c;
    fix->v_n[1] = SPEED * s;
}

int main(int argc, char** argv)
{
    const unsigned long fixes = argc > 1 ? strtoul(argv[1], NULL, 10) : 100;
    static ins_gps_ins_scale_t all;
    static const ins_kf15_scale_sensors_t scales = {INS_C(.01), INS_C(.01), INS_C(1e5), INS_C(1e5)};
    ins_gps_ins_t* const nav = &all.base;
    static const ins_gps_ins_start_t start = {.q_nb = {1, 0, 0, 0},
                                              .v_n = {SPEED, 0, 0},
                                              .position = {{INS_C(.9), INS_C(.2), 100}, {0, 0, 0}},
                                              .sigma = {INS_C(.01), INS_C(.01), INS_C(.1), 1, 1, 1, 2, 2, 2,
                                                        INS_C(1e-3), INS_C(1e-3), INS_C(1e-3), INS_C(.02), INS_C(.02),
                                                        INS_C(.02)}};
    ins_gps_ins_config_t cfg;
    ins_gps_ins_config(&cfg);
    if (LATE > 0)
    {
        cfg.antenna_b[0] = INS_C(.01); // far below the noise of the fixes, which are of the IMU
        cfg.antenna_b[1] = INS_C(.02);
        cfg.antenna_b[2] = INS_C(-.03);
    }
    if ((SCALE ? ins_gps_ins_scale_init(&all, &cfg, &scales, &start) : ins_gps_ins_init(nav, &cfg, &start)) != INS_OK)
    {
        return 1;
    }
    for (unsigned long k = 1; k <= SAMPLES * fixes; k++)
    {
        const ins_real shake = k % 2 ? TREMOR : -TREMOR;
        const ins_increment_t increment = {{shake, shake, 2 * PI / CIRCLE + shake},
                                           {shake, SPEED * (2 * PI / CIRCLE) + shake, -G / HZ + shake}};
        if (ins_gps_ins_step(nav, (int64_t)k * (1000000000 / HZ), INS_C(1.) / HZ, &increment) != INS_OK)
        {
            return 1;
        }
        if (k % SAMPLES == 0)
        {
            ins_gnss_fix_t fix;
            receive(k - LATE, &fix);
            if (ins_gps_ins_gnss(nav, &fix) != INS_OK)
            {
                return 1;
            }
        }
    }
    printf("%lu of %lu fixes used, %lu in part\n", (unsigned long)nav->count.fixes, fixes,
           (unsigned long)(nav->count.fix_position + nav->count.fix_velocity));
    return nav->count.fixes == fixes && nav->count.fix_position + nav->count.fix_velocity == 0 ? 0 : 1;
}
