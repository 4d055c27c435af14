/// \file   full.cpp
/// \brief  Maximum posterior of the accelerometers' parameters and the poses' attitudes. Frame: b. SI.
/// SPDX-License-Identifier: MIT
#include "ins_calib/full.h"
#include "full_design.hpp"
#include "why.hpp"
#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <ceres/ceres.h>
#include <ceres/rotation.h>

using namespace ins_calib;

namespace
{
constexpr int N = INS_CALIB_FULL_N;
constexpr int ITERATIONS_MAX = 100;
constexpr double CONVERGED = 1e-12;         ///< relative change of the parameters
constexpr double ROUNDING = 1e-13;          ///< relative change of the cost, which says nothing any more
constexpr double NEARLY_GAUSS_NEWTON = 1e8; ///< the linear guess is close

/// (reading - model) / sigma; of ins/accelfit.h's model, with the pose turned.
struct Reading
{
    const ins_calib_sensor_t* sensor;
    const ins_calib_pose_t* pose;
    double g, reading, sigma;

    template <typename T> T model(const T* p, const T* turn) const
    {
        using Vec = Eigen::Matrix<T, 3, 1>;
        const auto turned = [turn](const double v[3])
        {
            const T constant[3] = {T(v[0]), T(v[1]), T(v[2])};
            Vec out;
            ceres::AngleAxisRotatePoint(turn, constant, out.data());
            return out;
        };
        const Eigen::Vector3d u0(sensor->u0);
        const Eigen::Vector3d e1(sensor->e1);
        const Eigen::Vector3d e2(sensor->e2);
        const Vec u = (u0.cast<T>() + p[2] * e1.cast<T>() + p[3] * e2.cast<T>()).normalized();
        const Vec r(p[5], p[6], p[7]);
        const Vec w = turned(pose->w);
        const T x = u.dot(g * turned(pose->up) + turned(pose->wd).cross(r) + w.cross(w.cross(r)));
        return p[1] * (p[0] + x + p[4] * x * x);
    }
    template <typename T> bool operator()(const T* p, const T* turn, T* residual) const
    {
        residual[0] = (reading - model(p, turn)) / sigma;
        return true;
    }
};

/// turn / deviation.
struct Prior
{
    double deviation;
    template <typename T> bool operator()(const T* turn, T* residual) const
    {
        for (int i = 0; i < 3; i++)
        {
            residual[i] = turn[i] / deviation;
        }
        return true;
    }
};

bool finite(const double* x, size_t count)
{
    return std::all_of(x, x + count, [](double value) { return std::isfinite(value); });
}

std::string refused(const ins_calib_full_t& in)
{
    if (in.sensors == 0 || in.poses == 0)
    {
        return "no readings: give at least one accelerometer and eight poses";
    }
    if (!(in.g > 0) || !std::isfinite(in.g))
    {
        return "g is " + number(in.g) + " m/s^2, must be above 0";
    }
    if (!(in.fixture_rad >= 0 && in.fixture_rad < 1) || !(in.robust_sigmas >= 0))
    {
        return "fixture_rad is " + number(in.fixture_rad) + ", must lie in 0 .. 1; robust_sigmas is " +
               number(in.robust_sigmas) + ", must be 0 or above";
    }
    if (estimated(in.fixed).empty())
    {
        return "all eight parameters are fixed: nothing to estimate";
    }
    for (size_t j = 0; j < in.sensors; j++)
    {
        const ins_calib_sensor_t& s = in.sensor[j];
        const bool good = finite(s.u0, 3) && finite(s.e1, 3) && finite(s.e2, 3) && finite(s.r0, 3) &&
                          Eigen::Vector3d(s.u0).norm() > 0 && s.sigma > 0 && std::isfinite(s.sigma);
        if (!good)
        {
            return "accelerometer " + std::to_string(j + 1) + ": its axis must not be zero, its noise above 0 (found " +
                   number(s.sigma) + "), all finite";
        }
    }
    for (size_t k = 0; k < in.poses; k++)
    {
        const ins_calib_pose_t& pose = in.pose[k];
        const double length = Eigen::Vector3d(pose.up).norm();
        if (!(std::fabs(length - 1) < 1e-6) || !finite(pose.w, 3) || !finite(pose.wd, 3))
        {
            return "pose " + std::to_string(k + 1) + ": up has length " + number(length) +
                   ", must have 1; rates must be finite";
        }
        if (!finite(in.readings + k * in.sensors, in.sensors))
        {
            return "pose " + std::to_string(k + 1) + ": a reading is not a number";
        }
    }
    return {};
}

/// Bias, scale and leaning by the linear map, places as given.
int guess(const ins_calib_full_t& in, double* p, const Why& why)
{
    std::vector<double> f(3 * in.poses);
    std::vector<double> column(in.poses);
    for (size_t j = 0; j < in.sensors; j++)
    {
        const ins_calib_sensor_t& sensor = in.sensor[j];
        const Eigen::Vector3d r(sensor.r0);
        for (size_t k = 0; k < in.poses; k++)
        {
            const Eigen::Vector3d w(in.pose[k].w);
            const Eigen::Vector3d wd(in.pose[k].wd);
            Eigen::Map<Eigen::Vector3d>{f.data() + 3 * k} =
                in.g * Eigen::Vector3d(in.pose[k].up) + wd.cross(r) + w.cross(w.cross(r));
            column[k] = in.readings[k * in.sensors + j];
        }
        ins_calib_map_t map;
        const int status = ins_calib_linear(1, in.poses, f.data(), column.data(), &map, nullptr, why.text, why.size);
        if (status != INS_CALIB_OK)
        {
            return status;
        }
        const Eigen::Vector3d axis(map.map + 1);
        const Eigen::Vector3d u0 = Eigen::Vector3d(sensor.u0);
        const double sf = axis.dot(u0) < 0 ? -axis.norm() : axis.norm();
        if (!(std::fabs(sf) > 0))
        {
            return why.say(INS_CALIB_E_INPUT,
                           "accelerometer " + std::to_string(j + 1) + ": its readings do not change");
        }
        const auto lean = [&](const double e[3]) { return Eigen::Vector3d(e).dot(axis / sf) * u0.norm(); };
        const auto kept = [&](int i, double value) { return (in.fixed >> i & 1U) != 0 ? 0 : value; };
        const double start[N] = {
            kept(0, map.map[0] / sf), sf, kept(2, lean(sensor.e1)), kept(3, lean(sensor.e2)), 0, r(0), r(1), r(2)};
        std::copy(start, start + N, p + N * j);
    }
    return INS_CALIB_OK;
}

/// Inverse of the normal matrix, of the accelerometers' part.
Eigen::MatrixXd covariance(ceres::Problem& problem, std::vector<double*> blocks, Eigen::Index size)
{
    ceres::Problem::EvaluateOptions options;
    options.parameter_blocks = std::move(blocks);
    ceres::CRSMatrix crs;
    problem.Evaluate(options, nullptr, nullptr, nullptr, &crs);
    const Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>> J(
        crs.num_rows, crs.num_cols, static_cast<Eigen::Index>(crs.values.size()), crs.rows.data(), crs.cols.data(),
        crs.values.data());
    const Eigen::MatrixXd H = Eigen::SparseMatrix<double, Eigen::RowMajor>(J.transpose() * J);
    const Eigen::VectorXd scale = H.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd first = Eigen::MatrixXd::Identity(H.rows(), size);
    const Eigen::MatrixXd inverse =
        (scale.asDiagonal() * H * scale.asDiagonal()).ldlt().solve(scale.asDiagonal() * first);
    return scale.head(size).asDiagonal() * inverse.topRows(size);
}
} // namespace

