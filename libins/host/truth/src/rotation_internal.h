/// \file   rotation_internal.h
/// \brief  Quaternions (scalar first, rotating b into n) and ZYX angles of motions and tracks. rad.
/// SPDX-License-Identifier: MIT
#ifndef INS_TRUTH_ROTATION_INTERNAL_H_INCLUDED
#define INS_TRUTH_ROTATION_INTERNAL_H_INCLUDED

/// out is neither p nor q.
void ins_rotation_product(const double p[4], const double q[4], double out[4]);
/// v_b = conj(q_nb) v_n q_nb; out may be in.
void ins_rotation_into_b(const double q_nb[4], const double v_n[3], double v_b[3]);
/// ypr = yaw, pitch, roll.
void ins_rotation_of_angles(const double ypr[3], double q_nb[4]);
/// Body rate of angles that change at `speed` [rad/s].
void ins_rotation_rate(const double ypr[3], const double speed[3], double w_nb_b[3]);

#endif // INS_TRUTH_ROTATION_INTERNAL_H_INCLUDED
