/// \file   attitude.c
/// \brief  The path from increments to a quaternion: every form, fixed point, rates, block forms. Must be the same bits everywhere.
/// SPDX-License-Identifier: MIT
#include "report.h"

#define LARGE_STEPS 8 // beyond the range of the polynomials
#define LARGE_RAD   INS_C(3.0)
#define SMALL_RAD   INS_C(0.2)
#define LANES       3

static const ins_real start[4] = {INS_C(0.8), INS_C(0.48), INS_C(-0.36), INS_C(0.0)};

static void forms(void)
{
    same_begin("attitude");
    for (int form = 0; form < INS_CONING_FORM_COUNT; form++)
    {
        ins_attitude_t attitude;
        if (ins_attitude_init(&attitude, form, start) != INS_OK)
        {
            continue;
        }
        ins_real v[3];
        for (int k = 0; k < STEPS; k++)
        {
            random_reals(k < STEPS - LARGE_STEPS ? SMALL_RAD : LARGE_RAD, v, 3);
            same_integer((uint32_t)ins_attitude_step(&attitude, v));
            same_reals(attitude.q_nb, 4);
        }
        random_reals(SMALL_RAD, v, 3);
        same_integer((uint32_t)ins_attitude_turn_frame(&attitude, v));
        same_reals(attitude.q_nb, 4);
        random_reals(LARGE_RAD, v, 3);
        same_integer((uint32_t)ins_attitude_jump(&attitude, v));
        same_reals(attitude.q_nb, 4);
    }
    same_end();
}

static void small_step(void)
{
    ins_hist2_t lean;
    same_begin("hist2");
    same_integer((uint32_t)ins_hist2_init(&lean, start));
    same_reals(lean.q_nb, 4);
    for (int k = 0; k < STEPS; k++)
    {
        ins_real v[3];
        random_reals(k % LARGE_STEPS == 0 ? 3 * SMALL_RAD : SMALL_RAD, v, 3); // some are refused
        same_integer((uint32_t)ins_hist2_step(&lean, v));
        same_reals(lean.q_nb, 4);
    }
    same_end();
}

static void rotation_vectors(void)
{
    same_begin("coning");
    for (int form = 0; form < INS_CONING_FORM_COUNT; form++)
    {
        ins_real theta[3 * INS_CONING_SAMPLES_MAX];
        ins_real phi[3];
        random_reals(SMALL_RAD, theta, 3 * INS_CONING_SAMPLES_MAX);
        same_integer((uint32_t)ins_coning_phi(form, theta, phi));
        same_reals(phi, 3);
    }
    same_end();
}

static void fixed_point(void)
{
    static const int32_t q0[4] = {INT32_C(858993459), INT32_C(515396076), INT32_C(-386547057), 0};
    ins_q31_t narrow;
    ins_q31w_t wide;
    same_begin("q31");
    same_integer((uint32_t)ins_q31_init(&narrow, q0));
    same_integer((uint32_t)ins_q31w_init(&wide, q0));
    for (int k = 0; k < 2 * STEPS; k++)
    {
        int32_t dtheta[3];
        int32_t q[4];
        for (int i = 0; i < 3; i++)
        {
            dtheta[i] = (int32_t)(random_bits() & UINT32_C(0x3FFFFFFF)) - INT32_C(0x20000000);
        }
        same_integer((uint32_t)ins_q31_step(&narrow, dtheta));
        same_integer((uint32_t)ins_q31w_step(&wide, dtheta));
        ins_q31w_get(&wide, q);
        for (int i = 0; i < 4; i++)
        {
            same_integer((uint32_t)narrow.q_nb[i]);
            same_integer((uint32_t)q[i]);
            same_integer((uint32_t)((uint64_t)wide.q_nb[i] & UINT32_C(0xFFFFFFFF)));
        }
    }
    same_end();
}

static void sampled_rates(void)
{
    same_begin("rates");
    for (uint_least8_t order = 2; order <= INS_RATES_ORDER_MAX; order++)
    {
        ins_rates_t rates;
        same_integer((uint32_t)ins_rates_init(&rates, order, INS_C(0.02)));
        for (int k = 0; k < STEPS; k++)
        {
            ins_real w[3];
            ins_real dtheta[3];
            random_reals(2, w, 3);
            same_integer(
                (uint32_t)(k == STEPS / 2 ? ins_rates_bridge(&rates, 3, w, dtheta) : ins_rates_add(&rates, w, dtheta)));
            same_reals(dtheta, 3);
        }
    }
    for (uint_least8_t order = 1; order <= 3; order++)
    {
        static const ins_real delay[3] = {0, INS_C(126e-6), INS_C(260e-6)};
        ins_skew_t skew;
        same_integer((uint32_t)ins_skew_init(&skew, order, delay, INS_C(0.02)));
        for (int k = 0; k < STEPS; k++)
        {
            ins_real w[3];
            random_reals(2, w, 3);
            same_integer((uint32_t)ins_skew_add(&skew, w, w));
            same_reals(w, 3);
        }
    }
    same_end();
}

static void quaternions(void)
{
    same_begin("quat");
    for (int k = 0; k < STEPS; k++)
    {
        ins_real p[4];
        ins_real q[4];
        ins_real v[3];
        ins_real C[9];
        random_reals(1, p, 4);
        random_reals(k % 2 ? 500 : SMALL_RAD, v, 3);
        same_integer((uint32_t)ins_quat_from_rotvec(v, q));
        same_reals(q, 4);
        ins_quat_mul(p, q, q);
        ins_quat_rotate(q, v, v);
        same_reals(v, 3);
        same_integer((uint32_t)ins_quat_normalise(q));
        same_reals(q, 4);
        ins_quat_to_dcm(q, C);
        same_reals(C, 9);
        same_integer((uint32_t)ins_quat_from_dcm(C, p));
        ins_quat_normalise_approx(p);
        same_reals(p, 4);
    }
    same_end();
}

static void batch(void)
{
    ins_real state[INS_BATCH_ROWS * LANES];
    ins_real q[4 * LANES];
    ins_batch_t lanes;
    for (int i = 0; i < 4 * LANES; i++)
    {
        q[i] = start[i / LANES];
    }
    same_begin("batch");
    same_integer((uint32_t)ins_batch_init(&lanes, LANES, state, q));
    for (int k = 0; k < STEPS; k++)
    {
        ins_real dtheta[3 * LANES];
        random_reals(k % 16 == 9 ? LARGE_RAD : SMALL_RAD, dtheta, 3 * LANES);
        same_integer((uint32_t)ins_batch_step(&lanes, state, dtheta));
        same_reals(state, INS_BATCH_ROWS * LANES);
    }
    same_end();
}

void run_attitude(void)
{
    forms();
    small_step();
    rotation_vectors();
    fixed_point();
    sampled_rates();
    quaternions();
    batch();
}
