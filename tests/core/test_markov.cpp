/// \file   test_markov.cpp
/// \brief  Gauss-Markov states: against exp and expm1, the thesis's presets, composition of steps, refusals.
/// SPDX-License-Identifier: MIT
#include "core_test.h"
using namespace core_test;

namespace
{
constexpr double TOL_DECAY = INS_TOL(2e-15, 1e-6); ///< relative
} // namespace

TEST(markov, decay_and_noise_to_the_last_digits)
{
    Worst phi;
    Worst q;
    for (double ratio = 1e-9; ratio < 30; ratio *= 1.37)
    {
        ins_markov_t m;
        const ins_real dt = static_cast<ins_real>(ratio);
        ASSERT_EQ(ins_markov_init(&m, dt, 1, 2), INS_OK);
        const double x = static_cast<double>(dt);
        phi.take(static_cast<double>(m.phi), std::exp(-x), std::exp(-x) * (1 + x), "phi " + std::to_string(ratio));
        q.take(static_cast<double>(m.q), -4 * std::expm1(-2 * x), -4 * std::expm1(-2 * x),
               "q " + std::to_string(ratio));
    }
    expect_within(phi, TOL_DECAY, "phi, error over exp(-x) (1 + x)");
    expect_within(q, TOL_DECAY, "q, relative");
}

TEST(markov, limits)
{
    ins_markov_t m;
    ASSERT_EQ(ins_markov_init(&m, 0, 5, 3), INS_OK);
    EXPECT_EQ(m.phi, 1);
    EXPECT_EQ(m.q, 0);
    ASSERT_EQ(ins_markov_init(&m, std::numeric_limits<ins_real>::max(), INS_C(0.5), 3), INS_OK);
    EXPECT_EQ(m.phi, 0);
    EXPECT_EQ(m.q, 9);
}

TEST(markov, presets_of_the_thesis)
{
    const double deg_per_hour = PI / 180 / 3600;
    EXPECT_NEAR(static_cast<double>(INS_MARKOV_GIMBAL_SIGMA), 0.01 * deg_per_hour, 1e-14);
    EXPECT_NEAR(static_cast<double>(INS_MARKOV_STRAPDOWN_SIGMA), deg_per_hour, 1e-12);
    EXPECT_EQ(INS_MARKOV_GIMBAL_TAU_S, 7200);
    EXPECT_EQ(INS_MARKOV_STRAPDOWN_TAU_S, 300);
    // In the long run the variance is sigma^2, and density 2 sigma^2/tau gives q over a short step.
    ins_markov_t m;
    ASSERT_EQ(ins_markov_init(&m, INS_C(0.01), INS_MARKOV_STRAPDOWN_TAU_S, INS_MARKOV_STRAPDOWN_SIGMA), INS_OK);
    const double variance = deg_per_hour * deg_per_hour;
    EXPECT_NEAR(static_cast<double>(m.q), 2 * variance / 300 * 0.01, 1e-4 * 2 * variance / 300 * 0.01);
    ASSERT_EQ(ins_markov_init(&m, 100, INS_MARKOV_STRAPDOWN_TAU_S, INS_MARKOV_STRAPDOWN_SIGMA), INS_OK);
    double p = 0;
    for (int k = 0; k < 200; k++)
    {
        p = static_cast<double>(m.phi) * static_cast<double>(m.phi) * p + static_cast<double>(m.q);
    }
    EXPECT_NEAR(p, variance, 1e-5 * variance);
}

TEST(markov, refusals)
{
    const ins_real nan = std::numeric_limits<ins_real>::quiet_NaN();
    ins_markov_t m = {7, 8};
    EXPECT_EQ(ins_markov_init(&m, -1, 1, 1), INS_E_RANGE);
    EXPECT_EQ(ins_markov_init(&m, nan, 1, 1), INS_E_RANGE);
    EXPECT_EQ(ins_markov_init(&m, 1, 0, 1), INS_E_RANGE);
    EXPECT_EQ(ins_markov_init(&m, 1, nan, 1), INS_E_RANGE);
    EXPECT_EQ(ins_markov_init(&m, 1, 1, -1), INS_E_RANGE);
    EXPECT_EQ(ins_markov_init(&m, 1, 1, nan), INS_E_RANGE);
    EXPECT_EQ(m.phi, 7);
    EXPECT_EQ(m.q, 8);
}
