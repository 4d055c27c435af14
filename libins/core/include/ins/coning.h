/// \file   ins/coning.h
/// \brief  Rotation vector of an interval from the gyro's angle increments, coning corrected. Frame: b. Unit: rad.
///
///     ins_real theta[9];
///     for (i = 0; i < 9; i++) { theta[i] = sample(i); }   // three increments, oldest first
///     ins_coning_phi(INS_CONING_BLOCK3_OPT, theta, phi);  // then q_nb = q_nb q(phi)
///
/// Phi = sum theta_i + sum c_ij theta_i x theta_j. Block forms span all their increments. History forms span the last increment
/// alone and take the ones before it only to know how the rate turns; ins_attitude_t does that bookkeeping, and the start-up.
/// FIT: exact for a rate that is a polynomial in time. OPT: least drift in coning motion. docs/coning.md says which to take.
/// Source: R. B. Miller, J. Guid. Control 6(4), 1983, 287-291; P. G. Savage, J. Guid. Control Dyn. 21(1), 1998, 19-28;
/// M. B. Ignagni, J. Guid. Control 13(2), 1990, 363-369. Coefficients: docs/coning.md.
/// SPDX-License-Identifier: MIT
#ifndef INS_CONING_H_INCLUDED
#define INS_CONING_H_INCLUDED
#include "ins/config.h"
#ifdef __cplusplus
extern "C" {
#endif

/// Where FIT and OPT are the same there is one name. MU: coefficients shaped for a band of vibration frequencies.
enum
{
    INS_CONING_ONE = 0, ///< Phi = theta: no correction (block of 1, or no history)
    INS_CONING_HIST1,   ///< 1 increment before the interval
    INS_CONING_HIST2_FIT,
    INS_CONING_HIST2_OPT, ///< the default
    INS_CONING_HIST3_FIT,
    INS_CONING_HIST3_OPT,
    INS_CONING_BLOCK2,
    INS_CONING_BLOCK3_FIT, ///< 33/80, 57/80: equation 5 of Zheng and Zhou (2010)
    INS_CONING_BLOCK3_OPT,
    INS_CONING_BLOCK4_FIT,
    INS_CONING_BLOCK4_OPT,
    INS_CONING_HIST2_MU03, ///< history of 2, least peak drift for vibration of up to 0.3 rad of phase an increment: 0.048 / T
    INS_CONING_HIST2_MU06, ///< up to 0.6 rad
    INS_CONING_HIST2_MU10, ///< up to 1 rad
    INS_CONING_FORM_COUNT
};

#define INS_CONING_SAMPLES_MAX 4

/// Increments a form reads, 1 .. INS_CONING_SAMPLES_MAX; 0 if there is no such form.
INS_API int ins_coning_samples(int form);
/// 1 if the form spans all its increments, 0 if only the last (history forms).
INS_API int ins_coning_is_block(int form);
/// \param[in] theta_b  [ins_coning_samples(form) * 3], oldest first. \param[out] phi_b  [3] rotation vector of the interval.
/// \return INS_OK; INS_E_RANGE if there is no such form. NaN in gives NaN out.
INS_API ins_status_t ins_coning_phi(int form, const ins_real* theta_b, ins_real phi_b[3]);

#ifdef __cplusplus
}
#endif
#endif // INS_CONING_H_INCLUDED
