/// \file   ins_truth/accel.h
/// \brief  Accelerometers at lever arms on a known track: volts(channel, time), a pure function. Frame: b. V, m/s^2, m, s.
///
///     ins_accel_config_t c;
///     ins_accel_paper_config(&c, 0.1, 2.0 * 9.80665, 0.0, 5.0);
///     c.channel[0].bias = 0.01;
///     ins_accels_t a;
///     if (ins_accels_init(&a, &c, track, why, sizeof why)) { adc.analog.volts = ins_accels_volts; adc.analog.ctx = &a; }
///
/// x     = axis . (f + wd x r + w x (w x r))
/// a     = bias + turn_on + (1 + scale_error) * x + quadratic * x^2 + noise
/// volts = null_v + sensitivity * a, clipped to the rails
///
/// f and w are the track's at its origin; wd is the difference of w over +-3 ms, of sixth order: it errs by 7e-21 (2 pi f)^6 of itself
/// at f [Hz], which is 4e-10 at 10 Hz, and by a rounding of 1e-12 rad/s^2.
/// Noise: Gaussian values held for noise_hold_s, each from (seed, channel, floor(t / noise_hold_s)); white for samples further apart.
/// turn_on: Gaussian, one value a channel, from the seed.
/// SPDX-License-Identifier: MIT
#ifndef INS_TRUTH_ACCEL_H_INCLUDED
#define INS_TRUTH_ACCEL_H_INCLUDED
#include "ins_truth/track.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_ACCEL_CHANNELS 11 ///< most; the inputs of a TLC2543

typedef struct ins_accel_channel_t
{
    double axis[3];     ///< sensitive axis in b; its length, 0.5 to 2, is a scale factor too
    double r[3];        ///< place in b [m], from the track's origin
    double sensitivity; ///< [V/(m/s^2)], not 0; negative turns the sense round
    double null_v;      ///< at rest without gravity [V]
    double bias;        ///< [m/s^2]
    double scale_error; ///< 0.01 = reads 1 % high
    double quadratic;   ///< [1/(m/s^2)]
    double noise;       ///< standard deviation of a sample [m/s^2]
} ins_accel_channel_t;

typedef struct ins_accel_config_t
{
    unsigned count; ///< 1..INS_ACCEL_CHANNELS
    ins_accel_channel_t channel[INS_ACCEL_CHANNELS];
    double rail_low_v, rail_high_v; ///< the output stays between them [V]
    double turn_on;                 ///< standard deviation of what each bias has of its own at a start [m/s^2]
    double noise_hold_s;            ///< 1e-6 .. 1
    uint64_t seed;
} ins_accel_config_t;

/// Owned by the caller. Start with ins_accels_init(). Members are private.
typedef struct ins_accels_t
{
    ins_accel_config_t config;
    const ins_track_t* track;
    int64_t hold_ps;
} ins_accels_t;

/// The six of Hung, Fang, Wang and Lee, table 1, on an arm rho [m]: +-range [m/s^2] over the converter's span, null in its middle
/// (of code 2048 at 12 bits); no errors, no noise; noise held for 50 us; seed 1.
INS_TRUTH_API void ins_accel_paper_config(ins_accel_config_t* config, double rho, double range, double ref_minus_v,
                                          double ref_plus_v);
/// The track must outlive self. \return false when config is refused: why[why_size] names the channel, the member and the remedy.
INS_TRUTH_API bool ins_accels_init(ins_accels_t* self, const ins_accel_config_t* config, const ins_track_t* track,
                                   char* why, size_t why_size);
/// Without errors: axis . (f + wd x r + w x (w x r)) [m/s^2].
INS_TRUTH_API double ins_accels_exact(const ins_accels_t* self, unsigned channel, int64_t t_ps);
/// What the channel takes it to be [m/s^2]: errors and noise included, before the rails.
INS_TRUTH_API double ins_accels_reading(const ins_accels_t* self, unsigned channel, int64_t t_ps);
/// Volts at the converter; channels from count up read rail_low_v. Has the type of an analogue input. \param[in] accels  an ins_accels_t
INS_TRUTH_API double ins_accels_volts(void* accels, unsigned channel, int64_t t_ps);

#ifdef __cplusplus
}
#endif
#endif // INS_TRUTH_ACCEL_H_INCLUDED
