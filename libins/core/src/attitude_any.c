/// \file   attitude_any.c
/// \brief  The general attitude step: any form, start-up, large increments, refusals. Frame: b -> n. Unit: rad.
/// SPDX-License-Identifier: MIT
#include "attitude_internal.h"
#include "ins/ins_math.h"

#define STEP_MAX INS_C(3.14159265358979324) ///< largest |component| of an increment [rad]

const ins_coning_row_t* ins_attitude_row(const ins_attitude_t* self)
{
    // At start-up: ONE, HIST1, then the shorter form of the same kind (up to HIST3_OPT, FIT and OPT alternate in the enumeration).
    static const int first[] = {INS_CONING_ONE, INS_CONING_HIST1};
    const ins_coning_row_t* row = &ins_coning_rows[self->form];
    if (self->count >= row->samples - 1)
    {
        return row;
    }
    return &ins_coning_rows[self->count < 2 ? first[self->count] : self->form - 2];
}

ins_status_t ins_attitude_step_any(ins_attitude_t* self, const ins_real dtheta_b[3])
{
    for (int i = 0; i < 3; i++)
    {
        if (!(ins_fabs(dtheta_b[i]) <= STEP_MAX))
        {
            return INS_E_RANGE;
        }
    }
    const ins_coning_row_t* row = ins_attitude_row(self);
    const int starting = row != &ins_coning_rows[self->form];
    self->count = (uint_least8_t)(self->count + starting);
    ins_real phi[3];
    rotation_vector(self, row, dtheta_b, phi);
    const ins_real u = ins_vec_dot(phi, phi);
    ins_real c = half_cos_and_half(u);
    ins_real s = half_sinc(u);
    if (u > HALF_U_MAX)
    {
        ins_half_angle(u, &c, &s);
        c += INS_C(0.5);
    }
    attitude_turn(self->q_nb, c, s, phi);
    attitude_keep(self, dtheta_b, INS_CONING_SAMPLES_MAX);
    return starting ? INS_S_START : INS_OK;
}
