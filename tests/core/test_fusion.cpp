/// \file   test_fusion.cpp
/// \brief  Fusion of estimates, information sharing, the switch between GPS and dead reckoning: the reference runs, limits, refusals.
/// SPDX-License-Identifier: MIT
#include "gps_dr_file.h"
#include <random>
using namespace core_test;

TEST(vector_gps_dr, fusion_and_information_sharing)
{
    Worst worst;
    const json cases = load("gps_dr.json")["fusion"];
    ASSERT_FALSE(cases.empty());
    for (const json& c : cases)
    {
        const auto n = static_cast<unsigned>(c["x_fused"].size());
        std::vector<ins_real> info(n * n, 9);
        std::vector<ins_real> y(n, 9);
        std::vector<ins_real> x(n);
        std::vector<ins_real> P(n * n);
        std::vector<ins_real> work(n * n);
        ins_fusion_clear(n, info.data(), y.data());
        EXPECT_EQ(ins_fusion_solve(n, info.data(), y.data(), x.data(), P.data()), INS_E_RANGE) << "nothing is known";
        for (size_t i = 0; i < c["x"].size(); i++)
        {
            ASSERT_EQ(ins_fusion_add(n, info.data(), y.data(), numbers(c["x"][i]).data(), numbers(c["P"][i]).data(),
                                     work.data()),
                      INS_OK);
        }
        ASSERT_EQ(ins_fusion_solve(n, info.data(), y.data(), x.data(), P.data()), INS_OK);
        compare(worst, x.data(), c["x_fused"], "x");
        compare(worst, P.data(), c["P_fused"], "P");
        for (size_t i = 0; i < c["beta"].size(); i++)
        {
            ASSERT_EQ(ins_fusion_share(n, P.data(), number(c["beta"][i]), work.data()), INS_OK);
            compare(worst, work.data(), c["P_local_reset"][i], "P shared");
        }
        const auto before = info;
        std::vector<ins_real> unknown(n * n, 0);
        for (unsigned i = 0; i < n; i++)
        {
            unknown[(n + 1) * i] = std::numeric_limits<ins_real>::infinity();
        }
        for (const auto& bad : {std::vector<ins_real>(n * n, -1), unknown})
        {
            EXPECT_EQ(ins_fusion_add(n, info.data(), y.data(), x.data(), bad.data(), work.data()), INS_E_RANGE);
            EXPECT_EQ(info, before);
        }
        for (const ins_real beta : {INS_C(0.0), INS_C(1.5), NOT_A_NUMBER})
        {
            EXPECT_EQ(ins_fusion_share(n, P.data(), beta, work.data()), INS_E_RANGE);
        }
    }
    expect_within(worst, TOL_STEP, "fusion");
}

TEST(fusion, covariance_is_symmetric_to_the_bit)
{
    constexpr unsigned n = 4;
    const unsigned seed = 37;
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    for (int k = 0; k < 50; k++)
    {
        ins_real P[n * n];
        ins_real info[n * n];
        ins_real y[n];
        ins_real x[n] = {1, 2, 3, 4};
        ins_real work[n * n];
        ins_real L[n * n] = {0};
        for (unsigned i = 0; i < n; i++)
        {
            for (unsigned j = 0; j <= i; j++)
            {
                L[n * i + j] =
                    static_cast<ins_real>(i == j ? 1 : std::uniform_real_distribution<double>(-1, 1)(random));
            }
        }
        for (unsigned at = 0; at < n * n; at++)
        {
            P[at] = 0;
            for (unsigned j = 0; j < n; j++)
            {
                P[at] += L[n * (at / n) + j] * L[n * (at % n) + j];
            }
        }
        ins_fusion_clear(n, info, y);
        ASSERT_EQ(ins_fusion_add(n, info, y, x, P, work), INS_OK);
        ASSERT_EQ(ins_fusion_solve(n, info, y, x, P), INS_OK);
        for (unsigned at = 0; at < n * n; at++)
        {
            ASSERT_EQ(P[at], P[n * (at % n) + at / n]) << "run " << k << ", element " << at;
        }
    }
}

