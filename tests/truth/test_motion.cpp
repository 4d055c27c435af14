// Motions: rate is the derivative of attitude, increments are the integral of rate, ramps are C2, bad input is refused
// by name.
// SPDX-License-Identifier: MIT
#include "ins_truth/elementary.h"
#include "ins_truth/motion.h"
#include "near.hpp"
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace
{
using Motion = std::unique_ptr<ins_motion_t, decltype(&ins_motion_destroy)>;

struct Table
{
    std::vector<double> t, yaw, pitch, roll;
};

/// A slow swing that turns through more than half a circle, `rows` rows over 6 s.
Table swing(int rows)
{
    Table table;
    for (int k = 0; k < rows; k++)
    {
        const double t = 6.0 * k / (rows - 1);
        table.t.push_back(t);
        table.yaw.push_back(3.0 + 2.0 * std::sin(1.1 * t));
        table.pitch.push_back(0.4 * std::cos(0.9 * t));
        table.roll.push_back(0.2 - 0.6 * std::sin(0.7 * t));
    }
    return table;
}

Motion from_table(const Table& x, double ramp_s, char* why, std::size_t size)
{
    return {
        ins_motion_create_table(x.t.size(), x.t.data(), x.yaw.data(), x.pitch.data(), x.roll.data(), ramp_s, why, size),
        ins_motion_destroy};
}

struct Named
{
    std::string name;
    Motion motion;
};

std::vector<Named> every_kind(double ramp_s)
{
    const double w[3] = {0.3, -0.7, 1.9};
    const double q0[4] = {0.5, -0.5, 0.5, 0.5};
    const ins_motion_sines_t sines = {{0.2, 1.0, 0.2, 0.3}, {0.1, 0.5, 0.3, -1.0}, {-0.4, 0.3, 0.25, 2.0}};
    char why[160];
    std::vector<Named> all;
    all.push_back({"rate", Motion(ins_motion_create_rate(w, q0, ramp_s, why, sizeof why), ins_motion_destroy)});
    all.push_back({"euler", Motion(ins_motion_create_euler(&sines, ramp_s, why, sizeof why), ins_motion_destroy)});
    all.push_back({"coning", Motion(ins_motion_create_coning(0.3, 0.8, ramp_s, why, sizeof why), ins_motion_destroy)});
    all.push_back({"table", from_table(swing(13), ramp_s, why, sizeof why)});
    return all;
}

/// Body rate from attitudes at t +- h and t +- 2h: q* dq/dt * 2, error of order h^4.
void numerical_rate(const ins_motion_t* m, double t, double h, double w[3])
{
    double q[5][4];
    for (int k = 0; k < 5; k++)
    {
        ins_motion_attitude(m, t + (k - 2) * h, q[k]);
    }
    double d[4];
    for (int i = 0; i < 4; i++)
    {
        d[i] = (q[0][i] - 8.0 * q[1][i] + 8.0 * q[3][i] - q[4][i]) / (12.0 * h);
    }
    const double* const p = q[2];
    w[0] = 2.0 * (p[0] * d[1] - p[1] * d[0] - p[2] * d[3] + p[3] * d[2]);
    w[1] = 2.0 * (p[0] * d[2] - p[2] * d[0] - p[3] * d[1] + p[1] * d[3]);
    w[2] = 2.0 * (p[0] * d[3] - p[3] * d[0] - p[1] * d[2] + p[2] * d[1]);
}
} // namespace

TEST(motion, rate_is_the_derivative_of_attitude)
{
    for (double ramp_s : {0.0, 2.0})
    {
        for (const Named& n : every_kind(ramp_s))
        {
            ASSERT_NE(n.motion, nullptr) << n.name;
            for (double t = -0.955; t < 7.0; t += 0.11) // never within 2h of a knot or an end of the ramp
            {
                double want[3];
                double got[3];
                numerical_rate(n.motion.get(), t, 1e-3, want);
                ins_motion_rate(n.motion.get(), t, got);
                EXPECT_LE(max_difference(got, want, 3), 2e-10) << n.name << " ramp " << ramp_s << " s, t " << t;
            }
        }
    }
}

