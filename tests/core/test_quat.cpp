/// \file   test_quat.cpp
/// \brief  docs/conventions.md in numbers, and quaternions at their edges: poles, half turns, NaN, large angles.
/// SPDX-License-Identifier: MIT
#include "core_test.h"
#include <limits>
#include <random>
using namespace core_test;

namespace
{
const double TOL = INS_TOL(4e-16, 3e-7);           // component of a quaternion or of a unit vector
const double TOL_LARGE = INS_TOL(1e-15, 6e-7);     // after a few products
const double TOL_LARGE_REL = INS_TOL(6e-16, 3e-7); // of the angle
const ins_real NOT_A_NUMBER = std::numeric_limits<ins_real>::quiet_NaN();
const ins_real INFINITE = std::numeric_limits<ins_real>::infinity();
const int RANDOM_ROTATIONS = 2000;

Quat rotvec(const Vec& phi)
{
    ins_real q[4];
    EXPECT_EQ(ins_quat_from_rotvec(real(phi).data(), q), INS_OK);
    return quat(q);
}

void expect_near(const ins_real* got, std::vector<double> want, double tolerance)
{
    for (size_t i = 0; i < want.size(); i++)
    {
        EXPECT_NEAR(static_cast<double>(got[i]), want[i], tolerance) << "element " << i;
    }
}
} // namespace

// A body that heads east (yaw +90 deg): its nose is east, its right wing south. Axes: n = north, east, down; b = forward, right, down.
TEST(conventions, yaw_turns_the_nose_from_north_to_east)
{
    const ins_real euler[3] = {0, 0, static_cast<ins_real>(PI / 2)};
    ins_real q[4];
    ins_quat_from_euler(euler, q);
    expect_near(q, {std::sqrt(0.5), 0, 0, std::sqrt(0.5)}, TOL); // scalar first
    const ins_real forward[3] = {1, 0, 0};
    const ins_real right[3] = {0, 1, 0};
    ins_real v_n[3];
    ins_quat_rotate(q, forward, v_n);
    expect_near(v_n, {0, 1, 0}, TOL);
    ins_quat_rotate(q, right, v_n);
    expect_near(v_n, {-1, 0, 0}, TOL);
    ins_real C_nb[9];
    ins_quat_to_dcm(q, C_nb);
    expect_near(C_nb, {0, -1, 0, 1, 0, 0, 0, 0, 1}, TOL); // row-major, columns = body axes in n
}

TEST(conventions, positive_pitch_lifts_the_nose_and_positive_roll_lowers_the_right_wing)
{
    const ins_real forward[3] = {1, 0, 0};
    const ins_real right[3] = {0, 1, 0};
    const ins_real pitch[3] = {0, static_cast<ins_real>(PI / 6), 0};
    const ins_real roll[3] = {static_cast<ins_real>(PI / 6), 0, 0};
    ins_real q[4];
    ins_real v_n[3];
    ins_quat_from_euler(pitch, q);
    ins_quat_rotate(q, forward, v_n);
    expect_near(v_n, {std::sqrt(0.75), 0, -0.5}, TOL);
    ins_quat_from_euler(roll, q);
    ins_quat_rotate(q, right, v_n);
    expect_near(v_n, {0, std::sqrt(0.75), 0.5}, TOL);
}

TEST(conventions, euler_sequence_is_yaw_then_pitch_then_roll)
{
    const Vec euler = {0.3, -0.4, 2.5};
    ins_real q[4];
    ins_quat_from_euler(real(euler).data(), q);
    const Quat in_turn = mul(mul(rotvec({0, 0, 2.5}), rotvec({0, -0.4, 0})), rotvec({0.3, 0, 0}));
    expect_near(q, {in_turn.begin(), in_turn.end()}, TOL_LARGE);
    ins_real back[3];
    ins_quat_to_euler(q, back);
    expect_near(back, {0.3, -0.4, 2.5}, TOL_LARGE);
}

