/// \file   test_gps_ins.cpp
/// \brief  The GPS/INS filter on a figure of eight: late fixes and lever arms, aids, bad input that is counted and survived.
///
/// Units: SI, rad.
/// SPDX-License-Identifier: MIT
#include "gps_ins_ride.h"
#include <cstring>

using namespace core_test;
using namespace core_test::ride;

namespace
{
constexpr double MOVING_S = 15; ///< under way by then
constexpr double DURATION_S = 75;
constexpr Errors SMALL = {1e-3, 1e-3, 5e-3, 0.05, 0.05, 0.05, 0.5, 0.5, 0.5, 1e-4, 1e-4, 1e-4, 2e-3, 2e-3, 2e-3};
constexpr Errors NONE = {};
const ins_real NOT_A_NUMBER = static_cast<ins_real>(std::nan(""));

const ins_track_t* track()
{
    static const ride::Track t = eight(5);
    return t.get();
}

const Increments& exact()
{
    static const Increments x = increments(track(), DURATION_S);
    return x;
}

double length(const Errors& e, size_t first)
{
    return norm({e[first], e[first + 1], e[first + 2]});
}

/// An IMU that a car has, of little noise: what is looked for is what the filter does, not what the sensors do.
void quiet(Ride& r)
{
    r.cfg.sensors.arw = INS_C(2e-5);
    r.cfg.sensors.vrw = INS_C(2e-4);
    r.cfg.sensors.bg_sigma = INS_C(1e-4);
    r.cfg.sensors.ba_sigma = INS_C(2e-3);
    r.sensor_as_told();
}

/// From sample `from` up to `to`, with a fix each s; `each` is called after every sample.
void drive(Ride& r, size_t from, size_t to, bool fixes = true, const std::function<void(size_t)>& each = nullptr)
{
    for (size_t k = from; k < to; k++)
    {
        const double t = static_cast<double>(k + 1) / HZ;
        ASSERT_EQ(r.step(t, exact()[k]), INS_OK) << k;
        if (fixes && (k + 1) % 100 == 0)
        {
            const ins_gnss_fix_t f = r.fix(t);
            EXPECT_EQ(ins_gps_ins_gnss(&r.nav, &f), INS_OK) << t;
        }
        if (each)
        {
            each(k);
        }
    }
}

size_t at(double t)
{
    return static_cast<size_t>(std::llround(t * HZ));
}

TEST(gps_ins, a_late_fix_of_an_antenna_on_an_arm_is_that_of_then)
{
    // No errors at all: what an innovation is not zero by is the filter's own recollection.
    for (const double late : {0.0, 0.037, 0.18, 0.45, -0.008})
    {
        Ride r(track(), 3);
        r.cfg.antenna_b[0] = INS_C(1.2);
        r.cfg.antenna_b[1] = INS_C(-0.7);
        r.cfg.antenna_b[2] = INS_C(-1.5);
        r.cfg.gnss_late = late == 0.45 ? INS_C(0.05) : 0;
        r.cfg.stuck = 0;
        r.start(0, NONE);
        r.sigma_p = 0;
        r.sigma_v = 0;
        double place = 0, speed = 0;
        drive(r, 0, at(40), false,
              [&](size_t k)
              {
                  const double t = static_cast<double>(k + 1) / HZ;
                  if (t > MOVING_S && k % 50 == 0)
                  {
                      ins_gnss_fix_t f = r.fix(t - late);
                      for (size_t i = 0; i < 3; i++)
                      {
                          f.sigma_p[i] = 1;
                          f.sigma_v[i] = INS_C(0.1);
                      }
                      ASSERT_EQ(ins_gps_ins_gnss(&r.nav, &f), INS_OK) << late;
                      for (size_t i = 0; i < 3; i++)
                      {
                          place = larger(place, std::fabs(static_cast<double>(r.nav.check.innovation[i])));
                          speed = larger(speed, std::fabs(static_cast<double>(r.nav.check.innovation[3 + i])));
                      }
                  }
              });
        std::printf("[ figure   ] %+.3f s late: %.1e m, %.1e m/s\n", late, place, speed);
        EXPECT_LE(place, 3e-3) << late;
        EXPECT_LE(speed, 1e-3) << late;
        EXPECT_EQ(r.nav.count.fix_time, 0u);
    }
}

TEST(gps_ins, times_that_the_past_does_not_reach_are_refused)
{
    Ride r(track(), 1);
    r.start(0, SMALL);
    drive(r, 0, at(10));
    for (const double t : {10 - 0.7, 10 + 0.05, 10.0 + 604800, 10.0 - 604800})
    {
        ins_gnss_fix_t f = r.fix(10);
        f.t_ns = ns(t);
        const ins_gps_ins_t before = r.nav;
        EXPECT_EQ(ins_gps_ins_gnss(&r.nav, &f), INS_E_RANGE) << t;
        EXPECT_EQ(std::memcmp(&before.kf, &r.nav.kf, sizeof before.kf), 0);
    }
    ins_gnss_fix_t f = r.fix(10);
    f.t_ns = INT64_MIN;
    EXPECT_EQ(ins_gps_ins_gnss(&r.nav, &f), INS_E_RANGE);
    EXPECT_EQ(r.nav.count.fix_time, 5u);
    EXPECT_EQ(r.nav.count.fixes, 10u);
}

TEST(gps_ins, a_week_that_rolls_over_is_no_gap)
{
    // The receiver says a time of week of this week, of the one 1024 weeks ago, or none at all.
    const int64_t end = (T0_NS / INS_GNSS_WEEK_NS + 1) * INS_GNSS_WEEK_NS;
    for (const int64_t after : {INT64_C(-1500000000), INT64_C(0), INT64_C(250000000)})
    {
        const int64_t t = end + after;
        const int64_t tow = t % INS_GNSS_WEEK_NS;
        EXPECT_EQ(ins_gnss_time_near(tow, INS_GNSS_WEEK_NS, t - INT64_C(400000000)), t);
        EXPECT_EQ(ins_gnss_time_near(t - INS_GNSS_ROLLOVER_NS, INS_GNSS_ROLLOVER_NS, t + INT64_C(900000000)), t);
        EXPECT_EQ(ins_gnss_time_near(t + 3 * INS_GNSS_ROLLOVER_NS, INS_GNSS_ROLLOVER_NS, t), t);
    }
}

TEST(gps_ins, positions_of_integers_keep_every_digit)
{
    Worst worst;
    for (const int32_t lat : {-899999999, -123456789, 0, 1, 515777777, 899999999})
    {
        for (const int32_t lon : {-1800000000, -987654321, 0, 1799999999, 131234567})
        {
            ins_position_t p;
            ins_gnss_position(lat, lon, -12345, &p);
            const Vec llh = geodetic(p);
            worst.take(llh[0], lat * (PI / 1.8e9), 1, "latitude " + std::to_string(lat));
            worst.take(llh[1], lon * (PI / 1.8e9), 1, "longitude " + std::to_string(lon));
            worst.take(llh[2], -12.345, 1e6, "height"); // a tenth of a millimetre of height is 1e-10 here
        }
    }
    expect_within(worst, INS_TOL(1e-15, 2e-11), "positions of integers [rad]");
}

TEST(gps_ins, samples_that_are_no_samples_change_nothing)
{
    Ride r(track(), 1);
    r.start(0, SMALL);
    drive(r, 0, at(10));
    const ins_increment_t good = r.sample(exact()[at(10)]);
    uint32_t refused = 0;
    for (size_t i = 0; i < 6; i++)
    {
        for (const ins_real bad : {NOT_A_NUMBER, std::numeric_limits<ins_real>::infinity(), INS_C(1e3), INS_C(-1e3)})
        {
            ins_increment_t x = good;
            (i < 3 ? x.theta_b[i] : x.v_b[i - 3]) = bad;
            EXPECT_EQ(ins_gps_ins_step(&r.nav, ns(10.01), INS_C(0.01), &x), INS_E_RANGE);
            EXPECT_EQ(r.nav.count.imu_refused, ++refused);
        }
    }
    for (const ins_real dt : {NOT_A_NUMBER, INS_C(0.), INS_C(-0.01), INS_C(2.)})
    {
        EXPECT_EQ(ins_gps_ins_step(&r.nav, ns(10.01), dt, &good), INS_E_RANGE);
        EXPECT_EQ(r.nav.count.imu_refused, ++refused);
    }
    const ins_gps_ins_t before = r.nav;
    uint32_t odd = 0;
    for (const int64_t t : {ns(10), ns(9.99), ns(10) - INT64_C(604800000000000), ns(1e6), INT64_MIN, INT64_MAX})
    {
        EXPECT_EQ(ins_gps_ins_step(&r.nav, t, INS_C(0.01), &good), INS_E_RANGE) << t;
        EXPECT_EQ(r.nav.count.imu_time, ++odd);
    }
    EXPECT_EQ(std::memcmp(&before.nav, &r.nav.nav, sizeof before.nav), 0);
    EXPECT_EQ(std::memcmp(&before.kf, &r.nav.kf, sizeof before.kf), 0);
    EXPECT_EQ(ins_gps_ins_step(&r.nav, ns(10.01), INS_C(0.01), &good), INS_OK);
    EXPECT_EQ(r.nav.count.imu_gaps, 0u);
}

TEST(gps_ins, fixes_that_are_no_fixes_change_nothing)
{
    Ride r(track(), 1);
    r.start(0, SMALL);
    drive(r, 0, at(10));
    const ins_gps_ins_t before = r.nav;
    for (size_t i = 0; i < 3; i++)
    {
        for (int part = 0; part < 5; part++)
        {
            ins_gnss_fix_t f = r.fix(10);
            ins_real* const members[5] = {f.position.anchor, f.position.offset, f.v_n, f.sigma_p, f.sigma_v};
            members[part][i] = NOT_A_NUMBER;
            EXPECT_EQ(ins_gps_ins_gnss(&r.nav, &f), INS_E_RANGE) << i << part;
        }
    }
    ins_gnss_fix_t empty = r.fix(10);
    std::fill(empty.sigma_p, empty.sigma_p + 3, INS_C(0.));
    std::fill(empty.sigma_v, empty.sigma_v + 3, INS_C(0.));
    EXPECT_EQ(ins_gps_ins_gnss(&r.nav, &empty), INS_E_RANGE);
    EXPECT_EQ(r.nav.count.fix_refused, 16u);
    EXPECT_EQ(std::memcmp(&before.kf, &r.nav.kf, sizeof before.kf), 0);
    EXPECT_EQ(std::memcmp(&before.nav, &r.nav.nav, sizeof before.nav), 0);
    // An aid of no standard deviation, or no number.
    EXPECT_EQ(ins_gps_ins_altitude(&r.nav, 100, 0), INS_E_RANGE);
    EXPECT_EQ(ins_gps_ins_odometer(&r.nav, NOT_A_NUMBER, 1), INS_E_RANGE);
    EXPECT_EQ(ins_gps_ins_yaw_rate(&r.nav, 0, NOT_A_NUMBER), INS_E_RANGE);
    EXPECT_EQ(r.nav.count.aid_refused, 3u);
    EXPECT_EQ(std::memcmp(&before.kf, &r.nav.kf, sizeof before.kf), 0);
}

TEST(gps_ins, a_position_100_km_off_is_refused_and_its_velocity_used)
{
    Ride r(track(), 2), twin(track(), 2);
    r.start(0, SMALL);
    twin.start(0, SMALL);
    drive(r, 0, at(20));
    drive(twin, 0, at(20));
    ins_gnss_fix_t f = r.fix(20), v = f;
    f.position.anchor[0] += INS_C(0.0157);
    std::fill(v.sigma_p, v.sigma_p + 3, INS_C(0.));
    EXPECT_EQ(ins_gps_ins_gnss(&r.nav, &f), INS_OK);
    EXPECT_EQ(ins_gps_ins_gnss(&twin.nav, &v), INS_OK);
    EXPECT_EQ(r.nav.count.fix_position, 1u);
    EXPECT_EQ(r.nav.count.fix_velocity, 0u);
    EXPECT_EQ(std::memcmp(&r.nav.nav, &twin.nav.nav, sizeof r.nav.nav), 0);
    EXPECT_EQ(std::memcmp(&r.nav.kf, &twin.nav.kf, sizeof r.nav.kf), 0);
    std::fill(f.sigma_v, f.sigma_v + 3, INS_C(0.));
    EXPECT_EQ(ins_gps_ins_gnss(&r.nav, &f), INS_E_GATE);
    EXPECT_EQ(std::memcmp(&r.nav.nav, &twin.nav.nav, sizeof r.nav.nav), 0);
}

TEST(gps_ins, a_filter_that_all_fixes_contradict_doubts_itself)
{
    Ride r(track(), 2);
    quiet(r);
    r.start(0, SMALL);
    r.nav.nav.position.offset[0] += INS_C(1e-4); // 640 m
    r.nav.nav.v_n[1] += 8;
    for (size_t k = 0; k < at(30); k++)
    {
        const double t = static_cast<double>(k + 1) / HZ;
        ASSERT_EQ(r.step(t, exact()[k]), INS_OK);
        if ((k + 1) % 50 == 0)
        {
            const ins_gnss_fix_t f = r.fix(t);
            (void)ins_gps_ins_gnss(&r.nav, &f);
        }
    }
    EXPECT_EQ(r.nav.count.fix_doubts, 1u);
    EXPECT_EQ(r.nav.count.fix_position, r.cfg.refused_max + 1u);
    EXPECT_LT(length(r.errors(30), 6), 3);
    EXPECT_LT(length(r.errors(30), 3), 0.5);
}

TEST(gps_ins, a_gap_is_bridged_and_its_cost_is_in_the_covariance)
{
    for (const double gap : {0.02, 0.3, 0.9})
    {
        Ride r(track(), 4);
        quiet(r);
        r.start(0, SMALL);
        drive(r, 0, at(30));
        const double before = length(r.errors(30), 6);
        drive(r, at(30 + gap), at(31.5), false);
        const Errors e = r.errors(31.5);
        ins_gps_ins_state_t s;
        ins_gps_ins_state(&r.nav, &s);
        EXPECT_EQ(r.nav.count.imu_gaps, 1u);
        for (size_t i = 0; i < 9; i++)
        {
            EXPECT_LE(std::fabs(e[i]), 4 * static_cast<double>(s.sigma[i])) << gap << " s, state " << i;
        }
        std::printf("[ figure   ] gap of %.2f s: position error %.3f m before, %.3f m after\n", gap, before,
                    length(e, 6));
        drive(r, at(31.5), at(60));
        EXPECT_LT(length(r.errors(60), 6), 2) << gap;
        EXPECT_EQ(r.nav.count.imu_gaps, 1u);
    }
}

TEST(gps_ins, a_gap_too_long_ends_it)
{
    Ride r(track(), 4);
    r.start(0, SMALL);
    drive(r, 0, at(10));
    const ins_increment_t x = r.sample(exact()[at(12)]);
    for (int k = 0; k < 7; k++)
    {
        EXPECT_EQ(ins_gps_ins_step(&r.nav, ns(12.01 + 0.01 * k), INS_C(0.01), &x), INS_E_RANGE); // it may be the stamps
    }
    EXPECT_EQ(ins_gps_ins_step(&r.nav, ns(12.08), INS_C(0.01), &x), INS_E_STATE);
    EXPECT_EQ(r.nav.lost, 1);
    const ins_gnss_fix_t f = r.fix(12.08);
    EXPECT_EQ(ins_gps_ins_gnss(&r.nav, &f), INS_E_STATE);
    EXPECT_EQ(ins_gps_ins_zupt(&r.nav), INS_E_STATE);
    EXPECT_EQ(ins_gps_ins_step(&r.nav, ns(10.01), INS_C(0.01), &x), INS_E_STATE);
}

TEST(gps_ins, a_clock_that_steps_back_is_followed)
{
    Ride r(track(), 4);
    quiet(r);
    r.start(0, SMALL);
    drive(r, 0, at(30));
    const int64_t back = INT64_C(604800000000000);
    for (size_t k = at(30); k < at(60); k++)
    {
        const double t = static_cast<double>(k + 1) / HZ;
        const ins_increment_t x = r.sample(exact()[k]);
        (void)ins_gps_ins_step(&r.nav, ns(t) - back, INS_C(0.01), &x);
        if ((k + 1) % 100 == 0)
        {
            ins_gnss_fix_t f = r.fix(t);
            f.t_ns -= back;
            EXPECT_EQ(ins_gps_ins_gnss(&r.nav, &f), INS_OK) << t;
        }
    }
    EXPECT_EQ(r.nav.count.imu_clock, 1u);
    EXPECT_EQ(r.nav.count.imu_time, 7u);
    EXPECT_EQ(r.nav.count.imu_gaps, 1u) << "the seven";
    EXPECT_LT(length(r.errors(60), 6), 2);
}

TEST(gps_ins, a_dead_axis_is_found_and_survived)
{
    for (const size_t axis : {2u, 3u})
    {
        Ride r(track(), 5);
        quiet(r);
        r.start(0, SMALL);
        drive(r, 0, at(20));
        EXPECT_EQ(r.nav.stuck, 0);
        const double stuck = exact()[at(20)][axis];
        double worst = 0;
        for (size_t k = at(20); k < at(75); k++)
        {
            const double t = static_cast<double>(k + 1) / HZ;
            ins_increment_t x = r.sample(exact()[k]);
            if (t < 45)
            {
                (axis < 3 ? x.theta_b[axis] : x.v_b[axis - 3]) = static_cast<ins_real>(stuck);
            }
            ASSERT_EQ(ins_gps_ins_step(&r.nav, ns(t), INS_C(0.01), &x), INS_OK);
            if ((k + 1) % 20 == 0)
            {
                const ins_gnss_fix_t f = r.fix(t);
                (void)ins_gps_ins_gnss(&r.nav, &f);
            }
            if (t < 20.995 || t > 21.015) // 100 samples after it died
            {
                EXPECT_EQ(r.nav.stuck, t > 21 && t < 44.995 ? 1u << axis : 0u) << t;
            }
            worst = larger(worst, length(r.errors(t), 6));
        }
        EXPECT_EQ(r.nav.count.imu_stuck, 1u);
        std::printf("[ figure   ] axis %zu dead for 25 s: position error up to %.1f m, at the end %.2f m\n", axis,
                    worst, length(r.errors(75), 6));
        EXPECT_LT(worst, 30) << axis;
        EXPECT_LT(length(r.errors(75), 6), 2) << axis;
    }
}

TEST(gps_ins, what_was_in_its_memory_before_does_not_matter)
{
    Ride clean(track(), 6), dirty(track(), 6);
    std::memset(static_cast<void*>(&clean.both), 0, sizeof clean.both);
    std::memset(static_cast<void*>(&dirty.both), 0xA5, sizeof dirty.both);
    clean.start(0, SMALL);
    dirty.start(0, SMALL);
    drive(clean, 0, at(20));
    drive(dirty, 0, at(20));
    EXPECT_EQ(std::memcmp(&clean.nav.nav, &dirty.nav.nav, sizeof clean.nav.nav), 0);
    EXPECT_EQ(std::memcmp(&clean.nav.kf, &dirty.nav.kf, sizeof clean.nav.kf), 0);
    EXPECT_EQ(std::memcmp(&clean.nav.count, &dirty.nav.count, sizeof clean.nav.count), 0);
    EXPECT_EQ(std::memcmp(&clean.nav.past, &dirty.nav.past, sizeof clean.nav.past), 0);
}
} // namespace
