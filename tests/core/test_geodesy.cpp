/// \file   test_geodesy.cpp
/// \brief  Geodetic, ECEF, local and TM2 coordinates against the reference file, at the poles, and out of range. Units: rad, m.
/// SPDX-License-Identifier: MIT
#include "core_test.h"
#include <limits>
using namespace core_test;

namespace
{
const double RAD = PI / 180;
// Double: the tolerances of the reference file. Float: steps of the type, 0.5 m in 6e6 m (2 m in 2.5e7 m), 1.2e-7 in 2 rad.
const double TOL_ECEF_M = INS_TOL(1e-8, 6.0);
const double TOL_ANGLE_RAD = INS_TOL(1e-13, 5e-7);
const double TOL_TM_M = INS_TOL(1e-6, 2.0);
const double TOL_THESIS_INVERSE_RAD = INS_TOL(1e-4 / 6.4e6, 5e-7);
const double TOL_TM_RAD = INS_TOL(1e-13, 5e-7);
const double TOL_CONVERGENCE_RAD = INS_TOL(5e-8, 3e-7); // the file's is a difference quotient
const ins_real NOT_A_NUMBER = std::numeric_limits<ins_real>::quiet_NaN();
const ins_real INFINITE = std::numeric_limits<ins_real>::infinity();

Vec llh_of(const json& p)
{
    return {p["lat_deg"].get<double>() * RAD, p["lon_deg"].get<double>() * RAD, p["h"].get<double>()};
}

/// Of an angle, times the radius at which it is taken: the distance on the ground, in units of the Earth's radius.
double longitude_error(double got, double want, double lat)
{
    return std::remainder(got - want, 2 * PI) * std::cos(lat);
}

struct Grid
{
    ins_tm_t tm;
    explicit Grid(int zone) { EXPECT_EQ(ins_tm_init_twd97(&tm, zone), INS_OK); }
};
} // namespace

TEST(vector_geodesy, ecef_both_ways)
{
    const json file = load("geodesy.json");
    Worst there;
    Worst angle;
    Worst height;
    for (const char* list : {"points", "ecef_global"})
    {
        for (const json& p : file[list])
        {
            const Vec want = {p["X"], p["Y"], p["Z"]};
            const Vec llh = llh_of(p);
            ins_real xyz[3];
            ASSERT_EQ(ins_geodesy_to_ecef(&ins_grs80, real(llh).data(), xyz), INS_OK);
            for (size_t i = 0; i < 3; i++)
            {
                there.take(vec(xyz)[i], want[i], 1, list);
            }
            ins_real back[3];
            ASSERT_EQ(ins_geodesy_from_ecef(&ins_grs80, real(want).data(), back), INS_OK);
            angle.take(vec(back)[0], llh[0], 1, list);
            angle.take(longitude_error(vec(back)[1], llh[1], llh[0]), 0, 1, list);
            height.take(vec(back)[2], llh[2], 1, list);
        }
    }
    expect_within(there, TOL_ECEF_M, "to ECEF [m]");
    expect_within(angle, TOL_ANGLE_RAD, "from ECEF [rad]");
    expect_within(height, TOL_ECEF_M, "from ECEF, height [m]");
}

TEST(vector_geodesy, tm2_of_twd97)
{
    const json file = load("geodesy.json");
    Worst forward;
    Worst inverse;
    Worst convergence;
    Worst thesis_forward;
    Worst thesis_inverse;
    for (const json& p : file["points"])
    {
        const Vec llh = llh_of(p);
        const Grid grid(p["epsg"] == 3826 ? 121 : 119);
        const auto in = real(llh);
        const Vec want = {p["E"], p["N"], 0};
        const auto want_real = real(want);
        ins_real en[2];
        ins_real gamma;
        ins_real ll[2];
        ASSERT_EQ(ins_tm_forward(&grid.tm, in[0], in[1], en, &gamma), INS_OK);
        convergence.take(static_cast<double>(gamma), p["convergence_deg"].get<double>() * RAD, 1, "forward");
        ASSERT_EQ(ins_tm_inverse(&grid.tm, want_real.data(), ll), INS_OK);
        ins_real thesis_en[2];
        ins_real thesis_ll[2];
        ASSERT_EQ(ins_tm_thesis_forward(&grid.tm, in[0], in[1], thesis_en), INS_OK);
        ASSERT_EQ(ins_tm_thesis_inverse(&grid.tm, want_real.data(), thesis_ll), INS_OK);
        for (size_t i = 0; i < 2; i++)
        {
            forward.take(static_cast<double>(en[i]), want[i], 1, i ? "N" : "E");
            inverse.take(static_cast<double>(ll[i]), llh[i], 1, i ? "lon" : "lat");
            thesis_forward.take(static_cast<double>(thesis_en[i]), want[i], 1, i ? "N" : "E");
            thesis_inverse.take(static_cast<double>(thesis_ll[i]), llh[i], 1, i ? "lon" : "lat");
        }
    }
    expect_within(forward, TOL_TM_M, "Krueger forward [m]");
    expect_within(inverse, TOL_TM_RAD, "Krueger inverse [rad]");
    expect_within(convergence, TOL_CONVERGENCE_RAD, "convergence [rad]");
    expect_within(thesis_forward, TOL_TM_M, "thesis forward [m]");
    expect_within(thesis_inverse, TOL_THESIS_INVERSE_RAD, "thesis inverse [rad]");
}

