/// \file   ins/gps_ins.hpp
/// \brief  GPS/INS, its start, and the forms with U D U' and with scale factors. Frames: b, n (NED). SI, rad.
///
/// Thin: each function is one call of the C function named the same, whose header says frames, units and ranges.
/// SPDX-License-Identifier: MIT
#ifndef INS_GPS_INS_HPP_INCLUDED
#define INS_GPS_INS_HPP_INCLUDED
#include "ins/eigen.hpp"
#include "ins/gps_ins.h"
#include "ins/gps_ins_align.h"
#include "ins/strapdown.hpp"
#include <type_traits>

namespace ins
{
/// The answer and how sure it is: ins_gps_ins_state_t.
struct GpsInsState
{
    int64_t t_ns;
    Quaternion q_nb;
    Vector3 v_n;
    Position position;
    Vector3 gyro_bias, accel_bias;
    Square<3> P_phi, P_v, P_p;
    Vector<INS_KF15_N> sigma;
};

/// What all forms do. \tparam Raw  ins_gps_ins_t, or what begins with one as `base`.
template <class Raw> class GpsInsForm
{
  public:
    Status step(int64_t t_ns, Real dt, const Increment& increment)
    {
        const ins_increment_t in = increment.raw();
        return detail::status(ins_gps_ins_step(&base(), t_ns, dt, &in));
    }
    /// What became of it: base().check, base().count.
    Status gnss(const ins_gnss_fix_t& fix) { return detail::status(ins_gps_ins_gnss(&base(), &fix)); }
    Status zupt() { return detail::status(ins_gps_ins_zupt(&base())); }
    Status zaru(const Vector3& w_ib_b) { return detail::status(ins_gps_ins_zaru(&base(), w_ib_b.data())); }
    Status nhc() { return detail::status(ins_gps_ins_nhc(&base())); }
    Status odometer(Real speed, Real sigma) { return detail::status(ins_gps_ins_odometer(&base(), speed, sigma)); }
    Status yaw_rate(Real rate, Real sigma) { return detail::status(ins_gps_ins_yaw_rate(&base(), rate, sigma)); }
    Status altitude(Real height, Real sigma) { return detail::status(ins_gps_ins_altitude(&base(), height, sigma)); }
    [[nodiscard]] GpsInsState state() const
    {
        ins_gps_ins_state_t s;
        ins_gps_ins_state(&base(), &s);
        return {s.t_ns,
                detail::quaternion(s.q_nb),
                Vector3(s.v_n),
                Position(s.position),
                Vector3(s.gyro_bias),
                Vector3(s.accel_bias),
                Square<3>(s.P_phi),
                Square<3>(s.P_v),
                Square<3>(s.P_p),
                Vector<INS_KF15_N>(s.sigma)};
    }
    [[nodiscard]] const ins_gps_ins_t& base() const
    {
        if constexpr (std::is_same_v<Raw, ins_gps_ins_t>)
        {
            return raw;
        }
        else
        {
            return raw.base;
        }
    }
    [[nodiscard]] ins_gps_ins_t& base()
    {
        if constexpr (std::is_same_v<Raw, ins_gps_ins_t>)
        {
            return raw;
        }
        else
        {
            return raw.base;
        }
    }

    Raw raw = {};
};

/// ins_gps_ins_t
class GpsIns : public GpsInsForm<ins_gps_ins_t>
{
  public:
    Status init(const ins_gps_ins_config_t& cfg, const ins_gps_ins_start_t& start)
    {
        return detail::status(ins_gps_ins_init(&raw, &cfg, &start));
    }
};

/// ins_gps_ins_ud_t
class GpsInsUd : public GpsInsForm<ins_gps_ins_ud_t>
{
  public:
    Status init(const ins_gps_ins_config_t& cfg, const ins_gps_ins_start_t& start)
    {
        return detail::status(ins_gps_ins_ud_init(&raw, &cfg, &start));
    }
};

/// ins_gps_ins_scale_t
class GpsInsScale : public GpsInsForm<ins_gps_ins_scale_t>
{
  public:
    Status init(const ins_gps_ins_config_t& cfg, const ins_kf15_scale_sensors_t& sensors,
                const ins_gps_ins_start_t& start)
    {
        return detail::status(ins_gps_ins_scale_init(&raw, &cfg, &sensors, &start));
    }
    /// Scale factors; 0.01 reads a hundredth too much.
    [[nodiscard]] Vector3 gyro() const { return Vector3(raw.gyro); }
    [[nodiscard]] Vector3 accel() const { return Vector3(raw.accel); }
};

/// Finds where to start: ins_gps_ins_align_t.
class GpsInsAlign
{
  public:
    Status init(const ins_gps_ins_config_t& cfg, const ins_gps_ins_align_config_t& how)
    {
        return detail::status(ins_gps_ins_align_init(&raw, &cfg, &how));
    }
    Status step(int64_t t_ns, Real dt, const Increment& increment)
    {
        const ins_increment_t in = increment.raw();
        return detail::status(ins_gps_ins_align_step(&raw, t_ns, dt, &in));
    }
    Status heading(Real heading, Real sigma) { return detail::status(ins_gps_ins_align_heading(&raw, heading, sigma)); }
    /// start is written when the status is Ok.
    Status gnss(const ins_gnss_fix_t& fix, ins_gps_ins_start_t& start)
    {
        return detail::status(ins_gps_ins_align_gnss(&raw, &fix, &start));
    }

    ins_gps_ins_align_t raw = {};
};
} // namespace ins

#endif // INS_GPS_INS_HPP_INCLUDED
