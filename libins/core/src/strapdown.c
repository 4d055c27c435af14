/// \file   strapdown.c
/// \brief  The strapdown step in NED over WGS-84, earth terms at mid-step. Frames: b -> n. SI, rad.
/// SPDX-License-Identifier: MIT
#include "sculling_internal.h"
#include "strapdown_internal.h"

ins_status_t ins_strapdown_step(ins_strapdown_t* self, const ins_increment_t* increment)
{
    // The default form under way; everything else is done by the general step.
    ins_sculling_t* sculling = &self->sculling;
    if (sculling_is_default(sculling))
    {
        ins_real phi[3];
        ins_real dv[3];
        ins_real z[3];
        sculling_two(sculling, increment, phi, dv);
        const ins_real u = ins_vec_dot(phi, phi);
        // All of v_b is in each component of dv: one tells whether any is NaN or infinite.
        if (u + 0 * dv[0] <= HALF_U_MAX && strapdown_advance(self, dv, z) == INS_OK)
        {
            ins_real q[4];
            sculling_turn(sculling->q_nb, u, phi, q);
            strapdown_turn_n(z, q, sculling->q_nb);
            sculling_keep(sculling, increment);
            return strapdown_is_far(self) ? ins_strapdown_anchor(self) : INS_OK;
        }
    }
    return ins_strapdown_step_any(self, increment);
}