TEST(vector_gps_dr, switch_with_hysteresis)
{
    const json s = load("gps_dr.json")["switch"];
    const ins_switch_config_t cfg = {number(s["params"]["hmax"]), number(s["params"]["gate"]),
                                     s["params"]["smin"].get<uint_least8_t>(),
                                     s["params"]["n_back"].get<uint_least8_t>()};
    EXPECT_EQ(cfg.back, INS_SWITCH_BACK_GOOD);
    ins_switch_t good;
    ins_switch_t paper;
    ins_switch_config_t at_once = cfg;
    at_once.back = INS_SWITCH_BACK_PAPER;
    ASSERT_EQ(ins_switch_init(&good, &cfg), INS_OK);
    ASSERT_EQ(ins_switch_init(&paper, &at_once), INS_OK);
    int changes_good = 0;
    int changes_paper = 0;
    for (size_t k = 0; k < s["epochs"].size(); k++)
    {
        const json& e = s["epochs"][k];
        const ins_real nis = e["nis"].is_null() ? 0 : number(e["nis"]);
        const int before_good = good.mode;
        const int before_paper = paper.mode;
        const int mode =
            ins_switch_epoch(&good, e["valid"].get<bool>(), e["sats"].get<unsigned>(), number(e["hdop"]), nis);
        EXPECT_EQ(mode == INS_SWITCH_GPS ? "GPS" : "DR", s["expected"][k]["mode"].get<std::string>()) << k;
        EXPECT_EQ(good.good != 0, s["expected"][k]["good"].get<bool>()) << k;
        const int m =
            ins_switch_epoch(&paper, e["valid"].get<bool>(), e["sats"].get<unsigned>(), number(e["hdop"]), nis);
        EXPECT_EQ(m == INS_SWITCH_GPS, s["expected"][k]["good"].get<bool>()) << "the paper's follows each epoch " << k;
        changes_good += mode != before_good;
        changes_paper += m != before_paper;
    }
    std::printf("[ figure   ] changes of mode in %zu epochs: %d with hysteresis, %d as printed\n", s["epochs"].size(),
                changes_good, changes_paper);
    EXPECT_LT(changes_good, changes_paper);
}

TEST(gps_dr_switch, limits_and_refusals)
{
    const ins_switch_config_t cfg = {4, INS_KALMAN_GATE2_99, 4, 1};
    ins_switch_t s;
    ASSERT_EQ(ins_switch_init(&s, &cfg), INS_OK);
    EXPECT_EQ(ins_switch_epoch(&s, 1, 4, 4, INS_KALMAN_GATE2_99), INS_SWITCH_GPS) << "the limits are good";
    EXPECT_EQ(ins_switch_epoch(&s, 0, 4, 4, 0), INS_SWITCH_DR);
    EXPECT_EQ(ins_switch_epoch(&s, 1, 3, 4, 0), INS_SWITCH_DR);
    EXPECT_EQ(ins_switch_epoch(&s, 1, 4, NOT_A_NUMBER, 0), INS_SWITCH_DR);
    EXPECT_EQ(ins_switch_epoch(&s, 1, 4, 1, NOT_A_NUMBER), INS_SWITCH_DR);
    EXPECT_EQ(ins_switch_epoch(&s, 1, 4, 1, 10), INS_SWITCH_DR);
    for (int k = 0; k < 300; k++) // more than a counter of 8 bits holds
    {
        EXPECT_EQ(ins_switch_epoch(&s, 1, 4, 1, 0), INS_SWITCH_GPS);
    }
    const ins_switch_config_t no_gate = {4, 0, 4, 1};
    ASSERT_EQ(ins_switch_init(&s, &no_gate), INS_OK);
    EXPECT_EQ(ins_switch_epoch(&s, 1, 4, 1, 1000), INS_SWITCH_GPS);
    for (const ins_switch_config_t& bad :
         {ins_switch_config_t{4, 1, 4, 0}, ins_switch_config_t{0, 1, 4, 1}, ins_switch_config_t{NOT_A_NUMBER, 1, 4, 1},
          ins_switch_config_t{4, -1, 4, 1}})
    {
        EXPECT_EQ(ins_switch_init(&s, &bad), INS_E_RANGE);
    }
}
