/// \file   test_triad.cpp
/// \brief  The triad calibration on a made-up IMU moved by hand: its parameters come back, within their own covariance; refusals. SI.
/// SPDX-License-Identifier: MIT
#include "calib_test.hpp"
#include "ins_calib/triad.h"
#include <limits>
#include <random>
using namespace calib_test;

namespace
{
constexpr unsigned SEED = 2014;
constexpr double PERIOD_S = 0.01;
constexpr double G = 9.81;
constexpr double SCALE = 2e-4; ///< rad/s per count
constexpr int POSES = 30;
constexpr int START = 1000;         ///< samples still at first
constexpr int REST = 300;           ///< in each pose
constexpr double SHAKE = 3;         ///< of the hand, m/s^2: a turn about the vertical is to be seen
constexpr double SHAKEN_RAD = 40;   ///< over a motion
constexpr int MOTION = 200;         ///< between them
constexpr double CHI2_9_MAX = 27.9; ///< 99.9 % of nine degrees of freedom
constexpr double TOL_EXACT = 1e-6;  ///< of p relative to its unit, without noise: what integration of samples leaves
const double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();

const std::array<double, 9> ACCEL = {3e-3, -9e-3, 0.02, 2.4e-3, 2.43e-3, 2.41e-3, 33100, 33300, 32400};
const std::array<double, 9> GYRO = {-0.006, 0.002, 0.008, 0.05, -0.025, -0.001, 2.1e-4, 2.05e-4, 1.95e-4};
const std::array<double, 9> SENSITIVITY = {0.1, 0.3, 0.6, -1.3, 0, 0.8, -0.7, -0.8, 0.2};
const Vec GYRO_BIAS = {32770, 32460, 32510};

/// x with M x = y, by Cramer's rule.
Vec solved(const std::array<double, 9>& M, const Vec& y)
{
    const auto det = [](const Vec& a, const Vec& b, const Vec& c)
    {
        return a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1]) +
               c[0] * (a[1] * b[2] - a[2] * b[1]);
    };
    const Vec a = {M[0], M[3], M[6]};
    const Vec b = {M[1], M[4], M[7]};
    const Vec c = {M[2], M[5], M[8]};
    const double d = det(a, b, c);
    return {det(y, b, c) / d, det(a, y, c) / d, det(a, b, y) / d};
}

struct Recording
{
    std::vector<double> accel, gyro;

    /// Turns by hand from pose to pose about axes at random, the rate a bell; readings with the noise of both sensors in counts.
    Recording(double accel_noise, double gyro_noise, bool about_x = false)
    {
        const auto& a = ACCEL;
        const auto& g = GYRO;
        const std::array<double, 9> to_f = {a[3], -a[0] * a[4], a[1] * a[5], 0, a[4], -a[2] * a[5], 0, 0, a[5]};
        const std::array<double, 9> to_w = {g[6],         -g[0] * g[7], g[1] * g[8], g[2] * g[6], g[7],
                                            -g[3] * g[8], -g[4] * g[6], g[5] * g[7], g[8]};
        std::mt19937 random(SEED);
        std::normal_distribution<double> normal;
        Quat q = {1, 0, 0, 0}; // q_nb
        const auto sample = [&](const Quat& now, const Vec& w, double shaken)
        {
            double f[3];
            const double up[3] = {0, 0, G};
            const Quat back = conj(now);
            ins_quat_rotate(back.data(), up, f);
            for (size_t i = 0; i < 3; i++)
            {
                f[i] += SHAKE * std::sin(shaken * (1 + static_cast<double>(i)));
            }
            const Vec s = solved(to_f, {f[0], f[1], f[2]});
            const Vec r = solved(to_w, w);
            for (size_t i = 0; i < 3; i++)
            {
                accel.push_back(s[i] + a[6 + i] + accel_noise * normal(random));
                gyro.push_back(r[i] + GYRO_BIAS[i] + SENSITIVITY[3 * i] * f[0] + SENSITIVITY[3 * i + 1] * f[1] +
                               SENSITIVITY[3 * i + 2] * f[2] + gyro_noise * normal(random));
            }
        };
        for (int pose = 0; pose < POSES; pose++)
        {
            for (int k = 0; k < (pose == 0 ? START : REST); k++)
            {
                sample(q, {}, 0);
            }
            Vec axis = {normal(random), normal(random), normal(random)};
            axis = about_x ? Vec{1, 0, 0} : axis;
            const double length = std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
            const double angle = 1.5 + std::fabs(normal(random)) / 2;
            const Quat from = q;
            for (int k = 0; k <= MOTION; k++)
            {
                const double u = k / static_cast<double>(MOTION);
                const double way = u * u * u * (10 - 15 * u + 6 * u * u);
                const double rate = 30 * u * u * (1 - u) * (1 - u) / (MOTION * PERIOD_S);
                Vec phi;
                Vec w;
                for (size_t i = 0; i < 3; i++)
                {
                    phi[i] = axis[i] / length * angle * way;
                    w[i] = axis[i] / length * angle * rate;
                }
                Quat turn;
                ins_quat_from_rotvec(phi.data(), turn.data());
                q = mul(from, turn);
                if (k > 0 && k < MOTION)
                {
                    sample(q, w, SHAKEN_RAD * u);
                }
            }
        }
    }
};

