/// \file   kf15_ud.c
/// \brief  Covariance of the 15 errors of a strapdown as P = U D U'. Frames: b -> n (NED). SI, rad.
///
/// Loops go over four elements at a time, up to and beyond the diagonal: 1 on it and 0 below stay what they are.
/// Source: G. J. Bierman, Factorization Methods (1977), V.3 (update), VI.4 (Gram-Schmidt); Agee and Turner (1972) (rank one).
/// SPDX-License-Identifier: MIT
#include "kalman_internal.h"
#include "kf15_internal.h"

#define KF15_NAV 9 ///< rows that I + F dt mixes
/// Columns: 9 of U, 6 that the noise of the biases leaves, 5 of own noise, since that of the first row meets no other.
#define KF15_WIDTH 20

ins_status_t ins_kf15_ud_init(ins_kf15_ud_t* self, const ins_real sigma[INS_KF15_N])
{
    for (unsigned i = 0; i < INS_KF15_N; i++)
    {
        if (!(sigma[i] >= 0 && sigma[i] <= INS_REAL_MAX))
        {
            return INS_E_RANGE;
        }
    }
    static const ins_kf15_ud_t none = {{0}, {0}, {0}};
    *self = none;
    for (unsigned i = 0; i < INS_KF15_N; i++)
    {
        self->U[i * INS_KF15_ROW + i] = 1;
        self->D[i] = sigma[i] * sigma[i];
    }
    return INS_OK;
}

void ins_kf15_ud_covariance(const ins_kf15_ud_t* self, ins_real P[INS_KF15_N * INS_KF15_ROW])
{
    for (unsigned i = 0; i < INS_KF15_N; i++)
    {
        for (unsigned j = i; j < INS_KF15_N; j++)
        {
            ins_real sum = 0;
            for (unsigned k = j; k < INS_KF15_N; k++)
            {
                const ins_real* const u = self->U + k * INS_KF15_ROW;
                sum += u[i] * self->D[k] * u[j];
            }
            P[i * INS_KF15_ROW + j] = sum;
            P[j * INS_KF15_ROW + i] = sum;
        }
        P[i * INS_KF15_ROW + INS_KF15_N] = 0;
    }
}

/// U D U' + q e e' for bias `from`, e its unit vector, as far as the bias columns (Agee and Turner).
/// \param[out] W  [KF15_NAV] rows: in column `from` the vector that is left for the navigation columns. \return its weight.
static ins_real add_noise(ins_kf15_ud_t* self, unsigned from, ins_real q, ins_real* W)
{
    ins_real a[INS_KF15_N] = {0};
    ins_real b_of[INS_KF15_N] = {0};
    ins_real weight = q;
    a[from] = 1;
    for (unsigned j = from + 1; j-- > KF15_NAV;)
    {
        ins_real* const u = self->U + j * INS_KF15_ROW;
        const ins_real a_j = a[j];
        const ins_real d = self->D[j] + weight * a_j * a_j;
        const ins_real per_d = d > 0 ? weight / d : 0;
        const ins_real b = a_j * per_d;
        weight = d > 0 ? self->D[j] * per_d : weight;
        self->D[j] = d;
        b_of[j] = b;
        for (unsigned i = KF15_NAV - 1; i < j; i++)
        {
            a[i] -= a_j * u[i];
            u[i] += b * a[i];
        }
    }
    // The other rows follow, eight at a time.
    ins_real a0 = 0;
    ins_real a1 = 0;
    ins_real a2 = 0;
    ins_real a3 = 0;
    ins_real a4 = 0;
    ins_real a5 = 0;
    ins_real a6 = 0;
    ins_real a7 = 0;
    for (unsigned j = from + 1; j-- > KF15_NAV;)
    {
        ins_real* const u = self->U + j * INS_KF15_ROW;
        const ins_real a_j = a[j];
        const ins_real b = b_of[j];
        a0 -= a_j * u[0];
        a1 -= a_j * u[1];
        a2 -= a_j * u[2];
        a3 -= a_j * u[3];
        a4 -= a_j * u[4];
        a5 -= a_j * u[5];
        a6 -= a_j * u[6];
        a7 -= a_j * u[7];
        u[0] += b * a0;
        u[1] += b * a1;
        u[2] += b * a2;
        u[3] += b * a3;
        u[4] += b * a4;
        u[5] += b * a5;
        u[6] += b * a6;
        u[7] += b * a7;
    }
    W[0 * KF15_WIDTH + from] = a0;
    W[1 * KF15_WIDTH + from] = a1;
    W[2 * KF15_WIDTH + from] = a2;
    W[3 * KF15_WIDTH + from] = a3;
    W[4 * KF15_WIDTH + from] = a4;
    W[5 * KF15_WIDTH + from] = a5;
    W[6 * KF15_WIDTH + from] = a6;
    W[7 * KF15_WIDTH + from] = a7;
    W[8 * KF15_WIDTH + from] = a[8];
    return weight;
}

