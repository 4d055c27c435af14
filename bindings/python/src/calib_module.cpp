/// \file   calib_module.cpp
/// \brief  The Python module libins._calib over libins_calib: NumPy arrays of float64, one row a pose. SPDX-License-Identifier: MIT
#include "ins_calib/full.h"
#include "ins_calib/triad.h"
#include <array>
#include <memory>
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace nb = nanobind;
using namespace nb::literals;

namespace
{
using In = nb::ndarray<const double, nb::numpy, nb::c_contig, nb::device::cpu>;
using Out = nb::ndarray<double, nb::numpy, nb::c_contig>;

/// A new array that owns a copy.
Out array(const double* data, std::initializer_list<size_t> shape)
{
    size_t count = 1;
    for (const size_t length : shape)
    {
        count *= length;
    }
    auto copy = std::make_unique<double[]>(count);
    std::copy(data, data + count, copy.get());
    double* const raw = copy.release();
    return Out(raw, shape, nb::capsule(raw, [](void* p) noexcept { delete[] static_cast<double*>(p); }));
}

/// Shape (n, columns) or a ValueError that names the argument. \return n.
size_t rows(const In& given, const char* name, size_t columns)
{
    if (given.ndim() != 2 || given.shape(1) != columns)
    {
        throw std::invalid_argument(std::string(name) + ": an array of shape (n, " + std::to_string(columns) +
                                    ") is needed");
    }
    return given.shape(0);
}

/// Room for a reason, thrown as a ValueError.
struct Reason
{
    std::array<char, 2048> text{};
    void check(int status) const
    {
        if (status != INS_CALIB_OK)
        {
            throw std::invalid_argument(text.data());
        }
    }
};

nb::dict linear(const In& f_b, const In& readings)
{
    const size_t poses = rows(f_b, "f_b", 3);
    const size_t sensors = readings.ndim() == 2 ? readings.shape(1) : 0;
    if (rows(readings, "readings", sensors) != poses)
    {
        throw std::invalid_argument("readings: as many rows as f_b are needed");
    }
    std::vector<ins_calib_map_t> maps(sensors);
    std::vector<double> residuals(poses * sensors);
    Reason why;
    why.check(ins_calib_linear(sensors, poses, f_b.data(), readings.data(), maps.data(), residuals.data(),
                               why.text.data(), why.text.size()));
    std::vector<double> map, deviation, rms;
    for (const ins_calib_map_t& m : maps)
    {
        map.insert(map.end(), m.map, m.map + 4);
        deviation.insert(deviation.end(), m.deviation, m.deviation + 4);
        rms.push_back(m.rms);
    }
    nb::dict d;
    d["map"] = array(map.data(), {sensors, 4});
    d["deviation"] = array(deviation.data(), {sensors, 4});
    d["rms"] = array(rms.data(), {sensors});
    d["residual"] = array(residuals.data(), {poses, sensors});
    return d;
}

ins_calib_group_t group_of(int number)
{
    if (number != 235 && number != 146)
    {
        throw std::invalid_argument("group: 235 or 146 is needed, not " + std::to_string(number));
    }
    return number == 235 ? INS_CALIB_235 : INS_CALIB_146;
}

Out paper_attitudes(int group, double g)
{
    std::array<double, 18> f{};
    ins_calib_paper_attitudes(group_of(group), g, f.data());
    return array(f.data(), {6, 3});
}

Out paper_axes(int group, const In& angles, bool exact)
{
    if (angles.size() != 6)
    {
        throw std::invalid_argument("angles: the six xy, xz, yx, yz, zx, zy [rad] are needed");
    }
    std::array<double, 9> axes{};
    ins_calib_paper_axes(group_of(group), angles.data(), exact ? 1 : 0, axes.data());
    return array(axes.data(), {3, 3});
}

nb::dict paper(int group, double g, double T, const In& readings)
{
    if (rows(readings, "readings", 6) != 3)
    {
        throw std::invalid_argument("readings: three rows are needed, one an accelerometer of the group");
    }
    ins_calib_paper_t out;
    Reason why;
    why.check(ins_calib_paper(group_of(group), g, T, readings.data(), &out, why.text.data(), why.text.size()));
    nb::dict d;
    d["sf"] = array(out.sf, {3});
    d["bias"] = array(out.bias, {3});
    d["angles"] = array(out.angle, {6});
    d["H"] = array(out.H, {INS_CALIB_PAPER_ROWS, 9});
    d["map"] = array(out.map[0], {3, 4});
    d["residual"] = array(out.residual, {3, 6});
    return d;
}
constexpr size_t SENSOR_COLUMNS = 13; ///< u0, e1, e2, r0, sigma

nb::dict full(const In& sensors, const In& poses, const In& readings, double g, double fixture_rad,
              double robust_sigmas, unsigned fixed)
{
    const size_t count = rows(sensors, "sensors", SENSOR_COLUMNS);
    const size_t n = rows(poses, "poses", 9);
    if (rows(readings, "readings", count) != n)
    {
        throw std::invalid_argument("readings: as many rows as poses are needed");
    }
    std::vector<ins_calib_sensor_t> sensor(count);
    for (size_t j = 0; j < count; j++)
    {
        const double* const row = sensors.data() + SENSOR_COLUMNS * j;
        std::copy(row, row + 3, sensor[j].u0);
        std::copy(row + 3, row + 6, sensor[j].e1);
        std::copy(row + 6, row + 9, sensor[j].e2);
        std::copy(row + 9, row + 12, sensor[j].r0);
        sensor[j].sigma = row[12];
    }
    std::vector<ins_calib_pose_t> pose(n);
    for (size_t k = 0; k < n; k++)
    {
        const double* const row = poses.data() + 9 * k;
        std::copy(row, row + 3, pose[k].up);
        std::copy(row + 3, row + 6, pose[k].w);
        std::copy(row + 6, row + 9, pose[k].wd);
    }
    const size_t all = INS_CALIB_FULL_N * count;
    std::vector<double> p(all), covariance(all * all), attitude(3 * n), residual(n * count), condition(count);
    const ins_calib_full_t in = {count, n,           sensor.data(), pose.data(), readings.data(),
                                 g,     fixture_rad, robust_sigmas, fixed};
    ins_calib_full_result_t out{};
    out.p = p.data();
    out.covariance = covariance.data();
    out.attitude = attitude.data();
    out.residual = residual.data();
    out.condition = condition.data();
    Reason why;
    why.check(ins_calib_full(&in, &out, why.text.data(), why.text.size()));
    nb::dict d;
    d["p"] = array(p.data(), {count, INS_CALIB_FULL_N});
    d["covariance"] = array(covariance.data(), {all, all});
    d["attitude"] = array(attitude.data(), {n, 3});
    d["residual"] = array(residual.data(), {n, count});
    d["condition"] = array(condition.data(), {count});
    d["chi2"] = out.chi2;
    d["chi2_expected"] = out.chi2_expected;
    d["from_prior"] = out.from_prior;
    d["iterations"] = out.iterations;
    return d;
}
nb::dict axes(const ins_calib_axes_t& a)
{
    nb::dict d;
    d["matrix"] = array(a.matrix, {3, 3});
    d["bias"] = array(a.bias, {3});
    d["p"] = array(a.p, {INS_CALIB_TRIAD_N});
    d["covariance"] = array(a.covariance, {INS_CALIB_TRIAD_N, INS_CALIB_TRIAD_N});
    d["condition"] = a.condition;
    d["rms"] = a.rms;
    d["rms_scale"] = a.rms_scale;
    return d;
}

nb::dict triad(const In& accel, const std::optional<In>& gyro, double period_s, double g, double initial_s,
               double window_s, double gyro_scale, unsigned part, unsigned parts)
{
    const size_t samples = rows(accel, "accel", 3);
    if (gyro && rows(*gyro, "gyro", 3) != samples)
    {
        throw std::invalid_argument("gyro: as many rows as accel are needed");
    }
    const ins_calib_triad_t in = {
        samples, accel.data(), gyro ? gyro->data() : nullptr, period_s, g, initial_s, window_s, gyro_scale,
        part,    parts};
    ins_calib_triad_result_t out{};
    out.capacity = samples;
    std::vector<size_t> first(samples), last(samples);
    std::vector<double> residual(samples), angle(samples);
    out.first = first.data();
    out.last = last.data();
    out.residual = residual.data();
    out.angle = angle.data();
    Reason why;
    int status = 0;
    {
        const nb::gil_scoped_release release;
        status = ins_calib_triad(&in, &out, why.text.data(), why.text.size());
    }
    why.check(status);
    nb::list poses;
    for (size_t k = 0; k < out.poses; k++)
    {
        poses.append(nb::make_tuple(first[k], last[k]));
    }
    nb::dict d;
    d["accel"] = axes(out.accel);
    if (gyro)
    {
        d["gyro"] = axes(out.gyro);
        d["g_sensitivity"] = array(out.g_sensitivity, {3, 3});
        d["bias_rms"] = out.bias_rms;
        d["bias_rms_constant"] = out.bias_rms_constant;
        d["angle"] = array(angle.data(), {out.poses});
    }
    d["rms_raw"] = out.rms_raw;
    d["threshold"] = out.threshold;
    d["poses"] = poses;
    d["residual"] = array(residual.data(), {out.poses});
    return d;
}
} // namespace

