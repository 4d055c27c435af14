/// \file   test_gps_dr.cpp
/// \brief  Dead reckoning and vehicle filters: the reference runs, limits, refusals.
/// SPDX-License-Identifier: MIT
#include "gps_dr_file.h"
using namespace core_test;

TEST(vector_gps_dr, dead_reckoning)
{
    Worst worst;
    const json cases = load("gps_dr.json")["dead_reckoning"];
    for (const json& c : cases)
    {
        ins_real pose[3] = {number(c["e"]), number(c["n"]), number(c["heading"])};
        ASSERT_EQ(ins_dead_reckoning_step(pose, number(c["s"]), number(c["dheading"])), INS_OK);
        worst.take(static_cast<double>(pose[0]), c["out"][0], 100, c.dump());
        worst.take(static_cast<double>(pose[1]), c["out"][1], 100, c.dump());
        worst.take(std::remainder(static_cast<double>(pose[2]) - c["out"][2].get<double>(), 2 * PI), 0, 1, c.dump());
    }
    expect_within(worst, INS_TOL(1e-15, 1e-6), "dead reckoning");
}

TEST(dead_reckoning, a_circle_closes_at_any_step)
{
    const double radius = 50;
    for (const int steps : {4, 100, 5000})
    {
        ins_real pose[3] = {10, 20, 3};
        for (int k = 0; k < steps; k++)
        {
            ASSERT_EQ(ins_dead_reckoning_step(pose, static_cast<ins_real>(2 * PI * radius / steps),
                                              static_cast<ins_real>(-2 * PI / steps)),
                      INS_OK);
        }
        EXPECT_NEAR(static_cast<double>(pose[0]), 10, INS_TOL(1e-10, 2e-2)) << steps;
        EXPECT_NEAR(static_cast<double>(pose[1]), 20, INS_TOL(1e-10, 2e-2)) << steps;
        EXPECT_NEAR(static_cast<double>(pose[2]), 3, INS_TOL(1e-11, 1e-3)) << steps;
    }
    ins_real pose[3] = {1, 2, 3};
    EXPECT_EQ(ins_dead_reckoning_step(pose, 1, 1001), INS_E_RANGE);
    EXPECT_EQ(ins_dead_reckoning_step(pose, 1, NOT_A_NUMBER), INS_E_RANGE);
    EXPECT_EQ(ins_dead_reckoning_step(pose, NOT_A_NUMBER, 1), INS_E_RANGE);
    EXPECT_EQ(pose[0], 1);
    pose[2] = 2000;
    EXPECT_EQ(ins_dead_reckoning_step(pose, 1, 1), INS_E_RANGE);
}

TEST(dead_reckoning, the_chord_of_a_small_turn_is_right_to_rounding)
{
    for (const double turn : {2e-3, -1.7e-3, 1e-3, 0.0}) // up to the end of the series
    {
        const auto t = static_cast<ins_real>(turn);
        ins_real pose[3] = {0, 0, -t / 2}; // the chord points north
        ASSERT_EQ(ins_dead_reckoning_step(pose, 1, t), INS_OK);
        const double half = static_cast<double>(t) / 2;
        const double chord = half != 0 ? std::sin(half) / half : 1;
        EXPECT_EQ(pose[0], 0);
        EXPECT_NEAR(static_cast<double>(pose[1]), chord, INS_TOL(1e-14, 3e-8)) << turn; // float: half an ulp
    }
}

TEST(dead_reckoning, sine_and_cosine_all_around)
{
    Worst worst;
    for (double heading = -1000; heading <= 1000; heading += 0.0371)
    {
        const auto h = static_cast<ins_real>(heading);
        ins_real pose[3] = {0, 0, h};
        ASSERT_EQ(ins_dead_reckoning_step(pose, 1, 0), INS_OK);
        const std::string place = std::to_string(heading);
        worst.take(static_cast<double>(pose[0]), std::sin(static_cast<double>(h)), 1, "sin " + place);
        worst.take(static_cast<double>(pose[1]), std::cos(static_cast<double>(h)), 1, "cos " + place);
        worst.take(static_cast<double>(pose[2]), std::remainder(static_cast<double>(h), 2 * PI), 1, "wrap " + place);
    }
    expect_within(worst, INS_TOL(3e-13, 1.5e-4),
                  "sine, cosine, wrap up to 1000 rad"); // half an ulp of 1000 is 6e-14, 3e-5
}

