/// \file   core_test.h
/// \brief  What the core's tests share: tolerances, reference files, double-precision references. Units: rad, s.
///
/// Each test program is compiled twice, against libins (double) and libinsf (float).
/// SPDX-License-Identifier: MIT
#ifndef INS_TESTS_CORE_TEST_H
#define INS_TESTS_CORE_TEST_H
#include "ins/ins.h"
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace core_test
{
using json = nlohmann::json;
using Vec = std::array<double, 3>;
using Quat = std::array<double, 4>;
constexpr double PI = 3.14159265358979323846;

/// A reference file, from the directory in INS_VECTOR_DIR or from the project's own.
inline json load(const std::string& name)
{
    const char* dir = std::getenv("INS_VECTOR_DIR");
    const std::string path = (dir ? std::string(dir) : std::string(INS_TEST_DATA) + "/vectors") + "/" + name;
    std::ifstream file(path);
    if (!file)
    {
        throw std::runtime_error("cannot read " + path);
    }
    return json::parse(file);
}

/// The larger of two, and NaN once there is one: std::max(worst, NaN) is worst.
inline double larger(double worst, double e)
{
    return std::isnan(worst) || e <= worst ? worst : e;
}

/// The largest of many errors, and where it was; failures show it, and so does the report. NaN is the largest of all.
struct Worst
{
    double error = 0;
    std::string where = "nowhere";
    long checked = 0;

    void take(double got, double want, double scale, const std::string& place)
    {
        const double e = std::fabs(got - want) / scale;
        checked++;
        if (!std::isnan(error) && !(e <= error))
        {
            error = e;
            where = place + ": got " + std::to_string(got) + ", want " + std::to_string(want);
        }
    }
};

inline void expect_within(const Worst& worst, double tolerance, const std::string& what)
{
    EXPECT_GT(worst.checked, 0) << what;
    EXPECT_LE(worst.error, tolerance) << what << " at " << worst.where;
    std::printf("[ figure   ] %s: %ld values, largest error %.2e (tolerance %.0e)\n", what.c_str(), worst.checked,
                worst.error, tolerance);
}

inline Quat conj(const Quat& q)
{
    return {q[0], -q[1], -q[2], -q[3]};
}

inline Quat mul(const Quat& p, const Quat& q)
{
    return {
        p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3], p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
        p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1], p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0]};
}

/// Rotation vector of a q b*, in n.
inline Vec rotation_between(const Quat& a, const Quat& b)
{
    Quat d = mul(a, conj(b));
    if (d[0] < 0)
    {
        d = {-d[0], -d[1], -d[2], -d[3]};
    }
    const double s = std::sqrt(d[1] * d[1] + d[2] * d[2] + d[3] * d[3]);
    const double k = s > 0 ? 2 * std::atan2(s, d[0]) / s : 2;
    return {k * d[1], k * d[2], k * d[3]};
}

