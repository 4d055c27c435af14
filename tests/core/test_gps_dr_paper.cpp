/// \file   test_gps_dr_paper.cpp
/// \brief  The paper's pair switches as printed and as corrected; what both navigators have of the vehicle filter.
/// SPDX-License-Identifier: MIT
#include "gps_dr_file.h"
using namespace core_test;

TEST(gps_dr_paper, switches_at_once_as_printed_and_with_hysteresis_as_corrected)
{
    for (const int reading : {INS_GPS_DR_PAPER_PRINTED, INS_GPS_DR_PAPER_CORRECTED})
    {
        const bool printed = reading == INS_GPS_DR_PAPER_PRINTED;
        ins_gps_dr_paper_config_t cfg;
        ins_gps_dr_paper_t p;
        ins_real x[4];
        ins_real var[4];
        ins_gps_dr_paper_config_default(&cfg, reading);
        ASSERT_EQ(ins_gps_dr_paper_init(&p, &cfg), INS_OK);
        EXPECT_EQ(ins_gps_dr_paper_state(&p, x, var), INS_E_STATE);
        ins_gps_dr_fix_t f = {};
        f.valid = 1;
        f.sats = 8;
        f.hdop = 1;
        f.east = 100;
        const auto epoch = [&](ins_real north)
        {
            f.north = north;
            EXPECT_EQ(ins_gps_dr_paper_fix(&p, &f), INS_OK);
            for (int k = 0; k < 10; k++)
            {
                EXPECT_EQ(ins_gps_dr_paper_step(&p, 0, INS_C(0.8)), INS_OK);
            }
            return ins_gps_dr_paper_source(&p);
        };
        EXPECT_EQ(epoch(0), printed ? INS_GPS_DR_GPS : INS_GPS_DR_DR);
        EXPECT_EQ(epoch(8), printed ? INS_GPS_DR_GPS : INS_GPS_DR_DR);
        for (int k = 2; k < 20; k++)
        {
            EXPECT_EQ(epoch(static_cast<ins_real>(8 * k)), INS_GPS_DR_GPS);
        }
        ASSERT_EQ(ins_gps_dr_paper_state(&p, x, var), INS_OK);
        EXPECT_NEAR(static_cast<double>(x[0]), 100, 1);
        EXPECT_NEAR(static_cast<double>(x[1]), 160, 3) << "the fix and a second of reckoning";
        EXPECT_NEAR(static_cast<double>(x[3]), 8, 0.5);
        EXPECT_GT(var[0], 0);
        f.valid = 0;
        EXPECT_EQ(epoch(0), INS_GPS_DR_DR);
        f.valid = 1;
        EXPECT_EQ(epoch(168), printed ? INS_GPS_DR_GPS : INS_GPS_DR_DR);
        EXPECT_EQ(epoch(1000), printed ? INS_GPS_DR_GPS : INS_GPS_DR_DR) << "800 m off";
        f.east = NOT_A_NUMBER;
        EXPECT_EQ(ins_gps_dr_paper_fix(&p, &f), INS_E_RANGE);
        cfg.axis.dt = 0;
        EXPECT_EQ(ins_gps_dr_paper_init(&p, &cfg), INS_E_RANGE);
    }
}

TEST(unicycle, course_and_judgement)
{
    const ins_unicycle_config_t cfg = {4, 0, 0, INS_C(1e-4), INS_C(0.0025), 0, 0};
    const ins_real x0[6] = {0, 0, 3, 8, 0, 1};
    const ins_real var[6] = {5, 5, INS_C(0.01), 1, 0, 0};
    ins_unicycle_t f;
    ASSERT_EQ(ins_unicycle_init(&f, &cfg, x0, var), INS_OK);
    f.P[1] = f.P[6] = 3;
    ins_real nis = 0;
    ins_real det = 0;
    ASSERT_EQ(ins_unicycle_judge(&f, 9, -6, 4, &nis, &det), INS_OK); // S = [9 3; 3 9], as in test_gps_dr
    EXPECT_NEAR(static_cast<double>(nis), 19.125, 1e-5);
    EXPECT_NEAR(static_cast<double>(det), 72, 1e-4);
    EXPECT_EQ(ins_unicycle_judge(&f, 9, NOT_A_NUMBER, 4, &nis, &det), INS_E_RANGE);
    EXPECT_EQ(ins_unicycle_judge(&f, 9, -6, 0, &nis, &det), INS_E_RANGE);
    const auto across = static_cast<ins_real>(3.1 - 2 * PI); // a tenth of a radian on, beyond the seam
    ASSERT_EQ(ins_unicycle_course(&f, across, INS_C(0.01), 0, &nis), INS_OK);
    EXPECT_NEAR(static_cast<double>(f.x[2]), 3.05, 1e-6);
    EXPECT_NEAR(static_cast<double>(nis), 0.5, 1e-4);
    EXPECT_EQ(ins_unicycle_course(&f, 0, INS_C(0.01), INS_KALMAN_GATE_999, &nis), INS_E_GATE);
    EXPECT_EQ(ins_unicycle_course(&f, NOT_A_NUMBER, 1, 0, nullptr), INS_E_RANGE);
    EXPECT_EQ(ins_unicycle_course(&f, 3, 0, 0, nullptr), INS_E_RANGE);
}

