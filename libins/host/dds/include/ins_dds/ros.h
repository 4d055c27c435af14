/// \file   ins_dds/ros.h
/// \brief  Navigation as ROS 2 nodes see it, with no ROS installed: the same topics, types and names on the DDS wire.
///         Frames as REP 103 and REP 105 want them: ENU world, FLU body.
///
///     ins_ros_config_t cfg;
///     ins_ros_config_default(&cfg);                         // node /libins on ROS_DOMAIN_ID, loopback
///     if (ins_ros_open(&cfg, &ros) != INS_DDS_OK) { puts(ins_dds_error_text()); }
///     ins_ros_publish(ros, &navigation);                    // imu/data, gnss/fix, odometry, twist, /tf: what its bits allow
///     ins_ros_close(ros);
///
/// A topic is published only if the instant holds what it says: a board with gyros alone gives imu/data and the rotation of /tf.
/// Covariances are those of the instant; without INS_NAVIGATION_COVARIANCE they are zero, which ROS reads as unknown.
/// Writers are RELIABLE and carry the type's hash; the participant its enclave, and ros_discovery_info names the node and its topics,
/// so that `ros2 topic list` and `ros2 node info` show them (Iron and later; Humble's 24-octet ids: cfg.gid_octets = 0).
/// Source: REP 103, 105, 145; the .msg files of common_interfaces; docs/ros2.md says what was tried with which stack.
/// SPDX-License-Identifier: MIT
#ifndef INS_DDS_ROS_H_INCLUDED
#define INS_DDS_ROS_H_INCLUDED
#include "ins_dds/dds.h"
#include "ins_nav/navigation.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_ROS_NAME_MAX   255        ///< octets of a topic, node, namespace or frame name
#define INS_ROS_DOMAIN_ENV UINT32_MAX ///< as cfg.dds.domain: that of the environment variable ROS_DOMAIN_ID, else 0

/// Topics, in the order of cfg.topic.
typedef enum ins_ros_topic_t
{
    INS_ROS_IMU,         ///< sensor_msgs/Imu, imu/data: frame `imu`
    INS_ROS_FIX,         ///< sensor_msgs/NavSatFix, gnss/fix: frame `imu`
    INS_ROS_ODOMETRY,    ///< nav_msgs/Odometry, odometry: pose of `base` in `odom`, twist in `base`
    INS_ROS_TWIST,       ///< geometry_msgs/TwistWithCovarianceStamped, twist: frame `base`
    INS_ROS_TF,          ///< tf2_msgs/TFMessage, /tf: `odom` to `base`
    INS_ROS_DIAGNOSTICS, ///< diagnostic_msgs/DiagnosticArray, /diagnostics
    INS_ROS_TOPICS
} ins_ros_topic_t;

typedef struct ins_ros_config_t
{
    ins_dds_config_t dds;   ///< topic, publishes and subscribes are not looked at
    const char* node;       ///< letters, digits and _
    const char* name_space; ///< "/", or a path such as "/car/nav"
    const char* odom;       ///< frame: tangent to the Earth at the first position
    const char* base;       ///< frame: body, FLU
    const char* imu;        ///< frame of the sensor, FLU; rigid with `base`
    /// Names are below the namespace, or absolute with a leading '/'; NULL: not published.
    ins_dds_topic_config_t topic[INS_ROS_TOPICS];
    double rate_sigma;   ///< of an angular rate [rad/s]; 0: unknown
    double force_sigma;  ///< of a specific force [m/s^2]; 0: unknown
    uint32_t gid_octets; ///< of ros_discovery_info: 16; 0: none is published
} ins_ros_config_t;

/// One line of /diagnostics.
typedef struct ins_ros_value_t
{
    const char* key;
    const char* value;
} ins_ros_value_t;

enum
{
    INS_ROS_LEVEL_OK = 0,
    INS_ROS_LEVEL_WARN = 1,
    INS_ROS_LEVEL_ERROR = 2,
    INS_ROS_LEVEL_STALE = 3
};

typedef struct ins_ros_t ins_ros_t;

/// Node "libins" in "/", ROS_DOMAIN_ID, loopback, frames odom, base_link, imu_link, all topics, none decimated, QoS "default"
/// without a deadline.
INS_API void ins_ros_config_default(ins_ros_config_t* cfg);
/// \return INS_DDS_OK, or an error with its text in ins_dds_error_text(), and then *self is NULL and nothing is left open.
INS_API int ins_ros_open(const ins_ros_config_t* cfg, ins_ros_t** self);
/// The first position becomes the origin of `odom`. \return INS_DDS_OK; INS_DDS_E_ARGUMENT for an instant with a field that is not
/// finite, and nothing is published; INS_DDS_E_DDS.
INS_API int ins_ros_publish(ins_ros_t* self, const ins_navigation_t* navigation);
/// \param[in] level  INS_ROS_LEVEL_OK ... \param[in] values  [count], may be NULL with count 0.
INS_API int ins_ros_diagnose(ins_ros_t* self, int64_t time_ns, int level, const char* message,
                             const ins_ros_value_t* values, uint32_t count);
/// Readers matched with a topic's writer; 0 for one that is not published; negative on error.
INS_API int ins_ros_matched(ins_ros_t* self, ins_ros_topic_t topic);
/// NULL is allowed.
INS_API void ins_ros_close(ins_ros_t* self);

#ifdef __cplusplus
}
#endif
#endif // INS_DDS_ROS_H_INCLUDED
