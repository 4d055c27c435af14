/// \file   gyro_free.cpp
/// \brief  Navigation by accelerometers alone: ins/gyro_free.h.
/// SPDX-License-Identifier: MIT
#include "accels.hpp"

namespace libins
{
using namespace nb::literals;

namespace
{
using Config = ins_gyro_free_config_t;
using Nav = ins_gyro_free_t;

void bind_config(nb::module_& m)
{
    nb::class_<Config> cfg(m, "GyroFreeConfig",
                           "Standard deviations that a GyroFree starts with; 0 unless set. SI, rad.");
    cfg.def(
        "__init__", [](Config* self) { new (self) Config(); }, "All 0.");
#define MEMBER(name, doc) cfg.def_rw(#name, &Config::name, doc);
    MEMBER(noise, "Of a reading, quantisation included [m/s^2], > 0.")
    MEMBER(bias, "Of a reading's bias at the start [m/s^2].")
    MEMBER(bias_walk, "Its growth [m/s^2/sqrt(s)].")
    MEMBER(velocity, "At the start, each axis [m/s].")
    MEMBER(position, "At the start, each axis [m].")
    MEMBER(rate, "At the start, each axis [rad/s].")
    MEMBER(gate, "Of an innovation's square over its variance; 0: none.")
#undef MEMBER
    writes(cfg, "attitude", &Config::attitude, {3}, "At the start, about north, east, down [rad], (3,).");
    copies(cfg);
}

void init(Nav* self, const Config& cfg, const Given& bias, const Given& axis, const Given& r, double period_s,
          const Given& q_nb, const Given& v_n, const ins_position_t& position)
{
    new (self) Nav();
    const Call call("GyroFree", "6 to 12 accelerometers that see all six unknowns, a start as Strapdown takes it, "
                                "noise > 0 and no other deviation negative");
    const auto accels = accels_of(call, bias, axis, r);
    call.check(ins_gyro_free_init(self, &cfg, static_cast<unsigned>(accels.size()), accels.data(), as_real(period_s),
                                  call.whole<ins_real>("q_nb", q_nb, {4}).data,
                                  call.whole<ins_real>("v_n", v_n, {3}).data, &position));
}

ins_status_t position(Nav& self, const ins_position_t& fix, const Given& sigma, const Given& l_b)
{
    const Call call("GyroFree.position_fix");
    return ins_gyro_free_position(&self, &fix, call.whole<ins_real>("sigma", sigma, {3}).data,
                                  call.whole<ins_real>("l_b", l_b, {3}).data);
}

ins_status_t velocity(Nav& self, const Given& v_n, const Given& sigma)
{
    const Call call("GyroFree.velocity_fix");
    return ins_gyro_free_velocity(&self, call.whole<ins_real>("v_n", v_n, {3}).data,
                                  call.whole<ins_real>("sigma", sigma, {3}).data);
}
} // namespace

void bind_gyro_free(nb::module_& m)
{
    bind_config(m);
    m.attr("GYRO_FREE_N") = INS_GYRO_FREE_N;
    nb::class_<Nav> nav(m, "GyroFree",
                        "Strapdown and error filter on accelerometers alone. Frames: b, n (NED). SI, rad.");
    nav.def("__init__", init, "config"_a, "bias"_a, "axis"_a, "r"_a, "period_s"_a, "q_nb"_a, "v_n"_a, "position"_a,
            "bias, axis, r: (n,), (n, 3), (n, 3) as Sixacc has them. At rate 0.");
    nav.def(
        "step",
        [](Nav& self, const Given& readings)
        {
            Call call("GyroFree.step", "finite readings");
            const auto in = call.rows<ins_real>("readings", readings, {self.sixacc.count});
            call.run([&](size_t k) { return ins_gyro_free_step(&self, in[k]); });
        },
        "readings"_a, "Next samples, (n,) or (N, n); the first moves nothing.");
    nav.def(
        "position_fix", position, "fix"_a, "sigma"_a, "l_b"_a,
        "A fix of the antenna's position at the last sample; sigma (3,) [m], l_b (3,) to it [m]. Returns the status: "
        "an axis outside the gate does not count.");
    nav.def("velocity_fix", velocity, "v_n"_a, "sigma"_a,
            "A known velocity (3,) and its deviations (3,) [m/s]. As above.");
    nav.def(
        "still",
        [](Nav& self, double sigma_v, double sigma_w)
        { return ins_gyro_free_still(&self, as_real(sigma_v), as_real(sigma_w)); },
        "sigma_v"_a, "sigma_w"_a, "Known to stand still [m/s], [rad/s]. As above.");
    nav.def_prop_ro(
        "sigma",
        [](const Nav& self)
        {
            const auto out = made<ins_real>({INS_GYRO_FREE_N});
            ins_gyro_free_sigma(&self, out.data);
            return out;
        },
        "Standard deviations of attitude, velocity, position, rate, and of what biases make of wd and f, (18,).");
    nav.def_prop_ro(
        "q_nb", [](const Nav& self) { return copy_of(self.strapdown.sculling.q_nb, {4}); }, "Attitude, (4,).");
    nav.def_prop_ro(
        "v_n", [](const Nav& self) { return copy_of(self.strapdown.v_n, {3}); }, "Velocity [m/s], (3,).");
    nav.def_prop_ro(
        "w_ib_b", [](const Nav& self) { return copy_of(self.sixacc.w_ib_b, {3}); }, "Rate [rad/s], (3,).");
    nav.def_prop_ro(
        "position", [](const Nav& self) { return self.strapdown.position; }, "A Position.");
    nav.def_ro("refused", &Nav::refused, "Innovations outside the gate so far.");
    copies(nav);
}
} // namespace libins
