/// \file   earth_internal.h
/// \brief  WGS-84 at one latitude and height, in place of calls, for the strapdown step. SI.
/// SPDX-License-Identifier: MIT
#ifndef INS_EARTH_INTERNAL_H_INCLUDED
#define INS_EARTH_INTERNAL_H_INCLUDED
#include "ins/earth.h"
#include "ins/ins_math.h"

#define WGS84_A       INS_C(6378137.)
#define WGS84_F       INS_C(3.35281066474748072e-3)
#define WGS84_E2      INS_C(6.69437999014131699e-3)
#define WGS84_GAMMA_E INS_C(9.7803253359)        ///< normal gravity on the equator [m/s^2]
#define WGS84_K       INS_C(1.93185265241e-3)    ///< Somigliana's k
#define WGS84_M       INS_C(3.44978650684084e-3) ///< w^2 a^2 b / GM

typedef struct earth_t
{
    ins_real per_meridian; ///< 1 / (R_M + h) [1/m]
    ins_real per_normal;   ///< 1 / (R_N + h) [1/m]
    ins_real gravity;      ///< [m/s^2]
} earth_t;

/// R_N = a / W, R_M = a (1 - e^2) / W^3, gamma_0 = gamma_e (1 + k s^2) / W, W^2 = 1 - e^2 s^2.
static inline void earth_at(ins_real s, ins_real h, earth_t* out)
{
    const ins_real s2 = s * s;
    const ins_real W2 = 1 - WGS84_E2 * s2;
    const ins_real W = ins_sqrt(ins_fabs(W2));
    const ins_real W3 = W * W2;
    out->per_normal = W / (WGS84_A + h * W);
    out->per_meridian = W3 / (WGS84_A * (1 - WGS84_E2) + h * W3);
    const ins_real fall = (2 / WGS84_A) * (1 + WGS84_F + WGS84_M) - (4 * WGS84_F / WGS84_A) * s2;
    out->gravity = (WGS84_GAMMA_E + WGS84_GAMMA_E * WGS84_K * s2) / W * (1 - h * (fall - (3 / WGS84_A / WGS84_A) * h));
}

#endif // INS_EARTH_INTERNAL_H_INCLUDED
