/// \file   test_q31.cpp
/// \brief  The fixed-point attitude step against double precision: 10 minutes of random motion, single steps, its products, its refusals.
/// SPDX-License-Identifier: MIT
#include "core_test.h"
#include <random>
using namespace core_test;

namespace long_form
{
#include "../../libins/core/src/q31_long_internal.h"
}
namespace split_form
{
#include "../../libins/core/src/q31_split_internal.h"
}
/// The sources of the steps built once more, with Q31_SPLIT (CMakeLists.txt).
extern "C" {
ins_status_t split_q31_init(ins_q31_t* self, const int32_t q_nb[4]);
ins_status_t split_q31_step(ins_q31_t* self, const int32_t dtheta_b[3]);
ins_status_t split_q31w_init(ins_q31w_t* self, const int32_t q_nb[4]);
ins_status_t split_q31w_step(ins_q31w_t* self, const int32_t dtheta_b[3]);
}

namespace
{
const unsigned SEED = std::getenv("INS_SEED") ? static_cast<unsigned>(std::atoi(std::getenv("INS_SEED"))) : 31;
const double RATE_HZ = 100;
const int MINUTES = 10;
const int PRODUCTS = std::getenv("INS_BENCH") ? 20000000 : 200000;
const int RUNS = std::getenv("INS_BENCH") ? 20000 : 400; // of the two forms
const int RUN_STEPS = 50;
const double TOL_32_RAD = 5e-7;   // over 10 minutes
const double TOL_64_RAD = 2.5e-7; // over 10 minutes
const double TOL_STEP = 1.5e-9;   // component of one step, 32-bit state: 1.6 units
const double TOL_NORM = 5e-9;
const double TOL_SCALE = 3e-10; // of the angle turned: the polynomials at their range's end

using Increment = std::array<int32_t, 3>;

Vec in_rad(const Increment& theta)
{
    return {std::ldexp(theta[0], -31), std::ldexp(theta[1], -31), std::ldexp(theta[2], -31)};
}

Increment quantised(const Vec& theta)
{
    Increment q;
    for (size_t i = 0; i < 3; i++)
    {
        q[i] = static_cast<int32_t>(std::lrint(std::ldexp(theta[i], 31)));
    }
    return q;
}

Quat from_q30(const int32_t q[4])
{
    return {std::ldexp(q[0], -30), std::ldexp(q[1], -30), std::ldexp(q[2], -30), std::ldexp(q[3], -30)};
}

Quat from_q62(const int64_t q[4])
{
    Quat x;
    for (size_t i = 0; i < 4; i++)
    {
        x[i] = std::ldexp(static_cast<double>(q[i]), -62);
    }
    return x;
}

/// The same formula in double with libm, on the same increments.
struct Reference
{
    Quat q = {1, 0, 0, 0};
    Vec prev[2] = {{0, 0, 0}, {0, 0, 0}};
    int count = 0;
    void step(const Vec& t)
    {
        const double k1 = count == 0 ? 0 : count == 1 ? 1.0 / 12 : 7.0 / 60;
        const double k2 = count < 2 ? 0 : -1.0 / 60;
        Vec w;
        for (size_t i = 0; i < 3; i++)
        {
            w[i] = k1 * prev[0][i] + k2 * prev[1][i];
        }
        const Vec phi = {t[0] + w[1] * t[2] - w[2] * t[1], t[1] + w[2] * t[0] - w[0] * t[2],
                         t[2] + w[0] * t[1] - w[1] * t[0]};
        const double angle = norm(phi);
        const double s = angle > 0 ? std::sin(angle / 2) / angle : 0.5;
        q = mul(q, {std::cos(angle / 2), s * phi[0], s * phi[1], s * phi[2]});
        const double n = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
        q = {q[0] / n, q[1] / n, q[2] / n, q[3] / n};
        prev[1] = prev[0];
        prev[0] = t;
        count = std::min(count + 1, 2);
    }
};

double norm_of(const Quat& q)
{
    return std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
}
} // namespace

