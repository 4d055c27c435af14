/// \file   ins/gps_dr_paper.h
/// \brief  The GPS/DR paper's navigator: a filter a coordinate of the fixes, one of dead reckoning, a switch. Units: m, s, rad.
///
///     ins_gps_dr_paper_t n;
///     ins_gps_dr_paper_config_t cfg;
///     ins_gps_dr_fix_t fix = {0};
///     ins_real yaw_rate = 0, distance = 0;
///     ins_gps_dr_paper_config_default(&cfg, INS_GPS_DR_PAPER_CORRECTED);
///     ins_gps_dr_paper_init(&n, &cfg);
///     ins_gps_dr_paper_step(&n, yaw_rate, distance);   // each cfg.dr.dt: 100 ms
///     ins_gps_dr_paper_fix(&n, &fix);                  // each cfg.axis.dt: 1 s; with fix.valid = 0 when none came
///
/// Frame as ins/dead_reckoning.h. With good fixes the position is that of the GPS filters, and the reckoning one is set to it at each;
/// else it is the reckoning one's. The paper filters along x, y, z of the Earth; with one set of figures for all axes the same
/// filter comes out along east and north, and up is not needed. For comparison: ins/gps_dr.h is the one to use.
/// Source: the ARM vehicle navigator paper of the GPS/DR system, 1.2.3.
/// SPDX-License-Identifier: MIT
#ifndef INS_GPS_DR_PAPER_H_INCLUDED
#define INS_GPS_DR_PAPER_H_INCLUDED
#include "ins/dead_reckoning.h"
#include "ins/fusion.h"
#include "ins/gps_axis.h"
#include "ins/gps_dr.h"
#ifdef __cplusplus
extern "C" {
#endif

enum
{
    INS_GPS_DR_PAPER_PRINTED,  ///< back to GPS at the first good fix, no gate of a fix, the yaw rate used at any speed
    INS_GPS_DR_PAPER_CORRECTED ///< hysteresis, gate, yaw rate above 0.5 m/s only
};

typedef struct ins_gps_dr_paper_config_t
{
    ins_gps_axis_config_t axis; ///< of east and of north
    ins_dr_ekf_config_t dr;
    ins_switch_config_t choice;
    ins_real var_velocity;     ///< of each velocity at the start [(m/s)^2]
    ins_real var_acceleration; ///< [(m/s^2)^2]
} ins_gps_dr_paper_config_t;

/// Owned by the caller; readable.
typedef struct ins_gps_dr_paper_t
{
    ins_gps_dr_paper_config_t cfg;
    ins_gps_axis_t axis[2]; ///< east, north
    ins_dr_ekf_t dr;
    ins_switch_t choice;
    uint_least8_t started;
    ins_real nis;           ///< of the last fix, both coordinates
    uint_least32_t used;    ///< fixes
    uint_least32_t refused; ///< by the gate of an axis, or not a number
} ins_gps_dr_paper_t;

/// Tasks of 100 ms and 1 s. \param[in] reading  INS_GPS_DR_PAPER_PRINTED or _CORRECTED.
INS_API void ins_gps_dr_paper_config_default(ins_gps_dr_paper_config_t* cfg, int reading);
/// \return INS_E_RANGE: as the parts' own init.
INS_API ins_status_t ins_gps_dr_paper_init(ins_gps_dr_paper_t* self, const ins_gps_dr_paper_config_t* cfg);
/// \return as ins_dr_ekf_step(); INS_OK before the first fix.
INS_API ins_status_t ins_gps_dr_paper_step(ins_gps_dr_paper_t* self, ins_real yaw_rate, ins_real distance);
/// Sigma, age and course are not read: the paper's filters have one variance for all. \return as ins_gps_axis_step(); INS_OK when
/// the fix is not valid.
INS_API ins_status_t ins_gps_dr_paper_fix(ins_gps_dr_paper_t* self, const ins_gps_dr_fix_t* fix);
/// INS_GPS_DR_NONE, _DR or _GPS.
INS_API int ins_gps_dr_paper_source(const ins_gps_dr_paper_t* self);
/// \param[out] x  [4] east, north, their velocities. \param[out] var  [4] variances. \return INS_E_STATE: no fix yet.
INS_API ins_status_t ins_gps_dr_paper_state(const ins_gps_dr_paper_t* self, ins_real x[4], ins_real var[4]);

#ifdef __cplusplus
}
#endif
#endif // INS_GPS_DR_PAPER_H_INCLUDED
