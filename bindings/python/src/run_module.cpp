/// \file   run_module.cpp
/// \brief  The Python module libins._run: motions, gyros and runs, over the C libraries. SPDX-License-Identifier: MIT
#include "board_module.hpp"
#include "debug_module.hpp"
#include "ins/coning.h"
#include "net_module.hpp"
#include "observe_module.hpp"
#include "run.hpp"
#include "sixacc_module.hpp"
#include "states.hpp"
#include <memory>
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <stdexcept>

namespace nb = nanobind;
using namespace nb::literals;
using libins::Edge;
using libins::Motion;
using libins::Octet;
using libins::Report;
using libins::Run;
using libins::RunConfig;
using libins::Scan;
using libins::Scored;

namespace
{

std::vector<double> scored_row(const Scored& s)
{
    std::vector<double> row = {static_cast<double>(s.state.index), static_cast<double>(s.scan), s.t_s, s.age_s};
    row.insert(row.end(), s.error.begin(), s.error.end());
    row.insert(row.end(), s.estimate.begin(), s.estimate.end());
    row.insert(row.end(), s.euler.begin(), s.euler.end());
    row.insert(row.end(), std::begin(s.state.q_nb), std::end(s.state.q_nb));
    row.insert(row.end(), s.q_nb.begin(), s.q_nb.end());
    row.insert(row.end(), std::begin(s.state.w_ib_b), std::end(s.state.w_ib_b));
    for (const uint64_t value : {uint64_t{s.state.seq}, uint64_t{s.state.bridged}, uint64_t{s.state.status},
                                 s.state.used, s.state.missed, s.state.counts.accepted, s.state.counts.lost})
    {
        row.push_back(static_cast<double>(value));
    }
    row.insert(row.end(), s.more.begin(), s.more.end());
    return row;
}

nb::list names(std::initializer_list<const char*> columns)
{
    nb::list list;
    for (const char* column : columns)
    {
        list.append(column);
    }
    return list;
}

} // namespace

nb::tuple libins::states_table(const std::vector<Scored>& states)
{
    std::vector<double> values;
    nb::list raw;
    const size_t columns = scored_row(states.empty() ? Scored() : states.front()).size();
    for (const Scored& state : states)
    {
        const std::vector<double> row = scored_row(state);
        values.insert(values.end(), row.begin(), row.end());
        raw.append(nb::bytes(&state.state, sizeof state.state));
    }
    return nb::make_tuple(table(states.size(), columns, std::move(values)), raw);
}

void libins::put_counts(nb::dict& d, const ins_nav_counts_t& counts)
{
    d["accepted"] = counts.accepted;
    d["lost"] = counts.lost;
    d["invalid"] = counts.invalid;
    d["duplicates"] = counts.duplicates;
    d["corrupt"] = counts.corrupt;
    d["timeouts"] = counts.timeouts;
    d["stray"] = counts.stray;
}

