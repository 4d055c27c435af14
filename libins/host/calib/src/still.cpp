/// \file   still.cpp
/// \brief  The detector of stillness.
/// SPDX-License-Identifier: MIT
#include "still.hpp"
#include <limits>

namespace ins_calib
{
namespace
{
Eigen::RowVector3d variance(const Eigen::Ref<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>& samples)
{
    const Eigen::RowVector3d mean = samples.colwise().mean();
    return (samples.rowwise() - mean).colwise().squaredNorm() / static_cast<double>(samples.rows() - 1);
}
} // namespace

Stillness::Stillness(const Samples& accel, Eigen::Index initial, Eigen::Index half)
    : accel_(accel), half_(half), still_(variance(accel.topRows(initial)).norm()),
      magnitude_(static_cast<size_t>(accel.rows()), std::numeric_limits<double>::infinity())
{
    for (Eigen::Index i = half; i + half < accel.rows(); i++)
    {
        magnitude_[static_cast<size_t>(i)] = variance(accel.middleRows(i - half, 2 * half + 1)).norm();
    }
}

std::vector<Pose> Stillness::poses(double times) const
{
    std::vector<Pose> found;
    const auto count = static_cast<Eigen::Index>(magnitude_.size());
    Eigen::Index first = 0;
    for (Eigen::Index i = 0; i <= count; i++)
    {
        if (i < count && magnitude_[static_cast<size_t>(i)] < times * still_)
        {
            continue;
        }
        const Eigen::Index length = i - first;
        if (length >= 2 * half_ + 1)
        {
            found.push_back({first, i - 1, accel_.middleRows(first, length).colwise().mean()});
        }
        first = i + 1;
    }
    return found;
}
} // namespace ins_calib
