/// \file   ins/vec.h
/// \brief  Three-vectors as plain arrays. Any frame, any unit; the caller keeps them consistent.
///
/// Header only: each is a handful of multiplications, cheaper in place than as a call.
/// SPDX-License-Identifier: MIT
#ifndef INS_VEC_H_INCLUDED
#define INS_VEC_H_INCLUDED
#include "ins/config.h"
#ifdef __cplusplus
extern "C" {
#endif

/// a . b
static inline ins_real ins_vec_dot(const ins_real a[3], const ins_real b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// \param[out] out  [3] a x b; not the same array as a or b.
static inline void ins_vec_cross(const ins_real a[3], const ins_real b[3], ins_real out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/// \param[in,out] y  [3] y + k x
static inline void ins_vec_add_scaled(ins_real y[3], ins_real k, const ins_real x[3])
{
    y[0] += k * x[0];
    y[1] += k * x[1];
    y[2] += k * x[2];
}

/// 1 unless an element is NaN or infinite (the difference with itself is then NaN).
static inline int ins_vec_is_finite(const ins_real v[3])
{
    return v[0] - v[0] == 0 && v[1] - v[1] == 0 && v[2] - v[2] == 0;
}

/// to = from
static inline void ins_vec_copy(const ins_real from[3], ins_real to[3])
{
    to[0] = from[0];
    to[1] = from[1];
    to[2] = from[2];
}

#ifdef __cplusplus
}
#endif
#endif // INS_VEC_H_INCLUDED
