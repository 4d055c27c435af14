/// \file   test_full.cpp
/// \brief  The full model: the reference file, Monte-Carlo against its own covariance and the Cramer-Rao bound, what poses do not
///         show, outliers, refusals. SI.
/// SPDX-License-Identifier: MIT
#include "fixture.hpp"
#include <limits>
using namespace calib_test;

namespace
{
const double TOL_CLEAN = 1e-10;
const double TOL_NOISY_REL = 1e-7; // the file's own minimum is that good
const double TOL_SD_REL = 1e-5;
const unsigned SEED = 2004;
const int RUNS = 200;
const double RMS_OVER_BOUND = 1.2; ///< over 200 runs the rms of one parameter spreads by 0.05
const double FIXTURE_RAD = 1e-3;
const double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();
const char* const NAMES[] = {"b", "SF", "m1", "m2", "k2", "r_x", "r_y", "r_z"};

/// e^T P^-1 e by Cholesky.
double normalised(std::vector<double> P, std::vector<double> e)
{
    const size_t n = e.size();
    double sum = 0;
    for (size_t i = 0; i < n; i++)
    {
        for (size_t j = 0; j <= i; j++)
        {
            double s = P[i * n + j];
            for (size_t k = 0; k < j; k++)
            {
                s -= P[i * n + k] * P[j * n + k];
            }
            P[i * n + j] = i == j ? std::sqrt(s) : s / P[j * n + j];
        }
        for (size_t k = 0; k < i; k++)
        {
            e[i] -= P[i * n + k] * e[k];
        }
        e[i] /= P[i * n + i];
        sum += e[i] * e[i];
    }
    return sum;
}

/// Normalised errors within the 95 % bounds of chi-square, and each parameter's rms within its bound.
void monte_carlo(double fixture_rad)
{
    const Fixture fixture;
    const Solution at_truth(fixture, fixture.readings(std::vector<Vec>(fixture.poses.size(), Vec{})), fixture_rad);
    ASSERT_EQ(at_truth.status, 0) << at_truth.why.text;
    std::mt19937 random(SEED);
    std::normal_distribution<double> normal;
    const size_t n = fixture.truth.size();
    std::vector<double> square(n);
    double pooled = 0;
    double chi2 = 0;
    unsigned iterations = 0;
    for (int run = 0; run < RUNS; run++)
    {
        std::vector<Vec> turns(fixture.poses.size());
        for (Vec& turn : turns)
        {
            turn = {fixture_rad * normal(random), fixture_rad * normal(random), fixture_rad * normal(random)};
        }
        std::vector<double> readings = fixture.readings(turns);
        for (size_t i = 0; i < readings.size(); i++)
        {
            readings[i] += fixture.sensors[i % fixture.sensors.size()].sigma * normal(random);
        }
        const Solution s(fixture, readings, fixture_rad);
        ASSERT_EQ(s.status, 0) << s.why.text;
        std::vector<double> e(n);
        for (size_t i = 0; i < n; i++)
        {
            e[i] = s.p[i] - fixture.truth[i];
            square[i] += e[i] * e[i];
        }
        pooled += normalised(s.covariance, e);
        chi2 += s.result.chi2;
        iterations = std::max(iterations, s.result.iterations);
    }
    const auto expect_chi2 = [](double value, double freedom, const char* what)
    {
        const double bound = 1.96 * std::sqrt(2 * freedom); // freedom is thousands: chi-square is normal
        std::printf("[ figure   ] %s: %.1f, 95 %% bounds %.1f .. %.1f\n", what, value, freedom - bound,
                    freedom + bound);
        EXPECT_NEAR(value, freedom, bound) << what;
    };
    std::printf("seed %u, %d runs, at most %u iterations\n", SEED, RUNS, iterations);
    expect_chi2(pooled, RUNS * static_cast<double>(n), "normalised errors squared, pooled");
    expect_chi2(chi2, RUNS * at_truth.result.chi2_expected, "residuals over sigma squared, pooled");
    Worst ratio;
    for (size_t i = 0; i < n; i++)
    {
        const std::string name = "accelerometer " + std::to_string(i / N + 1) + " " + NAMES[i % N];
        ratio.take(std::sqrt(square[i] / RUNS), 0, at_truth.deviation(i), name);
    }
    expect_within(ratio, RMS_OVER_BOUND, "rms over the Cramer-Rao bound");
}
} // namespace

