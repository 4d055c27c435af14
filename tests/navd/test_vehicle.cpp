// The vehicle's navigator: sentences in, solutions out.
// SPDX-License-Identifier: MIT
#include "ins_nav/vehicle.h"
#include "vehicle_drive.hpp"
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace
{
using vehicle_drive::board_sentence;
using vehicle_drive::Drive;
using vehicle_drive::sentence;

class Vehicle : public testing::Test
{
  protected:
    void SetUp() override { start(INS_VEHICLE_OURS); }
    void start(int filter)
    {
        ins_vehicle_config_t cfg;
        ins_vehicle_config_default(&cfg);
        cfg.filter = filter;
        cfg.metres_per_count = vehicle_drive::METRES_PER_COUNT;
        cfg.car.tau_fix = 0; // the drive's fixes are white
        cfg.car.sigma_bias = 0.01;
        ASSERT_EQ(ins_vehicle_init(&v, &cfg), INS_OK);
    }
    /// \return solutions that came of it; the last one is in `last`
    int feed(const std::string& text, unsigned port = 0)
    {
        int count = 0;
        for (const char c : text)
        {
            count += ins_vehicle_octet(&v, port, static_cast<ins_octet_t>(c), &last);
        }
        return count;
    }
    void drive(Drive& d, double until, bool visible, bool with_course = false)
    {
        while (d.t < until - 0.05)
        {
            feed(d.step(visible, with_course));
        }
    }
    double error(const Drive& d) const
    {
        return std::hypot((last.lat_lon_rad[0] - d.latitude()) * vehicle_drive::RADIUS_N,
                          (last.lat_lon_rad[1] - d.longitude()) * vehicle_drive::RADIUS_E *
                              std::cos(vehicle_drive::LATITUDE));
    }

    ins_vehicle_t v;
    ins_nav_solution_t last = {};
};
} // namespace

TEST_F(Vehicle, FindsItsHeadingAndHoldsItThroughAMinuteWithoutFixes)
{
    Drive d(1);
    drive(d, 2, true);
    EXPECT_EQ(ins_vehicle_source(&v), INS_GPS_DR_ALIGN);
    EXPECT_EQ(last.status, INS_NAV_BLOCK_POSITION);
    drive(d, 120, true);
    EXPECT_EQ(ins_vehicle_source(&v), INS_GPS_DR_GPS);
    EXPECT_EQ(last.status, INS_NAV_BLOCK_POSITION | INS_NAV_BLOCK_ALIGNED | INS_NAV_BLOCK_FILTER);
    EXPECT_LT(error(d), 4);
    EXPECT_NEAR(std::remainder(last.euler_rad[2] - d.heading, 2 * vehicle_drive::PI), 0, 0.03);
    EXPECT_NEAR(last.v_en_m_s[0], 10 * std::sin(d.heading), 0.6);
    EXPECT_NEAR(last.t_s, 119.9, 1e-6);
    EXPECT_EQ(last.sats, 9u);
    EXPECT_LT(last.fix_age_s, 0.05);
    EXPECT_NEAR(ins_vehicle_sigma(&v), 1, 0.9);
    drive(d, 180, false);
    EXPECT_EQ(ins_vehicle_source(&v), INS_GPS_DR_DR);
    EXPECT_EQ(last.status, INS_NAV_BLOCK_POSITION | INS_NAV_BLOCK_ALIGNED);
    EXPECT_LT(error(d), 12);
    EXPECT_NEAR(last.fix_age_s, 25.5, 1e-9);
    EXPECT_EQ(v.counts.no_fixes, 60u);
    drive(d, 190, true);
    EXPECT_EQ(ins_vehicle_source(&v), INS_GPS_DR_GPS);
    EXPECT_LT(error(d), 5);
}

TEST_F(Vehicle, ACourseGivesTheHeadingAtOnce)
{
    Drive d(2);
    drive(d, 3, true, true);
    EXPECT_NE(last.status & INS_NAV_BLOCK_ALIGNED, 0u);
    EXPECT_NEAR(std::remainder(last.euler_rad[2] - d.heading, 2 * vehicle_drive::PI), 0, 0.1);
}

