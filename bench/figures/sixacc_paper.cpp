/// \file   sixacc_paper.cpp
/// \brief  Section 6 of Hung, Fang, Wang and Lee: the IMU of their table 6, calibrated, and the motion of figures 5 and 7 to 13. SI.
///
/// The paper prints neither the arm nor the period: 0.04 m, at which the errors of table 6 make the angular acceleration that its
/// figure 8 shows (more than 5 rad/s^2), and 1 ms. Readings are P = SF (b + row . f) with the rows of (13) and T = 1 s.
/// SPDX-License-Identifier: MIT
#include "figures.hpp"
#include "ins/quat.h"
#include "ins/sixacc.h"
#include "ins_calib/calib.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <string>

using figures::point;

namespace
{
constexpr double G = 9.81, RHO = 0.01, PERIOD_S = 1e-3, DURATION_S = 5, DRAWN_S = 0.25;
constexpr double DEG = 3.14159265358979323846 / 180;
constexpr double BIAS = 0.001 * G;                               ///< table 6, all six
constexpr double ANGLES_DEG[6] = {0.6, 0.5, 0.8, 0.7, 0.4, 0.8}; ///< table 6, both groups: xy xz yx yz zx zy
constexpr double ACCELERATION[3] = {9.81, 0, 0};                 ///< table 6, in i
constexpr double LEAST = 1e-17;                                  ///< an error of 0 on a logarithmic axis
const std::array<const char*, 6> ANGLES = {"xy", "xz", "yx", "yz", "zx", "zy"};

struct Group
{
    ins_calib_group_t group;
    const char* letter;
    std::array<int, 3> ids;
    std::array<double, 3> sf; ///< table 6
};
const Group GROUPS[] = {{INS_CALIB_146, "alpha", {1, 4, 6}, {0.5, 2.5, 2.5}},
                        {INS_CALIB_235, "beta", {2, 3, 5}, {2.5, 0.5, 2.5}}};

/// Reading = axis . f + bias, of the six by number less one.
using Sensors = std::array<ins_accel_t, 6>;

double reading(const ins_accel_t& a, const double f[3])
{
    return a.bias + a.axis[0] * f[0] + a.axis[1] * f[1] + a.axis[2] * f[2];
}

/// True sensors, what they are without calibration, and what (21) to (25) make of them: as angles, as a map.
struct Imu
{
    Sensors truth{}, nominal{}, by_angles{}, by_map{};
    std::array<double, 6> sf{};
};

void place(ins_accel_t& to, double sf, double bias, const double axis[3])
{
    to.bias = sf * bias;
    for (int i = 0; i < 3; i++)
    {
        to.axis[i] = sf * axis[i];
    }
}

Imu calibrated()
{
    Imu imu;
    for (Sensors* s : {&imu.truth, &imu.nominal, &imu.by_angles, &imu.by_map})
    {
        ins_sixacc_paper(RHO, s->data()); // places, and axes that are replaced below
    }
    double angles[6];
    std::transform(ANGLES_DEG, ANGLES_DEG + 6, angles, [](double deg) { return deg * DEG; });
    for (const Group& g : GROUPS)
    {
        double axes[9], attitudes[18], readings[INS_CALIB_PAPER_ROWS];
        ins_calib_paper_axes(g.group, angles, 1, axes);
        ins_calib_paper_attitudes(g.group, G, attitudes);
        for (size_t k = 0; k < 3; k++)
        {
            const auto id = static_cast<size_t>(g.ids[k] - 1);
            imu.sf[id] = g.sf[k];
            place(imu.truth[id], g.sf[k], BIAS, axes + 3 * k);
            const ins_accel_t paper = imu.nominal[id];
            place(imu.nominal[id], g.sf[k], 0, paper.axis);
            for (size_t pose = 0; pose < 6; pose++)
            {
                readings[6 * k + pose] = reading(imu.truth[id], attitudes + 3 * pose);
            }
        }
        ins_calib_paper_t found;
        char why[256];
        EXPECT_EQ(ins_calib_paper(g.group, G, 1, readings, &found, why, sizeof why), INS_CALIB_OK) << why;
        ins_calib_paper_axes(g.group, found.angle, 1, axes);
        for (size_t k = 0; k < 3; k++)
        {
            const auto id = static_cast<size_t>(g.ids[k] - 1);
            place(imu.by_angles[id], found.sf[k], found.bias[k], axes + 3 * k);
            imu.by_map[id].bias = found.map[k][0];
            std::copy(found.map[k] + 1, found.map[k] + 4, imu.by_map[id].axis);
            const std::string row = "#" + std::to_string(g.ids[k]);
            const double* a = imu.truth[id].axis;
            const double values[] = {found.sf[k], found.bias[k] / G,
                                     std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])};
            for (int i = 0; i < 3; i++)
            {
                point("table_sixacc_sf", row, i, values[i]);
            }
        }
        for (size_t i = 0; i < 6; i++)
        {
            point("table_sixacc_angles", std::string(g.letter) + "_" + ANGLES[i], 0, found.angle[i] / DEG);
        }
    }
    return imu;
}

