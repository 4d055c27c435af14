/// \file   filters.cpp
/// \brief  Errors of the filters and of what they are made of, and what a frame's check lets through. Units: SI.
/// SPDX-License-Identifier: MIT
#include "figures.hpp"
#include "kalman_runs.h"
#include "undetected.h"
using namespace core_test;
using figures::point;

namespace
{
const char* const TYPE = INS_TOL("double", "float");

void gain_against_prior()
{
    for (int power = 2; power <= 16; power++)
    {
        const double ratio = std::pow(10.0, power), r = 1e-2;
        for (const bool ud : {false, true})
        {
            const double error = gain_error(ud, r, r * ratio);
            // Above 1 the gain means nothing; a refusal is infinite.
            if (error < 1)
            {
                point("kalman_prior", std::string(ud ? "UD, " : "Joseph, ") + TYPE, ratio, error);
            }
        }
    }
}

/// Relative error of the covariance that one epoch adds to the position, of the library and of Singer's closed form as it is printed.
void epoch_noise()
{
    using L = long double;
    const double tau = 20;
    for (int i = 0; i <= 24; i++)
    {
        const double ratio = std::pow(10.0, -4 + i * 0.25); // T / tau, 1e-4 to 100
        const double T = tau * ratio;
        const ins_gps_axis_config_t cfg = {static_cast<ins_real>(T), static_cast<ins_real>(tau), 100, 1, 5, 9, 0, 0};
        const ins_real var[4] = {1, 1, 1, 1};
        ins_gps_axis_t x;
        EXPECT_EQ(ins_gps_axis_init(&x, &cfg, var), INS_OK);
        // Reference: integral of the square of the position's response to white noise, (b - 1 + exp(-b)) / al^2, b = s / tau,
        // by Gauss-Legendre on panels of 1/8; the response is its series where it cancels.
        const auto response = [](L b)
        {
            L term = b * b / 2, sum = 0;
            for (int k = 3; k < 40 && b < 2; k++)
            {
                sum += term;
                term *= -b / static_cast<L>(k);
            }
            return b < 2 ? sum : b - 1 + std::exp(-b);
        };
        static const L node[] = {0, 0.538469310105683091036L, 0.906179845938663992798L};
        static const L weight[] = {0.568888888888888888889L, 0.478628670499366468041L, 0.236926885056189087514L};
        const L end = static_cast<L>(cfg.dt) / static_cast<L>(cfg.tau_acceleration);
        const int panels = 400;
        L integral = 0;
        for (int p = 0; p < panels; p++)
        {
            for (int n = -2; n <= 2; n++)
            {
                const L b = end * (p + (1 + (n < 0 ? -1 : 1) * node[std::abs(n)]) / 2) / panels;
                integral += weight[std::abs(n)] / 2 * response(b) * response(b) * end / panels;
            }
        }
        const L want = 2 * integral * std::pow(static_cast<L>(cfg.tau_acceleration), 4);
        point("singer_noise", std::string("library, ") + TYPE, ratio,
              static_cast<double>(std::fabs(static_cast<L>(x.Q[0]) - want) / want));
        const ins_real b = cfg.dt / cfg.tau_acceleration, e = static_cast<ins_real>(std::exp(-b));
        const ins_real al = 1 / cfg.tau_acceleration;
        const ins_real printed = (1 - e * e + 2 * b + 2 * b * b * b / 3 - 2 * b * b - 4 * b * e) / (al * al * al * al);
        const double off = static_cast<double>(std::fabs(static_cast<L>(printed) - want) / want);
        if (off < 10)
        {
            point("singer_noise", std::string("as printed, ") + TYPE, ratio, off);
        }
    }
}

#ifndef INS_REAL_FLOAT
/// Variance that a Gauss-Markov state settles at, relative to sigma^2; against phi = 1 - T / tau, q = 2 sigma^2 T / tau.
void markov()
{
    for (int i = 0; i <= 16; i++)
    {
        const double ratio = std::pow(10.0, -4 + i * 0.25);
        ins_markov_t m;
        EXPECT_EQ(ins_markov_init(&m, ratio, 1, 1), INS_OK);
        const long double phi = m.phi;
        const double settled = static_cast<double>(m.q / (1 - phi * phi) - 1);
        // What doubles can say at all: half a unit in the last place.
        point("markov_step", "exact discretisation", ratio, std::max(std::fabs(settled), 1e-17));
        const double euler = 2 * ratio / (1 - (1 - ratio) * (1 - ratio)) - 1;
        if (ratio < 1.9)
        {
            point("markov_step", "first order", ratio, std::fabs(euler));
        }
    }
}

/// A minute of slalom: heading 0.8 sin 0.5 t, speed 10 + 2 sin 0.3 t, exact distances and turns; against the integral of the track.
void dead_reckoning()
{
    const auto heading = [](double t) { return 0.8 * std::sin(0.5 * t); };
    const auto way = [](double t) { return 10 * t + 2 / 0.3 * (1 - std::cos(0.3 * t)); };
    const auto speed = [](double t) { return 10 + 2 * std::sin(0.3 * t); };
    const double duration = 60;
    double east = 0, north = 0;
    const int fine = 600000;
    for (int k = 0; k < fine; k++) // the middle of each 100 us: 1e-9 m
    {
        const double t = duration * (k + 0.5) / fine;
        east += speed(t) * std::sin(heading(t)) * duration / fine;
        north += speed(t) * std::cos(heading(t)) * duration / fine;
    }
    for (const int hz : {1, 2, 5, 10, 20, 50, 100})
    {
        ins_real pose[3] = {0, 0, 0};
        double tangent[2] = {0, 0};
        for (int k = 0; k < 60 * hz; k++)
        {
            const double t0 = static_cast<double>(k) / hz, t1 = static_cast<double>(k + 1) / hz;
            const double distance = way(t1) - way(t0);
            tangent[0] += distance * std::sin(heading(t0));
            tangent[1] += distance * std::cos(heading(t0));
            EXPECT_EQ(ins_dead_reckoning_step(pose, distance, heading(t1) - heading(t0)), INS_OK);
        }
        point("dr_step", "arc (library)", 1.0 / hz, std::hypot(pose[0] - east, pose[1] - north));
        point("dr_step", "tangent", 1.0 / hz, std::hypot(tangent[0] - east, tangent[1] - north));
    }
}

/// Relative distance of the P-V-A filter's gains from where they settle.
void pva_gain()
{
    const double settled[3] = {0.15189845, 0.25011868, 0.20592493}; // T = 0.05, q = 1, R = 1
    ins_pva_t f;
    const ins_real var[3] = {100, 100, 100};
    EXPECT_EQ(ins_pva_init(&f, var), INS_OK);
    const char* const names[] = {"k1", "k2", "k3"};
    for (int k = 1; k <= 140; k++)
    {
        ins_innovation_t z = {0, 1, 0, 0};
        EXPECT_EQ(ins_pva_predict(&f, INS_C(0.05), 1), INS_OK);
        EXPECT_EQ(ins_pva_update(&f, INS_PVA_POSITION, &z), INS_OK);
        for (int i = 0; i < 3 && k % 4 == 0; i++)
        {
            point("pva_gain", names[i], k, std::fabs(f.K[i] / settled[i] - 1));
        }
    }
}

/// Chance that a frame of six data octets is taken though bits are wrong.
void undetected_frames()
{
    const std::pair<const char*, std::vector<double>> checks[] = {{"sum modulo 256", undetected::sum_escapes()},
                                                                  {"CRC-16", undetected::crc_escapes(72)}};
    const unsigned bits[] = {56, 72};
    for (int i = 0; i <= 16; i++)
    {
        const double p = std::pow(10.0, -6 + i * 0.25);
        for (size_t c = 0; c < 2; c++)
        {
            double rate = 0;
            for (unsigned k = 1; k <= undetected::FLIPS_MAX; k++)
            {
                rate += undetected::binomial(bits[c], k) * std::pow(p, k) * std::pow(1 - p, bits[c] - k) *
                        checks[c].second[k];
            }
            point("link_undetected", checks[c].first, p, rate);
        }
    }
}
#endif
} // namespace

void figures::filters()
{
    gain_against_prior();
    epoch_noise();
#ifndef INS_REAL_FLOAT
    markov();
    dead_reckoning();
    pva_gain();
    undetected_frames();
#endif
}
