/// \file   test_align.cpp
/// \brief  Means and nulls with their standard error, levelling, TRIAD. Frames: b -> n (NED). Units: rad, m/s^2.
/// SPDX-License-Identifier: MIT
#include "core_test.h"
#include <limits>
#include <random>
using namespace core_test;

namespace
{
const double TOL_RAD = INS_TOL(1e-14, 1e-6);
const ins_real NOT_A_NUMBER = std::numeric_limits<ins_real>::quiet_NaN();

Vec rotate(const Quat& q, const Vec& v)
{
    const Quat r = mul(mul(q, {0, v[0], v[1], v[2]}), conj(q));
    return {r[1], r[2], r[3]};
}
} // namespace

TEST(align, level_and_heading)
{
    for (const double heading : {-3.0, 0.0, 1.0, 5.0})
    {
        for (const double pitch : {-1.2, -0.3, 0.0, 0.5, 1.5})
        {
            for (const double roll : {-3.0, -1.0, 0.0, 0.2, 2.5})
            {
                const Quat want = from_euler({roll, pitch, heading});
                const Vec f = rotate(conj(want), {0, 0, -9.79});
                ins_real q[4];
                ASSERT_EQ(ins_align_level(real(f).data(), static_cast<ins_real>(heading), q), INS_OK);
                // A direction is as good as its component across the nose lets it be.
                EXPECT_LT(angle_between(quat(q), want), TOL_RAD / std::cos(pitch)) << heading << pitch << roll;
            }
        }
    }
}

TEST(align, nose_up_and_down_have_no_roll)
{
    for (const double sign : {1.0, -1.0})
    {
        const ins_real f[3] = {static_cast<ins_real>(sign * 9.8), 0, 0};
        ins_real q[4];
        ASSERT_EQ(ins_align_level(f, INS_C(0.7), q), INS_OK);
        EXPECT_LT(angle_between(quat(q), from_euler({0, sign * PI / 2, 0.7})), INS_TOL(1e-7, 1e-3));
    }
}

TEST(align, triad)
{
    const Quat want = from_euler({0.3, -0.7, 2});
    const Vec down = {0, 0, 1};
    const Vec field = {27, -2, 40};
    const Vec down_b = rotate(conj(want), {0, 0, 3});
    const Vec field_b = rotate(conj(want), field);
    ins_real q[4];
    ASSERT_EQ(ins_align_triad(real(down_b).data(), real(field_b).data(), real(down).data(), real(field).data(), q),
              INS_OK);
    EXPECT_LT(angle_between(quat(q), want), TOL_RAD);
    // The first is met exactly: an error of the second along the plane of both changes nothing.
    const Vec bent = {field_b[0] + 20 * down_b[0], field_b[1] + 20 * down_b[1], field_b[2] + 20 * down_b[2]};
    ASSERT_EQ(ins_align_triad(real(down_b).data(), real(bent).data(), real(down).data(), real(field).data(), q),
              INS_OK);
    EXPECT_LT(angle_between(quat(q), want), 10 * TOL_RAD);
}

