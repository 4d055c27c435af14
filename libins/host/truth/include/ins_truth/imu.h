/// \file   ins_truth/imu.h
/// \brief  Errors of an IMU that gives increments: exact ones in, those of a real sensor out. Frame b; rad, m/s, s, K.
///
///     ins_imu_config_t c;
///     ins_imu_ideal_config(&c);
///     c.gyro.random_walk[0] = 3e-5;
///     ins_imu_t imu;
///     if (ins_imu_init(&imu, &c, why, sizeof why)) { ins_imu_apply(&imu, dt, 0.0, theta, v, theta, v); }
///
/// With x the mean rate or specific force of a sample, theta / dt or v / dt, and K the temperature above that of calibration:
///
///     y = (I + diag(scale + scale_per_k K) + misalignment) x + g_sensitivity f + b + random_walk / sqrt(dt) w       (gyro; accelerometer
///     b = bias + turn_on w + bias_per_k K + markov + flicker + walk                                        without g_sensitivity)
///
/// clipped to +-range, and y dt rounded to whole quanta; what is left over goes into the next sample, so no angle is lost.
/// The coefficients are those of IEEE Std 952-1997, annex C, by their Allan variance at the averaging time tau:
///
///     N random_walk: N^2 / tau     B bias_instability: B^2 2 ln 2 / pi, flat     K rate_random_walk: K^2 tau / 3
///     Q = quantum / sqrt(12): 3 Q^2 / tau^2
///
/// N is of the two-sided spectrum: a data sheet's one-sided noise density is sqrt(2) N; many sheets print N under that name.
/// B is a sum of seven first-order Markov processes, 0.1 s to 1e5 s apart by ten (Keshner 1982): 1 / f within 6 % from 2e-5 Hz to 0.3 Hz,
/// Allan deviation within 3 % of flat from 1 s to 1e4 s; together 2.3 B of standard deviation at the start.
/// Sample k of a seed has the same bits everywhere (own elementary functions, no libm).
/// SPDX-License-Identifier: MIT
#ifndef INS_TRUTH_IMU_H_INCLUDED
#define INS_TRUTH_IMU_H_INCLUDED
#include "ins_truth/api.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif

#define INS_IMU_FLICKERS 7 ///< processes of a bias instability

/// Three gyros (unit u = rad) or three accelerometers (u = m/s) along x, y, z of b.
typedef struct ins_imu_triad_t
{
    double bias[3];             ///< [u/s]
    double turn_on[3];          ///< standard deviation of what each seed adds to it [u/s]
    double scale[3];            ///< 0.01 = reads 1 % high
    double misalignment[9];     ///< row-major, what axis i sees of j [rad]; its diagonal is 0
    double random_walk[3];      ///< N, of angle or velocity [u/sqrt(s)]
    double bias_instability[3]; ///< B [u/s]
    double rate_random_walk[3]; ///< K [u/s/sqrt(s)], from 0 at the first sample
    double markov[3];           ///< standard deviation of a first-order Markov bias, steady from the start [u/s]
    double markov_tau_s;        ///< its correlation time, 1e-3 .. 1e9
    double bias_per_k[3];       ///< [u/s/K]
    double scale_per_k[3];      ///< [1/K]
    double quantum;             ///< of an increment [u]; 0: not rounded
    double range;               ///< [u/s]; 0: unlimited
} ins_imu_triad_t;

typedef struct ins_imu_config_t
{
    ins_imu_triad_t gyro, accel;
    double g_sensitivity[9]; ///< of the gyros, row-major, by specific force [rad/s per m/s^2]
    uint64_t seed;
} ins_imu_config_t;

/// What one triad has become.
typedef struct ins_imu_state_t
{
    double bias[3]; ///< b of the newest sample [u/s]
    double turn_on[3], markov[3], walk[3], flicker[INS_IMU_FLICKERS][3];
    double left[3];     ///< not put out yet [u]
    uint64_t saturated; ///< components clipped
} ins_imu_state_t;

/// Owned by the caller. Start with ins_imu_init(). Read gyro.bias, accel.bias, saturated; the rest is private.
typedef struct ins_imu_t
{
    ins_imu_config_t config;
    ins_imu_state_t gyro, accel;
    int64_t samples;
} ins_imu_t;

/// No error of any kind; markov_tau_s 100, seed 1.
INS_TRUTH_API void ins_imu_ideal_config(ins_imu_config_t* config);
/// \return false when config is refused: why[why_size] names the triad, the member, the value and the remedy.
INS_TRUTH_API bool ins_imu_init(ins_imu_t* self, const ins_imu_config_t* config, char* why, size_t why_size);
/// The next sample.
/// \param[in] dt_s       its length, above 0.
/// \param[in] above_k    temperature above that of calibration [K].
/// \param[out] theta_out  may be theta, v_out may be v.
INS_TRUTH_API void ins_imu_apply(ins_imu_t* self, double dt_s, double above_k, const double theta[3], const double v[3],
                                 double theta_out[3], double v_out[3]);

#ifdef __cplusplus
}
#endif
#endif // INS_TRUTH_IMU_H_INCLUDED
