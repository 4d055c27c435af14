/// \file   batch_any.c
/// \brief  The general batch step: start-up, large increments, refusals. Unit: rad.
/// SPDX-License-Identifier: MIT
#include "batch_internal.h"
#include "ins/attitude.h"
#include "ins/ins_math.h"

#define STEP_MAX INS_C(3.14159265358979324) ///< as in attitude_any.c

int ins_batch_beyond(const ins_real* v, size_t length, ins_real limit)
{
    int beyond = 0;
    for (size_t i = 0; i < length; i++) // to the end: so this is vector code too
    {
        beyond |= !(ins_fabs(v[i]) <= limit);
    }
    return beyond;
}

/// Trajectory i. The new increment replaces the oldest.
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
        one.prev[0][axis] = state[(self->newest + axis) * n + i];
        one.prev[1][axis] = state[(batch_oldest(self) + axis) * n + i];
        theta[axis] = dtheta_b[axis * n + i];
        state[(batch_oldest(self) + axis) * n + i] = theta[axis];
    }
    (void)ins_attitude_step(&one, theta);
    for (size_t row = 0; row < 4; row++)
    {
        state[row * n + i] = one.q_nb[row];
    }
}

void ins_batch_one_by_one(const ins_batch_t* self, ins_real* state, const ins_real* dtheta_b, size_t first)
{
    for (size_t i = first; i < self->n; i++)
    {
        step_one(self, state, dtheta_b, i);
    }
}

ins_status_t ins_batch_step_any(ins_batch_t* self, ins_real* state, const ins_real* dtheta_b)
{
    if (ins_batch_beyond(dtheta_b, 3 * self->n, STEP_MAX))
    {
        return INS_E_RANGE;
    }
    const int large = ins_batch_beyond(dtheta_b, 3 * self->n, BATCH_SMALL);
    self->large = (uint_least8_t)((self->large << 1 | large) & 3);
    ins_batch_one_by_one(self, state, dtheta_b, 0);
    self->newest = batch_oldest(self);
    if (self->count == 2)
    {
        return INS_OK;
    }
    self->count++;
    return INS_S_START;
}
