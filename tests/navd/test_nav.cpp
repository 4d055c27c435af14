// The solver: codes to attitude, gaps, flags; and the JSON line. Reference: closed-form rates of a yaw, pitch, roll motion.
// SPDX-License-Identifier: MIT
#include "../core/core_test.h"
#include "ins/coning.h"
#include "ins/quat.h"
#include "ins_nav/nav.h"
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

namespace
{
const double pi = 3.14159265358979323846;

/// Sinusoids of the paper's test: roll, pitch, yaw.
struct Motion
{
    std::array<double, 3> amplitude = {0.3, 0.5, 1.0};
    std::array<double, 3> frequency_hz = {0.25, 0.3, 0.2};

    std::array<double, 3> euler(double t) const
    {
        std::array<double, 3> e;
        for (size_t i = 0; i < 3; i++)
        {
            e[i] = amplitude[i] * std::sin(2 * pi * frequency_hz[i] * t);
        }
        return e;
    }
    std::array<double, 3> rate(double t) const
    {
        const auto e = euler(t);
        std::array<double, 3> d;
        for (size_t i = 0; i < 3; i++)
        {
            d[i] = amplitude[i] * 2 * pi * frequency_hz[i] * std::cos(2 * pi * frequency_hz[i] * t);
        }
        return {d[0] - d[2] * std::sin(e[1]), d[1] * std::cos(e[0]) + d[2] * std::cos(e[1]) * std::sin(e[0]),
                -d[1] * std::sin(e[0]) + d[2] * std::cos(e[1]) * std::cos(e[0])};
    }
};

/// 16-bit codes over +-4 rad/s, so that what is seen is the algorithm and not the converter.
ins_nav_config_t fine()
{
    ins_nav_config_t cfg;
    ins_nav_config_default(&cfg);
    cfg.seq = 0;
    cfg.code_max = 65535;
    for (int i = 0; i < 3; i++)
    {
        cfg.lsb_rad_s[i] = 8.0 / 65536;
        cfg.null_code[i] = 32768;
    }
    return cfg;
}

uint16_t code(const ins_nav_config_t& cfg, double w)
{
    return static_cast<uint16_t>(std::lround(w / cfg.lsb_rad_s[0] + cfg.null_code[0]));
}

/// Largest angle error over `seconds`, channel i sampled delay[i] late.
double worst_error(const ins_nav_config_t& base, const std::array<double, 3>& delay, double seconds)
{
    const Motion motion;
    ins_nav_config_t cfg = base;
    EXPECT_EQ(ins_nav_config_attitude(&cfg, motion.euler(0).data()), INS_OK);
    ins_nav_t nav;
    EXPECT_EQ(ins_nav_init(&nav, &cfg), INS_OK) << ins_nav_config_problem(&cfg);
    double worst = 0;
    for (int k = 0; k * cfg.period_s <= seconds; k++)
    {
        uint16_t codes[3];
        for (size_t i = 0; i < 3; i++)
        {
            codes[i] = code(cfg, motion.rate(k * cfg.period_s + delay[i])[i]);
        }
        ins_nav_state_t state;
        EXPECT_EQ(ins_nav_codes(&nav, codes, 0, &state), INS_OK);
        EXPECT_EQ(state.t_s, k * cfg.period_s);
        const auto truth = motion.euler(state.t_s);
        for (size_t i = 0; i < 3; i++)
        {
            worst = core_test::larger(worst, std::fabs(state.euler_rad[i] - truth[i]));
        }
    }
    return worst;
}

TEST(Nav, ConstantRateTurnsByRateTimesTime)
{
    ins_nav_config_t cfg = fine();
    ins_nav_t nav;
    ASSERT_EQ(ins_nav_init(&nav, &cfg), INS_OK);
    const uint16_t codes[3] = {code(cfg, 0), code(cfg, 0), code(cfg, 0.5)};
    ins_nav_state_t state;
    const int steps = 100;
    for (int k = 0; k <= steps; k++)
    {
        ASSERT_EQ(ins_nav_codes(&nav, codes, 0, &state), INS_OK);
    }
    EXPECT_EQ(state.w_ib_b[2], 0.5);
    EXPECT_NEAR(state.euler_rad[2], 0.5 * steps * cfg.period_s, 1e-12);
    EXPECT_NEAR(state.dtheta_b[2], 0.5 * cfg.period_s, 1e-15);
    EXPECT_EQ(state.status, 0u);
}

TEST(Nav, FollowsThePapersMotion)
{
    ins_nav_config_t cfg = fine();
    const double at_20ms = worst_error(cfg, {0, 0, 0}, 24);
    cfg.period_s = 0.08;
    const double at_80ms = worst_error(cfg, {0, 0, 0}, 24);
    // 16-bit codes of 1.2e-4 rad/s: their rounding, summed over 24 s, is 4e-5 rad at worst.
    EXPECT_LT(at_20ms, 6e-5);
    EXPECT_LT(at_80ms, 4e-4);
    cfg.rate_order = 2;
    EXPECT_GT(worst_error(cfg, {0, 0, 0}, 24), 2 * at_80ms)
        << "the trapezoid is worse, so the test sees the integration";
}

TEST(Nav, SkewCompensationBringsTheChannelsTogether)
{
    ins_nav_config_t cfg = fine();
    cfg.period_s = 0.08;
    const std::array<double, 3> delay = {0, 0.002, 0.004};
    const double without = worst_error(cfg, delay, 24);
    std::copy(delay.begin(), delay.end(), cfg.delay_s);
    const double with = worst_error(cfg, delay, 24);
    EXPECT_GT(without, 1e-3);
    EXPECT_LT(with, 5e-4);
}

TEST(Nav, StartsFromTheConfiguredAttitudeAndSaysStart)
{
    ins_nav_config_t cfg = fine();
    const double euler[3] = {0.1, -0.7, 2.5};
    ASSERT_EQ(ins_nav_config_attitude(&cfg, euler), INS_OK);
    double reference[4];
    ins_quat_from_euler(euler, reference);
    ins_nav_t nav;
    ASSERT_EQ(ins_nav_init(&nav, &cfg), INS_OK);
    const uint16_t codes[3] = {code(cfg, 1), code(cfg, 1), code(cfg, 1)};
    ins_nav_state_t state;
    ASSERT_EQ(ins_nav_codes(&nav, codes, 0, &state), INS_OK);
    for (int i = 0; i < 4; i++)
    {
        EXPECT_NEAR(state.q_nb[i], reference[i], 1e-15);
        EXPECT_NEAR(state.q_nb[i], cfg.q_nb[i], 1e-15);
    }
    EXPECT_EQ(state.index, 0u);
    // AM4 wants 4 rates, and the two increments before the first regular one make the history.
    for (int k = 0; k < 3; k++)
    {
        EXPECT_TRUE(state.status & INS_NAV_START) << k;
        ASSERT_EQ(ins_nav_codes(&nav, codes, 0, &state), INS_OK);
    }
    EXPECT_FALSE(state.status & INS_NAV_START);
}

TEST(Nav, BridgesLostSamplesAndSaysSo)
{
    ins_nav_config_t cfg = fine();
    cfg.bridge_max = 10;
    ins_nav_t nav;
    ASSERT_EQ(ins_nav_init(&nav, &cfg), INS_OK);
    const uint16_t codes[3] = {code(cfg, 0), code(cfg, 0.25), code(cfg, 0)};
    ins_nav_state_t state;
    uint64_t used = 0;
    uint64_t index = 0;
    // The longest gap turns by 1000 rad, more than INS_ROTVEC_MAX takes at once.
    for (const uint32_t lost : {0u, 0u, 0u, 0u, 3u, 0u, 10u, 0u, 0u, 0u, 200000u, 0u, 0u, 0u, 0u})
    {
        ASSERT_EQ(ins_nav_codes(&nav, codes, lost, &state), INS_OK);
        index += used == 0 ? 0 : lost + 1u;
        used++;
        EXPECT_EQ(state.index, index);
        EXPECT_EQ(state.bridged, lost);
        EXPECT_EQ((state.status & INS_NAV_BRIDGED) != 0, lost > 0);
        EXPECT_EQ(state.used, used);
        EXPECT_EQ(state.used + state.missed, state.index + 1);
        EXPECT_EQ((state.status & INS_NAV_LONG_GAP) != 0, index > 1000) << "stays once it was said";
        const double half = 0.5 * 0.25 * state.t_s;
        EXPECT_NEAR(state.q_nb[0], std::cos(half), 1e-11) << state.t_s;
        EXPECT_NEAR(state.q_nb[2], std::sin(half), 1e-11) << state.t_s;
    }
}

// The last rates before a gap say nothing about the one after it: that is taken as sampled, and the next from those two.
TEST(Nav, SkewCompensationRestartsAfterAGap)
{
    ins_nav_config_t cfg = fine();
    cfg.skew_order = 1;
    cfg.delay_s[1] = 0.25 * cfg.period_s;
    ins_nav_t nav;
    ASSERT_EQ(ins_nav_init(&nav, &cfg), INS_OK);
    ins_nav_state_t state;
    const auto y = [&](double w, uint32_t lost)
    {
        const uint16_t codes[3] = {code(cfg, 0), code(cfg, w), code(cfg, 0)};
        EXPECT_EQ(ins_nav_codes(&nav, codes, lost, &state), INS_OK);
        return state.w_ib_b[1];
    };
    EXPECT_EQ(y(0.0, 0), 0.0);
    EXPECT_EQ(y(1.0, 0), 0.75) << "a quarter of a period back";
    EXPECT_EQ(y(-2.0, 5), -2.0);
    EXPECT_EQ(y(-1.0, 0), -1.25);
}

TEST(Nav, ClippedAndImpossibleCodes)
{
    ins_nav_config_t cfg;
    ins_nav_config_default(&cfg);
    ins_nav_t nav;
    ASSERT_EQ(ins_nav_init(&nav, &cfg), INS_OK);
    ins_nav_state_t state;
    const uint16_t rest[3] = {2048, 2048, 2048};
    const uint16_t low[3] = {2048, 0, 2048};
    const uint16_t high[3] = {2048, 2048, 4095};
    const uint16_t beyond[3] = {2048, 4096, 2048};
    ASSERT_EQ(ins_nav_codes(&nav, rest, 0, &state), INS_OK);
    EXPECT_FALSE(state.status & INS_NAV_CLIPPED);
    ASSERT_EQ(ins_nav_codes(&nav, low, 0, &state), INS_OK);
    EXPECT_TRUE(state.status & INS_NAV_CLIPPED);
    ASSERT_EQ(ins_nav_codes(&nav, high, 0, &state), INS_OK);
    EXPECT_TRUE(state.status & INS_NAV_CLIPPED);
    const ins_nav_solver_t before = nav.solver;
    EXPECT_EQ(ins_nav_codes(&nav, beyond, 0, &state), INS_E_RANGE);
    EXPECT_EQ(std::memcmp(&before, &nav.solver, sizeof before), 0);
}

TEST(Nav, RefusesUnusableConfigurations)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    using Change = std::function<void(ins_nav_config_t&)>;
    const std::pair<const char*, Change> cases[] = {
        {"period", [&](auto& c) { c.period_s = nan; }},
        {"period", [&](auto& c) { c.period_s = 0; }},
        {"period", [&](auto& c) { c.period_s = inf; }},
        {"block length", [&](auto& c) { c.block_len = 5; }},
        {"block length", [&](auto& c) { c.block_len = 33; }},
        {"seq", [&](auto& c) { c.seq = 2; }},
        {"time-out", [&](auto& c) { c.octet_timeout_ms = 0; }},
        {"rate order", [&](auto& c) { c.rate_order = 1; }},
        {"skew order", [&](auto& c) { c.skew_order = 4; }},
        {"delay", [&](auto& c) { c.delay_s[1] = c.period_s; }},
        {"delay", [&](auto& c) { c.delay_s[2] = nan; }},
        {"rate per code", [&](auto& c) { c.lsb_rad_s[0] = nan; }},
        {"rate per code", [&](auto& c) { c.lsb_rad_s[2] = 0; }},
        {"null code", [&](auto& c) { c.null_code[1] = nan; }},
        {"1 rad in a period", [&](auto& c) { c.period_s = 1; }},
        {"code_max", [&](auto& c) { c.code_max = 8191; }},
        {"attitude", [&](auto& c) { c.q_nb[3] = nan; }},
        {"attitude", [&](auto& c) { c.q_nb[0] = 2; }},
        {"form", [&](auto& c) { c.form = INS_CONING_BLOCK3_OPT; }},
    };
    for (const auto& [word, change] : cases)
    {
        ins_nav_config_t cfg;
        ins_nav_config_default(&cfg);
        ASSERT_EQ(ins_nav_config_problem(&cfg), nullptr);
        change(cfg);
        const char* problem = ins_nav_config_problem(&cfg);
        ASSERT_NE(problem, nullptr) << word;
        EXPECT_NE(std::strstr(problem, word), nullptr) << problem << " should speak of " << word;
        ins_nav_t nav;
        EXPECT_EQ(ins_nav_init(&nav, &cfg), INS_E_RANGE);
    }
    ins_nav_config_t cfg;
    const double euler[3] = {0, nan, 0};
    EXPECT_EQ(ins_nav_config_attitude(&cfg, euler), INS_E_RANGE);
}

