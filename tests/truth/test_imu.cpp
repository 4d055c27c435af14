// Errors of an IMU: each alone against its formula, each random one against its Allan variance, bits, refusals.
// SPDX-License-Identifier: MIT
#include "ins_truth/imu.h"
#include "near.hpp"
#include <array>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

namespace
{
using Vec = std::array<double, 3>;
constexpr double dt_s = 0.01;
constexpr double pi = 3.14159265358979323846;
constexpr std::uint64_t seed = 5;
constexpr std::size_t reduced_samples = 1u << 17;
constexpr std::size_t bench_samples = 1u << 22; ///< with INS_BENCH=1
constexpr double sigmas = 4.5;
constexpr std::uint64_t pinned = 15282641065115268205u;

struct Sample
{
    Vec theta, v;
};

ins_imu_config_t ideal()
{
    ins_imu_config_t c;
    ins_imu_ideal_config(&c);
    c.seed = seed;
    return c;
}

ins_imu_t made(const ins_imu_config_t& c)
{
    ins_imu_t imu;
    char why[200] = "";
    EXPECT_TRUE(ins_imu_init(&imu, &c, why, sizeof why)) << why;
    return imu;
}

Sample apply(ins_imu_t& imu, const Sample& in, double above_k = 0.0)
{
    Sample out;
    ins_imu_apply(&imu, dt_s, above_k, in.theta.data(), in.v.data(), out.theta.data(), out.v.data());
    return out;
}

constexpr Sample moving = {{0.003, -0.002, 0.001}, {0.02, 0.05, -0.098}};

void expect_near(const Vec& got, const Vec& want, double tolerance)
{
    EXPECT_LE(max_difference(got.data(), want.data(), 3), tolerance) << got[0] << " " << got[1] << " " << got[2];
}

/// Overlapping Allan variance of increments at m of them, and how many independent pairs stand behind it.
double allan_variance(const std::vector<double>& increments, std::size_t m)
{
    std::vector<double> angle = {0.0};
    for (double x : increments)
    {
        angle.push_back(angle.back() + x);
    }
    const double tau = static_cast<double>(m) * dt_s;
    double sum = 0.0;
    const std::size_t count = angle.size() - 2 * m;
    for (std::size_t k = 0; k < count; k++)
    {
        const double d = angle[k + 2 * m] - 2.0 * angle[k + m] + angle[k];
        sum += d * d;
    }
    return sum / (2.0 * tau * tau * static_cast<double>(count));
}

/// Output of channel y of a triad at rest for so many samples.
std::vector<double> record(const ins_imu_config_t& c, bool accel, std::size_t samples)
{
    ins_imu_t imu = made(c);
    std::vector<double> out;
    for (std::size_t k = 0; k < samples; k++)
    {
        const Sample s = apply(imu, {});
        out.push_back(accel ? s.v[1] : s.theta[1]);
    }
    return out;
}

std::size_t samples()
{
    return std::getenv("INS_BENCH") != nullptr ? bench_samples : reduced_samples;
}

/// \param[in] want  variance by tau [s]; \param[in] slack  relative, of the model itself
void expect_allan(const ins_imu_config_t& c, bool accel, const std::vector<std::size_t>& lengths,
                  const std::function<double(double)>& want, double slack)
{
    const std::vector<double> out = record(c, accel, samples());
    for (std::size_t m : lengths)
    {
        // Relative standard deviation of the estimate: about sqrt(1.5 / independent pairs) at worst (Greenhall 1991).
        const double spread = std::sqrt(1.5 * static_cast<double>(m) / static_cast<double>(out.size()));
        const double tau = static_cast<double>(m) * dt_s;
        EXPECT_NEAR(allan_variance(out, m) / want(tau), 1.0, slack + sigmas * spread)
            << "tau " << tau << " seed " << seed;
    }
}

ins_imu_triad_t& triad(ins_imu_config_t& c, bool accel)
{
    return accel ? c.accel : c.gyro;
}
} // namespace

TEST(imu, an_ideal_one_changes_nothing)
{
    ins_imu_t imu = made(ideal());
    const Sample out = apply(imu, moving, 30.0);
    EXPECT_EQ(out.theta, moving.theta);
    EXPECT_EQ(out.v, moving.v);
}

