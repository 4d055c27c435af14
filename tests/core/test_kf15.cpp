/// \file   test_kf15.cpp
/// \brief  The 15-error covariance against dense long double, and its model against the strapdown itself. Frames: b -> n (NED). SI, rad.
/// SPDX-License-Identifier: MIT
#include "kf15_runs.h"
#include <limits>

using namespace core_test;

namespace
{
const double TOL_P = INS_TOL(1e-13, 3e-5); ///< of the standard deviations
const double TOL_MODEL = 2e-3; ///< of the largest error of its kind: first order in dt, and the terms left out
const double LEAST_PHI = 1e-6; ///< kinds that have no error at first are compared with this [rad]
const double LEAST_V = 1e-3;   ///< [m/s]
const double TOL_K = INS_TOL(1e-12, 1e-4); ///< of the largest element of its kind

/// Rows as a GNSS antenna 1.5 m ahead, 0.5 m right and 2 m above the IMU gives them at yaw 0: position north, velocity east.
Row15 antenna_north()
{
    Row15 h = {};
    h[INS_KF15_P] = 1;
    h[1] = -2;
    h[2] = ins_real(-0.5);
    return h;
}
Row15 antenna_velocity_east()
{
    Row15 h = {};
    h[INS_KF15_V + 1] = 1;
    h[0] = ins_real(0.3);
    h[2] = ins_real(-0.1);
    h[INS_KF15_BG + 0] = ins_real(-2);
    h[INS_KF15_BG + 2] = ins_real(1.5);
    return h;
}
} // namespace

template <typename Form> class Kf15 : public testing::Test
{
  protected:
    Kf15() { EXPECT_EQ(form.init(sigmas()), INS_OK); }
    /// One step of the drive; the reference's too, if there is one.
    void step(long k, Reference* reference = nullptr)
    {
        const ins_increment_t x = drive(k);
        ASSERT_GE(ins_strapdown_step(&strapdown, &x), INS_OK);
        ins_kf15_model(&model, &strapdown, x.v_b);
        form.propagate(model);
        if (reference)
        {
            reference->propagate(model);
        }
    }
    Form form;
    ins_strapdown_t strapdown = start_of_drive();
    ins_kf15_model_t model = start_of_model();
};
using Forms = testing::Types<Symmetric, Factors>;
TYPED_TEST_SUITE(Kf15, Forms, );

TYPED_TEST(Kf15, follows_the_dense_filter)
{
    const long steps = 400;
    const long between = 20;
    Reference want(sigmas());
    Worst covariances;
    Worst gains;
    for (long k = 0; k < steps; k++)
    {
        this->step(k, &want);
        const unsigned turn = static_cast<unsigned>(k / between) % 8;
        if (k % between == between - 1)
        {
            const double r = 0.04;
            ins_innovation_t z = {1, static_cast<ins_real>(r), 0, 0};
            Row15 h = {};
            if (turn < 6)
            {
                h[INS_KF15_V + turn] = 1;
                ASSERT_EQ(this->form.update_state(INS_KF15_V + turn, z), INS_OK);
            }
            else
            {
                h = turn == 6 ? antenna_north() : antenna_velocity_east();
                ASSERT_EQ(this->form.update(h, z), INS_OK);
            }
            want.update(h, static_cast<double>(z.r));
            for (size_t i = 0; i < N15; i++)
            {
                const double scale = std::sqrt(static_cast<double>(want.P[i][i]) / r);
                gains.take(static_cast<double>(this->form.f.K[i]), static_cast<double>(want.K[i]), scale,
                           std::to_string(k));
            }
        }
        covariances.take(distance(covariance(this->form), want.P), 0, 1, std::to_string(k));
    }
    expect_within(covariances, TOL_P, "P");
    expect_within(gains, TOL_K, "K");
}

TYPED_TEST(Kf15, is_symmetric_to_the_last_bit)
{
    for (long k = 0; k < 300; k++)
    {
        this->step(k);
        ins_innovation_t z = {0, 1, 0, 0};
        ASSERT_EQ(this->form.update(k % 2 ? antenna_north() : antenna_velocity_east(), z), INS_OK);
        ASSERT_EQ(this->form.update_state(static_cast<unsigned>(k) % N15, z), INS_OK);
        const auto P = this->form.packed();
        for (size_t i = 0; i < N15; i++)
        {
            for (size_t j = 0; j < N15; j++)
            {
                ASSERT_EQ(P[i * INS_KF15_ROW + j], P[j * INS_KF15_ROW + i]) << k << " " << i << " " << j;
            }
            ASSERT_EQ(P[i * INS_KF15_ROW + N15], 0);
        }
    }
}