TEST(q31, ten_minutes_of_random_motion)
{
    // Six sines an axis; the largest increment is what is named. Worst of all instants.
    for (const double largest : {0.013, 0.08, 0.265})
    {
        std::mt19937 random(SEED);
        std::uniform_real_distribution<double> frequency(0.05, 3.0);
        std::uniform_real_distribution<double> phase(0, 2 * PI);
        std::uniform_real_distribution<double> amplitude(0.2, 1.0);
        double f[3][6], p[3][6], a[3][6];
        for (int axis = 0; axis < 3; axis++)
        {
            double sum = 0;
            for (int i = 0; i < 6; i++)
            {
                f[axis][i] = frequency(random);
                p[axis][i] = phase(random);
                a[axis][i] = amplitude(random);
                sum += a[axis][i];
            }
            for (int i = 0; i < 6; i++)
            {
                a[axis][i] *= largest / sum;
            }
        }
        const int32_t level[4] = {INS_Q31_ONE, 0, 0, 0};
        ins_q31_t narrow;
        ins_q31w_t wide;
        ASSERT_EQ(ins_q31_init(&narrow, level), INS_OK);
        ASSERT_EQ(ins_q31w_init(&wide, level), INS_OK);
        Reference reference;
        double worst[2] = {0, 0};
        double worst_norm = 0;
        const long steps = std::lrint(MINUTES * 60 * RATE_HZ);
        for (long k = 0; k < steps; k++)
        {
            const double t = static_cast<double>(k) / RATE_HZ;
            Vec theta = {0, 0, 0};
            for (size_t axis = 0; axis < 3; axis++)
            {
                for (size_t i = 0; i < 6; i++)
                {
                    theta[axis] += a[axis][i] * std::sin(2 * PI * f[axis][i] * t + p[axis][i]);
                }
            }
            const Increment increment = quantised(theta);
            const ins_status_t expected = k < 2 ? INS_S_START : INS_OK;
            ASSERT_EQ(ins_q31_step(&narrow, increment.data()), expected);
            ASSERT_EQ(ins_q31w_step(&wide, increment.data()), expected);
            reference.step(in_rad(increment));
            worst[0] = larger(worst[0], angle_between(from_q30(narrow.q_nb), reference.q));
            worst[1] = larger(worst[1], angle_between(from_q62(wide.q_nb), reference.q));
            worst_norm = larger(worst_norm, std::fabs(norm_of(from_q30(narrow.q_nb)) - 1));
            worst_norm = larger(worst_norm, std::fabs(norm_of(from_q62(wide.q_nb)) - 1));
        }
        std::printf("[ figure   ] increments up to %.3f rad, seed %u: 32-bit %.2e rad, 64-bit %.2e rad, norm %.1e\n",
                    largest, SEED, worst[0], worst[1], worst_norm);
        EXPECT_LE(worst[0], TOL_32_RAD) << largest;
        EXPECT_LE(worst[1], TOL_64_RAD) << largest;
        EXPECT_LE(worst_norm, TOL_NORM) << largest;
    }
}

TEST(q31, steady_turn_does_not_drift)
{
    // Constant increments: an error of a rounding that leans to one side, or of the polynomials, adds up here.
    for (const Vec& theta : {Vec{0.2, -0.1, 0.4}, Vec{1e-4, 2e-5, -3e-5}, Vec{0, 0, 0.499}})
    {
        const Increment increment = quantised(theta);
        const int32_t tilted[4] = {858993459, 0, 644245094, 0}; // 0.8, 0.6
        ins_q31_t narrow;
        ins_q31w_t wide;
        ASSERT_EQ(ins_q31_init(&narrow, tilted), INS_OK);
        ASSERT_EQ(ins_q31w_init(&wide, tilted), INS_OK);
        Reference reference;
        reference.q = from_q62(wide.q_nb);
        for (int k = 0; k < 60000; k++)
        {
            ASSERT_GE(ins_q31_step(&narrow, increment.data()), INS_OK);
            ASSERT_GE(ins_q31w_step(&wide, increment.data()), INS_OK);
            reference.step(in_rad(increment));
        }
        const double slip = TOL_SCALE * 60000 * norm(theta);
        EXPECT_LE(angle_between(from_q30(narrow.q_nb), reference.q), 1e-6 + slip) << theta[2];
        EXPECT_LE(angle_between(from_q62(wide.q_nb), reference.q), 3e-7 + slip) << theta[2];
        std::printf("[ figure   ] steady %.2e rad: 32-bit %.2e, 64-bit %.2e\n", norm(theta),
                    angle_between(from_q30(narrow.q_nb), reference.q), angle_between(from_q62(wide.q_nb), reference.q));
    }
}

