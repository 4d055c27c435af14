/// \file   ins/gps_dr.h
/// \brief  GPS and dead reckoning of a vehicle, decentralised: it finds its heading, shares information, switches. Units: m, s, rad.
///
///     ins_gps_dr_t n;
///     ins_gps_dr_config_t cfg;
///     ins_gps_dr_fix_t fix = {0};
///     ins_real x[6];
///     ins_real P[36];
///     ins_real yaw_rate = 0, distance = 0;
///     ins_gps_dr_config_default(&cfg);
///     ins_gps_dr_init(&n, &cfg);
///     ins_gps_dr_step(&n, INS_C(0.1), yaw_rate, distance);   // each 100 ms
///     ins_gps_dr_fix(&n, &fix);                              // each s, valid or not
///     ins_gps_dr_state(&n, x, P);                            // INS_UNICYCLE_EAST ...
///
/// Frame as ins/dead_reckoning.h. Start: vehicle filters (ins/unicycle.h) with headings all round, weighed by the fixes (a Gaussian sum,
/// merged when it has one heading), or the receiver's course once it moves. Then two local filters with half of the information each:
/// both reckon, one of them also takes the fixes. While the switch says GPS they are fused after each fix and share again, which is the
/// filter that takes everything; else the reckoning one goes on alone, and fixes prove themselves in the other.
/// A fix is judged with the deviation it states. It weighs as one of a Student's t with 4 degrees of freedom, and, since the errors of
/// successive fixes are those of one multipath, as T/(T + 2 tau_fix) of a fresh one.
/// Source: N. A. Carlson, IEEE Trans. AES 26(3), 1990, 517-525 (information sharing); D. L. Alspach and H. W. Sorenson, IEEE Trans.
/// AC 17(4), 1972, 439-448 (Gaussian sum); K. L. Lange, R. Little, J. Taylor, JASA 84(408), 1989, 881-896 (weight of a t).
/// SPDX-License-Identifier: MIT
#ifndef INS_GPS_DR_H_INCLUDED
#define INS_GPS_DR_H_INCLUDED
#include "ins/fusion.h"
#include "ins/unicycle.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_GPS_DR_HEADINGS 8 ///< at the start

/// What the state rests on.
enum
{
    INS_GPS_DR_NONE,  ///< no fix yet
    INS_GPS_DR_ALIGN, ///< fixes; the heading is being found
    INS_GPS_DR_DR,    ///< dead reckoning
    INS_GPS_DR_GPS
};

typedef struct ins_gps_dr_config_t
{
    ins_unicycle_config_t vehicle; ///< noise; q_speed and the gates are not used
    ins_switch_config_t choice;    ///< its gate is for the nis of a fix with the deviation it states
    ins_real sigma_bias;           ///< gyro bias at the start [rad/s]
    ins_real sigma_scale;          ///< odometer scale at the start
    ins_real tau_fix;              ///< correlation time of a fix's error [s]; 0: white
    ins_real gate_gross;           ///< nis above which a fix is not used at all; 0: none
    ins_real sigma_velocity;       ///< of the receiver's velocity: its course has sigma_velocity/speed [m/s]
    ins_real course_min;           ///< speed from which the course is used [m/s]
    ins_real still_after;  ///< standing so long, the mean yaw rate counts as one sample of the bias [s]; 0: never
    ins_real fix_max_age;  ///< without a fix for so long: dead reckoning [s]
    uint_least8_t restart; ///< gross fixes in a row after which it starts again; 0: never
} ins_gps_dr_config_t;

typedef struct ins_gps_dr_fix_t
{
    ins_real east, north; ///< [m]
    ins_real sigma;       ///< of each [m]
    ins_real age;         ///< how long ago it was so [s]
    ins_real hdop;
    ins_real course, speed;   ///< clockwise from north [rad]; [m/s]
    uint_least8_t valid;      ///< 0: there is no fix, nothing else is read
    uint_least8_t sats;       ///< satellites used
    uint_least8_t has_course; ///< course and speed are known
} ins_gps_dr_fix_t;

/// Owned by the caller; readable.
typedef struct ins_gps_dr_t
{
    ins_gps_dr_config_t cfg;
    ins_unicycle_t local[INS_GPS_DR_HEADINGS]; ///< with `paired`: [0] reckons, [1] takes fixes as well
    ins_real weight[INS_GPS_DR_HEADINGS];      ///< of each heading, the best 1
    uint_least8_t count;                       ///< of local; 0: not started
    uint_least8_t paired;
    ins_switch_t choice;
    ins_real since_fix;      ///< [s]
    ins_real stood;          ///< no distance for this long, or since the last sample of the bias [s]
    ins_real turned;         ///< in that time, as the gyro says [rad]
    ins_real nis;            ///< of the last fix
    uint_least8_t gross_run; ///< gross fixes in a row
    uint_least32_t used;     ///< fixes
    uint_least32_t doubted;  ///< fixes that made the switch say DR
    uint_least32_t gross;    ///< fixes refused
    uint_least32_t restarts;
} ins_gps_dr_t;

/// A car with a MEMS gyro and wheel pulses, a receiver between buildings (docs/gps_dr.md).
INS_API void ins_gps_dr_config_default(ins_gps_dr_config_t* cfg);
/// \return INS_E_RANGE: as ins_unicycle_init() and ins_switch_init() with theirs; one of the others is negative or not a number.
INS_API ins_status_t ins_gps_dr_init(ins_gps_dr_t* self, const ins_gps_dr_config_t* cfg);
/// dt [s] have passed. \param[in] yaw_rate  clockwise, their mean [rad/s]. \param[in] distance  counted in them [m].
/// \return INS_OK; INS_E_RANGE: dt is not positive, or one is not a number or beyond 1000 rad: nothing changed.
INS_API ins_status_t ins_gps_dr_step(ins_gps_dr_t* self, ins_real dt, ins_real yaw_rate, ins_real distance);
/// \return INS_OK; INS_E_GATE: gross, or its course was: that is not used; INS_E_RANGE: not a number, or sigma is not positive.
INS_API ins_status_t ins_gps_dr_fix(ins_gps_dr_t* self, const ins_gps_dr_fix_t* fix);
/// INS_GPS_DR_NONE ...
INS_API int ins_gps_dr_source(const ins_gps_dr_t* self);
/// \param[out] x  [6] INS_UNICYCLE_EAST ... \param[out] P  [36]; may be 0. \return INS_E_STATE: no fix yet.
INS_API ins_status_t ins_gps_dr_state(const ins_gps_dr_t* self, ins_real x[6], ins_real P[36]);

#ifdef __cplusplus
}
#endif
#endif // INS_GPS_DR_H_INCLUDED
