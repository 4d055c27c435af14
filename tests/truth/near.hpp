// Comparison of vectors, and the random numbers of these tests.
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// The larger of two errors; NaN counts as infinity, where std::max(worst, NaN) is worst.
inline double larger(double worst, double error)
{
    return error <= worst ? worst : (error == error ? error : infinity);
}

/// Largest absolute difference of n components; NaN counts as infinity.
inline double max_difference(const double* a, const double* b, int n)
{
    double worst = 0.0;
    for (int i = 0; i < n; i++)
    {
        worst = larger(worst, std::fabs(a[i] - b[i]));
    }
    return worst;
}

/// A 64-bit linear congruential generator (Knuth's MMIX constants): the same numbers with every C++ library.
struct Random
{
    std::uint64_t state;
    double operator()(double low, double high)
    {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return low + (high - low) * static_cast<double>(state >> 11) * 0x1p-53;
    }
};
