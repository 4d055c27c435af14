/// \file   truth_bind.cpp
/// \brief  See truth_bind.hpp. SPDX-License-Identifier: MIT
#include "truth_bind.hpp"
#include "ins_truth/exact.h"
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <optional>

namespace nb = nanobind;
using namespace nb::literals;

namespace libins
{
namespace
{

using Sine = std::array<double, 4>; // offset, amplitude, frequency_hz, phase

template <typename Create> Motion motion(Create create)
{
    std::array<char, 256> why{};
    ins_motion_t* made = create(why.data(), why.size());
    if (made == nullptr)
    {
        throw std::invalid_argument(why.data());
    }
    return {{made, ins_motion_destroy}};
}

ins_motion_sine_t sine(const Sine& s)
{
    return {s[0], s[1], s[2], s[3]};
}

using Speed = std::array<double, 5>; ///< speed [m/s], start_s, accelerate_s, cruise_s, brake_s
template <typename Create> Track track(const std::optional<Motion>& attitude, Create create)
{
    std::array<char, 256> why{};
    const std::shared_ptr<ins_motion_t> kept = attitude ? attitude->handle : nullptr;
    ins_track_t* const made = create(kept.get(), why.data(), why.size());
    if (made == nullptr)
    {
        throw std::invalid_argument(why.data());
    }
    return {{made, [kept](ins_track_t* gone) { ins_track_destroy(gone); }}};
}

ins_track_speed_t speed_of(const Speed& s)
{
    return {s[0], s[1], s[2], s[3], s[4]};
}

constexpr std::array<std::pair<const char*, ins_track_gravity_t>, 2> gravities = {
    {{"thesis", INS_TRACK_G_THESIS}, {"normal", INS_TRACK_G_NORMAL}}};
nb::dict track_at(const Track& self, double t)
{
    ins_track_state_t s;
    ins_track_geodetic_t g;
    ins_track_at(self.handle.get(), t, &s);
    ins_track_geodetic(self.handle.get(), t, &g);
    nb::dict d;
    d["p_n"] = copied(s.p_n);
    d["v_n"] = copied(s.v_n);
    d["a_n"] = copied(s.a_n);
    d["q_nb"] = copied(s.q_nb);
    d["w_ib_b"] = copied(s.w_ib_b);
    d["f_b"] = copied(s.f_b);
    d["llh"] = copied(g.llh);
    d["v_local"] = copied(g.v_n);
    d["q_local"] = copied(g.q_nb);
    return d;
}

using Column = std::pair<const char*, size_t>; ///< name, width

/// Columns of values, one row an instant, by name.
template <size_t n, typename Fill>
nb::dict tabulated(const Instants& t, const std::array<Column, n>& columns, Fill fill)
{
    nb::dict d;
    std::array<std::vector<double>, n> values;
    for (size_t k = 0; k < t.shape(0); k++)
    {
        fill(t(k), values);
    }
    for (size_t i = 0; i < n; i++)
    {
        d[columns[i].first] = table(t.shape(0), columns[i].second, std::move(values[i]));
    }
    return d;
}

template <size_t n> void append(std::vector<double>& to, const double (&values)[n])
{
    to.insert(to.end(), values, values + n);
}

nb::dict track_at_all(const Track& self, const Instants& t)
{
    constexpr std::array<Column, 9> columns = {{{"p_n", 3},
                                                {"v_n", 3},
                                                {"a_n", 3},
                                                {"q_nb", 4},
                                                {"w_ib_b", 3},
                                                {"f_b", 3},
                                                {"llh", 3},
                                                {"v_local", 3},
                                                {"q_local", 4}}};
    return tabulated(t, columns,
                     [&](double instant, std::array<std::vector<double>, 9>& values)
                     {
                         ins_track_state_t s;
                         ins_track_geodetic_t g;
                         ins_track_at(self.handle.get(), instant, &s);
                         ins_track_geodetic(self.handle.get(), instant, &g);
                         append(values[0], s.p_n);
                         append(values[1], s.v_n);
                         append(values[2], s.a_n);
                         append(values[3], s.q_nb);
                         append(values[4], s.w_ib_b);
                         append(values[5], s.f_b);
                         append(values[6], g.llh);
                         append(values[7], g.v_n);
                         append(values[8], g.q_nb);
                     });
}

nb::tuple track_increments(const Track& self, const Instants& t)
{
    if (t.shape(0) < 2)
    {
        throw std::invalid_argument("t: " + std::to_string(t.shape(0)) +
                                    " instants, give the 2 or more ends of increments");
    }
    const size_t rows = t.shape(0) - 1;
    std::vector<double> theta(3 * rows);
    std::vector<double> v(3 * rows);
    {
        const nb::gil_scoped_release other_threads;
        for (size_t k = 0; k < rows; k++)
        {
            ins_truth_increment(self.handle.get(), t(k), t(k + 1), &theta[3 * k], &v[3 * k]);
        }
    }
    return nb::make_tuple(table(rows, 3, std::move(theta)), table(rows, 3, std::move(v)));
}

template <auto member> auto get3()
{
    return [](const ins_gps_config_t& self) { return copied(self.*member); };
}

template <auto member> auto set3()
{
    return [](ins_gps_config_t& self, const std::array<double, 3>& values)
    { std::copy(values.begin(), values.end(), self.*member); };
}

} // namespace

void bind_motions(nb::module_& m)
{
    nb::class_<Motion>(m, "Motion", "A known rotation as a function of time; see ins_truth/motion.h.")
        .def(
            "euler",
            [](const Motion& self, double t)
            {
                std::array<double, 3> rpy{};
                ins_motion_euler(self.handle.get(), t, rpy.data());
                return rpy;
            },
            "t"_a, "Roll, pitch, yaw [rad] at t [s].")
        .def(
            "attitude",
            [](const Motion& self, double t)
            {
                std::array<double, 4> q{};
                ins_motion_attitude(self.handle.get(), t, q.data());
                return q;
            },
            "t"_a, "q_nb, scalar first, at t [s].")
        .def(
            "rate",
            [](const Motion& self, double t)
            {
                std::array<double, 3> w{};
                ins_motion_rate(self.handle.get(), t, w.data());
                return w;
            },
            "t"_a, "w_ib_b at t [rad/s].")
        .def(
            "span",
            [](const Motion& self)
            {
                std::array<double, 2> span{};
                ins_motion_span(self.handle.get(), &span[0], &span[1]);
                return span;
            },
            "First and last instant the motion is known for [s].");
    m.def(
        "motion_rate",
        [](const std::array<double, 3>& w_ib_b, double ramp_s)
        {
            const double level[4] = {1.0, 0.0, 0.0, 0.0};
            return motion([&](char* why, size_t n)
                          { return ins_motion_create_rate(w_ib_b.data(), level, ramp_s, why, n); });
        },
        "w_ib_b"_a, "ramp_s"_a);
    m.def(
        "motion_euler",
        [](const Sine& yaw, const Sine& pitch, const Sine& roll, double ramp_s)
        {
            const ins_motion_sines_t sines = {sine(yaw), sine(pitch), sine(roll)};
            return motion([&](char* why, size_t n) { return ins_motion_create_euler(&sines, ramp_s, why, n); });
        },
        "yaw"_a, "pitch"_a, "roll"_a, "ramp_s"_a);
    m.def(
        "motion_coning",
        [](double half_angle, double frequency_hz, double ramp_s)
        {
            return motion([&](char* why, size_t n)
                          { return ins_motion_create_coning(half_angle, frequency_hz, ramp_s, why, n); });
        },
        "half_angle"_a, "frequency_hz"_a, "ramp_s"_a);
    m.def(
        "motion_table",
        [](const std::vector<double>& t, const std::vector<double>& yaw, const std::vector<double>& pitch,
           const std::vector<double>& roll, double ramp_s)
        {
            if (yaw.size() != t.size() || pitch.size() != t.size() || roll.size() != t.size())
            {
                throw std::invalid_argument("t, yaw, pitch and roll must have the same length");
            }
            return motion(
                [&](char* why, size_t n) {
                    return ins_motion_create_table(t.size(), t.data(), yaw.data(), pitch.data(), roll.data(), ramp_s,
                                                   why, n);
                });
        },
        "t"_a, "yaw"_a, "pitch"_a, "roll"_a, "ramp_s"_a);
}

void bind_tracks(nb::module_& m)
{
    nb::class_<ins_track_site_t>(m, "Site",
                                 "Origin of a track; rad, m. gravity: thesis (9.8 m/s^2) or normal (WGS-84).")
        .def(
            "__init__",
            [](ins_track_site_t* self, double latitude, double longitude, double height, const std::string& gravity,
               bool rotating) {
                new (self)
                    ins_track_site_t{latitude, longitude, height, named("gravity", gravity, gravities), rotating};
            },
            "latitude"_a, "longitude"_a, "height"_a = 0.0, "gravity"_a = "thesis", "rotating"_a = false);
    nb::class_<Track>(m, "Track", "A known trajectory as a function of time; see ins_truth/track.h.")
        .def("at", track_at, "t"_a,
             "Position, velocity, acceleration, attitude, body rate, specific force in the site's n at t [s]; llh, "
             "v_local and q_local in the frame of where it is.")
        .def("at", track_at_all, "t"_a, "The same of many instants, one row each.")
        .def("increments", track_increments, "t"_a,
             "Integrals of w_ib_b [rad] and f_b [m/s] between each two of the instants t; see ins_truth/exact.h.");
    m.def(
        "track_still",
        [](const ins_track_site_t& site, const std::optional<Motion>& attitude)
        {
            return track(attitude, [&](const ins_motion_t* q, char* why, size_t n)
                         { return ins_track_create_still(&site, q, why, n); });
        },
        "site"_a, "attitude"_a.none() = nb::none());
    m.def(
        "track_line",
        [](const ins_track_site_t& site, double heading, double climb, const Speed& speed,
           const std::optional<Motion>& attitude)
        {
            const ins_track_speed_t way = speed_of(speed);
            return track(attitude, [&](const ins_motion_t* q, char* why, size_t n)
                         { return ins_track_create_line(&site, heading, climb, &way, q, why, n); });
        },
        "site"_a, "heading"_a, "climb"_a, "speed"_a, "attitude"_a.none() = nb::none());
    m.def(
        "track_circle",
        [](const ins_track_site_t& site, double heading, double radius, const Speed& speed,
           const std::optional<Motion>& attitude)
        {
            const ins_track_speed_t way = speed_of(speed);
            return track(attitude, [&](const ins_motion_t* q, char* why, size_t n)
                         { return ins_track_create_circle(&site, heading, radius, &way, q, why, n); });
        },
        "site"_a, "heading"_a, "radius"_a, "speed"_a, "attitude"_a.none() = nb::none());
    m.def(
        "track_eight",
        [](const ins_track_site_t& site, double heading, double length, double width, const Speed& speed,
           const std::optional<Motion>& attitude)
        {
            const ins_track_speed_t way = speed_of(speed);
            return track(attitude, [&](const ins_motion_t* q, char* why, size_t n)
                         { return ins_track_create_eight(&site, heading, length, width, &way, q, why, n); });
        },
        "site"_a, "heading"_a, "length"_a, "width"_a, "speed"_a, "attitude"_a.none() = nb::none());
    m.def(
        "track_waypoints",
        [](const ins_track_site_t& site, const std::vector<double>& t, const std::vector<double>& north,
           const std::vector<double>& east, const std::vector<double>& up, const std::optional<Motion>& attitude)
        {
            if (north.size() != t.size() || east.size() != t.size() || up.size() != t.size())
            {
                throw std::invalid_argument("t, north, east and up must have the same length");
            }
            return track(attitude,
                         [&](const ins_motion_t* q, char* why, size_t n) {
                             return ins_track_create_waypoints(&site, t.size(), t.data(), north.data(), east.data(),
                                                               up.data(), q, why, n);
                         });
        },
        "site"_a, "t"_a, "north"_a, "east"_a, "up"_a, "attitude"_a.none() = nb::none());
}

void bind_gps(nb::module_& m)
{
    using Gps = ins_gps_config_t;
    nb::class_<Gps>(m, "Gps", "A GPS receiver on a track; see ins_truth/gps.h.")
        .def_prop_rw(
            "period_s", [](const Gps& self) { return seconds(self.period_ps); },
            [](Gps& self, double s) { self.period_ps = picoseconds("period_s", s); })
        .def_prop_rw(
            "latency_s", [](const Gps& self) { return seconds(self.latency_ps); },
            [](Gps& self, double s) { self.latency_ps = picoseconds("latency_s", s); })
        .def_prop_rw("white_m", get3<&Gps::white>(), set3<&Gps::white>())
        .def_prop_rw("markov_m", get3<&Gps::markov>(), set3<&Gps::markov>())
        .def_prop_rw("velocity_m_s", get3<&Gps::velocity>(), set3<&Gps::velocity>())
        .def_rw("markov_tau_s", &Gps::markov_tau_s)
        .def_rw("sats", &Gps::sats)
        .def_rw("sats_spread", &Gps::sats_spread)
        .def_rw("sats_outage", &Gps::sats_outage)
        .def_rw("hdop", &Gps::hdop)
        .def_rw("first_fix_s", &Gps::first_fix_s)
        .def_rw("seed", &Gps::seed)
        .def(
            "set_outages",
            [](Gps& self, const std::vector<std::array<double, 2>>& windows)
            {
                if (windows.size() > INS_GPS_OUTAGES)
                {
                    throw std::invalid_argument("outages: " + std::to_string(windows.size()) + " windows, give " +
                                                std::to_string(INS_GPS_OUTAGES) + " at most");
                }
                self.outages = static_cast<unsigned>(windows.size());
                for (size_t i = 0; i < windows.size(); i++)
                {
                    self.outage[i] = {windows[i][0], windows[i][1]};
                }
            },
            "windows_s"_a, "No fix of an instant in one of [from, to).");
    m.def("gps_default",
          []
          {
              Gps config;
              ins_gps_default_config(&config);
              return config;
          });
    m.def("gps_ideal",
          []
          {
              Gps config;
              ins_gps_ideal_config(&config);
              return config;
          });
}

} // namespace libins
