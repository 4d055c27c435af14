/// \file   test_sixacc.cpp
/// \brief  Six accelerometers and their calibration against the reference files; other geometries; refusals. SI.
/// SPDX-License-Identifier: MIT
#include "core_test.h"
#include <limits>
#include <random>
using namespace core_test;

namespace
{
const double TOL_REL = INS_TOL(1e-12, 1e-6); // of the largest reading, m/s^2, and of it over the arm
const ins_real NOT_A_NUMBER = std::numeric_limits<ins_real>::quiet_NaN();

Vec cross(const Vec& a, const Vec& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// What accelerometer a reads.
ins_real reading(const ins_accel_t& a, const Vec& f, const Vec& w, const Vec& wd)
{
    const Vec r = vec(a.r);
    const Vec tangential = cross(wd, r);
    const Vec radial = cross(w, cross(w, r));
    double sum = static_cast<double>(a.bias);
    for (size_t i = 0; i < 3; i++)
    {
        sum += static_cast<double>(a.axis[i]) * (f[i] + tangential[i] + radial[i]);
    }
    return static_cast<ins_real>(sum);
}

/// Eight accelerometers with scale factors, misalignments and biases.
std::vector<ins_accel_t> eight()
{
    std::vector<ins_accel_t> list;
    for (int j = 0; j < 8; j++)
    {
        const double x = j;
        const auto u = real(Vec{(1 + 0.1 * x) * std::cos(2.1 * x), 2 * std::sin(1.3 * x + 1), std::cos(0.7 * x * x)});
        const auto r = real(Vec{0.2 * std::sin(3.1 * x), 0.15 * std::cos(1.9 * x), 0.1 * std::sin(x * x)});
        list.push_back({static_cast<ins_real>(0.1 * x - 0.3), {u[0], u[1], u[2]}, {r[0], r[1], r[2]}});
    }
    return list;
}
} // namespace

TEST(vector_sixacc, angular_acceleration_and_specific_force)
{
    const json file = load("sixacc.json");
    Worst angular;
    Worst force;
    Worst resolved;
    for (const json& c : file["cases"])
    {
        const double rho = c["rho"];
        const Vec G = c["G_nav"].get<Vec>();
        ins_accel_t accels[6];
        ins_sixacc_paper(static_cast<ins_real>(rho), accels);
        for (size_t j = 0; j < 6; j++)
        {
            for (size_t i = 0; i < 3; i++)
            {
                EXPECT_NEAR(static_cast<double>(accels[j].axis[i]), file["axis"][j][i].get<double>(), 1e-7);
                EXPECT_NEAR(static_cast<double>(accels[j].r[i]), rho * file["pos_unit"][j][i].get<double>(), 1e-7);
            }
        }
        ins_sixacc_t s;
        ASSERT_EQ(ins_sixacc_init(&s, 6, accels, INS_C(0.02)), INS_OK);
        for (const json& row : c["rows"])
        {
            const auto f = row["f"].get<std::vector<double>>();
            ins_real readings[6];
            double largest = 0;
            for (size_t j = 0; j < 6; j++)
            {
                readings[j] = static_cast<ins_real>(f[j]);
                largest = std::max(largest, std::fabs(f[j]));
            }
            ins_real wd[3];
            ins_real f_b[3];
            ins_real a[3];
            ins_sixacc_resolve(&s, readings, real(row["w"].get<Vec>()).data(), wd, f_b);
            // Gravity is added where the vertical is known: in n, after resolving.
            ins_quat_rotate(real(row["q"].get<Quat>()).data(), f_b, a);
            for (size_t i = 0; i < 3; i++)
            {
                angular.take(vec(wd)[i], row["wd"][i], largest / rho, "wd");
                force.take(vec(f_b)[i], row["f_centre"][i], largest, "f");
                resolved.take(vec(a)[i] + G[i], row["a"][i], largest, "a");
            }
        }
    }
    expect_within(angular, TOL_REL, "angular acceleration, relative");
    expect_within(force, TOL_REL, "specific force, relative");
    expect_within(resolved, TOL_REL, "acceleration in n, relative");
}

TEST(vector_calib_linear, maps_from_the_readings)
{
    const json file = load("calib_linear.json");
    Worst worst;
    for (const json& c : file["cases"])
    {
        const json& attitudes = file["attitudes"][c["group"].get<std::string>()];
        ins_linfit_t fit;
        ASSERT_EQ(ins_linfit_init(&fit, 3), INS_OK);
        ins_real map[4];
        for (size_t k = 0; k < attitudes.size(); k++)
        {
            Vec f = attitudes[k].get<Vec>();
            const double g = c["g"];
            // At rest the specific force points up; the file's rows are up in b, of unit length.
            const Vec up = {f[0] * g, f[1] * g, f[2] * g};
            ins_real readings[3];
            for (size_t j = 0; j < 3; j++)
            {
                readings[j] = static_cast<ins_real>(c["P"][j][k].get<double>() / c["T"].get<double>());
            }
            ASSERT_EQ(ins_linfit_add(&fit, real(up).data(), readings), INS_OK);
            if (k < 3)
            {
                EXPECT_EQ(ins_linfit_solve(&fit, 0, map), INS_E_STATE) << "four unknowns from " << k + 1;
            }
        }
        for (unsigned j = 0; j < 3; j++)
        {
            ASSERT_EQ(ins_linfit_solve(&fit, j, map), INS_OK);
            for (size_t i = 0; i < 3; i++)
            {
                worst.take(static_cast<double>(map[i + 1]), c["true_map"][j][i], 1, "axis");
            }
            const double bias = c["true"]["bias"][j].get<double>() * c["true"]["SF"][j].get<double>();
            worst.take(static_cast<double>(map[0]), bias, 1, "bias");
            EXPECT_LT(static_cast<double>(fit.residual2[j]), INS_TOL(1e-24, 1e-9)) << "the map is exact";
        }
    }
    expect_within(worst, INS_TOL(1e-12, 2e-6), "linear map");
}

TEST(linfit, residual_is_that_of_the_map)
{
    const unsigned seed = 34;
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    ins_linfit_t fit;
    ASSERT_EQ(ins_linfit_init(&fit, 2), INS_OK);
    std::vector<std::array<ins_real, 5>> rows; // f_b, readings
    for (int k = 0; k < 40; k++)
    {
        std::array<ins_real, 5> row;
        for (ins_real& x : row)
        {
            x = static_cast<ins_real>(uniform(random));
        }
        ASSERT_EQ(ins_linfit_add(&fit, row.data(), row.data() + 3), INS_OK);
        rows.push_back(row);
    }
    for (unsigned j = 0; j < 2; j++)
    {
        ins_real map[4];
        ASSERT_EQ(ins_linfit_solve(&fit, j, map), INS_OK);
        double sum = 0;
        for (const auto& row : rows)
        {
            double rest = static_cast<double>(row[3 + j]) - static_cast<double>(map[0]);
            for (size_t i = 0; i < 3; i++)
            {
                rest -= static_cast<double>(map[i + 1]) * static_cast<double>(row[i]);
            }
            sum += rest * rest;
        }
        EXPECT_NEAR(static_cast<double>(fit.residual2[j]), sum, sum * INS_TOL(1e-13, 1e-5)) << j;
        EXPECT_GT(sum, 1) << "noise alone";
    }
}

TEST(sixacc, any_geometry_scale_and_misalignment)
{
    const auto accels = eight();
    ins_sixacc_t s;
    ASSERT_EQ(ins_sixacc_init(&s, 8, accels.data(), INS_C(0.01)), INS_OK);
    const Vec f = {1, -2, 9};
    const Vec w = {0.5, -1.5, 2};
    const Vec wd = {3, -4, 1};
    ins_real readings[8];
    for (size_t j = 0; j < 8; j++)
    {
        readings[j] = reading(accels[j], f, w, wd);
    }
    ins_real got_wd[3];
    ins_real got_f[3];
    ins_sixacc_resolve(&s, readings, real(w).data(), got_wd, got_f);
    for (size_t i = 0; i < 3; i++)
    {
        EXPECT_NEAR(static_cast<double>(got_wd[i]), wd[i], INS_TOL(1e-12, 1e-4)) << i;
        EXPECT_NEAR(static_cast<double>(got_f[i]), f[i], INS_TOL(1e-12, 1e-4)) << i;
    }
}

TEST(sixacc, rate_integration_is_second_order)
{
    // w = sines, f constant: rate by trapezoid, increments by Hermite's cubic. Eight accelerometers, where wd holds products of w.
    const auto accels = eight();
    const auto rate = [](double t) { return Vec{std::sin(3 * t), 0.5 * std::cos(2 * t), std::sin(t + 1)}; };
    const auto acceleration = [](double t) { return Vec{3 * std::cos(3 * t), -std::sin(2 * t), std::cos(t + 1)}; };
    const auto angle = [](double t) { return Vec{-std::cos(3 * t) / 3, 0.25 * std::sin(2 * t), -std::cos(t + 1)}; };
    const Vec f = {1, -2, 9};
    double last = 0;
    for (const int hz : {50, 100, 200})
    {
        const double T = 1.0 / hz;
        ins_sixacc_t s;
        ASSERT_EQ(ins_sixacc_init(&s, 8, accels.data(), static_cast<ins_real>(T)), INS_OK);
        std::copy_n(real(rate(0)).data(), 3, s.w_ib_b);
        double worst_w = 0;
        double worst_v = 0;
        double worst_angle = 0;
        Vec sum = {0, 0, 0};
        for (int k = 0; k <= 2 * hz; k++)
        {
            ins_real readings[8];
            for (size_t j = 0; j < 8; j++)
            {
                readings[j] = reading(accels[j], f, rate(k * T), acceleration(k * T));
            }
            ins_increment_t x;
            ASSERT_EQ(ins_sixacc_step(&s, readings, &x), k ? INS_OK : INS_S_START);
            for (size_t i = 0; i < 3; i++)
            {
                worst_w = larger(worst_w, std::fabs(static_cast<double>(s.w_ib_b[i]) - rate(k * T)[i]));
                sum[i] += static_cast<double>(x.theta_b[i]);
                worst_angle = larger(worst_angle, std::fabs(sum[i] - (angle(k * T)[i] - angle(0)[i])));
                if (k)
                {
                    worst_v = larger(worst_v, std::fabs(static_cast<double>(x.v_b[i]) / T - f[i]));
                }
            }
        }
        std::printf("[ figure   ] %d Hz, 2 s: rate %.1e rad/s, angle %.1e rad, specific force %.1e m/s^2\n", hz,
                    worst_w, worst_angle, worst_v);
        EXPECT_LT(worst_w, 10 * T * T + INS_TOL(0, 1e-4));
        EXPECT_LT(worst_angle, 15 * T * T + INS_TOL(0, 2e-4));
        EXPECT_LT(worst_v, 20 * T * T + INS_TOL(0, 1e-3));
        if (last > 0)
        {
            EXPECT_GT(last / worst_w, INS_TOL(3.5, 3.0)) << hz;
        }
        last = worst_w;
    }
}

TEST(sixacc, a_quadratic_term_is_taken_out_of_a_reading)
{
    const ins_accel_t a = {ins_real(0.3), {ins_real(1.2), ins_real(-1.6), 0}, {0, 0, 0}}; // of length 2
    for (const double k2 : {-2e-3, -1e-5, 0.0, 1e-5, 2e-3})
    {
        for (double x = -60.0; x <= 60.0; x += 7.5)
        {
            const auto reading = ins_real(0.3 + 2.0 * (x + k2 * x * x));
            EXPECT_NEAR(double(ins_accel_linear(&a, ins_real(k2), reading)), 0.3 + 2.0 * x, INS_TOL(1e-13, 5e-5))
                << "k2 " << k2 << ", x " << x;
        }
    }
    const double turn = 0.3 + 2.0 * -500.0; // of x = -1 / (2 k2), whose reading is -250
    EXPECT_NEAR(double(ins_accel_linear(&a, ins_real(1e-3), ins_real(0.3 - 2.0 * 250.0))), turn, INS_TOL(1e-3, 2));
}

TEST(sixacc, refuses)
{
    auto accels = eight();
    ins_sixacc_t s;
    EXPECT_EQ(ins_sixacc_init(&s, 5, accels.data(), INS_C(0.01)), INS_E_RANGE);
    EXPECT_EQ(ins_sixacc_init(&s, INS_SIXACC_MAX + 1, accels.data(), INS_C(0.01)), INS_E_RANGE);
    EXPECT_EQ(ins_sixacc_init(&s, 8, accels.data(), 0), INS_E_RANGE);
    EXPECT_EQ(ins_sixacc_init(&s, 8, accels.data(), NOT_A_NUMBER), INS_E_RANGE);
    EXPECT_EQ(ins_sixacc_init(&s, 8, accels.data(), std::numeric_limits<ins_real>::infinity()), INS_E_RANGE);
    ins_accel_t together[6];
    ins_sixacc_paper(0, together); // all in one place: no angular acceleration is seen
    EXPECT_EQ(ins_sixacc_init(&s, 6, together, INS_C(0.01)), INS_E_RANGE);
    ins_sixacc_paper(INS_C(0.1), together);
    ins_accel_t twice[6];
    std::copy_n(together, 6, twice);
    twice[5] = twice[0];
    EXPECT_EQ(ins_sixacc_init(&s, 6, twice, INS_C(0.01)), INS_E_RANGE);
    accels[3].bias = NOT_A_NUMBER;
    EXPECT_EQ(ins_sixacc_init(&s, 8, accels.data(), INS_C(0.01)), INS_E_RANGE);
    using limits = std::numeric_limits<ins_real>;
    for (const ins_real bad :
         {NOT_A_NUMBER, limits::infinity(), -limits::infinity(), limits::max()}) // or its square is infinite
    {
        for (size_t i = 0; i < 3; i++)
        {
            accels = eight();
            accels[3].axis[i] = bad;
            EXPECT_EQ(ins_sixacc_init(&s, 8, accels.data(), INS_C(0.01)), INS_E_RANGE);
        }
    }
    accels = eight();
    accels[3].r[1] = limits::infinity();
    EXPECT_EQ(ins_sixacc_init(&s, 8, accels.data(), INS_C(0.01)), INS_E_RANGE);
    ASSERT_EQ(ins_sixacc_init(&s, 6, together, INS_C(0.01)), INS_OK);
    ins_increment_t x;
    ins_real readings[6] = {1, 2, 3, 4, 5, 6};
    ASSERT_EQ(ins_sixacc_step(&s, readings, &x), INS_S_START);
    const ins_sixacc_t before = s;
    for (ins_real& r : readings)
    {
        const ins_real good = r;
        r = NOT_A_NUMBER;
        EXPECT_EQ(ins_sixacc_step(&s, readings, &x), INS_E_RANGE);
        r = good;
    }
    for (size_t i = 0; i < 6; i++)
    {
        EXPECT_EQ(s.linear[i], before.linear[i]);
    }
    // Finite readings whose specific force is not; the long arm keeps the angular acceleration small.
    ins_accel_t far[6];
    ins_sixacc_paper(100, far);
    ASSERT_EQ(ins_sixacc_init(&s, 6, far, INS_C(0.01)), INS_OK);
    const auto along_x = [&](ins_real scale)
    {
        ins_real r[6];
        for (size_t j = 0; j < 6; j++)
        {
            r[j] = far[j].axis[0] > 0 ? scale : far[j].axis[0] < 0 ? -scale : 0;
        }
        return ins_sixacc_step(&s, r, &x);
    };
    const ins_real largest = std::numeric_limits<ins_real>::max();
    EXPECT_EQ(along_x(largest), INS_E_RANGE);
    EXPECT_EQ(s.started, 0);
    EXPECT_EQ(along_x(largest / 2), INS_S_START);
    EXPECT_NEAR(static_cast<double>(s.linear[3] / largest), std::sqrt(0.5), TOL_REL);
    EXPECT_LT(std::fabs(static_cast<double>(s.linear[0] / largest)), TOL_REL);
    ins_linfit_t fit;
    ins_real map[4];
    EXPECT_EQ(ins_linfit_init(&fit, 0), INS_E_RANGE);
    EXPECT_EQ(ins_linfit_init(&fit, INS_SIXACC_MAX + 1), INS_E_RANGE);
    ASSERT_EQ(ins_linfit_init(&fit, 6), INS_OK);
    const ins_real odd[3] = {0, NOT_A_NUMBER, 0};
    const ins_real fine[3] = {0, 0, INS_C(9.8)};
    EXPECT_EQ(ins_linfit_add(&fit, odd, readings), INS_E_RANGE);
    readings[5] = NOT_A_NUMBER;
    EXPECT_EQ(ins_linfit_add(&fit, fine, readings), INS_E_RANGE);
    EXPECT_EQ(fit.R[0], 0);
    EXPECT_EQ(ins_linfit_solve(&fit, 6, map), INS_E_RANGE);
    EXPECT_EQ(ins_linfit_solve(&fit, 0, map), INS_E_STATE);
}
