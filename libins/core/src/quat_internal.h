/// \file   quat_internal.h
/// \brief  Quaternion product and rotation in place of calls, for the attitude and strapdown steps. Scalar first.
/// SPDX-License-Identifier: MIT
#ifndef INS_QUAT_INTERNAL_H_INCLUDED
#define INS_QUAT_INTERNAL_H_INCLUDED
#include "ins/config.h"
#include "ins/vec.h"

static inline void quat_mul(const ins_real p[4], const ins_real q[4], ins_real out[4])
{
    // w and x, y and z are the same sums of other elements: compilers for two lanes find it. A small rotation's terms come together
    // before they meet the large one, so float drifts less.
    const ins_real a[4] = {-p[1], p[0], p[3], -p[2]};
    const ins_real w = p[0] * q[0] - (p[2] * q[2] - a[0] * q[1] + a[2] * q[3]);
    const ins_real x = p[1] * q[0] - (p[3] * q[2] - a[1] * q[1] + a[3] * q[3]);
    const ins_real y = p[2] * q[0] + (p[0] * q[2] + a[2] * q[1] + a[0] * q[3]);
    const ins_real z = p[3] * q[0] + (p[1] * q[2] + a[3] * q[1] + a[1] * q[3]);
    out[0] = w;
    out[1] = x;
    out[2] = y;
    out[3] = z;
}

/// q v q* = v + 2 w (r x v) + 2 r x (r x v), r = vector part. out may be v.
static inline void quat_rotate(const ins_real q[4], const ins_real v[3], ins_real out[3])
{
    ins_real t[3];
    ins_real r_t[3];
    ins_vec_cross(q + 1, v, t);
    ins_vec_cross(q + 1, t, r_t);
    ins_vec_copy(v, out);
    ins_vec_add_scaled(out, 2 * q[0], t);
    ins_vec_add_scaled(out, 2, r_t);
}

static inline ins_real quat_norm2(const ins_real q[4])
{
    return q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
}

#endif // INS_QUAT_INTERNAL_H_INCLUDED
