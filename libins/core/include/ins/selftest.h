/// \file   ins/selftest.h
/// \brief  Known-answer self-test of the attitude path, for a firmware's start: some 60 steps, no libm.
///
///     if (ins_selftest() != 0) { refuse_to_fly(); }
///
/// It runs the very functions the firmware uses on motions whose answer is known, so a coning term that is silently zero, of the wrong
/// sign or with one wrong coefficient is found, as is a soft-float library or compiler flag that spoils the arithmetic.
/// SPDX-License-Identifier: MIT
#ifndef INS_SELFTEST_H_INCLUDED
#define INS_SELFTEST_H_INCLUDED
#include "ins/config.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_SELFTEST_ABI    0x01u ///< headers and library differ (INS_ABI_CHECK)
#define INS_SELFTEST_CONING 0x02u ///< a coefficient sum of a coning form
#define INS_SELFTEST_STEP   0x04u ///< ins_attitude_step over one turn of a cone: its drift, its norm
#define INS_SELFTEST_FITER  0x08u ///< functional iteration over the same cone
#define INS_SELFTEST_RATES  0x10u ///< Adams-Moulton weights
#define INS_SELFTEST_FIXED  0x20u ///< ins_q31_t over the same cone

/// \return 0, or the INS_SELFTEST_* of what failed, or-ed.
INS_API unsigned ins_selftest(void);

#ifdef __cplusplus
}
#endif
#endif // INS_SELFTEST_H_INCLUDED
