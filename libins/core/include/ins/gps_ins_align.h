/// \file   ins/gps_ins_align.h
/// \brief  Where a GPS/INS filter starts: level and heading at rest or under way, with an honest standard deviation. Frames: b, n (NED). SI, rad.
///
///     ins_gps_ins_align_t a;
///     ins_gps_ins_align_init(&a, &cfg, &how);
///     for (;;)
///     {
///         ins_gps_ins_align_step(&a, t_ns, dt, &increment);
///         if (new_fix && ins_gps_ins_align_gnss(&a, &fix, &start) == INS_OK) { ins_gps_ins_init(&n, &cfg, &start); }
///     }
///
/// What the accelerometers felt between two fixes, turned together by the gyros, must be the change of velocity less gravity: two
/// sets of vectors, whose best rotation is the attitude (Wahba 1965), by Newton's method from level and heading. Level comes from
/// gravity, heading from accelerations across it; or, earlier, from the velocity of a vehicle whose nose points along it, or from
/// whoever knows it. Until heading is known to how.heading_max there is no start: no filter is told a heading that is a guess.
/// Source: G. Wahba, SIAM Rev. 7(3), 1965, 409; M. Wu et al., J. Aerosp. Eng. 24(1), 2011, 102-116 (alignment as that problem).
/// No libm but sqrt.
/// SPDX-License-Identifier: MIT
#ifndef INS_GPS_INS_ALIGN_H_INCLUDED
#define INS_GPS_INS_ALIGN_H_INCLUDED
#include "ins/gps_ins_types.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct ins_gps_ins_align_config_t
{
    ins_real heading_max;  ///< standard deviation that is good enough, up to INS_GPS_INS_TILT_MAX [rad]
    ins_real memory;       ///< of the accelerations [s]; the gyros' bias turns them meanwhile
    ins_real course_speed; ///< from which on the nose points along the velocity [m/s]; 0: it need not
    ins_real course_sigma; ///< how well [rad]
} ins_gps_ins_align_config_t;

/// Owned by the caller. Start with ins_gps_ins_align_init(); gyro_bias is readable. Members are private.
typedef struct ins_gps_ins_align_t
{
    ins_kf15_sensors_t sensors;
    ins_gps_ins_align_config_t how;
    ins_real antenna_b[3];
    ins_real gyro_bias[3]; ///< of the last rest [rad/s]
    ins_real bg_sigma;     ///< [rad/s]
    ins_still_t still;
    ins_sculling_t turned; ///< attitude against that at the last fix
    ins_real felt[3];      ///< specific force integrated since, in b as it stood then [m/s]
    ins_real dt;           ///< of the last sample [s]
    ins_real felt_s;       ///< time of felt [s]
    int64_t t_ns;          ///< of the last sample
    ins_real v_n[3];       ///< of the last fix [m/s]
    uint_least8_t has_fix; ///< 1: v_n and felt are good
    uint_least8_t rests;   ///< 1: the last fix had no velocity; a steady drive looks like rest to an IMU
    ins_real M[9];         ///< sum of w n b', rows n
    ins_real sum_b[3];     ///< of what was felt
    ins_real sum_n[3];     ///< of what it must have been
    ins_real S[9];         ///< sum of w n n', less what is noise in it [1/rad^2]
    ins_real bent;         ///< sum of w e^2, e the most that biases bend what was felt
    ins_real nose_b[3];    ///< the nose when its direction was known
    ins_real nose_n[3];    ///< that direction, horizontal
    ins_real nose_sigma;   ///< 0: not known [rad]
} ins_gps_ins_align_t;

/// heading_max 0.2 rad, memory 20 s, course of a vehicle from 3 m/s within 0.05 rad.
INS_API void ins_gps_ins_align_config(ins_gps_ins_align_config_t* how);
/// \param[in] cfg  of the filter to start: sensors, antenna, detector of rest. \return INS_E_RANGE, self unchanged.
INS_API ins_status_t ins_gps_ins_align_init(ins_gps_ins_align_t* self, const ins_gps_ins_config_t* cfg,
                                            const ins_gps_ins_align_config_t* how);
/// Next IMU sample, as ins_gps_ins_step(). After a gap the accelerations begin anew.
/// \return INS_OK; INS_E_RANGE: not a number, or its time does not follow.
INS_API ins_status_t ins_gps_ins_align_step(ins_gps_ins_align_t* self, int64_t t_ns, ins_real dt,
                                            const ins_increment_t* increment);
/// Heading of the nose from who knows it: a compass, two antennas, a map [rad].
/// \return INS_E_RANGE: not a number, |heading| > 2 pi, or no sigma.
INS_API ins_status_t ins_gps_ins_align_heading(ins_gps_ins_align_t* self, ins_real heading, ins_real sigma);
/// A fix of position and velocity, at most 0.1 s late. \param[out] start  if INS_OK.
/// \return INS_OK: this is where it starts; INS_S_START: not known yet; INS_E_RANGE: not such a fix.
INS_API ins_status_t ins_gps_ins_align_gnss(ins_gps_ins_align_t* self, const ins_gnss_fix_t* fix,
                                            ins_gps_ins_start_t* start);

#ifdef __cplusplus
}
#endif
#endif // INS_GPS_INS_ALIGN_H_INCLUDED
