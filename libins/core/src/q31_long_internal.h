/// \file   q31_long_internal.h
/// \brief  What the fixed-point attitude step is made of, by products of 32 x 32 bits. q31_split_internal.h: the same by 16 x 16.
///
/// Straight lines, no loops: gcc -O2 makes one instruction of each q31_mac, and would keep a loop.
/// SPDX-License-Identifier: MIT
#ifndef INS_Q31_LONG_INTERNAL_H_INCLUDED
#define INS_Q31_LONG_INTERNAL_H_INCLUDED
#include "ins/config.h"

/// sum + a b
static inline int64_t q31_mac(int64_t sum, int32_t a, int32_t b)
{
    return sum + (int64_t)a * b;
}

/// floor(x / 2^32). The shift is unsigned: after a signed one gcc 12 multiplies the result in 64 bits.
static inline int32_t q31_top(int64_t x)
{
    return (int32_t)(uint32_t)((uint64_t)x >> 32);
}

/// floor(a b / 2^32)
static inline int32_t q31_high(int32_t a, int32_t b)
{
    return q31_top(q31_mac(0, a, b));
}

/// floor(v v / 2^32)
static inline int32_t q31_square3(const int32_t v[3])
{
    return q31_top(q31_mac(q31_mac(q31_mac(0, v[0], v[0]), v[1], v[1]), v[2], v[2]));
}

/// floor(q q / 2^30): the norm wants the finer one
static inline int32_t q31_square4(const int32_t q[4])
{
    return (int32_t)(q31_mac(q31_mac(q31_mac(q31_mac(0, q[0], q[0]), q[1], q[1]), q[2], q[2]), q[3], q[3]) >> 30);
}

/// k (7 newer - older) / 8
static inline int32_t q31_weigh(int32_t newer, int32_t older, int32_t k)
{
    return q31_high(newer - (newer >> 3) - (older >> 3), k);
}

/// phi = theta + w x theta, w = k (7 prev[0] - prev[1]) / 8
static inline void q31_coning(int32_t prev[2][3], const int32_t theta[3], int32_t k, int32_t phi[3])
{
    const int32_t x = q31_weigh(prev[0][0], prev[1][0], k);
    const int32_t y = q31_weigh(prev[0][1], prev[1][1], k);
    const int32_t z = q31_weigh(prev[0][2], prev[1][2], k);
    phi[0] = theta[0] + q31_high(y, theta[2]) - q31_high(z, theta[1]);
    phi[1] = theta[1] + q31_high(z, theta[0]) - q31_high(x, theta[2]);
    phi[2] = theta[2] + q31_high(x, theta[1]) - q31_high(y, theta[0]);
}

/// x - round(s x / 2^33)
static inline int32_t q31_shorten_one(int32_t x, int32_t s)
{
    return x - ((q31_high(s, x) + 1) >> 1);
}

static inline void q31_shorten(int32_t v[3], int32_t s)
{
    v[0] = q31_shorten_one(v[0], s);
    v[1] = q31_shorten_one(v[1], s);
    v[2] = q31_shorten_one(v[2], s);
}

#endif // INS_Q31_LONG_INTERNAL_H_INCLUDED