TYPED_TEST(Kf15, stays_a_covariance)
{
    const long steps = std::getenv("INS_BENCH") ? 360000 : 12000; // an hour, two minutes
    const long fix = 25;
    const long looked_at = 1000;
    double least = 1;
    ASSERT_EQ(this->form.init(sigmas(100)), INS_OK); // and fixes of a centimetre: P0/R = 1e8
    for (long k = 0; k < steps; k++)
    {
        this->step(k);
        const bool outage = k % 6000 > 3000;
        for (unsigned i = 0; i < 3 && k % fix == 0 && !outage; i++)
        {
            ins_innovation_t position = {0, ins_real(1e-4), 0, 0};
            ins_innovation_t velocity = {0, ins_real(4e-4), 0, 0};
            Row15 h = i == 0 ? antenna_north() : Row15{};
            h[INS_KF15_P + i] = 1;
            ASSERT_EQ(this->form.update(h, position), INS_OK) << k;
            ASSERT_EQ(this->form.update_state(INS_KF15_V + i, velocity), INS_OK) << k;
        }
        if (k % looked_at < 2)
        {
            least = std::min(least, smallest_pivot(covariance(this->form)));
            ASSERT_GT(least, 0) << k;
        }
    }
    std::printf("[ figure   ] smallest pivot of the correlation matrix %.1e\n", least);
}

TYPED_TEST(Kf15, refuses)
{
    const ins_real nan = std::numeric_limits<ins_real>::quiet_NaN();
    const ins_real inf = std::numeric_limits<ins_real>::infinity();
    for (const ins_real bad : {ins_real(-1), nan, inf})
    {
        Row15 sigma = sigmas();
        sigma[14] = bad;
        EXPECT_EQ(this->form.init(sigma), INS_E_RANGE);
    }
    this->step(0);
    const auto before = this->form.packed();
    const auto gain = this->form.f.K[INS_KF15_P];
    const auto unchanged = [&] { return this->form.packed() == before && this->form.f.K[INS_KF15_P] == gain; };
    Row15 h = antenna_north();
    ins_innovation_t z = {100, 1, INS_KALMAN_GATE_99, 0};
    EXPECT_EQ(this->form.update_state(INS_KF15_P, z), INS_E_GATE);
    EXPECT_NEAR(static_cast<double>(z.nis), 1e4 / 101, 0.1);
    EXPECT_EQ(this->form.update(h, z), INS_E_GATE);
    z.v = 0;
    EXPECT_EQ(this->form.update_state(N15, z), INS_E_RANGE);
    for (const ins_real bad : {ins_real(0), ins_real(-1), nan})
    {
        ins_innovation_t wrong = {0, bad, 0, 0};
        EXPECT_EQ(this->form.update_state(INS_KF15_P, wrong), INS_E_RANGE);
        EXPECT_EQ(this->form.update(h, wrong), INS_E_RANGE);
    }
    for (const ins_real bad : {nan, inf})
    {
        ins_innovation_t wrong = {bad, 1, 0, 0};
        EXPECT_EQ(this->form.update_state(INS_KF15_P, wrong), INS_E_RANGE);
        h[3] = bad;
        EXPECT_EQ(this->form.update(h, z), INS_E_RANGE);
    }
    EXPECT_TRUE(unchanged());
}

TYPED_TEST(Kf15, a_row_of_zeros_says_nothing)
{
    const auto before = this->form.packed();
    ins_innovation_t z = {1, 1, 0, 0};
    EXPECT_EQ(this->form.update(Row15{}, z), INS_OK);
    EXPECT_EQ(z.nis, 1);
    EXPECT_EQ(this->form.packed(), before);
    EXPECT_EQ(this->form.f.K[0], 0);
}

