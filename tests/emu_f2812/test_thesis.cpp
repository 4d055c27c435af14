/// \file   test_thesis.cpp
/// \brief  The thesis's firmware without its DSP: calibration, attitude, position, reports, from samples made here. Units: rad, m, s.
/// SPDX-License-Identifier: MIT
extern "C" {
#include "firmware/thesis/navigate.h"
#include "firmware/thesis/report.h"
}
#include "ins/quat.h"
#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace
{
constexpr double DEG = 3.14159265358979323846 / 180;
constexpr double K_DEG_S[] = {0.2087, 0.2099, 0.1993};
constexpr double G_CODES = 992.727; ///< of 1 g
constexpr double NOISE_CODES = 1;   ///< of a gyro: 0.2 deg/s
constexpr int STATIC_PACKETS = 360; ///< 60 s
constexpr uint32_t LAT = 24590000;  ///< 24 deg 59.0000': the example of the thesis's figure 4.5
constexpr uint32_t LON = 120123456; ///< 120 deg 12.3456'
constexpr double EASTING = 169816.943, NORTHING = 2764166.270; ///< its TWD97 TM2, by ins_tm_forward() in double

/// A GIMU that is what the thesis says, but for its nulls.
struct Sensor
{
    std::array<double, 6> null = {2047.6, 2046.3, 2047.8, 2047, 2047, 2047};
    std::mt19937_64 random{2009};
    uint32_t time_ms = 500;
    double sixth = 0;

    ins_gimu_packet_t sample(const std::array<double, 3>& rate_deg_s, const std::array<double, 3>& f_g = {0, 0, -1})
    {
        std::normal_distribution<double> noise(0, NOISE_CODES);
        ins_gimu_packet_t p = {};
        for (size_t i = 0; i < 3; i++)
        {
            p.raw[i] = static_cast<uint16_t>(std::lround(null[i] + rate_deg_s[i] / K_DEG_S[i] + noise(random)));
            p.raw[3 + i] = static_cast<uint16_t>(std::lround(null[3 + i] + f_g[i] * G_CODES + noise(random)));
        }
        sixth += 1000.0 / 6;
        time_ms = 500 + static_cast<uint32_t>(std::lround(sixth));
        return p;
    }
};

struct Rig
{
    explicit Rig(null_mode_t mode, bool filter = true)
    {
        navigation.filter = filter;
        navigation_begin(&navigation, mode);
    }
    void calibrate()
    {
        for (int i = 0; i < THESIS_CALIBRATION_PACKETS; i++)
        {
            still();
        }
        ASSERT_EQ(navigation.aligned, 1);
    }
    void still() { turn({0, 0, 0}); }
    void turn(const std::array<double, 3>& rate_deg_s)
    {
        const ins_gimu_packet_t p = sensor.sample(rate_deg_s);
        navigation_packet(&navigation, &p, INS_GIMU_T1, sensor.time_ms);
    }
    /// A packet of type 2, north and east of the example in metres.
    void fix(double east = 0, double north = 0, unsigned sats = 8, const std::array<double, 3>& f_g = {0, 0, -1})
    {
        ins_gimu_packet_t p = sensor.sample({0, 0, 0}, f_g);
        p.sats = static_cast<uint_least8_t>(sats);
        p.has_position = 1;
        p.lat_e7 = ins_gimu_e7(LAT) + static_cast<int32_t>(std::lround(north / 110777.0 * 1e7));
        p.lon_e7 = ins_gimu_e7(LON) + static_cast<int32_t>(std::lround(east / 100949.0 * 1e7));
        navigation_packet(&navigation, &p, INS_GIMU_T2, sensor.time_ms);
    }
    ins_nav_block_t block() const
    {
        ins_nav_block_t b;
        navigation_block(&navigation, &b);
        return b;
    }
    double largest_angle_deg() const
    {
        double worst = 0;
        for (const float a : navigation.angle)
        {
            worst = std::max(worst, std::fabs(static_cast<double>(a)) / DEG);
        }
        return worst;
    }

    Sensor sensor;
    navigation_t navigation = {};
};

double drift_deg(null_mode_t mode)
{
    Rig rig(mode);
    rig.calibrate();
    for (int i = 0; i < STATIC_PACKETS; i++)
    {
        rig.still();
    }
    return rig.largest_angle_deg();
}
} // namespace

