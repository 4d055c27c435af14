/// \file   dead_reckoning.c
/// \brief  Classic dead reckoning, and the extended filter with the state east, north, velocities, accelerations.
///
///     yaw rate h1 = c/V^2, c = vn ae - ve an;   distance h2 = T V;   V^2 = ve^2 + vn^2
///     dh1 = [(-an V^2 - 2 ve c)/V^4, (ae V^2 - 2 vn c)/V^4, vn/V^2, -ve/V^2] of (ve, vn, ae, an);   dh2 = [T ve/V, T vn/V]
/// SPDX-License-Identifier: MIT
#include "ins/dead_reckoning.h"
#include "elementary_internal.h"
#include "ins/ins_math.h"
#include "singer_internal.h"

#define ANGLE_MAX  INS_C(1000.0)
#define SINC_SMALL INS_C(1e-3) ///< x^4/120 is below 1e-14 there

ins_status_t ins_dead_reckoning_step(ins_real pose[3], ins_real distance, ins_real turn)
{
    const ins_real half = turn / 2;
    ins_real s;
    ins_real c;
    if (!(ins_fabs(turn) <= ANGLE_MAX) || !(ins_fabs(pose[2]) <= ANGLE_MAX) || !(ins_fabs(distance) <= INS_REAL_MAX))
    {
        return INS_E_RANGE;
    }
    if (ins_fabs(half) > SINC_SMALL)
    {
        ins_elementary_turn(half, &s, &c);
        distance *= s / half;
    }
    else
    {
        distance *= 1 - half * half / 6;
    }
    ins_elementary_turn(pose[2] + half, &s, &c);
    pose[0] += distance * s;
    pose[1] += distance * c;
    pose[2] = ins_elementary_wrap(pose[2] + turn);
    return INS_OK;
}

/// One axis of Phi and Q into the 6 x 6 matrices, in which an axis has every other row and column.
static void place(ins_dr_ekf_t* self, unsigned axis)
{
    ins_singer_t s;
    ins_singer(self->cfg.dt, self->cfg.tau[axis], &s);
    const ins_real v = self->cfg.sigma[axis] * self->cfg.sigma[axis];
    const ins_real phi[9] = {1, s.p12, s.p13, 0, 1, s.p23, 0, 0, s.p33};
    const ins_real q[9] = {s.q11, s.q12, s.q13, s.q12, s.q22, s.q23, s.q13, s.q23, s.q33};
    for (unsigned i = 0; i < 3; i++)
    {
        for (unsigned j = 0; j < 3; j++)
        {
            const unsigned at = 6 * (2 * i + axis) + 2 * j + axis;
            self->Phi[at] = phi[3 * i + j];
            self->Q[at] = v * q[3 * i + j];
        }
    }
}

ins_status_t ins_dr_ekf_init(ins_dr_ekf_t* self, const ins_dr_ekf_config_t* cfg, const ins_real x[6],
                             const ins_real var[6])
{
    if (!(cfg->dt > 0) || !(cfg->tau[0] > 0) || !(cfg->tau[1] > 0) || !(cfg->sigma[0] >= 0) || !(cfg->sigma[1] >= 0) ||
        !(cfg->r_rate > 0) || !(cfg->r_distance > 0) || !(cfg->v_zero > 0) || !(cfg->v_min >= cfg->v_zero) ||
        !(cfg->gate >= 0))
    {
        return INS_E_RANGE;
    }
    for (unsigned i = 0; i < 6; i++)
    {
        if (!(var[i] >= 0) || !(ins_fabs(x[i]) <= INS_REAL_MAX))
        {
            return INS_E_RANGE;
        }
    }
    static const ins_dr_ekf_t zero; // all 0
    *self = zero;
    self->cfg = *cfg;
    place(self, 0);
    place(self, 1);
    for (unsigned i = 0; i < 6; i++)
    {
        self->x[i] = x[i];
        self->P[7 * i] = var[i];
    }
    return INS_OK;
}

/// One measurement z whose prediction is h(x_0) + H (x - x_0), x_0 the predicted state.
static ins_status_t use(ins_dr_ekf_t* self, unsigned what, const ins_real H[6], const ins_real x0[6], ins_real v,
                        ins_real r)
{
    ins_real work[12];
    for (unsigned i = 0; i < 6; i++)
    {
        v -= H[i] * (self->x[i] - x0[i]);
    }
    ins_innovation_t z = {v, r, self->cfg.gate, 0};
    const ins_status_t status = ins_kalman_update(6, self->x, self->P, H, &z, work);
    self->nis[what - 1] = z.nis;
    self->used |= status == INS_OK ? what : 0;
    self->gated += status == INS_E_GATE;
    return status;
}

ins_status_t ins_dr_ekf_step(ins_dr_ekf_t* self, ins_real yaw_rate, ins_real distance)
{
    const ins_real T = self->cfg.dt;
    ins_real work[INS_KALMAN_WORK(6)];
    ins_real x0[6];
    ins_status_t status = INS_OK;
    if (!(ins_fabs(yaw_rate) <= ANGLE_MAX) || !(ins_fabs(distance) <= INS_REAL_MAX))
    {
        return INS_E_RANGE;
    }
    ins_kalman_predict(6, self->x, self->P, self->Phi, self->Q, work);
    for (unsigned i = 0; i < 6; i++)
    {
        x0[i] = self->x[i];
    }
    self->used = 0;
    self->nis[0] = 0;
    self->nis[1] = 0;
    const ins_real ve = x0[2];
    const ins_real vn = x0[3];
    const ins_real v2 = ve * ve + vn * vn;
    const ins_real v = ins_sqrt(v2);
    if (v >= self->cfg.v_min)
    {
        const ins_real rate = (vn * x0[4] - ve * x0[5]) / v2;
        const ins_real H[6] = {0, 0, (-x0[5] - 2 * ve * rate) / v2, (x0[4] - 2 * vn * rate) / v2, vn / v2, -ve / v2};
        status = use(self, INS_DR_RATE, H, x0, yaw_rate - rate, self->cfg.r_rate);
    }
    if (v >= self->cfg.v_zero)
    {
        const ins_real H[6] = {0, 0, T * ve / v, T * vn / v, 0, 0};
        const ins_status_t second = use(self, INS_DR_DISTANCE, H, x0, distance - T * v, self->cfg.r_distance);
        status = second != INS_OK ? second : status;
    }
    return status;
}
