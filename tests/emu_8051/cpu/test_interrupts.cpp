/// \file   test_interrupts.cpp
/// \brief  Latency of 3 to 8 cycles, gating after RETI and IE/IP, two priorities, edge and level, idle and power-down.
/// SPDX-License-Identifier: MIT
#include "bare_cpu.hpp"
#include <algorithm>

namespace
{

constexpr uint16_t INT0 = 0x03, T0 = 0x0B, INT1 = 0x13, T1 = 0x1B, SERIAL = 0x23;
constexpr uint8_t INT0_PIN = 0xFB;

/// Cycles from the overflow of timer 0 to the first instruction of its handler, while `pattern` runs over and over.
std::vector<uint64_t> latencies(std::initializer_list<int> pattern)
{
    std::vector<uint64_t> result;
    for (int phase = 0; phase < 24; ++phase)
    {
        bare_cpu b;
        b.load(T0, {0x80, 0xFE});
        std::vector<uint8_t> code;
        while (code.size() < 0x400)
        {
            code.insert(code.end(), pattern.begin(), pattern.end());
        }
        EXPECT_EQ(mcs51_load(b.cpu, 0x100, code.data(), code.size()), 0);
        mcs51_set_pc(b.cpu, 0x100);
        b.set(sfr::TMOD, 0x02);
        b.set(sfr::TL0, 0xC0 - phase);
        b.set(sfr::IE, 0x82);
        b.set(sfr::TCON, 0x10);
        const uint64_t handler = b.reach(T0);
        EXPECT_NE(handler, 0u);
        result.push_back(handler - static_cast<uint64_t>(0x40 + phase));
    }
    std::sort(result.begin(), result.end());
    return result;
}

TEST(interrupts, latency_is_3_to_8_cycles)
{
    const auto nop = latencies({0x00});
    EXPECT_EQ(nop.front(), 3u);
    EXPECT_EQ(nop.back(), 3u);
    const auto mul = latencies({0xA4});
    EXPECT_EQ(mul.front(), 3u);
    EXPECT_EQ(mul.back(), 6u);
    const auto gated = latencies({0x75, sfr::IE, 0x82, 0xA4}); // the write to IE, then 4 cycles more
    EXPECT_EQ(gated.front(), 3u);
    EXPECT_EQ(gated.back(), 8u);
}

TEST(interrupts, one_instruction_runs_after_a_write_to_ie_or_ip)
{
    for (const int address : {static_cast<int>(sfr::IE), static_cast<int>(sfr::IP)})
    {
        bare_cpu b;
        b.load(T0, {0x85, 0x30, 0x31, 0x32}); // MOV 31h,30h; RETI
        b.set(sfr::TCON, 0x20);
        b.set(sfr::IE, address == sfr::IE ? 0x00 : 0x82);
        b.load(0x100, {0x75, address, 0x82, 0x05, 0x30, 0x05, 0x30, 0x05, 0x30, 0x80, 0xFE});
        mcs51_set_pc(b.cpu, 0x100);
        b.run(40);
        EXPECT_EQ(b.ram(0x30), 3);
        EXPECT_EQ(b.ram(0x31), 1);
        EXPECT_EQ(mcs51_interrupts(b.cpu), 1u);
    }
}

TEST(interrupts, one_instruction_runs_after_reti)
{
    bare_cpu b;
    b.load(T0, {0xD2, 0x8D, 0x32}); // SETB TF0; RETI
    b.load(0x100, {0x75, sfr::IE, 0x82, 0x05, 0x30, 0x80, 0xFC});
    mcs51_set_pc(b.cpu, 0x100);
    b.set(sfr::TCON, 0x20);
    b.run(2); // MOV IE
    const uint64_t main_before = mcs51_instructions(b.cpu);
    while (mcs51_interrupts(b.cpu) < 17)
    {
        b.step();
    }
    // One of main before each vector; two of the handler for each but the last.
    EXPECT_EQ(mcs51_instructions(b.cpu) - main_before, 17u + 16u * 2u);
}

TEST(interrupts, simultaneous_requests_follow_priority_then_polling_order)
{
    const std::vector<std::pair<int, std::vector<uint16_t>>> cases = {{0x00, {INT0, T0, INT1, T1, SERIAL}},
                                                                      {0x10, {SERIAL, INT0, T0, INT1, T1}},
                                                                      {0x0A, {T0, T1, INT0, INT1, SERIAL}}};
    for (const auto& [ip, order] : cases)
    {
        bare_cpu b;
        for (const uint16_t vector : order)
        {
            b.load(vector, {0xC2, vector == SERIAL ? 0x99 : 0xD5, 0x32}); // CLR TI or F0; RETI
        }
        b.set(sfr::IP, ip);
        b.set(sfr::TCON, 0xAF);
        b.set(sfr::SCON, 0x02);
        b.set(sfr::IE, 0x9F);
        mcs51_set_pc(b.cpu, 0x100);
        std::vector<uint16_t> seen;
        for (int i = 0; i < 40; ++i)
        {
            b.step();
            if (b.pc() < 0x30 && b.pc() % 8 == 3)
            {
                seen.push_back(b.pc());
            }
        }
        EXPECT_EQ(seen, order) << ip;
    }
}

TEST(interrupts, high_breaks_into_low_and_low_waits)
{
    bare_cpu b;
    b.load(T0, {0xD2, 0x8F, 0x00, 0x05, 0x30, 0x32}); // SETB TF1; NOP; INC 30h; RETI
    b.load(T1, {0x85, 0x30, 0x31, 0xD2, 0x8D, 0x32}); // MOV 31h,30h; SETB TF0; RETI
    b.load(0x100, {0x80, 0xFE});
    b.set(sfr::IP, 0x08);
    b.set(sfr::IE, 0x8A);
    b.set(sfr::TCON, 0x20);
    mcs51_set_pc(b.cpu, 0x100);
    EXPECT_NE(b.reach(T1), 0u);
    EXPECT_EQ(b.ram(0x30), 0); // inside the low handler
    b.set(sfr::IP, 0x00);
    EXPECT_NE(b.reach(T0), 0u);
    EXPECT_EQ(b.ram(0x31), 0);
    EXPECT_EQ(b.ram(0x30), 1); // the low handler ended before its own request was taken again
    bare_cpu low;
    low.load(T0, {0xD2, 0x8F, 0x00, 0x05, 0x30, 0x32});
    low.load(T1, {0x85, 0x30, 0x31, 0x32});
    low.load(0x100, {0x80, 0xFE});
    low.set(sfr::IE, 0x8A);
    low.set(sfr::TCON, 0x20);
    mcs51_set_pc(low.cpu, 0x100);
    EXPECT_NE(low.reach(T1), 0u);
    EXPECT_EQ(low.ram(0x30), 1);
}

TEST(interrupts, edge_triggers_once_and_the_vector_clears_the_flag)
{
    bare_cpu b;
    b.load(INT0, {0x05, 0x30, 0x32});
    b.load(0x100, {0x80, 0xFE});
    mcs51_set_pc(b.cpu, 0x100);
    b.set(sfr::TCON, 0x01);
    b.set(sfr::IE, 0x81);
    b.run(100);
    mcs51_set_pins(b.cpu, 3, INT0_PIN, 100);
    const uint64_t handler = b.reach(INT0);
    EXPECT_GE(handler, 104u); // sampled in 100, polled in 101, LCALL
    EXPECT_LE(handler, 105u);
    EXPECT_EQ(b.get(sfr::TCON) & 0x02, 0);
    b.run(1000);
    EXPECT_EQ(b.ram(0x30), 1);
    mcs51_set_pins(b.cpu, 3, 0xFF, 1000);
    mcs51_set_pins(b.cpu, 3, INT0_PIN, 1000); // shorter than a cycle: not sampled
    b.run(1100);
    EXPECT_EQ(b.ram(0x30), 1);
    mcs51_set_pins(b.cpu, 3, 0xFF, 1100);
    b.run(1101);
    mcs51_set_pins(b.cpu, 3, INT0_PIN, b.now());
    b.run(1200);
    EXPECT_EQ(b.ram(0x30), 2);
}

/// A request stays one, however often its timer overflows before the vector is taken.
TEST(interrupts, the_vector_clears_what_overflowed_meanwhile)
{
    constexpr int PERIOD = 256;
    bare_cpu b;
    b.load(INT0, {0x7F, 0x00, 0xDF, 0xFE, 0x32}); // MOV R7,#0; DJNZ R7,$; RETI: 512 cycles
    b.load(T0, {0x05, 0x30, 0x32});               // INC 30h; RETI
    b.load(0x100, {0x80, 0xFE});
    mcs51_set_pc(b.cpu, 0x100);
    b.set(sfr::TMOD, 0x02);
    b.set(sfr::IE, 0x83);
    b.set(sfr::TCON, 0x13);
    b.run(PERIOD + 20);
    ASSERT_EQ(b.ram(0x30), 0); // held back by the handler of INT0
    b.run(3 * PERIOD - 20);
    EXPECT_EQ(b.ram(0x30), 1);
    b.run(3 * PERIOD + 20);
    EXPECT_EQ(b.ram(0x30), 2);
}

TEST(interrupts, level_repeats_while_low)
{
    bare_cpu b;
    b.load(INT0, {0x05, 0x30, 0x32});
    b.load(0x100, {0x05, 0x31, 0x80, 0xFC});
    mcs51_set_pc(b.cpu, 0x100);
    b.set(sfr::IE, 0x81);
    b.run(100);
    EXPECT_EQ(b.ram(0x30), 0);
    b.set_ram(0x31, 0);
    mcs51_set_pins(b.cpu, 3, INT0_PIN, b.now());
    const uint64_t before = mcs51_instructions(b.cpu);
    while (mcs51_interrupts(b.cpu) < 11)
    {
        b.step();
    }
    EXPECT_NEAR(static_cast<double>(mcs51_instructions(b.cpu) - before), 10 * 3 + 2, 1); // one of main between each two
    mcs51_set_pins(b.cpu, 3, 0xFF, b.now());
    EXPECT_NE(b.get(sfr::TCON) & 0x02, 0);
    b.run(b.now() + 30);
    EXPECT_EQ(b.get(sfr::TCON) & 0x02, 0);
    EXPECT_EQ(mcs51_interrupts(b.cpu), 11u);
}

TEST(interrupts, firmware_can_pull_its_own_int0)
{
    bare_cpu b;
    b.load(INT0, {0x80, 0xFE});
    b.set(sfr::TCON, 0x01);
    b.set(sfr::IE, 0x81);
    b.load(0x100, {0xC2, 0xB2}); // CLR P3.2
    mcs51_set_pc(b.cpu, 0x100);
    EXPECT_NE(b.reach(INT0, 10), 0u);
}

TEST(idle, ends_with_an_interrupt_and_costs_no_instructions)
{
    bare_cpu b;
    b.load(T0, {0x05, 0x30, 0x32});
    b.load(0x100, {0x43, sfr::PCON, 0x01, 0x05, 0x31, 0x80, 0xF9}); // ORL PCON,#1; INC 31h; again
    mcs51_set_pc(b.cpu, 0x100);
    b.set(sfr::TMOD, 0x01);
    b.set(sfr::IE, 0x82);
    b.set(sfr::TCON, 0x10); // first overflow after 65536 cycles
    b.run(60000);
    EXPECT_EQ(mcs51_instructions(b.cpu), 1u);
    EXPECT_EQ(b.now(), 60000u);
    EXPECT_EQ(b.get(sfr::PCON) & 1, 1);
    b.run(65536);
    EXPECT_EQ(b.reach(T0), 65536u + 3u);
    EXPECT_EQ(b.get(sfr::PCON) & 1, 0);
    b.run(10 * 65536 + 100);
    EXPECT_EQ(b.ram(0x30), 10);
    EXPECT_EQ(b.ram(0x31), 10);
}

TEST(idle, a_jump_to_itself_waits_at_no_cost_and_halts_without_interrupts)
{
    bare_cpu b;
    b.load(T0, {0x05, 0x30, 0x32});
    b.load(0x100, {0x80, 0xFE});
    mcs51_set_pc(b.cpu, 0x100);
    b.set(sfr::TMOD, 0x02);
    b.set(sfr::IE, 0x82);
    b.set(sfr::TCON, 0x10);
    EXPECT_EQ(b.run(25600 + 20), MCS51_RAN);
    EXPECT_EQ(b.ram(0x30), 100);
    b.set(sfr::IE, 0);
    const uint64_t at = b.now(), instructions = mcs51_instructions(b.cpu);
    EXPECT_EQ(b.run(at + 1000000), MCS51_HALTED);
    EXPECT_EQ(b.now(), at);
    EXPECT_EQ(mcs51_instructions(b.cpu), instructions);
    EXPECT_EQ(b.run(at + 1000000), MCS51_HALTED); // time passes when it is run again
    EXPECT_GE(b.now(), at + 1000000);
    EXPECT_LE(b.now(), at + 1000001);
    EXPECT_EQ(mcs51_instructions(b.cpu), instructions + 500000);
}

TEST(power_down, stops_the_clocks_until_an_external_interrupt)
{
    mcs51_config_t config{};
    config.wake_at_low = true;
    bare_cpu b(config);
    b.load(INT0, {0x05, 0x30, 0x32});
    b.load(0x100, {0x43, sfr::PCON, 0x02, 0x80, 0xFE});
    mcs51_set_pc(b.cpu, 0x100);
    b.set(sfr::TMOD, 0x01);
    b.set(sfr::IE, 0x81);
    b.set(sfr::TCON, 0x10);
    EXPECT_EQ(b.run(1000), MCS51_POWER_DOWN);
    EXPECT_EQ(b.now(), 1000u);
    EXPECT_EQ(b.run(5000), MCS51_POWER_DOWN);
    EXPECT_EQ(b.get(sfr::TL0), 2); // the cycles of the ORL
    mcs51_set_pins(b.cpu, 3, INT0_PIN, 5000);
    EXPECT_EQ(b.run(5020), MCS51_RAN);
    EXPECT_GT(b.ram(0x30), 0);
    EXPECT_EQ(b.get(sfr::PCON) & 2, 0);
    EXPECT_GE(b.get(sfr::TL0), 20);
    EXPECT_LE(b.get(sfr::TL0), 24);
}

TEST(power_down, ends_when_the_pin_is_high_again_and_serves_it_once)
{
    for (const int tcon : {0x00, 0x01, 0x04}) // level, INT0 by edge, INT1 by edge
    {
        const bool second = tcon == 0x04;
        bare_cpu b;
        b.load(second ? INT1 : INT0, {0x05, 0x30, 0x32});
        b.load(0x100, {0x43, sfr::PCON, 0x02, 0x05, 0x31, 0x80, 0xFE});
        mcs51_set_pc(b.cpu, 0x100);
        b.set(sfr::TMOD, 0x01);
        b.set(sfr::IE, second ? 0x84 : 0x81);
        b.set(sfr::TCON, 0x10 | tcon);
        b.run(1000);
        mcs51_set_pins(b.cpu, 3, second ? 0xF7 : INT0_PIN, 1000);
        EXPECT_EQ(b.run(5000), MCS51_POWER_DOWN);
        EXPECT_EQ(b.get(sfr::TL0), 2);
        mcs51_set_pins(b.cpu, 3, 0xFF, 5000);
        EXPECT_EQ(b.run(5002), MCS51_RAN); // LCALL
        EXPECT_EQ(b.pc(), second ? INT1 : INT0);
        b.run(5100);
        EXPECT_EQ(b.ram(0x30), 1) << tcon;
        EXPECT_EQ(b.ram(0x31), 1); // the instruction after the one that set PD
        EXPECT_EQ(b.get(sfr::TCON) & 0x0A, 0);
        EXPECT_NEAR(b.get(sfr::TL0), 102, 1);
    }
}

TEST(power_down, a_disabled_interrupt_does_not_end_it)
{
    for (const int ie : {0x01, 0x80, 0x84})
    {
        bare_cpu b;
        b.load(0, {0x75, sfr::IE, ie, 0x43, sfr::PCON, 0x02});
        b.run(100);
        mcs51_set_pins(b.cpu, 3, INT0_PIN, 100);
        b.run(200);
        mcs51_set_pins(b.cpu, 3, 0xFF, 200);
        EXPECT_EQ(b.run(300), MCS51_POWER_DOWN) << ie;
    }
}

TEST(power_down, reset_ends_it_and_keeps_ram)
{
    bare_cpu b;
    b.load(0, {0x75, 0x30, 0x77, 0x43, sfr::PCON, 0x02});
    EXPECT_EQ(b.run(100), MCS51_POWER_DOWN);
    mcs51_reset(b.cpu, false);
    EXPECT_EQ(b.pc(), 0);
    EXPECT_EQ(b.ram(0x30), 0x77);
    b.step();
    EXPECT_EQ(b.pc(), 3);
}

} // namespace