TEST(q31, single_steps_in_the_whole_range)
{
    std::mt19937 random(SEED);
    std::uniform_real_distribution<double> component(-0.28, 0.28);
    const int32_t tilted[4] = {858993459, 0, 644245094, 0};
    Worst worst;
    for (int trial = 0; trial < 20000; trial++)
    {
        ins_q31_t s;
        ASSERT_EQ(ins_q31_init(&s, tilted), INS_OK);
        Reference reference;
        reference.q = from_q30(s.q_nb);
        for (int k = 0; k < 3; k++)
        {
            reference.q = from_q30(s.q_nb);
            const Increment increment = quantised({component(random), component(random), component(random)});
            const Vec theta = in_rad(increment);
            const int32_t before = s.count;
            const ins_status_t status = ins_q31_step(&s, increment.data());
            if (norm(theta) > 0.48)
            {
                break;
            }
            ASSERT_EQ(status, before < 2 ? INS_S_START : INS_OK);
            reference.step(theta);
            const Quat got = from_q30(s.q_nb);
            for (size_t i = 0; i < 4; i++)
            {
                worst.take(got[i], reference.q[i], 1, "step " + std::to_string(k));
            }
        }
    }
    expect_within(worst, TOL_STEP, "fixed-point steps, seed " + std::to_string(SEED));
}

TEST(q31, products_of_16_bits_give_the_long_product)
{
    // Within what q31_split_internal.h promises: operands up to 2^30 and 2^30 less a 400th.
    std::mt19937 random(SEED);
    const int32_t one = 1 << 30;
    const int32_t end = one - one / 400;
    const int32_t corner[] = {0,       1,        -1,      2,      0x7FFF,           -0x7FFF,          0x8000,
                              -0x8000, 0xFFFF,   0x10000, 0x4000, -0x4000,          0x3FFF,           -16385,
                              one / 2, -one / 2, end,     -end,   one / 2 - 0x4000, -one / 2 - 0x4000};
    const auto check = [](int32_t a, int32_t b)
    {
        ASSERT_EQ(split_form::q31_high(a, b), long_form::q31_high(a, b)) << a << " " << b;
        ASSERT_EQ(split_form::q31_mac(b, a, b), long_form::q31_mac(b, a, b)) << a << " " << b;
    };
    for (const int32_t a : corner)
    {
        for (const int32_t b : corner)
        {
            check(a, b);
        }
        check(one, a);
        check(-one, a);
    }
    std::uniform_int_distribution<int32_t> range(-end, end);
    for (int i = 0; i < PRODUCTS; i++)
    {
        check(range(random) >> (i % 20), range(random) >> (i % 7));
    }
}

