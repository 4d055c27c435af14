/// \file   spline_internal.h
/// \brief  Natural cubic splines of three angles over one column of time.
/// SPDX-License-Identifier: MIT
#ifndef INS_TRUTH_SPLINE_INTERNAL_H_INCLUDED
#define INS_TRUTH_SPLINE_INTERNAL_H_INCLUDED
#include "why_internal.h"

typedef struct ins_spline_t
{
    size_t rows;
    double* t;          ///< [rows] [s]; the head of the one block that holds all columns
    double* y[3];       ///< [3][rows] [rad]
    double* y2[3];      ///< [3][rows] second derivatives [rad/s^2]
    double excursion;   ///< sum of the three largest |y - y[0]| [rad]
    double speed_bound; ///< not below the sum of the three |slopes| anywhere [rad/s]
} ins_spline_t;

/// y = yaw, pitch, roll. \return false, with nothing to free, when the table is refused.
bool ins_spline_init(ins_spline_t* self, size_t rows, const double* t, const double* const y[3], const ins_why_t* why);
void ins_spline_free(ins_spline_t* self);
void ins_spline_at(const ins_spline_t* self, double t, double value[3], double slope[3]);
/// The first knot after t; infinity behind the last.
double ins_spline_next_knot(const ins_spline_t* self, double t);

#endif // INS_TRUTH_SPLINE_INTERNAL_H_INCLUDED
