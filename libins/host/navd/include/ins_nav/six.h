/// \file   ins_nav/six.h
/// \brief  Samples of a board with six accelerometers to attitude, velocity and position, with their deviations. Frame: b -> n. SI, rad.
///
///     ins_nav_six_init(&six, &config);                          // the link with config.link.channels = 6
///     if (ins_nav_link_octet(&link, octet, now_ms, &reply, &sample) == 1) { ins_nav_six_step(&six, &sample, &state); }
///     ins_nav_six_fix(&six, lat_lon_height, age_s, sigma_m);    // whenever there is one
///
/// Codes become readings, each interpolated back to the scan's instant (ins/rates.h), and go through ins/gyro_free.h. Lost samples
/// are bridged by a straight line between the readings before and after. No thread, no clock, no transport, no allocation.
/// SPDX-License-Identifier: MIT
#ifndef INS_NAV_SIX_H_INCLUDED
#define INS_NAV_SIX_H_INCLUDED
#include "ins/gyro_free.h"
#include "ins/rates.h"
#include "ins_nav/nav.h"
#include "ins_nav/navigation.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct ins_nav_six_config_t
{
    ins_nav_config_t link; ///< period, delays, skew_order, code_max, bridge_max and the attitude at the start count
    ins_accel_t accels[6]; ///< reading [m/s^2] of each
    double lsb_m_s2;       ///< reading of a code
    double null_code;      ///< code of reading 0
    ins_gyro_free_config_t filter;
    double v_n[3], lat_lon_height[3]; ///< at the first sample [m/s; rad, m]
    double still_s;                   ///< it stands still for so long from the first sample
    double still_m_s, still_rad_s;    ///< how still: standard deviations
} ins_nav_six_config_t;

typedef struct ins_nav_six_state_t
{
    ins_nav_state_t nav; ///< of which dtheta_b is 0
    double v_n[3];
    double lat_lon_height[3];
    double sigma[INS_GYRO_FREE_N]; ///< standard deviations of ins/gyro_free.h's errors
    uint64_t fixes;                ///< taken
    uint64_t refused;              ///< innovations outside the gate
} ins_nav_six_state_t;

/// Members are private.
typedef struct ins_nav_six_t
{
    ins_nav_six_config_t cfg;
    ins_gyro_free_t filter;
    ins_skew_t skew[2];
    double last[6]; ///< readings
    uint64_t index, used, missed, fixes;
    uint32_t sticky;
} ins_nav_six_t;

/// \return INS_OK; INS_E_RANGE for what ins_nav_config_problem() or ins_gyro_free_init() refuse, or other than six channels.
INS_API ins_status_t ins_nav_six_init(ins_nav_six_t* self, const ins_nav_six_config_t* cfg);
/// \param[in] sample  its index must be above the last one's. \return INS_OK; INS_E_RANGE, nothing changed.
INS_API ins_status_t ins_nav_six_step(ins_nav_six_t* self, const ins_nav_sample_t* sample, ins_nav_six_state_t* state);
/// A position fix; after the first sample. \param[in] age_s  of the last sample against the fix: it is carried on by the velocity, |age_s| <= 1.
/// \param[in] sigma  [3] north, east, down [m]. \return as ins_gyro_free_position(); INS_E_STATE before the first sample.
INS_API ins_status_t ins_nav_six_fix(ins_nav_six_t* self, const double lat_lon_height[3], double age_s,
                                     const double sigma[3]);
/// A state of it as one instant of navigation, with the covariance of attitude, velocity and position as they are now.
INS_API void ins_nav_six_navigation(const ins_nav_six_t* self, const ins_nav_six_state_t* state, int64_t time_ns,
                                    ins_navigation_t* out);
/// As ins_nav_state_json(); INS_NAV_SIX_JSON_MAX always is enough.
INS_API size_t ins_nav_six_json(const ins_nav_six_state_t* state, char* buffer, size_t size);
#define INS_NAV_SIX_JSON_MAX 3072

#ifdef __cplusplus
}
#endif
#endif // INS_NAV_SIX_H_INCLUDED