TEST(Nav, JsonReadsBackBitForBit)
{
    ins_nav_state_t state;
    std::memset(&state, 0, sizeof state);
    state.index = 12345678901234;
    state.t_s = 0.1 + 0.2;
    const double odd[4] = {1.0 / 3, -0.0, 4.9e-324, 0.70710678118654757};
    std::memcpy(state.q_nb, odd, sizeof odd);
    for (int i = 0; i < 3; i++)
    {
        state.euler_rad[i] = std::sin(i + 1.0);
        state.w_ib_b[i] = std::exp(-30.0 * i);
        state.dtheta_b[i] = 1e300 / (i + 3);
    }
    state.seq = 255;
    state.bridged = 7;
    state.status = INS_NAV_BRIDGED | INS_NAV_DISAGREE;
    state.used = 11;
    state.missed = 22;
    state.counts = {1, 2, 3, 4, 5, 6, 7};
    char line[INS_NAV_JSON_MAX];
    const size_t length = ins_nav_state_json(&state, line, sizeof line);
    ASSERT_EQ(length, std::strlen(line));
    ASSERT_EQ(line[length - 1], '\n');
    const auto j = nlohmann::json::parse(line);
    const auto same = [](double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; };
    EXPECT_EQ(j["index"], state.index);
    EXPECT_TRUE(same(j["t_s"], state.t_s));
    for (size_t i = 0; i < 4; i++)
    {
        EXPECT_TRUE(same(j["q_nb"][i].get<double>(), state.q_nb[i])) << i;
    }
    for (size_t i = 0; i < 3; i++)
    {
        EXPECT_TRUE(same(j["euler_rad"][i], state.euler_rad[i])) << i;
        EXPECT_TRUE(same(j["w_ib_b"][i], state.w_ib_b[i])) << i;
        EXPECT_TRUE(same(j["dtheta_b"][i], state.dtheta_b[i])) << i;
    }
    EXPECT_EQ(j["seq"], 255);
    EXPECT_EQ(j["bridged"], 7);
    EXPECT_EQ(j["status"], nlohmann::json({"bridged", "disagree"}));
    EXPECT_EQ(j["used"], 11);
    EXPECT_EQ(j["missed"], 22);
    const nlohmann::json link = {{"accepted", 1}, {"lost", 2},     {"invalid", 3}, {"duplicates", 4},
                                 {"corrupt", 5},  {"timeouts", 6}, {"stray", 7}};
    EXPECT_EQ(j["link"], link);
    for (size_t room = 0; room <= length; room++)
    {
        std::vector<char> exact(room); // so that the sanitizer sees a write beyond it
        EXPECT_EQ(ins_nav_state_json(&state, exact.data(), room), 0u) << room;
    }
    EXPECT_EQ(ins_nav_state_json(&state, line, length + 1), length);
}

TEST(Nav, JsonOfTheLongestStateFits)
{
    ins_nav_state_t state;
    std::memset(&state, 0xFF, sizeof state);
    double* const reals[] = {&state.t_s, state.q_nb, state.euler_rad, state.w_ib_b, state.dtheta_b};
    const int count[] = {1, 4, 3, 3, 3};
    for (int r = 0; r < 5; r++)
    {
        for (int i = 0; i < count[r]; i++)
        {
            reals[r][i] = -1.2345678901234567e-300;
        }
    }
    char line[INS_NAV_JSON_MAX];
    EXPECT_GT(ins_nav_state_json(&state, line, sizeof line), 800u);
}
} // namespace
