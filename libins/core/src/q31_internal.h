/// \file   q31_internal.h
/// \brief  Products of 32 x 32 bits and the coefficients of the fixed-point attitude step.
///
/// Qn: an integer x stands for x / 2^n. Every sum of products is kept in 64 bits and rounded once, to nearest: a floor would drift.
/// Right shifts of negative numbers are arithmetic on every compiler the core is built with.
/// SPDX-License-Identifier: MIT
#ifndef INS_Q31_INTERNAL_H_INCLUDED
#define INS_Q31_INTERNAL_H_INCLUDED
#include "ins/config.h"

/// a b from four products of 16 bits, for cores without a long multiply (ARMv6-M): the same result.
static inline int64_t q31_wide_split(int32_t a, int32_t b)
{
    const uint32_t a_low = (uint32_t)a & 0xFFFFu;
    const uint32_t b_low = (uint32_t)b & 0xFFFFu;
    const int32_t a_high = a >> 16;
    const int32_t b_high = b >> 16;
    const uint32_t low = a_low * b_low;
    const int32_t middle = a_high * (int32_t)b_low + (int32_t)(low >> 16);
    const int32_t upper = (int32_t)a_low * b_high + (middle & 0xFFFF);
    const int32_t high = a_high * b_high + (middle >> 16) + (upper >> 16);
    return (int64_t)(((uint64_t)(uint32_t)high << 32) | ((uint32_t)upper << 16) | (low & 0xFFFFu));
}

#if defined(__ARM_ARCH_6M__) || defined(__ARM_ARCH_8M_BASE__)
#define Q31_SPLIT  1
#define Q31_INLINE // one copy: the split product is long
#else
#define Q31_SPLIT  0
#define Q31_INLINE inline
#endif

/// sum + a b
static Q31_INLINE int64_t q31_mac(int64_t sum, int32_t a, int32_t b)
{
    return sum + (Q31_SPLIT ? q31_wide_split(a, b) : (int64_t)a * b);
}

/// x / 2^32, rounded.
static inline int32_t q31_high(int64_t x)
{
    return (int32_t)((x + INT64_C(0x80000000)) >> 32);
}

/// Coefficients with u = |phi|^2 in Q32 <= 1/4 (tools/fixed.py): cos(|phi|/2) - 1 = u (COS_1 + u (COS_2 + u COS_3)), error 3e-11, and
/// sin(|phi|/2) / |phi| - 1/2 = u (SINC_1 + u (SINC_2 + u SINC_3)), error 4e-12. The first is -1/8, 1/384, -1/46080 in Q33 but for
/// the last digits, the second -1/48, 1/3840, -1/645120 in Q34.
#define Q31_COS_1  INT32_C(-1073741824)
#define Q31_COS_2  INT32_C(22369592)
#define Q31_COS_3  INT32_C(-186102)
#define Q31_SINC_1 INT32_C(-357913941)
#define Q31_SINC_2 INT32_C(4473921)
#define Q31_SINC_3 INT32_C(-26596)
/// 7/60 theta_1 - 1/60 theta_2 = 8/60 (7 theta_1 - theta_2) / 8, in Q33
#define Q31_CONING INT32_C(1145324612)

/// c is n / d in Qbits to `tight` bits, and fits an int32: a slip in a coefficient, or one too large, does not compile.
#define Q31_OFF(c, n, d, bits) ((int64_t)(c) * (d) - (n) * (INT64_C(1) << (bits)))
#define Q31_IS(c, n, d, bits, tight)                                                                                   \
    typedef char c##_is[(c) >= -INT64_C(2147483647) && (c) <= INT64_C(2147483647) &&                                   \
                                Q31_OFF(c, n, d, bits) <= INT64_C(1) << ((bits) - (tight)) &&                          \
                                Q31_OFF(c, n, d, bits) >= -(INT64_C(1) << ((bits) - (tight)))                          \
                            ? 1                                                                                        \
                            : -1]

/// d = {cos(|phi|/2) - 1, phi sin(|phi|/2) / |phi|} in Q33. \return 0 if |theta| or |phi| is above 0.5.
int ins_q31_turn(int32_t prev[2][3], const int32_t theta[3], int32_t d[4]);
/// out = q (d + (1 - |q|^2) / 2) in Q63, q in Q30: what to add to q, the correction of its norm included.
void ins_q31_change(const int32_t q[4], const int32_t d[4], int64_t out[4]);
ins_status_t ins_q31_remember(int32_t prev[2][3], uint_least8_t* count, const int32_t theta[3]);
/// 1 if |q| is within 1e-3 of 1.
int ins_q31_is_unit(const int32_t q[4]);

#endif // INS_Q31_INTERNAL_H_INCLUDED
