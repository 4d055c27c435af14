/// \file   gps_ins_measure.c
/// \brief  Measurements judged by their joint NIS and used one scalar at a time; the errors found go into the state. Frames: b, n.
///
/// Scalars in a row: S = H P H' + R = L D L', e = L^-1 v; e_i^2 / D_i is the NIS of each given those before, their sum the joint one.
/// SPDX-License-Identifier: MIT
#include "gps_ins_internal.h"
#include "ins/vec.h"
#include "strapdown_internal.h"

ins_real ins_gps_ins_covariance(const ins_gps_ins_t* self, unsigned i, unsigned j)
{
    return self->kf.P[INS_KF15_ROW * i + j];
}

/// A row without its zeros.
typedef struct columns_t
{
    unsigned n;
    uint_least8_t at[INS_KF15_N];
    ins_real h[INS_KF15_N];
} columns_t;

static void find(const ins_real h[INS_KF15_N], columns_t* columns)
{
    unsigned n = 0;
    for (unsigned i = 0; i < INS_KF15_N; i++)
    {
        if (h[i] != 0)
        {
            columns->at[n] = (uint_least8_t)i;
            columns->h[n] = h[i];
            n++;
        }
    }
    columns->n = n;
}

/// a P b'
static ins_real row_product(const ins_real* P, const columns_t* a, const columns_t* b)
{
    ins_real sum = 0;
    for (unsigned k = 0; k < a->n; k++)
    {
        const ins_real* const p = P + (unsigned)INS_KF15_ROW * a->at[k];
        ins_real row = 0;
        for (unsigned m = 0; m < b->n; m++)
        {
            row += b->h[m] * p[b->at[m]];
        }
        sum += a->h[k] * row;
    }
    return sum;
}

static void judge_rows(ins_gps_ins_t* self, const columns_t* columns, gps_ins_rows_t* rows)
{
    ins_real P[3][3]; // h_i P h_j'
    ins_real l[3][3];
    ins_real d[3];
    ins_real e[3];
    rows->joint = 0;
    for (unsigned i = 0; i < rows->n; i++)
    {
        for (unsigned j = 0; j <= i; j++)
        {
            P[i][j] = row_product(self->kf.P, &columns[i], &columns[j]);
        }
    }
    if (self->form == GPS_INS_SCALE)
    {
        for (unsigned i = 0; i < rows->n; i++)
        {
            for (unsigned j = 0; j <= i; j++)
            {
                P[i][j] += ins_gps_ins_scale_product(self, rows->h[i], rows->h[j]);
            }
        }
    }
    for (unsigned i = 0; i < rows->n; i++)
    {
        e[i] = rows->v[i];
        d[i] = P[i][i] + rows->r[i];
        for (unsigned j = 0; j < i; j++)
        {
            ins_real s = P[i][j];
            for (unsigned k = 0; k < j; k++)
            {
                s -= l[i][k] * l[j][k] * d[k];
            }
            l[i][j] = s / d[j];
            d[i] -= l[i][j] * s;
            e[i] -= l[i][j] * e[j];
        }
        rows->nis[i] = e[i] * e[i] / d[i];
        rows->joint += rows->nis[i];
    }
}

/// Truth = estimate + x, for fixes that come late too.
static void correct_all(ins_gps_ins_t* self, const ins_real x[INS_KF15_N])
{
    ins_strapdown_correct(&self->nav, x);
    ins_vec_add_scaled(self->gyro_bias, 1, x + INS_KF15_BG);
    ins_vec_add_scaled(self->accel_bias, 1, x + INS_KF15_BA);
    for (unsigned k = 0; k < INS_GPS_INS_PAST; k++)
    {
        ins_gps_ins_past_t* past = &self->past[k];
        ins_vec_add_scaled(past->u_n, -(ins_real)(self->t_ns - past->t_ns) * NS_TO_S, x + INS_KF15_V);
        ins_vec_add_scaled(past->v_n, 1, x + INS_KF15_V);
    }
}

/// One scalar. \return its gain, or 0 if it was refused.
static const ins_real* update_by(ins_gps_ins_t* self, const ins_real h[INS_KF15_N], const columns_t* columns,
                                 ins_innovation_t* z)
{
    const unsigned index = columns->at[0];
    const int is_unit = columns->n == 1 && h[index] == 1;
    if (self->form == GPS_INS_UD)
    {
        ins_kf15_ud_t* ud = gps_ins_ud(self);
        const ins_status_t status = is_unit ? ins_kf15_ud_update_state(ud, index, z) : ins_kf15_ud_update(ud, h, z);
        return status == INS_OK ? ud->K : 0;
    }
    if (self->form == GPS_INS_SCALE)
    {
        return ins_gps_ins_scale_update(self, h, z) == INS_OK ? self->kf.K : 0;
    }
    const ins_status_t status = is_unit ? ins_kf15_update_state(&self->kf, index, z) : ins_kf15_update(&self->kf, h, z);
    return status == INS_OK ? self->kf.K : 0;
}

ins_status_t ins_gps_ins_measure(ins_gps_ins_t* self, gps_ins_rows_t* rows, ins_real gate)
{
    ins_real x[INS_KF15_N] = {0};
    int positive = 1;
    columns_t columns[3];
    if (self->form == GPS_INS_UD)
    {
        ins_kf15_ud_covariance(gps_ins_ud(self), self->kf.P);
    }
    for (unsigned i = 0; i < rows->n; i++)
    {
        find(rows->h[i], &columns[i]);
        positive &= rows->r[i] > 0;
    }
    judge_rows(self, columns, rows);
    if (!positive || !(rows->joint >= 0 && rows->joint <= INS_REAL_MAX))
    {
        return INS_E_RANGE;
    }
    if (gate > 0 && rows->joint > gate)
    {
        return INS_E_GATE;
    }
    for (unsigned i = 0; i < rows->n; i++)
    {
        ins_innovation_t z = {rows->v[i], rows->r[i], 0, 0};
        for (unsigned k = 0; k < columns[i].n; k++)
        {
            z.v -= columns[i].h[k] * x[columns[i].at[k]];
        }
        const ins_real* K = update_by(self, rows->h[i], &columns[i], &z);
        for (unsigned k = 0; K && k < INS_KF15_N; k++)
        {
            x[k] += K[k] * z.v;
        }
    }
    correct_all(self, x);
    if (self->form == GPS_INS_UD)
    {
        ins_kf15_ud_covariance(gps_ins_ud(self), self->kf.P);
    }
    if (self->form == GPS_INS_SCALE)
    {
        ins_gps_ins_scale_correct(self);
    }
    return INS_OK;
}
