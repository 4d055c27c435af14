/// \file   ins/compare.hpp
/// \brief  Other ways from increments or rates to attitude: functional iteration, sample reuse, the thesis. Frame: b -> n.
///
/// Thin: each function is one call of the C function named the same, whose header says frames, units and ranges.
/// SPDX-License-Identifier: MIT
#ifndef INS_COMPARE_HPP_INCLUDED
#define INS_COMPARE_HPP_INCLUDED
#include "ins/eigen.hpp"
#include "ins/fiter.h"
#include "ins/reuse.h"
#include "ins/thesis.h"

namespace ins
{
/// Rotation over a form's interval by functional iteration.
[[nodiscard]] inline Result<Quaternion> fiter_turn(int form, const Samples& theta_b)
{
    if (theta_b.cols() != ins_fiter_samples(form))
    {
        return {Status::Range, Quaternion(0, 0, 0, 0)};
    }
    Eigen::Matrix<Real, 3, INS_FITER_SAMPLES_MAX> packed;
    packed.leftCols(theta_b.cols()) = theta_b;
    return detail::get_quaternion([&](Real* out) { return ins_fiter_turn(form, packed.data(), out); });
}

/// The paper's sample reuse: ins_reuse_t.
class Reuse
{
  public:
    Status init(int form, const Quaternion& q0, const Quaternion& q1, const Quaternion& q2)
    {
        const Real q[12] = {q0.w(), q0.x(), q0.y(), q0.z(), q1.w(), q1.x(),
                            q1.y(), q1.z(), q2.w(), q2.x(), q2.y(), q2.z()};
        return detail::status(ins_reuse_init(&raw, form, q));
    }
    [[nodiscard]] Result<Quaternion> step(const Vector3& dtheta_b)
    {
        return detail::get_quaternion([&](Real* out) { return ins_reuse_step(&raw, dtheta_b.data(), out); });
    }

    ins_reuse_t raw = {};
};

/// Functional iteration: ins_fiter_t.
class Fiter
{
  public:
    Status init(int form, Real period_s, const Quaternion& q_nb)
    {
        return detail::status(ins_fiter_init(&raw, form, period_s, detail::Quat(q_nb).q));
    }
    Status step(const Vector3& sample_b) { return detail::status(ins_fiter_step(&raw, sample_b.data())); }
    [[nodiscard]] Quaternion q_nb() const { return detail::quaternion(raw.q_nb); }

    ins_fiter_t raw = {};
};

/// The thesis's second-order update: ins_thesis_t.
class Thesis
{
  public:
    Status init(const Quaternion& q_nb) { return detail::status(ins_thesis_init(&raw, detail::Quat(q_nb).q)); }
    Status step(const Vector3& dtheta_b) { return detail::status(ins_thesis_step(&raw, dtheta_b.data())); }
    [[nodiscard]] Quaternion q_nb() const { return detail::quaternion(raw.q_nb); }

    ins_thesis_t raw = {};
};

/// Its Runge-Kutta: ins_thesis_rk4_t.
class ThesisRk4
{
  public:
    Status init(Real feedback, Real step_s, const Quaternion& q_nb, const Vector3& w_ib_b)
    {
        return detail::status(ins_thesis_rk4_init(&raw, feedback, step_s, detail::Quat(q_nb).q, w_ib_b.data()));
    }
    Status step(const Vector3& w_mid_b, const Vector3& w_end_b)
    {
        return detail::status(ins_thesis_rk4_step(&raw, w_mid_b.data(), w_end_b.data()));
    }
    [[nodiscard]] Quaternion q_nb() const { return detail::quaternion(raw.q_nb); }

    ins_thesis_rk4_t raw = {};
};

[[nodiscard]] inline Matrix3 thesis_zxz(const Vector3& angles)
{
    return detail::fill_matrix([&](Real* out) { ins_thesis_zxz(angles.data(), out); });
}
} // namespace ins

#endif // INS_COMPARE_HPP_INCLUDED
