// Gyro channels: scale and null, clipping, bandwidth against 1 / (1 + i w tau), noise statistics, same bits.
// SPDX-License-Identifier: MIT
#include "ins_truth/elementary.h"
#include "ins_truth/gyro.h"
#include "near.hpp"
#include <complex>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

namespace
{
using Motion = std::unique_ptr<ins_motion_t, decltype(&ins_motion_destroy)>;
constexpr double deg = INS_TRUTH_PI / 180.0;
constexpr std::int64_t ms = 1000000000; // [ps]
constexpr int noise_samples = 200000;
constexpr std::uint64_t noise_seed = 7;

Motion turn(double x, double y, double z)
{
    const double w[3] = {x, y, z};
    const double level[4] = {1.0, 0.0, 0.0, 0.0};
    return {ins_motion_create_rate(w, level, 0.0, nullptr, 0), ins_motion_destroy};
}

/// Yaw alone: the z rate is 2 pi f A cos(2 pi f t).
Motion yaw_swing(double amplitude, double frequency_hz, double ramp_s)
{
    const ins_motion_sines_t sines = {{0.0, amplitude, frequency_hz, 0.0}, {}, {}};
    return {ins_motion_create_euler(&sines, ramp_s, nullptr, 0), ins_motion_destroy};
}

ins_gyro_t gyro_on(const ins_motion_t* motion, const ins_gyro_config_t& config)
{
    ins_gyro_t g;
    char why[200] = "";
    EXPECT_TRUE(ins_gyro_init(&g, &config, motion, why, sizeof why)) << why;
    return g;
}

ins_gyro_config_t ideal()
{
    ins_gyro_config_t c;
    ins_gyro_default_config(&c);
    return c;
}

/// Nearest code of a 12-bit converter over 0 .. 5 V.
long code(double volts)
{
    const long k = std::lround(volts * 4096.0 / 5.0);
    return k > 4095 ? 4095 : k;
}
} // namespace

TEST(gyro, default_spans_90_deg_per_s_with_null_at_code_2048)
{
    const Motion m = turn(45.0 * deg, -45.0 * deg, 0.0);
    ins_gyro_t g = gyro_on(m.get(), ideal());
    EXPECT_NEAR(ins_gyro_volts(&g, 0, 5 * ms), 3.75, 1e-14);
    EXPECT_NEAR(ins_gyro_volts(&g, 1, 5 * ms), 1.25, 1e-14);
    EXPECT_EQ(ins_gyro_volts(&g, 2, 5 * ms), 2.5);
    EXPECT_EQ(ins_gyro_volts(&g, 3, 5 * ms), 0.0);
    EXPECT_EQ(code(ins_gyro_volts(&g, 2, 5 * ms)), 2048);
    EXPECT_EQ(code(ins_gyro_volts(&g, 0, 5 * ms)), 3072);
}

TEST(gyro, clips_at_the_rails)
{
    const Motion m = turn(200.0 * deg, -200.0 * deg, 89.0 * deg);
    ins_gyro_config_t c = ideal();
    c.rail_low_v = 0.1;
    c.rail_high_v = 4.9;
    ins_gyro_t g = gyro_on(m.get(), c);
    EXPECT_EQ(ins_gyro_volts(&g, 0, 0), 4.9);
    EXPECT_EQ(ins_gyro_volts(&g, 1, 0), 0.1);
    EXPECT_EQ(ins_gyro_volts(&g, 2, 0), 4.9);
    EXPECT_NEAR(ins_gyro_rate(&g, 0, 0), 200.0 * deg, 1e-14);
}

TEST(gyro, errors_add_up_as_documented)
{
    const Motion m = turn(0.2, 0.1, -0.3);
    ins_gyro_config_t c = ideal();
    c.channel[1].axis[0] = 0.02;
    c.channel[1].sensitivity = -0.012;
    c.channel[1].gain = 55.0;
    c.channel[1].null_v = 2.4;
    c.channel[1].bias = 0.004;
    c.channel[1].drift = 0.0005;
    c.channel[1].scale_error = 0.03;
    ins_gyro_t g = gyro_on(m.get(), c);
    const double seen = 1.03 * (0.1 + 0.02 * 0.2) + 0.004 + 0.0005 * 12.0;
    EXPECT_NEAR(ins_gyro_volts(&g, 1, 12000 * ms), 2.4 - 55.0 * 0.012 * seen, 1e-14);
}

