/// \file   sculling_step.c
/// \brief  A load for callgrind: N steps of coning, sculling and quaternion, two previous increments. As attitude_step.c.
/// SPDX-License-Identifier: MIT
#include "ins/ins.h"
#include <stdio.h>
#include <stdlib.h>

#define SAMPLES 16

int main(int argc, char** argv)
{
    const unsigned long steps = argc > 1 ? strtoul(argv[1], NULL, 10) : 1000;
    const ins_real level[4] = {1, 0, 0, 0};
    ins_increment_t increment[SAMPLES];
    for (int i = 0; i < SAMPLES; i++)
    {
        for (int axis = 0; axis < 3; axis++)
        {
            increment[i].theta_b[axis] = (ins_real)(i % (5 + axis) - 2) * INS_C(0.01);
            increment[i].v_b[axis] = (ins_real)(i % (7 - axis) - 3) * INS_C(0.02);
        }
    }
    ins_sculling_t sculling;
    if (ins_sculling_init(&sculling, INS_CONING_HIST2_OPT, level) != INS_OK)
    {
        return 1;
    }
    ins_real dv[3] = {0, 0, 0};
    for (unsigned long k = 0; k < steps; k++)
    {
        if (ins_sculling_step(&sculling, &increment[k % SAMPLES], dv) < 0)
        {
            return 1;
        }
    }
    printf("%.9g %.9g\n", (double)sculling.q_nb[0], (double)dv[0]);
    return 0;
}
