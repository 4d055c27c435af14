/// \file   ins/gnss.h
/// \brief  A GNSS fix as a navigation filter takes it, and times of week made continuous. Frame: n (NED). SI, rad, ns.
///
///     fix.t_ns = ins_gnss_time_near(tow_ms * 1000000LL, INS_GNSS_WEEK_NS, imu_t_ns);    // whatever the week number says
///
/// A receiver counts weeks modulo 1024 (IS-GPS-200, 20.3.3.3.1.1), and some report the new time of week a message before the new
/// week. Neither matters to who knows the time to half a period: the IMU's clock does.
/// SPDX-License-Identifier: MIT
#ifndef INS_GNSS_H_INCLUDED
#define INS_GNSS_H_INCLUDED
#include "ins/config.h"
#include "ins/strapdown.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_GNSS_WEEK_NS     INT64_C(604800000000000)           ///< one week: a time of week repeats after it
#define INS_GNSS_ROLLOVER_NS (INT64_C(1024) * INS_GNSS_WEEK_NS) ///< of a week number of 10 bits
#define INS_GNSS_TIME_MAX_NS INT64_C(4000000000000000000)       ///< 126 years: times lie within +- this

/// What a receiver says of its antenna. A standard deviation of 0: this figure is not known, and not used.
typedef struct ins_gnss_fix_t
{
    int64_t t_ns; ///< of which it is, in the time base of the IMU
    ins_position_t position;
    ins_real v_n[3];     ///< over ground [m/s]
    ins_real sigma_p[3]; ///< north, east, down [m]
    ins_real sigma_v[3]; ///< [m/s]
} ins_gnss_fix_t;

/// t_ns plus the multiple of period_ns that brings it nearest to near_ns. \param[in] period_ns  > 0.
INS_API int64_t ins_gnss_time_near(int64_t t_ns, int64_t period_ns, int64_t near_ns);
/// Position from integers as receivers send them, exact to 1e-9 deg in float too: the anchor is a coarse part, the offset the rest.
/// \param[in] lat_e7  latitude [1e-7 deg]. \param[in] lon_e7  longitude. \param[in] height_mm  above the ellipsoid.
INS_API void ins_gnss_position(int32_t lat_e7, int32_t lon_e7, int32_t height_mm, ins_position_t* position);

#ifdef __cplusplus
}
#endif
#endif // INS_GNSS_H_INCLUDED
