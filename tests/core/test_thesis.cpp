/// \file   test_thesis.cpp
/// \brief  The thesis's update, RK4 with norm feedback and ZXZ matrix, against the reference files and their own promises.
/// SPDX-License-Identifier: MIT
#include "attitude_runs.h"
using namespace core_test;

namespace
{
const double TOL_ONE_STEP = INS_TOL(1e-12, 4e-7);   // component
const double TOL_CONING = INS_TOL(1e-12, 4e-7);     // component or rad, after 36 steps
const double TOL_MOTION = INS_TOL(1e-12, 3e-6);     // component, after 300 steps
const double TOL_MOTION_RAD = INS_TOL(1e-12, 6e-6); // rad, over 300 steps
const double TOL_UNIT = INS_TOL(1e-15, 4e-7);       // norm of a normalised quaternion
const double FEEDBACK = 5;                          // [1/s]
const double TOL_FEEDBACK = INS_TOL(1e-7, 1e-6);    // norm that feedback holds: off by O((|w| h)^4)
const ins_real LEVEL[4] = {1, 0, 0, 0};
const ins_real REST[3] = {0, 0, 0};

void take_quat(Worst& worst, const Quat& got, const Quat& want, const std::string& place)
{
    double dot = 0;
    for (size_t i = 0; i < 4; i++)
    {
        dot += got[i] * want[i];
    }
    for (size_t i = 0; i < 4; i++)
    {
        worst.take(dot < 0 ? -got[i] : got[i], want[i], 1, place);
    }
}

double quat_norm(const ins_real q[4])
{
    const Quat x = quat(q);
    return std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3]);
}
} // namespace

TEST(vector_thesis, interval_quaternion)
{
    Worst worst;
    const json quaternion = load("quaternion.json");
    for (const json& c : quaternion["products"])
    {
        ins_real p[4];
        ins_thesis_p(real(c["rv"].get<Vec>()).data(), real(c["thesis_P_prev"].get<Vec>()).data(), p);
        const auto want = c["thesis_P"].get<Quat>();
        const double scale = std::max(1.0, std::fabs(want[0])); // of vectors out of the update's range P is large
        for (size_t i = 0; i < 4; i++)
        {
            worst.take(static_cast<double>(p[i]), want[i], scale, "products");
        }
    }
    const json coning = load("coning.json");
    for (const json& c : coning["cases"])
    {
        ins_real p[4];
        ins_thesis_p(real(c["incs"][0].get<Vec>()).data(), real(c["pre"].get<std::vector<Vec>>().back()).data(), p);
        const auto want = c["phi_first"]["thesis_P_unnormalised"].get<Quat>();
        for (size_t i = 0; i < 4; i++)
        {
            worst.take(static_cast<double>(p[i]), want[i], 1, "coning");
        }
    }
    expect_within(worst, TOL_ONE_STEP, "thesis P");
}

TEST(vector_thesis, update_in_coning)
{
    Worst quats;
    Worst errors;
    const json coning = load("coning.json");
    for (const json& c : coning["cases"])
    {
        const auto truth = c["q_true"].get<std::vector<Quat>>();
        const Track track =
            run_thesis(truth[0], c["pre"].get<std::vector<Vec>>().back(), c["incs"].get<std::vector<Vec>>());
        take_quat(quats, track.back().second, c["q_final"]["thesis2"].get<Quat>(), "thesis2");
        const Vec e = rotation_between(track.back().second, truth.back());
        for (size_t i = 0; i < 3; i++)
        {
            errors.take(e[i], c["att_err_final"]["thesis2"][i], 1, "thesis2");
        }
    }
    expect_within(quats, TOL_CONING, "thesis2 in coning, q_final");
    expect_within(errors, TOL_CONING, "thesis2 in coning, att_err_final [rad]");
}

TEST(vector_thesis, rk4_in_coning)
{
    Worst worst;
    const json coning = load("coning.json");
    for (const json& c : coning["cases"])
    {
        const Track track =
            run_rk4(0, c["h"], false, c["q_true"][0].get<Quat>(), c["rates_half_step"].get<std::vector<Vec>>());
        take_quat(worst, track.back().second, c["rk4_q_after_12_unnormalised"].get<Quat>(), "rk4");
    }
    expect_within(worst, TOL_CONING, "rk4 in coning");
}

