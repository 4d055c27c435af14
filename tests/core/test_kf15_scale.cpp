/// \file   test_kf15_scale.cpp
/// \brief  Scale factors beside the 15-error covariance: against a dense filter of 21, and against two strapdowns. SI, rad.
/// SPDX-License-Identifier: MIT
#include "ins/kf15_scale.h"
#include "kf15_runs.h"
#include <cstring>
#include <limits>

using namespace core_test;

namespace
{
constexpr size_t N21 = INS_KF15_N + INS_KF15_SCALE_N;
constexpr ins_real SIGMA_G = ins_real(0.01), SIGMA_A = ins_real(0.02), TAU_G = 200, TAU_A = 500;
constexpr ins_kf15_scale_sensors_t SENSORS = {SIGMA_G, SIGMA_A, TAU_G, TAU_A};
constexpr double TOL_DENSE = INS_TOL(1e-11, 3e-4); ///< of the standard deviations
constexpr double TOL_GAIN = INS_TOL(1e-10, 2e-3);
using Dense21 = DenseFilter<N21>;
using Row21 = std::array<ins_real, N21>;

struct Scaled
{
    ins_kf15_t f;
    ins_kf15_scale_t s;

    explicit Scaled(const Row15& sigma, const ins_kf15_scale_sensors_t& sensors = SENSORS)
    {
        EXPECT_EQ(ins_kf15_init(&f, sigma.data()), INS_OK);
        EXPECT_EQ(ins_kf15_scale_init(&s, &sensors), INS_OK);
    }
    void propagate(const ins_kf15_model_t& m, const ins_increment_t& x)
    {
        ins_kf15_scale_propagate(&s, &f, &m, x.theta_b, x.v_b);
    }
    ins_status_t update(const Row21& h, ins_innovation_t& z)
    {
        return ins_kf15_scale_update(&s, &f, h.data(), h.data() + INS_KF15_N, &z);
    }
    ins_real at(size_t i, size_t j) const
    {
        return j >= INS_KF15_N   ? s.B[INS_KF15_SCALE_N * i + j - INS_KF15_N]
               : i >= INS_KF15_N ? s.B[INS_KF15_SCALE_N * j + i - INS_KF15_N]
                                 : f.P[INS_KF15_ROW * i + j];
    }
    decltype(Dense21::P) covariance() const
    {
        decltype(Dense21::P) P;
        for (size_t i = 0; i < N21 * N21; i++)
        {
            P[i / N21][i % N21] = static_cast<long double>(at(i / N21, i % N21));
        }
        return P;
    }
};

/// Of all 21, from the strapdown's attitude and the increment alone.
void propagate(Dense21& dense, const ins_kf15_model_t& m, const ins_strapdown_t& at, const ins_increment_t& x)
{
    ins_real Phi[N15 * N15];
    ins_real C[9];
    ins_kf15_transition(&m, Phi);
    ins_quat_to_dcm(at.sculling.q_nb, C);
    const long double phi_g = 1 - static_cast<long double>(m.dt) / static_cast<long double>(TAU_G);
    const long double phi_a = 1 - static_cast<long double>(m.dt) / static_cast<long double>(TAU_A);
    dense.congruence(
        [&](size_t i, size_t j) -> long double
        {
            if (i < N15 && j < N15)
            {
                return static_cast<long double>(Phi[i * N15 + j]);
            }
            const bool gyro = j < N15 + 3;
            if (i >= N15 || i >= INS_KF15_P || gyro != (i < INS_KF15_V))
            {
                return i == j ? (gyro ? phi_g : phi_a) : 0;
            }
            const size_t axis = (j - N15) % 3;
            return -static_cast<long double>(C[3 * (i % 3) + axis]) *
                   static_cast<long double>(gyro ? x.theta_b[axis] : x.v_b[axis]);
        });
    dense.add_noise(m);
    for (size_t i = 0; i < 3; i++)
    {
        dense.P[N15 + i][N15 + i] +=
            static_cast<long double>(SIGMA_G) * static_cast<long double>(SIGMA_G) * (1 - phi_g * phi_g);
        dense.P[N15 + 3 + i][N15 + 3 + i] +=
            static_cast<long double>(SIGMA_A) * static_cast<long double>(SIGMA_A) * (1 - phi_a * phi_a);
    }
}

Row21 fix_row(long k, size_t i, const ins_increment_t& x)
{
    Row21 h = {};
    if (k % 2 == 0)
    {
        h[INS_KF15_P + i] = 1;
        return h;
    }
    // A velocity with a lever arm: biases, and the scale factors that are felt like them.
    h[INS_KF15_V + i] = 1;
    h[(i + 1) % 3] = ins_real(0.2);
    for (size_t axis = 0; axis < 3; axis++)
    {
        h[INS_KF15_BG + axis] = ins_real(0.3) * static_cast<ins_real>(axis + i);
        h[N15 + axis] = h[INS_KF15_BG + axis] * x.theta_b[axis] / static_cast<ins_real>(PERIOD_S);
        h[N15 + 3 + axis] = ins_real(0.01) * static_cast<ins_real>(axis);
    }
    return h;
}

TEST(kf15_scale, is_the_dense_filter_of_21)
{
    Scaled scaled(sigmas());
    Dense21 dense;
    dense.P = scaled.covariance();
    ins_strapdown_t strapdown = start_of_drive();
    ins_kf15_model_t m = start_of_model();
    double gain = 0;
    for (long k = 0; k < 600; k++)
    {
        const ins_increment_t x = drive(k);
        ASSERT_GE(ins_strapdown_step(&strapdown, &x), INS_OK);
        ins_kf15_model(&m, &strapdown, x.v_b);
        scaled.propagate(m, x);
        propagate(dense, m, strapdown, x);
        for (size_t i = 0; k % 50 == 49 && i < 3; i++)
        {
            const Row21 h = fix_row(k / 50, i, x);
            ins_innovation_t z = {1, ins_real(k < 300 ? 0.01 : 1e-4), 0, 0};
            ASSERT_EQ(scaled.update(h, z), INS_OK);
            dense.update(h, static_cast<double>(z.r));
            for (size_t j = 0; j < N21; j++)
            {
                const long double K = static_cast<long double>(j < N15 ? scaled.f.K[j] : scaled.s.K[j - N15]);
                gain = larger(gain, static_cast<double>(std::fabs(K - dense.K[j]) *
                                                        std::sqrt(static_cast<long double>(z.r) / dense.P[j][j])));
            }
        }
    }
    const double worst = distance(scaled.covariance(), dense.P);
    std::printf("[ figure   ] beside the dense filter: covariance within %.1e, gains within %.1e sigma\n", worst, gain);
    EXPECT_LE(worst, TOL_DENSE);
    EXPECT_LE(gain, TOL_GAIN);
    EXPECT_LT(static_cast<double>(scaled.at(N15 + 2, N15 + 2)), 0.9 * static_cast<double>(SIGMA_G * SIGMA_G));
    for (size_t i = 0; i < N21; i++)
    {
        for (size_t j = 0; j < i; j++)
        {
            EXPECT_EQ(scaled.at(i, j), scaled.at(j, i)) << i << ' ' << j;
        }
        EXPECT_EQ(i < N15 ? scaled.f.P[i * INS_KF15_ROW + N15] : 0, 0) << "padding of row " << i;
    }
}

TEST(kf15_scale, of_nothing_is_the_filter_of_15)
{
    Scaled scaled(sigmas(), {0, 0, 100, 100});
    ins_kf15_t plain = scaled.f;
    ins_strapdown_t strapdown = start_of_drive();
    ins_kf15_model_t m = start_of_model();
    for (long k = 0; k < 500; k++)
    {
        const ins_increment_t x = drive(k);
        ASSERT_GE(ins_strapdown_step(&strapdown, &x), INS_OK);
        ins_kf15_model(&m, &strapdown, x.v_b);
        scaled.propagate(m, x);
        ins_kf15_propagate(&plain, &m);
        if (k == 300)
        {
            Row21 h = {};
            h[INS_KF15_P] = 1;
            ins_innovation_t z = {1, 1, 0, 0}, also = z;
            ASSERT_EQ(scaled.update(h, z), INS_OK);
            ASSERT_EQ(ins_kf15_update(&plain, h.data(), &also), INS_OK);
            EXPECT_EQ(z.nis, also.nis);
        }
    }
    EXPECT_EQ(std::memcmp(scaled.f.P, plain.P, sizeof plain.P), 0);
    EXPECT_TRUE(std::all_of(std::begin(scaled.s.B), std::end(scaled.s.B), [](ins_real b) { return b == 0; }));
}

TEST(kf15_scale, refuses_what_is_out_of_range_and_changes_nothing)
{
    constexpr ins_real nan = std::numeric_limits<ins_real>::quiet_NaN();
    Scaled scaled(sigmas());
    const Scaled before = scaled;
    const ins_kf15_scale_sensors_t bad[] = {{ins_real(0.11), 0, 100, 100}, {0, ins_real(0.11), 100, 100},
                                            {-SIGMA_G, 0, 100, 100},       {nan, 0, 100, 100},
                                            {0, 0, ins_real(0.5), 100},    {0, 0, 100, nan}};
    for (const ins_kf15_scale_sensors_t& sensors : bad)
    {
        EXPECT_EQ(ins_kf15_scale_init(&scaled.s, &sensors), INS_E_RANGE);
    }
    Row21 h = {};
    h[INS_KF15_V] = 1;
    h[N15] = 1;
    ins_innovation_t far = {100, ins_real(0.01), INS_KALMAN_GATE_99, 0};
    EXPECT_EQ(scaled.update(h, far), INS_E_GATE);
    EXPECT_GT(far.nis, INS_KALMAN_GATE_99);
    ins_innovation_t none = {1, 0, 0, 0}, lost = {nan, 1, 0, 0}, fine = {1, 1, 0, 0};
    EXPECT_EQ(scaled.update(h, none), INS_E_RANGE);
    EXPECT_EQ(scaled.update(h, lost), INS_E_RANGE);
    h[N15] = nan;
    EXPECT_EQ(scaled.update(h, fine), INS_E_RANGE);
    EXPECT_EQ(std::memcmp(&scaled, &before, sizeof before), 0);
}

TEST(kf15_scale, stays_a_covariance_over_fixes_and_outages)
{
    const long steps = std::getenv("INS_BENCH") != nullptr ? 360000 : 12000;
    Scaled scaled(sigmas(1000));
    ins_strapdown_t strapdown = start_of_drive();
    ins_kf15_model_t m = start_of_model();
    for (long k = 0; k < steps; k++)
    {
        const ins_increment_t x = drive(k);
        ASSERT_GE(ins_strapdown_step(&strapdown, &x), INS_OK);
        ins_kf15_model(&m, &strapdown, x.v_b);
        scaled.propagate(m, x);
        const bool outage = k % 3000 > 2000;
        for (size_t i = 0; k % 20 == 19 && !outage && i < 3; i++)
        {
            Row21 h = fix_row(0, i, x);
            ins_innovation_t z = {0, ins_real(1e-4), 0, 0};
            ASSERT_EQ(scaled.update(h, z), INS_OK);
            h = fix_row(1, i, x);
            ASSERT_EQ(scaled.update(h, z), INS_OK) << k;
        }
        if (k % 500 == 499)
        {
            ASSERT_GT(smallest_pivot(scaled.covariance()), 0) << k;
        }
    }
}

#ifndef INS_REAL_FLOAT // the differences of two drives drown in the rounding of float
TEST(kf15_scale, model_is_the_strapdowns_derivative)
{
    const long steps = 3000;
    const double size = 1e-6;
    Worst worst[2];
    for (size_t column = 0; column < INS_KF15_SCALE_N; column++)
    {
        // What P says of an error in this scale factor alone: its column of B over its variance.
        ins_kf15_scale_sensors_t sensors = {column < 3 ? size : 0, column < 3 ? 0 : size, 1e12, 1e12};
        Scaled scaled({}, sensors);
        for (size_t k = 0; k < INS_KF15_SCALE_N; k++)
        {
            scaled.s.B[(N15 + k) * INS_KF15_SCALE_N + k] *= k == column ? 1 : 0;
        }
        scaled.s.sensors = {0, 0, 1e12, 1e12};
        ins_strapdown_t estimate = start_of_drive(), truth = estimate;
        ins_kf15_model_t m = start_of_model();
        double largest[2] = {0, 0};
        std::array<double, 6> e = {};
        for (long k = 0; k < steps; k++)
        {
            const ins_increment_t x = drive(k);
            ins_increment_t without = x;
            double* const of = column < 3 ? without.theta_b : without.v_b;
            of[column % 3] -= of[column % 3] * size;
            ins_kf15_model(&m, &estimate, x.v_b);
            scaled.propagate(m, x);
            ASSERT_GE(ins_strapdown_step(&estimate, &x), INS_OK);
            ASSERT_GE(ins_strapdown_step(&truth, &without), INS_OK);
            for (size_t i = 0; i < 6; i++)
            {
                e[i] = scaled.s.B[i * INS_KF15_SCALE_N + column] / size;
                largest[i / 3] = std::max(largest[i / 3], std::fabs(e[i]));
            }
        }
        const Vec attitude = rotation_between(quat(truth.sculling.q_nb), quat(estimate.sculling.q_nb));
        for (size_t i = 0; i < 3; i++)
        {
            const std::string place = "scale factor " + std::to_string(column) + " axis " + std::to_string(i);
            worst[0].take(attitude[i], e[i], largest[0] > 0 ? largest[0] : size, place);
            worst[1].take(truth.v_n[i] - estimate.v_n[i], e[3 + i], largest[1], place);
        }
    }
    expect_within(worst[0], 3e-3, "attitude error by scale factors");
    expect_within(worst[1], 3e-3, "velocity error by scale factors");
}
#endif
} // namespace