TEST(imu, each_constant_error_is_its_formula)
{
    ins_imu_config_t c = ideal();
    const double scale[3] = {0.01, -0.02, 0.03};
    const double bias[3] = {0.1, 0.2, -0.3};
    const double m[9] = {0, 1e-3, 2e-3, 3e-3, 0, 4e-3, 5e-3, 6e-3, 0};
    const double g[9] = {1e-4, 2e-4, 3e-4, 4e-4, 5e-4, 6e-4, 7e-4, 8e-4, 9e-4};
    const double bias_per_k[3] = {1e-3, -2e-3, 0.0};
    const double scale_per_k[3] = {0.0, 1e-4, -1e-4};
    for (ins_imu_triad_t* t : {&c.gyro, &c.accel})
    {
        std::memcpy(t->scale, scale, sizeof scale);
        std::memcpy(t->bias, bias, sizeof bias);
        std::memcpy(t->misalignment, m, sizeof m);
        std::memcpy(t->bias_per_k, bias_per_k, sizeof bias_per_k);
        std::memcpy(t->scale_per_k, scale_per_k, sizeof scale_per_k);
    }
    std::memcpy(c.g_sensitivity, g, sizeof g);
    ins_imu_t imu = made(c);
    const double above_k = 12.0;
    const Sample out = apply(imu, moving, above_k);
    Vec theta;
    Vec v;
    for (std::size_t i = 0; i < 3; i++)
    {
        const double k = 1.0 + scale[i] + scale_per_k[i] * above_k;
        const double b = (bias[i] + bias_per_k[i] * above_k) * dt_s;
        theta[i] = moving.theta[i] * k + b;
        v[i] = moving.v[i] * k + b;
        for (std::size_t j = 0; j < 3; j++)
        {
            theta[i] += m[3 * i + j] * moving.theta[j] + g[3 * i + j] * moving.v[j];
            v[i] += m[3 * i + j] * moving.v[j];
        }
    }
    expect_near(out.theta, theta, 1e-17);
    expect_near(out.v, v, 1e-16);
    expect_near({imu.gyro.bias[0], imu.gyro.bias[1], imu.gyro.bias[2]}, {0.112, 0.176, -0.3}, 1e-16);
}

TEST(imu, random_walk_has_its_allan_variance)
{
    for (bool accel : {false, true})
    {
        ins_imu_config_t c = ideal();
        triad(c, accel).random_walk[1] = 3e-4;
        expect_allan(
            c, accel, {1, 4, 16, 64, 256}, [](double tau) { return 9e-8 / tau; }, 0.0);
    }
}

TEST(imu, rate_random_walk_has_its_allan_variance)
{
    for (bool accel : {false, true})
    {
        ins_imu_config_t c = ideal();
        triad(c, accel).rate_random_walk[1] = 2e-3;
        expect_allan(
            c, accel, {64, 256, 1024}, [](double tau) { return 4e-6 * tau / 3.0; }, 0.001);
    }
}

TEST(imu, quantisation_has_its_allan_variance_and_loses_no_angle)
{
    ins_imu_config_t c = ideal();
    c.gyro.quantum = 1e-4;
    ins_imu_t imu = made(c);
    Random random = {seed};
    std::vector<double> error;
    double left = 0.0;
    for (std::size_t k = 0; k < samples(); k++)
    {
        const Sample in = {{0, random(-0.01, 0.01), 0}, {0, 0, 0}};
        const double x = apply(imu, in).theta[1];
        EXPECT_EQ(x, 1e-4 * std::floor(x / 1e-4 + 0.5));
        error.push_back(x - in.theta[1]);
        left += error.back();
        ASSERT_LE(std::fabs(left), 0.5001e-4);
    }
    const double q2 = 1e-8 / 12.0;
    for (std::size_t m : {100, 1000})
    {
        const double tau = static_cast<double>(m) * dt_s;
        EXPECT_NEAR(allan_variance(error, m) * tau * tau / (3.0 * q2), 1.0, 0.05) << "tau " << tau;
    }
}

TEST(imu, bias_instability_is_flat_at_0_664_of_b)
{
    constexpr double b = 1e-3;
    ins_imu_config_t c = ideal();
    c.gyro.bias_instability[1] = b;
    const double floor = b * b * 2.0 * std::log(2.0) / pi;
    expect_allan(
        c, false, {128, 512, 2048}, [&](double) { return floor; }, 0.06);
}

TEST(imu, a_markov_bias_has_its_variance_and_correlation)
{
    constexpr double sigma = 0.02;
    ins_imu_config_t c = ideal();
    c.accel.markov[1] = sigma;
    c.accel.markov_tau_s = 0.5;
    const std::vector<double> out = record(c, true, samples());
    const double spread = sigmas * std::sqrt(2.0 * 0.5 / dt_s / static_cast<double>(out.size()));
    for (std::size_t lag : {0, 25, 50, 100})
    {
        double sum = 0.0;
        for (std::size_t k = lag; k < out.size(); k++)
        {
            sum += out[k] * out[k - lag];
        }
        const double got = sum / static_cast<double>(out.size() - lag) / (sigma * sigma * dt_s * dt_s);
        EXPECT_NEAR(got, std::exp(-static_cast<double>(lag) * dt_s / 0.5), spread) << "lag " << lag << " seed " << seed;
    }
}

