/// \file   ins/gyro_free.hpp
/// \brief  Navigation of N accelerometers without gyros, aided by positions and standstills. Frames: b -> n (NED). SI, rad.
///
/// Thin: each function is one call of the C function named the same, whose header says frames, units and ranges.
/// SPDX-License-Identifier: MIT
#ifndef INS_GYRO_FREE_HPP_INCLUDED
#define INS_GYRO_FREE_HPP_INCLUDED
#include "ins/eigen.hpp"
#include "ins/gyro_free.h"
#include "ins/strapdown.hpp"

namespace ins
{
/// ins_gyro_free_t
template <int N = 6> class GyroFree
{
  public:
    static_assert(N >= 6 && N <= INS_SIXACC_MAX, "6 to INS_SIXACC_MAX accelerometers");
    Status init(const ins_gyro_free_config_t& cfg, const ins_accel_t (&accels)[N], Real period_s,
                const Quaternion& q_nb, const Vector3& v_n, const Position& position)
    {
        const ins_position_t start = position.raw();
        return detail::status(
            ins_gyro_free_init(&raw, &cfg, N, accels, period_s, detail::Quat(q_nb).q, v_n.data(), &start));
    }
    Status step(const Vector<N>& readings) { return detail::status(ins_gyro_free_step(&raw, readings.data())); }
    /// ins_gyro_free_position(). \param[in] l_b  from the IMU to the antenna [m].
    Status fix(const Position& position, const Vector3& sigma, const Vector3& l_b = Vector3::Zero())
    {
        const ins_position_t given = position.raw();
        return detail::status(ins_gyro_free_position(&raw, &given, sigma.data(), l_b.data()));
    }
    Status velocity(const Vector3& v_n, const Vector3& sigma)
    {
        return detail::status(ins_gyro_free_velocity(&raw, v_n.data(), sigma.data()));
    }
    Status still(Real sigma_v, Real sigma_w) { return detail::status(ins_gyro_free_still(&raw, sigma_v, sigma_w)); }
    [[nodiscard]] Vector<INS_GYRO_FREE_N> sigma() const
    {
        return detail::fill<Vector<INS_GYRO_FREE_N>>([&](Real* out) { ins_gyro_free_sigma(&raw, out); });
    }
    [[nodiscard]] Quaternion q_nb() const { return detail::quaternion(raw.strapdown.sculling.q_nb); }
    [[nodiscard]] Vector3 v_n() const { return Vector3(raw.strapdown.v_n); }
    [[nodiscard]] Position position() const { return Position(raw.strapdown.position); }
    [[nodiscard]] Vector3 w_ib_b() const { return Vector3(raw.sixacc.w_ib_b); }

    ins_gyro_free_t raw = {};
};
} // namespace ins

#endif // INS_GYRO_FREE_HPP_INCLUDED
