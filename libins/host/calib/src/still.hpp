/// \file   still.hpp
/// \brief  Poses in which an IMU lies still, by the variance of its accelerometers in a moving window.
///
/// Source: Tedaldi, Pretto, Menegatti 2014, section IV-B.
/// SPDX-License-Identifier: MIT
#ifndef INS_CALIB_STILL_HPP_INCLUDED
#define INS_CALIB_STILL_HPP_INCLUDED
#include <Eigen/Dense>
#include <vector>

namespace ins_calib
{
using Samples = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>;

struct Pose
{
    Eigen::Index first, last; ///< samples
    Eigen::RowVector3d mean;  ///< of the accelerometers
};

class Stillness
{
  public:
    /// \param[in] initial  samples at the start that are still. \param[in] half  of the window, samples.
    Stillness(const Samples& accel, Eigen::Index initial, Eigen::Index half);
    /// Poses of at least a window's length in which the magnitude of the variances stays below `times` that of the start.
    std::vector<Pose> poses(double times) const;

  private:
    Samples accel_;
    Eigen::Index half_;
    double still_;
    std::vector<double> magnitude_; ///< of the variances; infinite at the ends
};
} // namespace ins_calib
#endif // INS_CALIB_STILL_HPP_INCLUDED
