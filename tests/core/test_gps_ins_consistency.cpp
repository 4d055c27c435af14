/// \file   test_gps_ins_consistency.cpp
/// \brief  Does the GPS/INS filter err as its covariance says? NEES and NIS of many runs against their 95 % bounds.
///
/// Units: SI, rad. The truth is libins_truth's, with the sensor errors that the filter is told. INS_BENCH=1: all 200 runs.
/// SPDX-License-Identifier: MIT
#include "gps_ins_ride.h"

using namespace core_test;
using namespace core_test::ride;

namespace
{
constexpr int RUNS = 10;
constexpr int BENCH_RUNS = 200;
constexpr double DURATION_S = 60;
constexpr size_t FIX_EVERY = 20; ///< samples: 5 Hz
constexpr Errors START = {0.01, 0.01, 0.05, 0.2, 0.2, 0.2, 2, 2, 2, 1.7e-3, 1.7e-3, 1.7e-3, 0.05, 0.05, 0.05};

int runs()
{
    return std::getenv("INS_BENCH") != nullptr ? BENCH_RUNS : RUNS;
}

TEST(gps_ins_consistency, nees_and_nis_of_many_runs_are_chi_squared)
{
    const ride::Track track = eight(5);
    const Increments exact = increments(track.get(), DURATION_S);
    std::array<Squares, 6> nees_at;
    Squares position, velocity;
    for (int run = 0; run < runs(); run++)
    {
        Ride r(track.get(), static_cast<uint64_t>(run + 1));
        r.cfg.stuck = 0;
        r.cfg.gate_position = 0;
        r.cfg.gate_velocity = 0;
        r.sensor_as_told();
        r.start(0, START);
        for (size_t k = 0; k < exact.size(); k++)
        {
            const double t = static_cast<double>(k + 1) / HZ;
            ASSERT_EQ(r.step(t, exact[k]), INS_OK);
            if ((k + 1) % FIX_EVERY == 0)
            {
                const ins_gnss_fix_t f = r.fix(t);
                ASSERT_EQ(ins_gps_ins_gnss(&r.nav, &f), INS_OK);
                position.take(static_cast<double>(r.nav.check.nis_position), 3);
                velocity.take(static_cast<double>(r.nav.check.nis_velocity), 3);
            }
            if ((k + 1) % (exact.size() / nees_at.size()) == 0)
            {
                nees_at[(k + 1) / (exact.size() / nees_at.size()) - 1].take(nees(r.nav, r.errors(t)), N);
            }
        }
    }
    for (size_t i = 0; i < nees_at.size(); i++)
    {
        nees_at[i].expect(("NEES at " + std::to_string((i + 1) * 10) + " s").c_str());
    }
    position.expect("NIS of positions");
    velocity.expect("NIS of velocities");
}

TEST(gps_ins_consistency, a_start_as_unsure_as_is_allowed_stays_honest)
{
    const ride::Track track = eight(5);
    const Increments exact = increments(track.get(), DURATION_S);
    constexpr double START_S = 20;
    Errors unsure = START;
    unsure[0] = 0.03;
    unsure[1] = 0.03;
    unsure[2] = static_cast<double>(INS_GPS_INS_TILT_MAX);
    Squares heading;
    double worst = 0;
    for (int run = 0; run < runs(); run++)
    {
        Ride r(track.get(), static_cast<uint64_t>(run + 1));
        r.sensor_as_told();
        r.start(START_S, unsure);
        for (size_t k = static_cast<size_t>(START_S * HZ); k < exact.size(); k++)
        {
            const double t = static_cast<double>(k + 1) / HZ;
            ASSERT_EQ(r.step(t, exact[k]), INS_OK);
            if ((k + 1) % 50 == 0)
            {
                const ins_gnss_fix_t f = r.fix(t);
                (void)ins_gps_ins_gnss(&r.nav, &f);
            }
        }
        ins_gps_ins_state_t s;
        ins_gps_ins_state(&r.nav, &s);
        const double x = r.errors(DURATION_S)[2] / static_cast<double>(s.sigma[2]);
        heading.take(x * x, 1);
        worst = larger(worst, std::fabs(x));
    }
    heading.expect("heading 40 s after a start of 0.3 rad");
    EXPECT_LT(worst, 4.5);
}
TEST(gps_ins_consistency, factors_and_covariance_are_one_filter)
{
    // P0/R up to 1e10 for a position known to nobody and a fix of a centimetre: in float the symmetric form is not asked for that.
    const ride::Track track = eight(5);
    const Increments exact = increments(track.get(), DURATION_S);
    for (const double unsure : {2.0, 1000.0})
    {
        Ride p(track.get(), 1), u(track.get(), 1);
        u.ud = true;
        Errors start = START;
        std::fill(start.begin() + 6, start.begin() + 9, unsure);
        for (Ride* r : {&p, &u})
        {
            r->cfg.gate_position = 0;
            r->sigma_p = unsure > 2 ? 0.01 : 1;
            r->sensor_as_told();
            r->start(0, start);
        }
        for (size_t k = 0; k < exact.size(); k++)
        {
            const double t = static_cast<double>(k + 1) / HZ;
            ASSERT_EQ(p.step(t, exact[k]), INS_OK);
            ASSERT_EQ(u.step(t, exact[k]), INS_OK);
            if ((k + 1) % FIX_EVERY == 0)
            {
                const ins_gnss_fix_t f = p.fix(t), g = u.fix(t);
                ASSERT_EQ(ins_gps_ins_gnss(&p.nav, &f), INS_OK);
                ASSERT_EQ(ins_gps_ins_gnss(&u.nav, &g), INS_OK);
            }
        }
        ins_gps_ins_state_t a, b;
        ins_gps_ins_state(&p.nav, &a);
        ins_gps_ins_state(&u.nav, &b);
        double sigma = 0, state = 0;
        const Errors ea = p.errors(DURATION_S), eb = u.errors(DURATION_S);
        for (size_t i = 0; i < N; i++)
        {
            const double s = static_cast<double>(a.sigma[i]);
            sigma = larger(sigma, std::fabs(static_cast<double>(b.sigma[i]) / s - 1));
            state = larger(state, std::fabs(ea[i] - eb[i]) / s);
        }
        std::printf("[ figure   ] start to %.0f m: sigma of the two forms within %.1e, states within %.1e sigma\n",
                    unsure, sigma, state);
        EXPECT_LE(sigma, INS_TOL(1e-11, 3e-4)) << unsure;
        EXPECT_LE(state, INS_TOL(1e-10, 5e-3)) << unsure;
    }
}
} // namespace
