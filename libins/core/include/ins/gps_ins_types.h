/// \file   ins/gps_ins_types.h
/// \brief  What goes into ins/gps_ins.h and what comes out: configuration, start, counters, state. Frames: b, n (NED). SI, rad.
/// SPDX-License-Identifier: MIT
#ifndef INS_GPS_INS_TYPES_H_INCLUDED
#define INS_GPS_INS_TYPES_H_INCLUDED
#include "ins/gnss.h"
#include "ins/kf15.h"
#include "ins/still.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_GPS_INS_GATE3_999 INS_C(16.266236) ///< chi-squared, 3 degrees of freedom, 99.9 %
#define INS_GPS_INS_PAST      8u               ///< instants of the antenna kept for late fixes
#define INS_GPS_INS_DELAY_MAX INS_C(0.5)       ///< of a fix [s]
#define INS_GPS_INS_TILT_MAX                                                                                           \
    INS_C(0.3) ///< largest standard deviation of an angle at the start [rad]; docs/gps_ins.md says why

typedef struct ins_gps_ins_config_t
{
    ins_kf15_sensors_t sensors;            ///< random walks and Gauss-Markov biases of the IMU
    ins_real unseen_rate, unseen_accel;    ///< rms of a motion that a gap or a dead axis hides [rad/s], [m/s^2]
    ins_real rate_max, force_max;          ///< of the IMU's ranges; beyond: refused [rad/s], [m/s^2]
    ins_real gap_max;                      ///< longest time without IMU that is bridged [s]
    uint16_t stuck;                        ///< samples of one value that make an axis dead; 0: not looked at
    uint16_t decimate;                     ///< IMU samples to a step of the covariance, at least 1
    ins_real antenna_b[3];                 ///< from the IMU [m]
    ins_real gnss_late;                    ///< added to the time of a fix, within +-INS_GPS_INS_DELAY_MAX [s]
    ins_real gate_position, gate_velocity; ///< of the joint NIS of 3; 0: none
    ins_real gate;                         ///< of one scalar; 0: none
    uint16_t refused_max;                  ///< fixes refused in a row after which the filter doubts itself; 0: never
    ins_real wheel_b[3];                   ///< from the IMU to the point that only rolls forward, the rear axle [m]
    ins_real nhc, zupt, zaru;              ///< standard deviations of no slip, of rest [m/s], of no turning [rad/s]
    ins_still_config_t still;              ///< detector of rest: zupt and zaru by themselves
} ins_gps_ins_config_t;

/// Where it starts. sigma: as ins/kf15.h orders the states.
typedef struct ins_gps_ins_start_t
{
    int64_t t_ns;
    ins_real q_nb[4], v_n[3];
    ins_position_t position; ///< of the IMU
    ins_real gyro_bias[3], accel_bias[3];
    ins_real sigma[INS_KF15_N];
} ins_gps_ins_start_t;

/// Counters, and what each says.
#define INS_GPS_INS_COUNT_LIST(X)                                                                                      \
    X(steps, "IMU samples used")                                                                                       \
    X(imu_refused, "IMU samples that are not a number, out of range or of no length")                                  \
    X(imu_time, "IMU samples that do not follow in time: duplicates, backward or wild stamps")                         \
    X(imu_clock, "steps of the IMU's clock that were followed")                                                        \
    X(imu_gaps, "gaps bridged")                                                                                        \
    X(imu_stuck, "axes that went dead")                                                                                \
    X(fixes, "fixes used, in whole or in part")                                                                        \
    X(fix_refused, "fixes that are not a number or have no standard deviation")                                        \
    X(fix_time, "fixes too old or of the future")                                                                      \
    X(fix_position, "positions outside the gate")                                                                      \
    X(fix_velocity, "velocities outside the gate")                                                                     \
    X(fix_doubts, "times that the filter doubted itself")                                                              \
    X(rests, "rests found and used")                                                                                   \
    X(rest_refused, "rests outside the gate")                                                                          \
    X(aid_refused, "other aids refused")

typedef struct ins_gps_ins_count_t
{
#define INS_GPS_INS_COUNT_MEMBER(name, text) uint32_t name;
    INS_GPS_INS_COUNT_LIST(INS_GPS_INS_COUNT_MEMBER)
#undef INS_GPS_INS_COUNT_MEMBER
} ins_gps_ins_count_t;

/// The answer with its covariance: blocks of P, row-major, north, east, down.
typedef struct ins_gps_ins_state_t
{
    int64_t t_ns;
    ins_real q_nb[4], v_n[3];
    ins_position_t position;
    ins_real gyro_bias[3], accel_bias[3];
    ins_real P_phi[9], P_v[9], P_p[9]; ///< attitude [rad^2], velocity [m^2/s^2], position [m^2]
    ins_real sigma[INS_KF15_N];
} ins_gps_ins_state_t;

#ifdef __cplusplus
}
#endif
#endif // INS_GPS_INS_TYPES_H_INCLUDED
