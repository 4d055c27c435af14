/// \file   test_fidelity.cpp
/// \brief  Rules of docs/fidelity.md that no other test of the CPU is about.
/// SPDX-License-Identifier: MIT
#include "bare_cpu.hpp"

namespace
{

constexpr uint8_t TXD = 0x02;

/// A jump to itself that interrupts do not halt, and timer 1 set for 9600 Bd at 11.0592 MHz, not running.
void idle_at_9600(bare_cpu& b)
{
    b.load(0x100, {0x80, 0xFE});
    mcs51_set_pc(b.cpu, 0x100);
    b.set(sfr::IE, 0x80);
    b.set(sfr::TMOD, 0x20);
    b.set(sfr::TH1, 0xFD);
    b.set(sfr::TL1, 0xFD);
}

TEST(fidelity, indirect_addressing_never_reaches_an_sfr)
{
    const std::vector<std::vector<int>> instructions = {{0x06},       {0x16}, {0x26},       {0x36},
                                                        {0x46},       {0x56}, {0x66},       {0x76, 0x12},
                                                        {0x86, 0x30}, {0x96}, {0xA6, 0x31}, {0xB6, 0x12, 0x00},
                                                        {0xC6},       {0xD6}, {0xE6},       {0xF6}};
    for (const mcs51_part_t part : {MCS51_AT89S51, MCS51_AT89S52})
    {
        for (const auto& instruction : instructions)
        {
            mcs51_config_t config{};
            config.part = part;
            bare_cpu b(config);
            b.set_ram(0, 0xF0);
            b.set_ram(0x31, 0x77);
            b.set_ram(0xF0, 0x3C);
            b.set(sfr::B, 0xA5);
            b.set(sfr::ACC, 0x5A);
            std::vector<uint8_t> code(instruction.begin(), instruction.end());
            ASSERT_EQ(mcs51_load(b.cpu, 0, code.data(), code.size()), 0);
            b.step();
            EXPECT_EQ(b.get(sfr::B), 0xA5) << std::hex << instruction[0];
            EXPECT_NE(b.ram(0x30), 0xA5) << std::hex << instruction[0];
            EXPECT_EQ(b.reports.size(), part == MCS51_AT89S51 ? 1u : 0u) << std::hex << instruction[0];
        }
    }
    mcs51_config_t config{};
    config.part = MCS51_AT89S52;
    bare_cpu b(config);
    b.set_ram(0, 0xF0);
    b.set_ram(0xF0, 0x3C);
    b.set(sfr::ACC, 0x5A);
    b.execute(0, {0xD6}); // XCHD A,@R0
    EXPECT_EQ(b.get(sfr::ACC), 0x5C);
    EXPECT_EQ(b.ram(0xF0), 0x3A);
}

/// [U] The order in which PUSH SP reads and POP SP writes: the value before the increment, and the popped value stays.
TEST(fidelity, push_and_pop_of_sp_are_a_named_choice)
{
    bare_cpu b;
    b.execute(0, {0x75, sfr::SP, 0x30, 0xC0, sfr::SP}, 2);
    EXPECT_EQ(b.get(sfr::SP), 0x31);
    EXPECT_EQ(b.ram(0x31), 0x30);
    b.set_ram(0x31, 0x55);
    b.execute(0x10, {0xD0, sfr::SP});
    EXPECT_EQ(b.get(sfr::SP), 0x55);
}

TEST(fidelity, sbuf_is_two_registers)
{
    bare_cpu b;
    b.load(0x100, {0x80, 0xFE});
    mcs51_set_pc(b.cpu, 0x100);
    b.set(sfr::IE, 0x80);
    b.set(sfr::SCON, 0x10); // mode 0 receives zeros from a line held low
    mcs51_set_pins(b.cpu, 3, 0xFE, 0);
    b.run(20);
    EXPECT_EQ(b.get(sfr::SBUF), 0x00);
    b.set(sfr::SCON, 0x01);
    b.set(sfr::SBUF, 0xA6);
    EXPECT_EQ(b.get(sfr::SBUF), 0x00);
    b.run(60);
    EXPECT_EQ(b.get(sfr::SBUF), 0x00);
    EXPECT_EQ(b.get(sfr::SCON) & 0x02, 0x02);
}

/// RI and TI share vector 23h, and hardware clears neither.
TEST(fidelity, the_serial_vector_repeats_until_software_clears_both_flags)
{
    bare_cpu b;
    b.load(0x23, {0x05, 0x30, 0x32}); // INC 30h; RETI
    b.load(0x100, {0x80, 0xFE});
    mcs51_set_pc(b.cpu, 0x100);
    b.set(sfr::SCON, 0x03);
    b.set(sfr::IE, 0x90);
    b.run(100);
    EXPECT_GT(b.ram(0x30), 5);
    EXPECT_EQ(b.get(sfr::SCON), 0x03);
    b.set(sfr::SCON, 0x02); // RI alone is cleared
    const int before = b.ram(0x30);
    b.run(200);
    EXPECT_GT(b.ram(0x30), before + 5);
    b.set(sfr::SCON, 0x00);
    const uint64_t taken = mcs51_interrupts(b.cpu);
    b.run(300);
    EXPECT_LE(mcs51_interrupts(b.cpu), taken + 1);
}

TEST(fidelity, a_flag_left_up_hides_no_later_overflow)
{
    bare_cpu b;
    b.load(0x100, {0x80, 0xFE});
    mcs51_set_pc(b.cpu, 0x100);
    b.set(sfr::IE, 0x80);
    b.set(sfr::TMOD, 0x02);
    b.set(sfr::TCON, 0x10);
    b.run(1000); // overflows at 256, 512, 768
    EXPECT_EQ(b.get(sfr::TCON), 0x30);
    b.set(sfr::TCON, 0x10);
    b.run(1023);
    EXPECT_EQ(b.get(sfr::TCON), 0x10);
    b.run(1024);
    EXPECT_EQ(b.get(sfr::TCON), 0x30);
}

TEST(fidelity, modes_2_and_3_receive_nine_bits_and_sm2_drops_data)
{
    for (const int mode : {0x80, 0xC0})
    {
        for (const int sm2 : {0x00, 0x20})
        {
            for (const int ninth : {0, 1})
            {
                bare_cpu b;
                b.load(0x100, {0x80, 0xFE});
                mcs51_set_pc(b.cpu, 0x100);
                b.set(sfr::IE, 0x80);
                b.set(sfr::TMOD, 0x20);
                b.set(sfr::TH1, 0xFF);
                b.set(sfr::TL1, 0xFF);
                b.set(sfr::PCON, mode == 0xC0 ? 0x80 : 0x00);
                b.set(sfr::SCON, mode | sm2 | 0x10);
                b.set(sfr::TCON, 0x40);
                const double bit = mode == 0xC0 ? 16.0 : 64.0 / 12.0; // cycles
                const unsigned frame = 1u << 10 | static_cast<unsigned>(ninth) << 9 | 0x96u << 1;
                for (unsigned i = 0; i < 11; ++i)
                {
                    const auto at = static_cast<uint64_t>(1000 + bit * i + 0.5);
                    b.run(at);
                    mcs51_set_pins(b.cpu, 3, frame >> i & 1u ? 0xFF : 0xFE, at);
                    EXPECT_EQ(b.get(sfr::SCON) & 0x01, i == 10 && (ninth || !sm2) ? 1 : 0) << i; // in the ninth bit
                }
                b.run(2000);
                const bool taken = ninth || !sm2;
                EXPECT_EQ(b.get(sfr::SCON) & 0x01, taken) << mode << ' ' << sm2 << ' ' << ninth;
                EXPECT_EQ(b.get(sfr::SBUF), taken ? 0x96 : 0x00);
                EXPECT_EQ((b.get(sfr::SCON) & 0x04) != 0, taken && ninth);
            }
        }
    }
}

TEST(fidelity, a_break_is_one_frame_without_a_stop_bit)
{
    bare_cpu b;
    idle_at_9600(b);
    b.set(sfr::SCON, 0x50);
    b.set(sfr::TCON, 0x40);
    b.run(1000);
    mcs51_set_pins(b.cpu, 3, 0xFE, 1000);
    b.run(20000);                             // 20 frames long
    EXPECT_EQ(b.get(sfr::SCON) & 0x05, 0x01); // RI, and RB8 = 0 tells the missing stop bit
    EXPECT_EQ(b.get(sfr::SBUF), 0x00);
    EXPECT_TRUE(b.reports.empty()); // a start bit needs a fall: no overrun
}

/// 0F0h cycles to the overflow and a frame that begins at SBUF's write would both show in the phase of the start bit.
TEST(fidelity, the_divider_by_16_runs_free)
{
    constexpr uint64_t BIT = 96;
    std::vector<uint64_t> phases;
    for (const uint64_t written : {1001, 1020, 1050, 1079, 1090})
    {
        bare_cpu b;
        idle_at_9600(b);
        b.set(sfr::SCON, 0x40);
        b.set(sfr::TCON, 0x40);
        b.run(written);
        b.set(sfr::SBUF, 0x00);
        b.run(3000);
        for (const auto& e : b.edges)
        {
            if (e.port == 3 && (e.changed & TXD) && !(e.out & TXD))
            {
                phases.push_back(e.cycle % BIT);
                EXPECT_LE(e.cycle - written, BIT + 1);
            }
        }
    }
    ASSERT_EQ(phases.size(), 5u);
    EXPECT_EQ(std::vector<uint64_t>(5, phases[0]), phases);
}

TEST(fidelity, nothing_but_reset_stops_the_watchdog)
{
    const std::vector<std::vector<int>> attempts = {
        {0x75, sfr::WDTRST, 0x00}, {0x75, sfr::WDTRST, 0x1E}, {0x75, sfr::AUXR, 0x00}, {0x75, sfr::WDTRST, 0xE1}};
    for (const auto& attempt : attempts)
    {
        bare_cpu b;
        std::vector<uint8_t> code = {0x75, sfr::WDTRST, 0x1E, 0x75, sfr::WDTRST, 0xE1};
        code.insert(code.end(), attempt.begin(), attempt.end());
        code.insert(code.end(), {0x80, 0xFE});
        ASSERT_EQ(mcs51_load(b.cpu, 0, code.data(), code.size()), 0);
        b.run(4 + 16383 + 20);
        EXPECT_EQ(b.reports.size(), 1u) << attempt[1] << ' ' << attempt[2];
    }
    bare_cpu b;
    b.load(0, {0x75, sfr::WDTRST, 0x1E, 0x75, sfr::WDTRST, 0xE1, 0x00, 0x80, 0xFD});
    b.run(1000);
    b.load(0, {0x00, 0x80, 0xFD});
    mcs51_reset(b.cpu, false);
    b.run(50000);
    EXPECT_TRUE(b.reports.empty());
}

TEST(fidelity, the_watchdog_stands_in_power_down_and_goes_on_after_it)
{
    bare_cpu b;
    b.load(0, {0x02, 0x01, 0x00});
    b.load(0x03, {0x32});
    b.load(0x100,
           {0x75, sfr::IE, 0x81, 0x75, sfr::WDTRST, 0x1E, 0x75, sfr::WDTRST, 0xE1, 0x75, sfr::PCON, 0x02, 0x80, 0xFE});
    b.run(1000);
    mcs51_set_pins(b.cpu, 3, 0xFB, 1000);
    EXPECT_EQ(b.run(100000), MCS51_POWER_DOWN);
    mcs51_set_pins(b.cpu, 3, 0xFF, 100000);
    b.run(100000 + 16383 - 10);
    EXPECT_TRUE(b.reports.empty());
    b.run(100000 + 16383 + 10);
    EXPECT_EQ(b.reports.size(), 1u);
}

TEST(fidelity, wdtrst_cannot_be_read_and_auxr_keeps_disale)
{
    bare_cpu b;
    b.execute(0, {0xE5, sfr::WDTRST});
    ASSERT_EQ(b.reports.size(), 1u);
    EXPECT_EQ(b.reports[0].kind, EMU_GUEST_ERROR);
    b.execute(0, {0x75, sfr::AUXR, 0x01, 0xE5, sfr::AUXR}, 2);
    EXPECT_EQ(b.get(sfr::ACC), 0x01); // ALE itself is no pin of this emulator
    EXPECT_EQ(b.reports.size(), 1u);
}

/// 9600 Bd from 11.0592 MHz; from 12 MHz the same reload gives 10417 and the nearest reload 8929.
TEST(fidelity, baud_of_modes_1_and_3_by_timer_1)
{
    struct baud
    {
        int th1, pcon;
        double crystal_hz, baud;
    };
    for (const baud& c : {baud{0xFD, 0x00, 11059200, 9600.0},
                          {0xFD, 0x80, 11059200, 19200.0},
                          {0xFD, 0x00, 12000000, 10416.667},
                          {0xF9, 0x80, 12000000, 8928.571}})
    {
        bare_cpu b;
        b.load(0x100, {0x80, 0xFE});
        mcs51_set_pc(b.cpu, 0x100);
        b.set(sfr::IE, 0x80);
        b.set(sfr::TMOD, 0x20);
        b.set(sfr::TH1, c.th1);
        b.set(sfr::TL1, c.th1);
        b.set(sfr::PCON, c.pcon);
        b.set(sfr::SCON, 0x40);
        b.set(sfr::TCON, 0x40);
        b.set(sfr::SBUF, 0x00); // start and eight zeros: nine bits low
        b.run(5000);
        ASSERT_EQ(b.edges.size(), 2u);
        const double low = static_cast<double>(b.edges[1].cycle - b.edges[0].cycle);
        EXPECT_NEAR(9 * c.crystal_hz / 12 / low, c.baud, 0.01);
    }
}

} // namespace
