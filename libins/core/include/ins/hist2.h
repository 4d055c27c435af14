/// \file   ins/hist2.h
/// \brief  Attitude from angle increments by the default formula alone, for small flash. Frame: b -> n. Unit: rad.
///
///     ins_hist2_t a;
///     ins_hist2_init(&a, q_nb0);
///     for (;;) { ins_hist2_step(&a, dtheta_b); use(a.q_nb); }
///
/// INS_CONING_HIST2_OPT (ins/coning.h) with renormalisation, start-up included: the numbers of ins_attitude_step() to the last
/// bit, for a quarter of its code. Links nothing else of the core and no libm. Any increment up to 0.5 rad; sample faster
/// beyond, or take ins/attitude.h. Without an FPU ins/q31.h is quicker yet. docs/coning.md, docs/targets.md.
/// SPDX-License-Identifier: MIT
#ifndef INS_HIST2_H_INCLUDED
#define INS_HIST2_H_INCLUDED
#include "ins/config.h"
#ifdef __cplusplus
extern "C" {
#endif

/// Start with ins_hist2_init().
typedef struct ins_hist2_t
{
    ins_real q_nb[4];    ///< scalar first; v_n = q v_b q*
    ins_real prev[2][3]; ///< previous increments, newest first [rad]
    uint_least8_t count; ///< previous increments held
} ins_hist2_t;

/// \return INS_OK; INS_E_RANGE for NaN, or a norm that is not within 1e-3 of 1 (it is normalised), and then self is unchanged.
INS_API ins_status_t ins_hist2_init(ins_hist2_t* self, const ins_real q_nb[4]);
/// Turn by one increment.
/// \return INS_OK; INS_S_START for the first two; INS_E_RANGE for NaN or one that turns by more than 0.5, its coning term
/// included, and then self is unchanged.
INS_API ins_status_t ins_hist2_step(ins_hist2_t* self, const ins_real dtheta_b[3]);

#ifdef __cplusplus
}
#endif
#endif // INS_HIST2_H_INCLUDED
