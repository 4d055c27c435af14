/// Clock domains whose rate changes while they run: instants against integer arithmetic of the test's own.
/// SPDX-License-Identifier: MIT
extern "C" {
#include "periph/clock.h"
}
#include <gtest/gtest.h>

namespace
{
constexpr emu_clock_t OSC2{30000000, 2}, MHZ150{150000000, 1};

/// n / hz seconds, rounded down.
emu_time_t exact(uint64_t n, uint64_t hz)
{
    const emu_clock_t clock{hz, 1};
    return emu_clock_time(&clock, n);
}

struct domain
{
    emu_ticker_t sysclk;
    f2812_clock_t clock;
    domain(const emu_clock_t& rate, uint64_t divider)
    {
        emu_ticker_init(&sysclk, &rate);
        f2812_clock_init(&clock, &sysclk, divider);
    }
};

TEST(clock, a_tick_lies_on_its_cycle_to_the_picosecond)
{
    const domain lspclk(MHZ150, 4);
    for (const uint64_t tick : {0ULL, 1ULL, 2ULL, 3ULL, 1952ULL, 37500000ULL, 999999999999ULL})
    {
        EXPECT_EQ(f2812_clock_time(&lspclk.clock, tick), exact(4 * tick, 150000000)) << tick;
        EXPECT_EQ(f2812_clock_tick(&lspclk.clock, exact(4 * tick, 150000000)), tick) << tick;
        EXPECT_EQ(f2812_clock_tick(&lspclk.clock, exact(4 * tick, 150000000) + 1), tick + 1) << tick;
    }
    EXPECT_EQ(f2812_clock_time(&lspclk.clock, UINT64_MAX), EMU_TIME_MAX);
    EXPECT_EQ(f2812_clock_tick(&lspclk.clock, EMU_TIME_MAX), UINT64_MAX);
}

TEST(clock, a_change_of_sysclkout_moves_every_later_tick)
{
    domain lspclk(OSC2, 4);
    emu_ticker_clock(&lspclk.sysclk, 4000, &MHZ150);
    EXPECT_EQ(f2812_clock_time(&lspclk.clock, 1000), exact(4000, 15000000));
    for (const uint64_t tick : {1001ULL, 1002ULL, 5000ULL, 37501000ULL})
    {
        EXPECT_EQ(f2812_clock_time(&lspclk.clock, tick), exact(40000 + 4 * (tick - 1000), 150000000)) << tick;
    }
}

/// The period that is under way goes on in cycles of the new rate.
TEST(clock, a_change_amid_a_tick_keeps_the_cycles_that_are_left)
{
    domain lspclk(OSC2, 4);
    emu_ticker_clock(&lspclk.sysclk, 4001, &MHZ150);
    EXPECT_EQ(f2812_clock_time(&lspclk.clock, 1001), exact(40013, 150000000));
}

TEST(clock, ticks_are_numbered_on_over_another_divider)
{
    domain lspclk(MHZ150, 4);
    f2812_clock_divide(&lspclk.clock, 402, 10);
    EXPECT_EQ(f2812_clock_time(&lspclk.clock, 101), exact(402, 150000000)) << "tick 100 was at 400; 101 begins here";
    EXPECT_EQ(f2812_clock_time(&lspclk.clock, 103), exact(422, 150000000));
    EXPECT_EQ(f2812_clock_tick_of_cycle(&lspclk.clock, 402), 101u);
    EXPECT_EQ(f2812_clock_tick_of_cycle(&lspclk.clock, 403), 102u);
    EXPECT_EQ(f2812_clock_tick_of_cycle(&lspclk.clock, 412), 102u);
    f2812_clock_divide(&lspclk.clock, 412, 1);
    EXPECT_EQ(f2812_clock_time(&lspclk.clock, 105), exact(415, 150000000)) << "tick 102 was at 412 and stays";
}

/// Asking far ahead leaves the present as it is, also with a rate whose remainders do not fit 64 bits for long.
TEST(clock, far_ahead_and_near_are_told_in_any_order)
{
    const emu_clock_t odd{29999999, 2};
    domain lspclk(odd, 4);
    emu_ticker_rate(&lspclk.sysclk, 0, 12347);
    const emu_time_t near = f2812_clock_time(&lspclk.clock, 3);
    const double far = 3e12 * 4 * 2 / 29999999 / (1 + 12.347e-6) * 1e12;
    EXPECT_NEAR(static_cast<double>(f2812_clock_time(&lspclk.clock, 3000000000000)), far, 1e3);
    EXPECT_EQ(f2812_clock_time(&lspclk.clock, 3), near);
    const emu_time_t second = f2812_clock_time(&lspclk.clock, 29999999 / 8);
    EXPECT_EQ(f2812_clock_tick(&lspclk.clock, second), 29999999u / 8);
}
} // namespace
