// GPS fixes: instants and latency, statistics of the errors, the same bits in any order, outages, refusals.
// SPDX-License-Identifier: MIT
#include "ins/geodesy.h"
#include "ins_truth/gps.h"
#include "track_kit.hpp"
#include <cstdlib>
#include <cstring>

namespace
{
constexpr std::int64_t s_ps = 1000000000000;
constexpr int reduced_fixes = 20000;
constexpr int bench_fixes = 1000000; ///< with INS_BENCH=1
constexpr std::uint64_t seed = 11;

Track still()
{
    return {ins_track_create_still(&flat_site, nullptr, nullptr, 0), ins_track_destroy};
}

ins_gps_t receiver(const Track& track, const ins_gps_config_t& config)
{
    ins_gps_t g;
    char why[200] = "";
    EXPECT_TRUE(ins_gps_init(&g, &config, track.get(), why, sizeof why)) << why;
    return g;
}

ins_gps_config_t ideal()
{
    ins_gps_config_t c;
    ins_gps_ideal_config(&c);
    return c;
}

/// North, east, down from the site [m], by the core.
Vec from_site(const ins_gps_fix_t& fix)
{
    const double llh[3] = {flat_site.latitude, flat_site.longitude, flat_site.height};
    ins_local_t local;
    double xyz[3];
    Vec ned;
    ins_local_init(&local, &ins_wgs84, llh);
    ins_geodesy_to_ecef(&ins_wgs84, fix.llh, xyz);
    ins_local_from_ecef(&local, xyz, ned.data());
    return ned;
}
} // namespace

TEST(gps, ideal_fixes_are_the_truth_of_their_instant)
{
    const Track track(ins_track_create_circle(&flat_site, 1.0, 50.0, &town, nullptr, nullptr, 0), ins_track_destroy);
    ins_gps_config_t c = ideal();
    c.latency_ps = 3 * s_ps / 10;
    ins_gps_t g = receiver(track, c);
    ins_gps_fix_t fix;
    EXPECT_FALSE(ins_gps_fix(&g, 3 * s_ps / 10 - 1, &fix));
    EXPECT_EQ(fix.number, -1);
    ASSERT_TRUE(ins_gps_fix(&g, 3 * s_ps / 10, &fix));
    EXPECT_EQ(fix.number, 0);
    ASSERT_TRUE(ins_gps_fix(&g, 20 * s_ps + 3 * s_ps / 10 - 1, &fix));
    EXPECT_EQ(fix.of_ps, 19 * s_ps) << "fix 20 is not there yet";
    ASSERT_TRUE(ins_gps_fix(&g, 20 * s_ps + 3 * s_ps / 10, &fix));
    EXPECT_EQ(fix.of_ps, 20 * s_ps);
    const ins_track_state_t s = at(track, 20.0);
    EXPECT_LE(max_difference(from_site(fix).data(), s.p_n, 3), 1e-7);
    EXPECT_LE(max_difference(fix.v_n, s.v_n, 3), 1e-3) << "resolved in the frame there, 8 urad from n";
    EXPECT_NEAR(fix.speed, 15.0, 1e-6);
    const double course = std::atan2(fix.v_n[1], fix.v_n[0]);
    EXPECT_NEAR(fix.course, course < 0 ? course + 2 * INS_TRUTH_PI : course, 1e-14);
    EXPECT_EQ(fix.sats, 8u);
}

