/// \file   noise_internal.h
/// \brief  Random numbers by place: a pure function of seed, stream and cell.
/// SPDX-License-Identifier: MIT
#ifndef INS_TRUTH_NOISE_INTERNAL_H_INCLUDED
#define INS_TRUTH_NOISE_INTERNAL_H_INCLUDED
#include <stdint.h>

/// 64 random bits.
uint64_t ins_noise_bits(uint64_t seed, unsigned stream, int64_t cell);
/// Standard normal value (Box and Muller 1958).
double ins_noise_normal(uint64_t seed, unsigned stream, int64_t cell);

#endif // INS_TRUTH_NOISE_INTERNAL_H_INCLUDED
