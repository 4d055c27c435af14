/// \file   batch_internal.h
/// \brief  The parts of a batch step that its two paths share. Unit: rad.
/// SPDX-License-Identifier: MIT
#ifndef INS_BATCH_INTERNAL_H_INCLUDED
#define INS_BATCH_INTERNAL_H_INCLUDED
#include "ins/batch.h"

#define BATCH_SMALL INS_C(0.25) ///< three components and their coning term: |phi| <= 0.48, within HALF_U_MAX

/// First row of the set of three that holds the oldest increment, which the next replaces.
static inline uint_least8_t batch_oldest(const ins_batch_t* self)
{
    return (uint_least8_t)(4 + 7 - self->newest);
}

/// 1 if a value is not within the limit, or NaN.
int ins_batch_beyond(const ins_real* v, size_t length, ins_real limit);

/// Trajectories from `first` on by the scalar step.
void ins_batch_one_by_one(const ins_batch_t* self, ins_real* state, const ins_real* dtheta_b, size_t first);

/// Start-up and large increments too; refuses what is out of range.
ins_status_t ins_batch_step_any(ins_batch_t* self, ins_real* state, const ins_real* dtheta_b);

#endif // INS_BATCH_INTERNAL_H_INCLUDED
