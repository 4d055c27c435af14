/// \file   noise.c
/// \brief  SplitMix64's mixing function (Steele, Lea and Flood 2014) as a hash, and normal values from it.
/// SPDX-License-Identifier: MIT
#include "ins_truth/elementary.h"
#include "noise_internal.h"
#include <math.h>

#define GOLDEN UINT64_C(0x9e3779b97f4a7c15)

static uint64_t mix(uint64_t z)
{
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

/// (0, 1]
static double unit(uint64_t z)
{
    return ((double)(z >> 11) + 0.5) * 0x1p-53;
}

uint64_t ins_noise_bits(uint64_t seed, unsigned stream, int64_t cell)
{
    return mix(mix(seed + GOLDEN * (stream + 1u)) + GOLDEN * (uint64_t)cell);
}

double ins_noise_normal(uint64_t seed, unsigned stream, int64_t cell)
{
    const uint64_t a = ins_noise_bits(seed, stream, cell);
    const uint64_t b = mix(a + GOLDEN);
    double s;
    double c;
    ins_truth_sincos(2.0 * INS_TRUTH_PI * unit(b), &s, &c);
    return sqrt(-2.0 * ins_truth_log(unit(a))) * c;
}
