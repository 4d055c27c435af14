/// \file   test_gps_ins_align.cpp
/// \brief  Start of the GPS/INS filter: at rest, by course, by accelerations alone; is what it says of its heading true?
///
/// Units: SI, rad.
/// SPDX-License-Identifier: MIT
#include "gps_ins_ride.h"

using namespace core_test;
using namespace core_test::ride;

namespace
{
constexpr int RUNS = 30;
constexpr int BENCH_RUNS = 200;
constexpr double REST_S = 20;
constexpr double DURATION_S = 100;

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

struct Start
{
    Ride ride;
    ins_gps_ins_align_config_t how;
    ins_gps_ins_align_t align;
    ins_gps_ins_start_t start = {};
    double found_s = 0; ///< 0: not found

    explicit Start(uint64_t seed) : ride(track(), seed)
    {
        ins_gps_ins_align_config(&how);
        ride.cfg.still = {50, INS_C(2e-3), INS_C(0.05), INS_C(0.02)};
        ride.cfg.antenna_b[0] = INS_C(0.8);
        ride.cfg.antenna_b[2] = INS_C(-1.2);
        ride.sensor_as_told();
    }
    /// Aligns from t on, until it has started or t1. \param heading  given at t, unless NaN
    void run(double t0, double t1, double heading = NAN)
    {
        char why[200] = "";
        ASSERT_TRUE(ins_imu_init(&ride.imu, &ride.sensor, why, sizeof why)) << why;
        ASSERT_EQ(ins_gps_ins_align_init(&align, &ride.cfg, &how), INS_OK);
        if (!std::isnan(heading))
        {
            ASSERT_EQ(ins_gps_ins_align_heading(&align, static_cast<ins_real>(heading), INS_C(0.03)), INS_OK);
        }
        for (size_t k = at(t0); k < at(t1) && found_s == 0; k++)
        {
            const double t = static_cast<double>(k + 1) / HZ;
            const ins_increment_t x = ride.sample(exact()[k]);
            ASSERT_EQ(ins_gps_ins_align_step(&align, ns(t), static_cast<ins_real>(1 / HZ), &x), INS_OK);
            if ((k + 1) % 50 == 0)
            {
                const ins_gnss_fix_t f = ride.fix(t);
                const ins_status_t status = ins_gps_ins_align_gnss(&align, &f, &start);
                found_s = status == INS_OK ? t : 0;
                ASSERT_GE(status, INS_OK) << t;
            }
        }
        if (found_s > 0)
        {
            ASSERT_EQ(ins_gps_ins_init(&ride.nav, &ride.cfg, &start), INS_OK);
        }
    }
    /// Errors squared over what start says of them: heading, tilt of two axes, velocity, position.
    std::array<double, 4> squares() const
    {
        const Errors e = ride.errors(found_s);
        const auto of = [&](size_t i) { return std::pow(e[i] / static_cast<double>(start.sigma[i]), 2); };
        return {of(2), (of(0) + of(1)) / 2, (of(3) + of(4) + of(5)) / 3, (of(6) + of(7) + of(8)) / 3};
    }
};

TEST(gps_ins_align, at_rest_it_knows_level_and_bias_and_waits_for_a_heading)
{
    Start s(1);
    s.run(0, REST_S - 1);
    EXPECT_EQ(s.found_s, 0) << "a heading out of nothing";
    for (size_t i = 0; i < 3; i++)
    {
        EXPECT_NEAR(static_cast<double>(s.align.gyro_bias[i]), s.ride.imu.gyro.bias[i], 5e-4);
    }
    // Somebody knows it.
    ins_track_geodetic_t g;
    ins_track_geodetic(track(), 0, &g);
    Start told(1);
    told.run(0, REST_S - 1, euler_of({g.q_nb[0], g.q_nb[1], g.q_nb[2], g.q_nb[3]})[2] + 0.02);
    EXPECT_GT(told.found_s, 0);
    EXPECT_LT(told.found_s, 5);
    const Errors e = told.ride.errors(told.found_s);
    EXPECT_NEAR(e[2], -0.02, 5e-3);
    EXPECT_LT(std::hypot(e[0], e[1]), 0.02);
}

/// Runs many starts, prints how honest they are, and returns the means of their squares.
void expect_honest(const char* what, double from, const std::function<void(Start&)>& set)
{
    const int runs = std::getenv("INS_BENCH") != nullptr ? BENCH_RUNS : RUNS;
    std::array<double, 4> mean = {};
    double found = 0, sigma = 0, worst = 0, end = 0;
    for (int run = 0; run < runs; run++)
    {
        Start s(static_cast<uint64_t>(100 + run));
        set(s);
        s.run(from, from + 40);
        ASSERT_GT(s.found_s, 0) << what << ", run " << run;
        const auto x = s.squares();
        for (size_t i = 0; i < 4; i++)
        {
            mean[i] += x[i] / runs;
        }
        worst = larger(worst, x[0]);
        found += (s.found_s - from) / runs;
        sigma += static_cast<double>(s.start.sigma[2]) / runs;
        // And the filter goes on from there.
        for (size_t k = at(s.found_s); k < at(s.found_s + 30); k++)
        {
            const double t = static_cast<double>(k + 1) / HZ;
            ASSERT_EQ(s.ride.step(t, exact()[k]), INS_OK);
            if ((k + 1) % 50 == 0)
            {
                const ins_gnss_fix_t f = s.ride.fix(t);
                (void)ins_gps_ins_gnss(&s.ride.nav, &f);
            }
        }
        ins_gps_ins_state_t state;
        ins_gps_ins_state(&s.ride.nav, &state);
        const Errors e = s.ride.errors(s.found_s + 30);
        end = larger(end, std::fabs(e[2]) / static_cast<double>(state.sigma[2]));
        EXPECT_LT(std::fabs(e[2]), 0.1) << what << ", heading 30 s later, run " << run;
    }
    std::printf("[ figure   ] %s: found after %.1f s, heading to %.3f rad; error^2 / sigma^2 of heading %.2f (worst "
                "%.1f), tilt "
                "%.2f, velocity %.2f, position %.2f; 30 s later heading within %.1f sigma\n",
                what, found, sigma, mean[0], worst, mean[1], mean[2], mean[3], end);
    for (size_t i = 0; i < 4; i++)
    {
        EXPECT_LT(mean[i], 1.5) << what << ' ' << i;
    }
    EXPECT_GT(mean[0], 0.02) << what << ": much too modest";
    EXPECT_LT(worst, 16) << what;
    EXPECT_LT(end, 4.5) << what;
}

TEST(gps_ins_align, a_vehicle_that_starts_off_is_found_by_its_course)
{
    expect_honest("rest, then course", 5, [](Start&) {});
}

TEST(gps_ins_align, under_way_accelerations_alone_give_the_heading)
{
    expect_honest("under way, no course", 40, [](Start& s) { s.how.course_speed = 0; });
}

TEST(gps_ins_align, bad_input_is_refused_and_a_gap_begins_anew)
{
    Start s(1);
    const ins_gps_ins_align_config_t good = s.how;
    for (ins_real ins_gps_ins_align_config_t::*member :
         {&ins_gps_ins_align_config_t::heading_max, &ins_gps_ins_align_config_t::memory,
          &ins_gps_ins_align_config_t::course_sigma})
    {
        for (const ins_real bad : {INS_C(0.), INS_C(-1.), static_cast<ins_real>(std::nan(""))})
        {
            s.how = good;
            s.how.*member = bad;
            EXPECT_EQ(ins_gps_ins_align_init(&s.align, &s.ride.cfg, &s.how), INS_E_RANGE);
        }
    }
    s.how = good;
    s.how.heading_max = INS_C(0.7);
    EXPECT_EQ(ins_gps_ins_align_init(&s.align, &s.ride.cfg, &s.how), INS_E_RANGE);
    s.how = good;
    s.run(0, 3);
    EXPECT_EQ(ins_gps_ins_align_heading(&s.align, static_cast<ins_real>(std::nan("")), 1), INS_E_RANGE);
    EXPECT_EQ(ins_gps_ins_align_heading(&s.align, 1, 0), INS_E_RANGE);
    ins_increment_t x = {};
    EXPECT_EQ(ins_gps_ins_align_step(&s.align, ns(3), INS_C(0.01), &x), INS_E_RANGE) << "the same time again";
    x.v_b[1] = static_cast<ins_real>(std::nan(""));
    EXPECT_EQ(ins_gps_ins_align_step(&s.align, ns(3.01), INS_C(0.01), &x), INS_E_RANGE);
    EXPECT_EQ(s.align.has_fix, 1);
    x.v_b[1] = 0;
    EXPECT_EQ(ins_gps_ins_align_step(&s.align, ns(3.1), INS_C(0.01), &x), INS_OK);
    EXPECT_EQ(s.align.has_fix, 0);
    for (const double t : {2.9, 3.2})
    {
        ins_gnss_fix_t f = s.ride.fix(3.1);
        f.t_ns = ns(t);
        EXPECT_EQ(ins_gps_ins_align_gnss(&s.align, &f, &s.start), INS_E_RANGE);
    }
    ins_gnss_fix_t f = s.ride.fix(3.1);
    f.sigma_v[2] = 0;
    EXPECT_EQ(ins_gps_ins_align_gnss(&s.align, &f, &s.start), INS_E_RANGE);
}
} // namespace
