/// \file   gps_ins_aid.c
/// \brief  Aids other than GNSS: rest, wheels that do not slip, odometer, another gyro, height. Frames: b, n (NED). SI, rad.
///
/// Of the velocity of a point l_b of the body, in b: v_b = C' v_n + w x l, dv_b = C' (dv + v_n x phi) + l x dbg.
/// SPDX-License-Identifier: MIT
#include "gps_ins_internal.h"
#include "ins/earth.h"
#include "ins/ins_math.h"
#include "ins/quat.h"
#include "ins/vec.h"

/// The last samples are in the covariance; the rows are empty.
static gps_ins_rows_t* begin(ins_gps_ins_t* self, gps_ins_rows_t* rows)
{
    static const gps_ins_rows_t empty; // all 0
    ins_gps_ins_settle(self);
    *rows = empty;
    return rows;
}

/// Uses them. \return as ins_gps_ins_measure(); INS_E_STATE if lost.
static ins_status_t finish(ins_gps_ins_t* self, gps_ins_rows_t* rows, ins_real gate)
{
    const ins_status_t status = self->lost ? INS_E_STATE : ins_gps_ins_measure(self, rows, gate);
    self->count.aid_refused += status < INS_OK;
    return status;
}

/// Row of the velocity of the wheel along axis i of b.
static void wheel_row(const ins_gps_ins_t* self, unsigned i, ins_real speed, ins_real sigma, gps_ins_rows_t* rows)
{
    const unsigned k = rows->n++;
    const ins_real* v = self->nav.v_n;
    const ins_real* l = self->cfg.wheel_b;
    ins_real C[9];
    ins_real turning[3];
    ins_quat_to_dcm(self->nav.sculling.q_nb, C);
    const ins_real c[3] = {C[i], C[3 + i], C[6 + i]};
    ins_vec_cross(self->w_ib_b, l, turning);
    ins_vec_cross(c, v, rows->h[k] + INS_KF15_PHI);
    ins_vec_copy(c, rows->h[k] + INS_KF15_V);
    const ins_real back[3] = {-l[0], -l[1], -l[2]};
    gps_ins_cross_row(back, i, rows->h[k] + INS_KF15_BG);
    rows->v[k] = speed - (ins_vec_dot(c, v) + turning[i]);
    rows->r[k] = sigma * sigma;
}

ins_status_t ins_gps_ins_zupt(ins_gps_ins_t* self)
{
    gps_ins_rows_t rows;
    begin(self, &rows)->n = 3;
    for (unsigned i = 0; i < 3; i++)
    {
        rows.h[i][INS_KF15_V + i] = 1;
        rows.v[i] = -self->nav.v_n[i];
        rows.r[i] = self->cfg.zupt * self->cfg.zupt;
    }
    return finish(self, &rows, self->cfg.gate_velocity);
}

ins_status_t ins_gps_ins_zaru(ins_gps_ins_t* self, const ins_real w_ib_b[3])
{
    gps_ins_rows_t rows;
    ins_real w_ie_n[3];
    ins_real w_ie_b[3];
    ins_real q_bn[4];
    begin(self, &rows)->n = 3;
    ins_earth_rate(self->nav.sin_lat, self->nav.cos_lat, w_ie_n);
    ins_quat_conj(self->nav.sculling.q_nb, q_bn);
    ins_quat_rotate(q_bn, w_ie_n, w_ie_b);
    for (unsigned i = 0; i < 3; i++)
    {
        rows.h[i][INS_KF15_BG + i] = 1;
        rows.v[i] = w_ib_b[i] - w_ie_b[i] - self->gyro_bias[i];
        rows.r[i] = self->cfg.zaru * self->cfg.zaru;
    }
    return finish(self, &rows, self->cfg.gate_velocity);
}

ins_status_t ins_gps_ins_nhc(ins_gps_ins_t* self)
{
    gps_ins_rows_t rows;
    begin(self, &rows);
    wheel_row(self, 1, 0, self->cfg.nhc, &rows);
    wheel_row(self, 2, 0, self->cfg.nhc, &rows);
    return finish(self, &rows, self->cfg.gate_velocity);
}

ins_status_t ins_gps_ins_odometer(ins_gps_ins_t* self, ins_real speed, ins_real sigma)
{
    gps_ins_rows_t rows;
    begin(self, &rows);
    wheel_row(self, 0, speed, sigma, &rows);
    return finish(self, &rows, self->cfg.gate);
}

ins_status_t ins_gps_ins_yaw_rate(ins_gps_ins_t* self, ins_real rate, ins_real sigma)
{
    gps_ins_rows_t rows;
    begin(self, &rows)->n = 1;
    rows.h[0][INS_KF15_BG + 2] = -1;
    rows.v[0] = rate - self->w_ib_b[2];
    rows.r[0] = sigma * sigma;
    if (self->dt > 0)
    {
        rows.r[0] += self->cfg.sensors.arw * self->cfg.sensors.arw / self->dt; // the sample has noise too
    }
    return finish(self, &rows, self->cfg.gate);
}

ins_status_t ins_gps_ins_altitude(ins_gps_ins_t* self, ins_real height, ins_real sigma)
{
    gps_ins_rows_t rows;
    begin(self, &rows)->n = 1;
    rows.h[0][INS_KF15_P + 2] = 1; // down
    rows.v[0] = (self->nav.position.anchor[2] - height) + self->nav.position.offset[2];
    rows.r[0] = sigma * sigma;
    return finish(self, &rows, self->cfg.gate);
}
