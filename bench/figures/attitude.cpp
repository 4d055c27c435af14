/// \file   attitude.cpp
/// \brief  Attitude errors against the step: forms, sampled rates, functional iteration, the thesis's, integers, skew. Units: rad, s.
/// SPDX-License-Identifier: MIT
#include "attitude_errors.hpp"
#include "figures.hpp"
using namespace core_test;
using namespace figures;

#ifndef INS_REAL_FLOAT
namespace
{
const double DEG = PI / 180;
const double DURATION_S = 24;
const double T = 0.08; // of the table

/// Sample reuse as the paper prints it: a three-sample rotation vector on the newest attitude.
double naive_reuse(const Motion& m, double period, size_t steps)
{
    auto q = real(m.attitude(0));
    Track track;
    for (size_t k = 0; k < steps; k++)
    {
        const double t = static_cast<double>(k) * period;
        std::vector<ins_real> theta;
        for (int back = 2; back >= 0; back--)
        {
            const auto x = real(m.increment(t - back * period, t - back * period + period));
            theta.insert(theta.end(), x.begin(), x.end());
        }
        ins_real phi[3];
        ins_real dq[4];
        EXPECT_EQ(ins_coning_phi(INS_CONING_BLOCK3_FIT, theta.data(), phi), INS_OK);
        EXPECT_EQ(ins_quat_from_rotvec(phi, dq), INS_OK);
        ins_quat_mul(q.data(), dq, q.data());
        ins_quat_normalise_approx(q.data());
        track.push_back({k + 1, quat(q.data())});
    }
    return max_error(track, truth_of(m, period));
}

/// Uniform in (0, 1) from a counter (splitmix64): the same on every machine.
double uniform(uint64_t& state)
{
    state += UINT64_C(0x9E3779B97F4A7C15);
    uint64_t z = state;
    z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
    return (static_cast<double>((z ^ (z >> 31)) >> 11) + 0.5) / 9007199254740992.0;
}

/// Rates of a converter with a step and noise, order 0 for the rectangle; root mean square of the largest error over ten seeds.
double converted(const Motion& m, unsigned order, double step, double noise)
{
    const int seeds = 10;
    const long steps = std::lrint(DURATION_S / T);
    double sum = 0;
    for (int seed = 1; seed <= seeds; seed++)
    {
        uint64_t state = static_cast<uint64_t>(seed) << 32;
        const long lead = 8;
        std::vector<Vec> rates;
        for (long k = -lead; k <= steps; k++)
        {
            Vec w = m.rate(static_cast<double>(k) * T);
            for (double& x : w)
            {
                const double gauss = std::sqrt(-2 * std::log(uniform(state))) * std::cos(2 * PI * uniform(state));
                x = std::nearbyint((x + noise * gauss) / step) * step;
            }
            rates.push_back(w);
        }
        double error;
        if (order == 0)
        {
            std::vector<Vec> pre;
            std::vector<Vec> incs;
            for (long k = -3; k < steps; k++)
            {
                Vec w = rates[static_cast<size_t>(k + lead)];
                for (double& x : w)
                {
                    x *= T;
                }
                (k < 0 ? pre : incs).push_back(w);
            }
            error = max_error(run_form(INS_CONING_HIST2_OPT, m.attitude(0), pre, incs), truth_of(m, T));
        }
        else
        {
            error = max_error(run_rates(order, T, m.attitude(0), rates, lead), truth_of(m, T));
        }
        sum += error * error;
    }
    return std::sqrt(sum / seeds);
}

void table()
{
    const Motion motions[] = {MOTION_A, MOTION_B, MOTION_D};
    const size_t steps = static_cast<size_t>(std::lrint(DURATION_S / T));
    for (size_t i = 0; i < 3; i++)
    {
        const Motion& m = motions[i];
        const double x = static_cast<double>(i);
        for (const Form& f : forms())
        {
            point("table_motion", f.name, x, named(m, f.name, T, steps));
        }
        for (const char* name : {"reuse_fit", "AM2", "AM3", "AM4", "AM5"})
        {
            point("table_motion", name, x, named(m, name, T, steps));
        }
        point("table_motion", "naive_reuse", x, naive_reuse(m, T, steps));
        point("table_motion", "thesis", x, thesis(m, T, steps));
        point("table_motion", "rectangle", x, rectangle(m, T, steps));
        point("table_motion", "rk4_2T", x, rk4(m, T, steps));
        point("table_motion", "rk4_T", x, rk4(m, T / 2, 2 * steps));
        const std::pair<const char*, int> iterations[] = {
            {"fiter_block3", INS_FITER_BLOCK3}, {"fhist2", INS_FITER_HIST2}, {"fhist3", INS_FITER_HIST3},
            {"fhist4", INS_FITER_HIST4},        {"rate4", INS_FITER_RATE4},  {"rate5", INS_FITER_RATE5}};
        for (const auto& f : iterations)
        {
            point("table_motion", f.first, x, fiter(m, f.second, T, steps));
        }
    }
    const std::pair<double, double> sensors[] = {{0.044, 0}, {0.044, 0.1}, {0.2, 0.3}}; // deg/s
    for (size_t i = 0; i < 3; i++)
    {
        for (const unsigned order : {0u, 2u, 3u, 4u})
        {
            point("table_noise", order == 0 ? "rectangle" : "AM" + std::to_string(order), static_cast<double>(i),
                  converted(MOTION_B, order, sensors[i].first * DEG, sensors[i].second * DEG));
        }
    }
}

/// Motion B over 24 s; steps are multiples of 12, so that blocks of 2, 3 and 4 all end with it.
void against_step()
{
    for (const size_t steps : {144u, 204u, 300u, 432u, 600u, 852u, 1200u, 1704u, 2400u, 3396u, 4800u})
    {
        const double period = DURATION_S / static_cast<double>(steps);
        const Motion& m = MOTION_B;
        const std::pair<const char*, const char*> shown[] = {{"ONE", "one"},
                                                             {"HIST1", "hist1"},
                                                             {"HIST2_FIT", "hist2_poly"},
                                                             {"HIST2_OPT", "hist2_opt"},
                                                             {"HIST3_FIT", "hist3_poly"},
                                                             {"BLOCK2", "two"},
                                                             {"BLOCK3_FIT", "three_poly"},
                                                             {"BLOCK4_FIT", "four_poly"}};
        for (const auto& f : shown)
        {
            point("coning_step", f.first, period, named(m, f.second, period, steps));
        }
        point("rates_step", "rectangle", period, rectangle(m, period, steps));
        for (int order = 2; order <= 5; order++)
        {
            point("rates_step", "order " + std::to_string(order), period,
                  named(m, "AM" + std::to_string(order), period, steps));
        }
        const std::pair<const char*, int> iterations[] = {{"HIST1", INS_FITER_HIST1}, {"HIST2", INS_FITER_HIST2},
                                                          {"HIST3", INS_FITER_HIST3}, {"HIST4", INS_FITER_HIST4},
                                                          {"RATE3", INS_FITER_RATE3}, {"RATE4", INS_FITER_RATE4},
                                                          {"RATE5", INS_FITER_RATE5}, {"BLOCK3", INS_FITER_BLOCK3}};
        for (const auto& f : iterations)
        {
            point("fiter_step", f.first, period, fiter(m, f.second, period, steps));
        }
        point("thesis_step", "update", period, thesis(m, period, steps));
        point("thesis_step", "RK4, steps of 2 T", period, rk4(m, period, steps));
        point("thesis_step", "HIST2_OPT, for comparison", period, named(m, "hist2_opt", period, steps));
    }
}

/// Drift that a late channel feigns: y and z vibrate in phase by 1 deg, z is sampled 0.3 ms late. T = 1.8 ms, 2000 periods of T.
void skew()
{
    const double period = 1.8e-3, late = 0.3e-3, amplitude = 1 * DEG;
    for (const int per_turn : {8, 10, 13, 18, 25, 36, 50, 80, 125}) // samples a turn: 4.4 to 69 Hz
    {
        const double omega = 2 * PI / (per_turn * period);
        for (unsigned order = 0; order <= 3; order++)
        {
            ins_skew_t s;
            ins_rates_t r;
            ins_attitude_t a;
            const ins_real delay[3] = {0, 0, static_cast<ins_real>(order ? late : 0)};
            const ins_real level[4] = {1, 0, 0, 0};
            EXPECT_EQ(ins_skew_init(&s, static_cast<uint_least8_t>(order ? order : 1), delay, period), INS_OK);
            EXPECT_EQ(ins_rates_init(&r, 5, period), INS_OK);
            EXPECT_EQ(ins_attitude_init(&a, INS_CONING_HIST3_OPT, level), INS_OK);
            const long settle = per_turn * 4, turns = 200;
            double x[2] = {0, 0};
            for (long k = 0; k <= settle + turns * per_turn; k++)
            {
                const double t = static_cast<double>(k) * period;
                auto w = real(
                    Vec{0, amplitude * omega * std::cos(omega * t), amplitude * omega * std::cos(omega * (t + late))});
                ins_real dtheta[3];
                EXPECT_GE(ins_skew_add(&s, w.data(), w.data()), INS_OK);
                EXPECT_GE(ins_rates_add(&r, w.data(), dtheta), INS_OK);
                EXPECT_GE(ins_attitude_step(&a, dtheta), INS_OK);
                if (k == settle || k == settle + turns * per_turn)
                {
                    x[k == settle ? 0 : 1] = 2 * static_cast<double>(a.q_nb[1] / a.q_nb[0]);
                }
            }
            const double drift = (x[1] - x[0]) / (static_cast<double>(turns) * per_turn * period);
            point("skew", order ? "order " + std::to_string(order) : "as sampled", 1 / (per_turn * period),
                  std::fabs(drift) / DEG * 3600);
        }
    }
}

/// Ten minutes at 100 Hz, three sines an axis; the integer forms against the double form on the same increments.
void integers()
{
    const double frequency_hz[] = {0.11, 0.7, 2.3};
    for (const double largest : {0.004, 0.008, 0.016, 0.031, 0.062, 0.125, 0.25})
    {
        const int32_t start[4] = {INS_Q31_ONE, 0, 0, 0};
        const ins_real level[4] = {1, 0, 0, 0};
        ins_q31_t narrow;
        ins_q31w_t wide;
        ins_attitude_t exact;
        EXPECT_EQ(ins_q31_init(&narrow, start), INS_OK);
        EXPECT_EQ(ins_q31w_init(&wide, start), INS_OK);
        EXPECT_EQ(ins_attitude_init(&exact, INS_CONING_HIST2_OPT, level), INS_OK);
        double worst[2] = {0, 0};
        for (long k = 0; k < 60000; k++)
        {
            int32_t theta[3];
            ins_real same[3];
            for (int axis = 0; axis < 3; axis++)
            {
                double x = 0;
                for (int i = 0; i < 3; i++)
                {
                    const double phase = 2 * PI * frequency_hz[i] * static_cast<double>(k) / 100 + axis + 2 * i;
                    x += largest / 3 * std::sin(phase * (1 + 0.1 * axis));
                }
                theta[axis] = static_cast<int32_t>(std::lrint(std::ldexp(x, 31)));
                same[axis] = std::ldexp(static_cast<double>(theta[axis]), -31);
            }
            EXPECT_GE(ins_q31_step(&narrow, theta), INS_OK);
            EXPECT_GE(ins_q31w_step(&wide, theta), INS_OK);
            EXPECT_GE(ins_attitude_step(&exact, same), INS_OK);
            Quat q32, q64;
            for (size_t i = 0; i < 4; i++)
            {
                q32[i] = std::ldexp(static_cast<double>(narrow.q_nb[i]), -30);
                q64[i] = std::ldexp(static_cast<double>(wide.q_nb[i]), -62);
            }
            worst[0] = larger(worst[0], angle_between(q32, quat(exact.q_nb)));
            worst[1] = larger(worst[1], angle_between(q64, quat(exact.q_nb)));
        }
        point("q31_size", "32-bit state", largest, worst[0]);
        point("q31_size", "64-bit state", largest, worst[1]);
    }
}
} // namespace

void figures::attitude()
{
    table();
    against_step();
    skew();
    integers();
}
#else
void figures::attitude()
{
    // In float these would show its rounding, 1e-7 rad a step, and not the formulas.
}
#endif
