/// \file   strapdown_reference.h
/// \brief  The strapdown step against the equations of motion in Earth-fixed coordinates: what its test and the figures of docs share.
///
/// Units: SI, rad.
/// SPDX-License-Identifier: MIT
#ifndef INS_TESTS_STRAPDOWN_REFERENCE_H
#define INS_TESTS_STRAPDOWN_REFERENCE_H
#include "core_test.h"

namespace core_test
{
namespace strapdown
{
using real_t = long double;
using V3 = std::array<real_t, 3>;

inline V3 cross(const V3& a, const V3& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

constexpr real_t A = 6378137.0L, F = 1 / 298.257223563L, E2 = F * (2 - F), OMEGA = 7.292115e-5L;

/// Sums of sines, so that their integrals are exact: rate and specific force of the body, in b.
struct Ride
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

inline V3 turned(const std::array<real_t, 4>& q, const V3& x)
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

inline Llh geodetic(const V3& r)
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
inline std::array<V3, 3> ned_axes(const Llh& x)
{
    const real_t s = std::sin(x.lat), c = std::cos(x.lat), sl = std::sin(x.lon), cl = std::cos(x.lon);
    return {V3{-s * cl, -s * sl, c}, V3{-sl, cl, 0}, V3{-c * cl, -c * sl, -s}};
}

inline real_t gravity(real_t lat, real_t h)
{
    const real_t s2 = std::sin(lat) * std::sin(lat);
    const real_t g0 = 9.7803253359L * (1 + 0.00193185265241L * s2) / std::sqrt(1 - E2 * s2);
    return g0 * (1 - 2 / A * (1 + F + 0.00344978650684084L - 2 * F * s2) * h + 3 * h * h / (A * A));
}

inline State derivative(const State& x, real_t t)
{
    const V3 earth = {0, 0, OMEGA};
    const V3 w = Ride::rate(t);
    const V3 f = turned(x.q, Ride::force(t));
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

inline State add(const State& x, real_t k, const State& d)
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

constexpr real_t DURATION_S = 120;

struct Start
{
    Llh llh;
    V3 v_n;
};

inline State reference(const Start& start)
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

inline Errors run(const Start& start, const State& end, int rate_hz)
{
    const double lat = static_cast<double>(start.llh.lat), lon = static_cast<double>(start.llh.lon);
    ins_position_t p = {{static_cast<ins_real>(lat), static_cast<ins_real>(lon), static_cast<ins_real>(start.llh.h)},
                        {0, 0, 0}};
    const ins_real level[4] = {1, 0, 0, 0};
    // What the anchor's rounding leaves (in float 0.4 m) belongs into the offset.
    p.offset[0] = static_cast<ins_real>(start.llh.lat - p.anchor[0]);
    p.offset[1] = static_cast<ins_real>(start.llh.lon - p.anchor[1]);
    const auto v = real(
        Vec{static_cast<double>(start.v_n[0]), static_cast<double>(start.v_n[1]), static_cast<double>(start.v_n[2])});
    const real_t T = 1 / static_cast<real_t>(rate_hz);
    ins_strapdown_t s;
    EXPECT_EQ(ins_strapdown_init(&s, INS_CONING_HIST2_OPT, static_cast<ins_real>(T), level, v.data(), &p), INS_OK);
    const long steps = static_cast<long>(DURATION_S) * rate_hz;
    for (long k = 0; k < steps; k++)
    {
        const ins_increment_t x = Ride::increment(static_cast<real_t>(k) * T, static_cast<real_t>(k + 1) * T);
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
} // namespace strapdown
} // namespace core_test

#endif // INS_TESTS_STRAPDOWN_REFERENCE_H
