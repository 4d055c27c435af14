/// \file   ins/thesis.h
/// \brief  Attitude as in the thesis on the GPS-enabled IMU: second-order update, RK4 with norm feedback, ZXZ angles. Frame: b -> n.
///
/// For comparison with the thesis and for systems built on it. ins/attitude.h is more accurate for less work.
///
///     ins_thesis_t t;                                        // from angle increments [rad]
///     ins_thesis_init(&t, q_nb0);
///     for (;;) { ins_thesis_step(&t, dtheta_b); use(t.q_nb); }
///
///     ins_thesis_rk4_t r;                                    // from rates [rad/s] sampled every T: steps of 2 T
///     ins_thesis_rk4_init(&r, feedback, 2 * T, q_nb0, w0_b);
///     for (;;) { ins_thesis_rk4_step(&r, w_mid_b, w_end_b); use(r.q_nb); }
///
/// Source: "GPS/INS System Design and Integration", master's thesis, Chung Hua University, 2009: (2-8)..(2-11), (2-15)..(2-23), 2.8, 4.5.4,
/// with the sign of (2-20) put right and the result normalised. What differs from the print, and why: docs/thesis.md.
/// SPDX-License-Identifier: MIT
#ifndef INS_THESIS_H_INCLUDED
#define INS_THESIS_H_INCLUDED
#include "ins/config.h"
#ifdef __cplusplus
extern "C" {
#endif

/// RK4 holds the norm only while 2 k h is below this (the real end of its region of stability); beyond it explodes.
#define INS_THESIS_RK4_LIMIT INS_C(2.785)

/// Start with ins_thesis_init().
typedef struct ins_thesis_t
{
    ins_real q_nb[4];    ///< scalar first; v_n = q v_b q*
    ins_real prev[3];    ///< the increment before [rad]
    uint_least8_t count; ///< previous increments held, 0 or 1
} ins_thesis_t;

/// P of (2-15)..(2-19): the quaternion of one interval, not normalised (|P|^2 = 1 - |theta|^4 / 192 + ...). Any input.
/// \param[in] theta_b  [3] increment of the interval, \param[in] prev_b  [3] of the one before [rad]. \param[out] p  [4]
INS_API void ins_thesis_p(const ins_real theta_b[3], const ins_real prev_b[3], ins_real p[4]);
/// \return INS_OK; INS_E_RANGE for NaN, or a quaternion whose norm is not within 1e-3 of 1 (it is normalised).
INS_API ins_status_t ins_thesis_init(ins_thesis_t* self, const ins_real q_nb[4]);
/// \return INS_OK; INS_S_START for the first; INS_E_RANGE for NaN or |component| > 1 rad, and then self is unchanged.
INS_API ins_status_t ins_thesis_step(ins_thesis_t* self, const ins_real dtheta_b[3]);

/// Start with ins_thesis_rk4_init().
typedef struct ins_thesis_rk4_t
{
    ins_real q_nb[4];
    ins_real w_ib_b[3]; ///< rate at the end of the last step [rad/s]
    ins_real feedback;  ///< k [1/s]
    ins_real step_s;    ///< h
} ins_thesis_rk4_t;

/// q' = q w / 2 + k (1 - |q|^2) q. With k = 0 the norm is the caller's: ins_quat_normalise(r.q_nb) after each step.
/// \param[in] feedback  k >= 0 [1/s]; a norm error decays as exp(-2 k t). k h <= 0.5 is a good choice.
/// \param[in] step_s  h > 0; samples of the rate are needed every h / 2. \param[in] w_ib_b  [3] rate at the start [rad/s].
/// \return INS_OK; INS_E_RANGE if 2 k h >= INS_THESIS_RK4_LIMIT, for NaN, or a norm not within 1e-3 of 1.
INS_API ins_status_t ins_thesis_rk4_init(ins_thesis_rk4_t* self, ins_real feedback, ins_real step_s,
                                         const ins_real q_nb[4], const ins_real w_ib_b[3]);
/// One step of h. \return INS_OK; INS_E_RANGE for NaN or |component| h > pi, and then self is unchanged.
INS_API ins_status_t ins_thesis_rk4_step(ins_thesis_rk4_t* self, const ins_real w_mid_b[3], const ins_real w_end_b[3]);

/// Passive ZXZ rotation of 2.8, R = Rz(gamma) Rx(beta) Rz(alpha), row-major. Its first row is what 4.5.4 plots with the integrals of
/// P, Q, R as angles. That is no attitude of a body that rolls about x (a pure roll moves it): for comparison only. Uses libm.
/// \param[in] angles  [3] alpha, beta, gamma [rad]
INS_API void ins_thesis_zxz(const ins_real angles[3], ins_real R[9]);

#ifdef __cplusplus
}
#endif
#endif // INS_THESIS_H_INCLUDED
