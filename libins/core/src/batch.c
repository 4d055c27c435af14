/// \file   batch.c
/// \brief  The attitude step over a structure of arrays, with the operations of the scalar step in the same order. Unit: rad.
/// SPDX-License-Identifier: MIT
#include "ins/batch.h"
#include "attitude_internal.h"
#include "batch_internal.h"
#include "ins/ins_math.h"

#define BATCH_LANES 8  ///< the vectors of today's machines divide it
#define BATCH_SUM   12 ///< values compared at once

ins_status_t ins_batch_init(ins_batch_t* self, size_t n, ins_real* state, const ins_real* q_nb)
{
    ins_status_t status = n > 0 ? INS_OK : INS_E_RANGE;
    for (int pass = 0; pass < 2 && status == INS_OK; pass++) // the first only looks
    {
        for (size_t i = 0; i < n && status == INS_OK; i++)
        {
            const ins_real q[4] = {q_nb[i], q_nb[n + i], q_nb[2 * n + i], q_nb[3 * n + i]};
            ins_attitude_t one;
            status = ins_attitude_init(&one, INS_CONING_HIST2_OPT, q);
            for (size_t row = 0; pass == 1 && row < INS_BATCH_ROWS; row++)
            {
                state[row * n + i] = row < 4 ? one.q_nb[row] : 0;
            }
        }
    }
    if (status == INS_OK)
    {
        const ins_batch_t start = {n, 0, 0, 4};
        *self = start;
    }
    return status;
}

/// The first n trajectories in place, where none needs the range reduction of the scalar step; rows are `pitch` apart. A pointer each
/// written row: compilers need not ask at run time whether they overlap.
static void step_wide(size_t n, size_t pitch, const ins_real* theta, const ins_real* newest, ins_real* restrict x2,
                      ins_real* restrict y2, ins_real* restrict z2, ins_real* restrict w, ins_real* restrict x,
                      ins_real* restrict y, ins_real* restrict z)
{
    static const ins_coning_row_t row = CONING_ROW_HIST2_OPT;
    for (size_t i = 0; i < n; i++)
    {
        const ins_real t[3] = {theta[i], theta[pitch + i], theta[2 * pitch + i]};
        const ins_real t1[3] = {newest[i], newest[pitch + i], newest[2 * pitch + i]};
        const ins_real t2[3] = {x2[i], y2[i], z2[i]};
        const ins_real p[4] = {w[i], x[i], y[i], z[i]};
        ins_real phi[3] = {t[0], t[1], t[2]};
        coning_add(&row, t, t1, t2, t2, phi);
        const ins_real u = ins_vec_dot(phi, phi);
        const ins_real s = half_sinc(u);
        const ins_real dq[4] = {half_cos_and_half(u) - INS_C(0.5) * quat_norm2(p), s * phi[0], s * phi[1], s * phi[2]};
        // quat_mul without its negations, which are operations of their own here.
        w[i] = p[0] * dq[0] - (p[2] * dq[2] + p[1] * dq[1] + p[3] * dq[3]);
        x[i] = p[1] * dq[0] - (p[3] * dq[2] - p[0] * dq[1] - p[2] * dq[3]);
        y[i] = p[2] * dq[0] + (p[0] * dq[2] + p[3] * dq[1] - p[1] * dq[3]);
        z[i] = p[3] * dq[0] + (p[1] * dq[2] - p[2] * dq[1] + p[0] * dq[3]);
        x2[i] = t[0];
        y2[i] = t[1];
        z2[i] = t[2];
    }
}

/// 0 if sums of magnitudes, far cheaper than each alone, prove that every one of the 3 n values is small.
static int may_be_large(const ins_real* v, size_t n)
{
    const size_t part = n / (BATCH_SUM / 3) & ~(size_t)(BATCH_LANES - 1);
    int small = 1;
    for (size_t i = 0; i < part; i++)
    {
        ins_real sum = ins_fabs(v[i]);
        for (size_t k = 1; k < BATCH_SUM; k++)
        {
            sum += ins_fabs(v[k * part + i]);
        }
        small = sum <= BATCH_SMALL ? small : 0;
    }
    const size_t rest = 3 * n - BATCH_SUM * part;
    return small == 0 || (rest > 0 && ins_batch_beyond(v + BATCH_SUM * part, rest, BATCH_SMALL));
}

ins_status_t ins_batch_step(ins_batch_t* self, ins_real* state, const ins_real* dtheta_b)
{
    const size_t n = self->n;
    if (self->count != 2 || self->large != 0 ||
        (may_be_large(dtheta_b, n) && ins_batch_beyond(dtheta_b, 3 * n, BATCH_SMALL)))
    {
        return ins_batch_step_any(self, state, dtheta_b);
    }
    const size_t whole = n & ~(size_t)(BATCH_LANES - 1);
    ins_real* old = state + batch_oldest(self) * n;
    step_wide(whole, n, dtheta_b, state + self->newest * n, old, old + n, old + 2 * n, state, state + n, state + 2 * n,
              state + 3 * n);
    if (whole != n)
    {
        ins_batch_one_by_one(self, state, dtheta_b, whole);
    }
    self->newest = batch_oldest(self);
    return INS_OK;
}