TEST(conventions, an_increment_multiplies_from_the_right)
{
    // Heading east, then a roll about the body's own nose: the nose stays east.
    const Quat q = mul(rotvec({0, 0, PI / 2}), rotvec({0.7, 0, 0}));
    ins_attitude_t a;
    ASSERT_EQ(ins_attitude_init(&a, INS_CONING_ONE, real(rotvec({0, 0, PI / 2})).data()), INS_OK);
    const ins_real roll[3] = {static_cast<ins_real>(0.7), 0, 0};
    ASSERT_EQ(ins_attitude_step(&a, roll), INS_OK);
    expect_near(a.q_nb, {q.begin(), q.end()}, TOL_LARGE);
    const ins_real forward[3] = {1, 0, 0};
    ins_real v_n[3];
    ins_quat_rotate(a.q_nb, forward, v_n);
    expect_near(v_n, {0, 1, 0}, TOL_LARGE);
}

TEST(quat, rotation_vectors_of_any_angle)
{
    Worst worst;
    for (const double angle : {0.0, 1e-30, 1e-12, 1e-4, 0.1, 0.4999999, 0.5, 0.5000001, 1.0, PI / 2, PI, 3 * PI / 2,
                               2 * PI, 7.0, 100.0, 999.0})
    {
        // Half angle by libm of the angle as it is in ins_real.
        const auto phi = real(Vec{0.6 * angle, 0, -0.8 * angle});
        const double n = norm(vec(phi.data()));
        const Quat q = rotvec(vec(phi.data()));
        const double s = std::sin(n / 2);
        const double scale = std::max(1.0, n);
        worst.take(q[0], std::cos(n / 2), scale, "w at " + std::to_string(angle));
        worst.take(q[1], 0.6 * s, scale, "x at " + std::to_string(angle));
        EXPECT_EQ(q[2], 0);
        worst.take(q[3], -0.8 * s, scale, "z at " + std::to_string(angle));
    }
    expect_within(worst, TOL_LARGE_REL, "rotvec, relative to max(1, |phi|)");
}

TEST(quat, refuses_what_is_no_rotation)
{
    const ins_real bad[][3] = {{NOT_A_NUMBER, 0, 0}, {0, INFINITE, 0}, {0, 0, INS_ROTVEC_MAX + 1}};
    for (const auto& phi : bad)
    {
        ins_real q[4] = {9, 9, 9, 9};
        EXPECT_EQ(ins_quat_from_rotvec(phi, q), INS_E_RANGE);
        EXPECT_EQ(q[0], 9);
    }
    ins_real zero[4] = {0, 0, 0, 0};
    EXPECT_EQ(ins_quat_normalise(zero), INS_E_RANGE);
    ins_real nan[4] = {1, 0, NOT_A_NUMBER, 0};
    EXPECT_EQ(ins_quat_normalise(nan), INS_E_RANGE);
    EXPECT_EQ(nan[0], 1);
    ins_real huge[4] = {0, INS_C(1e16), 0, 0};
    EXPECT_EQ(ins_quat_normalise(huge), INS_E_RANGE);
    EXPECT_EQ(huge[1], INS_C(1e16));
    const ins_real bad_dcm[][9] = {{1, 0, 0, 0, 1, 0, 0, 0, -1}, {-1, 0, 0, 0, -1, 0, 0, 0, -1},
                                   {2, 0, 0, 0, 2, 0, 0, 0, 2},  {1, 0, 0, 0, NOT_A_NUMBER, 0, 0, 0, 1},
                                   {0, 0, 0, 0, 0, 0, 0, 0, 0},  {1, static_cast<ins_real>(0.01), 0, 0, 1, 0, 0, 0, 1}};
    for (const auto& C : bad_dcm)
    {
        ins_real q[4] = {9, 9, 9, 9};
        EXPECT_EQ(ins_quat_from_dcm(C, q), INS_E_RANGE);
        EXPECT_EQ(q[0], 9);
    }
}

TEST(quat, normalise_exactly_and_to_first_order)
{
    for (const double length : {1e-10, 0.5, 1.0, 3.0, 1e10})
    {
        auto q = real(Quat{0.5 * length, -0.5 * length, 0.5 * length, 0.5 * length});
        ASSERT_EQ(ins_quat_normalise(q.data()), INS_OK);
        expect_near(q.data(), {0.5, -0.5, 0.5, 0.5}, TOL);
    }
    // eps = 1 - |q|^2 leaves 3/8 eps^2.
    const double eps = 1e-2;
    auto q = real(Quat{std::sqrt(1 - eps), 0, 0, 0});
    ins_quat_normalise_approx(q.data());
    EXPECT_NEAR(1 - static_cast<double>(q[0]), 3.0 / 8 * eps * eps, 1e-6);
}