TEST_F(Vehicle, ThePapersPairIsThereToCompare)
{
    for (const int filter : {INS_VEHICLE_PRINTED, INS_VEHICLE_CORRECTED})
    {
        start(filter);
        Drive d(3);
        drive(d, 60, true);
        EXPECT_EQ(ins_vehicle_source(&v) == INS_GPS_DR_GPS, filter == INS_VEHICLE_PRINTED);
        EXPECT_LT(error(d), 60);
        drive(d, 70, false);
        EXPECT_EQ(ins_vehicle_source(&v), INS_GPS_DR_DR);
        EXPECT_LT(error(d), 100);
    }
}

TEST_F(Vehicle, TwoLinesGiveWhatOneGives)
{
    Drive d(4);
    Drive same(4);
    drive(d, 30, true);
    const ins_nav_solution_t one = last;
    start(INS_VEHICLE_OURS);
    while (same.t < 29.95)
    {
        const std::string text = same.step(true);
        const size_t board = text.find("$PINSD");
        feed(text.substr(0, board), 0);
        EXPECT_EQ(feed(text.substr(board), 1), same.tick > 1);
    }
    EXPECT_EQ(last.lat_lon_rad[0], one.lat_lon_rad[0]);
    EXPECT_EQ(last.euler_rad[2], one.euler_rad[2]);
}

TEST_F(Vehicle, WhatIsWrongIsCountedAndSurvived)
{
    Drive d(5);
    drive(d, 60, true);
    const uint64_t samples = v.counts.samples;
    EXPECT_EQ(feed("$PINSD,60100,15025,2048*00\r\n"), 0) << "a wrong checksum";
    EXPECT_EQ(feed("$PINSD,60100,15025\r\n"), 0) << "cut";
    EXPECT_EQ(v.counts.corrupt, 2u);
    for (const char* body : {"PINSD,60100,15025,4096", "PINSD,60100,15025,", "PINSD,60100,15025", "PINSD,-1,15025,2048",
                             "PINSD,60100,99999999999,2048", "PINSD,60100,15025,2048,1"})
    {
        EXPECT_EQ(feed(sentence(body)), 0) << body;
    }
    EXPECT_EQ(v.counts.invalid, 6u);
    EXPECT_EQ(feed("$PINSD," + std::string(200, '1') + "\r\n\xff\x01$"), 0) << "noise";
    EXPECT_EQ(feed(board_sentence(60000, 15000, 2048)), 0) << "the same clock again";
    EXPECT_EQ(v.counts.repeated, 1u);
    EXPECT_EQ(v.counts.samples, samples);
    const auto code = static_cast<uint32_t>(std::lround(0.005 / vehicle_drive::LSB + 2048));
    EXPECT_EQ(feed(board_sentence(60500, 15125, code)), 1);
    EXPECT_EQ(v.counts.gaps, 1u);
    EXPECT_NE(last.status & INS_NAV_BLOCK_GAP, 0u);
    EXPECT_EQ(feed(board_sentence(100, 25, code)), 0) << "the board has started again";
    EXPECT_EQ(v.counts.restarts, 1u);
    const double before[2] = {last.en_m[0], last.en_m[1]};
    EXPECT_EQ(feed(board_sentence(200, 50, code)), 1);
    EXPECT_NEAR(std::hypot(last.en_m[0] - before[0], last.en_m[1] - before[1]), 1, 0.1) << "counts start anew too";
    EXPECT_EQ(feed(board_sentence(300, 50 - 25, code)), 1) << "it rolls back";
    EXPECT_NEAR(std::hypot(last.en_m[0] - before[0], last.en_m[1] - before[1]), 0, 0.1);
}

TEST_F(Vehicle, AWildFixIsRefused)
{
    Drive d(6);
    drive(d, 60, true);
    feed(sentence("GPGGA,123457.00,5330.0000000,N,01322.5000000,W,1,09,0.60,40.0,M,0.0,M,,")); // 111 km away
    feed(sentence("GPGGA,123457.00,9930.0000000,N,01322.5000000,W,1,09,0.60,40.0,M,0.0,M,,")); // nowhere
    feed(sentence("GPGGA,123457.00,5330.0000000,N,01322.5000000,W,1,09,0.60,40.0,M,0.0,M,,"));
    for (int k = 1; k <= 10; k++)
    {
        feed(board_sentence(60000 + 100 * static_cast<uint32_t>(k), 15000 + 25 * static_cast<uint32_t>(k), 2048));
    }
    EXPECT_EQ(v.counts.refused, 1u);
    EXPECT_EQ(ins_vehicle_source(&v), INS_GPS_DR_DR);
    EXPECT_LT(error(d), 20) << "ten metres on";
    EXPECT_EQ(v.nmea[0].malformed, 1u);
}

