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

void ins_kf15_downdate(ins_kf15_t* restrict self, const ins_real* restrict g, ins_real s)
{
    const ins_real per_s = 1 / s;
    const ins_real root = ins_sqrt(per_s);
    ins_real w[INS_KF15_ROW];
    for (unsigned j = 0; j < KF15_COLUMNS; j++)
    {
        self->K[j] = per_s * g[j];
        w[j] = root * g[j];
    }
    for (unsigned i = 0; i < INS_KF15_N; i += 5)
    {
        ins_real* const row = self->P + i * INS_KF15_ROW;
        const ins_real a[5] = {w[i], w[i + 1], w[i + 2], w[i + 3], w[i + 4]};
        for (unsigned j = INS_VECTORS ? 0 : i; j < KF15_COLUMNS; j++)
        {
            const ins_real p[5] = {row[0 * INS_KF15_ROW + j] - a[0] * w[j], row[1 * INS_KF15_ROW + j] - a[1] * w[j],
                                   row[2 * INS_KF15_ROW + j] - a[2] * w[j], row[3 * INS_KF15_ROW + j] - a[3] * w[j],
                                   row[4 * INS_KF15_ROW + j] - a[4] * w[j]};
            row[0 * INS_KF15_ROW + j] = p[0];
            row[1 * INS_KF15_ROW + j] = p[1];
            row[2 * INS_KF15_ROW + j] = p[2];
            row[3 * INS_KF15_ROW + j] = p[3];
            row[4 * INS_KF15_ROW + j] = p[4];
            if (!INS_VECTORS && j >= i + 5)
            {
                ins_real* const mirror = self->P + j * INS_KF15_ROW + i;
                mirror[0] = p[0];
                mirror[1] = p[1];
                mirror[2] = p[2];
                mirror[3] = p[3];
                mirror[4] = p[4];
            }
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
    for (unsigned j = 0; j < KF15_COLUMNS; j++)
    {
        g[j] = self->P[index * INS_KF15_ROW + j];
    }
    const ins_status_t status = kalman_judge(z, g[index]);
    if (status != INS_OK)
    {
        return status;
    }
    ins_kf15_downdate(self, g, g[index] + z->r);
    // What P h' = r K says, without the cancellation.
    const ins_real r = z->r;
    ins_real* const P = self->P;
    for (unsigned j = 0; j < INS_KF15_N; j++)
    {
        const ins_real p = r * self->K[j];
        P[index * INS_KF15_ROW + j] = p;
        P[j * INS_KF15_ROW + index] = p;
    }
    return INS_OK;
}

/// A row of H without its zeros, filled up with some to a multiple of three.
typedef struct kf15_row_t
{
    unsigned n;
    unsigned at[INS_KF15_N];
    ins_real h[INS_KF15_N];
} kf15_row_t;

/// y = P h'
static void times(const ins_real* restrict P, const kf15_row_t* h, ins_real* restrict y)
{
    for (unsigned j = 0; j < KF15_COLUMNS; j++)
    {
        y[j] = 0;
    }
    for (unsigned k = 0; k < h->n; k += 3)
    {
        const ins_real* const row0 = P + h->at[k] * INS_KF15_ROW;
        const ins_real* const row1 = P + h->at[k + 1] * INS_KF15_ROW;
        const ins_real* const row2 = P + h->at[k + 2] * INS_KF15_ROW;
        const ins_real h0 = h->h[k];
        const ins_real h1 = h->h[k + 1];
        const ins_real h2 = h->h[k + 2];
        for (unsigned j = 0; j < KF15_COLUMNS; j++)
        {
            y[j] += h0 * row0[j] + h1 * row1[j] + h2 * row2[j];
        }
    }
}

/// h x
static ins_real inner(const kf15_row_t* h, const ins_real x[INS_KF15_N])
{
    ins_real sum = 0;
    for (unsigned k = 0; k < h->n; k++)
    {
        sum += h->h[k] * x[h->at[k]];
    }
    return sum;
}

/// Rounding leaves P h' off r K by what is lost of the large elements: it goes into the row and the column that had the most to lose.
static void restore(ins_kf15_t* self, const kf15_row_t* h, unsigned pivot, ins_real h_pivot, ins_real r)
{
    ins_real x[INS_KF15_ROW];
    ins_real* const P = self->P;
    const ins_real per_h = 1 / h_pivot;
    times(P, h, x);
    for (unsigned j = 0; j < KF15_COLUMNS; j++)
    {
        x[j] = per_h * (r * self->K[j] - x[j]);
    }
    x[pivot] += x[pivot] - per_h * inner(h, x);
    for (unsigned j = 0; j < INS_KF15_N; j++)
    {
        const ins_real p = P[pivot * INS_KF15_ROW + j] + x[j];
        P[pivot * INS_KF15_ROW + j] = p;
        P[j * INS_KF15_ROW + pivot] = p;
    }
}

ins_status_t ins_kf15_update(ins_kf15_t* self, const ins_real h[INS_KF15_N], ins_innovation_t* z)
{
    kf15_row_t row;
    ins_real g[INS_KF15_ROW];
    ins_real most = 0;
    unsigned pivot = 0;
    row.n = 0;
    for (unsigned i = 0; i < INS_KF15_N; i++)
    {
        if (h[i] != 0)
        {
            const ins_real own = h[i] * h[i] * self->P[i * (INS_KF15_ROW + 1)];
            pivot = own > most ? i : pivot;
            most = own > most ? own : most;
            row.at[row.n] = i;
            row.h[row.n] = h[i];
            row.n++;
        }
    }
    while (row.n % 3 != 0)
    {
        row.at[row.n] = 0;
        row.h[row.n] = 0;
        row.n++;
    }
    times(self->P, &row, g);
    const ins_real hph = inner(&row, g);
    const ins_status_t status = kalman_judge(z, hph);
    if (status != INS_OK)
    {
        return status;
    }
    ins_kf15_downdate(self, g, hph + z->r);
    if (hph > KF15_FALL * z->r)
    {
        restore(self, &row, pivot, h[pivot], z->r);
    }
    return INS_OK;
}
