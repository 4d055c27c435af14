/// \file   triad_gyro.cpp
/// \brief  Gyros by gravity turned from pose to pose. Frame: b, of the accelerometers.
/// SPDX-License-Identifier: MIT
#include "ins/ins.h"
#include "triad_fit.hpp"

namespace ins_calib
{
namespace
{
constexpr double SCALE_OFF_MAX = 0.3; ///< of the nominal scale: more is another unit
constexpr uint_least8_t RATES_ORDER = 4;
const std::vector<std::string> NAMES = {"gamma_yz", "gamma_zy", "gamma_xz", "gamma_zx", "gamma_xy",
                                        "gamma_yx", "s_x",      "s_y",      "s_z"};

/// T K, in units of the nominal scale.
Matrix3 ratio(const Nine& x)
{
    Matrix3 T;
    T << 1, -x[0], x[1], x[2], 1, -x[3], -x[4], x[5], 1;
    return T * Vec(1 + x[6], 1 + x[7], 1 + x[8]).asDiagonal();
}

/// One motion, and gravity in the poses before and after it.
struct Turn
{
    const Readings* rates; ///< without bias and what specific force adds [counts]
    Vec from, to;
    Eigen::Index first, last;

    /// Gravity after it, by the gyros.
    Vec arrived(const Matrix3& matrix, double period_s) const
    {
        ins_rates_t integrator;
        ins_attitude_t attitude;
        const double start[4] = {1, 0, 0, 0};
        ins_rates_init(&integrator, RATES_ORDER, period_s);
        ins_attitude_init(&attitude, INS_CONING_HIST2_OPT, start);
        for (Eigen::Index i = first; i <= last; i++)
        {
            const Vec w = matrix * rates->row(i).transpose();
            double theta[3];
            ins_rates_add(&integrator, w.data(), theta);
            ins_attitude_step(&attitude, theta);
        }
        double back[4];
        Vec here;
        ins_quat_conj(attitude.q_nb, back);
        ins_quat_rotate(back, from.data(), here.data());
        return here;
    }
};
} // namespace

int fit_gyros(const ins_calib_triad_t& in, const std::vector<Pose>& poses, ins_calib_triad_result_t* out,
              const Why& why)
{
    const auto samples = static_cast<Eigen::Index>(in.samples);
    const Samples gyro(in.gyro, samples, 3);
    const Eigen::RowVector3d bias(out->accel.bias);
    const Readings force = (Samples(in.accel, samples, 3).rowwise() - bias) * Matrix3(out->accel.matrix).transpose();
    const auto mean = [](const auto& of, const Pose& pose) -> Eigen::RowVector3d
    { return of.middleRows(pose.first, pose.last - pose.first + 1).colwise().mean(); };

    // Bias and sensitivity to specific force, by the poses; then each sample without them.
    const std::vector<Pose> used = every(poses, in.part, in.parts);
    const auto n = static_cast<Eigen::Index>(used.size());
    Eigen::MatrixXd A = Eigen::MatrixXd::Ones(n, 4);
    Eigen::MatrixXd still(n, 3);
    for (Eigen::Index k = 0; k < n; k++)
    {
        A.row(k).tail<3>() = mean(force, used[static_cast<size_t>(k)]);
        still.row(k) = mean(gyro, used[static_cast<size_t>(k)]);
    }
    const Eigen::MatrixXd x = A.colPivHouseholderQr().solve(still);
    const auto largest = [](const Eigen::MatrixXd& e)
    { return std::sqrt(e.colwise().squaredNorm().maxCoeff() / static_cast<double>(e.rows())); };
    out->bias_rms = largest(still - A * x);
    out->bias_rms_constant = largest(still.rowwise() - still.colwise().mean());
    Eigen::Map<Eigen::RowVector3d>{out->gyro.bias} = x.row(0);
    Eigen::Map<Matrix3>{out->g_sensitivity} = x.bottomRows(3).transpose();
    const Readings rates = (gyro - force * x.bottomRows(3)).rowwise() - Eigen::RowVector3d(x.row(0));

    std::vector<Turn> turns;
    for (size_t k = 0; k + 1 < poses.size(); k++)
    {
        turns.push_back({&rates, mean(force, poses[k]).normalized(), mean(force, poses[k + 1]).normalized(),
                         poses[k].last, poses[k + 1].first});
    }
    const std::vector<Turn> fitted = every(turns, in.part, in.parts);
    const double s = in.gyro_scale;
    const Fit fit = solve(3 * static_cast<Eigen::Index>(fitted.size()),
                          [&](const Nine& unknown)
                          {
                              Eigen::VectorXd residual(3 * static_cast<Eigen::Index>(fitted.size()));
                              Eigen::Index row = 0;
                              for (const Turn& turn : fitted)
                              {
                                  residual.segment<3>(row) = turn.arrived(s * ratio(unknown), in.period_s) - turn.to;
                                  row += 3;
                              }
                              return residual;
                          });
    if (!fit.usable || fit.x.tail<3>().cwiseAbs().maxCoeff() > SCALE_OFF_MAX)
    {
        return why.say(
            INS_CALIB_E_CONVERGENCE,
            "the gyros do not fit gyro_scale = " + number(s) +
                " rad/s per count, nor anything within 30 % of it: wrong unit, axes in another order or sign?");
    }
    Frame frame;
    frame.guess << 0, 0, 0, 0, 0, 0, s, s, s;
    frame.unit << 1, 1, 1, 1, 1, 1, s, s, s;
    // Of the three components of a residual two count: along gravity there is next to none.
    const double freedom = 2 * static_cast<double>(fitted.size()) - INS_CALIB_TRIAD_N;
    if (const std::string lacking = report(fit, frame, freedom, NAMES, &out->gyro); !lacking.empty())
    {
        return why.say(INS_CALIB_E_RANK,
                       "the motions do not fix " + lacking + " of the gyros; turn about all axes, both ways");
    }
    Eigen::Map<Matrix3>{out->gyro.matrix} = s * ratio(fit.x);
    const auto angles = [&](const Matrix3& matrix)
    {
        Eigen::VectorXd all(static_cast<Eigen::Index>(turns.size()));
        for (size_t k = 0; k < turns.size(); k++)
        {
            const Vec there = turns[k].arrived(matrix, in.period_s);
            all(static_cast<Eigen::Index>(k)) = std::atan2(there.cross(turns[k].to).norm(), there.dot(turns[k].to));
        }
        return all;
    };
    const Eigen::VectorXd after = angles(Matrix3(out->gyro.matrix));
    out->gyro.rms = rms(after);
    out->gyro.rms_scale = rms(angles(Matrix3::Identity() * (s * (1 + fit.x.tail<3>().mean()))));
    out->angle[0] = 0;
    std::copy(after.data(), after.data() + after.size(), out->angle + 1);
    return INS_CALIB_OK;
}
} // namespace ins_calib
