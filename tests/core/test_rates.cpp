/// \file   test_rates.cpp
/// \brief  Adams-Moulton integration of sampled rates, gaps, and channel skew. Units: rad/s, s, rad.
/// SPDX-License-Identifier: MIT
#include "core_test.h"
#include <limits>
using namespace core_test;

namespace
{
const double TOL = INS_TOL(1e-14, 1e-5); // on integrals and values of some 1..30
const ins_real NOT_A_NUMBER = std::numeric_limits<ins_real>::quiet_NaN();
const ins_real INFINITE = std::numeric_limits<ins_real>::infinity();

double power(double t, unsigned n)
{
    return std::pow(t, static_cast<double>(n));
}
} // namespace

TEST(rates, each_order_is_exact_for_its_polynomial_and_not_beyond)
{
    const double period = 0.5;
    for (unsigned order = 2; order <= INS_RATES_ORDER_MAX; order++)
    {
        for (unsigned degree = 0; degree <= order; degree++)
        {
            ins_rates_t r;
            ASSERT_EQ(ins_rates_init(&r, static_cast<uint_least8_t>(order), static_cast<ins_real>(period)), INS_OK);
            ins_real theta[3];
            for (unsigned k = 0; k < 6; k++)
            {
                const double w = power(k * period, degree);
                const auto sample = real(Vec{w, -2 * w, 0});
                EXPECT_EQ(ins_rates_add(&r, sample.data(), theta), k + 1 < order ? INS_S_START : INS_OK);
            }
            const double exact = (power(5 * period, degree + 1) - power(4 * period, degree + 1)) / (degree + 1);
            const double error = std::fabs(static_cast<double>(theta[0]) - exact);
            if (degree < order)
            {
                EXPECT_LE(error, TOL) << "order " << order << ", t^" << degree;
            }
            else
            {
                EXPECT_GT(error, 100 * TOL) << "order " << order << ", t^" << degree;
            }
            EXPECT_EQ(theta[1], -2 * theta[0]);
            EXPECT_EQ(theta[2], 0);
        }
    }
}

TEST(rates, start_up_integrates_with_the_samples_there_are)
{
    ins_rates_t r;
    ASSERT_EQ(ins_rates_init(&r, 4, 1), INS_OK);
    ins_real theta[3] = {9, 9, 9};
    const double exact[] = {0, 0.5, 7.0 / 3}; // none, trapezoid of t^2, AM3 of t^2
    for (int k = 0; k < 3; k++)
    {
        const ins_real w[3] = {static_cast<ins_real>(k * k), 0, 0};
        EXPECT_EQ(ins_rates_add(&r, w, theta), INS_S_START);
        EXPECT_NEAR(static_cast<double>(theta[0]), exact[k], INS_TOL(1e-15, 3e-7)) << k;
    }
}

TEST(rates, a_gap_is_bridged_by_a_trapezoid_and_the_history_restarts)
{
    ins_rates_t r;
    ASSERT_EQ(ins_rates_init(&r, 3, INS_C(0.5)), INS_OK);
    ins_real theta[3];
    const ins_real w0[3] = {1, 2, 3};
    const ins_real w1[3] = {3, 2, 1};
    EXPECT_EQ(ins_rates_bridge(&r, 4, w0, theta), INS_S_START); // nothing to bridge from
    EXPECT_EQ(theta[0], 0);
    EXPECT_EQ(ins_rates_bridge(&r, 4, w1, theta), INS_OK); // 5 periods
    EXPECT_EQ(theta[0], 5);
    EXPECT_EQ(theta[1], 5);
    EXPECT_EQ(theta[2], 5);
    EXPECT_EQ(ins_rates_add(&r, w0, theta), INS_S_START); // a trapezoid again
    EXPECT_EQ(theta[0], 1);
    EXPECT_EQ(ins_rates_add(&r, w0, theta), INS_OK);
    EXPECT_EQ(ins_rates_bridge(&r, 0, w0, theta), INS_E_RANGE);
    EXPECT_EQ(ins_rates_bridge(&r, 4294967295u, w0, theta), INS_OK);
    EXPECT_EQ(theta[0], INS_C(0.5) * 4294967296);
}

TEST(rates, refuses_and_stays_as_it_was)
{
    ins_rates_t r;
    EXPECT_EQ(ins_rates_init(&r, 1, 1), INS_E_RANGE);
    EXPECT_EQ(ins_rates_init(&r, INS_RATES_ORDER_MAX + 1, 1), INS_E_RANGE);
    for (const ins_real period : {INS_C(0.0), INS_C(-1.0), NOT_A_NUMBER, INFINITE})
    {
        EXPECT_EQ(ins_rates_init(&r, 2, period), INS_E_RANGE);
    }
    ASSERT_EQ(ins_rates_init(&r, 2, 1), INS_OK);
    const ins_real good[3] = {1, 2, 3};
    ins_real theta[3];
    ins_rates_add(&r, good, theta);
    theta[0] = 9;
    for (const ins_real bad : {NOT_A_NUMBER, INFINITE, -INFINITE})
    {
        const ins_real w[3] = {0, bad, 0};
        EXPECT_EQ(ins_rates_add(&r, w, theta), INS_E_RANGE);
        EXPECT_EQ(ins_rates_bridge(&r, 1, w, theta), INS_E_RANGE);
        EXPECT_EQ(theta[0], 9);
        EXPECT_EQ(r.count, 1);
        EXPECT_EQ(r.w[0][1], 2);
    }
}