TEST(vector_gps_dr, dr_ekf)
{
    const json d = load("gps_dr.json")["dr"];
    ins_dr_ekf_config_t cfg = {number(d["T"]),
                               {number(d["tau_e"]), number(d["tau_n"])},
                               {static_cast<ins_real>(std::sqrt(d["sigma2"][0].get<double>())),
                                static_cast<ins_real>(std::sqrt(d["sigma2"][1].get<double>()))},
                               number(d["R"][0][0]),
                               number(d["R"][1][1]),
                               number(d["vmin"]),
                               number(d["vzero"]),
                               0};
    const auto x0 = numbers(d["x0"]);
    const auto var = diagonal(numbers(d["P0"]).data(), 6);
    ins_dr_ekf_t f;
    ASSERT_EQ(ins_dr_ekf_init(&f, &cfg, x0.data(), var.data()), INS_OK);
    Worst model;
    compare(model, f.Phi, d["Phi"], "Phi");
    compare(model, f.Q, d["Q"], "Q");
    expect_within(model, TOL_MODEL, "DR model");
    Worst run;
    size_t next = 0;
    unsigned all = 0;
    unsigned partly = 0;
    for (size_t k = 0; k < d["z"].size(); k++)
    {
        ASSERT_EQ(ins_dr_ekf_step(&f, number(d["z"][k][0]), number(d["z"][k][1])), INS_OK) << k;
        all += f.used == (INS_DR_RATE | INS_DR_DISTANCE);
        partly += f.used == INS_DR_DISTANCE;
        if (next < d["steps"].size() && d["steps"][next]["k"].get<size_t>() == k + 1)
        {
            compare(run, f.x, d["steps"][next]["x"], "x " + std::to_string(k));
            compare(run, diagonal(f.P, 6).data(), d["steps"][next]["P_diag"], "P " + std::to_string(k));
            next++;
        }
    }
    EXPECT_EQ(next, d["steps"].size());
    EXPECT_GT(all, 200u);
    std::printf("%u steps with both, %u with the odometer alone\n", all, partly);
    expect_within(run, TOL_RUN, "DR filter run");
}

