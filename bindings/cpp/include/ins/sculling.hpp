/// \file   ins/sculling.hpp
/// \brief  Attitude and velocity increments with sculling correction. Frames: b -> n. Units: rad, m/s.
///
/// Thin: each function is one call of the C function named the same, whose header says frames, units and ranges.
/// SPDX-License-Identifier: MIT
#ifndef INS_SCULLING_HPP_INCLUDED
#define INS_SCULLING_HPP_INCLUDED
#include "ins/eigen.hpp"
#include "ins/sculling.h"

namespace ins
{
/// What an IMU gives for one interval: integrals of rate [rad] and of specific force [m/s], in b.
struct Increment
{
    Vector3 theta_b = Vector3::Zero();
    Vector3 v_b = Vector3::Zero();

    [[nodiscard]] ins_increment_t raw() const
    {
        return {{theta_b.x(), theta_b.y(), theta_b.z()}, {v_b.x(), v_b.y(), v_b.z()}};
    }
};

/// ins_sculling_t
class Sculling
{
  public:
    Status init(int form, const Quaternion& q_nb)
    {
        return detail::status(ins_sculling_init(&raw, form, detail::Quat(q_nb).q));
    }
    /// Specific force integrated in b as it stood at the interval's start [m/s].
    [[nodiscard]] Result<Vector3> step(const Increment& increment)
    {
        const ins_increment_t in = increment.raw();
        return detail::get<Vector3>([&](Real* out) { return ins_sculling_step(&raw, &in, out); });
    }
    [[nodiscard]] Quaternion q_nb() const { return detail::quaternion(raw.q_nb); }

    ins_sculling_t raw = {};
};

/// The correction of one interval; columns of theta_b and v_b are a form's increments, oldest first.
[[nodiscard]] inline Result<Vector3> sculling_dv(int form, const Samples& theta_b, const Samples& v_b)
{
    if (theta_b.cols() != ins_coning_samples(form) || v_b.cols() != theta_b.cols())
    {
        return {Status::Range, Vector3::Zero()};
    }
    ins_increment_t increments[INS_CONING_SAMPLES_MAX] = {};
    for (Eigen::Index k = 0; k < theta_b.cols(); k++)
    {
        increments[k] = Increment{theta_b.col(k), v_b.col(k)}.raw();
    }
    return detail::get<Vector3>([&](Real* out) { return ins_sculling_dv(form, increments, out); });
}
} // namespace ins

#endif // INS_SCULLING_HPP_INCLUDED
