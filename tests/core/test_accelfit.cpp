/// \file   test_accelfit.cpp
/// \brief  The fit of one accelerometer's eight parameters against the reference file; derivatives; what poses do not show; refusals. SI.
/// SPDX-License-Identifier: MIT
#include "core_test.h"
#include <limits>
using namespace core_test;

namespace
{
constexpr int PASSES_MAX = 8;
const ins_real NOT_A_NUMBER = std::numeric_limits<ins_real>::quiet_NaN();
const double TOL_CLEAN = INS_TOL(1e-10, 2e-5);   // of the parameters; float: readings of 14 m/s^2 are good to 1e-6
const double TOL_NOISY = INS_TOL(1e-7, 2e-5);    // "1e-7 relative"; the file's own minimum is that good
const double TOL_SD_REL = INS_TOL(1e-5, 1e-3);   // of each standard deviation
const double TOL_JACOBIAN = INS_TOL(1e-7, 2e-3); // of its size, by central differences

using Parameters = std::array<double, INS_ACCELFIT_N>;

struct Reference
{
    std::vector<ins_accelfit_motion_t> motions;
    std::vector<json> accelerometers;
    double g;
};

Reference reference()
{
    const json file = load("calib_full.json");
    Reference r;
    r.g = file["g"];
    for (const json& m : file["meas"])
    {
        ins_accelfit_motion_t motion;
        for (size_t i = 0; i < 3; i++)
        {
            motion.f_b[i] = static_cast<ins_real>(r.g * m[i].get<double>());
            motion.w_ib_b[i] = static_cast<ins_real>(m[3 + i].get<double>());
            motion.wd_ib_b[i] = static_cast<ins_real>(m[6 + i].get<double>());
        }
        r.motions.push_back(motion);
    }
    r.accelerometers = file["acc"].get<std::vector<json>>();
    return r;
}

ins_accelfit_t start(const json& a, const char* key)
{
    ins_accelfit_t fit;
    EXPECT_EQ(ins_accelfit_init(&fit, real(a["u0"].get<Vec>()).data(), real(a["e1"].get<Vec>()).data(),
                                real(a["e2"].get<Vec>()).data(), real(a[key].get<Parameters>()).data()),
              INS_OK);
    return fit;
}

void pass(ins_accelfit_t* fit, const Reference& r, const json& readings)
{
    for (size_t k = 0; k < r.motions.size(); k++)
    {
        ASSERT_EQ(ins_accelfit_add(fit, &r.motions[k], static_cast<ins_real>(readings[k].get<double>())), INS_OK);
    }
}

int solve(ins_accelfit_t* fit, const Reference& r, const json& readings)
{
    for (int passes = 1; passes <= PASSES_MAX; passes++)
    {
        pass(fit, r, readings);
        ins_real largest;
        EXPECT_EQ(ins_accelfit_step(fit, &largest), INS_OK);
        if (largest < static_cast<ins_real>(INS_TOL(1e-12, 1e-5)))
        {
            return passes;
        }
    }
    ADD_FAILURE() << "no convergence in " << PASSES_MAX << " passes";
    return PASSES_MAX;
}
} // namespace

TEST(vector_calib_full, reads_as_the_file)
{
    const Reference r = reference();
    Worst worst;
    for (const json& a : r.accelerometers)
    {
        const ins_accelfit_t truth = start(a, "p_true");
        for (size_t k = 0; k < r.motions.size(); k++)
        {
            const double reading = static_cast<double>(ins_accelfit_predict(&truth, &r.motions[k], nullptr));
            worst.take(reading, a["y_clean"][k], 1, "accelerometer " + a["acc"].dump() + " pose " + std::to_string(k));
        }
    }
    expect_within(worst, INS_TOL(1e-13, 1e-5), "readings, m/s^2");
}

