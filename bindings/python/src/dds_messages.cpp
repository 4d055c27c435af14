/// \file   dds_messages.cpp
/// \brief  Of libins._dds: status, innovations and raw IMU samples from Python. NaN: not known. SPDX-License-Identifier: MIT
#include "dds_module.hpp"
#include <cmath>
#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

namespace nb = nanobind;
using namespace nb::literals;

namespace
{
const std::array<const char*, 8> measured = {INS_DDS_MEASURED_LIST(INS_DDS_TEXT)};
const std::array<const char*, 4> verdicts = {INS_DDS_VERDICT_LIST(INS_DDS_TEXT)};

void publish_innovations(Handle& handle, int64_t time_ns, const std::string& clock, const std::string& kind,
                         const std::string& verdict, const std::vector<double>& innovation,
                         const std::vector<double>& sigma, double nis, const std::string& source, int64_t published_ns)
{
    ins_dds_innovations_t to{};
    if (innovation.empty() || innovation.size() > 3 || sigma.size() != innovation.size())
    {
        throw std::invalid_argument("an innovation has 1 to 3 components, and as many deviations");
    }
    to.time_ns = time_ns;
    to.time_base = number(clocks, clock);
    to.kind = number(measured, kind);
    to.verdict = number(verdicts, verdict);
    to.size = static_cast<uint32_t>(innovation.size());
    std::copy(innovation.begin(), innovation.end(), to.innovation);
    std::copy(sigma.begin(), sigma.end(), to.sigma);
    to.nis = nis;
    checked(ins_dds_publish_innovations(handle.get(), &to, source.c_str(), published_ns));
}

void publish_raw_imu(Handle& handle, int64_t time_ns, const std::string& clock, uint64_t index, double t_s, double dt_s,
                     bool increments, const std::array<double, 3>& gyro_b, const std::array<double, 3>& accel_b,
                     const std::string& source, int64_t published_ns)
{
    ins_dds_raw_imu_t to{};
    to.time_ns = time_ns;
    to.time_base = number(clocks, clock);
    to.increments = increments ? 1 : 0;
    to.index = index;
    to.t_s = t_s;
    to.dt_s = dt_s;
    std::copy(gyro_b.begin(), gyro_b.end(), to.gyro_b);
    std::copy(accel_b.begin(), accel_b.end(), to.accel_b);
    to.temperature_k = std::nan("");
    checked(ins_dds_publish_raw_imu(handle.get(), &to, source.c_str(), published_ns));
}

/// Mode and deviations follow from the navigation. refused: of positions, of velocities, since the start.
void publish_status(Handle& handle, const ins_navigation_t& navigation, bool aided, bool alert, double fix_age_s,
                    uint64_t fixes, const std::array<uint64_t, 2>& refused, uint64_t published,
                    const std::string& source, int64_t published_ns)
{
    ins_dds_status_t to;
    ins_dds_status_from_navigation(&navigation, &to);
    to.mode = aided ? to.mode : static_cast<uint32_t>(INS_DDS_MODE_DEAD_RECKONING);
    to.alerts = alert ? INS_DDS_ALERT_REFUSED : 0;
    to.fix_age_s = fix_age_s;
    to.fixes = fixes;
    to.position_refused = refused[0];
    to.velocity_refused = refused[1];
    to.published = published;
    checked(ins_dds_publish_status(handle.get(), &to, source.c_str(), published_ns));
}
} // namespace

void bind_messages(nb::class_<Handle>& handle)
{
    handle
        .def("publish_innovations", publish_innovations, "time_ns"_a, "clock"_a, "kind"_a, "verdict"_a, "innovation"_a,
             "sigma"_a, "nis"_a, "source"_a, "published_ns"_a)
        .def("publish_raw_imu", publish_raw_imu, "time_ns"_a, "clock"_a, "index"_a, "t_s"_a, "dt_s"_a, "increments"_a,
             "gyro_b"_a, "accel_b"_a, "source"_a, "published_ns"_a)
        .def("publish_status", publish_status, "navigation"_a, "aided"_a, "alert"_a, "fix_age_s"_a, "fixes"_a,
             "refused"_a, "published"_a, "source"_a, "published_ns"_a);
}
