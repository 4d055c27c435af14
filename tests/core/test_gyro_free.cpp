/// \file   test_gyro_free.cpp
/// \brief  Navigation by accelerometers alone: the filter's model against perturbed runs, growth without aiding, consistency. SI, rad.
/// SPDX-License-Identifier: MIT
#include "gyro_free_runs.h"

using namespace gyro_free;

namespace
{
const bool FULL = std::getenv("INS_BENCH") != nullptr;
const int RUNS = FULL ? 200 : 20;
constexpr double RHO = 0.1;
constexpr double NOISE = 1e-3;
constexpr double LONG_RHO =
    0.3; ///< with this and NOISE the attitude stays within what is linear: the map in docs/gyro_free.md
constexpr double FLIGHT_S = 40.0;
constexpr double BIAS = 2e-4; ///< of calibrated accelerometers [m/s^2]
constexpr double FIX_S = 0.2;
constexpr double FIX_M = 0.3;

ins_gyro_free_config_t config_of(double noise)
{
    return {ins_real(noise), ins_real(BIAS),  0, {ins_real(0.01), ins_real(0.01), ins_real(0.02)}, ins_real(0.05),
            ins_real(0.5),   ins_real(0.002), 0};
}
} // namespace

/// One kind of error at a time: the covariance that the filter carries forward is that of runs which start off by each of its axes.
TEST(gyro_free, covariance_is_that_of_perturbed_runs)
{
    const Track track = eight(0.0);
    const double of_kind[] = {1e-3, 1e-2, 0.5, 1e-3, 1e-3}; // attitude, velocity, position, rate, bias
    const double smallest[] = {1e-5, 1e-4, 1e-3, 1e-4, 1e-5, 1e-4};
    const double tolerance = INS_TOL(0.03, 0.05); // first order in the period, over 3 s
    for (int kind = 0; kind < 5; kind++)
    {
        ins_gyro_free_config_t config = {ins_real(1e-9), 0, 0, {0, 0, 0}, 0, 0, 0, 0};
        const auto size = ins_real(of_kind[kind]);
        ins_real* const figure[] = {config.attitude, &config.velocity, &config.position, &config.rate, &config.bias};
        *figure[kind] = size;
        config.attitude[1] = config.attitude[2] = config.attitude[0];
        Flight base(track, config, RHO, 1);
        base.begin({}, {});
        std::vector<Flight> off;
        for (size_t axis = 0; axis < (kind == 4 ? 6 : 3); axis++)
        {
            off.emplace_back(track, config, RHO, 1);
            Error x{};
            std::array<double, 6> bias{};
            (kind == 4 ? bias[axis] : x[3 * size_t(kind) + axis]) = double(size);
            off.back().begin(x, bias);
        }
        for (int k = 0; k < 300; k++)
        {
            base.step(0.0);
            for (Flight& flight : off)
            {
                flight.step(0.0);
            }
        }
        const Error zero = base.error();
        ins_real sigma[INS_GYRO_FREE_N];
        ins_gyro_free_sigma(&base.filter, sigma);
        for (size_t i = 0; i < INS_GYRO_FREE_N; i++)
        {
            double square = 0.0;
            for (const Flight& flight : off)
            {
                square += std::pow(flight.error()[i] - zero[i], 2);
            }
            EXPECT_NEAR(double(sigma[i]), std::sqrt(square), tolerance * std::sqrt(square) + smallest[i / 3])
                << "kind " << kind << ", state " << i;
        }
    }
}

/// FORMULAS of the six: a bias of b gives s = b / (sqrt 2 rho) [rad/s^2], s t^2 / 2 of tilt and g s t^4 / 24 of way.
TEST(gyro_free, without_aiding_a_bias_of_1_mg_grows_as_its_fourth_integral)
{
    const Track track = still();
    Flight flight(track, config_of(1e-6), RHO, 1);
    const double b = 9.80665e-3;
    const double s = b / (std::sqrt(2.0) * RHO);
    std::array<double, 6> bias{}; // what looks like s about x, and like no force
    for (size_t j = 0; j < 6; j++)
    {
        bias[j] = s * flight.moment(j, 0);
    }
    flight.begin({}, bias);
    for (int k = 0; k <= 500; k++)
    {
        flight.step(0.0);
        if (k == 100 || k == 500)
        {
            const double t = flight.t_s;
            const Error x = flight.error();
            std::printf("after %g s: rate %.2f deg/s, attitude %.2f deg, position %.3f m\n", t, x[9] / DEG, x[0] / DEG,
                        x[7]);
            EXPECT_NEAR(std::fabs(x[9]), s * t, 0.01 * s * t);
            EXPECT_NEAR(std::fabs(x[0]), s * t * t / 2.0, 0.03 * s * t * t / 2.0);
            EXPECT_NEAR(std::fabs(x[7]), 9.79 * s * t * t * t * t / 24.0, 0.06 * 9.79 * s * t * t * t * t / 24.0);
        }
    }
}

TEST(gyro_free, a_standstill_calibrates_the_angular_acceleration)
{
    const Track track = still();
    ins_gyro_free_config_t config = config_of(NOISE);
    config.bias = ins_real(0.05);
    Flight flight(track, config, RHO, 3);
    flight.begin({}, {0.05, -0.02, 0.04, 0.01, -0.06, 0.03});
    for (int k = 0; k < 1000; k++)
    {
        flight.step(NOISE);
        ASSERT_EQ(ins_gyro_free_still(&flight.filter, ins_real(1e-3), ins_real(1e-3)), INS_OK);
    }
    const Error x = flight.error();
    ins_real sigma[INS_GYRO_FREE_N];
    ins_gyro_free_sigma(&flight.filter, sigma);
    for (size_t i = INS_GYRO_FREE_BD; i < INS_GYRO_FREE_BF; i++)
    {
        EXPECT_LT(double(sigma[i]), 1e-3) << "of 0.35 rad/s^2 at the start";
        EXPECT_LT(std::fabs(x[i]), 4 * double(sigma[i])) << "axis " << i - INS_GYRO_FREE_BD << ", seed 3";
    }
    EXPECT_LT(double(sigma[INS_GYRO_FREE_BF + 2]), 1e-3) << "the vertical one is seen beside gravity";
    EXPECT_GT(double(sigma[INS_GYRO_FREE_BF]), 0.03) << "a level one looks like a tilt";
}