/// In four sums, as vector units do. \param[in] n  a multiple of four.
static inline ins_real dot(unsigned n, const ins_real* a, const ins_real* b)
{
    ins_real s0 = 0;
    ins_real s1 = 0;
    ins_real s2 = 0;
    ins_real s3 = 0;
    for (const ins_real* const end = a + n; a != end; a += 4, b += 4)
    {
        s0 += a[0] * b[0];
        s1 += a[1] * b[1];
        s2 += a[2] * b[2];
        s3 += a[3] * b[3];
    }
    return (s0 + s1) + (s2 + s3);
}

/// y -= k x. \param[in] n  as in dot().
static inline void subtract(unsigned n, ins_real* y, ins_real k, const ins_real* x)
{
    for (const ins_real* const end = x + n; x != end; x += 4, y += 4)
    {
        const ins_real y0 = y[0] - k * x[0];
        const ins_real y1 = y[1] - k * x[1];
        const ins_real y2 = y[2] - k * x[2];
        const ins_real y3 = y[3] - k * x[3];
        y[0] = y0;
        y[1] = y1;
        y[2] = y2;
        y[3] = y3;
    }
}

/// Column j of U, and D, from row j of W, of which `columns` are in use: a multiple of four. The rows above are made orthogonal to it.
/// \param[in] q  noise of its own. Its column of W would be e: what is left of it above row j goes to column `own`.
static inline void pivot(ins_kf15_ud_t* self, unsigned j, unsigned columns, ins_real q, unsigned own, ins_real* W,
                         ins_real* weight)
{
    ins_real c[KF15_WIDTH];
    ins_real* const u = self->U + j * INS_KF15_ROW;
    const ins_real* const w = W + j * KF15_WIDTH;
    for (unsigned k = 0; k < KF15_WIDTH; k++)
    {
        c[k] = weight[k] * w[k];
    }
    const ins_real d = q + dot(columns, c, w);
    self->D[j] = d;
    const ins_real per_d = d > 0 ? 1 / d : 0;
    for (unsigned i = 0; i < j; i++)
    {
        ins_real* const row = W + i * KF15_WIDTH;
        const ins_real u_i = per_d * dot(columns, c, row);
        u[i] = u_i;
        subtract(columns, row, u_i, w);
        row[own] = -u_i;
    }
    weight[own] = q;
}

/// U by rows. \param[out] R  zero before.
static void by_rows(const ins_kf15_ud_t* self, ins_real* R)
{
    for (unsigned j = 0; j < INS_KF15_N; j++)
    {
        const ins_real* const u = self->U + j * INS_KF15_ROW;
        for (unsigned i = 0; i <= j; i += 3)
        {
            R[i * INS_KF15_ROW + j] = u[i];
            R[(i + 1) * INS_KF15_ROW + j] = u[i + 1];
            R[(i + 2) * INS_KF15_ROW + j] = u[i + 2];
        }
    }
}

