/// \file   gyro_free_runs.h
/// \brief  Simulated flights for the gyro-free filter: a track of libins_truth, six readings with noise and biases, fixes. SI, rad.
/// SPDX-License-Identifier: MIT
#ifndef INS_TESTS_GYRO_FREE_RUNS_H
#define INS_TESTS_GYRO_FREE_RUNS_H
#include "core_test.h"
#include "ins_truth/accel.h"
#include <memory>
#include <random>

namespace gyro_free
{
using Real3 = std::array<ins_real, 3>;
using Error = std::array<double, INS_GYRO_FREE_N>;
using Track = std::unique_ptr<ins_track_t, decltype(&ins_track_destroy)>;
constexpr double PERIOD_S = 0.01;
constexpr double DEG = core_test::PI / 180.0;
constexpr ins_track_site_t SITE = {24.757 * DEG, 120.951 * DEG, 60.0, INS_TRACK_G_NORMAL, true};

inline Track still()
{
    return {ins_track_create_still(&SITE, nullptr, nullptr, 0), ins_track_destroy};
}
/// A level eight of 60 m by 40 m, crossed at 8 m/s, from rest after rest_s: up to 4 m/s^2 to the side.
inline Track eight(double rest_s)
{
    const ins_track_speed_t speed = {8.0, rest_s, 4.0, INFINITY, 4.0};
    return {ins_track_create_eight(&SITE, 0.4, 60.0, 40.0, &speed, nullptr, nullptr, 0), ins_track_destroy};
}

inline ins_position_t position_of(const double llh[3])
{
    ins_position_t p{};
    for (int i = 0; i < 3; i++)
    {
        p.anchor[i] = ins_real(llh[i]);
        p.offset[i] = ins_real(llh[i] - double(p.anchor[i]));
    }
    return p;
}

inline void product(const double p[4], const double q[4], double out[4])
{
    out[0] = p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3];
    out[1] = p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2];
    out[2] = p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1];
    out[3] = p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0];
}