TEST(skew, each_order_is_exact_for_its_polynomial)
{
    const double period = 0.5;
    const Vec delay = {0, 0.1, 0.45};
    for (unsigned order = 1; order <= 3; order++)
    {
        for (unsigned degree = 0; degree <= order + 1; degree++)
        {
            ins_skew_t s;
            ASSERT_EQ(
                ins_skew_init(&s, static_cast<uint_least8_t>(order), real(delay).data(), static_cast<ins_real>(period)),
                INS_OK);
            ins_real x[3];
            double t = 0;
            for (unsigned k = 0; k < 6; k++)
            {
                t = k * period;
                const auto raw =
                    real(Vec{power(t + delay[0], degree), power(t + delay[1], degree), power(t + delay[2], degree)});
                std::copy(raw.begin(), raw.end(), x);
                EXPECT_EQ(ins_skew_add(&s, x, x), k < order ? INS_S_START : INS_OK); // in place
            }
            for (size_t i = 0; i < 3; i++)
            {
                const double error = std::fabs(static_cast<double>(x[i]) - power(t, degree));
                if (degree <= order || i == 0)
                {
                    EXPECT_LE(error, 2 * TOL) << "order " << order << ", t^" << degree << ", channel " << i;
                }
                else
                {
                    EXPECT_GT(error, 100 * TOL) << "order " << order << ", t^" << degree << ", channel " << i;
                }
            }
        }
    }
}

TEST(skew, restart_forgets)
{
    const ins_real delay[3] = {0, INS_C(0.5), INS_C(0.5)};
    ins_skew_t s;
    ASSERT_EQ(ins_skew_init(&s, 1, delay, 1), INS_OK);
    ins_real x[3];
    const ins_real a[3] = {1, 1, 1};
    const ins_real b[3] = {3, 3, 3};
    ins_skew_add(&s, a, x);
    EXPECT_EQ(ins_skew_add(&s, b, x), INS_OK);
    EXPECT_EQ(x[1], 2);
    ins_skew_restart(&s);
    EXPECT_EQ(ins_skew_add(&s, b, x), INS_S_START);
    EXPECT_EQ(x[1], 3);
}

TEST(skew, refuses)
{
    ins_skew_t s;
    const ins_real good[3] = {0, INS_C(0.1), INS_C(0.2)};
    const ins_real late[3] = {0, 1, 0};
    const ins_real early[3] = {0, INS_C(-0.1), 0};
    const ins_real nan[3] = {0, 0, NOT_A_NUMBER};
    EXPECT_EQ(ins_skew_init(&s, 0, good, 1), INS_E_RANGE);
    EXPECT_EQ(ins_skew_init(&s, 1, good, -1), INS_E_RANGE);
    EXPECT_EQ(ins_skew_init(&s, 4, good, 1), INS_E_RANGE);
    EXPECT_EQ(ins_skew_init(&s, 1, good, 0), INS_E_RANGE);
    EXPECT_EQ(ins_skew_init(&s, 1, good, INFINITE), INS_E_RANGE);
    EXPECT_EQ(ins_skew_init(&s, 1, late, 1), INS_E_RANGE);
    EXPECT_EQ(ins_skew_init(&s, 1, early, 1), INS_E_RANGE);
    EXPECT_EQ(ins_skew_init(&s, 1, nan, 1), INS_E_RANGE);
    ASSERT_EQ(ins_skew_init(&s, 2, good, 1), INS_OK);
    ins_real x[3] = {9, 9, 9};
    EXPECT_EQ(ins_skew_add(&s, nan, x), INS_E_RANGE);
    EXPECT_EQ(x[0], 9);
    EXPECT_EQ(s.count, 0);
}

#ifndef INS_REAL_FLOAT
TEST(skew, pseudo_coning_is_removed)
{
    // In-phase vibration about y and z, z read late by d: a drift about x of a^2 Omega sin(Omega d) / 2 that is not there.
    const double a = PI / 180;
    const double omega = 2 * PI * 10;
    const double late = 0.3e-3;
    const double period = 1e-3;
    const size_t steps = 2000; // 20 cycles
    const ins_real delay[3] = {0, 0, static_cast<ins_real>(late)};
    double drift[2];
    for (int compensated = 0; compensated < 2; compensated++)
    {
        ins_skew_t s;
        ins_rates_t r;
        ins_attitude_t q;
        const ins_real q0[4] = {1, 0, 0, 0};
        ASSERT_EQ(ins_skew_init(&s, 3, delay, static_cast<ins_real>(period)), INS_OK);
        ASSERT_EQ(ins_rates_init(&r, 4, static_cast<ins_real>(period)), INS_OK);
        ASSERT_EQ(ins_attitude_init(&q, INS_CONING_HIST2_OPT, q0), INS_OK);
        for (size_t k = 0; k <= steps; k++)
        {
            const double t = static_cast<double>(k) * period;
            ins_real w[3] = {0, static_cast<ins_real>(a * omega * std::cos(omega * t)),
                             static_cast<ins_real>(a * omega * std::cos(omega * (t + late)))};
            ins_real theta[3];
            if (compensated)
            {
                ASSERT_GE(ins_skew_add(&s, w, w), INS_OK);
            }
            ASSERT_GE(ins_rates_add(&r, w, theta), INS_OK);
            ASSERT_GE(ins_attitude_step(&q, theta), INS_OK);
        }
        drift[compensated] = rotation_between(quat(q.q_nb), {1, 0, 0, 0})[0] / (static_cast<double>(steps) * period);
    }
    const double formula = a * a / 2 * omega * std::sin(omega * late); // 37 deg/h
    EXPECT_NEAR(std::fabs(drift[0]), formula, 0.01 * formula);
    EXPECT_LE(std::fabs(drift[1]), 0.01 * formula);
}
#endif