TEST(geodesy, ecef_round_trip_everywhere)
{
    Worst worst;
    for (int lat = -90; lat <= 90; lat += 5)
    {
        for (int lon = -180; lon < 180; lon += 30)
        {
            for (const double h : {-1e6, -1e4, 0.0, 1e4, 2e7})
            {
                const Vec llh = {lat * RAD * (1 - 1e-9), lon * RAD * (1 - 1e-9), h};
                ins_real xyz[3];
                ins_real back[3];
                ASSERT_EQ(ins_geodesy_to_ecef(&ins_wgs84, real(llh).data(), xyz), INS_OK);
                ASSERT_EQ(ins_geodesy_from_ecef(&ins_wgs84, xyz, back), INS_OK);
                const double r = 6.4e6 + h;
                worst.take(r * (vec(back)[0] - llh[0]), 0, 1, "lat " + std::to_string(lat));
                worst.take(r * longitude_error(vec(back)[1], llh[1], llh[0]), 0, 1, "lon " + std::to_string(lon));
                worst.take(vec(back)[2], h, 1, "h " + std::to_string(h));
            }
        }
    }
    expect_within(worst, INS_TOL(4e-8, 6.0), "ECEF round trip [m]");
}

TEST(geodesy, poles_and_the_axis)
{
    for (const double sign : {1.0, -1.0})
    {
        const double b = 6378137.0 * (1 - 1 / 298.257223563);
        const Vec pole = {0, 0, sign * (b + 100)};
        ins_real llh[3];
        ASSERT_EQ(ins_geodesy_from_ecef(&ins_wgs84, real(pole).data(), llh), INS_OK);
        EXPECT_NEAR(static_cast<double>(llh[0]), sign * PI / 2, INS_TOL(1e-15, 1e-7));
        EXPECT_EQ(llh[1], 0);
        EXPECT_NEAR(static_cast<double>(llh[2]), 100, INS_TOL(2e-9, 0.6));
        // A millimetre from the axis: the latitude must see it.
        const Vec near = {1e-3, 0, pole[2]};
        ASSERT_EQ(ins_geodesy_from_ecef(&ins_wgs84, real(near).data(), llh), INS_OK);
        const double from_pole = PI / 2 - std::fabs(static_cast<double>(llh[0]));
        EXPECT_NEAR(from_pole, 1e-3 / 6.4e6, INS_TOL(2e-12, 1e-7));
    }
}

