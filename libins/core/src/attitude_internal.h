/// \file   attitude_internal.h
/// \brief  The parts of an attitude step. Frame: b -> n. Unit: rad.
///
/// q' = q (dq + (1 - |q|^2) / 2): the norm error of the old q is taken out through the scalar of dq, which costs three operations
/// less than scaling the product, and differs from it by |norm error| sin(|phi|/2) in attitude.
/// SPDX-License-Identifier: MIT
#ifndef INS_ATTITUDE_INTERNAL_H_INCLUDED
#define INS_ATTITUDE_INTERNAL_H_INCLUDED
#include "coning_internal.h"
#include "ins/attitude.h"
#include "quat_internal.h"
#include "rotvec_internal.h"

static inline void rotation_vector(const ins_attitude_t* self, const ins_coning_row_t* row, const ins_real theta[3],
                                   ins_real phi[3])
{
    ins_vec_copy(theta, phi);
    coning_add(row, theta, self->prev[0], self->prev[1], self->prev[2], phi);
}

/// q := q (dq + (1 - |q|^2) / 2), dq = {c - 1/2, s phi}: `c` comes with the 1/2 of that formula.
static inline void attitude_turn(ins_real q[4], ins_real c, ins_real s, const ins_real phi[3])
{
    const ins_real dq[4] = {c - INS_C(0.5) * quat_norm2(q), s * phi[0], s * phi[1], s * phi[2]};
    quat_mul(q, dq, q);
}

static inline void attitude_keep(ins_attitude_t* self, const ins_real theta[3], int samples)
{
    if (samples > 3)
    {
        ins_vec_copy(self->prev[1], self->prev[2]);
    }
    ins_vec_copy(self->prev[0], self->prev[1]);
    ins_vec_copy(theta, self->prev[0]);
}

/// The coefficients of the next step: the form's, or at start-up those of a form as long as the history.
const ins_coning_row_t* ins_attitude_row(const ins_attitude_t* self);

/// Any form, at start-up too, any size of increment; refuses what is out of range.
ins_status_t ins_attitude_step_any(ins_attitude_t* self, const ins_real dtheta_b[3]);

#endif // INS_ATTITUDE_INTERNAL_H_INCLUDED
