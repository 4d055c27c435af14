/// \file   main.c
/// \brief  Attitude from angle increments: a turn of 0.5 rad/s about a fixed axis for 10 s, and how far off the result is. Unit: rad.
/// SPDX-License-Identifier: MIT
#include "ins/ins.h"
#include <stdio.h>

#define STEPS    1000
#define PERIOD_S INS_C(0.01)
#define TOL_RAD  INS_TOL(1e-12, 5e-6)

int main(void)
{
    const ins_real w_ib_b[3] = {INS_C(0.3), INS_C(0.), INS_C(0.4)}; // rad/s
    const ins_real level[4] = {1, 0, 0, 0};
    if (INS_ABI_CHECK() != INS_OK || ins_selftest() != 0)
    {
        puts("this is not the library of these headers, or it computes wrongly");
        return 1;
    }
    ins_attitude_t attitude;
    ins_attitude_init(&attitude, INS_CONING_HIST2_OPT, level);
    const ins_real dtheta_b[3] = {w_ib_b[0] * PERIOD_S, w_ib_b[1] * PERIOD_S,
                                  w_ib_b[2] * PERIOD_S}; // your gyro's increment
    for (int k = 0; k < STEPS; k++)
    {
        ins_attitude_step(&attitude, dtheta_b);
    }

    const ins_real whole[3] = {w_ib_b[0] * STEPS * PERIOD_S, w_ib_b[1] * STEPS * PERIOD_S,
                               w_ib_b[2] * STEPS * PERIOD_S};
    const ins_real* q = attitude.q_nb;
    ins_real p[4];
    ins_real error = 0;
    ins_quat_from_rotvec(whole, p);
    const ins_real d[3] = {p[0] * q[1] - p[1] * q[0] - p[2] * q[3] + p[3] * q[2],
                           p[0] * q[2] - p[2] * q[0] - p[3] * q[1] + p[1] * q[3],
                           p[0] * q[3] - p[3] * q[0] - p[1] * q[2] + p[2] * q[1]};
    for (int i = 0; i < 3; i++)
    {
        error += 2 * ins_fabs(d[i]);
    }
    printf("q_nb = %.9f %.9f %.9f %.9f, error %.1e rad\n", (double)q[0], (double)q[1], (double)q[2], (double)q[3],
           (double)error);
    return error <= TOL_RAD ? 0 : 1;
}
