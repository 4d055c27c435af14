/// \file   test_board_load.cpp
/// \brief  The two loads of tests/data/bench in full: results, cycles, instructions, and the octets on the TXD pin.
/// SPDX-License-Identifier: MIT
#include "bare_cpu.hpp"
#include <random>

namespace
{

constexpr uint64_t OCTETS = 16000, CYCLES_PER_OCTET = 960, BIT = 96, FOREVER = 100'000'000;

/// 8N1 from the edges of TXD, each bit at its centre. \return octets; frames with a bad stop bit are counted.
struct decoder
{
    std::vector<uint8_t> octets;
    uint64_t bad = 0;

    explicit decoder(const std::vector<bare_cpu::edge>& edges)
    {
        std::vector<std::pair<uint64_t, bool>> txd = {{0, true}};
        for (const auto& e : edges)
        {
            if (e.port == 3 && (e.changed & 2))
            {
                txd.emplace_back(e.cycle, (e.out & 2) != 0);
            }
        }
        size_t at = 0;
        const auto level = [&](uint64_t cycle)
        {
            while (at + 1 < txd.size() && txd[at + 1].first <= cycle)
            {
                ++at;
            }
            return txd[at].second;
        };
        while (true)
        {
            while (at < txd.size() && txd[at].second)
            {
                ++at;
            }
            if (at == txd.size())
            {
                break;
            }
            const uint64_t start = txd[at].first;
            unsigned octet = 0;
            for (unsigned i = 0; i < 8; ++i)
            {
                octet |= static_cast<unsigned>(level(start + BIT * (i + 1) + BIT / 2)) << i;
            }
            bad += !level(start + BIT * 9 + BIT / 2);
            octets.push_back(static_cast<uint8_t>(octet));
        }
    }
};

TEST(load, bench_cpu_result_cycles_and_instructions)
{
    bare_cpu b;
    b.load_file(std::string(MCS51_IMAGES) + "/bench_cpu.bin");
    EXPECT_EQ(b.run(FOREVER), MCS51_HALTED);
    EXPECT_EQ(b.get(sfr::P0) << 8 | b.get(sfr::P2), 0x0CFA);
    EXPECT_EQ(b.now(), 38'602'854u);
    EXPECT_EQ(mcs51_instructions(b.cpu), 27'924'960u);
}

TEST(load, bench_board_sends_every_octet_on_the_pin)
{
    bare_cpu b;
    b.load_file(std::string(MCS51_IMAGES) + "/bench_board.bin");
    EXPECT_EQ(b.run(FOREVER), MCS51_HALTED);
    EXPECT_GE(b.now(), OCTETS * CYCLES_PER_OCTET);
    b.run(b.now() + 2 * CYCLES_PER_OCTET);
    const decoder d(b.edges);
    EXPECT_EQ(d.bad, 0u);
    ASSERT_EQ(d.octets.size(), OCTETS);
    // With P1.3 high the firmware reads FFFh three times a turn: AA, six octets, their exclusive or of the low ones.
    for (size_t i = 0; i < OCTETS; ++i)
    {
        const uint8_t turn[8] = {0xAA, 0x0F, 0xFF, 0x0F, 0xFF, 0x0F, 0xFF, 0xFF};
        ASSERT_EQ(d.octets[i], turn[i % 8]) << i;
    }
    EXPECT_NEAR(static_cast<double>(mcs51_interrupts(b.cpu)), static_cast<double>(b.now()) / 940, 200);
}

TEST(load, slices_of_any_length_give_the_same_run)
{
    constexpr uint64_t CYCLES = 400'000;
    bare_cpu whole, sliced;
    std::mt19937 rng(51);
    for (bare_cpu* b : {&whole, &sliced})
    {
        b->load_file(std::string(MCS51_IMAGES) + "/bench_board.bin");
    }
    whole.run(CYCLES);
    while (sliced.now() < CYCLES)
    {
        sliced.run(std::min<uint64_t>(CYCLES, sliced.now() + 1 + (rng() % 4 ? rng() % 5 : rng() % 500)));
    }
    EXPECT_EQ(whole.now(), sliced.now());
    EXPECT_EQ(mcs51_instructions(whole.cpu), mcs51_instructions(sliced.cpu));
    EXPECT_EQ(mcs51_interrupts(whole.cpu), mcs51_interrupts(sliced.cpu));
    ASSERT_EQ(whole.edges.size(), sliced.edges.size());
    for (size_t i = 0; i < whole.edges.size(); ++i)
    {
        ASSERT_EQ(whole.edges[i].cycle, sliced.edges[i].cycle) << i;
        ASSERT_EQ(whole.edges[i].out, sliced.edges[i].out) << i;
    }
    for (unsigned a = 0; a < 0x80; ++a)
    {
        EXPECT_EQ(whole.ram(static_cast<uint8_t>(a)), sliced.ram(static_cast<uint8_t>(a))) << a;
        EXPECT_EQ(whole.get(static_cast<uint8_t>(a + 0x80)), sliced.get(static_cast<uint8_t>(a + 0x80))) << a;
    }
}

} // namespace
