/// \file   ins_calib/full.h
/// \brief  Accelerometers in full: bias, scale, misalignment, quadratic term and place, in a fixture that is not perfect. Frame: b. SI.
///
/// Accelerometer j reads SF (b + x + k2 x^2), x = u . (f + wd x r + w x (w x r)), u the unit vector along u0 + m1 e1 + m2 e2, as in
/// ins/accelfit.h. A pose is held at rest or spun about an axis; it says where up is in b, and the rate. Each pose may be turned by a
/// small rotation that is estimated with it, of mean 0 and deviation fixture_rad: these priors alone fix how the block as a whole sits
/// in its fixture. Places are relative to the point in which the axes of the spins meet.
/// Maximum posterior by Levenberg-Marquardt (Ceres), covariance by the inverse of its normal matrix.
/// Source of the model: Hung, Fang, Wang, Lee (see ins_calib/calib.h), who have b, SF and angles; k2 and place are added.
/// SPDX-License-Identifier: MIT
#ifndef INS_CALIB_FULL_H_INCLUDED
#define INS_CALIB_FULL_H_INCLUDED
#include "ins_calib/calib.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_CALIB_FULL_N                                                                                               \
    8 ///< parameters of one accelerometer: b [m/s^2], SF [reading per m/s^2], m1, m2, k2 [s^2/m], r[3] [m]

typedef struct ins_calib_sensor_t
{
    double u0[3]; ///< nominal axis; its length does not matter
    double e1[3]; ///< direction of m1
    double e2[3]; ///< direction of m2
    double r0[3]; ///< nominal place [m]
    double sigma; ///< noise of one reading, in its unit
} ins_calib_sensor_t;

typedef struct ins_calib_pose_t
{
    double up[3]; ///< upward vertical in b; specific force at rest is g times it
    double w[3];  ///< angular rate [rad/s]
    double wd[3]; ///< angular acceleration [rad/s^2]
} ins_calib_pose_t;

typedef struct ins_calib_full_t
{
    size_t sensors, poses;
    const ins_calib_sensor_t* sensor;
    const ins_calib_pose_t* pose;
    const double* readings; ///< [poses][sensors]
    double g;               ///< of the place where it is done: it scales everything
    double fixture_rad;     ///< deviation of each pose's attitude about each axis [rad]; 0: the fixture is perfect
    double robust_sigmas;   ///< residuals above some of these count less (Cauchy); 0: least squares
    unsigned fixed;         ///< bit i: parameter i is not estimated: b 0, SF as fitted linearly, m 0, k2 0, r as given
} ins_calib_full_t;

/// Memory of the caller. [a][b]: row by row.
typedef struct ins_calib_full_result_t
{
    double* p;          ///< [sensors][8]
    double* covariance; ///< [8 sensors][8 sensors]; rows of what is fixed are 0
    double* attitude; ///< [poses][3] rotation vectors that turn the nominal vectors of a pose into the true ones [rad]
    double* residual; ///< [poses][sensors] reading less model, in units of the reading
    double*
        condition; ///< [sensors] of the poses, at the nominal geometry with attitudes known, columns scaled to unit length
    double chi2;          ///< sum of squared residuals over sigma, priors included; under robust_sigmas the robust cost
    double chi2_expected; ///< readings less unknowns, to which chi2 should be near
    unsigned
        from_prior; ///< combinations of the unknowns that only the priors of the attitudes fix; 3 is the block's own turn
    unsigned iterations;
} ins_calib_full_result_t;

/// \return INS_CALIB_OK; INS_CALIB_E_RANK when the poses do not fix all that is not `fixed`: why names what, and poses to add.
INS_CALIB_API int ins_calib_full(const ins_calib_full_t* in, ins_calib_full_result_t* out, char* why, size_t why_size);

#ifdef __cplusplus
}
#endif
#endif // INS_CALIB_FULL_H_INCLUDED
