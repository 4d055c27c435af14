/// \file   givens_internal.h
/// \brief  Least squares row by row with Givens rotations: no normal equations, and no memory of the rows.
///
/// Source: G. H. Golub, C. F. Van Loan, Matrix Computations, section 5.1.8.
/// SPDX-License-Identifier: MIT
#ifndef INS_GIVENS_INTERNAL_H_INCLUDED
#define INS_GIVENS_INTERNAL_H_INCLUDED
#include "ins/config.h"

/// Takes one row into the triangle: row . x = p[j] for the right-hand sides j. What is left of p is the residual's share.
/// \param[in,out] R    [n*n] upper triangle, row-major.
/// \param[in,out] row  [n]; used up.
/// \param[in,out] z    [m*n] right-hand sides of the triangle, one after the other.
/// \param[in,out] p    [m].
void ins_givens_add(unsigned n, ins_real* R, ins_real* row, unsigned m, ins_real* z, ins_real* p);

/// R x = z by back substitution. \param[in] z  [n]; x may be z. \return INS_OK; INS_E_STATE when R is not of full rank.
ins_status_t ins_givens_solve(unsigned n, const ins_real* R, const ins_real* z, ins_real* x);

#endif // INS_GIVENS_INTERNAL_H_INCLUDED
