/// \file   test_gps_dr_pair.cpp
/// \brief  Decentralised GPS and dead reckoning: a heading found, information shared, the switch; the paper's pair beside it.
/// SPDX-License-Identifier: MIT
#include "gps_dr_file.h"
#include <cstring>
#include <random>
using namespace core_test;

namespace
{
constexpr double T = 0.1;             ///< [s]
constexpr double GYRO_BIAS = 0.0087;  ///< [rad/s]
constexpr double ODOMETER = 1.02;     ///< scale
constexpr double GYRO_NOISE = 0.005;  ///< [rad/s]
constexpr double WHEEL_NOISE = 0.003; ///< of a distance [m]
constexpr double FIX_SIGMA = 3;       ///< [m]

/// A car that starts at the origin with a heading, drives bends, and stops from 30 s to 36 s.
struct Car
{
    Car(double heading, unsigned seed) : pose{0, 0, heading}, random(seed) {}

    double speed() const { return t < 30 || t >= 36 ? 8 : 0; }
    /// \param[out] sensed  yaw rate, distance
    void step(double sensed[2])
    {
        const double rate = speed() > 0 ? 0.25 * std::sin(0.11 * t) : 0;
        const double middle = pose[2] + rate * T / 2;
        const double noise = normal(random);
        pose[0] += speed() * T * std::sin(middle);
        pose[1] += speed() * T * std::cos(middle);
        pose[2] += rate * T;
        t += T;
        sensed[0] = rate + GYRO_BIAS + GYRO_NOISE * normal(random);
        sensed[1] = speed() > 0 ? ODOMETER * speed() * T + WHEEL_NOISE * noise : 0;
    }
    ins_gps_dr_fix_t fix()
    {
        ins_gps_dr_fix_t f = {};
        f.valid = 1;
        f.sats = 8;
        f.hdop = 1;
        f.sigma = static_cast<ins_real>(FIX_SIGMA);
        f.east = static_cast<ins_real>(pose[0] + FIX_SIGMA * normal(random));
        f.north = static_cast<ins_real>(pose[1] + FIX_SIGMA * normal(random));
        return f;
    }

    double pose[3];
    double t = 0;
    std::mt19937 random;
    std::normal_distribution<double> normal;
};

ins_gps_dr_config_t config()
{
    ins_gps_dr_config_t cfg;
    ins_gps_dr_config_default(&cfg);
    cfg.sigma_bias = INS_C(0.01);
    cfg.tau_fix = 0; // the fixes here are white
    return cfg;
}

/// \param[in] sees  whether there is a fix at t
template <typename Sees> void drive(ins_gps_dr_t& n, Car& car, double until, Sees sees)
{
    while (car.t < until - T / 2)
    {
        double sensed[2];
        car.step(sensed);
        ASSERT_EQ(ins_gps_dr_step(&n, INS_C(0.1), static_cast<ins_real>(sensed[0]), static_cast<ins_real>(sensed[1])),
                  INS_OK);
        if (std::fabs(car.t - std::round(car.t)) < T / 2)
        {
            ins_gps_dr_fix_t f = car.fix();
            f.valid = sees(car.t);
            ASSERT_EQ(ins_gps_dr_fix(&n, &f), INS_OK) << "at " << car.t << " s, nis " << n.nis;
        }
    }
}

double position_error(const ins_gps_dr_t& n, const Car& car)
{
    ins_real x[6];
    EXPECT_EQ(ins_gps_dr_state(&n, x, nullptr), INS_OK);
    return std::hypot(static_cast<double>(x[0]) - car.pose[0], static_cast<double>(x[1]) - car.pose[1]);
}

const auto always = [](double) { return true; };
} // namespace

