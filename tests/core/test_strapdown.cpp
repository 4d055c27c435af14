/// \file   test_strapdown.cpp
/// \brief  The strapdown step: order of convergence against integrated equations, slow motion, levers, refusals. SI, rad.
/// SPDX-License-Identifier: MIT
#include "strapdown_reference.h"
#include <cstring>
#include <limits>
using namespace core_test;
using namespace core_test::strapdown;

namespace
{
const double RAD = PI / 180;
const ins_real NOT_A_NUMBER = std::numeric_limits<ins_real>::quiet_NaN();
const ins_real INFINITE = std::numeric_limits<ins_real>::infinity();
const ins_real LEVEL[4] = {1, 0, 0, 0};

ins_increment_t increment_of(const Vec& theta, const Vec& v)
{
    const auto t = real(theta);
    const auto w = real(v);
    return {{t[0], t[1], t[2]}, {w[0], w[1], w[2]}};
}

ins_position_t place(double lat, double lon, double h)
{
    return {{static_cast<ins_real>(lat), static_cast<ins_real>(lon), static_cast<ins_real>(h)}, {0, 0, 0}};
}

} // namespace

TEST(strapdown, converges_to_the_integrated_equations)
{
    const Start start = {{45 * RAD, 0.1L, 500}, {300, 200, -10}};
    const State end = reference(start);
    std::vector<Errors> e;
    for (const int hz : {25, 50, 100, 200})
    {
        e.push_back(run(start, end, hz));
        std::printf("[ figure   ] strapdown %d Hz, 120 s: position %.2e m, velocity %.2e m/s, attitude %.2e rad\n", hz,
                    e.back().position_m, e.back().velocity, e.back().attitude_rad);
    }
#ifdef INS_REAL_FLOAT
    // Rounding is what is left: of each step's attitude, 6e-8 rad, adding up with the number of steps.
    for (const Errors& x : e)
    {
        EXPECT_LT(x.position_m, 3);
        EXPECT_LT(x.velocity, 0.06);
        EXPECT_LT(x.attitude_rad, 1.5e-4);
    }
#else
    EXPECT_LT(e[2].position_m, 0.1);
    EXPECT_LT(e[2].attitude_rad, 6e-9);
    for (size_t i = 1; i < e.size(); i++)
    {
        const double second_order = 3.5; // 4 in the limit
        EXPECT_GT(e[i - 1].position_m / e[i].position_m, second_order) << i;
        EXPECT_GT(e[i - 1].velocity / e[i].velocity, second_order) << i;
        EXPECT_GT(e[i - 1].attitude_rad / e[i].attitude_rad, second_order) << i;
    }
#endif
}

TEST(strapdown, stands_still_on_the_rotating_earth)
{
    // A level IMU at rest measures Earth rate and the reaction to gravity; for ten minutes it must not move.
    const double lat = 25 * RAD, T = 0.01;
    const ins_position_t p = place(lat, 121 * RAD, 30);
    const ins_real zero[3] = {0, 0, 0};
    ins_strapdown_t s;
    ASSERT_EQ(ins_strapdown_init(&s, INS_CONING_HIST2_OPT, INS_C(0.01), LEVEL, zero, &p), INS_OK);
    const double g = static_cast<double>(ins_earth_gravity(static_cast<ins_real>(std::sin(lat)), 30));
    const ins_increment_t x =
        increment_of({7.292115e-5 * std::cos(lat) * T, 0, -7.292115e-5 * std::sin(lat) * T}, {0, 0, -g * T});
    for (int k = 0; k < 60000; k++)
    {
        ASSERT_GE(ins_strapdown_step(&s, &x), INS_OK);
    }
    ins_real ned[3];
    ins_position_difference(&p, &s.position, ned);
    // Float: the attitude's rounding, some 1e-7 rad, tilts gravity; its products are 1e-6 m/s^2.
    for (size_t i = 0; i < 3; i++)
    {
        EXPECT_NEAR(static_cast<double>(s.v_n[i]), 0, INS_TOL(1e-9, 5e-2)) << i;
        EXPECT_NEAR(static_cast<double>(ned[i]), 0, INS_TOL(1e-6, 15)) << i;
    }
    EXPECT_LT(angle_between(quat(s.sculling.q_nb), {1, 0, 0, 0}), INS_TOL(1e-12, 3e-5));
}

