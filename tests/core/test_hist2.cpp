/// \file   test_hist2.cpp
/// \brief  The small attitude step: the bits of the general one, the end of its range, refusals, the reference motions.
/// SPDX-License-Identifier: MIT
#include "core_test.h"
#include <limits>
#include <random>
using namespace core_test;

namespace
{
const unsigned SEED = std::getenv("INS_SEED") ? static_cast<unsigned>(std::atoi(std::getenv("INS_SEED"))) : 2;
const int RUNS = std::getenv("INS_BENCH") ? 20000 : 400;
const int RUN_STEPS = 50;
const double COMPONENT_MAX_RAD = 0.27; // with the coning term of two such increments |phi| stays below 0.5
const double TOL_QUAT = INS_TOL(5e-14, 3e-6);
const double TOL_NORM = INS_TOL(4e-16, 2e-7);
const ins_real LEVEL[4] = {1, 0, 0, 0};

/// ins_attitude_t with INS_CONING_HIST2_OPT, at the attitude of `lean`: the two initialisations round differently.
ins_attitude_t general(const ins_hist2_t& lean)
{
    ins_attitude_t a;
    EXPECT_EQ(ins_attitude_init(&a, INS_CONING_HIST2_OPT, LEVEL), INS_OK);
    std::copy(lean.q_nb, lean.q_nb + 4, a.q_nb);
    return a;
}

::testing::AssertionResult same_quat(const ins_real a[4], const ins_real b[4])
{
    for (int i = 0; i < 4; i++)
    {
        if (!(a[i] == b[i]))
        {
            return ::testing::AssertionFailure()
                   << "element " << i << ": " << a[i] << " and " << b[i] << ", difference " << a[i] - b[i];
        }
    }
    return ::testing::AssertionSuccess();
}

::testing::AssertionResult same_state(const ins_hist2_t& a, const ins_hist2_t& b)
{
    if (a.count != b.count || !std::equal(a.prev[0], a.prev[0] + 3, b.prev[0]) ||
        !std::equal(a.prev[1], a.prev[1] + 3, b.prev[1]))
    {
        return ::testing::AssertionFailure() << "the history differs";
    }
    return same_quat(a.q_nb, b.q_nb);
}

/// q after the increments, those before the start known.
Quat run(const json& c)
{
    const auto q0 = real(c["q_true"][0].get<Quat>());
    const auto pre = c["pre"].get<std::vector<Vec>>();
    ins_hist2_t s;
    EXPECT_EQ(ins_hist2_init(&s, q0.data()), INS_OK);
    for (size_t k = pre.size() - 2; k < pre.size(); k++)
    {
        EXPECT_EQ(ins_hist2_step(&s, real(pre[k]).data()), INS_S_START);
    }
    std::copy(q0.begin(), q0.end(), s.q_nb);
    for (const Vec& theta : c["incs"].get<std::vector<Vec>>())
    {
        EXPECT_EQ(ins_hist2_step(&s, real(theta).data()), INS_OK);
    }
    return quat(s.q_nb);
}
} // namespace

TEST(hist2, the_bits_of_the_general_step)
{
    std::mt19937 random(SEED);
    std::normal_distribution<double> gauss;
    std::uniform_real_distribution<double> component(-1, 1);
    const double sizes[] = {COMPONENT_MAX_RAD, 0.02, 1e-4, 1e-9};
    for (int n = 0; n < RUNS; n++)
    {
        Quat start = {gauss(random), gauss(random), gauss(random), gauss(random)};
        const double length =
            std::sqrt(start[0] * start[0] + start[1] * start[1] + start[2] * start[2] + start[3] * start[3]);
        for (double& x : start)
        {
            x /= length;
        }
        ins_hist2_t lean;
        ASSERT_EQ(ins_hist2_init(&lean, real(start).data()), INS_OK);
        ins_attitude_t any = general(lean);
        for (int k = 0; k < RUN_STEPS; k++)
        {
            const double size = sizes[n % 4];
            Vec theta = {size * component(random), size * component(random), size * component(random)};
            theta[static_cast<size_t>(n % 3)] *= n % 5 == 0 ? 0 : 1; // zeros too
            const auto x = real(theta);
            ASSERT_EQ(ins_hist2_step(&lean, x.data()), k < 2 ? INS_S_START : INS_OK) << n << " " << k;
            ASSERT_EQ(ins_attitude_step(&any, x.data()), k < 2 ? INS_S_START : INS_OK);
            ASSERT_TRUE(same_quat(lean.q_nb, any.q_nb)) << "seed " << SEED << ", run " << n << ", step " << k;
        }
    }
}