TYPED_TEST(Kf15, what_is_certain_stays_certain)
{
    ASSERT_EQ(this->form.init(Row15{}), INS_OK);
    ins_kf15_sensors_t none = {0, 0, 0, 300, 0, 300};
    ASSERT_EQ(ins_kf15_model_init(&this->model, ins_real(PERIOD_S), &none), INS_OK);
    this->step(0);
    ins_innovation_t z = {1, 1, 0, 0};
    EXPECT_EQ(this->form.update(antenna_north(), z), INS_OK);
    EXPECT_EQ(this->form.update_state(4, z), INS_OK);
    for (const ins_real p : this->form.packed())
    {
        EXPECT_EQ(p, 0);
    }
}

/// Largest error of the gain of a position on itself, over that gain, after the third of 40 fixes of 20 Hz. North is an antenna's.
template <typename Form> double gain_error_of(double p0, double r)
{
    Form form;
    ins_kf15_model_t model = start_of_model();
    ins_strapdown_t s = start_of_drive();
    Row15 sigma = sigmas(std::sqrt(p0));
    EXPECT_EQ(form.init(sigma), INS_OK);
    Reference want(sigma);
    double worst = 0;
    for (long k = 0; k < 200; k++)
    {
        const ins_increment_t x = drive(k);
        EXPECT_GE(ins_strapdown_step(&s, &x), INS_OK);
        ins_kf15_model(&model, &s, x.v_b);
        form.propagate(model);
        want.propagate(model);
        for (unsigned i = INS_KF15_P; i < INS_KF15_P + 3 && k % 5 == 4; i++)
        {
            ins_innovation_t z = {0, static_cast<ins_real>(r), 0, 0};
            Row15 h = i == INS_KF15_P ? antenna_north() : Row15{};
            h[i] = 1;
            if ((i == INS_KF15_P ? form.update(h, z) : form.update_state(i, z)) != INS_OK)
            {
                return INFINITY;
            }
            want.update(h, static_cast<double>(z.r));
            const long double error = (static_cast<long double>(form.f.K[i]) - want.K[i]) / want.K[i];
            worst = k > 15 ? larger(worst, std::fabs(static_cast<double>(error))) : worst;
        }
    }
    return worst;
}

TEST(kf15, gain_error_over_p0_over_r)
{
    struct Case
    {
        double p0, r, symmetric, factors; ///< bounds of the relative gain error; 1e9: none
    };
    const Case cases[] = {{1e2, 1e-4, INS_TOL(1e-11, 2e-3), INS_TOL(1e-12, 2e-4)},
                          {1e4, 1e-4, INS_TOL(1e-11, 2e-3), INS_TOL(1e-12, 2e-4)},
                          {1e8, 1e-4, INS_TOL(1e-11, 2e-3), INS_TOL(1e-12, 2e-4)}};
    for (const Case& c : cases)
    {
        const double conventional = gain_error_of<Conventional>(c.p0, c.r);
        const double symmetric = gain_error_of<Symmetric>(c.p0, c.r);
        const double factors = gain_error_of<Factors>(c.p0, c.r);
        std::printf("[ figure   ] P0/R %.0e: gain error conventional %.1e, symmetric %.1e, UD %.1e\n", c.p0 / c.r,
                    conventional, symmetric, factors);
        EXPECT_LE(factors, c.factors);
        EXPECT_TRUE(symmetric <= c.symmetric || c.symmetric >= 1e9);
    }
}

