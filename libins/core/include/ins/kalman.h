/// \file   ins/kalman.h
/// \brief  Kalman filter of n states over the caller's arrays: Joseph form (full P) and UD form (P = U D U').
///
///     ins_real x[3], P[9], work[INS_KALMAN_WORK(3)], nis;
///     ins_kalman_predict(3, x, P, Phi, Q, work);                            // x = Phi x, P = Phi P Phi' + Q
///     ins_innovation_t z = {z0 - x[0], r, INS_KALMAN_GATE_99, 0};           // one scalar at a time: R is diagonal
///     ins_status_t s = ins_kalman_update(3, x, P, h, &z, work);             // z.nis is set; the gain is in work[0..2]
///
/// Nothing is kept between calls but the caller's arrays: a snapshot is their copy. An extended filter puts its own x after the
/// covariance: call predict with x = 0 (a null pointer), or update with v = z - h(x) and the Jacobian's row as h.
/// UD costs about twice as much and stands a P0/R that is some 1e4 times larger in float: docs/kalman.md has the figures.
/// Matrices are row-major. UD is packed by columns: U(i,j), i < j, at j (j+1)/2 + i; D(j) at j (j+1)/2 + j.
/// Source: P. D. Joseph in Bucy and Joseph (1968); G. J. Bierman, Factorization Methods (1977), V.3 (measurement), VI.4 (Thornton).
/// Cost:   no libm, no allocation. Zeros in Phi are skipped.
/// SPDX-License-Identifier: MIT
#ifndef INS_KALMAN_H_INCLUDED
#define INS_KALMAN_H_INCLUDED
#include "ins/config.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_KALMAN_WORK(n) ((n) * (n) + (n))         ///< reals of scratch for the Joseph functions
#define INS_UD_SIZE(n)     ((n) * ((n) + 1) / 2)     ///< reals of a packed U and D
#define INS_UD_WORK(n)     (2 * (n) * (n) + 4 * (n)) ///< reals of scratch for the UD functions

#define INS_KALMAN_GATE_99  INS_C(6.6348966)  ///< chi-squared, 1 degree of freedom, 99 %
#define INS_KALMAN_GATE2_99 INS_C(9.2103404)  ///< 2 degrees of freedom, 99 %: -2 ln 0.01
#define INS_KALMAN_GATE_999 INS_C(10.8275662) ///< 1 degree of freedom, 99.9 %

/// One scalar measurement as the filter sees it.
typedef struct ins_innovation_t
{
    ins_real v;    ///< z - h(x)
    ins_real r;    ///< variance of the measurement noise, > 0
    ins_real gate; ///< refused if v^2 / (h P h' + r) is above; 0: no gate
    ins_real nis;  ///< out: v^2 / (h P h' + r), set also when refused by the gate
} ins_innovation_t;

/// x = Phi x and P = Phi P Phi' + Q.
/// \param[in,out] x  [n], or 0: the caller has moved it by its own model. \param[in,out] P  [n n] symmetric.
/// \param[in] Phi  [n n]. \param[in] Q  [n n]. \param work  [INS_KALMAN_WORK(n)].
INS_API void ins_kalman_predict(unsigned n, ins_real* x, ins_real* P, const ins_real* Phi, const ins_real* Q,
                                ins_real* work);
/// x = x + K v and P = (I - K h) P (I - K h)' + K r K'.
/// \param[in] h  [n] row of H. \param[out] work  [2 n]; the gain K is left in work[0..n-1].
/// \return INS_OK; INS_E_GATE: outside the gate, z->nis says how far; INS_E_RANGE: v or h P h' is not a number, or r is not
/// positive. Refused means that x and P are unchanged.
INS_API ins_status_t ins_kalman_update(unsigned n, ins_real* x, ins_real* P, const ins_real* h, ins_innovation_t* z,
                                       ins_real* work);

/// P = U D U'. \param[in] P  [n n] symmetric, positive semidefinite. \param[out] UD  [INS_UD_SIZE(n)]. \param work  [n n].
/// \return INS_OK; INS_E_RANGE: P is indefinite (beyond the rounding of its diagonal) or not a number; UD is then unchanged.
INS_API ins_status_t ins_ud_factor(unsigned n, const ins_real* P, ins_real* UD, ins_real* work);
/// P = U D U', from the factors.
INS_API void ins_ud_covariance(unsigned n, const ins_real* UD, ins_real* P);
/// x = Phi x and U D U' = Phi U D U' Phi' + Q by modified weighted Gram-Schmidt (Thornton).
/// \param[in,out] x  [n] or 0. \param[in] Q_ud  [INS_UD_SIZE(n)] ins_ud_factor() of Q. \param work  [INS_UD_WORK(n)].
INS_API void ins_ud_predict(unsigned n, ins_real* x, ins_real* UD, const ins_real* Phi, const ins_real* Q_ud,
                            ins_real* work);
/// As ins_kalman_update(), on the factors (Bierman). \param[out] work  [3 n]; the gain K is left in work[0..n-1].
INS_API ins_status_t ins_ud_update(unsigned n, ins_real* x, ins_real* UD, const ins_real* h, ins_innovation_t* z,
                                   ins_real* work);

#ifdef __cplusplus
}
#endif
#endif // INS_KALMAN_H_INCLUDED