TEST(vector_thesis, motions)
{
    Worst quats;
    Worst errors;
    const json attitude_motion = load("attitude_motion.json");
    for (const json& c : attitude_motion["cases"])
    {
        const auto truth = c["q_true"].get<std::vector<Quat>>();
        const auto rates = c["rates"].get<std::vector<Vec>>();
        const std::vector<Vec> from_start(rates.begin() - c["rates_first_k"].get<long>(), rates.end());
        const std::pair<const char*, Track> tracks[] = {
            {"thesis2",
             run_thesis(truth[0], c["pre"].get<std::vector<Vec>>().back(), c["incs"].get<std::vector<Vec>>())},
            {"rk4_2T", run_rk4(0, 2 * c["T"].get<double>(), true, truth[0], from_start)}};
        for (const auto& [name, track] : tracks)
        {
            const json& want = c["results"].at(name);
            ASSERT_EQ(track.back().first, want["k_final"].get<size_t>()) << name;
            take_quat(quats, track.back().second, want["q_final"].get<Quat>(), name);
            errors.take(max_error(track, [&](size_t k) { return truth[k]; }), want["max_err"], 1, name);
        }
    }
    expect_within(quats, TOL_MOTION, "thesis2, rk4_2T q_final");
    expect_within(errors, TOL_MOTION_RAD, "thesis2, rk4_2T max_err [rad]");
}

TEST(vector_thesis, zxz)
{
    Worst worst;
    const json quaternion = load("quaternion.json");
    for (const json& c : quaternion["zxz"])
    {
        const Vec angles = {c["alpha"], c["beta"], c["gamma"]};
        ins_real R[9];
        ins_thesis_zxz(real(angles).data(), R);
        for (size_t i = 0; i < 9; i++)
        {
            worst.take(static_cast<double>(R[i]), c["R"][i / 3][i % 3], 1, "R");
        }
        for (size_t i = 0; i < 3; i++)
        {
            worst.take(static_cast<double>(R[i]), c["S"][i], 1, "S");
        }
    }
    expect_within(worst, TOL_ONE_STEP, "zxz");
}

#ifndef INS_REAL_FLOAT
TEST(thesis, order_of_convergence)
{
    const Motion m = {{0, 1.0, 0.2, 0}, {0, 0.5, 0.3, 0}, {0, 0.3, 0.25, 0}};
    const auto errors_at = [&](double period, size_t steps)
    {
        std::vector<Vec> incs;
        std::vector<Vec> rates;
        for (size_t k = 0; k < steps; k++)
        {
            const double t = static_cast<double>(k) * period;
            incs.push_back(m.increment(t, t + period));
            rates.push_back(m.rate(t));
        }
        rates.push_back(m.rate(static_cast<double>(steps) * period));
        const auto truth = [&](size_t k) { return m.attitude(static_cast<double>(k) * period); };
        return std::pair<double, double>{max_error(run_thesis(truth(0), m.increment(-period, 0), incs), truth),
                                         max_error(run_rk4(FEEDBACK, 2 * period, false, truth(0), rates), truth)};
    };
    const auto coarse = errors_at(0.02, 600);
    const auto fine = errors_at(0.01, 1200);
    EXPECT_NEAR(std::log2(coarse.first / fine.first), 3, 0.3);
    EXPECT_NEAR(std::log2(coarse.second / fine.second), 4, 0.3);
}
#endif

TEST(thesis, update_keeps_the_norm)
{
    ins_thesis_t t;
    ASSERT_EQ(ins_thesis_init(&t, LEVEL), INS_OK);
    for (int k = 0; k < 1000; k++)
    {
        const ins_real theta[3] = {INS_C(0.9), static_cast<ins_real>(k % 3) - 1, INS_C(-0.4)};
        ASSERT_GE(ins_thesis_step(&t, theta), INS_OK);
        ASSERT_NEAR(quat_norm(t.q_nb), 1, TOL_UNIT);
    }
}

TEST(thesis, rk4_feedback_restores_the_norm_as_predicted)
{
    // At rest eps = 1 - |q|^2 decays as exp(-2 k t).
    const ins_real off[4] = {INS_C(1.0008), 0, 0, 0};
    ins_thesis_rk4_t r;
    ASSERT_EQ(ins_thesis_rk4_init(&r, 100, INS_C(0.0018), LEVEL, REST), INS_OK); // the thesis's k, at 1.8 ms
    std::copy(off, off + 4, r.q_nb);
    double before = quat_norm(r.q_nb) - 1;
    for (int k = 0; k < 5; k++)
    {
        ASSERT_EQ(ins_thesis_rk4_step(&r, REST, REST), INS_OK);
        const double now = quat_norm(r.q_nb) - 1;
        EXPECT_NEAR(now / before, std::exp(-2 * 100 * 0.0018), INS_TOL(1e-3, 5e-3));
        before = now;
    }
    // And while turning fast it holds it.
    const ins_real w[3] = {3, -2, 1};
    for (int k = 0; k < 2000; k++)
    {
        ASSERT_EQ(ins_thesis_rk4_step(&r, w, w), INS_OK);
    }
    EXPECT_NEAR(quat_norm(r.q_nb), 1, TOL_FEEDBACK);
}

