/// \file   ins/gps_ins.h
/// \brief  GPS/INS: the strapdown of ins/strapdown.h, corrected by the 15-state error filter of ins/kf15.h. Frames: b, n (NED). SI, rad.
///
///     ins_gps_ins_t n;
///     ins_gps_ins_config(&cfg);                          // a low-cost MEMS IMU; then what is known better
///     ins_gps_ins_init(&n, &cfg, &start);                // start: given, or from ins/gps_ins_align.h
///     for (;;)
///     {
///         ins_gps_ins_step(&n, t_ns, dt, &increment);    // each IMU sample
///         if (new_fix) { ins_gps_ins_gnss(&n, &fix); }   // up to INS_GPS_INS_DELAY_MAX late
///     }                                                  // n.nav is the answer; ins_gps_ins_state() adds how sure it is
///
/// Every refusal is counted with its reason in n.count. What a gap or a dead axis hides goes into the covariance.
/// Source: P. D. Groves, Principles of GNSS, Inertial, and Multisensor Integrated Navigation Systems, 2nd ed., 2013, 14.2 and 15.
/// SPDX-License-Identifier: MIT
#ifndef INS_GPS_INS_H_INCLUDED
#define INS_GPS_INS_H_INCLUDED
#include "ins/gps_ins_types.h"
#include "ins/kf15_scale.h"
#ifdef __cplusplus
extern "C" {
#endif

/// Where the antenna was, for fixes that come late.
typedef struct ins_gps_ins_past_t
{
    int64_t t_ns;
    ins_real u_n[3]; ///< from a common point [m]
    ins_real v_n[3]; ///< [m/s]
} ins_gps_ins_past_t;

/// The last fix beside the filter: north, east, down of position, then of velocity.
typedef struct ins_gps_ins_check_t
{
    ins_real innovation[6];              ///< fix - filter [m], [m/s]
    ins_real nis[6];                     ///< of each alone, given those before it; 0: not used
    ins_real nis_position, nis_velocity; ///< joint, of the components known
} ins_gps_ins_check_t;

/// Owned by the caller. Start with ins_gps_ins_init(); read nav (attitude, velocity, position), biases, kf, check, count, stuck.
typedef struct ins_gps_ins_t
{
    ins_gps_ins_config_t cfg;
    ins_strapdown_t nav;
    ins_real gyro_bias[3], accel_bias[3];
    ins_kf15_t kf;
    ins_kf15_model_t model; ///< of the covariance's last step
    ins_gps_ins_check_t check;
    ins_gps_ins_count_t count;
    ins_still_t still;
    uint_least8_t stuck; ///< bit i: axis i of the gyros, i - 3 of the accelerometers, is dead
    uint_least8_t lost;  ///< 1 after a gap longer than gap_max: start again
    int64_t t_ns;        ///< of the last sample used
    // Private.
    ins_real dt;           ///< of the last sample [s]
    ins_real w_ib_b[3];    ///< its rate, biases taken off [rad/s]
    ins_real value[6];     ///< rates and specific forces as they came
    uint16_t same[6];      ///< samples in a row without a change
    uint16_t pending;      ///< samples since the covariance's last step
    ins_real pending_dt;   ///< [s]
    ins_real pending_v[3]; ///< specific force integrated over them [m/s]
    int64_t odd_t_ns;      ///< of the last sample that did not follow in time
    uint16_t odd;          ///< of those, in a row
    uint16_t refused;      ///< fixes, in a row
    ins_real way_n[3];     ///< from the common point of past [m]
    ins_gps_ins_past_t past[INS_GPS_INS_PAST];
    uint_least8_t newest, held;
    uint_least8_t plain; ///< 1: model holds cfg.sensors alone
    uint_least8_t form;  ///< what it is the base of
} ins_gps_ins_t;

/// The same with the covariance as P = U D U', for float with P0/R above 1e8. Start with ins_gps_ins_ud_init(); base goes to all
/// other functions, base.kf.P is the covariance at the last measurement.
typedef struct ins_gps_ins_ud_t
{
    ins_gps_ins_t base;
    ins_kf15_ud_t ud;
} ins_gps_ins_ud_t;

/// The same with scale factors. Start with ins_gps_ins_scale_init(); base goes to all other functions. Read gyro, accel; kf has
/// their covariance, 0.01 of standard deviation: a hundredth.
typedef struct ins_gps_ins_scale_t
{
    ins_gps_ins_t base;
    ins_kf15_scale_t kf;
    ins_real gyro[3], accel[3]; ///< a sensor reads (1 + this) times the truth, and its bias
    // Private.
    ins_real pending_theta[3]; ///< angle since the covariance's last step [rad]
    ins_real moved[INS_KF15_SCALE_N];
} ins_gps_ins_scale_t;

/// A low-cost MEMS IMU (0.3 deg/sqrt(h), 0.1 m/s/sqrt(h), 0.1 deg/s and 50 mg/1000 s), an antenna at the IMU, gates of 99.9 %,
/// no detector of rest.
INS_API void ins_gps_ins_config(ins_gps_ins_config_t* cfg);
/// Begins where start says.
/// \return INS_E_RANGE, self unchanged: a figure is out of its range, or sigma of an angle above INS_GPS_INS_TILT_MAX: that far
/// off an error filter is not linear, and would be sure of a wrong heading; ins/gps_ins_align.h finds it.
INS_API ins_status_t ins_gps_ins_init(ins_gps_ins_t* self, const ins_gps_ins_config_t* cfg,
                                      const ins_gps_ins_start_t* start);
/// As ins_gps_ins_init().
INS_API ins_status_t ins_gps_ins_ud_init(ins_gps_ins_ud_t* self, const ins_gps_ins_config_t* cfg,
                                         const ins_gps_ins_start_t* start);
/// As ins_gps_ins_init(); scale factors begin at 0. \return INS_E_RANGE also for what ins_kf15_scale_init() refuses.
INS_API ins_status_t ins_gps_ins_scale_init(ins_gps_ins_scale_t* self, const ins_gps_ins_config_t* cfg,
                                            const ins_kf15_scale_sensors_t* sensors, const ins_gps_ins_start_t* start);

/// Next IMU sample.
/// \param[in] t_ns  end of the interval, any time base, within +-INS_GNSS_TIME_MAX_NS. \param[in] dt  its length [s].
/// \return INS_OK; INS_E_RANGE: not a number, out of range, or its time does not follow: not used; INS_E_STATE: lost.
INS_API ins_status_t ins_gps_ins_step(ins_gps_ins_t* self, int64_t t_ns, ins_real dt, const ins_increment_t* increment);
/// Position and velocity are judged apart. \return INS_OK: at least one was used; INS_E_GATE: none; INS_E_RANGE: not a number, no
/// sigma, or a time that the past does not reach.
INS_API ins_status_t ins_gps_ins_gnss(ins_gps_ins_t* self, const ins_gnss_fix_t* fix);

/// At rest now. \return INS_OK; INS_E_GATE.
INS_API ins_status_t ins_gps_ins_zupt(ins_gps_ins_t* self);
/// Not turning over the last time. \param[in] w_ib_b  [3] mean rate as the IMU gave it, bias and all [rad/s].
INS_API ins_status_t ins_gps_ins_zaru(ins_gps_ins_t* self, const ins_real w_ib_b[3]);
/// No velocity across the wheels, sideways or up, at cfg.wheel_b: non-holonomic constraint.
INS_API ins_status_t ins_gps_ins_nhc(ins_gps_ins_t* self);
/// Forward speed of cfg.wheel_b [m/s], and its standard deviation.
INS_API ins_status_t ins_gps_ins_odometer(ins_gps_ins_t* self, ins_real speed, ins_real sigma);
/// Rate of heading, right turn positive, of another gyro, over the last IMU sample [rad/s].
INS_API ins_status_t ins_gps_ins_yaw_rate(ins_gps_ins_t* self, ins_real rate, ins_real sigma);
/// Height of the IMU above the ellipsoid, of a barometer or a map [m].
INS_API ins_status_t ins_gps_ins_altitude(ins_gps_ins_t* self, ins_real height, ins_real sigma);

/// The answer and how sure it is, of the last sample and measurement.
INS_API void ins_gps_ins_state(const ins_gps_ins_t* self, ins_gps_ins_state_t* state);

#ifdef __cplusplus
}
#endif
#endif // INS_GPS_INS_H_INCLUDED