TEST(vector_calib_full, least_squares)
{
    const Reference r = reference();
    Worst clean;
    Worst noisy;
    Worst cost;
    Worst deviations;
    int most = 0;
    for (const json& a : r.accelerometers)
    {
        const std::string name = "accelerometer " + a["acc"].dump();
        ins_accelfit_t fit = start(a, "p0");
        most = std::max(most, solve(&fit, r, a["y_clean"]));
        for (size_t i = 0; i < INS_ACCELFIT_N; i++)
        {
            clean.take(static_cast<double>(fit.p[i]), a["p_true"][i], 1, name + " parameter " + std::to_string(i));
        }
        fit = start(a, "p0");
        solve(&fit, r, a["y_noisy"]);
        for (size_t i = 0; i < INS_ACCELFIT_N; i++)
        {
            noisy.take(static_cast<double>(fit.p[i]), a["p_est_noisy"][i], 1, name + " parameter " + std::to_string(i));
        }
        pass(&fit, r, a["y_noisy"]);
        EXPECT_EQ(fit.rows, r.motions.size());
        cost.take(static_cast<double>(fit.residual2), a["cost_noisy"], a["cost_noisy"], name);
        ins_real sd[INS_ACCELFIT_N];
        const ins_real sigma = static_cast<ins_real>(1e-3 * a["p_true"][1].get<double>()); // the file's noise: 1 mm/s^2
        ASSERT_EQ(ins_accelfit_deviation(&fit, sigma, sd), INS_OK);
        for (size_t i = 0; i < INS_ACCELFIT_N; i++)
        {
            const double want = a["sd"][i];
            deviations.take(static_cast<double>(sd[i]), want, want, name + " deviation " + std::to_string(i));
        }
    }
    std::printf("[ figure   ] at most %d passes\n", most);
    expect_within(clean, TOL_CLEAN, "parameters without noise");
    expect_within(noisy, TOL_NOISY, "parameters with noise");
    expect_within(cost, INS_TOL(1e-9, 2e-2), "sum of squared residuals, relative");
    expect_within(deviations, TOL_SD_REL, "standard deviations, relative");
}

TEST(accelfit, jacobian_by_differences)
{
    const Reference r = reference();
    const ins_accelfit_motion_t motion = {{1, -4, 8}, {3, -2, 5}, {20, -30, 10}};
    const ins_real h = static_cast<ins_real>(INS_TOL(1e-6, 1e-3));
    Worst worst;
    for (const json& a : r.accelerometers)
    {
        const ins_accelfit_t fit = start(a, "p_true");
        ins_real jacobian[INS_ACCELFIT_N];
        ins_accelfit_predict(&fit, &motion, jacobian);
        for (size_t i = 0; i < INS_ACCELFIT_N; i++)
        {
            ins_accelfit_t up = fit;
            ins_accelfit_t down = fit;
            up.p[i] += h;
            down.p[i] -= h;
            const double difference = static_cast<double>(
                (ins_accelfit_predict(&up, &motion, nullptr) - ins_accelfit_predict(&down, &motion, nullptr)) /
                (up.p[i] - down.p[i]));
            const double scale = 1 + std::fabs(difference);
            worst.take(static_cast<double>(jacobian[i]), difference, scale, "parameter " + std::to_string(i));
        }
    }
    expect_within(worst, TOL_JACOBIAN, "jacobian");
}

TEST(accelfit, poses_that_do_not_fix_all_eight)
{
    // 18 static attitudes show five; spins about the body's axes leave one combination of place (FORMULAS: rank 7 of 8).
    const Reference r = reference();
    for (const size_t poses : {size_t{18}, size_t{24}})
    {
        for (const json& a : r.accelerometers)
        {
            ins_accelfit_t fit = start(a, "p0");
            for (size_t k = 0; k < poses; k++)
            {
                ASSERT_EQ(ins_accelfit_add(&fit, &r.motions[k], static_cast<ins_real>(a["y_clean"][k].get<double>())),
                          INS_OK);
            }
            const ins_accelfit_t before = fit;
            ins_real largest = -1;
            ins_real sd[INS_ACCELFIT_N];
            EXPECT_EQ(ins_accelfit_step(&fit, &largest), INS_E_STATE) << poses << " poses, " << a["acc"];
            EXPECT_EQ(ins_accelfit_deviation(&fit, 1, sd), INS_E_STATE);
            EXPECT_EQ(largest, -1);
            EXPECT_TRUE(std::equal(fit.p, fit.p + INS_ACCELFIT_N, before.p));
            EXPECT_EQ(fit.rows, before.rows);
        }
    }
}