TEST(geodesy, local_frames)
{
    const Vec origin = {25 * RAD, 121.5 * RAD, 100};
    ins_local_t local;
    ASSERT_EQ(ins_local_init(&local, &ins_wgs84, real(origin).data()), INS_OK);
    // A point a little north, east and up of the origin, by the radii of curvature.
    const double s = std::sin(origin[0]);
    const double w = std::sqrt(1 - 6.69437999014131699e-3 * s * s);
    const double meridian = 6378137 * (1 - 6.69437999014131699e-3) / (w * w * w);
    const double normal = 6378137 / w;
    const double d = 1e-4;
    const Vec there = {origin[0] + d, origin[1] - d, origin[2] + 50};
    ins_real xyz[3];
    ins_real ned[3];
    ASSERT_EQ(ins_geodesy_to_ecef(&ins_wgs84, real(there).data(), xyz), INS_OK);
    ins_local_from_ecef(&local, xyz, ned);
    // Second order of 640 m: 0.03 m horizontally, and 0.06 m below the tangent plane.
    const double second_order_m = 0.1;
    EXPECT_NEAR(static_cast<double>(ned[0]), d * (meridian + 100), second_order_m + TOL_ECEF_M);
    EXPECT_NEAR(static_cast<double>(ned[1]), -d * (normal + 100) * std::cos(origin[0]), second_order_m + TOL_ECEF_M);
    EXPECT_NEAR(static_cast<double>(ned[2]), -50, second_order_m + TOL_ECEF_M);
    ins_real back[3];
    ins_local_to_ecef(&local, ned, back);
    ins_real enu[3];
    ins_local_swap(ned, enu);
    EXPECT_EQ(enu[0], ned[1]);
    EXPECT_EQ(enu[1], ned[0]);
    EXPECT_EQ(enu[2], -ned[2]);
    ins_local_swap(enu, enu);
    for (size_t i = 0; i < 3; i++)
    {
        EXPECT_NEAR(static_cast<double>(back[i]), static_cast<double>(xyz[i]), INS_TOL(2e-9, 0.6));
        EXPECT_EQ(enu[i], ned[i]);
    }
}

TEST(geodesy, tm_round_trip_to_the_edge)
{
    Worst worst;
    for (const double lon0 : {121.0, 119.0, -179.0})
    {
        ins_tm_t tm;
        const ins_real meridian = static_cast<ins_real>(lon0 * RAD);
        ASSERT_EQ(ins_tm_init(&tm, &ins_wgs84, meridian, INS_C(0.9996), 500000, 10000), INS_OK);
        for (int lat = -90; lat <= 90; lat += 6)
        {
            for (const double dlon : {-10.0, -3.0, -1.0, 0.0, 0.5, 2.0, 9.99})
            {
                double lon = lon0 + dlon * (1 - 1e-6);
                lon = lon < -180 ? lon + 360 : lon;
                const Vec want = {lat * RAD * (1 - 1e-7), lon * RAD, 0};
                const auto in = real(want);
                ins_real en[2];
                ins_real back[2];
                ASSERT_EQ(ins_tm_forward(&tm, in[0], in[1], en, nullptr), INS_OK);
                ASSERT_EQ(ins_tm_inverse(&tm, en, back), INS_OK) << lat << " " << dlon;
                const std::string place = std::to_string(lat) + ", " + std::to_string(dlon);
                worst.take(static_cast<double>(back[0]), want[0], 1, place);
                worst.take(longitude_error(static_cast<double>(back[1]), want[1], want[0]), 0, 1, place);
            }
        }
    }
    expect_within(worst, INS_TOL(3e-15, 6e-7), "TM round trip [rad]");
}

#ifndef INS_REAL_FLOAT
TEST(geodesy, convergence_is_the_direction_of_the_meridian)
{
    const Grid grid(121);
    const double step = 1e-5;
    for (int lat = -80; lat <= 80; lat += 20)
    {
        for (const double dlon : {-9.0, -1.0, 0.3, 5.0})
        {
            double gamma;
            double north[2];
            double south[2];
            const double lon = (121 + dlon) * RAD;
            ASSERT_EQ(ins_tm_forward(&grid.tm, lat * RAD, lon, south, &gamma), INS_OK);
            ASSERT_EQ(ins_tm_forward(&grid.tm, lat * RAD + step, lon, north, nullptr), INS_OK);
            ASSERT_EQ(ins_tm_forward(&grid.tm, lat * RAD - step, lon, south, nullptr), INS_OK);
            // The meridian, seen on the grid, leans by -gamma.
            EXPECT_NEAR(gamma, -std::atan2(north[0] - south[0], north[1] - south[1]), 3e-10) << lat << " " << dlon;
        }
    }
}
#endif

TEST(geodesy, zones)
{
    EXPECT_EQ(ins_twd97_zone(static_cast<ins_real>(121.5 * RAD)), 121);
    EXPECT_EQ(ins_twd97_zone(static_cast<ins_real>(120.01 * RAD)), 121);
    EXPECT_EQ(ins_twd97_zone(static_cast<ins_real>(119.6 * RAD)), 119); // Penghu
    EXPECT_EQ(ins_twd97_zone(static_cast<ins_real>(118.4 * RAD)), 119); // Kinmen
    EXPECT_EQ(ins_twd97_zone(static_cast<ins_real>(117.9 * RAD)), 0);
    EXPECT_EQ(ins_twd97_zone(static_cast<ins_real>(123.1 * RAD)), 0);
    EXPECT_EQ(ins_twd97_zone(NOT_A_NUMBER), 0);
}

