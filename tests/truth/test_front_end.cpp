// Analogue stages before a converter: against closed forms of each, jumps, snapshots, refusals.
// SPDX-License-Identifier: MIT
#include "ins_truth/elementary.h"
#include "ins_truth/front_end.h"
#include "ins_truth/gyro.h"
#include "near.hpp"
#include <complex>
#include <cstdio>
#include <memory>
#include <string>

namespace
{
using FrontEnd = std::unique_ptr<ins_front_end_t, decltype(&ins_front_end_destroy)>;
constexpr double pi = INS_TRUTH_PI;
constexpr double tolerance_v = 1e-9;
constexpr double settled_v = 1e-7; // what some hundred steps of that tolerance add up to
constexpr int64_t s_ps = 1000000000000;
constexpr int64_t sample_ps = s_ps / 300; // three channels at 100 Hz

/// 2.5 V + 1 V sin(2 pi 20 Hz t).
double sine(void*, unsigned, int64_t t_ps)
{
    double s;
    double c;
    ins_truth_sincos(2.0 * pi * 20.0 * static_cast<double>(t_ps) * 1e-12, &s, &c);
    return 2.5 + s;
}

/// Each millisecond another level, from 1 to 4 V.
double levels(void*, unsigned, int64_t t_ps)
{
    return 1.0 + static_cast<double>((t_ps / (s_ps / 1000) * 7) % 4);
}

/// 1 V up to 10 ms, then 4 V.
double step(void*, unsigned, int64_t t_ps)
{
    return t_ps < s_ps / 100 ? 1.0 : 4.0;
}

/// 1 V, and 4 V for one millisecond after half a second.
double pulse(void*, unsigned, int64_t t_ps)
{
    return t_ps / (s_ps / 1000) == 500 ? 4.0 : 1.0;
}

ins_front_end_config_t config(double (*source)(void*, unsigned, int64_t), const ins_front_end_channel_t& channel,
                              int64_t hold_ps = 0)
{
    ins_front_end_config_t c = {};
    c.channels = 1;
    c.channel[0] = channel;
    c.channel[0].rail_high_v = channel.rail_high_v > 0.0 ? channel.rail_high_v : 5.0;
    c.hold_ps = hold_ps;
    c.tolerance_v = tolerance_v;
    c.source = source;
    return c;
}

FrontEnd made(const ins_front_end_config_t& c)
{
    char why[200] = "";
    FrontEnd f(ins_front_end_create(&c, why, sizeof why), ins_front_end_destroy);
    EXPECT_NE(f, nullptr) << why;
    return f;
}

void record(const char* name, double worst)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.1e", worst);
    testing::Test::RecordProperty(name, text);
}
} // namespace

TEST(front_end, linear_stages_have_their_frequency_response)
{
    const double w = 2.0 * pi * 20.0;
    const std::complex<double> i = {0.0, 1.0};
    const auto lag = [&](double hz) { return 1.0 / (1.0 + i * w / (2.0 * pi * hz)); };
    struct
    {
        const char* name;
        ins_front_end_channel_t channel;
        std::complex<double> response;
    } const cases[] = {
        {"wire", {}, 1.0},
        {"sensor of first order", {50.0, 0, 0, 0, 0, 0, 0}, lag(50.0)},
        {"sensor of second order",
         {40.0, 0.5, 0, 0, 0, 0, 0},
         1600.0 / (1600.0 - 400.0 + i * (2.0 * 0.5 * 40.0 * 20.0))},
        {"amplifier", {0, 0, 1e5, 0, 0, 0, 0}, lag(1e5)},
        {"RC", {0, 0, 0, 0, 0, 0, 2e-3}, 1.0 / (1.0 + i * w * 2e-3)},
        {"all", {40.0, 0.5, 1e6, 1e5, 0, 0, 2e-3}, 1600.0 / (1200.0 + i * 800.0) * lag(1e6) / (1.0 + i * w * 2e-3)},
    };
    double worst = 0.0;
    for (const auto& c : cases)
    {
        const FrontEnd f = made(config(sine, c.channel));
        for (int64_t t = sample_ps; t < s_ps; t += sample_ps)
        {
            const double volts = ins_front_end_volts(f.get(), 0, t);
            if (t > s_ps / 2) // what is left of the start: e^-31 at most
            {
                const double want = 2.5 + (c.response * std::exp(i * w * (static_cast<double>(t) * 1e-12))).imag();
                worst = larger(worst, std::fabs(volts - want));
                ASSERT_LE(std::fabs(volts - want), settled_v) << c.name << " at " << t;
            }
        }
        EXPECT_EQ(ins_front_end_failures(f.get()), 0u);
    }
    record("worst_v", worst);
}

TEST(front_end, a_sensor_of_first_order_is_the_gyros_bandwidth)
{
    const ins_motion_sines_t sines = {{0, 0.04, 3.0, 0}, {0, 0.03, 2.0, 0.5}, {0, 0.02, 5.0, 1.0}};
    const std::unique_ptr<ins_motion_t, decltype(&ins_motion_destroy)> motion(
        ins_motion_create_euler(&sines, 0.0, nullptr, 0), ins_motion_destroy);
    ins_gyro_config_t gyros;
    ins_gyro_default_config(&gyros);
    ins_gyro_t wide;
    ASSERT_TRUE(ins_gyro_init(&wide, &gyros, motion.get(), nullptr, 0));
    for (ins_gyro_channel_t& channel : gyros.channel)
    {
        channel.bandwidth_hz = 50.0;
    }
    ins_gyro_t narrow;
    ASSERT_TRUE(ins_gyro_init(&narrow, &gyros, motion.get(), nullptr, 0));
    ins_front_end_config_t c = config(ins_gyro_volts, {50.0, 0, 0, 0, 0, 0, 0});
    c.channels = 3;
    c.channel[1] = c.channel[2] = c.channel[0];
    c.ctx = &wide;
    const FrontEnd f = made(c);
    for (int64_t t = 0; t < s_ps; t += sample_ps)
    {
        const auto channel = static_cast<unsigned>(t / sample_ps % 3);
        const double volts = ins_front_end_volts(f.get(), channel, t);
        if (t > s_ps / 5)
        {
            ASSERT_NEAR(volts, ins_gyro_volts(&narrow, channel, t), settled_v) << t;
        }
    }
    EXPECT_EQ(ins_front_end_volts(f.get(), 7, s_ps), 0.0) << "the source's own";
}

