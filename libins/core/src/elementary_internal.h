/// \file   elementary_internal.h
/// \brief  exp, sine and cosine for states that must be the same bits everywhere: additions and products only, no libm.
///
/// Largest error in double: decay 4e-16 of 1 - e, turn 3e-16; in float 3e-7 and 1e-7 (test_markov.cpp).
/// SPDX-License-Identifier: MIT
#ifndef INS_ELEMENTARY_INTERNAL_H_INCLUDED
#define INS_ELEMENTARY_INTERNAL_H_INCLUDED
#include "ins/config.h"

/// exp(-x), and 1 - exp(-x) without cancellation, for x >= 0. \param[out] rest  1 - exp(-x), or 0 if it is not wanted.
ins_real ins_elementary_decay(ins_real x, ins_real* rest);
/// Sine and cosine; |x| is reduced by multiples of pi/2 and must be below 1e4 (headings are kept within one turn).
void ins_elementary_turn(ins_real x, ins_real* sine, ins_real* cosine);
/// x within (-pi, pi]; |x| below 1e4.
ins_real ins_elementary_wrap(ins_real x);

#endif // INS_ELEMENTARY_INTERNAL_H_INCLUDED
