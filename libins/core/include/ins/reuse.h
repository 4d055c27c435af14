/// \file   ins/reuse.h
/// \brief  Attitude at every sample from three-sample blocks: three interleaved chains, Q(k+1) = Q(k-2) q(Phi). Frame: b -> n.
///
/// This is "sample reuse" of Zheng and Zhou (2010), section 1.2, read so that it holds: Phi spans [t(k-2), t(k+1)], so it turns
/// Q(k-2) and not Q(k), which would rotate three times too far. It needs three start attitudes. A history form (ins/attitude.h)
/// gives the same rate of output from one chain and one start attitude; take that unless you compare with the paper.
/// SPDX-License-Identifier: MIT
#ifndef INS_REUSE_H_INCLUDED
#define INS_REUSE_H_INCLUDED
#include "ins/config.h"
#ifdef __cplusplus
extern "C" {
#endif

/// Start with ins_reuse_init(). Members are private.
typedef struct ins_reuse_t
{
    ins_real q_nb[3][4];  ///< Q(k), Q(k+1), Q(k+2) in turn
    ins_real theta[2][3]; ///< the two increments before the next, oldest first [rad]
    uint_least8_t form;
    uint_least8_t slot;  ///< chain whose turn is next
    uint_least8_t count; ///< increments held
} ins_reuse_t;

/// \param[in] form  INS_CONING_BLOCK3_FIT or _OPT. \param[in] q_nb  [12] Q(0), Q(1), Q(2), each within 1e-3 of unit norm.
/// \return INS_OK or INS_E_RANGE.
INS_API ins_status_t ins_reuse_init(ins_reuse_t* self, int form, const ins_real q_nb[12]);
/// \param[in] dtheta_b  [3] increment from t(k) to t(k+1), |component| <= pi. \param[out] q_nb  [4] Q(k+1).
/// \return INS_OK; INS_S_START for the first two, where Q(1) and Q(2) of the start are returned; INS_E_RANGE, self unchanged.
INS_API ins_status_t ins_reuse_step(ins_reuse_t* self, const ins_real dtheta_b[3], ins_real q_nb[4]);

#ifdef __cplusplus
}
#endif
#endif // INS_REUSE_H_INCLUDED
