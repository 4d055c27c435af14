/// \file   ins/kf15_scale.h
/// \brief  Six scale factors beside the 15 errors of ins/kf15.h: of three gyros, three accelerometers. Frames: b -> n (NED). SI, rad.
///
///     ins_kf15_scale_t s;
///     ins_kf15_scale_init(&s, &sensors);                            // beside ins_kf15_init(&f, sigma)
///     ins_kf15_scale_propagate(&s, &f, &m, increment.theta_b, increment.v_b); // in place of ins_kf15_propagate(&f, &m)
///     if (ins_kf15_scale_update(&s, &f, h, h_s, &z) == INS_OK)      // in place of ins_kf15_update(&f, h, &z)
///     {
///         use(f.K); // and s.K, of the scale factors
///     }
///
/// A sensor reads (1 + s) x + b + noise, and s is a Gauss-Markov state. Where a bias errs by db, it errs by db + x ds: what
/// ins/kf15.h says of dbg holds for dbg + w ds, of dba for dba + f ds, axis by axis. A bias moves by (1 + s) less than that; left out.
/// The covariance of all 21 is P of ins_kf15_t and six columns more, B: the filter of 15 does not know of them, and costs what it did.
/// Source: P. D. Groves, Principles of GNSS, Inertial, and Multisensor Navigation (2013), 14.2.4 and 14.2.6.
/// Cost:   docs/gps_ins.md. sqrt of libm, no allocation; P and the scale factors' own part of B are symmetric to the last bit.
/// SPDX-License-Identifier: MIT
#ifndef INS_KF15_SCALE_H_INCLUDED
#define INS_KF15_SCALE_H_INCLUDED
#include "ins/config.h"
#include "ins/kf15.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_KF15_SCALE_N   6
#define INS_KF15_SCALE_MAX INS_C(0.1) ///< largest standard deviation: beyond it 1 + s is far from 1

/// What is known of them before. A standard deviation of 0: there is none, and none is estimated.
typedef struct ins_kf15_scale_sensors_t
{
    ins_real gyro_sigma, accel_sigma; ///< 0.01: a hundredth; up to INS_KF15_SCALE_MAX
    ins_real gyro_tau, accel_tau;     ///< time constants [s], at least INS_STRAPDOWN_PERIOD_MAX; 1e6: all but constant
} ins_kf15_scale_sensors_t;

/// Owned by the caller; readable. Start with ins_kf15_scale_init().
typedef struct ins_kf15_scale_t
{
    ins_real
        B[(INS_KF15_N + INS_KF15_SCALE_N) * INS_KF15_SCALE_N]; ///< of state i, 15 to 20 being s, with s j: at 6 i + j
    ins_real K[INS_KF15_SCALE_N];                              ///< gain of the last update that was not refused
    ins_kf15_scale_sensors_t sensors;
} ins_kf15_scale_t;

/// Not correlated with anything yet. \return INS_E_RANGE, self unchanged: a figure is out of its range, or not a number.
INS_API ins_status_t ins_kf15_scale_init(ins_kf15_scale_t* self, const ins_kf15_scale_sensors_t* sensors);
/// One step of all 21. \param[in,out] kf  as by ins_kf15_propagate().
/// \param[in] theta_b  [3] of the step, as ins_kf15_model() was told [rad]. \param[in] v_b  [3], likewise [m/s].
INS_API void ins_kf15_scale_propagate(ins_kf15_scale_t* self, ins_kf15_t* kf, const ins_kf15_model_t* model,
                                      const ins_real theta_b[3], const ins_real v_b[3]);
/// One scalar z = h x + h_s s + noise. \param[in] h  [15]; one of it at least is not 0. \param[in] h_s  [6] gyros, accelerometers.
/// \return as ins_kf15_update(); kf->K and self->K are the gain.
INS_API ins_status_t ins_kf15_scale_update(ins_kf15_scale_t* self, ins_kf15_t* kf, const ins_real h[INS_KF15_N],
                                           const ins_real h_s[INS_KF15_SCALE_N], ins_innovation_t* z);

#ifdef __cplusplus
}
#endif
#endif // INS_KF15_SCALE_H_INCLUDED
