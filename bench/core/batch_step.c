/// \file   batch_step.c
/// \brief  A load for callgrind: N batch steps of 256 trajectories. At the end each must have the bits of its scalar twin.
/// SPDX-License-Identifier: MIT
#include "ins/ins.h"
#include <stdio.h>
#include <stdlib.h>

#define SAMPLES      16
#define TRAJECTORIES 256

static ins_real state[INS_BATCH_ROWS * TRAJECTORIES];
static ins_real q_nb[4 * TRAJECTORIES];
static ins_real increment[SAMPLES][3 * TRAJECTORIES];

/// 1 if trajectory i differs from the scalar step's.
static int differs(unsigned long steps, size_t i)
{
    const ins_real level[4] = {1, 0, 0, 0};
    ins_attitude_t attitude;
    ins_status_t status = ins_attitude_init(&attitude, INS_CONING_HIST2_OPT, level);
    for (unsigned long k = 0; k < steps && status >= INS_OK; k++)
    {
        const ins_real* row = increment[k % SAMPLES] + i;
        const ins_real dtheta_b[3] = {row[0], row[TRAJECTORIES], row[2 * TRAJECTORIES]};
        status = ins_attitude_step(&attitude, dtheta_b);
    }
    int found = status < INS_OK;
    for (size_t j = 0; j < 4; j++)
    {
        found |= !(attitude.q_nb[j] == state[j * TRAJECTORIES + i]);
    }
    return found;
}

int main(int argc, char** argv)
{
    const unsigned long steps = argc > 1 ? strtoul(argv[1], NULL, 10) : 1000;
    for (int i = 0; i < TRAJECTORIES; i++)
    {
        q_nb[i] = 1;
        for (int k = 0; k < SAMPLES; k++)
        {
            increment[k][i] = (ins_real)((k + i) % 5 - 2) * INS_C(0.01);
            increment[k][TRAJECTORIES + i] = (ins_real)((k + i) % 7 - 3) * INS_C(0.008);
            increment[k][2 * TRAJECTORIES + i] = (ins_real)((k + i) % 3 - 1) * INS_C(0.012);
        }
    }
    ins_batch_t batch;
    if (ins_batch_init(&batch, TRAJECTORIES, state, q_nb) != INS_OK)
    {
        return 1;
    }
    for (unsigned long k = 0; k < steps; k++)
    {
        if (ins_batch_step(&batch, state, increment[k % SAMPLES]) < 0)
        {
            return 1;
        }
    }
    for (size_t i = 0; i < TRAJECTORIES; i++)
    {
        if (differs(steps, i))
        {
            fprintf(stderr, "trajectory %zu differs from the scalar step after %lu steps\n", i, steps);
            return 1;
        }
    }
    printf("%.9g\n", (double)state[0]);
    return 0;
}
