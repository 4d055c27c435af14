// Exact increments of a track: against another quadrature, in sums, across breaks, against the motion's own.
// SPDX-License-Identifier: MIT
#include "ins_truth/exact.h"
#include "track_kit.hpp"

namespace
{
constexpr double end_s = 55.0;
constexpr double theta_tol = 1e-12; // over the whole track [rad]: roundings of the test's own sums of up to 40
constexpr double v_tol = 2e-11;     // likewise, of up to 600 [m/s]

struct Both
{
    Vec theta, v;
};

Both increment(const Track& track, double t0, double t1)
{
    Both out;
    ins_truth_increment(track.get(), t0, t1, out.theta.data(), out.v.data());
    return out;
}

/// With a rule and panels of the test's own.
Both quadrature(const Named& n, double t0, double t1, double panel_s)
{
    const auto w = [&](double t)
    {
        const ins_track_state_t s = at(n.track, t);
        return Vec{s.w_ib_b[0], s.w_ib_b[1], s.w_ib_b[2]};
    };
    const auto f = [&](double t)
    {
        const ins_track_state_t s = at(n.track, t);
        return Vec{s.f_b[0], s.f_b[1], s.f_b[2]};
    };
    return {integral(w, t0, t1, n.breaks, panel_s), integral(f, t0, t1, n.breaks, panel_s)};
}

void record(const char* name, double worst)
{
    testing::Test::RecordProperty(name, std::to_string(worst * 1e15) + "e-15");
}
} // namespace

TEST(exact, increments_are_the_integrals_of_rate_and_specific_force)
{
    const Motion motion = swing();
    double worst_theta = 0.0;
    double worst_v = 0.0;
    for (const ins_motion_t* attitude :
         {static_cast<const ins_motion_t*>(nullptr), static_cast<const ins_motion_t*>(motion.get())})
    {
        for (const Named& n : every_track(round_site, attitude))
        {
            const Both got = increment(n.track, 0.0, end_s);
            const Both want = quadrature(n, 0.0, end_s, 0.1);
            worst_theta = larger(worst_theta, max_difference(got.theta.data(), want.theta.data(), 3));
            worst_v = larger(worst_v, max_difference(got.v.data(), want.v.data(), 3));
            EXPECT_LE(worst_theta, theta_tol) << n.name;
            EXPECT_LE(worst_v, v_tol) << n.name;
        }
    }
    record("worst_theta_rad", worst_theta);
    record("worst_v_m_s", worst_v);
}

TEST(exact, increments_add_up_whatever_their_length)
{
    for (const Named& n : every_track(round_site, nullptr))
    {
        const Both whole = increment(n.track, 0.0, end_s);
        for (double step_s : {0.01, 0.73})
        {
            long double sums[6] = {0}; // thousands of roundings of a sum of 600 m/s would hide the rest
            double t = 0.0;
            for (int k = 1; t < end_s; k++)
            {
                const double next = std::fmin(k * step_s, end_s);
                const Both part = increment(n.track, t, next);
                for (std::size_t i = 0; i < 3; i++)
                {
                    sums[i] += part.theta[i];
                    sums[i + 3] += part.v[i];
                }
                t = next;
            }
            Both sum;
            for (std::size_t i = 0; i < 3; i++)
            {
                sum.theta[i] = static_cast<double>(sums[i]);
                sum.v[i] = static_cast<double>(sums[i + 3]);
            }
            EXPECT_LE(max_difference(sum.theta.data(), whole.theta.data(), 3), theta_tol) << n.name << " " << step_s;
            EXPECT_LE(max_difference(sum.v.data(), whole.v.data(), 3), v_tol) << n.name << " " << step_s;
        }
    }
}

TEST(exact, a_fast_cone_is_not_missed_by_a_long_interval)
{
    const Motion cone(ins_motion_create_coning(5.0 * deg, 8.33, 0.0, nullptr, 0), ins_motion_destroy);
    const Track track(ins_track_create_still(&flat_site, cone.get(), nullptr, 0), ins_track_destroy);
    for (double t1 : {0.01, 0.1, 7.0, 60.0})
    {
        double want[3];
        ins_motion_increment(cone.get(), 0.0, t1, want);
        EXPECT_LE(max_difference(increment(track, 0.0, t1).theta.data(), want, 3), theta_tol) << t1;
    }
}

TEST(exact, backwards_is_the_negative_and_beyond_the_known_is_no_number)
{
    const Motion motion = swing();
    const Track track(ins_track_create_still(&round_site, motion.get(), nullptr, 0), ins_track_destroy);
    const Both there = increment(track, 1.0, 3.0);
    const Both back = increment(track, 3.0, 1.0);
    const Both none = increment(track, 3.0, 3.0);
    const Both beyond = increment(track, 0.0, 2e9);
    for (std::size_t i = 0; i < 3; i++)
    {
        EXPECT_EQ(there.theta[i], -back.theta[i]);
        EXPECT_EQ(there.v[i], -back.v[i]);
        EXPECT_EQ(none.theta[i], 0.0);
        EXPECT_TRUE(std::isnan(beyond.theta[i]) && std::isnan(beyond.v[i]));
    }
}
