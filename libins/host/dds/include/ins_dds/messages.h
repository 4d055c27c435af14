/// \file   ins_dds/messages.h
/// \brief  What libins_dds carries beside states and solutions: status, innovations, raw IMU samples. SI, rad. NaN: not known.
/// SPDX-License-Identifier: MIT
#ifndef INS_DDS_MESSAGES_H_INCLUDED
#define INS_DDS_MESSAGES_H_INCLUDED
#include "ins_nav/nav.h"
#include "ins_nav/nav_input.h"
#include "ins_nav/navigation.h"
#ifdef __cplusplus
extern "C" {
#endif

/// What the solution rests on.
#define INS_DDS_MODE_LIST(X)                                                                                           \
    X(INS_DDS_MODE_NONE, 0, "none")                     /* no sample yet */                                            \
    X(INS_DDS_MODE_ALIGN, 1, "align")                   /* attitude or place is being found */                         \
    X(INS_DDS_MODE_ATTITUDE, 2, "attitude")             /* attitude alone, integrated */                               \
    X(INS_DDS_MODE_DEAD_RECKONING, 3, "dead_reckoning") /* the last fix is too old */                                  \
    X(INS_DDS_MODE_AIDED, 4, "aided")                   /* by fixes */

/// What a user should know of.
#define INS_DDS_ALERT_LIST(X)                                                                                          \
    X(INS_DDS_ALERT_SILENT, 0x01, "silent")     /* nothing came from the sensors for a second */                       \
    X(INS_DDS_ALERT_LOST, 0x02, "lost")         /* samples went missing on the link since the last status */           \
    X(INS_DDS_ALERT_DISAGREE, 0x04, "disagree") /* the board's clock and its numbers tell different times */           \
    X(INS_DDS_ALERT_CLIPPED, 0x08, "clipped")   /* a sensor reads its end of scale */                                  \
    X(INS_DDS_ALERT_REFUSED, 0x10, "refused")   /* the last fix was outside the gate */                                \
    X(INS_DDS_ALERT_DROPPED, 0x20, "dropped")   /* messages found the outbox full since the last status */

/// What was measured.
#define INS_DDS_MEASURED_LIST(X)                                                                                       \
    X(INS_DDS_POSITION, 0, "position") /* of the antenna, north, east, down [m] */                                     \
    X(INS_DDS_VELOCITY, 1, "velocity") /* of the antenna, north, east, down [m/s] */                                   \
    X(INS_DDS_ZUPT, 2, "zupt")         /* rest: no velocity, north, east, down [m/s] */                                \
    X(INS_DDS_ZARU, 3, "zaru")         /* rest: no rotation, forward, right, down [rad/s] */                           \
    X(INS_DDS_NHC, 4, "nhc")           /* no slip: right, down [m/s] */                                                \
    X(INS_DDS_ODOMETER, 5, "odometer") /* forward speed [m/s] */                                                       \
    X(INS_DDS_YAW_RATE, 6, "yaw_rate") /* of another gyro [rad/s] */                                                   \
    X(INS_DDS_ALTITUDE, 7, "altitude") /* [m] */

/// What became of it.
#define INS_DDS_VERDICT_LIST(X)                                                                                        \
    X(INS_DDS_USED, 0, "used")                                                                                         \
    X(INS_DDS_REFUSED_GATE, 1, "gate")   /* improbable */                                                              \
    X(INS_DDS_REFUSED_RANGE, 2, "range") /* not a number, or without a standard deviation */                           \
    X(INS_DDS_WITHHELD, 3, "withheld")   /* compared only: a simulated outage */

#define INS_DDS_ENUM(name, value, text) name = (value),
enum
{
    INS_DDS_MODE_LIST(INS_DDS_ENUM)
};
enum
{
    INS_DDS_ALERT_LIST(INS_DDS_ENUM)
};
enum
{
    INS_DDS_MEASURED_LIST(INS_DDS_ENUM)
};
enum
{
    INS_DDS_VERDICT_LIST(INS_DDS_ENUM)
};
#undef INS_DDS_ENUM

typedef struct ins_dds_status_t
{
    int64_t time_ns;
    uint32_t time_base;        ///< INS_NAVIGATION_HOST ...
    uint32_t mode;             ///< INS_DDS_MODE_NONE ...
    uint32_t alerts;           ///< INS_DDS_ALERT_SILENT ...
    double sigma_horizontal_m; ///< along the worst horizontal direction
    double sigma_vertical_m;
    double sigma_heading_rad;
    double fix_age_s;                                                      ///< since the last fix that was used
    uint32_t sats;                                                         ///< of the last fix
    uint64_t fixes;                                                        ///< used
    uint64_t position_refused, velocity_refused, aid_refused, imu_refused; ///< as ins_gps_ins_count_t has them
    uint64_t published;                                                    ///< states handed to DDS
    uint64_t dropped;                                                      ///< messages that found the outbox full
    ins_nav_counts_t counts;
} ins_dds_status_t;

typedef struct ins_dds_innovations_t
{
    int64_t time_ns;
    uint32_t time_base;   ///< INS_NAVIGATION_HOST ...
    uint32_t kind;        ///< INS_DDS_POSITION ...
    uint32_t verdict;     ///< INS_DDS_USED ...
    uint32_t size;        ///< components, 1 to 3
    double innovation[3]; ///< measured less expected
    double sigma[3];      ///< expected, standard deviation
    double nis;           ///< of all components
} ins_dds_innovations_t;

typedef struct ins_dds_raw_imu_t
{
    int64_t time_ns;
    uint32_t time_base;  ///< INS_NAVIGATION_HOST ...
    uint32_t increments; ///< 0: rates and forces; 1: their integrals over dt_s
    uint64_t index;      ///< sample number; lost ones count
    double t_s;          ///< by the source's own clock
    double dt_s;
    double gyro_b[3];  ///< [rad/s], or [rad]
    double accel_b[3]; ///< [m/s^2], or [m/s]
    double temperature_k;
} ins_dds_raw_imu_t;

/// A status of which only mode, clock and deviations follow from an instant; the rest is zero, fix_age_s NaN.
/// \param[out] out  mode is INS_DDS_MODE_AIDED for a place, INS_DDS_MODE_ATTITUDE for attitude alone, else INS_DDS_MODE_ALIGN.
INS_API void ins_dds_status_from_navigation(const ins_navigation_t* navigation, ins_dds_status_t* out);

#ifdef __cplusplus
}
#endif
#endif // INS_DDS_MESSAGES_H_INCLUDED
