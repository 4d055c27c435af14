/// \file   ins/kf15.h
/// \brief  Covariance of the 15 errors of a strapdown: attitude, velocity, position, gyro and accelerometer bias. Frames: b -> n (NED). SI, rad.
///
///     ins_kf15_t f;
///     ins_kf15_model_t m;
///     ins_kf15_init(&f, sigma);
///     ins_kf15_model_init(&m, dt, &sensors);
///     for (;;) {
///         ins_strapdown_step(&s, &increment);                      // of increments less the estimated biases
///         ins_kf15_model(&m, &s, increment.v_b);
///         ins_kf15_propagate(&f, &m);
///         ins_innovation_t z = {north, r, INS_KALMAN_GATE_99, 0};  // fix less estimate [m]
///         if (ins_kf15_update_state(&f, INS_KF15_P, &z) == INS_OK) { use(f.K); } // add f.K[i] z.v to the estimate
///     }
///
/// An error is truth less estimate, so a correction is added: q_nb = q(phi) q_nb, v_n + dv, b + db; dp is in metres north, east, down.
/// P = (I + F dt) P (I + F dt)' + Q with
///     phi' = -w_in x phi - dw_en(dv) - C dbg        dv' = phi x f - (2 w_ie + w_en) x dv - dw_en(dv) x v + 2 g/R dp_D - C dba
///     dp' = dv                                      db' = -db/tau + noise
/// Left out are terms of v/R on dp and of dp/R on the rates: 5e-6 of dp a second at 30 m/s.
/// Two forms: ins_kf15_* keeps P, for double, or float while P0/R <= 1e8; ins_kf15_ud_* keeps P = U D U', for float at any ratio.
/// Source: P. D. Groves, Principles of GNSS, Inertial, and Multisensor Navigation (2013), 14.2.4; G. J. Bierman (1977), V.3, VI.4.
/// Cost:   docs/kf15.md. No libm, no allocation; P^T = P to the last bit.
/// SPDX-License-Identifier: MIT
#ifndef INS_KF15_H_INCLUDED
#define INS_KF15_H_INCLUDED
#include "ins/config.h"
#include "ins/kalman.h"
#include "ins/markov.h"
#include "ins/strapdown.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_KF15_N 15
#define INS_KF15_ROW                                                                                                   \
    16 ///< reals from one row to the next: a multiple of what vector units take. Element 15 of a row is 0

/// Where three errors begin.
enum
{
    INS_KF15_PHI = 0, ///< attitude, in n [rad]
    INS_KF15_V = 3,   ///< velocity, in n [m/s]
    INS_KF15_P = 6,   ///< position, north, east, down [m]
    INS_KF15_BG = 9,  ///< gyro bias, in b [rad/s]
    INS_KF15_BA = 12  ///< accelerometer bias, in b [m/s^2]
};

/// Owned by the caller; readable. Start with ins_kf15_init().
typedef struct ins_kf15_t
{
    ins_real P[INS_KF15_N * INS_KF15_ROW]; ///< symmetric; P(i,j) at INS_KF15_ROW i + j
    ins_real K[INS_KF15_ROW];              ///< gain of the last update that was not refused
} ins_kf15_t;

/// The same as P = U D U'. Start with ins_kf15_ud_init().
typedef struct ins_kf15_ud_t
{
    ins_real U[INS_KF15_N * INS_KF15_ROW]; ///< by columns: U(i,j) at INS_KF15_ROW j + i; 1 on the diagonal, 0 below
    ins_real D[INS_KF15_N];
    ins_real K[INS_KF15_ROW]; ///< as in ins_kf15_t
} ins_kf15_ud_t;

/// What the sensors add.
typedef struct ins_kf15_sensors_t
{
    ins_real arw;      ///< angle random walk [rad/sqrt(s)]
    ins_real vrw;      ///< velocity random walk [m/s/sqrt(s)]
    ins_real bg_sigma; ///< gyro bias: Gauss-Markov, standard deviation [rad/s]
    ins_real bg_tau;   ///< its time constant [s]
    ins_real ba_sigma; ///< accelerometer bias [m/s^2]
    ins_real ba_tau;   ///< [s]
} ins_kf15_sensors_t;

