/// \file   q31_internal.h
/// \brief  The fixed-point attitude step but for its last line. Frame: b -> n. Qn: an integer x stands for x / 2^n.
///
/// Right shifts of negative numbers are arithmetic on every compiler the core is built with.
/// SPDX-License-Identifier: MIT
#ifndef INS_Q31_INTERNAL_H_INCLUDED
#define INS_Q31_INTERNAL_H_INCLUDED
#include "ins/q31.h"

/// 1: products of 32 x 32 bits are formed of 16-bit ones, for cores without a long multiply (Thumb-1: ARMv6-M, ARMv8-M Baseline; 8051).
/// 0: one instruction each. The same results, and the same increments refused.
#ifndef Q31_SPLIT
#if (defined(__thumb__) && !defined(__thumb2__)) || defined(__SDCC)
#define Q31_SPLIT 1
#else
#define Q31_SPLIT 0
#endif
#endif

#if Q31_SPLIT
#include "q31_split_internal.h"
#else
#include "q31_long_internal.h"
#endif

/// Polynomials in u = |phi|^2 in Q30, below 1/4; v = u in Q14 (tools/fixed.py).
/// cos(|phi|/2) - 1 = -u/2 (1/4) + u^2 (COS_2 - COS_3 v), error 6e-11, COS_2 in Q36, COS_3 in Q22.
#define Q31_COS_2 INT32_C(178957232)
#define Q31_COS_3 INT32_C(91)
/// 1/2 - sin(|phi|/2) / |phi| = u (SINC_1 - u (SINC_2 - SINC_3 v)), error 3e-12, in Q36, Q41, Q27.
#define Q31_SINC_1 INT32_C(1431655768)
#define Q31_SINC_2 INT32_C(572663179)
#define Q31_SINC_3 INT32_C(208)
/// 7/60 theta_1 - 1/60 theta_2 = 2/15 (7 theta_1 - theta_2) / 8, in Q33
#define Q31_CONING INT32_C(1145324612)

#define Q31_HALF_RAD  (UINT32_C(1) << 30)
#define Q31_U_END     (INT32_C(1) << 28) ///< |phi| = 0.5, in Q30
#define Q31_ONE_Q28   (INT32_C(1) << 28)
#define Q31_NORM2_TOL (UINT32_C(1) << 19) ///< 2^-9 of |q|^2, in Q28

/// sum += q d, the product of quaternions, to the last bit.
static inline void q31_change(const int32_t q[4], const int32_t d[4], int64_t sum[4])
{
    const int32_t w = d[0];
    const int32_t x = d[1];
    const int32_t y = d[2];
    const int32_t z = d[3];
    sum[0] = q31_mac(q31_mac(q31_mac(q31_mac(sum[0], q[0], w), q[1], -x), q[2], -y), q[3], -z);
    sum[1] = q31_mac(q31_mac(q31_mac(q31_mac(sum[1], q[0], x), q[1], w), q[2], z), q[3], -y);
    sum[2] = q31_mac(q31_mac(q31_mac(q31_mac(sum[2], q[0], y), q[1], -z), q[2], w), q[3], x);
    sum[3] = q31_mac(q31_mac(q31_mac(q31_mac(sum[3], q[0], z), q[1], y), q[2], -x), q[3], w);
}

#if !Q31_SPLIT
/// q += round(q d / 2^32), the product of quaternions.
static inline void q31_rotate(int32_t q[4], const int32_t d[4])
{
    const int64_t half = INT64_C(0x80000000);
    const int64_t one = INT64_C(1) << 32;
    int64_t sum[4] = {q[0] * one + half, q[1] * one + half, q[2] * one + half, q[3] * one + half};
    q31_change(q, d, sum);
    q[0] = q31_top(sum[0]);
    q[1] = q31_top(sum[1]);
    q[2] = q31_top(sum[2]);
    q[3] = q31_top(sum[3]);
}
#endif

/// 1 if a component is outside [-0.5, 0.5) rad.
static inline int q31_too_long(const int32_t v[3])
{
    return ((((uint32_t)v[0] + Q31_HALF_RAD) | ((uint32_t)v[1] + Q31_HALF_RAD) | ((uint32_t)v[2] + Q31_HALF_RAD)) >>
            31) != 0;
}

/// d = {cos(|phi|/2) - 1 + (1 - |q|^2) / 2, phi sin(|phi|/2) / |phi|} in Q32: the turn that changes q (Q30) by q d, the
/// correction of its norm included. \return 0 if a component of theta, or |phi|, is 0.5 or more.
static inline int q31_turn(int32_t prev[2][3], const int32_t theta[3], const int32_t q[4], int32_t d[4])
{
    if (q31_too_long(theta))
    {
        return 0;
    }
    int32_t* phi = d + 1; // below 0.57: theta was accepted below 0.54
    q31_coning(prev, theta, Q31_CONING, phi);
    const int32_t u = q31_square3(phi);
    if (u >= Q31_U_END)
    {
        return 0;
    }
    const int32_t v = u >> 16;
    const int32_t c = q31_high(u, q31_high(u, Q31_COS_2 - Q31_COS_3 * v));
    const int32_t s = q31_high(u, Q31_SINC_1 - (q31_high(u, Q31_SINC_2 - Q31_SINC_3 * v) >> 3)); // Q34
    d[0] = c - (u >> 1) - (q31_square4(q) - INS_Q31_ONE) * 2;
    q31_shorten(phi, s);
    return 1;
}

/// Components moved as one.
typedef struct q31_vector_t
{
    int32_t v[3];
} q31_vector_t;

typedef struct q31_quaternion_t
{
    int32_t v[4];
} q31_quaternion_t;

static inline ins_status_t q31_remember(int32_t prev[2][3], uint_least8_t* count, const int32_t theta[3])
{
    *(q31_vector_t*)prev[1] = *(const q31_vector_t*)prev[0];
    *(q31_vector_t*)prev[0] = *(const q31_vector_t*)theta;
    if (*count == 2)
    {
        return INS_OK;
    }
    if (*count == 0)
    {
        // With one increment known, an earlier one of twice its size makes 7/60, -1/60 the 1/12 of the one-previous form.
        prev[1][0] = 2 * theta[0];
        prev[1][1] = 2 * theta[1];
        prev[1][2] = 2 * theta[2];
    }
    (*count)++;
    return INS_S_START;
}

/// 1 if |q| is within about 1e-3 of 1.
static inline int q31_is_unit(const int32_t q[4])
{
    uint32_t off = Q31_NORM2_TOL - (uint32_t)Q31_ONE_Q28;
    for (int i = 0; i < 4; i++)
    {
        const int32_t h = q[i] >> 16;
        off += (uint32_t)(h * h);
    }
    return off < 2 * Q31_NORM2_TOL;
}

/// c is n / d in Qbits to `tight` bits, and fits an int32: a slip in a coefficient, or one too large, does not compile.
#define Q31_OFF(c, n, d, bits) ((int64_t)(c) * (d) - (n) * (INT64_C(1) << (bits)))
#define Q31_IS(c, n, d, bits, tight)                                                                                   \
    typedef char c##_is[(c) >= -INT64_C(2147483647) && (c) <= INT64_C(2147483647) &&                                   \
                                Q31_OFF(c, n, d, bits) <= INT64_C(1) << ((bits) - (tight)) &&                          \
                                Q31_OFF(c, n, d, bits) >= -(INT64_C(1) << ((bits) - (tight)))                          \
                            ? 1                                                                                        \
                            : -1]

#endif // INS_Q31_INTERNAL_H_INCLUDED
