/// \file   sculling.c
/// \brief  Sculling-corrected velocity increments, with the attitude step. Frames: b -> n. Units: rad, m/s.
/// SPDX-License-Identifier: MIT
#include "sculling_internal.h"

ins_status_t ins_sculling_step(ins_sculling_t* self, const ins_increment_t* increment, ins_real dv_b[3])
{
    // The default form under way; everything else is done by the general step.
    if (sculling_is_default(self))
    {
        ins_real phi[3];
        ins_real dv[3];
        sculling_two(self, increment, phi, dv);
        const ins_real u = ins_vec_dot(phi, phi);
        // All of v_b is in each component of dv: one tells whether any is NaN or infinite.
        if (u + 0 * dv[0] <= HALF_U_MAX)
        {
            ins_vec_copy(dv, dv_b);
            sculling_turn(self->q_nb, u, phi, self->q_nb);
            sculling_keep(self, increment);
            return INS_OK;
        }
    }
    return ins_sculling_step_any(self, increment, dv_b);
}
