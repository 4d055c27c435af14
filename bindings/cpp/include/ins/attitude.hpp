/// \file   ins/attitude.hpp
/// \brief  Attitude from angle increments, one at a time, N at a time, or N trajectories at once. Frame: b -> n. Unit: rad.
///
/// Thin: each function is one call of the C function named the same, whose header says frames, units and ranges.
/// SPDX-License-Identifier: MIT
#ifndef INS_ATTITUDE_HPP_INCLUDED
#define INS_ATTITUDE_HPP_INCLUDED
#include "ins/attitude.h"
#include "ins/batch.h"
#include "ins/coning.h"
#include "ins/eigen.hpp"
#include "ins/hist2.h"

namespace ins
{
namespace detail
{
/// Each column is an increment; the attitude after it goes to the same column of q_out.
template <class Filter> Result<Eigen::Index> run(Filter& self, const Samples& dtheta_b, QuaternionsOut& q_out)
{
    if (dtheta_b.cols() != q_out.cols())
    {
        return {Status::Range, 0};
    }
    return for_each(dtheta_b.cols(),
                    [&](Eigen::Index k)
                    {
                        const Status s = self.step(dtheta_b.col(k));
                        if (ok(s))
                        {
                            q_out.col(k) = self.q_nb().coeffs();
                        }
                        return s;
                    });
}
} // namespace detail

/// Rotation vector of a form's interval; columns are its increments, oldest first [rad].
[[nodiscard]] inline Result<Vector3> coning_phi(int form, const Samples& theta_b)
{
    if (theta_b.cols() != ins_coning_samples(form))
    {
        return {Status::Range, Vector3::Zero()};
    }
    Eigen::Matrix<Real, 3, INS_CONING_SAMPLES_MAX> packed;
    packed.leftCols(theta_b.cols()) = theta_b;
    return detail::get<Vector3>([&](Real* out) { return ins_coning_phi(form, packed.data(), out); });
}

/// Increments to attitude: ins_attitude_t.
class Attitude
{
  public:
    Status init(int form, const Quaternion& q_nb)
    {
        return detail::status(ins_attitude_init(&raw, form, detail::Quat(q_nb).q));
    }
    Status step(const Vector3& dtheta_b) { return detail::status(ins_attitude_step(&raw, dtheta_b.data())); }
    /// Each column is an increment; the attitude after it goes to the same column of q_out.
    [[nodiscard]] Result<Eigen::Index> run(const Samples& dtheta_b, QuaternionsOut q_out)
    {
        return detail::run(*this, dtheta_b, q_out);
    }
    Status turn_frame(const Vector3& dzeta_n) { return detail::status(ins_attitude_turn_frame(&raw, dzeta_n.data())); }
    Status jump(const Vector3& phi_b) { return detail::status(ins_attitude_jump(&raw, phi_b.data())); }
    [[nodiscard]] Quaternion q_nb() const { return detail::quaternion(raw.q_nb); }

    ins_attitude_t raw = {};
};

/// The same by INS_CONING_HIST2_OPT alone, for small flash: ins_hist2_t.
class Hist2
{
  public:
    Status init(const Quaternion& q_nb) { return detail::status(ins_hist2_init(&raw, detail::Quat(q_nb).q)); }
    Status step(const Vector3& dtheta_b) { return detail::status(ins_hist2_step(&raw, dtheta_b.data())); }
    /// As Attitude's.
    [[nodiscard]] Result<Eigen::Index> run(const Samples& dtheta_b, QuaternionsOut q_out)
    {
        return detail::run(*this, dtheta_b, q_out);
    }
    [[nodiscard]] Quaternion q_nb() const { return detail::quaternion(raw.q_nb); }

    ins_hist2_t raw = {};
};

/// N trajectories at once, one a row: ins_batch_t. Columns are w, x, y, z and x, y, z; the state is the caller's, one column each of
/// INS_BATCH_ROWS, its first four the attitudes. All contiguous.
class Batch
{
  public:
    using State = Eigen::Ref<Eigen::Matrix<Real, Eigen::Dynamic, INS_BATCH_ROWS>>;
    using Quaternions = Eigen::Ref<const Eigen::Matrix<Real, Eigen::Dynamic, 4>>;
    using Increments = Eigen::Ref<const Eigen::Matrix<Real, Eigen::Dynamic, 3>>;

    Status init(State state, const Quaternions& q_nb)
    {
        const bool fits = q_nb.rows() == state.rows() && packed(state) && packed(q_nb);
        return detail::status(fits ? ins_batch_init(&raw, static_cast<size_t>(state.rows()), state.data(), q_nb.data())
                                   : INS_E_RANGE);
    }
    Status step(State state, const Increments& dtheta_b)
    {
        const bool fits = static_cast<size_t>(state.rows()) == raw.n && dtheta_b.rows() == state.rows() &&
                          packed(state) && packed(dtheta_b);
        return detail::status(fits ? ins_batch_step(&raw, state.data(), dtheta_b.data()) : INS_E_RANGE);
    }

    ins_batch_t raw = {};

  private:
    template <class Matrix> static bool packed(const Matrix& m) { return m.outerStride() == m.rows(); }
};
} // namespace ins

#endif // INS_ATTITUDE_HPP_INCLUDED