TEST(dr_ekf, standing_still_uses_nothing_and_bad_input_is_refused)
{
    const ins_dr_ekf_config_t good = {INS_C(0.1), {5, 5}, {1, 1}, INS_C(1e-4), INS_C(1e-3), INS_C(0.5), INS_C(1e-3), 0};
    const ins_real x0[6] = {0, 0, 0, 0, 0, 0};
    const ins_real var[6] = {1, 1, 1, 1, 1, 1};
    ins_dr_ekf_t f;
    ASSERT_EQ(ins_dr_ekf_init(&f, &good, x0, var), INS_OK);
    ASSERT_EQ(ins_dr_ekf_step(&f, 1, 1), INS_OK);
    EXPECT_EQ(f.used, 0u);
    f.x[2] = INS_C(0.1);
    ASSERT_EQ(ins_dr_ekf_step(&f, 1, INS_C(0.01)), INS_OK);
    EXPECT_EQ(f.used, INS_DR_DISTANCE);

    ins_dr_ekf_config_t gated = good;
    gated.gate = INS_KALMAN_GATE_999;
    const ins_real moving[6] = {0, 0, 8, 0, 0, 0};
    const ins_real sure[6] = {1, 1, INS_C(1e-4), INS_C(1e-4), INS_C(1e-4), INS_C(1e-4)};
    ASSERT_EQ(ins_dr_ekf_init(&f, &gated, moving, sure), INS_OK);
    EXPECT_EQ(ins_dr_ekf_step(&f, 3, INS_C(0.8)), INS_E_GATE) << "a yaw rate of 3 rad/s out of nothing";
    EXPECT_EQ(f.used, INS_DR_DISTANCE);
    EXPECT_GT(f.nis[0], gated.gate);
    EXPECT_EQ(f.gated, 1u);
    ASSERT_EQ(ins_dr_ekf_init(&f, &gated, moving, sure), INS_OK);
    EXPECT_EQ(ins_dr_ekf_step(&f, 0, 80), INS_E_GATE) << "80 m in a tenth of a second";
    EXPECT_EQ(f.used, INS_DR_RATE);
    EXPECT_GT(f.nis[1], gated.gate);
    EXPECT_EQ(f.gated, 1u);

    const ins_dr_ekf_t before = f;
    EXPECT_EQ(ins_dr_ekf_step(&f, NOT_A_NUMBER, 1), INS_E_RANGE);
    EXPECT_EQ(ins_dr_ekf_step(&f, 1, NOT_A_NUMBER), INS_E_RANGE);
    EXPECT_TRUE(std::equal(f.P, f.P + 36, before.P));
    ins_real ins_dr_ekf_config_t::*const members[] = {&ins_dr_ekf_config_t::dt,         &ins_dr_ekf_config_t::r_rate,
                                                      &ins_dr_ekf_config_t::r_distance, &ins_dr_ekf_config_t::v_min,
                                                      &ins_dr_ekf_config_t::v_zero,     &ins_dr_ekf_config_t::gate};
    for (const auto member : members)
    {
        for (const ins_real bad : {INS_C(-1.0), NOT_A_NUMBER})
        {
            ins_dr_ekf_config_t cfg = good;
            cfg.*member = bad;
            EXPECT_EQ(ins_dr_ekf_init(&f, &cfg, x0, var), INS_E_RANGE);
        }
    }
    for (const auto member : {&ins_dr_ekf_config_t::dt, &ins_dr_ekf_config_t::r_rate, &ins_dr_ekf_config_t::r_distance,
                              &ins_dr_ekf_config_t::v_zero})
    {
        ins_dr_ekf_config_t cfg = good;
        cfg.*member = 0;
        EXPECT_EQ(ins_dr_ekf_init(&f, &cfg, x0, var), INS_E_RANGE);
    }
    for (size_t i = 0; i < 2; i++)
    {
        ins_dr_ekf_config_t cfg = good;
        for (const ins_real tau : {INS_C(0.0), INS_C(-5.0)})
        {
            cfg.tau[i] = tau;
            EXPECT_EQ(ins_dr_ekf_init(&f, &cfg, x0, var), INS_E_RANGE);
        }
        cfg = good;
        cfg.sigma[i] = -1;
        EXPECT_EQ(ins_dr_ekf_init(&f, &cfg, x0, var), INS_E_RANGE);
    }
    ins_dr_ekf_config_t least = good; // at equality all these are taken
    least.sigma[0] = least.sigma[1] = least.gate = 0;
    least.v_min = least.v_zero;
    const ins_real known[6] = {0, 0, 0, 0, 0, 0};
    EXPECT_EQ(ins_dr_ekf_init(&f, &least, x0, known), INS_OK);
    const ins_real bad_x[6] = {0, NOT_A_NUMBER, 0, 0, 0, 0};
    const ins_real bad_var[6] = {1, 1, 1, 1, 1, -1};
    EXPECT_EQ(ins_dr_ekf_init(&f, &good, bad_x, var), INS_E_RANGE);
    EXPECT_EQ(ins_dr_ekf_init(&f, &good, x0, bad_var), INS_E_RANGE);
}

