/// \file   ins/quat.h
/// \brief  Attitude quaternions: product, rotation, normalisation, Euler angles, direction cosines, rotation vector.
///
/// A quaternion is {w, x, y, z}, Hamilton; q_nb turns body vectors into navigation: v_n = q_nb v_b q_nb*. docs/conventions.md is law.
/// C_nb[9] is row-major in the same sense. euler = {roll, pitch, yaw} [rad], the ZYX sequence: yaw first, then pitch, then roll.
/// Source: J. B. Kuipers, Quaternions and Rotation Sequences, 1999; S. W. Shepperd, J. Guid. Control 1(3), 1978 (from_dcm);
/// E. Bernardes, S. Viollet, PLoS ONE 17(11), 2022, e0276302 (to_euler).
/// SPDX-License-Identifier: MIT
#ifndef INS_QUAT_H_INCLUDED
#define INS_QUAT_H_INCLUDED
#include "ins/config.h"
#ifdef __cplusplus
extern "C" {
#endif

/// Largest |phi| that ins_quat_from_rotvec takes [rad]; its error there is that of an angle rounded at this size.
#define INS_ROTVEC_MAX 1000

/// \param[out] out  [4] p q; may be p or q.
INS_API void ins_quat_mul(const ins_real p[4], const ins_real q[4], ins_real out[4]);
/// \param[out] out  [4] q*, the inverse rotation of a unit quaternion; may be q.
INS_API void ins_quat_conj(const ins_real q[4], ins_real out[4]);
/// \param[out] v_n  [3] q_nb v_b q_nb*; may be v_b.
INS_API void ins_quat_rotate(const ins_real q_nb[4], const ins_real v_b[3], ins_real v_n[3]);

/// Exact: divides by the square root. \return INS_OK; INS_E_RANGE for NaN, infinity or a norm out of 1e-15 .. 1e15, q unchanged.
INS_API ins_status_t ins_quat_normalise(ins_real q[4]);
/// First order, without root or division: q (3/2 - |q|^2 / 2). Leaves a norm error of 3/8 eps^2, eps = 1 - |q|^2: for |eps| < 1e-3.
INS_API void ins_quat_normalise_approx(ins_real q[4]);

/// Rotation vector to quaternion, {cos(|phi|/2), phi sin(|phi|/2) / |phi|}, with no libm. The sign of q is that of the formula.
/// \return INS_OK; INS_E_RANGE for NaN or |phi| > INS_ROTVEC_MAX, q unchanged.
INS_API ins_status_t ins_quat_from_rotvec(const ins_real phi[3], ins_real q[4]);

/// \param[in] euler  [3] roll, pitch, yaw [rad]. \param[out] q_nb  [4]. Uses libm's sin and cos.
INS_API void ins_quat_from_euler(const ins_real euler[3], ins_real q_nb[4]);
/// Uses libm's atan2, for display and comparison. roll, yaw in [-pi, pi], pitch in [-pi/2, pi/2]. At a pole of pitch only
/// yaw - roll (nose up) or yaw + roll (nose down) has a meaning: there the roll returned is 0, so no angle is noise.
INS_API void ins_quat_to_euler(const ins_real q_nb[4], ins_real euler[3]);

/// \param[in] q_nb  [4] of unit length. \param[out] C_nb  [9] row-major, v_n = C_nb v_b.
INS_API void ins_quat_to_dcm(const ins_real q_nb[4], ins_real C_nb[9]);
/// \return INS_OK; INS_E_RANGE unless C_nb is a rotation (each element within 1e-3 of the one that q_nb gives), q_nb unchanged.
INS_API ins_status_t ins_quat_from_dcm(const ins_real C_nb[9], ins_real q_nb[4]);

#ifdef __cplusplus
}
#endif
#endif // INS_QUAT_H_INCLUDED