TEST(thesis_navigation, a_fractional_null_drifts_least)
{
    const double none = drift_deg(NULL_NONE), integer = drift_deg(NULL_INTEGER), fraction = drift_deg(NULL_FRACTION);
    std::printf("[ figure   ] 60 s at rest: none %.2f, integer %.2f, fraction %.2f deg\n", none, integer, fraction);
    EXPECT_GT(none, 8);
    EXPECT_LT(none, 11);
    EXPECT_GT(integer, fraction);
    EXPECT_LE(integer, 0.5 * K_DEG_S[1] * 60 + 2);
    EXPECT_LT(fraction, 3 * NOISE_CODES * K_DEG_S[1] * 60 / std::sqrt(THESIS_CALIBRATION_PACKETS) + 1);
}

TEST(thesis_navigation, the_block_says_how_the_nulls_were_found)
{
    for (const auto& [mode, bits] : std::vector<std::pair<null_mode_t, unsigned>>{
             {NULL_NONE, 0}, {NULL_INTEGER, INS_NAV_BLOCK_INTEGER}, {NULL_FRACTION, INS_NAV_BLOCK_FRACTION}})
    {
        Rig rig(mode);
        EXPECT_EQ(rig.block().status & INS_NAV_BLOCK_ALIGNED, 0u);
        rig.calibrate();
        EXPECT_EQ(rig.block().status & (INS_NAV_BLOCK_INTEGER | INS_NAV_BLOCK_FRACTION), bits);
        EXPECT_NE(rig.block().status & INS_NAV_BLOCK_ALIGNED, 0u);
        for (size_t i = 0; i < 6; i++)
        {
            const double null = static_cast<double>(rig.navigation.scale.null[i]);
            const double want = mode == NULL_NONE ? 2047 : rig.sensor.null[i];
            EXPECT_NEAR(null, want, mode == NULL_INTEGER ? 1.0 : 0.5) << "channel " << i;
            EXPECT_TRUE(mode == NULL_FRACTION || null == std::floor(null)) << "channel " << i;
        }
    }
}

// 45 deg/s for 2 s, about each axis, and back: section 4.5.4.
TEST(thesis_navigation, turns_of_90_degrees_and_back)
{
    for (size_t axis = 0; axis < 3; axis++)
    {
        for (const double way : {1.0, -1.0})
        {
            Rig rig(NULL_FRACTION);
            rig.calibrate();
            std::array<double, 3> rate = {0, 0, 0};
            rate[axis] = 45 * way;
            for (int i = 0; i < 12; i++)
            {
                rig.turn(rate);
            }
            EXPECT_NEAR(static_cast<double>(rig.navigation.angle[axis]) / DEG, 90 * way, 1.0) << "axis " << axis;
            const auto& q = rig.navigation.attitude.q_nb;
            EXPECT_NEAR(static_cast<double>(q[0]), std::cos(45 * DEG), 0.01) << "axis " << axis;
            EXPECT_NEAR(static_cast<double>(q[1 + axis]), way * std::sin(45 * DEG), 0.01) << "axis " << axis;
            rate[axis] = -rate[axis];
            for (int i = 0; i < 12; i++)
            {
                rig.turn(rate);
            }
            EXPECT_LT(rig.largest_angle_deg(), 1.5) << "axis " << axis;
        }
    }
}

