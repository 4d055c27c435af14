/// \file   attitude_any.c
/// \brief  The general attitude step: any form, start-up, large increments, refusals. Frame: b -> n. Unit: rad.
/// SPDX-License-Identifier: MIT
#include "attitude_internal.h"
#include "ins/ins_math.h"

#define STEP_MAX INS_C(3.14159265358979324) ///< largest |component| of an increment [rad]

/// The form to use while fewer increments are held than `form` wants (FIT and OPT alternate in the enumeration).
static int start_up_form(int form, int held)
{
    static const int first[] = {INS_CONING_ONE, INS_CONING_HIST1};
    return held < 2 ? first[held] : form - 2;
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
    const ins_coning_row_t* row = &ins_coning_rows[self->form];
    const int starting = self->count < row->samples - 1;
    if (starting)
    {
        row = &ins_coning_rows[start_up_form(self->form, self->count)];
        self->count++;
    }
    ins_real phi[3];
    rotation_vector(self, row, dtheta_b, phi);
    const ins_real u = ins_vec_dot(phi, phi);
    ins_real c = HALF_COS_0 + INS_C(0.5) + half_cos_rest(u);
    ins_real s = half_sinc(u);
    if (u > HALF_U_MAX)
    {
        ins_half_angle(u, &c, &s);
        c += INS_C(0.5);
    }
    turn(self, c, s, phi, dtheta_b, INS_CONING_SAMPLES_MAX);
    return starting ? INS_S_START : INS_OK;
}
