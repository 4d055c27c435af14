/// \file   sculling.c
/// \brief  Sculling-corrected velocity increments, with the attitude step. Frames: b -> n. Units: rad, m/s.
/// SPDX-License-Identifier: MIT
#include "attitude_internal.h"
#include "sculling_internal.h"

/// 1 if the default form is under way with all its history.
static int is_default(const ins_sculling_t* self)
{
    return self->form == INS_CONING_HIST2_OPT && self->count == 2;
}

/// Rotation vector and velocity increment of the default form.
static void corrected(const ins_sculling_t* self, const ins_increment_t* now, ins_real phi[3], ins_real dv[3])
{
    static const ins_coning_row_t row = CONING_ROW_HIST2_OPT;
    const ins_real* c = row.c;
    const ins_real* t = now->theta_b;
    const ins_real* t1 = self->prev[0].theta_b;
    const ins_real* t2 = self->prev[1].theta_b;
    const ins_real* v = now->v_b;
    const ins_real* v1 = self->prev[0].v_b;
    const ins_real* v2 = self->prev[1].v_b;
    // a x t is also (a + t/2) x t: one vector serves both corrections.
    const ins_real a[3] = {c[0] * t1[0] + c[1] * t2[0] + INS_C(0.5) * t[0],
                           c[0] * t1[1] + c[1] * t2[1] + INS_C(0.5) * t[1],
                           c[0] * t1[2] + c[1] * t2[2] + INS_C(0.5) * t[2]};
    const ins_real b[3] = {c[0] * v1[0] + c[1] * v2[0], c[0] * v1[1] + c[1] * v2[1], c[0] * v1[2] + c[1] * v2[2]};
    phi[0] = t[0] + (a[1] * t[2] - a[2] * t[1]);
    phi[1] = t[1] + (a[2] * t[0] - a[0] * t[2]);
    phi[2] = t[2] + (a[0] * t[1] - a[1] * t[0]);
    dv[0] = v[0] + (a[1] * v[2] - a[2] * v[1]) + (b[1] * t[2] - b[2] * t[1]);
    dv[1] = v[1] + (a[2] * v[0] - a[0] * v[2]) + (b[2] * t[0] - b[0] * t[2]);
    dv[2] = v[2] + (a[0] * v[1] - a[1] * v[0]) + (b[0] * t[1] - b[1] * t[0]);
}

ins_status_t ins_sculling_step(ins_sculling_t* self, const ins_increment_t* increment, ins_real dv_b[3])
{
    // The default form under way; everything else is done by the general step.
    if (is_default(self))
    {
        ins_real phi[3];
        ins_real dv[3];
        corrected(self, increment, phi, dv);
        const ins_real u = ins_vec_dot(phi, phi);
        // All of v_b is in each component of dv: one tells whether any is NaN or infinite.
        if (u + 0 * dv[0] <= HALF_U_MAX)
        {
            ins_vec_copy(dv, dv_b);
            attitude_turn(self->q_nb, half_cos_and_half(u), half_sinc(u), phi);
            sculling_keep(self, increment);
            return INS_OK;
        }
    }
    return ins_sculling_step_any(self, increment, dv_b);
}
