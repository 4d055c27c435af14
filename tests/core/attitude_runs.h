/// \file   attitude_runs.h
/// \brief  Attitude algorithms of the core run over known motions: what their tests and the figures of docs share. Units: rad, s.
/// SPDX-License-Identifier: MIT
#ifndef INS_TESTS_ATTITUDE_RUNS_H
#define INS_TESTS_ATTITUDE_RUNS_H
#include "core_test.h"

namespace core_test
{
/// The motions of the accuracy table. D's twin in the reference files has offsets, hence other last digits.
inline const Motion MOTION_A = {{0, 0.5, 0.25, 0}, {0, 0.3, 0.2, 0}, {0, 0, 0, 0}};
inline const Motion MOTION_B = {{0, 1.0, 0.2, 0}, {0, 0.5, 0.3, 0}, {0, 0.3, 0.25, 0}};
inline const Motion MOTION_D = {{0, 30 * PI / 180, 1, 0}, {0, 20 * PI / 180, 1, PI / 2}, {0, 10 * PI / 180, 1, 0.3}};

/// Known: attitude(t), rate(t), increment(t0, t1), as Motion has them.
template <typename Known> Track run_named(const Known& m, const std::string& name, double period, size_t steps)
{
    const auto truth = [&](long k) { return m.attitude(static_cast<double>(k) * period); };
    const std::string rates_prefix = "AM";
    if (name.rfind(rates_prefix, 0) == 0)
    {
        const long lead = 8;
        std::vector<Vec> rates;
        for (long k = -lead; k <= static_cast<long>(steps); k++)
        {
            rates.push_back(m.rate(static_cast<double>(k) * period));
        }
        return run_rates(static_cast<unsigned>(name[2] - '0'), period, truth(0), rates, lead);
    }
    std::vector<Vec> pre;
    std::vector<Vec> incs;
    for (long k = -3; k < static_cast<long>(steps); k++)
    {
        const double t = static_cast<double>(k) * period;
        (k < 0 ? pre : incs).push_back(m.increment(t, t + period));
    }
    if (name == "reuse_fit")
    {
        return run_reuse(INS_CONING_BLOCK3_FIT, {truth(0), truth(1), truth(2)}, incs);
    }
    for (const Form& f : forms())
    {
        if (name == f.name)
        {
            return run_form(f.form, truth(0), pre, incs);
        }
    }
    ADD_FAILURE() << "no form " << name;
    return {};
}

inline bool is_rate(int form)
{
    return form >= INS_FITER_RATE2 && form <= INS_FITER_RATE5;
}

/// The last `lead` + 1 samples of `before` belong to the time up to the start (a rate sample at the start itself included).
inline Track run_fiter(int form, double period, const Quat& start, const std::vector<Vec>& before,
                       const std::vector<Vec>& samples)
{
    Track track = {{0, start}};
    const auto q0 = real(start);
    ins_fiter_t f;
    EXPECT_EQ(ins_fiter_init(&f, form, static_cast<ins_real>(period), q0.data()), INS_OK);
    for (const Vec& s : before)
    {
        EXPECT_GE(ins_fiter_step(&f, real(s).data()), INS_OK);
    }
    std::copy(q0.begin(), q0.end(), f.q_nb);
    for (size_t k = 0; k < samples.size(); k++)
    {
        EXPECT_EQ(ins_fiter_step(&f, real(samples[k]).data()), INS_OK);
        track.push_back({k + 1, quat(f.q_nb)});
    }
    return track;
}

inline Track run_block3(const Quat& start, const std::vector<Vec>& increments)
{
    Track track = {{0, start}};
    auto q = real(start);
    for (size_t k = 0; k + 3 <= increments.size(); k += 3)
    {
        std::vector<ins_real> theta;
        for (size_t i = 0; i < 3; i++)
        {
            const auto x = real(increments[k + i]);
            theta.insert(theta.end(), x.begin(), x.end());
        }
        ins_real dq[4];
        EXPECT_EQ(ins_fiter_turn(INS_FITER_BLOCK3, theta.data(), dq), INS_OK);
        ins_quat_mul(q.data(), dq, q.data());
        ins_quat_normalise_approx(q.data());
        track.push_back({k + 3, quat(q.data())});
    }
    return track;
}

template <typename Known> Track run_fiter_motion(const Known& m, int form, double period, size_t steps)
{
    std::vector<Vec> before;
    std::vector<Vec> samples;
    for (long k = -4; k <= static_cast<long>(steps); k++)
    {
        const double t = static_cast<double>(k) * period;
        if (is_rate(form))
        {
            (k <= 0 ? before : samples).push_back(m.rate(t));
        }
        else if (k > -4)
        {
            (k <= 0 ? before : samples).push_back(m.increment(t - period, t));
        }
    }
    if (!is_rate(form))
    {
        before.insert(before.begin(), m.increment(-5 * period, -4 * period));
    }
    return run_fiter(form, period, m.attitude(0), before, samples);
}

inline Track run_thesis(const Quat& start, const Vec& before, const std::vector<Vec>& increments)
{
    Track track = {{0, start}};
    const auto q0 = real(start);
    ins_thesis_t t;
    EXPECT_EQ(ins_thesis_init(&t, q0.data()), INS_OK);
    EXPECT_EQ(ins_thesis_step(&t, real(before).data()), INS_S_START);
    std::copy(q0.begin(), q0.end(), t.q_nb);
    for (size_t k = 0; k < increments.size(); k++)
    {
        EXPECT_EQ(ins_thesis_step(&t, real(increments[k]).data()), INS_OK);
        track.push_back({k + 1, quat(t.q_nb)});
    }
    return track;
}

/// rates[2 i], [2 i + 1], [2 i + 2] are those of step i.
inline Track run_rk4(double feedback, double step_s, bool normalise, const Quat& start, const std::vector<Vec>& rates)
{
    Track track = {{0, start}};
    ins_thesis_rk4_t r;
    EXPECT_EQ(ins_thesis_rk4_init(&r, static_cast<ins_real>(feedback), static_cast<ins_real>(step_s),
                                  real(start).data(), real(rates[0]).data()),
              INS_OK);
    for (size_t k = 2; k < rates.size(); k += 2)
    {
        EXPECT_EQ(ins_thesis_rk4_step(&r, real(rates[k - 1]).data(), real(rates[k]).data()), INS_OK);
        if (normalise)
        {
            EXPECT_EQ(ins_quat_normalise(r.q_nb), INS_OK);
        }
        track.push_back({k, quat(r.q_nb)});
    }
    return track;
}

} // namespace core_test

#endif // INS_TESTS_ATTITUDE_RUNS_H