TEST(thesis, rk4_limit_is_where_it_explodes)
{
    // Just below the limit the norm error shrinks; what is refused would have grown.
    const ins_real h = INS_C(0.01);
    ins_thesis_rk4_t r;
    const ins_real below = INS_C(0.999) * INS_THESIS_RK4_LIMIT / (2 * h);
    ASSERT_EQ(ins_thesis_rk4_init(&r, below, h, LEVEL, REST), INS_OK);
    r.q_nb[0] = INS_C(1.0005);
    for (int k = 0; k < 4000; k++)
    {
        ASSERT_EQ(ins_thesis_rk4_step(&r, REST, REST), INS_OK);
    }
    EXPECT_LT(std::fabs(quat_norm(r.q_nb) - 1), 2e-4);
    r.feedback = INS_C(1.05) * INS_THESIS_RK4_LIMIT / (2 * h);
    r.q_nb[0] = INS_C(1.0005);
    for (int k = 0; k < 100; k++)
    {
        ASSERT_EQ(ins_thesis_rk4_step(&r, REST, REST), INS_OK);
    }
    EXPECT_GT(std::fabs(quat_norm(r.q_nb) - 1), 1e-2);
    const ins_real gimu_s = INS_C(1.0) / 6;
    EXPECT_EQ(ins_thesis_rk4_init(&r, 100, gimu_s, LEVEL, REST), INS_E_RANGE);
    EXPECT_EQ(ins_thesis_rk4_init(&r, INS_THESIS_RK4_LIMIT / (2 * h) * INS_C(1.0001), h, LEVEL, REST), INS_E_RANGE);
}

TEST(thesis, refuses_and_changes_nothing)
{
    const ins_real nan = static_cast<ins_real>(std::nan(""));
    const ins_real inf = static_cast<ins_real>(INFINITY);
    const ins_real long_q[4] = {INS_C(1.002), 0, 0, 0};
    const ins_real nan_q[4] = {1, nan, 0, 0};
    ins_thesis_t t;
    EXPECT_EQ(ins_thesis_init(&t, long_q), INS_E_RANGE);
    EXPECT_EQ(ins_thesis_init(&t, nan_q), INS_E_RANGE);
    const ins_real tilted[4] = {INS_C(0.1), INS_C(-0.7), INS_C(0.5), INS_C(0.5)}; // a unit
    ASSERT_EQ(ins_thesis_init(&t, tilted), INS_OK);
    EXPECT_LT(angle_between(quat(t.q_nb), quat(tilted)), INS_TOL(1e-15, 5e-7));
    ASSERT_EQ(ins_thesis_init(&t, LEVEL), INS_OK);
    ins_thesis_rk4_t r;
    EXPECT_EQ(ins_thesis_rk4_init(&r, 1, INS_C(0.01), long_q, REST), INS_E_RANGE);
    EXPECT_EQ(ins_thesis_rk4_init(&r, -1, INS_C(0.01), LEVEL, REST), INS_E_RANGE);
    EXPECT_EQ(ins_thesis_rk4_init(&r, nan, INS_C(0.01), LEVEL, REST), INS_E_RANGE);
    EXPECT_EQ(ins_thesis_rk4_init(&r, 0, inf, LEVEL, REST), INS_E_RANGE);
    EXPECT_EQ(ins_thesis_rk4_init(&r, 0, 0, LEVEL, REST), INS_E_RANGE);
    for (size_t axis = 0; axis < 3; axis++)
    {
        for (const ins_real bad : {nan, inf, INS_C(400.0)})
        {
            ins_real v[3] = {0, 0, 0};
            v[axis] = bad;
            EXPECT_EQ(ins_thesis_step(&t, v), INS_E_RANGE);
            EXPECT_EQ(ins_thesis_rk4_init(&r, 0, INS_C(0.01), LEVEL, v), INS_E_RANGE);
            ASSERT_EQ(ins_thesis_rk4_init(&r, 0, INS_C(0.01), LEVEL, REST), INS_OK);
            EXPECT_EQ(ins_thesis_rk4_step(&r, v, REST), INS_E_RANGE);
            EXPECT_EQ(ins_thesis_rk4_step(&r, REST, v), INS_E_RANGE);
            EXPECT_EQ(quat(r.q_nb), quat(LEVEL));
        }
    }
    EXPECT_EQ(quat(t.q_nb), quat(LEVEL));
    EXPECT_EQ(t.count, 0);
}
