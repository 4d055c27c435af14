/// \file   vectors_attitude.c
/// \brief  coning.json, attitude_motion.json and quaternion.json on the target.
/// SPDX-License-Identifier: MIT
#include "tape.h"

#define PREVIOUS 3  // increments before the start
#define CHAINS   16 // forms run beside each other, at most

/// One form on its way through the increments.
typedef struct
{
    int form;
    unsigned held; // increments of an unfinished block
    ins_attitude_t history;
    ins_real block[3 * INS_CONING_SAMPLES_MAX];
    ins_real q[4];
} chain_t;

static chain_t chains[CHAINS];

static void start(chain_t* chain, int form, const ins_real q0[4], const ins_real previous[3 * PREVIOUS])
{
    chain->form = form;
    chain->held = 0;
    for (int i = 0; i < 4; i++)
    {
        chain->q[i] = q0[i];
    }
    if (!ins_coning_is_block(form))
    {
        check_true(ins_attitude_init(&chain->history, form, q0) == INS_OK);
        for (int i = 0; i < PREVIOUS; i++)
        {
            check_true(ins_attitude_step(&chain->history, previous + 3 * i) >= INS_OK);
        }
        for (int i = 0; i < 4; i++)
        {
            chain->history.q_nb[i] = q0[i];
        }
    }
}

static void step(chain_t* chain, const ins_real theta[3])
{
    if (!ins_coning_is_block(chain->form))
    {
        check_true(ins_attitude_step(&chain->history, theta) == INS_OK);
        for (int i = 0; i < 4; i++)
        {
            chain->q[i] = chain->history.q_nb[i];
        }
        return;
    }
    for (int i = 0; i < 3; i++)
    {
        chain->block[3 * chain->held + (unsigned)i] = theta[i];
    }
    if (++chain->held == (unsigned)ins_coning_samples(chain->form))
    {
        ins_real phi[3];
        ins_real dq[4];
        check_true(ins_coning_phi(chain->form, chain->block, phi) == INS_OK);
        check_true(ins_quat_from_rotvec(phi, dq) == INS_OK);
        ins_quat_mul(chain->q, dq, chain->q);
        ins_quat_normalise_approx(chain->q);
        chain->held = 0;
    }
}

/// Forms, start, increments, and the attitude that each form ends with.
static void increments(const char* name, ins_real limit)
{
    for (unsigned cases = tape_section(name, limit); cases > 0; cases--)
    {
        ins_real q0[4];
        ins_real theta[3 * PREVIOUS];
        const unsigned forms = (unsigned)tape_integer();
        const unsigned steps = (unsigned)tape_integer();
        tape_reals(q0, 4);
        tape_reals(theta, 3 * PREVIOUS);
        check_true(forms <= CHAINS);
        for (unsigned i = 0; i < forms && i < CHAINS; i++)
        {
            start(&chains[i], (int)tape_integer(), q0, theta);
        }
        for (unsigned k = 0; k < steps; k++)
        {
            tape_reals(theta, 3);
            for (unsigned i = 0; i < forms && i < CHAINS; i++)
            {
                step(&chains[i], theta);
            }
        }
        for (unsigned i = 0; i < forms && i < CHAINS; i++)
        {
            check_quat(chains[i].q);
        }
    }
    check_end();
}

/// The rotation vector of one interval, over its length.
static void rotation_vectors(void)
{
    for (unsigned cases = tape_section("coning.phi", INS_TOL(INS_C(1e-12), INS_C(5e-7))); cases > 0; cases--)
    {
        ins_real theta[3 * INS_CONING_SAMPLES_MAX];
        ins_real phi[3];
        const int form = (int)tape_integer();
        tape_reals(theta, 3 * (unsigned)ins_coning_samples(form));
        check_true(ins_coning_phi(form, theta, phi) == INS_OK);
        check_together(phi, 3, 0);
    }
    check_end();
}

static void sampled_rates(void)
{
    for (unsigned cases = tape_section("attitude_motion.rates", INS_TOL(INS_C(1e-12), INS_C(3e-6))); cases > 0; cases--)
    {
        ins_real q0[4];
        ins_rates_t rates;
        ins_attitude_t attitude;
        const uint_least8_t order = (uint_least8_t)tape_integer();
        const ins_real T = tape_real();
        const unsigned lead = (unsigned)tape_integer();
        const unsigned steps = (unsigned)tape_integer();
        tape_reals(q0, 4);
        check_true(ins_rates_init(&rates, order, T) == INS_OK);
        check_true(ins_attitude_init(&attitude, INS_CONING_HIST2_OPT, q0) == INS_OK);
        for (unsigned k = 0; k < steps; k++)
        {
            ins_real w[3];
            ins_real theta[3];
            tape_reals(w, 3);
            if (ins_rates_add(&rates, w, theta) == INS_OK)
            {
                check_true(ins_attitude_step(&attitude, theta) >= INS_OK);
            }
            for (int i = 0; i < 4 && k == lead; i++) // what came before is history only
            {
                attitude.q_nb[i] = q0[i];
            }
        }
        check_quat(attitude.q_nb);
    }
    check_end();
}

static void products(void)
{
    for (unsigned cases = tape_section("quaternion.products", INS_TOL(INS_C(1e-12), INS_C(4e-7))); cases > 0; cases--)
    {
        ins_real a[4];
        ins_real b[4];
        ins_real q[4];
        ins_real v[3];
        tape_reals(a, 4);
        tape_reals(b, 4);
        ins_quat_mul(a, b, q);
        check_quat(q);
        tape_reals(v, 3);
        ins_quat_rotate(a, v, v);
        check_together(v, 3, 1);
        tape_reals(v, 3);
        check_true(ins_quat_from_rotvec(v, q) == INS_OK);
        check_quat(q);
    }
    check_end();
}

static void euler_angles(void)
{
    for (unsigned cases = tape_section("quaternion.euler", INS_TOL(INS_C(1e-12), INS_C(4e-7))); cases > 0; cases--)
    {
        ins_real euler[3];
        ins_real q[4];
        ins_real C[9];
        tape_reals(euler, 3);
        ins_quat_from_euler(euler, q);
        check_quat(q);
        ins_quat_to_dcm(q, C);
        check_reals(C, 9);
        ins_quat_to_euler(q, euler);
        ins_quat_from_euler(euler, q);
        check_quat(q);
    }
    check_end();
}

void check_attitude(void)
{
    rotation_vectors();
    increments("coning.attitude", INS_TOL(INS_C(1e-12), INS_C(3e-7)));
    increments("attitude_motion.attitude", INS_TOL(INS_C(1e-12), INS_C(3e-6)));
    sampled_rates();
    products();
    euler_angles();
}
