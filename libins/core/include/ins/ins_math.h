/// \file   ins/ins_math.h
/// \brief  The few functions of <math.h> that the core uses, in the precision of ins_real.
///
/// Only sqrt and fabs (both exact to the last bit by IEEE 754) are used where a navigation state is made. sin, cos and atan2
/// serve the Euler angles alone, and may differ in the last bits between C libraries.
/// SPDX-License-Identifier: MIT
#ifndef INS_MATH_H_INCLUDED
#define INS_MATH_H_INCLUDED
#include "ins/config.h"
#include <math.h>

#ifdef INS_REAL_FLOAT
#define ins_sqrt  sqrtf
#define ins_fabs  fabsf
#define ins_sin   sinf
#define ins_cos   cosf
#define ins_atan2 atan2f
#else
#define ins_sqrt  sqrt
#define ins_fabs  fabs
#define ins_sin   sin
#define ins_cos   cos
#define ins_atan2 atan2
#endif

#endif // INS_MATH_H_INCLUDED
