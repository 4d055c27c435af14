/// \file   ins/sculling.h
/// \brief  Velocity increments with sculling correction, beside the attitude step. Frames: b -> n. Units: rad, m/s.
///
///     ins_sculling_t s;
///     ins_sculling_init(&s, INS_CONING_HIST2_OPT, q_nb0);
///     for (;;) { ins_sculling_step(&s, &increment, dv_b); use(dv_b); } // s.q_nb, and dv_b in b at the interval's start
///
/// dv = v + theta x v / 2 + sum c_ij (theta_i x v_j + v_i x theta_j): the coefficients of coning serve here too (duality), so both
/// share their history. Inputs are the integrals of rate and specific force over the interval, in the moving body frame.
/// Source: K. M. Roscoe, J. Guid. Control Dyn. 24(2), 2001, 205-212 (duality); coefficients: ins/coning.h, docs/coning.md.
/// SPDX-License-Identifier: MIT
#ifndef INS_SCULLING_H_INCLUDED
#define INS_SCULLING_H_INCLUDED
#include "ins/attitude.h"
#include "ins/config.h"
#ifdef __cplusplus
extern "C" {
#endif

/// What an IMU gives for one interval, each integrated in the moving body frame.
typedef struct ins_increment_t
{
    ins_real theta_b[3]; ///< of the angular rate w_ib_b [rad]
    ins_real v_b[3];     ///< of the specific force f_b [m/s]
} ins_increment_t;

/// Owned by the caller. Start with ins_sculling_init().
typedef struct ins_sculling_t
{
    ins_real q_nb[4];        ///< attitude at the end of the last interval
    ins_increment_t prev[3]; ///< previous increments, newest first
    uint_least8_t form;      ///< as in ins_attitude_t
    uint_least8_t count;     ///< previous increments held
} ins_sculling_t;

/// \return as ins_attitude_init.
INS_API ins_status_t ins_sculling_init(ins_sculling_t* self, int form, const ins_real q_nb[4]);
/// Next interval: attitude and velocity increment. Angles as in ins_attitude_step.
/// \param[out] dv_b  [3] specific force integrated in b as it stood at the start of the interval [m/s]; not in the increment.
/// \return INS_OK; INS_S_START; INS_E_RANGE for NaN, infinity or |component of theta_b| > pi; nothing is changed then.
INS_API ins_status_t ins_sculling_step(ins_sculling_t* self, const ins_increment_t* increment, ins_real dv_b[3]);
/// The correction alone, for any form: as ins_coning_phi. \param[in] increments  [ins_coning_samples(form)], oldest first.
/// \return INS_OK; INS_E_RANGE if there is no such form. NaN in gives NaN out.
INS_API ins_status_t ins_sculling_dv(int form, const ins_increment_t* increments, ins_real dv_b[3]);

#ifdef __cplusplus
}
#endif
#endif // INS_SCULLING_H_INCLUDED