TEST(gyro_free, a_fix_outside_the_gate_changes_nothing)
{
    const Track track = still();
    ins_gyro_free_config_t config = config_of(NOISE);
    config.gate = INS_KALMAN_GATE_999;
    Flight flight(track, config, RHO, 4);
    flight.begin({}, {});
    flight.step(NOISE);
    ins_position_t far = flight.filter.strapdown.position;
    far.offset[0] += ins_real(1e-4); // 636 m
    const ins_real sigma[3] = {1, 1, 1};
    const ins_real none[3] = {0, 0, 0};
    const ins_real before = flight.filter.strapdown.position.offset[0];
    EXPECT_EQ(ins_gyro_free_position(&flight.filter, &far, sigma, none), INS_E_GATE);
    EXPECT_EQ(flight.filter.refused, 1u);
    EXPECT_EQ(flight.filter.strapdown.position.offset[0], before);
    const ins_real bad[3] = {1, 0, 1};
    EXPECT_EQ(ins_gyro_free_position(&flight.filter, &far, bad, none), INS_E_RANGE);
    far.offset[2] = ins_real(NAN);
    EXPECT_EQ(ins_gyro_free_position(&flight.filter, &far, sigma, none), INS_E_RANGE);
    const ins_real nan[6] = {1, 1, 1, 1, ins_real(NAN), 1};
    EXPECT_EQ(ins_gyro_free_step(&flight.filter, nan), INS_E_RANGE);
}

TEST(gyro_free, refuses_a_configuration_that_cannot_work)
{
    ins_accel_t accels[6];
    ins_sixacc_paper(ins_real(RHO), accels);
    const ins_real level[4] = {1, 0, 0, 0};
    const ins_real rest[3] = {0, 0, 0};
    const ins_position_t place = {{ins_real(0.4), 2, 50}, {0, 0, 0}};
    ins_gyro_free_t g;
    const auto of = [&](const ins_gyro_free_config_t& config)
    { return ins_gyro_free_init(&g, &config, 6, accels, ins_real(PERIOD_S), level, rest, &place); };
    ins_gyro_free_config_t config = config_of(NOISE);
    EXPECT_EQ(of(config), INS_OK);
    config.noise = 0;
    EXPECT_EQ(of(config), INS_E_RANGE);
    config = config_of(NOISE);
    config.attitude[2] = ins_real(NAN);
    EXPECT_EQ(of(config), INS_E_RANGE);
    config = config_of(NOISE);
    config.bias = -1;
    EXPECT_EQ(of(config), INS_E_RANGE);
}

namespace
{
/// NEES a state at the end of RUNS drawn flights.
double nees_of_flights(ins_real heading, double seconds)
{
    const Track track = eight(0.0);
    ins_gyro_free_config_t config = config_of(NOISE);
    config.attitude[2] = heading;
    double total = 0.0;
    for (int run = 0; run < RUNS; run++)
    {
        Flight flight(track, config, LONG_RHO, unsigned(run + 1));
        Error x{};
        const double sigma[] = {0.01, 0.01, double(heading), 0.05, 0.05, 0.05, 0.5, 0.5, 0.5, 0.002, 0.002, 0.002};
        std::array<double, 6> bias{};
        for (size_t i = 0; i < 12; i++)
        {
            x[i] = sigma[i] * flight.draw();
        }
        for (double& b : bias)
        {
            b = BIAS * flight.draw();
        }
        flight.begin(x, bias);
        const int fix_each = int(FIX_S / PERIOD_S + 0.5);
        for (int k = 0; k <= int(seconds / PERIOD_S); k++)
        {
            flight.step(NOISE);
            if (k > 0 && k % fix_each == 0)
            {
                EXPECT_EQ(flight.fix(FIX_M), INS_OK);
            }
        }
        total += flight.nees();
    }
    return total / (double(INS_GYRO_FREE_N) * RUNS);
}
} // namespace

TEST(gyro_free, errors_are_those_of_its_covariance)
{
    const double nees = nees_of_flights(config_of(NOISE).attitude[2], FLIGHT_S);
    const double spread = 1.96 * std::sqrt(2.0 / (double(INS_GYRO_FREE_N) * RUNS));
    std::printf("NEES / %d over %d runs, seeds 1 to %d: %.3f; 95 %% bounds %.3f to %.3f\n", INS_GYRO_FREE_N, RUNS, RUNS,
                nees, 1.0 - spread, 1.0 + spread);
    EXPECT_NEAR(nees, 1.0, spread);
}

/// Errors as differences of velocities and positions give 3 here: the attitude that the first fixes find turns what was there before.
TEST(gyro_free, a_heading_that_is_hardly_known_leaves_the_covariance_right)
{
    const double nees = nees_of_flights(ins_real(30.0 * DEG), 5.0);
    std::printf("NEES / %d over %d runs, heading to 30 deg, after 5 s: %.3f\n", INS_GYRO_FREE_N, RUNS, nees);
    EXPECT_LT(nees, 1.2);
}
