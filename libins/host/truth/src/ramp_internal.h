/// \file   ramp_internal.h
/// \brief  The start from rest that motions and tracks share: 10 x^3 - 15 x^4 + 6 x^5, its integral and its slope.
/// SPDX-License-Identifier: MIT
#ifndef INS_TRUTH_RAMP_INTERNAL_H_INCLUDED
#define INS_TRUTH_RAMP_INTERNAL_H_INCLUDED

/// Integral, value and derivative of an amplitude that is 1 when under way.
typedef struct ins_ramp_t
{
    double integral; ///< [s]
    double value;
    double slope; ///< [1/s]
} ins_ramp_t;

/// 0 for t <= 0, 1 from t = ramp_s > 0 on.
ins_ramp_t ins_ramp_at(double ramp_s, double t);

#endif // INS_TRUTH_RAMP_INTERNAL_H_INCLUDED
