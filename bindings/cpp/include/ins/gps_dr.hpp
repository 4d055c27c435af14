/// \file   ins/gps_dr.hpp
/// \brief  GPS and dead-reckoning filters of set size: a coordinate of a fix, the paper's, the vehicle's. Units: m, s, rad.
///
/// Thin: each function is one call of the C function named the same, whose header says frames, units and ranges. nis is as in
/// ins_innovation_t, set also when the gate refuses.
/// SPDX-License-Identifier: MIT
#ifndef INS_GPS_DR_HPP_INCLUDED
#define INS_GPS_DR_HPP_INCLUDED
#include "ins/dead_reckoning.h"
#include "ins/eigen.hpp"
#include "ins/gps_axis.h"
#include "ins/unicycle.h"

namespace ins
{
/// Position, velocity, acceleration and fix error of one coordinate: ins_gps_axis_t.
class GpsAxis
{
  public:
    Status init(const ins_gps_axis_config_t& cfg, const Vector<4>& var)
    {
        return detail::status(ins_gps_axis_init(&raw, &cfg, var.data()));
    }
    void predict() { ins_gps_axis_predict(&raw); }
    Status step(Real z, Real* nis = nullptr) { return detail::status(ins_gps_axis_step(&raw, z, nis)); }
    [[nodiscard]] Vector<4> x() const { return Vector<4>(raw.x); }
    [[nodiscard]] Square<4> P() const { return Square<4>(raw.P); }
    [[nodiscard]] Square<4> Phi() const { return Square<4>(raw.Phi); }
    [[nodiscard]] Vector<4> gain() const { return Vector<4>(raw.K); }

    ins_gps_axis_t raw = {};
};

/// One step along an arc. \param[in,out] pose  east, north, heading.
inline Status dead_reckoning_step(Vector3& pose, Real distance, Real turn)
{
    return detail::status(ins_dead_reckoning_step(pose.data(), distance, turn));
}

/// East, north, their velocities and accelerations: ins_dr_ekf_t.
class DrEkf
{
  public:
    Status init(const ins_dr_ekf_config_t& cfg, const Vector<6>& x, const Vector<6>& var)
    {
        return detail::status(ins_dr_ekf_init(&raw, &cfg, x.data(), var.data()));
    }
    /// raw.used, raw.nis and raw.gated say what became of the two.
    Status step(Real yaw_rate, Real distance) { return detail::status(ins_dr_ekf_step(&raw, yaw_rate, distance)); }
    [[nodiscard]] Vector<6> x() const { return Vector<6>(raw.x); }
    [[nodiscard]] Square<6> P() const { return Square<6>(raw.P); }

    ins_dr_ekf_t raw = {};
};

/// East, north, heading, speed, gyro bias, odometer scale: ins_unicycle_t.
class Unicycle
{
  public:
    Status init(const ins_unicycle_config_t& cfg, const Vector<6>& x, const Vector<6>& var)
    {
        return detail::status(ins_unicycle_init(&raw, &cfg, x.data(), var.data()));
    }
    Status predict(Real dt, Real yaw_rate) { return detail::status(ins_unicycle_predict(&raw, dt, yaw_rate)); }
    Status odometer(Real dt, Real distance, Real* nis = nullptr)
    {
        return detail::status(ins_unicycle_odometer(&raw, dt, distance, nis));
    }
    Status still(Real yaw_rate, Real r_speed) { return detail::status(ins_unicycle_still(&raw, yaw_rate, r_speed)); }
    /// East, north.
    Status gps(const Vector2& en, Real r, Real* nis = nullptr)
    {
        return detail::status(ins_unicycle_gps(&raw, en.x(), en.y(), r, nis));
    }
    [[nodiscard]] Vector<6> x() const { return Vector<6>(raw.x); }
    [[nodiscard]] Square<6> P() const { return Square<6>(raw.P); }

    ins_unicycle_t raw = {};
};
} // namespace ins

#endif // INS_GPS_DR_HPP_INCLUDED