/// F dt and Q of one step. Start with ins_kf15_model_init(). Members are private.
typedef struct ins_kf15_model_t
{
    ins_real C[9];        ///< C_nb dt [s]
    ins_real turn[3];     ///< w_in_n dt [rad]
    ins_real dv[3];       ///< f_n dt [m/s]
    ins_real curve[3];    ///< -dt/(R_N + h), dt/(R_M + h), dt tan(lat)/(R_N + h) [s/m]
    ins_real coriolis[9]; ///< d dv / d v by rows; in place of its last element, which is 0, 2 g dt/R [1/s]
    ins_real dt;          ///< [s]
    ins_real q_phi;       ///< [rad^2]
    ins_real q_v;         ///< [m^2/s^2]
    ins_markov_t bg, ba;
} ins_kf15_model_t;

/// \param[in] sigma  [15] standard deviations of the start. \return INS_OK; INS_E_RANGE: one is negative or not a number.
INS_API ins_status_t ins_kf15_init(ins_kf15_t* self, const ins_real sigma[INS_KF15_N]);
/// \param[in] dt  of one step [s], > 0. \return INS_OK; INS_E_RANGE: dt, a noise or a time constant is out of range (those from dt).
INS_API ins_status_t ins_kf15_model_init(ins_kf15_model_t* self, ins_real dt, const ins_kf15_sensors_t* sensors);
/// F dt of the step that ended at `at`. \param[in] at  attitude, velocity and position. \param[in] v_b  [3] of that step [m/s].
INS_API void ins_kf15_model(ins_kf15_model_t* self, const ins_strapdown_t* at, const ins_real v_b[3]);
/// I + F dt, for a smoother. \param[out] Phi  [15 15]
INS_API void ins_kf15_transition(const ins_kf15_model_t* self, ins_real Phi[INS_KF15_N * INS_KF15_N]);
/// P = (I + F dt) P (I + F dt)' + Q.
INS_API void ins_kf15_propagate(ins_kf15_t* self, const ins_kf15_model_t* model);
/// One scalar z = h x + noise; what K v corrects is the caller's. \param[in] h  [15]; zeros cost nothing.
/// \return INS_OK, self->K is the gain; INS_E_GATE: outside the gate; INS_E_RANGE: v or h P h' is not a number, or r is not
/// positive. Refused means that self is unchanged.
INS_API ins_status_t ins_kf15_update(ins_kf15_t* self, const ins_real h[INS_KF15_N], ins_innovation_t* z);
/// The same for h = 1 at index, 0 elsewhere. \return also INS_E_RANGE for an index above 14.
INS_API ins_status_t ins_kf15_update_state(ins_kf15_t* self, unsigned index, ins_innovation_t* z);

/// As ins_kf15_init().
INS_API ins_status_t ins_kf15_ud_init(ins_kf15_ud_t* self, const ins_real sigma[INS_KF15_N]);
/// As ins_kf15_propagate(), on the factors: the nine navigation rows by weighted Gram-Schmidt, the noise of each bias by a
/// rank-one change.
INS_API void ins_kf15_ud_propagate(ins_kf15_ud_t* self, const ins_kf15_model_t* model);
/// As ins_kf15_update() (Bierman).
INS_API ins_status_t ins_kf15_ud_update(ins_kf15_ud_t* self, const ins_real h[INS_KF15_N], ins_innovation_t* z);
/// As ins_kf15_update_state().
INS_API ins_status_t ins_kf15_ud_update_state(ins_kf15_ud_t* self, unsigned index, ins_innovation_t* z);
/// \param[out] P  [INS_KF15_N INS_KF15_ROW] as in ins_kf15_t.
INS_API void ins_kf15_ud_covariance(const ins_kf15_ud_t* self, ins_real P[INS_KF15_N * INS_KF15_ROW]);

#ifdef __cplusplus
}
#endif
#endif // INS_KF15_H_INCLUDED
