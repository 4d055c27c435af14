/// \file   ins_truth/front_end.h
/// \brief  Sensor bandwidth, amplifier and anti-alias RC as differential equations, advanced to each instant a converter samples. V, s.
///
///     ins_front_end_config_t c = {.channels = 3, .tolerance_v = 1e-7, .source = ins_gyro_volts, .ctx = &gyro};
///     c.channel[0] = (ins_front_end_channel_t){.sensor_hz = 50.0, .rail_high_v = 5.0, .rc_s = 1e-4};
///     ins_front_end_t* f = ins_front_end_create(&c, why, sizeof why);
///     adc.analog.volts = ins_front_end_volts; adc.analog.ctx = f;
///
/// Each channel is a chain; a stage whose figure is 0 is a wire. With u what comes in and w = 2 pi f:
///
///     sensor     y' = w (u - y), or, with damping z: y'' = w^2 (u - y) - 2 z w y'
///     amplifier  y' = w (clip(u) - y), |y'| <= slew; clip: to the rails
///     RC         y' = (u - y) / rc
///
/// It is in libins_truth_cvode, which is built where SUNDIALS 6 is found: bits hold for one build of SUNDIALS and libm, where those of
/// ins_gyro_volts() alone hold everywhere. Between two instants asked for the state is a few numbers, so a run's snapshot can hold it.
/// Source: CVODE's variable-order BDF (Hindmarsh et al., ACM TOMS 31(3), 2005), started anew at each sample and each jump of the source.
/// SPDX-License-Identifier: MIT
#ifndef INS_TRUTH_FRONT_END_H_INCLUDED
#define INS_TRUTH_FRONT_END_H_INCLUDED
#include "ins_truth/api.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif

#define INS_FRONT_END_CHANNELS 11
#define INS_FRONT_END_STATES   4 ///< sensor, its slope / w, amplifier, RC

typedef struct ins_front_end_channel_t
{
    double sensor_hz;               ///< 0, or 1e-2 .. 1e6
    double sensor_damping;          ///< 0: first order; else 0.05 .. 20
    double amplifier_hz;            ///< closed loop; 0: at once; or 1 .. 1e8
    double slew_v_s;                ///< 0: unlimited; or 1e-3 .. 1e9; needs amplifier_hz
    double rail_low_v, rail_high_v; ///< rail_low_v < rail_high_v, within +-1e3
    double rc_s;                    ///< 0, or 1e-9 .. 10
} ins_front_end_channel_t;

typedef struct ins_front_end_config_t
{
    unsigned channels; ///< 1 .. INS_FRONT_END_CHANNELS
    ins_front_end_channel_t channel[INS_FRONT_END_CHANNELS];
    int64_t hold_ps;    ///< the source jumps at multiples of it (noise held for that long); 0: it is smooth
    double tolerance_v; ///< of a step, 1e-12 .. 1e-2
    double (*source)(void* ctx, unsigned channel, int64_t t_ps); ///< volts without these stages; finite
    void* ctx;                                                   ///< must outlive the front end
} ins_front_end_config_t;

/// Of one channel at the newest instant asked for.
typedef struct ins_front_end_state_t
{
    int64_t t_ps;
    double x[INS_FRONT_END_STATES];
} ins_front_end_state_t;

typedef struct ins_front_end_t ins_front_end_t;

/// At rest at t = 0, at what the source says then. NULL, and why[why_size] says what would be right: refused.
INS_TRUTH_API ins_front_end_t* ins_front_end_create(const ins_front_end_config_t* config, char* why, size_t why_size);
INS_TRUTH_API void ins_front_end_destroy(ins_front_end_t* self); ///< NULL is allowed.
/// Volts at the pin; a channel is advanced to t_ps. An earlier instant than the last starts it anew, at rest there. Channels that are
/// not there read the source. Has the type of the emulators' analogue nets. \param[in] front_end an ins_front_end_t
INS_TRUTH_API double ins_front_end_volts(void* front_end, unsigned channel, int64_t t_ps);
/// How often the solver gave up; the channel then stands still at rail_low_v. 0 for a source that is finite.
INS_TRUTH_API uint64_t ins_front_end_failures(const ins_front_end_t* self);
/// For snapshots. channel < channels.
INS_TRUTH_API void ins_front_end_get(const ins_front_end_t* self, unsigned channel, ins_front_end_state_t* state);
/// As ins_front_end_get() gave it: what follows has the same bits.
INS_TRUTH_API void ins_front_end_set(ins_front_end_t* self, unsigned channel, const ins_front_end_state_t* state);

#ifdef __cplusplus
}
#endif
#endif // INS_TRUTH_FRONT_END_H_INCLUDED
