/// \file   test_uart.cpp
/// \brief  The serial port on its pins: bit edges of TXD by cycle, and RXD driven at a baud of the test's own.
/// SPDX-License-Identifier: MIT
#include "bare_cpu.hpp"

namespace
{

constexpr uint8_t RXD = 0x01, TXD = 0x02;
constexpr uint64_t BIT = 96; // 9600 Bd at 11.0592 MHz: T1 = FDh, SMOD = 0

/// Port set up for 9600 Bd, the CPU in a loop.
void set_up(bare_cpu& b, int scon, int pcon = 0, int th1 = 0xFD)
{
    b.load(0x100, {0x80, 0xFE});
    mcs51_set_pc(b.cpu, 0x100);
    b.set(sfr::IE, 0x80);
    b.set(sfr::TMOD, 0x20);
    b.set(sfr::TH1, th1);
    b.set(sfr::TL1, th1);
    b.set(sfr::PCON, pcon);
    b.set(sfr::SCON, scon);
    b.set(sfr::TCON, 0x40);
}

std::vector<std::pair<uint64_t, int>> txd_edges(const bare_cpu& b)
{
    std::vector<std::pair<uint64_t, int>> result;
    for (const auto& e : b.edges)
    {
        if (e.port == 3 && (e.changed & TXD))
        {
            result.emplace_back(e.cycle, (e.out & TXD) != 0);
        }
    }
    return result;
}

/// Level of TXD at a cycle.
int txd_at(const bare_cpu& b, uint64_t cycle)
{
    int level = 1;
    for (const auto& [at, value] : txd_edges(b))
    {
        level = at <= cycle ? value : level;
    }
    return level;
}

uint64_t cycle_of_flag(bare_cpu& b, uint8_t flag, uint64_t limit)
{
    while (b.now() < limit && !(b.get(sfr::SCON) & flag))
    {
        b.run(b.now() + 1);
    }
    return b.now();
}

TEST(uart_tx, mode_1_starts_at_a_rollover_and_sets_ti_as_the_stop_bit_begins)
{
    for (uint64_t phase = 0; phase < 2 * BIT; phase += 7)
    {
        bare_cpu b;
        set_up(b, 0x40);
        b.run(1000 + phase);
        const uint64_t written = b.now();
        b.set(sfr::SBUF, 0x55); // every bit has an edge
        const uint64_t ti = cycle_of_flag(b, 0x02, written + 2000);
        EXPECT_GT(ti - written, 9 * BIT);
        EXPECT_LE(ti - written, 10 * BIT + 2); // seen at the end of a 2-cycle instruction
        const auto edges = txd_edges(b);
        ASSERT_EQ(edges.size(), 10u);
        EXPECT_EQ(edges[0].first % BIT, 0u); // the divider runs free from T1's first overflow
        EXPECT_GT(edges[0].first, written);
        EXPECT_LE(edges[0].first, written + BIT);
        for (size_t i = 0; i < edges.size(); ++i)
        {
            EXPECT_EQ(edges[i].first, edges[0].first + i * BIT);
            EXPECT_EQ(edges[i].second, static_cast<int>(i & 1));
        }
        EXPECT_LE(ti - edges[9].first, 2u);
    }
}

TEST(uart_tx, an_octet_written_at_ti_follows_after_one_stop_bit)
{
    bare_cpu b;
    set_up(b, 0x40);
    b.run(1000);
    b.set(sfr::SBUF, 0xFF);
    cycle_of_flag(b, 0x02, 3000);
    b.set(sfr::SBUF, 0xFF);
    b.run(5000);
    const auto edges = txd_edges(b);
    ASSERT_EQ(edges.size(), 4u);
    EXPECT_EQ(edges[2].first - edges[0].first, 10 * BIT);
    EXPECT_TRUE(b.reports.empty());
    b.set(sfr::SBUF, 0x00);
    b.set(sfr::SBUF, 0x00);
    EXPECT_EQ(b.reports.size(), 1u);
}

TEST(uart_tx, an_edge_after_until_waits_for_the_next_run)
{
    bare_cpu b;
    set_up(b, 0x40);
    b.run(1000);
    b.set(sfr::SBUF, 0x55);
    unsigned passed = 0;
    for (uint64_t until = 1001; until < 3000; ++until)
    {
        b.run(until);
        ASSERT_LE(b.edges.empty() ? 0 : b.edges.back().cycle, until);
        passed += b.now() > until;
    }
    EXPECT_EQ(txd_edges(b).size(), 10u);
    EXPECT_GT(passed, 900u);
}

TEST(uart_tx, mode_3_sends_nine_bits_and_smod_doubles)
{
    for (const int tb8 : {0, 1})
    {
        bare_cpu b;
        set_up(b, 0xC0 | tb8 << 3, 0x80);
        b.run(1000);
        b.set(sfr::SBUF, 0x81);
        b.run(3000);
        const uint64_t start = txd_edges(b).at(0).first, bit = BIT / 2;
        const std::vector<int> want = {0, 1, 0, 0, 0, 0, 0, 0, 1, tb8, 1};
        for (size_t i = 0; i < want.size(); ++i)
        {
            EXPECT_EQ(txd_at(b, start + i * bit + bit / 2), want[i]) << i;
        }
    }
}

TEST(uart_tx, mode_2_bits_are_32_or_64_oscillator_periods)
{
    for (const int pcon : {0x00, 0x80})
    {
        bare_cpu b;
        set_up(b, 0x80, pcon);
        b.set(sfr::TCON, 0); // needs no timer
        b.run(1001);
        b.set(sfr::SBUF, 0x55);
        b.run(2000);
        const auto edges = txd_edges(b);
        ASSERT_EQ(edges.size(), 10u); // start, 1 0 1 0 1 0 1 0, TB8 = 0, stop
        const uint64_t osc = pcon ? 32 : 64;
        // Each edge is in the machine cycle after its own oscillator period.
        const uint64_t first = (edges[0].first * 12 / osc) * osc;
        for (size_t i = 0; i < 9; ++i)
        {
            EXPECT_EQ(edges[i].first, (first + i * osc + 11) / 12) << i;
        }
        EXPECT_EQ(edges[9].first, (first + 10 * osc + 11) / 12);
    }
}

TEST(uart_mode_0, shifts_out_and_in_a_bit_a_cycle)
{
    bare_cpu b;
    set_up(b, 0x00);
    b.run(101);
    const uint64_t written = b.now();
    b.set(sfr::SBUF, 0xA6);
    const uint64_t ti = cycle_of_flag(b, 0x02, 200);
    EXPECT_GE(ti, written + 9);
    EXPECT_LE(ti, written + 10);
    int octet = 0, bits = 0;
    for (const auto& e : b.edges)
    {
        if ((e.changed & TXD) && (e.out & TXD)) // rising shift clock
        {
            EXPECT_EQ(e.cycle, written + 1 + static_cast<uint64_t>(bits));
            octet |= (e.out & RXD) << bits++;
        }
    }
    EXPECT_EQ(bits, 8);
    EXPECT_EQ(octet, 0xA6);

    // A shift register on the pins: the next bit after each rising clock.
    struct shifter
    {
        mcs51_t* cpu = nullptr;
        unsigned octet = 0x5C;
    } s;
    mcs51_config_t config{};
    config.clock = {11059200, 12};
    config.ctx = &s;
    config.port = [](void* ctx, unsigned port, uint8_t out, uint8_t changed, uint64_t cycle)
    {
        auto* self = static_cast<shifter*>(ctx);
        if (port == 3 && (changed & out & TXD))
        {
            self->octet >>= 1;
            mcs51_set_pins(self->cpu, 3, static_cast<uint8_t>(0xFE | (self->octet & 1)), cycle);
        }
    };
    s.cpu = mcs51_create(&config);
    mcs51_set_pins(s.cpu, 3, 0xFE, 0);
    const uint8_t code[] = {0x75, sfr::SCON, 0x10, 0x30, 0x98, 0xFD, 0xE5, sfr::SBUF, 0x80, 0xFE};
    ASSERT_EQ(mcs51_load(s.cpu, 0, code, sizeof code), 0);
    EXPECT_EQ(mcs51_run(s.cpu, 100), MCS51_HALTED);
    EXPECT_EQ(mcs51_sfr(s.cpu, sfr::ACC), 0x5C);
    EXPECT_EQ(mcs51_cycle(s.cpu), 2u + 10u + 1u); // RI 9 cycles after the write, seen by a 2-cycle poll
    mcs51_destroy(s.cpu);
}

/// Drive a frame of levels on RXD from cycle `from`, each `bit` cycles long; the line idles high after it.
void drive(bare_cpu& b, uint64_t from, const std::vector<int>& levels, double bit)
{
    for (size_t i = 0; i <= levels.size(); ++i)
    {
        const auto at = from + static_cast<uint64_t>(bit * static_cast<double>(i) + 0.5);
        b.run(at);
        mcs51_set_pins(b.cpu, 3, i < levels.size() && !levels[i] ? 0xFF & ~RXD : 0xFF, at);
    }
}

std::vector<int> frame(int octet, std::initializer_list<int> tail = {1})
{
    std::vector<int> levels = {0};
    for (int i = 0; i < 8; ++i)
    {
        levels.push_back(octet >> i & 1);
    }
    levels.insert(levels.end(), tail);
    return levels;
}

TEST(uart_rx, mode_1_takes_every_octet_and_sets_ri_in_the_stop_bit)
{
    bare_cpu b;
    set_up(b, 0x50);
    for (int octet = 0; octet < 256; ++octet)
    {
        const uint64_t start = 1000 + static_cast<uint64_t>(octet) * 1111;
        std::vector<int> levels = frame(octet);
        levels.pop_back();
        drive(b, start, levels, static_cast<double>(BIT)); // the stop bit is the idle line
        EXPECT_EQ(b.get(sfr::SCON) & 0x01, 0);
        const uint64_t ri = cycle_of_flag(b, 0x01, start + 2000);
        EXPECT_GE(ri, start + 9 * BIT + 9 * BIT / 16);
        EXPECT_LE(ri, start + 9 * BIT + 10 * BIT / 16 + 4);
        EXPECT_EQ(b.get(sfr::SBUF), octet);
        EXPECT_EQ(b.get(sfr::SCON) & 0x04, 0x04); // RB8 = stop bit
        b.set(sfr::SCON, 0x50);
    }
    EXPECT_TRUE(b.reports.empty());
}

TEST(uart_rx, tolerates_a_baud_2_percent_off_and_not_7)
{
    for (const double error : {-0.02, 0.02})
    {
        bare_cpu b;
        set_up(b, 0x50);
        drive(b, 1000, frame(0x95), static_cast<double>(BIT) * (1 + error));
        b.run(3000);
        EXPECT_EQ(b.get(sfr::SCON) & 0x05, 0x05) << error;
        EXPECT_EQ(b.get(sfr::SBUF), 0x95) << error;
    }
    bare_cpu slow;
    set_up(slow, 0x50);
    drive(slow, 1000, frame(0x15), static_cast<double>(BIT) * 1.07); // D7 = 0 lies where the stop bit is sampled
    slow.run(3000);
    EXPECT_EQ(slow.get(sfr::SCON) & 0x05, 0x01); // a framing error: RB8 = 0
    bare_cpu fast;
    set_up(fast, 0x50);
    drive(fast, 1000, frame(0x55), static_cast<double>(BIT) * 0.93);
    fast.run(3000);
    EXPECT_NE(fast.get(sfr::SBUF), 0x55);
}

TEST(uart_rx, bad_stop_bit_clears_rb8_and_with_sm2_is_dropped)
{
    bare_cpu b;
    set_up(b, 0x50);
    drive(b, 1000, frame(0x3C, {0}), static_cast<double>(BIT));
    b.run(3000);
    EXPECT_EQ(b.get(sfr::SCON) & 0x05, 0x01);
    bare_cpu sm2;
    set_up(sm2, 0x70);
    drive(sm2, 1000, frame(0x3C, {0}), static_cast<double>(BIT));
    sm2.run(3000);
    EXPECT_EQ(sm2.get(sfr::SCON) & 0x01, 0);
    drive(sm2, 3000, frame(0x3C), static_cast<double>(BIT));
    sm2.run(5000);
    EXPECT_EQ(sm2.get(sfr::SCON) & 0x01, 1);
}

TEST(uart_rx, mode_3_with_sm2_takes_only_addresses)
{
    bare_cpu b;
    set_up(b, 0xF0);
    drive(b, 1000, frame(0x11, {0, 1}), static_cast<double>(BIT));
    b.run(3000);
    EXPECT_EQ(b.get(sfr::SCON) & 0x01, 0);
    drive(b, 3000, frame(0x22, {1, 1}), static_cast<double>(BIT));
    b.run(5000);
    EXPECT_EQ(b.get(sfr::SCON) & 0x05, 0x05);
    EXPECT_EQ(b.get(sfr::SBUF), 0x22);
}

TEST(uart_rx, overrun_loses_the_second_octet_and_is_reported)
{
    bare_cpu b;
    set_up(b, 0x50);
    drive(b, 1000, frame(0x11), static_cast<double>(BIT));
    drive(b, 2000, frame(0x22), static_cast<double>(BIT));
    b.run(4000);
    EXPECT_EQ(b.get(sfr::SBUF), 0x11);
    ASSERT_EQ(b.reports.size(), 1u);
    EXPECT_EQ(b.reports[0].detail, 0x22u);
}

TEST(uart_rx, a_glitch_is_no_start_bit_and_the_majority_of_three_wins)
{
    bare_cpu b;
    set_up(b, 0x50);
    b.run(1000);
    mcs51_set_pins(b.cpu, 3, 0xFE, 1000);
    b.run(1000 + BIT / 4);
    mcs51_set_pins(b.cpu, 3, 0xFF, 1000 + BIT / 4);
    b.run(1000 + BIT / 2 + 10);
    drive(b, 1200, frame(0x5A), static_cast<double>(BIT));
    b.run(3000);
    EXPECT_EQ(b.get(sfr::SCON) & 0x05, 0x05);
    EXPECT_EQ(b.get(sfr::SBUF), 0x5A);

    // One sample of each bit is inverted: a pulse of 5 cycles (a tick is 6) wherever it falls about the centre.
    const auto levels = frame(0x5A);
    for (uint64_t offset = 36; offset < 64; ++offset)
    {
        bare_cpu noisy;
        set_up(noisy, 0x50);
        for (size_t i = 0; i <= levels.size(); ++i)
        {
            const uint64_t at = 3000 + i * BIT;
            const int level = i < levels.size() ? levels[i] : 1;
            for (const auto& [cycle, value] :
                 {std::pair<uint64_t, int>{at, level}, {at + offset, !level}, {at + offset + 5, level}})
            {
                noisy.run(cycle);
                mcs51_set_pins(noisy.cpu, 3, value ? 0xFF : 0xFE, cycle);
            }
        }
        noisy.run(6000);
        EXPECT_EQ(noisy.get(sfr::SBUF), 0x5A) << offset;
    }
}

TEST(uart_rx, needs_ren)
{
    bare_cpu b;
    set_up(b, 0x40);
    drive(b, 1000, frame(0x5A), static_cast<double>(BIT));
    b.run(3000);
    EXPECT_EQ(b.get(sfr::SCON) & 0x01, 0);
}

TEST(uart, loops_back_at_odd_bauds_and_through_the_counter_pin_of_timer_1)
{
    for (const int th1 : {0xFF, 0xFA, 0x40})
    {
        bare_cpu b;
        set_up(b, 0x50, 0, th1);
        b.run(500);
        b.set(sfr::SBUF, 0xC5);
        size_t seen = b.edges.size();
        const uint64_t limit = 500 + 12u * 32u * static_cast<uint64_t>(256 - th1);
        while (b.now() < limit)
        {
            b.run(b.now() + 1);
            for (; seen < b.edges.size(); ++seen)
            {
                mcs51_set_pins(b.cpu, 3, b.edges[seen].out & TXD ? 0xFF : 0xFE, b.now());
            }
        }
        EXPECT_EQ(b.get(sfr::SBUF), 0xC5) << th1;
        EXPECT_EQ(b.get(sfr::SCON) & 0x07, 0x07) << th1;
    }
    bare_cpu b; // T1 counts falls on P3.5, one in 10 cycles
    set_up(b, 0x40, 0x80, 0xFF);
    b.set(sfr::TMOD, 0x60);
    b.set(sfr::SBUF, 0x00);
    for (uint64_t at = 10; at < 5000; at += 10)
    {
        b.run(at);
        mcs51_set_pins(b.cpu, 3, at / 5 % 4 ? 0xFF : 0xDF, at);
    }
    const auto edges = txd_edges(b);
    ASSERT_EQ(edges.size(), 2u);
    EXPECT_EQ(edges[1].first - edges[0].first, 9u * 16u * 20u); // start and eight zeros, 16 falls of 20 cycles each
}

} // namespace