TEST(vector_gps_dr, unicycle)
{
    const json u = load("gps_dr.json")["dr_unicycle"];
    const ins_unicycle_config_t cfg = {
        number(u["qv"]), number(u["qb"]), number(u["qk"]), number(u["rw"]), number(u["rs"]), 0, 0};
    const auto x0 = numbers(u["x0"]);
    const auto var = diagonal(numbers(u["P0"]).data(), 6);
    const ins_real T = number(u["T"]);
    ins_unicycle_t f;
    ASSERT_EQ(ins_unicycle_init(&f, &cfg, x0.data(), var.data()), INS_OK);
    Worst run;
    size_t next = 0;
    for (size_t k = 0; k < u["z"].size(); k++)
    {
        const json& z = u["z"][k];
        ASSERT_EQ(ins_unicycle_odometer(&f, T, number(z[1]), nullptr), INS_OK);
        ASSERT_EQ(ins_unicycle_predict(&f, T, number(z[0])), INS_OK);
        if (!z[2].is_null())
        {
            ASSERT_EQ(ins_unicycle_gps(&f, number(z[2][0]), number(z[2][1]), number(u["Rgps"]), nullptr), INS_OK);
        }
        if (next < u["steps"].size() && u["steps"][next]["k"].get<size_t>() == k + 1)
        {
            auto x = std::vector<ins_real>(f.x, f.x + 6);
            const double want = u["steps"][next]["x"][2];
            x[2] = static_cast<ins_real>(want + std::remainder(static_cast<double>(x[2]) - want, 2 * PI));
            compare(run, x.data(), u["steps"][next]["x"], "x " + std::to_string(k));
            compare(run, diagonal(f.P, 6).data(), u["steps"][next]["P_diag"], "P " + std::to_string(k));
            next++;
        }
    }
    EXPECT_EQ(next, u["steps"].size());
    expect_within(run, TOL_RUN, "unicycle run");
    std::printf("bias %.5f of %.5f rad/s, scale %.4f of %.4f\n", static_cast<double>(f.x[INS_UNICYCLE_BIAS]),
                u["truth_bias"].get<double>(), static_cast<double>(f.x[INS_UNICYCLE_SCALE]),
                u["truth_scale"].get<double>());
    EXPECT_NEAR(static_cast<double>(f.x[INS_UNICYCLE_BIAS]), u["truth_bias"].get<double>(),
                4 * std::sqrt(static_cast<double>(f.P[7 * INS_UNICYCLE_BIAS])));
}

TEST(unicycle, heading_survives_a_stop_and_standing_still_finds_the_bias)
{
    const ins_unicycle_config_t cfg = {4, INS_C(1e-10), INS_C(1e-10), INS_C(7.6e-5), INS_C(0.0025), 0, 0};
    const ins_real x0[6] = {0, 0, 1, 8, 0, 1};
    const ins_real var[6] = {1, 1, INS_C(1e-4), 1, INS_C(3e-4), INS_C(1e-4)};
    const ins_real T = INS_C(0.1);
    const ins_real bias = INS_C(0.0087);
    ins_unicycle_t f;
    ASSERT_EQ(ins_unicycle_init(&f, &cfg, x0, var), INS_OK);
    for (int k = 0; k < 100; k++)
    {
        ASSERT_EQ(ins_unicycle_odometer(&f, T, 0, nullptr), INS_OK);
        ASSERT_EQ(ins_unicycle_still(&f, bias, INS_C(1e-4)), INS_OK);
        ASSERT_EQ(ins_unicycle_predict(&f, T, bias), INS_OK);
    }
    EXPECT_NEAR(static_cast<double>(f.x[INS_UNICYCLE_HEADING]), 1, 1e-2);
    EXPECT_NEAR(static_cast<double>(f.x[INS_UNICYCLE_BIAS]), static_cast<double>(bias), 1e-4);
    EXPECT_NEAR(static_cast<double>(f.x[INS_UNICYCLE_SPEED]), 0, 1e-2);
}

