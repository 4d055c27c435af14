// A motion taken on by hand: the base until then, attitude without a step, the commanded rate from there.
// SPDX-License-Identifier: MIT
#include "ins_truth/motion.h"
#include "near.hpp"
#include <cmath>
#include <limits>
#include <memory>
#include <string>

namespace
{
using Motion = std::unique_ptr<ins_motion_t, decltype(&ins_motion_destroy)>;

constexpr double first_s = 1.25, second_s = 2.5, w1[3] = {0.4, -0.2, 0.7}, w2[3] = {-1.1, 0.3, 0.0};

struct Chain
{
    Motion base{nullptr, ins_motion_destroy}, one{nullptr, ins_motion_destroy}, two{nullptr, ins_motion_destroy};
};

Chain chain(double ramp_s)
{
    const ins_motion_sines_t sines = {{0.2, 1.0, 0.2, 0.3}, {0.1, 0.5, 0.3, -1.0}, {-0.4, 0.3, 0.25, 2.0}};
    Chain c;
    c.base.reset(ins_motion_create_euler(&sines, ramp_s, nullptr, 0));
    c.one.reset(ins_motion_create_onward(c.base.get(), first_s, w1, nullptr, 0));
    c.two.reset(ins_motion_create_onward(c.one.get(), second_s, w2, nullptr, 0));
    return c;
}

/// q after a turn at rate w for t from q0, by the rotation vector.
void turned(const double q0[4], const double w[3], double t, double q[4])
{
    const double rate = std::sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    const double c = std::cos(0.5 * rate * t), k = std::sin(0.5 * rate * t) / rate;
    const double d[4] = {c, k * w[0], k * w[1], k * w[2]};
    q[0] = q0[0] * d[0] - q0[1] * d[1] - q0[2] * d[2] - q0[3] * d[3];
    q[1] = q0[0] * d[1] + q0[1] * d[0] + q0[2] * d[3] - q0[3] * d[2];
    q[2] = q0[0] * d[2] - q0[1] * d[3] + q0[2] * d[0] + q0[3] * d[1];
    q[3] = q0[0] * d[3] + q0[1] * d[2] - q0[2] * d[1] + q0[3] * d[0];
}
} // namespace

TEST(onward, is_its_base_before_and_turns_from_its_attitude_after)
{
    for (const double ramp_s : {0.0, 2.0})
    {
        const Chain c = chain(ramp_s);
        ASSERT_NE(c.two, nullptr);
        double q[4], w[3], want_q[4], want_w[3], q1[4], q2[4];
        for (double t = -0.5; t < first_s; t += 0.1)
        {
            ins_motion_attitude(c.two.get(), t, q);
            ins_motion_rate(c.two.get(), t, w);
            ins_motion_attitude(c.base.get(), t, want_q);
            ins_motion_rate(c.base.get(), t, want_w);
            EXPECT_EQ(max_difference(q, want_q, 4) + max_difference(w, want_w, 3), 0.0) << t;
        }
        ins_motion_attitude(c.base.get(), first_s, q1);
        turned(q1, w1, second_s - first_s, q2);
        for (double t = first_s; t < 5.0; t += 0.25)
        {
            const bool later = t >= second_s;
            turned(later ? q2 : q1, later ? w2 : w1, t - (later ? second_s : first_s), want_q);
            ins_motion_attitude(c.two.get(), t, q);
            ins_motion_rate(c.two.get(), t, w);
            EXPECT_LE(max_difference(q, want_q, 4), 1e-15) << t;
            EXPECT_EQ(max_difference(w, later ? w2 : w1, 3), 0.0) << t;
        }
    }
}

TEST(onward, increments_are_the_base_s_and_then_the_rate_s)
{
    for (const double ramp_s : {0.0, 2.0})
    {
        const Chain c = chain(ramp_s);
        double got[3], want[3];
        ins_motion_increment(c.base.get(), -0.3, first_s, want);
        for (int i = 0; i < 3; i++)
        {
            want[i] += w1[i] * (second_s - first_s) + w2[i] * (4.0 - second_s);
        }
        ins_motion_increment(c.two.get(), -0.3, 4.0, got);
        EXPECT_LE(max_difference(got, want, 3), 1e-14);
        ins_motion_increment(c.two.get(), 4.0, -0.3, got);
        for (double& x : want)
        {
            x = -x;
        }
        EXPECT_LE(max_difference(got, want, 3), 1e-14);
    }
}

TEST(onward, goes_on_from_a_constant_rate_and_from_a_table)
{
    const double w0[3] = {0.0, 0.0, 0.5}, level[4] = {1.0, 0.0, 0.0, 0.0};
    const double t[4] = {0.0, 1.0, 2.0, 3.0}, yaw[4] = {0.0, 0.1, 0.4, 0.2}, zero[4] = {};
    const Motion rate(ins_motion_create_rate(w0, level, 0.0, nullptr, 0), ins_motion_destroy);
    const Motion table(ins_motion_create_table(4, t, yaw, zero, zero, 0.0, nullptr, 0), ins_motion_destroy);
    for (const ins_motion_t* const base : {rate.get(), table.get()})
    {
        const Motion m(ins_motion_create_onward(base, 1.5, w1, nullptr, 0), ins_motion_destroy);
        double got[3], want[3], first, last;
        ins_motion_increment(base, 0.0, 1.5, want);
        for (int i = 0; i < 3; i++)
        {
            want[i] += w1[i] * 8.5;
        }
        ins_motion_increment(m.get(), 0.0, 10.0, got);
        EXPECT_LE(max_difference(got, want, 3), 1e-14);
        ins_motion_span(m.get(), &first, &last);
        EXPECT_EQ(first, base == table.get() ? 0.0 : -std::numeric_limits<double>::infinity());
        EXPECT_EQ(last, std::numeric_limits<double>::infinity());
    }
}

TEST(onward, what_is_no_number_is_refused_by_name)
{
    const double nan = std::numeric_limits<double>::quiet_NaN(), bad[3] = {0.0, 2e4, 0.0};
    const Chain c = chain(0.0);
    char why[160];
    EXPECT_EQ(ins_motion_create_onward(c.base.get(), nan, w1, why, sizeof why), nullptr);
    EXPECT_NE(std::string(why).find("from_s is nan"), std::string::npos) << why;
    EXPECT_EQ(ins_motion_create_onward(c.base.get(), 1.0, bad, why, sizeof why), nullptr);
    EXPECT_NE(std::string(why).find("w_ib_b[1] is 20000"), std::string::npos) << why;
    double q[4];
    ins_motion_attitude(c.two.get(), nan, q);
    EXPECT_TRUE(std::isnan(q[0]));
}
