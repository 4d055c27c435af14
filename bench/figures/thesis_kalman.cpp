/// \file   thesis_kalman.cpp
/// \brief  Section 5.3 of the thesis: 1000 and 3000 steps of 0.05 s, and the signal ten times as large. Units: m, s.
///
/// The thesis prints neither signal nor A, Q, R: here a position of 10 m amplitude and 50 s period, GPS of 1 m at each step, an
/// accelerometer with a bias of 0.05 m/s^2 and 0.1 m/s^2 of noise, white jerk of 1 m^2/s^5 in the filter.
/// SPDX-License-Identifier: MIT
#include "figures.hpp"
#include "ins/gps_axis.h"
#include "ins/pva.h"
#include "thesis.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

using figures::point;

namespace
{
constexpr double T = 0.05, AMPLITUDE = 10, OMEGA = 2 * 3.14159265358979323846 / 50;
constexpr double GPS = 1, BIAS = 0.05, NOISE = 0.1;
constexpr double Q = 1, R = 1, R_ACCELERATION = 0.1;

/// Mean square and final value of an error.
struct Error
{
    double sum = 0, last = 0, largest = 0;
    long count = 0;
    void add(double e)
    {
        sum += e * e;
        last = e;
        largest = std::max(largest, std::fabs(e));
        count++;
    }
    double rms() const { return std::sqrt(sum / static_cast<double>(count)); }
};

ins_pva_t filter()
{
    static const double variance[3] = {100, 100, 100};
    ins_pva_t x;
    EXPECT_EQ(ins_pva_init(&x, variance), INS_OK);
    return x;
}

void update(ins_pva_t& x, int what, double measured, double r)
{
    ins_innovation_t z = {measured - x.x[what], r, 0, 0};
    EXPECT_EQ(ins_pva_update(&x, what, &z), INS_OK);
}

void run(const std::string& row, long steps, double scale, bool drawn)
{
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal(0, 1);
    ins_pva_t thesis = filter(), aided = filter();
    ins_gps_axis_t singer;
    const ins_gps_axis_config_t cfg = {T, 5, 100, 0.2 * scale, 0.01, R, 0, 0};
    const double variance[4] = {100, 100, 1, 1e-4};
    EXPECT_EQ(ins_gps_axis_init(&singer, &cfg, variance), INS_OK);
    double p = 0, v = AMPLITUDE * scale * OMEGA; // INS alone starts right
    Error ins, gps, with_thesis, with_accelerometer, with_singer;
    for (long k = 1; k <= steps; k++)
    {
        const double t = T * static_cast<double>(k);
        const double truth = AMPLITUDE * scale * std::sin(OMEGA * t);
        const double f = -OMEGA * OMEGA * truth + BIAS + NOISE * normal(random);
        const double fix = truth + GPS * normal(random);
        p += v * T + f * T * T / 2;
        v += f * T;
        for (ins_pva_t* x : {&thesis, &aided})
        {
            EXPECT_EQ(ins_pva_predict(x, T, Q), INS_OK);
        }
        update(aided, INS_PVA_ACCELERATION, f, R_ACCELERATION);
        update(aided, INS_PVA_POSITION, fix, R);
        update(thesis, INS_PVA_POSITION, fix, R);
        EXPECT_EQ(ins_gps_axis_step(&singer, fix, nullptr), INS_OK);
        if (k <= 200) // the first 10 s settle
        {
            continue;
        }
        ins.add(p - truth);
        gps.add(fix - truth);
        with_thesis.add(thesis.x[0] - truth);
        with_accelerometer.add(aided.x[0] - truth);
        with_singer.add(singer.x[0] - truth);
        if (drawn && k % 40 == 0)
        {
            point("thesis_kalman", "INS alone", static_cast<double>(k), std::fabs(ins.last));
            point("thesis_kalman", "P-V-A", static_cast<double>(k), std::max(std::fabs(with_thesis.last), 1e-3));
            point("thesis_kalman", "P-V-A, accelerometer too", static_cast<double>(k),
                  std::max(std::fabs(with_accelerometer.last), 1e-3));
        }
    }
    const double values[] = {ins.last,          gps.rms(),          with_thesis.rms(), with_accelerometer.rms(),
                             with_singer.rms(), with_thesis.largest};
    for (int i = 0; i < 6; i++)
    {
        point("table_thesis_kalman", row, i, values[i]);
    }
    for (int i = 0; i < 3; i++)
    {
        point("table_thesis_gain", row, i, thesis.K[i]);
        point("table_thesis_gain", row, 3 + i, thesis.P[4 * i]);
    }
}
} // namespace

void figures::thesis_kalman()
{
    run("1000 steps", 1000, 1, false);
    run("3000 steps", 3000, 1, true);
    run("3000 steps, signal x 10", 3000, 10, false);
}
