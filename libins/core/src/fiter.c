/// \file   fiter.c
/// \brief  Rate polynomial through samples, and its quaternion by the limit of Picard's iteration. Frame: b -> n. Unit: rad.
/// SPDX-License-Identifier: MIT
#include "ins/fiter.h"
#include "ins/ins_math.h"
#include "ins/quat.h"
#include "ins/vec.h"
#include "quat_internal.h"

#define SAMPLES  INS_FITER_SAMPLES_MAX
#define NORM_TOL INS_C(1e-3)
#define STEP_MAX INS_C(3.14159265358979324)        ///< largest |component| of an increment, or of a rate times T [rad]
#define QUIET2   (INS_EPSILON * INS_EPSILON / 256) ///< |coefficient|^2 that does not move the sum any more

/// w(s) = sum w_j s^j, s = 0..1 over the interval solved for; w_j = sum weight[j][i] theta_i / denominator, theta_0 the newest.
/// Inverses of the matrices that integrate (HIST, BLOCK) or sample (RATE) s^j.
static const struct
{
    int_least16_t weight[SAMPLES][SAMPLES];
    uint_least8_t denominator;
    uint_least8_t samples;
} fits[INS_FITER_FORM_COUNT] = {
    [INS_FITER_HIST0] = {{{1}}, 1, 1},
    [INS_FITER_HIST1] = {{{1, 1}, {2, -2}}, 2, 2},
    [INS_FITER_HIST2] = {{{2, 5, -1}, {6, -6, 0}, {3, -6, 3}}, 6, 3},
    [INS_FITER_HIST3] = {{{3, 13, -5, 1}, {11, -9, -3, 1}, {9, -21, 15, -3}, {2, -6, 6, -2}}, 12, 4},
    [INS_FITER_HIST4] = {{{24, 154, -86, 34, -6},
                          {100, -50, -90, 50, -10},
                          {105, -270, 240, -90, 15},
                          {40, -140, 180, -100, 20},
                          {5, -20, 30, -20, 5}},
                         120,
                         5},
    [INS_FITER_RATE2] = {{{0, 1}, {1, -1}}, 1, 2},
    [INS_FITER_RATE3] = {{{0, 2, 0}, {1, 0, -1}, {1, -2, 1}}, 2, 3},
    [INS_FITER_RATE4] = {{{0, 6, 0, 0}, {2, 3, -6, 1}, {3, -6, 3, 0}, {1, -3, 3, -1}}, 6, 4},
    [INS_FITER_RATE5] =
        {{{0, 24, 0, 0, 0}, {6, 20, -36, 12, -2}, {11, -20, 6, 4, -1}, {6, -20, 24, -12, 2}, {1, -4, 6, -4, 1}}, 24, 5},
    [INS_FITER_BLOCK3] = {{{2, -7, 11}, {-18, 54, -36}, {27, -54, 27}}, 2, 3},
};

/// q(1) of q' = q w / 2, q(0) = 1. A pass of Picard's iteration over a series in s makes one more coefficient final; in the limit
/// (k + 1) q_(k+1) = 1/2 sum q_(k-j) w_j, which is written down without iterating. \return 0 if the series has not ended.
static int picard(ins_real w[SAMPLES][3], int n, ins_real q[4])
{
    ins_real last[SAMPLES][4] = {{1, 0, 0, 0}}; // q_k at k modulo n
    ins_real sum[4] = {1, 0, 0, 0};
    int quiet = 0;
    for (int k = 1; k <= INS_FITER_DEGREE && quiet < n; k++)
    {
        ins_real next[4] = {0, 0, 0, 0};
        for (int j = 0; j < n && j < k; j++)
        {
            const ins_real w_j[4] = {0, w[j][0], w[j][1], w[j][2]};
            ins_real product[4];
            quat_mul(last[(k - 1 - j) % n], w_j, product);
            for (int i = 0; i < 4; i++)
            {
                next[i] += product[i];
            }
        }
        for (int i = 0; i < 4; i++)
        {
            next[i] /= (ins_real)(2 * k);
            last[k % n][i] = next[i];
            sum[i] += next[i];
        }
        quiet = quat_norm2(next) <= QUIET2 ? quiet + 1 : 0;
    }
    for (int i = 0; i < 4; i++)
    {
        q[i] = sum[i];
    }
    return quiet == n;
}

