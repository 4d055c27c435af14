/// \file   test_gps_axis.cpp
/// \brief  GPS axis filter: the reference run, the limits of its model, refusals.
/// SPDX-License-Identifier: MIT
#include "gps_dr_file.h"
using namespace core_test;

namespace
{
ins_gps_axis_config_t gps_config(const json& g)
{
    return {number(g["T"]),
            number(g["tau_a"]),
            number(g["tau_eps"]),
            static_cast<ins_real>(std::sqrt(g["sigma_a2"].get<double>())),
            static_cast<ins_real>(std::sqrt(g["sigma_eps2"].get<double>())),
            number(g["R"]),
            0,
            0};
}
} // namespace

TEST(vector_gps_dr, gps_axis)
{
    const json g = load("gps_dr.json")["gps"];
    const ins_gps_axis_config_t cfg = gps_config(g);
    const auto var = diagonal(numbers(g["P0"]).data(), 4);
    ins_gps_axis_t f;
    ASSERT_EQ(ins_gps_axis_init(&f, &cfg, var.data()), INS_OK);
    Worst model;
    compare(model, f.Phi, g["Phi"], "Phi");
    compare(model, f.Q, g["Q"], "Q");
    compare(model, f.u,
            json(std::vector<double>{g["U_current_stat"][0], g["U_current_stat"][1], g["U_current_stat"][2]}), "U");
    expect_within(model, TOL_MODEL, "GPS axis model");
    Worst run;
    size_t next = 0;
    for (size_t k = 0; k < g["z"].size(); k++)
    {
        ASSERT_EQ(ins_gps_axis_step(&f, number(g["z"][k][0]), nullptr), INS_OK);
        if (next < g["steps"].size() && g["steps"][next]["k"].get<size_t>() == k)
        {
            compare(run, f.x, g["steps"][next]["x"], "x " + std::to_string(k));
            compare(run, diagonal(f.P, 4).data(), g["steps"][next]["P_diag"], "P " + std::to_string(k));
            compare(run, f.K, g["steps"][next]["K"], "K " + std::to_string(k));
            next++;
        }
    }
    EXPECT_EQ(next, g["steps"].size());
    expect_within(run, TOL_RUN, "GPS axis run");
    for (int k = 0; k < 2000; k++)
    {
        ASSERT_EQ(ins_gps_axis_step(&f, 0, nullptr), INS_OK);
    }
    Worst steady;
    compare(steady, f.K, g["steady"]["K"], "K");
    compare(steady, f.P, g["steady"]["P_plus"], "P");
    expect_within(steady, INS_TOL(1e-7, 1e-3), "GPS axis steady state");
}

/// The series below dt/tau = 1 and the closed forms above meet, and their limits are the white-jerk and the white-acceleration model.
TEST(gps_axis, model_is_continuous_over_dt_by_tau)
{
    const ins_real var[4] = {1, 1, 1, 1};
    Worst seam;
    ins_gps_axis_t below;
    ins_gps_axis_t above;
    ins_gps_axis_config_t cfg = {1, 1, 100, 1, 1, 1, 0, 0};
    const ins_real step = INS_TOL(1e-14, 1e-6f);
    cfg.tau_acceleration = 1 + step;
    ASSERT_EQ(ins_gps_axis_init(&below, &cfg, var), INS_OK);
    cfg.tau_acceleration = 1 - step;
    ASSERT_EQ(ins_gps_axis_init(&above, &cfg, var), INS_OK);
    for (size_t i = 0; i < 16; i++)
    {
        seam.take(static_cast<double>(below.Q[i]), static_cast<double>(above.Q[i]), 1, "Q");
        seam.take(static_cast<double>(below.Phi[i]), static_cast<double>(above.Phi[i]), 1, "Phi");
    }
    expect_within(seam, INS_TOL(1e-13, 2e-5), "Singer model, series against closed form at dt = tau");

    cfg.tau_acceleration = INS_C(1e6); // a -> 0: Q of white jerk of density 2/tau
    ASSERT_EQ(ins_gps_axis_init(&below, &cfg, var), INS_OK);
    const double q = 2e-6;
    const double want[] = {q / 20, q / 8, q / 6, q / 3, q / 2, q};
    const size_t at[] = {0, 1, 2, 5, 6, 10};
    for (size_t i = 0; i < 6; i++)
    {
        EXPECT_NEAR(static_cast<double>(below.Q[at[i]]), want[i], want[i] * INS_TOL(3e-6, 1e-5)) << i;
    }
}

