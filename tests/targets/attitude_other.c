/// \file   attitude_other.c
/// \brief  Sample reuse, the thesis's update and RK4, functional iteration. Must be the same bits everywhere.
/// SPDX-License-Identifier: MIT
#include "report.h"

#define FITER_STEPS 12 // a step is some thousand operations
#define SMALL_RAD   INS_C(0.2)

static const ins_real level[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

static void reuse(void)
{
    same_begin("reuse");
    for (int form = INS_CONING_BLOCK3_FIT; form <= INS_CONING_BLOCK3_OPT; form++)
    {
        ins_reuse_t chains;
        same_integer((uint32_t)ins_reuse_init(&chains, form, level));
        for (int k = 0; k < STEPS; k++)
        {
            ins_real dtheta[3];
            ins_real q[4];
            random_reals(SMALL_RAD, dtheta, 3);
            same_integer((uint32_t)ins_reuse_step(&chains, dtheta, q));
            same_reals(q, 4);
        }
    }
    same_end();
}

static void thesis(void)
{
    ins_thesis_t second;
    ins_thesis_rk4_t rk4;
    ins_real w[3];
    same_begin("thesis");
    same_integer((uint32_t)ins_thesis_init(&second, level));
    random_reals(2, w, 3);
    same_integer((uint32_t)ins_thesis_rk4_init(&rk4, 10, INS_C(0.04), level, w));
    for (int k = 0; k < STEPS; k++)
    {
        ins_real middle[3];
        ins_real end[3];
        random_reals(SMALL_RAD, w, 3);
        random_reals(2, middle, 3);
        random_reals(2, end, 3);
        same_integer((uint32_t)ins_thesis_step(&second, w));
        same_reals(second.q_nb, 4);
        same_integer((uint32_t)ins_thesis_rk4_step(&rk4, middle, end));
        same_reals(rk4.q_nb, 4);
    }
    same_end();
}

static void functional_iteration(void)
{
    same_begin("fiter");
    for (int form = 0; form < INS_FITER_BLOCK3; form++)
    {
        const int is_rate = form >= INS_FITER_RATE2;
        ins_fiter_t fiter;
        same_integer((uint32_t)ins_fiter_init(&fiter, form, INS_C(0.05), level));
        for (int k = 0; k < FITER_STEPS; k++)
        {
            ins_real sample[3];
            random_reals(is_rate ? 2 : INS_C(0.1), sample, 3);
            same_integer((uint32_t)ins_fiter_step(&fiter, sample));
            same_reals(fiter.q_nb, 4);
        }
    }
    ins_real block[9];
    ins_real dq[4] = {0, 0, 0, 0};
    random_reals(INS_C(0.05), block, 9);
    same_integer((uint32_t)ins_fiter_turn(INS_FITER_BLOCK3, block, dq));
    same_reals(dq, 4);
    same_end();
}

void run_attitude_other(void)
{
    reuse();
    thesis();
    functional_iteration();
}
