/// \file   thesis.c
/// \brief  The thesis's attitude update, RK4 with norm feedback, ZXZ matrix. Frame: b -> n. Units: rad, rad/s, s.
/// SPDX-License-Identifier: MIT
#include "ins/thesis.h"
#include "ins/ins_math.h"
#include "ins/quat.h"
#include "ins/vec.h"
#include "quat_internal.h"

#define NORM_TOL  INS_C(1e-3)
#define THETA_MAX INS_C(1.0)                 ///< largest |component| of an increment [rad]: P is a series in it
#define TURN_MAX  INS_C(3.14159265358979324) ///< largest |component| of w h [rad], well inside RK4's region (2.8 * 2)

static int within(const ins_real v[3], ins_real limit)
{
    return ins_fabs(v[0]) <= limit && ins_fabs(v[1]) <= limit && ins_fabs(v[2]) <= limit;
}

static ins_status_t take_unit(const ins_real from[4], ins_real q[4])
{
    for (int i = 0; i < 4; i++)
    {
        q[i] = from[i];
    }
    return ins_fabs(ins_sqrt(quat_norm2(q)) - 1) <= NORM_TOL ? ins_quat_normalise(q) : INS_E_RANGE;
}

void ins_thesis_p(const ins_real theta_b[3], const ins_real prev_b[3], ins_real p[4])
{
    // P = {1 - S/8, theta (1/2 - S/48) - theta x prev / 24}, S = |theta|^2
    const ins_real S = ins_vec_dot(theta_b, theta_b);
    const ins_real k = INS_C(0.5) - S / 48;
    ins_real cross[3];
    ins_vec_cross(theta_b, prev_b, cross);
    p[0] = 1 - S / 8;
    p[1] = k * theta_b[0] - cross[0] / 24;
    p[2] = k * theta_b[1] - cross[1] / 24;
    p[3] = k * theta_b[2] - cross[2] / 24;
}

ins_status_t ins_thesis_init(ins_thesis_t* self, const ins_real q_nb[4])
{
    ins_real q[4];
    if (take_unit(q_nb, q) != INS_OK)
    {
        return INS_E_RANGE;
    }
    const ins_thesis_t start = {{q[0], q[1], q[2], q[3]}, {0}, 0};
    *self = start;
    return INS_OK;
}

ins_status_t ins_thesis_step(ins_thesis_t* self, const ins_real dtheta_b[3])
{
    if (!within(dtheta_b, THETA_MAX))
    {
        return INS_E_RANGE;
    }
    const ins_status_t status = self->count ? INS_OK : INS_S_START;
    ins_real p[4];
    ins_thesis_p(dtheta_b, self->prev, p);
    quat_mul(self->q_nb, p, self->q_nb);
    (void)ins_quat_normalise(self->q_nb); // |P| is in 0.6 .. 1.1 for increments in range
    ins_vec_copy(dtheta_b, self->prev);
    self->count = 1;
    return status;
}

ins_status_t ins_thesis_rk4_init(ins_thesis_rk4_t* self, ins_real feedback, ins_real step_s, const ins_real q_nb[4],
                                 const ins_real w_ib_b[3])
{
    ins_real q[4];
    if (!(feedback >= 0 && step_s > 0 && step_s - step_s == 0 && 2 * feedback * step_s < INS_THESIS_RK4_LIMIT) ||
        !within(w_ib_b, TURN_MAX / step_s) || take_unit(q_nb, q) != INS_OK)
    {
        return INS_E_RANGE;
    }
    const ins_thesis_rk4_t start = {{q[0], q[1], q[2], q[3]}, {w_ib_b[0], w_ib_b[1], w_ib_b[2]}, feedback, step_s};
    *self = start;
    return INS_OK;
}

/// out = q w / 2 + k (1 - |q|^2) q at q = q_nb + reach slope; `out` may be `slope`.
static void slope_at(const ins_thesis_rk4_t* self, ins_real reach, const ins_real slope[4], const ins_real w[3],
                     ins_real out[4])
{
    const ins_real half_w[4] = {0, INS_C(0.5) * w[0], INS_C(0.5) * w[1], INS_C(0.5) * w[2]};
    ins_real q[4];
    for (int i = 0; i < 4; i++)
    {
        q[i] = self->q_nb[i] + reach * slope[i];
    }
    const ins_real pull = self->feedback * (1 - quat_norm2(q));
    quat_mul(q, half_w, out);
    for (int i = 0; i < 4; i++)
    {
        out[i] += pull * q[i];
    }
}

ins_status_t ins_thesis_rk4_step(ins_thesis_rk4_t* self, const ins_real w_mid_b[3], const ins_real w_end_b[3])
{
    const ins_real h = self->step_s;
    if (!within(w_mid_b, TURN_MAX / h) || !within(w_end_b, TURN_MAX / h))
    {
        return INS_E_RANGE;
    }
    const ins_real* w[4] = {self->w_ib_b, w_mid_b, w_mid_b, w_end_b};
    const ins_real reach[4] = {0, INS_C(0.5) * h, INS_C(0.5) * h, h};
    const ins_real weight[4] = {h / 6, h / 3, h / 3, h / 6};
    ins_real slope[4] = {0, 0, 0, 0};
    ins_real change[4] = {0, 0, 0, 0};
    for (int stage = 0; stage < 4; stage++)
    {
        slope_at(self, reach[stage], slope, w[stage], slope);
        for (int i = 0; i < 4; i++)
        {
            change[i] += weight[stage] * slope[i];
        }
    }
    for (int i = 0; i < 4; i++)
    {
        self->q_nb[i] += change[i];
    }
    ins_vec_copy(w_end_b, self->w_ib_b);
    return INS_OK;
}

void ins_thesis_zxz(const ins_real angles[3], ins_real R[9])
{
    const ins_real sa = ins_sin(angles[0]);
    const ins_real ca = ins_cos(angles[0]);
    const ins_real sb = ins_sin(angles[1]);
    const ins_real cb = ins_cos(angles[1]);
    const ins_real sg = ins_sin(angles[2]);
    const ins_real cg = ins_cos(angles[2]);
    R[0] = ca * cg - cb * sa * sg;
    R[1] = sa * cg + cb * ca * sg;
    R[2] = sb * sg;
    R[3] = -ca * sg - cb * sa * cg;
    R[4] = -sa * sg + cb * ca * cg;
    R[5] = sb * cg;
    R[6] = sb * sa;
    R[7] = -sb * ca;
    R[8] = cb;
}
