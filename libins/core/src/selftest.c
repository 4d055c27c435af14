/// \file   selftest.c
/// \brief  Known answers of the attitude path. Unit: rad.
///
/// The motion: a cone of 0.15 rad turned in 12 increments {X, -C sin(30 deg k), C cos(30 deg k)}. One turn brings the body back but for the
/// answers below, computed with 40 digits; without a coning term the first of them would be -1.5e-3.
/// SPDX-License-Identifier: MIT
#include "ins/selftest.h"
#include "ins/attitude.h"
#include "ins/fiter.h"
#include "ins/ins_math.h"
#include "ins/q31.h"
#include "ins/rates.h"
#include "ins/version.h"

#define TURN      12 ///< increments a turn
#define CONE_X    INS_C(-0.0058794)
#define CONE_C    INS_C(0.0774)
#define TOL_STEP  INS_TOL(1e-14, 1e-6F)
#define TOL_SUM   INS_TOL(1e-13, 2e-5F)
#define TOL_UNITS 4 ///< of Q30

/// Largest difference of components.
static ins_real distance(const ins_real a[4], const ins_real b[4])
{
    ins_real largest = 0;
    for (int i = 0; i < 4; i++)
    {
        const ins_real d = ins_fabs(a[i] - b[i]);
        largest = d <= largest ? largest : d; // NaN stays
    }
    return largest;
}

static ins_real sine(int k)
{
    static const ins_real table[TURN / 2] = {
        0, INS_C(0.5), INS_C(0.866025403784438647), 1, INS_C(0.866025403784438647), INS_C(0.5)};
    const int i = k % TURN;
    return i < TURN / 2 ? table[i] : -table[i - TURN / 2];
}

static void cone(int k, ins_real theta[3])
{
    theta[0] = CONE_X;
    theta[1] = -CONE_C * sine(k);
    theta[2] = CONE_C * sine(k + TURN / 4);
}

/// In slow coning every form of n increments needs sum of c_ij (j - i) = n^3 / 12, n = 1 for the history forms; without history 0.
static int coning_fails(void)
{
    for (int form = INS_CONING_HIST1; form < INS_CONING_FORM_COUNT; form++)
    {
        const int n = ins_coning_samples(form);
        ins_real sum = 0;
        for (int i = 0; i < n; i++)
        {
            for (int j = i + 1; j < n; j++)
            {
                ins_real theta[3 * INS_CONING_SAMPLES_MAX] = {0};
                ins_real phi[3];
                theta[3 * i] = 1;
                theta[3 * j + 1] = 1;
                if (ins_coning_phi(form, theta, phi) != INS_OK)
                {
                    return 1;
                }
                sum += (ins_real)(j - i) * phi[2];
            }
        }
        const int span = ins_coning_is_block(form) ? n * n * n : 1;
        if (!(ins_fabs(sum - (ins_real)span / 12) <= TOL_SUM))
        {
            return 1;
        }
    }
    return 0;
}

static const ins_real level[4] = {1, 0, 0, 0};

static int step_fails(void)
{
    static const ins_real answer[4] = {INS_C(0.999999999337243769), INS_C(0.0000359982936725065236),
                                       INS_C(-0.00000384920586161254373), INS_C(0.00000384953606931078773)};
    ins_attitude_t a;
    ins_status_t worst = ins_attitude_init(&a, INS_CONING_HIST2_OPT, level);
    for (int k = 0; k < TURN + 2; k++)
    {
        ins_real theta[3];
        cone(k, theta);
        const ins_status_t status = ins_attitude_step(&a, theta);
        worst = status < worst ? status : worst;
        for (int i = 0; i < 4 && k == 1; i++) // history so far
        {
            a.q_nb[i] = level[i];
        }
    }
    return worst < 0 || !(distance(a.q_nb, answer) <= TOL_STEP);
}

static int fiter_fails(void)
{
    static const ins_real answer[4] = {INS_C(0.999999997370273256), INS_C(0.0000717068187777523716),
                                       INS_C(-0.00000766769256662780133), INS_C(0.00000766760152769874482)};
    ins_fiter_t f;
    ins_status_t worst = ins_fiter_init(&f, INS_FITER_HIST3, 1, level);
    for (int k = TURN - 1; k < 2 * TURN + 2; k++)
    {
        ins_real theta[3];
        cone(k, theta);
        const ins_status_t status = ins_fiter_step(&f, theta);
        worst = status < worst ? status : worst;
        for (int i = 0; i < 4 && k == TURN + 1; i++) // history so far
        {
            f.q_nb[i] = level[i];
        }
    }
    return worst < 0 || !(distance(f.q_nb, answer) <= TOL_STEP);
}

/// Order n integrates k^(n-1) exactly: over [4, 5] that is (5^n - 4^n) / n.
static int rates_fail(void)
{
    static const ins_real answer[INS_RATES_ORDER_MAX + 1] = {
        0, 0, INS_C(4.5), INS_C(20.333333333333333), INS_C(92.25), INS_C(420.2)};
    for (int order = 2; order <= INS_RATES_ORDER_MAX; order++)
    {
        ins_rates_t r;
        ins_real theta[3] = {0, 0, 0};
        ins_status_t status = ins_rates_init(&r, (uint_least8_t)order, 1);
        for (int k = 0; k <= 5 && status >= 0; k++)
        {
            ins_real w[3] = {1, 1, 1};
            for (int i = 1; i < order; i++)
            {
                w[1] *= (ins_real)k;
            }
            status = ins_rates_add(&r, w, theta);
        }
        if (status != INS_OK || !(ins_fabs(theta[0] - 1) <= TOL_SUM) ||
            !(ins_fabs(theta[1] / answer[order] - 1) <= TOL_SUM))
        {
            return 1;
        }
    }
    return 0;
}

static int fixed_fails(void)
{
    static const int32_t sines[TURN / 2] = {0, 83107617, 143946615, 166215234, 143946615, 83107617}; // C sin, Q31
    static const int32_t answer[4] = {1073741823, 38653, -4133, 4133};
    static const int32_t level_q30[4] = {INS_Q31_ONE, 0, 0, 0};
    ins_q31_t a;
    ins_status_t worst = ins_q31_init(&a, level_q30);
    for (int k = 0; k < TURN + 2; k++)
    {
        const int c = (k + TURN / 4) % TURN;
        const int s = k % TURN;
        const int32_t theta[3] = {-12625915, s < TURN / 2 ? -sines[s] : sines[s - TURN / 2],
                                  c < TURN / 2 ? sines[c] : -sines[c - TURN / 2]};
        const ins_status_t status = ins_q31_step(&a, theta);
        worst = status < worst ? status : worst;
        for (int i = 0; i < 4 && k == 1; i++)
        {
            a.q_nb[i] = level_q30[i];
        }
    }
    int off = worst < 0;
    for (int i = 0; i < 4; i++)
    {
        const int32_t d = a.q_nb[i] - answer[i];
        off |= d > TOL_UNITS || d < -TOL_UNITS;
    }
    return off;
}

unsigned ins_selftest(void)
{
    unsigned failed = 0;
    failed |= INS_ABI_CHECK() != INS_OK ? INS_SELFTEST_ABI : 0;
    failed |= coning_fails() ? INS_SELFTEST_CONING : 0;
    failed |= step_fails() ? INS_SELFTEST_STEP : 0;
    failed |= fiter_fails() ? INS_SELFTEST_FITER : 0;
    failed |= rates_fail() ? INS_SELFTEST_RATES : 0;
    failed |= fixed_fails() ? INS_SELFTEST_FIXED : 0;
    return failed;
}