TEST(imu, turn_on_bias_is_drawn_once_for_each_seed)
{
    constexpr int seeds = 4000;
    double sum = 0.0;
    double squares = 0.0;
    for (int k = 0; k < seeds; k++)
    {
        ins_imu_config_t c = ideal();
        c.seed = static_cast<std::uint64_t>(k);
        c.gyro.turn_on[2] = 0.5;
        ins_imu_t imu = made(c);
        const double first = apply(imu, {}).theta[2] / dt_s;
        EXPECT_NEAR(apply(imu, {}).theta[2] / dt_s, first, 1e-15);
        EXPECT_NEAR(imu.gyro.bias[2], first, 1e-15) << "what a filter is to estimate";
        sum += first;
        squares += first * first;
    }
    EXPECT_NEAR(sum / seeds, 0.0, sigmas * 0.5 / std::sqrt(seeds));
    EXPECT_NEAR(squares / seeds / 0.25, 1.0, sigmas * std::sqrt(2.0 / seeds));
}

TEST(imu, beyond_its_range_it_is_clipped_and_counted)
{
    ins_imu_config_t c = ideal();
    c.gyro.range = 0.25;
    ins_imu_t imu = made(c);
    const Sample out = apply(imu, {{0.003, -0.0026, 0.002}, {0, 0, 0}});
    expect_near(out.theta, {0.0025, -0.0025, 0.002}, 1e-18);
    EXPECT_EQ(imu.gyro.saturated, 2u);
    EXPECT_EQ(imu.accel.saturated, 0u);
}

TEST(imu, axes_triads_and_causes_are_independent)
{
    ins_imu_config_t c = ideal();
    for (ins_imu_triad_t* t : {&c.gyro, &c.accel})
    {
        for (int i = 0; i < 3; i++)
        {
            t->random_walk[i] = 0.1;
        }
    }
    ins_imu_t imu = made(c);
    constexpr int count = 20000;
    std::array<std::array<double, 6>, 6> products{};
    for (int k = 0; k < count; k++)
    {
        const Sample s = apply(imu, {});
        for (std::size_t i = 0; i < 6; i++)
        {
            for (std::size_t j = 0; j < 6; j++)
            {
                products[i][j] += (i < 3 ? s.theta[i] : s.v[i - 3]) * (j < 3 ? s.theta[j] : s.v[j - 3]);
            }
        }
    }
    for (std::size_t i = 0; i < 6; i++)
    {
        for (std::size_t j = 0; j < i; j++)
        {
            EXPECT_NEAR(products[i][j] / products[i][i], 0.0, sigmas / std::sqrt(count)) << i << " " << j;
        }
    }
}

TEST(imu, the_same_seed_gives_the_same_bits)
{
    ins_imu_config_t c = ideal();
    for (ins_imu_triad_t* t : {&c.gyro, &c.accel})
    {
        t->random_walk[0] = t->rate_random_walk[0] = t->markov[0] = t->bias_instability[0] = t->turn_on[0] = 1e-3;
    }
    const auto sum = [](const ins_imu_config_t& config)
    {
        std::uint64_t hash = 14695981039346656037u; // Fowler, Noll and Vo
        ins_imu_t imu = made(config);
        for (int k = 0; k < 1000; k++)
        {
            const Sample s = apply(imu, moving);
            std::uint64_t bits[2];
            std::memcpy(&bits[0], &s.theta[0], 8);
            std::memcpy(&bits[1], &s.v[0], 8);
            hash = (hash ^ bits[0]) * 1099511628211u;
            hash = (hash ^ bits[1]) * 1099511628211u;
        }
        return hash;
    };
    EXPECT_EQ(sum(c), pinned);
    c.seed++;
    EXPECT_NE(sum(c), pinned);
}

TEST(imu, a_refusal_says_what_and_why)
{
    const auto why = [](const std::function<void(ins_imu_config_t&)>& spoil)
    {
        ins_imu_config_t c = ideal();
        ins_imu_t imu;
        char text[200] = "";
        spoil(c);
        EXPECT_FALSE(ins_imu_init(&imu, &c, text, sizeof text));
        return std::string(text);
    };
    EXPECT_EQ(why([](ins_imu_config_t& c) { c.accel.random_walk[2] = -1.0; }),
              "accel: random_walk[2] is -1, give 0 to 1000");
    EXPECT_EQ(why([](ins_imu_config_t& c) { c.gyro.bias[0] = not_a_number; }),
              "gyro: bias[0] is nan, give -1000 to 1000");
    EXPECT_EQ(why([](ins_imu_config_t& c) { c.gyro.misalignment[4] = 0.1; }),
              "gyro: misalignment[4] is 0.1, give 0: what an axis sees of itself is scale");
    EXPECT_EQ(why([](ins_imu_config_t& c) { c.g_sensitivity[8] = infinity; }),
              "g_sensitivity[8] is inf, give -1000 to 1000");
}
