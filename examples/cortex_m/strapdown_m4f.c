/// \file   strapdown_m4f.c
/// \brief  Firmware for a Cortex-M4F: attitude, velocity and position in float, checked at the end. Frames: b -> n (NED). SI, rad.
/// SPDX-License-Identifier: MIT
#include "ins/ins.h"
#include "motion.inc"
#include <stdio.h>

#define GYRO_LSB          4.656612873077393e-10f // 2^-31 rad
#define ACCELEROMETER_LSB 3.725290298461914e-9f  // 2^-28 m/s
#define QUATERNION_LSB    9.313225746154785e-10f // 2^-30
#define TOL_ATTITUDE      1e-5f                  // rad
#define TOL_VELOCITY      5e-4f                  // m/s
#define TOL_POSITION      2e-3f                  // m

static float largest(const float v[3])
{
    const float pair = ins_fabs(v[0]) > ins_fabs(v[1]) ? ins_fabs(v[0]) : ins_fabs(v[1]);
    return pair > ins_fabs(v[2]) ? pair : ins_fabs(v[2]);
}

static void quaternion(const int32_t counts[4], float q[4])
{
    for (int i = 0; i < 4; i++)
    {
        q[i] = (float)counts[i] * QUATERNION_LSB;
    }
}

int main(void)
{
    const ins_position_t place = {{MOTION_LATITUDE, 2.1f, MOTION_HEIGHT}, {0, 0, 0}};
    const float at_rest[3] = {0, 0, 0};
    float p[4];
    ins_strapdown_t s;
    quaternion(motion_start, p);
    if (INS_ABI_CHECK() != INS_OK || ins_selftest() != 0 ||
        ins_strapdown_init(&s, INS_CONING_HIST2_OPT, MOTION_PERIOD_S, p, at_rest, &place) != INS_OK)
    {
        puts("self-test failed");
        return 2;
    }
    for (int k = 0; k < MOTION_STEPS; k++)
    {
        ins_increment_t x;
        for (int i = 0; i < 3; i++)
        {
            x.theta_b[i] = (float)motion[k][i] * GYRO_LSB;
            x.v_b[i] = (float)motion[k][3 + i] * ACCELEROMETER_LSB;
        }
        if (ins_strapdown_step(&s, &x) < INS_OK)
        {
            puts("increment refused");
            return 2;
        }
    }
    const float* q = s.sculling.q_nb;
    float ned[3];
    quaternion(motion_end, p);
    const float turn[3] = {2 * (p[0] * q[1] - p[1] * q[0] - p[2] * q[3] + p[3] * q[2]),
                           2 * (p[0] * q[2] - p[2] * q[0] - p[3] * q[1] + p[1] * q[3]),
                           2 * (p[0] * q[3] - p[3] * q[0] - p[1] * q[2] + p[2] * q[1])};
    ins_position_difference(&place, &s.position, ned);
    printf("%d steps, errors: attitude %ld nrad, velocity %ld um/s, position %ld um\n", MOTION_STEPS,
           (long)(largest(turn) * 1e9f), (long)(largest(s.v_n) * 1e6f), (long)(largest(ned) * 1e6f));
    return largest(turn) < TOL_ATTITUDE && largest(s.v_n) < TOL_VELOCITY && largest(ned) < TOL_POSITION ? 0 : 1;
}
