/// \file   test_kalman.cpp
/// \brief  Kalman filter: the reference runs by both forms, single precision against P0/R, gate, refusals, consistency.
/// SPDX-License-Identifier: MIT
#include "kalman_runs.h"
#include <random>
using namespace core_test;

namespace
{
constexpr double TOL_RUN = INS_TOL(1e-12, 3e-5); ///< of an element over the largest of its kind in that step
constexpr double TOL_STEADY = INS_TOL(1e-9, 1e-5);
constexpr double TOL_STEADY_POS_VEL = 1e-5; ///< still converging at the end of the run: 2.4e-6
constexpr double TOL_RMS_M = INS_TOL(1e-9, 2e-4);
constexpr double TOL_FACTOR = INS_TOL(1e-14, 1e-5);
constexpr double TOL_FORMS = INS_TOL(1e-11, 1e-3);

Reals flat(const json& matrix)
{
    Reals r;
    for (const json& row : matrix)
    {
        for (const json& value : row)
        {
            r.push_back(static_cast<ins_real>(value.get<double>()));
        }
    }
    return r;
}

Reals column(const json& list)
{
    Reals r;
    for (const json& value : list)
    {
        r.push_back(static_cast<ins_real>(value.get<double>()));
    }
    return r;
}

/// A filter in either form, with its scratch guarded: a write past INS_KALMAN_WORK or INS_UD_WORK is found by the sanitizers.
double largest(const Reals& r)
{
    double m = 0;
    for (const ins_real v : r)
    {
        m = std::max(m, std::fabs(static_cast<double>(v)));
    }
    return m;
}

void compare(Worst& worst, const Reals& got, const json& want, const std::string& place)
{
    const Reals w = want.front().is_array() ? flat(want) : column(want);
    ASSERT_EQ(got.size(), w.size());
    const double scale = std::max(1e-3, largest(w));
    for (size_t i = 0; i < w.size(); i++)
    {
        worst.take(static_cast<double>(got[i]), static_cast<double>(w[i]), scale, place);
    }
}

/// The file gives P at some steps, its diagonal at all.
void compare_covariance(Worst& worst, const Reals& P, const json& step, const std::string& place)
{
    if (!step["P"].is_null())
    {
        compare(worst, P, step["P"], place);
    }
    compare(worst, {P[0], P[4], P[8]}, step["P_diag"], place);
}

/// One of the file's runs; updates are skipped in [from, to).
void run_pva(bool ud, const json& file, const json& run, const json& steps, size_t from, size_t to)
{
    const std::string what = std::string(ud ? "UD " : "Joseph ") + run["name"].get<std::string>();
    Filter f(ud, column(run["x0"]), flat(run["P0"]));
    const Reals A = flat(file["A"]);
    const Reals Q = flat(file["Q"]);
    Worst state;
    Worst covariance;
    Worst gain;
    Reals K;
    size_t next = 0;
    double squares = 0;
    for (size_t k = 0; k < run["z"].size(); k++)
    {
        f.predict(A, Q);
        for (size_t row = 0; row < run["H"].size() && !(k >= from && k < to); row++)
        {
            const Reals h = column(run["H"][row]);
            const auto z = static_cast<ins_real>(run["z"][k][row].get<double>());
            ins_innovation_t i = {z - f.x[row], static_cast<ins_real>(run["R"][row][row].get<double>()), 0, 0};
            ASSERT_EQ(f.update(h, i, &K), INS_OK);
        }
        squares += std::pow(static_cast<double>(f.x[0]) - file["truth"][k][0].get<double>(), 2);
        if (next < steps.size() && steps[next]["k"].get<size_t>() == k)
        {
            const std::string place = what + " step " + std::to_string(k);
            compare(state, f.x, steps[next]["x"], place);
            compare_covariance(covariance, f.covariance(), steps[next], place);
            if (run["H"].size() == 1 && !steps[next]["K"].is_null() && !(k >= from && k < to))
            {
                Reals want;
                for (const json& r : steps[next]["K"])
                {
                    want.push_back(static_cast<ins_real>(r[0].get<double>()));
                }
                compare(gain, K, json(want), place);
            }
            next++;
        }
    }
    EXPECT_EQ(next, steps.size()) << what;
    expect_within(state, TOL_RUN, what + " x");
    expect_within(covariance, TOL_RUN, what + " P");
    if (gain.checked > 0)
    {
        expect_within(gain, TOL_RUN, what + " K");
    }
    if (from == to)
    {
        EXPECT_NEAR(std::sqrt(squares / static_cast<double>(run["z"].size())), run["rms_pos_err"].get<double>(),
                    TOL_RMS_M);
        Worst steady;
        compare(steady, f.covariance(), run["steady"]["P_plus"], what);
        expect_within(steady, run["H"].size() == 1 ? TOL_STEADY : TOL_STEADY_POS_VEL, what + " steady P");
    }
}

/// A symmetric positive definite matrix M M' + small I.
Reals random_covariance(unsigned n, std::mt19937& random)
{
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<double> M(n * n);
    for (double& m : M)
    {
        m = uniform(random);
    }
    Reals P(n * n);
    for (unsigned i = 0; i < n; i++)
    {
        for (unsigned j = 0; j < n; j++)
        {
            double sum = i == j ? 0.1 : 0;
            for (unsigned k = 0; k < n; k++)
            {
                sum += M[i * n + k] * M[j * n + k];
            }
            P[i * n + j] = static_cast<ins_real>(sum);
        }
    }
    return P;
}
} // namespace

