/// \file   test_fiter.cpp
/// \brief  Functional iteration and rate fit, against the reference files, the published accuracy, and a fine Runge-Kutta integration.
/// SPDX-License-Identifier: MIT
#include "attitude_runs.h"
#include <random>
using namespace core_test;

namespace
{
const double T = 0.08;                              // [s]
const size_t STEPS = 300;                           // 24 s
const unsigned SEED = 20180;                        // of the random increments
const double TOL_MOTION = INS_TOL(1e-12, 4e-6);     // component, after 300 steps
const double TOL_MOTION_RAD = INS_TOL(1e-12, 8e-6); // rad, over 300 steps
const double TOL_ONE_STEP = INS_TOL(2e-15, 1e-6);   // component
const ins_real LEVEL[4] = {1, 0, 0, 0};

const struct
{
    const char* name; ///< as in the reference files
    int form;
} FORMS[] = {{"fhist2", INS_FITER_HIST2},   {"fhist3", INS_FITER_HIST3},   {"fhist4", INS_FITER_HIST4},
             {"ratefit3", INS_FITER_RATE3}, {"ratefit4", INS_FITER_RATE4}, {"ratefit5", INS_FITER_RATE5}};

double error_of(const Motion& m, int form, double period, size_t steps)
{
    return max_error(run_fiter_motion(m, form, period, steps),
                     [&](size_t k) { return m.attitude(static_cast<double>(k) * period); });
}

/// theta of the last interval(s) from a rate polynomial on s = 0..1, w(s) = sum w_j s^j, and its quaternion by Runge-Kutta.
Quat integrate(const std::vector<Vec>& w)
{
    const int substeps = 2000;
    using L = long double;
    std::array<L, 4> q = {1, 0, 0, 0};
    const auto slope = [&](L s, const std::array<L, 4>& x)
    {
        std::array<L, 3> r = {0, 0, 0};
        L power = 1;
        for (const Vec& c : w)
        {
            for (size_t i = 0; i < 3; i++)
            {
                r[i] += power * static_cast<L>(c[i]) / 2;
            }
            power *= s;
        }
        return std::array<L, 4>{-x[1] * r[0] - x[2] * r[1] - x[3] * r[2], x[0] * r[0] + x[2] * r[2] - x[3] * r[1],
                                x[0] * r[1] - x[1] * r[2] + x[3] * r[0], x[0] * r[2] + x[1] * r[1] - x[2] * r[0]};
    };
    const auto ahead = [](const std::array<L, 4>& x, L h, const std::array<L, 4>& d) {
        return std::array<L, 4>{x[0] + h * d[0], x[1] + h * d[1], x[2] + h * d[2], x[3] + h * d[3]};
    };
    const L h = L(1) / substeps;
    for (int k = 0; k < substeps; k++)
    {
        const L s = k * h;
        const auto a = slope(s, q);
        const auto b = slope(s + h / 2, ahead(q, h / 2, a));
        const auto c = slope(s + h / 2, ahead(q, h / 2, b));
        const auto d = slope(s + h, ahead(q, h, c));
        for (size_t i = 0; i < 4; i++)
        {
            q[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
        }
    }
    return {static_cast<double>(q[0]), static_cast<double>(q[1]), static_cast<double>(q[2]), static_cast<double>(q[3])};
}
} // namespace

TEST(vector_fiter, motions)
{
    const json file = load("attitude_motion.json");
    Worst quats;
    Worst errors;
    for (const json& c : file["cases"])
    {
        const auto truth = c["q_true"].get<std::vector<Quat>>();
        const auto rates = c["rates"].get<std::vector<Vec>>();
        const auto start = rates.begin() - c["rates_first_k"].get<long>();
        const auto pre = c["pre"].get<std::vector<Vec>>();
        const auto incs = c["incs"].get<std::vector<Vec>>();
        std::vector<std::pair<std::string, Track>> tracks = {{"fiter3", run_block3(truth[0], incs)}};
        for (const auto& f : FORMS)
        {
            if (c["results"].contains(f.name))
            {
                tracks.push_back({f.name, is_rate(f.form)
                                              ? run_fiter(f.form, c["T"], truth[0], {rates.begin(), start + 1},
                                                          {start + 1, start + 1 + c["n"].get<long>()})
                                              : run_fiter(f.form, 1, truth[0], pre, incs)});
            }
        }
        ASSERT_GE(tracks.size(), 6u);
        for (const auto& [name, track] : tracks)
        {
            const json& want = c["results"].at(name);
            ASSERT_EQ(track.back().first, want["k_final"].get<size_t>()) << name;
            const Quat q = track.back().second;
            const auto q_want = want["q_final"].get<Quat>();
            const double sign = q[0] * q_want[0] + q[1] * q_want[1] + q[2] * q_want[2] + q[3] * q_want[3] < 0 ? -1 : 1;
            for (size_t i = 0; i < 4; i++)
            {
                quats.take(sign * q[i], q_want[i], 1, name);
            }
            errors.take(max_error(track, [&](size_t k) { return truth[k]; }), want["max_err"], 1, name);
        }
    }
    expect_within(quats, TOL_MOTION, "functional iteration, q_final");
    // The reference stops its own series where 1e-9 is left of the largest motion's block (degree 24), its attitudes agree to 1e-12.
    expect_within(errors, TOL_MOTION_RAD, "functional iteration, max_err [rad]");
}

TEST(fiter, accuracy_table_at_80_ms)
{
    const struct
    {
        int form;
        double a, b, d; ///< published, two digits
    } rows[] = {{INS_FITER_HIST3, 3.6e-7, 4.4e-6, 8.6e-3},
                {INS_FITER_HIST4, 4.8e-8, 8.3e-7, 7.1e-3},
                {INS_FITER_RATE4, 1.0e-5, 3.7e-5, 0.040},
                {INS_FITER_RATE5, 1.1e-6, 8.1e-6, 0.0094}};
    const double rounding = INS_TOL(1e-12, 8e-6);
    for (const auto& row : rows)
    {
        const double got[] = {error_of(MOTION_A, row.form, T, STEPS), error_of(MOTION_B, row.form, T, STEPS),
                              error_of(MOTION_D, row.form, T, STEPS)};
        const double want[] = {row.a, row.b, row.d};
        std::printf("form %d: %10.3e %10.3e %10.3e\n", row.form, got[0], got[1], got[2]);
        for (int i = 0; i < 3; i++)
        {
            EXPECT_NEAR(got[i], want[i], 0.05 * want[i] + rounding) << row.form << "ABD"[i];
        }
    }
}

#ifndef INS_REAL_FLOAT
TEST(fiter, order_of_convergence)
{
    const struct
    {
        int form;
        double order;
    } rows[] = {{INS_FITER_HIST0, 2}, {INS_FITER_HIST1, 3}, {INS_FITER_HIST2, 4},
                {INS_FITER_HIST3, 5}, {INS_FITER_HIST4, 6}, {INS_FITER_RATE2, 2},
                {INS_FITER_RATE3, 3}, {INS_FITER_RATE4, 4}, {INS_FITER_RATE5, 5}};
    const double period = 0.04;
    const size_t steps = 300;
    for (const auto& row : rows)
    {
        const double coarse = error_of(MOTION_B, row.form, period, steps);
        const double fine = error_of(MOTION_B, row.form, period / 2, 2 * steps);
        EXPECT_NEAR(std::log2(coarse / fine), row.order, 0.35) << row.form << " " << coarse << " " << fine;
    }
}
#endif

TEST(fiter, solves_the_polynomial_exactly)
{
    // Random polynomials of each form's degree: samples made from them, the quaternion by fine Runge-Kutta.
    std::mt19937 random(SEED);
    std::uniform_real_distribution<double> component(-0.4, 0.4);
    Worst worst;
    for (int form = 0; form < INS_FITER_FORM_COUNT; form++)
    {
        const int n = ins_fiter_samples(form);
        const bool block = form == INS_FITER_BLOCK3;
        for (int trial = 0; trial < 10; trial++)
        {
            std::vector<Vec> w;
            for (int j = 0; j < n; j++)
            {
                w.push_back({component(random), component(random), component(random)});
            }
            std::vector<ins_real> theta;
            for (int i = n - 1; i >= 0; i--)
            {
                const double end = block ? (3 - i) / 3.0 : 1 - i;
                const double begin = block ? (2 - i) / 3.0 : -i;
                for (size_t axis = 0; axis < 3; axis++)
                {
                    double x = 0;
                    for (int j = 0; j < n; j++)
                    {
                        x += w[static_cast<size_t>(j)][axis] *
                             (is_rate(form) ? std::pow(end, j)
                                            : (std::pow(end, j + 1) - std::pow(begin, j + 1)) / (j + 1));
                    }
                    // History of a quartic is larger than pi for some: such are not asked for.
                    theta.push_back(static_cast<ins_real>(x));
                }
            }
            ins_real dq[4];
            const double largest = std::fabs(static_cast<double>(*std::max_element(
                theta.begin(), theta.end(), [](ins_real a, ins_real b) { return std::fabs(a) < std::fabs(b); })));
            if (largest > PI)
            {
                EXPECT_EQ(ins_fiter_turn(form, theta.data(), dq), INS_E_RANGE);
                continue;
            }
            ASSERT_EQ(ins_fiter_turn(form, theta.data(), dq), INS_OK) << form;
            const Quat want = integrate(w);
            for (size_t i = 0; i < 4; i++)
            {
                worst.take(static_cast<double>(dq[i]), want[i], std::max(1.0, 4 * largest), std::to_string(form));
            }
        }
    }
    EXPECT_GT(worst.checked, 200);
    expect_within(worst, TOL_ONE_STEP, "functional iteration of random polynomials, seed " + std::to_string(SEED));
}

TEST(fiter, ends_for_any_increments_up_to_its_promise)
{
    // The worst case of the fit is increments of alternating sign; the series must end, and be a rotation.
    for (int form = 0; form < INS_FITER_FORM_COUNT; form++)
    {
        const ins_real largest = form == INS_FITER_BLOCK3 ? INS_C(0.05) : INS_C(0.5);
        for (unsigned signs = 0; signs < 1u << 15; signs += 5)
        {
            ins_real theta[3 * INS_FITER_SAMPLES_MAX];
            for (unsigned i = 0; i < 15; i++)
            {
                theta[i] = (signs >> i & 1) ? largest : -largest;
            }
            ins_real dq[4];
            ASSERT_EQ(ins_fiter_turn(form, theta, dq), INS_OK) << form << " " << signs;
            const Quat q = quat(dq);
            ASSERT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1, INS_TOL(2e-13, 1e-4));
        }
    }
}

