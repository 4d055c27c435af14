/// \file   ins/gps_axis.h
/// \brief  Filter of one coordinate of a GPS fix: position, velocity, acceleration, and a correlated fix error. Units: m, s.
///
///     ins_gps_axis_t x;
///     ins_gps_axis_config_t cfg = {1, 20, 100, 1, 5, 9, INS_KALMAN_GATE_999, 0};
///     ins_gps_axis_init(&x, &cfg, var);
///     ins_gps_axis_step(&x, z, &nis);                    // each epoch: predict, then update; ins_gps_axis_predict() without a fix
///
/// The acceleration is a Gauss-Markov process (Singer), z = position + fix error + white noise. With acceleration_max > 0 it varies
/// about the last estimate instead of about zero (the "current statistical" model): its variance is then (4 - pi)/pi (max - |a|)^2.
/// The fix error is hardly observable: the filter keeps it near its prior and uses it to widen the position's variance. With tau_fix
/// near tau_acceleration it is not observable at all, and init refuses.
/// Source: the ARM vehicle navigator paper of the GPS/DR system, 1.2.1; its formulas are lost, this is the model its states imply.
/// SPDX-License-Identifier: MIT
#ifndef INS_GPS_AXIS_H_INCLUDED
#define INS_GPS_AXIS_H_INCLUDED
#include "ins/kalman.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_GPS_AXIS_TAU_RATIO_MIN INS_C(0.1) ///< least |1 - tau_acceleration/tau_fix|

typedef struct ins_gps_axis_config_t
{
    ins_real dt;                 ///< epoch [s]
    ins_real tau_acceleration;   ///< [s]
    ins_real tau_fix;            ///< [s]
    ins_real sigma_acceleration; ///< [m/s^2]
    ins_real sigma_fix;          ///< [m]
    ins_real r;                  ///< variance of the white part of a fix [m^2]
    ins_real gate;               ///< of the innovation, as ins_innovation_t; 0: none
    ins_real acceleration_max;   ///< [m/s^2]; 0: plain Singer model
} ins_gps_axis_config_t;

/// Owned by the caller; readable.
typedef struct ins_gps_axis_t
{
    ins_gps_axis_config_t cfg;
    ins_real x[4]; ///< position, velocity, acceleration, fix error
    ins_real P[16];
    ins_real Phi[16];
    ins_real Q[16]; ///< the motion's part for an acceleration of variance 1 (m/s^2)^2
    ins_real u[3];  ///< input of the mean acceleration
    ins_real K[4];  ///< gain of the last update
} ins_gps_axis_t;

/// x = 0; set it if it is known. \param[in] var  [4] variances of x.
/// \return INS_E_RANGE: a time or r is not positive, a deviation is negative, or the two time constants are too close.
INS_API ins_status_t ins_gps_axis_init(ins_gps_axis_t* self, const ins_gps_axis_config_t* cfg, const ins_real var[4]);
/// One epoch on without a fix.
INS_API void ins_gps_axis_predict(ins_gps_axis_t* self);
/// One epoch on, then the fix z [m]. \param[out] nis  as ins_innovation_t, or 0. \return as ins_kalman_update(); when it refuses the
/// epoch is predicted all the same.
INS_API ins_status_t ins_gps_axis_step(ins_gps_axis_t* self, ins_real z, ins_real* nis);

#ifdef __cplusplus
}
#endif
#endif // INS_GPS_AXIS_H_INCLUDED
