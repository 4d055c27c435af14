/// \file   ins/geodesy.hpp
/// \brief  Geodetic, Earth-fixed, local and projected coordinates. Frames: e, n. Units: rad, m.
///
/// Thin: each function is one call of the C function named the same, whose header says frames, units and ranges.
/// SPDX-License-Identifier: MIT
#ifndef INS_GEODESY_HPP_INCLUDED
#define INS_GEODESY_HPP_INCLUDED
#include "ins/eigen.hpp"
#include "ins/geodesy.h"
#include "ins/tm.h"

namespace ins
{
/// llh: latitude, longitude [rad], height [m].
[[nodiscard]] inline Result<Vector3> geodesy_to_ecef(const ins_ellipsoid_t& ellipsoid, const Vector3& llh)
{
    return detail::get<Vector3>([&](Real* out) { return ins_geodesy_to_ecef(&ellipsoid, llh.data(), out); });
}

[[nodiscard]] inline Result<Vector3> geodesy_from_ecef(const ins_ellipsoid_t& ellipsoid, const Vector3& xyz_e)
{
    return detail::get<Vector3>([&](Real* out) { return ins_geodesy_from_ecef(&ellipsoid, xyz_e.data(), out); });
}

/// ins_local_t
class Local
{
  public:
    Status init(const ins_ellipsoid_t& ellipsoid, const Vector3& llh)
    {
        return detail::status(ins_local_init(&raw, &ellipsoid, llh.data()));
    }
    [[nodiscard]] Vector3 from_ecef(const Vector3& xyz_e) const
    {
        return detail::fill<Vector3>([&](Real* out) { ins_local_from_ecef(&raw, xyz_e.data(), out); });
    }
    [[nodiscard]] Vector3 to_ecef(const Vector3& ned) const
    {
        return detail::fill<Vector3>([&](Real* out) { ins_local_to_ecef(&raw, ned.data(), out); });
    }

    ins_local_t raw = {};
};

/// ins_tm_t
class Tm
{
  public:
    Status init(const ins_ellipsoid_t& ellipsoid, Real lon0, Real k0, const Vector2& false_origin)
    {
        return detail::status(ins_tm_init(&raw, &ellipsoid, lon0, k0, false_origin.x(), false_origin.y()));
    }
    Status init_twd97(int zone) { return detail::status(ins_tm_init_twd97(&raw, zone)); }
    /// Easting, northing.
    [[nodiscard]] Result<Vector2> forward(const Vector2& lat_lon) const
    {
        return detail::get<Vector2>([&](Real* out)
                                    { return ins_tm_forward(&raw, lat_lon.x(), lat_lon.y(), out, nullptr); });
    }
    [[nodiscard]] Result<Vector2> inverse(const Vector2& en) const
    {
        return detail::get<Vector2>([&](Real* out) { return ins_tm_inverse(&raw, en.data(), out); });
    }

    ins_tm_t raw = {};
};
} // namespace ins

#endif // INS_GEODESY_HPP_INCLUDED
