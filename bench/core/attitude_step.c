/// \file   attitude_step.c
/// \brief  A load for callgrind: N attitude steps with two previous increments, coning-optimal, renormalisation included.
/// Run twice with different N: the difference over the difference is the cost of a step, start-up subtracted.
/// SPDX-License-Identifier: MIT
#include "ins/ins.h"
#include <stdio.h>
#include <stdlib.h>

#define SAMPLES 16

int main(int argc, char** argv)
{
    const long steps = argc > 1 ? atol(argv[1]) : 1000;
    const ins_real level[4] = {1, 0, 0, 0};
    ins_real increment[SAMPLES][3];
    for (int i = 0; i < SAMPLES; i++)
    {
        increment[i][0] = (ins_real)(i % 5 - 2) * INS_C(0.01);
        increment[i][1] = (ins_real)(i % 7 - 3) * INS_C(0.008);
        increment[i][2] = (ins_real)(i % 3 - 1) * INS_C(0.012);
    }
    ins_attitude_t attitude;
    if (ins_attitude_init(&attitude, INS_CONING_HIST2_OPT, level) != INS_OK)
    {
        return 1;
    }
    for (long k = 0; k < steps; k++)
    {
        if (ins_attitude_step(&attitude, increment[k % SAMPLES]) < 0)
        {
            return 1;
        }
    }
    printf("%.9g\n", (double)attitude.q_nb[0]);
    return 0;
}
