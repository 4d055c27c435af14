/// \file   ins_truth/gyro.h
/// \brief  Three rate-gyro channels with amplifiers on a known motion: volts(channel, time), a pure function. V, rad/s, s.
///
///     ins_gyro_config_t c;
///     ins_gyro_default_config(&c);
///     ins_gyro_t g;
///     if (ins_gyro_init(&g, &c, motion, why, sizeof why)) { adc.analog.volts = ins_gyro_volts; adc.analog.ctx = &g; }
///
/// rate  = (1 + scale_error) * lowpass(axis . w_ib_b) + bias + drift * t + noise
/// volts = null_v + gain * sensitivity * rate, clipped to the rails
///
/// Bandwidth: first order, y(t) = integral of exp(-s) w(t - s tau) ds over s >= 0, tau = 1 / (2 pi bandwidth_hz), by
/// 16-node Gauss-Laguerre. Its error, relative to the input, at motion frequency / bandwidth_hz =
/// up to 0.5: rounding; 1: 4e-11; 2: 8e-5; 4: 8e-2 (docs/truth.md).
///
/// Noise: Gaussian values held for h = 1 / (2 noise_bandwidth_hz), each from (seed, channel, floor(t / h)); white for
/// samples further apart than h. Variance noise_density^2 * noise_bandwidth_hz; one-sided spectrum
/// noise_density^2 * sinc^2(f h); angle random walk noise_density / sqrt(2).
/// SPDX-License-Identifier: MIT
#ifndef INS_TRUTH_GYRO_H_INCLUDED
#define INS_TRUTH_GYRO_H_INCLUDED
#include "ins_truth/motion.h"
#include <stdbool.h>
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif

#define INS_GYRO_CHANNELS 3 ///< X, Y, Z

typedef struct ins_gyro_channel_t
{
    double axis[3];       ///< sensitive axis in b, unit length within 1e-3 (so misalignment is an axis off its own)
    double sensitivity;   ///< before the amplifier [V/(rad/s)], not 0; negative turns the sense round
    double gain;          ///< amplifier, not 0
    double null_v;        ///< at the converter, after the amplifier, at rest [V]
    double bandwidth_hz;  ///< 0 = unlimited
    double noise_density; ///< [rad/s/sqrt(Hz)], one-sided
    double bias;          ///< [rad/s]
    double drift;         ///< of the bias [rad/s/s], from t = 0
    double scale_error;   ///< 0.01 = reads 1 % high
} ins_gyro_channel_t;

typedef struct ins_gyro_config_t
{
    ins_gyro_channel_t channel[INS_GYRO_CHANNELS];
    double rail_low_v, rail_high_v; ///< the amplifier's output stays between them [V]
    double noise_bandwidth_hz;      ///< 1e-3 .. 1e9
    uint64_t seed;
} ins_gyro_config_t;

/// Owned by the caller. Start with ins_gyro_init(). Members are private.
typedef struct ins_gyro_t
{
    ins_gyro_config_t config;
    const ins_motion_t* motion;
    int64_t noise_step_ps;
    double noise_sigma[INS_GYRO_CHANNELS]; ///< [rad/s]
} ins_gyro_t;

/// Ideal gyros for a 0 .. 5 V converter: 5 V span = +-90 deg/s (5 / pi V/(rad/s) at gain 1), null 2.5 V, that is
/// 2048 * 5 / 4096 V, the middle of code 2048 of a TLC2543; unlimited bandwidth; no noise, bias, drift or scale error;
/// rails 0 and 5 V; noise bandwidth 500 Hz; seed 1.
INS_TRUTH_API void ins_gyro_default_config(ins_gyro_config_t* config);
/// The CG-L53 of Zheng and Zhou (2010) with its amplifier. EVERY number is an assumption: no data sheet of the
/// CG-L53 was found (gyro.c says where each comes from; the nearest documented kin is Murata's ENC-03R).
INS_TRUTH_API void ins_gyro_cgl53_config(ins_gyro_config_t* config);

/// The motion must outlive the gyro. \return false when config is refused: why[why_size] names the channel, the
/// member and the remedy.
INS_TRUTH_API bool ins_gyro_init(ins_gyro_t* self, const ins_gyro_config_t* config, const ins_motion_t* motion,
                                 char* why, size_t why_size);

/// What the channel takes the rate to be [rad/s]: errors and noise included, before the rails. channel < 3.
INS_TRUTH_API double ins_gyro_rate(const ins_gyro_t* self, unsigned channel, int64_t t_ps);
/// Volts at the converter; channels from INS_GYRO_CHANNELS up have nothing connected and read rail_low_v. Has the
/// type of the emulators' analogue nets. \param[in] gyro an ins_gyro_t
INS_TRUTH_API double ins_gyro_volts(void* gyro, unsigned channel, int64_t t_ps);

/// What a navigator is told about a channel, from nominal values: rate = (code - null_code) * rate_per_lsb.
/// Converter: 2^bits codes over ref_plus_v - ref_minus_v. \return false unless channel < 3, 1 <= bits <= 24 and
/// ref_plus_v > ref_minus_v.
INS_TRUTH_API bool ins_gyro_scale(const ins_gyro_config_t* config, unsigned channel, unsigned bits, double ref_minus_v,
                                  double ref_plus_v, double* rate_per_lsb, double* null_code);

#ifdef __cplusplus
}
#endif
#endif // INS_TRUTH_GYRO_H_INCLUDED
