/// \file   triad.cpp
/// \brief  Accelerometers by |f| = g in still poses, gyros by gravity turned from pose to pose. Frame: b, of the accelerometers.
/// SPDX-License-Identifier: MIT
#include "ins_calib/triad.h"
#include "triad_fit.hpp"
#include <limits>

using namespace ins_calib;

namespace
{
constexpr int THRESHOLDS = 10; ///< multiples of the start's variance that are tried, from 1
const std::vector<std::string> NAMES = {"alpha_yz", "alpha_zy", "alpha_zx", "s_x", "s_y", "s_z", "b_x", "b_y", "b_z"};

/// Specific force of a reading. T is upper triangular, its misalignments yz and zx count negative.
Matrix3 matrix_of(const double* p)
{
    Matrix3 T;
    T << 1, -p[0], p[1], 0, 1, -p[2], 0, 0, 1;
    return T * Vec(p[3], p[4], p[5]).asDiagonal();
}

Readings forces(const Nine& p, const Readings& readings)
{
    return (readings.rowwise() - p.tail<3>().transpose()) * matrix_of(p.data()).transpose();
}

Readings means(const std::vector<Pose>& poses)
{
    Readings readings(static_cast<Eigen::Index>(poses.size()), 3);
    for (size_t k = 0; k < poses.size(); k++)
    {
        readings.row(static_cast<Eigen::Index>(k)) = poses[k].mean;
    }
    return readings;
}

bool fit_accelerometers(const std::vector<Pose>& poses, double g, Frame* frame, Fit* fit)
{
    const Readings readings = means(poses);
    if (!ellipsoid(readings, g, frame))
    {
        return false;
    }
    *fit = solve(readings.rows(),
                 [&](const Nine& x) -> Eigen::VectorXd
                 { return forces(frame->of(x), readings).rowwise().norm().array() - g; });
    return fit->usable;
}

std::string refused(const ins_calib_triad_t& in)
{
    const auto length = static_cast<double>(in.samples) * in.period_s;
    if (!(in.g > 0) || !std::isfinite(in.g) || !(in.period_s > 0))
    {
        return "g is " + number(in.g) + " m/s^2, the period " + number(in.period_s) + " s: both must be above 0";
    }
    if (!(in.window_s >= 4 * in.period_s) || !(in.initial_s >= INS_CALIB_INITIAL_MIN * in.period_s) ||
        !(in.initial_s < length))
    {
        return "window_s is " + number(in.window_s) + ", initial_s " + number(in.initial_s) +
               ": give at least four and " + std::to_string(INS_CALIB_INITIAL_MIN) +
               " samples, less than the recording of " + number(length) + " s";
    }
    if (in.parts == 0 || in.part >= in.parts)
    {
        return "part " + std::to_string(in.part) + " of " + std::to_string(in.parts) + ": must be below it";
    }
    if (in.gyro != nullptr && !(in.gyro_scale > 0))
    {
        return "gyro_scale is " + number(in.gyro_scale) + ": give the nominal rad/s per count, above 0";
    }
    const auto n = static_cast<Eigen::Index>(in.samples);
    if (!Samples(in.accel, n, 3).allFinite() || (in.gyro != nullptr && !Samples(in.gyro, n, 3).allFinite()))
    {
        return "a sample is not a number";
    }
    return {};
}

} // namespace

int ins_calib_triad(const ins_calib_triad_t* given, ins_calib_triad_result_t* out, char* text, size_t size)
{
    const Why why{text, size};
    const ins_calib_triad_t& in = *given;
    if (const std::string reason = refused(in); !reason.empty())
    {
        return why.say(INS_CALIB_E_INPUT, reason);
    }
    const auto samples = [&](double s) { return static_cast<Eigen::Index>(std::lround(s / in.period_s)); };
    const Stillness stillness(Samples(in.accel, static_cast<Eigen::Index>(in.samples), 3), samples(in.initial_s),
                              samples(in.window_s / 2));
    std::vector<Pose> poses;
    Frame frame;
    Fit fit;
    double best = std::numeric_limits<double>::infinity();
    size_t most = 0;
    for (int times = 1; times <= THRESHOLDS; times++)
    {
        const std::vector<Pose> all = stillness.poses(times);
        const std::vector<Pose> some = every(all, in.part, in.parts);
        most = std::max(most, some.size());
        Frame trial;
        Fit fitted;
        if (some.size() < INS_CALIB_POSES_MIN || all.size() > out->capacity ||
            !fit_accelerometers(some, in.g, &trial, &fitted))
        {
            continue;
        }
        const double e = rms(fitted.residual);
        if (e < best)
        {
            best = e;
            poses = all;
            frame = trial;
            fit = fitted;
            out->threshold = times;
        }
    }
    const std::string hold = ": hold each axis up and down, and slanted between";
    if (poses.empty() && most >= INS_CALIB_POSES_MIN && most <= out->capacity)
    {
        return why.say(INS_CALIB_E_RANK,
                       std::to_string(most) + " still poses, whose readings lie on no ellipsoid" + hold);
    }
    if (poses.empty())
    {
        return why.say(INS_CALIB_E_RANK,
                       std::to_string(most) + " still poses of " + number(in.window_s) + " s, " +
                           std::to_string(INS_CALIB_POSES_MIN) + " to " + std::to_string(out->capacity) +
                           " are needed; does it lie still for the first " + number(in.initial_s) + " s?");
    }
    const double freedom = static_cast<double>(fit.residual.size() - INS_CALIB_TRIAD_N);
    if (const std::string lacking = report(fit, frame, freedom, NAMES, &out->accel); !lacking.empty())
    {
        return why.say(INS_CALIB_E_RANK, "the poses do not fix " + lacking + " of the accelerometers" + hold);
    }
    Eigen::Map<Matrix3>{out->accel.matrix} = matrix_of(out->accel.p);
    std::copy(out->accel.p + 6, out->accel.p + 9, out->accel.bias);
    const Readings readings = means(poses);
    const Eigen::VectorXd e = forces(Nine(out->accel.p), readings).rowwise().norm().array() - in.g;
    out->accel.rms = rms(e);
    out->accel.rms_scale = rms_scaled(readings, Eigen::RowVector3d(out->accel.bias), in.g);
    out->rms_raw = rms_raw(readings, in.g);
    out->poses = poses.size();
    for (size_t k = 0; k < poses.size(); k++)
    {
        out->first[k] = static_cast<size_t>(poses[k].first);
        out->last[k] = static_cast<size_t>(poses[k].last);
        out->residual[k] = e(static_cast<Eigen::Index>(k));
    }
    return in.gyro == nullptr ? INS_CALIB_OK : fit_gyros(in, poses, out, why);
}