TEST(hist2, half_a_radian_is_the_end)
{
    const ins_real half = INS_C(0.5);
    const ins_real above = std::nextafter(half, ins_real(1));
    for (int axis = 0; axis < 3; axis++)
    {
        for (const ins_real sign : {ins_real(1), ins_real(-1)})
        {
            ins_real theta[3] = {0, 0, 0};
            ins_hist2_t s;
            ASSERT_EQ(ins_hist2_init(&s, LEVEL), INS_OK);
            ins_attitude_t any = general(s);
            theta[axis] = sign * above;
            EXPECT_EQ(ins_hist2_step(&s, theta), INS_E_RANGE) << axis;
            theta[axis] = sign * half;
            EXPECT_EQ(ins_hist2_step(&s, theta), INS_S_START) << axis;
            EXPECT_EQ(ins_attitude_step(&any, theta), INS_S_START);
            EXPECT_TRUE(same_quat(s.q_nb, any.q_nb));
        }
    }
    // The coning term counts: the same increment is taken after rest and refused after a turn about another axis.
    const ins_real about_y[3] = {0, INS_C(0.4995), 0};
    const ins_real about_x[2][3] = {{INS_C(-0.45), 0, 0}, {INS_C(0.45), 0, 0}};
    ins_hist2_t s;
    ASSERT_EQ(ins_hist2_init(&s, LEVEL), INS_OK);
    EXPECT_EQ(ins_hist2_step(&s, about_y), INS_S_START);
    ASSERT_EQ(ins_hist2_init(&s, LEVEL), INS_OK);
    EXPECT_EQ(ins_hist2_step(&s, about_x[0]), INS_S_START);
    EXPECT_EQ(ins_hist2_step(&s, about_x[1]), INS_S_START);
    EXPECT_EQ(ins_hist2_step(&s, about_y), INS_E_RANGE);
}

TEST(hist2, refuses_and_stays_as_it_was)
{
    using limits = std::numeric_limits<ins_real>;
    const ins_real good[3] = {INS_C(0.1), INS_C(0.2), INS_C(-0.1)};
    const ins_real bad[] = {limits::quiet_NaN(), limits::infinity(), -limits::infinity(),
                            limits::max(),       -limits::max(),     INS_C(0.6)};
    ins_hist2_t s;
    ASSERT_EQ(ins_hist2_init(&s, LEVEL), INS_OK);
    for (int held = 0; held < 4; held++)
    {
        const ins_hist2_t before = s;
        for (const ins_real x : bad)
        {
            for (int i = 0; i < 3; i++)
            {
                ins_real theta[3] = {good[0], good[1], good[2]};
                theta[i] = x;
                EXPECT_EQ(ins_hist2_step(&s, theta), INS_E_RANGE) << x << " in place " << i << ", step " << held;
                EXPECT_TRUE(same_state(s, before)) << x << " in place " << i << ", step " << held;
            }
            for (int i = 0; i < 4 && x != INS_C(0.6); i++)
            {
                ins_real q[4] = {0, INS_C(0.6), INS_C(0.8), 0};
                q[i] = x;
                EXPECT_EQ(ins_hist2_init(&s, q), INS_E_RANGE) << x << " in place " << i;
                EXPECT_TRUE(same_state(s, before)) << x << " in place " << i;
            }
        }
        EXPECT_EQ(ins_hist2_step(&s, good), held < 2 ? INS_S_START : INS_OK);
    }
}

TEST(hist2, starts_at_unit_norm)
{
    const Quat tilted = {0.1, -0.7, 0.5, 0.5};
    for (const double size : {0.9989, 1.0011, 0.0, 2.0})
    {
        ins_hist2_t s;
        const auto q = real(Quat{size * tilted[0], size * tilted[1], size * tilted[2], size * tilted[3]});
        EXPECT_EQ(ins_hist2_init(&s, q.data()), INS_E_RANGE) << size;
    }
    for (const double size : {0.9991, 1.0009, 1.0})
    {
        ins_hist2_t s;
        const auto q = real(Quat{size * tilted[0], size * tilted[1], size * tilted[2], size * tilted[3]});
        ASSERT_EQ(ins_hist2_init(&s, q.data()), INS_OK) << size;
        double n2 = 0;
        for (size_t i = 0; i < 4; i++)
        {
            EXPECT_NEAR(static_cast<double>(s.q_nb[i]), tilted[i], TOL_NORM) << size;
            n2 += static_cast<double>(s.q_nb[i]) * static_cast<double>(s.q_nb[i]);
        }
        EXPECT_NEAR(n2, 1, 2 * TOL_NORM) << size;
        EXPECT_EQ(s.count, 0);
    }
    ins_hist2_t s;
    ASSERT_EQ(ins_hist2_init(&s, LEVEL), INS_OK);
    EXPECT_TRUE(same_quat(s.q_nb, LEVEL));
}

TEST(vector_hist2, motions)
{
    const json coning = load("coning.json");
    const json motion = load("attitude_motion.json");
    Worst worst;
    for (const auto& [cases, results] : {std::pair(coning["cases"], "q_final"), std::pair(motion["cases"], "results")})
    {
        for (const json& c : cases)
        {
            const json& result = c[results]["hist2_opt"];
            const Quat want = (result.is_array() ? result : result["q_final"]).get<Quat>();
            const Quat got = run(c);
            double dot = 0;
            for (size_t i = 0; i < 4; i++)
            {
                dot += got[i] * want[i];
            }
            for (size_t i = 0; i < 4; i++)
            {
                worst.take(dot < 0 ? -got[i] : got[i], want[i], 1, results);
            }
        }
    }
    expect_within(worst, TOL_QUAT, "q_final of hist2_opt");
}
