/// \file   test_sculling.cpp
/// \brief  Sculling against the reference file and the attitude step; the Earth's published numbers. SI, rad.
/// SPDX-License-Identifier: MIT
#include "core_test.h"
#include <cstring>
using namespace core_test;

namespace
{
const double TOL_DV_REL = INS_TOL(1e-12, 3e-7); // of |dv|
const ins_real LEVEL[4] = {1, 0, 0, 0};

ins_increment_t increment_of(const Vec& theta, const Vec& v)
{
    const auto t = real(theta);
    const auto w = real(v);
    return {{t[0], t[1], t[2]}, {w[0], w[1], w[2]}};
}

} // namespace

TEST(vector_sculling, every_row_and_the_mean)
{
    const json file = load("sculling.json");
    const std::vector<std::pair<std::string, int>> forms = {
        {"rot", INS_CONING_ONE}, {"hist1", INS_CONING_HIST1}, {"hist2_opt", INS_CONING_HIST2_OPT}};
    Worst worst;
    for (const json& c : file["cases"])
    {
        for (const auto& [name, form] : forms)
        {
            std::vector<ins_increment_t> all;
            for (const json& p : c["pre"])
            {
                all.push_back(increment_of(p[0].get<Vec>(), p[1].get<Vec>()));
            }
            const size_t before = all.size();
            double mean = 0;
            for (const json& row : c["rows"])
            {
                all.push_back(increment_of(row["theta"].get<Vec>(), row["v"].get<Vec>()));
                ins_real dv[3];
                const size_t n = static_cast<size_t>(ins_coning_samples(form));
                ASSERT_EQ(ins_sculling_dv(form, &all[all.size() - n], dv), INS_OK);
                const Vec want = row[name].get<Vec>();
                for (size_t i = 0; i < 3; i++)
                {
                    worst.take(vec(dv)[i], want[i], norm(want), name);
                }
                mean += (static_cast<double>(dv[0]) - row["true"][0].get<double>());
            }
            mean /= static_cast<double>(all.size() - before) * c["h"].get<double>();
            const double want = c["mean_x_error_mps2"][name];
            EXPECT_NEAR(mean, want, INS_TOL(1e-12 + 1e-6 * std::fabs(want), 2e-7)) << name;
        }
    }
    expect_within(worst, TOL_DV_REL, "sculling dv, relative");
}

TEST(sculling, step_is_the_correction_beside_the_attitude_step)
{
    for (int form = INS_CONING_ONE; form < INS_CONING_BLOCK2; form++)
    {
        ins_sculling_t s;
        ins_attitude_t a;
        ASSERT_EQ(ins_sculling_init(&s, form, LEVEL), INS_OK);
        ASSERT_EQ(ins_attitude_init(&a, form, LEVEL), INS_OK);
        std::vector<ins_increment_t> all;
        for (int k = 0; k < 40; k++)
        {
            // Every eighth is too large for the fast path.
            const double big = k % 8 == 7 ? 0.8 : 0.02;
            all.push_back(increment_of({big * std::sin(k), 0.03 * std::cos(1.7 * k), -0.01 * std::sin(2.3 * k)},
                                       {0.1 * std::cos(k), -0.2 * std::sin(0.9 * k), -0.1}));
            ins_real dv[3];
            ins_real want[3];
            const ins_status_t status = ins_sculling_step(&s, &all.back(), dv);
            EXPECT_EQ(ins_attitude_step(&a, all.back().theta_b), status);
            if (status == INS_S_START)
            {
                continue;
            }
            ASSERT_EQ(status, INS_OK);
            const size_t n = static_cast<size_t>(ins_coning_samples(form));
            ASSERT_EQ(ins_sculling_dv(form, &all[all.size() - n], want), INS_OK);
            for (size_t i = 0; i < 3; i++)
            {
                EXPECT_NEAR(static_cast<double>(dv[i]), static_cast<double>(want[i]), INS_TOL(1e-16, 5e-8)) << form;
            }
            EXPECT_LT(angle_between(quat(s.q_nb), quat(a.q_nb)), INS_TOL(1e-14, 5e-6)) << form << " " << k;
        }
    }
}

TEST(sculling, a_turn_too_large_is_refused_and_changes_nothing)
{
    const ins_increment_t calm = increment_of({1e-3, 2e-3, 1e-3}, {0, 0, -0.098});
    const ins_increment_t turn = increment_of({0, 4, 0}, {0, 0, -0.098});
    ins_sculling_t s;
    ASSERT_EQ(ins_sculling_init(&s, INS_CONING_HIST2_OPT, LEVEL), INS_OK);
    for (int k = 0; k < 4; k++) // the general step first, then the fast one
    {
        const ins_sculling_t before = s;
        ins_real dv[3] = {7, 7, 7};
        EXPECT_EQ(ins_sculling_step(&s, &turn, dv), INS_E_RANGE);
        EXPECT_EQ(dv[0], 7);
        EXPECT_EQ(std::memcmp(&before, &s, sizeof s), 0);
        EXPECT_EQ(ins_sculling_step(&s, &calm, dv), k < 2 ? INS_S_START : INS_OK);
    }
}

