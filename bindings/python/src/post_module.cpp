/// \file   post_module.cpp
/// \brief  The Python module libins._post: replay of recordings through filters, and the smoother. SPDX-License-Identifier: MIT
#include "ins_post/gps_dr.hpp"
#include "ins_post/gps_ins.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace nb = nanobind;
using namespace nb::literals;

namespace
{
using Rows = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using Table = nb::ndarray<nb::numpy, double, nb::ndim<2>>;
using ins_post::Vec3;

const std::vector<const char*> INCREMENT_COLUMNS = {"t_s",     "period_s", "theta_x", "theta_y",
                                                    "theta_z", "v_x",      "v_y",     "v_z"};
const std::vector<const char*> FIX_COLUMNS = {"known_s",  "t_s",      "t_v_s",    "latitude", "longitude", "height",
                                              "sigma_n",  "sigma_e",  "sigma_d",  "v_n",      "v_e",       "v_d",
                                              "sigma_vn", "sigma_ve", "sigma_vd", "hdop",     "sats",      "withheld"};
const std::vector<const char*> WHEEL_COLUMNS = {"t_s", "period_s", "speed", "yaw_rate"};
const std::vector<const char*> STATE_COLUMNS = {"t_s",
                                                "latitude_rad",
                                                "longitude_rad",
                                                "height_m",
                                                "v_n_m_s",
                                                "v_e_m_s",
                                                "v_d_m_s",
                                                "q_w",
                                                "q_x",
                                                "q_y",
                                                "q_z",
                                                "bg_x_rad_s",
                                                "bg_y_rad_s",
                                                "bg_z_rad_s",
                                                "ba_x_m_s2",
                                                "ba_y_m_s2",
                                                "ba_z_m_s2",
                                                "sigma_phi_n_rad",
                                                "sigma_phi_e_rad",
                                                "sigma_phi_d_rad",
                                                "sigma_v_n_m_s",
                                                "sigma_v_e_m_s",
                                                "sigma_v_d_m_s",
                                                "sigma_n_m",
                                                "sigma_e_m",
                                                "sigma_d_m",
                                                "sigma_bg_x_rad_s",
                                                "sigma_bg_y_rad_s",
                                                "sigma_bg_z_rad_s",
                                                "sigma_ba_x_m_s2",
                                                "sigma_ba_y_m_s2",
                                                "sigma_ba_z_m_s2",
                                                "aided"};
const std::vector<const char*> CHECK_COLUMNS = {
    "t_s",         "dp_n_before", "dp_e_before", "dp_d_before", "dp_n_after", "dp_e_after", "dp_d_after",
    "dv_n_before", "dv_e_before", "dv_d_before", "dv_n_after",  "dv_e_after", "dv_d_after", "nis_n",
    "nis_e",       "nis_d",       "nis_vn",      "nis_ve",      "nis_vd",     "refused",    "withheld",
    "sigma_n",     "sigma_e",     "sigma_d",     "sigma_vn",    "sigma_ve",   "sigma_vd"};

const double* row(const Rows& rows, size_t i)
{
    return rows.data() + i * rows.shape(1);
}

Vec3 three(const double* at)
{
    return {at[0], at[1], at[2]};
}

void check_width(const Rows& rows, const std::vector<const char*>& columns, const char* what)
{
    if (rows.shape(1) != columns.size())
    {
        throw std::invalid_argument(std::string(what) + ": " + std::to_string(columns.size()) +
                                    " columns are needed, found " + std::to_string(rows.shape(1)));
    }
}

/// Increments first, wheels next, fixes last of one instant.
std::vector<ins_post::Event> merged(const Rows& increments, const Rows& wheels, const Rows& fixes)
{
    check_width(increments, INCREMENT_COLUMNS, "increments");
    check_width(wheels, WHEEL_COLUMNS, "wheels");
    check_width(fixes, FIX_COLUMNS, "fixes");
    std::vector<ins_post::Event> events;
    events.reserve(increments.shape(0) + wheels.shape(0) + fixes.shape(0));
    size_t w = 0;
    size_t f = 0;
    const auto before = [&](double t, bool with)
    {
        for (;;)
        {
            const double tw = w < wheels.shape(0) ? row(wheels, w)[0] : HUGE_VAL;
            const double tf = f < fixes.shape(0) ? row(fixes, f)[0] : HUGE_VAL;
            const double next = std::min(tw, tf);
            if (!(next < t || (with && next == t && next < HUGE_VAL)))
            {
                return;
            }
            if (tw <= tf)
            {
                const double* r = row(wheels, w++);
                events.push_back({r[0], ins_post::Wheels{r[1], r[2], r[3]}});
            }
            else
            {
                const double* r = row(fixes, f++);
                events.push_back(
                    {r[0], ins_post::Fix{r[1], r[2], three(r + 3), three(r + 6), three(r + 9), three(r + 12), r[15],
                                         static_cast<unsigned>(r[16]), r[17] != 0.0}});
            }
        }
    };
    for (size_t i = 0; i < increments.shape(0); i++)
    {
        const double* r = row(increments, i);
        before(r[0], false);
        events.push_back({r[0], ins_post::Increment{r[1], three(r + 2), three(r + 5)}});
    }
    before(HUGE_VAL, true);
    return events;
}

Table table(std::vector<double>&& values, size_t width)
{
    auto held = std::make_unique<std::vector<double>>(std::move(values));
    double* data = held->data();
    const size_t rows = held->size() / width;
    nb::capsule owner(held.release(), [](void* p) noexcept { delete static_cast<std::vector<double>*>(p); });
    return Table(data, {rows, width}, owner);
}

template <typename... Parts> void append(std::vector<double>& to, const Parts&... parts)
{
    (to.insert(to.end(), parts.begin(), parts.end()), ...);
}

Table state_table(const std::vector<ins_post::State>& states)
{
    std::vector<double> out;
    for (const ins_post::State& s : states)
    {
        out.push_back(s.t);
        append(out, s.position, s.v_n, s.q_nb, s.bias_g, s.bias_a, s.sigma_phi, s.sigma_v, s.sigma_p, s.sigma_bias_g,
               s.sigma_bias_a);
        out.push_back(s.aided ? 1.0 : 0.0);
    }
    return table(std::move(out), STATE_COLUMNS.size());
}

Table covariance_table(const std::vector<ins_post::State>& states)
{
    std::vector<double> out;
    for (const ins_post::State& s : states)
    {
        append(out, s.P);
    }
    return table(std::move(out), std::tuple_size<decltype(ins_post::State::P)>::value);
}

Table check_table(const std::vector<ins_post::Check>& checks)
{
    std::vector<double> out;
    for (const ins_post::Check& c : checks)
    {
        out.push_back(c.t);
        append(out, c.dp_before, c.dp_after, c.dv_before, c.dv_after, c.nis);
        out.push_back(static_cast<double>(c.refused));
        out.push_back(c.withheld ? 1.0 : 0.0);
        append(out, c.sigma);
    }
    return table(std::move(out), CHECK_COLUMNS.size());
}

void copy3(const Vec3& from, double* to)
{
    std::copy(from.begin(), from.end(), to);
}

/// A key that the settings do not have keeps the preset's value.
template <typename T> void take(const nb::dict& settings, const char* key, T& value)
{
    if (settings.contains(key))
    {
        value = nb::cast<T>(settings[key]);
    }
}

ins_gps_ins_config_t configuration(const nb::dict& settings)
{
    ins_gps_ins_config_t c;
    ins_gps_ins_config(&c);
    take(settings, "arw", c.sensors.arw);
    take(settings, "vrw", c.sensors.vrw);
    take(settings, "bg_sigma", c.sensors.bg_sigma);
    take(settings, "bg_tau", c.sensors.bg_tau);
    take(settings, "ba_sigma", c.sensors.ba_sigma);
    take(settings, "ba_tau", c.sensors.ba_tau);
    take(settings, "unseen_rate", c.unseen_rate);
    take(settings, "unseen_accel", c.unseen_accel);
    take(settings, "rate_max", c.rate_max);
    take(settings, "force_max", c.force_max);
    take(settings, "gap_max", c.gap_max);
    take(settings, "stuck", c.stuck);
    take(settings, "decimate", c.decimate);
    take(settings, "gnss_late", c.gnss_late);
    take(settings, "gate_position", c.gate_position);
    take(settings, "gate_velocity", c.gate_velocity);
    take(settings, "gate", c.gate);
    take(settings, "refused_max", c.refused_max);
    take(settings, "nhc", c.nhc);
    take(settings, "zupt", c.zupt);
    take(settings, "zaru", c.zaru);
    take(settings, "still_samples", c.still.samples);
    take(settings, "still_rate_sigma", c.still.rate_sigma);
    take(settings, "still_force_sigma", c.still.force_sigma);
    take(settings, "still_rate_mean", c.still.rate_mean);
    Vec3 lever{};
    take(settings, "antenna_b", lever);
    copy3(lever, c.antenna_b);
    lever = {};
    take(settings, "wheel_b", lever);
    copy3(lever, c.wheel_b);
    return c;
}

ins_post::GpsDr make_gps_dr(const std::string& kind, const nb::dict& settings, double uere_m)
{
    using Kind = ins_post::GpsDrKind;
    const std::vector<std::pair<std::string, Kind>> kinds = {
        {"ours", Kind::OURS}, {"printed", Kind::PAPER_PRINTED}, {"corrected", Kind::PAPER_CORRECTED}};
    const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const auto& each) { return each.first == kind; });
    if (found == kinds.end())
    {
        throw std::invalid_argument("GpsDr: kind '" + kind + "' is none of ours, printed, corrected");
    }
    ins_gps_dr_config_t c;
    ins_gps_dr_config_default(&c);
    take(settings, "tau_fix", c.tau_fix);
    take(settings, "sigma_bias", c.sigma_bias);
    take(settings, "sigma_scale", c.sigma_scale);
    return {c, {found->second, uere_m}};
}