TEST(gps_dr_pair, finds_its_heading_from_any_and_knows_how_well)
{
    const int runs = std::getenv("INS_BENCH") ? 200 : 24;
    const double outage_s = 60;
    double nees = 0;
    double drift = 0;
    int doubted = 0;
    for (int run = 0; run < runs; run++)
    {
        Car car(-PI + 2 * PI * run / runs, static_cast<unsigned>(run));
        ins_gps_dr_t n;
        const ins_gps_dr_config_t cfg = config();
        ASSERT_EQ(ins_gps_dr_init(&n, &cfg), INS_OK);
        drive(n, car, 120, always);
        EXPECT_GE(ins_gps_dr_source(&n), INS_GPS_DR_DR) << "run " << run;
        doubted += ins_gps_dr_source(&n) == INS_GPS_DR_DR;
        ins_real x[6];
        ins_real P[36];
        ASSERT_EQ(ins_gps_dr_state(&n, x, P), INS_OK);
        const double heading = std::remainder(static_cast<double>(x[2]) - car.pose[2], 2 * PI);
        const double expected[] = {car.pose[0], car.pose[1], 0, 8, GYRO_BIAS, ODOMETER};
        nees += heading * heading / static_cast<double>(P[14]);
        for (const size_t i : {0u, 1u, 4u, 5u})
        {
            const double e = static_cast<double>(x[i]) - expected[i];
            nees += e * e / static_cast<double>(P[7 * i]);
        }
        drive(n, car, 120 + outage_s, [](double) { return false; });
        EXPECT_EQ(ins_gps_dr_source(&n), INS_GPS_DR_DR);
        drift += position_error(n, car) / runs;
    }
    const double per_state = nees / (5 * runs);
    std::printf("seeds 0..%d: nees a state %.2f, %.1f m after %g s without fixes\n", runs - 1, per_state, drift,
                outage_s);
    EXPECT_LE(doubted, runs / 8) << "of 1 % of good fixes the switch says DR, for three epochs";
    EXPECT_GT(per_state, 0.4);
    EXPECT_LT(per_state, 1.6);
    EXPECT_LT(drift, 12) << "plain dead reckoning with this bias and scale: 140 m";
}

TEST(gps_dr_pair, sharing_is_the_filter_that_takes_everything)
{
    Car car(1, 7);
    ins_gps_dr_t n;
    const ins_gps_dr_config_t cfg = config();
    ASSERT_EQ(ins_gps_dr_init(&n, &cfg), INS_OK);
    drive(n, car, 60, always);
    ASSERT_EQ(ins_gps_dr_source(&n), INS_GPS_DR_GPS);
    ins_unicycle_t central;
    const ins_real nothing[6] = {0};
    ASSERT_EQ(ins_unicycle_init(&central, &cfg.vehicle, nothing, nothing), INS_OK);
    ASSERT_EQ(ins_gps_dr_state(&n, central.x, central.P), INS_OK);
    Worst worst;
    for (int second = 0; second < 20; second++)
    {
        for (int k = 0; k < 10; k++)
        {
            double sensed[2];
            car.step(sensed);
            const auto rate = static_cast<ins_real>(sensed[0]);
            const auto distance = static_cast<ins_real>(sensed[1]);
            ASSERT_EQ(ins_gps_dr_step(&n, INS_C(0.1), rate, distance), INS_OK);
            ASSERT_EQ(ins_unicycle_travel(&central, INS_C(0.1), rate, distance), INS_OK);
        }
        const ins_gps_dr_fix_t f = car.fix();
        ASSERT_EQ(ins_gps_dr_fix(&n, &f), INS_OK);
        const ins_real r = f.sigma * f.sigma * (4 + n.nis) / 6; // the same weight of a Student's t
        ASSERT_EQ(ins_unicycle_gps(&central, f.east, f.north, r, nullptr), INS_OK);
        ins_real x[6];
        ins_real P[36];
        ASSERT_EQ(ins_gps_dr_state(&n, x, P), INS_OK);
        for (size_t i = 0; i < 6; i++)
        {
            const double sigma = std::sqrt(static_cast<double>(central.P[7 * i]));
            worst.take(static_cast<double>(x[i]), static_cast<double>(central.x[i]), sigma, "x " + std::to_string(i));
            worst.take(static_cast<double>(P[7 * i]), static_cast<double>(central.P[7 * i]), sigma * sigma,
                       "P " + std::to_string(i));
        }
    }
    expect_within(worst, INS_TOL(1e-9, 2e-2), "shared against central, in sigmas");
}

