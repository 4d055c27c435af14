// Accelerometers off the origin: against the second difference of where each one is, errors, noise, rails, refusals.
// SPDX-License-Identifier: MIT
#include "ins_truth/accel.h"
#include "track_kit.hpp"
#include <cmath>
#include <cstdint>

namespace
{
constexpr double g0 = 9.80665;
constexpr double rho = 0.1;
constexpr double range = 2.0 * g0;
constexpr std::int64_t ms = 1000000000; // [ps]
constexpr int noise_samples = 50000;

ins_accel_config_t paper()
{
    ins_accel_config_t c;
    ins_accel_paper_config(&c, rho, range, 0.0, 5.0);
    return c;
}

ins_accels_t made(const ins_accel_config_t& config, const Track& track)
{
    ins_accels_t a;
    char why[200] = "";
    EXPECT_TRUE(ins_accels_init(&a, &config, track.get(), why, sizeof why)) << why;
    return a;
}

/// Where an accelerometer at r is in n at t.
Vec place(const Track& track, const double r[3], double t)
{
    const ins_track_state_t s = at(track, t);
    const Vec arm = turn(s.q_nb, r);
    return {s.p_n[0] + arm[0], s.p_n[1] + arm[1], s.p_n[2] + arm[2]};
}

/// Its specific force along axis: the second difference of its place, of fourth order, less the thesis's gravity.
double by_differences(const Track& track, const ins_accel_channel_t& c, double t)
{
    constexpr double h = 2e-3;
    static const double weight[5] = {-1.0, 16.0, -30.0, 16.0, -1.0};
    Vec f_n = {0.0, 0.0, -INS_TRACK_G};
    for (int k = 0; k < 5; k++)
    {
        const Vec p = place(track, c.r, t + (k - 2) * h);
        for (size_t i = 0; i < 3; i++)
        {
            f_n[i] += weight[k] * p[i] / (12.0 * h * h);
        }
    }
    const ins_track_state_t s = at(track, t);
    const Vec f_b = turn(s.q_nb, f_n.data(), -1);
    return c.axis[0] * f_b[0] + c.axis[1] * f_b[1] + c.axis[2] * f_b[2];
}
} // namespace

TEST(accel, at_rest_and_level_reads_the_reaction_to_gravity)
{
    const Track still = {ins_track_create_still(&flat_site, nullptr, nullptr, 0), ins_track_destroy};
    ins_accels_t a = made(paper(), still);
    const double expected[6] = {0, -1, -1, -1, -1, 0};
    for (unsigned j = 0; j < 6; j++)
    {
        const double x = expected[j] * INS_TRACK_G * std::sqrt(0.5);
        EXPECT_NEAR(ins_accels_exact(&a, j, 5 * ms), x, 1e-12) << "accelerometer " << j + 1;
        EXPECT_NEAR(ins_accels_volts(&a, j, 5 * ms), 2.5 + x * 2.5 / range, 1e-12) << "accelerometer " << j + 1;
    }
    EXPECT_EQ(ins_accels_volts(&a, 6, 5 * ms), 0.0) << "nothing is connected";
}

TEST(accel, is_the_second_derivative_of_its_own_place)
{
    const ins_motion_sines_t sines = {{0.3, 0.8, 0.7, 0.3}, {0.1, 0.4, 0.9, -1.0}, {-0.2, 0.7, 0.5, 2.0}};
    const Motion m = {ins_motion_create_euler(&sines, 0.0, nullptr, 0), ins_motion_destroy};
    for (const Named& named : every_track(flat_site, m.get()))
    {
        const ins_accels_t a = made(paper(), named.track);
        for (unsigned j = 0; j < 6; j++)
        {
            for (int k = 0; k < 20; k++)
            {
                const std::int64_t t = (10100 + 1234 * k) * ms;
                EXPECT_NEAR(ins_accels_exact(&a, j, t),
                            by_differences(named.track, a.config.channel[j], static_cast<double>(t) * 1e-12), 2e-7)
                    << named.name << ", accelerometer " << j + 1 << ", t = " << t / ms << " ms";
            }
        }
    }
}

