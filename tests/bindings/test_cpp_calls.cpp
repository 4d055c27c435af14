/// \file   test_cpp_calls.cpp
/// \brief  The C++ headers bit for bit against the C calls, and what they refuse. SI, rad.
/// SPDX-License-Identifier: MIT
#include "ins/ins.hpp"
#include <algorithm>
#include <gtest/gtest.h>
#include <limits>

namespace
{
const double TOL = INS_TOL(1e-12, 4e-7);
using Columns = Eigen::Matrix<ins_real, 3, Eigen::Dynamic>;
using Attitudes = Eigen::Matrix<ins_real, 4, Eigen::Dynamic>;
const ins::Quaternion LEVEL = ins::Quaternion::Identity();

ins::Vector3 wobble(int k)
{
    return ins::Vector3(std::sin(INS_C(0.1) * static_cast<ins_real>(k)), INS_C(0.7), INS_C(-0.3)) * INS_C(0.02);
}
} // namespace

TEST(cpp, sculling_skew_and_six_accelerometers_have_the_bits_of_c)
{
    ins::Sculling s;
    ins::Skew skew;
    ins::SixAcc<> six;
    const ins::Vector3 delay(0, INS_C(0.002), INS_C(0.004));
    ins_accel_t accels[6];
    ins_sixacc_paper(INS_C(0.1), accels);
    ASSERT_EQ(s.init(INS_CONING_HIST2_OPT, LEVEL), ins::Status::Ok);
    ASSERT_EQ(skew.init(2, delay, INS_C(0.02)), ins::Status::Ok);
    ASSERT_EQ(six.init(accels, INS_C(0.02)), ins::Status::Ok);
    EXPECT_EQ(ins::accel_linear(accels[0], INS_C(0.001), 3), ins_accel_linear(&accels[0], INS_C(0.001), 3));
    ins_sculling_t c_s = s.raw;
    ins_skew_t c_skew = skew.raw;
    ins_sixacc_t c_six = six.raw;
    for (int k = 0; k < 20; k++)
    {
        const ins::Increment x{wobble(k), wobble(k + 3)};
        const ins_increment_t c_x = x.raw();
        ins::Vector3 want;
        const auto dv = s.step(x);
        EXPECT_EQ(static_cast<int>(dv.status), ins_sculling_step(&c_s, &c_x, want.data()));
        EXPECT_EQ(dv.value, want);
        const auto level = skew.add(wobble(k));
        EXPECT_EQ(static_cast<int>(level.status), ins_skew_add(&c_skew, wobble(k).data(), want.data()));
        EXPECT_EQ(level.value, want);
        ins::Vector<6> readings;
        readings << wobble(k), wobble(k + 5);
        ins_increment_t c_increment;
        const auto increment = six.step(readings);
        EXPECT_EQ(static_cast<int>(increment.status), ins_sixacc_step(&c_six, readings.data(), &c_increment));
        EXPECT_EQ(increment.value.theta_b, ins::Vector3(c_increment.theta_b));
        EXPECT_EQ(increment.value.v_b, ins::Vector3(c_increment.v_b));
    }
    EXPECT_EQ(s.q_nb().coeffs(), ins::Quaternion(c_s.q_nb[0], c_s.q_nb[1], c_s.q_nb[2], c_s.q_nb[3]).coeffs());
    EXPECT_EQ(six.w_ib_b(), ins::Vector3(c_six.w_ib_b));
    ins::Vector3 rate;
    ins_earth_rate(INS_C(0.6), INS_C(0.8), rate.data());
    EXPECT_EQ(ins::earth_rate(INS_C(0.6), INS_C(0.8)), rate);
    const ins::Vector3 v(10, 20, 0);
    ins_earth_transport_rate(INS_C(0.6), INS_C(0.8), 100, v.data(), rate.data());
    EXPECT_EQ(ins::earth_transport_rate(INS_C(0.6), INS_C(0.8), 100, v), rate);
}

