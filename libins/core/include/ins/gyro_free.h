/// \file   ins/gyro_free.h
/// \brief  Navigation without gyros: six or more accelerometers, a strapdown and a filter of 18 errors, aided by GPS positions and
///         standstills. Frames: b -> n (NED). SI, rad.
///
///     ins_gyro_free_t g;
///     ins_gyro_free_init(&g, &config, 6, accels, period_s, q_nb0, v_n0, &start);
///     for (;;) {
///         ins_gyro_free_step(&g, readings);                        // g.strapdown, g.sixacc.w_ib_b, ins_gyro_free_sigma()
///         ins_gyro_free_position(&g, &fix_position, sigma_m, l_b); // whenever there is a fix
///     }
///
/// The accelerometers give the angular acceleration wd and the specific force f (ins/sixacc.h). Their errors integrate once into the
/// rate, twice into the attitude, and through gravity four times into the position, so nothing here lasts without aiding.
/// Errors are truth less estimate: phi (attitude, n), dv, dp (n, metres), dw (b), and what the biases of the readings make of wd and
/// of f, dbd and dbf (b): of N biases only these six combinations are observable.
///     phi' = C dw     dv' = phi x f + C (J dw - dbf)     dp' = dv     dw' = J dw - dbd     db' = noise
/// Attitude, velocity and position are one element of a group, and their errors of the body (left-invariant): the estimate is
/// moved by exp(phi, dv, dp), and their covariance turns with it. As differences they would make the filter surer than it may be.
/// J is the derivative of the centripetal terms. The Earth's rate moves the state but is left out of the filter's model: 7e-5 rad/s of
/// errors. UD form (ins/kalman.h): the errors' ratios are those of t^4.
/// Source: C.-Y. Hung et al. (ins/sixacc.h); P. D. Groves (2013), 14.2; A. Barrau, S. Bonnabel, IEEE Trans. AC 62(4), 2017, 1797-1812.
/// Cost:   no libm but sqrt, no allocation; docs/gyro_free.md.
/// SPDX-License-Identifier: MIT
#ifndef INS_GYRO_FREE_H_INCLUDED
#define INS_GYRO_FREE_H_INCLUDED
#include "ins/config.h"
#include "ins/kalman.h"
#include "ins/sixacc.h"
#include "ins/strapdown.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_GYRO_FREE_N 18

/// Where three errors begin.
enum
{
    INS_GYRO_FREE_PHI = 0, ///< attitude, in n [rad]
    INS_GYRO_FREE_V = 3,   ///< velocity, in n [m/s]
    INS_GYRO_FREE_P = 6,   ///< position, north, east, down [m]
    INS_GYRO_FREE_W = 9,   ///< rate, in b [rad/s]
    INS_GYRO_FREE_BD = 12, ///< of the angular acceleration, in b [rad/s^2]
    INS_GYRO_FREE_BF = 15  ///< of the specific force, in b [m/s^2]
};

/// Standard deviations; those of the readings are alike for all accelerometers, in m/s^2.
typedef struct ins_gyro_free_config_t
{
    ins_real noise;       ///< of a reading, quantisation included, > 0
    ins_real bias;        ///< of a reading's bias at the start
    ins_real bias_walk;   ///< its growth [m/s^2/sqrt(s)]
    ins_real attitude[3]; ///< at the start, about north, east, down [rad]
    ins_real velocity;    ///< each axis [m/s]
    ins_real position;    ///< each axis [m]
    ins_real rate;        ///< each axis [rad/s]
    ins_real gate;        ///< an innovation's v^2 / variance above it is refused: INS_KALMAN_GATE_999 is good; 0: none
} ins_gyro_free_config_t;

/// Owned by the caller; readable.
typedef struct ins_gyro_free_t
{
    ins_gyro_free_config_t cfg;
    ins_sixacc_t sixacc; ///< its biases are the estimated ones
    ins_strapdown_t strapdown;
    ins_real forward[INS_SIXACC_MAX][6]; ///< reading of an angular acceleration and a specific force
    ins_real noise[6][6];                ///< covariance of these two for readings of variance 1
    ins_real UD[INS_UD_SIZE(INS_GYRO_FREE_N)];
    uint32_t refused; ///< innovations outside the gate
} ins_gyro_free_t;

/// At rate 0. \return INS_OK; INS_E_RANGE for what ins_sixacc_init() and ins_strapdown_init() refuse, a noise that is not positive, or
/// another figure that is negative or not a number.
INS_API ins_status_t ins_gyro_free_init(ins_gyro_free_t* self, const ins_gyro_free_config_t* cfg, unsigned count,
                                        const ins_accel_t* accels, ins_real period_s, const ins_real q_nb[4],
                                        const ins_real v_n[3], const ins_position_t* position);
/// Next sample. \param[in] readings  [count]. \return INS_OK; INS_S_START for the first sample, which moves nothing; INS_E_RANGE as
/// ins_sixacc_step() and ins_strapdown_step(); nothing is changed then.
INS_API ins_status_t ins_gyro_free_step(ins_gyro_free_t* self, const ins_real* readings);
/// A fix of the antenna's position at the last sample. Each axis is judged by itself.
/// \param[in] sigma  [3] north, east, down [m]. \param[in] l_b  [3] from the IMU to the antenna [m].
/// \return INS_OK; INS_E_GATE: an axis was outside the gate (the others count); INS_E_RANGE for NaN or a sigma that is not positive.
INS_API ins_status_t ins_gyro_free_position(ins_gyro_free_t* self, const ins_position_t* fix, const ins_real sigma[3],
                                            const ins_real l_b[3]);
/// A known velocity. \param[in] sigma  [3] [m/s]. \return as ins_gyro_free_position().
INS_API ins_status_t ins_gyro_free_velocity(ins_gyro_free_t* self, const ins_real v_n[3], const ins_real sigma[3]);
/// Known to stand still: the velocity is 0 and the rate that of the Earth. What calibrates dbd, at every sample of a standstill.
/// \param[in] sigma_v  [m/s]. \param[in] sigma_w  [rad/s]. \return as ins_gyro_free_position().
INS_API ins_status_t ins_gyro_free_still(ins_gyro_free_t* self, ins_real sigma_v, ins_real sigma_w);
/// \param[out] sigma  [INS_GYRO_FREE_N] standard deviations of the errors.
INS_API void ins_gyro_free_sigma(const ins_gyro_free_t* self, ins_real sigma[INS_GYRO_FREE_N]);

#ifdef __cplusplus
}
#endif
#endif // INS_GYRO_FREE_H_INCLUDED