TEST(gps_dr_pair, dead_reckoning_is_not_touched_until_fixes_have_proved_themselves)
{
    Car car(2, 3);
    ins_gps_dr_t n;
    const ins_gps_dr_config_t cfg = config();
    ASSERT_EQ(ins_gps_dr_init(&n, &cfg), INS_OK);
    drive(n, car, 60, always);
    drive(n, car, 61, [](double) { return false; });
    EXPECT_EQ(ins_gps_dr_source(&n), INS_GPS_DR_DR) << "the first epoch without a fix";
    ins_gps_dr_t alone = n;
    Car same = car;
    for (int good = 1; good <= INS_SWITCH_BACK_GOOD; good++)
    {
        drive(n, car, 61 + good, always);
        drive(alone, same, 61 + good, [](double) { return false; });
        ins_real x[6];
        ins_real y[6];
        ASSERT_EQ(ins_gps_dr_state(&n, x, nullptr), INS_OK);
        ASSERT_EQ(ins_gps_dr_state(&alone, y, nullptr), INS_OK);
        EXPECT_EQ(std::equal(x, x + 6, y), good < INS_SWITCH_BACK_GOOD) << good << " good fixes";
    }
    EXPECT_EQ(ins_gps_dr_source(&n), INS_GPS_DR_GPS);
    while (n.since_fix <= cfg.fix_max_age)
    {
        ASSERT_EQ(ins_gps_dr_step(&n, INS_C(0.1), 0, INS_C(0.8)), INS_OK);
    }
    EXPECT_EQ(ins_gps_dr_source(&n), INS_GPS_DR_DR) << "nobody said that there was no fix";
}

TEST(gps_dr_pair, heading_survives_a_stop_and_the_stop_shows_the_bias)
{
    for (const bool paper : {false, true})
    {
        Car car(1, 11);
        ins_gps_dr_t n;
        ins_gps_dr_paper_t p;
        const ins_gps_dr_config_t cfg = config();
        ins_gps_dr_paper_config_t printed;
        ins_gps_dr_paper_config_default(&printed, INS_GPS_DR_PAPER_CORRECTED);
        ASSERT_EQ(ins_gps_dr_init(&n, &cfg), INS_OK);
        ASSERT_EQ(ins_gps_dr_paper_init(&p, &printed), INS_OK);
        while (car.t < 89.95)
        {
            double sensed[2];
            car.step(sensed);
            ins_gps_dr_fix_t f = car.fix();
            f.valid = car.t < 29;
            const bool second = std::fabs(car.t - std::round(car.t)) < T / 2;
            const auto rate = static_cast<ins_real>(sensed[0]);
            const auto distance = static_cast<ins_real>(sensed[1]);
            (void)(paper ? ins_gps_dr_paper_step(&p, rate, distance) : ins_gps_dr_step(&n, INS_C(0.1), rate, distance));
            ASSERT_EQ(!second ? INS_OK : paper ? ins_gps_dr_paper_fix(&p, &f) : ins_gps_dr_fix(&n, &f), INS_OK);
        }
        ins_real x[6] = {0};
        ASSERT_EQ(paper ? ins_gps_dr_paper_state(&p, x, x + 2) : ins_gps_dr_state(&n, x, nullptr), INS_OK);
        const double error =
            std::hypot(static_cast<double>(x[0]) - car.pose[0], static_cast<double>(x[1]) - car.pose[1]);
        std::printf("%s: %.1f m, 60 s after the last fix, with a stop\n", paper ? "the paper's pair" : "ours", error);
        if (paper)
        {
            EXPECT_GT(error, 60);
        }
        else
        {
            EXPECT_LT(error, 40);
            EXPECT_NEAR(static_cast<double>(n.local[0].x[INS_UNICYCLE_BIAS]), GYRO_BIAS, 2e-3);
        }
    }
}

TEST(gps_dr_pair, survives_wild_fixes_and_starts_again_where_they_persist)
{
    Car car(0, 5);
    ins_gps_dr_t n;
    const ins_gps_dr_config_t cfg = config();
    ASSERT_EQ(ins_gps_dr_init(&n, &cfg), INS_OK);
    drive(n, car, 60, always);
    ins_gps_dr_fix_t wild = car.fix();
    wild.east += 100000;
    EXPECT_EQ(ins_gps_dr_fix(&n, &wild), INS_E_GATE);
    EXPECT_EQ(n.gross, 1u);
    EXPECT_EQ(ins_gps_dr_source(&n), INS_GPS_DR_DR);
    drive(n, car, 80, always);
    EXPECT_EQ(ins_gps_dr_source(&n), INS_GPS_DR_GPS);
    EXPECT_LT(position_error(n, car), 4 * FIX_SIGMA);
    for (unsigned k = 1; k < cfg.restart; k++)
    {
        EXPECT_EQ(ins_gps_dr_fix(&n, &wild), INS_E_GATE);
    }
    EXPECT_EQ(ins_gps_dr_fix(&n, &wild), INS_OK) << "it has been on a ferry";
    EXPECT_EQ(n.restarts, 1u);
    EXPECT_EQ(ins_gps_dr_source(&n), INS_GPS_DR_ALIGN);
    EXPECT_GT(position_error(n, car), 90000);
    ins_gps_dr_config_t never = cfg;
    never.restart = 0;
    ASSERT_EQ(ins_gps_dr_init(&n, &never), INS_OK);
    drive(n, car, 140, always);
    for (unsigned k = 0; k < 600; k++)
    {
        ASSERT_EQ(ins_gps_dr_fix(&n, &wild), INS_E_GATE);
    }
}