TEST(fiter, start_up)
{
    // Constant rate: every start-up form is exact, from increments and from rates.
    const ins_real w[3] = {INS_C(0.6), INS_C(-0.2), INS_C(0.3)}; // |w| = 0.7 rad/s
    for (const int form : {INS_FITER_HIST4, INS_FITER_RATE5})
    {
        const bool rates = is_rate(form);
        const ins_real period = INS_C(0.125);
        ins_fiter_t f;
        ASSERT_EQ(ins_fiter_init(&f, form, period, LEVEL), INS_OK);
        for (int k = 0; k < 8; k++)
        {
            const ins_real theta[3] = {w[0] * period, w[1] * period, w[2] * period};
            ASSERT_EQ(ins_fiter_step(&f, rates ? w : theta), k < 4 ? INS_S_START : INS_OK) << k;
            const double angle = 0.7 * 0.125 * (rates ? k : k + 1);
            const double s = std::sin(angle / 2) / 0.7;
            const Quat want = {std::cos(angle / 2), 0.6 * s, -0.2 * s, 0.3 * s};
            EXPECT_LT(angle_between(quat(f.q_nb), want), INS_TOL(1e-14, 2e-6)) << k;
        }
    }
}

TEST(fiter, refuses_and_changes_nothing)
{
    const ins_real nan = static_cast<ins_real>(std::nan(""));
    const ins_real inf = static_cast<ins_real>(INFINITY);
    const ins_real long_q[4] = {INS_C(1.002), 0, 0, 0};
    ins_fiter_t f;
    EXPECT_EQ(ins_fiter_samples(-1), 0);
    EXPECT_EQ(ins_fiter_samples(INS_FITER_FORM_COUNT), 0);
    EXPECT_EQ(ins_fiter_init(&f, INS_FITER_BLOCK3, 1, LEVEL), INS_E_RANGE);
    EXPECT_EQ(ins_fiter_init(&f, INS_FITER_FORM_COUNT, 1, LEVEL), INS_E_RANGE);
    EXPECT_EQ(ins_fiter_init(&f, INS_FITER_HIST3, 1, long_q), INS_E_RANGE);
    for (const ins_real bad : {nan, inf, INS_C(0.0), INS_C(-1.0)})
    {
        EXPECT_EQ(ins_fiter_init(&f, INS_FITER_RATE3, bad, LEVEL), INS_E_RANGE);
    }
    for (const int form : {INS_FITER_HIST4, INS_FITER_RATE5})
    {
        ASSERT_EQ(ins_fiter_init(&f, form, 1, LEVEL), INS_OK);
        for (const ins_real bad : {nan, inf, INS_C(3.2)})
        {
            for (size_t axis = 0; axis < 3; axis++)
            {
                ins_real v[3] = {0, 0, 0};
                v[axis] = bad;
                EXPECT_EQ(ins_fiter_step(&f, v), INS_E_RANGE);
            }
        }
        EXPECT_EQ(f.count, 0);
        // Swings of 3 rad from sample to sample: the quartic through them is wild, and its series does not end.
        for (size_t i = 0; i < 12; i++)
        {
            f.prev[i / 3][i % 3] = static_cast<ins_real>(i % 2 ? 3 : -3);
        }
        f.count = 4;
        const ins_fiter_t before = f;
        const ins_real swing[3] = {3, 3, -3};
        EXPECT_EQ(ins_fiter_step(&f, swing), INS_E_RANGE);
        EXPECT_EQ(quat(f.q_nb), quat(before.q_nb));
        EXPECT_EQ(f.count, before.count);
        EXPECT_EQ(vec(f.prev[0]), vec(before.prev[0]));
    }
    ins_real theta[15] = {0};
    ins_real dq[4] = {7, 7, 7, 7};
    EXPECT_EQ(ins_fiter_turn(INS_FITER_FORM_COUNT, theta, dq), INS_E_RANGE);
    theta[3] = nan;
    EXPECT_EQ(ins_fiter_turn(INS_FITER_HIST4, theta, dq), INS_E_RANGE);
    EXPECT_EQ(quat(dq), (Quat{7, 7, 7, 7}));
}
