/// \file   earth_internal.h
/// \brief  WGS-84 at one latitude and height, in place of calls, for the strapdown step. SI.
/// SPDX-License-Identifier: MIT
#ifndef INS_EARTH_INTERNAL_H_INCLUDED
#define INS_EARTH_INTERNAL_H_INCLUDED
#include "ins/earth.h"

#define WGS84_A       INS_C(6378137.)
#define WGS84_F       INS_C(3.35281066474748072e-3)
#define WGS84_E2      INS_C(6.69437999014131699e-3)
#define WGS84_GAMMA_E INS_C(9.7803253359)        ///< normal gravity on the equator [m/s^2]
#define WGS84_K       INS_C(1.93185265241e-3)    ///< Somigliana's k
#define WGS84_M       INS_C(3.44978650684084e-3) ///< w^2 a^2 b / GM

typedef struct earth_t
{
    ins_real meridian; ///< R_M + h [m]
    ins_real normal;   ///< R_N + h [m]
    ins_real gravity;  ///< [m/s^2]
} earth_t;

/// 1 / W = 1 / sqrt(1 - e^2 s2), minimax (tools/minimax.py): to 1.0e-17 in double, 3.0e-9 in float. No root: it is a call on some
/// targets and a branch on the others.
static inline ins_real earth_per_w(ins_real s2)
{
#ifdef INS_REAL_FLOAT
    return 1 + s2 * (0.003347136741f + s2 * 1.69471516e-5f);
#else
    return 1 +
           s2 * (0.00334718999507138728 +
                 s2 * (0.0000168055212861587437 +
                       s2 * (9.37521574168762906e-8 + s2 * (5.49091150261538013e-10 + s2 * 3.37030573456161992e-12))));
#endif
}

/// R_N = a / W, R_M = a (1 - e^2) / W^3, gamma_0 = gamma_e (1 + k s^2) / W, W^2 = 1 - e^2 s^2.
static inline void earth_at(ins_real s, ins_real h, earth_t* out)
{
    const ins_real s2 = s * s;
    const ins_real per_w = earth_per_w(s2);
    out->normal = WGS84_A * per_w + h;
    out->meridian = (WGS84_A * (1 - WGS84_E2)) * (per_w * per_w * per_w) + h;
    const ins_real fall = (2 / WGS84_A) * (1 + WGS84_F + WGS84_M) - (4 * WGS84_F / WGS84_A) * s2;
    const ins_real gamma = (WGS84_GAMMA_E + WGS84_GAMMA_E * WGS84_K * s2) * per_w;
    out->gravity = gamma - gamma * h * (fall - (3 / WGS84_A / WGS84_A) * h);
}

#endif // INS_EARTH_INTERNAL_H_INCLUDED