TEST(unicycle, travel_moves_as_its_jacobian_says)
{
    const ins_unicycle_config_t cfg = {0, INS_C(1e-3), INS_C(1e-4), INS_C(1e-2), INS_C(0.04), 0, 0};
    const std::array<ins_real, 8> at = {3,          -4,          2,          0,
                                        INS_C(0.1), INS_C(1.25), INS_C(0.7), 10}; // state, yaw rate, distance
    const ins_real T = INS_C(0.5);
    const auto travel = [&](const std::array<ins_real, 8>& in, const std::array<ins_real, 6>& var)
    {
        ins_unicycle_t f;
        EXPECT_EQ(ins_unicycle_init(&f, &cfg, in.data(), var.data()), INS_OK);
        EXPECT_EQ(ins_unicycle_travel(&f, T, in[6], in[7]), INS_OK);
        return f;
    };
    const ins_unicycle_t f = travel(at, {});
    EXPECT_NEAR(static_cast<double>(f.x[0]), 3 + 8 * std::sin(2.15), INS_TOL(1e-13, 1e-5));
    EXPECT_NEAR(static_cast<double>(f.x[1]), -4 + 8 * std::cos(2.15), INS_TOL(1e-13, 1e-5));
    EXPECT_NEAR(static_cast<double>(f.x[2]), 2.3, INS_TOL(1e-13, 1e-5));
    EXPECT_NEAR(static_cast<double>(f.x[3]), 16, INS_TOL(1e-13, 1e-5));
    const double tolerance = INS_TOL(1e-6, 5e-2); // of central differences
    const auto slope = [&](size_t input)
    {
        const auto step = static_cast<ins_real>(INS_TOL(1e-5, 1e-2));
        std::array<ins_real, 8> up = at;
        std::array<ins_real, 8> down = at;
        up[input] += step;
        down[input] -= step;
        std::array<double, 6> d;
        for (size_t i = 0; i < 6; i++)
        {
            d[i] = static_cast<double>(travel(up, {}).x[i] - travel(down, {}).x[i]) / static_cast<double>(2 * step);
        }
        return d;
    };
    const std::array<double, 6> of_rate = slope(6);
    const std::array<double, 6> of_distance = slope(7);
    for (size_t k = 0; k < 36; k++) // P from zero is the noise
    {
        const double walk = k == 28 ? 5e-4 : k == 35 ? 5e-5 : 0;
        const double want = 0.01 * of_rate[k / 6] * of_rate[k % 6] + 0.04 * of_distance[k / 6] * of_distance[k % 6];
        EXPECT_NEAR(static_cast<double>(f.P[k]), want + walk, tolerance * (1 + std::fabs(want))) << k;
    }
    for (size_t state = 0; state < 6; state++) // and what the state's own error becomes
    {
        std::array<ins_real, 6> var = {};
        var[state] = 1;
        const ins_unicycle_t g = travel(at, var);
        const std::array<double, 6> column = slope(state);
        for (size_t k = 0; k < 36; k++)
        {
            const double want = column[k / 6] * column[k % 6];
            EXPECT_NEAR(static_cast<double>(g.P[k] - f.P[k]), want, tolerance * (1 + std::fabs(want))) << state;
        }
    }
    ins_unicycle_t bad = f;
    EXPECT_EQ(ins_unicycle_travel(&bad, 0, 1, 1), INS_E_RANGE);
    EXPECT_EQ(ins_unicycle_travel(&bad, T, 1, NOT_A_NUMBER), INS_E_RANGE);
    EXPECT_TRUE(std::equal(f.P, f.P + 36, bad.P));
    bad.x[5] = 0;
    EXPECT_EQ(ins_unicycle_travel(&bad, T, 1, 1), INS_E_RANGE);
}