nb::dict gps_dr_counts(const ins_post::GpsDr& filter)
{
    nb::dict d;
    d["fixes taken"] = filter.counts().fixes;
    d["seconds without a fix"] = filter.counts().no_fixes;
    d["fixes refused"] = filter.counts().refused;
    return d;
}

ins_gps_ins_start_t beginning(double t, const std::array<double, 4>& q_nb, const Vec3& v_n, const Vec3& position,
                              const Vec3& gyro_bias, const std::array<double, INS_KF15_N>& sigma)
{
    ins_gps_ins_start_t s{};
    s.t_ns = std::llround(t * 1e9);
    std::copy(q_nb.begin(), q_nb.end(), s.q_nb);
    copy3(v_n, s.v_n);
    copy3(position, s.position.anchor);
    copy3(gyro_bias, s.gyro_bias);
    std::copy(sigma.begin(), sigma.end(), s.sigma);
    return s;
}

nb::object scales(const ins_post::GpsIns& filter)
{
    const auto found = filter.scales();
    return found ? nb::object(nb::make_tuple(found->gyro, found->accel, found->sigma_gyro, found->sigma_accel))
                 : nb::none();
}

nb::dict counts(const ins_post::GpsIns& filter)
{
    nb::dict d;
    const ins_gps_ins_count_t& count = filter.count();
#define LIBINS_COUNT(name, text) d[text] = count.name;
    INS_GPS_INS_COUNT_LIST(LIBINS_COUNT)
#undef LIBINS_COUNT
    return d;
}
} // namespace

