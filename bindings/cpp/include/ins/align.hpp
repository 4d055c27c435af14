/// \file   ins/align.hpp
/// \brief  Start attitude from gravity and from two vectors. Frames: b -> n (NED). Unit: rad.
///
/// Thin: each function is one call of the C function named the same, whose header says frames, units and ranges.
/// SPDX-License-Identifier: MIT
#ifndef INS_ALIGN_HPP_INCLUDED
#define INS_ALIGN_HPP_INCLUDED
#include "ins/align.h"
#include "ins/eigen.hpp"

namespace ins
{
[[nodiscard]] inline Result<Quaternion> align_level(const Vector3& f_b, Real heading)
{
    return detail::get_quaternion([&](Real* out) { return ins_align_level(f_b.data(), heading, out); });
}

[[nodiscard]] inline Result<Quaternion> align_triad(const Vector3& first_b, const Vector3& second_b,
                                                    const Vector3& first_n, const Vector3& second_n)
{
    return detail::get_quaternion(
        [&](Real* out)
        { return ins_align_triad(first_b.data(), second_b.data(), first_n.data(), second_n.data(), out); });
}
} // namespace ins

#endif // INS_ALIGN_HPP_INCLUDED
