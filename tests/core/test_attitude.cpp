/// \file   test_attitude.cpp
/// \brief  Attitude from increments and from rates: accuracy against exact motions, orders, start-up, edges.
/// SPDX-License-Identifier: MIT
#include "attitude_runs.h"
#include <limits>
#include <random>
using namespace core_test;

namespace
{
const double T = 0.08;
const size_t STEPS = 300;
const double ROUNDING_RAD = INS_TOL(1e-12, 3e-6); // over 300 steps
const long NORM_STEPS = 60000;                    // 10 minutes at 100 Hz
const double TOL_NORM = INS_TOL(1e-15, 4e-7);

double error_of(const Motion& m, const std::string& name, double period, size_t steps)
{
    return max_error(run_named(m, name, period, steps),
                     [&](size_t k) { return m.attitude(static_cast<double>(k) * period); });
}

#ifndef INS_REAL_FLOAT
/// `text` as published: a value within half a unit of its last digit.
bool rounds_to(double value, const std::string& text)
{
    const double published = std::stod(text);
    const size_t e = text.find('e');
    const std::string mantissa = text.substr(0, e);
    const size_t point = mantissa.find('.');
    const int decimals = point == std::string::npos ? 0 : static_cast<int>(mantissa.size() - point - 1);
    const int exponent = e == std::string::npos ? 0 : std::stoi(text.substr(e + 1));
    return std::fabs(value - published) <= 0.5000001 * std::pow(10.0, exponent - decimals);
}
#endif
} // namespace

TEST(attitude, accuracy_table_at_80_ms)
{
    // Largest attitude error in 24 s, exact increments or noise-free rates, exact pre-history.
    const struct
    {
        const char* name;
        const char* a;
        const char* b;
        const char* d; ///< nullptr where none is published
    } rows[] = {{"one", "1.3e-3", "3.4e-3", ".56"},          {"three_poly", "1.2e-5", "1.5e-4", "5.0e-2"},
                {"three_opt", "1.0e-5", "1.4e-4", "3.8e-2"}, {"reuse_fit", "1.2e-5", "1.6e-4", "5.0e-2"},
                {"hist1", "1.7e-5", "1.2e-4", nullptr},      {"hist2_poly", "4.8e-6", "2.2e-5", "4.1e-2"},
                {"hist2_opt", "9.8e-6", "6.9e-5", "9.6e-3"}, {"two", "1.5e-6", "2.4e-5", "2.0e-2"},
                {"AM2", "1.6e-3", "4.0e-3", ".56"},          {"AM3", "9.5e-5", "3.0e-4", ".035"},
                {"AM4", "1.7e-5", "6.8e-5", ".044"}};
    std::printf("%-12s %10s %10s %10s\n", "form", "A", "B", "D");
    for (const auto& row : rows)
    {
        const double got[] = {error_of(MOTION_A, row.name, T, STEPS), error_of(MOTION_B, row.name, T, STEPS),
                              error_of(MOTION_D, row.name, T, STEPS)};
        const char* published[] = {row.a, row.b, row.d};
        std::printf("%-12s %10.3e %10.3e %10.3e\n", row.name, got[0], got[1], got[2]);
        for (int i = 0; i < 3 && published[i]; i++)
        {
#ifdef INS_REAL_FLOAT
            EXPECT_NEAR(got[i], std::stod(published[i]), 0.05 * std::stod(published[i]) + ROUNDING_RAD) << row.name;
#else
            EXPECT_TRUE(rounds_to(got[i], published[i]))
                << row.name << ", motion "
                << "ABD"[i] << ": got " << got[i] << ", published " << published[i];
#endif
        }
    }
}

#ifndef INS_REAL_FLOAT
TEST(attitude, order_of_convergence)
{
    // Global order, from halving the period of motion B. Float would show its rounding instead.
    const struct
    {
        const char* name;
        double order;
    } rows[] = {{"one", 2},       {"hist1", 3},      {"hist2_opt", 3}, {"hist2_poly", 4}, {"hist3_poly", 4},
                {"hist3_opt", 3}, {"three_poly", 4}, {"three_opt", 4}, {"AM2", 2},        {"AM3", 3}};
    const double period = 0.02;
    const size_t steps = 600;
    for (const auto& row : rows)
    {
        const double coarse = error_of(MOTION_B, row.name, period, steps);
        const double fine = error_of(MOTION_B, row.name, period / 2, 2 * steps);
        EXPECT_NEAR(std::log2(coarse / fine), row.order, 0.3) << row.name << " " << coarse << " " << fine;
    }
}
#endif

