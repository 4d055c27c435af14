/// \file   ins/gps_dr.hpp
/// \brief  GPS and dead-reckoning filters of set size: a coordinate of a fix, the paper's, the vehicle's, both pairs. Units: m, s, rad.
///
/// Thin: each function is one call of the C function named the same, whose header says frames, units and ranges. nis is as in
/// ins_innovation_t, set also when the gate refuses.
/// SPDX-License-Identifier: MIT
#ifndef INS_GPS_DR_HPP_INCLUDED
#define INS_GPS_DR_HPP_INCLUDED
#include "ins/dead_reckoning.h"
#include "ins/eigen.hpp"
#include "ins/gps_axis.h"
#include "ins/gps_dr.h"
#include "ins/gps_dr_paper.h"
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
    Status travel(Real dt, Real yaw_rate, Real distance)
    {
        return detail::status(ins_unicycle_travel(&raw, dt, yaw_rate, distance));
    }
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
    Status judge(const Vector2& en, Real r, Real& nis, Real& det) const
    {
        return detail::status(ins_unicycle_judge(&raw, en.x(), en.y(), r, &nis, &det));
    }
    Status course(Real course, Real r, Real gate = 0, Real* nis = nullptr)
    {
        return detail::status(ins_unicycle_course(&raw, course, r, gate, nis));
    }
    [[nodiscard]] Vector<6> x() const { return Vector<6>(raw.x); }
    [[nodiscard]] Square<6> P() const { return Square<6>(raw.P); }

    ins_unicycle_t raw = {};
};

/// The decentralised pair that finds its heading: ins_gps_dr_t.
class GpsDr
{
  public:
    Status init(const ins_gps_dr_config_t& cfg) { return detail::status(ins_gps_dr_init(&raw, &cfg)); }
    Status step(Real dt, Real yaw_rate, Real distance)
    {
        return detail::status(ins_gps_dr_step(&raw, dt, yaw_rate, distance));
    }
    Status fix(const ins_gps_dr_fix_t& fix) { return detail::status(ins_gps_dr_fix(&raw, &fix)); }
    /// INS_GPS_DR_NONE ...
    [[nodiscard]] int source() const { return ins_gps_dr_source(&raw); }
    /// x as of Unicycle. P is column-major as well: it is symmetric.
    Status state(Vector<6>& x, Square<6>& P) const
    {
        return detail::status(ins_gps_dr_state(&raw, x.data(), P.data()));
    }

    ins_gps_dr_t raw = {};
};

/// The paper's pair: ins_gps_dr_paper_t.
class GpsDrPaper
{
  public:
    Status init(const ins_gps_dr_paper_config_t& cfg) { return detail::status(ins_gps_dr_paper_init(&raw, &cfg)); }
    Status step(Real yaw_rate, Real distance)
    {
        return detail::status(ins_gps_dr_paper_step(&raw, yaw_rate, distance));
    }
    Status fix(const ins_gps_dr_fix_t& fix) { return detail::status(ins_gps_dr_paper_fix(&raw, &fix)); }
    [[nodiscard]] int source() const { return ins_gps_dr_paper_source(&raw); }
    /// East, north, their velocities; their variances.
    Status state(Vector<4>& x, Vector<4>& var) const
    {
        return detail::status(ins_gps_dr_paper_state(&raw, x.data(), var.data()));
    }

    ins_gps_dr_paper_t raw = {};
};
} // namespace ins

#endif // INS_GPS_DR_HPP_INCLUDED
