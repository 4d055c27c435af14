/// \file   gimu_module.cpp
/// \brief  See gimu_module.hpp. SPDX-License-Identifier: MIT
#include "gimu_module.hpp"
#include "board_module.hpp"
#include "net_gimu.hpp"
#include "truth_bind.hpp"
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

using Rows = nb::ndarray<nb::numpy, int64_t, nb::ndim<2>>;

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
