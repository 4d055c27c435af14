/// \file   ros_convert.c
/// \brief  ins_navigation_t (NED, FRD) to the messages of ROS 2 (ENU, FLU). Source: REP 103, REP 105, REP 145.
/// SPDX-License-Identifier: MIT
#include "ins/quat.h"
#include "ins/vec.h"
#include "ros_internal.h"
#include <math.h>
#include <string.h>

#define EARTH_RATE 7.292115e-5 ///< [rad/s]

static const double ned_to_enu[9] = {0, 1, 0, 1, 0, 0, 0, 0, -1};
static const double frd_to_flu[9] = {1, 0, 0, 0, -1, 0, 0, 0, -1}; // its own inverse

/// out = A B, 3 x 3, row-major; out is neither.
static void product(const double A[9], const double B[9], double out[9])
{
    for (int i = 0; i < 3; i++)
    {
        for (int j = 0; j < 3; j++)
        {
            out[3 * i + j] = A[3 * i] * B[j] + A[3 * i + 1] * B[3 + j] + A[3 * i + 2] * B[6 + j];
        }
    }
}

static void transposed(const double A[9], double out[9])
{
    for (int i = 0; i < 3; i++)
    {
        for (int j = 0; j < 3; j++)
        {
            out[3 * i + j] = A[3 * j + i];
        }
    }
}

static void apply(const double A[9], const double x[3], double out[3])
{
    for (int i = 0; i < 3; i++)
    {
        out[i] = A[3 * i] * x[0] + A[3 * i + 1] * x[1] + A[3 * i + 2] * x[2];
    }
}

/// out = J P J' for J of `rows` rows on the states of P. \param[out] out  [rows rows].
static void propagate(int rows, const double* J, const double* P, double* out)
{
    const int n = INS_NAVIGATION_P;
    for (int i = 0; i < rows; i++)
    {
        double row[INS_NAVIGATION_P];
        for (int k = 0; k < n; k++)
        {
            row[k] = 0;
            for (int m = 0; m < n; m++)
            {
                row[k] += J[n * i + m] * P[n * m + k];
            }
        }
        for (int j = 0; j < rows; j++)
        {
            double sum = 0;
            for (int k = 0; k < n; k++)
            {
                sum += row[k] * J[n * j + k];
            }
            out[rows * i + j] = sum;
        }
    }
}

/// Rows row..row+2 of J, columns from `state` on: k A.
static void put(double* J, int row, int state, double k, const double A[9])
{
    for (int i = 0; i < 3; i++)
    {
        for (int j = 0; j < 3; j++)
        {
            J[INS_NAVIGATION_P * (row + i) + state + j] = k * A[3 * i + j];
        }
    }
}

/// \param[in] C_on  NED of the place -> odom. \param[in] C_fn  NED -> FLU.
static void covariances(const ins_navigation_t* from, const double C_on[9], const double C_fn[9], ros_instant_t* out)
{
    enum
    {
        PHI = 0,
        VELOCITY = 3,
        POSITION = 6
    };
    const double* v = from->v_n;
    const double cross[9] = {0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0};
    double lever[9];
    double J[6 * INS_NAVIGATION_P] = {0};
    put(J, 0, POSITION, 1, C_on);
    put(J, 3, PHI, 1, C_on);
    propagate(6, J, from->P, out->pose_P);
    memset(J, 0, sizeof J);
    product(C_fn, cross, lever);
    put(J, 0, VELOCITY, 1, C_fn);
    put(J, 0, PHI, 1, lever); // C_bn true v true - C_bn v = C_bn (dv + v x phi)
    propagate(6, J, from->P, out->twist_P);
    memset(J, 0, sizeof J);
    put(J, 0, POSITION, 1, ned_to_enu);
    propagate(3, J, from->P, out->place_P);
    memset(J, 0, sizeof J);
    put(J, 0, PHI, 1, ned_to_enu);
    propagate(3, J, from->P, out->rotation_P);
}

static int all_finite(const double* values, int count)
{
    for (int i = 0; i < count; i++)
    {
        if (!isfinite(values[i]))
        {
            return 0;
        }
    }
    return 1;
}

