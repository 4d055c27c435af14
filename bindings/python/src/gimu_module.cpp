/// \file   gimu_module.cpp
/// \brief  See gimu_module.hpp. SPDX-License-Identifier: MIT
#include "gimu_module.hpp"
#include "board_module.hpp"
#include "net_gimu.hpp"
#include <cmath>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <stdexcept>

namespace nb = nanobind;
using namespace nb::literals;

namespace libins
{
namespace
{

using Speed = std::array<double, 5>; ///< speed [m/s], start_s, accelerate_s, cruise_s, brake_s
using Rows = nb::ndarray<nb::numpy, int64_t, nb::ndim<2>>;

/// With the attitude that it looks at.
struct Track
{
    std::shared_ptr<ins_track_t> handle;
};

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

/// The value whose name it is. Throws std::invalid_argument.
template <typename T, size_t n>
T named(const char* key, const std::string& name, const std::array<std::pair<const char*, T>, n>& names)
{
    std::string all;
    for (const auto& [known, value] : names)
    {
        if (name == known)
        {
            return value;
        }
        all += (all.empty() ? "" : " or ") + std::string(known);
    }
    throw std::invalid_argument(std::string(key) + ": found '" + name + "', but " + all + " is needed");
}

template <typename T, size_t n> const char* name_of(T value, const std::array<std::pair<const char*, T>, n>& names)
{
    for (const auto& [name, known] : names)
    {
        if (value == known)
        {
            return name;
        }
    }
    return "";
}

constexpr std::array<std::pair<const char*, ins_track_gravity_t>, 2> gravities = {
    {{"thesis", INS_TRACK_G_THESIS}, {"normal", INS_TRACK_G_NORMAL}}};
constexpr std::array<std::pair<const char*, gimu_order_t>, 2> orders = {
    {{"longitude", GIMU_LONGITUDE_FIRST}, {"latitude", GIMU_LATITUDE_FIRST}}};
constexpr std::array<std::pair<const char*, gimu_no_fix_t>, 2> without_fix = {
    {{"last", GIMU_HOLD_LAST}, {"zeros", GIMU_SEND_ZEROS}}};
constexpr std::array<std::pair<const char*, double gimu_channel_t::*>, 6> channel_keys = {
    {{"sensitivity", &gimu_channel_t::sensitivity},
     {"scale_error", &gimu_channel_t::scale_error},
     {"null_v", &gimu_channel_t::null_v},
     {"drift_v_s", &gimu_channel_t::drift_v_s},
     {"bandwidth_hz", &gimu_channel_t::bandwidth_hz},
     {"noise_density", &gimu_channel_t::noise_density}}};

double seconds(int64_t ps)
{
    return static_cast<double>(ps) * 1e-12;
}

int64_t picoseconds(const char* key, double s)
{
    if (!(s >= 0.0 && s <= 1e6))
    {
        throw std::invalid_argument(std::string(key) + ": 0 to 1e6 s is needed");
    }
    return static_cast<int64_t>(std::floor(s * 1e12 + 0.5));
}

template <size_t n> std::array<double, n> copied(const double (&values)[n])
{
    std::array<double, n> out{};
    std::copy(values, values + n, out.begin());
    return out;
}

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
             "v_local and q_local in the frame of where it is.");
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

template <auto member> auto get3()
{
    return [](const ins_gps_config_t& self) { return copied(self.*member); };
}

template <auto member> auto set3()
{
    return [](ins_gps_config_t& self, const std::array<double, 3>& values)
    { std::copy(values.begin(), values.end(), self.*member); };
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

void bind_part(nb::module_& m)
{
    using Gimu = gimu_config_t;
    nb::class_<Gimu>(m, "Gimu", "The thesis's sensor; see emu_f2812/gimu_part.h.")
        .def(
            "set",
            [](Gimu& self, const std::string& key, const std::array<double, GIMU_CHANNELS>& values)
            {
                const auto member = named("channel", key, channel_keys);
                for (size_t i = 0; i < GIMU_CHANNELS; i++)
                {
                    self.channel[i].*member = values[i];
                }
            },
            "key"_a, "values"_a, "One figure of P, Q, R, AX, AY, AZ.")
        .def(
            "get",
            [](const Gimu& self, const std::string& key)
            {
                const auto member = named("channel", key, channel_keys);
                std::array<double, GIMU_CHANNELS> values{};
                for (size_t i = 0; i < GIMU_CHANNELS; i++)
                {
                    values[i] = self.channel[i].*member;
                }
                return values;
            },
            "key"_a)
        .def(
            "set_axes",
            [](Gimu& self, const std::array<std::array<double, 3>, GIMU_CHANNELS>& axes)
            {
                for (size_t i = 0; i < GIMU_CHANNELS; i++)
                {
                    std::copy(axes[i].begin(), axes[i].end(), self.channel[i].axis);
                }
            },
            "axes"_a, "Sensitive axes in b.")
        .def_rw("vcc_v", &Gimu::vcc_v)
        .def_prop_rw(
            "power_up_s", [](const Gimu& self) { return seconds(self.power_up); },
            [](Gimu& self, double s) { self.power_up = picoseconds("power_up_s", s); })
        .def_rw("baud", &Gimu::baud)
        .def_rw("clock_ppb", &Gimu::clock_ppb)
        .def_prop_rw(
            "order", [](const Gimu& self) { return name_of(self.order, orders); },
            [](Gimu& self, const std::string& name) { self.order = named("order", name, orders); })
        .def_prop_rw(
            "no_fix", [](const Gimu& self) { return name_of(self.no_fix, without_fix); },
            [](Gimu& self, const std::string& name) { self.no_fix = named("no_fix", name, without_fix); })
        .def_rw("nmea_baud", &Gimu::nmea_baud)
        .def_prop_rw(
            "nmea_delay_s", [](const Gimu& self) { return seconds(self.nmea_delay); },
            [](Gimu& self, double s) { self.nmea_delay = picoseconds("nmea_delay_s", s); })
        .def_rw("geoid_m", &Gimu::geoid_m)
        .def_rw("utc_s", &Gimu::utc_s)
        .def_rw("seed", &Gimu::seed);
    m.def("gimu_ideal",
          []
          {
              Gimu config;
              gimu_default_config(&config);
              return config;
          });
    m.def("gimu_thesis",
          []
          {
              Gimu config;
              gimu_thesis_config(&config);
              return config;
          });
    m.attr("GIMU_COLUMNS") = nb::make_tuple("packet", "t_ps", "p", "q", "r", "ax", "ay", "az");
}

Rows take_samples(Net& net, const std::string& station)
{
    auto* const values = new std::vector<int64_t>;
    const nb::capsule owner(values, [](void* p) noexcept { delete static_cast<std::vector<int64_t>*>(p); });
    constexpr size_t columns = 2 + GIMU_CHANNELS;
    for (const GimuSample& sample : net.get<GimuStation>(station).take_samples())
    {
        values->insert(values->end(), {static_cast<int64_t>(sample.packet), sample.at});
        values->insert(values->end(), sample.raw.begin(), sample.raw.end());
    }
    return {values->data(), {values->size() / columns, columns}, owner};
}

} // namespace

void bind_truth(nb::module_& module)
{
    bind_tracks(module);
    bind_gps(module);
    bind_part(module);
}

void bind_gimu(nb::class_<Net>& net)
{
    net.def(
           "gimu",
           [](Net& self, const std::string& name, const gimu_config_t& config, const Track& on,
              const std::optional<ins_gps_config_t>& gps)
           { self.add(std::make_unique<GimuStation>(name, config, on.handle, gps)); },
           "name"_a, "config"_a, "track"_a, "gps"_a.none() = nb::none(),
           "The thesis's sensor: packets on port T, NMEA on port R. Without gps never a fix.")
        .def("take_samples", take_samples, "gimu"_a, "Samples of each packet since the last call; see GIMU_COLUMNS.")
        .def(
            "gimu_counters",
            [](Net& self, const std::string& station)
            {
                const gimu_t& part = self.get<GimuStation>(station).part();
                nb::dict d;
                d["packets"] = part.packets;
                d["sentences"] = part.sentences;
                d["clipped"] = part.clipped;
                d["octets"] = part.t.octets_sent;
                return d;
            },
            "gimu"_a);
}

} // namespace libins