/// The result with its memory.
struct Solution
{
    static constexpr size_t CAPACITY = 100;
    std::array<size_t, CAPACITY> first{}, last{};
    std::array<double, CAPACITY> residual{}, angle{};
    ins_calib_triad_result_t out{};
    Reason why;
    int status = 0;

    explicit Solution(const ins_calib_triad_t& in)
    {
        out.capacity = CAPACITY;
        out.first = first.data();
        out.last = last.data();
        out.residual = residual.data();
        out.angle = angle.data();
        status = ins_calib_triad(&in, &out, why.text, sizeof why.text);
    }
};

ins_calib_triad_t given(const Recording& r)
{
    return {r.accel.size() / 3, r.accel.data(), r.gyro.data(), PERIOD_S, G, 8, 1, SCALE, 0, 1};
}

/// Squared error over the variances, one by one.
double normalised(const ins_calib_axes_t& axes, const std::array<double, 9>& truth)
{
    double sum = 0;
    for (size_t i = 0; i < 9; i++)
    {
        const double e = axes.p[i] - truth[i];
        sum += e * e / axes.covariance[10 * i];
    }
    return sum;
}
} // namespace

TEST(calib_triad, parameters_come_back)
{
    const Recording exact(1e-3, 0); // a little noise, or stillness would be perfect
    const Solution s(given(exact));
    ASSERT_EQ(s.status, 0) << s.why.text;
    EXPECT_EQ(s.out.poses, static_cast<size_t>(POSES));
    Worst accel;
    Worst gyro;
    Worst rest;
    for (size_t i = 0; i < 9; i++)
    {
        const std::string name = "p" + std::to_string(i);
        accel.take(s.out.accel.p[i], ACCEL[i], i < 3 ? 1 : std::fabs(ACCEL[i]), name);
        gyro.take(s.out.gyro.p[i], GYRO[i], i < 6 ? 1 : GYRO[i], name);
        rest.take(s.out.g_sensitivity[i], SENSITIVITY[i], 1, "g-sensitivity " + std::to_string(i));
    }
    for (size_t i = 0; i < 3; i++)
    {
        rest.take(s.out.gyro.bias[i], GYRO_BIAS[i], GYRO_BIAS[i], "bias");
    }
    std::printf("[ figure   ] condition %.1f and %.1f\n", s.out.accel.condition, s.out.gyro.condition);
    expect_within(accel, TOL_EXACT, "accelerometers");
    expect_within(rest, TOL_EXACT, "gyros' bias and sensitivity");
    expect_within(gyro, TOL_EXACT, "gyros");
    EXPECT_LT(s.out.accel.rms, 1e-6);
    EXPECT_GT(s.out.accel.rms_scale, 0.01);
    EXPECT_GT(s.out.gyro.rms_scale, 0.01);
}

TEST(calib_triad, errors_are_those_of_the_covariance_and_of_both_halves)
{
    const Recording noisy(4, 9);
    std::printf("seed %u\n", SEED);
    ins_calib_triad_t in = given(noisy);
    for (const unsigned parts : {1U, 2U})
    {
        for (unsigned part = 0; part < parts; part++)
        {
            in.part = part;
            in.parts = parts;
            const Solution s(in);
            ASSERT_EQ(s.status, 0) << s.why.text;
            const double accel = normalised(s.out.accel, ACCEL);
            const double gyro = normalised(s.out.gyro, GYRO);
            std::printf("[ figure   ] part %u of %u: squared errors over variances %.1f and %.1f of 9\n", part, parts,
                        accel, gyro);
            EXPECT_LT(accel, CHI2_9_MAX);
            EXPECT_LT(gyro, CHI2_9_MAX);
            EXPECT_GT(accel, 0.3); // a covariance far too large is wrong as well
            EXPECT_GT(gyro, 0.3);
        }
    }
}

TEST(calib_triad, refuses)
{
    const Recording good(1, 0);
    const auto expect = [](const ins_calib_triad_t& in, int status, const char* words)
    {
        const Solution s(in);
        EXPECT_EQ(s.status, status) << words;
        EXPECT_SAYS(s.why, words);
    };
    ins_calib_triad_t in = given(good);
    in.g = 0;
    expect(in, INS_CALIB_E_INPUT, "g is 0 m/s^2");
    in = given(good);
    in.initial_s = 0.5;
    expect(in, INS_CALIB_E_INPUT, "initial_s 0.5");
    in = given(good);
    in.gyro_scale = 0;
    expect(in, INS_CALIB_E_INPUT, "gyro_scale is 0");
    in = given(good);
    in.part = 2;
    in.parts = 2;
    expect(in, INS_CALIB_E_INPUT, "part 2 of 2");
    in = given(good);
    in.gyro_scale = 2 * SCALE;
    expect(in, INS_CALIB_E_CONVERGENCE, "wrong unit");
    in.gyro = nullptr;
    EXPECT_EQ(Solution(in).status, 0) << "accelerometers alone";
    in = given(good);
    in.samples = START + 3 * (REST + MOTION);
    expect(in, INS_CALIB_E_RANK, "12 to 100 are needed");
    Recording odd = good;
    odd.gyro[7] = NOT_A_NUMBER;
    expect(given(odd), INS_CALIB_E_INPUT, "not a number");
    // Turned about one axis alone, which then stays level: its scale is not seen.
    const Recording flat(1, 0, true);
    expect(given(flat), INS_CALIB_E_RANK, "hold each axis up and down");
}
