/// \file   math.h
/// \brief  The functions of <math.h> that the core may use, and no more: another one does not compile.
/// SPDX-License-Identifier: MIT
#ifndef INS_TESTS_SHIM16_MATH_H
#define INS_TESTS_SHIM16_MATH_H

double sqrt(double);
double fabs(double);
double sin(double);
double cos(double);
double atan2(double, double);
float sqrtf(float);
float fabsf(float);
float sinf(float);
float cosf(float);
float atan2f(float, float);

#endif // INS_TESTS_SHIM16_MATH_H
