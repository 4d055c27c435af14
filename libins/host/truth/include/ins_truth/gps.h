/// \file   ins_truth/gps.h
/// \brief  Fixes of a GPS receiver on a known trajectory: errors, latency, outages, satellites; a pure function of the fix's number.
///
///     ins_gps_config_t c;
///     ins_gps_default_config(&c);
///     ins_gps_t g;
///     if (ins_gps_init(&g, &c, track, why, sizeof why)) { ins_gps_fix(&g, t_ps, &newest); }
///
/// Fix k is of instant k * period and is there from latency later. Error of its position in each of north, east, down:
///
///     e_k = white_k + m_k        m_k = phi m_(k-1) + sqrt(1 - phi^2) markov w_k        phi = exp(-period / markov_tau)
///
/// with m_0 of the steady state: standard deviation markov, autocorrelation exp(-|t| / markov_tau). Velocity: white alone.
/// SPDX-License-Identifier: MIT
#ifndef INS_TRUTH_GPS_H_INCLUDED
#define INS_TRUTH_GPS_H_INCLUDED
#include "ins_truth/track.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_GPS_OUTAGES 32

/// No fix of an instant from <= t < to [s].
typedef struct ins_gps_outage_t
{
    double from_s, to_s;
} ins_gps_outage_t;

typedef struct ins_gps_config_t
{
    int64_t period_ps;    ///< 1e10 .. 1e14
    int64_t latency_ps;   ///< 0 .. 1e13
    double white[3];      ///< standard deviation, north, east, down [m]
    double markov[3];     ///< the same of the slow error [m]
    double markov_tau_s;  ///< its correlation time, 1e-3 .. 1e6
    double velocity[3];   ///< standard deviation [m/s]
    unsigned sats;        ///< in use with a fix, 3 .. 32
    unsigned sats_spread; ///< up to so many fewer, drawn for each fix; sats - sats_spread >= 3
    unsigned sats_outage; ///< in view without a fix, 0 .. 2
    double hdop;          ///< reported, 0.5 .. 50
    double first_fix_s;   ///< no fix of an earlier instant (cold start)
    unsigned outages;     ///< windows used
    ins_gps_outage_t outage[INS_GPS_OUTAGES];
    uint64_t seed;
} ins_gps_config_t;

typedef struct ins_gps_fix_t
{
    int64_t number; ///< k
    int64_t of_ps;  ///< the instant it is of
    bool valid;     ///< false: only number, of_ps and sats are set, the others 0
    double llh[3];  ///< [rad, rad, m]
    double v_n[3];  ///< [m/s]
    double speed;   ///< over ground [m/s]
    double course;  ///< from north, clockwise, 0 .. 2 pi [rad]
    unsigned sats;  ///< in use
    double hdop;
} ins_gps_fix_t;

/// Owned by the caller. Start with ins_gps_init(). Members are private.
typedef struct ins_gps_t
{
    ins_gps_config_t config;
    const ins_track_t* track;
    double phi, kick; ///< of the slow error
    int64_t slow_number;
    double slow[3]; ///< m of slow_number, in units of its standard deviation
} ins_gps_t;

/// 1 Hz, 0.1 s late; white 1.5, 1.5, 3 m; slow 2.5, 2.5, 5 m over 100 s; velocity 0.1 m/s; 8 satellites, up to 2 fewer; HDOP 1.2;
/// no outage; seed 1. Chosen, of the order of a single-frequency receiver of that time without corrections.
INS_TRUTH_API void ins_gps_default_config(ins_gps_config_t* config);
/// 1 Hz, no latency, no error, 8 satellites.
INS_TRUTH_API void ins_gps_ideal_config(ins_gps_config_t* config);
/// The track must outlive the receiver. \return false when config is refused: why[why_size] names the member and the remedy.
INS_TRUTH_API bool ins_gps_init(ins_gps_t* self, const ins_gps_config_t* config, const ins_track_t* track, char* why,
                                size_t why_size);
/// Fix number k >= 0. The same k gives the same bits in any order; rising k costs least.
INS_TRUTH_API void ins_gps_number(ins_gps_t* self, int64_t number, ins_gps_fix_t* fix);
/// The newest fix that is there at t_ps. \return false when there is none yet (fix is zeroed) or it is not valid.
INS_TRUTH_API bool ins_gps_fix(ins_gps_t* self, int64_t t_ps, ins_gps_fix_t* fix);

#ifdef __cplusplus
}
#endif
#endif // INS_TRUTH_GPS_H_INCLUDED
