/// \file   ins/strapdown.hpp
/// \brief  Attitude, velocity and position over the WGS-84 Earth. Frames: b -> n (NED). SI, rad.
///
/// Thin: each function is one call of the C function named the same, whose header says frames, units and ranges.
/// SPDX-License-Identifier: MIT
#ifndef INS_STRAPDOWN_HPP_INCLUDED
#define INS_STRAPDOWN_HPP_INCLUDED
#include "ins/earth.h"
#include "ins/eigen.hpp"
#include "ins/sculling.hpp"
#include "ins/strapdown.h"

namespace ins
{
/// Latitude, longitude [rad], height [m]: the sum of both, see ins_position_t.
struct Position
{
    Vector3 anchor = Vector3::Zero();
    Vector3 offset = Vector3::Zero();

    Position() = default;
    explicit Position(const Vector3& llh) : anchor(llh) {}
    explicit Position(const ins_position_t& raw) : anchor(raw.anchor), offset(raw.offset) {}
    [[nodiscard]] ins_position_t raw() const
    {
        return {{anchor.x(), anchor.y(), anchor.z()}, {offset.x(), offset.y(), offset.z()}};
    }
    /// From this to another along the meridian and the parallel through this, and down [m].
    [[nodiscard]] Vector3 ned_to(const Position& other) const
    {
        const ins_position_t a = raw();
        const ins_position_t b = other.raw();
        return detail::fill<Vector3>([&](Real* out) { ins_position_difference(&a, &b, out); });
    }
};

/// ins_strapdown_t
class Strapdown
{
  public:
    Status init(int form, Real period_s, const Quaternion& q_nb, const Vector3& v_n, const Position& position)
    {
        const ins_position_t start = position.raw();
        return detail::status(ins_strapdown_init(&raw, form, period_s, detail::Quat(q_nb).q, v_n.data(), &start));
    }
    Status step(const Increment& increment)
    {
        const ins_increment_t in = increment.raw();
        return detail::status(ins_strapdown_step(&raw, &in));
    }
    /// Each column is an increment.
    [[nodiscard]] Result<Eigen::Index> run(const Samples& theta_b, const Samples& v_b)
    {
        if (theta_b.cols() != v_b.cols())
        {
            return {Status::Range, 0};
        }
        return detail::for_each(theta_b.cols(),
                                [&](Eigen::Index k) {
                                    return step(Increment{theta_b.col(k), v_b.col(k)});
                                });
    }
    [[nodiscard]] Quaternion q_nb() const { return detail::quaternion(raw.sculling.q_nb); }
    [[nodiscard]] Vector3 v_n() const { return Vector3(raw.v_n); }
    [[nodiscard]] Position position() const { return Position(raw.position); }

    struct Point
    {
        Vector3 v_n;
        Position position;
    };
    [[nodiscard]] Point point(const Vector3& l_b, const Vector3& w_ib_b) const
    {
        Point out;
        ins_position_t place;
        ins_strapdown_point(&raw, l_b.data(), w_ib_b.data(), out.v_n.data(), &place);
        out.position = Position(place);
        return out;
    }

    ins_strapdown_t raw = {};
};

[[nodiscard]] inline Vector3 earth_rate(Real sin_lat, Real cos_lat)
{
    return detail::fill<Vector3>([&](Real* out) { ins_earth_rate(sin_lat, cos_lat, out); });
}

[[nodiscard]] inline Vector3 earth_transport_rate(Real sin_lat, Real cos_lat, Real height, const Vector3& v_n)
{
    return detail::fill<Vector3>([&](Real* out)
                                 { ins_earth_transport_rate(sin_lat, cos_lat, height, v_n.data(), out); });
}
} // namespace ins

#endif // INS_STRAPDOWN_HPP_INCLUDED