TEST(strapdown, slow_motion_is_not_lost_in_the_position)
{
    // 1 cm/s north and east, up, at 100 Hz: 1e-4 m a step, far below the step of a latitude in float, 0.4 m.
    const ins_position_t p = place(45 * RAD, 179.9999999 * RAD, 1000);
    const ins_real v[3] = {INS_C(0.01), INS_C(0.01), INS_C(-0.01)};
    ins_strapdown_t s;
    ASSERT_EQ(ins_strapdown_init(&s, INS_CONING_HIST2_OPT, INS_C(0.01), LEVEL, v, &p), INS_OK);
    for (int k = 0; k < 10000; k++)
    {
        ins_increment_t x = increment_of({0, 0, 0}, {0, 0, 0});
        ASSERT_GE(ins_strapdown_step(&s, &x), INS_OK);
        // Held on course: only the position's arithmetic is under test.
        for (size_t i = 0; i < 3; i++)
        {
            s.v_n[i] = v[i];
            s.half_dv[i] = 0;
        }
    }
    ins_real ned[3];
    ins_position_difference(&p, &s.position, ned);
    // Free fall of half a step each: g T^2 / 2 goes into the height.
    const double fell = 10000 * 0.5 * 9.80 * 1e-4;
    EXPECT_NEAR(static_cast<double>(ned[0]), 1, INS_TOL(2e-3, 4e-3));
    EXPECT_NEAR(static_cast<double>(ned[1]), 1, INS_TOL(2e-3, 4e-3));
    EXPECT_NEAR(static_cast<double>(ned[2]), -1 + fell, 0.01);
}

TEST(strapdown, anchor_follows_and_longitude_wraps)
{
    for (const int sense : {1, -1}) // east over the date line, and west
    {
        const ins_position_t p = place(0.5, sense * 179.99 * RAD, 0);
        const ins_real v[3] = {0, static_cast<ins_real>(300 * sense), 0};
        ins_strapdown_t s;
        ASSERT_EQ(ins_strapdown_init(&s, INS_CONING_HIST2_OPT, INS_C(0.01), LEVEL, v, &p), INS_OK);
        for (int k = 0; k < 1000; k++)
        {
            const ins_increment_t x = increment_of({0, 0, 0}, {0, 0, -0.0979});
            ASSERT_GE(ins_strapdown_step(&s, &x), INS_OK);
            EXPECT_LE(std::fabs(static_cast<double>(s.position.offset[1])), 2.6e-4);
        }
        EXPECT_LT(static_cast<double>(s.position.anchor[1]) * sense, -179.9 * RAD);
        ins_real ned[3];
        ins_position_difference(&p, &s.position, ned);
        EXPECT_NEAR(static_cast<double>(ned[1]), sense * 3000, 0.3);
        ins_real back[3];
        ins_position_difference(&s.position, &p, back);
        EXPECT_NEAR(static_cast<double>(back[1]), -static_cast<double>(ned[1]), 0.3);
    }
}

TEST(strapdown, another_point_of_the_body)
{
    const double lat = 0.5;
    const ins_position_t p = place(lat, 2, 100);
    const ins_real v[3] = {10, 0, 0};
    const auto q = real(from_euler({0, 0, PI / 2})); // nose to the east
    ins_strapdown_t s;
    ASSERT_EQ(ins_strapdown_init(&s, INS_CONING_HIST2_OPT, INS_C(0.01), q.data(), v, &p), INS_OK);
    // Turning right at 1 rad/s, 2 m ahead of the IMU and 1 m above: east 2, up 1; moving south by 2 m/s more.
    const ins_real lever[3] = {2, 0, -1};
    const ins_real w[3] = {0, 0, 1};
    ins_real v_point[3];
    ins_position_t point;
    ins_real ned[3];
    ins_strapdown_point(&s, lever, w, v_point, &point);
    ins_position_difference(&s.position, &point, ned);
    const Vec want_v = {8, 0, 0};
    const Vec want = {0, 2, -1};
    // The Earth turns under the lever: 2 m times 7.3e-5 rad/s.
    for (size_t i = 0; i < 3; i++)
    {
        EXPECT_NEAR(static_cast<double>(ned[i]), want[i], INS_TOL(1e-6, 1e-4)) << i;
        EXPECT_NEAR(static_cast<double>(v_point[i]), want_v[i], 2e-4) << i;
    }
    // Level and heading north, b and n have the same axes.
    ASSERT_EQ(ins_strapdown_init(&s, INS_CONING_HIST2_OPT, INS_C(0.01), LEVEL, v, &p), INS_OK);
    const ins_real ahead[3] = {3, -2, 1};
    ins_strapdown_point(&s, ahead, w, v_point, &point);
    ins_position_difference(&s.position, &point, ned);
    for (size_t i = 0; i < 3; i++)
    {
        EXPECT_NEAR(static_cast<double>(ned[i]), static_cast<double>(ahead[i]), INS_TOL(1e-6, 1e-4)) << i;
    }
    // At rest on Earth, turning with it, the point stands still.
    const ins_real still[3] = {0, 0, 0};
    ASSERT_EQ(ins_strapdown_init(&s, INS_CONING_HIST2_OPT, INS_C(0.01), LEVEL, still, &p), INS_OK);
    ins_real w_ie[3];
    ins_earth_rate(static_cast<ins_real>(std::sin(lat)), static_cast<ins_real>(std::cos(lat)), w_ie);
    ins_strapdown_point(&s, lever, w_ie, v_point, &point);
    for (const ins_real x : v_point)
    {
        EXPECT_NEAR(static_cast<double>(x), 0, INS_TOL(1e-18, 1e-10));
    }
}

