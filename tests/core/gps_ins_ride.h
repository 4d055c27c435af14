/// \file   gps_ins_ride.h
/// \brief  A GPS/INS filter on a known track: the truth's increments with the errors of an IMU, fixes with theirs, the errors left.
///
/// Units: SI, rad. An error is truth less estimate, in the order of ins/kf15.h.
/// SPDX-License-Identifier: MIT
#ifndef INS_TESTS_GPS_INS_RIDE_H
#define INS_TESTS_GPS_INS_RIDE_H
#include "core_test.h"
#include "ins_truth/exact.h"
#include "ins_truth/imu.h"
#include <cstdint>
#include <memory>
#include <random>

namespace core_test
{
namespace ride
{
constexpr size_t N = INS_KF15_N;
using Errors = std::array<double, N>;
using Increments = std::vector<std::array<double, 6>>;

constexpr ins_track_site_t SITE = {0.9, 0.23, 120.0, INS_TRACK_G_NORMAL, true};
constexpr double HZ = 100;
constexpr int64_t T0_NS = INT64_C(1300000000000000000); ///< some day of 2021, on the scale of GPS

struct Close
{
    void operator()(ins_track_t* track) const { ins_track_destroy(track); }
};
using Track = std::unique_ptr<ins_track_t, Close>;

inline int64_t ns(double t)
{
    return T0_NS + std::llround(t * 1e9);
}

/// A figure of eight of 15 m/s after `rest_s` at rest.
inline Track eight(double rest_s)
{
    const ins_track_speed_t speed = {15, rest_s, 8, INFINITY, 8};
    char why[200] = "";
    Track track(ins_track_create_eight(&SITE, 0.4, 300, 90, &speed, nullptr, why, sizeof why));
    EXPECT_NE(track, nullptr) << why;
    return track;
}

inline Increments increments(const ins_track_t* track, double duration_s)
{
    Increments out(static_cast<size_t>(duration_s * HZ));
    for (size_t k = 0; k < out.size(); k++)
    {
        ins_truth_increment(track, static_cast<double>(k) / HZ, static_cast<double>(k + 1) / HZ, out[k].data(),
                            out[k].data() + 3);
    }
    return out;
}

inline ins_position_t place(const double llh[3])
{
    ins_position_t p;
    for (size_t i = 0; i < 3; i++)
    {
        p.anchor[i] = static_cast<ins_real>(llh[i]);
        p.offset[i] = static_cast<ins_real>(llh[i] - static_cast<double>(p.anchor[i]));
    }
    return p;
}

inline Vec geodetic(const ins_position_t& p)
{
    Vec llh;
    for (size_t i = 0; i < 3; i++)
    {
        llh[i] = static_cast<double>(p.anchor[i]) + static_cast<double>(p.offset[i]);
    }
    return llh;
}

/// Metres north, east, down of a rad of latitude, of longitude, of a metre of height.
inline Vec scale(const double llh[3])
{
    ins_real radii[2];
    ins_earth_radii(static_cast<ins_real>(std::sin(llh[0])), radii);
    return {static_cast<double>(radii[0]) + llh[2], (static_cast<double>(radii[1]) + llh[2]) * std::cos(llh[0]), -1};
}

inline Quat turn(const Vec& phi)
{
    const double a = norm(phi), k = a > 1e-12 ? std::sin(a / 2) / a : 0.5;
    return {std::cos(a / 2), k * phi[0], k * phi[1], k * phi[2]};
}

/// The point l_b of the body.
inline ins_track_geodetic_t point(const ins_track_t* track, double t, const Vec& l_b)
{
    ins_track_geodetic_t g;
    ins_track_state_t s;
    ins_track_geodetic(track, t, &g);
    ins_track_at(track, t, &s);
    const Quat q = {g.q_nb[0], g.q_nb[1], g.q_nb[2], g.q_nb[3]};
    const Vec u_b = {s.w_ib_b[1] * l_b[2] - s.w_ib_b[2] * l_b[1], s.w_ib_b[2] * l_b[0] - s.w_ib_b[0] * l_b[2],
                     s.w_ib_b[0] * l_b[1] - s.w_ib_b[1] * l_b[0]};
    const Quat l = mul(mul(q, {0, l_b[0], l_b[1], l_b[2]}), conj(q)),
               u = mul(mul(q, {0, u_b[0], u_b[1], u_b[2]}), conj(q));
    const Vec per = scale(g.llh);
    for (size_t i = 0; i < 3; i++)
    {
        g.llh[i] += l[i + 1] / per[i];
        g.v_n[i] += u[i + 1];
    }
    return g;
}

/// A filter, its IMU and its receiver.
struct Ride
{
    const ins_track_t* track;
    std::mt19937_64 random;
    std::normal_distribution<double> normal;
    ins_gps_ins_config_t cfg;
    ins_imu_config_t sensor;
    ins_imu_t imu;
    union
    {
        ins_gps_ins_ud_t both;
        ins_gps_ins_scale_t scaled;
    };
    ins_gps_ins_t& nav = both.base; ///< scaled.base as well
    bool ud = false;
    const ins_kf15_scale_sensors_t* scales = nullptr; ///< of the filter with scale factors
    double sigma_p = 1, sigma_v = 0.1;                ///< of the fixes

