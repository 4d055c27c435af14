/// \file   ins/dead_reckoning.h
/// \brief  Dead reckoning from a yaw-rate gyro and an odometer: the classic sums, and the extended filter of the GPS/DR paper.
///
/// Frame: east, north [m]; heading clockwise from north [rad], within (-pi, pi]; yaw rate positive clockwise [rad/s].
/// The paper's filter keeps its heading in the direction of its velocity alone, so each stop loses it (docs/gps_dr.md: 121 m after
/// 60 s with one stop). It is here for comparison; ins/unicycle.h is the one to use.
/// Source: the ARM vehicle navigator paper of the GPS/DR system, 1.2.2; its formulas are lost, this is the model its states imply.
/// SPDX-License-Identifier: MIT
#ifndef INS_DEAD_RECKONING_H_INCLUDED
#define INS_DEAD_RECKONING_H_INCLUDED
#include "ins/kalman.h"
#ifdef __cplusplus
extern "C" {
#endif

/// One step along a circular arc. \param[in,out] pose  [3] east, north, heading. \param[in] distance  along the arc [m].
/// \param[in] turn  change of heading [rad]. \return INS_E_RANGE, pose unchanged: not a number, or an angle beyond +-1000 rad.
INS_API ins_status_t ins_dead_reckoning_step(ins_real pose[3], ins_real distance, ins_real turn);

/// What an update used, in ins_dr_ekf_t.used.
#define INS_DR_RATE     1u
#define INS_DR_DISTANCE 2u

typedef struct ins_dr_ekf_config_t
{
    ins_real dt;         ///< [s]
    ins_real tau[2];     ///< correlation time of the acceleration, east and north [s]
    ins_real sigma[2];   ///< its standard deviation [m/s^2]
    ins_real r_rate;     ///< variance of the yaw rate [(rad/s)^2]
    ins_real r_distance; ///< variance of the distance in dt [m^2]
    ins_real v_min;      ///< predicted speed below which the yaw rate is not used [m/s]: 0.5 is good
    ins_real v_zero;     ///< predicted speed below which nothing is used [m/s]: 1e-3 is good
    ins_real gate;       ///< of each innovation, as ins_innovation_t; 0: none
} ins_dr_ekf_config_t;

/// Owned by the caller; readable.
typedef struct ins_dr_ekf_t
{
    ins_dr_ekf_config_t cfg;
    ins_real x[6]; ///< east, north, their velocities, their accelerations
    ins_real P[36];
    ins_real Phi[36];
    ins_real Q[36];
    unsigned used;        ///< what the last step used: INS_DR_RATE, INS_DR_DISTANCE
    ins_real nis[2];      ///< of yaw rate and distance in the last step; 0 if it was not looked at
    uint_least32_t gated; ///< measurements refused by the gate
} ins_dr_ekf_t;

/// \param[in] x  [6] start. \param[in] var  [6] its variances.
/// \return INS_E_RANGE: dt, tau, r or v_zero is not positive, or sigma, var, gate or v_min - v_zero is negative, or one is not a
/// number.
INS_API ins_status_t ins_dr_ekf_init(ins_dr_ekf_t* self, const ins_dr_ekf_config_t* cfg, const ins_real x[6],
                                     const ins_real var[6]);
/// Predict by dt, then update with what may be used; both Jacobians are taken at the prediction.
/// \return INS_OK; INS_E_GATE: one or both were refused by the gate (`used` says what was not); INS_E_RANGE: not a number, x and P
/// unchanged.
INS_API ins_status_t ins_dr_ekf_step(ins_dr_ekf_t* self, ins_real yaw_rate, ins_real distance);

#ifdef __cplusplus
}
#endif
#endif // INS_DEAD_RECKONING_H_INCLUDED