namespace
{

/// The edges themselves: nothing is copied.
nb::ndarray<nb::numpy, int64_t, nb::ndim<2>> take_edges(Run& run)
{
    static_assert(sizeof(Edge) == 3 * sizeof(int64_t));
    auto* kept = new std::vector<Edge>(run.take_edges());
    const nb::capsule owner(kept, [](void* p) noexcept { delete static_cast<std::vector<Edge>*>(p); });
    return {reinterpret_cast<int64_t*>(kept->data()), {kept->size(), 3}, owner};
}

nb::ndarray<nb::numpy, double, nb::ndim<2>> scans(const Run& run)
{
    std::vector<double> values;
    const unsigned channels = run.channels();
    for (const Scan& scan : run.scans.kept)
    {
        for (unsigned i = 0; i < channels; i++)
        {
            values.push_back(static_cast<double>(scan.at[i]) * 1e-12);
        }
        values.insert(values.end(), scan.code.begin(), scan.code.begin() + channels);
    }
    return libins::table(run.scans.kept.size(), 2 * channels, std::move(values));
}

nb::dict counters(const Run& run)
{
    nb::dict d;
    d["instructions"] = mcs51_instructions(run.cpu());
    d["cycles"] = mcs51_cycle(run.cpu());
    d["interrupts"] = mcs51_interrupts(run.cpu());
    d["sampled"] = run.scans.size();
    libins::put_counts(d, run.counts());
    d["corrupt_accepted"] = run.corrupt_accepted();
    d["framing_errors"] = run.host_end().framing_errors;
    d["octets_received"] = run.host_end().octets_received;
    d["octets_sent"] = run.host_end().octets_sent;
    d["slots_inverted"] = run.slots_inverted()[0] + run.slots_inverted()[1];
    d["octets_swallowed"] = run.octets_swallowed()[0] + run.octets_swallowed()[1];
    return d;
}

ins_nav_config_t nav_config(double period_s, unsigned block_len, bool sequence, const std::string& form,
                            unsigned rate_order, const std::array<double, 3>& skew_s, const ins_gyro_config_t& gyro)
{
    static const std::vector<std::pair<std::string, int>> forms = {{"one", INS_CONING_ONE},
                                                                   {"hist1", INS_CONING_HIST1},
                                                                   {"hist2_fit", INS_CONING_HIST2_FIT},
                                                                   {"hist2_opt", INS_CONING_HIST2_OPT},
                                                                   {"hist3_fit", INS_CONING_HIST3_FIT},
                                                                   {"hist3_opt", INS_CONING_HIST3_OPT}};
    ins_nav_config_t cfg;
    ins_nav_config_default(&cfg);
    cfg.period_s = period_s;
    cfg.block_len = static_cast<uint8_t>(block_len);
    cfg.seq = sequence ? 1 : 0;
    cfg.rate_order = static_cast<uint8_t>(rate_order);
    for (const auto& [name, value] : forms)
    {
        cfg.form = name == form ? value : cfg.form;
    }
    for (unsigned i = 0; i < 3; i++)
    {
        cfg.delay_s[i] = skew_s[i];
        ins_gyro_scale(&gyro, i, 12, 0.0, 5.0, &cfg.lsb_rad_s[i], &cfg.null_code[i]);
    }
    return cfg;
}

} // namespace

nb::list libins::reports_list(const std::vector<Report>& reports)
{
    nb::list list;
    for (const Report& report : reports)
    {
        nb::dict d;
        d["kind"] = report.kind == EMU_GUEST_ERROR ? "guest_error" : "not_modelled";
        d["text"] = report.text;
        d["detail"] = report.detail;
        d["first_s"] = static_cast<double>(report.first) * 1e-12;
        d["count"] = report.count;
        list.append(d);
    }
    return list;
}