TEST(unicycle, fixes_are_judged_as_one_and_bad_input_is_refused)
{
    const ins_unicycle_config_t good = {4, 0, 0, INS_C(1e-4), INS_C(0.0025), INS_KALMAN_GATE_99, INS_KALMAN_GATE2_99};
    const ins_real x0[6] = {0, 0, 0, 8, 0, 1};
    const ins_real var[6] = {5, 5, 1, 1, 0, 0};
    ins_unicycle_t f;
    ASSERT_EQ(ins_unicycle_init(&f, &good, x0, var), INS_OK);
    f.P[1] = f.P[6] = 3;
    const ins_unicycle_t before = f;
    ins_real nis = 0;
    // S = [9 3; 3 9]: v = (9, -6) has nis v' S^-1 v = (81 9 + 2 54 3 + 36 9)/72 = 19.125
    EXPECT_EQ(ins_unicycle_gps(&f, 9, -6, 4, &nis), INS_E_GATE);
    EXPECT_NEAR(static_cast<double>(nis), 19.125, 1e-5);
    EXPECT_TRUE(std::equal(f.x, f.x + 6, before.x) && std::equal(f.P, f.P + 36, before.P));
    EXPECT_EQ(ins_unicycle_gps(&f, NOT_A_NUMBER, 0, 4, &nis), INS_E_RANGE);
    EXPECT_EQ(ins_unicycle_gps(&f, 0, 0, 0, &nis), INS_E_RANGE);
    EXPECT_EQ(ins_unicycle_gps(&f, 3, 3, 4, &nis), INS_OK);
    EXPECT_NEAR(static_cast<double>(nis), 1.5, 1e-5);
    EXPECT_EQ(ins_unicycle_odometer(&f, INS_C(0.1), 100, &nis), INS_E_GATE);
    EXPECT_GT(nis, good.gate);
    EXPECT_EQ(ins_unicycle_odometer(&f, INS_C(0.1), NOT_A_NUMBER, nullptr), INS_E_RANGE);
    EXPECT_EQ(ins_unicycle_predict(&f, 0, 0), INS_E_RANGE);
    EXPECT_EQ(ins_unicycle_predict(&f, INS_C(0.1), NOT_A_NUMBER), INS_E_RANGE);
    EXPECT_EQ(ins_unicycle_predict(&f, 1, 2000), INS_E_RANGE);
    EXPECT_EQ(ins_unicycle_still(&f, NOT_A_NUMBER, 1), INS_E_RANGE);
    EXPECT_EQ(ins_unicycle_still(&f, 0, 0), INS_E_RANGE);
    ins_real ins_unicycle_config_t::*const members[] = {
        &ins_unicycle_config_t::q_speed, &ins_unicycle_config_t::q_bias,     &ins_unicycle_config_t::q_scale,
        &ins_unicycle_config_t::r_rate,  &ins_unicycle_config_t::r_distance, &ins_unicycle_config_t::gate,
        &ins_unicycle_config_t::gate_gps};
    for (const auto member : members)
    {
        for (const ins_real bad : {INS_C(-1.0), NOT_A_NUMBER})
        {
            ins_unicycle_config_t cfg = good;
            cfg.*member = bad;
            EXPECT_EQ(ins_unicycle_init(&f, &cfg, x0, var), INS_E_RANGE);
        }
    }
    for (size_t i = 0; i < 6; i++)
    {
        ins_real x[6] = {0, 0, 0, 8, 0, 1};
        ins_real v[6] = {1, 1, 1, 1, 1, 1};
        x[i] = NOT_A_NUMBER;
        EXPECT_EQ(ins_unicycle_init(&f, &good, x, var), INS_E_RANGE);
        v[i] = -1;
        EXPECT_EQ(ins_unicycle_init(&f, &good, x0, v), INS_E_RANGE);
    }
}

TEST(unicycle, what_the_filter_refuses_leaves_it_as_it_was)
{
    const ins_unicycle_config_t no_gate = {4, 0, 0, INS_C(1e-4), INS_C(0.0025), 0, 0};
    const ins_real var[6] = {5, 5, 1, 1, 1, 1};
    const auto refused = [](ins_unicycle_t f, auto&& call)
    {
        const ins_unicycle_t before = f;
        return call(&f) == INS_E_RANGE && std::equal(f.x, f.x + 6, before.x) && std::equal(f.P, f.P + 36, before.P);
    };
    const auto fix = [](ins_unicycle_t* f) { return ins_unicycle_gps(f, 1, 2, 4, nullptr); };
    const auto still = [](ins_unicycle_t* f) { return ins_unicycle_still(f, INS_C(0.1), 1); };

    ins_unicycle_t f;
    const ins_real x0[6] = {0, 0, 0, 8, 0, 1};
    ASSERT_EQ(ins_unicycle_init(&f, &no_gate, x0, var), INS_OK);
    EXPECT_FALSE(refused(f, fix));
    EXPECT_FALSE(refused(f, still));
    ins_unicycle_t lost = f;
    lost.P[1] = lost.P[6] = 30; // det S = 9 9 - 30 30
    EXPECT_TRUE(refused(lost, fix));
    lost = f;
    lost.P[0] = -1; // det S = 3 9, yet a variance below 0
    EXPECT_TRUE(refused(lost, fix));
    const ins_real fast[6] = {0, 0, 0, std::numeric_limits<ins_real>::max(), 0, 1}; // its square is infinite
    ASSERT_EQ(ins_unicycle_init(&f, &no_gate, fast, var), INS_OK);
    EXPECT_TRUE(refused(f, still)) << "the yaw rate is not used either";
}