NB_MODULE(_calib, m)
{
    m.doc() = "Calibration of accelerometers and of triads; see ins_calib/*.h. Refusals are ValueErrors.";
    m.def("linear", linear, "f_b"_a, "readings"_a,
          "Linear maps P = map[0] + map[1:] . f from specific force (n, 3) [m/s^2] and readings (n, sensors): "
          "{map (sensors, 4), deviation (sensors, 4), rms (sensors,), residual (n, sensors)}.");
    m.def("paper_attitudes", paper_attitudes, "group"_a, "g"_a,
          "Specific force (6, 3) in the attitudes of table 3 (group 235) or 4 (146).");
    m.def(
        "paper_axes", paper_axes, "group"_a, "angles"_a, "exact"_a = true,
        "Axes of sense (3, 3) of the group under the angles xy, xz, yx, yz, zx, zy [rad]: the printed product (13), or "
        "(14) to first order.");
    m.def("paper", paper, "group"_a, "g"_a, "T"_a, "readings"_a,
          "Equations 21 to 25 on readings (3, 6), P = SF T (b + axis . f): {sf, bias, angles, H, map, residual}.");
    m.attr("FULL_NAMES") = nb::make_tuple("b", "SF", "m1", "m2", "k2", "r_x", "r_y", "r_z");
    m.def("full", full, "sensors"_a, "poses"_a, "readings"_a, "g"_a, "fixture_rad"_a = 0.0, "robust_sigmas"_a = 0.0,
          "fixed"_a = 0U,
          "The full model. sensors: (n, 13) u0, e1, e2, r0 [m], sigma. poses: (k, 9) up, w [rad/s], wd [rad/s^2]. "
          "readings: (k, n). fixed: bits of FULL_NAMES that are not estimated. Gives {p (n, 8), covariance, attitude, "
          "residual, condition, chi2, chi2_expected, from_prior, iterations}.");
    m.attr("ACCEL_NAMES") =
        nb::make_tuple("alpha_yz", "alpha_zy", "alpha_zx", "s_x", "s_y", "s_z", "b_x", "b_y", "b_z");
    m.attr("GYRO_NAMES") =
        nb::make_tuple("gamma_yz", "gamma_zy", "gamma_xz", "gamma_zx", "gamma_xy", "gamma_yx", "s_x", "s_y", "s_z");
    m.def(
        "triad", triad, "accel"_a, "gyro"_a.none(), "period_s"_a, "g"_a, "initial_s"_a, "window_s"_a,
        "gyro_scale"_a = 0.0, "part"_a = 0U, "parts"_a = 1U,
        "A triad by still poses: accel (n, 3), gyro (n, 3) or None. Of every `parts` poses the part-th is used. Gives "
        "{accel, gyro: {matrix, bias, p, covariance, condition, rms, rms_scale}, rms_raw, threshold, bias_spread, "
        "poses, "
        "residual, angle}; see ins_calib/triad.h.");
}
