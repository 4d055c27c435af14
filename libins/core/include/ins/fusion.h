/// \file   ins/fusion.h
/// \brief  Fusion of several estimates of one state, information sharing, and the switch between GPS and dead reckoning.
///
///     ins_fusion_clear(n, info, y);
///     for (i = 0; i < count; i++) { ins_fusion_add(n, info, y, x_i[i], P_i[i], work); } // info += P_i^-1, y += P_i^-1 x_i
///     ins_fusion_solve(n, info, y, x, P);                                        // P = info^-1, x = P y
///     ins_fusion_share(n, P, beta, P_i[0]);                                   // back to the local filters: sum beta = 1
///
/// Fusion takes the estimates for uncorrelated. Information sharing (P/beta and Q/beta in each local filter) stays conservative when
/// they start from the same state.
/// Source: N. A. Carlson, IEEE Trans. AES 26(3), 1990, 517-525 (information sharing).
/// SPDX-License-Identifier: MIT
#ifndef INS_FUSION_H_INCLUDED
#define INS_FUSION_H_INCLUDED
#include "ins/config.h"
#ifdef __cplusplus
extern "C" {
#endif

/// \param[out] info  [n n] and y [n]: nothing known.
INS_API void ins_fusion_clear(unsigned n, ins_real* info, ins_real* y);
/// \param[in] x  [n], P [n n] an estimate and its covariance. \param work  [n n].
/// \return INS_E_RANGE, and info and y unchanged: P is not positive definite.
INS_API ins_status_t ins_fusion_add(unsigned n, ins_real* info, ins_real* y, const ins_real* x, const ins_real* P,
                                    ins_real* work);
/// \param[out] x  [n], P [n n] the fused estimate; P is undefined when refused. \return INS_E_RANGE: too little is known.
INS_API ins_status_t ins_fusion_solve(unsigned n, const ins_real* info, const ins_real* y, ins_real* x, ins_real* P);
/// P_local = P/beta (also for Q). \param[in] beta  (0, 1]. \return INS_E_RANGE: beta is not in there.
INS_API ins_status_t ins_fusion_share(unsigned n, const ins_real* P, ins_real beta, ins_real* P_local);

enum
{
    INS_SWITCH_DR,
    INS_SWITCH_GPS
};

#define INS_SWITCH_BACK_PAPER 1 ///< epochs: at once when the signal recovers, as the GPS/DR paper prints it
#define INS_SWITCH_BACK_GOOD  3 ///< with hysteresis, against flicker between buildings

typedef struct ins_switch_config_t
{
    ins_real hdop_max;  ///< 4 is good
    ins_real gate;      ///< of the fix's nis, 2 degrees of freedom: INS_KALMAN_GATE2_99; 0: not looked at
    uint_least8_t sats; ///< fewest satellites: 4
    uint_least8_t back; ///< good epochs in a row to go from DR to GPS: INS_SWITCH_BACK_GOOD
} ins_switch_config_t;

/// Owned by the caller; readable. Starts in DR.
typedef struct ins_switch_t
{
    ins_switch_config_t cfg;
    uint_least8_t mode; ///< INS_SWITCH_DR or INS_SWITCH_GPS
    uint_least8_t good; ///< the last epoch was good
    uint_least8_t run;  ///< good epochs in a row, up to back
} ins_switch_t;

/// \return INS_E_RANGE: back is 0, hdop_max is not positive, or gate is negative.
INS_API ins_status_t ins_switch_init(ins_switch_t* self, const ins_switch_config_t* cfg);
/// One GPS epoch. \param[in] nis  of its fix, or 0 if there is none. A NaN in hdop or nis makes the epoch bad.
/// \return the mode: to DR at the first bad epoch, to GPS after `back` good ones.
INS_API int ins_switch_epoch(ins_switch_t* self, int valid, unsigned sats, ins_real hdop, ins_real nis);

#ifdef __cplusplus
}
#endif
#endif // INS_FUSION_H_INCLUDED