TEST(vector_kalman_pva, joseph_and_ud)
{
    const json file = load("kalman_pva.json");
    ASSERT_EQ(file["runs"].size(), 2u);
    for (const json& run : file["runs"])
    {
        for (const bool ud : {false, true})
        {
            run_pva(ud, file, run, run["steps"], 0, 0);
            run_pva(ud, file, run, run["steps_outage_400_499"], 400, 500);
        }
    }
}

TEST(vector_kalman_pva, pva_module)
{
    const json file = load("kalman_pva.json");
    const auto T = static_cast<ins_real>(file["T"].get<double>());
    for (const json& run : file["runs"])
    {
        const Reals P0 = flat(run["P0"]);
        const ins_real var[3] = {P0[0], P0[4], P0[8]};
        ins_pva_t f;
        ASSERT_EQ(ins_pva_init(&f, var), INS_OK);
        Worst worst;
        size_t next = 0;
        for (size_t k = 0; k < run["z"].size(); k++)
        {
            ASSERT_EQ(ins_pva_predict(&f, T, static_cast<ins_real>(file["q"].get<double>())), INS_OK);
            for (size_t row = 0; row < run["H"].size(); row++)
            {
                const auto z = static_cast<ins_real>(run["z"][k][row].get<double>());
                ins_innovation_t i = {z - f.x[row], static_cast<ins_real>(run["R"][row][row].get<double>()), 0, 0};
                ASSERT_EQ(ins_pva_update(&f, static_cast<int>(row), &i), INS_OK);
            }
            if (next < run["steps"].size() && run["steps"][next]["k"].get<size_t>() == k)
            {
                compare(worst, Reals(f.x, f.x + 3), run["steps"][next]["x"], "x " + std::to_string(k));
                compare_covariance(worst, Reals(f.P, f.P + 9), run["steps"][next], "P " + std::to_string(k));
                next++;
            }
        }
        expect_within(worst, TOL_RUN, "pva " + run["name"].get<std::string>());
        if (run["H"].size() == 1)
        {
            compare(worst, Reals(f.K, f.K + 3),
                    json({run["steady"]["K"][0][0], run["steady"]["K"][1][0], run["steady"]["K"][2][0]}), "K");
            expect_within(worst, TOL_STEADY, "pva steady gain");
        }
    }
}

TEST(kalman, joseph_and_ud_against_p0_over_r)
{
    struct Case
    {
        double r, p0, joseph,
            ud; ///< bounds of the largest relative gain error; 1e9: no bound. At 1e16 the reference itself has 1e-7
    };
    const Case cases[] = {{1e-2, 1e6, INS_TOL(1e-9, 5e-3), INS_TOL(1e-12, 1e-5)},
                          {1e-4, 1e8, INS_TOL(1e-5, 1e9), INS_TOL(1e-10, 2e-6)},
                          {1e-6, 1e10, INS_TOL(1e-1, 1e9), INS_TOL(1e-6, 1e-5)}};
    for (const Case& c : cases)
    {
        const double joseph = gain_error(false, c.r, c.p0);
        const double ud = gain_error(true, c.r, c.p0);
        std::printf("[ figure   ] P0/R %.0e: gain error conventional %.1e, Joseph %.1e, UD %.1e\n", c.p0 / c.r,
                    gain_error(false, c.r, c.p0, true), joseph, ud);
        EXPECT_LE(ud, c.ud);
        if (c.joseph < 1)
        {
            EXPECT_LE(joseph, c.joseph);
        }
        EXPECT_LT(ud, joseph);
    }
}

