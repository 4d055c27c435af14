/// \file   sixacc_module.cpp
/// \brief  See sixacc_module.hpp. SPDX-License-Identifier: MIT
#include "sixacc_module.hpp"
#include "truth_bind.hpp"
#include <algorithm>
#include <array>
#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>
#include <stdexcept>

namespace nb = nanobind;
using namespace nb::literals;

namespace libins
{
namespace
{

constexpr double ref_v[2] = {0.0, 5.0}; ///< of the board's converter
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
