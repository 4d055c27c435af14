/// \file   batch.c
/// \brief  The attitude step over a structure of arrays, with the operations of the scalar step in the same order. Unit: rad.
/// SPDX-License-Identifier: MIT
#include "ins/batch.h"
#include "attitude_internal.h"
#include "ins/ins_math.h"

#define STEP_MAX INS_C(3.14159265358979324) ///< as in attitude_any.c
#define SMALL    INS_C(0.25) ///< three components and their coning term: |phi| <= 0.48, within HALF_U_MAX

/// First row of a set of three.
static size_t newest_row(const ins_batch_t* self)
{
    return self->newest ? 7 : 4;
}

static size_t oldest_row(const ins_batch_t* self)
{
    return self->newest ? 4 : 7;
}

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
        const ins_batch_t start = {n, 0, 0, 0};
        *self = start;
    }
    return status;
}

/// Trajectory i by the scalar step, for start-up and large increments. The new increment replaces the oldest.
static void step_one(const ins_batch_t* self, ins_real* state, const ins_real* dtheta_b, size_t i)
{
    const size_t n = self->n;
    ins_attitude_t one = {{0}, {{0}}, INS_CONING_HIST2_OPT, self->count};
    ins_real theta[3];
    for (size_t row = 0; row < 4; row++)
    {
        one.q_nb[row] = state[row * n + i];
    }
    for (size_t axis = 0; axis < 3; axis++)
    {
        one.prev[0][axis] = state[(newest_row(self) + axis) * n + i];
        one.prev[1][axis] = state[(oldest_row(self) + axis) * n + i];
        theta[axis] = dtheta_b[axis * n + i];
        state[(oldest_row(self) + axis) * n + i] = theta[axis];
    }
    (void)ins_attitude_step(&one, theta);
    for (size_t row = 0; row < 4; row++)
    {
        state[row * n + i] = one.q_nb[row];
    }
}

/// All trajectories in place, where none needs the range reduction of the scalar step.
static void step_all(size_t n, const ins_real* restrict theta, const ins_real* restrict newest,
                     ins_real* restrict oldest, ins_real* restrict q)
{
    static const ins_coning_row_t row = CONING_ROW_HIST2_OPT;
    for (size_t i = 0; i < n; i++)
    {
        const ins_real t[3] = {theta[i], theta[n + i], theta[2 * n + i]};
        const ins_real t1[3] = {newest[i], newest[n + i], newest[2 * n + i]};
        const ins_real t2[3] = {oldest[i], oldest[n + i], oldest[2 * n + i]};
        const ins_real p[4] = {q[i], q[n + i], q[2 * n + i], q[3 * n + i]};
        ins_real phi[3] = {t[0], t[1], t[2]};
        coning_add(&row, t, t1, t2, t2, phi);
        const ins_real u = ins_vec_dot(phi, phi);
        const ins_real s = half_sinc(u);
        const ins_real c = half_cos_and_half(u);
        const ins_real dq[4] = {c - INS_C(0.5) * quat_norm2(p), s * phi[0], s * phi[1], s * phi[2]};
        ins_real product[4];
        quat_mul(p, dq, product);
        q[i] = product[0];
        q[n + i] = product[1];
        q[2 * n + i] = product[2];
        q[3 * n + i] = product[3];
        oldest[i] = t[0];
        oldest[n + i] = t[1];
        oldest[2 * n + i] = t[2];
    }
}

/// 1 if a component is not within the limit. It does not stop at the first: so this is vector code too.
static int any_beyond(const ins_real* v, size_t length, ins_real limit)
{
    int beyond = 0;
    for (size_t i = 0; i < length; i++)
    {
        beyond |= !(ins_fabs(v[i]) <= limit);
    }
    return beyond;
}

ins_status_t ins_batch_step(ins_batch_t* self, ins_real* state, const ins_real* dtheta_b)
{
    const size_t n = self->n;
    const int large = any_beyond(dtheta_b, 3 * n, SMALL);
    if (large && any_beyond(dtheta_b, 3 * n, STEP_MAX))
    {
        return INS_E_RANGE;
    }
    self->large = (uint_least8_t)((self->large << 1 | large) & 7);
    if (self->count == 2 && self->large == 0)
    {
        step_all(n, dtheta_b, state + newest_row(self) * n, state + oldest_row(self) * n, state);
    }
    else
    {
        for (size_t i = 0; i < n; i++)
        {
            step_one(self, state, dtheta_b, i);
        }
    }
    self->newest = (uint_least8_t)!self->newest;
    if (self->count == 2)
    {
        return INS_OK;
    }
    self->count++;
    return INS_S_START;
}
