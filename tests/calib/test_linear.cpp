/// \file   test_linear.cpp
/// \brief  The linear map and the paper's estimator against the reference file, tables 6 and 7, and refusals. SI.
/// SPDX-License-Identifier: MIT
#include "calib_test.hpp"
#include "ins_calib/calib.h"
#include <limits>
using namespace calib_test;

namespace
{
const double TOL_MAP = 1e-12; // of the reference file, m/s^2 and reading per m/s^2
const double TOL_ESTIMATE = 1e-12;
const double TOL_ANGLE_RAD = 1e-11; // of the file's own solver
const double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();
const char* const ANGLES[] = {"xy", "xz", "yx", "yz", "zx", "zy"};

ins_calib_group_t group_of(const json& c)
{
    return c["group"] == "235" ? INS_CALIB_235 : INS_CALIB_146;
}

std::array<double, 6> angles_of(const json& c)
{
    std::array<double, 6> angle;
    for (size_t k = 0; k < 6; k++)
    {
        angle[k] = c[ANGLES[k]];
    }
    return angle;
}

std::array<double, INS_CALIB_PAPER_ROWS> readings_of(const json& c)
{
    std::array<double, INS_CALIB_PAPER_ROWS> P;
    for (size_t k = 0; k < P.size(); k++)
    {
        P[k] = c["P"][k / 6][k % 6];
    }
    return P;
}
} // namespace

TEST(vector_calib_linear, linear_map)
{
    const json file = load("calib_linear.json");
    Worst worst;
    Worst residual;
    for (const json& c : file["cases"])
    {
        std::array<double, 18> f;
        ins_calib_paper_attitudes(group_of(c), c["g"], f.data());
        const auto P = readings_of(c);
        std::array<double, 18> readings;
        for (size_t k = 0; k < 18; k++)
        {
            readings[k] = P[k % 3 * 6 + k / 3] / c["T"].get<double>();
        }
        ins_calib_map_t maps[3];
        std::array<double, 18> rest;
        Reason why;
        ASSERT_EQ(ins_calib_linear(3, 6, f.data(), readings.data(), maps, rest.data(), why.text, sizeof why.text), 0)
            << why.text;
        for (size_t j = 0; j < 3; j++)
        {
            const double bias = c["true"]["bias"][j].get<double>() * c["true"]["SF"][j].get<double>();
            worst.take(maps[j].map[0], bias, 1, "bias");
            for (size_t i = 0; i < 3; i++)
            {
                worst.take(maps[j].map[1 + i], c["true_map"][j][i], 1, "axis");
            }
            residual.take(maps[j].rms, 0, 1, "rms");
        }
        for (const double e : rest)
        {
            residual.take(e, 0, 1, "residual");
        }
    }
    expect_within(worst, TOL_MAP, "linear map");
    expect_within(residual, TOL_MAP, "residuals of the linear map, in units of the reading");
}

