/// A running clock, its errors and its drift. Seeds are printed.
/// SPDX-License-Identifier: MIT
#include "emu/ticker.h"
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace
{
constexpr uint64_t kSeed = 20100501;
constexpr emu_clock_t kClocks[] = {{11059200, 12}, {12000000, 12}, {33000000, 12},
                                   {1, 1},         {999999937, 1}, {1000003, 999983}};
constexpr emu_time_t kDay = 86400 * EMU_PS_PER_S;

TEST(ticker, at_its_nominal_rate_is_the_clock)
{
    std::mt19937_64 random(kSeed);
    for (const emu_clock_t& clock : kClocks)
    {
        emu_ticker_t ticker;
        emu_ticker_init(&ticker, &clock);
        uint64_t tick = 0;
        for (unsigned n = 0; n < 20000; n++)
        {
            const emu_time_t at = emu_ticker_time(&ticker, tick);
            ASSERT_EQ(at, emu_clock_time(&clock, tick)) << clock.hz << " Hz, tick " << tick << ", seed " << kSeed;
            // Ahead of the present, near and far, and a few ticks behind it.
            const auto ahead = static_cast<emu_time_t>(random() >> (11 + random() % 50)) % kDay;
            ASSERT_EQ(emu_ticker_tick(&ticker, at + ahead), emu_clock_tick(&clock, at + ahead))
                << clock.hz << ", " << at << " + " << ahead;
            const uint64_t before = tick < 3 ? 0 : tick - 3;
            ASSERT_EQ(emu_ticker_time(&ticker, before), emu_clock_time(&clock, before)) << clock.hz << ", " << before;
            const uint64_t step = random() >> (40 + random() % 24);
            tick = emu_clock_time(&clock, tick + step) < kDay ? tick + step : tick + 1;
        }
    }
}

TEST(ticker, a_rate_that_is_off_is_another_clock)
{
    // 11 MHz + 1000 ppb = 11,000,011 Hz, and so on: whole numbers of hertz.
    const struct
    {
        uint64_t hz;
        int32_t ppb;
        uint64_t real_hz;
    } rows[] = {{11000000, 1000, 11000011},
                {11059200, -100000000, 9953280},
                {1000000000, 37, 1000000037},
                {4000000, 250, 4000001}};
    std::mt19937_64 random(kSeed);
    for (const auto& r : rows)
    {
        const emu_clock_t nominal{r.hz, 12};
        emu_ticker_t ticker;
        emu_ticker_init(&ticker, &nominal);
        emu_ticker_rate(&ticker, 0, r.ppb);
        uint64_t tick = 0;
        for (unsigned n = 0; n < 20000; n++, tick += random() >> (35 + random() % 29))
        {
            // real_hz may lie above what emu_clock_t takes, so the instant is found in whole seconds and the rest of one.
            const uint64_t seconds = tick * 12 / r.real_hz, rest = tick * 12 % r.real_hz;
            const auto at = static_cast<emu_time_t>(seconds * 1000000000000 + rest * 1000000 / r.real_hz * 1000000 +
                                                    rest * 1000000 % r.real_hz * 1000000 / r.real_hz);
            ASSERT_EQ(emu_ticker_time(&ticker, tick), at)
                << r.hz << " Hz, " << r.ppb << " ppb, tick " << tick << ", seed " << kSeed;
            ASSERT_EQ(emu_ticker_tick(&ticker, at), tick)
                << "the instant is rounded down: the tick is the first at or after it";
            ASSERT_EQ(emu_ticker_tick(&ticker, at + 1), tick + 1);
        }
    }
}

TEST(ticker, a_change_of_rate_begins_at_its_tick)
{
    const emu_clock_t clock{12000000, 12};
    emu_ticker_t ticker;
    emu_ticker_init(&ticker, &clock);
    emu_ticker_rate(&ticker, 1000, 1000000); // 0.1 % fast: a cycle lasts 999000.999 ps
    EXPECT_EQ(emu_ticker_time(&ticker, 999), 999 * EMU_PS_PER_US + 999) << "counted back at the new rate";
    EXPECT_EQ(emu_ticker_time(&ticker, 1000), 1000 * EMU_PS_PER_US);
    EXPECT_EQ(emu_ticker_time(&ticker, 1001 + 1000), 1000 * EMU_PS_PER_US + 1001 * 999000 + 1000);
    emu_ticker_rate(&ticker, 3000, 0);
    const emu_time_t at = emu_ticker_time(&ticker, 3000);
    EXPECT_EQ(emu_ticker_time(&ticker, 4000), at + 1000 * EMU_PS_PER_US);
    EXPECT_EQ(emu_ticker_tick(&ticker, EMU_TIME_MAX), UINT64_MAX) << "never";
}

TEST(ticker, another_clock_begins_at_its_tick_as_far_off_as_before)
{
    const emu_clock_t slow{30000000, 2}, fast{150000000, 1};
    emu_ticker_t ticker, as_if;
    emu_ticker_init(&ticker, &slow);
    emu_ticker_rate(&ticker, 0, 50000);
    const emu_time_t at = emu_ticker_time(&ticker, 65536);
    emu_ticker_clock(&ticker, 65536, &fast);
    emu_ticker_init(&as_if, &fast);
    emu_ticker_rate(&as_if, 0, 50000);
    for (const uint64_t ticks : {0ULL, 1ULL, 2ULL, 7808ULL, 150000000ULL})
    {
        EXPECT_NEAR(static_cast<double>(emu_ticker_ahead(&ticker, 65536 + ticks) - at),
                    static_cast<double>(emu_ticker_ahead(&as_if, ticks)), 1.0)
            << ticks;
    }
}

/// Two clocks of one crystal: 10 000 changes do not part them by a picosecond.
TEST(ticker, another_clock_loses_nothing_at_the_change)
{
    const emu_clock_t crystal{30000000, 1}, slow{30000000, 2}, fast{150000000, 1};
    emu_ticker_t ticker;
    emu_ticker_init(&ticker, &slow);
    uint64_t tick = 0, period = 0;
    for (unsigned i = 0; i < 10000; i++)
    {
        tick += 7;
        period += 14;
        emu_ticker_clock(&ticker, tick, &fast);
        tick += 35;
        period += 7;
        ASSERT_EQ(emu_ticker_ahead(&ticker, tick), emu_clock_time(&crystal, period)) << i;
        emu_ticker_clock(&ticker, tick, &slow);
    }
}

TEST(ticker, looking_far_ahead_does_not_move_the_present)
{
    const emu_clock_t clock{29999999, 1};
    emu_ticker_t ticker;
    emu_ticker_init(&ticker, &clock);
    emu_ticker_rate(&ticker, 0, 12347);
    const emu_time_t second = emu_ticker_ahead(&ticker, 30000369);
    EXPECT_NEAR(static_cast<double>(emu_ticker_ahead(&ticker, 30000369000)), 1e3 * static_cast<double>(second), 1e3);
    EXPECT_EQ(emu_ticker_ahead(&ticker, 30000369), second);
    EXPECT_EQ(emu_ticker_time(&ticker, 30000369), second);
}

TEST(ticker, comes_back_from_a_snapshot)
{
    const emu_clock_t clock{11059200, 12};
    emu_ticker_t a, b;
    emu_ticker_init(&a, &clock);
    emu_ticker_init(&b, &clock);
    emu_ticker_rate(&a, 777, -12345);
    (void)emu_ticker_time(&a, 123456789);
    std::vector<uint8_t> octets(256);
    emu_state_t out{octets.data(), nullptr, octets.size(), 0, false};
    emu_ticker_state(&a, &out);
    emu_state_t in{nullptr, octets.data(), out.at, 0, false};
    emu_ticker_state(&b, &in);
    ASSERT_FALSE(in.bad);
    for (uint64_t tick = 123456789; tick < 223456789; tick += 9999991)
    {
        ASSERT_EQ(emu_ticker_time(&a, tick), emu_ticker_time(&b, tick));
    }
    octets[3] ^= 0x40; // the rate
    emu_state_t bad{nullptr, octets.data(), out.at, 0, false};
    emu_ticker_state(&b, &bad);
    EXPECT_TRUE(bad.bad);
}
} // namespace