static int holds_what_it_says(const ins_navigation_t* n)
{
    const double norm2 =
        n->q_nb[0] * n->q_nb[0] + n->q_nb[1] * n->q_nb[1] + n->q_nb[2] * n->q_nb[2] + n->q_nb[3] * n->q_nb[3];
    return (!(n->valid & INS_NAVIGATION_ATTITUDE) || fabs(norm2 - 1) < 1e-3) && all_finite(n->w_ib_b, 3) &&
           all_finite(n->f_b, 3) && all_finite(n->v_n, 3) && all_finite(n->llh, 3) &&
           fabs(n->llh[0]) <= 1.5707963267948968 && fabs(n->llh[1]) <= 6.2831853071795865 &&
           all_finite(n->P, INS_NAVIGATION_P * INS_NAVIGATION_P);
}

/// Place in odom, and the rotation from NED of the place into odom's ENU.
static int place(ros_frame_t* frame, const ins_navigation_t* from, double C_on[9], double p_odom[3])
{
    ins_local_t here;
    double xyz_e[3];
    double ned[3];
    if (ins_local_init(&here, &ins_wgs84, from->llh) != INS_OK ||
        ins_geodesy_to_ecef(&ins_wgs84, from->llh, xyz_e) != INS_OK)
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "a position to publish is no place on Earth");
    }
    if (!frame->has_origin)
    {
        frame->origin = here;
        frame->has_origin = 1;
    }
    ins_local_from_ecef(&frame->origin, xyz_e, ned);
    apply(ned_to_enu, ned, p_odom);
    double C_en[9];
    double C_nn[9];
    transposed(here.C_ne, C_en);
    product(frame->origin.C_ne, C_en, C_nn);
    product(ned_to_enu, C_nn, C_on);
    return INS_DDS_OK;
}

int ros_instant(ros_frame_t* frame, const ins_navigation_t* from, ros_instant_t* out)
{
    memset(out, 0, sizeof *out);
    if (!holds_what_it_says(from))
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "a navigation to publish holds what is no number, no rotation or no place");
    }
    double C_on[9];
    memcpy(C_on, ned_to_enu, sizeof C_on);
    if ((from->valid & INS_NAVIGATION_POSITION) != 0)
    {
        const int status = place(frame, from, C_on, out->p_odom);
        if (status != INS_DDS_OK)
        {
            return status;
        }
    }
    out->q_enu[0] = out->q_odom[0] = 1;
    double w[3] = {from->w_ib_b[0], from->w_ib_b[1], from->w_ib_b[2]};
    if ((from->valid & INS_NAVIGATION_ATTITUDE) != 0)
    {
        double C_nb[9];
        double C_nf[9];
        double C_fn[9];
        double C[9];
        ins_quat_to_dcm(from->q_nb, C_nb);
        product(C_nb, frd_to_flu, C_nf);
        product(ned_to_enu, C_nf, C);
        (void)ins_quat_from_dcm(C, out->q_enu);
        product(C_on, C_nf, C);
        (void)ins_quat_from_dcm(C, out->q_odom);
        transposed(C_nf, C_fn);
        apply(C_fn, from->v_n, out->v_base);
        if ((from->valid & INS_NAVIGATION_POSITION) != 0)
        {
            const double earth_n[3] = {EARTH_RATE * cos(from->llh[0]), 0, -EARTH_RATE * sin(from->llh[0])};
            double q_bn[4];
            double earth_b[3];
            ins_quat_conj(from->q_nb, q_bn);
            ins_quat_rotate(q_bn, earth_n, earth_b);
            ins_vec_add_scaled(w, -1, earth_b);
        }
        if ((from->valid & INS_NAVIGATION_COVARIANCE) != 0)
        {
            covariances(from, C_on, C_fn, out);
            for (int i = 3; i < 6; i++)
            {
                out->twist_P[7 * i] = frame->rate_variance;
            }
        }
    }
    apply(frd_to_flu, w, out->w_base);
    return INS_DDS_OK;
}

builtin_interfaces_msg_dds__Time_ ros_time(int64_t time_ns)
{
    const int64_t second = 1000000000;
    const int64_t rest = ((time_ns % second) + second) % second;
    return (builtin_interfaces_msg_dds__Time_){(int32_t)((time_ns - rest) / second), (uint32_t)rest};
}

static std_msgs_msg_dds__Header_ header(const ins_navigation_t* from, const char* frame)
{
    return (std_msgs_msg_dds__Header_){ros_time(from->time_ns), (char*)(uintptr_t)frame};
}

