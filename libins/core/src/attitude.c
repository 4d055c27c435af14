/// \file   attitude.c
/// \brief  Attitude state from angle increments. Frame: b -> n. Unit: rad.
/// SPDX-License-Identifier: MIT
#include "ins/attitude.h"
#include "attitude_internal.h"
#include "ins/ins_math.h"
#include "ins/quat.h"

#define NORM_TOL_INIT INS_C(1e-3)

ins_status_t ins_attitude_init(ins_attitude_t* self, int form, const ins_real q_nb[4])
{
    ins_real q[4] = {q_nb[0], q_nb[1], q_nb[2], q_nb[3]};
    const ins_real norm = ins_sqrt(quat_norm2(q));
    if (ins_coning_samples(form) == 0 || ins_coning_is_block(form) || !(ins_fabs(norm - 1) <= NORM_TOL_INIT) ||
        ins_quat_normalise(q) != INS_OK)
    {
        return INS_E_RANGE;
    }
    const ins_attitude_t start = {{q[0], q[1], q[2], q[3]}, {{0}}, (uint_least8_t)form, 0};
    *self = start;
    return INS_OK;
}

ins_status_t ins_attitude_step(ins_attitude_t* self, const ins_real dtheta_b[3])
{
    // The default form under way, its coefficients folded in; everything else is done by the general step, to the same bits.
    static const ins_coning_row_t row = CONING_ROW_HIST2_OPT;
    if (self->form == INS_CONING_HIST2_OPT && self->count == 2)
    {
        const ins_real theta[3] = {dtheta_b[0], dtheta_b[1], dtheta_b[2]};
        ins_real phi[3];
        rotation_vector(self, &row, theta, phi);
        const ins_real u = ins_vec_dot(phi, phi);
        if (u <= HALF_U_MAX)
        {
            attitude_turn(self->q_nb, half_cos_and_half(u), half_sinc(u), phi);
            attitude_keep(self, theta, row.samples);
            return INS_OK;
        }
    }
    return ins_attitude_step_any(self, dtheta_b);
}

ins_status_t ins_attitude_turn_frame(ins_attitude_t* self, const ins_real dzeta_n[3])
{
    const ins_real back[3] = {-dzeta_n[0], -dzeta_n[1], -dzeta_n[2]};
    ins_real dq[4];
    if (ins_quat_from_rotvec(back, dq) != INS_OK)
    {
        return INS_E_RANGE;
    }
    quat_mul(dq, self->q_nb, self->q_nb);
    ins_quat_normalise_approx(self->q_nb);
    return INS_OK;
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