TEST(motion, increment_is_the_integral_of_rate)
{
    constexpr int steps = 2000; // Simpson's rule, error about h^4
    for (double ramp_s : {0.0, 2.0})
    {
        for (const Named& n : every_kind(ramp_s))
        {
            for (const auto& [a, b] : {std::pair<double, double>{-1.0, 0.5}, {0.0, 0.08}, {0.5, 4.25}, {5.0, 7.0}})
            {
                double want[3] = {0.0, 0.0, 0.0};
                const double h = (b - a) / steps;
                for (int k = 0; k <= steps; k++)
                {
                    double w[3];
                    ins_motion_rate(n.motion.get(), a + k * h, w);
                    const double weight = (k == 0 || k == steps ? 1.0 : (k % 2 == 0 ? 2.0 : 4.0)) * h / 3.0;
                    for (int i = 0; i < 3; i++)
                    {
                        want[i] += weight * w[i];
                    }
                }
                double got[3];
                ins_motion_increment(n.motion.get(), a, b, got);
                EXPECT_LE(max_difference(got, want, 3), 2e-9)
                    << n.name << " ramp " << ramp_s << " s, " << a << " to " << b;
            }
        }
    }
}

TEST(motion, increments_add_up_whatever_the_steps)
{
    // Other steps are other Gauss-Legendre panels, so this is the quadrature's own error.
    for (double ramp_s : {0.0, 2.0})
    {
        for (const Named& n : every_kind(ramp_s))
        {
            double whole[3];
            long double sum[3] = {0.0L, 0.0L, 0.0L};
            double back[3];
            ins_motion_increment(n.motion.get(), -1.0, 8.0, whole);
            ins_motion_increment(n.motion.get(), 8.0, -1.0, back);
            for (int k = 0; k < 900; k++)
            {
                double d[3];
                ins_motion_increment(n.motion.get(), -1.0 + 0.01 * k, -1.0 + 0.01 * (k + 1), d);
                for (int i = 0; i < 3; i++)
                {
                    sum[i] += d[i];
                }
            }
            for (int i = 0; i < 3; i++)
            {
                EXPECT_NEAR(static_cast<double>(sum[i] - static_cast<long double>(whole[i])), 0.0, 5e-15)
                    << n.name << " ramp " << ramp_s;
                EXPECT_EQ(back[i], -whole[i]) << n.name;
            }
        }
    }
}

TEST(motion, ramp_starts_at_rest_and_ends_under_way)
{
    const std::vector<Named> ramped = every_kind(2.0);
    const std::vector<Named> going = every_kind(0.0);
    for (std::size_t k = 0; k < ramped.size(); k++)
    {
        double q0[4];
        ins_motion_attitude(ramped[k].motion.get(), 0.0, q0);
        for (double t : {-5.0, -0.3, 0.0})
        {
            double q[4];
            double w[3];
            const double zero[3] = {0.0, 0.0, 0.0};
            ins_motion_attitude(ramped[k].motion.get(), t, q);
            ins_motion_rate(ramped[k].motion.get(), t, w);
            EXPECT_LE(max_difference(q, q0, 4), 0.0) << ramped[k].name;
            EXPECT_LE(max_difference(w, zero, 3), 0.0) << ramped[k].name;
        }
        for (double t : {2.0, 3.3})
        {
            // A constant rate trails by half the ramp; the others are where they would be.
            const double at = ramped[k].name == "rate" ? t - 1.0 : t;
            double a[4];
            double b[4];
            ins_motion_attitude(ramped[k].motion.get(), t, a);
            ins_motion_attitude(going[k].motion.get(), at, b);
            EXPECT_LE(max_difference(a, b, 4), 1e-15) << ramped[k].name;
            ins_motion_rate(ramped[k].motion.get(), t, a);
            ins_motion_rate(going[k].motion.get(), at, b);
            EXPECT_LE(max_difference(a, b, 3), 1e-14) << ramped[k].name;
        }
    }
}

