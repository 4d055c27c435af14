/// \file   ins/q31.h
/// \brief  Attitude from angle increments in integers, for targets without an FPU. Frame: b -> n. Unit: rad.
///
///     ins_q31_t a;
///     ins_q31_init(&a, q_nb0);                             // Q30: 1.0 is 1 << 30
///     for (;;) { ins_q31_step(&a, dtheta_b); use(a.q_nb); } // Q31: 1 rad is 1 << 31
///
/// INS_CONING_HIST2_OPT (ins/coning.h) with renormalisation, the same bits on every machine and in both builds of the core.
/// ins_q31_t holds q in 32 bits, ins_q31w_t in 64 for half the error or less. Any increment up to 0.5 rad; sample faster beyond.
/// Cost: 39 products of 32 x 32 bits, no division, no branch that depends on the data; an ARMv6-M forms each of four of 16 bits, with
/// the same results. docs/q31.md has the error, the format and the instructions of each core.
/// SPDX-License-Identifier: MIT
#ifndef INS_Q31_H_INCLUDED
#define INS_Q31_H_INCLUDED
#include "ins/config.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_Q31_ONE INT32_C(0x40000000) ///< 1.0 of a quaternion

/// Start with ins_q31_init().
typedef struct ins_q31_t
{
    int32_t q_nb[4];     ///< Q30, scalar first; v_n = q v_b q*
    int32_t prev[2][3];  ///< previous increments, newest first, Q31 [rad]
    uint_least8_t count; ///< previous increments held
} ins_q31_t;

/// Start with ins_q31w_init().
typedef struct ins_q31w_t
{
    int64_t q_nb[4]; ///< Q62
    int32_t prev[2][3];
    uint_least8_t count;
} ins_q31w_t;

/// \param[in] q_nb  [4] Q30. \return INS_OK; INS_E_RANGE for a norm that is not within 1e-3 of 1 (it is normalised).
INS_API ins_status_t ins_q31_init(ins_q31_t* self, const int32_t q_nb[4]);
/// Turn by one increment. \param[in] dtheta_b  [3] Q31 [rad], |dtheta| < 0.5.
/// \return INS_OK; INS_S_START for the first two; INS_E_RANGE for one that turns by 0.5 or more, its coning
/// term included, and then self is unchanged.
INS_API ins_status_t ins_q31_step(ins_q31_t* self, const int32_t dtheta_b[3]);

/// As ins_q31_init(); normalised to 62 places.
INS_API ins_status_t ins_q31w_init(ins_q31w_t* self, const int32_t q_nb[4]);
/// As ins_q31_step().
INS_API ins_status_t ins_q31w_step(ins_q31w_t* self, const int32_t dtheta_b[3]);
/// \param[out] q_nb  [4] Q30, rounded.
INS_API void ins_q31w_get(const ins_q31w_t* self, int32_t q_nb[4]);

#ifdef __cplusplus
}
#endif
#endif // INS_Q31_H_INCLUDED