TEST(gyro, scale_inverts_volts)
{
    ins_gyro_config_t c;
    ins_gyro_cgl53_config(&c);
    for (auto& channel : c.channel)
    {
        channel.noise_density = 0.0;
        channel.drift = 0.0;
    }
    const Motion m = turn(-80.0 * deg, 33.0 * deg, 0.7);
    ins_gyro_t g = gyro_on(m.get(), c);
    const double want[3] = {-80.0 * deg, 33.0 * deg, 0.7};
    for (unsigned i = 0; i < 3; i++)
    {
        double lsb;
        double null_code;
        ASSERT_TRUE(ins_gyro_scale(&c, i, 12, 0.0, 5.0, &lsb, &null_code));
        EXPECT_NEAR((static_cast<double>(code(ins_gyro_volts(&g, i, 0))) - null_code) * lsb, want[i], 0.501 * lsb);
    }
    double lsb;
    double null_code;
    c = ideal();
    ASSERT_TRUE(ins_gyro_scale(&c, 0, 12, 0.0, 5.0, &lsb, &null_code));
    EXPECT_EQ(null_code, 2048.0);
    EXPECT_NEAR(lsb, 180.0 * deg / 4096.0, 1e-18);
    EXPECT_FALSE(ins_gyro_scale(&c, 3, 12, 0.0, 5.0, &lsb, &null_code));
    EXPECT_FALSE(ins_gyro_scale(&c, 0, 12, 5.0, 5.0, &lsb, &null_code));
    EXPECT_FALSE(ins_gyro_scale(&c, 0, 0, 0.0, 5.0, &lsb, &null_code));
}

TEST(gyro, bandwidth_is_first_order)
{
    struct Row
    {
        double ratio;    // motion frequency / bandwidth
        double relative; // to the input's amplitude; what gyro.h states (1e-14: rounding of the motion's argument)
    };
    for (const Row& row :
         {Row{0.02, 1e-14}, Row{0.1, 1e-14}, Row{0.5, 1e-14}, Row{1.0, 4.6e-11}, Row{2.0, 8.3e-5}, Row{4.0, 8.3e-2}})
    {
        const double f = 0.4;
        const double w = 2.0 * INS_TRUTH_PI * f;
        const Motion m = yaw_swing(0.5, f, 0.0);
        ins_gyro_config_t c = ideal();
        c.channel[2].bandwidth_hz = f / row.ratio;
        const ins_gyro_t g = gyro_on(m.get(), c);
        double worst = 0.0;
        for (int k = 0; k < 200; k++)
        {
            const double t = 0.05 * k;
            const std::complex<double> response = 1.0 / std::complex<double>(1.0, row.ratio);
            const double want = (0.5 * w * response * std::polar(1.0, w * t)).real();
            worst = larger(worst, std::fabs(ins_gyro_rate(&g, 2, 50 * k * ms) - want) / (0.5 * w));
        }
        EXPECT_LE(worst, row.relative) << "f / bandwidth = " << row.ratio;
        if (row.ratio >= 1.0)
        {
            EXPECT_GE(worst, 0.5 * row.relative) << "gyro.h and docs/truth.md say worse than it is";
        }
    }
}

TEST(gyro, bandwidth_through_a_ramp)
{
    // The ramp's ends are no analytic points. Reference: Simpson's rule in s over 40 time constants.
    const Motion m = yaw_swing(0.5, 0.4, 1.0);
    ins_gyro_config_t c = ideal();
    c.channel[2].bandwidth_hz = 50.0;
    const ins_gyro_t g = gyro_on(m.get(), c);
    const double tau = 0.5 / (INS_TRUTH_PI * 50.0);
    double worst = 0.0;
    for (int k = -5; k < 250; k++)
    {
        constexpr int steps = 2000;
        double want = 0.0;
        for (int j = 0; j <= steps; j++)
        {
            const double s = 40.0 * j / steps;
            const double weight = j == 0 || j == steps ? 1.0 : (j % 2 == 0 ? 2.0 : 4.0);
            double rate[3];
            ins_motion_rate(m.get(), 0.005 * k - s * tau, rate);
            want += weight * std::exp(-s) * rate[2] * (40.0 / steps / 3.0);
        }
        worst = larger(worst, std::fabs(ins_gyro_rate(&g, 2, 5 * k * ms) - want));
    }
    RecordProperty("worst", std::to_string(worst * 1e9) + "e-9");
    EXPECT_LE(worst, 1e-6); // [rad/s], of 1.26
}

