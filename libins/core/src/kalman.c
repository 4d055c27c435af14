/// \file   kalman.c
/// \brief  Kalman filter, Joseph form, one scalar measurement at a time.
/// SPDX-License-Identifier: MIT
#include "ins/kalman.h"
#include "kalman_internal.h"

void ins_kalman_predict(unsigned n, ins_real* x, ins_real* P, const ins_real* Phi, const ins_real* Q, ins_real* work)
{
    ins_real* const row = work + n * n;
    if (x)
    {
        kalman_times(n, Phi, x, row);
        for (unsigned i = 0; i < n; i++)
        {
            x[i] = row[i];
        }
    }
    for (unsigned i = 0; i < n; i++) // work = Phi P
    {
        for (unsigned j = 0; j < n; j++)
        {
            work[i * n + j] = 0;
        }
        for (unsigned k = 0; k < n; k++)
        {
            const ins_real phi = Phi[i * n + k];
            if (phi != 0)
            {
                for (unsigned j = 0; j < n; j++)
                {
                    work[i * n + j] += phi * P[k * n + j];
                }
            }
        }
    }
    for (unsigned j = 0; j < n; j++) // P = work Phi' + Q, upper triangle, and its mirror
    {
        for (unsigned i = 0; i <= j; i++)
        {
            row[i] = Q[i * n + j];
        }
        for (unsigned k = 0; k < n; k++)
        {
            const ins_real phi = Phi[j * n + k];
            if (phi != 0)
            {
                for (unsigned i = 0; i <= j; i++)
                {
                    row[i] += work[i * n + k] * phi;
                }
            }
        }
        for (unsigned i = 0; i <= j; i++)
        {
            P[i * n + j] = row[i];
            P[j * n + i] = row[i];
        }
    }
}

ins_status_t ins_kalman_update(unsigned n, ins_real* x, ins_real* P, const ins_real* h, ins_innovation_t* z,
                               ins_real* work)
{
    ins_real* const K = work;
    ins_real* const g = work + n; // P h'
    ins_real hph = 0;
    kalman_times(n, P, h, g);
    for (unsigned i = 0; i < n; i++)
    {
        hph += h[i] * g[i];
    }
    const ins_status_t status = kalman_judge(z, hph);
    if (status != INS_OK)
    {
        return status;
    }
    const ins_real scale = 1 / (hph + z->r);
    for (unsigned i = 0; i < n; i++)
    {
        K[i] = g[i] * scale;
        x[i] += K[i] * z->v;
    }
    // A = P - K g'; P = A - (A h' - r K) K', of which row i needs row i of P alone, and its upper part is enough.
    for (unsigned i = 0; i < n; i++)
    {
        ins_real* const row = P + i * n;
        ins_real rest = -z->r * K[i];
        for (unsigned j = 0; j < n; j++)
        {
            row[j] -= K[i] * g[j];
            rest += row[j] * h[j];
        }
        for (unsigned j = i; j < n; j++)
        {
            row[j] -= rest * K[j];
        }
    }
    for (unsigned i = 1; i < n; i++)
    {
        for (unsigned j = 0; j < i; j++)
        {
            P[i * n + j] = P[j * n + i];
        }
    }
    return INS_OK;
}