TEST(attitude, one_axis_rotation_is_exact_in_every_form)
{
    // All increments parallel: every cross product is zero, the angle is the sum.
    for (const Form& f : forms())
    {
        const std::vector<Vec> pre = {{0.12, 0.06, -0.12}, {0.02, 0.01, -0.02}, {-0.04, -0.02, 0.04}};
        std::vector<Vec> incs;
        double angle = 0;
        for (int k = 0; k < 12; k++)
        {
            const double size = 0.1 * std::sin(1.0 + k);
            incs.push_back({2 * size / 3, size / 3, -2 * size / 3});
            angle += size;
        }
        const Track track = run_form(f.form, {1, 0, 0, 0}, pre, incs);
        const double s = std::sin(angle / 2);
        const Quat want = {std::cos(angle / 2), 2 * s / 3, s / 3, -2 * s / 3};
        EXPECT_LE(angle_between(track.back().second, want), INS_TOL(1e-15, 3e-7)) << f.name;
    }
}

TEST(coning, fit_forms_integrate_polynomial_rates_to_second_order)
{
    // Rate t^p about x and t^q about y: the z of phi is 1/2 of the integral of alpha x omega over the interval, exactly.
    const int fits[] = {INS_CONING_HIST1,  INS_CONING_HIST2_FIT,  INS_CONING_HIST3_FIT,
                        INS_CONING_BLOCK2, INS_CONING_BLOCK3_FIT, INS_CONING_BLOCK4_FIT};
    for (const int form : fits)
    {
        const int n = ins_coning_samples(form);
        const double start = ins_coning_is_block(form) ? 0 : n - 1;
        const auto rise = [&](int k, double from, double to) { return (std::pow(to, k) - std::pow(from, k)) / k; };
        const auto swept = [&](int p, int q)
        { return (rise(p + q + 2, start, n) - std::pow(start, p + 1) * rise(q + 1, start, n)) / (p + 1); };
        for (int p = 0; p < n; p++)
        {
            for (int q = 0; q < n; q++)
            {
                ins_real theta[3 * INS_CONING_SAMPLES_MAX] = {0};
                for (int i = 0; i < n; i++)
                {
                    theta[3 * i] = static_cast<ins_real>(rise(p + 1, i, i + 1));
                    theta[3 * i + 1] = static_cast<ins_real>(rise(q + 1, i, i + 1));
                }
                ins_real phi[3];
                ASSERT_EQ(ins_coning_phi(form, theta, phi), INS_OK);
                const double want = (swept(p, q) - swept(q, p)) / 2;
                EXPECT_NEAR(static_cast<double>(phi[2]), want, INS_TOL(1e-14, 1e-5) * (1 + swept(p, q)))
                    << "form " << form << ", t^" << p << ", t^" << q;
            }
        }
    }
}

TEST(attitude, start_up_uses_what_history_there_is)
{
    const ins_real theta[9] = {INS_C(0.01), INS_C(0.02),  INS_C(-0.03), INS_C(0.04), INS_C(0.01),
                               INS_C(0.02), INS_C(-0.02), INS_C(0.03),  INS_C(0.05)};
    const struct
    {
        int form;
        int start[3];
    } cases[] = {{INS_CONING_HIST3_OPT, {INS_CONING_ONE, INS_CONING_HIST1, INS_CONING_HIST2_OPT}},
                 {INS_CONING_HIST3_FIT, {INS_CONING_ONE, INS_CONING_HIST1, INS_CONING_HIST2_FIT}}};
    for (const auto& c : cases)
    {
        ins_attitude_t a;
        const ins_real q0[4] = {1, 0, 0, 0};
        ASSERT_EQ(ins_attitude_init(&a, c.form, q0), INS_OK);
        Quat q = {1, 0, 0, 0};
        for (int k = 0; k < 3; k++)
        {
            ASSERT_EQ(ins_attitude_step(&a, theta + 3 * k), INS_S_START);
            ins_real phi[3];
            ins_real dq[4];
            ASSERT_EQ(ins_coning_phi(c.start[k], theta, phi), INS_OK);
            ASSERT_EQ(ins_quat_from_rotvec(phi, dq), INS_OK);
            q = mul(q, quat(dq));
            EXPECT_LE(angle_between(quat(a.q_nb), q), INS_TOL(1e-15, 3e-7)) << "step " << k;
        }
        EXPECT_EQ(ins_attitude_step(&a, theta), INS_OK);
    }
}