TEST(gps, errors_have_the_stated_statistics)
{
    const Track track = still();
    ins_gps_config_t c = ideal();
    const double white[3] = {1.0, 2.0, 3.0};
    const double slow[3] = {4.0, 3.0, 6.0};
    std::memcpy(c.white, white, sizeof white);
    std::memcpy(c.markov, slow, sizeof slow);
    c.velocity[0] = c.velocity[1] = c.velocity[2] = 0.2;
    c.markov_tau_s = 10.0;
    c.seed = seed;
    ins_gps_t g = receiver(track, c);
    std::vector<Vec> e;
    const int fixes = std::getenv("INS_BENCH") != nullptr ? bench_fixes : reduced_fixes;
    double velocity = 0.0;
    for (int k = 0; k < fixes; k++)
    {
        ins_gps_fix_t fix;
        ins_gps_number(&g, k, &fix);
        e.push_back(from_site(fix));
        velocity += fix.v_n[1] * fix.v_n[1];
    }
    // Correlation over tau leaves about fixes / (2 tau) independent values; five standard deviations.
    const double limit = 5.0 * std::sqrt(2.0 * 10.0 / fixes);
    EXPECT_NEAR(velocity / fixes / 0.04, 1.0, 5.0 * std::sqrt(2.0 / fixes)) << "seed " << seed;
    for (std::size_t i = 0; i < 3; i++)
    {
        double mean = 0.0;
        for (const Vec& v : e)
        {
            mean += v[i] / fixes;
        }
        EXPECT_NEAR(mean / slow[i], 0.0, limit) << "axis " << i << " seed " << seed;
        for (int lag : {0, 1, 10, 20})
        {
            double product = 0.0;
            for (int k = lag; k < fixes; k++)
            {
                product += e[static_cast<std::size_t>(k)][i] * e[static_cast<std::size_t>(k - lag)][i] / (fixes - lag);
            }
            const double want = slow[i] * slow[i] * std::exp(-lag / 10.0) + (lag == 0 ? white[i] * white[i] : 0.0);
            EXPECT_NEAR(product / want, 1.0, 1.5 * limit * slow[i] * slow[i] / want) << "axis " << i << " lag " << lag;
        }
    }
}

TEST(gps, a_fix_is_a_function_of_its_number)
{
    const Track track = still();
    ins_gps_config_t c;
    ins_gps_default_config(&c);
    ins_gps_t forward = receiver(track, c);
    ins_gps_t backward = receiver(track, c);
    c.seed = 2;
    ins_gps_t other = receiver(track, c);
    std::vector<ins_gps_fix_t> seen(300);
    for (std::size_t k = 0; k < seen.size(); k++)
    {
        ins_gps_number(&forward, static_cast<std::int64_t>(k), &seen[k]);
        EXPECT_GE(seen[k].sats, 6u);
        EXPECT_LE(seen[k].sats, 8u);
    }
    for (std::size_t k = seen.size(); k-- > 0;)
    {
        ins_gps_fix_t again;
        ins_gps_number(&backward, static_cast<std::int64_t>(k), &again);
        EXPECT_EQ(max_difference(again.llh, seen[k].llh, 3), 0.0) << k;
        EXPECT_EQ(max_difference(again.v_n, seen[k].v_n, 3), 0.0) << k;
        EXPECT_EQ(again.sats, seen[k].sats) << k;
        ins_gps_number(&other, static_cast<std::int64_t>(k), &again);
        EXPECT_NE(again.llh[0], seen[k].llh[0]) << k;
    }
}

TEST(gps, outages_take_fixes_of_their_instants)
{
    const Track track = still();
    ins_gps_config_t c = ideal();
    c.first_fix_s = 2.5;
    c.sats_outage = 2;
    c.outages = 2;
    c.outage[0] = {5.0, 7.0};
    c.outage[1] = {9.5, 9.9};
    ins_gps_t g = receiver(track, c);
    for (std::int64_t k = 0; k < 12; k++)
    {
        ins_gps_fix_t fix;
        const bool out = k < 3 || k == 5 || k == 6;
        EXPECT_EQ(ins_gps_fix(&g, k * s_ps, &fix), !out) << k;
        EXPECT_EQ(fix.valid, !out) << k;
        EXPECT_EQ(fix.sats, out ? 2u : 8u) << k;
        EXPECT_EQ(fix.of_ps, k * s_ps);
    }
}

TEST(gps, refuses_bad_parameters_by_name)
{
    const Track track = still();
    char why[200];
    const auto refused = [&](const ins_gps_config_t& c, const std::string& place)
    {
        ins_gps_t g;
        EXPECT_FALSE(ins_gps_init(&g, &c, track.get(), why, sizeof why)) << place;
        EXPECT_NE(std::string(why).find(place), std::string::npos) << "want: " << place << ", got: " << why;
    };
    ins_gps_config_t c = ideal();
    c.period_ps = 0;
    refused(c, "period_ps is 0");
    c = ideal();
    c.markov[1] = -1.0;
    refused(c, "markov[1] is -1");
    c = ideal();
    c.markov_tau_s = not_a_number;
    refused(c, "markov_tau_s is nan");
    c = ideal();
    c.sats_spread = 6;
    refused(c, "sats_spread (leaving 3) is 6");
    c = ideal();
    c.outages = 1;
    c.outage[0] = {3.0, 2.0};
    refused(c, "outage 1: from_s is 3, to_s 2");
}
