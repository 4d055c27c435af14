/// \file   ins_calib/triad.h
/// \brief  A triad of accelerometers and one of gyros, calibrated by hand: many poses held still, no turntable. Frame: b. SI.
///
///     f_b = matrix (reading - bias)       w_ib_b = matrix (reading - bias - g_sensitivity f_b)
///
/// The matrices are there to be applied. b is the frame of the accelerometers: x along theirs, y in the plane of x and y. Method:
/// D. Tedaldi, A. Pretto, E. Menegatti, A robust and easy to implement method for IMU calibration without external equipments, ICRA
/// 2014: |f| = g in each still pose, over a search of the threshold of stillness; then gravity turned by the gyros from pose to pose
/// against the accelerometers. Other than there, the gyros' bias and its dependence on specific force are fitted to all still poses,
/// rates are integrated as a navigator does (ins/rates.h of order 4, ins/attitude.h), and covariances are given.
/// SPDX-License-Identifier: MIT
#ifndef INS_CALIB_TRIAD_H_INCLUDED
#define INS_CALIB_TRIAD_H_INCLUDED
#include "ins_calib/calib.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_CALIB_TRIAD_N     9   ///< parameters of one triad
#define INS_CALIB_POSES_MIN   12  ///< still poses that a calibration needs
#define INS_CALIB_INITIAL_MIN 100 ///< samples of the still start

typedef struct ins_calib_triad_t
{
    size_t samples;
    const double* accel; ///< [samples][3]
    const double* gyro;  ///< [samples][3], or NULL: accelerometers alone
    double period_s;     ///< of the samples
    double g;            ///< of the place
    double initial_s;    ///< it lies still at least so long at the start: the noise of stillness
    double window_s;     ///< over which stillness is judged, and the shortest pose
    double gyro_scale;   ///< nominal [rad/s per count]; the start of the search
    unsigned part;       ///< poses k and motions k with k mod parts = part are used
    unsigned parts;      ///< 1: all
} ins_calib_triad_t;

typedef struct ins_calib_axes_t
{
    double matrix[9]; ///< T K
    double bias[3];   ///< [counts]
    double p
        [INS_CALIB_TRIAD_N]; ///< accelerometers: alpha_yz, zy, zx, s_x, s_y, s_z, b_x, b_y, b_z; gyros: gamma_yz, zy, xz, zx, xy, yx, s_x, s_y, s_z
    double covariance[INS_CALIB_TRIAD_N * INS_CALIB_TRIAD_N]; ///< of p, by the residuals
    double condition;                                         ///< of the poses for p, columns scaled to unit length
    double rms;       ///< residual: |f| - g [m/s^2]; gravity turned by the gyros from pose to pose [rad]
    double rms_scale; ///< the same with one scale factor for three perpendicular axes, biases as found
} ins_calib_axes_t;

/// Memory of the caller, for `capacity` poses.
typedef struct ins_calib_triad_result_t
{
    ins_calib_axes_t accel, gyro;
    double rms_raw;          ///< of |f| with one scale factor and one bias for all three accelerometers [m/s^2]
    double threshold;        ///< of stillness, in standard deviations of the start
    double g_sensitivity[9]; ///< of the gyros [counts per m/s^2]
    double bias_rms; ///< of the gyros' mean readings in the poses about bias + g_sensitivity f, largest axis [counts]
    double bias_rms_constant; ///< the same about one bias [counts]
    size_t poses;             ///< all that were found
    size_t capacity;
    size_t* first;    ///< [capacity] first sample of a pose
    size_t* last;     ///< [capacity] last sample
    double* residual; ///< [capacity] |f| - g of a pose [m/s^2]
    double*
        angle; ///< [capacity] between gravity turned by the gyros into a pose and that seen there [rad]; 0 for the first
} ins_calib_triad_result_t;

/// \return INS_CALIB_OK; INS_CALIB_E_RANK with fewer poses than INS_CALIB_POSES_MIN, or poses that do not fix all.
INS_CALIB_API int ins_calib_triad(const ins_calib_triad_t* in, ins_calib_triad_result_t* out, char* why,
                                  size_t why_size);

#ifdef __cplusplus
}
#endif
#endif // INS_CALIB_TRIAD_H_INCLUDED