TEST(accelfit, refuses)
{
    const ins_real x[3] = {1, 0, 0};
    const ins_real y[3] = {0, 1, 0};
    const ins_real z[3] = {0, 0, 1};
    const ins_real zero[3] = {0, 0, 0};
    ins_real p[INS_ACCELFIT_N] = {0, 1, 0, 0, 0, 0, 0, 0};
    ins_accelfit_t fit;
    EXPECT_EQ(ins_accelfit_init(&fit, zero, y, z, p), INS_E_RANGE);
    p[1] = 0;
    EXPECT_EQ(ins_accelfit_init(&fit, x, y, z, p), INS_E_RANGE);
    p[1] = 1;
    for (ins_real& value : p)
    {
        const ins_real good = value;
        value = NOT_A_NUMBER;
        EXPECT_EQ(ins_accelfit_init(&fit, x, y, z, p), INS_E_RANGE);
        value = good;
    }
    ins_real odd[3] = {0, NOT_A_NUMBER, 0};
    EXPECT_EQ(ins_accelfit_init(&fit, odd, y, z, p), INS_E_RANGE);
    EXPECT_EQ(ins_accelfit_init(&fit, x, odd, z, p), INS_E_RANGE);
    EXPECT_EQ(ins_accelfit_init(&fit, x, y, odd, p), INS_E_RANGE);
    ASSERT_EQ(ins_accelfit_init(&fit, x, y, z, p), INS_OK);
    ins_accelfit_motion_t motion = {{INS_C(9.8), 0, 0}, {0, 0, 0}, {0, 0, 0}};
    EXPECT_EQ(ins_accelfit_add(&fit, &motion, NOT_A_NUMBER), INS_E_RANGE);
    for (ins_real* const member : {motion.f_b, motion.w_ib_b, motion.wd_ib_b})
    {
        const ins_real good = member[1];
        member[1] = std::numeric_limits<ins_real>::infinity();
        EXPECT_EQ(ins_accelfit_add(&fit, &motion, 9), INS_E_RANGE);
        member[1] = good;
    }
    // The prediction is finite, its derivative x^2 by k2 is not.
    const ins_real large = INS_C(1e6) * std::sqrt(std::numeric_limits<ins_real>::max());
    ins_accelfit_t steep = fit;
    steep.p[4] = 1 / large;
    const ins_accelfit_motion_t hard = {{large, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    EXPECT_TRUE(std::isfinite(ins_accelfit_predict(&steep, &hard, nullptr)));
    EXPECT_EQ(ins_accelfit_add(&steep, &hard, 9), INS_E_RANGE);
    EXPECT_EQ(steep.rows, 0U);
    EXPECT_EQ(steep.R[0], 0);
    EXPECT_EQ(fit.rows, 0U);
    EXPECT_EQ(fit.R[0], 0);
    ASSERT_EQ(ins_accelfit_add(&fit, &motion, 9), INS_OK);
    EXPECT_EQ(fit.residual2, (9 - INS_C(9.8)) * (9 - INS_C(9.8)));
    ins_real sd[INS_ACCELFIT_N];
    EXPECT_EQ(ins_accelfit_deviation(&fit, -1, sd), INS_E_RANGE);
    EXPECT_EQ(ins_accelfit_deviation(&fit, NOT_A_NUMBER, sd), INS_E_RANGE);
    EXPECT_EQ(ins_accelfit_deviation(&fit, std::numeric_limits<ins_real>::infinity(), sd), INS_E_RANGE);
}
