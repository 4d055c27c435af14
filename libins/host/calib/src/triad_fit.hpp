/// \file   triad_fit.hpp
/// \brief  Least squares of the nine parameters of a triad, and where it starts. Frame: b, of the accelerometers. SI.
/// SPDX-License-Identifier: MIT
#ifndef INS_CALIB_TRIAD_FIT_HPP_INCLUDED
#define INS_CALIB_TRIAD_FIT_HPP_INCLUDED
#include "ins_calib/triad.h"
#include "still.hpp"
#include "why.hpp"
#include <functional>
#include <string>

namespace ins_calib
{
using Vec = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Readings = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Nine = Eigen::Matrix<double, INS_CALIB_TRIAD_N, 1>;

/// Unknowns of a search are of order 1: p = guess + unit * x.
struct Frame
{
    Nine guess, unit;
    Nine of(const Nine& x) const { return guess + unit.cwiseProduct(x); }
};

struct Fit
{
    Nine x = Nine::Zero();
    Eigen::VectorXd residual;
    Eigen::Matrix<double, Eigen::Dynamic, INS_CALIB_TRIAD_N, Eigen::RowMajor> jacobian;
    bool usable = false;
};

/// Least squares by Levenberg-Marquardt, derivatives by central differences.
Fit solve(Eigen::Index residuals, const std::function<Eigen::VectorXd(const Nine&)>& residual);
/// Parameters, covariance and condition of a fit. \return names of what the poses do not fix, or nothing.
std::string report(const Fit& fit, const Frame& frame, double freedom, const std::vector<std::string>& names,
                   ins_calib_axes_t* out);
/// Scale and bias of each axis, by the ellipsoid a x^2 + b y^2 + c z^2 + d x + e y + f z = 1 through the readings.
bool ellipsoid(const Readings& readings, double g, Frame* frame);

double rms(const Eigen::VectorXd& e);
/// Of |s (reading - bias)| - g with the one s that fits.
double rms_scaled(const Readings& readings, const Eigen::RowVector3d& bias, double g);
/// The same with the one bias for all axes that fits.
double rms_raw(const Readings& readings, double g);

/// Every parts-th, from part on.
template <typename T> std::vector<T> every(const std::vector<T>& all, unsigned part, unsigned parts)
{
    std::vector<T> some;
    for (size_t k = part; k < all.size(); k += parts)
    {
        some.push_back(all[k]);
    }
    return some;
}

/// The gyros, with the accelerometers done.
int fit_gyros(const ins_calib_triad_t& in, const std::vector<Pose>& poses, ins_calib_triad_result_t* out,
              const Why& why);
} // namespace ins_calib
#endif // INS_CALIB_TRIAD_FIT_HPP_INCLUDED
