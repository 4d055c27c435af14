/// \file   kalman_ud.c
/// \brief  Kalman filter on the factors of P = U D U'. Bierman (1977): V.3, VI.4.
/// SPDX-License-Identifier: MIT
#include "ins/ins_math.h"
#include "ins/kalman.h"
#include "kalman_internal.h"

#define FACTOR_TOL (16 * INS_EPSILON) ///< of a diagonal element: what its rounding may leave below zero

/// Column j of a packed U and D; its element j is D(j).
static unsigned column(unsigned j)
{
    return j * (j + 1) / 2;
}

ins_status_t ins_ud_factor(unsigned n, const ins_real* P, ins_real* UD, ins_real* work)
{
    for (unsigned i = 0; i < n * n; i++)
    {
        work[i] = P[i];
    }
    for (unsigned j = n; j-- > 0;)
    {
        const ins_real limit = FACTOR_TOL * ins_fabs(P[j * n + j]);
        ins_real d = work[j * n + j];
        if (!(d >= -limit) || !(d <= INS_REAL_MAX))
        {
            return INS_E_RANGE;
        }
        d = d > limit ? d : 0;
        work[j * n + j] = d;
        for (unsigned i = 0; i < j; i++)
        {
            const ins_real p = work[i * n + j];
            if (d == 0 && !(p * p <= FACTOR_TOL * P[i * n + i] * P[j * n + j]))
            {
                return INS_E_RANGE;
            }
            const ins_real u = d > 0 ? p / d : 0;
            for (unsigned k = 0; k <= i; k++)
            {
                work[k * n + i] -= work[k * n + j] * u;
            }
        }
        for (unsigned i = 0; i < j; i++)
        {
            work[i * n + j] = d > 0 ? work[i * n + j] / d : 0;
        }
    }
    for (unsigned j = 0; j < n; j++)
    {
        for (unsigned i = 0; i <= j; i++)
        {
            UD[column(j) + i] = work[i * n + j];
        }
    }
    return INS_OK;
}

void ins_ud_covariance(unsigned n, const ins_real* UD, ins_real* P)
{
    for (unsigned i = 0; i < n; i++)
    {
        for (unsigned j = i; j < n; j++)
        {
            ins_real sum = 0;
            for (unsigned k = j; k < n; k++)
            {
                const ins_real* const c = UD + column(k);
                sum += (k == i ? 1 : c[i]) * c[k] * (k == j ? 1 : c[j]);
            }
            P[i * n + j] = sum;
            P[j * n + i] = sum;
        }
    }
}

/// W = [Phi U, U_q], n rows of 2 n; w = their weights [D, D_q].
static void rows(unsigned n, const ins_real* UD, const ins_real* Phi, const ins_real* Q_ud, ins_real* W, ins_real* w)
{
    for (unsigned j = 0; j < n; j++)
    {
        const ins_real* const c = UD + column(j);
        const ins_real* const q = Q_ud + column(j);
        for (unsigned i = 0; i < n; i++)
        {
            ins_real sum = Phi[i * n + j];
            for (unsigned k = 0; k < j; k++)
            {
                sum += Phi[i * n + k] * c[k];
            }
            W[2 * n * i + j] = sum;
            W[2 * n * i + n + j] = i < j ? q[i] : (ins_real)(i == j);
        }
        w[j] = c[j];
        w[n + j] = q[j];
    }
}

void ins_ud_predict(unsigned n, ins_real* x, ins_real* UD, const ins_real* Phi, const ins_real* Q_ud, ins_real* work)
{
    const unsigned m = 2 * n;
    ins_real* const W = work;
    ins_real* const w = work + m * n;
    ins_real* const c = w + m; // weights times row j
    if (x)
    {
        kalman_times(n, Phi, x, c);
        for (unsigned i = 0; i < n; i++)
        {
            x[i] = c[i];
        }
    }
    rows(n, UD, Phi, Q_ud, W, w);
    for (unsigned j = n; j-- > 0;)
    {
        const ins_real* const Wj = W + m * j;
        ins_real* const u = UD + column(j);
        ins_real d = 0;
        for (unsigned k = 0; k < m; k++)
        {
            c[k] = w[k] * Wj[k];
            d += c[k] * Wj[k];
        }
        u[j] = d;
        for (unsigned i = 0; i < j; i++)
        {
            ins_real* const Wi = W + m * i;
            ins_real sum = 0;
            for (unsigned k = 0; k < m; k++)
            {
                sum += Wi[k] * c[k];
            }
            u[i] = d > 0 ? sum / d : 0;
            for (unsigned k = 0; k < m; k++)
            {
                Wi[k] -= u[i] * Wj[k];
            }
        }
    }
}

ins_status_t ins_ud_update(unsigned n, ins_real* x, ins_real* UD, const ins_real* h, ins_innovation_t* z,
                           ins_real* work)
{
    ins_real* const K = work;
    ins_real* const f = work + n;     // U' h'
    ins_real* const g = work + 2 * n; // D f
    ins_real hph = 0;
    for (unsigned j = 0; j < n; j++)
    {
        const ins_real* const u = UD + column(j);
        f[j] = h[j];
        for (unsigned i = 0; i < j; i++)
        {
            f[j] += u[i] * h[i];
        }
        g[j] = u[j] * f[j];
        hph += f[j] * g[j];
    }
    const ins_status_t status = kalman_judge(z, hph);
    if (status != INS_OK)
    {
        return status;
    }
    ins_real alpha = z->r;
    for (unsigned j = 0; j < n; j++)
    {
        ins_real* const u = UD + column(j);
        const ins_real lambda = -f[j] / alpha;
        const ins_real beta = alpha;
        alpha += f[j] * g[j];
        u[j] *= beta / alpha;
        for (unsigned i = 0; i < j; i++)
        {
            const ins_real before = u[i];
            u[i] += lambda * K[i];
            K[i] += g[j] * before;
        }
        K[j] = g[j];
    }
    const ins_real scale = 1 / alpha;
    for (unsigned i = 0; i < n; i++)
    {
        K[i] *= scale;
        x[i] += K[i] * z->v;
    }
    return INS_OK;
}