TEST(kalman, both_forms_agree_on_random_systems)
{
    const unsigned seed = 20061;
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Worst worst;
    for (unsigned n = 1; n <= 15; n++)
    {
        const Reals P0 = random_covariance(n, random);
        Filter joseph(false, Reals(n, 1), P0);
        Filter ud(true, Reals(n, 1), P0);
        for (int k = 0; k < 20; k++)
        {
            Reals Phi(n * n);
            Reals h(n);
            for (unsigned i = 0; i < n * n; i++)
            {
                Phi[i] = static_cast<ins_real>(uniform(random) / n + (i % (n + 1) == 0 ? 0.7 : 0));
            }
            for (ins_real& e : h)
            {
                e = static_cast<ins_real>(uniform(random));
            }
            const Reals Q = random_covariance(n, random);
            joseph.predict(Phi, Q);
            ud.predict(Phi, Q);
            ins_innovation_t a = {static_cast<ins_real>(uniform(random)), INS_C(0.5), 0, 0};
            ins_innovation_t b = a;
            ASSERT_EQ(joseph.update(h, a), INS_OK);
            ASSERT_EQ(ud.update(h, b), INS_OK);
            worst.take(static_cast<double>(a.nis), static_cast<double>(b.nis), 1, "nis");
            const Reals P = joseph.P;
            const Reals R = ud.covariance();
            for (unsigned i = 0; i < n * n; i++)
            {
                worst.take(static_cast<double>(R[i]), static_cast<double>(P[i]), largest(P), "P");
                EXPECT_EQ(P[i], P[(i % n) * n + i / n]) << "P is symmetric to the last bit";
            }
            for (unsigned i = 0; i < n; i++)
            {
                worst.take(static_cast<double>(ud.x[i]), static_cast<double>(joseph.x[i]), 1, "x");
            }
        }
    }
    expect_within(worst, TOL_FORMS, "UD against Joseph, 1 to 15 states");
}

TEST(kalman, factors_multiply_back_and_indefinite_is_refused)
{
    std::mt19937 random(7);
    Worst worst;
    for (unsigned n = 1; n <= 8; n++)
    {
        const Reals P = random_covariance(n, random);
        Reals UD(INS_UD_SIZE(n));
        Reals work(n * n);
        ASSERT_EQ(ins_ud_factor(n, P.data(), UD.data(), work.data()), INS_OK);
        Reals back(n * n);
        ins_ud_covariance(n, UD.data(), back.data());
        for (unsigned i = 0; i < n * n; i++)
        {
            worst.take(static_cast<double>(back[i]), static_cast<double>(P[i]), largest(P), "n " + std::to_string(n));
        }
    }
    expect_within(worst, TOL_FACTOR, "U D U'");

    Reals UD = {5, 5, 5};
    Reals work(4);
    const Reals semidefinite = {4, 2, 2, 1};
    EXPECT_EQ(ins_ud_factor(2, semidefinite.data(), UD.data(), work.data()), INS_OK);
    EXPECT_EQ(UD, (Reals{0, 2, 1}));
    const Reals zero = {0, 0, 0, 3};
    EXPECT_EQ(ins_ud_factor(2, zero.data(), UD.data(), work.data()), INS_OK);
    EXPECT_EQ(UD, (Reals{0, 0, 3}));
    const Reals known = {3, 0, 0, 0};
    EXPECT_EQ(ins_ud_factor(2, known.data(), UD.data(), work.data()), INS_OK);
    EXPECT_EQ(UD, (Reals{3, 0, 0}));
    EXPECT_EQ(ins_ud_factor(2, zero.data(), UD.data(), work.data()), INS_OK);
    // Element 1 is element 2's but for a rounding in its product with element 0, or with 1 of 4: no variance is left, and no factor.
    const auto r = static_cast<ins_real>(INS_TOL(0x1p-30, 0x1p-13));
    const Reals rounded = {2, 1 + r, 1, 1 + r, 1, 1, 1, 1, 1};
    Reals UD3(INS_UD_SIZE(3));
    Reals work3(9);
    EXPECT_EQ(ins_ud_factor(3, rounded.data(), UD3.data(), work3.data()), INS_OK);
    EXPECT_EQ(UD3, (Reals{1, 0, 0, 1, 1, 1}));
    const Reals beside = {1, 0, 0, 0, 0, 2, 1 + r, 1, 0, 1 + r, 1, 1, 0, 1, 1, 1};
    Reals UD4(INS_UD_SIZE(4));
    Reals work4(16);
    EXPECT_EQ(ins_ud_factor(4, beside.data(), UD4.data(), work4.data()), INS_OK);
    EXPECT_EQ(UD4, (Reals{1, 0, 1, 0, 0, 0, 0, 1, 1, 1}));
    const ins_real nan = std::numeric_limits<ins_real>::quiet_NaN();
    const ins_real inf = std::numeric_limits<ins_real>::infinity();
    for (const Reals& bad : {Reals{1, 2, 2, 1}, Reals{-1, 0, 0, 1}, Reals{1, 0, 0, -1}, Reals{1, 1, 1, 0},
                             Reals{1, 0, 0, nan}, Reals{nan, 0, 0, 1}, Reals{1, nan, nan, 1}, Reals{inf, 0, 0, 1}})
    {
        EXPECT_EQ(ins_ud_factor(2, bad.data(), UD.data(), work.data()), INS_E_RANGE);
        EXPECT_EQ(UD, (Reals{0, 0, 3})) << "a refused factorisation leaves UD alone";
    }
}