TEST(vector_calib_full, least_squares_on_the_host)
{
    const Fixture fixture;
    const Solution clean(fixture, fixture.readings("y_clean"));
    const Solution noisy(fixture, fixture.readings("y_noisy"));
    ASSERT_EQ(clean.status, 0) << clean.why.text;
    ASSERT_EQ(noisy.status, 0) << noisy.why.text;
    Worst exact;
    Worst minimum;
    Worst deviations;
    Worst cost;
    std::vector<double> sum(fixture.sensors.size());
    for (size_t i = 0; i < noisy.residual.size(); i++)
    {
        sum[i % sum.size()] += noisy.residual[i] * noisy.residual[i];
    }
    for (size_t i = 0; i < fixture.truth.size(); i++)
    {
        const json& a = fixture.accelerometers[i / N];
        const std::string name = "accelerometer " + a["acc"].dump() + " " + NAMES[i % N];
        const double want = a["p_est_noisy"][i % N];
        const double sd = a["sd"][i % N];
        exact.take(clean.p[i], fixture.truth[i], 1, name);
        minimum.take(noisy.p[i], want, std::fabs(want), name);
        deviations.take(noisy.deviation(i), sd, sd, name);
        cost.take(sum[i / N], a["cost_noisy"], a["cost_noisy"], name);
    }
    std::printf("[ figure   ] condition %.1f, %u iterations\n", noisy.condition[0], noisy.result.iterations);
    EXPECT_EQ(noisy.result.from_prior, 0U);
    expect_within(exact, TOL_CLEAN, "parameters without noise");
    expect_within(minimum, TOL_NOISY_REL, "parameters with noise, relative");
    expect_within(deviations, TOL_SD_REL, "standard deviations, relative");
    expect_within(cost, 1e-9, "sum of squared residuals, relative");
}

TEST(calib_full, errors_are_those_of_the_covariance_in_known_attitudes)
{
    monte_carlo(0);
}

TEST(calib_full, errors_are_those_of_the_covariance_in_a_poor_fixture)
{
    monte_carlo(FIXTURE_RAD);
}

TEST(calib_full, attitudes_are_found_but_for_the_turn_of_the_whole)
{
    const Fixture fixture;
    const std::vector<Vec> turns(fixture.poses.size(), Vec{1e-3, -2e-3, 5e-4});
    const Solution s(fixture, fixture.readings(turns), FIXTURE_RAD);
    ASSERT_EQ(s.status, 0) << s.why.text;
    EXPECT_EQ(s.result.from_prior, 3U) << "the block's turn in its fixture";
    // All poses turned alike is the block turned back: readings fit, attitudes stay, axes lean by it.
    Worst turn;
    Worst rest;
    for (size_t i = 0; i < s.attitude.size(); i++)
    {
        turn.take(s.attitude[i], 0, 1, "pose " + std::to_string(i / 3));
    }
    for (const double e : s.residual)
    {
        rest.take(e, 0, 1, "residual");
    }
    expect_within(turn, 1e-5, "attitudes, rad");
    expect_within(rest, 1e-6, "residuals");
}

