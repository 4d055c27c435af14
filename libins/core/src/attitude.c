/// \file   attitude.c
/// \brief  Attitude state from angle increments. Frame: b -> n. Unit: rad.
///
/// q' = q (dq + (1 - |q|^2) / 2): the norm error of the old q is taken out through the scalar of dq, which costs three operations
/// less than scaling the product, and differs from it by |norm error| sin(|phi|/2) in attitude.
/// SPDX-License-Identifier: MIT
#include "ins/attitude.h"
#include "coning_internal.h"
#include "ins/ins_math.h"
#include "ins/quat.h"
#include "rotvec_internal.h"

#define STEP_MAX      INS_C(3.14159265358979324) ///< largest |component| of an increment [rad]
#define NORM_TOL_INIT INS_C(1e-3)

ins_status_t ins_attitude_init(ins_attitude_t* self, int form, const ins_real q_nb[4])
{
    ins_real q[4] = {q_nb[0], q_nb[1], q_nb[2], q_nb[3]};
    const ins_real norm = ins_sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (ins_coning_samples(form) == 0 || ins_coning_is_block(form) || !(ins_fabs(norm - 1) <= NORM_TOL_INIT) ||
        ins_quat_normalise(q) != INS_OK)
    {
        return INS_E_RANGE;
    }
    const ins_attitude_t start = {{q[0], q[1], q[2], q[3]}, {{0}}, (uint_least8_t)form, 0};
    *self = start;
    return INS_OK;
}

/// The form to use while fewer increments are held than `form` wants (FIT and OPT alternate in the enumeration).
static int start_up_form(int form, int held)
{
    static const int first[] = {INS_CONING_ONE, INS_CONING_HIST1};
    return held < 2 ? first[held] : form - 2;
}

ins_status_t ins_attitude_step(ins_attitude_t* self, const ins_real dtheta_b[3])
{
    const ins_coning_row_t* row = &ins_coning_rows[self->form];
    const int history = row->samples - 1;
    ins_status_t status = INS_OK;
    if (self->count < history)
    {
        row = &ins_coning_rows[start_up_form(self->form, self->count)];
        status = INS_S_START;
    }
    ins_real phi[3] = {dtheta_b[0], dtheta_b[1], dtheta_b[2]};
    coning_add(row, dtheta_b, self->prev[0], self->prev[1], self->prev[2], phi);

    ins_real* q = self->q_nb;
    const ins_real u = ins_vec_dot(phi, phi);
    const ins_real half_norm2 = INS_C(0.5) * (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    ins_real c;
    ins_real s;
    if (u <= HALF_U_MAX)
    {
        c = HALF_COS_0 + INS_C(0.5) + half_cos_rest(u) - half_norm2;
        s = half_sinc(u);
    }
    else // NaN too
    {
        for (int i = 0; i < 3; i++)
        {
            if (!(ins_fabs(dtheta_b[i]) <= STEP_MAX))
            {
                return INS_E_RANGE;
            }
        }
        ins_half_angle(u, &c, &s);
        c += INS_C(0.5) - half_norm2;
    }
    const ins_real dq[4] = {c, s * phi[0], s * phi[1], s * phi[2]};
    ins_quat_mul(q, dq, q);

    if (history > 2)
    {
        ins_vec_copy(self->prev[1], self->prev[2]);
    }
    if (history > 1)
    {
        ins_vec_copy(self->prev[0], self->prev[1]);
    }
    ins_vec_copy(dtheta_b, self->prev[0]);
    if (status != INS_OK)
    {
        self->count++;
    }
    return status;
}

ins_status_t ins_attitude_jump(ins_attitude_t* self, const ins_real phi_b[3])
{
    ins_real dq[4];
    if (ins_quat_from_rotvec(phi_b, dq) != INS_OK)
    {
        return INS_E_RANGE;
    }
    ins_quat_mul(self->q_nb, dq, self->q_nb);
    ins_quat_normalise_approx(self->q_nb);
    self->count = 0;
    return INS_OK;
}
