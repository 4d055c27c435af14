/// \file   signal.hpp
/// \brief  Volts on an analogue input as a function of time: a constant, a sine and points joined by straight lines, added. V, s.
/// SPDX-License-Identifier: MIT
#pragma once
#include "ins_truth/elementary.h"
#include <algorithm>
#include <array>
#include <vector>

namespace libins
{

struct Signal
{
    std::array<double, 4> wave{}; ///< volts, amplitude [V], frequency [Hz], phase [rad]
    std::vector<double> t_s, v;   ///< points; before the first and after the last their volts stay

    double at(double t) const
    {
        double sine = 0.0, cosine = 0.0;
        ins_truth_sincos(2.0 * INS_TRUTH_PI * wave[2] * t + wave[3], &sine, &cosine);
        return wave[0] + wave[1] * sine + (t_s.empty() ? 0.0 : joined(t));
    }

  private:
    double joined(double t) const
    {
        const auto next = static_cast<size_t>(std::upper_bound(t_s.begin(), t_s.end(), t) - t_s.begin());
        if (next == 0 || next == t_s.size())
        {
            return next == 0 ? v.front() : v.back();
        }
        return v[next - 1] + (v[next] - v[next - 1]) * ((t - t_s[next - 1]) / (t_s[next] - t_s[next - 1]));
    }
};

} // namespace libins