TEST(gps_dr_pair, a_course_counts_when_it_moves)
{
    const ins_gps_dr_config_t cfg = config();
    ins_gps_dr_t n;
    ASSERT_EQ(ins_gps_dr_init(&n, &cfg), INS_OK);
    ins_gps_dr_fix_t f = {};
    ins_real x[6];
    ins_real P[36];
    f.valid = f.has_course = 1;
    f.sats = 8;
    f.hdop = 1;
    f.sigma = 3;
    f.course = INS_C(2.0);
    f.speed = cfg.course_min / 2;
    EXPECT_EQ(ins_gps_dr_state(&n, x, P), INS_E_STATE);
    EXPECT_EQ(ins_gps_dr_source(&n), INS_GPS_DR_NONE);
    ASSERT_EQ(ins_gps_dr_fix(&n, &f), INS_OK);
    EXPECT_EQ(ins_gps_dr_source(&n), INS_GPS_DR_ALIGN) << "too slow for a course";
    ASSERT_EQ(ins_gps_dr_state(&n, x, P), INS_OK);
    EXPECT_GT(P[14], 1) << "no heading is known";
    f.speed = 10;
    ASSERT_EQ(ins_gps_dr_step(&n, INS_C(0.1), 0, 1), INS_OK);
    ASSERT_EQ(ins_gps_dr_fix(&n, &f), INS_OK);
    ASSERT_EQ(ins_gps_dr_state(&n, x, P), INS_OK);
    EXPECT_NEAR(static_cast<double>(x[2]), 2, 1e-5);
    EXPECT_NEAR(std::sqrt(static_cast<double>(P[14])), 0.03, 1e-4);
    const ins_gps_dr_t before = n;
    f.course = INS_C(2.1);
    ASSERT_EQ(ins_gps_dr_fix(&n, &f), INS_OK);
    EXPECT_GT(n.local[1].x[2], before.local[1].x[2]);
    f.course = INS_C(2.0) + static_cast<ins_real>(PI);
    EXPECT_EQ(ins_gps_dr_fix(&n, &f), INS_E_GATE) << "it drives backwards";
}

TEST(gps_dr_pair, an_old_fix_is_brought_forward)
{
    const ins_gps_dr_config_t cfg = config();
    ins_gps_dr_t now;
    ASSERT_EQ(ins_gps_dr_init(&now, &cfg), INS_OK);
    Car car(1, 2);
    drive(now, car, 60, always);
    ins_gps_dr_t late = now;
    ins_gps_dr_fix_t f = {};
    f.valid = 1;
    f.sats = 8;
    f.hdop = 1;
    f.sigma = 3;
    ins_real x[6];
    ASSERT_EQ(ins_gps_dr_state(&now, x, nullptr), INS_OK);
    f.east = x[0];
    f.north = x[1];
    ASSERT_EQ(ins_gps_dr_fix(&now, &f), INS_OK);
    f.age = INS_C(0.5);
    f.east -= x[3] / 2 * std::sin(x[2]);
    f.north -= x[3] / 2 * std::cos(x[2]);
    ASSERT_EQ(ins_gps_dr_fix(&late, &f), INS_OK);
    EXPECT_NEAR(static_cast<double>(late.nis), 0, INS_TOL(1e-20, 1e-8));
    EXPECT_NEAR(static_cast<double>(late.local[0].x[0]), static_cast<double>(now.local[0].x[0]), INS_TOL(1e-9, 1e-3));
}

