/// \file   gps_dr_paper.c
/// \brief  The GPS/DR paper's two local filters and its switch.
/// SPDX-License-Identifier: MIT
#include "ins/gps_dr_paper.h"
#include "ins/ins_math.h"

#define V_MIN INS_C(0.5) ///< [m/s]

void ins_gps_dr_paper_config_default(ins_gps_dr_paper_config_t* cfg, int reading)
{
    static const ins_gps_dr_paper_config_t printed = {
        {1, 5, 100, 1, 5, 9, 0, 0},
        {INS_C(0.1), {5, 5}, {1, 1}, INS_C(2.5e-5), INS_C(1e-5), INS_C(1e-3), INS_C(1e-3), 0},
        {4, 0, 4, INS_SWITCH_BACK_PAPER},
        100,
        1};
    *cfg = printed;
    if (reading == INS_GPS_DR_PAPER_CORRECTED)
    {
        cfg->dr.v_min = V_MIN;
        cfg->choice.gate = INS_KALMAN_GATE2_99;
        cfg->choice.back = INS_SWITCH_BACK_GOOD;
    }
}

/// Variances at the first fix [position, velocity, acceleration, fix error].
static void prior(const ins_gps_dr_paper_config_t* cfg, ins_real var[4])
{
    var[0] = cfg->axis.r + cfg->axis.sigma_fix * cfg->axis.sigma_fix;
    var[1] = cfg->var_velocity;
    var[2] = cfg->var_acceleration;
    var[3] = cfg->axis.sigma_fix * cfg->axis.sigma_fix;
}

ins_status_t ins_gps_dr_paper_init(ins_gps_dr_paper_t* self, const ins_gps_dr_paper_config_t* cfg)
{
    static const ins_gps_dr_paper_t zero; // all 0
    static const ins_real nothing[6] = {0};
    ins_gps_dr_paper_t made;
    ins_real var[4];
    made = zero;
    prior(cfg, var);
    if (ins_gps_axis_init(&made.axis[0], &cfg->axis, var) != INS_OK ||
        ins_dr_ekf_init(&made.dr, &cfg->dr, nothing, nothing) != INS_OK ||
        ins_switch_init(&made.choice, &cfg->choice) != INS_OK)
    {
        return INS_E_RANGE;
    }
    made.axis[1] = made.axis[0];
    made.cfg = *cfg;
    *self = made;
    return INS_OK;
}

ins_status_t ins_gps_dr_paper_step(ins_gps_dr_paper_t* self, ins_real yaw_rate, ins_real distance)
{
    return self->started ? ins_dr_ekf_step(&self->dr, yaw_rate, distance) : INS_OK;
}

/// Dead reckoning goes on from what the fixes say.
static void correct_dr(ins_gps_dr_paper_t* self)
{
    for (unsigned i = 0; i < 36; i++)
    {
        self->dr.P[i] = 0;
    }
    for (unsigned i = 0; i < 6; i++)
    {
        const ins_gps_axis_t* const axis = &self->axis[i % 2];
        self->dr.x[i] = axis->x[i / 2];
        for (unsigned j = i % 2; j < 6; j += 2)
        {
            self->dr.P[6 * i + j] = axis->P[4 * (i / 2) + j / 2];
        }
    }
}

ins_status_t ins_gps_dr_paper_fix(ins_gps_dr_paper_t* self, const ins_gps_dr_fix_t* fix)
{
    const ins_real z[2] = {fix->east, fix->north};
    ins_status_t status = INS_OK;
    self->nis = 0;
    const int usable = ins_fabs(z[0]) <= INS_REAL_MAX && ins_fabs(z[1]) <= INS_REAL_MAX;
    if (!fix->valid || !usable)
    {
        ins_gps_axis_predict(&self->axis[0]);
        ins_gps_axis_predict(&self->axis[1]);
        (void)ins_switch_epoch(&self->choice, 0, 0, 0, 0);
        return fix->valid ? INS_E_RANGE : INS_OK;
    }
    const int first = !self->started;
    for (unsigned i = 0; i < 2; i++)
    {
        ins_real nis = 0;
        if (first)
        {
            self->axis[i].x[0] = z[i];
        }
        const ins_status_t one = ins_gps_axis_step(&self->axis[i], z[i], &nis);
        status = one != INS_OK ? one : status;
        self->nis += nis;
    }
    self->started = 1;
    self->used += status == INS_OK;
    self->refused += status != INS_OK;
    if (ins_switch_epoch(&self->choice, status == INS_OK, fix->sats, fix->hdop, self->nis) == INS_SWITCH_GPS || first)
    {
        correct_dr(self);
    }
    return status;
}

int ins_gps_dr_paper_source(const ins_gps_dr_paper_t* self)
{
    const int mode = self->choice.mode == INS_SWITCH_GPS ? INS_GPS_DR_GPS : INS_GPS_DR_DR;
    return self->started ? mode : INS_GPS_DR_NONE;
}

ins_status_t ins_gps_dr_paper_state(const ins_gps_dr_paper_t* self, ins_real x[4], ins_real var[4])
{
    if (!self->started)
    {
        return INS_E_STATE;
    }
    for (unsigned i = 0; i < 4; i++)
    {
        x[i] = self->dr.x[i];
        var[i] = self->dr.P[7 * i];
    }
    return INS_OK;
}
