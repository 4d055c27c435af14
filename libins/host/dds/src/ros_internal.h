/// \file   ros_internal.h
/// \brief  Shared by ros.c (entities) and ros_convert.c (messages).
/// SPDX-License-Identifier: MIT
#ifndef INS_DDS_ROS_INTERNAL_H_INCLUDED
#define INS_DDS_ROS_INTERNAL_H_INCLUDED
#include "dds_internal.h"
#include "ins/geodesy.h"
#include "ins_dds/ros.h"
#include "ros2.h"

#define ROS_GID 16 ///< octets of an entity's id

/// What the messages of all instants share.
typedef struct ros_frame_t
{
    char odom[INS_ROS_NAME_MAX + 1];
    char base[INS_ROS_NAME_MAX + 1];
    char imu[INS_ROS_NAME_MAX + 1];
    double rate_variance;  ///< [(rad/s)^2]
    double force_variance; ///< [(m/s^2)^2]
    int has_origin;
    ins_local_t origin; ///< of odom
} ros_frame_t;

/// One instant in the frames of ROS.
typedef struct ros_instant_t
{
    double q_enu[4];      ///< FLU -> ENU of the place, scalar first
    double q_odom[4];     ///< FLU -> odom
    double p_odom[3];     ///< [m]
    double v_base[3];     ///< [m/s]
    double w_base[3];     ///< against the Earth as far as the place is known [rad/s]
    double pose_P[36];    ///< x, y, z [m], rotation about the axes of odom [rad]
    double twist_P[36];   ///< in base
    double place_P[9];    ///< ENU of the place [m^2]
    double rotation_P[9]; ///< about ENU of the place [rad^2]
} ros_instant_t;

/// \return INS_DDS_OK; INS_DDS_E_ARGUMENT: a field that `valid` promises is not finite.
int ros_instant(ros_frame_t* frame, const ins_navigation_t* navigation, ros_instant_t* out);

// The messages point into frame; they own nothing.
void ros_imu(const ros_frame_t* frame, const ins_navigation_t* from, const ros_instant_t* at,
             sensor_msgs_msg_dds__Imu_* out);
void ros_fix(const ros_frame_t* frame, const ins_navigation_t* from, const ros_instant_t* at,
             sensor_msgs_msg_dds__NavSatFix_* out);
void ros_odometry(const ros_frame_t* frame, const ins_navigation_t* from, const ros_instant_t* at,
                  nav_msgs_msg_dds__Odometry_* out);
void ros_twist(const ros_frame_t* frame, const ins_navigation_t* from, const ros_instant_t* at,
               geometry_msgs_msg_dds__TwistWithCovarianceStamped_* out);
void ros_transform(const ros_frame_t* frame, const ins_navigation_t* from, const ros_instant_t* at,
                   geometry_msgs_msg_dds__TransformStamped_* out);
builtin_interfaces_msg_dds__Time_ ros_time(int64_t time_ns);

#endif // INS_DDS_ROS_INTERNAL_H_INCLUDED
