/// \file   test_shaped.cpp
/// \brief  Coning coefficients shaped for a band of vibration, and the turn of the navigation frame.
/// SPDX-License-Identifier: MIT
#include "core_test.h"
using namespace core_test;

namespace
{
/// Coefficients K1 (of theta_1 back) and K2 (two back) of a form, as the library uses them.
std::array<double, 2> coefficients(int form)
{
    std::array<double, 2> k;
    for (size_t back = 1; back <= 2; back++)
    {
        ins_real theta[9] = {0};
        theta[3 * (2 - back)] = 1; // x
        theta[7] = 1;              // y
        ins_real phi[3];
        EXPECT_EQ(ins_coning_phi(form, theta, phi), INS_OK);
        k[back - 1] = static_cast<double>(phi[2]);
    }
    return k;
}

/// Drift over a^2 Omega at mu radians of the cone's turn an increment.
double drift(const std::array<double, 2>& k, double mu)
{
    return (2 * (1 - std::cos(mu)) * (k[0] * std::sin(mu) + k[1] * std::sin(2 * mu)) - (mu - std::sin(mu)) / 2) / mu;
}

double peak(const std::array<double, 2>& k, double top)
{
    double worst = 0;
    for (int i = 1; i <= 1000; i++)
    {
        worst = larger(worst, std::fabs(drift(k, top * i / 1000)));
    }
    return worst;
}

const struct
{
    int form;
    double top;       ///< end of the band [rad]
    double published; ///< times the peak is below the Taylor-optimal form's
    double peak;
} BANDS[] = {{INS_CONING_HIST2_MU03, 0.3, 9.29, 2.754e-7},
             {INS_CONING_HIST2_MU06, 0.6, 8.84, 1.757e-5},
             {INS_CONING_HIST2_MU10, 1.0, 7.84, 3.748e-4}};
} // namespace

TEST(shaped, least_peak_over_the_band)
{
    for (const auto& b : BANDS)
    {
        const auto k = coefficients(b.form);
        EXPECT_EQ(ins_coning_samples(b.form), 3);
        EXPECT_EQ(ins_coning_is_block(b.form), 0);
        EXPECT_NEAR(k[0] + 2 * k[1], 1.0 / 12, INS_TOL(1e-16, 1e-8));
        const double mine = peak(k, b.top);
        EXPECT_NEAR(mine / b.peak, 1, INS_TOL(1e-3, 0.1));
        EXPECT_NEAR(peak(coefficients(INS_CONING_HIST2_OPT), b.top) / mine, b.published, INS_TOL(0.01, 0.5));
        for (const double shift : {-1e-5, 1e-5}) // a least peak: worse on both sides
        {
            EXPECT_GT(peak({k[0] - 2 * shift, k[1] + shift}, b.top), mine);
        }
    }
}

#ifndef INS_REAL_FLOAT
TEST(shaped, drift_of_the_running_step)
{
    // A cone of 1 degree for whole cycles: the step drifts as the formula says.
    const double a = PI / 180;
    for (const auto& b : BANDS)
    {
        const int per_cycle = static_cast<int>(std::ceil(2 * PI / b.top));
        const double mu = 2 * PI / per_cycle;
        ins_attitude_t s;
        const Quat start = {std::cos(a / 2), 0, std::sin(a / 2), 0};
        ASSERT_EQ(ins_attitude_init(&s, b.form, real(start).data()), INS_OK);
        const int steps = 10 * per_cycle;
        for (int k = -2; k < steps; k++)
        {
            const double mid = (k + 0.5) * mu;
            const double chord = 2 * std::sin(a) * std::sin(mu / 2);
            const Vec theta = {-2 * mu * std::sin(a / 2) * std::sin(a / 2), -chord * std::sin(mid),
                               chord * std::cos(mid)};
            ASSERT_EQ(ins_attitude_step(&s, real(theta).data()), k < 0 ? INS_S_START : INS_OK);
            if (k == -1)
            {
                std::copy(start.begin(), start.end(), s.q_nb);
            }
        }
        const double got = rotation_between(quat(s.q_nb), start)[0] / (steps * mu);
        const double want = a * a * drift(coefficients(b.form), mu);
        EXPECT_NEAR(got, want, 0.02 * std::fabs(want) + a * a * a * a * 1e-5) << b.top;
        std::printf("mu %.3f: %.3e a^2 Omega\n", mu, got / (a * a));
    }
}
#endif

TEST(shaped, frame_that_turns_with_the_body_stands_still)
{
    // A body fixed to a frame that turns: the gyro sees the frame's rate, and the compensated attitude does not change.
    const double tilt = 0.6;
    const Quat start = {std::cos(tilt / 2), 0, std::sin(tilt / 2), 0};
    ins_attitude_t s;
    ASSERT_EQ(ins_attitude_init(&s, INS_CONING_HIST2_OPT, real(start).data()), INS_OK);
    const ins_real zeta_n[3] = {INS_C(0.012), INS_C(-0.007), INS_C(0.02)};
    ins_real back[4];
    ins_quat_conj(s.q_nb, back);
    ins_real theta_b[3];
    ins_quat_rotate(back, zeta_n, theta_b);
    for (int k = 0; k < 5000; k++)
    {
        ASSERT_GE(ins_attitude_step(&s, theta_b), INS_OK);
        ASSERT_EQ(ins_attitude_turn_frame(&s, zeta_n), INS_OK);
    }
    EXPECT_LT(angle_between(quat(s.q_nb), start), INS_TOL(2e-13, 1e-4));
}

TEST(shaped, frame_turn_is_on_the_left)
{
    const ins_real heading[4] = {static_cast<ins_real>(std::sqrt(0.5)), 0, 0, static_cast<ins_real>(std::sqrt(0.5))};
    ins_attitude_t s;
    ASSERT_EQ(ins_attitude_init(&s, INS_CONING_HIST2_OPT, heading), INS_OK);
    const ins_real zeta_n[3] = {INS_C(0.3), INS_C(-0.1), INS_C(0.2)};
    ASSERT_EQ(ins_attitude_turn_frame(&s, zeta_n), INS_OK);
    const Vec turned = rotation_between(quat(s.q_nb), quat(heading));
    for (size_t i = 0; i < 3; i++)
    {
        EXPECT_NEAR(turned[i], -static_cast<double>(zeta_n[i]), INS_TOL(1e-15, 3e-7));
    }
    const ins_attitude_t before = s;
    const ins_real bad[3] = {0, static_cast<ins_real>(std::nan("")), 0};
    EXPECT_EQ(ins_attitude_turn_frame(&s, bad), INS_E_RANGE);
    EXPECT_EQ(quat(s.q_nb), quat(before.q_nb));
}
