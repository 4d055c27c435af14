/// splitmix64, and normal values from it.
/// SPDX-License-Identifier: MIT
#include "emu/random.h"
#include <stdbool.h>

uint64_t emu_random(uint64_t* state)
{
    *state += UINT64_C(0x9E3779B97F4A7C15);
    uint64_t z = *state;
    z = (z ^ z >> 30) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ z >> 27) * UINT64_C(0x94D049BB133111EB);
    return z ^ z >> 31;
}

/// [0, 1)
static double unit(uint64_t* state)
{
    return (double)(emu_random(state) >> 11) * 0x1p-53;
}

/// True with probability exp(-x c), 0 <= x, c <= 1: x > u1 > u2 > ... goes on with probability c each time; von Neumann 1951.
static bool chance(uint64_t* state, double x, double c)
{
    bool even = true;
    double least = x;
    for (;;)
    {
        const double u = unit(state);
        if (!(u < least) || !(unit(state) < c))
        {
            return even;
        }
        least = u;
        even = !even;
    }
}

/// True with probability exp(-times / 2).
static bool half_chances(uint64_t* state, unsigned times)
{
    while (times > 0 && chance(state, 0.5, 1.0))
    {
        times--;
    }
    return times == 0;
}

double emu_random_normal(uint64_t* state)
{
    for (;;) // |value| = k + x, of density exp(-k^2 / 2) exp(-x (2 k + x) / 2)
    {
        unsigned k = 0;
        while (chance(state, 0.5, 1.0))
        {
            k++;
        }
        if (k > 1 && !half_chances(state, k * (k - 1)))
        {
            continue;
        }
        const double x = unit(state);
        unsigned left = k + 1;
        while (left > 0 && chance(state, x, (2.0 * k + x) / (2.0 * k + 2.0)))
        {
            left--;
        }
        if (left == 0)
        {
            return (emu_random(state) >> 63) != 0 ? -(k + x) : k + x;
        }
    }
}
