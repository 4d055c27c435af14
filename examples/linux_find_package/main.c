/// \file   main.c
/// \brief  Strapdown navigation of an IMU's increments from standard input. Frames: b -> n (NED). SI, rad.
///
///     imu_strapdown LATITUDE_DEG LONGITUDE_DEG HEIGHT_M PERIOD_S < increments
///
/// A line is six numbers: angle increment x, y, z [rad] and velocity increment x, y, z [m/s], b = forward, right, down. It starts
/// level, heading north, at rest. Prints the last state.
/// SPDX-License-Identifier: MIT
#include "ins/ins.h"
#include <stdio.h>
#include <stdlib.h>

#define RAD_PER_DEG 0.01745329251994329577

int main(int argc, char** argv)
{
    if (argc != 5)
    {
        fputs("usage: imu_strapdown LATITUDE_DEG LONGITUDE_DEG HEIGHT_M PERIOD_S < increments\n", stderr);
        return 2;
    }
    if (INS_ABI_CHECK() != INS_OK)
    {
        fprintf(stderr, "imu_strapdown: %s\n", ins_status_text(INS_E_ABI));
        return 1;
    }
    const ins_real level[4] = {1, 0, 0, 0};
    const ins_real at_rest[3] = {0, 0, 0};
    const ins_position_t start = {
        {(ins_real)(atof(argv[1]) * RAD_PER_DEG), (ins_real)(atof(argv[2]) * RAD_PER_DEG), (ins_real)atof(argv[3])},
        {0, 0, 0}};
    ins_strapdown_t s;
    if (ins_strapdown_init(&s, INS_CONING_HIST2_OPT, (ins_real)atof(argv[4]), level, at_rest, &start) != INS_OK)
    {
        fputs("imu_strapdown: latitude, longitude, height or period is out of range\n", stderr);
        return 2;
    }
    double x[6];
    long line = 0;
    int got;
    while ((got = scanf("%lf %lf %lf %lf %lf %lf", &x[0], &x[1], &x[2], &x[3], &x[4], &x[5])) == 6)
    {
        const ins_increment_t increment = {{(ins_real)x[0], (ins_real)x[1], (ins_real)x[2]},
                                           {(ins_real)x[3], (ins_real)x[4], (ins_real)x[5]}};
        line++;
        if (ins_strapdown_step(&s, &increment) < INS_OK)
        {
            fprintf(stderr, "imu_strapdown: increment %ld: %s\n", line, ins_status_text(INS_E_RANGE));
            return 1;
        }
    }
    if (got != EOF)
    {
        fprintf(stderr, "imu_strapdown: increment %ld: six numbers are wanted\n", line + 1);
        return 1;
    }
    ins_real ned[3];
    ins_position_difference(&start, &s.position, ned);
    printf(
        "steps %ld  position %.6f %.6f %.6f m from the start  velocity %.6f %.6f %.6f m/s  q_nb %.9f %.9f %.9f %.9f\n",
        line, (double)ned[0], (double)ned[1], (double)ned[2], (double)s.v_n[0], (double)s.v_n[1], (double)s.v_n[2],
        (double)s.sculling.q_nb[0], (double)s.sculling.q_nb[1], (double)s.sculling.q_nb[2], (double)s.sculling.q_nb[3]);
    return 0;
}
