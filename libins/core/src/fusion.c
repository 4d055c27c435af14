/// \file   fusion.c
/// \brief  Fusion in information form: x = (sum P_i^-1)^-1 sum P_i^-1 x_i. GPS/DR switch.
/// SPDX-License-Identifier: MIT
#include "ins/fusion.h"

/// A = A^-1 by Gauss-Jordan in place, which needs no pivoting for a positive definite A; an indefinite one is refused.
static ins_status_t invert(unsigned n, ins_real* A)
{
    for (unsigned k = 0; k < n; k++)
    {
        const ins_real d = A[k * n + k];
        if (!(d > 0) || !(d <= INS_REAL_MAX))
        {
            return INS_E_RANGE;
        }
        A[k * n + k] = 1;
        for (unsigned j = 0; j < n; j++)
        {
            A[k * n + j] /= d;
        }
        for (unsigned i = 0; i < n; i++)
        {
            const ins_real f = A[i * n + k];
            if (i == k)
            {
                continue;
            }
            A[i * n + k] = 0;
            for (unsigned j = 0; j < n; j++)
            {
                A[i * n + j] -= f * A[k * n + j];
            }
        }
    }
    for (unsigned i = 0; i < n; i++) // symmetric again
    {
        for (unsigned j = 0; j < i; j++)
        {
            A[i * n + j] = (A[i * n + j] + A[j * n + i]) / 2;
            A[j * n + i] = A[i * n + j];
        }
    }
    return INS_OK;
}

void ins_fusion_clear(unsigned n, ins_real* info, ins_real* y)
{
    for (unsigned i = 0; i < n * n; i++)
    {
        info[i] = 0;
    }
    for (unsigned i = 0; i < n; i++)
    {
        y[i] = 0;
    }
}

ins_status_t ins_fusion_add(unsigned n, ins_real* info, ins_real* y, const ins_real* x, const ins_real* P,
                            ins_real* work)
{
    for (unsigned i = 0; i < n * n; i++)
    {
        work[i] = P[i];
    }
    if (invert(n, work) != INS_OK)
    {
        return INS_E_RANGE;
    }
    for (unsigned i = 0; i < n; i++)
    {
        for (unsigned j = 0; j < n; j++)
        {
            info[i * n + j] += work[i * n + j];
            y[i] += work[i * n + j] * x[j];
        }
    }
    return INS_OK;
}

ins_status_t ins_fusion_solve(unsigned n, const ins_real* info, const ins_real* y, ins_real* x, ins_real* P)
{
    for (unsigned i = 0; i < n * n; i++)
    {
        P[i] = info[i];
    }
    if (invert(n, P) != INS_OK)
    {
        return INS_E_RANGE;
    }
    for (unsigned i = 0; i < n; i++)
    {
        x[i] = 0;
        for (unsigned j = 0; j < n; j++)
        {
            x[i] += P[i * n + j] * y[j];
        }
    }
    return INS_OK;
}

ins_status_t ins_fusion_share(unsigned n, const ins_real* P, ins_real beta, ins_real* P_local)
{
    if (!(beta > 0) || !(beta <= 1))
    {
        return INS_E_RANGE;
    }
    for (unsigned i = 0; i < n * n; i++)
    {
        P_local[i] = P[i] / beta;
    }
    return INS_OK;
}

ins_status_t ins_switch_init(ins_switch_t* self, const ins_switch_config_t* cfg)
{
    if (cfg->back == 0 || !(cfg->hdop_max > 0) || !(cfg->gate >= 0))
    {
        return INS_E_RANGE;
    }
    self->cfg = *cfg;
    self->mode = INS_SWITCH_DR;
    self->good = 0;
    self->run = 0;
    return INS_OK;
}

int ins_switch_epoch(ins_switch_t* self, int valid, unsigned sats, ins_real hdop, ins_real nis)
{
    const ins_switch_config_t* const c = &self->cfg;
    self->good = valid && sats >= c->sats && hdop <= c->hdop_max && (!(c->gate > 0) || nis <= c->gate);
    if (!self->good)
    {
        self->run = 0;
        self->mode = INS_SWITCH_DR;
    }
    else if (self->run < c->back)
    {
        self->run++;
    }
    if (self->run == c->back)
    {
        self->mode = INS_SWITCH_GPS;
    }
    return self->mode;
}
