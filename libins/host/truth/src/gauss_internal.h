/// \file   gauss_internal.h
/// \brief  Gauss and Legendre's rule with 10 nodes on one panel: exact for polynomials of degree 19.
/// SPDX-License-Identifier: MIT
#ifndef INS_TRUTH_GAUSS_INTERNAL_H_INCLUDED
#define INS_TRUTH_GAUSS_INTERNAL_H_INCLUDED

#define INS_GAUSS_MOST 6 ///< components

/// A function of time with up to INS_GAUSS_MOST components.
typedef void ins_gauss_integrand_t(const void* ctx, double t, double value[]);

/// Adds the integral over [a, b] of n components to sum.
void ins_gauss_add(ins_gauss_integrand_t* f, const void* ctx, double a, double b, int n, double sum[]);

#endif // INS_TRUTH_GAUSS_INTERNAL_H_INCLUDED