TEST(strapdown, refuses_and_changes_nothing)
{
    const ins_position_t good = place(0.5, 2, 100);
    const ins_real v[3] = {1, 2, 3};
    ins_strapdown_t s;
    const auto init = [&](ins_real T, const ins_real velocity[3], const ins_position_t& p)
    { return ins_strapdown_init(&s, INS_CONING_HIST2_OPT, T, LEVEL, velocity, &p); };
    for (const ins_real T : {INS_C(0.), INS_C(-0.01), INS_C(1.01), NOT_A_NUMBER})
    {
        EXPECT_EQ(init(T, v, good), INS_E_RANGE);
    }
    const ins_real fast[3] = {0, 0, INS_C(1.1e4)};
    const ins_real odd[3] = {0, NOT_A_NUMBER, 0};
    EXPECT_EQ(init(INS_C(0.01), fast, good), INS_E_RANGE);
    EXPECT_EQ(init(INS_C(0.01), odd, good), INS_E_RANGE);
    for (size_t i = 0; i < 3; i++)
    {
        ins_position_t bad = good;
        bad.anchor[i] = NOT_A_NUMBER;
        EXPECT_EQ(init(INS_C(0.01), v, bad), INS_E_RANGE);
        bad = good;
        bad.offset[i] = INFINITE;
        EXPECT_EQ(init(INS_C(0.01), v, bad), INS_E_RANGE);
    }
    EXPECT_EQ(init(INS_C(0.01), v, place(PI / 2 - 1e-4, 0, 0)), INS_E_RANGE);
    EXPECT_EQ(ins_strapdown_init(&s, INS_CONING_BLOCK2, INS_C(0.01), LEVEL, v, &good), INS_E_RANGE);
    ASSERT_EQ(init(INS_C(0.01), v, good), INS_OK);
    const ins_increment_t calm = increment_of({1e-3, 2e-3, 1e-3}, {0, 0, -0.098});
    for (int k = 0; k < 4; k++) // the general step first, then the fast one
    {
        for (size_t i = 0; i < 6; i++)
        {
            for (const ins_real bad : {NOT_A_NUMBER, INFINITE, -INFINITE})
            {
                ins_increment_t x = calm;
                (i < 3 ? x.theta_b[i] : x.v_b[i - 3]) = bad;
                const ins_strapdown_t before = s;
                EXPECT_EQ(ins_strapdown_step(&s, &x), INS_E_RANGE) << i;
                ins_real dv[3] = {7, 7, 7};
                EXPECT_EQ(ins_sculling_step(&s.sculling, &x, dv), INS_E_RANGE) << i;
                EXPECT_EQ(dv[0], 7);
                EXPECT_EQ(std::memcmp(&before, &s, sizeof s), 0);
            }
        }
        EXPECT_EQ(ins_strapdown_step(&s, &calm), k < 2 ? INS_S_START : INS_OK);
    }
    // Flying over the pole ends before it.
    const ins_real north[3] = {1000, 0, 0};
    ASSERT_EQ(init(INS_C(0.01), north, place(PI / 2 - 2e-3, 0, 0)), INS_OK);
    int steps = 0;
    const ins_increment_t level_flight = increment_of({0, 0, 0}, {0, 0, -0.098});
    while (steps < 2000 && ins_strapdown_step(&s, &level_flight) >= INS_OK)
    {
        steps++;
    }
    EXPECT_GT(steps, 500);
    EXPECT_LT(steps, 700);
}
