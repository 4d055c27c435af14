/// \file   gps_axis.c
/// \brief  GPS filter of one axis.
/// SPDX-License-Identifier: MIT
#include "ins/gps_axis.h"
#include "elementary_internal.h"
#include "ins/ins_math.h"
#include "singer_internal.h"

#define RAYLEIGH INS_C(0.27323954473516268615) ///< (4 - pi)/pi: variance of a Rayleigh variable of mean 1

ins_status_t ins_gps_axis_init(ins_gps_axis_t* self, const ins_gps_axis_config_t* cfg, const ins_real var[4])
{
    if (!(cfg->dt > 0) || !(cfg->tau_acceleration > 0) || !(cfg->tau_fix > 0) || !(cfg->sigma_acceleration >= 0) ||
        !(cfg->sigma_fix >= 0) || !(cfg->r > 0) || !(cfg->acceleration_max >= 0) || !(var[0] >= 0) || !(var[1] >= 0) ||
        !(var[2] >= 0) || !(var[3] >= 0) ||
        !(ins_fabs(1 - cfg->tau_acceleration / cfg->tau_fix) > INS_GPS_AXIS_TAU_RATIO_MIN))
    {
        return INS_E_RANGE;
    }
    ins_singer_t s;
    ins_real rest;
    ins_singer(cfg->dt, cfg->tau_acceleration, &s);
    const ins_real decay = ins_elementary_decay(cfg->dt / cfg->tau_fix, 0);
    (void)ins_elementary_decay(2 * cfg->dt / cfg->tau_fix, &rest);
    const ins_real Phi[16] = {1, s.p12, s.p13, 0, 0, 1, s.p23, 0, 0, 0, s.p33, 0, 0, 0, 0, decay};
    const ins_real Q[16] = {s.q11, s.q12, s.q13, 0, s.q12, s.q22, s.q23, 0,
                            s.q13, s.q23, s.q33, 0, 0,     0,     0,     cfg->sigma_fix * cfg->sigma_fix * rest};
    self->cfg = *cfg;
    for (unsigned i = 0; i < 16; i++)
    {
        self->Phi[i] = Phi[i];
        self->Q[i] = Q[i];
        self->P[i] = i % 5 == 0 ? var[i / 5] : 0;
    }
    for (unsigned i = 0; i < 4; i++)
    {
        self->x[i] = 0;
        self->K[i] = 0;
    }
    for (unsigned i = 0; i < 3; i++)
    {
        self->u[i] = s.u[i];
    }
    return INS_OK;
}

void ins_gps_axis_predict(ins_gps_axis_t* self)
{
    ins_real work[INS_KALMAN_WORK(4)];
    ins_real Q[16];
    const ins_real mean = self->x[2];
    const ins_real room = self->cfg.acceleration_max - ins_fabs(mean);
    const int current = self->cfg.acceleration_max > 0;
    ins_real v = self->cfg.sigma_acceleration * self->cfg.sigma_acceleration;
    if (current)
    {
        v = room > 0 ? RAYLEIGH * room * room : 0;
    }
    for (unsigned i = 0; i < 15; i++)
    {
        Q[i] = v * self->Q[i];
    }
    Q[15] = self->Q[15];
    ins_kalman_predict(4, self->x, self->P, self->Phi, Q, work);
    for (unsigned i = 0; current && i < 3; i++)
    {
        self->x[i] += self->u[i] * mean;
    }
}

ins_status_t ins_gps_axis_step(ins_gps_axis_t* self, ins_real z, ins_real* nis)
{
    static const ins_real h[4] = {1, 0, 0, 1};
    ins_real work[8];
    ins_gps_axis_predict(self);
    ins_innovation_t i = {z - self->x[0] - self->x[3], self->cfg.r, self->cfg.gate, 0};
    const ins_status_t status = ins_kalman_update(4, self->x, self->P, h, &i, work);
    if (status == INS_OK)
    {
        for (unsigned k = 0; k < 4; k++)
        {
            self->K[k] = work[k];
        }
    }
    if (nis)
    {
        *nis = i.nis;
    }
    return status;
}
