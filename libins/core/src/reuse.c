/// \file   reuse.c
/// \brief  Three interleaved chains of three-sample blocks. Frame: b -> n. Unit: rad.
/// SPDX-License-Identifier: MIT
#include "ins/reuse.h"
#include "ins/coning.h"
#include "ins/ins_math.h"
#include "ins/quat.h"
#include "ins/vec.h"
#include "quat_internal.h"

#define STEP_MAX      INS_C(3.14159265358979324) ///< largest |component| of an increment [rad]
#define NORM2_TOL     INS_C(2e-3)                ///< 1e-3 in the norm
#define BLOCK_SAMPLES 3

ins_status_t ins_reuse_init(ins_reuse_t* self, int form, const ins_real q_nb[12])
{
    if (form != INS_CONING_BLOCK3_FIT && form != INS_CONING_BLOCK3_OPT)
    {
        return INS_E_RANGE;
    }
    ins_reuse_t start = {{{0}}, {{0}}, (uint_least8_t)form, 0, 0};
    for (int i = 0; i < BLOCK_SAMPLES; i++)
    {
        ins_real* q = start.q_nb[i];
        for (int j = 0; j < 4; j++)
        {
            q[j] = q_nb[4 * i + j];
        }
        if (!(ins_fabs(quat_norm2(q) - 1) <= NORM2_TOL) || ins_quat_normalise(q) != INS_OK)
        {
            return INS_E_RANGE;
        }
    }
    *self = start;
    return INS_OK;
}

ins_status_t ins_reuse_step(ins_reuse_t* self, const ins_real dtheta_b[3], ins_real q_nb[4])
{
    for (int i = 0; i < 3; i++)
    {
        if (!(ins_fabs(dtheta_b[i]) <= STEP_MAX))
        {
            return INS_E_RANGE;
        }
    }
    ins_status_t status = INS_S_START;
    if (self->count < BLOCK_SAMPLES - 1)
    {
        self->count++;
        for (int j = 0; j < 4; j++)
        {
            q_nb[j] = self->q_nb[self->count][j];
        }
    }
    else
    {
        ins_real theta[3 * BLOCK_SAMPLES];
        ins_vec_copy(self->theta[0], theta);
        ins_vec_copy(self->theta[1], theta + 3);
        ins_vec_copy(dtheta_b, theta + 6);
        ins_real phi[3];
        ins_real dq[4];
        ins_coning_phi(self->form, theta, phi);
        ins_quat_from_rotvec(phi, dq);
        ins_real* q = self->q_nb[self->slot];
        ins_quat_mul(q, dq, q);
        ins_quat_normalise_approx(q);
        self->slot = (uint_least8_t)((self->slot + 1) % BLOCK_SAMPLES);
        for (int j = 0; j < 4; j++)
        {
            q_nb[j] = q[j];
        }
        status = INS_OK;
    }
    ins_vec_copy(self->theta[1], self->theta[0]);
    ins_vec_copy(dtheta_b, self->theta[1]);
    return status;
}