void ins_kf15_ud_propagate(ins_kf15_ud_t* self, const ins_kf15_model_t* model)
{
    ins_real R[INS_KF15_N * INS_KF15_ROW] = {0};
    ins_real W[KF15_NAV * KF15_WIDTH];
    ins_real weight[KF15_WIDTH + 1] = {0};
    by_rows(self, R);
    kf15_turn(model, R, W, KF15_WIDTH);
    for (unsigned i = 0; i < KF15_NAV; i++)
    {
        for (unsigned k = INS_KF15_N; k < KF15_WIDTH; k++)
        {
            W[i * KF15_WIDTH + k] = 0;
        }
    }
    const ins_real phi[2] = {model->bg.phi, model->ba.phi};
    const ins_real per_phi[2] = {1 / phi[0], 1 / phi[1]};
    for (unsigned j = 0; j < KF15_NAV; j++)
    {
        weight[j] = self->D[j];
    }
    for (unsigned j = KF15_NAV; j < INS_KF15_N; j++)
    {
        const unsigned sensor = j >= INS_KF15_BA;
        ins_real* const u = self->U + j * INS_KF15_ROW;
        for (unsigned i = 0; i < KF15_NAV; i++)
        {
            u[i] = per_phi[sensor] * W[i * KF15_WIDTH + j];
        }
        self->D[j] *= phi[sensor] * phi[sensor];
    }
    const ins_real ratio = phi[0] * per_phi[1];
    for (unsigned j = INS_KF15_BA; j < INS_KF15_N; j++)
    {
        ins_real* const u = self->U + j * INS_KF15_ROW + INS_KF15_BG;
        u[0] *= ratio;
        u[1] *= ratio;
        u[2] *= ratio;
    }
    for (unsigned j = INS_KF15_N; j-- > KF15_NAV;)
    {
        weight[j] = add_noise(self, j, j >= INS_KF15_BA ? model->ba.q : model->bg.q, W);
    }
    for (unsigned j = KF15_NAV; j-- > 4;)
    {
        pivot(self, j, 16, j < INS_KF15_P ? model->q_v : 0, 15 + (j == 4), W, weight);
    }
    for (unsigned j = 4; j-- > 0;)
    {
        pivot(self, j, 20, j >= INS_KF15_V ? model->q_v : model->q_phi, 20 - j, W, weight);
    }
}

/// The update with f = U' h, of which the elements before `first` are 0.
static ins_status_t bierman(ins_kf15_ud_t* self, unsigned first, const ins_real f[INS_KF15_N], ins_innovation_t* z)
{
    ins_real g[INS_KF15_N];
    ins_real lambda[INS_KF15_N];
    ins_real D[INS_KF15_N];
    ins_real alpha = -z->r; // Bierman's, negative
    ins_real per_alpha = 1 / alpha;
    for (unsigned j = first; j < INS_KF15_N; j++)
    {
        const ins_real before = alpha;
        // cppcheck-suppress uninitvar  // it does not see that both begin at first
        g[j] = self->D[j] * f[j];
        lambda[j] = f[j] * per_alpha;
        alpha -= f[j] * g[j];
        per_alpha = 1 / alpha;
        D[j] = self->D[j] * (before * per_alpha);
    }
    const ins_status_t status = kalman_judge(z, -alpha - z->r);
    if (status != INS_OK)
    {
        return status;
    }
    for (unsigned j = first; j < INS_KF15_N; j++)
    {
        self->D[j] = D[j];
    }
    for (unsigned i = 0; i < INS_KF15_N; i += 4)
    {
        ins_real k0 = 0;
        ins_real k1 = 0;
        ins_real k2 = 0;
        ins_real k3 = 0;
        for (unsigned j = i > first ? i : first; j < INS_KF15_N; j++)
        {
            ins_real* const u = self->U + j * INS_KF15_ROW + i;
            const ins_real u0 = u[0];
            const ins_real u1 = u[1];
            const ins_real u2 = u[2];
            const ins_real u3 = u[3];
            u[0] = u0 + lambda[j] * k0;
            u[1] = u1 + lambda[j] * k1;
            u[2] = u2 + lambda[j] * k2;
            u[3] = u3 + lambda[j] * k3;
            k0 += g[j] * u0;
            k1 += g[j] * u1;
            k2 += g[j] * u2;
            k3 += g[j] * u3;
        }
        self->K[i] = -per_alpha * k0;
        self->K[i + 1] = -per_alpha * k1;
        self->K[i + 2] = -per_alpha * k2;
        self->K[i + 3] = -per_alpha * k3;
    }
    return INS_OK;
}

ins_status_t ins_kf15_ud_update_state(ins_kf15_ud_t* self, unsigned index, ins_innovation_t* z)
{
    if (index >= INS_KF15_N)
    {
        return INS_E_RANGE;
    }
    ins_real f[INS_KF15_N];
    for (unsigned j = index; j < INS_KF15_N; j++)
    {
        f[j] = self->U[j * INS_KF15_ROW + index];
    }
    return bierman(self, index, f, z);
}

ins_status_t ins_kf15_ud_update(ins_kf15_ud_t* self, const ins_real h[INS_KF15_N], ins_innovation_t* z)
{
    ins_real f[INS_KF15_N] = {0};
    for (unsigned i = 0; i < INS_KF15_N; i++)
    {
        const ins_real h_i = h[i];
        if (h_i != 0)
        {
            for (unsigned j = i; j < INS_KF15_N; j++)
            {
                f[j] += h_i * self->U[j * INS_KF15_ROW + i];
            }
        }
    }
    return bierman(self, 0, f, z);
}
