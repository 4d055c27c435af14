/// \file   ins/unicycle.h
/// \brief  Vehicle filter: east, north, heading, speed, gyro bias, odometer scale. GPS calibrates, gyro and odometer carry on.
///
///     ins_unicycle_odometer(&u, dt, distance, &nis);     // each 100 ms
///     ins_unicycle_predict(&u, dt, yaw_rate);
///     ins_unicycle_gps(&u, east, north, 9, &nis);        // each s, when the fix is good
///
/// Frame as ins/dead_reckoning.h. The gyro is an input, so the heading survives stops. Distances carry the odometer's scale:
/// distance = scale * speed * dt. Covariance in Joseph form.
/// SPDX-License-Identifier: MIT
#ifndef INS_UNICYCLE_H_INCLUDED
#define INS_UNICYCLE_H_INCLUDED
#include "ins/kalman.h"
#ifdef __cplusplus
extern "C" {
#endif

enum
{
    INS_UNICYCLE_EAST,
    INS_UNICYCLE_NORTH,
    INS_UNICYCLE_HEADING,
    INS_UNICYCLE_SPEED,
    INS_UNICYCLE_BIAS,
    INS_UNICYCLE_SCALE
};

typedef struct ins_unicycle_config_t
{
    ins_real q_speed;    ///< growth of the speed's variance [(m/s)^2/s]
    ins_real q_bias;     ///< of the gyro bias's [(rad/s)^2/s]
    ins_real q_scale;    ///< of the odometer scale's [1/s]
    ins_real r_rate;     ///< variance of a yaw-rate sample [(rad/s)^2]
    ins_real r_distance; ///< variance of a distance [m^2]
    ins_real gate;       ///< of the odometer's innovation, 1 degree of freedom; 0: none
    ins_real gate_gps;   ///< of a fix, 2 degrees of freedom: INS_KALMAN_GATE2_99 is good; 0: none
} ins_unicycle_config_t;

/// Owned by the caller; readable.
typedef struct ins_unicycle_t
{
    ins_unicycle_config_t cfg;
    ins_real x[6];
    ins_real P[36];
} ins_unicycle_t;

/// \param[in] x  [6] start; the heading is wrapped. \param[in] var  [6] its variances.
/// \return INS_E_RANGE: r not positive, another figure negative, not a number, or the heading beyond +-1000 rad.
INS_API ins_status_t ins_unicycle_init(ins_unicycle_t* self, const ins_unicycle_config_t* cfg, const ins_real x[6],
                                       const ins_real var[6]);
/// Move by dt [s] with the gyro's yaw rate [rad/s]. \return INS_E_RANGE, nothing changed: dt not positive, or |yaw_rate dt| > 1000.
INS_API ins_status_t ins_unicycle_predict(ins_unicycle_t* self, ins_real dt, ins_real yaw_rate);
/// Both sensors as inputs: move by dt [s] along the distance [m] over the odometer's scale; the speed is theirs after it. So the odometer
/// says nothing about its own scale, as it does through ins_unicycle_odometer() where counts are coarse (docs/gps_dr.md).
/// \return INS_E_RANGE, nothing changed: as ins_unicycle_predict(), the distance is not a number, or the scale is not positive.
INS_API ins_status_t ins_unicycle_travel(ins_unicycle_t* self, ins_real dt, ins_real yaw_rate, ins_real distance);
/// Distance counted in the dt before. \param[out] nis  may be 0. \return as ins_kalman_update().
INS_API ins_status_t ins_unicycle_odometer(ins_unicycle_t* self, ins_real dt, ins_real distance, ins_real* nis);
/// Known to stand still: the gyro reads its bias, the speed is 0. \param[in] r_speed  how sure [(m/s)^2]. \return as above.
INS_API ins_status_t ins_unicycle_still(ins_unicycle_t* self, ins_real yaw_rate, ins_real r_speed);
/// A fix, variance r on each coordinate [m^2]. Judged as one, by its joint nis. \return as ins_kalman_update().
INS_API ins_status_t ins_unicycle_gps(ins_unicycle_t* self, ins_real east, ins_real north, ins_real r, ins_real* nis);
/// What the fix would be judged by. \param[out] nis  joint, 2 degrees of freedom. \param[out] det  of its innovation's covariance
/// [m^4]. \return INS_E_RANGE: r is not positive, or not a number; nothing is given.
INS_API ins_status_t ins_unicycle_judge(const ins_unicycle_t* self, ins_real east, ins_real north, ins_real r,
                                        ins_real* nis, ins_real* det);
/// The direction of travel, of a receiver for example: clockwise from north [rad], |course| < 1000. \param[in] r  its variance [rad^2].
/// \param[in] gate  as ins_innovation_t. \param[out] nis  may be 0. \return as ins_kalman_update().
INS_API ins_status_t ins_unicycle_course(ins_unicycle_t* self, ins_real course, ins_real r, ins_real gate,
                                         ins_real* nis);

#ifdef __cplusplus
}
#endif
#endif // INS_UNICYCLE_H_INCLUDED
