/// \file   full_design.cpp
/// \brief  Observability of the full model at the nominal geometry, by the derivatives of ins/accelfit.h. Frame: b.
/// SPDX-License-Identifier: MIT
#include "full_design.hpp"
#include "observe.hpp"
#include "why.hpp"
#include <algorithm>
#include <cmath>

namespace ins_calib
{
namespace
{
using Vec = Eigen::Vector3d;
using Row = Eigen::Matrix<double, INS_CALIB_FULL_N, 1>;

const char* const NAMES[INS_CALIB_FULL_N] = {"b", "SF", "m1", "m2", "k2", "r_x", "r_y", "r_z"};
constexpr double SPIN_RAD_S = 10; ///< of proposed spins where the poses have none

/// Derivatives of one reading by the eight parameters, SF 1 and nothing misaligned.
Row derivatives(const ins_calib_sensor_t& sensor, const ins_accelfit_motion_t& motion)
{
    const double p[INS_CALIB_FULL_N] = {0, 1, 0, 0, 0, sensor.r0[0], sensor.r0[1], sensor.r0[2]};
    ins_accelfit_t nominal;
    Row row;
    ins_accelfit_init(&nominal, sensor.u0, sensor.e1, sensor.e2, p);
    ins_accelfit_predict(&nominal, &motion, row.data());
    return row;
}

Eigen::VectorXd chosen(const Row& row, const std::vector<int>& columns)
{
    Eigen::VectorXd part(static_cast<Eigen::Index>(columns.size()));
    for (size_t i = 0; i < columns.size(); i++)
    {
        part(static_cast<Eigen::Index>(i)) = row(columns[i]);
    }
    return part;
}

std::string direction(const Vec& v)
{
    return "(" + number(v(0)) + ", " + number(v(1)) + ", " + number(v(2)) + ")";
}

/// Faces and edges of a cube up, and spins about its axes and face diagonals.
std::vector<Candidate> candidates(const ins_calib_full_t& in, const std::vector<int>& columns)
{
    double rate = 0;
    for (size_t k = 0; k < in.poses; k++)
    {
        rate = std::max(rate, Eigen::Map<const Vec>(in.pose[k].w).norm());
    }
    rate = rate > 0 ? rate : SPIN_RAD_S;
    std::vector<Candidate> all;
    const auto add = [&](const std::string& name, const Vec& up, double w)
    {
        ins_calib_pose_t pose{};
        Eigen::Map<Vec>{pose.up} = up.normalized();
        Eigen::Map<Vec>{pose.w} = w * up.normalized();
        Candidate candidate{name, {}};
        for (size_t j = 0; j < in.sensors; j++)
        {
            candidate.rows.push_back(chosen(derivatives(in.sensor[j], motion_of(pose, in.g)), columns));
        }
        all.push_back(candidate);
    };
    std::vector<Vec> directions;
    for (int a = 0; a < 3; a++)
    {
        directions.emplace_back(Vec::Unit(a));
    }
    for (int a = 0; a < 3; a++)
    {
        directions.emplace_back(Vec::Unit(a) + Vec::Unit((a + 1) % 3));
        directions.emplace_back(Vec::Unit(a) - Vec::Unit((a + 1) % 3));
    }
    for (const Vec& up : directions)
    {
        add("at rest " + direction(up) + " up", up, 0);
        add("at rest " + direction(-up) + " up", -up, 0);
        add("spin about " + direction(up), up, rate);
    }
    return all;
}
} // namespace

std::vector<int> estimated(unsigned fixed)
{
    std::vector<int> columns;
    for (int i = 0; i < INS_CALIB_FULL_N; i++)
    {
        if ((fixed >> i & 1U) == 0)
        {
            columns.push_back(i);
        }
    }
    return columns;
}

ins_accelfit_motion_t motion_of(const ins_calib_pose_t& pose, double g)
{
    ins_accelfit_motion_t motion;
    for (int i = 0; i < 3; i++)
    {
        motion.f_b[i] = g * pose.up[i];
        motion.w_ib_b[i] = pose.w[i];
        motion.wd_ib_b[i] = pose.wd[i];
    }
    return motion;
}

std::string unfixed(const ins_calib_full_t& in, double* condition)
{
    const std::vector<int> columns = estimated(in.fixed);
    std::vector<std::string> names;
    for (const int i : columns)
    {
        names.emplace_back(NAMES[i]);
    }
    std::vector<Observed> sensors;
    std::vector<std::string> lacking;
    for (size_t j = 0; j < in.sensors; j++)
    {
        Eigen::MatrixXd rows(static_cast<Eigen::Index>(in.poses), static_cast<Eigen::Index>(columns.size()));
        for (size_t k = 0; k < in.poses; k++)
        {
            const Row row = derivatives(in.sensor[j], motion_of(in.pose[k], in.g));
            rows.row(static_cast<Eigen::Index>(k)) = chosen(row, columns);
        }
        sensors.push_back(observe(rows));
        condition[j] = sensors[j].condition;
        if (sensors[j].unseen.cols() > 0)
        {
            lacking.push_back("accelerometer " + std::to_string(j + 1) + " has rank " +
                              std::to_string(sensors[j].rank) + " of " + std::to_string(columns.size()) +
                              ", not fixed: " + unseen_names(sensors[j], names));
        }
    }
    if (lacking.empty())
    {
        return {};
    }
    const std::vector<std::string> add = remedies(sensors, candidates(in, columns));
    std::string text = lacking[0];
    for (size_t i = 1; i < lacking.size(); i++)
    {
        text += "; " + lacking[i];
    }
    return text + (add.empty() ? ". No pose of a cube fixes that" : ". Add: " + listed(add)) +
           ", or do not estimate it";
}

unsigned from_prior(const ins_calib_full_t& in)
{
    const std::vector<int> columns = estimated(in.fixed);
    const auto n = static_cast<Eigen::Index>(columns.size());
    const auto sensors = static_cast<Eigen::Index>(in.sensors);
    const auto all = static_cast<Eigen::Index>(in.poses) * sensors;
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(all, n * sensors);
    Eigen::MatrixXd projected = J;
    for (size_t k = 0; k < in.poses; k++)
    {
        // The pose's own readings by its attitude: a turn d of f and of the rates acts as a turn -d of axis and place.
        const ins_accelfit_motion_t motion = motion_of(in.pose[k], in.g);
        const auto first = static_cast<Eigen::Index>(k) * sensors;
        Eigen::MatrixXd by_attitude(sensors, 3);
        for (Eigen::Index j = 0; j < sensors; j++)
        {
            const ins_calib_sensor_t& sensor = in.sensor[j];
            const Row row = derivatives(sensor, motion);
            J.block(first + j, n * j, 1, n) = chosen(row, columns).transpose();
            const Vec w(in.pose[k].w);
            const Vec wd(in.pose[k].wd);
            const Vec r(sensor.r0);
            const Vec a = in.g * Vec(in.pose[k].up) + wd.cross(r) + w.cross(w.cross(r));
            by_attitude.row(j) = a.cross(Vec(sensor.u0).normalized()) + Vec(row.tail<3>()).cross(r);
        }
        const Eigen::JacobiSVD<Eigen::MatrixXd> svd(by_attitude, Eigen::ComputeThinU);
        const Eigen::MatrixXd seen = svd.matrixU().leftCols(svd.rank());
        const auto rows = J.middleRows(first, sensors);
        projected.middleRows(first, sensors) = rows - seen * (seen.transpose() * rows);
    }
    const Eigen::VectorXd length = J.colwise().norm();
    const Eigen::VectorXd values =
        Eigen::JacobiSVD<Eigen::MatrixXd>(projected * length.cwiseInverse().asDiagonal()).singularValues();
    return static_cast<unsigned>((values.array() < RANK_TOLERANCE * values(0)).count());
}
} // namespace ins_calib