TEST(gps_dr_pair, refuses_bad_figures_unchanged)
{
    const ins_gps_dr_config_t good = config();
    ins_gps_dr_t n;
    ins_real ins_gps_dr_config_t::*const members[] = {
        &ins_gps_dr_config_t::sigma_bias,  &ins_gps_dr_config_t::sigma_scale,    &ins_gps_dr_config_t::tau_fix,
        &ins_gps_dr_config_t::gate_gross,  &ins_gps_dr_config_t::sigma_velocity, &ins_gps_dr_config_t::course_min,
        &ins_gps_dr_config_t::still_after, &ins_gps_dr_config_t::fix_max_age};
    for (const auto member : members)
    {
        for (const ins_real bad : {INS_C(-1.0), NOT_A_NUMBER})
        {
            ins_gps_dr_config_t cfg = good;
            cfg.*member = bad;
            EXPECT_EQ(ins_gps_dr_init(&n, &cfg), INS_E_RANGE);
        }
    }
    ins_gps_dr_config_t cfg = good;
    cfg.vehicle.r_rate = 0;
    EXPECT_EQ(ins_gps_dr_init(&n, &cfg), INS_E_RANGE);
    cfg = good;
    cfg.choice.back = 0;
    EXPECT_EQ(ins_gps_dr_init(&n, &cfg), INS_E_RANGE);
    ASSERT_EQ(ins_gps_dr_init(&n, &good), INS_OK);
    ins_gps_dr_fix_t f = {};
    f.valid = 1;
    f.sigma = 3;
    ASSERT_EQ(ins_gps_dr_fix(&n, &f), INS_OK);
    const ins_gps_dr_t before = n;
    const auto unchanged = [&] { return std::memcmp(before.local, n.local, sizeof n.local) == 0 && n.used == 1; };
    EXPECT_EQ(ins_gps_dr_step(&n, 0, 0, 0), INS_E_RANGE);
    EXPECT_EQ(ins_gps_dr_step(&n, INS_C(0.1), NOT_A_NUMBER, 0), INS_E_RANGE);
    EXPECT_EQ(ins_gps_dr_step(&n, INS_C(0.1), 0, NOT_A_NUMBER), INS_E_RANGE);
    for (const auto member : {&ins_gps_dr_fix_t::east, &ins_gps_dr_fix_t::north, &ins_gps_dr_fix_t::sigma,
                              &ins_gps_dr_fix_t::age, &ins_gps_dr_fix_t::course, &ins_gps_dr_fix_t::speed})
    {
        ins_gps_dr_fix_t bad = f;
        bad.has_course = 1;
        bad.*member = NOT_A_NUMBER;
        EXPECT_EQ(ins_gps_dr_fix(&n, &bad), INS_E_RANGE);
    }
    f.sigma = 0;
    EXPECT_EQ(ins_gps_dr_fix(&n, &f), INS_E_RANGE);
    EXPECT_TRUE(unchanged());
}

TEST(gps_dr_pair, coarse_counts_do_not_move_the_scale)
{
    const double quantum = 0.04; // [m]: 0.4 m/s in 100 ms
    ins_gps_dr_config_t cfg = config();
    cfg.vehicle.r_distance = static_cast<ins_real>(quantum * quantum / 6);
    ins_gps_dr_t n;
    ASSERT_EQ(ins_gps_dr_init(&n, &cfg), INS_OK);
    Car car(1, 9);
    double way = 0;
    double counted = 0;
    while (car.t < 299.95)
    {
        double sensed[2];
        car.step(sensed);
        way += sensed[1];
        const double now = quantum * std::floor(way / quantum);
        ASSERT_EQ(
            ins_gps_dr_step(&n, INS_C(0.1), static_cast<ins_real>(sensed[0]), static_cast<ins_real>(now - counted)),
            INS_OK);
        counted = now;
        ins_gps_dr_fix_t f = car.fix();
        ASSERT_EQ(std::fabs(car.t - std::round(car.t)) < T / 2 ? ins_gps_dr_fix(&n, &f) : INS_OK, INS_OK);
    }
    ins_real x[6];
    ins_real P[36];
    ASSERT_EQ(ins_gps_dr_state(&n, x, P), INS_OK);
    EXPECT_NEAR(static_cast<double>(x[5]), ODOMETER, 4 * std::sqrt(static_cast<double>(P[35])));
    EXPECT_LT(P[35], INS_C(0.005) * INS_C(0.005));
}