NB_MODULE(_run, m)
{
    m.doc() = "Deterministic runs of the acquisition board, fed from a known motion and scored against it.";
    m.attr("STATE_COLUMNS") = names(
        {"index",     "scan",      "t_s",       "age_s",         "error_roll_rad", "error_pitch_rad", "error_yaw_rad",
         "roll_rad",  "pitch_rad", "yaw_rad",   "true_roll_rad", "true_pitch_rad", "true_yaw_rad",    "q_w",
         "q_x",       "q_y",       "q_z",       "true_q_w",      "true_q_x",       "true_q_y",        "true_q_z",
         "w_x_rad_s", "w_y_rad_s", "w_z_rad_s", "seq",           "bridged",        "status",          "used",
         "missed",    "accepted",  "lost"});
    m.attr("SCAN_COLUMNS") = names({"x_s", "y_s", "z_s", "x_code", "y_code", "z_code"});
    nb::list wires;
    for (const char* wire : Run::traced)
    {
        wires.append(wire);
    }
    m.attr("WIRES") = wires;

    libins::bind_motions(m);
    nb::class_<ins_gyro_config_t>(m, "Gyro", "Three rate gyros with amplifiers; see ins_truth/gyro.h.")
        .def(
            "set",
            [](ins_gyro_config_t& self, const std::string& key, const std::array<double, 3>& values)
            {
                for (size_t i = 0; i < INS_GYRO_CHANNELS; i++)
                {
                    double ins_gyro_channel_t::*const member = key == "bandwidth_hz" ? &ins_gyro_channel_t::bandwidth_hz
                                                               : key == "noise_rad_s_rthz"
                                                                   ? &ins_gyro_channel_t::noise_density
                                                               : key == "bias_rad_s"   ? &ins_gyro_channel_t::bias
                                                               : key == "drift_rad_s2" ? &ins_gyro_channel_t::drift
                                                                                       : nullptr;
                    if (member == nullptr)
                    {
                        throw std::invalid_argument("a gyro has no " + key);
                    }
                    self.channel[i].*member = values[i];
                }
            },
            "key"_a, "values"_a)
        .def_rw("seed", &ins_gyro_config_t::seed);
    m.def("gyro_ideal",
          []
          {
              ins_gyro_config_t config;
              ins_gyro_default_config(&config);
              return config;
          });
    m.def("gyro_cg_l53",
          []
          {
              ins_gyro_config_t config;
              ins_gyro_cgl53_config(&config);
              return config;
          });

    nb::class_<ins_nav_config_t>(m, "Nav", "Receiver and navigator; see ins_nav/nav.h.");
    m.def("nav", nav_config, "period_s"_a, "block_len"_a, "sequence"_a, "form"_a, "rate_order"_a, "skew_s"_a, "gyro"_a);

    nb::class_<RunConfig> run_config(m, "RunConfig");
    run_config.def(nb::init<>())
        .def_prop_rw(
            "part", [](const RunConfig& self) { return libins::part_name(self.part); },
            [](RunConfig& self, const std::string& name) { self.part = libins::part_of(name); })
        .def_rw("code_octets", &RunConfig::code_octets)
        .def_rw("xdata_octets", &RunConfig::xdata_octets)
        .def_rw("crystal_hz", &RunConfig::crystal_hz)
        .def_rw("seed", &RunConfig::seed)
        .def_rw("baud", &RunConfig::baud)
        .def_rw("bit_error", &RunConfig::bit_error)
        .def_rw("octet_loss", &RunConfig::octet_loss)
        .def_rw("cuts_s", &RunConfig::cuts_s)
        .def_rw("nav", &RunConfig::nav)
        .def_rw("start_at_truth", &RunConfig::start_at_truth)
        .def_rw("trace", &RunConfig::trace)
        .def_rw("six", &RunConfig::six)
        .def_rw("listen", &RunConfig::listen)
        .def_rw("seen", &RunConfig::seen)
        .def_rw("scans_kept", &RunConfig::scans_kept)
        .def(
            "set_front_end",
            [](RunConfig& self, double sensor_hz, double sensor_damping, double amplifier_hz, double slew_v_s,
               double rc_s) { self.front_end = {sensor_hz, sensor_damping, amplifier_hz, slew_v_s, 0.0, 0.0, rc_s}; },
            "sensor_hz"_a, "sensor_damping"_a, "amplifier_hz"_a, "slew_v_s"_a, "rc_s"_a,
            "Stages between sensors and converter; see ins_truth/front_end.h.")
        .def(
            "add_signal",
            [](RunConfig& self, unsigned channel, const std::array<double, 4>& wave, const std::vector<double>& t_s,
               const std::vector<double>& volts) {
                self.signals[channel] = {wave, t_s, volts};
            },
            "channel"_a, "wave"_a, "t_s"_a, "volts"_a)
        .def(
            "add_segment",
            [](RunConfig& self, uint16_t address, const nb::bytes& octets) {
                self.image.push_back({address, std::string(octets.c_str(), octets.size())});
            },
            "address"_a, "octets"_a);

    nb::class_<Run> run(m, "Run", "See run.hpp.");
    libins::bind_board(run);
    libins::bind_faults(m, run);
    libins::bind_knobs(m, run);
    libins::bind_debug(m, run);
    run.def(
           "__init__",
           [](Run* self, const RunConfig& config, const Motion& motion, const ins_gyro_config_t& gyro)
           { new (self) Run(config, motion.handle, gyro); },
           "config"_a, "motion"_a, "gyro"_a)
        .def("until", &Run::until, "t_ps"_a, nb::call_guard<nb::gil_scoped_release>())
        .def_prop_ro("now_ps", &Run::now)
        .def_prop_ro("channels", &Run::channels)
        .def_prop_ro("motion", [](const Run& self) { return Motion{self.motion()}; })
        .def("take_states", [](Run& self) { return libins::states_table(self.take_states()); })
        .def("take_edges", take_edges)
        .def("take_octets",
             [](Run& self)
             {
                 std::string octets;
                 for (const Octet& octet : self.take_octets())
                 {
                     octets.push_back(static_cast<char>(octet.value));
                 }
                 return nb::bytes(octets.data(), octets.size());
             })
        .def(
            "send",
            [](Run& self, const nb::bytes& octets) { return self.send(std::string(octets.c_str(), octets.size())); },
            "octets"_a)
        .def("level", &Run::level, "wire"_a)
        .def("scans", scans, "Those that are kept.")
        .def("counters", counters)
        .def("reports", [](const Run& self) { return libins::reports_list(self.reports); });
    libins::bind_net(m);
    libins::bind_sixacc(m, run_config);
    libins::bind_observer(m);
}
