/// \file   attitude_m0.c
/// \brief  Firmware for a Cortex-M0: attitude from angle increments in 32-bit integers, checked at the end. Frames: b -> n. Unit: rad.
/// SPDX-License-Identifier: MIT
#include "ins/q31.h"
#include "motion.inc"
#include <stdio.h>

#define TOL_NRAD 60

/// Component of 2 conj(truth) q, in nrad.
static long nrad(int32_t a0, int32_t b0, int32_t a1, int32_t b1, int32_t a2, int32_t b2, int32_t a3, int32_t b3)
{
    const int64_t sum_q60 = (int64_t)a0 * b0 - (int64_t)a1 * b1 - (int64_t)a2 * b2 + (int64_t)a3 * b3;
    return (long)(((sum_q60 >> 28) * 2000000000) >> 32);
}

int main(void)
{
    ins_q31_t attitude;
    if (ins_q31_init(&attitude, motion_start) != INS_OK)
    {
        puts("start attitude refused");
        return 2;
    }
    for (int k = 0; k < MOTION_STEPS; k++)
    {
        if (ins_q31_step(&attitude, motion[k]) < INS_OK) // the first three are the gyro's
        {
            puts("increment refused");
            return 2;
        }
    }
    const int32_t* p = motion_end_inertial;
    const int32_t* q = attitude.q_nb;
    const long error[3] = {nrad(p[0], q[1], p[1], q[0], p[2], q[3], p[3], q[2]),
                           nrad(p[0], q[2], p[2], q[0], p[3], q[1], p[1], q[3]),
                           nrad(p[0], q[3], p[3], q[0], p[1], q[2], p[2], q[1])};
    printf("%d steps, attitude error %ld %ld %ld nrad\n", MOTION_STEPS, error[0], error[1], error[2]);
    for (int i = 0; i < 3; i++)
    {
        if (error[i] > TOL_NRAD || error[i] < -TOL_NRAD)
        {
            return 1;
        }
    }
    return 0;
}