TEST(gps_axis, current_statistical_model_follows_the_mean)
{
    const ins_real var[4] = {1, 1, 1, 1};
    for (const double tau : {20.0, 0.5}) // dt/tau below and above the end of the series
    {
        const ins_gps_axis_config_t cfg = {1, static_cast<ins_real>(tau), 100, 1, 5, 9, 0, 10};
        ins_gps_axis_t f;
        ASSERT_EQ(ins_gps_axis_init(&f, &cfg, var), INS_OK);
        f.x[1] = 3;
        f.x[2] = 2;
        const ins_real before = f.P[10];
        ins_gps_axis_predict(&f);
        EXPECT_NEAR(static_cast<double>(f.x[0]), 3 + 0.5 * 2, 1e-5) << "a constant acceleration is carried on";
        EXPECT_NEAR(static_cast<double>(f.x[1]), 3 + 2, 1e-5);
        EXPECT_NEAR(static_cast<double>(f.x[2]), 2, 1e-6);
        const double phi = std::exp(-1 / tau);
        const double added = (4 - PI) / PI * 8 * 8 * (1 - phi * phi);
        EXPECT_NEAR(static_cast<double>(f.P[10]), static_cast<double>(before) * phi * phi + added, 1e-5);
        for (const double beyond : {10.5, -11.5}) // there is no room: no noise
        {
            f.x[2] = static_cast<ins_real>(beyond);
            const ins_real variance = f.P[10];
            ins_gps_axis_predict(&f);
            EXPECT_NEAR(static_cast<double>(f.P[10]), static_cast<double>(variance) * phi * phi, 1e-5) << beyond;
        }
    }
}

TEST(gps_axis, refusals_and_gate)
{
    const ins_gps_axis_config_t good = {1, 20, 100, 1, 5, 9, INS_KALMAN_GATE_99, 0};
    const ins_real var[4] = {1, 1, 1, 1};
    ins_gps_axis_t f;
    ins_real ins_gps_axis_config_t::*const members[] = {&ins_gps_axis_config_t::dt,
                                                        &ins_gps_axis_config_t::tau_acceleration,
                                                        &ins_gps_axis_config_t::tau_fix,
                                                        &ins_gps_axis_config_t::sigma_acceleration,
                                                        &ins_gps_axis_config_t::sigma_fix,
                                                        &ins_gps_axis_config_t::r,
                                                        &ins_gps_axis_config_t::acceleration_max};
    for (const auto member : members)
    {
        for (const ins_real bad : {INS_C(-1.0), NOT_A_NUMBER})
        {
            ins_gps_axis_config_t cfg = good;
            cfg.*member = bad;
            EXPECT_EQ(ins_gps_axis_init(&f, &cfg, var), INS_E_RANGE);
        }
    }
    for (const auto member : {&ins_gps_axis_config_t::dt, &ins_gps_axis_config_t::tau_acceleration,
                              &ins_gps_axis_config_t::tau_fix, &ins_gps_axis_config_t::r})
    {
        ins_gps_axis_config_t cfg = good;
        cfg.*member = 0;
        EXPECT_EQ(ins_gps_axis_init(&f, &cfg, var), INS_E_RANGE);
    }
    for (const auto member : {&ins_gps_axis_config_t::sigma_acceleration, &ins_gps_axis_config_t::sigma_fix,
                              &ins_gps_axis_config_t::acceleration_max, &ins_gps_axis_config_t::gate})
    {
        ins_gps_axis_config_t cfg = good;
        cfg.*member = 0;
        EXPECT_EQ(ins_gps_axis_init(&f, &cfg, var), INS_OK);
    }
    const ins_real known[4] = {0, 0, 0, 0};
    EXPECT_EQ(ins_gps_axis_init(&f, &good, known), INS_OK);
    for (const double tau : {91.0, 100.0, 109.0})
    {
        ins_gps_axis_config_t cfg = good;
        cfg.tau_acceleration = static_cast<ins_real>(tau);
        EXPECT_EQ(ins_gps_axis_init(&f, &cfg, var), INS_E_RANGE) << "the fix error is not observable at tau " << tau;
    }
    for (size_t i = 0; i < 4; i++)
    {
        ins_real wrong[4] = {1, 1, 1, 1};
        wrong[i] = -1;
        EXPECT_EQ(ins_gps_axis_init(&f, &good, wrong), INS_E_RANGE);
    }
    ASSERT_EQ(ins_gps_axis_init(&f, &good, var), INS_OK);
    ins_gps_axis_t predicted = f;
    ins_gps_axis_predict(&predicted);
    ins_real nis = 0;
    EXPECT_EQ(ins_gps_axis_step(&f, 1000, &nis), INS_E_GATE);
    EXPECT_GT(nis, 1000);
    EXPECT_TRUE(std::equal(f.P, f.P + 16, predicted.P)) << "refused, but the epoch has passed";
    EXPECT_EQ(ins_gps_axis_step(&f, NOT_A_NUMBER, nullptr), INS_E_RANGE);
}
