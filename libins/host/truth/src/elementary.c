/// \file   elementary.c
/// \brief  Elementary functions from +, -, *, / and floor: argument reduction (Cody and Waite 1980) and Taylor series.
/// SPDX-License-Identifier: MIT
#include "ins_truth/elementary.h"
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

// pi / 2 in three parts. The first two have 33 bits, so that n times them is exact for n < 2^20.
static const double half_pi_1 = 0x1.921fb544p+0;
static const double half_pi_2 = 0x1.0b4611a6p-34;
static const double half_pi_3 = 0x1.3198a2e037073p-69;
// log 2; the first part has 32 bits.
static const double ln2_1 = 0x1.62e42feep-1;
static const double ln2_2 = 0x1.a39ef35793c76p-33;

/// c[0] + c[1] z + ... + c[7] z^7
static double series(const double c[8], double z)
{
    double p = c[7];
    for (int k = 6; k >= 0; k--)
    {
        p = c[k] + z * p;
    }
    return p;
}

/// |y| <= pi / 4; the first term left out is y^19 / 19! < 1e-19.
static double sine_kernel(double y)
{
    static const double c[8] = {-1.0 / 6.0,        1.0 / 120.0,        -1.0 / 5040.0,          1.0 / 362880.0,
                                -1.0 / 39916800.0, 1.0 / 6227020800.0, -1.0 / 1307674368000.0, 1.0 / 355687428096000.0};
    return y + y * (y * y * series(c, y * y));
}

/// |y| <= pi / 4; the first term left out is y^18 / 18! < 3e-18.
static double cosine_kernel(double y)
{
    static const double c[8] = {-1.0 / 2.0,       1.0 / 24.0,        -1.0 / 720.0,         1.0 / 40320.0,
                                -1.0 / 3628800.0, 1.0 / 479001600.0, -1.0 / 87178291200.0, 1.0 / 20922789888000.0};
    return 1.0 + y * y * series(c, y * y);
}

void ins_truth_sincos(double x, double* sine, double* cosine)
{
    const double n = floor(x * (2.0 / INS_TRUTH_PI) + 0.5);
    const double y = ((x - n * half_pi_1) - n * half_pi_2) - n * half_pi_3;
    const double quadrant = n - 4.0 * floor(0.25 * n);
    const double s = sine_kernel(y);
    const double c = cosine_kernel(y);
    const double a = quadrant == 1.0 || quadrant == 3.0 ? c : s;
    const double b = quadrant == 1.0 || quadrant == 3.0 ? s : c;
    *sine = quadrant >= 2.0 ? -a : a;
    *cosine = quadrant == 1.0 || quadrant == 2.0 ? -b : b;
}

/// 0 <= t <= 1
static double arc_tangent(double t)
{
    const double tan_eighth_pi = 0.41421356237309503;
    const double z = t > tan_eighth_pi ? (t - 1.0) / (t + 1.0) : t;
    double p = 0.0;
    for (int k = 41; k >= 1; k -= 2) // the next term is below 1e-18
    {
        p = 1.0 / (double)k - p * z * z;
    }
    return t > tan_eighth_pi ? INS_TRUTH_PI / 4.0 + z * p : z * p;
}

double ins_truth_atan2(double y, double x)
{
    const double ay = fabs(y);
    const double ax = fabs(x);
    if (ay == 0.0 && ax == 0.0)
    {
        return 0.0;
    }
    double angle = ay > ax ? INS_TRUTH_PI / 2.0 - arc_tangent(ax / ay) : arc_tangent(ay / ax);
    angle = x < 0.0 ? INS_TRUTH_PI - angle : angle;
    return y < 0.0 ? -angle : angle;
}

double ins_truth_log(double x)
{
    if (!(x >= DBL_MIN && x <= DBL_MAX))
    {
        return (double)NAN;
    }
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    int exponent = (int)(bits >> 52) - 1023;
    bits = (bits & ((UINT64_C(1) << 52) - 1)) | UINT64_C(1023) << 52;
    double m; // x = m 2^exponent
    memcpy(&m, &bits, sizeof m);
    if (m > 1.4142135623730951)
    {
        m *= 0.5;
        exponent++;
    }
    const double z = (m - 1.0) / (m + 1.0); // log m = 2 artanh z, |z| < 0.172
    double p = 0.0;
    for (int k = 23; k >= 1; k -= 2) // the next term is below 1e-20
    {
        p = 1.0 / (double)k + p * z * z;
    }
    return exponent * ln2_1 + (exponent * ln2_2 + 2.0 * z * p);
}

double ins_truth_exp(double x)
{
    if (!(x >= -708.0 && x <= 709.0))
    {
        return x < -708.0 ? 0.0 : (x > 709.0 ? (double)INFINITY : (double)NAN);
    }
    const double n = floor(x / (ln2_1 + ln2_2) + 0.5);
    const double r = (x - n * ln2_1) - n * ln2_2;
    double p = 1.0;
    for (int k = 14; k >= 1; k--) // the next term is below 1e-19
    {
        p = 1.0 + p * r / (double)k;
    }
    const uint64_t bits = (uint64_t)(1023 + (int)n) << 52;
    double scale; // 2^n
    memcpy(&scale, &bits, sizeof scale);
    return p * scale;
}