TEST(attitude, a_jump_restarts_the_history)
{
    const ins_real q0[4] = {1, 0, 0, 0};
    const ins_real theta[3] = {INS_C(0.1), INS_C(0.2), INS_C(0.1)};
    const ins_real gap[3] = {INS_C(1.5), INS_C(-2.0), INS_C(2.5)};
    ins_attitude_t a;
    ASSERT_EQ(ins_attitude_init(&a, INS_CONING_HIST2_OPT, q0), INS_OK);
    EXPECT_EQ(ins_attitude_step(&a, theta), INS_S_START);
    EXPECT_EQ(ins_attitude_step(&a, theta), INS_S_START);
    EXPECT_EQ(ins_attitude_step(&a, theta), INS_OK);
    ins_real before[4];
    std::copy(a.q_nb, a.q_nb + 4, before);
    ASSERT_EQ(ins_attitude_jump(&a, gap), INS_OK);
    ins_real dq[4];
    ASSERT_EQ(ins_quat_from_rotvec(gap, dq), INS_OK);
    EXPECT_LE(angle_between(quat(a.q_nb), mul(quat(before), quat(dq))), INS_TOL(1e-15, 5e-7));
    EXPECT_EQ(ins_attitude_step(&a, theta), INS_S_START);
}

TEST(attitude, large_increments_are_done_exactly)
{
    const double sizes[] = {0.49, 0.51, 1.0, 2.0, 3.1};
    for (const double size : sizes)
    {
        ins_attitude_t a;
        const ins_real q0[4] = {1, 0, 0, 0};
        ASSERT_EQ(ins_attitude_init(&a, INS_CONING_HIST2_OPT, q0), INS_OK);
        const auto theta = real(Vec{0, size, 0});
        for (int k = 0; k < 5; k++)
        {
            ASSERT_GE(ins_attitude_step(&a, theta.data()), INS_OK);
        }
        const double angle = 5 * static_cast<double>(theta[1]);
        EXPECT_LE(angle_between(quat(a.q_nb), {std::cos(angle / 2), 0, std::sin(angle / 2), 0}), INS_TOL(1e-14, 3e-6))
            << size;
    }
}