/// theta[0] is the newest.
static ins_status_t fitted_turn(int form, ins_real theta[SAMPLES][3], ins_real dq[4])
{
    const int n = fits[form].samples;
    const ins_real unit = 1 / (ins_real)fits[form].denominator;
    ins_real w[SAMPLES][3] = {{0}};
    for (int i = 0; i < n; i++)
    {
        if (!(ins_fabs(theta[i][0]) <= STEP_MAX && ins_fabs(theta[i][1]) <= STEP_MAX &&
              ins_fabs(theta[i][2]) <= STEP_MAX))
        {
            return INS_E_RANGE;
        }
        for (int j = 0; j < n; j++)
        {
            ins_vec_add_scaled(w[j], unit * fits[form].weight[j][i], theta[i]);
        }
    }
    ins_real q[4];
    if (!picard(w, n, q))
    {
        return INS_E_RANGE;
    }
    for (int i = 0; i < 4; i++)
    {
        dq[i] = q[i];
    }
    return INS_OK;
}

int ins_fiter_samples(int form)
{
    return form >= 0 && form < INS_FITER_FORM_COUNT ? fits[form].samples : 0;
}

ins_status_t ins_fiter_turn(int form, const ins_real* theta_b, ins_real dq[4])
{
    const int n = ins_fiter_samples(form);
    ins_real newest_first[SAMPLES][3] = {{0}};
    for (int i = 0; i < n; i++)
    {
        ins_vec_copy(theta_b + 3 * (n - 1 - i), newest_first[i]);
    }
    return n == 0 ? INS_E_RANGE : fitted_turn(form, newest_first, dq);
}

static int reads_rates(int form)
{
    return form >= INS_FITER_RATE2 && form <= INS_FITER_RATE5;
}

ins_status_t ins_fiter_init(ins_fiter_t* self, int form, ins_real period_s, const ins_real q_nb[4])
{
    ins_real q[4] = {q_nb[0], q_nb[1], q_nb[2], q_nb[3]};
    const ins_real scale = reads_rates(form) ? period_s : 1;
    if (ins_fiter_samples(form) == 0 || form == INS_FITER_BLOCK3 || !(scale > 0 && scale - scale == 0) ||
        !(ins_fabs(ins_sqrt(quat_norm2(q)) - 1) <= NORM_TOL) || ins_quat_normalise(q) != INS_OK)
    {
        return INS_E_RANGE;
    }
    const ins_fiter_t start = {{q[0], q[1], q[2], q[3]}, {{0}}, scale, (uint_least8_t)form, 0};
    *self = start;
    return INS_OK;
}

ins_status_t ins_fiter_step(ins_fiter_t* self, const ins_real sample_b[3])
{
    const int held = self->count;
    const int wanted = fits[self->form].samples - 1;
    ins_real theta[SAMPLES][3] = {{0}};
    ins_vec_add_scaled(theta[0], self->scale, sample_b);
    for (int i = 1; i < SAMPLES; i++)
    {
        ins_vec_copy(self->prev[i - 1], theta[i]);
    }
    // At start-up the form of as many samples as there are. One sample of a rate spans nothing: it only has to be in range.
    const int rates = reads_rates(self->form);
    const int form = held >= wanted      ? self->form
                     : rates && held > 0 ? INS_FITER_RATE2 + held - 1
                                         : INS_FITER_HIST0 + held;
    ins_real dq[4];
    if (fitted_turn(form, theta, dq) != INS_OK)
    {
        return INS_E_RANGE;
    }
    if (!rates || held > 0)
    {
        quat_mul(self->q_nb, dq, self->q_nb);
        ins_quat_normalise_approx(self->q_nb);
    }
    for (int i = 0; i < SAMPLES - 1; i++)
    {
        ins_vec_copy(theta[i], self->prev[i]);
    }
    self->count = (uint_least8_t)(held < wanted ? held + 1 : held);
    return held < wanted ? INS_S_START : INS_OK;
}
