/// \file   rotvec_internal.h
/// \brief  cos(|phi|/2) and sin(|phi|/2)/|phi| as functions of u = |phi|^2: no root, no libm, no case for phi = 0.
///
/// Minimax polynomials for u <= 1/4 (Remez; tools/minimax.py prints them). Largest error over the range:
/// double (degree 4): 5.1e-16 and 2.3e-17; float (degree 2): 1.1e-8 and 7.6e-10.
/// SPDX-License-Identifier: MIT
#ifndef INS_ROTVEC_INTERNAL_H_INCLUDED
#define INS_ROTVEC_INTERNAL_H_INCLUDED
#include "ins/config.h"

#define HALF_U_MAX INS_C(0.25) ///< |phi| <= 0.5 rad

#ifdef INS_REAL_FLOAT
static inline ins_real half_cos_and_half(ins_real u)
{
    return 1.4999999894f + u * (-0.1249992385f + u * 0.002596039612f);
}

static inline ins_real half_sinc(ins_real u)
{
    return 0.4999999992f + u * (-0.02083327892f + u * 0.0002598359888f);
}
#else
/// cos(|phi|/2) + 1/2, as a renormalised product wants it
static inline ins_real half_cos_and_half(ins_real u)
{
    return 1.499999999999999487 +
           u * (-0.124999999999897477 +
                u * (0.00260416666338558109 + u * (-0.0000217013521351980557 + u * 9.67131371979679977e-8)));
}

/// sin(|phi|/2) / |phi|
static inline ins_real half_sinc(ins_real u)
{
    return 0.499999999999999977 +
           u * (-0.0208333333333286722 +
                u * (0.000260416666517498433 + u * (-1.55009753545218289e-6 + u * 5.3746487425792931e-9)));
}
#endif

/// The same for any finite u >= 0: the angle is halved until the polynomials hold, then the quaternion squared as often.
void ins_half_angle(ins_real u, ins_real* half_cos, ins_real* half_sinc_out);

#endif // INS_ROTVEC_INTERNAL_H_INCLUDED
