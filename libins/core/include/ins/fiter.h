/// \file   ins/fiter.h
/// \brief  Attitude by functional iteration on a fitted rate polynomial, from angle increments or sampled rates. Frame: b -> n.
///
///     ins_fiter_t f;
///     ins_fiter_init(&f, INS_FITER_HIST3, 1, q_nb0);       // increments [rad]; for rates: INS_FITER_RATE4, T, q_nb0
///     for (;;) { ins_fiter_step(&f, dtheta_b); use(f.q_nb); }
///
/// A polynomial in time is laid through the last samples, and q' = q w / 2 is solved for it to the last bit: no truncated Bortz equation.
/// For slow sampling and large manoeuvres; in vibration the coning forms (ins/coning.h) do the same for a twentieth of the work.
/// Source: Y. Wu, RodFIter, IEEE Trans. Aerosp. Electron. Syst. 54(5), 2018, 2131-2142; here with quaternions: docs/fiter.md.
/// Cost: 0.5 to 2 thousand operations a step in smooth motion, about 600 octets of stack in double. No libm, no allocation.
/// SPDX-License-Identifier: MIT
#ifndef INS_FITER_H_INCLUDED
#define INS_FITER_H_INCLUDED
#include "ins/config.h"
#ifdef __cplusplus
extern "C" {
#endif

/// What the polynomial goes through, and the interval it is solved for.
enum
{
    INS_FITER_HIST0 =
        0, ///< the last increment alone: constant rate. Solved for the last interval, as are all HIST and RATE forms
    INS_FITER_HIST1,
    INS_FITER_HIST2, ///< the last increment and 2 before it
    INS_FITER_HIST3, ///< the default for slow sampling
    INS_FITER_HIST4,
    INS_FITER_RATE2, ///< the last 2 samples of the rate
    INS_FITER_RATE3,
    INS_FITER_RATE4,
    INS_FITER_RATE5,
    INS_FITER_BLOCK3, ///< 3 increments, solved for all of them (ins_fiter_turn only)
    INS_FITER_FORM_COUNT
};

#define INS_FITER_SAMPLES_MAX 5
#define INS_FITER_DEGREE                                                                                               \
    80 ///< the solution is a polynomial in time of this degree at most; of 10 to 20 for smooth motion

/// Start with ins_fiter_init().
typedef struct ins_fiter_t
{
    ins_real q_nb[4];                            ///< scalar first; v_n = q v_b q*
    ins_real prev[INS_FITER_SAMPLES_MAX - 1][3]; ///< previous increments, or rates times T, newest first [rad]
    ins_real scale;                              ///< sample to angle: 1, or T for rates
    uint_least8_t form;
    uint_least8_t count; ///< previous samples held
} ins_fiter_t;

/// Samples a form reads, 1 .. INS_FITER_SAMPLES_MAX; 0 if there is no such form.
INS_API int ins_fiter_samples(int form);

/// \param[in] theta_b  [ins_fiter_samples(form) * 3] increments, or rates times T, oldest first [rad]; |component| <= pi.
/// \param[out] dq  [4] rotation over the form's interval.
/// \return INS_OK; INS_E_RANGE if there is no such form, for NaN, or if the series does not end within INS_FITER_DEGREE (increments of
/// up to 0.5 rad always do, of a block up to 0.05), dq unchanged.
INS_API ins_status_t ins_fiter_turn(int form, const ins_real* theta_b, ins_real dq[4]);

/// \param[in] period_s  T > 0 of a RATE form [s]; not read for increments.
/// \return INS_OK; INS_E_RANGE for BLOCK3, NaN, or a quaternion whose norm is not within 1e-3 of 1 (it is normalised).
INS_API ins_status_t ins_fiter_init(ins_fiter_t* self, int form, ins_real period_s, const ins_real q_nb[4]);
/// Next increment [rad], or next sample of the rate [rad/s], the first one of which belongs to the start attitude and turns nothing.
/// \return INS_OK; INS_S_START with fewer samples than the form reads; INS_E_RANGE as ins_fiter_turn, and then self is unchanged.
INS_API ins_status_t ins_fiter_step(ins_fiter_t* self, const ins_real sample_b[3]);

#ifdef __cplusplus
}
#endif
#endif // INS_FITER_H_INCLUDED
