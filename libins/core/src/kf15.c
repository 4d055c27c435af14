/// \file   kf15.c
/// \brief  Covariance of the 15 errors of a strapdown, symmetric form. Frames: b -> n (NED). SI, rad.
/// SPDX-License-Identifier: MIT
#include "ins/kf15.h"
#include "ins/ins_math.h"
#include "kalman_internal.h"
#include "kf15_internal.h"

ins_status_t ins_kf15_init(ins_kf15_t* self, const ins_real sigma[INS_KF15_N])
{
    for (unsigned i = 0; i < INS_KF15_N; i++)
    {
        if (!(sigma[i] >= 0 && sigma[i] <= INS_REAL_MAX))
        {
            return INS_E_RANGE;
        }
    }
    static const ins_kf15_t none = {{0}, {0}};
    *self = none;
    for (unsigned i = 0; i < INS_KF15_N; i++)
    {
        self->P[i * INS_KF15_ROW + i] = sigma[i] * sigma[i];
    }
    return INS_OK;
}

/// Element j of a row of T (I + F dt)', and its mirror.
static void set_both(ins_real* P, unsigned i, unsigned j, ins_real p)
{
    P[i * INS_KF15_ROW + j] = p;
    P[j * INS_KF15_ROW + i] = p;
}

void ins_kf15_propagate(ins_kf15_t* self, const ins_kf15_model_t* model)
{
    ins_real T[9 * INS_KF15_ROW];
    ins_real* const P = self->P;
    kf15_turn(model, P, T, INS_KF15_ROW);
    for (unsigned i = 0; i < INS_KF15_V; i++)
    {
        const ins_real* const t = T + i * INS_KF15_ROW;
        set_both(P, i, 0, kf15_attitude(model, 0, t, 1));
        set_both(P, i, 1, kf15_attitude(model, 1, t, 1));
        set_both(P, i, 2, kf15_attitude(model, 2, t, 1));
    }
    for (unsigned i = 0; i < INS_KF15_P; i++)
    {
        const ins_real* const t = T + i * INS_KF15_ROW;
        set_both(P, i, 3, kf15_velocity(model, 0, t, 1));
        set_both(P, i, 4, kf15_velocity(model, 1, t, 1));
        set_both(P, i, 5, kf15_velocity(model, 2, t, 1));
    }
    for (unsigned i = 0; i < INS_KF15_BG; i++)
    {
        const ins_real* const t = T + i * INS_KF15_ROW;
        set_both(P, i, 6, kf15_position(model, 0, t, 1));
        set_both(P, i, 7, kf15_position(model, 1, t, 1));
        set_both(P, i, 8, kf15_position(model, 2, t, 1));
        set_both(P, i, 9, model->bg.phi * t[9]);
        set_both(P, i, 10, model->bg.phi * t[10]);
        set_both(P, i, 11, model->bg.phi * t[11]);
        set_both(P, i, 12, model->ba.phi * t[12]);
        set_both(P, i, 13, model->ba.phi * t[13]);
        set_both(P, i, 14, model->ba.phi * t[14]);
    }
    const ins_real gg = model->bg.phi * model->bg.phi;
    const ins_real ga = model->bg.phi * model->ba.phi;
    const ins_real aa = model->ba.phi * model->ba.phi;
    for (unsigned i = 0; i < 3; i++)
    {
        ins_real* const g = P + (INS_KF15_BG + i) * INS_KF15_ROW;
        ins_real* const a = P + (INS_KF15_BA + i) * INS_KF15_ROW;
        for (unsigned j = 9; j < 12; j++)
        {
            g[j] *= gg;
            a[j] *= ga;
        }
        for (unsigned j = 12; j < 15; j++)
        {
            g[j] *= ga;
            a[j] *= aa;
        }
        P[(INS_KF15_PHI + i) * (INS_KF15_ROW + 1)] += model->q_phi;
        P[(INS_KF15_V + i) * (INS_KF15_ROW + 1)] += model->q_v;
        P[(INS_KF15_BG + i) * (INS_KF15_ROW + 1)] += model->bg.q;
        P[(INS_KF15_BA + i) * (INS_KF15_ROW + 1)] += model->ba.q;
    }
}