/// One run; errors are truth less estimate.
class Flight
{
  public:
    Flight(const Track& track, const ins_gyro_free_config_t& config, double rho, unsigned seed)
        : track_(track.get()), config_(config), random_(seed)
    {
        ins_accel_config_t accels;
        ins_accel_paper_config(&accels, rho, 4 * 9.80665, 0.0, 5.0);
        EXPECT_TRUE(ins_accels_init(&sensors_, &accels, track_, nullptr, 0));
        ins_sixacc_paper(ins_real(rho), model_);
    }
    /// An error of its own kind that the filter starts with, and biases of the readings.
    void begin(const Error& x, const std::array<double, 6>& bias)
    {
        ins_track_geodetic_t g;
        ins_track_state_t s;
        ins_track_geodetic(track_, 0.0, &g);
        ins_track_at(track_, 0.0, &s);
        const double half = 0.5 * std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
        const double sinc = half > 0.0 ? -0.5 * std::sin(half) / half : -0.5;
        const double back[4] = {std::cos(half), sinc * x[0], sinc * x[1], sinc * x[2]};
        double q[4];
        product(back, g.q_nb, q);
        const ins_real q_nb[4] = {ins_real(q[0]), ins_real(q[1]), ins_real(q[2]), ins_real(q[3])};
        Real3 v;
        ins_position_t p = position_of(g.llh);
        p.offset[0] -= ins_real(x[6] / 6.35e6); // what it is exactly is asked of error() below
        p.offset[1] -= ins_real(x[7] / (6.378e6 * std::cos(g.llh[0])));
        p.offset[2] += ins_real(x[8]);
        for (size_t i = 0; i < 3; i++)
        {
            v[i] = ins_real(g.v_n[i] - x[3 + i]);
        }
        bias_ = bias;
        ASSERT_EQ(ins_gyro_free_init(&filter, &config_, 6, model_, ins_real(PERIOD_S), q_nb, v.data(), &p), INS_OK);
        for (size_t i = 0; i < 3; i++)
        {
            filter.sixacc.w_ib_b[i] = ins_real(s.w_ib_b[i] - x[9 + i]);
        }
    }
    void step(double noise)
    {
        ins_real readings[6];
        const int64_t t_ps = k_ * int64_t(PERIOD_S * 1e12);
        for (unsigned j = 0; j < 6; j++)
        {
            const double white = noise > 0.0 ? noise * normal_(random_) : 0.0;
            readings[j] = ins_real(ins_accels_exact(&sensors_, j, t_ps) + bias_[j] + white);
        }
        const ins_status_t status = ins_gyro_free_step(&filter, readings);
        ASSERT_EQ(status, k_ == 0 ? INS_S_START : INS_OK);
        t_s = double(k_) * PERIOD_S;
        k_++;
    }
    ins_status_t fix(double sigma)
    {
        static const ins_real none[3] = {0, 0, 0};
        ins_track_geodetic_t g;
        ins_track_geodetic(track_, t_s, &g);
        ins_position_t p = position_of(g.llh);
        p.offset[0] += ins_real(sigma * normal_(random_) / 6.35e6);
        p.offset[1] += ins_real(sigma * normal_(random_) / (6.378e6 * std::cos(g.llh[0])));
        p.offset[2] += ins_real(sigma * normal_(random_));
        const Real3 each = {ins_real(sigma), ins_real(sigma), ins_real(sigma)};
        return ins_gyro_free_position(&filter, &p, each.data(), none);
    }
    Error error() const
    {
        Error x{};
        ins_track_geodetic_t g;
        ins_track_state_t s;
        ins_track_geodetic(track_, t_s, &g);
        ins_track_at(track_, t_s, &s);
        const ins_real* e = filter.strapdown.sculling.q_nb;
        const double back[4] = {double(e[0]), -double(e[1]), -double(e[2]), -double(e[3])};
        double dq[4];
        product(g.q_nb, back, dq);
        const double sine = std::sqrt(dq[1] * dq[1] + dq[2] * dq[2] + dq[3] * dq[3]);
        const double angle = 2.0 * std::atan2(sine, std::fabs(dq[0])) * (dq[0] < 0.0 ? -1.0 : 1.0);
        const ins_position_t truth = position_of(g.llh);
        Real3 dp;
        ins_position_difference(&filter.strapdown.position, &truth, dp.data());
        for (size_t i = 0; i < 3; i++)
        {
            x[i] = sine > 0.0 ? angle * dq[1 + i] / sine : 0.0;
            x[3 + i] = g.v_n[i] - double(filter.strapdown.v_n[i]);
            x[6 + i] = double(dp[i]);
            x[9 + i] = s.w_ib_b[i] - double(filter.sixacc.w_ib_b[i]);
        }
        for (size_t i = 0; i < 6; i++)
        {
            for (size_t j = 0; j < 6; j++)
            {
                x[12 + i] += double(filter.sixacc.inverse[i][j]) * (bias_[j] - double(filter.sixacc.bias[j]));
            }
        }
        return x;
    }
    /// x' P^-1 x: with y of U y = x, the sum of y^2 / D.
    double nees() const
    {
        Error y = error();
        double sum = 0.0;
        for (int j = INS_GYRO_FREE_N - 1; j >= 0; j--)
        {
            const ins_real* column = filter.UD + j * (j + 1) / 2;
            for (int i = 0; i < j; i++)
            {
                y[size_t(i)] -= double(column[i]) * y[size_t(j)];
            }
            sum += y[size_t(j)] * y[size_t(j)] / double(column[j]);
        }
        return sum;
    }
    /// Of accelerometer j's reading by angular acceleration about an axis [m].
    double moment(size_t j, size_t axis) const
    {
        const size_t a = (axis + 1) % 3;
        const size_t b = (axis + 2) % 3;
        return double(model_[j].r[a] * model_[j].axis[b] - model_[j].r[b] * model_[j].axis[a]);
    }
    double draw() { return normal_(random_); }

    ins_gyro_free_t filter{};
    double t_s = 0.0;

  private:
    const ins_track_t* track_;
    ins_gyro_free_config_t config_;
    ins_accels_t sensors_{};
    ins_accel_t model_[6];
    std::array<double, 6> bias_{};
    std::mt19937 random_;
    std::normal_distribution<double> normal_;
    int64_t k_ = 0;
};

} // namespace gyro_free
#endif // INS_TESTS_GYRO_FREE_RUNS_H