TEST(vector_calib_linear, estimator_of_the_paper)
{
    const json file = load("calib_linear.json");
    Worst attitudes;
    Worst model;
    Worst estimate;
    Worst angles;
    Worst map;
    Worst matrix;
    for (const json& c : file["cases"])
    {
        std::array<double, 18> f;
        ins_calib_paper_attitudes(group_of(c), c["g"], f.data());
        const json& rows = file["attitudes"][c["group"].get<std::string>()];
        for (size_t k = 0; k < 18; k++)
        {
            attitudes.take(f[k], rows[k / 3][k % 3].get<double>() * c["g"].get<double>(), 1, "attitude");
        }
        std::array<double, 9> axes;
        ins_calib_paper_axes(group_of(c), angles_of(c["true"]["angles_rad"]).data(), c["model"] == "exact",
                             axes.data());
        for (size_t k = 0; k < 9; k++)
        {
            model.take(axes[k] * c["true"]["SF"][k / 3].get<double>(), c["true_map"][k / 3][k % 3], 1, "axis");
        }
        ins_calib_paper_t out;
        Reason why;
        ASSERT_EQ(ins_calib_paper(group_of(c), c["g"], c["T"], readings_of(c).data(), &out, why.text, sizeof why.text),
                  0)
            << why.text;
        const auto want = angles_of(c["est"]["angles_rad"]);
        for (size_t k = 0; k < 6; k++)
        {
            angles.take(out.angle[k], want[k], 1, ANGLES[k]);
        }
        for (size_t j = 0; j < 3; j++)
        {
            estimate.take(out.sf[j], c["est"]["SF"][j], 1, "SF");
            estimate.take(out.bias[j], c["est"]["bias"][j], 1, "bias");
            for (size_t i = 0; i < 3; i++)
            {
                map.take(out.map[j][1 + i], c["true_map"][j][i], 1, "map");
            }
        }
        for (size_t k = 0; !c["H"].is_null() && k < INS_CALIB_PAPER_ROWS * 9; k++)
        {
            matrix.take(out.H[k], c["H"][k / 9][k % 9], 1, "H");
        }
        for (const double e : out.residual)
        {
            map.take(e, 0, 1, "residual");
        }
    }
    expect_within(attitudes, 1e-14, "attitudes of tables 3 and 4");
    expect_within(model, 1e-14, "axes of (13) and (14)");
    expect_within(estimate, TOL_ESTIMATE, "scale factors and biases");
    expect_within(angles, TOL_ANGLE_RAD, "angles, rad");
    expect_within(map, TOL_MAP, "map of the paper's estimate");
    expect_within(matrix, 1e-14, "H of (22)");
}

TEST(calib_paper, table_7_from_table_6)
{
    const double g = 9.81;
    const double degree = PI / 180;
    const double angle[6] = {0.6 * degree, 0.5 * degree, 0.8 * degree, 0.7 * degree, 0.4 * degree, 0.8 * degree};
    // The paper's numbers, to the last digit printed; #2, #3, #5 and #1, #4, #6.
    const double sf[2][3] = {{2.5, 0.5, 2.5}, {0.5, 2.5, 2.5}};
    const double printed_sf[2][3] = {{2.4998, 0.4999, 2.4997}, {0.5, 2.4996, 2.4997}};
    const double printed_deg[6] = {0.5930, 0.5042, 0.8074, 0.7001, 0.4000, 0.8001};
    for (const ins_calib_group_t group : {INS_CALIB_235, INS_CALIB_146})
    {
        double axes[9];
        double f[18];
        double P[INS_CALIB_PAPER_ROWS];
        ins_calib_paper_axes(group, angle, 1, axes);
        ins_calib_paper_attitudes(group, g, f);
        for (int k = 0; k < INS_CALIB_PAPER_ROWS; k++)
        {
            const double* const row = axes + 3 * (k / 6);
            const double* const up = f + 3 * (k % 6);
            P[k] = sf[group][k / 6] * (0.001 * g + row[0] * up[0] + row[1] * up[1] + row[2] * up[2]);
        }
        ins_calib_paper_t out;
        ASSERT_EQ(ins_calib_paper(group, g, 1, P, &out, nullptr, 0), 0);
        for (int j = 0; j < 3; j++)
        {
            EXPECT_EQ(std::round(out.sf[j] * 1e4), std::round(printed_sf[group][j] * 1e4)) << group << j;
            EXPECT_EQ(std::round(out.bias[j] / g * 1e3), 1);
        }
        for (int k = 0; k < 6; k++)
        {
            EXPECT_EQ(std::round(out.angle[k] / degree * 1e4), std::round(printed_deg[k] * 1e4)) << group << ANGLES[k];
        }
        // Scale factors depend on pairs of opposite attitudes alone: (21a), (21b).
        if (group == INS_CALIB_235)
        {
            const double a = (P[0] - P[1] + 3 * (P[2] - P[3]) - 2 * (P[4] - P[5])) / (4 * g);
            const double b = (-(P[6] - P[7]) - (P[8] - P[9]) + 2 * (P[10] - P[11])) / (2 * g);
            EXPECT_NEAR(out.sf[0], a, 1e-14);
            EXPECT_NEAR(out.sf[1], b, 1e-14);
        }
    }
}

