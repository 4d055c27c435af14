/// \file   gps_ins.cpp
/// \brief  GPS/INS filter, detector of rest, times and positions of receivers: ins/gps_ins.h, ins/gps_ins_align.h, ins/still.h, ins/gnss.h.
/// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

namespace libins
{
using namespace nb::literals;

namespace
{
using Config = ins_gps_ins_config_t;
using Nav = ins_gps_ins_ud_t; ///< its base alone, unless the UD form is asked for

ins_increment_t increment(const ins_real* theta_b, const ins_real* v_b)
{
    ins_increment_t x;
    std::copy(theta_b, theta_b + 3, x.theta_b);
    std::copy(v_b, v_b + 3, x.v_b);
    return x;
}

void bind_config(nb::module_& m)
{
    nb::class_<Config> cfg(m, "GpsInsConfig", "What a GpsIns is told; starts as that of a low-cost MEMS IMU. SI, rad.");
    cfg.def(
        "__init__",
        [](Config* self)
        {
            new (self) Config();
            ins_gps_ins_config(self);
        },
        "A low-cost MEMS IMU, an antenna at the IMU, gates of 99.9 %, no detector of rest.");
#define MEMBER(name, doc) cfg.def_rw(#name, &Config::name, doc);
#define INNER(type, owner, name, doc)                                                                                  \
    cfg.def_prop_rw(                                                                                                   \
        #name, [](const Config& c) { return c.owner.name; }, [](Config& c, type x) { c.owner.name = x; }, doc);
    INNER(ins_real, sensors, arw, "Angle random walk [rad/sqrt(s)].")
    INNER(ins_real, sensors, vrw, "Velocity random walk [m/s/sqrt(s)].")
    INNER(ins_real, sensors, bg_sigma, "Gyro bias: standard deviation [rad/s].")
    INNER(ins_real, sensors, bg_tau, "Its correlation time [s].")
    INNER(ins_real, sensors, ba_sigma, "Accelerometer bias: standard deviation [m/s^2].")
    INNER(ins_real, sensors, ba_tau, "Its correlation time [s].")
    INNER(uint16_t, still, samples, "Of a block of the detector of rest; 0: none.")
    INNER(ins_real, still, rate_sigma, "Largest deviation of a rate at rest [rad/s].")
    INNER(ins_real, still, force_sigma, "Largest deviation of a specific force at rest [m/s^2].")
    INNER(ins_real, still, rate_mean, "Largest mean rate at rest [rad/s].")
    MEMBER(unseen_rate, "Rms of a rate that a gap or a dead axis hides [rad/s].")
    MEMBER(unseen_accel, "Rms of an acceleration that it hides [m/s^2].")
    MEMBER(rate_max, "Range of the gyros [rad/s].")
    MEMBER(force_max, "Range of the accelerometers [m/s^2].")
    MEMBER(gap_max, "Longest time without IMU that is bridged [s].")
    MEMBER(stuck, "Samples of one value that make an axis dead; 0: not looked at.")
    MEMBER(decimate, "IMU samples to a step of the covariance.")
    MEMBER(gnss_late, "Added to the time of a fix [s].")
    MEMBER(gate_position, "Of the joint NIS of a position; 0: none.")
    MEMBER(gate_velocity, "Of the joint NIS of a velocity; 0: none.")
    MEMBER(gate, "Of the NIS of a scalar; 0: none.")
    MEMBER(refused_max, "Fixes refused in a row after which the filter doubts itself; 0: never.")
    MEMBER(nhc, "Standard deviation of no slip [m/s].")
    MEMBER(zupt, "Standard deviation of rest [m/s].")
    MEMBER(zaru, "Standard deviation of no turning [rad/s].")
#undef INNER
#undef MEMBER
    writes(cfg, "antenna_b", &Config::antenna_b, {3}, "Antenna from the IMU [m], (3,).");
    writes(cfg, "wheel_b", &Config::wheel_b, {3}, "Point that only rolls forward, from the IMU [m], (3,).");
    copies(cfg);
}

void start(Nav* self, const Config& cfg, int64_t t_ns, const Given& q_nb, const Given& v_n,
           const ins_position_t& position, const Given& sigma, const Given& gyro_bias, const Given& accel_bias, bool ud)
{
    new (self) Nav();
    const Call call("GpsIns", "a config in its ranges, unit q_nb, sigma >= 0 and no angle's above GPS_INS_TILT_MAX");
    ins_gps_ins_start_t s = {};
    s.t_ns = t_ns;
    s.position = position;
    const auto q = call.whole<ins_real>("q_nb", q_nb, {4});
    const auto v = call.whole<ins_real>("v_n", v_n, {3});
    const auto d = call.whole<ins_real>("sigma", sigma, {INS_KF15_N});
    const auto g = call.whole<ins_real>("gyro_bias", gyro_bias, {3});
    const auto a = call.whole<ins_real>("accel_bias", accel_bias, {3});
    std::copy(q.data, q.data + 4, s.q_nb);
    std::copy(v.data, v.data + 3, s.v_n);
    std::copy(d.data, d.data + INS_KF15_N, s.sigma);
    std::copy(g.data, g.data + 3, s.gyro_bias);
    std::copy(a.data, a.data + 3, s.accel_bias);
    call.check(ud ? ins_gps_ins_ud_init(self, &cfg, &s) : ins_gps_ins_init(&self->base, &cfg, &s));
}

ins_gnss_fix_t fix_of(const char* name, int64_t t_ns, const ins_position_t& position, const Given& v_n,
                      const Given& sigma_p, const Given& sigma_v)
{
    const Call call(name);
    ins_gnss_fix_t f = {};
    f.t_ns = t_ns;
    f.position = position;
    const auto v = call.whole<ins_real>("v_n", v_n, {3});
    const auto p = call.whole<ins_real>("sigma_p", sigma_p, {3});
    const auto s = call.whole<ins_real>("sigma_v", sigma_v, {3});
    std::copy(v.data, v.data + 3, f.v_n);
    std::copy(p.data, p.data + 3, f.sigma_p);
    std::copy(s.data, s.data + 3, f.sigma_v);
    return f;
}

ins_status_t fix(Nav& self, int64_t t_ns, const ins_position_t& position, const Given& v_n, const Given& sigma_p,
                 const Given& sigma_v)
{
    const ins_gnss_fix_t f = fix_of("GpsIns.gnss", t_ns, position, v_n, sigma_p, sigma_v);
    return ins_gps_ins_gnss(&self.base, &f);
}

std::map<std::string, uint32_t> counts(const Nav& self)
{
    std::map<std::string, uint32_t> out;
#define COUNT(name, text) out[#name] = self.base.count.name;
    INS_GPS_INS_COUNT_LIST(COUNT)
#undef COUNT
    return out;
}

void bind_aids(nb::class_<Nav>& nav)
{
    nav.def(
        "zupt", [](Nav& self) { return ins_gps_ins_zupt(&self.base); },
        "At rest now. Returns the status, as do the aids that follow.");
    nav.def(
        "zaru",
        [](Nav& self, const Given& w_ib_b)
        { return ins_gps_ins_zaru(&self.base, Call("GpsIns.zaru").whole<ins_real>("w_ib_b", w_ib_b, {3}).data); },
        "w_ib_b"_a, "Not turning: mean rate as the IMU gave it [rad/s], (3,).");
    nav.def(
        "nhc", [](Nav& self) { return ins_gps_ins_nhc(&self.base); }, "No velocity across the wheels.");
    nav.def(
        "odometer",
        [](Nav& self, double speed, double sigma)
        { return ins_gps_ins_odometer(&self.base, as_real(speed), as_real(sigma)); },
        "speed"_a, "sigma"_a, "Forward speed of config.wheel_b [m/s].");
    nav.def(
        "yaw_rate",
        [](Nav& self, double rate, double sigma)
        { return ins_gps_ins_yaw_rate(&self.base, as_real(rate), as_real(sigma)); },
        "rate"_a, "sigma"_a, "Rate about z of b by another gyro [rad/s].");
    nav.def(
        "altitude",
        [](Nav& self, double height, double sigma)
        { return ins_gps_ins_altitude(&self.base, as_real(height), as_real(sigma)); },
        "height"_a, "sigma"_a, "Height above the ellipsoid [m].");
}

void bind_filter(nb::module_& m)
{
    nb::class_<Nav> nav(m, "GpsIns",
                        "GPS/INS: strapdown with a 15-state error filter. Frames: b -> n (NED). SI, rad, ns.");
    nav.def("__init__", start, "config"_a, "t_ns"_a, "q_nb"_a, "v_n"_a, "position"_a, "sigma"_a,
            "gyro_bias"_a = nb::make_tuple(0, 0, 0), "accel_bias"_a = nb::make_tuple(0, 0, 0), "ud"_a = false,
            "Where it starts; ud: the covariance as U D U'. sigma (15,) in the order KF15_PHI, KF15_V, KF15_P, "
            "KF15_BG, KF15_BA.");
    nav.def(
        "step",
        [](Nav& self, const Given& t_ns, double dt, const Given& theta_b, const Given& v_b)
        {
            Call call("GpsIns.step");
            const auto t = call.rows<int64_t>("t_ns", t_ns, {});
            const auto theta = call.rows<ins_real>("theta_b", theta_b, {3});
            const auto v = call.rows<ins_real>("v_b", v_b, {3});
            const auto status = call.out<int32_t>({});
            call.run(
                [&](size_t k)
                {
                    const ins_increment_t x = increment(theta[k], v[k]);
                    *status[k] = ins_gps_ins_step(&self.base, *t[k], as_real(dt), &x);
                });
            return status;
        },
        "t_ns"_a, "dt"_a, "theta_b"_a, "v_b"_a,
        "IMU samples, () or (N,): end and length of each, increments (3,) or (N, 3). Returns the status of each; what "
        "is refused is counted.");
    nav.def("gnss", fix, "t_ns"_a, "position"_a, "v_n"_a, "sigma_p"_a, "sigma_v"_a,
            "A fix of the antenna; a sigma of 0: that component is not known. Returns the status.");
    bind_aids(nav);
    nav.def_prop_ro(
        "sigma",
        [](const Nav& self)
        {
            ins_gps_ins_state_t state;
            ins_gps_ins_state(&self.base, &state);
            return copy_of(state.sigma, {INS_KF15_N});
        },
        "Standard deviations of the 15 errors, (15,).");
    nav.def_prop_ro(
        "nav", [](const Nav& self) { return self.base.nav; }, "The Strapdown now: attitude, velocity, position.");
    nav.def_prop_ro(
        "kf", [](const Nav& self) { return self.base.kf; }, "The Kf15 now.");
    nav.def_prop_ro(
        "model", [](const Nav& self) { return self.base.model; }, "The Kf15Model of its last step.");
    nav.def_prop_ro(
        "t_ns", [](const Nav& self) { return self.base.t_ns; }, "Of the last sample used.");
    nav.def_prop_ro(
        "stuck", [](const Nav& self) { return self.base.stuck; },
        "Bit i: axis i of the gyros, i - 3 of the accelerometers, is dead.");
    nav.def_prop_ro(
        "lost", [](const Nav& self) { return self.base.lost != 0; }, "After a gap too long: start again.");
    nav.def_prop_ro("count", counts, "What was used and what was refused, by reason.");
    nav.def_prop_ro(
        "innovation", [](const Nav& self) { return copy_of(self.base.check.innovation, {6}); },
        "Of the last fix: position [m], velocity [m/s], (6,).");
    nav.def_prop_ro(
        "nis", [](const Nav& self) { return copy_of(self.base.check.nis, {6}); },
        "Of each component of the last fix, given those before; 0: not used, (6,).");
    nav.def_prop_ro(
        "gyro_bias", [](const Nav& self) { return copy_of(self.base.gyro_bias, {3}); }, "[rad/s], (3,).");
    nav.def_prop_ro(
        "accel_bias", [](const Nav& self) { return copy_of(self.base.accel_bias, {3}); }, "[m/s^2], (3,).");
    copies(nav);
}

/// A filter that starts here, or None.
std::optional<Nav> begin(ins_gps_ins_align_t& self, const Config& cfg, int64_t t_ns, const ins_position_t& position,
                         const Given& v_n, const Given& sigma_p, const Given& sigma_v)
{
    const ins_gnss_fix_t f = fix_of("GpsInsAlign.gnss", t_ns, position, v_n, sigma_p, sigma_v);
    const Call call("GpsInsAlign.gnss", "finite figures, every sigma > 0, at most 0.1 s late, an IMU sample before it");
    ins_gps_ins_start_t s = {};
    const ins_status_t status = ins_gps_ins_align_gnss(&self, &f, &s);
    call.check(status);
    if (status == INS_S_START)
    {
        return std::nullopt;
    }
    Nav nav = {};
    call.check(ins_gps_ins_init(&nav.base, &cfg, &s));
    return nav;
}

void bind_align(nb::module_& m)
{
    using Align = ins_gps_ins_align_t;
    nb::class_<Align> align(m, "GpsInsAlign", "Where a GpsIns starts: level and heading, at rest or under way.");
    align.def(
        "__init__",
        [](Align* self, const Config& cfg, std::optional<double> heading_max, std::optional<double> memory,
           std::optional<double> course_speed, std::optional<double> course_sigma)
        {
            new (self) Align();
            ins_gps_ins_align_config_t how;
            ins_gps_ins_align_config(&how);
            how.heading_max = heading_max ? as_real(*heading_max) : how.heading_max;
            how.memory = memory ? as_real(*memory) : how.memory;
            how.course_speed = course_speed ? as_real(*course_speed) : how.course_speed;
            how.course_sigma = course_sigma ? as_real(*course_sigma) : how.course_sigma;
            Call("GpsInsAlign", "0 < heading_max <= GPS_INS_TILT_MAX, memory and course_sigma > 0, course_speed >= 0")
                .check(ins_gps_ins_align_init(self, &cfg, &how));
        },
        "config"_a, nb::kw_only(), "heading_max"_a = nb::none(), "memory"_a = nb::none(), "course_speed"_a = nb::none(),
        "course_sigma"_a = nb::none(),
        "As in ins_gps_ins_align_config_t; course_speed 0: the nose need not point along the velocity.");
    align.def(
        "step",
        [](Align& self, const Given& t_ns, double dt, const Given& theta_b, const Given& v_b)
        {
            Call call("GpsInsAlign.step");
            const auto t = call.rows<int64_t>("t_ns", t_ns, {});
            const auto theta = call.rows<ins_real>("theta_b", theta_b, {3});
            const auto v = call.rows<ins_real>("v_b", v_b, {3});
            const auto status = call.out<int32_t>({});
            call.run(
                [&](size_t k)
                {
                    const ins_increment_t x = increment(theta[k], v[k]);
                    *status[k] = ins_gps_ins_align_step(&self, *t[k], as_real(dt), &x);
                });
            return status;
        },
        "t_ns"_a, "dt"_a, "theta_b"_a, "v_b"_a, "IMU samples, as GpsIns.step.");
    align.def(
        "heading",
        [](Align& self, double heading, double sigma)
        {
            Call("GpsInsAlign.heading", "|heading| <= 2 pi, sigma > 0")
                .check(ins_gps_ins_align_heading(&self, as_real(heading), as_real(sigma)));
        },
        "heading"_a, "sigma"_a, "Heading of the nose now, from who knows it [rad].");
    align.def("gnss", begin, "config"_a, "t_ns"_a, "position"_a, "v_n"_a, "sigma_p"_a, "sigma_v"_a,
              "A fix: a GpsIns that starts here, or None while the heading is not known well enough.");
    reads(align, "gyro_bias", &Align::gyro_bias, {3}, "Of the last rest [rad/s], (3,).");
    copies(align);
}

void bind_still(nb::module_& m)
{
    nb::class_<ins_still_t> still(m, "Still", "Detector of rest, over blocks of IMU samples. Frame: b. SI, rad.");
    still.def(
        "__init__",
        [](ins_still_t* self, uint16_t samples, double rate_sigma, double force_sigma, double rate_mean)
        {
            new (self) ins_still_t();
            const ins_still_config_t cfg = {samples, as_real(rate_sigma), as_real(force_sigma), as_real(rate_mean)};
            Call("Still", "samples 0 or above 1, bounds > 0").check(ins_still_init(self, &cfg));
        },
        "samples"_a, "rate_sigma"_a, "force_sigma"_a, "rate_mean"_a, "As in ins_still_config_t.");
    still.def(
        "add",
        [](ins_still_t& self, double dt, const Given& theta_b, const Given& v_b)
        {
            Call call("Still.add");
            const auto theta = call.rows<ins_real>("theta_b", theta_b, {3});
            const auto v = call.rows<ins_real>("v_b", v_b, {3});
            const auto rest = call.out<bool>({});
            call.run(
                [&](size_t k)
                {
                    const ins_increment_t x = increment(theta[k], v[k]);
                    *rest[k] = ins_still_add(&self, as_real(dt), &x) != 0;
                });
            return rest;
        },
        "dt"_a, "theta_b"_a, "v_b"_a, "Increments, (3,) or (N, 3): True at the end of each block of rest.");
    still.def("restart", ins_still_restart, "After lost samples: a new block.");
    reads(still, "rate", &ins_still_t::rate, {3}, "Mean rate of the last block of rest [rad/s], (3,).");
    reads(still, "force", &ins_still_t::force, {3}, "Its mean specific force [m/s^2], (3,).");
    copies(still);
}
} // namespace

void bind_gps_ins(nb::module_& m)
{
    m.attr("GPS_INS_TILT_MAX") = static_cast<double>(INS_GPS_INS_TILT_MAX);
    m.attr("GNSS_WEEK_NS") = INS_GNSS_WEEK_NS;
    m.attr("GNSS_ROLLOVER_NS") = INS_GNSS_ROLLOVER_NS;
    m.def("gnss_time_near", ins_gnss_time_near, "t_ns"_a, "period_ns"_a, "near_ns"_a,
          "t_ns plus the multiple of period_ns that brings it nearest to near_ns.");
    m.def(
        "gnss_position",
        [](int32_t lat_e7, int32_t lon_e7, int32_t height_mm)
        {
            ins_position_t position;
            ins_gnss_position(lat_e7, lon_e7, height_mm, &position);
            return position;
        },
        "lat_e7"_a, "lon_e7"_a, "height_mm"_a, "Position of a receiver's integers [1e-7 deg], [mm].");
    bind_still(m);
    bind_config(m);
    bind_filter(m);
    bind_align(m);
}

} // namespace libins