TEST(thesis_navigation, a_gap_is_bridged_said_and_not_beyond_five_seconds)
{
    Rig rig(NULL_FRACTION);
    rig.calibrate();
    rig.turn({0, 0, 12});
    EXPECT_EQ(rig.block().status & INS_NAV_BLOCK_GAP, 0u);
    (void)rig.sensor.sample({0, 0, 12});
    (void)rig.sensor.sample({0, 0, 12});
    rig.turn({0, 0, 12}); // 2 lost
    EXPECT_NE(rig.block().status & INS_NAV_BLOCK_GAP, 0u);
    EXPECT_NEAR(static_cast<double>(rig.navigation.angle[2]) / DEG, 8, 0.5) << "four sixths of a second at 12 deg/s";
    for (int i = 0; i < THESIS_GAP_PACKETS_MAX; i++)
    {
        (void)rig.sensor.sample({0, 0, 12});
    }
    const float before = rig.navigation.angle[2];
    rig.turn({0, 0, 12});
    EXPECT_EQ(rig.navigation.angle[2], before);
    EXPECT_NE(rig.block().status & INS_NAV_BLOCK_GAP, 0u);
}

TEST(thesis_navigation, the_first_fix_is_the_grids_position)
{
    Rig rig(NULL_FRACTION);
    rig.fix();
    EXPECT_EQ(rig.block().status & INS_NAV_BLOCK_POSITION, 0u) << "not before the alignment";
    EXPECT_EQ(rig.block().fix_age, INS_NAV_BLOCK_OLD);
    rig.calibrate();
    rig.fix(0, 0, THESIS_SATS_MIN - 1);
    EXPECT_EQ(rig.block().status & INS_NAV_BLOCK_POSITION, 0u) << "three satellites";
    rig.fix();
    const ins_nav_block_t b = rig.block();
    EXPECT_NE(b.status & INS_NAV_BLOCK_POSITION, 0u);
    EXPECT_EQ(b.status & INS_NAV_BLOCK_ZONE_119, 0u);
    EXPECT_EQ(b.fix_age, 9) << "it was 0.91 s old when it came";
    EXPECT_NEAR(b.en_cm[0] * 0.01, EASTING, 0.1);
    EXPECT_NEAR(b.en_cm[1] * 0.01, NORTHING, 0.4) << "a float northing has steps of a quarter of a metre";
    rig.still();
    rig.still();
    EXPECT_EQ(rig.block().fix_age, 12) << "two sixths of a second later";
}

TEST(thesis_navigation, dead_reckoning_diverges_and_the_filter_does_not)
{
    double far_dead = 0, far_filter = 0;
    for (const bool filter : {false, true})
    {
        Rig rig(NULL_FRACTION, filter);
        rig.calibrate();
        rig.sensor.null[1] += 0.16; // what is left of a null: 2 deg/min
        rig.fix();
        const ins_nav_block_t first = rig.block();
        for (int s = 0; s < 120; s++)
        {
            for (int i = 0; i < 5; i++)
            {
                rig.still();
            }
            rig.fix();
            const ins_nav_block_t b = rig.block();
            const double off = std::hypot(b.en_cm[0] - first.en_cm[0], b.en_cm[1] - first.en_cm[1]) * 0.01;
            (filter ? far_filter : far_dead) = std::max(filter ? far_filter : far_dead, off);
        }
    }
    std::printf("[ figure   ] 120 s at rest, gyro drifts 2 deg/min: dead reckoning %.0f m, filter %.1f m\n", far_dead,
                far_filter);
    EXPECT_GT(far_dead, 100);
    EXPECT_LT(far_filter, 15);
}

TEST(thesis_navigation, fixes_level_the_attitude)
{
    for (const size_t axis : {size_t{0}, size_t{1}})
    {
        double tilt_deg[2];
        for (const bool level : {false, true})
        {
            Rig rig(NULL_FRACTION);
            rig.navigation.level = level;
            rig.calibrate();
            rig.sensor.null[axis] += 0.16; // 2 deg/min
            for (int s = 0; s < 180; s++)
            {
                rig.fix();
                for (int i = 0; i < 5; i++)
                {
                    rig.still();
                }
            }
            float euler[3];
            ins_quat_to_euler(rig.navigation.attitude.q_nb, euler);
            tilt_deg[level] = std::fabs(static_cast<double>(euler[axis])) / DEG;
        }
        std::printf("[ figure   ] axis %zu drifts 2 deg/min for 3 min: tilt %.1f deg, levelled %.1f deg\n", axis,
                    tilt_deg[0], tilt_deg[1]);
        EXPECT_GT(tilt_deg[0], 3) << "axis " << axis;
        EXPECT_LT(tilt_deg[1], 2) << "axis " << axis;
    }
}

