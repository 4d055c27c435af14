/// \file   ins/gimu.hpp
/// \brief  Samples of a GIMU packet to increments. Frame: b. Units: rad, m/s. The packets themselves: ins/gimu.h, as in C.
///
/// Thin: each function is one call of the C function named the same, whose header says frames, units and ranges.
/// SPDX-License-Identifier: MIT
#ifndef INS_GIMU_HPP_INCLUDED
#define INS_GIMU_HPP_INCLUDED
#include "ins/gimu.h"
#include "ins/sculling.hpp"

namespace ins
{
[[nodiscard]] inline Increment gimu_increments(const ins_gimu_scale_t& scale, const uint16_t (&raw)[6], Real dt)
{
    Increment out;
    ins_gimu_increments(&scale, raw, dt, out.theta_b.data(), out.v_b.data());
    return out;
}
} // namespace ins

#endif // INS_GIMU_HPP_INCLUDED
