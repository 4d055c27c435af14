/// \file   elementary.c
/// \brief  exp(-x), sine and cosine by Taylor series on a reduced argument.
/// SPDX-License-Identifier: MIT
#include "elementary_internal.h"

#define DECAY_SMALL   INS_C(0.25)
#define DECAY_NOTHING INS_C(800.0) ///< exp(-800) is 0 in double
#define DECAY_TERMS   INS_TOL(12, 7)
#define TURN_TERMS    INS_TOL(9, 5)                               ///< up to x^18 / 18! at pi/4: 2e-18
#define QUARTERS      INS_C(0.63661977236758134308)               ///< 2 / pi
#define HALF_PI_HIGH  INS_TOL(1.57079632673412561417, 1.5703125f) ///< 33 or 9 bits, so that times a count it is exact
#define HALF_PI_LOW   INS_TOL(6.07710050650619224932e-11, 4.83826794896619e-4f)

ins_real ins_elementary_decay(ins_real x, ins_real* rest)
{
    ins_real e = 0;
    ins_real r = 1;
    if (x < DECAY_NOTHING)
    {
        unsigned halvings = 0;
        for (; x > DECAY_SMALL; halvings++)
        {
            x /= 2;
        }
        r = 0; // 1 - exp(-x) = x (1 - x/2 (1 - x/3 (1 - ...)))
        for (unsigned k = DECAY_TERMS; k > 0; k--)
        {
            r = x / (ins_real)k * (1 - r);
        }
        e = 1 - r;
        for (; halvings > 0; halvings--)
        {
            r *= 2 - r;
            e *= e;
        }
    }
    if (rest)
    {
        *rest = r;
    }
    return e;
}

void ins_elementary_turn(ins_real x, ins_real* sine, ins_real* cosine)
{
    const int quarter = (int)(x * QUARTERS + (x < 0 ? INS_C(-0.5) : INS_C(0.5)));
    const ins_real y = x - (ins_real)quarter * HALF_PI_HIGH - (ins_real)quarter * HALF_PI_LOW;
    const ins_real u = y * y;
    ins_real s = 1;
    ins_real c = 1;
    for (unsigned k = TURN_TERMS; k > 0; k--)
    {
        s = 1 - s * u / (ins_real)(2 * k * (2 * k + 1));
        c = 1 - c * u / (ins_real)(2 * k * (2 * k - 1));
    }
    s *= y;
    *sine = (quarter & 1) ? c : s;
    *cosine = (quarter & 1) ? s : c;
    if (quarter & 2)
    {
        *sine = -*sine;
    }
    if ((quarter + 1) & 2)
    {
        *cosine = -*cosine;
    }
}

ins_real ins_elementary_wrap(ins_real x)
{
    const int turns = (int)(x * QUARTERS / 4 + (x < 0 ? INS_C(-0.5) : INS_C(0.5)));
    return x - (ins_real)(4 * turns) * HALF_PI_HIGH - (ins_real)(4 * turns) * HALF_PI_LOW;
}