/// P = P - K g with K = g / s. As sqrt(1/s) g times itself, it stays symmetric to the last bit.
static void downdate(ins_kf15_t* self, const ins_real g[INS_KF15_ROW], ins_real s)
{
    const ins_real per_s = 1 / s;
    const ins_real root = ins_sqrt(per_s);
    ins_real w[INS_KF15_ROW];
    for (unsigned j = 0; j < INS_KF15_ROW; j++)
    {
        self->K[j] = per_s * g[j];
        w[j] = root * g[j];
    }
    for (unsigned i = 0; i < INS_KF15_N; i += 5)
    {
        ins_real* const row = self->P + i * INS_KF15_ROW;
        const ins_real a[5] = {w[i], w[i + 1], w[i + 2], w[i + 3], w[i + 4]};
        for (unsigned j = 0; j < INS_KF15_ROW; j++)
        {
            const ins_real b = w[j];
            row[0 * INS_KF15_ROW + j] -= a[0] * b;
            row[1 * INS_KF15_ROW + j] -= a[1] * b;
            row[2 * INS_KF15_ROW + j] -= a[2] * b;
            row[3 * INS_KF15_ROW + j] -= a[3] * b;
            row[4 * INS_KF15_ROW + j] -= a[4] * b;
        }
    }
}

ins_status_t ins_kf15_update_state(ins_kf15_t* self, unsigned index, ins_innovation_t* z)
{
    if (index >= INS_KF15_N)
    {
        return INS_E_RANGE;
    }
    ins_real g[INS_KF15_ROW];
    for (unsigned j = 0; j < INS_KF15_ROW; j++)
    {
        g[j] = self->P[index * INS_KF15_ROW + j];
    }
    const ins_status_t status = kalman_judge(z, g[index]);
    if (status != INS_OK)
    {
        return status;
    }
    downdate(self, g, g[index] + z->r);
    // What P h' = r K says, without the cancellation.
    for (unsigned j = 0; j < INS_KF15_ROW; j++)
    {
        self->P[index * INS_KF15_ROW + j] = z->r * self->K[j];
    }
    for (unsigned i = 0; i < INS_KF15_N; i++)
    {
        self->P[i * INS_KF15_ROW + index] = z->r * self->K[i];
    }
    return INS_OK;
}

/// y = P h', by the rows where h is not 0.
static void times(const ins_real* P, const ins_real h[INS_KF15_N], ins_real y[INS_KF15_ROW])
{
    for (unsigned j = 0; j < INS_KF15_ROW; j++)
    {
        y[j] = 0;
    }
    for (unsigned i = 0; i < INS_KF15_N; i++)
    {
        const ins_real h_i = h[i];
        if (h_i != 0)
        {
            for (unsigned j = 0; j < INS_KF15_ROW; j++)
            {
                y[j] += h_i * P[i * INS_KF15_ROW + j];
            }
        }
    }
}

ins_status_t ins_kf15_update(ins_kf15_t* self, const ins_real h[INS_KF15_N], ins_innovation_t* z)
{
    ins_real g[INS_KF15_ROW];
    ins_real hph = 0;
    ins_real most = 0;
    unsigned pivot = INS_KF15_N;
    times(self->P, h, g);
    for (unsigned i = 0; i < INS_KF15_N; i++)
    {
        const ins_real own = h[i] * h[i] * self->P[i * (INS_KF15_ROW + 1)];
        hph += h[i] * g[i];
        if (own > most)
        {
            most = own;
            pivot = i;
        }
    }
    const ins_status_t status = kalman_judge(z, hph);
    if (status != INS_OK)
    {
        return status;
    }
    downdate(self, g, hph + z->r);
    if (pivot == INS_KF15_N) // nothing is known about what was measured but that it is certain
    {
        return INS_OK;
    }
    // P h' = r K holds without rounding; what is missing goes into the row and the column that had the most to lose.
    ins_real rest[INS_KF15_ROW];
    times(self->P, h, rest);
    const ins_real per_h = 1 / h[pivot];
    ins_real own = 0;
    for (unsigned j = 0; j < INS_KF15_ROW; j++)
    {
        rest[j] = per_h * (z->r * self->K[j] - rest[j]);
    }
    for (unsigned i = 0; i < INS_KF15_N; i++)
    {
        own += h[i] * rest[i];
    }
    rest[pivot] += per_h * (h[pivot] * rest[pivot] - own);
    for (unsigned j = 0; j < INS_KF15_N; j++)
    {
        const ins_real p = self->P[pivot * INS_KF15_ROW + j] + rest[j];
        self->P[pivot * INS_KF15_ROW + j] = p;
        self->P[j * INS_KF15_ROW + pivot] = p;
    }
    return INS_OK;
}