TEST(front_end, jumps_of_the_source_are_met_exactly)
{
    constexpr double rc_s = 2e-3;
    const FrontEnd f = made(config(levels, {0, 0, 0, 0, 0, 0, rc_s}, s_ps / 1000));
    double want = 1.0;
    for (int64_t k = 1; k < 400; k++) // thirds of a millisecond
    {
        const double level = levels(nullptr, 0, (k - 1) / 3 * (s_ps / 1000));
        want = level + (want - level) * std::exp(-1e-3 / 3.0 / rc_s);
        ASSERT_NEAR(ins_front_end_volts(f.get(), 0, k * (s_ps / 1000) / 3), want, settled_v) << k;
    }
}

TEST(front_end, a_jump_between_two_samples_far_apart_is_not_stepped_over)
{
    const FrontEnd f = made(config(pulse, {0, 0, 0, 0, 0, 0, 2e-3}, s_ps / 1000));
    const double want = 1.0 + 3.0 * (1.0 - std::exp(-0.5)) * std::exp(-1.0);
    EXPECT_NEAR(ins_front_end_volts(f.get(), 0, 503 * (s_ps / 1000)), want, settled_v);
}

TEST(front_end, an_amplifier_slews_and_stops_at_its_rails)
{
    const FrontEnd f = made(config(step, {0, 0, 1e6, 100.0, 0, 3.3, 0}, s_ps / 100));
    const auto at = [&](double s) { return ins_front_end_volts(f.get(), 0, static_cast<int64_t>(s * 1e12)); };
    EXPECT_NEAR(at(0.009), 1.0, settled_v);
    EXPECT_NEAR(at(0.015), 1.5, settled_v) << "100 V/s";
    EXPECT_NEAR(at(0.025), 2.5, settled_v);
    EXPECT_NEAR(at(0.1), 3.3, settled_v) << "the rail";
}

TEST(front_end, a_snapshot_goes_on_with_the_same_bits)
{
    const ins_front_end_channel_t channel = {40.0, 0.5, 1e6, 1e5, 0, 0, 2e-3};
    const FrontEnd f = made(config(sine, channel));
    ins_front_end_volts(f.get(), 0, 100 * sample_ps);
    ins_front_end_state_t state;
    ins_front_end_get(f.get(), 0, &state);
    const double first = ins_front_end_volts(f.get(), 0, 101 * sample_ps);
    const double second = ins_front_end_volts(f.get(), 0, 102 * sample_ps);
    ins_front_end_set(f.get(), 0, &state);
    EXPECT_EQ(ins_front_end_volts(f.get(), 0, 101 * sample_ps), first);
    EXPECT_EQ(ins_front_end_volts(f.get(), 0, 101 * sample_ps), first) << "asked again";
    const FrontEnd other = made(config(sine, channel));
    ins_front_end_set(other.get(), 0, &state);
    EXPECT_EQ(ins_front_end_volts(other.get(), 0, 101 * sample_ps), first);
    EXPECT_EQ(ins_front_end_volts(other.get(), 0, 102 * sample_ps), second);
    EXPECT_EQ(ins_front_end_volts(f.get(), 0, 50 * sample_ps), sine(nullptr, 0, 50 * sample_ps))
        << "back: at rest there";
}

TEST(front_end, a_source_that_is_no_number_is_counted)
{
    const auto broken = [](void*, unsigned, int64_t t_ps) { return t_ps > s_ps / 1000 ? not_a_number : 2.0; };
    const FrontEnd f = made(config(broken, {0, 0, 0, 0, 0, 0, 1e-3}));
    EXPECT_NEAR(ins_front_end_volts(f.get(), 0, s_ps / 1000), 2.0, settled_v);
    EXPECT_EQ(ins_front_end_volts(f.get(), 0, s_ps / 500), 0.0);
    EXPECT_EQ(ins_front_end_failures(f.get()), 1u);
}

TEST(front_end, a_refusal_says_what_and_why)
{
    const auto why = [](const ins_front_end_channel_t& channel)
    {
        char text[200] = "";
        const ins_front_end_config_t c = config(sine, channel);
        EXPECT_EQ(ins_front_end_create(&c, text, sizeof text), nullptr);
        return std::string(text);
    };
    EXPECT_EQ(why({-1.0, 0, 0, 0, 0, 0, 0}), "channel 0: sensor_hz (0: none) is -1, give 0.01 to 1000000");
    EXPECT_EQ(why({0, 0, 0, 10.0, 0, 0, 0}),
              "channel 0: slew_v_s is 10 and amplifier_hz 0: give the amplifier a bandwidth too");
    EXPECT_EQ(why({0, 0, 0, 0, 6.0, 5.0, 0}).find("channel 0: rail_high_v (above rail_low_v) is 5, give 6"), 0u);
    EXPECT_EQ(why({0, 0, 0, 0, 0, 0, not_a_number}), "channel 0: rc_s (0: none) is nan, give 1e-09 to 10");
}