TEST(cpp, strapdown_and_batch_have_the_bits_of_c)
{
    const ins::Position start(ins::Vector3(INS_C(0.4), INS_C(2.1), 100));
    ins::Strapdown s;
    ASSERT_EQ(s.init(INS_CONING_HIST2_OPT, INS_C(0.01), LEVEL, {1, 2, 0}, start), ins::Status::Ok);
    ins_strapdown_t c = s.raw;
    Columns theta(3, 50);
    Columns v(3, 50);
    for (int k = 0; k < 50; k++)
    {
        theta.col(k) = wobble(k);
        v.col(k) = ins::Vector3(0, INS_C(0.01), INS_C(-0.098)) + wobble(k);
        const ins_increment_t x = ins::Increment{theta.col(k), v.col(k)}.raw();
        ASSERT_GE(ins_strapdown_step(&c, &x), 0);
    }
    ASSERT_EQ(s.run(theta, v).value, 50);
    EXPECT_EQ(s.v_n(), ins::Vector3(c.v_n));
    EXPECT_EQ(s.position().offset, ins::Vector3(c.position.offset));
    const ins_position_t from = start.raw();
    ins::Vector3 want;
    ins_position_difference(&from, &c.position, want.data());
    EXPECT_EQ(start.ned_to(s.position()), want);
    const ins::Vector3 arm(1, 2, 3);
    const ins::Vector3 w(INS_C(0.1), 0, 2);
    ins_position_t place;
    ins_strapdown_point(&c, arm.data(), w.data(), want.data(), &place);
    const auto point = s.point(arm, w);
    EXPECT_EQ(point.v_n, want);
    EXPECT_EQ(point.position.offset, ins::Vector3(place.offset));

    Eigen::Matrix<ins_real, Eigen::Dynamic, INS_BATCH_ROWS> state(3, +INS_BATCH_ROWS);
    Eigen::Matrix<ins_real, Eigen::Dynamic, 4> q0(3, 4);
    q0.setZero();
    q0.col(0).setOnes();
    ins::Batch batch;
    ins::Attitude single[3];
    ASSERT_EQ(batch.init(state, q0), ins::Status::Ok);
    for (ins::Attitude& a : single)
    {
        ASSERT_EQ(a.init(INS_CONING_HIST2_OPT, LEVEL), ins::Status::Ok);
    }
    for (int k = 0; k < 50; k++)
    {
        Eigen::Matrix<ins_real, Eigen::Dynamic, 3> rows(3, 3);
        for (int i = 0; i < 3; i++)
        {
            rows.row(i) = wobble(k + 7 * i).transpose();
            ASSERT_TRUE(ins::ok(single[i].step(wobble(k + 7 * i))));
        }
        ASSERT_TRUE(ins::ok(batch.step(state, rows)));
    }
    for (int i = 0; i < 3; i++)
    {
        EXPECT_EQ(state(i, 0), single[i].q_nb().w());
        EXPECT_EQ(state(i, 3), single[i].q_nb().z());
    }
    EXPECT_EQ(batch.step(state.topRows(2), q0.leftCols(3)), ins::Status::Range) << "another number of trajectories";
}

TEST(cpp, refusals_say_so_and_change_nothing)
{
    const ins_real nan = std::numeric_limits<ins_real>::quiet_NaN();
    ins::Attitude a;
    EXPECT_EQ(a.init(INS_CONING_BLOCK2, LEVEL), ins::Status::Range);
    ASSERT_EQ(a.init(INS_CONING_HIST2_OPT, LEVEL), ins::Status::Ok);
    Columns theta = Columns::Zero(3, 5);
    theta(1, 3) = nan;
    Attitudes q = Attitudes::Constant(4, 5, 7);
    const auto done = a.run(theta, q);
    EXPECT_EQ(done.status, ins::Status::Range);
    EXPECT_EQ(done.value, 3);
    EXPECT_NEAR(static_cast<double>(q(3, 2)), 1, TOL);
    EXPECT_EQ(q(3, 3), 7) << "columns from the refused one on are not written";
    EXPECT_EQ(a.run(theta, q.leftCols(2)).status, ins::Status::Range);
    EXPECT_EQ(a.turn_frame({nan, 0, 0}), ins::Status::Range);
    EXPECT_EQ(a.jump({0, 0, INS_C(0.5)}), ins::Status::Ok);
    EXPECT_EQ(a.step({0, 0, 0}), ins::Status::Start);
    EXPECT_EQ(ins::coning_phi(INS_CONING_BLOCK3_OPT, theta).status, ins::Status::Range);
    EXPECT_EQ(ins::fiter_turn(INS_FITER_BLOCK3, theta).status, ins::Status::Range);
    EXPECT_EQ(ins::from_dcm(ins::Matrix3::Zero()).status, ins::Status::Range);
    ins::Rates rates;
    EXPECT_EQ(rates.init(258, 1), ins::Status::Range) << "not as 2";
    const ins::Vector3 down(0, 0, 1);
    EXPECT_EQ(ins::align_triad(down, down, down, {1, 0, 0}).status, ins::Status::Range);
    const auto level = ins::align_level({0, 0, INS_C(-9.8)}, INS_C(0.5));
    ASSERT_TRUE(level);
    EXPECT_NEAR(static_cast<double>(ins::to_euler(level.value).z()), 0.5, TOL);
    ins::Kalman<2> f;
    f.P.setIdentity();
    ins_innovation_t far = {10, 1, INS_KALMAN_GATE_99, 0};
    EXPECT_EQ(f.update({1, 0}, far), ins::Status::Gate);
    EXPECT_EQ(far.nis, 50);
    EXPECT_EQ(f.x, ins::Vector2::Zero());
}
