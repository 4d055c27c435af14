/// \file   sixacc_module.cpp
/// \brief  See sixacc_module.hpp. SPDX-License-Identifier: MIT
#include "sixacc_module.hpp"
#include "truth_bind.hpp"
#include <algorithm>
#include <array>
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

constexpr double ref_v[2] = {0.0, 5.0}; ///< of the board's converter
constexpr double null_code = 2048.0;
constexpr unsigned count = INS_NAV_CHANNELS;
constexpr std::array<std::pair<const char*, double ins_accel_channel_t::*>, 4> keys = {
    {{"bias_m_s2", &ins_accel_channel_t::bias},
     {"scale_error", &ins_accel_channel_t::scale_error},
     {"quadratic_s2_m", &ins_accel_channel_t::quadratic},
     {"noise_m_s2", &ins_accel_channel_t::noise}}};
using Vectors = std::array<std::array<double, 3>, count>;

template <auto member> void set_vectors(ins_accel_config_t& self, const Vectors& values)
{
    for (size_t j = 0; j < count; j++)
    {
        std::copy(values[j].begin(), values[j].end(), self.channel[j].*member);
    }
}

template <auto member> Vectors get_vectors(const ins_accel_config_t& self)
{
    Vectors values{};
    for (size_t j = 0; j < count; j++)
    {
        std::copy_n(self.channel[j].*member, 3, values[j].begin());
    }
    return values;
}

void set(ins_accel_config_t& self, const std::string& key, const std::array<double, count>& values)
{
    for (const auto& [name, member] : keys)
    {
        if (key == name)
        {
            for (size_t j = 0; j < count; j++)
            {
                self.channel[j].*member = values[j];
            }
            return;
        }
    }
    throw std::invalid_argument("an accelerometer has no " + key);
}

/// filter: its figures in the order of ins_gyro_free_config_t. still: for how long, and how still [s, m/s, rad/s]. The navigator takes
/// the accelerometers for what `accels` says but for their noise.
void init_nav(SixConfig* self, const ins_nav_config_t& nav, const ins_accel_config_t& accels, double lsb_m_s2,
              const std::array<double, count>& delay_s, const std::array<double, 10>& filter,
              const std::array<double, 3>& still, uint64_t seed)
{
    new (self) SixConfig();
    self->seed = seed;
    self->nav.link = nav;
    self->nav.link.channels = count;
    std::copy(delay_s.begin(), delay_s.end(), self->nav.link.delay_s);
    self->nav.lsb_m_s2 = lsb_m_s2;
    self->nav.null_code = null_code;
    for (size_t j = 0; j < count; j++)
    {
        ins_accel_t& taken = self->nav.accels[j];
        taken.bias = accels.channel[j].bias;
        for (size_t i = 0; i < 3; i++)
        {
            taken.axis[i] = (1.0 + accels.channel[j].scale_error) * accels.channel[j].axis[i];
            taken.r[i] = accels.channel[j].r[i];
        }
    }
    self->nav.filter = {filter[0], filter[1], filter[2], {filter[3], filter[4], filter[5]},
                        filter[6], filter[7], filter[8], filter[9]};
    self->nav.still_s = still[0];
    self->nav.still_m_s = still[1];
    self->nav.still_rad_s = still[2];
}

} // namespace

void bind_sixacc(nb::module_& m, nb::class_<RunConfig>& config)
{
    nb::list columns;
    for (const char* what : {"_s", "_code"})
    {
        for (unsigned i = 0; i < count; i++)
        {
            columns.append("a" + std::to_string(i + 1) + what);
        }
    }
    m.attr("SIX_SCAN_COLUMNS") = columns;
    nb::class_<ins_accel_config_t>(m, "Accels", "Six accelerometers at lever arms; see ins_truth/accel.h.")
        .def("set", set, "key"_a, "values"_a, "bias_m_s2, scale_error, quadratic_s2_m or noise_m_s2 of each.")
        .def_prop_rw("axis", get_vectors<&ins_accel_channel_t::axis>, set_vectors<&ins_accel_channel_t::axis>)
        .def_prop_rw("place_m", get_vectors<&ins_accel_channel_t::r>, set_vectors<&ins_accel_channel_t::r>)
        .def_rw("turn_on_m_s2", &ins_accel_config_t::turn_on)
        .def_rw("seed", &ins_accel_config_t::seed);
    m.def(
        "accels_paper",
        [](double rho_m, double range_m_s2)
        {
            ins_accel_config_t paper;
            ins_accel_paper_config(&paper, rho_m, range_m_s2, ref_v[0], ref_v[1]);
            return paper;
        },
        "rho_m"_a, "range_m_s2"_a, "Table 1 of Hung, Fang, Wang and Lee; +-range over the converter's 0 to 5 V.");
    m.attr("SIX_COLUMNS") =
        nb::cast(std::vector<std::string>(SixNavigator::columns.begin(), SixNavigator::columns.end()));
    nb::class_<SixConfig>(m, "SixNav", "Receiver and navigator of six accelerometers; see ins_nav/six.h.")
        .def("__init__", init_nav, "nav"_a, "accels"_a, "lsb_m_s2"_a, "delay_s"_a, "filter"_a, "still"_a, "seed"_a)
        .def_rw("gps", &SixConfig::gps)
        .def_rw("gps_sigma_m", &SixConfig::gps_sigma_m);
    config.def(
        "set_six_nav",
        [](RunConfig& self, const SixConfig& six)
        {
            self.nav = six.nav.link;
            self.six_nav = six;
        },
        "six"_a);
    config.def(
        "set_accels",
        [](RunConfig& self, const ins_accel_config_t& accels, const Track& track)
        {
            self.accels = accels;
            self.track = track.handle;
        },
        "accels"_a, "track"_a);
}

} // namespace libins
