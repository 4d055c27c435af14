/// \file   kf15.c
/// \brief  Covariance of the 15 errors of a strapdown, symmetric form. Frames: b -> n (NED). SI, rad.
/// SPDX-License-Identifier: MIT
#include "ins/kf15.h"
#include "kalman_internal.h"
#include "kf15_internal.h"

#define N   INS_KF15_N
#define ROW INS_KF15_ROW

ins_status_t ins_kf15_init(ins_kf15_t* self, const ins_real sigma[INS_KF15_N])
{
    for (unsigned i = 0; i < N; i++)
    {
        if (!(sigma[i] >= 0 && sigma[i] <= INS_REAL_MAX))
        {
            return INS_E_RANGE;
        }
    }
    static const ins_kf15_t none = {{0}, {0}};
    *self = none;
    for (unsigned i = 0; i < N; i++)
    {
        self->P[i * ROW + i] = sigma[i] * sigma[i];
    }
    return INS_OK;
}

void ins_kf15_propagate(ins_kf15_t* self, const ins_kf15_model_t* model)
{
    ins_real T[9 * ROW]; // the first nine rows of (I + F dt) P
    ins_real* const P = self->P;
    for (unsigned j = 0; j < ROW; j++)
    {
        kf15_attitude(model, P + j, ROW, T + j, ROW);
    }
    for (unsigned j = 0; j < ROW; j++)
    {
        kf15_velocity(model, P + j, ROW, T + INS_KF15_V * ROW + j, ROW);
    }
    for (unsigned j = 0; j < ROW; j++)
    {
        kf15_position(model, P + j, ROW, T + INS_KF15_P * ROW + j, ROW);
    }
    for (unsigned i = 0; i < 9; i++)
    {
        const ins_real* const t = T + i * ROW;
        ins_real* const row = P + i * ROW;
        ins_real x[9];
        if (i < INS_KF15_V)
        {
            kf15_attitude(model, t, 1, x, 1);
        }
        if (i < INS_KF15_P)
        {
            kf15_velocity(model, t, 1, x + INS_KF15_V, 1);
        }
        kf15_position(model, t, 1, x + INS_KF15_P, 1);
        for (unsigned j = i; j < 9; j++)
        {
            row[j] = x[j];
            P[j * ROW + i] = x[j];
        }
        for (unsigned j = 9; j < N; j++)
        {
            const ins_real p = t[j] * (j < INS_KF15_BA ? model->bg.phi : model->ba.phi);
            row[j] = p;
            P[j * ROW + i] = p;
        }
    }
    const ins_real decay[6] = {model->bg.phi, model->bg.phi, model->bg.phi,
                               model->ba.phi, model->ba.phi, model->ba.phi};
    for (unsigned i = 0; i < 6; i++)
    {
        for (unsigned j = 0; j < 6; j++)
        {
            P[(9 + i) * ROW + 9 + j] *= decay[i] * decay[j];
        }
    }
    for (unsigned i = 0; i < 3; i++)
    {
        P[(INS_KF15_PHI + i) * (ROW + 1)] += model->q_phi;
        P[(INS_KF15_V + i) * (ROW + 1)] += model->q_v;
        P[(INS_KF15_BG + i) * (ROW + 1)] += model->bg.q;
        P[(INS_KF15_BA + i) * (ROW + 1)] += model->ba.q;
    }
}

/// P = P - K g with K = g / s. As sqrt(1/s) g times itself, it stays symmetric to the last bit.
static void reduce(ins_kf15_t* self, const ins_real g[ROW], ins_real s)
{
    const ins_real per_s = 1 / s;
    const ins_real root = ins_sqrt(per_s);
    ins_real w[ROW];
    for (unsigned j = 0; j < ROW; j++)
    {
        self->K[j] = per_s * g[j];
        w[j] = root * g[j];
    }
    for (unsigned i = 0; i < N; i++)
    {
        ins_real* const row = self->P + i * ROW;
        const ins_real w_i = w[i];
        for (unsigned j = 0; j < ROW; j++)
        {
            row[j] -= w_i * w[j];
        }
    }
}

ins_status_t ins_kf15_update_state(ins_kf15_t* self, unsigned index, ins_innovation_t* z)
{
    if (index >= N)
    {
        return INS_E_RANGE;
    }
    ins_real g[ROW];
    for (unsigned j = 0; j < ROW; j++)
    {
        g[j] = self->P[index * ROW + j];
    }
    const ins_status_t status = kalman_judge(z, g[index]);
    if (status != INS_OK)
    {
        return status;
    }
    reduce(self, g, g[index] + z->r);
    // What P h' = r K says, without the cancellation.
    for (unsigned j = 0; j < ROW; j++)
    {
        self->P[index * ROW + j] = z->r * self->K[j];
    }
    for (unsigned i = 0; i < N; i++)
    {
        self->P[i * ROW + index] = z->r * self->K[i];
    }
    return INS_OK;
}

/// y = P h', by the rows where h is not 0.
static void times(const ins_real* P, const ins_real h[N], ins_real y[ROW])
{
    for (unsigned j = 0; j < ROW; j++)
    {
        y[j] = 0;
    }
    for (unsigned i = 0; i < N; i++)
    {
        const ins_real h_i = h[i];
        if (h_i != 0)
        {
            for (unsigned j = 0; j < ROW; j++)
            {
                y[j] += h_i * P[i * ROW + j];
            }
        }
    }
}

ins_status_t ins_kf15_update(ins_kf15_t* self, const ins_real h[INS_KF15_N], ins_innovation_t* z)
{
    ins_real g[ROW];
    ins_real hph = 0;
    ins_real most = 0;
    unsigned pivot = N;
    times(self->P, h, g);
    for (unsigned i = 0; i < N; i++)
    {
        const ins_real own = h[i] * h[i] * self->P[i * (ROW + 1)];
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
    reduce(self, g, hph + z->r);
    if (pivot == N) // nothing is known about what was measured but that it is certain
    {
        return INS_OK;
    }
    // P h' = r K holds without rounding; what is missing goes into the row and the column that had the most to lose.
    ins_real rest[ROW];
    times(self->P, h, rest);
    const ins_real per_h = 1 / h[pivot];
    ins_real own = 0;
    for (unsigned j = 0; j < ROW; j++)
    {
        rest[j] = per_h * (z->r * self->K[j] - rest[j]);
    }
    for (unsigned i = 0; i < N; i++)
    {
        own += h[i] * rest[i];
    }
    rest[pivot] += per_h * (h[pivot] * rest[pivot] - own);
    for (unsigned j = 0; j < N; j++)
    {
        const ins_real p = self->P[pivot * ROW + j] + rest[j];
        self->P[pivot * ROW + j] = p;
        self->P[j * ROW + pivot] = p;
    }
    return INS_OK;
}