TEST(kalman, the_gate_refuses_and_reports)
{
    const ins_real nan = std::numeric_limits<ins_real>::quiet_NaN();
    const ins_real inf = std::numeric_limits<ins_real>::infinity();
    for (const bool ud : {false, true})
    {
        Filter f(ud, {1, 2}, {3, 0, 0, 2});
        const Reals before_x = f.x;
        const Reals before_P = f.covariance();
        const auto unchanged = [&] { return f.x == before_x && f.covariance() == before_P; };
        ins_innovation_t z = {4, 1, INS_C(3.99), 0}; // nis = 16 / (3 + 1) = 4
        EXPECT_EQ(f.update({1, 0}, z), INS_E_GATE);
        EXPECT_EQ(z.nis, 4);
        EXPECT_TRUE(unchanged());
        for (const ins_real bad_r : {INS_C(0.0), INS_C(-1.0), nan})
        {
            ins_innovation_t bad = {4, bad_r, 0, 0};
            EXPECT_EQ(f.update({1, 0}, bad), INS_E_RANGE);
        }
        for (const ins_real bad_v : {nan, inf, -inf})
        {
            ins_innovation_t bad = {bad_v, 1, 0, 0};
            EXPECT_EQ(f.update({1, 0}, bad), INS_E_RANGE);
        }
        ins_innovation_t bad = {0, 1, 0, 0};
        EXPECT_EQ(f.update({nan, 0}, bad), INS_E_RANGE);
        EXPECT_TRUE(unchanged());
        z.gate = 4; // on the boundary is inside
        EXPECT_EQ(f.update({1, 0}, z), INS_OK);
        EXPECT_NEAR(static_cast<double>(f.x[0]), 1 + 0.75 * 4, 1e-6);
        EXPECT_NEAR(static_cast<double>(f.covariance()[0]), 0.75, 1e-6);
        EXPECT_EQ(f.x[1], 2);
    }
    Filter indefinite(false, {0, 0}, {1, 0, 0, 1});
    indefinite.P = {-3, 0, 0, 1};
    ins_innovation_t z = {1, 1, 0, 0};
    EXPECT_EQ(indefinite.update({1, 0}, z), INS_E_RANGE);
}