TEST(q31, sums_of_16_bit_products_give_the_long_sums)
{
    // Unit quaternions whose lower halves are all at their ends, where a sum of four products is largest; then any.
    std::mt19937 random(SEED);
    std::normal_distribution<double> gauss;
    for (int i = 0; i < PRODUCTS / 10; i++)
    {
        Quat u = {gauss(random), gauss(random), gauss(random), gauss(random)};
        if (i % 2 == 0)
        {
            u = {i % 4 ? 1.0 : -1.0, i % 8 < 4 ? 1.0 : -1.0, i % 16 < 8 ? 1.0 : -1.0, i % 32 < 16 ? 1.0 : -1.0};
        }
        const double n = std::ldexp(1 / norm_of(u), 30);
        int32_t q[4];
        int32_t d[4];
        for (size_t k = 0; k < 4; k++)
        {
            q[k] = static_cast<int32_t>(u[k] * n);
            if (i % 2 == 0)
            {
                q[k] = static_cast<int32_t>((static_cast<uint32_t>(q[k]) & ~0x7FFFu) + (i & 32 ? 0x4000u : 0x3FFFu));
            }
            d[k] = q[(k + static_cast<size_t>(i / 64)) % 4] / 1000 * 997;
        }
        ASSERT_EQ(split_form::q31_square4(q), long_form::q31_square4(q)) << q[0] << " " << q[1] << " " << q[2];
        const int32_t rows[4][4] = {{d[0], -d[1], -d[2], -d[3]}, // of q d, the product of quaternions
                                    {d[1], d[0], d[3], -d[2]},
                                    {d[2], -d[3], d[0], d[1]},
                                    {d[3], d[2], -d[1], d[0]}};
        int32_t turned[4] = {q[0], q[1], q[2], q[3]};
        int32_t change[4] = {d[0], d[1], d[2], d[3]};
        split_form::q31_rotate(turned, change);
        for (size_t r = 0; r < 4; r++)
        {
            int64_t sum = INT64_C(0x80000000);
            for (size_t k = 0; k < 4; k++)
            {
                sum = long_form::q31_mac(sum, q[k], rows[r][k]);
            }
            ASSERT_EQ(turned[r] - q[r], static_cast<int32_t>(sum >> 32)) << r << ": " << q[0] << " " << d[0];
        }
        const int32_t phi[3] = {d[1], d[2], INT32_MAX / 20 * 11};
        ASSERT_EQ(split_form::q31_square3(phi), long_form::q31_square3(phi));
    }
}

TEST(q31, both_forms_of_the_steps_are_equal)
{
    // From any attitude, increments of every size; the refused ones are the same ones.
    std::mt19937 random(SEED);
    std::normal_distribution<double> gauss;
    std::uniform_real_distribution<double> magnitude(-31, 0.2);
    long refused = 0;
    for (int run = 0; run < RUNS; run++)
    {
        const Quat u = {gauss(random), gauss(random), gauss(random), gauss(random)};
        int32_t q[4];
        for (size_t i = 0; i < 4; i++)
        {
            q[i] = static_cast<int32_t>(std::ldexp(u[i] / norm_of(u), 30) * (1 + 9e-4 * std::sin(run)));
        }
        ins_q31_t narrow[2];
        ins_q31w_t wide[2];
        ASSERT_EQ(ins_q31_init(&narrow[0], q), INS_OK);
        ASSERT_EQ(split_q31_init(&narrow[1], q), INS_OK);
        ASSERT_EQ(ins_q31w_init(&wide[0], q), INS_OK);
        ASSERT_EQ(split_q31w_init(&wide[1], q), INS_OK);
        for (int k = 0; k < RUN_STEPS; k++)
        {
            const double size = run % 3 == 0 ? 0.3 : std::exp2(magnitude(random));
            const auto part = [&] { return std::max(-0.99, std::min(0.99, size * gauss(random))); };
            const Increment theta = quantised({part(), part(), part()});
            const ins_status_t status = ins_q31_step(&narrow[0], theta.data());
            refused += status == INS_E_RANGE;
            ASSERT_EQ(split_q31_step(&narrow[1], theta.data()), status);
            ASSERT_EQ(ins_q31w_step(&wide[0], theta.data()), status);
            ASSERT_EQ(split_q31w_step(&wide[1], theta.data()), status);
            for (size_t i = 0; i < 4; i++)
            {
                ASSERT_EQ(narrow[1].q_nb[i], narrow[0].q_nb[i]) << "run " << run << " step " << k << ", seed " << SEED;
                ASSERT_EQ(wide[1].q_nb[i], wide[0].q_nb[i]) << "run " << run << " step " << k << ", seed " << SEED;
            }
        }
    }
    EXPECT_GT(refused, RUNS);
    EXPECT_LT(refused, RUNS * RUN_STEPS / 2);
}

