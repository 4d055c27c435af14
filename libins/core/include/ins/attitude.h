/// \file   ins/attitude.h
/// \brief  Attitude from angle increments: rotation vector with coning correction, quaternion, renormalisation. Frame: b -> n. Unit: rad.
///
///     ins_attitude_t a;
///     ins_attitude_init(&a, INS_CONING_HIST2_OPT, q_nb0);
///     for (;;) { ins_attitude_step(&a, dtheta_b); use(a.q_nb); }
///
/// One increment is one update (single interval with history). Start-up uses 0, 1, 2 previous increments as they come.
/// SPDX-License-Identifier: MIT
#ifndef INS_ATTITUDE_H_INCLUDED
#define INS_ATTITUDE_H_INCLUDED
#include "ins/config.h"
#include "ins/coning.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct ins_attitude_t
{
    ins_real q_nb[4];    ///< scalar first; v_n = q v_b q*
    ins_real prev[3][3]; ///< previous increments, newest first [rad]
    uint_least8_t form;  ///< INS_CONING_ONE or one of INS_CONING_HIST*
    uint_least8_t count; ///< previous increments held
} ins_attitude_t;

/// \return INS_OK; INS_E_RANGE for a block form, NaN, or a quaternion whose norm is not within 1e-3 of 1 (it is normalised).
INS_API ins_status_t ins_attitude_init(ins_attitude_t* self, int form, const ins_real q_nb[4]);
/// Add one increment, each component in [-0.5, 0.5] for the accuracy stated in docs/coning.md; larger is done exactly but slower.
/// \return INS_OK; INS_S_START; INS_E_RANGE for NaN or |component| > pi, and then self is unchanged.
INS_API ins_status_t ins_attitude_step(ins_attitude_t* self, const ins_real dtheta_b[3]);
/// Turn of the navigation frame over the same time: q_nb := q(-dzeta) q_nb. Optional, once an increment or less often.
/// \param[in] dzeta_n  [3] integral of w_in_n: Earth rate w_ie (cos L, 0, -sin L) in NED, without which level and heading drift by up to
/// 15 deg/h, plus transport rate (v_E / (N + h), -v_N / (M + h), -v_E tan L / (N + h)) [rad].
/// \return INS_OK; INS_E_RANGE as ins_quat_from_rotvec, and then self is unchanged.
INS_API ins_status_t ins_attitude_turn_frame(ins_attitude_t* self, const ins_real dzeta_n[3]);
/// Add one rotation that spans a gap; the history restarts.
INS_API ins_status_t ins_attitude_jump(ins_attitude_t* self, const ins_real phi_b[3]);

#ifdef __cplusplus
}
#endif
#endif // INS_ATTITUDE_H_INCLUDED