inline double norm(const Vec& v)
{
    return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

inline double angle_between(const Quat& a, const Quat& b)
{
    return norm(rotation_between(a, b));
}

/// roll, pitch, yaw of a unit quaternion, away from the poles.
inline Vec euler_of(const Quat& q)
{
    return {std::atan2(2 * (q[2] * q[3] + q[0] * q[1]), q[0] * q[0] - q[1] * q[1] - q[2] * q[2] + q[3] * q[3]),
            std::asin(-2 * (q[1] * q[3] - q[0] * q[2])),
            std::atan2(2 * (q[1] * q[2] + q[0] * q[3]), q[0] * q[0] + q[1] * q[1] - q[2] * q[2] - q[3] * q[3])};
}

inline Quat from_euler(const Vec& e)
{
    const Quat yaw = {std::cos(e[2] / 2), 0, 0, std::sin(e[2] / 2)};
    const Quat pitch = {std::cos(e[1] / 2), 0, std::sin(e[1] / 2), 0};
    const Quat roll = {std::cos(e[0] / 2), std::sin(e[0] / 2), 0, 0};
    return mul(mul(yaw, pitch), roll);
}

template <size_t N> std::array<ins_real, N> real(const std::array<double, N>& x)
{
    std::array<ins_real, N> r;
    for (size_t i = 0; i < N; i++)
    {
        r[i] = static_cast<ins_real>(x[i]);
    }
    return r;
}

inline Quat quat(const ins_real q[4])
{
    return {static_cast<double>(q[0]), static_cast<double>(q[1]), static_cast<double>(q[2]), static_cast<double>(q[3])};
}

inline Vec vec(const ins_real v[3])
{
    return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

/// angle(t) = offset + amplitude sin(2 pi frequency t + phase)
struct Sine
{
    double offset, amplitude, frequency, phase;
    double at(double t) const { return offset + amplitude * std::sin(2 * PI * frequency * t + phase); }
    double rate(double t) const { return 2 * PI * frequency * amplitude * std::cos(2 * PI * frequency * t + phase); }
};

/// Attitude by sinusoids in yaw, pitch and roll, with its body rates and its exact increments.
struct Motion
{
    Sine yaw, pitch, roll;
    Quat attitude(double t) const { return from_euler({roll.at(t), pitch.at(t), yaw.at(t)}); }
    Vec rate(double t) const
    {
        const double sr = std::sin(roll.at(t)), cr = std::cos(roll.at(t));
        const double sp = std::sin(pitch.at(t)), cp = std::cos(pitch.at(t));
        return {roll.rate(t) - yaw.rate(t) * sp, pitch.rate(t) * cr + yaw.rate(t) * sr * cp,
                -pitch.rate(t) * sr + yaw.rate(t) * cr * cp};
    }
    /// Integral of the rate by Gauss-Legendre, 5 nodes on each of 8 parts: 1e-15 rad for parts of some 10 ms at 1 Hz.
    Vec increment(double t0, double t1) const
    {
        static const double node[] = {0, 0.5384693101056831, 0.9061798459386640};
        static const double weight[] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
        Vec sum = {0, 0, 0};
        const int parts = 8;
        const double half = (t1 - t0) / (2 * parts);
        for (int part = 0; part < parts; part++)
        {
            const double centre = t0 + (2 * part + 1) * half;
            for (int i = -2; i <= 2; i++)
            {
                const Vec w = rate(centre + (i < 0 ? -1 : 1) * node[std::abs(i)] * half);
                for (int axis = 0; axis < 3; axis++)
                {
                    sum[static_cast<size_t>(axis)] += weight[std::abs(i)] * half * w[static_cast<size_t>(axis)];
                }
            }
        }
        return sum;
    }
};

struct Form
{
    const char* name; ///< as in the reference files
    int form;
};

inline const std::vector<Form>& forms()
{
    static const std::vector<Form> list = {{"one", INS_CONING_ONE},
                                           {"two", INS_CONING_BLOCK2},
                                           {"three_poly", INS_CONING_BLOCK3_FIT},
                                           {"three_opt", INS_CONING_BLOCK3_OPT},
                                           {"four_poly", INS_CONING_BLOCK4_FIT},
                                           {"four_opt", INS_CONING_BLOCK4_OPT},
                                           {"hist1", INS_CONING_HIST1},
                                           {"hist2_poly", INS_CONING_HIST2_FIT},
                                           {"hist2_opt", INS_CONING_HIST2_OPT},
                                           {"hist3_poly", INS_CONING_HIST3_FIT},
                                           {"hist3_opt", INS_CONING_HIST3_OPT}};
    return list;
}

/// Attitude at a sequence of instants: (index of the last increment used, from 1; attitude).
using Track = std::vector<std::pair<size_t, Quat>>;

/// Runs a form over increments. `pre` are increments before the first, for the history forms.
inline Track run_form(int form, const Quat& start, const std::vector<Vec>& pre, const std::vector<Vec>& increments)
{
    Track track = {{0, start}};
    const auto q0 = real(start);
    if (!ins_coning_is_block(form))
    {
        ins_attitude_t a;
        EXPECT_EQ(ins_attitude_init(&a, form, q0.data()), INS_OK);
        for (const Vec& theta : pre)
        {
            EXPECT_GE(ins_attitude_step(&a, real(theta).data()), INS_OK);
        }
        std::copy(q0.begin(), q0.end(), a.q_nb);
        for (size_t k = 0; k < increments.size(); k++)
        {
            EXPECT_EQ(ins_attitude_step(&a, real(increments[k]).data()), INS_OK);
            track.push_back({k + 1, quat(a.q_nb)});
        }
        return track;
    }
    const size_t n = static_cast<size_t>(ins_coning_samples(form));
    auto q = q0;
    for (size_t k = 0; k + n <= increments.size(); k += n)
    {
        std::vector<ins_real> theta;
        for (size_t i = 0; i < n; i++)
        {
            const auto x = real(increments[k + i]);
            theta.insert(theta.end(), x.begin(), x.end());
        }
        ins_real phi[3];
        ins_real dq[4];
        EXPECT_EQ(ins_coning_phi(form, theta.data(), phi), INS_OK);
        EXPECT_EQ(ins_quat_from_rotvec(phi, dq), INS_OK);
        ins_quat_mul(q.data(), dq, q.data());
        ins_quat_normalise_approx(q.data());
        track.push_back({k + n, quat(q.data())});
    }
    return track;
}

/// The paper's sample reuse, as three chains.
inline Track run_reuse(int form, const std::array<Quat, 3>& start, const std::vector<Vec>& increments)
{
    Track track = {{0, start[0]}};
    ins_real q0[12];
    for (size_t i = 0; i < 12; i++)
    {
        q0[i] = static_cast<ins_real>(start[i / 4][i % 4]);
    }
    ins_reuse_t r;
    EXPECT_EQ(ins_reuse_init(&r, form, q0), INS_OK);
    for (size_t k = 0; k < increments.size(); k++)
    {
        ins_real q[4];
        EXPECT_EQ(ins_reuse_step(&r, real(increments[k]).data(), q), k < 2 ? INS_S_START : INS_OK);
        track.push_back({k + 1, quat(q)});
    }
    return track;
}

/// Point-sampled rates through Adams-Moulton, then HIST2_OPT. rates[lead] is the sample at the start attitude.
inline Track run_rates(unsigned order, double T, const Quat& start, const std::vector<Vec>& rates, size_t lead)
{
    ins_rates_t r;
    EXPECT_EQ(ins_rates_init(&r, static_cast<uint_least8_t>(order), static_cast<ins_real>(T)), INS_OK);
    std::vector<Vec> pre;
    std::vector<Vec> increments;
    for (size_t k = 0; k < rates.size(); k++)
    {
        ins_real theta[3];
        const ins_status_t status = ins_rates_add(&r, real(rates[k]).data(), theta);
        EXPECT_EQ(status, k + 1 < order ? INS_S_START : INS_OK);
        if (status == INS_OK)
        {
            (k <= lead ? pre : increments).push_back(vec(theta));
        }
    }
    return run_form(INS_CONING_HIST2_OPT, start, pre, increments);
}

inline double max_error(const Track& track, const std::function<Quat(size_t)>& truth)
{
    double worst = 0;
    for (const auto& point : track)
    {
        worst = larger(worst, angle_between(point.second, truth(point.first)));
    }
    return worst;
}
} // namespace core_test

#endif // INS_TESTS_CORE_TEST_H