TEST(geodesy, refuses_what_is_out_of_range)
{
    ins_real out[3] = {7, 7, 7};
    const ins_real good[3] = {INS_C(0.4), 2, 100};
    for (size_t i = 0; i < 3; i++)
    {
        for (const ins_real bad : {NOT_A_NUMBER, INFINITE, -INFINITE})
        {
            ins_real llh[3] = {good[0], good[1], good[2]};
            llh[i] = bad;
            EXPECT_EQ(ins_geodesy_to_ecef(&ins_wgs84, llh, out), INS_E_RANGE);
            ins_real xyz[3] = {-3000000, 5000000, 2700000};
            xyz[i] = bad;
            EXPECT_EQ(ins_geodesy_from_ecef(&ins_wgs84, xyz, out), INS_E_RANGE);
            ins_local_t local;
            EXPECT_EQ(ins_local_init(&local, &ins_wgs84, llh), INS_E_RANGE);
        }
    }
    const ins_real over_the_pole[3] = {INS_C(1.58), 0, 0};
    const ins_real round_again[3] = {0, INS_C(6.3), 0};
    const ins_real centre[3] = {1000, 1000, 1000};
    EXPECT_EQ(ins_geodesy_to_ecef(&ins_wgs84, over_the_pole, out), INS_E_RANGE);
    EXPECT_EQ(ins_geodesy_to_ecef(&ins_wgs84, round_again, out), INS_E_RANGE);
    EXPECT_EQ(ins_geodesy_from_ecef(&ins_wgs84, centre, out), INS_E_RANGE);

    ins_tm_t tm;
    EXPECT_EQ(ins_tm_init_twd97(&tm, 120), INS_E_RANGE);
    const ins_ellipsoid_t flat = {6378137, INS_C(0.01), INS_C(0.0199)};
    EXPECT_EQ(ins_tm_init(&tm, &flat, 0, 1, 0, 0), INS_E_RANGE);
    EXPECT_EQ(ins_tm_init(&tm, &ins_wgs84, 4, 1, 0, 0), INS_E_RANGE);
    const ins_ellipsoid_t sphere = {6378137, 0, 0};
    EXPECT_EQ(ins_tm_init(&tm, &sphere, 0, 1, 0, 0), INS_E_RANGE);
    EXPECT_EQ(ins_tm_init(&tm, &ins_wgs84, 0, 0, 0, 0), INS_E_RANGE);
    EXPECT_EQ(ins_tm_init(&tm, &ins_wgs84, 0, 3, 0, 0), INS_E_RANGE);
    EXPECT_EQ(ins_tm_init(&tm, &ins_wgs84, 0, 1, NOT_A_NUMBER, 0), INS_E_RANGE);
    ASSERT_EQ(ins_tm_init_twd97(&tm, 121), INS_OK);
    const ins_real lon0 = static_cast<ins_real>(121 * RAD);
    for (const ins_real bad : {NOT_A_NUMBER, INFINITE, INS_C(1.58), INS_C(-1.58)})
    {
        EXPECT_EQ(ins_tm_forward(&tm, bad, lon0, out, nullptr), INS_E_RANGE);
        EXPECT_EQ(ins_tm_thesis_forward(&tm, bad, lon0, out), INS_E_RANGE);
    }
    for (const ins_real bad : {NOT_A_NUMBER, INFINITE, lon0 + INS_C(0.175), lon0 - INS_C(0.175)})
    {
        EXPECT_EQ(ins_tm_forward(&tm, INS_C(0.4), bad, out, nullptr), INS_E_RANGE);
        EXPECT_EQ(ins_tm_thesis_forward(&tm, INS_C(0.4), bad, out), INS_E_RANGE);
    }
    const ins_real far[4][2] = {
        {NOT_A_NUMBER, 2700000}, {250000, NOT_A_NUMBER}, {2000000, 2700000}, {250000, 10100000}};
    for (const auto& en : far)
    {
        EXPECT_EQ(ins_tm_inverse(&tm, en, out), INS_E_RANGE);
        EXPECT_EQ(ins_tm_thesis_inverse(&tm, en, out), INS_E_RANGE);
    }
    EXPECT_EQ(out[0], 7);
    EXPECT_EQ(out[1], 7);
    EXPECT_EQ(out[2], 7);
}
