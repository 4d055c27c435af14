/// \file   vehicle.cpp
/// \brief  GPS axis filter, dead reckoning, vehicle filter, the switch between them: ins/gps_axis.h, dead_reckoning.h, unicycle.h, fusion.h.
/// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include <cmath>
#include <nanobind/stl/pair.h>

namespace libins
{
using namespace nb::literals;

namespace
{
using Track = std::pair<Made<ins_real>, Made<ins_real>>; ///< states, nis

/// A refusal by the gate is an answer in a run: its nis tells.
ins_status_t unless_gated(ins_status_t status)
{
    return status == INS_E_GATE ? INS_OK : status;
}

Track gps_step(ins_gps_axis_t& self, const Given& z)
{
    Call call("GpsAxis.step", "finite z, or NaN for no fix");
    const auto in = call.rows<ins_real>("z", z, {});
    const auto x = call.out<ins_real>({4});
    const auto nis = call.out<ins_real>({});
    call.run(
        [&](size_t k)
        {
            ins_status_t status = INS_OK;
            *nis[k] = 0;
            if (std::isnan(*in[k]))
            {
                ins_gps_axis_predict(&self);
            }
            else
            {
                status = unless_gated(ins_gps_axis_step(&self, *in[k], nis[k]));
            }
            std::copy(self.x, self.x + 4, x[k]);
            return status;
        });
    return {x, nis};
}

void bind_gps_axis(nb::module_& m)
{
    nb::class_<ins_gps_axis_t> axis(
        m, "GpsAxis",
        "Filter of one coordinate of a GPS fix: position, velocity, acceleration, fix error. Units: m, s.");
    axis.def(
        "__init__",
        [](ins_gps_axis_t* self, const Given& var, double dt, double tau_acceleration, double tau_fix,
           double sigma_acceleration, double sigma_fix, double r, double gate, double acceleration_max)
        {
            new (self) ins_gps_axis_t();
            const ins_gps_axis_config_t cfg = {as_real(dt),        as_real(tau_acceleration),
                                               as_real(tau_fix),   as_real(sigma_acceleration),
                                               as_real(sigma_fix), as_real(r),
                                               as_real(gate),      as_real(acceleration_max)};
            const Call call("GpsAxis",
                            "times and r > 0, deviations and var >= 0, |1 - tau_acceleration / tau_fix| >= 0.1");
            call.check(ins_gps_axis_init(self, &cfg, call.whole<ins_real>("var", var, {4}).data));
        },
        "var"_a, nb::kw_only(), "dt"_a, "tau_acceleration"_a, "tau_fix"_a, "sigma_acceleration"_a, "sigma_fix"_a, "r"_a,
        "gate"_a = 0.0, "acceleration_max"_a = 0.0,
        "var: (4,) variances of the start; x is 0, set it if it is known. The others as in ins_gps_axis_config_t.");
    axis.def("step", gps_step, "z"_a,
             "Epochs with a fix z [m], or NaN for none, () or (N,): (x after each, (4,) or (N, 4); nis, () or (N,), 0 "
             "without a fix, above "
             "the gate if the fix was refused).");
    writes(axis, "x", &ins_gps_axis_t::x, {4}, "Position, velocity, acceleration, fix error, (4,).");
    reads(axis, "P", &ins_gps_axis_t::P, {4, 4}, "Covariance, (4, 4).");
    reads(axis, "Phi", &ins_gps_axis_t::Phi, {4, 4}, "Transition over an epoch, (4, 4).");
    reads(axis, "Q", &ins_gps_axis_t::Q, {4, 4},
          "Noise of the motion for an acceleration of variance 1 (m/s^2)^2, (4, 4).");
    reads(axis, "u", &ins_gps_axis_t::u, {3}, "Input of the mean acceleration, (3,).");
    reads(axis, "K", &ins_gps_axis_t::K, {4}, "Gain of the last update, (4,).");
    copies(axis);
}

Made<ins_real> dead_reckoning(const Given& pose, const Given& distance, const Given& turn)
{
    Call call("dead_reckoning", "finite numbers, angles within +-1000 rad");
    const auto start = call.whole<ins_real>("pose", pose, {3});
    const auto s = call.rows<ins_real>("distance", distance, {});
    const auto angle = call.rows<ins_real>("turn", turn, {});
    const auto out = call.out<ins_real>({3});
    ins_real now[3] = {start.data[0], start.data[1], start.data[2]};
    call.run(
        [&](size_t k)
        {
            const ins_status_t status = ins_dead_reckoning_step(now, *s[k], *angle[k]);
            std::copy(now, now + 3, out[k]);
            return status;
        });
    return out;
}

Track dr_step(ins_dr_ekf_t& self, const Given& yaw_rate, const Given& distance)
{
    Call call("DrEkf.step", "finite numbers");
    const auto rate = call.rows<ins_real>("yaw_rate", yaw_rate, {});
    const auto s = call.rows<ins_real>("distance", distance, {});
    const auto x = call.out<ins_real>({6});
    const auto nis = call.out<ins_real>({2});
    call.run(
        [&](size_t k)
        {
            const ins_status_t status = ins_dr_ekf_step(&self, *rate[k], *s[k]);
            std::copy(self.x, self.x + 6, x[k]);
            std::copy(self.nis, self.nis + 2, nis[k]);
            return unless_gated(status);
        });
    return {x, nis};
}

void bind_dead_reckoning(nb::module_& m)
{
    m.attr("DR_RATE") = INS_DR_RATE;
    m.attr("DR_DISTANCE") = INS_DR_DISTANCE;
    m.def("dead_reckoning", dead_reckoning, "pose"_a, "distance"_a, "turn"_a,
          "From pose (3,), east, north [m] and heading clockwise from north [rad], along arcs of distance [m] and turn "
          "[rad], () or (N,), "
          "to the poses after each, (3,) or (N, 3).");
    nb::class_<ins_dr_ekf_t> ekf(
        m, "DrEkf", "The GPS/DR paper's dead-reckoning filter, for comparison; Unicycle is the one to use.");
    ekf.def(
        "__init__",
        [](ins_dr_ekf_t* self, const Given& x, const Given& var, double dt, const Given& tau, const Given& sigma,
           double r_rate, double r_distance, double v_min, double v_zero, double gate)
        {
            new (self) ins_dr_ekf_t();
            const Call call("DrEkf",
                            "dt, tau, r and v_zero > 0, sigma, var and gate >= 0, v_min >= v_zero, finite numbers");
            const auto t = call.whole<ins_real>("tau", tau, {2});
            const auto s = call.whole<ins_real>("sigma", sigma, {2});
            const ins_dr_ekf_config_t cfg = {as_real(dt),     {t.data[0], t.data[1]}, {s.data[0], s.data[1]},
                                             as_real(r_rate), as_real(r_distance),    as_real(v_min),
                                             as_real(v_zero), as_real(gate)};
            const auto start = call.whole<ins_real>("x", x, {6});
            call.check(ins_dr_ekf_init(self, &cfg, start.data, call.whole<ins_real>("var", var, {6}).data));
        },
        "x"_a, "var"_a, nb::kw_only(), "dt"_a, "tau"_a, "sigma"_a, "r_rate"_a, "r_distance"_a, "v_min"_a = 0.5,
        "v_zero"_a = 1e-3, "gate"_a = 0.0,
        "x, var: (6,), east, north, their velocities and accelerations. The others as in ins_dr_ekf_config_t.");
    ekf.def("step", dr_step, "yaw_rate"_a, "distance"_a,
            "Yaw rates [rad/s] and distances in dt [m], () or (N,), to (x after each, (6,) or (N, 6); nis of both, "
            "(2,) or (N, 2)).");
    writes(ekf, "x", &ins_dr_ekf_t::x, {6}, "State, (6,).");
    reads(ekf, "P", &ins_dr_ekf_t::P, {6, 6}, "Covariance, (6, 6).");
    reads(ekf, "Phi", &ins_dr_ekf_t::Phi, {6, 6}, "Transition over dt, (6, 6).");
    reads(ekf, "Q", &ins_dr_ekf_t::Q, {6, 6}, "Its noise, (6, 6).");
    ekf.def_ro("used", &ins_dr_ekf_t::used, "DR_RATE, DR_DISTANCE: what the last step used.");
    ekf.def_ro("gated", &ins_dr_ekf_t::gated, "Measurements refused by the gate.");
    copies(ekf);
}

void expect(const Call& call, ins_status_t status, ins_real nis)
{
    call.check(status, status == INS_E_GATE ? "nis " + std::to_string(nis) + ": " : "");
}

Track unicycle_run(ins_unicycle_t& self, double dt, const Given& yaw_rate, const Given& distance, const Given& fix,
                   double r)
{
    Call call("Unicycle.run", "finite numbers or NaN for no fix, dt > 0, r > 0, |yaw_rate dt| <= 1000");
    const auto rate = call.rows<ins_real>("yaw_rate", yaw_rate, {});
    const auto s = call.rows<ins_real>("distance", distance, {});
    const auto en = call.rows<ins_real>("fix", fix, {2});
    const auto x = call.out<ins_real>({6});
    const auto nis = call.out<ins_real>({2});
    call.run(
        [&](size_t k)
        {
            nis[k][1] = 0;
            ins_status_t status = unless_gated(ins_unicycle_odometer(&self, as_real(dt), *s[k], nis[k]));
            status = status < 0 ? status : ins_unicycle_predict(&self, as_real(dt), *rate[k]);
            if (status >= 0 && !std::isnan(en[k][0]) && !std::isnan(en[k][1]))
            {
                status = unless_gated(ins_unicycle_gps(&self, en[k][0], en[k][1], as_real(r), nis[k] + 1));
            }
            std::copy(self.x, self.x + 6, x[k]);
            return status;
        });
    return {x, nis};
}

void bind_unicycle(nb::module_& m)
{
    nb::class_<ins_unicycle_t> unicycle(m, "Unicycle",
                                        "Vehicle filter: east, north [m], heading clockwise from north [rad], speed "
                                        "[m/s], gyro bias [rad/s], odometer scale.");
    unicycle.def(
        "__init__",
        [](ins_unicycle_t* self, const Given& x, const Given& var, double q_speed, double q_bias, double q_scale,
           double r_rate, double r_distance, double gate, double gate_gps)
        {
            new (self) ins_unicycle_t();
            const Call call("Unicycle", "r > 0, the other figures >= 0, |heading| <= 1000 rad, finite numbers");
            const ins_unicycle_config_t cfg = {as_real(q_speed),    as_real(q_bias), as_real(q_scale), as_real(r_rate),
                                               as_real(r_distance), as_real(gate),   as_real(gate_gps)};
            const auto start = call.whole<ins_real>("x", x, {6});
            call.check(ins_unicycle_init(self, &cfg, start.data, call.whole<ins_real>("var", var, {6}).data));
        },
        "x"_a, "var"_a, nb::kw_only(), "q_speed"_a, "q_bias"_a, "q_scale"_a, "r_rate"_a, "r_distance"_a, "gate"_a = 0.0,
        "gate_gps"_a = 0.0, "x, var: (6,). The others as in ins_unicycle_config_t.");
    unicycle.def("run", unicycle_run, "dt"_a, "yaw_rate"_a, "distance"_a, "fix"_a, "r"_a,
                 "Steps of dt [s], each odometer, predict, gps: yaw rates [rad/s] and distances [m], () or (N,), fixes "
                 "east and north [m], "
                 "NaN for none, (2,) or (N, 2), of variance r. Returns (x after each, (6,) or (N, 6); nis of odometer "
                 "and fix, (2,) or (N, 2)).");
    unicycle.def(
        "predict",
        [](ins_unicycle_t& self, double dt, double yaw_rate)
        {
            Call("Unicycle.predict", "dt > 0, |yaw_rate dt| <= 1000")
                .check(ins_unicycle_predict(&self, as_real(dt), as_real(yaw_rate)));
        },
        "dt"_a, "yaw_rate"_a, "Move by dt [s] with the gyro's yaw rate [rad/s].");
    unicycle.def(
        "travel",
        [](ins_unicycle_t& self, double dt, double yaw_rate, double distance)
        {
            Call("Unicycle.travel", "dt > 0, |yaw_rate dt| <= 1000, finite distance, scale > 0")
                .check(ins_unicycle_travel(&self, as_real(dt), as_real(yaw_rate), as_real(distance)));
        },
        "dt"_a, "yaw_rate"_a, "distance"_a,
        "Move by dt [s] with the gyro's yaw rate [rad/s] and the odometer's distance [m].");
    unicycle.def(
        "odometer",
        [](ins_unicycle_t& self, double dt, double distance)
        {
            ins_real nis = 0;
            expect(Call("Unicycle.odometer", "dt > 0, finite distance, nis within the gate"),
                   ins_unicycle_odometer(&self, as_real(dt), as_real(distance), &nis), nis);
            return static_cast<double>(nis);
        },
        "dt"_a, "distance"_a, "Distance [m] counted in the dt [s] before. Returns its nis, or raises GateError.");
    unicycle.def(
        "still",
        [](ins_unicycle_t& self, double yaw_rate, double r_speed)
        {
            Call("Unicycle.still", "finite yaw_rate, r_speed > 0")
                .check(ins_unicycle_still(&self, as_real(yaw_rate), as_real(r_speed)));
        },
        "yaw_rate"_a, "r_speed"_a, "Known to stand still: the gyro reads its bias. r_speed: how sure [(m/s)^2].");
    unicycle.def(
        "gps",
        [](ins_unicycle_t& self, double east, double north, double r)
        {
            ins_real nis = 0;
            expect(Call("Unicycle.gps", "finite fix, r > 0, nis within the gate"),
                   ins_unicycle_gps(&self, as_real(east), as_real(north), as_real(r), &nis), nis);
            return static_cast<double>(nis);
        },
        "east"_a, "north"_a, "r"_a,
        "A fix [m], variance r on each coordinate. Returns its joint nis, or raises GateError.");
    unicycle.def(
        "judge",
        [](const ins_unicycle_t& self, double east, double north, double r)
        {
            ins_real nis = 0;
            ins_real det = 0;
            Call("Unicycle.judge", "finite fix, r > 0")
                .check(ins_unicycle_judge(&self, as_real(east), as_real(north), as_real(r), &nis, &det));
            return std::pair{static_cast<double>(nis), static_cast<double>(det)};
        },
        "east"_a, "north"_a, "r"_a, "(Joint nis of a fix that is not used, determinant of its covariance [m^4]).");
    unicycle.def(
        "course",
        [](ins_unicycle_t& self, double course, double r, double gate)
        {
            ins_real nis = 0;
            expect(Call("Unicycle.course", "|course| < 1000, r > 0, nis within the gate"),
                   ins_unicycle_course(&self, as_real(course), as_real(r), as_real(gate), &nis), nis);
            return static_cast<double>(nis);
        },
        "course"_a, "r"_a, "gate"_a = 0.0,
        "Direction of travel, clockwise from north [rad], of variance r. Returns its nis, or raises GateError.");
    writes(unicycle, "x", &ins_unicycle_t::x, {6}, "State, (6,).");
    reads(unicycle, "P", &ins_unicycle_t::P, {6, 6}, "Covariance, (6, 6).");
    copies(unicycle);
}

Made<int32_t> switch_epoch(ins_switch_t& self, const Given& valid, const Given& sats, const Given& hdop,
                           const Given& nis)
{
    Call call("Switch.epoch");
    const auto v = call.rows<bool>("valid", valid, {});
    const auto s = call.rows<uint32_t>("sats", sats, {});
    const auto h = call.rows<ins_real>("hdop", hdop, {});
    const auto n = call.rows<ins_real>("nis", nis, {});
    const auto mode = call.out<int32_t>({});
    call.run([&](size_t k) { *mode[k] = ins_switch_epoch(&self, *v[k] ? 1 : 0, *s[k], *h[k], *n[k]); });
    return mode;
}

void bind_switch(nb::module_& m)
{
#define LIBINS_CONSTANT(name) m.attr(#name) = static_cast<int>(INS_##name);
    LIBINS_CONSTANT(SWITCH_DR)
    LIBINS_CONSTANT(SWITCH_GPS)
    LIBINS_CONSTANT(SWITCH_BACK_PAPER)
    LIBINS_CONSTANT(SWITCH_BACK_GOOD)
    nb::class_<ins_switch_t> change(m, "Switch", "The switch between GPS and dead reckoning; starts in DR.");
    change.def(
        "__init__",
        [](ins_switch_t* self, double hdop_max, double gate, uint_least8_t sats, uint_least8_t back)
        {
            new (self) ins_switch_t();
            const ins_switch_config_t cfg = {as_real(hdop_max), as_real(gate), sats, back};
            Call("Switch", "hdop_max > 0, gate >= 0, back >= 1").check(ins_switch_init(self, &cfg));
        },
        nb::kw_only(), "hdop_max"_a = 4.0, "gate"_a = static_cast<double>(INS_KALMAN_GATE2_99), "sats"_a = 4,
        "back"_a = INS_SWITCH_BACK_GOOD,
        "gate: of a fix's nis, 0: not looked at; back: good epochs in a row to go to GPS.");
    change.def("epoch", switch_epoch, "valid"_a, "sats"_a, "hdop"_a, "nis"_a = 0.0,
               "GPS epochs, () or (N,): bool, uint32, real, real (nis 0: no fix), to the mode after each, SWITCH_DR or "
               "SWITCH_GPS.");
    change.def_ro("mode", &ins_switch_t::mode, "Mode now.");
    change.def_prop_ro(
        "good", [](const ins_switch_t& self) { return self.good != 0; }, "The last epoch was good.");
    copies(change);
}
} // namespace

void bind_vehicle(nb::module_& m)
{
    bind_gps_axis(m);
    bind_dead_reckoning(m);
    bind_unicycle(m);
    bind_switch(m);
}

} // namespace libins
