/// \file   test_batch.cpp
/// \brief  The batch step: the bits of the scalar step for every trajectory, at start-up, for large increments, for any number.
/// SPDX-License-Identifier: MIT
#include "core_test.h"
#include <cstring>
#include <random>
using namespace core_test;

namespace
{
const unsigned SEED = 64;
const int STEPS = std::getenv("INS_BENCH") ? 5000 : 200;

/// Every trajectory against its own ins_attitude_t.
void compare(size_t n, double largest, double seldom_larger)
{
    std::mt19937 random(SEED);
    std::uniform_real_distribution<double> component(-1, 1);
    std::vector<ins_attitude_t> scalar(n);
    std::vector<ins_real> q0(4 * n);
    for (size_t i = 0; i < n; i++)
    {
        const Quat q = from_euler({3 * component(random), 1.5 * component(random), 3 * component(random)});
        const auto start = real(q);
        for (size_t row = 0; row < 4; row++)
        {
            q0[row * n + i] = start[row];
        }
        ASSERT_EQ(ins_attitude_init(&scalar[i], INS_CONING_HIST2_OPT, start.data()), INS_OK);
    }
    std::vector<ins_real> state(INS_BATCH_ROWS * n);
    ins_batch_t batch;
    ASSERT_EQ(ins_batch_init(&batch, n, state.data(), q0.data()), INS_OK);
    for (int k = 0; k < STEPS; k++)
    {
        std::vector<ins_real> theta(3 * n);
        for (ins_real& x : theta)
        {
            x = static_cast<ins_real>(component(random) * (random() % 50 ? largest : seldom_larger));
        }
        ASSERT_EQ(ins_batch_step(&batch, state.data(), theta.data()), k < 2 ? INS_S_START : INS_OK);
        for (size_t i = 0; i < n; i++)
        {
            const ins_real one[3] = {theta[i], theta[n + i], theta[2 * n + i]};
            ASSERT_GE(ins_attitude_step(&scalar[i], one), INS_OK);
            for (size_t row = 0; row < 4; row++)
            {
                ASSERT_EQ(0, std::memcmp(&scalar[i].q_nb[row], &state[row * n + i], sizeof(ins_real)))
                    << "seed " << SEED << ", n " << n << ", trajectory " << i << ", step " << k;
            }
        }
    }
}
} // namespace

TEST(batch, same_bits_as_the_scalar_step)
{
    for (const size_t n : {size_t(1), size_t(15), size_t(16), size_t(17), size_t(32), size_t(256)})
    {
        compare(n, 0.2, 0.2);
        compare(n, 0.01, 0.01); // small enough for the check that looks at sums
    }
}

TEST(batch, same_bits_with_large_increments_among_them)
{
    compare(64, 0.1, 3.0);
}

TEST(batch, refuses_and_changes_nothing)
{
    const size_t n = 40;
    std::vector<ins_real> q0(4 * n, 0);
    std::fill(q0.begin(), q0.begin() + n, static_cast<ins_real>(1));
    std::vector<ins_real> state(INS_BATCH_ROWS * n, 7);
    ins_batch_t b;
    EXPECT_EQ(ins_batch_init(&b, 0, state.data(), q0.data()), INS_E_RANGE);
    for (const size_t at : {size_t(0), n / 2, n - 1})
    {
        q0[at] = INS_C(1.01);
        EXPECT_EQ(ins_batch_init(&b, n, state.data(), q0.data()), INS_E_RANGE) << at;
        EXPECT_EQ(state, std::vector<ins_real>(INS_BATCH_ROWS * n, 7));
        q0[at] = 1;
    }
    ASSERT_EQ(ins_batch_init(&b, n, state.data(), q0.data()), INS_OK);
    const auto before = state;
    for (const ins_real bad : {static_cast<ins_real>(std::nan("")), static_cast<ins_real>(INFINITY), INS_C(-3.2)})
    {
        for (size_t at = 0; at < 3 * n; at += n - 1)
        {
            std::vector<ins_real> theta(3 * n, INS_C(0.01));
            theta[at] = bad;
            EXPECT_EQ(ins_batch_step(&b, state.data(), theta.data()), INS_E_RANGE);
            EXPECT_EQ(state, before);
            EXPECT_EQ(b.count, 0);
        }
    }
}

TEST(batch, refuses_under_way_wherever_the_bad_one_stands)
{
    const size_t n = 45; // whole vectors, and a rest
    std::vector<ins_real> q0(4 * n, 0);
    std::fill(q0.begin(), q0.begin() + n, static_cast<ins_real>(1));
    std::vector<ins_real> state(INS_BATCH_ROWS * n);
    ins_batch_t b;
    ASSERT_EQ(ins_batch_init(&b, n, state.data(), q0.data()), INS_OK);
    const std::vector<ins_real> calm(3 * n, INS_C(0.01));
    for (int k = 0; k < 4; k++)
    {
        ASSERT_GE(ins_batch_step(&b, state.data(), calm.data()), INS_OK);
    }
    const auto before = state;
    const ins_batch_t self = b;
    for (size_t at = 0; at < 3 * n; at++)
    {
        for (const ins_real bad : {static_cast<ins_real>(std::nan("")), static_cast<ins_real>(-INFINITY), INS_C(3.2)})
        {
            std::vector<ins_real> theta = calm;
            theta[at] = bad;
            ASSERT_EQ(ins_batch_step(&b, state.data(), theta.data()), INS_E_RANGE) << at;
            ASSERT_EQ(state, before) << at;
            ASSERT_EQ(std::memcmp(&self, &b, sizeof b), 0) << at;
        }
    }
    EXPECT_EQ(ins_batch_step(&b, state.data(), calm.data()), INS_OK);
}
