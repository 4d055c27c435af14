/// \file   test_state.cpp
/// \brief  Snapshot, restore into another part, run on: the same state and the same callbacks; what is refused.
/// SPDX-License-Identifier: MIT
#include "bare_cpu.hpp"
#include <cstdlib>
#include <memory>
#include <random>

namespace
{

const int INSTANTS = std::getenv("INS_BENCH") ? 1000 : 60;
const int TURNS = std::getenv("INS_BENCH") ? 20000 : 2000;
const int CORRUPTED = std::getenv("INS_BENCH") ? 20000 : 500;
constexpr uint64_t BEGIN = 60000,
                   ON = 30000; ///< cycles: the loads' instants lie in the first, then as many are compared

mcs51_config_t configuration()
{
    mcs51_config_t config{};
    config.part = MCS51_AT89S52;
    config.xdata_octets = 512;
    return config;
}

/// busy.c with TXD looped back to RXD, and INT0, T2EX and the other inputs moved by a fixed function of time.
struct busy : bare_cpu
{
    static constexpr uint64_t SLOT = 13, SLOTS_A_MOVE = 20; ///< cycles; the serial line is looped back in each slot

    busy() : bare_cpu(configuration()) { load_file(std::string(MCS51_IMAGES) + "/busy.bin"); }
    void advance(uint64_t until)
    {
        while (now() < until)
        {
            const uint64_t slot = now() / SLOT, end = std::min(until, (slot + 1) * SLOT);
            run(end);
            if (end == (slot + 1) * SLOT)
            {
                const auto inputs = static_cast<uint8_t>((slot / SLOTS_A_MOVE * UINT64_C(0x9E3779B97F4A7C15)) >> 56);
                const auto rxd = static_cast<uint8_t>(mcs51_port_out(cpu, 3) >> 1 & 1);
                mcs51_set_pins(cpu, 3, static_cast<uint8_t>((inputs & 0xFC) | 2 | rxd), end);
                mcs51_set_pins(cpu, 1, inputs, end);
            }
        }
    }
    std::vector<uint8_t> save()
    {
        emu_state_t count{};
        mcs51_state(cpu, &count);
        std::vector<uint8_t> octets(count.at);
        emu_state_t io{};
        io.to = octets.data();
        io.size = octets.size();
        mcs51_state(cpu, &io);
        EXPECT_FALSE(io.bad);
        return octets;
    }
    bool restore(const std::vector<uint8_t>& octets)
    {
        emu_state_t io{};
        io.from = octets.data();
        io.size = octets.size();
        mcs51_state(cpu, &io);
        return !io.bad && io.at == octets.size();
    }
};

void expect_equal(busy& a, busy& b)
{
    ASSERT_EQ(a.now(), b.now());
    ASSERT_EQ(a.edges.size(), b.edges.size());
    for (size_t i = 0; i < a.edges.size(); ++i)
    {
        ASSERT_EQ(a.edges[i].cycle, b.edges[i].cycle) << i;
        ASSERT_EQ(a.edges[i].out, b.edges[i].out) << i;
    }
    ASSERT_EQ(a.reports.size(), b.reports.size());
    ASSERT_EQ(mcs51_instructions(a.cpu), mcs51_instructions(b.cpu));
    ASSERT_EQ(mcs51_interrupts(a.cpu), mcs51_interrupts(b.cpu));
    ASSERT_EQ(a.save(), b.save());
}

TEST(state, the_load_is_busy)
{
    busy b;
    b.advance(BEGIN + ON);
    EXPECT_GT(mcs51_interrupts(b.cpu), 500u);
    EXPECT_GT(b.edges.size(), 500u);
    EXPECT_TRUE(b.reports.empty());
    unsigned received = 0;
    for (uint16_t a = 0; a < 256; ++a)
    {
        received += mcs51_xdata(b.cpu, a) != 0;
    }
    EXPECT_GT(received, 30u);
}

TEST(state, saved_restored_and_run_equals_run)
{
    std::mt19937_64 rng(2543);
    for (int i = 0; i < INSTANTS; ++i)
    {
        const uint64_t at = rng() % BEGIN;
        SCOPED_TRACE("instant " + std::to_string(at));
        busy whole;
        whole.advance(at);
        switch (rng() % 8)
        {
        case 0:
            mcs51_set_code(whole.cpu, static_cast<uint16_t>(rng() % 0x300), static_cast<uint8_t>(rng()));
            break;
        case 1:
            mcs51_hold_reset(whole.cpu, true);
            whole.run(whole.now() + rng() % 4);
            break;
        case 2:
            mcs51_brown_out(whole.cpu, rng());
            break;
        default:
            break;
        }
        const std::vector<uint8_t> snapshot = whole.save();
        busy restored;
        restored.advance(rng() % 5000); // whatever it was
        mcs51_set_code(restored.cpu, 0x123, 0x00);
        ASSERT_TRUE(restored.restore(snapshot));
        ASSERT_EQ(restored.save(), snapshot);
        for (busy* b : {&whole, &restored})
        {
            b->edges.clear();
            b->reports.clear();
            b->advance(at + ON / 2);
            mcs51_hold_reset(b->cpu, false);
            b->advance(at + ON);
        }
        expect_equal(whole, restored);
        if (HasFatalFailure())
        {
            return;
        }
    }
}

TEST(state, saved_and_restored_at_every_turn_equals_run)
{
    std::mt19937_64 rng(8051);
    busy whole, restored;
    for (int i = 0; i < TURNS; ++i)
    {
        whole.advance(whole.now() + 1 + rng() % 60);
        ASSERT_TRUE(restored.restore(whole.save()));
        const uint64_t until = whole.now() + 1 + rng() % 200;
        SCOPED_TRACE("turn " + std::to_string(i) + " until " + std::to_string(until));
        for (busy* b : {&whole, &restored})
        {
            b->edges.clear();
            b->reports.clear();
            b->advance(until);
        }
        expect_equal(whole, restored);
        ASSERT_EQ(whole.get(sfr::PSW), restored.get(sfr::PSW));
        if (HasFatalFailure())
        {
            return;
        }
    }
}

TEST(state, power_down_and_a_halt_are_restored)
{
    for (const int loop : {0x00, 0x02})
    {
        bare_cpu a, b;
        for (bare_cpu* cpu : {&a, &b})
        {
            cpu->load(0, {0x75, sfr::IE, 0x01, 0x43, sfr::PCON, loop, 0x80, 0xFE});
        }
        const mcs51_stop_t stopped = a.run(1000);
        EXPECT_EQ(stopped, loop ? MCS51_POWER_DOWN : MCS51_HALTED);
        std::vector<uint8_t> octets(4096);
        emu_state_t save{}, load{};
        save.to = octets.data();
        load.from = octets.data();
        save.size = load.size = octets.size();
        mcs51_state(a.cpu, &save);
        mcs51_state(b.cpu, &load);
        EXPECT_FALSE(save.bad || load.bad);
        EXPECT_EQ(a.run(2000), b.run(2000));
        EXPECT_EQ(a.now(), b.now());
        EXPECT_EQ(mcs51_instructions(a.cpu), mcs51_instructions(b.cpu));
    }
}

TEST(state, another_part_image_or_length_is_refused)
{
    busy b;
    b.advance(1000);
    const std::vector<uint8_t> snapshot = b.save();
    busy other_image;
    other_image.load(0x1FFF, {0x00});
    EXPECT_FALSE(other_image.restore(snapshot));
    other_image.load(0x1FFF, {0xFF});
    EXPECT_TRUE(other_image.restore(snapshot)); // loaded in another order, the same image
    mcs51_config_t configs[3] = {configuration(), configuration(), configuration()};
    configs[0].part = MCS51_AT89S51;
    configs[1].xdata_octets = 256;
    configs[2].code_octets = 65536;
    for (const mcs51_config_t& config : configs)
    {
        bare_cpu other(config);
        emu_state_t io{};
        io.from = snapshot.data();
        io.size = snapshot.size();
        mcs51_state(other.cpu, &io);
        EXPECT_TRUE(io.bad);
    }
    for (size_t size = 0; size < snapshot.size(); ++size)
    {
        EXPECT_FALSE(b.restore({snapshot.begin(), snapshot.begin() + static_cast<std::ptrdiff_t>(size)}));
    }
    EXPECT_TRUE(b.restore(snapshot));
}

TEST(state, no_octets_make_it_hang_or_reach_beyond_its_memory)
{
    std::mt19937_64 rng(51);
    busy from;
    from.advance(20000);
    const std::vector<uint8_t> snapshot = from.save();
    busy b;
    int accepted = 0;
    for (int i = 0; i < CORRUPTED; ++i)
    {
        std::vector<uint8_t> octets = snapshot;
        for (uint64_t flips = 1 + rng() % 4; flips; --flips)
        {
            octets[rng() % octets.size()] = static_cast<uint8_t>(rng());
        }
        if (b.restore(octets))
        {
            ++accepted;
            mcs51_run(b.cpu, std::min(mcs51_cycle(b.cpu), UINT64_MAX - 5000) + 2000);
        }
    }
    EXPECT_GT(accepted, CORRUPTED / 4);
}

} // namespace
