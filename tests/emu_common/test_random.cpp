/// splitmix64 and the normal values made of it.
/// SPDX-License-Identifier: MIT
#include "emu/random.h"
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <gtest/gtest.h>
#include <vector>

namespace
{
constexpr uint64_t kSeed = 20061;
constexpr std::size_t kValues = 400000;
constexpr std::size_t kBenchValues = 10000000; ///< with INS_BENCH=1
} // namespace

TEST(random, splitmix64_as_published)
{
    uint64_t state = 1234567; // the first values of Vigna's reference for this seed
    EXPECT_EQ(emu_random(&state), 6457827717110365317u);
    EXPECT_EQ(emu_random(&state), 3203168211198807973u);
    EXPECT_EQ(emu_random(&state), 9817491932198370423u);
}

TEST(random, normal_values_are_normal_and_independent)
{
    uint64_t state = kSeed;
    std::vector<double> x(std::getenv("INS_BENCH") != nullptr ? kBenchValues : kValues);
    for (double& v : x)
    {
        v = emu_random_normal(&state);
    }
    const double n = static_cast<double>(x.size());
    const double limit = 5.0 / std::sqrt(n); // five standard deviations of a mean
    double mean = 0, square = 0, third = 0, fourth = 0, next = 0;
    for (std::size_t k = 0; k < x.size(); k++)
    {
        mean += x[k] / n;
        square += x[k] * x[k] / n;
        third += x[k] * x[k] * x[k] / n;
        fourth += x[k] * x[k] * x[k] * x[k] / n;
        next += k > 0 ? x[k] * x[k - 1] / n : 0.0;
    }
    EXPECT_NEAR(mean, 0.0, limit) << "seed " << kSeed;
    EXPECT_NEAR(square, 1.0, limit * std::sqrt(2.0)) << "seed " << kSeed;
    EXPECT_NEAR(third, 0.0, limit * std::sqrt(15.0)) << "seed " << kSeed;
    EXPECT_NEAR(fourth, 3.0, limit * std::sqrt(96.0)) << "seed " << kSeed;
    EXPECT_NEAR(next, 0.0, limit) << "seed " << kSeed;
    std::sort(x.begin(), x.end());
    double worst = 0.0; // Kolmogorov and Smirnov
    for (std::size_t k = 0; k < x.size(); k++)
    {
        const double below = 0.5 * std::erfc(-x[k] / std::sqrt(2.0));
        worst = std::max(
            {worst, std::fabs(below - static_cast<double>(k) / n), std::fabs(below - static_cast<double>(k + 1) / n)});
    }
    EXPECT_LE(worst, 2.23 / std::sqrt(n)) << "exceeded once in ten thousand; seed " << kSeed;
    EXPECT_GT(x.back(), 4.0) << "a tail, seed " << kSeed;
}

TEST(random, normal_values_keep_their_bits)
{
    uint64_t state = kSeed;
    uint64_t sum = 0;
    for (int k = 0; k < 1000; k++)
    {
        const double v = emu_random_normal(&state);
        uint64_t bits;
        std::memcpy(&bits, &v, sizeof bits);
        sum = sum * 3 + bits;
    }
    EXPECT_EQ(sum, 3354934802568836220u); // a change here changes every recorded run
}
