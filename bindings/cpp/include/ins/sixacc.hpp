/// \file   ins/sixacc.hpp
/// \brief  Motion and calibration of N accelerometers. Frame: b. SI.
///
/// Thin: each function is one call of the C function named the same, whose header says frames, units and ranges.
/// SPDX-License-Identifier: MIT
#ifndef INS_SIXACC_HPP_INCLUDED
#define INS_SIXACC_HPP_INCLUDED
#include "ins/eigen.hpp"
#include "ins/sculling.hpp"
#include "ins/sixacc.h"

namespace ins
{
[[nodiscard]] inline Real accel_linear(const ins_accel_t& accel, Real k2, Real reading)
{
    return ins_accel_linear(&accel, k2, reading);
}

/// N accelerometers: ins_sixacc_t.
template <int N = 6> class SixAcc
{
  public:
    static_assert(N >= 6 && N <= INS_SIXACC_MAX, "6 to INS_SIXACC_MAX accelerometers");
    Status init(const ins_accel_t (&accels)[N], Real period_s)
    {
        return detail::status(ins_sixacc_init(&raw, N, accels, period_s));
    }
    struct Motion
    {
        Vector3 wd_ib_b;
        Vector3 f_b;
    };
    [[nodiscard]] Motion resolve(const Vector<N>& readings, const Vector3& w_ib_b) const
    {
        Motion out;
        ins_sixacc_resolve(&raw, readings.data(), w_ib_b.data(), out.wd_ib_b.data(), out.f_b.data());
        return out;
    }
    [[nodiscard]] Result<Increment> step(const Vector<N>& readings)
    {
        ins_increment_t out = {};
        const Status s = detail::status(ins_sixacc_step(&raw, readings.data(), &out));
        return {s, Increment{Vector3(out.theta_b), Vector3(out.v_b)}};
    }
    [[nodiscard]] Vector3 w_ib_b() const { return Vector3(raw.w_ib_b); }

    ins_sixacc_t raw = {};
};

/// Linear maps of N accelerometers: ins_linfit_t.
template <int N> class LinFit
{
  public:
    static_assert(N >= 1 && N <= INS_SIXACC_MAX, "1 to INS_SIXACC_MAX accelerometers");
    LinFit() { (void)ins_linfit_init(&raw, N); }
    Status add(const Vector3& f_b, const Vector<N>& readings)
    {
        return detail::status(ins_linfit_add(&raw, f_b.data(), readings.data()));
    }
    /// Bias and axis of one.
    [[nodiscard]] Result<Vector<4>> solve(unsigned index) const
    {
        return detail::get<Vector<4>>([&](Real* out) { return ins_linfit_solve(&raw, index, out); });
    }

    ins_linfit_t raw = {};
};
} // namespace ins

#endif // INS_SIXACC_HPP_INCLUDED
