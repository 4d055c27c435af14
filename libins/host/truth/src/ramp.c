/// \file   ramp.c
/// \brief  A start from rest with continuous second derivative.
/// SPDX-License-Identifier: MIT
#include "ramp_internal.h"

ins_ramp_t ins_ramp_at(double ramp_s, double t)
{
    if (t <= 0.0)
    {
        return (ins_ramp_t){0.0, 0.0, 0.0};
    }
    if (t >= ramp_s)
    {
        return (ins_ramp_t){t - 0.5 * ramp_s, 1.0, 0.0};
    }
    const double x = t / ramp_s;
    return (ins_ramp_t){ramp_s * x * x * x * x * (2.5 + x * (x - 3.0)), x * x * x * (10.0 + x * (6.0 * x - 15.0)),
                        30.0 * x * x * (1.0 - x) * (1.0 - x) / ramp_s};
}
