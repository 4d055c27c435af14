/// \file   spline_internal.h
/// \brief  Natural cubic splines of three angles or three distances over one column of time.
/// SPDX-License-Identifier: MIT
#ifndef INS_TRUTH_SPLINE_INTERNAL_H_INCLUDED
#define INS_TRUTH_SPLINE_INTERNAL_H_INCLUDED
#include "why_internal.h"

/// What the columns are, for checks and refusals.
typedef struct ins_spline_kind_t
{
    const char* column[3];
    const char* unit;
    double most; ///< of |y|
    double step; ///< the most between two rows
} ins_spline_kind_t;

extern const ins_spline_kind_t ins_spline_angles; ///< a step above pi is refused
extern const ins_spline_kind_t ins_spline_metres;

typedef struct ins_spline_t
{
    size_t rows;
    double* t;          ///< [rows] [s]; the head of the one block that holds all columns
    double* y[3];       ///< [3][rows]
    double* y2[3];      ///< [3][rows] second derivatives
    double excursion;   ///< sum of the three largest |y - y[0]|
    double speed_bound; ///< not below the sum of the three |slopes| anywhere [1/s]
} ins_spline_t;

/// \return false, with nothing to free, when the table is refused.
bool ins_spline_init(ins_spline_t* self, const ins_spline_kind_t* kind, size_t rows, const double* t,
                     const double* const y[3], const ins_why_t* why);
void ins_spline_free(ins_spline_t* self);
void ins_spline_at(const ins_spline_t* self, double t, double value[3], double slope[3]);
/// Second derivatives; 0 outside the rows.
void ins_spline_bend(const ins_spline_t* self, double t, double bend[3]);
/// The first knot after t; infinity behind the last.
double ins_spline_next_knot(const ins_spline_t* self, double t);

#endif // INS_TRUTH_SPLINE_INTERNAL_H_INCLUDED
