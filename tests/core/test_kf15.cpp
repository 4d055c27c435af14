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
#endif