TEST(thesis_navigation, a_fix_far_off_is_refused_until_it_insists)
{
    Rig rig(NULL_FRACTION);
    rig.calibrate();
    rig.fix();
    for (int k = 1; k < THESIS_GATED_MAX; k++)
    {
        rig.fix(500);
        EXPECT_NE(rig.block().status & INS_NAV_BLOCK_GATED, 0u) << k;
        EXPECT_NEAR(rig.block().en_cm[0] * 0.01, EASTING, 5) << k;
    }
    rig.fix(500);
    EXPECT_NEAR(rig.block().en_cm[0] * 0.01, EASTING + 500, 1);
    rig.fix(500);
    EXPECT_EQ(rig.block().status & INS_NAV_BLOCK_GATED, 0u);
}

TEST(thesis_navigation, a_moving_cars_heading_is_its_course)
{
    Rig rig(NULL_FRACTION);
    rig.calibrate();
    for (int s = 0; s < 30; s++) // 10 m/s to the east, though the board believes it heads north
    {
        rig.fix(10.0 * s);
        for (int i = 0; i < 5; i++)
        {
            rig.still();
        }
    }
    float euler[3];
    ins_quat_to_euler(rig.navigation.attitude.q_nb, euler);
    EXPECT_NEAR(static_cast<double>(euler[2]) / DEG, 90, 10)
        << "tilts of a degree or two are accelerations to this filter";
    EXPECT_NEAR(static_cast<double>(rig.block().v_en[0]), 10, 1);
    const double since_fix = static_cast<double>(THESIS_FIX_DELAY_S) + 5.0 / 6;
    EXPECT_NEAR(rig.block().en_cm[0] * 0.01, EASTING + 290 + 10 * since_fix, 6) << "a fix is of some time ago";
}

TEST(thesis_report, the_newest_result_replaces_one_that_waits)
{
    report_t report;
    ins_hs_host_t host;
    const ins_hs_config_t cfg = {INS_NAV_BLOCK_LEN, 1, 3, 0, 30};
    ASSERT_EQ(ins_hs_host_init(&host, &cfg), INS_OK);
    report_begin(&report);
    std::vector<std::pair<unsigned, uint32_t>> got; // gap, time
    const auto exchange = [&]()
    {
        report_tick(&report, 0);
        for (int16_t octet; (octet = report_tx(&report, 0)) >= 0;)
        {
            int16_t reply;
            if (ins_hs_host_rx(&host, static_cast<ins_octet_t>(octet), 0, &reply) == INS_HS_BLOCK)
            {
                ins_nav_block_t b;
                ASSERT_EQ(ins_nav_block_get(host.block, &b), INS_OK);
                got.push_back({host.gap, b.time_ms});
            }
            if (reply >= 0)
            {
                ASSERT_EQ(report_rx(&report, static_cast<uint16_t>(reply), 0), COMMAND_NONE);
            }
        }
    };
    ins_nav_block_t block = {};
    block.q_nb[0] = 1;
    for (const uint32_t time : {100u, 200u, 300u, 400u})
    {
        block.time_ms = time;
        report_put(&report, &block);
        if (time == 100 || time == 400) // the line is busy between
        {
            exchange();
        }
    }
    EXPECT_EQ(got, (std::vector<std::pair<unsigned, uint32_t>>{{0, 100}, {2, 400}}));
}

TEST(thesis_report, commands_between_the_octets_of_the_handshake)
{
    report_t report;
    report_begin(&report);
    for (const char command : {'n', 'i', 'f', 'K', 'k', 'L', 'l'})
    {
        EXPECT_EQ(report_rx(&report, static_cast<uint16_t>(command), 0), static_cast<uint16_t>(command));
    }
    for (const unsigned octet : {0x00u, 0xBBu, 0xFFu, 0x20u})
    {
        EXPECT_EQ(report_rx(&report, static_cast<uint16_t>(octet), 0), COMMAND_NONE);
    }
}
