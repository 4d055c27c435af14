/// \file   truth_module.cpp
/// \brief  The Python module libins._truth: known motions and trajectories, GPS fixes, errors of an IMU. SPDX-License-Identifier: MIT
#include "ins_truth/imu.h"
#include "truth_bind.hpp"
#include "truth_body.hpp"
#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

namespace nb = nanobind;
using namespace nb::literals;
using libins::Instants;
using libins::Rows3;
using libins::table;
using libins::Track;

namespace
{

using Triad = ins_imu_triad_t;
using Config = ins_imu_config_t;

template <typename T, size_t n> nb::ndarray<nb::numpy, double> view(T& owner, double (&values)[n])
{
    return nb::ndarray<nb::numpy, double>(values, {n}, nb::find(owner));
}

/// A member with n numbers: reads as an array that writes through, takes n numbers or one for all.
template <auto member, typename Owner> void numbers(nb::class_<Owner>& c, const char* name)
{
    c.def_prop_rw(
        name, [](Owner& self) { return view(self, self.*member); },
        [name](Owner& self, const std::vector<double>& values)
        {
            const size_t n = sizeof(self.*member) / sizeof(double);
            if (values.size() != n)
            {
                throw std::invalid_argument(std::string(name) + ": " + std::to_string(values.size()) +
                                            " numbers, give " + std::to_string(n));
            }
            std::copy(values.begin(), values.end(), self.*member);
        });
}

void bind_config(nb::module_& m)
{
    nb::class_<Triad> triad(m, "Triad",
                            "Errors of three gyros or accelerometers; see ins_imu_triad_t in ins_truth/imu.h.");
    numbers<&Triad::bias>(triad, "bias");
    numbers<&Triad::turn_on>(triad, "turn_on");
    numbers<&Triad::scale>(triad, "scale");
    numbers<&Triad::misalignment>(triad, "misalignment");
    numbers<&Triad::random_walk>(triad, "random_walk");
    numbers<&Triad::bias_instability>(triad, "bias_instability");
    numbers<&Triad::rate_random_walk>(triad, "rate_random_walk");
    numbers<&Triad::markov>(triad, "markov");
    numbers<&Triad::bias_per_k>(triad, "bias_per_k");
    numbers<&Triad::scale_per_k>(triad, "scale_per_k");
    triad.def_rw("markov_tau_s", &Triad::markov_tau_s)
        .def_rw("quantum", &Triad::quantum)
        .def_rw("range", &Triad::range);
    nb::class_<Config> config(m, "ImuConfig", "No error until members are set; see ins_truth/imu.h.");
    config
        .def("__init__",
             [](Config* self)
             {
                 new (self) Config;
                 ins_imu_ideal_config(self);
             })
        .def_prop_ro(
            "gyro", [](Config& self) -> Triad& { return self.gyro; }, nb::rv_policy::reference_internal)
        .def_prop_ro(
            "accel", [](Config& self) -> Triad& { return self.accel; }, nb::rv_policy::reference_internal)
        .def_rw("seed", &Config::seed);
    numbers<&Config::g_sensitivity>(config, "g_sensitivity");
}

ins_imu_t errors_of(const Config& config)
{
    std::array<char, 256> why{};
    ins_imu_t imu;
    if (!ins_imu_init(&imu, &config, why.data(), why.size()))
    {
        throw std::invalid_argument(why.data());
    }
    return imu;
}

/// \param[in] above_k  of each row, or one for all
nb::dict apply(ins_imu_t& self, const Rows3& theta, const Rows3& v, double dt_s, const std::vector<double>& above_k)
{
    const size_t rows = theta.shape(0);
    if (v.shape(0) != rows)
    {
        throw std::invalid_argument("theta has " + std::to_string(rows) + " rows and v " + std::to_string(v.shape(0)) +
                                    ", give as many of each");
    }
    if (!(dt_s > 0.0 && dt_s <= 1e6))
    {
        throw std::invalid_argument("dt_s: above 0 and up to 1e6 is needed");
    }
    if (above_k.size() != rows && above_k.size() != 1)
    {
        throw std::invalid_argument("above_k has " + std::to_string(above_k.size()) + " numbers, give " +
                                    std::to_string(rows) + " or one");
    }
    std::array<std::vector<double>, 4> out;
    out.fill(std::vector<double>(3 * rows));
    for (size_t k = 0; k < rows; k++)
    {
        ins_imu_apply(&self, dt_s, above_k[above_k.size() == 1 ? 0 : k], theta.data() + 3 * k, v.data() + 3 * k,
                      &out[0][3 * k], &out[1][3 * k]);
        std::copy(self.gyro.bias, self.gyro.bias + 3, &out[2][3 * k]);
        std::copy(self.accel.bias, self.accel.bias + 3, &out[3][3 * k]);
    }
    constexpr std::array<const char*, 4> names = {"theta", "v", "gyro_bias", "accel_bias"};
    nb::dict d;
    for (size_t i = 0; i < out.size(); i++)
    {
        d[names[i]] = table(rows, 3, std::move(out[i]));
    }
    return d;
}

void bind_errors(nb::module_& m)
{
    nb::class_<ins_imu_t>(m, "ImuErrors", "One IMU, stepped from sample to sample; see ins_truth/imu.h.")
        .def(
            "__init__", [](ins_imu_t* self, const Config& config) { new (self) ins_imu_t(errors_of(config)); },
            "config"_a)
        .def("apply", apply, "theta"_a, "v"_a, "dt_s"_a, "above_k"_a = std::vector<double>{0.0},
             "The next samples: exact increments of dt_s seconds in, and the temperature above that of calibration, "
             "one or one a row [K]; theta, v with errors and the true bias of each "
             "sample out.")
        .def_prop_ro("gyro_bias",
                     [](const ins_imu_t& self) {
                         return std::array<double, 3>{self.gyro.bias[0], self.gyro.bias[1], self.gyro.bias[2]};
                     })
        .def_prop_ro("accel_bias",
                     [](const ins_imu_t& self) {
                         return std::array<double, 3>{self.accel.bias[0], self.accel.bias[1], self.accel.bias[2]};
                     })
        .def_prop_ro("saturated", [](const ins_imu_t& self) { return self.gyro.saturated + self.accel.saturated; });
}

/// Of fixes first to first + count - 1.
nb::dict fixes(const ins_gps_config_t& config, const Track& track, int64_t first, size_t count)
{
    std::array<char, 256> why{};
    ins_gps_t gps;
    if (!ins_gps_init(&gps, &config, track.handle.get(), why.data(), why.size()))
    {
        throw std::invalid_argument(why.data());
    }
    std::vector<double> t;
    std::vector<double> valid;
    std::vector<double> llh;
    std::vector<double> v_n;
    std::vector<double> sats;
    for (size_t k = 0; k < count; k++)
    {
        ins_gps_fix_t fix;
        ins_gps_number(&gps, first + static_cast<int64_t>(k), &fix);
        t.push_back(libins::seconds(fix.of_ps));
        valid.push_back(fix.valid ? 1.0 : 0.0);
        llh.insert(llh.end(), fix.llh, fix.llh + 3);
        v_n.insert(v_n.end(), fix.v_n, fix.v_n + 3);
        sats.push_back(fix.sats);
    }
    nb::dict d;
    d["t"] = table(count, 1, std::move(t));
    d["valid"] = table(count, 1, std::move(valid));
    d["llh"] = table(count, 3, std::move(llh));
    d["v_n"] = table(count, 3, std::move(v_n));
    d["sats"] = table(count, 1, std::move(sats));
    return d;
}

} // namespace

NB_MODULE(_truth, m)
{
    m.doc() = "Known motions, trajectories and sensors; see docs/truth.md.";
    libins::bind_motions(m);
    libins::bind_tracks(m);
    libins::bind_gps(m);
    libins::bind_bodies(m);
    bind_config(m);
    bind_errors(m);
    m.def(
        "gps_fixes", fixes, "gps"_a, "track"_a, "first"_a, "count"_a,
        "Fixes number first, first + 1, ...: t [s], valid (1 or 0), llh [rad, rad, m], v_n [m/s], sats; one row each.");
}