TEST(align, refuses)
{
    const ins_real x[3] = {1, 0, 0};
    const ins_real y[3] = {0, 2, 0};
    const ins_real nearly_x[3] = {-1, INS_C(1e-4), 0};
    const ins_real zero[3] = {0, 0, 0};
    const ins_real odd[3] = {1, NOT_A_NUMBER, 0};
    const ins_real huge[3] = {0, std::numeric_limits<ins_real>::max(), 0}; // its square is infinite
    const ins_real endless[3] = {0, 0, std::numeric_limits<ins_real>::infinity()};
    ins_real q[4] = {7, 7, 7, 7};
    for (const ins_real* bad : {nearly_x, zero, odd, huge, endless})
    {
        EXPECT_EQ(ins_align_triad(x, bad, x, y, q), INS_E_RANGE);
        EXPECT_EQ(ins_align_triad(bad, x, x, y, q), INS_E_RANGE);
        EXPECT_EQ(ins_align_triad(x, y, bad, x, q), INS_E_RANGE);
        EXPECT_EQ(ins_align_triad(x, y, x, bad, q), INS_E_RANGE);
    }
    EXPECT_EQ(ins_align_level(zero, 0, q), INS_E_RANGE);
    EXPECT_EQ(ins_align_level(odd, 0, q), INS_E_RANGE);
    EXPECT_EQ(ins_align_level(x, 7, q), INS_E_RANGE);
    EXPECT_EQ(ins_align_level(x, NOT_A_NUMBER, q), INS_E_RANGE);
    EXPECT_EQ(q[0], 7);
    ins_mean_t mean;
    ins_real m[3];
    ins_real e[3];
    EXPECT_EQ(ins_mean_init(&mean, -1), INS_E_RANGE);
    EXPECT_EQ(ins_mean_init(&mean, NOT_A_NUMBER), INS_E_RANGE);
    EXPECT_EQ(ins_mean_init(&mean, std::numeric_limits<ins_real>::infinity()), INS_E_RANGE);
    ASSERT_EQ(ins_mean_init(&mean, 0), INS_OK);
    EXPECT_EQ(ins_mean_add(&mean, odd), INS_E_RANGE);
    EXPECT_EQ(ins_mean_add(&mean, x), INS_OK);
    EXPECT_EQ(ins_mean_get(&mean, m, e), INS_E_STATE);
    EXPECT_EQ(mean.count, 1u);
}

TEST(align, null_is_fractional_and_its_error_honest)
{
    // A minute of 12-bit codes at 6 Hz about a null of 2047.37: sigma 0.9 code on x, 0.5 on y, none on z.
    const unsigned seed = 20090611;
    const int minutes = 400;
    const int samples = 360;
    const double null = 2047.37;
    std::printf("[ figure   ] seed %u\n", seed);
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const double sigma[3] = {0.9, 0.5, 0};
    double inside[2] = {0, 0};
    double sum2[2] = {0, 0};
    double claimed[2] = {0, 0};
    for (int k = 0; k < minutes; k++)
    {
        ins_mean_t mean;
        ASSERT_EQ(ins_mean_init(&mean, 1), INS_OK);
        for (int i = 0; i < samples; i++)
        {
            ins_real code[3];
            for (size_t axis = 0; axis < 3; axis++)
            {
                code[axis] = static_cast<ins_real>(std::floor(null + sigma[axis] * normal(random) + 0.5));
            }
            ASSERT_EQ(ins_mean_add(&mean, code), INS_OK);
        }
        ins_real m[3];
        ins_real e[3];
        ASSERT_EQ(ins_mean_get(&mean, m, e), INS_OK);
        for (size_t axis = 0; axis < 2; axis++)
        {
            const double error = static_cast<double>(m[axis]) - null;
            sum2[axis] += error * error;
            claimed[axis] += static_cast<double>(e[axis] * e[axis]);
            inside[axis] += std::fabs(error) < 2 * static_cast<double>(e[axis]);
        }
        // Without noise every code is 2047: 0.37 off, and the error says a good quarter of a code.
        EXPECT_EQ(m[2], 2047);
        EXPECT_NEAR(static_cast<double>(e[2]), 1 / std::sqrt(12.0), 1e-6);
    }
    for (size_t axis = 0; axis < 2; axis++)
    {
        std::printf("[ figure   ] null after 60 s: rms error %.4f code, claimed %.4f\n",
                    std::sqrt(sum2[axis] / minutes), std::sqrt(claimed[axis] / minutes));
        EXPECT_NEAR(std::sqrt(sum2[axis] / claimed[axis]), 1, 0.15);
        EXPECT_NEAR(inside[axis] / minutes, 0.954, 0.035);
        EXPECT_LT(std::sqrt(sum2[axis] / minutes), 0.06); // an integer null would be 0.37 off
    }
}