TEST(gyro, noise_is_white_gaussian_and_of_the_stated_density)
{
    const Motion m = turn(0.0, 0.0, 0.0);
    ins_gyro_config_t c = ideal();
    const double density = 0.01 * deg;
    c.noise_bandwidth_hz = 250.0; // cells of 2 ms
    c.seed = noise_seed;
    for (auto& channel : c.channel)
    {
        channel.noise_density = density;
    }
    const ins_gyro_t g = gyro_on(m.get(), c);
    const double sigma = density * std::sqrt(250.0);
    const int n = noise_samples;
    std::vector<double> x[3];
    for (unsigned i = 0; i < 3; i++)
    {
        for (int k = 0; k < n; k++)
        {
            x[i].push_back(ins_gyro_rate(&g, i, (2 * (k - n / 2)) * ms) / sigma); // negative times too
        }
    }
    const double limit = 5.0 / std::sqrt(static_cast<double>(n));
    const auto mean_product = [&](const std::vector<double>& a, const std::vector<double>& b, int lag)
    {
        double sum = 0.0;
        for (int k = lag; k < n; k++)
        {
            sum += a[static_cast<std::size_t>(k)] * b[static_cast<std::size_t>(k - lag)];
        }
        return sum / n;
    };
    for (int i = 0; i < 3; i++)
    {
        double sum = 0.0;
        double fourth = 0.0;
        double square = 0.0;
        int beyond_2 = 0;
        for (double v : x[i])
        {
            sum += v;
            square += v * v;
            fourth += v * v * v * v;
            beyond_2 += std::fabs(v) > 2.0 ? 1 : 0;
        }
        EXPECT_NEAR(sum / n, 0.0, limit) << "seed " << noise_seed;
        EXPECT_NEAR(square / n, 1.0, limit * std::sqrt(2.0)) << "seed " << noise_seed;
        EXPECT_NEAR(fourth / n, 3.0, limit * std::sqrt(96.0)) << "seed " << noise_seed;
        EXPECT_NEAR(static_cast<double>(beyond_2) / n, 0.04550026, limit * 0.21) << "seed " << noise_seed;
        for (int lag = 1; lag <= 50; lag++)
        {
            EXPECT_NEAR(mean_product(x[i], x[i], lag), 0.0, limit) << "lag " << lag << " seed " << noise_seed;
        }
        EXPECT_NEAR(mean_product(x[i], x[(i + 1) % 3], 0), 0.0, limit)
            << "channels " << i << " and next, seed " << noise_seed;
    }
}

TEST(gyro, noise_is_held_within_its_cell_and_differs_by_seed)
{
    const Motion m = turn(0.0, 0.0, 0.0);
    ins_gyro_config_t c = ideal();
    c.channel[0].noise_density = 0.01;
    ins_gyro_t a = gyro_on(m.get(), c); // cells of 1 ms
    c.seed = 2;
    ins_gyro_t b = gyro_on(m.get(), c);
    for (std::int64_t cell : {-3, -1, 0, 4})
    {
        const double v = ins_gyro_volts(&a, 0, cell * ms);
        EXPECT_EQ(ins_gyro_volts(&a, 0, cell * ms + ms - 1), v) << cell;
        EXPECT_NE(ins_gyro_volts(&a, 0, cell * ms + ms), v) << cell;
        EXPECT_NE(ins_gyro_volts(&b, 0, cell * ms), v) << cell;
    }
}

TEST(gyro, volts_do_not_depend_on_the_order_asked_and_keep_their_bits)
{
    const ins_motion_sines_t sines = {{0.2, 1.0, 0.2, 0.3}, {0.1, 0.5, 0.3, -1.0}, {-0.4, 0.3, 0.25, 2.0}};
    const Motion m(ins_motion_create_euler(&sines, 1.5, nullptr, 0), ins_motion_destroy);
    ins_gyro_config_t c;
    ins_gyro_cgl53_config(&c);
    ins_gyro_t g = gyro_on(m.get(), c);
    std::uint64_t forward = 0;
    std::uint64_t backward = 0;
    const auto bits = [&](std::int64_t k)
    {
        const double v = ins_gyro_volts(&g, static_cast<unsigned>(k % 3), k * 6999999937);
        std::uint64_t b;
        std::memcpy(&b, &v, sizeof b);
        return b * (2u * static_cast<std::uint64_t>(k) + 1u);
    };
    for (std::int64_t k = 0; k < 3000; k++)
    {
        forward += bits(k);
        backward += bits(2999 - k);
    }
    EXPECT_EQ(forward, backward);
    // The same on every x86-64 machine, compiler and optimisation level; a change here changes every recorded run.
    EXPECT_EQ(forward, 1645613353980385287u);
}

TEST(gyro, refuses_bad_parameters_by_name)
{
    const Motion m = turn(0.0, 0.0, 0.0);
    char why[200];
    const auto refused = [&](const ins_gyro_config_t& c, const char* place)
    {
        ins_gyro_t g;
        why[0] = '\0';
        EXPECT_FALSE(ins_gyro_init(&g, &c, m.get(), why, sizeof why)) << place;
        EXPECT_NE(std::string(why).find(place), std::string::npos) << "got: " << why;
    };
    ins_gyro_config_t c = ideal();
    c.channel[1].sensitivity = 0.0;
    refused(c, "channel Y: |sensitivity| is 0");
    c = ideal();
    c.channel[0].gain = not_a_number;
    refused(c, "channel X: |gain| is nan");
    c = ideal();
    c.channel[2].bandwidth_hz = -5.0;
    refused(c, "channel Z: bandwidth_hz (0 = unlimited) is -5");
    c = ideal();
    c.channel[2].noise_density = -1.0;
    refused(c, "channel Z: noise_density is -1");
    c = ideal();
    c.channel[0].axis[1] = 1.0;
    refused(c, "channel X: the length of axis");
    c = ideal();
    c.rail_high_v = -1.0;
    refused(c, "rail_high_v (above rail_low_v) is -1");
    c = ideal();
    c.noise_bandwidth_hz = 0.0;
    refused(c, "noise_bandwidth_hz is 0");
}
