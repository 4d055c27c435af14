/// \file   q31_split_internal.h
/// \brief  What the fixed-point attitude step is made of, by products of 16 x 16 bits: the results of q31_long_internal.h.
///
/// Small code: loops, and what is called often is a function. No sum leaves its 32 bits while one operand of q31_high is within
/// 2^30 and the other within 2^30 less a 400th (or 2^28.3 and 2^30.2: coning), |q| <= 1.002 and |d| < 0.2495 + 2^-9.
/// SPDX-License-Identifier: MIT
#ifndef INS_Q31_SPLIT_INTERNAL_H_INCLUDED
#define INS_Q31_SPLIT_INTERNAL_H_INCLUDED
#include "ins/config.h"

/// floor(a b / 2^32)
static int32_t q31_high(int32_t a, int32_t b)
{
    const int32_t a_high = a >> 16;
    const int32_t b_high = b >> 16;
    const uint32_t a_low = (uint32_t)a & 0xFFFFu;
    const uint32_t b_low = (uint32_t)b & 0xFFFFu;
    const int32_t low = (int32_t)((a_low * b_low) >> 16);
    return a_high * b_high + ((low + a_high * (int32_t)b_low + (int32_t)a_low * b_high) >> 16);
}

static inline int64_t q31_mac(int64_t sum, int32_t a, int32_t b)
{
    const uint32_t low = (uint32_t)a * (uint32_t)b;
    return sum + (int64_t)q31_high(a, b) * (INT64_C(1) << 32) + low;
}

/// The lower 15 bits of a, signed, -2^14 .. 2^14 - 1: sums of four products with them fit 32 bits.
static inline int32_t q31_low(int32_t a)
{
    return (int32_t)((uint32_t)a << 17) >> 17;
}

/// floor(sum of squares / 2^30), v up to end.
static uint32_t q31_square(const int32_t* v, const int32_t* end)
{
    uint32_t high = 0;  // 2^30; of a phi that is refused, above 2^31
    int32_t middle = 0; // 2^16
    int32_t low = 0;
    do
    {
        const int32_t l = q31_low(*v);
        const int32_t h = (*v - l) >> 15;
        high += (uint32_t)(h * h);
        middle += h * l;
        low += l * l;
        v++;
    } while (v != end);
    return high + (uint32_t)((middle + (low >> 16)) >> 14);
}

static inline int32_t q31_square3(const int32_t v[3])
{
    return (int32_t)(q31_square(v, v + 3) >> 2);
}

static inline int32_t q31_square4(const int32_t q[4])
{
    return (int32_t)q31_square(q, q + 4);
}

static inline void q31_coning(int32_t prev[2][3], const int32_t theta[3], int32_t k, int32_t phi[3])
{
    int32_t w[3];
    for (int i = 0; i < 3; i++)
    {
        w[i] = q31_high(prev[0][i] - (prev[0][i] >> 3) - (prev[1][i] >> 3), k);
    }
    phi[0] = theta[0] + q31_high(w[1], theta[2]) - q31_high(w[2], theta[1]);
    phi[1] = theta[1] + q31_high(w[2], theta[0]) - q31_high(w[0], theta[2]);
    phi[2] = theta[2] + q31_high(w[0], theta[1]) - q31_high(w[1], theta[0]);
}

static inline void q31_shorten(int32_t v[3], int32_t s)
{
    for (int i = 0; i < 3; i++)
    {
        v[i] -= (q31_high(s, v[i]) + 1) >> 1;
    }
}

/// q += round(q d / 2^32), the product of quaternions; d becomes what was added.
static inline void q31_rotate(int32_t q[4], int32_t d[4])
{
    const int32_t w = d[0];
    const int32_t x = d[1];
    const int32_t y = d[2];
    const int32_t z = d[3];
    const int32_t rows[4][4] = {{w, -x, -y, -z}, {x, w, z, -y}, {y, -z, w, x}, {z, y, -x, w}};
    for (int i = 0; i < 4; i++)
    {
        int32_t high = 2;   // 2^30; the 2 rounds
        int32_t middle = 0; // 2^15
        int32_t low = 0;
        for (int j = 0; j < 4; j++)
        {
            const int32_t a_low = q31_low(q[j]);
            const int32_t a_high = (q[j] - a_low) >> 15;
            const int32_t b_low = q31_low(rows[i][j]);
            const int32_t b_high = (rows[i][j] - b_low) >> 15;
            low += a_low * b_low; // this order: the fewest registers with gcc -Os
            middle += a_low * b_high;
            high += a_high * b_high;
            middle += a_high * b_low;
        }
        d[i] = (high + ((middle + (low >> 15)) >> 15)) >> 2;
    }
    for (int i = 0; i < 4; i++)
    {
        q[i] += d[i];
    }
}

#endif // INS_Q31_SPLIT_INTERNAL_H_INCLUDED
