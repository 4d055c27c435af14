/// \file   undetected.h
/// \brief  How many wrong bits the sum and the CRC of a frame let through, in theory: what test and figure share. Unit: 1.
/// SPDX-License-Identifier: MIT
#ifndef INS_TESTS_UNDETECTED_H
#define INS_TESTS_UNDETECTED_H
#include <array>
#include <cmath>
#include <vector>

namespace undetected
{
constexpr unsigned LEN = 6;
constexpr unsigned FLIPS_MAX = 8; ///< more wrong bits add below 1e-5 of the rate at 1e-3
constexpr unsigned POLYNOMIAL = 0x90D9;

/// Syndrome of a wrong bit i of a frame of `bits`, i from the first one sent.
inline std::vector<unsigned> syndromes(unsigned bits)
{
    std::vector<unsigned> s(bits);
    unsigned r = 1;
    for (unsigned i = bits; i-- > 0;)
    {
        s[i] = r;
        r = ((r << 1) ^ ((r & 0x8000) ? POLYNOMIAL : 0)) & 0xFFFF;
    }
    return s;
}

inline double binomial(unsigned n, unsigned k)
{
    double b = 1;
    for (unsigned i = 0; i < k; i++)
    {
        b = b * (n - i) / (i + 1);
    }
    return b;
}

/// Chance that k wrong bits in a frame of `bits` escape the CRC: the code's weights from its dual's (MacWilliams).
inline std::vector<double> crc_escapes(unsigned bits)
{
    const auto s = syndromes(bits);
    std::vector<double> dual(bits + 1, 0);
    for (unsigned mask = 0; mask < 65536; mask++)
    {
        unsigned weight = 0;
        for (const unsigned x : s)
        {
            weight += static_cast<unsigned>(__builtin_parity(x & mask));
        }
        dual[weight]++;
    }
    std::vector<double> escapes;
    for (unsigned k = 0; k <= FLIPS_MAX; k++)
    {
        double count = 0;
        for (unsigned w = 0; w <= bits; w++)
        {
            double krawtchouk = 0;
            for (unsigned j = 0; j <= k && dual[w] > 0; j++)
            {
                krawtchouk += (j % 2 ? -1 : 1) * binomial(w, j) * binomial(bits - w, k - j);
            }
            count += dual[w] * krawtchouk / 65536;
        }
        escapes.push_back(std::round(count) / binomial(bits, k));
    }
    return escapes;
}

/// The same for the sum: a wrong bit j of an octet adds 2^j or takes it away, by the bit that was sent; octets are uniform but
/// for the high ones of a code, whose upper four bits are 0.
inline std::vector<double> sum_escapes()
{
    using Table = std::vector<std::array<double, 256>>; // [wrong bits][change of the sum]
    Table all(FLIPS_MAX + 1, std::array<double, 256>{});
    all[0][0] = 1;
    for (unsigned octet = 0; octet <= LEN; octet++)
    {
        for (unsigned bit = 0; bit < 8; bit++)
        {
            const bool always_zero = octet < LEN && octet % 2 == 0 && bit >= 4;
            Table next = all;
            for (unsigned k = 0; k < FLIPS_MAX; k++)
            {
                for (unsigned d = 0; d < 256; d++)
                {
                    next[k + 1][(d + (1u << bit)) & 255] += all[k][d] * (always_zero ? 1 : 0.5);
                    next[k + 1][(d - (1u << bit)) & 255] += all[k][d] * (always_zero ? 0 : 0.5);
                }
            }
            all = next;
        }
    }
    std::vector<double> escapes;
    for (unsigned k = 0; k <= FLIPS_MAX; k++)
    {
        escapes.push_back(all[k][0] / binomial(8 * (LEN + 1), k));
    }
    return escapes;
}

} // namespace undetected

#endif // INS_TESTS_UNDETECTED_H