TEST(motion, ramp_is_continuous_to_the_angular_acceleration)
{
    constexpr double h = 1e-5;
    for (const Named& n : every_kind(2.0))
    {
        for (double edge : {0.0, 2.0})
        {
            double w[3][3];
            double q[2][4];
            for (int k = 0; k < 3; k++)
            {
                ins_motion_rate(n.motion.get(), edge + (k - 1) * h, w[k]);
            }
            ins_motion_attitude(n.motion.get(), edge - h, q[0]);
            ins_motion_attitude(n.motion.get(), edge + h, q[1]);
            EXPECT_LE(max_difference(q[0], q[1], 4), 1e-4) << n.name << " at " << edge;
            for (int i = 0; i < 3; i++)
            {
                const double before = (w[1][i] - w[0][i]) / h;
                const double after = (w[2][i] - w[1][i]) / h;
                EXPECT_NEAR(before, after, 5e-4)
                    << n.name << " at " << edge; // a jump would be of the order of 1 rad/s^2
            }
        }
    }
}

TEST(motion, euler_angles_come_back_wrapped)
{
    const ins_motion_sines_t sines = {{10.0, 0.0, 0.0, 0.0}, {1.5, 0.0, 0.0, 0.0}, {-4.0, 0.0, 0.0, 0.0}};
    const Motion m(ins_motion_create_euler(&sines, 0.0, nullptr, 0), ins_motion_destroy);
    double rpy[3];
    ins_motion_euler(m.get(), 1.0, rpy);
    const double want[3] = {-4.0 + 2.0 * INS_TRUTH_PI, 1.5, 10.0 - 4.0 * INS_TRUTH_PI};
    EXPECT_LE(max_difference(rpy, want, 3), 1e-13);
}

TEST(motion, table_passes_its_rows_and_converges)
{
    const auto worst = [](int rows, double from, double to)
    {
        const Motion m = from_table(swing(rows), 0.0, nullptr, 0);
        const Motion fine = from_table(swing(20001), 0.0, nullptr, 0);
        double most = 0.0;
        for (double t = from; t < to; t += 0.0137)
        {
            double a[4];
            double b[4];
            ins_motion_attitude(m.get(), t, a);
            ins_motion_attitude(fine.get(), t, b);
            most = larger(most, max_difference(a, b, 4));
        }
        return most;
    };
    const Table rows = swing(13);
    const Motion m = from_table(rows, 0.0, nullptr, 0);
    for (std::size_t k = 0; k < rows.t.size(); k++)
    {
        double rpy[3];
        ins_motion_euler(m.get(), rows.t[k], rpy);
        EXPECT_NEAR(rpy[0], rows.roll[k], 1e-14);
        EXPECT_NEAR(rpy[1], rows.pitch[k], 1e-14);
        EXPECT_NEAR(std::remainder(rpy[2] - rows.yaw[k], 2.0 * INS_TRUTH_PI), 0.0, 2e-14);
    }
    // Fourth order inside, where the natural ends are forgotten: 16 times better with twice the rows.
    EXPECT_NEAR(worst(41, 2.0, 4.0) / worst(81, 2.0, 4.0), 16.0, 3.0);
    double first;
    double last;
    ins_motion_span(m.get(), &first, &last);
    EXPECT_EQ(first, 0.0);
    EXPECT_EQ(last, 6.0);
}

TEST(motion, table_goes_on_at_its_end_slope)
{
    const Motion m = from_table(swing(13), 0.0, nullptr, 0);
    for (double edge : {0.0, 6.0})
    {
        double inside[3];
        double outside[3];
        ins_motion_rate(m.get(), edge, inside);
        ins_motion_rate(m.get(), edge == 0.0 ? -1e-9 : edge + 1e-9, outside);
        EXPECT_LE(max_difference(inside, outside, 3), 1e-8);
    }
    double a[3];
    double b[3];
    double c[3];
    ins_motion_euler(m.get(), 6.0, a);
    ins_motion_euler(m.get(), 6.1, b);
    ins_motion_euler(m.get(), 6.2, c);
    EXPECT_NEAR(c[1] - b[1], b[1] - a[1], 1e-14);
    EXPECT_NE(b[1], a[1]);
}

