/// \file   quat_internal.h
/// \brief  The quaternion product in place of a call, for the attitude step. Scalar first.
/// SPDX-License-Identifier: MIT
#ifndef INS_QUAT_INTERNAL_H_INCLUDED
#define INS_QUAT_INTERNAL_H_INCLUDED
#include "ins/config.h"

static inline void quat_mul(const ins_real p[4], const ins_real q[4], ins_real out[4])
{
    const ins_real w = p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3];
    const ins_real x = p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2];
    const ins_real y = p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1];
    const ins_real z = p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0];
    out[0] = w;
    out[1] = x;
    out[2] = y;
    out[3] = z;
}

static inline ins_real quat_norm2(const ins_real q[4])
{
    return q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
}

#endif // INS_QUAT_INTERNAL_H_INCLUDED
