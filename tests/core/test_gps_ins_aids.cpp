/// \file   test_gps_ins_aids.cpp
/// \brief  Rest, wheels, odometer, another gyro, height: each against the same drive without it, and all against their covariance.
///
/// Units: SI, rad.
/// SPDX-License-Identifier: MIT
#include "gps_ins_ride.h"

using namespace core_test;
using namespace core_test::ride;

namespace
{
constexpr int RUNS = 10;
constexpr int BENCH_RUNS = 200;
constexpr double REST_S = 30;
constexpr double DURATION_S = 90;
constexpr Errors START = {5e-3, 5e-3, 0.02, 0.1, 0.1, 0.1, 1, 1, 1, 1.7e-3, 1.7e-3, 1.7e-3, 0.05, 0.05, 0.05};

const ins_track_t* track()
{
    static const ride::Track t = eight(REST_S);
    return t.get();
}

const Increments& exact()
{
    static const Increments x = increments(track(), DURATION_S);
    return x;
}

size_t at(double t)
{
    return static_cast<size_t>(std::llround(t * HZ));
}

double length(const Errors& e, size_t first)
{
    return norm({e[first], e[first + 1], e[first + 2]});
}

void detect_rest(Ride& r)
{
    r.cfg.still = {50, INS_C(2e-3), INS_C(0.05), INS_C(0.02)};
}

double truth_speed(double t)
{
    ins_track_state_t s;
    ins_track_at(track(), t, &s);
    return norm({s.v_n[0], s.v_n[1], s.v_n[2]});
}

TEST(gps_ins_aids, a_gap_adds_the_turn_that_it_may_hide)
{
    const double gap = 0.5;
    std::array<double, 2> variance = {};
    for (const size_t hides : {0, 1})
    {
        Ride r(track(), 11);
        r.cfg.unseen_rate = hides ? INS_C(0.1) : 0;
        r.cfg.unseen_accel = 0;
        r.start(0, START);
        for (size_t k = 0; k < at(1); k++)
        {
            ASSERT_EQ(r.step(static_cast<double>(k + 1) / HZ, exact()[k]), INS_OK);
        }
        ASSERT_EQ(r.step(1 + gap + 1.0 / HZ, exact()[at(1 + gap)]), INS_OK);
        variance[hides] = static_cast<double>(r.nav.kf.P[(INS_KF15_ROW + 1) * (INS_KF15_PHI + 2)]);
    }
    EXPECT_NEAR(std::sqrt(variance[1] - variance[0]), 0.1 * gap, 0.02 * gap);
}

TEST(gps_ins_aids, the_joint_nis_of_a_position_knows_that_its_axes_are_correlated)
{
    Ride r(track(), 12);
    r.start(0, START);
    ASSERT_EQ(r.step(1.0 / HZ, exact()[0]), INS_OK);
    const size_t n = INS_KF15_P;
    const double correlation[3] = {0.9, -0.5, -0.3}; // north east, north down, east down
    const auto put = [&](size_t i, size_t j, double x) {
        r.nav.kf.P[INS_KF15_ROW * (n + i) + n + j] = r.nav.kf.P[INS_KF15_ROW * (n + j) + n + i] =
            static_cast<ins_real>(x);
    };
    for (size_t i = 0; i < 3; i++)
    {
        put(i, i, 4);
    }
    put(0, 1, 4 * correlation[0]);
    put(0, 2, 4 * correlation[1]);
    put(1, 2, 4 * correlation[2]);
    const ins_gnss_fix_t f = r.fix(1.0 / HZ);
    ASSERT_EQ(ins_gps_ins_gnss(&r.nav, &f), INS_OK);
    // S = P + I, v' S^-1 v by Cramer's rule.
    const double a = 5, b = 4 * correlation[0], c = 4 * correlation[1], d = 4 * correlation[2];
    const double det = a * (a * a - d * d) - b * (b * a - d * c) + c * (b * d - a * c);
    const double inverse[3][3] = {{(a * a - d * d) / det, (c * d - b * a) / det, (b * d - a * c) / det},
                                  {(c * d - b * a) / det, (a * a - c * c) / det, (b * c - a * d) / det},
                                  {(b * d - a * c) / det, (b * c - a * d) / det, (a * a - b * b) / det}};
    double nis = 0;
    for (size_t i = 0; i < 3; i++)
    {
        for (size_t j = 0; j < 3; j++)
        {
            nis += static_cast<double>(r.nav.check.innovation[i]) * inverse[i][j] *
                   static_cast<double>(r.nav.check.innovation[j]);
        }
    }
    EXPECT_NEAR(static_cast<double>(r.nav.check.nis_position), nis, 1e-3 * nis);
}

TEST(gps_ins_aids, rest_is_found_and_holds_the_drift_without_a_fix)
{
    for (const bool detector : {false, true})
    {
        Ride r(track(), 7);
        if (detector)
        {
            detect_rest(r);
        }
        r.sensor_as_told();
        r.start(0, START);
        for (size_t k = 0; k < at(REST_S + 20); k++)
        {
            ASSERT_EQ(r.step(static_cast<double>(k + 1) / HZ, exact()[k]), INS_OK);
            if (k + 1 == at(REST_S))
            {
                const Errors e = r.errors(REST_S);
                std::printf("[ figure   ] 30 s at rest without a fix, %s: %.3f m, %.4f m/s, gyro bias %.1e rad/s\n",
                            detector ? "rest detected" : "no detector", length(e, 6), length(e, 3), length(e, 9));
                EXPECT_EQ(r.nav.count.rests, detector ? 60u : 0u);
                EXPECT_LT(length(e, 3), detector ? 0.02 : 40);
                EXPECT_GT(length(e, 3), detector ? 0 : 0.2);
                if (detector)
                {
                    EXPECT_LT(length(e, 6), 2.5);
                    EXPECT_LT(length(e, 9), 4e-4);
                }
            }
        }
        EXPECT_LE(r.nav.count.rests, detector ? 62u : 0u) << "rests while it moves";
    }
}

TEST(gps_ins_aids, a_smooth_ride_is_no_rest)
{
    // 15 m/s straight on would pass the detector: the filter, which has fixes, does not believe it.
    const ins_track_speed_t speed = {15, -100, 8, INFINITY, 8};
    char why[200] = "";
    const ride::Track line(ins_track_create_line(&SITE, 0.3, 0, &speed, nullptr, why, sizeof why));
    ASSERT_NE(line, nullptr) << why;
    const Increments x = increments(line.get(), 10);
    Ride r(line.get(), 7);
    detect_rest(r);
    r.sensor_as_told();
    r.start(0, START);
    for (size_t k = 0; k < x.size(); k++)
    {
        ASSERT_EQ(r.step(static_cast<double>(k + 1) / HZ, x[k]), INS_OK);
    }
    EXPECT_EQ(r.nav.count.rests, 0u);
    EXPECT_EQ(r.nav.count.rest_refused, 20u);
}

enum Aid
{
    NONE,
    NHC,
    ODOMETER,
    BOTH
};

/// Horizontal error at the end of 25 s without fixes, and its 3 sigma.
std::array<double, 2> outage(Aid aid, uint64_t seed)
{
    Ride r(track(), seed);
    r.cfg.gate = 0; // one in a thousand is outside
    detect_rest(r);
    r.sensor_as_told();
    r.start(0, START);
    for (size_t k = 0; k < at(85); k++)
    {
        const double t = static_cast<double>(k + 1) / HZ;
        EXPECT_EQ(r.step(t, exact()[k]), INS_OK);
        if (t < 60 && (k + 1) % 20 == 0)
        {
            const ins_gnss_fix_t f = r.fix(t);
            EXPECT_EQ(ins_gps_ins_gnss(&r.nav, &f), INS_OK);
        }
        if ((k + 1) % 10 == 0 && (aid & NHC))
        {
            EXPECT_EQ(ins_gps_ins_nhc(&r.nav), INS_OK) << t;
        }
        if ((k + 1) % 10 == 0 && (aid & ODOMETER))
        {
            const ins_real speed = static_cast<ins_real>(truth_speed(t) + 0.05 * r.normal(r.random));
            EXPECT_EQ(ins_gps_ins_odometer(&r.nav, speed, INS_C(0.05)), INS_OK) << t;
        }
    }
    const Errors e = r.errors(85);
    ins_gps_ins_state_t s;
    ins_gps_ins_state(&r.nav, &s);
    return {std::hypot(e[6], e[7]), 3 * std::hypot(static_cast<double>(s.sigma[6]), static_cast<double>(s.sigma[7]))};
}

TEST(gps_ins_aids, wheels_carry_it_through_an_outage)
{
    std::array<double, 4> rms = {};
    for (const Aid aid : {NONE, NHC, ODOMETER, BOTH})
    {
        double sum = 0;
        for (uint64_t seed = 1; seed <= 8; seed++)
        {
            const auto [error, bound] = outage(aid, seed);
            EXPECT_LT(error, bound) << aid << " seed " << seed;
            sum += error * error / 8;
        }
        rms[aid] = std::sqrt(sum);
    }
    std::printf("[ figure   ] 25 s without fixes, 8 runs: %.1f m free, %.1f m nhc, %.1f m odometer, %.1f m both\n",
                rms[NONE], rms[NHC], rms[ODOMETER], rms[BOTH]);
    EXPECT_LT(rms[NHC], rms[NONE] / 2);
    EXPECT_LT(rms[ODOMETER], rms[NONE] / 2);
    EXPECT_LT(rms[BOTH], rms[NONE] / 5);
    EXPECT_LT(rms[BOTH], rms[NHC]);
    EXPECT_LT(rms[BOTH], rms[ODOMETER]);
}

TEST(gps_ins_aids, height_and_another_gyro_hold_what_they_measure)
{
    Ride r(track(), 9);
    r.cfg.gate = 0;
    r.sensor_as_told();
    r.start(0, START);
    for (size_t k = 0; k < at(60); k++)
    {
        const double t = static_cast<double>(k + 1) / HZ;
        ASSERT_EQ(r.step(t, exact()[k]), INS_OK);
        if ((k + 1) % 10 == 0)
        {
            ins_track_state_t s;
            ins_track_at(track(), t, &s);
            const double rate = s.w_ib_b[2] + 1e-4 * r.normal(r.random);
            const double height = SITE.height - s.p_n[2] + 0.5 * r.normal(r.random);
            EXPECT_EQ(ins_gps_ins_yaw_rate(&r.nav, static_cast<ins_real>(rate), INS_C(1e-4)), INS_OK);
            EXPECT_EQ(ins_gps_ins_altitude(&r.nav, static_cast<ins_real>(height), INS_C(0.5)), INS_OK);
        }
    }
    const Errors e = r.errors(60);
    ins_gps_ins_state_t s;
    ins_gps_ins_state(&r.nav, &s);
    EXPECT_LT(s.sigma[11], INS_C(2e-4)); // of 1.7e-3
    EXPECT_LT(s.sigma[8], INS_C(0.3));
    EXPECT_LT(std::fabs(e[11]), 3 * static_cast<double>(s.sigma[11])) << "gyro bias about z";
    EXPECT_LT(std::fabs(e[8]), 3 * static_cast<double>(s.sigma[8])) << "height";
    EXPECT_LT(std::fabs(e[5]), 0.1) << "vertical velocity";
    EXPECT_GT(std::hypot(e[6], e[7]), 20) << "they measure nothing else";
}

TEST(gps_ins_aids, nees_with_everything_at_once_is_chi_squared)
{
    const int runs = std::getenv("INS_BENCH") != nullptr ? BENCH_RUNS : RUNS;
    for (const uint16_t decimate : {uint16_t{1}, uint16_t{5}})
    {
        double sum = 0;
        for (int run = 0; run < runs; run++)
        {
            Ride r(track(), static_cast<uint64_t>(1000 + run));
            r.cfg.stuck = 0;
            r.cfg.decimate = decimate;
            r.cfg.gate = 0;
            r.cfg.gate_position = 0;
            r.cfg.gate_velocity = 0;
            r.cfg.antenna_b[0] = INS_C(1.5);
            r.cfg.antenna_b[1] = INS_C(-0.5);
            r.cfg.antenna_b[2] = INS_C(-1.);
            r.cfg.zaru = INS_C(1e-3);
            r.sensor_as_told();
            r.start(REST_S - 10, START);
            for (size_t k = at(REST_S - 10); k < exact().size(); k++)
            {
                const double t = static_cast<double>(k + 1) / HZ;
                ASSERT_EQ(r.step(t, exact()[k]), INS_OK);
                ins_track_state_t s;
                ins_track_at(track(), t, &s);
                if ((k + 1) % 100 == 50)
                {
                    const ins_gnss_fix_t f = r.fix(t - 0.18);
                    ASSERT_EQ(ins_gps_ins_gnss(&r.nav, &f), INS_OK);
                }
                if ((k + 1) % 50 == 0)
                {
                    const double speed = norm({s.v_n[0], s.v_n[1], s.v_n[2]}) + 0.1 * r.normal(r.random);
                    const double height = SITE.height - s.p_n[2] + r.normal(r.random);
                    const double rate = s.w_ib_b[2] + 2e-3 * r.normal(r.random);
                    ASSERT_EQ(ins_gps_ins_odometer(&r.nav, static_cast<ins_real>(speed), INS_C(0.1)), INS_OK);
                    ASSERT_EQ(ins_gps_ins_altitude(&r.nav, static_cast<ins_real>(height), 1), INS_OK);
                    ASSERT_EQ(ins_gps_ins_yaw_rate(&r.nav, static_cast<ins_real>(rate), INS_C(2e-3)), INS_OK);
                }
                if (k + 1 == at(REST_S - 5))
                {
                    ins_real w[3];
                    for (size_t i = 0; i < 3; i++)
                    {
                        w[i] = static_cast<ins_real>(s.w_ib_b[i] + r.imu.gyro.bias[i] + 1e-3 * r.normal(r.random));
                    }
                    ASSERT_EQ(ins_gps_ins_zaru(&r.nav, w), INS_OK);
                }
            }
            sum += nees(r.nav, r.errors(DURATION_S));
        }
        const double freedom = static_cast<double>(N) * runs;
        const auto bounds = chi2_95(freedom);
        std::printf(
            "[ figure   ] NEES with all aids, a covariance each %u samples: %.4f a degree of freedom of %.0f, 95 %% "
            "within %.4f .. %.4f\n",
            decimate, sum / freedom, freedom, bounds[0] / freedom, bounds[1] / freedom);
        EXPECT_GE(sum, bounds[0]);
        EXPECT_LE(sum, bounds[1]);
    }
}

TEST(gps_ins_aids, one_error_alone_is_found_by_each_measurement_that_sees_it)
{
    // Nothing else is uncertain and nothing has noise: a row of the wrong sign or size leaves the error or makes it larger.
    using Measure = std::function<ins_status_t(Ride&, double)>;
    const auto gnss = [](double late, bool position)
    {
        return [=](Ride& r, double t)
        {
            r.sigma_p = 0;
            r.sigma_v = 0;
            ins_gnss_fix_t f = r.fix(t - late);
            std::fill(position ? f.sigma_p : f.sigma_v, (position ? f.sigma_p : f.sigma_v) + 3, INS_C(1e-4));
            return ins_gps_ins_gnss(&r.nav, &f);
        };
    };
    const Measure odometer = [](Ride& r, double t)
    { return ins_gps_ins_odometer(&r.nav, static_cast<ins_real>(truth_speed(t)), INS_C(1e-3)); };
    const Measure nhc = [](Ride& r, double) { return ins_gps_ins_nhc(&r.nav); };
    const struct
    {
        const char* what;
        size_t state;
        double sigma;
        Measure measure;
    } cases[] = {{"heading by the arm", 2, 0.02, gnss(0, true)},
                 {"heading by the turning arm", 2, 0.02, gnss(0, false)},
                 {"velocity by a late position", 4, 0.3, gnss(0.4, true)},
                 {"velocity by a late velocity", 3, 0.3, gnss(0.4, false)},
                 {"tilt by a late velocity", 0, 0.01, gnss(0.4, false)},
                 {"gyro bias by the arm's velocity", 11, 2e-3, gnss(0, false)},
                 {"heading by the wheels", 2, 0.02, nhc},
                 {"pitch by the wheels", 1, 0.01, nhc},
                 {"speed by the odometer", 3, 0.3, odometer}};
    for (const auto& c : cases)
    {
        Ride r(track(), 11);
        r.cfg.antenna_b[0] = INS_C(8.);
        r.cfg.antenna_b[1] = INS_C(-5.);
        r.cfg.antenna_b[2] = INS_C(-3.);
        r.cfg.gate = r.cfg.gate_position = r.cfg.gate_velocity = 0;
        r.cfg.stuck = 0;
        r.cfg.nhc = INS_C(1e-3);
        r.cfg.sensors.arw = r.cfg.sensors.vrw = INS_C(1e-7);
        r.cfg.sensors.bg_sigma = r.cfg.sensors.ba_sigma = INS_C(1e-9);
        Errors sigma = {};
        sigma[c.state] = c.sigma;
        r.start(50, sigma);
        if (c.state == 11)
        {
            r.nav.gyro_bias[2] = static_cast<ins_real>(c.sigma);
        }
        for (size_t k = at(50); k < at(50.5); k++)
        {
            ASSERT_EQ(r.step(static_cast<double>(k + 1) / HZ, exact()[k]), INS_OK);
        }
        const double before = r.errors(50.5)[c.state];
        EXPECT_EQ(c.measure(r, 50.5), INS_OK) << c.what;
        const double after = r.errors(50.5)[c.state];
        std::printf("[ figure   ] %s: %+.5f before, %+.5f after\n", c.what, before, after);
        EXPECT_GT(std::fabs(before), 0.1 * c.sigma) << c.what;
        EXPECT_LT(std::fabs(after), 0.08 * std::fabs(before)) << c.what;
    }
}
} // namespace
