/// \file   test_gps_ins_scale.cpp
/// \brief  GPS/INS with scale factors: does it err as its covariance says, and does it find them where 15 states do not? SI, rad.
///
/// The truth is libins_truth's. INS_BENCH=1: all 200 runs.
/// SPDX-License-Identifier: MIT
#include "gps_ins_ride.h"
#include "kf15_runs.h"
#include <cstring>

using namespace core_test;
using namespace core_test::ride;

namespace
{
constexpr int RUNS = 12; ///< two at each instant
constexpr int BENCH_RUNS = 200;
constexpr double DURATION_S = 60;
constexpr size_t FIX_EVERY = 20; ///< samples: 5 Hz
constexpr size_t N21 = N + INS_KF15_SCALE_N;
constexpr uint64_t SEED = 10001;
constexpr double SIGMA = 0.01;
constexpr double RATE_SIGMA = 2e-4; ///< [rad/s]
constexpr ins_kf15_scale_sensors_t SENSORS = {ins_real(SIGMA), ins_real(SIGMA), ins_real(1e6), ins_real(1e6)};
constexpr Errors START = {0.01, 0.01, 0.05, 0.2, 0.2, 0.2, 2, 2, 2, 1.7e-3, 1.7e-3, 1.7e-3, 0.05, 0.05, 0.05};

int runs()
{
    return std::getenv("INS_BENCH") != nullptr ? BENCH_RUNS : RUNS;
}

/// A ride whose sensors have these scale errors, and a filter that looks for some.
struct ScaledRide : Ride
{
    ScaledRide(const ins_track_t* on, uint64_t seed) : Ride(on, seed)
    {
        scales = &SENSORS;
        sensor_as_told();
    }
    void scale_errors(const Vec& gyro, const Vec& accel)
    {
        std::copy(gyro.begin(), gyro.end(), sensor.gyro.scale);
        std::copy(accel.begin(), accel.end(), sensor.accel.scale);
    }
    std::array<double, N21> all_errors(double t) const
    {
        std::array<double, N21> e;
        const Errors of15 = errors(t);
        std::copy(of15.begin(), of15.end(), e.begin());
        for (size_t i = 0; i < 3; i++)
        {
            e[N + i] = sensor.gyro.scale[i] - static_cast<double>(scaled.gyro[i]);
            e[N + 3 + i] = sensor.accel.scale[i] - static_cast<double>(scaled.accel[i]);
        }
        return e;
    }
    double at(size_t i, size_t j) const
    {
        return static_cast<double>(i < N && j < N ? nav.kf.P[INS_KF15_ROW * i + j]
                                   : j < N        ? scaled.kf.B[INS_KF15_SCALE_N * j + i - N]
                                                  : scaled.kf.B[INS_KF15_SCALE_N * i + j - N]);
    }
    double all_nees(double t) const
    {
        return quadratic(all_errors(t), [&](size_t i, size_t j) { return at(i, j); });
    }
    /// Sample k and the fix that belongs to it. \return true after a fix.
    bool next(const Increments& exact, size_t k)
    {
        const double t = static_cast<double>(k + 1) / HZ;
        EXPECT_EQ(step(t, exact[k]), INS_OK);
        if ((k + 1) % FIX_EVERY != 0)
        {
            return false;
        }
        const ins_gnss_fix_t f = fix(t);
        EXPECT_EQ(ins_gps_ins_gnss(&nav, &f), INS_OK);
        return true;
    }
};

struct Consistency
{
    Squares nees; ///< of each run at one of six instants, so that they are independent
    Squares position, velocity;