using Calibration = std::pair<const char*, const Sensors*>;

/// Figures 5 and 7: what each calibration predicts less what the sensor reads, at rest in the attitude of the motion.
void outputs(const Imu& imu, const std::array<Calibration, 3>& calibrations, const double f[3])
{
    for (const auto& [name, sensors] : calibrations)
    {
        for (size_t id = 0; id < 6; id++)
        {
            const double error = (reading((*sensors)[id], f) - reading(imu.truth[id], f)) / imu.sf[id];
            point("sixacc_paper_outputs", name, static_cast<double>(id + 1), std::max(std::fabs(error), LEAST));
        }
    }
}

/// Figures 8 to 13: no turn, a constant acceleration; what the mechanisation makes of the readings.
void motion(const std::array<double, 6>& readings, const Calibration& calibration)
{
    const std::string name = calibration.first;
    ins_sixacc_t s;
    ASSERT_EQ(ins_sixacc_init(&s, 6, calibration.second->data(), PERIOD_S), INS_OK);
    double q[4] = {1, 0, 0, 0};
    const long steps = std::lround(DURATION_S / PERIOD_S), drawn = std::lround(DRAWN_S / PERIOD_S);
    for (long k = 0; k <= steps; k++)
    {
        ins_increment_t increment;
        ASSERT_GE(ins_sixacc_step(&s, readings.data(), &increment), 0);
        double dq[4], wd[3], f[3], a[3];
        ASSERT_EQ(ins_quat_from_rotvec(increment.theta_b, dq), INS_OK);
        ins_quat_mul(q, dq, q);
        ASSERT_EQ(ins_quat_normalise(q), INS_OK);
        ins_sixacc_resolve(&s, readings.data(), s.w_ib_b, wd, f);
        ins_quat_rotate(q, f, a);
        a[2] += G;
        if (k % drawn == 0)
        {
            for (size_t axis = 0; axis < 3; axis++)
            {
                const std::string curve = name + ", " + "xyz"[axis];
                const double error = std::fabs(a[axis] - ACCELERATION[axis]);
                point("sixacc_paper_angular", curve, PERIOD_S * static_cast<double>(k),
                      std::max(std::fabs(wd[axis]), LEAST));
                point("sixacc_paper_linear", curve, PERIOD_S * static_cast<double>(k), std::max(error, LEAST));
                if (k == steps)
                {
                    point("table_sixacc_motion", name, static_cast<double>(axis), std::fabs(wd[axis]));
                    point("table_sixacc_motion", name, static_cast<double>(3 + axis), error);
                }
            }
        }
    }
}
} // namespace

int main()
{
    const Imu imu = calibrated();
    const double f[3] = {ACCELERATION[0], ACCELERATION[1], ACCELERATION[2] - G};
    std::array<double, 6> readings{};
    std::transform(imu.truth.begin(), imu.truth.end(), readings.begin(),
                   [&](const ins_accel_t& a) { return reading(a, f); });
    const std::array<Calibration, 3> calibrations = {
        {{"none", &imu.nominal}, {"angles", &imu.by_angles}, {"map", &imu.by_map}}};
    outputs(imu, calibrations, f);
    for (const Calibration& calibration : calibrations)
    {
        motion(readings, calibration);
    }
    return testing::UnitTest::GetInstance()->Failed() ? 1 : 0;
}