static geometry_msgs_msg_dds__Vector3_ vector(const double x[3])
{
    return (geometry_msgs_msg_dds__Vector3_){x[0], x[1], x[2]};
}

static geometry_msgs_msg_dds__Quaternion_ quaternion(const double q[4])
{
    return (geometry_msgs_msg_dds__Quaternion_){q[1], q[2], q[3], q[0]};
}

/// REP 145: -1 in the first element says that there is no such quantity.
static void sensor_covariance(int there, double variance, double out[9])
{
    memset(out, 0, 9 * sizeof *out);
    out[0] = there ? variance : -1;
    out[4] = out[8] = there ? variance : 0;
}

void ros_imu(const ros_frame_t* frame, const ins_navigation_t* from, const ros_instant_t* at,
             sensor_msgs_msg_dds__Imu_* out)
{
    const int attitude = (from->valid & INS_NAVIGATION_ATTITUDE) != 0;
    double x[3];
    out->header = header(from, frame->imu);
    out->orientation = quaternion(at->q_enu);
    sensor_covariance(attitude, 0, out->orientation_covariance);
    if (attitude)
    {
        memcpy(out->orientation_covariance, at->rotation_P, sizeof out->orientation_covariance);
    }
    apply(frd_to_flu, from->w_ib_b, x);
    out->angular_velocity = vector(x);
    sensor_covariance((from->valid & INS_NAVIGATION_RATE) != 0, frame->rate_variance, out->angular_velocity_covariance);
    apply(frd_to_flu, from->f_b, x);
    out->linear_acceleration = vector(x);
    sensor_covariance((from->valid & INS_NAVIGATION_FORCE) != 0, frame->force_variance,
                      out->linear_acceleration_covariance);
}

void ros_fix(const ros_frame_t* frame, const ins_navigation_t* from, const ros_instant_t* at,
             sensor_msgs_msg_dds__NavSatFix_* out)
{
    enum
    {
        STATUS_FIX = 0,
        SERVICE_GPS = 1,
        COVARIANCE_UNKNOWN = 0,
        COVARIANCE_KNOWN = 3
    };
    const double degrees = 57.295779513082321;
    out->header = header(from, frame->imu);
    out->status.status = STATUS_FIX;
    out->status.service = SERVICE_GPS;
    out->latitude = from->llh[0] * degrees;
    out->longitude = from->llh[1] * degrees;
    out->altitude = (from->valid & INS_NAVIGATION_HEIGHT) != 0 ? from->llh[2] : (double)NAN;
    memcpy(out->position_covariance, at->place_P, sizeof out->position_covariance);
    out->position_covariance_type =
        (from->valid & INS_NAVIGATION_COVARIANCE) != 0 ? COVARIANCE_KNOWN : COVARIANCE_UNKNOWN;
}

static geometry_msgs_msg_dds__TwistWithCovariance_ twist(const ros_instant_t* at)
{
    geometry_msgs_msg_dds__TwistWithCovariance_ out;
    out.twist.linear = vector(at->v_base);
    out.twist.angular = vector(at->w_base);
    memcpy(out.covariance, at->twist_P, sizeof out.covariance);
    return out;
}

void ros_odometry(const ros_frame_t* frame, const ins_navigation_t* from, const ros_instant_t* at,
                  nav_msgs_msg_dds__Odometry_* out)
{
    out->header = header(from, frame->odom);
    out->child_frame_id = (char*)(uintptr_t)frame->base;
    out->pose.pose.position = (geometry_msgs_msg_dds__Point_){at->p_odom[0], at->p_odom[1], at->p_odom[2]};
    out->pose.pose.orientation = quaternion(at->q_odom);
    memcpy(out->pose.covariance, at->pose_P, sizeof out->pose.covariance);
    out->twist = twist(at);
}

void ros_twist(const ros_frame_t* frame, const ins_navigation_t* from, const ros_instant_t* at,
               geometry_msgs_msg_dds__TwistWithCovarianceStamped_* out)
{
    out->header = header(from, frame->base);
    out->twist = twist(at);
}

void ros_transform(const ros_frame_t* frame, const ins_navigation_t* from, const ros_instant_t* at,
                   geometry_msgs_msg_dds__TransformStamped_* out)
{
    out->header = header(from, frame->odom);
    out->child_frame_id = (char*)(uintptr_t)frame->base;
    out->transform.translation = vector(at->p_odom);
    out->transform.rotation = quaternion(at->q_odom);
}