#ifndef INS_REAL_FLOAT // the differences of two drives drown in the rounding of float
TEST(kf15, model_is_the_strapdowns_derivative)
{
    const long steps = 3000;
    // Small enough to be linear.
    const double size[5] = {1e-6, 1e-4, 1, 1e-7, 1e-5};
    std::array<ins_real, N15 * N15> Phi;
    Worst worst[3];
    for (size_t column = 0; column < N15; column++)
    {
        ins_strapdown_t estimate = start_of_drive();
        ins_strapdown_t truth = estimate;
        std::array<double, N15> e = {};
        e[column] = size[column / 3];
        const ins_real phi[3] = {e[0], e[1], e[2]};
        ins_real turn[4];
        ASSERT_EQ(ins_quat_from_rotvec(phi, turn), INS_OK);
        ins_quat_mul(turn, truth.sculling.q_nb, truth.sculling.q_nb);
        ins_real radii[2];
        ins_earth_radii(std::sin(LATITUDE), radii);
        const double height = truth.position.anchor[2];
        truth.position.offset[0] += e[6] / (radii[0] + height);
        truth.position.offset[1] += e[7] / ((radii[1] + height) * std::cos(LATITUDE));
        truth.position.offset[2] -= e[8];
        for (size_t i = 0; i < 3; i++)
        {
            truth.v_n[i] += e[3 + i];
        }
        ins_kf15_model_t m = start_of_model();
        double scale[3] = {0, 0, 0};
        for (long k = 0; k < steps; k++)
        {
            const ins_increment_t x = drive(k);
            ins_increment_t without = x;
            for (size_t i = 0; i < 3; i++)
            {
                without.theta_b[i] -= e[9 + i] * PERIOD_S;
                without.v_b[i] -= e[12 + i] * PERIOD_S;
            }
            ins_kf15_model(&m, &estimate, x.v_b); // the middle of the step, but for a turn of half an increment
            ASSERT_GE(ins_strapdown_step(&estimate, &x), INS_OK);
            ASSERT_GE(ins_strapdown_step(&truth, &without), INS_OK);
            ins_kf15_transition(&m, Phi.data());
            std::array<double, N15> next = {};
            for (size_t i = 0; i < N15 * N15; i++)
            {
                next[i / N15] += Phi[i] * e[i % N15];
            }
            for (size_t i = 9; i < N15; i++)
            {
                next[i] = e[i]; // a constant bias
            }
            e = next;
            for (size_t i = 0; i < 9; i++)
            {
                scale[i / 3] = std::max(scale[i / 3], std::fabs(e[i]));
            }
        }
        const Vec attitude = rotation_between(quat(truth.sculling.q_nb), quat(estimate.sculling.q_nb));
        ins_real position[3];
        ins_position_difference(&estimate.position, &truth.position, position);
        for (size_t i = 0; i < 3; i++)
        {
            const std::string place = "error " + std::to_string(column) + " axis " + std::to_string(i);
            worst[0].take(attitude[i], e[i], std::max(scale[0], LEAST_PHI), place);
            worst[1].take(truth.v_n[i] - estimate.v_n[i], e[3 + i], std::max(scale[1], LEAST_V), place);
            worst[2].take(position[i], e[6 + i], scale[2], place);
        }
    }
    expect_within(worst[0], TOL_MODEL, "attitude error");
    expect_within(worst[1], TOL_MODEL, "velocity error");
    expect_within(worst[2], TOL_MODEL, "position error");
}

/// The small terms, which a drive hides: one step at 250 m/s, from half an error on either side of the estimate.
TEST(kf15, model_has_the_strapdowns_earth)
{
    const double half = 0.05;             // m/s, and 1000 times as many m
    const double least[2] = {1e-9, 3e-8}; // of attitude and of velocity by an error of 1 m/s; height has 2 g/R dt
    const ins_real v[3] = {200, -150, 20};
    const ins_increment_t x = drive(0);
    Worst worst[2];
    for (size_t column = 3; column < 9; column += column == 5 ? 3 : 1)
    {
        const bool height = column == 8;
        ins_strapdown_t at = start_of_drive();
        std::copy(v, v + 3, at.v_n);
        ins_strapdown_t low = at;
        ins_strapdown_t high = at;
        (height ? low.position.offset[2] : low.v_n[column - 3]) += height ? 1000 * half : -half;
        (height ? high.position.offset[2] : high.v_n[column - 3]) -= height ? 1000 * half : -half;
        ins_kf15_model_t m = start_of_model();
        ins_kf15_model(&m, &at, x.v_b);
        ins_real Phi[N15 * N15];
        ins_kf15_transition(&m, Phi);
        ASSERT_GE(ins_strapdown_step(&low, &x), INS_OK);
        ASSERT_GE(ins_strapdown_step(&high, &x), INS_OK);
        const double error = 2 * half * (height ? 1000 : 1);
        const Vec phi = rotation_between(quat(high.sculling.q_nb), quat(low.sculling.q_nb));
        for (size_t i = 0; i < 3; i++)
        {
            const std::string place = "error " + std::to_string(column) + " axis " + std::to_string(i);
            const double dv = high.v_n[i] - low.v_n[i] - (column == 3 + i ? error : 0);
            const double change = Phi[(3 + i) * N15 + column] - (column == 3 + i);
            worst[0].take(phi[i] / error, height ? 0 : Phi[i * N15 + column], least[0], place);
            worst[1].take(dv / error, change, least[1], place);
        }
    }
    expect_within(worst[0], 1e-2, "attitude by one step");
    expect_within(worst[1], 1e-2, "velocity by one step");
}
#endif