TEST(calib_full, says_what_is_not_fixed_and_what_would_fix_it)
{
    Fixture fixture;
    const std::vector<ins_calib_pose_t> all = fixture.poses;
    fixture.poses.resize(24); // rest, and spins about the three axes
    Solution s(fixture, std::vector<double>(24 * 6));
    EXPECT_EQ(s.status, INS_CALIB_E_RANK);
    EXPECT_SAYS(s.why, "accelerometer 1 has rank 7 of 8, not fixed: r_z;");
    EXPECT_SAYS(s.why, "accelerometer 2 has rank 7 of 8, not fixed: r_y;");
    EXPECT_SAYS(s.why, "Add: spin about (1, 1, 0) and spin about (0, 1, 1), or do not estimate it");
    // What it proposes is enough, and nothing of it is idle.
    for (const std::vector<size_t>& more : {std::vector<size_t>{24}, {32}, {24, 32}})
    {
        fixture.poses.resize(24);
        for (const size_t k : more)
        {
            fixture.poses.push_back(all[k]);
        }
        s = Solution(fixture, fixture.readings(std::vector<Vec>(fixture.poses.size(), Vec{})));
        EXPECT_EQ(s.status, more.size() == 2 ? INS_CALIB_OK : INS_CALIB_E_RANK) << more[0] << s.why.text;
    }
    fixture.poses.resize(18); // rest alone
    s = Solution(fixture, std::vector<double>(18 * 6));
    EXPECT_EQ(s.status, INS_CALIB_E_RANK);
    EXPECT_SAYS(s.why, "rank 5 of 8, not fixed: r_x, r_y and r_z");
    const unsigned places = 0xE0;
    std::vector<double> readings = fixture.readings("y_clean");
    s = Solution(fixture, readings, 0, 0, places);
    ASSERT_EQ(s.status, 0) << s.why.text;
    for (size_t i = 0; i < fixture.truth.size(); i++)
    {
        const bool place = i % N >= 5;
        EXPECT_NEAR(s.p[i], place ? fixture.sensors[i / N].r0[i % N - 5] : fixture.truth[i], TOL_CLEAN) << i;
        EXPECT_EQ(s.deviation(i) == 0, place) << i;
    }
}

TEST(calib_full, outliers_count_less)
{
    const Fixture fixture;
    std::vector<double> readings = fixture.readings("y_noisy");
    const Solution before(fixture, readings, 0, 3);
    for (size_t j = 0; j < 6; j++)
    {
        readings[6 * (5 * j + 2) + j] +=
            300 * fixture.sensors[j].sigma; // one of 36, as if someone had touched the table
    }
    const Solution plain(fixture, readings);
    const Solution robust(fixture, readings, 0, 3);
    ASSERT_EQ(before.status, 0);
    ASSERT_EQ(plain.status, 0);
    ASSERT_EQ(robust.status, 0) << robust.why.text;
    double worst_plain = 0;
    double worst_robust = 0;
    for (size_t i = 0; i < fixture.truth.size(); i++)
    {
        worst_plain = std::max(worst_plain, std::fabs(plain.p[i] - before.p[i]) / before.deviation(i));
        worst_robust = std::max(worst_robust, std::fabs(robust.p[i] - before.p[i]) / before.deviation(i));
    }
    std::printf("[ figure   ] moved by outliers, in standard deviations: least squares %.1f, robust %.2f\n",
                worst_plain, worst_robust);
    EXPECT_GT(worst_plain, 20);
    EXPECT_LT(worst_robust, 1);
}

TEST(calib_full, refuses)
{
    const Fixture good;
    const std::vector<double> readings = good.readings("y_clean");
    const auto expect = [&](const Fixture& fixture, const std::vector<double>& r, const char* words, double rad = 0,
                            double robust = 0, unsigned fixed = 0)
    {
        const Solution s(fixture, r, rad, robust, fixed);
        EXPECT_EQ(s.status, INS_CALIB_E_INPUT) << words;
        EXPECT_SAYS(s.why, words);
    };
    expect(good, readings, "fixture_rad is -1", -1);
    expect(good, readings, "fixture_rad is nan", NOT_A_NUMBER);
    expect(good, readings, "robust_sigmas is -1", 0, -1);
    expect(good, readings, "nothing to estimate", 0, 0, 0xFF);
    Fixture bad = good;
    bad.g = 0;
    expect(bad, readings, "g is 0");
    bad = good;
    bad.sensors[2].sigma = 0;
    expect(bad, readings, "accelerometer 3");
    bad = good;
    bad.poses[4].up[0] = 2;
    expect(bad, readings, "pose 5: up has length");
    bad = good;
    bad.poses[4].w[0] = NOT_A_NUMBER;
    expect(bad, readings, "pose 5");
    std::vector<double> odd = readings;
    odd[6 * 6] = NOT_A_NUMBER;
    expect(good, odd, "pose 7: a reading is not a number");
    expect(good, std::vector<double>(readings.size(), 1.0), "accelerometer 1: its readings do not change");
}
