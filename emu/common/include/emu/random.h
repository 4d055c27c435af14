/// \file   emu/random.h
/// \brief  Random numbers that are the same on every machine: splitmix64 (Steele, Lea and Flood 2014).
/// SPDX-License-Identifier: MIT
#ifndef EMU_RANDOM_H_INCLUDED
#define EMU_RANDOM_H_INCLUDED
#include "emu/time.h"
#ifdef __cplusplus
extern "C" {
#endif

/// 64 random bits; `state` begins as the seed, whatever it is.
EMU_API uint64_t emu_random(uint64_t* state);
/// A standard normal value, from uniform ones and comparisons alone: no logarithm whose last bit would differ between C libraries.
/// Source: C. F. F. Karney, ACM Trans. Math. Softw. 42(1), 2016, algorithm N.
EMU_API double emu_random_normal(uint64_t* state);

#ifdef __cplusplus
}
#endif
#endif // EMU_RANDOM_H_INCLUDED
