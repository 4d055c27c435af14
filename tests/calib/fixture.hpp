/// \file   fixture.hpp
/// \brief  The fixture of the reference file: 18 static attitudes, spins about three axes and six face diagonals in both senses,
///         six accelerometers; readings with noise from core's model, poses turned at random. SI.
/// SPDX-License-Identifier: MIT
#ifndef INS_TESTS_CALIB_FIXTURE_HPP
#define INS_TESTS_CALIB_FIXTURE_HPP
#include "calib_test.hpp"
#include "ins_calib/full.h"
#include <random>

namespace calib_test
{
constexpr size_t N = INS_CALIB_FULL_N;
constexpr double NOISE = 1e-3; ///< [m/s^2], of the reference file

struct Fixture
{
    json accelerometers;
    double g;
    std::vector<ins_calib_sensor_t> sensors;
    std::vector<ins_calib_pose_t> poses;
    std::vector<double> truth; ///< [sensors][8]

    explicit Fixture(const std::string& name = "calib_full.json")
    {
        const json file = load(name);
        g = file["g"];
        accelerometers = file["acc"];
        for (const json& m : file["meas"])
        {
            const auto row = m.get<std::array<double, 9>>();
            ins_calib_pose_t pose;
            std::copy(row.begin(), row.begin() + 3, pose.up);
            std::copy(row.begin() + 3, row.begin() + 6, pose.w);
            std::copy(row.begin() + 6, row.end(), pose.wd);
            poses.push_back(pose);
        }
        for (const json& a : accelerometers)
        {
            const auto p = a["p_true"].get<std::array<double, N>>();
            const auto p0 = a["p0"].get<std::array<double, N>>();
            ins_calib_sensor_t sensor{};
            const auto copy = [&](const char* key, double* to)
            {
                const Vec v = a[key].get<Vec>();
                std::copy(v.begin(), v.end(), to);
            };
            copy("u0", sensor.u0);
            copy("e1", sensor.e1);
            copy("e2", sensor.e2);
            std::copy(p0.begin() + 5, p0.end(), sensor.r0);
            sensor.sigma = NOISE * p[1];
            sensors.push_back(sensor);
            truth.insert(truth.end(), p.begin(), p.end());
        }
    }

    /// From the file.
    std::vector<double> readings(const char* key) const
    {
        std::vector<double> all(poses.size() * sensors.size());
        for (size_t i = 0; i < all.size(); i++)
        {
            all[i] = accelerometers[i % sensors.size()][key][i / sensors.size()];
        }
        return all;
    }

    /// Core's model of what is read, each pose turned by its rotation vector.
    std::vector<double> readings(const std::vector<Vec>& turns) const
    {
        std::vector<double> all;
        for (size_t k = 0; k < poses.size(); k++)
        {
            ins_real q[4];
            ins_quat_from_rotvec(turns[k].data(), q);
            ins_accelfit_motion_t motion;
            const double f[3] = {g * poses[k].up[0], g * poses[k].up[1], g * poses[k].up[2]};
            ins_quat_rotate(q, f, motion.f_b);
            ins_quat_rotate(q, poses[k].w, motion.w_ib_b);
            ins_quat_rotate(q, poses[k].wd, motion.wd_ib_b);
            for (size_t j = 0; j < sensors.size(); j++)
            {
                ins_accelfit_t one;
                EXPECT_EQ(ins_accelfit_init(&one, sensors[j].u0, sensors[j].e1, sensors[j].e2, &truth[N * j]), INS_OK);
                all.push_back(ins_accelfit_predict(&one, &motion, nullptr));
            }
        }
        return all;
    }
};

/// The result with its memory.
struct Solution
{
    std::vector<double> p, covariance, attitude, residual, condition;
    ins_calib_full_result_t result{};
    Reason why;
    int status = 0;

    Solution(const Fixture& fixture, const std::vector<double>& readings, double fixture_rad = 0, double robust = 0,
             unsigned fixed = 0)
    {
        const size_t n = N * fixture.sensors.size();
        p.resize(n);
        covariance.resize(n * n);
        attitude.resize(3 * fixture.poses.size());
        residual.resize(readings.size());
        condition.resize(fixture.sensors.size());
        result.p = p.data();
        result.covariance = covariance.data();
        result.attitude = attitude.data();
        result.residual = residual.data();
        result.condition = condition.data();
        const ins_calib_full_t in = {fixture.sensors.size(),
                                     fixture.poses.size(),
                                     fixture.sensors.data(),
                                     fixture.poses.data(),
                                     readings.data(),
                                     fixture.g,
                                     fixture_rad,
                                     robust,
                                     fixed};
        status = ins_calib_full(&in, &result, why.text, sizeof why.text);
    }
    double deviation(size_t i) const { return std::sqrt(covariance[i * p.size() + i]); }
};
} // namespace calib_test
#endif // INS_TESTS_CALIB_FIXTURE_HPP
