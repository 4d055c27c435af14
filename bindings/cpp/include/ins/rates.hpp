/// \file   ins/rates.hpp
/// \brief  Sampled rates to increments, with the channels of a scan at one instant. Frame: b. Units: rad/s, rad.
///
/// Thin: each function is one call of the C function named the same, whose header says frames, units and ranges.
/// SPDX-License-Identifier: MIT
#ifndef INS_RATES_HPP_INCLUDED
#define INS_RATES_HPP_INCLUDED
#include "ins/eigen.hpp"
#include "ins/rates.h"

namespace ins
{
/// Sampled rates [rad/s] to increments [rad].
class Rates
{
  public:
    Status init(unsigned order, Real period_s)
    {
        return detail::status(order > INS_RATES_ORDER_MAX
                                  ? INS_E_RANGE
                                  : ins_rates_init(&raw, static_cast<uint_least8_t>(order), period_s));
    }
    [[nodiscard]] Result<Vector3> add(const Vector3& w_ib_b)
    {
        return detail::get<Vector3>([&](Real* out) { return ins_rates_add(&raw, w_ib_b.data(), out); });
    }
    [[nodiscard]] Result<Vector3> bridge(uint32_t missing, const Vector3& w_ib_b)
    {
        return detail::get<Vector3>([&](Real* out) { return ins_rates_bridge(&raw, missing, w_ib_b.data(), out); });
    }
    /// Each column of w_ib_b into the same of dtheta_b; they may not overlap.
    [[nodiscard]] Result<Eigen::Index> run(const Samples& w_ib_b, SamplesOut dtheta_b)
    {
        if (w_ib_b.cols() != dtheta_b.cols())
        {
            return {Status::Range, 0};
        }
        return detail::for_each(
            w_ib_b.cols(), [&](Eigen::Index k)
            { return detail::status(ins_rates_add(&raw, w_ib_b.col(k).data(), dtheta_b.col(k).data())); });
    }

    ins_rates_t raw = {};
};

/// The channels of one scan to its instant.
class Skew
{
  public:
    Status init(unsigned order, const Vector3& delay_s, Real period_s)
    {
        return detail::status(
            order > 3 ? INS_E_RANGE : ins_skew_init(&raw, static_cast<uint_least8_t>(order), delay_s.data(), period_s));
    }
    [[nodiscard]] Result<Vector3> add(const Vector3& sample)
    {
        return detail::get<Vector3>([&](Real* out) { return ins_skew_add(&raw, sample.data(), out); });
    }
    void restart() { ins_skew_restart(&raw); }

    ins_skew_t raw = {};
};
} // namespace ins

#endif // INS_RATES_HPP_INCLUDED