TEST(q31, known_answer)
{
    // Fixed for all machines: quaternions after 100 steps, both states.
    const int32_t level[4] = {INS_Q31_ONE, 0, 0, 0};
    ins_q31_t narrow;
    ins_q31w_t wide;
    ASSERT_EQ(ins_q31_init(&narrow, level), INS_OK);
    ASSERT_EQ(ins_q31w_init(&wide, level), INS_OK);
    for (int32_t k = 0; k < 100; k++)
    {
        const int32_t theta[3] = {(k % 5 - 2) * 21474836, (k % 7 - 3) * 17179869, (k % 3 - 1) * 25769803};
        ASSERT_GE(ins_q31_step(&narrow, theta), INS_OK);
        ASSERT_GE(ins_q31w_step(&wide, theta), INS_OK);
    }
    int32_t rounded[4];
    ins_q31w_get(&wide, rounded);
    const int32_t want_narrow[4] = {1073509613, -31694, -21515763, -5973869};
    const int32_t want_wide[4] = {1073509614, -31695, -21515764, -5973866};
    for (size_t i = 0; i < 4; i++)
    {
        EXPECT_EQ(narrow.q_nb[i], want_narrow[i]);
        EXPECT_EQ(rounded[i], want_wide[i]);
    }
}

TEST(q31, refuses_and_changes_nothing)
{
    const int32_t level[4] = {INS_Q31_ONE, 0, 0, 0};
    const int32_t half_rad = 1 << 30;
    ins_q31_t narrow;
    ins_q31w_t wide;
    const int32_t bad_q[][4] = {{INS_Q31_ONE + INS_Q31_ONE / 800, 0, 0, 0},
                                {INS_Q31_ONE - INS_Q31_ONE / 800, 0, 0, 0},
                                {0, 0, 0, 0},
                                {INT32_MIN, INT32_MIN, INT32_MIN, INT32_MIN},
                                {INT32_MAX, INT32_MAX, INT32_MAX, INT32_MAX}};
    for (const auto& q : bad_q)
    {
        EXPECT_EQ(ins_q31_init(&narrow, q), INS_E_RANGE);
        EXPECT_EQ(ins_q31w_init(&wide, q), INS_E_RANGE);
    }
    const int32_t nearly[4] = {INS_Q31_ONE + INS_Q31_ONE / 1200, 0, 0, 0};
    ASSERT_EQ(ins_q31_init(&narrow, nearly), INS_OK);
    EXPECT_NEAR(norm_of(from_q30(narrow.q_nb)), 1, 2e-9);
    ASSERT_EQ(ins_q31_init(&narrow, level), INS_OK);
    ASSERT_EQ(ins_q31w_init(&wide, level), INS_OK);
    const int32_t diagonal[3] = {half_rad / 10 * 6, half_rad / 10 * 6, half_rad / 10 * 6};
    EXPECT_EQ(ins_q31_step(&narrow, diagonal), INS_E_RANGE);
    EXPECT_EQ(ins_q31w_step(&wide, diagonal), INS_E_RANGE);
    for (size_t axis = 0; axis < 3; axis++)
    {
        for (const int32_t bad : {half_rad, -half_rad, INT32_MAX, INT32_MIN})
        {
            int32_t theta[3] = {0, 0, 0};
            theta[axis] = bad;
            EXPECT_EQ(ins_q31_step(&narrow, theta), INS_E_RANGE);
            EXPECT_EQ(ins_q31w_step(&wide, theta), INS_E_RANGE);
        }
    }
    EXPECT_EQ(from_q30(narrow.q_nb), (Quat{1, 0, 0, 0}));
    EXPECT_EQ(from_q62(wide.q_nb), (Quat{1, 0, 0, 0}));
    EXPECT_EQ(narrow.count, 0);
    EXPECT_EQ(wide.count, 0);
}