    void expect(const std::string& what) const
    {
        nees.expect((what + "NEES of 21").c_str());
        position.expect((what + "NIS of positions").c_str());
        velocity.expect((what + "NIS of velocities").c_str());
    }
};

/// \param[in] arm  the antenna is on an arm, a better gyro says the yaw rate at 2 Hz, and the covariance takes a step each 5 samples.
Consistency many_runs(bool arm)
{
    const ride::Track track = eight(5);
    const Increments exact = increments(track.get(), DURATION_S);
    Consistency out;
    for (int run = 0; run < runs(); run++)
    {
        ScaledRide r(track.get(), SEED + static_cast<uint64_t>(run));
        r.cfg.stuck = 0;
        r.cfg.gate_position = 0;
        r.cfg.gate_velocity = 0;
        r.cfg.gate = 0;
        const Vec gyro = r.noise(SIGMA);
        const Vec accel = r.noise(SIGMA);
        r.scale_errors(gyro, accel);
        if (arm)
        {
            r.cfg.decimate = 5;
            r.cfg.antenna_b[0] = ins_real(1.5);
            r.cfg.antenna_b[1] = ins_real(0.5);
            r.cfg.antenna_b[2] = -1;
        }
        r.start(0, START);
        for (size_t k = 0; k < exact.size(); k++)
        {
            const double t = static_cast<double>(k + 1) / HZ;
            if (r.next(exact, k))
            {
                out.position.take(static_cast<double>(r.nav.check.nis_position), 3);
                out.velocity.take(static_cast<double>(r.nav.check.nis_velocity), 3);
            }
            if (arm && (k + 1) % 50 == 10)
            {
                ins_track_state_t s;
                ins_track_at(track.get(), t, &s);
                const double rate = s.w_ib_b[2] + RATE_SIGMA * r.normal(r.random);
                EXPECT_EQ(ins_gps_ins_yaw_rate(&r.nav, static_cast<ins_real>(rate), ins_real(RATE_SIGMA)), INS_OK);
            }
            if (k + 1 == static_cast<size_t>(run % 6 + 1) * exact.size() / 6)
            {
                out.nees.take(r.all_nees(t), N21);
            }
        }
    }
    return out;
}

TEST(gps_ins_scale, nees_and_nis_of_many_runs_are_chi_squared)
{
    many_runs(false).expect("");
}

TEST(gps_ins_scale, so_they_are_with_an_arm_and_another_gyro)
{
    many_runs(true).expect("with an arm: ");
}

/// One hundredth on all six, in a car that turns both ways and brakes.
TEST(gps_ins_scale, finds_what_fifteen_states_cannot_say)
{
    constexpr int AS_MANY = 4;
    constexpr double LONG_S = 150; ///< two eights
    const ride::Track track = eight(5);
    const Increments exact = increments(track.get(), LONG_S);
    double plain = 0, scaled = 0, worst = 0, heading[2] = {0, 0};
    for (int run = 0; run < AS_MANY; run++)
    {
        for (const bool with : {true, false})
        {
            ScaledRide r(track.get(), static_cast<uint64_t>(run + 1));
            r.cfg.gate_position = 0;
            r.cfg.gate_velocity = 0;
            r.scale_errors({SIGMA, -SIGMA, SIGMA}, {SIGMA, -SIGMA, SIGMA});
            r.scales = with ? &SENSORS : nullptr;
            r.start(0, START);
            for (size_t k = 0; k < exact.size(); k++)
            {
                (void)r.next(exact, k);
            }
            const Errors e = r.errors(LONG_S);
            (with ? scaled : plain) += nees(r.nav, e) / (AS_MANY * static_cast<double>(N));
            heading[with ? 1 : 0] += e[2] * e[2] / AS_MANY;
            const auto all = r.all_errors(LONG_S);
            for (size_t i = N; with && i < N21; i++)
            {
                worst = larger(worst, std::fabs(all[i]) / std::sqrt(r.at(i, i)));
            }
            if (with && run == 0)
            {
                std::printf(
                    "[ figure   ] 1 %% on each: gyro z to %.3f %% with sigma %.3f %%, accelerometer x to %.3f %% with "
                    "%.3f %%\n",
                    100 * all[N + 2], 100 * std::sqrt(r.at(N + 2, N + 2)), 100 * all[N + 3],
                    100 * std::sqrt(r.at(N + 3, N + 3)));
                EXPECT_LT(std::sqrt(r.at(N + 2, N + 2)), 0.3 * SIGMA) << "the gyro that turns";
                EXPECT_LT(std::sqrt(r.at(N + 3, N + 3)), 0.4 * SIGMA) << "the accelerometer along the way";
            }
        }
    }
    std::printf("[ figure   ] NEES of the 15 a degree of freedom: %.2f with scale factors, %.2f without; heading %.4f "
                "and %.4f rad\n",
                scaled, plain, std::sqrt(heading[1]), std::sqrt(heading[0]));
    EXPECT_LT(worst, 4);
    EXPECT_LT(scaled, 1.5);
    EXPECT_GT(plain, 2);
    EXPECT_LT(heading[1], heading[0]);
}

TEST(gps_ins_scale, survives_gaps_and_refuses_a_wrong_start)
{
    const ride::Track track = eight(5);
    const Increments exact = increments(track.get(), DURATION_S);
    ScaledRide r(track.get(), 3);
    r.scale_errors({SIGMA, SIGMA, SIGMA}, {SIGMA, SIGMA, SIGMA});
    r.start(0, START);
    for (size_t k = 0; k < exact.size(); k++)
    {
        if (k % 500 > 20) // 0.2 s are lost each 5 s
        {
            (void)r.next(exact, k);
        }
        else
        {
            (void)r.sample(exact[k]);
        }
    }
    EXPECT_EQ(r.nav.count.imu_gaps, 12u);
    EXPECT_LT(r.all_nees(DURATION_S) / static_cast<double>(N21), 2.5);
    ins_gps_ins_start_t start = {};
    start.q_nb[0] = 1;
    const ins_gps_ins_t before = r.nav;
    const ins_kf15_scale_sensors_t wide = {ins_real(0.2), 0, 100, 100};
    EXPECT_EQ(ins_gps_ins_scale_init(&r.scaled, &r.cfg, &wide, &start), INS_E_RANGE);
    start.sigma[0] = 1; // rad
    EXPECT_EQ(ins_gps_ins_scale_init(&r.scaled, &r.cfg, &SENSORS, &start), INS_E_RANGE);
    EXPECT_EQ(std::memcmp(&r.nav, &before, sizeof before), 0);
}

/// In a turn the gyro's scale factor turns the attitude, seen or not.
TEST(gps_ins_scale, a_gap_moves_what_goes_with_them)
{
    const ride::Track track = eight(5);
    const Increments exact = increments(track.get(), 30);
    double crossed[2];
    for (const bool gap : {false, true})
    {
        ScaledRide r(track.get(), 5);
        r.start(20, START);
        for (size_t k = 2000; k < exact.size(); k++)
        {
            if (!gap || k < 2400 || k >= 2490)
            {
                ASSERT_EQ(r.step(static_cast<double>(k + 1) / HZ, exact[k]), INS_OK);
            }
        }
        EXPECT_EQ(r.nav.count.imu_gaps, gap ? 1u : 0u);
        crossed[gap ? 1 : 0] = r.at(INS_KF15_PHI + 2, N + 2);
    }
    EXPECT_NEAR(crossed[1] / crossed[0], 1, 0.02) << "0.9 of 10 s are unseen";
}

/// Velocity of an antenna far out on an arm, in a turn: three rows that feel biases and scale factors alike.
TEST(gps_ins_scale, rows_that_feel_the_rate_are_the_dense_filters)
{
    const ride::Track track = eight(5);
    const Increments exact = increments(track.get(), 20);
    ScaledRide r(track.get(), 6);
    r.scale_errors({SIGMA, -SIGMA, SIGMA}, {SIGMA, -SIGMA, SIGMA});
    r.cfg.antenna_b[0] = 30;
    r.cfg.antenna_b[1] = -20;
    r.cfg.antenna_b[2] = 10;
    r.cfg.gate_velocity = 0;
    r.start(0, START);
    for (size_t k = 0; k < exact.size(); k++)
    {
        ASSERT_EQ(r.step(static_cast<double>(k + 1) / HZ, exact[k]), INS_OK);
    }
    DenseFilter<N21> dense;
    for (size_t i = 0; i < N21 * N21; i++)
    {
        dense.P[i / N21][i % N21] = static_cast<long double>(r.at(i / N21, i % N21));
    }
    ins_real C[9], turning[3], u[3];
    ins_quat_to_dcm(r.nav.nav.sculling.q_nb, C);
    ins_vec_cross(r.nav.w_ib_b, r.cfg.antenna_b, turning);
    ins_quat_rotate(r.nav.nav.sculling.q_nb, turning, u);
    std::array<std::array<ins_real, N21>, 3> H = {};
    for (size_t i = 0; i < 3; i++)
    {
        H[i][INS_KF15_V + i] = 1;
        H[i][(i + 1) % 3] = u[(i + 2) % 3];
        H[i][(i + 2) % 3] = -u[(i + 1) % 3];
        ins_vec_cross(C + 3 * i, r.cfg.antenna_b, H[i].data() + INS_KF15_BG);
        for (size_t k = 0; k < 3; k++)
        {
            H[i][N + k] = H[i][INS_KF15_BG + k] * r.nav.w_ib_b[k];
        }
    }
    const std::array<double, N21> before = r.all_errors(20);
    r.sigma_v = 1e-3;
    ins_gnss_fix_t f = r.fix(20);
    std::fill(f.sigma_p, f.sigma_p + 3, ins_real(0));
    ASSERT_EQ(ins_gps_ins_gnss(&r.nav, &f), INS_OK);
    std::array<double, N21> x = {};
    double joint = 0;
    for (size_t i = 0; i < 3; i++)
    {
        double v = static_cast<double>(r.nav.check.innovation[3 + i]);
        long double s = static_cast<long double>(r.sigma_v * r.sigma_v);
        for (size_t j = 0; j < N21; j++)
        {
            v -= static_cast<double>(H[i][j]) * x[j];
            for (size_t k = 0; k < N21; k++)
            {
                s += static_cast<long double>(H[i][j]) * dense.P[j][k] * static_cast<long double>(H[i][k]);
            }
        }
        joint += v * v / static_cast<double>(s);
        dense.update(H[i], r.sigma_v * r.sigma_v);
        for (size_t j = 0; j < N21; j++)
        {
            x[j] += static_cast<double>(dense.K[j]) * v;
        }
    }
    EXPECT_NEAR(static_cast<double>(r.nav.check.nis_velocity) / joint, 1, INS_TOL(1e-9, 2e-3));
    const std::array<double, N21> after = r.all_errors(20);
    for (size_t j = INS_KF15_BG; j < N21; j++)
    {
        const double sigma = std::sqrt(static_cast<double>(dense.P[j][j]));
        EXPECT_NEAR((before[j] - after[j]) / sigma, x[j] / sigma, INS_TOL(1e-6, 0.02)) << "state " << j;
    }
}

/// The filter doubts itself: what it knew of scale factors stays, what went with position is gone.
TEST(gps_ins_scale, a_new_start_of_the_covariance_keeps_them)
{
    const ride::Track track = eight(5);
    const Increments exact = increments(track.get(), DURATION_S);
    ScaledRide r(track.get(), 4);
    r.cfg.refused_max = 2;
    r.start(0, START);
    for (size_t k = 0; k < exact.size() / 2; k++)
    {
        (void)r.next(exact, k);
    }
    const double known = r.at(N + 2, N + 2);
    for (int i = 0; r.nav.count.fix_doubts == 0 && i < 10; i++)
    {
        ins_gnss_fix_t f = r.fix(DURATION_S / 2);
        f.position.offset[0] += ins_real(1e-4); // 640 m
        f.v_n[1] += 20;
        (void)ins_gps_ins_gnss(&r.nav, &f);
    }
    ASSERT_EQ(r.nav.count.fix_doubts, 1u);
    EXPECT_EQ(r.at(N + 2, N + 2), known);
    for (size_t i = 0; i < N; i++)
    {
        EXPECT_EQ(r.at(i, N + 2), 0) << i;
    }
}
} // namespace
