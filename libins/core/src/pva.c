/// \file   pva.c
/// \brief  Position-velocity-acceleration filter: A = [1 T T^2/2; 0 1 T; 0 0 1], Q of white jerk.
/// SPDX-License-Identifier: MIT
#include "ins/pva.h"

ins_status_t ins_pva_init(ins_pva_t* self, const ins_real var[3])
{
    if (!(var[0] >= 0) || !(var[1] >= 0) || !(var[2] >= 0))
    {
        return INS_E_RANGE;
    }
    const ins_pva_t start = {{0}, {var[0], 0, 0, 0, var[1], 0, 0, 0, var[2]}, {0}};
    *self = start;
    return INS_OK;
}

ins_status_t ins_pva_predict(ins_pva_t* self, ins_real dt, ins_real q)
{
    if (!(dt >= 0) || !(q >= 0))
    {
        return INS_E_RANGE;
    }
    const ins_real half = dt * dt / 2;
    const ins_real A[9] = {1, dt, half, 0, 1, dt, 0, 0, 1};
    const ins_real q33 = q * dt;
    const ins_real q23 = q33 * dt / 2;
    const ins_real q22 = q33 * dt * dt / 3;
    const ins_real q13 = q33 * dt * dt / 6;
    const ins_real q12 = q23 * dt * dt / 4;
    const ins_real q11 = q12 * dt * 2 / 5;
    const ins_real Q[9] = {q11, q12, q13, q12, q22, q23, q13, q23, q33};
    ins_real work[INS_KALMAN_WORK(3)];
    ins_kalman_predict(3, self->x, self->P, A, Q, work);
    return INS_OK;
}

ins_status_t ins_pva_update(ins_pva_t* self, int what, ins_innovation_t* z)
{
    ins_real h[3] = {0};
    ins_real work[6];
    if (what < INS_PVA_POSITION || what > INS_PVA_ACCELERATION)
    {
        return INS_E_RANGE;
    }
    h[what] = 1;
    const ins_status_t status = ins_kalman_update(3, self->x, self->P, h, z, work);
    if (status == INS_OK)
    {
        self->K[0] = work[0];
        self->K[1] = work[1];
        self->K[2] = work[2];
    }
    return status;
}
