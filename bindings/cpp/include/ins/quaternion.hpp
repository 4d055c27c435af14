/// \file   ins/quaternion.hpp
/// \brief  Rotation vector, Euler angles and direction cosines to Eigen quaternions and back. Unit: rad.
///
/// Thin: each function is one call of the C function named the same, whose header says frames, units and ranges.
/// SPDX-License-Identifier: MIT
#ifndef INS_QUATERNION_HPP_INCLUDED
#define INS_QUATERNION_HPP_INCLUDED
#include "ins/eigen.hpp"
#include "ins/quat.h"

namespace ins
{
[[nodiscard]] inline Result<Quaternion> from_rotvec(const Vector3& phi)
{
    return detail::get_quaternion([&](Real* out) { return ins_quat_from_rotvec(phi.data(), out); });
}

/// euler: roll, pitch, yaw.
[[nodiscard]] inline Quaternion from_euler(const Vector3& euler)
{
    return detail::fill_quaternion([&](Real* out) { ins_quat_from_euler(euler.data(), out); });
}

[[nodiscard]] inline Vector3 to_euler(const Quaternion& q_nb)
{
    return detail::fill<Vector3>([&](Real* out) { ins_quat_to_euler(detail::Quat(q_nb).q, out); });
}

[[nodiscard]] inline Matrix3 to_dcm(const Quaternion& q_nb)
{
    return detail::fill_matrix([&](Real* out) { ins_quat_to_dcm(detail::Quat(q_nb).q, out); });
}

[[nodiscard]] inline Result<Quaternion> from_dcm(const Matrix3& C_nb)
{
    const Square<3> rows = C_nb;
    return detail::get_quaternion([&](Real* out) { return ins_quat_from_dcm(rows.data(), out); });
}
} // namespace ins

#endif // INS_QUATERNION_HPP_INCLUDED
