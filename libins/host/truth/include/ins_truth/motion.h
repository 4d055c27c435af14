/// \file   ins_truth/motion.h
/// \brief  Known rotations as pure functions of time: attitude, Euler angles, body rate, angle increments. Unit: rad, s.
///
///     ins_motion_t* m = ins_motion_create_euler(&sines, 0.0, why, sizeof why);
///     ins_motion_rate(m, t, w_ib_b);
///     ins_motion_destroy(m);
///
/// Frames: body b (x forward, y right, z down); navigation n (NED), taken as inertial: no Earth rate in these motions.
/// Quaternions are scalar first; q_nb rotates body vectors into n; q_nb(t2) = q_nb(t1) * dq. Euler angles are ZYX.
///
/// ramp_s > 0: the motion starts from rest. For t <= 0 it is at rest; over 0 < t < ramp_s its amplitude grows as
/// 10 x^3 - 15 x^4 + 6 x^5, x = t / ramp_s: attitude, rate and angular acceleration are continuous.
/// ramp_s = 0: under way, also for negative t.
///
/// Times beyond +-1e9 s and NaN give NaN. A motion is never written after creation: several threads may read it.
/// SPDX-License-Identifier: MIT
#ifndef INS_TRUTH_MOTION_H_INCLUDED
#define INS_TRUTH_MOTION_H_INCLUDED
#include "ins_truth/api.h"
#include <stddef.h>
#ifdef __cplusplus
extern "C" {
#endif

typedef struct ins_motion_t ins_motion_t;

/// angle(t) = offset + amplitude * sin(2 pi frequency_hz t + phase)
typedef struct ins_motion_sine_t
{
    double offset;       ///< [rad]
    double amplitude;    ///< [rad]
    double frequency_hz; ///< >= 0
    double phase;        ///< [rad]
} ins_motion_sine_t;

typedef struct ins_motion_sines_t
{
    ins_motion_sine_t yaw, pitch, roll;
} ins_motion_sines_t;

// Each constructor returns NULL when it refuses, and then writes the place, the value found and what would be right
// into why[why_size] (why may be NULL). Memory that ran out is reported the same way.

/// Constant body rate w_ib_b [rad/s] from the attitude q_nb0 at t = 0 (unit length within 1e-6; it is normalised).
/// The ramp is on the rate, so a ramped turn trails an unramped one by w * ramp_s / 2.
INS_TRUTH_API ins_motion_t* ins_motion_create_rate(const double w_ib_b[3], const double q_nb0[4], double ramp_s,
                                                   char* why, size_t why_size);
/// Sinusoids in yaw, pitch and roll. The ramp is on the amplitudes; the rest attitude is the offsets.
INS_TRUTH_API ins_motion_t* ins_motion_create_euler(const ins_motion_sines_t* sines, double ramp_s, char* why,
                                                    size_t why_size);
/// Coning: q_nb = [cos(a/2), 0, sin(a/2) cos(wt), sin(a/2) sin(wt)], w = 2 pi frequency_hz, a = half_angle [rad],
/// 0 <= a <= pi. The ramp is on a; the rest attitude is level, heading north.
INS_TRUTH_API ins_motion_t* ins_motion_create_coning(double half_angle, double frequency_hz, double ramp_s, char* why,
                                                     size_t why_size);
/// Natural cubic splines through rows of t [s], yaw, pitch, roll [rad]; the arrays are copied. Angles are unwrapped:
/// a step of more than pi between two rows is refused, as are NaN, times that do not increase and fewer than 4 rows.
/// Outside the rows each angle goes on at its end slope (the C2 continuation of a natural spline).
/// The ramp is on the deviation from the first row. Refusals count the first row of data as row 1.
INS_TRUTH_API ins_motion_t* ins_motion_create_table(size_t rows, const double* t, const double* yaw,
                                                    const double* pitch, const double* roll, double ramp_s, char* why,
                                                    size_t why_size);
/// Another motion until from_s, and from then on the constant body rate w_ib_b [rad/s] from the attitude there: what is
/// done to a board by hand. The base, which may be such a motion itself, must outlive it.
INS_TRUTH_API ins_motion_t* ins_motion_create_onward(const ins_motion_t* base, double from_s, const double w_ib_b[3],
                                                     char* why, size_t why_size);
INS_TRUTH_API void ins_motion_destroy(ins_motion_t* self); ///< NULL is allowed.

/// The time the motion is known for [s]: the rows of a table, -infinity to infinity for the others; an onward motion
/// begins with its base.
INS_TRUTH_API void ins_motion_span(const ins_motion_t* self, double* first, double* last);

/// \param[out] q_nb  [4] scalar first.
INS_TRUTH_API void ins_motion_attitude(const ins_motion_t* self, double t, double q_nb[4]);
/// rpy = roll, pitch, yaw; roll and yaw in [-pi, pi], pitch in [-pi/2, pi/2], whatever turns the motion has made.
INS_TRUTH_API void ins_motion_euler(const ins_motion_t* self, double t, double rpy[3]);
/// Analytic body rate [rad/s].
INS_TRUTH_API void ins_motion_rate(const ins_motion_t* self, double t, double w_ib_b[3]);
/// Integral of the body rate from t0 to t1 [rad] (not the rotation vector), error about 1e-15 of
/// max(1, rate * |t1 - t0|). Cost: 10 rates for each half period of the fastest component, and each row of a table.
INS_TRUTH_API void ins_motion_increment(const ins_motion_t* self, double t0, double t1, double dtheta_b[3]);

#ifdef __cplusplus
}
#endif
#endif // INS_TRUTH_MOTION_H_INCLUDED