TEST(accel, errors_are_bias_scale_and_square)
{
    const Track still = {ins_track_create_still(&flat_site, nullptr, nullptr, 0), ins_track_destroy};
    ins_accel_config_t c = paper();
    c.channel[1].bias = 0.02;
    c.channel[1].scale_error = 0.01;
    c.channel[1].quadratic = 1e-3;
    const ins_accels_t a = made(c, still);
    const double x = -INS_TRACK_G * std::sqrt(0.5);
    EXPECT_NEAR(ins_accels_reading(&a, 1, ms), 0.02 + 1.01 * x + 1e-3 * x * x, 1e-12);
    EXPECT_NEAR(ins_accels_reading(&a, 2, ms), x, 1e-12);
}

TEST(accel, noise_is_white_between_samples_and_biases_stay)
{
    const Track still = {ins_track_create_still(&flat_site, nullptr, nullptr, 0), ins_track_destroy};
    ins_accel_config_t c = paper();
    c.turn_on = 0.5;
    c.seed = 11;
    for (unsigned j = 0; j < 6; j++)
    {
        c.channel[j].noise = 0.01;
    }
    const ins_accels_t a = made(c, still);
    ins_accels_t quiet = a;
    quiet.config.channel[3].noise = 0.0;
    const double mean = ins_accels_reading(&quiet, 3, 0);
    EXPECT_GT(std::fabs(mean - ins_accels_exact(&a, 3, 0)), 1e-3) << "a turn-on bias of its own";
    EXPECT_EQ(mean, ins_accels_reading(&quiet, 3, 12345 * ms));
    double sum = 0.0, square = 0.0, lag = 0.0, last = 0.0;
    for (int k = 0; k < noise_samples; k++)
    {
        const double e = ins_accels_reading(&a, 3, k * ms) - mean;
        sum += e;
        square += e * e;
        lag += e * last;
        last = e;
    }
    const double n = noise_samples;
    EXPECT_LT(std::fabs(sum / n), 4.0 * 0.01 / std::sqrt(n)) << "seed 11";
    EXPECT_NEAR(std::sqrt(square / n), 0.01, 4.0 * 0.01 / std::sqrt(2.0 * n)) << "seed 11";
    EXPECT_LT(std::fabs(lag / square), 4.0 / std::sqrt(n)) << "seed 11";
    EXPECT_EQ(ins_accels_reading(&a, 3, 7 * ms), ins_accels_reading(&a, 3, 7 * ms)) << "a pure function";
}

TEST(accel, stays_between_its_rails_and_refuses_nonsense)
{
    const Track still = {ins_track_create_still(&flat_site, nullptr, nullptr, 0), ins_track_destroy};
    ins_accel_config_t c = paper();
    c.channel[0].bias = 100.0;
    c.channel[1].bias = -100.0;
    ins_accels_t a = made(c, still);
    EXPECT_EQ(ins_accels_volts(&a, 0, 0), 5.0);
    EXPECT_EQ(ins_accels_volts(&a, 1, 0), 0.0);
    const auto refused = [&](const ins_accel_config_t& bad)
    {
        char why[200] = "";
        EXPECT_FALSE(ins_accels_init(&a, &bad, still.get(), why, sizeof why));
        return std::string(why);
    };
    c.channel[4].axis[0] = 9.0;
    EXPECT_NE(refused(c).find("accelerometer  5: the length of axis"), std::string::npos);
    c = paper();
    c.channel[2].noise = std::nan("");
    EXPECT_NE(refused(c).find("accelerometer  3: noise"), std::string::npos);
    c = paper();
    c.count = 12;
    EXPECT_NE(refused(c).find("count"), std::string::npos);
}
