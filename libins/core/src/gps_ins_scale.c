/// \file   gps_ins_scale.c
/// \brief  GPS/INS filter with scale factors of gyros and accelerometers. Frames: b, n (NED). SI, rad.
///
/// A row that feels a gyro's bias feels its scale factor times the rate of now; none feels those of the accelerometers.
/// SPDX-License-Identifier: MIT
#include "gps_ins_internal.h"
#include "ins/vec.h"

ins_status_t ins_gps_ins_scale_init(ins_gps_ins_scale_t* self, const ins_gps_ins_config_t* cfg,
                                    const ins_kf15_scale_sensors_t* sensors, const ins_gps_ins_start_t* start)
{
    ins_kf15_scale_t kf;
    ins_status_t status = ins_kf15_scale_init(&kf, sensors);
    if (status == INS_OK)
    {
        status = ins_gps_ins_init(&self->base, cfg, start);
    }
    if (status != INS_OK)
    {
        return status;
    }
    self->base.form = GPS_INS_SCALE;
    self->kf = kf;
    for (unsigned i = 0; i < 3; i++)
    {
        self->gyro[i] = 0;
        self->accel[i] = 0;
        self->pending_theta[i] = 0;
    }
    for (unsigned i = 0; i < INS_KF15_SCALE_N; i++)
    {
        self->moved[i] = 0;
    }
    return INS_OK;
}

void ins_gps_ins_scale_part(ins_gps_ins_t* base)
{
    ins_gps_ins_scale_t* const self = gps_ins_scale(base);
    for (unsigned i = 0; i < INS_KF15_N * INS_KF15_SCALE_N; i++)
    {
        self->kf.B[i] = 0;
    }
}

void ins_gps_ins_scale_take_off(ins_gps_ins_t* base, ins_real dt, ins_increment_t* x)
{
    ins_gps_ins_scale_t* const self = gps_ins_scale(base);
    const ins_kf15_scale_sensors_t* const s = &self->kf.sensors;
    for (unsigned i = 0; i < 3; i++)
    {
        x->theta_b[i] /= 1 + self->gyro[i];
        x->v_b[i] /= 1 + self->accel[i];
    }
    ins_vec_add_scaled(self->gyro, -dt / s->gyro_tau, self->gyro);
    ins_vec_add_scaled(self->accel, -dt / s->accel_tau, self->accel);
}

void ins_gps_ins_scale_pend(ins_gps_ins_t* base, const ins_real theta_b[3])
{
    ins_vec_add_scaled(gps_ins_scale(base)->pending_theta, 1, theta_b);
}

void ins_gps_ins_scale_propagate(ins_gps_ins_t* base, const ins_real v_b[3])
{
    static const ins_real none[3] = {0, 0, 0};
    ins_gps_ins_scale_t* const self = gps_ins_scale(base);
    ins_kf15_scale_propagate(&self->kf, &base->kf, &base->model, self->pending_theta, v_b);
    ins_vec_copy(none, self->pending_theta);
}

/// h_s of a row h.
static void scale_row(const ins_gps_ins_t* base, const ins_real h[INS_KF15_N], ins_real h_s[INS_KF15_SCALE_N])
{
    for (unsigned k = 0; k < 3; k++)
    {
        h_s[k] = h[INS_KF15_BG + k] * base->w_ib_b[k];
        h_s[3 + k] = 0;
    }
}

/// h B1 h_s'
static ins_real crossed(const ins_real* B, const ins_real* h, const ins_real* h_s)
{
    ins_real sum = 0;
    for (unsigned i = 0; i < INS_KF15_N; i++)
    {
        if (h[i] != 0)
        {
            sum += h[i] * ins_vec_dot(B + i * INS_KF15_SCALE_N, h_s);
        }
    }
    return sum;
}

static int feels_rate(const ins_real h[INS_KF15_N])
{
    return h[INS_KF15_BG] != 0 || h[INS_KF15_BG + 1] != 0 || h[INS_KF15_BG + 2] != 0;
}

ins_real ins_gps_ins_scale_product(ins_gps_ins_t* base, const ins_real a[INS_KF15_N], const ins_real b[INS_KF15_N])
{
    const ins_real* const B = gps_ins_scale(base)->kf.B;
    ins_real a_s[INS_KF15_SCALE_N];
    ins_real b_s[INS_KF15_SCALE_N];
    if (!feels_rate(a) && !feels_rate(b))
    {
        return 0;
    }
    scale_row(base, a, a_s);
    scale_row(base, b, b_s);
    ins_real sum = crossed(B, a, b_s) + crossed(B, b, a_s);
    for (unsigned k = 0; k < 3; k++)
    {
        sum += a_s[k] * ins_vec_dot(B + (INS_KF15_N + k) * INS_KF15_SCALE_N, b_s);
    }
    return sum;
}

ins_status_t ins_gps_ins_scale_update(ins_gps_ins_t* base, const ins_real h[INS_KF15_N], ins_innovation_t* z)
{
    ins_gps_ins_scale_t* const self = gps_ins_scale(base);
    ins_real h_s[INS_KF15_SCALE_N];
    scale_row(base, h, h_s);
    z->v -= ins_vec_dot(h_s, self->moved);
    const ins_status_t status = ins_kf15_scale_update(&self->kf, &base->kf, h, h_s, z);
    for (unsigned k = 0; status == INS_OK && k < INS_KF15_SCALE_N; k++)
    {
        self->moved[k] += self->kf.K[k] * z->v;
    }
    return status;
}

void ins_gps_ins_scale_correct(ins_gps_ins_t* base)
{
    ins_gps_ins_scale_t* const self = gps_ins_scale(base);
    ins_vec_add_scaled(self->gyro, 1, self->moved);
    ins_vec_add_scaled(self->accel, 1, self->moved + 3);
    for (unsigned k = 0; k < INS_KF15_SCALE_N; k++)
    {
        self->moved[k] = 0;
    }
}
