/// \file   ins_truth/elementary.h
/// \brief  Sine, cosine, arc tangent, logarithm, exponential in double from + - * /, fabs and floor: the same bits on every x86-64.
///
/// A C library's sin() differs in the last bit between versions and with FMA; what reaches a converter code or a trace
/// uses these.
/// SPDX-License-Identifier: MIT
#ifndef INS_TRUTH_ELEMENTARY_H_INCLUDED
#define INS_TRUTH_ELEMENTARY_H_INCLUDED
#include "ins_truth/api.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_TRUTH_PI 3.14159265358979323846

/// \param[in] x [rad]. Absolute error at most 1e-15 for |x| <= 1e6, then about one ulp of x. NaN, infinity: NaN.
INS_TRUTH_API void ins_truth_sincos(double x, double* sine, double* cosine);
/// In [-pi, pi], error at most 1e-15; atan2(0, 0) = 0. x and y finite.
INS_TRUTH_API double ins_truth_atan2(double y, double x);
/// Natural logarithm of a positive normal number, error at most 1e-15 of max(1, |log x|). Zero, negative, infinity,
/// NaN: NaN.
INS_TRUTH_API double ins_truth_log(double x);
/// e^x, relative error at most 1e-15. Below -708: 0; above 709: infinity; NaN: NaN.
INS_TRUTH_API double ins_truth_exp(double x);

#ifdef __cplusplus
}
#endif
#endif // INS_TRUTH_ELEMENTARY_H_INCLUDED