int ins_calib_full(const ins_calib_full_t* given, ins_calib_full_result_t* out, char* text, size_t size)
{
    const Why why{text, size};
    const ins_calib_full_t& in = *given;
    if (const std::string reason = refused(in); !reason.empty())
    {
        return why.say(INS_CALIB_E_INPUT, reason);
    }
    if (const std::string reason = unfixed(in, out->condition); !reason.empty())
    {
        return why.say(INS_CALIB_E_RANK, reason);
    }
    if (const int status = guess(in, out->p, why); status != INS_CALIB_OK)
    {
        return status;
    }
    const std::vector<int> columns = estimated(in.fixed);
    const bool turning = in.fixture_rad > 0;
    std::fill(out->attitude, out->attitude + 3 * in.poses, 0.0);

    ceres::Problem::Options shared;
    shared.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    const std::unique_ptr<ceres::LossFunction> loss =
        in.robust_sigmas > 0 ? std::make_unique<ceres::CauchyLoss>(in.robust_sigmas) : nullptr;
    ceres::Problem problem(shared);
    std::vector<double*> blocks;
    auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    for (size_t j = 0; j < in.sensors; j++)
    {
        double* const p = out->p + N * j;
        problem.AddParameterBlock(p, N);
        if (columns.size() < N)
        {
            std::vector<int> constant;
            for (int i = 0; i < N; i++)
            {
                if ((in.fixed >> i & 1U) != 0)
                {
                    constant.push_back(i);
                }
            }
            problem.SetManifold(p, new ceres::SubsetManifold(N, constant));
        }
        blocks.push_back(p);
        ordering->AddElementToGroup(p, 1);
    }
    for (size_t k = 0; k < in.poses; k++)
    {
        double* const turn = out->attitude + 3 * k;
        problem.AddParameterBlock(turn, 3);
        ordering->AddElementToGroup(turn, 0);
        for (size_t j = 0; j < in.sensors; j++)
        {
            auto* const reading =
                new Reading{&in.sensor[j], &in.pose[k], in.g, in.readings[k * in.sensors + j], in.sensor[j].sigma};
            problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Reading, 1, N, 3>(reading), loss.get(), blocks[j],
                                     turn);
        }
        if (turning)
        {
            problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Prior, 3, 3>(new Prior{in.fixture_rad}), nullptr,
                                     turn);
        }
        else
        {
            problem.SetParameterBlockConstant(turn);
        }
    }
    ceres::Solver::Options options;
    options.max_num_iterations = ITERATIONS_MAX;
    options.function_tolerance = ROUNDING;
    options.gradient_tolerance = 0;
    options.parameter_tolerance = CONVERGED;
    options.initial_trust_region_radius = NEARLY_GAUSS_NEWTON;
    options.logging_type = ceres::SILENT;
    options.linear_solver_type = turning ? ceres::DENSE_SCHUR : ceres::DENSE_QR;
    options.linear_solver_ordering = ordering;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    if (!summary.IsSolutionUsable() || !finite(out->p, N * in.sensors))
    {
        return why.say(INS_CALIB_E_CONVERGENCE, "no minimum found: " + summary.message);
    }
    out->iterations = static_cast<unsigned>(summary.iterations.size());
    out->chi2 = 2 * summary.final_cost;
    out->chi2_expected = static_cast<double>(in.poses * in.sensors) - static_cast<double>(columns.size() * in.sensors);
    out->from_prior = turning ? from_prior(in) : 0;

    const auto n = static_cast<Eigen::Index>(columns.size());
    const auto whole = static_cast<Eigen::Index>(N * in.sensors);
    for (size_t k = 0; turning && k < in.poses; k++)
    {
        blocks.push_back(out->attitude + 3 * k);
    }
    const Eigen::MatrixXd part = covariance(problem, blocks, n * static_cast<Eigen::Index>(in.sensors));
    Eigen::Map<Eigen::MatrixXd> full(out->covariance, whole, whole);
    full.setZero();
    const auto place = [&](Eigen::Index i) { return N * (i / n) + columns[static_cast<size_t>(i % n)]; };
    for (Eigen::Index i = 0; i < part.rows(); i++)
    {
        for (Eigen::Index j = 0; j < part.cols(); j++)
        {
            full(place(i), place(j)) = part(i, j);
        }
    }
    for (size_t i = 0; i < in.poses * in.sensors; i++)
    {
        const size_t j = i % in.sensors;
        const size_t k = i / in.sensors;
        const Reading reading{&in.sensor[j], &in.pose[k], in.g, in.readings[i], in.sensor[j].sigma};
        out->residual[i] = in.readings[i] - reading.model(out->p + N * j, out->attitude + 3 * k);
    }
    return INS_CALIB_OK;
}