TEST(attitude, refuses_and_stays_as_it_was)
{
    const ins_real nan = std::numeric_limits<ins_real>::quiet_NaN();
    const ins_real q0[4] = {1, 0, 0, 0};
    const ins_real good[3] = {INS_C(0.1), INS_C(0.2), INS_C(-0.1)};
    const ins_real bad[][3] = {
        {nan, 0, 0}, {0, 0, nan}, {0, INS_C(3.15), 0}, {-std::numeric_limits<ins_real>::infinity(), 0, 0}};
    ins_attitude_t a;
    const int no_history_form[] = {INS_CONING_BLOCK2, INS_CONING_BLOCK4_OPT, INS_CONING_FORM_COUNT, -1};
    for (const int form : no_history_form)
    {
        EXPECT_EQ(ins_attitude_init(&a, form, q0), INS_E_RANGE) << form;
    }
    const ins_real bad_q[][4] = {{nan, 0, 0, 0}, {INS_C(1.002), 0, 0, 0}, {0, 0, 0, 0}};
    for (const auto& q : bad_q)
    {
        EXPECT_EQ(ins_attitude_init(&a, INS_CONING_HIST2_OPT, q), INS_E_RANGE);
    }
    const ins_real nearly[4] = {INS_C(1.0009), 0, 0, 0};
    ASSERT_EQ(ins_attitude_init(&a, INS_CONING_HIST2_OPT, nearly), INS_OK);
    EXPECT_EQ(a.q_nb[0], 1);
    for (int k = 0; k < 3; k++)
    {
        EXPECT_GE(ins_attitude_step(&a, good), INS_OK);
    }
    const ins_attitude_t before = a;
    for (const auto& theta : bad)
    {
        EXPECT_EQ(ins_attitude_step(&a, theta), INS_E_RANGE);
        EXPECT_EQ(ins_attitude_jump(&a, theta), theta[1] > 3 ? INS_OK : INS_E_RANGE);
        if (theta[1] > 3)
        {
            a = before;
        }
        EXPECT_TRUE(std::equal(a.q_nb, a.q_nb + 4, before.q_nb));
        EXPECT_TRUE(std::equal(&a.prev[0][0], &a.prev[0][0] + 9, &before.prev[0][0]));
        EXPECT_EQ(a.count, before.count);
    }
    ins_reuse_t r;
    const ins_real q3[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    ins_real q[4];
    EXPECT_EQ(ins_reuse_init(&r, INS_CONING_HIST2_OPT, q3), INS_E_RANGE);
    EXPECT_EQ(ins_reuse_init(&r, INS_CONING_BLOCK2, q3), INS_E_RANGE);
    ASSERT_EQ(ins_reuse_init(&r, INS_CONING_BLOCK3_OPT, q3), INS_OK);
    for (size_t i = 0; i < 3; i++)
    {
        ins_real longer[12];
        std::copy(q3, q3 + 12, longer);
        longer[4 * i] = INS_C(1.01);
        ins_reuse_t untouched = r;
        EXPECT_EQ(ins_reuse_init(&untouched, INS_CONING_BLOCK3_FIT, longer), INS_E_RANGE) << i;
        EXPECT_EQ(untouched.form, INS_CONING_BLOCK3_OPT);
        EXPECT_TRUE(std::equal(&r.q_nb[0][0], &r.q_nb[0][0] + 12, &untouched.q_nb[0][0]));
    }
    EXPECT_EQ(ins_reuse_step(&r, bad[0], q), INS_E_RANGE);
    EXPECT_EQ(ins_reuse_step(&r, good, q), INS_S_START);
    ins_real phi[3];
    EXPECT_EQ(ins_coning_phi(INS_CONING_FORM_COUNT, q3, phi), INS_E_RANGE);
    EXPECT_EQ(ins_coning_samples(-1), 0);
    EXPECT_EQ(ins_coning_is_block(INS_CONING_FORM_COUNT), 0);
}

TEST(attitude, norm_stays_one_over_ten_minutes)
{
    const unsigned seed = 7;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-0.1, 0.1);
    ins_attitude_t a;
    const ins_real q0[4] = {1, 0, 0, 0};
    ASSERT_EQ(ins_attitude_init(&a, INS_CONING_HIST2_OPT, q0), INS_OK);
    double worst = 0;
    for (long k = 0; k < NORM_STEPS; k++)
    {
        ASSERT_GE(ins_attitude_step(&a, real(Vec{uniform(random), uniform(random), uniform(random)}).data()), INS_OK);
        const Quat q = quat(a.q_nb);
        worst = larger(worst, std::fabs(1 - std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3])));
    }
    std::printf("[ figure   ] norm error %.1e after %ld steps, seed %u\n", worst, NORM_STEPS, seed);
    EXPECT_LE(worst, TOL_NORM);
}

TEST(attitude, a_norm_error_decays)
{
    ins_attitude_t a;
    const ins_real q0[4] = {1, 0, 0, 0};
    const ins_real theta[3] = {INS_C(0.02), INS_C(-0.01), INS_C(0.03)};
    ASSERT_EQ(ins_attitude_init(&a, INS_CONING_HIST2_OPT, q0), INS_OK);
    a.q_nb[0] = INS_C(1.01);
    for (int k = 0; k < 4; k++)
    {
        ASSERT_GE(ins_attitude_step(&a, theta), INS_OK);
    }
    const Quat q = quat(a.q_nb);
    EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1, INS_TOL(1e-9, 3e-7));
}
