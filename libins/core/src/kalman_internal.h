/// \file   kalman_internal.h
/// \brief  What both forms of the Kalman filter do alike.
/// SPDX-License-Identifier: MIT
#ifndef INS_KALMAN_INTERNAL_H_INCLUDED
#define INS_KALMAN_INTERNAL_H_INCLUDED
#include "ins/kalman.h"

/// Sets z->nis from the innovation's variance less r, and judges it.
static inline ins_status_t kalman_judge(ins_innovation_t* z, ins_real hph)
{
    const ins_real nis = z->v * z->v / (hph + z->r);
    if (!(z->r > 0) || !(hph >= 0) || !(nis <= INS_REAL_MAX))
    {
        return INS_E_RANGE;
    }
    z->nis = nis;
    return z->gate > 0 && nis > z->gate ? INS_E_GATE : INS_OK;
}

/// y = M x, M [n n].
static inline void kalman_times(unsigned n, const ins_real* M, const ins_real* x, ins_real* y)
{
    for (unsigned i = 0; i < n; i++)
    {
        ins_real sum = 0;
        for (unsigned k = 0; k < n; k++)
        {
            sum += M[i * n + k] * x[k];
        }
        y[i] = sum;
    }
}

#endif // INS_KALMAN_INTERNAL_H_INCLUDED