TEST(calib_linear, deviations_are_those_of_the_residuals)
{
    // One accelerometer, six faces, residuals known: orthogonal design, so sd(bias) = s / sqrt(6), sd(axis) = s / (g sqrt(2)).
    const double g = 9.8;
    double f[18] = {};
    double P[6];
    for (int k = 0; k < 6; k++)
    {
        f[3 * k + k / 2] = k % 2 == 0 ? g : -g;
        P[k] = 0.5 + 2 * f[3 * k] + (k / 2 == 0 ? 1e-3 : k / 2 == 1 ? -1e-3 : 0); // even in f: the map cannot take it
    }
    ins_calib_map_t map;
    ASSERT_EQ(ins_calib_linear(1, 6, f, P, &map, nullptr, nullptr, 0), 0);
    const double s = std::sqrt(4e-6 / 2); // four residuals of 1 mm/s^2, two degrees of freedom
    EXPECT_NEAR(map.map[0], 0.5, 1e-14);
    EXPECT_NEAR(map.map[1], 2, 1e-14);
    EXPECT_NEAR(map.deviation[0], s / std::sqrt(6.0), 1e-14);
    EXPECT_NEAR(map.deviation[3], s / (g * std::sqrt(2.0)), 1e-14);
    EXPECT_NEAR(map.rms, std::sqrt(4e-6 / 6), 1e-14);
}

TEST(calib_linear, refuses_and_says_which_attitudes_to_add)
{
    const double g = 9.8;
    const double f[18] = {g, 0, 0, -g, 0, 0, 0, g, 0, 0, -g, 0, 0, 0, g, 0, 0, -g};
    double P[6] = {1, 2, 3, 4, 5, 6};
    ins_calib_map_t map;
    Reason why;
    EXPECT_EQ(ins_calib_linear(1, 4, f, P, &map, nullptr, why.text, sizeof why.text), INS_CALIB_E_RANK);
    EXPECT_SAYS(why, "rank 3 of 4: they do not fix axis z; add the attitudes +z up");
    EXPECT_EQ(ins_calib_linear(1, 2, f, P, &map, nullptr, why.text, sizeof why.text), INS_CALIB_E_RANK);
    EXPECT_SAYS(why, "axis y and axis z; add the attitudes +y up and +z up");
    EXPECT_EQ(ins_calib_linear(1, 0, f, P, &map, nullptr, why.text, sizeof why.text), INS_CALIB_E_INPUT);
    P[3] = NOT_A_NUMBER;
    EXPECT_EQ(ins_calib_linear(1, 6, f, P, &map, nullptr, why.text, sizeof why.text), INS_CALIB_E_INPUT);
    EXPECT_SAYS(why, "not a number");
}

TEST(calib_paper, refuses)
{
    double P[INS_CALIB_PAPER_ROWS] = {};
    ins_calib_paper_t out;
    Reason why;
    EXPECT_EQ(ins_calib_paper(INS_CALIB_235, 9.8, 0, P, &out, why.text, sizeof why.text), INS_CALIB_E_INPUT);
    EXPECT_SAYS(why, "T 0 s");
    EXPECT_EQ(ins_calib_paper(INS_CALIB_235, NOT_A_NUMBER, 1, P, &out, nullptr, 0), INS_CALIB_E_INPUT);
    EXPECT_EQ(ins_calib_paper(INS_CALIB_235, 9.8, 1, P, &out, why.text, sizeof why.text), INS_CALIB_E_RANK);
    EXPECT_SAYS(why, "scale factor 0");
    P[4] = NOT_A_NUMBER;
    EXPECT_EQ(ins_calib_paper(INS_CALIB_235, 9.8, 1, P, &out, nullptr, 0), INS_CALIB_E_INPUT);
}
