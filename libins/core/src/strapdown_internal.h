/// \file   strapdown_internal.h
/// \brief  The position in two parts, as a strapdown step needs it. SI, rad.
/// SPDX-License-Identifier: MIT
#ifndef INS_STRAPDOWN_INTERNAL_H_INCLUDED
#define INS_STRAPDOWN_INTERNAL_H_INCLUDED
#include "ins/strapdown.h"

/// Of the anchor, carried over an offset d of latitude by series: they err by d^3 / 6.
static inline void strapdown_sin_cos(const ins_strapdown_t* self, ins_real d, ins_real* s, ins_real* c)
{
    const ins_real s0 = self->sin_lat;
    const ins_real c0 = self->cos_lat;
    const ins_real half = INS_C(0.5) * d;
    *s = s0 + d * (c0 - half * s0);
    *c = c0 - d * (s0 + half * c0);
}

/// Moves the anchor to the position, and makes its sine and cosine.
void ins_strapdown_anchor(ins_strapdown_t* self);

/// Truth = estimate + x. \param[in] x  [9] attitude in n [rad], velocity [m/s], position north, east, down [m].
void ins_strapdown_correct(ins_strapdown_t* self, const ins_real x[9]);

#endif // INS_STRAPDOWN_INTERNAL_H_INCLUDED
