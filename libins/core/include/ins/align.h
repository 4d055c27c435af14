/// \file   ins/align.h
/// \brief  Start attitude and start biases: means with their standard error, levelling, two-vector alignment. Frames: b -> n (NED).
///
/// Source: H. D. Black, AIAA J. 2(7), 1964, 1350-1351 (TRIAD); B. P. Welford, Technometrics 4(3), 1962, 419-420 (mean).
/// No libm but sqrt.
/// SPDX-License-Identifier: MIT
#ifndef INS_ALIGN_H_INCLUDED
#define INS_ALIGN_H_INCLUDED
#include "ins/config.h"
#ifdef __cplusplus
extern "C" {
#endif

/// Mean of three channels: a gyro's null in codes, or a specific force. A null is a fractional number: rounded to a code it is up to
/// half a code wrong, 6.3 deg/min with the 12-bit gyros of the thesis.
typedef struct ins_mean_t
{
    uint32_t count;
    ins_real quantum; ///< step of a sample, 0 if it has none
    ins_real mean[3];
    ins_real m2[3]; ///< sum of squared deviations
} ins_mean_t;

/// \return INS_OK; INS_E_RANGE unless quantum >= 0.
INS_API ins_status_t ins_mean_init(ins_mean_t* self, ins_real quantum);
/// \return INS_OK; INS_E_RANGE for NaN or infinity, unchanged.
INS_API ins_status_t ins_mean_add(ins_mean_t* self, const ins_real sample[3]);
/// \param[out] mean  [3]. \param[out] error  [3] its standard error, for samples that are independent. A channel with less noise than
/// a third of its quantum hides its null between two codes: its error is then quantum / sqrt(12), however many samples there are.
/// \return INS_OK; INS_E_STATE with fewer than 2 samples.
INS_API ins_status_t ins_mean_get(const ins_mean_t* self, ins_real mean[3], ins_real error[3]);

/// Roll and pitch from the specific force at rest, and a heading given. With the nose straight up or down, roll is 0.
/// \param[in] f_b  [3] mean specific force, any length > 0. \param[in] heading  of the nose, from north to east [rad].
/// \return INS_OK; INS_E_RANGE for NaN, infinity, no length or |heading| > 2 pi, q_nb unchanged.
INS_API ins_status_t ins_align_level(const ins_real f_b[3], ins_real heading, ins_real q_nb[4]);
/// Attitude from two directions known in both frames: the first is met exactly, the second gives the turn about it.
/// At rest: -f_b with {0, 0, 1}, and Earth rate or magnetic field. Any lengths > 0.
/// \return INS_OK; INS_E_RANGE for NaN, infinity, or if the two are within 1e-3 rad of a line in b or in n, q_nb unchanged.
INS_API ins_status_t ins_align_triad(const ins_real first_b[3], const ins_real second_b[3], const ins_real first_n[3],
                                     const ins_real second_n[3], ins_real q_nb[4]);

#ifdef __cplusplus
}
#endif
#endif // INS_ALIGN_H_INCLUDED
