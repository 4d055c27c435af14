/// \file   gps_dr.cpp
/// \brief  Decentralised GPS and dead reckoning, ours and the paper's: ins/gps_dr.h, gps_dr_paper.h.
/// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>

namespace libins
{
using namespace nb::literals;

namespace
{
using Pair = std::pair<Made<ins_real>, Made<ins_real>>; ///< state, covariance or variances

ins_gps_dr_config_t defaults()
{
    ins_gps_dr_config_t cfg;
    ins_gps_dr_config_default(&cfg);
    return cfg;
}
const ins_gps_dr_config_t CAR = defaults();

double number(ins_real x)
{
    return static_cast<double>(x);
}

ins_gps_dr_fix_t fix_of(double east, double north, double sigma, unsigned sats, double hdop, double age,
                        std::optional<double> course, double speed)
{
    ins_gps_dr_fix_t f = {};
    f.east = as_real(east);
    f.north = as_real(north);
    f.sigma = as_real(sigma);
    f.age = as_real(age);
    f.hdop = as_real(hdop);
    f.course = as_real(course.value_or(0));
    f.speed = as_real(speed);
    f.valid = 1;
    f.sats = static_cast<uint_least8_t>(sats < 255 ? sats : 255);
    f.has_course = course.has_value() ? 1 : 0;
    return f;
}

void construct(ins_gps_dr_t* self, double q_bias, double q_scale, double r_rate, double r_distance, double hdop_max,
               double gate, unsigned sats, unsigned back, double sigma_bias, double sigma_scale, double tau_fix,
               double gate_gross, double sigma_velocity, double course_min, double still_after, double fix_max_age,
               unsigned restart)
{
    new (self) ins_gps_dr_t();
    const ins_gps_dr_config_t cfg = {
        {0, as_real(q_bias), as_real(q_scale), as_real(r_rate), as_real(r_distance), 0, 0},
        {as_real(hdop_max), as_real(gate), static_cast<uint_least8_t>(sats), static_cast<uint_least8_t>(back)},
        as_real(sigma_bias),
        as_real(sigma_scale),
        as_real(tau_fix),
        as_real(gate_gross),
        as_real(sigma_velocity),
        as_real(course_min),
        as_real(still_after),
        as_real(fix_max_age),
        static_cast<uint_least8_t>(restart)};
    Call("GpsDr", "r, hdop_max and back > 0, the other figures >= 0").check(ins_gps_dr_init(self, &cfg));
}

void bind_ours(nb::module_& m)
{
#define LIBINS_CONSTANT(name) m.attr(#name) = static_cast<int>(INS_##name);
    LIBINS_CONSTANT(GPS_DR_NONE)
    LIBINS_CONSTANT(GPS_DR_ALIGN)
    LIBINS_CONSTANT(GPS_DR_DR)
    LIBINS_CONSTANT(GPS_DR_GPS)
    nb::class_<ins_gps_dr_t> c(m, "GpsDr",
                               "GPS and dead reckoning of a vehicle, decentralised: it finds its heading, shares "
                               "information, switches. Units: m, s, rad.");
    c.def("__init__", construct, nb::kw_only(), "q_bias"_a = number(CAR.vehicle.q_bias),
          "q_scale"_a = number(CAR.vehicle.q_scale), "r_rate"_a = number(CAR.vehicle.r_rate),
          "r_distance"_a = number(CAR.vehicle.r_distance), "hdop_max"_a = number(CAR.choice.hdop_max),
          "gate"_a = number(CAR.choice.gate), "sats"_a = static_cast<unsigned>(CAR.choice.sats),
          "back"_a = static_cast<unsigned>(CAR.choice.back), "sigma_bias"_a = number(CAR.sigma_bias),
          "sigma_scale"_a = number(CAR.sigma_scale), "tau_fix"_a = number(CAR.tau_fix),
          "gate_gross"_a = number(CAR.gate_gross), "sigma_velocity"_a = number(CAR.sigma_velocity),
          "course_min"_a = number(CAR.course_min), "still_after"_a = number(CAR.still_after),
          "fix_max_age"_a = number(CAR.fix_max_age), "restart"_a = static_cast<unsigned>(CAR.restart),
          "As in ins_gps_dr_config_t.");
    c.def(
        "step",
        [](ins_gps_dr_t& self, double dt, double yaw_rate, double distance)
        {
            Call("GpsDr.step", "dt > 0, |yaw_rate dt| < 1000, finite numbers")
                .check(ins_gps_dr_step(&self, as_real(dt), as_real(yaw_rate), as_real(distance)));
        },
        "dt"_a, "yaw_rate"_a, "distance"_a, "dt [s] have passed, with their mean yaw rate [rad/s] and distance [m].");
    c.def(
        "fix",
        [](ins_gps_dr_t& self, double east, double north, double sigma, unsigned sats, double hdop, double age,
           std::optional<double> course, double speed)
        {
            const ins_gps_dr_fix_t f = fix_of(east, north, sigma, sats, hdop, age, course, speed);
            Call("GpsDr.fix", "finite numbers, sigma > 0, nis within the gate").check(ins_gps_dr_fix(&self, &f));
            return number(self.nis);
        },
        "east"_a, "north"_a, "sigma"_a, nb::kw_only(), "sats"_a, "hdop"_a, "age"_a = 0.0, "course"_a = nb::none(),
        "speed"_a = 0.0,
        "A fix [m] of deviation sigma on each coordinate, age [s] ago. Returns its nis, or raises GateError.");
    c.def(
        "no_fix",
        [](ins_gps_dr_t& self)
        {
            const ins_gps_dr_fix_t none = {};
            (void)ins_gps_dr_fix(&self, &none);
        },
        "An epoch without a fix.");
    c.def(
        "state",
        [](const ins_gps_dr_t& self)
        {
            const Call call("GpsDr.state", "a fix before");
            const auto x = call.out<ins_real>({6});
            const auto P = call.out<ins_real>({6, 6});
            call.check(ins_gps_dr_state(&self, x[0], P[0]));
            return Pair{x, P};
        },
        "(x (6,), P (6, 6)): east, north, heading, speed, gyro bias, odometer scale.");
    c.def_prop_ro(
        "source", [](const ins_gps_dr_t& self) { return ins_gps_dr_source(&self); },
        "GPS_DR_NONE, GPS_DR_ALIGN, GPS_DR_DR or GPS_DR_GPS.");
    c.def_ro("used", &ins_gps_dr_t::used, "Fixes used.");
    c.def_ro("doubted", &ins_gps_dr_t::doubted, "Fixes that made the switch say DR.");
    c.def_ro("gross", &ins_gps_dr_t::gross, "Fixes refused.");
    c.def_ro("restarts", &ins_gps_dr_t::restarts, "Starts after the first.");
    copies(c);
}

void bind_paper(nb::module_& m)
{
    nb::class_<ins_gps_dr_paper_t> c(m, "GpsDrPaper",
                                     "The GPS/DR paper's pair and switch, for comparison; GpsDr is the one to use.");
    c.def(
        "__init__",
        [](ins_gps_dr_paper_t* self, bool printed, double r, double sigma_fix)
        {
            new (self) ins_gps_dr_paper_t();
            ins_gps_dr_paper_config_t cfg;
            ins_gps_dr_paper_config_default(&cfg, printed ? INS_GPS_DR_PAPER_PRINTED : INS_GPS_DR_PAPER_CORRECTED);
            cfg.axis.r = as_real(r);
            cfg.axis.sigma_fix = as_real(sigma_fix);
            Call("GpsDrPaper", "r > 0, sigma_fix >= 0").check(ins_gps_dr_paper_init(self, &cfg));
        },
        nb::kw_only(), "printed"_a = false, "r"_a = 9.0, "sigma_fix"_a = 5.0,
        "printed: as in the paper, without hysteresis and gates. r: variance of the white part of a fix [m^2], "
        "sigma_fix: deviation of the other [m].");
    c.def(
        "step",
        [](ins_gps_dr_paper_t& self, double yaw_rate, double distance)
        {
            Call("GpsDrPaper.step", "finite numbers")
                .check(ins_gps_dr_paper_step(&self, as_real(yaw_rate), as_real(distance)));
        },
        "yaw_rate"_a, "distance"_a, "100 ms have passed, with their mean yaw rate [rad/s] and distance [m].");
    c.def(
        "fix",
        [](ins_gps_dr_paper_t& self, double east, double north, unsigned sats, double hdop)
        {
            const ins_gps_dr_fix_t f = fix_of(east, north, 1, sats, hdop, 0, std::nullopt, 0);
            Call("GpsDrPaper.fix", "finite numbers").check(ins_gps_dr_paper_fix(&self, &f));
            return number(self.nis);
        },
        "east"_a, "north"_a, nb::kw_only(), "sats"_a, "hdop"_a, "The fix of a second [m]. Returns its nis.");
    c.def(
        "no_fix",
        [](ins_gps_dr_paper_t& self)
        {
            const ins_gps_dr_fix_t none = {};
            (void)ins_gps_dr_paper_fix(&self, &none);
        },
        "A second without a fix.");
    c.def(
        "state",
        [](const ins_gps_dr_paper_t& self)
        {
            const Call call("GpsDrPaper.state", "a fix before");
            const auto x = call.out<ins_real>({4});
            const auto var = call.out<ins_real>({4});
            call.check(ins_gps_dr_paper_state(&self, x[0], var[0]));
            return Pair{x, var};
        },
        "(x (4,), var (4,)): east, north, their velocities; variances.");
    c.def_prop_ro(
        "source", [](const ins_gps_dr_paper_t& self) { return ins_gps_dr_paper_source(&self); },
        "GPS_DR_NONE, GPS_DR_DR or GPS_DR_GPS.");
    copies(c);
}
} // namespace

void bind_gps_dr(nb::module_& m)
{
    bind_ours(m);
    bind_paper(m);
}

} // namespace libins
