// A GPS/INS navigator of a car, on a drive that it makes up itself: 20 s at rest, then off in a circle; no fixes from 60 s to 90 s.
// SPDX-License-Identifier: MIT
#include "ins/earth.h"
#include "ins/gps_ins.h"
#include "ins/gps_ins_align.h"
#include "ins/ins_math.h"
#include <stdio.h>

#define HZ     100
#define RADIUS INS_C(80.)
#define SPEED  INS_C(10.)
#define G      INS_C(9.80940)

/// The car at t: v along its heading, which turns by speed / radius. \param[out] v_n  [3] \param[out] ned  [3] from the start.
static void car(ins_real t, ins_real* speed, ins_real v_n[3], ins_real ned[3])
{
    const ins_real s = t < 20 ? 0 : t - 20;
    const ins_real way = s < 10 ? SPEED * s * s / 20 : SPEED * (s - 5); // 1 m/s^2, then steady
    *speed = s < 10 ? SPEED * s / 10 : SPEED;
    const ins_real heading = way / RADIUS;
    v_n[0] = *speed * ins_cos(heading);
    v_n[1] = *speed * ins_sin(heading);
    v_n[2] = 0;
    ned[0] = RADIUS * ins_sin(heading);
    ned[1] = RADIUS * (1 - ins_cos(heading));
    ned[2] = 0;
}

int main(void)
{
    static ins_gps_ins_t nav;
    static ins_gps_ins_align_t align;
    static ins_gps_ins_start_t start;
    ins_gps_ins_config_t cfg;
    ins_gps_ins_align_config_t how;
    ins_gps_ins_config(&cfg); // a low-cost MEMS IMU; here is what is known better
    cfg.sensors.bg_sigma = INS_C(1e-3);
    cfg.sensors.ba_sigma = INS_C(2e-2);
    cfg.still.samples = HZ; // rest is looked for
    cfg.still.rate_sigma = INS_C(2e-3);
    cfg.still.force_sigma = INS_C(0.05);
    cfg.still.rate_mean = INS_C(0.01);
    ins_gps_ins_align_config(&how); // a vehicle: its nose points along its velocity
    if (ins_gps_ins_align_init(&align, &cfg, &how) != INS_OK)
    {
        return 1;
    }
    const ins_position_t home = {{INS_C(0.9), INS_C(0.2), INS_C(100.)}, {0, 0, 0}};
    ins_real radii[2];
    ins_earth_radii(ins_sin(home.anchor[0]), radii);
    int running = 0;
    for (long k = 1; k <= 120L * HZ; k++)
    {
        const int64_t t_ns = (int64_t)k * (1000000000 / HZ);
        const ins_real t = (ins_real)k / HZ;
        ins_real before;
        ins_real speed;
        ins_real v_n[3];
        ins_real ned[3];
        car(t - INS_C(1.) / HZ, &before, v_n, ned);
        car(t, &speed, v_n, ned);
        // What the IMU says: the turn, the acceleration along and across, gravity; a bias of 0.03 deg/s and 10 mm/s^2, Earth rate off.
        const ins_real turn = (before + speed) / 2 / RADIUS / HZ;
        const ins_increment_t increment = {{0, 0, turn + INS_C(5e-4) / HZ},
                                           {speed - before + INS_C(0.01) / HZ, turn * speed, -G / HZ}};
        if (running)
        {
            ins_gps_ins_step(&nav, t_ns, INS_C(1.) / HZ, &increment);
        }
        else
        {
            ins_gps_ins_align_step(&align, t_ns, INS_C(1.) / HZ, &increment);
        }
        if (k % HZ == 0)
        {
            ins_gnss_fix_t fix = {
                t_ns, home, {v_n[0], v_n[1], v_n[2]}, {2, 2, 4}, {INS_C(0.1), INS_C(0.1), INS_C(0.2)}};
            fix.position.offset[0] = ned[0] / (radii[0] + home.anchor[2]);
            fix.position.offset[1] = ned[1] / ((radii[1] + home.anchor[2]) * ins_cos(home.anchor[0]));
            if (running && (t < 60 || t > 90))
            {
                ins_gps_ins_gnss(&nav, &fix);
            }
            if (!running && ins_gps_ins_align_gnss(&align, &fix, &start) == INS_OK)
            {
                running = ins_gps_ins_init(&nav, &cfg, &start) == INS_OK;
                printf("%3ld s: started, heading to %.1f deg\n", k / HZ, (double)start.sigma[2] * 57.2957795);
            }
            if (running && k % (10 * HZ) == 0)
            {
                ins_gps_ins_state_t s;
                ins_real error[3];
                ins_gps_ins_state(&nav, &s);
                ins_position_difference(&s.position, &fix.position, error);
                printf("%3ld s: %5.2f m off, sigma %5.2f m; gyro bias %.4f rad/s\n", k / HZ,
                       (double)ins_sqrt(error[0] * error[0] + error[1] * error[1]),
                       (double)ins_sqrt(s.P_p[0] + s.P_p[4]), (double)s.gyro_bias[2]);
            }
        }
    }
    printf("%lu samples, %lu fixes, %lu rests used\n", (unsigned long)nav.count.steps, (unsigned long)nav.count.fixes,
           (unsigned long)nav.count.rests);
    return running ? 0 : 1;
}
