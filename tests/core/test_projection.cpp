/// \file   test_projection.cpp
/// \brief  Transverse Mercator against its definition, a complex integral; the thesis's series by their orders on a sphere. rad, m.
/// SPDX-License-Identifier: MIT
#include "core_test.h"
#include <complex>
using namespace core_test;

namespace
{
using Complex = std::complex<double>;
constexpr double RAD = PI / 180;
constexpr double RADIUS_M = 6378137;
constexpr int PARTS = 64;

/// Northing and easting from the equator and the central meridian: the meridian's arc to the complex latitude whose isometric
/// latitude is that of the point plus i times its longitude. Newton, then Gauss-Legendre with 3 nodes on each part.
Complex definition(double e2, double lat, double lon)
{
    const double e = std::sqrt(e2);
    const auto isometric = [e](Complex p) { return std::atanh(std::sin(p)) - e * std::atanh(e * std::sin(p)); };
    const Complex want = isometric(lat) + Complex(0, lon);
    Complex p = Complex(lat, lon * std::cos(lat));
    for (int k = 0; k < 20; k++)
    {
        const Complex s = std::sin(p);
        p += (want - isometric(p)) * std::cos(p) * (1.0 - e2 * s * s) / (1 - e2);
    }
    const auto radius = [e2](Complex x)
    {
        const Complex w2 = 1.0 - e2 * std::sin(x) * std::sin(x);
        return RADIUS_M * (1 - e2) / (w2 * std::sqrt(w2));
    };
    const double node = std::sqrt(0.6);
    Complex sum = 0;
    for (int part = 0; part < PARTS; part++)
    {
        const Complex half = p / (2.0 * PARTS);
        const Complex centre = half * (2.0 * part + 1);
        sum +=
            half * (5.0 * (radius(centre - node * half) + radius(centre + node * half)) + 8.0 * radius(centre)) / 9.0;
    }
    return sum;
}

ins_tm_t projection(double f)
{
    const ins_ellipsoid_t ellipsoid = {RADIUS_M, static_cast<ins_real>(f), static_cast<ins_real>(f * (2 - f))};
    ins_tm_t tm;
    EXPECT_EQ(ins_tm_init(&tm, &ellipsoid, 0, 1, 0, 0), INS_OK);
    return tm;
}

struct Errors
{
    double forward_e = 0, forward_n = 0, inverse_lat = 0, inverse_lon = 0;
};

/// Of the thesis's series on a sphere, where only the powers of the longitude are cut off.
Errors thesis_errors(double dlon)
{
    const double f = 1e-12;
    const ins_tm_t tm = projection(f);
    Errors worst;
    for (const double lat : {20.0, 35.0, 50.0})
    {
        const Complex truth = definition(f * (2 - f), lat * RAD, dlon);
        const double want[2] = {truth.imag(), truth.real()};
        double en[2];
        double back[2];
        EXPECT_EQ(ins_tm_thesis_forward(&tm, lat * RAD, dlon, en), INS_OK);
        EXPECT_EQ(ins_tm_thesis_inverse(&tm, want, back), INS_OK);
        worst.forward_e = larger(worst.forward_e, std::fabs(en[0] - want[0]));
        worst.forward_n = larger(worst.forward_n, std::fabs(en[1] - want[1]));
        worst.inverse_lat = larger(worst.inverse_lat, std::fabs(back[0] - lat * RAD));
        worst.inverse_lon = larger(worst.inverse_lon, std::fabs(back[1] - dlon));
    }
    return worst;
}
} // namespace

TEST(projection, krueger_is_the_definition)
{
    // The flattest ellipsoid that is taken shows what WGS-84 hides: its sixth power is 64 times larger.
    for (const double f : {1 / 298.257223563, 1 / 150.0})
    {
        const ins_tm_t tm = projection(f);
        Worst forward;
        Worst inverse;
        for (int lat = -75; lat <= 75; lat += 15)
        {
            for (const double dlon : {-9.9, -4.0, 0.7, 3.0, 8.0})
            {
                const Complex truth = definition(f * (2 - f), lat * RAD, dlon * RAD);
                const double want[2] = {truth.imag(), truth.real()};
                double en[2];
                double back[2];
                ASSERT_EQ(ins_tm_forward(&tm, lat * RAD, dlon * RAD, en, nullptr), INS_OK);
                ASSERT_EQ(ins_tm_inverse(&tm, want, back), INS_OK);
                const std::string place = std::to_string(lat) + ", " + std::to_string(dlon);
                forward.take(en[0], want[0], 1, place + " east");
                forward.take(en[1], want[1], 1, place + " north");
                inverse.take(back[0], lat * RAD, 1, place + " latitude");
                inverse.take(back[1], dlon * RAD, 1 / std::cos(lat * RAD), place + " longitude");
            }
        }
        expect_within(forward, 8e-9, "forward [m]");
        expect_within(inverse, 2e-15, "inverse [rad]");
    }
}

TEST(projection, orders_of_the_thesis_series)
{
    const double wide = 9 * RAD;
    const Errors large = thesis_errors(wide);
    const Errors small = thesis_errors(wide / 2);
    std::printf("[ figure   ] sphere, 9 degrees: %.1e m east, %.1e m north; %.1e rad latitude, %.1e rad longitude\n",
                large.forward_e, large.forward_n, large.inverse_lat, large.inverse_lon);
    // What is cut off: the 9th power in easting, the 10th in northing; inverse the 8th in latitude, the 7th in longitude.
    EXPECT_NEAR(std::log2(large.forward_e / small.forward_e), 9, 0.2);
    EXPECT_NEAR(std::log2(large.forward_n / small.forward_n), 10, 0.3);
    EXPECT_NEAR(std::log2(large.inverse_lat / small.inverse_lat), 8, 0.2);
    EXPECT_NEAR(std::log2(large.inverse_lon / small.inverse_lon), 7, 0.2);
}