TEST(motion, table_refuses_bad_rows_by_number)
{
    char why[200];
    const auto refused = [&](const Table& table, const char* place)
    {
        why[0] = '\0';
        EXPECT_EQ(from_table(table, 0.0, why, sizeof why), nullptr) << place;
        EXPECT_NE(std::string(why).find(place), std::string::npos) << "got: " << why;
    };
    refused(swing(3), "3 rows");
    Table table = swing(9);
    table.pitch[4] = not_a_number;
    refused(table, "row 5: pitch is nan");
    table = swing(9);
    table.t[0] = not_a_number;
    refused(table, "row 1: t is nan");
    table = swing(9);
    table.t[6] = table.t[5];
    refused(table, "row 7: t is");
    table = swing(9);
    table.t[8] = 0.0;
    refused(table, "row 9: t is");
    table = swing(9);
    table.yaw[3] -= 2.0 * INS_TRUTH_PI;
    refused(table, "row 4: yaw steps by");
    table.yaw = {0.0, 0.0, 3.2, 3.2, 3.2, 3.2, 3.2, 3.2, 3.2};
    refused(table, "row 3: yaw steps by 3.2 rad");
    table.yaw = {0.0, 0.0, 3.1, 0.0, -3.1, 0.0, 0.0, 0.0, 0.0};
    EXPECT_NE(from_table(table, 0.0, why, sizeof why), nullptr) << why;
    table = swing(9);
    table.roll[8] = infinity;
    refused(table, "row 9: roll is inf");
}

TEST(motion, refuses_bad_parameters_by_name)
{
    char why[200];
    const auto refused = [&](ins_motion_t* m, const char* place)
    {
        EXPECT_EQ(m, nullptr) << place;
        EXPECT_NE(std::string(why).find(place), std::string::npos) << "got: " << why;
        ins_motion_destroy(m);
        why[0] = '\0';
    };
    const double w[3] = {0.0, not_a_number, 0.0};
    const double zero[3] = {0.0, 0.0, 0.0};
    const double level[4] = {1.0, 0.0, 0.0, 0.0};
    const double long_q[4] = {1.0, 0.1, 0.0, 0.0};
    refused(ins_motion_create_rate(w, level, 0.0, why, sizeof why), "w_ib_b[1] is nan");
    refused(ins_motion_create_rate(zero, long_q, 0.0, why, sizeof why), "length of q_nb0");
    refused(ins_motion_create_rate(zero, level, -1.0, why, sizeof why), "ramp_s is -1");
    refused(ins_motion_create_coning(4.0, 1.0, 0.0, why, sizeof why), "half_angle is 4");
    refused(ins_motion_create_coning(0.1, not_a_number, 0.0, why, sizeof why), "frequency_hz is nan");
    ins_motion_sines_t sines = {};
    sines.roll.frequency_hz = -2.0;
    refused(ins_motion_create_euler(&sines, 0.0, why, sizeof why), "roll: frequency_hz is -2");
    EXPECT_EQ(ins_motion_create_euler(&sines, 0.0, nullptr, 0), nullptr);
}

TEST(motion, times_that_are_none_give_nan_and_return)
{
    for (const Named& n : every_kind(1.0))
    {
        for (double t : {not_a_number, infinity, -2e9})
        {
            double x[4] = {0.0, 0.0, 0.0, 0.0};
            ins_motion_attitude(n.motion.get(), t, x);
            EXPECT_TRUE(std::isnan(x[0]) && std::isnan(x[3])) << n.name;
            ins_motion_rate(n.motion.get(), t, x);
            EXPECT_TRUE(std::isnan(x[0]) && std::isnan(x[2])) << n.name;
            ins_motion_increment(n.motion.get(), 0.0, t, x);
            EXPECT_TRUE(std::isnan(x[0]) && std::isnan(x[2])) << n.name;
            ins_motion_euler(n.motion.get(), t, x);
            EXPECT_TRUE(std::isnan(x[0]) && std::isnan(x[2])) << n.name;
        }
    }
}

TEST(motion, nothing_moves_without_amplitude)
{
    const ins_motion_sines_t still = {};
    const Motion m(ins_motion_create_euler(&still, 0.0, nullptr, 0), ins_motion_destroy);
    double d[3] = {1.0, 1.0, 1.0};
    const double zero[3] = {0.0, 0.0, 0.0};
    ins_motion_increment(m.get(), 0.0, 1e6, d);
    EXPECT_EQ(max_difference(d, zero, 3), 0.0);
}
