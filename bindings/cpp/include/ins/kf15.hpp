/// \file   ins/kf15.hpp
/// \brief  Covariance of the 15 errors of a strapdown, symmetric and as U D U', and of scale factors beside it. Frames: b -> n (NED). SI, rad.
///
/// Thin: each function is one call of the C function named the same, whose header says frames, units and ranges. z.nis is set, also
/// when the gate refuses.
/// SPDX-License-Identifier: MIT
#ifndef INS_KF15_HPP_INCLUDED
#define INS_KF15_HPP_INCLUDED
#include "ins/eigen.hpp"
#include "ins/kf15.h"
#include "ins/kf15_scale.h"
#include "ins/strapdown.hpp"

namespace ins
{
using Errors15 = Vector<INS_KF15_N>;
using Square15 = Square<INS_KF15_N>;

namespace detail
{
/// Rows of the core's, without what fills them up.
inline Square15 square15(const Real* P)
{
    return Eigen::Map<const Square15, 0, Eigen::OuterStride<INS_KF15_ROW>>(P);
}
} // namespace detail

/// F dt and Q of one step: ins_kf15_model_t.
class Kf15Model
{
  public:
    Status init(Real dt, const ins_kf15_sensors_t& sensors)
    {
        return detail::status(ins_kf15_model_init(&raw, dt, &sensors));
    }
    /// ins_kf15_model(): of the step that ended at `at`. \param[in] v_b  of that step [m/s].
    void set(const Strapdown& at, const Vector3& v_b) { ins_kf15_model(&raw, &at.raw, v_b.data()); }
    [[nodiscard]] Square15 transition() const
    {
        return detail::fill<Square15>([&](Real* out) { ins_kf15_transition(&raw, out); });
    }

    ins_kf15_model_t raw = {};
};

/// ins_kf15_t
class Kf15
{
  public:
    Status init(const Errors15& sigma) { return detail::status(ins_kf15_init(&raw, sigma.data())); }
    void propagate(const Kf15Model& model) { ins_kf15_propagate(&raw, &model.raw); }
    Status update(const Errors15& h, ins_innovation_t& z)
    {
        return detail::status(ins_kf15_update(&raw, h.data(), &z));
    }
    Status update_state(unsigned index, ins_innovation_t& z)
    {
        return detail::status(ins_kf15_update_state(&raw, index, &z));
    }
    [[nodiscard]] Square15 P() const { return detail::square15(raw.P); }
    [[nodiscard]] Errors15 gain() const { return Errors15(raw.K); }

    ins_kf15_t raw = {};
};

/// ins_kf15_ud_t
class Kf15Ud
{
  public:
    Status init(const Errors15& sigma) { return detail::status(ins_kf15_ud_init(&raw, sigma.data())); }
    void propagate(const Kf15Model& model) { ins_kf15_ud_propagate(&raw, &model.raw); }
    Status update(const Errors15& h, ins_innovation_t& z)
    {
        return detail::status(ins_kf15_ud_update(&raw, h.data(), &z));
    }
    Status update_state(unsigned index, ins_innovation_t& z)
    {
        return detail::status(ins_kf15_ud_update_state(&raw, index, &z));
    }
    /// ins_kf15_ud_covariance()
    [[nodiscard]] Square15 P() const
    {
        Real rows[INS_KF15_N * INS_KF15_ROW];
        ins_kf15_ud_covariance(&raw, rows);
        return detail::square15(rows);
    }
    [[nodiscard]] Errors15 gain() const { return Errors15(raw.K); }

    ins_kf15_ud_t raw = {};
};

/// Six scale factors beside a Kf15: ins_kf15_scale_t.
class Kf15Scale
{
  public:
    using Scales = Vector<INS_KF15_SCALE_N>;
    Status init(const ins_kf15_scale_sensors_t& sensors) { return detail::status(ins_kf15_scale_init(&raw, &sensors)); }
    /// \param[in] increment  of the step, as the model was told.
    void propagate(Kf15& kf, const Kf15Model& model, const Increment& increment)
    {
        ins_kf15_scale_propagate(&raw, &kf.raw, &model.raw, increment.theta_b.data(), increment.v_b.data());
    }
    Status update(Kf15& kf, const Errors15& h, const Scales& h_s, ins_innovation_t& z)
    {
        return detail::status(ins_kf15_scale_update(&raw, &kf.raw, h.data(), h_s.data(), &z));
    }
    /// Of the scale factors alone.
    [[nodiscard]] Square<INS_KF15_SCALE_N> P() const
    {
        return Square<INS_KF15_SCALE_N>(raw.B + INS_KF15_N * INS_KF15_SCALE_N);
    }
    [[nodiscard]] Scales gain() const { return Scales(raw.K); }

    ins_kf15_scale_t raw = {};
};
} // namespace ins

#endif // INS_KF15_HPP_INCLUDED