/// A rotation in one interval and a force in another meet with the coefficient of two such rotations, in every form.
TEST(sculling, coefficients_are_those_of_coning)
{
    Worst worst;
    for (const Form& f : forms())
    {
        const int n = ins_coning_samples(f.form);
        for (int i = 0; i < n; i++)
        {
            for (int j = 0; j < n; j++)
            {
                ins_increment_t x[INS_CONING_SAMPLES_MAX] = {};
                ins_real theta[3 * INS_CONING_SAMPLES_MAX] = {0};
                ins_real phi[3];
                ins_real dv[3];
                x[i].theta_b[0] = 1;
                x[j].v_b[1] = 1;
                theta[3 * i] = 1;
                theta[3 * j + 1] = 1;
                ASSERT_EQ(ins_coning_phi(f.form, theta, phi), INS_OK);
                ASSERT_EQ(ins_sculling_dv(f.form, x, dv), INS_OK);
                const bool now = ins_coning_is_block(f.form) == 1 || (i == n - 1 && j == n - 1);
                worst.take(static_cast<double>(dv[2]), static_cast<double>(phi[2]) + (now ? 0.5 : 0), 1, f.name);
            }
        }
    }
    expect_within(worst, INS_TOL(1e-15, 1e-7), "sculling coefficients");
}

TEST(sculling, block_form_of_a_constant_turn)
{
    // Rate and force constant in b: dv = theta/|theta|-rotations integrate to v + theta x v / 2 + O(theta^2 v / 6).
    const ins_increment_t one = increment_of({1e-3, 0, 0}, {0, 1, 0});
    const std::vector<ins_increment_t> four(4, one);
    for (const int form : {INS_CONING_BLOCK2, INS_CONING_BLOCK3_FIT, INS_CONING_BLOCK3_OPT, INS_CONING_BLOCK4_OPT})
    {
        ins_real dv[3];
        const int n = ins_coning_samples(form);
        ASSERT_EQ(ins_sculling_dv(form, four.data(), dv), INS_OK);
        EXPECT_NEAR(static_cast<double>(dv[1]), n, 1e-5);
        EXPECT_NEAR(static_cast<double>(dv[2]), n * n * 1e-3 / 2, 1e-8) << form;
    }
    ins_real dv[3];
    EXPECT_EQ(ins_sculling_dv(INS_CONING_FORM_COUNT, four.data(), dv), INS_E_RANGE);
    EXPECT_EQ(ins_sculling_dv(-1, four.data(), dv), INS_E_RANGE);
}

TEST(earth, published_numbers)
{
    // NIMA TR8350.2: gravity on the equator and at the pole; radii a (1 - e^2), a, and a^2 / b twice at the pole.
    EXPECT_NEAR(static_cast<double>(ins_earth_gravity(0, 0)), 9.7803253359, INS_TOL(1e-12, 1e-6));
    EXPECT_NEAR(static_cast<double>(ins_earth_gravity(1, 0)), 9.8321849378, INS_TOL(2e-10, 1e-6));
    ins_real radii[2];
    ins_earth_radii(0, radii);
    EXPECT_NEAR(static_cast<double>(radii[0]), 6335439.3272928, INS_TOL(1e-6, 1));
    EXPECT_NEAR(static_cast<double>(radii[1]), 6378137, INS_TOL(1e-8, 1));
    ins_earth_radii(-1, radii);
    EXPECT_NEAR(static_cast<double>(radii[0]), 6399593.6258, INS_TOL(1e-4, 1));
    EXPECT_NEAR(static_cast<double>(radii[1]), 6399593.6258, INS_TOL(1e-4, 1));
    // Free air: 3.086e-6 per metre.
    const double fall =
        static_cast<double>(ins_earth_gravity(INS_C(0.7071), 0) - ins_earth_gravity(INS_C(0.7071), 1000));
    EXPECT_NEAR(fall, 3.0855e-3, 2e-6);
    ins_real w[3];
    ins_earth_rate(INS_C(0.6), INS_C(0.8), w);
    EXPECT_NEAR(static_cast<double>(w[0]), 0.8 * 7.292115e-5, 1e-11);
    EXPECT_EQ(w[1], 0);
    EXPECT_NEAR(static_cast<double>(w[2]), -0.6 * 7.292115e-5, 1e-11);
    const ins_real v[3] = {100, 200, 0};
    ins_earth_radii(INS_C(0.6), radii);
    ins_earth_transport_rate(INS_C(0.6), INS_C(0.8), 500, v, w);
    EXPECT_NEAR(static_cast<double>(w[0]) * (static_cast<double>(radii[1]) + 500), 200, INS_TOL(1e-9, 1e-4));
    EXPECT_NEAR(static_cast<double>(w[1]) * (static_cast<double>(radii[0]) + 500), -100, INS_TOL(1e-9, 1e-4));
    EXPECT_NEAR(static_cast<double>(w[2]) * (static_cast<double>(radii[1]) + 500), -150, INS_TOL(1e-9, 1e-4));
}