TEST(quat, half_turns_about_every_axis_survive_the_dcm)
{
    const Vec axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.6, 0.8, 0}, {0, 0.6, -0.8}, {-0.48, 0.6, 0.64}};
    for (const Vec& axis : axes)
    {
        const auto q = real(Quat{0, axis[0], axis[1], axis[2]});
        ins_real C[9];
        ins_quat_to_dcm(q.data(), C);
        ins_real back[4];
        ASSERT_EQ(ins_quat_from_dcm(C, back), INS_OK);
        EXPECT_LE(angle_between(quat(back), quat(q.data())), 4 * TOL);
    }
}

TEST(quat, euler_angles_at_the_poles_give_the_rotation_back)
{
    Worst worst;
    for (const double pole : {PI / 2, -PI / 2})
    {
        for (const double off : {0.0, 1e-15, 1e-12, 1e-9, 1e-7, 1e-4})
        {
            for (const double roll : {0.0, 1.0, -2.0, 3.1})
            {
                for (const double yaw : {0.0, 0.4, -3.1, PI})
                {
                    const Quat q = from_euler({roll, pole - std::copysign(off, pole), yaw});
                    ins_real euler[3];
                    ins_quat_to_euler(real(q).data(), euler);
                    for (const ins_real e : euler)
                    {
                        EXPECT_LE(std::fabs(static_cast<double>(e)), PI + TOL);
                    }
                    if (off == 0)
                    {
                        EXPECT_EQ(euler[0], 0) << "roll has no meaning of its own here";
                    }
                    worst.take(angle_between(from_euler(vec(euler)), q), 0, 1, "pole " + std::to_string(pole));
                }
            }
        }
    }
    expect_within(worst, INS_TOL(4e-15, 1e-6), "Euler angles near the poles [rad]");
    const auto up = real(Quat{std::sqrt(0.5), 0, std::sqrt(0.5), 0});
    ins_real euler[3];
    ins_quat_to_euler(up.data(), euler);
    expect_near(euler, {0, PI / 2, 0}, TOL);
}

TEST(quat, random_rotations_agree_in_all_forms)
{
    const unsigned seed = 20260;
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    Worst worst;
    for (int n = 0; n < RANDOM_ROTATIONS; n++)
    {
        auto q = real(Quat{normal(random), normal(random), normal(random), normal(random)});
        ASSERT_EQ(ins_quat_normalise(q.data()), INS_OK);
        const Vec v = {normal(random), normal(random), normal(random)};
        const auto v_b = real(v);
        ins_real v_n[3];
        ins_quat_rotate(q.data(), v_b.data(), v_n);
        ins_real C[9];
        ins_quat_to_dcm(q.data(), C);
        for (size_t i = 0; i < 3; i++)
        {
            worst.take(static_cast<double>(ins_vec_dot(C + 3 * i, v_b.data())), static_cast<double>(v_n[i]),
                       1 + norm(v), "C v = q v q*");
        }
        ins_real inverse[4];
        ins_quat_conj(q.data(), inverse);
        ins_quat_rotate(inverse, v_n, v_n);
        for (size_t i = 0; i < 3; i++)
        {
            worst.take(static_cast<double>(v_n[i]), v[i], 1 + norm(v), "there and back");
        }
        ins_real other[4];
        ASSERT_EQ(ins_quat_from_dcm(C, other), INS_OK);
        worst.take(angle_between(quat(other), quat(q.data())), 0, 1, "dcm");
        ins_real euler[3];
        ins_quat_to_euler(q.data(), euler);
        ins_quat_from_euler(euler, other);
        worst.take(angle_between(quat(other), quat(q.data())), 0, 1, "euler");
    }
    expect_within(worst, INS_TOL(3e-15, 2e-6), "random rotations, seed " + std::to_string(seed));
}