NB_MODULE(_post, m)
{
    m.doc() = "Recorded drives through filters; see ins_post/replay.hpp, ins_post/gps_ins.hpp.";
    m.attr("INCREMENT_COLUMNS") = INCREMENT_COLUMNS;
    m.attr("FIX_COLUMNS") = FIX_COLUMNS;
    m.attr("WHEEL_COLUMNS") = WHEEL_COLUMNS;
    m.attr("STATE_COLUMNS") = STATE_COLUMNS;
    m.attr("CHECK_COLUMNS") = CHECK_COLUMNS;
    nb::class_<ins_post::Filter>(m, "Filter", "What a replay feeds.");
    nb::class_<ins_post::GpsIns, ins_post::Filter>(m, "GpsIns", "The GPS/INS of ins/gps_ins.h.")
        .def(
            "__init__",
            [](ins_post::GpsIns* self, const nb::dict& settings, double t, const std::array<double, 4>& q_nb,
               const Vec3& v_n, const Vec3& position, const Vec3& gyro_bias,
               const std::array<double, INS_KF15_N>& sigma, double nhc_period_s, double wheels_sigma,
               double yaw_rate_sigma, double node_period_s)
            {
                ins_post::GpsInsOptions options{nhc_period_s, wheels_sigma, yaw_rate_sigma, node_period_s};
                take(settings, "scale_g", options.scale_g);
                take(settings, "scale_a", options.scale_a);
                new (self) ins_post::GpsIns(configuration(settings),
                                            beginning(t, q_nb, v_n, position, gyro_bias, sigma), options);
            },
            "settings"_a, "t_s"_a, "q_nb"_a, "v_n"_a, "position"_a, "gyro_bias"_a, "sigma"_a, "nhc_period_s"_a = 0.0,
            "wheels_sigma"_a = 0.1, "yaw_rate_sigma"_a = 0.01, "node_period_s"_a = 0.0,
            "settings: members of ins_gps_ins_config_t by name; the others keep their preset. scale_g, scale_a: "
            "standard deviations of scale factors; both 0 or not there: none.")
        .def("scales", scales, "(gyros, accelerometers, their standard deviations), three each; None: not estimated.")
        .def("counts", counts, "What was used and refused, by what it is.")
        .def(
            "smooth", [](const ins_post::GpsIns& self) { return state_table(ins_post::smooth(self.nodes())); },
            "States of all nodes from the whole run, (N, len(STATE_COLUMNS)); needs node_period_s.");
    nb::class_<ins_post::GpsDr, ins_post::Filter>(m, "GpsDr", "GPS and dead reckoning: ins/gps_dr.h, or the paper's.")
        .def(
            "__init__",
            [](ins_post::GpsDr* self, const std::string& kind, const nb::dict& settings, double uere_m)
            { new (self) ins_post::GpsDr(make_gps_dr(kind, settings, uere_m)); },
            "kind"_a, "settings"_a, "uere_m"_a,
            "kind: ours, printed, corrected; settings: members of ins_gps_dr_config_t; the others keep their preset.")
        .def("counts", gps_dr_counts, "What was used and refused, by what it is.");
    nb::class_<ins_post::Replay>(m, "Replay", "A filter and its events.")
        .def(
            "__init__",
            [](ins_post::Replay* self, ins_post::Filter& filter, const Rows& increments, const Rows& wheels,
               const Rows& fixes, double output_s)
            { new (self) ins_post::Replay(filter, merged(increments, wheels, fixes), output_s); },
            "filter"_a, "increments"_a, "wheels"_a, "fixes"_a, "output_s"_a, nb::keep_alive<1, 2>(),
            "Tables as INCREMENT_COLUMNS, WHEEL_COLUMNS and FIX_COLUMNS say, each in order of time.")
        .def("run", &ins_post::Replay::run, "t_s"_a, nb::call_guard<nb::gil_scoped_release>(), "Everything before t_s.")
        .def_prop_ro("done", &ins_post::Replay::done)
        .def_prop_ro("time_s", &ins_post::Replay::time, "Of the next event, or of the last.")
        .def_prop_ro(
            "states", [](const ins_post::Replay& self) { return state_table(self.states()); }, nb::rv_policy::move,
            "What the filter said, (N, len(STATE_COLUMNS)).")
        .def_prop_ro(
            "covariances", [](const ins_post::Replay& self) { return covariance_table(self.states()); },
            nb::rv_policy::move, "Upper triangles of P of attitude, velocity and position, (N, 45); 0: not known.")
        .def_prop_ro(
            "checks", [](const ins_post::Replay& self) { return check_table(self.checks()); }, nb::rv_policy::move,
            "Fixes beside the filter, (N, len(CHECK_COLUMNS)); dp and dv are filter less fix.");
}