TEST_F(Vehicle, RefusesAConfigurationThatCannotBeAndSaysWhy)
{
    using Change = void (*)(ins_vehicle_config_t&);
    const std::vector<std::pair<Change, const char*>> cases = {
        {[](ins_vehicle_config_t& c) { c.filter = 7; }, "filter"},
        {[](ins_vehicle_config_t& c) { c.metres_per_count = 0; }, "metres per count"},
        {[](ins_vehicle_config_t& c) { c.metres_per_count = std::numeric_limits<double>::quiet_NaN(); },
         "metres per count"},
        {[](ins_vehicle_config_t& c) { c.lsb_rad_s = 0; }, "yaw rate per code"},
        {[](ins_vehicle_config_t& c) { c.null_code = 5000; }, "code at rest"},
        {[](ins_vehicle_config_t& c) { c.uere_m = 0; }, "deviation of a fix"},
        {[](ins_vehicle_config_t& c) { c.latency_s = -1; }, "latency"},
        {[](ins_vehicle_config_t& c) { c.car.tau_fix = -1; }, "noise"},
    };
    for (const auto& [change, word] : cases)
    {
        ins_vehicle_config_t cfg;
        ins_vehicle_config_default(&cfg);
        EXPECT_EQ(ins_vehicle_config_problem(&cfg), nullptr);
        change(cfg);
        ASSERT_NE(ins_vehicle_config_problem(&cfg), nullptr) << word;
        EXPECT_NE(std::string(ins_vehicle_config_problem(&cfg)).find(word), std::string::npos) << word;
        EXPECT_EQ(ins_vehicle_init(&v, &cfg), INS_E_RANGE);
    }
}

TEST_F(Vehicle, ItsCovarianceIsThatOfTheFilterInNorthEastDown)
{
    Drive d(3);
    ins_navigation_t n;
    ins_vehicle_navigation(&v, &last, 5, &n);
    EXPECT_EQ(n.valid, 0U) << "nothing is known yet";
    drive(d, 60, true, true);
    ins_vehicle_navigation(&v, &last, 5, &n);
    EXPECT_EQ(n.valid, static_cast<uint32_t>(INS_NAVIGATION_ATTITUDE | INS_NAVIGATION_VELOCITY |
                                             INS_NAVIGATION_POSITION | INS_NAVIGATION_COVARIANCE));
    EXPECT_EQ(n.time_ns, 5);
    ins_real x[6];
    ins_real P[36];
    ASSERT_EQ(ins_gps_dr_state(&v.ours, x, P), INS_OK);
    const auto at = [&](int i, int j) { return n.P[INS_NAVIGATION_P * i + j]; };
    EXPECT_DOUBLE_EQ(at(6, 6), P[7]);
    EXPECT_DOUBLE_EQ(at(7, 7), P[0]);
    EXPECT_DOUBLE_EQ(at(6, 7), P[1]);
    EXPECT_DOUBLE_EQ(at(2, 2), P[14]);
    EXPECT_DOUBLE_EQ(at(7, 2), P[2]);
    // Along and across the way: of the speed, and of the heading times the speed.
    const double s = std::sin(x[2]);
    const double c = std::cos(x[2]);
    const double along = c * c * at(3, 3) + 2 * s * c * at(3, 4) + s * s * at(4, 4);
    const double across = s * s * at(3, 3) - 2 * s * c * at(3, 4) + c * c * at(4, 4);
    EXPECT_NEAR(along, P[21], 1e-12 + 1e-9 * P[21]);
    EXPECT_NEAR(across, x[3] * x[3] * P[14], 1e-12 + 1e-9 * across);
    for (int i = 0; i < INS_NAVIGATION_P; i++)
    {
        for (int j = 0; j < INS_NAVIGATION_P; j++)
        {
            EXPECT_DOUBLE_EQ(at(i, j), at(j, i));
        }
        EXPECT_EQ(at(8, i), 0.0) << "the height is not known";
    }
}