    Ride(const ins_track_t* on, uint64_t seed) : track(on), random(seed)
    {
        ins_gps_ins_config(&cfg);
        ins_imu_ideal_config(&sensor);
        sensor.seed = seed;
    }
    /// The IMU errs as the filter is told.
    void sensor_as_told()
    {
        const ins_kf15_sensors_t& s = cfg.sensors;
        for (size_t i = 0; i < 3; i++)
        {
            sensor.gyro.random_walk[i] = static_cast<double>(s.arw);
            sensor.accel.random_walk[i] = static_cast<double>(s.vrw);
            sensor.gyro.markov[i] = static_cast<double>(s.bg_sigma);
            sensor.accel.markov[i] = static_cast<double>(s.ba_sigma);
        }
        sensor.gyro.markov_tau_s = static_cast<double>(s.bg_tau);
        sensor.accel.markov_tau_s = static_cast<double>(s.ba_tau);
    }
    Vec noise(double sigma) { return {sigma * normal(random), sigma * normal(random), sigma * normal(random)}; }

    /// The truth at t, off by errors drawn from sigma.
    void start(double t, const Errors& sigma)
    {
        char why[200] = "";
        ins_track_geodetic_t g;
        ins_track_geodetic(track, t, &g);
        const Vec phi = {sigma[0] * normal(random), sigma[1] * normal(random), sigma[2] * normal(random)};
        const Quat q = mul(turn({-phi[0], -phi[1], -phi[2]}), {g.q_nb[0], g.q_nb[1], g.q_nb[2], g.q_nb[3]});
        const Vec per = scale(g.llh);
        ins_gps_ins_start_t s = {};
        s.t_ns = ns(t);
        for (size_t i = 0; i < 4; i++)
        {
            s.q_nb[i] = static_cast<ins_real>(q[i]);
        }
        for (size_t i = 0; i < 3; i++)
        {
            s.v_n[i] = static_cast<ins_real>(g.v_n[i] - sigma[3 + i] * normal(random));
            g.llh[i] -= sigma[6 + i] * normal(random) / per[i];
        }
        s.position = place(g.llh);
        for (size_t i = 0; i < N; i++)
        {
            s.sigma[i] = static_cast<ins_real>(sigma[i]);
        }
        ASSERT_TRUE(ins_imu_init(&imu, &sensor, why, sizeof why)) << why;
        ASSERT_EQ(scales != nullptr ? ins_gps_ins_scale_init(&scaled, &cfg, scales, &s)
                  : ud              ? ins_gps_ins_ud_init(&both, &cfg, &s)
                                    : ins_gps_ins_init(&nav, &cfg, &s),
                  INS_OK);
    }
    ins_increment_t sample(const std::array<double, 6>& exact)
    {
        double theta[3], v[3];
        ins_imu_apply(&imu, 1 / HZ, 0, exact.data(), exact.data() + 3, theta, v);
        ins_increment_t x;
        for (size_t i = 0; i < 3; i++)
        {
            x.theta_b[i] = static_cast<ins_real>(theta[i]);
            x.v_b[i] = static_cast<ins_real>(v[i]);
        }
        return x;
    }
    ins_status_t step(double t, const std::array<double, 6>& exact)
    {
        const ins_increment_t x = sample(exact);
        return ins_gps_ins_step(&nav, ns(t), static_cast<ins_real>(1 / HZ), &x);
    }
    ins_gnss_fix_t fix(double t)
    {
        const ins_track_geodetic_t g = point(track, t, vec(cfg.antenna_b));
        const Vec per = scale(g.llh), dp = noise(sigma_p), dv = noise(sigma_v);
        double llh[3];
        ins_gnss_fix_t f;
        f.t_ns = ns(t) - std::llround(static_cast<double>(cfg.gnss_late) * 1e9);
        for (size_t i = 0; i < 3; i++)
        {
            llh[i] = g.llh[i] + dp[i] / per[i];
            f.v_n[i] = static_cast<ins_real>(g.v_n[i] + dv[i]);
            f.sigma_p[i] = static_cast<ins_real>(sigma_p);
            f.sigma_v[i] = static_cast<ins_real>(sigma_v);
        }
        f.position = place(llh);
        return f;
    }
    /// Truth less estimate at t.
    Errors errors(double t) const
    {
        ins_track_geodetic_t g;
        ins_track_geodetic(track, t, &g);
        const Vec phi = rotation_between({g.q_nb[0], g.q_nb[1], g.q_nb[2], g.q_nb[3]}, quat(nav.nav.sculling.q_nb));
        const Vec llh = geodetic(nav.nav.position), per = scale(g.llh);
        Errors e;
        for (size_t i = 0; i < 3; i++)
        {
            e[i] = phi[i];
            e[3 + i] = g.v_n[i] - static_cast<double>(nav.nav.v_n[i]);
            e[6 + i] = (g.llh[i] - llh[i]) * per[i];
            e[9 + i] = imu.gyro.bias[i] - static_cast<double>(nav.gyro_bias[i]);
            e[12 + i] = imu.accel.bias[i] - static_cast<double>(nav.accel_bias[i]);
        }
        return e;
    }
};

/// e P^-1 e; NaN if P is not positive. \param[in] P  P(i, j)
template <size_t M, typename Matrix> double quadratic(const std::array<double, M>& e, const Matrix& P)
{
    double L[M][M], y[M], sum = 0;
    for (size_t i = 0; i < M; i++)
    {
        y[i] = e[i];
        for (size_t j = 0; j <= i; j++)
        {
            double s = static_cast<double>(P(i, j));
            for (size_t k = 0; k < j; k++)
            {
                s -= L[i][k] * L[j][k];
            }
            L[i][j] = i == j ? std::sqrt(s) : s / L[j][j];
            y[i] -= j < i ? L[i][j] * y[j] : 0;
        }
        y[i] /= L[i][i];
        sum += y[i] * y[i];
    }
    return sum;
}

inline double nees(const ins_gps_ins_t& nav, const Errors& e)
{
    return quadratic(e, [&](size_t i, size_t j) { return nav.kf.P[INS_KF15_ROW * i + j]; });
}

/// 95 % of a chi-squared variable of n degrees of freedom lie in here (Wilson and Hilferty 1931).
inline std::array<double, 2> chi2_95(double n)
{
    const double a = 2 / (9 * n), z = 1.959964 * std::sqrt(a);
    return {n * std::pow(1 - a - z, 3), n * std::pow(1 - a + z, 3)};
}

/// A sum of squares that should be chi-squared.
struct Squares
{
    double sum = 0, freedom = 0;
    void take(double x, double n)
    {
        sum += x;
        freedom += n;
    }
    void expect(const char* what) const
    {
        const auto bounds = chi2_95(freedom);
        std::printf("[ figure   ] %s: %.4f a degree of freedom of %.0f, 95 %% within %.4f .. %.4f\n", what,
                    sum / freedom, freedom, bounds[0] / freedom, bounds[1] / freedom);
        EXPECT_GE(sum, bounds[0]) << what;
        EXPECT_LE(sum, bounds[1]) << what;
    }
};
} // namespace ride
} // namespace core_test

#endif // INS_TESTS_GPS_INS_RIDE_H
