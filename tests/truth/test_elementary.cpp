// Own elementary functions against the 80-bit ones of the C library.
// SPDX-License-Identifier: MIT
#include "ins_truth/elementary.h"
#include "near.hpp"
#include <cfloat>

static_assert(LDBL_MANT_DIG >= 64, "the reference must be better than double");

namespace
{
constexpr int draws = 200000;
constexpr std::uint64_t seed = 2026;
constexpr double tolerance = 1e-15;

double sincos_error(double x)
{
    double s;
    double c;
    ins_truth_sincos(x, &s, &c);
    const long double es = std::fabs(static_cast<long double>(s) - std::sin(static_cast<long double>(x)));
    const long double ec = std::fabs(static_cast<long double>(c) - std::cos(static_cast<long double>(x)));
    return static_cast<double>(es > ec ? es : ec);
}
} // namespace

TEST(elementary, sincos_within_1e6_rad)
{
    Random random{seed};
    double worst = 0.0;
    for (int k = 0; k < draws; k++)
    {
        const double scale = std::pow(10.0, random(-3.0, 6.0));
        worst = larger(worst, sincos_error(random(-scale, scale)));
    }
    for (int k = -600000; k <= 600000; k += 7) // where the reduction cancels most
    {
        worst = larger(worst, sincos_error(k * (INS_TRUTH_PI / 2.0)));
        worst = larger(worst, sincos_error((k + 0.5) * (INS_TRUTH_PI / 2.0)));
    }
    RecordProperty("worst", std::to_string(worst * 1e16) + "e-16");
    EXPECT_LE(worst, tolerance) << "seed " << seed;
}

TEST(elementary, sincos_beyond_1e6_rad_errs_by_an_ulp_of_the_argument)
{
    for (double x : {1.5e6, 3.7e7, -2.9e8, 6.1e9})
    {
        EXPECT_LE(sincos_error(x), 1.5 * std::fabs(x) * DBL_EPSILON) << x;
    }
}

TEST(elementary, sincos_of_no_number_is_no_number)
{
    for (double x : {infinity, -infinity, not_a_number})
    {
        double s = 0.0;
        double c = 0.0;
        ins_truth_sincos(x, &s, &c);
        EXPECT_TRUE(std::isnan(s) && std::isnan(c)) << x;
    }
}

TEST(elementary, atan2_all_round)
{
    Random random{seed};
    double worst = 0.0;
    for (int k = 0; k < draws; k++)
    {
        const double angle = random(-INS_TRUTH_PI, INS_TRUTH_PI);
        const double length = std::pow(10.0, random(-6.0, 6.0));
        const double y = length * std::sin(angle);
        const double x = length * std::cos(angle);
        const long double want = std::atan2(static_cast<long double>(y), static_cast<long double>(x));
        worst = larger(worst, static_cast<double>(std::fabs(static_cast<long double>(ins_truth_atan2(y, x)) - want)));
    }
    RecordProperty("worst", std::to_string(worst * 1e16) + "e-16");
    EXPECT_LE(worst, tolerance) << "seed " << seed;
    EXPECT_EQ(ins_truth_atan2(0.0, 0.0), 0.0);
    EXPECT_EQ(ins_truth_atan2(0.0, -1.0), INS_TRUTH_PI);
    EXPECT_EQ(ins_truth_atan2(-1.0, 0.0), -INS_TRUTH_PI / 2.0);
}

TEST(elementary, log_of_normal_numbers)
{
    Random random{seed};
    double worst = 0.0;
    for (int k = 0; k < draws; k++)
    {
        const double x = k % 2 == 0 ? std::pow(10.0, random(-300.0, 300.0)) : random(0.0, 2.0);
        const long double want = std::log(static_cast<long double>(x));
        const long double error = std::fabs(static_cast<long double>(ins_truth_log(x)) - want);
        worst = larger(worst, static_cast<double>(error / std::max(1.0L, std::fabs(want))));
    }
    RecordProperty("worst", std::to_string(worst * 1e16) + "e-16");
    EXPECT_LE(worst, tolerance) << "seed " << seed;
    EXPECT_EQ(ins_truth_log(1.0), 0.0);
    for (double x : {0.0, -1.0, infinity, not_a_number})
    {
        EXPECT_TRUE(std::isnan(ins_truth_log(x))) << x;
    }
}

TEST(elementary, exp_from_end_to_end)
{
    Random random = {5};
    long double worst = 0.0L;
    for (int k = 0; k < 200000; k++)
    {
        const double x = k % 2 == 0 ? random(-708.0, 709.0) : random(-1.0, 1.0);
        const long double want = std::exp(static_cast<long double>(x));
        worst = std::max(worst, std::fabs(static_cast<long double>(ins_truth_exp(x)) - want) / want);
    }
    RecordProperty("worst", std::to_string(static_cast<double>(worst) * 1e16) + "e-16");
    EXPECT_LE(worst, 1e-15L);
    EXPECT_EQ(ins_truth_exp(0.0), 1.0);
    EXPECT_EQ(ins_truth_exp(-709.0), 0.0);
    EXPECT_EQ(ins_truth_exp(-infinity), 0.0);
    EXPECT_EQ(ins_truth_exp(709.5), infinity);
    EXPECT_TRUE(std::isnan(ins_truth_exp(not_a_number)));
}