TEST(kalman, predict_leaves_the_callers_x_alone_when_it_is_not_given)
{
    const Reals Phi = {1, 1, 0, 1};
    const Reals Q = {0, 0, 0, 1};
    Filter a(false, {1, 2}, {1, 0, 0, 1});
    Filter b(true, {1, 2}, {1, 0, 0, 1});
    Reals work(INS_UD_WORK(2));
    ins_kalman_predict(2, nullptr, a.P.data(), Phi.data(), Q.data(), work.data());
    Reals Q_ud = {0, 0, 1};
    ins_ud_predict(2, nullptr, b.UD.data(), Phi.data(), Q_ud.data(), work.data());
    EXPECT_EQ(a.P, (Reals{2, 1, 1, 2}));
    for (size_t i = 0; i < 4; i++)
    {
        EXPECT_NEAR(static_cast<double>(b.covariance()[i]), static_cast<double>(a.P[i]), 1e-6);
    }
}

TEST(kalman, a_state_known_exactly_stays_known_without_noise)
{
    const Reals still = {0, 0, 0, 0};
    for (const Reals& Phi : {Reals{1, 5, 0, 1}, Reals{1, 0, 2, 0}, Reals{0, 1, 1, 0}, Reals{0, 2, 0, 1}})
    {
        Filter a(false, {1, 2}, {3, 0, 0, 0});
        Filter b(true, {1, 2}, {3, 0, 0, 0});
        a.predict(Phi, still);
        b.predict(Phi, still);
        EXPECT_EQ(b.x, a.x);
        EXPECT_EQ(b.covariance(), a.P) << "small integers: nothing rounds";
        EXPECT_EQ(a.P[0], 3 * Phi[0] * Phi[0]);
        EXPECT_EQ(a.P[1], 3 * Phi[0] * Phi[2]);
        EXPECT_EQ(a.P[3], 3 * Phi[2] * Phi[2]);
    }
}

TEST(kalman, nis_of_a_consistent_filter_averages_one)
{
    const unsigned seed = 1969;
    const int steps = 4000;
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    double x = normal(random);
    const double phi = 0.9;
    const double q = 0.3;
    const double r = 0.5;
    Filter f(true, {0}, {1});
    double sum = 0;
    int outside = 0;
    for (int k = 0; k < steps; k++)
    {
        x = phi * x + std::sqrt(q) * normal(random);
        f.predict({static_cast<ins_real>(phi)}, {static_cast<ins_real>(q)});
        const auto measured = static_cast<ins_real>(x + std::sqrt(r) * normal(random));
        ins_innovation_t z = {measured - f.x[0], static_cast<ins_real>(r), 0, 0};
        ASSERT_EQ(f.update({1}, z), INS_OK);
        sum += static_cast<double>(z.nis);
        outside += z.nis > INS_KALMAN_GATE_99;
    }
    EXPECT_NEAR(sum / steps, 1, 5 * std::sqrt(2.0 / steps));
    EXPECT_NEAR(outside, 0.01 * steps, 5 * std::sqrt(0.01 * steps));
}

TEST(pva, refusals)
{
    const ins_real nan = std::numeric_limits<ins_real>::quiet_NaN();
    ins_pva_t f;
    const ins_real var[3] = {1, 1, 1};
    ASSERT_EQ(ins_pva_init(&f, var), INS_OK);
    for (int i = 0; i < 3; i++)
    {
        for (const ins_real bad : {INS_C(-1.0), nan})
        {
            ins_real wrong[3] = {1, 1, 1};
            wrong[i] = bad;
            EXPECT_EQ(ins_pva_init(&f, wrong), INS_E_RANGE);
        }
    }
    for (const ins_real k : f.K)
    {
        EXPECT_EQ(k, 0) << "no update yet";
    }
    EXPECT_EQ(ins_pva_predict(&f, -1, 1), INS_E_RANGE);
    EXPECT_EQ(ins_pva_predict(&f, nan, 1), INS_E_RANGE);
    EXPECT_EQ(ins_pva_predict(&f, 1, -1), INS_E_RANGE);
    ins_innovation_t z = {1, 1, 0, 0};
    EXPECT_EQ(ins_pva_update(&f, -1, &z), INS_E_RANGE);
    EXPECT_EQ(ins_pva_update(&f, 3, &z), INS_E_RANGE);
    z.v = 100;
    z.gate = INS_KALMAN_GATE_999;
    EXPECT_EQ(ins_pva_update(&f, INS_PVA_ACCELERATION, &z), INS_E_GATE);
    EXPECT_EQ(f.x[2], 0);
    EXPECT_EQ(f.P[8], 1);
}
