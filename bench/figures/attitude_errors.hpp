/// \file   attitude_errors.hpp
/// \brief  Largest errors of the core's attitude algorithms over a known motion: attitude(t), rate(t), increment(t0, t1). rad, s.
/// SPDX-License-Identifier: MIT
#ifndef INS_BENCH_ATTITUDE_ERRORS_HPP
#define INS_BENCH_ATTITUDE_ERRORS_HPP
#include "attitude_runs.h"
#include <functional>
#include <string>
#include <vector>

namespace figures
{
using namespace core_test;

using Truth = std::function<Quat(size_t)>;

template <typename Known> Truth truth_of(const Known& m, double period)
{
    return [&m, period](size_t k) { return m.attitude(static_cast<double>(k) * period); };
}

template <typename Known> double named(const Known& m, const std::string& name, double period, size_t steps)
{
    return max_error(run_named(m, name, period, steps), truth_of(m, period));
}

template <typename Known> double fiter(const Known& m, int form, double period, size_t steps)
{
    const auto truth = truth_of(m, period);
    if (form != INS_FITER_BLOCK3)
    {
        return max_error(run_fiter_motion(m, form, period, steps), truth);
    }
    std::vector<Vec> incs;
    for (size_t k = 0; k < steps; k++)
    {
        incs.push_back(m.increment(static_cast<double>(k) * period, static_cast<double>(k + 1) * period));
    }
    return max_error(run_block3(truth(0), incs), truth);
}

/// The thesis's update, from increments.
template <typename Known> double thesis(const Known& m, double period, size_t steps)
{
    std::vector<Vec> incs;
    for (size_t k = 0; k < steps; k++)
    {
        incs.push_back(m.increment(static_cast<double>(k) * period, static_cast<double>(k + 1) * period));
    }
    return max_error(run_thesis(m.attitude(0), m.increment(-period, 0), incs), truth_of(m, period));
}

/// The thesis's RK4 with the rate every `sample`, two samples a step.
template <typename Known> double rk4(const Known& m, double sample, size_t samples)
{
    std::vector<Vec> rates;
    for (size_t k = 0; k <= samples; k++)
    {
        rates.push_back(m.rate(static_cast<double>(k) * sample));
    }
    return max_error(run_rk4(0, 2 * sample, true, m.attitude(0), rates), truth_of(m, sample));
}

/// Rates taken for constant until the next sample: what a firmware does that takes an ADC's samples for increments.
template <typename Known> double rectangle(const Known& m, double period, size_t steps)
{
    std::vector<Vec> pre;
    std::vector<Vec> incs;
    for (long k = -3; k < static_cast<long>(steps); k++)
    {
        Vec w = m.rate(static_cast<double>(k) * period);
        for (double& x : w)
        {
            x *= period;
        }
        (k < 0 ? pre : incs).push_back(w);
    }
    return max_error(run_form(INS_CONING_HIST2_OPT, m.attitude(0), pre, incs), truth_of(m, period));
}
} // namespace figures

#endif // INS_BENCH_ATTITUDE_ERRORS_HPP
