/// Clock domains stay exact for as long as simulated time lasts.
/// SPDX-License-Identifier: MIT
#include "emu/time.h"
#include <gtest/gtest.h>
#include <random>

namespace
{
constexpr int kRandomTicks = 20000;
constexpr emu_clock_t kMachineCycle{11059200, 12};
constexpr emu_clock_t kDsp{150000000, 1};
constexpr emu_clock_t kOdd{999999937, 7}; // a prime

/// floor(k * divider * 1e12 / hz), in 128 bits.
emu_time_t exact(const emu_clock_t& c, uint64_t k)
{
    __extension__ using wide = unsigned __int128;
    return static_cast<emu_time_t>(wide{k} * c.divider * 1000000000000u / c.hz);
}

TEST(emu_clock, matches_128_bit_arithmetic_over_106_days)
{
    std::mt19937_64 rng(2543);
    for (const emu_clock_t& c : {kMachineCycle, kDsp, kOdd, emu_clock_t{1, 1}, emu_clock_t{1000000000, 1000000}})
    {
        const uint64_t last = emu_clock_tick(&c, EMU_TIME_MAX - EMU_PS_PER_S) - 1;
        for (int i = 0; i < kRandomTicks; i++)
        {
            const uint64_t k = rng() % last;
            const emu_time_t t = emu_clock_time(&c, k);
            ASSERT_EQ(t, exact(c, k)) << "tick " << k << " of " << c.hz << "/" << c.divider << " Hz";
            ASSERT_EQ(emu_clock_tick(&c, t), k);
            ASSERT_LE(emu_clock_tick(&c, t + 1), k + 1);
            ASSERT_GT(emu_clock_tick(&c, t + 1), k);
        }
    }
}

TEST(emu_clock, whole_days_hold_whole_ticks)
{
    constexpr uint64_t kSeconds = 100 * 86400;
    constexpr emu_time_t kInstant = emu_time_t{kSeconds} * EMU_PS_PER_S;
    EXPECT_EQ(emu_clock_time(&kMachineCycle, 921600 * kSeconds), kInstant);
    EXPECT_EQ(emu_clock_time(&kDsp, 150000000 * kSeconds), kInstant);
}

TEST(emu_clock, beyond_the_end_is_never)
{
    EXPECT_EQ(emu_clock_time(&kMachineCycle, UINT64_MAX), EMU_TIME_MAX);
    EXPECT_EQ(emu_clock_time(&kDsp, UINT64_MAX), EMU_TIME_MAX);
}
} // namespace
