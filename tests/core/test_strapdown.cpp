/// \file   test_strapdown.cpp
/// \brief  The strapdown step: order of convergence against integrated equations, slow motion, levers, refusals. SI, rad.
/// SPDX-License-Identifier: MIT
#include "core_test.h"
#include <cstring>
#include <limits>
using namespace core_test;

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

using real_t = long double;
using V3 = std::array<real_t, 3>;

V3 cross(const V3& a, const V3& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

const real_t A = 6378137.0L, F = 1 / 298.257223563L, E2 = F * (2 - F), OMEGA = 7.292115e-5L;

/// Sums of sines, so that their integrals are exact: rate and specific force of the body, in b.
struct Track
{
    static V3 rate(real_t t)
    {
        return {0.3L * std::sin(1.1L * t), 0.2L * std::sin(0.7L * t + 1), 0.3L * std::sin(0.9L * t + 2)};
    }
    static V3 rate_integral(real_t t)
    {
        return {-0.3L / 1.1L * std::cos(1.1L * t), -0.2L / 0.7L * std::cos(0.7L * t + 1),
                -0.3L / 0.9L * std::cos(0.9L * t + 2)};
    }
    static V3 force(real_t t)
    {
        return {6 * std::sin(0.5L * t) + 2, 4 * std::sin(0.8L * t + 1), -9.8L + 3 * std::sin(0.6L * t)};
    }
    static V3 force_integral(real_t t)
    {
        return {-12 * std::cos(0.5L * t) + 2 * t, -5 * std::cos(0.8L * t + 1), -9.8L * t - 5 * std::cos(0.6L * t)};
    }
    static ins_increment_t increment(real_t from, real_t to)
    {
        const V3 a = rate_integral(from), b = rate_integral(to), c = force_integral(from), d = force_integral(to);
        ins_increment_t x;
        for (size_t i = 0; i < 3; i++)
        {
            x.theta_b[i] = static_cast<ins_real>(b[i] - a[i]);
            x.v_b[i] = static_cast<ins_real>(d[i] - c[i]);
        }
        return x;
    }
};

/// The reference: Earth-fixed Cartesian coordinates, q_eb, v_e, r_e, by RK4 in long double. Shares no formula with the core but
/// the definition of normal gravity.
struct State
{
    std::array<real_t, 4> q;
    V3 v, r;
};

V3 turned(const std::array<real_t, 4>& q, const V3& x)
{
    const V3 r = {q[1], q[2], q[3]};
    const V3 t = cross(r, x);
    const V3 u = cross(r, t);
    return {x[0] + 2 * (q[0] * t[0] + u[0]), x[1] + 2 * (q[0] * t[1] + u[1]), x[2] + 2 * (q[0] * t[2] + u[2])};
}

struct Llh
{
    real_t lat, lon, h;
};

Llh geodetic(const V3& r)
{
    const real_t p = std::sqrt(r[0] * r[0] + r[1] * r[1]);
    real_t lat = std::atan2(r[2], p * (1 - E2));
    for (int i = 0; i < 8; i++)
    {
        const real_t n = A / std::sqrt(1 - E2 * std::sin(lat) * std::sin(lat));
        lat = std::atan2(r[2] + E2 * n * std::sin(lat), p);
    }
    const real_t s = std::sin(lat);
    return {lat, std::atan2(r[1], r[0]), p * std::cos(lat) + r[2] * s - A * std::sqrt(1 - E2 * s * s)};
}

/// Rows: north, east, down in e.
std::array<V3, 3> ned_axes(const Llh& x)
{
    const real_t s = std::sin(x.lat), c = std::cos(x.lat), sl = std::sin(x.lon), cl = std::cos(x.lon);
    return {V3{-s * cl, -s * sl, c}, V3{-sl, cl, 0}, V3{-c * cl, -c * sl, -s}};
}

real_t gravity(real_t lat, real_t h)
{
    const real_t s2 = std::sin(lat) * std::sin(lat);
    const real_t g0 = 9.7803253359L * (1 + 0.00193185265241L * s2) / std::sqrt(1 - E2 * s2);
    return g0 * (1 - 2 / A * (1 + F + 0.00344978650684084L - 2 * F * s2) * h + 3 * h * h / (A * A));
}

State derivative(const State& x, real_t t)
{
    const V3 earth = {0, 0, OMEGA};
    const V3 w = Track::rate(t);
    const V3 f = turned(x.q, Track::force(t));
    const Llh at = geodetic(x.r);
    const V3 down = ned_axes(at)[2];
    const real_t g = gravity(at.lat, at.h);
    const V3 coriolis = cross(earth, x.v);
    const auto& q = x.q;
    State d;
    // q w / 2 - Omega q / 2
    d.q = {(-q[1] * w[0] - q[2] * w[1] - q[3] * w[2] + OMEGA * q[3]) / 2,
           (q[0] * w[0] + q[2] * w[2] - q[3] * w[1] + OMEGA * q[2]) / 2,
           (q[0] * w[1] - q[1] * w[2] + q[3] * w[0] - OMEGA * q[1]) / 2,
           (q[0] * w[2] + q[1] * w[1] - q[2] * w[0] - OMEGA * q[0]) / 2};
    for (size_t i = 0; i < 3; i++)
    {
        d.v[i] = f[i] + g * down[i] - 2 * coriolis[i];
        d.r[i] = x.v[i];
    }
    return d;
}

State add(const State& x, real_t k, const State& d)
{
    State y = x;
    for (size_t i = 0; i < 4; i++)
    {
        y.q[i] += k * d.q[i];
    }
    for (size_t i = 0; i < 3; i++)
    {
        y.v[i] += k * d.v[i];
        y.r[i] += k * d.r[i];
    }
    return y;
}

const real_t DURATION_S = 120;

struct Start
{
    Llh llh;
    V3 v_n;
};

State reference(const Start& start)
{
    const auto axes = ned_axes(start.llh);
    const real_t s = std::sin(start.llh.lat);
    const real_t n = A / std::sqrt(1 - E2 * s * s);
    State x;
    const real_t c = std::cos(start.llh.lat);
    x.r = {(n + start.llh.h) * c * std::cos(start.llh.lon), (n + start.llh.h) * c * std::sin(start.llh.lon),
           (n * (1 - E2) + start.llh.h) * s};
    for (size_t i = 0; i < 3; i++)
    {
        x.v[i] = axes[0][i] * start.v_n[0] + axes[1][i] * start.v_n[1] + axes[2][i] * start.v_n[2];
    }
    // Body axes on NED: q_en turns by the longitude about z, then by -(90 deg + latitude) about y.
    const real_t a = start.llh.lon / 2, b = -(start.llh.lat + std::acos(-1.0L) / 2) / 2;
    x.q = {std::cos(a) * std::cos(b), -std::sin(a) * std::sin(b), std::cos(a) * std::sin(b), std::sin(a) * std::cos(b)};
    const long steps = 6000;
    const real_t h = DURATION_S / static_cast<real_t>(steps);
    for (long k = 0; k < steps; k++)
    {
        const real_t t = static_cast<real_t>(k) * h;
        const State k1 = derivative(x, t);
        const State k2 = derivative(add(x, h / 2, k1), t + h / 2);
        const State k3 = derivative(add(x, h / 2, k2), t + h / 2);
        const State k4 = derivative(add(x, h, k3), t + h);
        x = add(add(add(add(x, h / 6, k1), h / 3, k2), h / 3, k3), h / 6, k4);
    }
    return x;
}

struct Errors
{
    double position_m, velocity, attitude_rad;
};

Errors run(const Start& start, const State& end, int rate_hz)
{
    const double lat = static_cast<double>(start.llh.lat), lon = static_cast<double>(start.llh.lon);
    ins_position_t p = place(lat, lon, static_cast<double>(start.llh.h));
    // What the anchor's rounding leaves (in float 0.4 m) belongs into the offset.
    p.offset[0] = static_cast<ins_real>(start.llh.lat - p.anchor[0]);
    p.offset[1] = static_cast<ins_real>(start.llh.lon - p.anchor[1]);
    const auto v = real(
        Vec{static_cast<double>(start.v_n[0]), static_cast<double>(start.v_n[1]), static_cast<double>(start.v_n[2])});
    const real_t T = 1 / static_cast<real_t>(rate_hz);
    ins_strapdown_t s;
    EXPECT_EQ(ins_strapdown_init(&s, INS_CONING_HIST2_OPT, static_cast<ins_real>(T), LEVEL, v.data(), &p), INS_OK);
    const long steps = static_cast<long>(DURATION_S) * rate_hz;
    for (long k = 0; k < steps; k++)
    {
        const ins_increment_t x = Track::increment(static_cast<real_t>(k) * T, static_cast<real_t>(k + 1) * T);
        EXPECT_EQ(ins_strapdown_step(&s, &x), k < 2 ? INS_S_START : INS_OK);
    }
    const Llh want = geodetic(end.r);
    const real_t got_lat = static_cast<real_t>(s.position.anchor[0]) + s.position.offset[0];
    const real_t got_lon = static_cast<real_t>(s.position.anchor[1]) + s.position.offset[1];
    const real_t got_h = static_cast<real_t>(s.position.anchor[2]) + s.position.offset[2];
    const double dn = static_cast<double>((got_lat - want.lat) * A);
    const double de = static_cast<double>((got_lon - want.lon) * A * std::cos(want.lat));
    const double dd = static_cast<double>(got_h - want.h);
    const auto axes = ned_axes(want);
    Errors e = {std::sqrt(dn * dn + de * de + dd * dd), 0, 0};
    for (size_t i = 0; i < 3; i++)
    {
        const real_t v_n = axes[i][0] * end.v[0] + axes[i][1] * end.v[1] + axes[i][2] * end.v[2];
        e.velocity = std::max(e.velocity, static_cast<double>(std::fabs(v_n - s.v_n[i])));
    }
    // Body axes in n, by both.
    for (size_t axis = 0; axis < 3; axis++)
    {
        V3 unit = {0, 0, 0};
        unit[axis] = 1;
        const V3 in_e = turned(end.q, unit);
        const V3 in_n = turned({s.sculling.q_nb[0], s.sculling.q_nb[1], s.sculling.q_nb[2], s.sculling.q_nb[3]}, unit);
        for (size_t i = 0; i < 3; i++)
        {
            const real_t x = axes[i][0] * in_e[0] + axes[i][1] * in_e[1] + axes[i][2] * in_e[2];
            e.attitude_rad = std::max(e.attitude_rad, static_cast<double>(std::fabs(x - in_n[i])));
        }
    }
    return e;
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
    const ins_position_t p = place(0.5, 179.99 * RAD, 0);
    const ins_real v[3] = {0, 300, 0};
    ins_strapdown_t s;
    ASSERT_EQ(ins_strapdown_init(&s, INS_CONING_HIST2_OPT, INS_C(0.01), LEVEL, v, &p), INS_OK);
    for (int k = 0; k < 1000; k++)
    {
        const ins_increment_t x = increment_of({0, 0, 0}, {0, 0, -0.0979});
        ASSERT_GE(ins_strapdown_step(&s, &x), INS_OK);
        EXPECT_LE(std::fabs(static_cast<double>(s.position.offset[1])), 2.6e-4);
    }
    EXPECT_LT(s.position.anchor[1], 0);
    ins_real ned[3];
    ins_position_difference(&p, &s.position, ned);
    EXPECT_NEAR(static_cast<double>(ned[1]), 3000, 0.3);
    ins_real back[3];
    ins_position_difference(&s.position, &p, back);
    EXPECT_NEAR(static_cast<double>(back[1]), -static_cast<double>(ned[1]), 0.3);
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
