/// \file   triad_fit.cpp
/// \brief  Least squares of a triad's parameters, and where it starts.
/// SPDX-License-Identifier: MIT
#include "triad_fit.hpp"
#include "observe.hpp"
#include <ceres/ceres.h>

namespace ins_calib
{
namespace
{
constexpr int N = INS_CALIB_TRIAD_N;
constexpr int ITERATIONS_MAX = 200;
constexpr double CONDITION_MAX = 1e3; ///< poses above it leave a combination at the mercy of the noise

struct Residual
{
    const std::function<Eigen::VectorXd(const Nine&)>* of;
    bool operator()(double const* const* x, double* residual) const
    {
        const Eigen::VectorXd e = (*of)(Nine(x[0]));
        std::copy(e.data(), e.data() + e.size(), residual);
        return true;
    }
};
} // namespace

Fit solve(Eigen::Index residuals, const std::function<Eigen::VectorXd(const Nine&)>& residual)
{
    Fit fit;
    auto* const cost = new ceres::DynamicNumericDiffCostFunction<Residual, ceres::CENTRAL>(new Residual{&residual});
    cost->AddParameterBlock(N);
    cost->SetNumResiduals(static_cast<int>(residuals));
    ceres::Problem problem;
    problem.AddResidualBlock(cost, nullptr, fit.x.data());
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.logging_type = ceres::SILENT;
    options.function_tolerance = 1e-13;
    options.parameter_tolerance = 1e-12;
    options.max_num_iterations = ITERATIONS_MAX;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    fit.residual = residual(fit.x);
    fit.jacobian.resize(residuals, N);
    double* const x = fit.x.data();
    double* const jacobian = fit.jacobian.data();
    Eigen::VectorXd again(residuals);
    cost->Evaluate(&x, again.data(), const_cast<double**>(&jacobian));
    fit.usable = summary.IsSolutionUsable() && fit.x.allFinite();
    return fit;
}

std::string report(const Fit& fit, const Frame& frame, double freedom, const std::vector<std::string>& names,
                   ins_calib_axes_t* out)
{
    Observed seen = observe(fit.jacobian);
    out->condition = seen.condition;
    if (!(seen.condition < CONDITION_MAX))
    {
        const Eigen::MatrixXd scaled = fit.jacobian * seen.scale.cwiseInverse().asDiagonal();
        seen.unseen = Eigen::JacobiSVD<Eigen::MatrixXd>(scaled, Eigen::ComputeFullV).matrixV().rightCols(1);
        return unseen_names(seen, names);
    }
    const Eigen::MatrixXd normal = fit.jacobian.transpose() * fit.jacobian;
    const Eigen::MatrixXd inverse = normal.ldlt().solve(Eigen::MatrixXd::Identity(N, N));
    const double s2 = fit.residual.squaredNorm() / freedom;
    Eigen::Map<Nine>{out->p} = frame.of(fit.x);
    Eigen::Map<Eigen::Matrix<double, N, N>>{out->covariance} =
        s2 * (frame.unit.asDiagonal() * inverse * frame.unit.asDiagonal());
    return {};
}

bool ellipsoid(const Readings& readings, double g, Frame* frame)
{
    const Eigen::RowVector3d middle = readings.colwise().mean();
    const double size = (readings.rowwise() - middle).rowwise().norm().maxCoeff();
    const Eigen::MatrixXd s = (readings.rowwise() - middle) / size;
    Eigen::MatrixXd A(s.rows(), 6);
    A << s.cwiseAbs2(), s;
    const Eigen::VectorXd q = A.colPivHouseholderQr().solve(Eigen::VectorXd::Ones(s.rows()));
    const Vec square = q.head<3>();
    const Vec centre = -q.tail<3>().cwiseQuotient(2 * square);
    const double r2 = 1 + square.dot(centre.cwiseAbs2());
    if (!(square.minCoeff() / r2 > 0))
    {
        return false;
    }
    const Vec scale = g * (square / r2).cwiseSqrt() / size;
    frame->guess << 0, 0, 0, scale, centre * size + middle.transpose();
    frame->unit << 1, 1, 1, scale, Vec(g / scale(0), g / scale(1), g / scale(2));
    return true;
}

double rms(const Eigen::VectorXd& e)
{
    return std::sqrt(e.squaredNorm() / static_cast<double>(e.size()));
}

double rms_scaled(const Readings& readings, const Eigen::RowVector3d& bias, double g)
{
    const Eigen::VectorXd length = (readings.rowwise() - bias).rowwise().norm();
    const double s = g * length.sum() / length.squaredNorm();
    return rms((s * length).array() - g);
}

double rms_raw(const Readings& readings, double g)
{
    // |r|^2 - 2 b (x + y + z) + c = 0 is linear in b and c.
    Eigen::MatrixXd A(readings.rows(), 2);
    A << 2 * readings.rowwise().sum(), -Eigen::VectorXd::Ones(readings.rows());
    const Eigen::Vector2d bc = A.colPivHouseholderQr().solve(readings.rowwise().squaredNorm());
    return rms_scaled(readings, Eigen::RowVector3d::Constant(bc(0)), g);
}

} // namespace ins_calib
