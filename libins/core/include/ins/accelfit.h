/// \file   ins/accelfit.h
/// \brief  One accelerometer in full, fitted on the target: bias, scale factor, misalignments, quadratic term and place. Frame: b. SI.
///
///     ins_accelfit_t fit;
///     ins_accelfit_init(&fit, u0, e1, e2, p_guess);
///     ins_real step = 1;
///     while (step > tolerance)   // Gauss-Newton: some four passes over the measurements
///     {
///         for (unsigned k = 0; k < n; k++) { ins_accelfit_add(&fit, &motion[k], reading[k]); }
///         if (ins_accelfit_step(&fit, &step) != INS_OK) { break; }   // these poses do not fix all eight
///     }
///
/// The accelerometer reads SF (b + x + k2 x^2), x = u . (f + wd x r + w x (w x r)), u the unit vector along u0 + m1 e1 + m2 e2.
/// Its eight parameters p are in that order: b [m/s^2], SF [reading per m/s^2], m1, m2 [1], k2 [s^2/m], r[3] [m].
/// Static attitudes alone do not show r, nor do spins about the three axes of the body: take face diagonals too.
/// Source: Hung, Fang, Wang, Lee (see ins/sixacc.h): scale factor, bias, misalignment and place errors; the quadratic
/// term is added here. Cost: two 8 x 8 loops a row, 8 x 8 reals of memory.
/// SPDX-License-Identifier: MIT
#ifndef INS_ACCELFIT_H_INCLUDED
#define INS_ACCELFIT_H_INCLUDED
#include "ins/config.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_ACCELFIT_N 8 ///< parameters: b, SF, m1, m2, k2, r[3]

/// What the fixture does at the body's origin, all resolved in b. At rest f_b is +g along the upward vertical.
typedef struct ins_accelfit_motion_t
{
    ins_real f_b[3];     ///< specific force [m/s^2]
    ins_real w_ib_b[3];  ///< angular rate [rad/s]
    ins_real wd_ib_b[3]; ///< angular acceleration [rad/s^2]
} ins_accelfit_motion_t;

/// Owned by the caller.
typedef struct ins_accelfit_t
{
    ins_real u0[3], e1[3], e2[3];                ///< nominal axis, and the two directions in which it may lean
    ins_real p[INS_ACCELFIT_N];                  ///< the present estimate
    ins_real R[INS_ACCELFIT_N * INS_ACCELFIT_N]; ///< triangle of the rows of this pass
    ins_real z[INS_ACCELFIT_N];                  ///< their right-hand side
    ins_real residual2;                          ///< sum of squared residuals about p of this pass
    uint32_t rows;                               ///< rows of this pass
} ins_accelfit_t;

/// \param[in] u0  [3] nominal axis, not zero. \param[in] e1  [3] direction of m1. \param[in] e2  [3] direction of m2.
/// \param[in] p  [8] first guess; SF not zero. \return INS_OK; INS_E_RANGE for a zero axis or SF, NaN or infinity.
INS_API ins_status_t ins_accelfit_init(ins_accelfit_t* self, const ins_real u0[3], const ins_real e1[3],
                                       const ins_real e2[3], const ins_real p[INS_ACCELFIT_N]);
/// What the accelerometer of the present estimate reads, and the derivatives by p.
/// \param[out] jacobian  [8], or a null pointer. \return the reading.
INS_API ins_real ins_accelfit_predict(const ins_accelfit_t* self, const ins_accelfit_motion_t* motion,
                                      ins_real* jacobian);
/// One measurement. \return INS_OK; INS_E_RANGE for NaN or infinity, and then self is unchanged.
INS_API ins_status_t ins_accelfit_add(ins_accelfit_t* self, const ins_accelfit_motion_t* motion, ins_real reading);
/// Ends a pass: moves p by the least-squares step and begins the next pass, without rows.
/// \param[out] largest  largest component of the step, in its own unit.
/// \return INS_OK; INS_E_STATE, and self unchanged, while the rows seen do not fix all eight parameters.
INS_API ins_status_t ins_accelfit_step(ins_accelfit_t* self, ins_real* largest);
/// Standard deviations of p by the rows of this pass (before ins_accelfit_step).
/// \param[in] sigma  of one reading. \param[out] deviation  [8]. \return as ins_accelfit_step; INS_E_RANGE unless sigma >= 0.
INS_API ins_status_t ins_accelfit_deviation(const ins_accelfit_t* self, ins_real sigma,
                                            ins_real deviation[INS_ACCELFIT_N]);

#ifdef __cplusplus
}
#endif
#endif // INS_ACCELFIT_H_INCLUDED
