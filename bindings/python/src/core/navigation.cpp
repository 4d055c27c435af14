/// \file   navigation.cpp
/// \brief  Sculling, strapdown navigation and the Earth under it: ins/sculling.h, ins/strapdown.h, ins/earth.h.
/// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include <nanobind/stl/pair.h>
#include <nanobind/stl/tuple.h>

namespace libins
{
using namespace nb::literals;

namespace
{
ins_increment_t increment(const ins_real* theta_b, const ins_real* v_b)
{
    ins_increment_t x;
    std::copy(theta_b, theta_b + 3, x.theta_b);
    std::copy(v_b, v_b + 3, x.v_b);
    return x;
}

Made<ins_real> sculling_dv(int form, const Given& theta_b, const Given& v_b)
{
    Call call("sculling_dv", "form one of CONING_*");
    const size_t samples = static_cast<size_t>(ins_coning_samples(form));
    call.check(samples > 0 ? INS_OK : INS_E_RANGE);
    const auto theta = call.rows<ins_real>("theta_b", theta_b, {samples, 3});
    const auto v = call.rows<ins_real>("v_b", v_b, {samples, 3});
    const auto out = call.out<ins_real>({3});
    call.run(
        [&](size_t k)
        {
            ins_increment_t increments[INS_CONING_SAMPLES_MAX];
            for (size_t i = 0; i < samples; i++)
            {
                increments[i] = increment(theta[k] + 3 * i, v[k] + 3 * i);
            }
            return ins_sculling_dv(form, increments, out[k]);
        });
    return out;
}

void bind_sculling(nb::module_& m)
{
    m.def("sculling_dv", sculling_dv, "form"_a, "theta_b"_a, "v_b"_a,
          "Velocity increment [m/s] in b at the interval's start, (3,) or (N, 3), from the increments a form reads, "
          "oldest first: "
          "angles [rad] and velocities [m/s], (n, 3) or (N, n, 3), n = coning_samples(form).");
    nb::class_<ins_sculling_t> sculling(
        m, "Sculling", "Attitude and velocity increments, coning and sculling corrected. Frame: b -> n.");
    sculling.def(
        "__init__",
        [](ins_sculling_t* self, int form, const Given& q_nb)
        {
            new (self) ins_sculling_t();
            const Call call("Sculling", "form CONING_ONE or one of CONING_HIST*, q_nb within 1e-3 of unit norm");
            call.check(ins_sculling_init(self, form, call.whole<ins_real>("q_nb", q_nb, {4}).data));
        },
        "form"_a, "q_nb"_a, "q_nb: (4,).");
    sculling.def(
        "step",
        [](ins_sculling_t& self, const Given& theta_b, const Given& v_b)
        {
            Call call("Sculling.step", "finite increments, each |component of theta_b| <= pi rad");
            const auto theta = call.rows<ins_real>("theta_b", theta_b, {3});
            const auto v = call.rows<ins_real>("v_b", v_b, {3});
            const auto q = call.out<ins_real>({4});
            const auto dv = call.out<ins_real>({3});
            call.run(
                [&](size_t k)
                {
                    const ins_increment_t x = increment(theta[k], v[k]);
                    const ins_status_t status = ins_sculling_step(&self, &x, dv[k]);
                    std::copy(self.q_nb, self.q_nb + 4, q[k]);
                    return status;
                });
            return std::make_pair(q, dv);
        },
        "theta_b"_a, "v_b"_a,
        "Increments of angle [rad] and velocity [m/s], (3,) or (N, 3), to (q_nb after each, (4,) or (N, 4); specific "
        "force integrated "
        "in b at the interval's start [m/s], (3,) or (N, 3)).");
    writes(sculling, "q_nb", &ins_sculling_t::q_nb, {4}, "Attitude now, (4,); set it to keep the history alone.");
    copies(sculling);
}

/// Latitude, longitude, height as one sum: in double for either ins_real, so that the offset is not lost beside the anchor.
void sum(const ins_position_t& position, double* llh)
{
    for (int i = 0; i < 3; i++)
    {
        llh[i] = static_cast<double>(position.anchor[i]) + static_cast<double>(position.offset[i]);
    }
}

void bind_position(nb::module_& m)
{
    nb::class_<ins_position_t> position(
        m, "Position", "Latitude, longitude [rad] and height above WGS-84 [m], as an anchor and an offset.");
    position.def(
        "__init__",
        [](ins_position_t* self, const Given& anchor, const Given& offset)
        {
            const Call call("Position");
            const auto a = call.whole<ins_real>("anchor", anchor, {3});
            const auto o = call.whole<ins_real>("offset", offset, {3});
            new (self) ins_position_t();
            std::copy(a.data, a.data + 3, self->anchor);
            std::copy(o.data, o.data + 3, self->offset);
        },
        "anchor"_a, "offset"_a = nb::make_tuple(0, 0, 0), "anchor, offset: (3,) each.");
    reads(position, "anchor", &ins_position_t::anchor, {3}, "(3,) [rad, rad, m].");
    reads(position, "offset", &ins_position_t::offset, {3}, "(3,) [rad, rad, m].");
    position.def_prop_ro(
        "llh",
        [](const ins_position_t& self)
        {
            const auto out = made<double>({3});
            sum(self, out.data);
            return out;
        },
        "Their sum, (3,) in float64.");
    position.def(
        "difference",
        [](const ins_position_t& self, const ins_position_t& to)
        {
            const auto ned = made<ins_real>({3});
            ins_position_difference(&self, &to, ned.data);
            return ned;
        },
        "to"_a, "From here to another position, along meridian and parallel and down [m], (3,).");
    copies(position);
}

void bind_strapdown(nb::module_& m)
{
    m.attr("STRAPDOWN_PERIOD_MAX") = static_cast<double>(INS_STRAPDOWN_PERIOD_MAX);
    m.attr("STRAPDOWN_SPEED_MAX") = static_cast<double>(INS_STRAPDOWN_SPEED_MAX);
    m.attr("STRAPDOWN_COS_MIN") = static_cast<double>(INS_STRAPDOWN_COS_MIN);
    nb::class_<ins_strapdown_t> strapdown(
        m, "Strapdown", "Attitude, velocity and position from increments. Frame: b -> n (NED), WGS-84.");
    strapdown.def(
        "__init__",
        [](ins_strapdown_t* self, int form, double period_s, const Given& q_nb, const Given& v_n,
           const ins_position_t& position)
        {
            new (self) ins_strapdown_t();
            const Call call(
                "Strapdown",
                "form CONING_ONE or CONING_HIST*, 0 < period_s <= 1, unit q_nb, |v_n| <= 1e4 m/s, |height| <= "
                "1e6 m, |longitude| <= 2 pi, offset <= 1e-3 rad, latitude 1e-3 rad off the poles");
            const auto q = call.whole<ins_real>("q_nb", q_nb, {4});
            const auto v = call.whole<ins_real>("v_n", v_n, {3});
            call.check(ins_strapdown_init(self, form, as_real(period_s), q.data, v.data, &position));
        },
        "form"_a, "period_s"_a, "q_nb"_a, "v_n"_a, "position"_a, "q_nb: (4,). v_n: (3,) over ground [m/s].");
    strapdown.def(
        "step",
        [](ins_strapdown_t& self, const Given& theta_b, const Given& v_b)
        {
            Call call("Strapdown.step",
                      "finite increments, each |component of theta_b| <= pi rad, a way that stays off the poles");
            const auto theta = call.rows<ins_real>("theta_b", theta_b, {3});
            const auto dv = call.rows<ins_real>("v_b", v_b, {3});
            const auto q = call.out<ins_real>({4});
            const auto v = call.out<ins_real>({3});
            const auto llh = call.out<double>({3});
            call.run(
                [&](size_t k)
                {
                    const ins_increment_t x = increment(theta[k], dv[k]);
                    const ins_status_t status = ins_strapdown_step(&self, &x);
                    std::copy(self.sculling.q_nb, self.sculling.q_nb + 4, q[k]);
                    std::copy(self.v_n, self.v_n + 3, v[k]);
                    sum(self.position, llh[k]);
                    return status;
                });
            return std::make_tuple(q, v, llh);
        },
        "theta_b"_a, "v_b"_a,
        "Increments of angle [rad] and velocity [m/s], (3,) or (N, 3), to (q_nb, v_n [m/s], latitude, longitude [rad] "
        "and height [m]) "
        "after each: (4,), (3,), (3,) or (N, 4), (N, 3), (N, 3); the last always in float64.");
    strapdown.def(
        "point",
        [](const ins_strapdown_t& self, const Given& l_b, const Given& w_ib_b)
        {
            const Call call("Strapdown.point");
            const auto lever = call.whole<ins_real>("l_b", l_b, {3});
            const auto w = call.whole<ins_real>("w_ib_b", w_ib_b, {3});
            const auto v = made<ins_real>({3});
            ins_position_t position;
            ins_strapdown_point(&self, lever.data, w.data, v.data, &position);
            return std::make_pair(v, position);
        },
        "l_b"_a, "w_ib_b"_a,
        "Velocity over ground (3,) [m/s] and Position of a point at l_b (3,) [m] from the IMU, which turns with w_ib_b "
        "(3,) [rad/s].");
    strapdown.def_prop_ro(
        "q_nb", [](const ins_strapdown_t& self) { return copy_of<ins_real>(self.sculling.q_nb, {4}); },
        "Attitude now, (4,).");
    reads(strapdown, "v_n", &ins_strapdown_t::v_n, {3}, "Velocity over ground now, (3,) [m/s].");
    strapdown.def_ro("position", &ins_strapdown_t::position, nb::rv_policy::copy, "Position now.");
    copies(strapdown);
}

void bind_earth(nb::module_& m)
{
    m.attr("EARTH_RATE") = static_cast<double>(INS_EARTH_RATE);
    m.def(
        "earth_radii",
        [](const Given& sin_lat)
        {
            Call call("earth_radii");
            const auto s = call.rows<ins_real>("sin_lat", sin_lat, {});
            const auto out = call.out<ins_real>({2});
            call.run([&](size_t k) { ins_earth_radii(*s[k], out[k]); });
            return out;
        },
        "sin_lat"_a, "Radii of the meridian and of the prime vertical [m], (2,) or (N, 2).");
    m.def(
        "earth_gravity",
        [](const Given& sin_lat, const Given& height)
        {
            Call call("earth_gravity");
            const auto s = call.rows<ins_real>("sin_lat", sin_lat, {});
            const auto h = call.rows<ins_real>("height", height, {});
            const auto out = call.out<ins_real>({});
            call.run([&](size_t k) { *out[k] = ins_earth_gravity(*s[k], *h[k]); });
            return out;
        },
        "sin_lat"_a, "height"_a, "Normal gravity of WGS-84, down [m/s^2], at a height [m]: () or (N,).");
    m.def(
        "earth_rate",
        [](const Given& sin_lat, const Given& cos_lat)
        {
            Call call("earth_rate");
            const auto s = call.rows<ins_real>("sin_lat", sin_lat, {});
            const auto c = call.rows<ins_real>("cos_lat", cos_lat, {});
            const auto out = call.out<ins_real>({3});
            call.run([&](size_t k) { ins_earth_rate(*s[k], *c[k], out[k]); });
            return out;
        },
        "sin_lat"_a, "cos_lat"_a, "w_ie_n [rad/s] in NED, (3,) or (N, 3).");
    m.def(
        "earth_transport_rate",
        [](const Given& sin_lat, const Given& cos_lat, const Given& height, const Given& v_n)
        {
            Call call("earth_transport_rate");
            const auto s = call.rows<ins_real>("sin_lat", sin_lat, {});
            const auto c = call.rows<ins_real>("cos_lat", cos_lat, {});
            const auto h = call.rows<ins_real>("height", height, {});
            const auto v = call.rows<ins_real>("v_n", v_n, {3});
            const auto out = call.out<ins_real>({3});
            call.run([&](size_t k) { ins_earth_transport_rate(*s[k], *c[k], *h[k], v[k], out[k]); });
            return out;
        },
        "sin_lat"_a, "cos_lat"_a, "height"_a, "v_n"_a,
        "w_en_n [rad/s] in NED, (3,) or (N, 3), for a velocity v_n [m/s].");
}
} // namespace

void bind_navigation(nb::module_& m)
{
    bind_sculling(m);
    bind_position(m);
    bind_strapdown(m);
    bind_earth(m);
}

} // namespace libins
