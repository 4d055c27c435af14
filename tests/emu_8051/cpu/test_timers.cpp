/// \file   test_timers.cpp
/// \brief  Timers 0 and 1: four modes, gate, counter pins, timer 0 in mode 3, compared with a count made cycle by cycle.
/// SPDX-License-Identifier: MIT
#include "bare_cpu.hpp"
#include <random>

namespace
{

constexpr int TRIALS = 300;

/// A timer of mode 0, 1 or 2 as the manual draws it, one count at a time.
struct model
{
    int mode;
    uint8_t tl, th;
    bool flag = false;

    void count()
    {
        ++tl;
        bool carry = tl == 0;
        if (mode == 0)
        {
            carry = tl == 0x20;
            tl &= 0x1F;
        }
        if (mode == 2)
        {
            tl = carry ? th : tl;
            flag |= carry;
        }
        else if (carry)
        {
            flag |= ++th == 0;
        }
    }
};

TEST(timers, modes_0_1_2_equal_a_count_by_count_model)
{
    std::mt19937 rng(8051);
    for (int trial = 0; trial < TRIALS; ++trial)
    {
        const int n = trial & 1, mode = static_cast<int>(rng() % 3);
        const auto th = static_cast<uint8_t>(rng());
        const auto tl = static_cast<uint8_t>(mode == 0 ? rng() & 0x1F : rng());
        const int cycles = static_cast<int>(rng() % 70000);
        bare_cpu b;
        b.load(0x100, {0x80, 0xFE});
        mcs51_set_pc(b.cpu, 0x100);
        b.set(sfr::IE, 0x80); // a loop with EA = 1 does not halt
        b.set(sfr::TMOD, n ? mode << 4 : mode);
        b.set(n ? sfr::TL1 : sfr::TL0, tl);
        b.set(n ? sfr::TH1 : sfr::TH0, th);
        b.set(sfr::TCON, n ? 0x40 : 0x10);
        model m{mode, tl, th};
        int at = 0;
        while (at < cycles)
        {
            at += 1 + static_cast<int>(rng() % 20000); // looked at in between
            b.run(static_cast<uint64_t>(at));
        }
        for (int i = 0; i < at; ++i)
        {
            m.count();
        }
        ASSERT_EQ(b.get(n ? sfr::TL1 : sfr::TL0), m.tl) << "trial " << trial << " mode " << mode << " cycles " << at;
        ASSERT_EQ(b.get(n ? sfr::TH1 : sfr::TH0), m.th) << "trial " << trial << " mode " << mode;
        ASSERT_EQ((b.get(sfr::TCON) & (n ? 0x80 : 0x20)) != 0, m.flag) << "trial " << trial << " mode " << mode;
    }
}

TEST(timers, writes_and_reads_take_effect_at_the_end_of_their_instruction)
{
    bare_cpu b;
    // MOV TL0,#10h; SETB TR0; MOV A,TL0; MOV R2,TL0; CLR TR0; NOP; NOP
    b.load(0, {0x75, sfr::TL0, 0x10, 0xD2, 0x8C, 0xE5, sfr::TL0, 0xAA, sfr::TL0, 0xC2, 0x8C, 0x00, 0x00});
    b.run(9);
    EXPECT_EQ(b.get(sfr::ACC), 0x11);
    EXPECT_EQ(b.ram(2), 0x13);
    EXPECT_EQ(b.get(sfr::TL0), 0x14);
}

TEST(timers, the_classic_seven_cycle_reload)
{
    // CLR TR0; MOV A,#lo+7; ADD A,TL0; MOV TL0,A; MOV A,#hi; ADDC A,TH0; MOV TH0,A; SETB TR0 keeps a period of 1000 exactly.
    const int reload = 0x10000 - 1000 + 7;
    bare_cpu b;
    b.load(0x0B, {0x02, 0x02, 0x00});
    b.load(0x200, {0xC2, 0x8C, 0x74, reload & 255, 0x25, sfr::TL0, 0xF5, sfr::TL0, 0x74, reload >> 8, 0x35, sfr::TH0,
                   0xF5, sfr::TH0, 0xD2, 0x8C, 0x05, 0x30, 0x32});
    b.load(0x100, {0xA4, 0x80, 0xFD}); // MUL makes the latency vary
    mcs51_set_pc(b.cpu, 0x100);
    b.set(sfr::TMOD, 0x01);
    b.set(sfr::IE, 0x82);
    b.set(sfr::TCON, 0x10);
    b.run(65536 + 100 * 1000 + 500);
    EXPECT_EQ(b.ram(0x30), 101);
    EXPECT_EQ(b.get(sfr::TL0) + 256 * b.get(sfr::TH0), 0x10000 - 1000 + 500);
}

TEST(timers, gate_counts_while_the_pin_is_high)
{
    bare_cpu b;
    b.load(0x100, {0x80, 0xFE});
    mcs51_set_pc(b.cpu, 0x100);
    b.set(sfr::IE, 0x80);
    b.set(sfr::TMOD, 0x99); // mode 1, gated, both
    b.set(sfr::TCON, 0x50);
    b.run(100);
    mcs51_set_pins(b.cpu, 3, 0xF7, 100); // INT1 low stops timer 1
    b.run(300);
    mcs51_set_pins(b.cpu, 3, 0xFF, 300);
    b.run(400);
    EXPECT_EQ(b.get(sfr::TL0) + 256 * b.get(sfr::TH0), 400);
    EXPECT_EQ(b.get(sfr::TL1) + 256 * b.get(sfr::TH1), 200);
}

TEST(timers, counters_count_falls_that_last_a_cycle)
{
    bare_cpu b;
    b.load(0x100, {0x80, 0xFE});
    mcs51_set_pc(b.cpu, 0x100);
    b.set(sfr::IE, 0x80);
    b.set(sfr::TMOD, 0x56); // timer 1: counter, mode 1; timer 0: counter, mode 2
    b.set(sfr::TL0, 0xFD);
    b.set(sfr::TH0, 0xF0);
    b.set(sfr::TCON, 0x50);
    for (uint64_t i = 0; i < 5; ++i)
    {
        b.run(100 * i + 10);
        mcs51_set_pins(b.cpu, 3, 0xCF, 100 * i + 10); // T0 and T1 fall
        b.run(100 * i + 50);
        mcs51_set_pins(b.cpu, 3, 0xFF, 100 * i + 50);
    }
    b.run(600);
    mcs51_set_pins(b.cpu, 3, 0xCF, 600);
    mcs51_set_pins(b.cpu, 3, 0xFF, 600);
    b.run(700);
    EXPECT_EQ(b.get(sfr::TL1), 5);
    EXPECT_EQ(b.get(sfr::TL0), 0xF2);
    EXPECT_EQ(b.get(sfr::TCON) & 0xA0, 0x20);
}

TEST(timers, timer_0_in_mode_3_is_two_and_timer_1_runs_free)
{
    bare_cpu b;
    b.load(0x100, {0x80, 0xFE});
    mcs51_set_pc(b.cpu, 0x100);
    b.set(sfr::IE, 0x80);
    b.set(sfr::TMOD, 0x13);
    b.set(sfr::TCON, 0x10); // TR0: TL0 only
    b.run(300);
    EXPECT_EQ(b.get(sfr::TL0), 300 - 256);
    EXPECT_EQ(b.get(sfr::TH0), 0);
    EXPECT_EQ(b.get(sfr::TL1) + 256 * b.get(sfr::TH1), 300); // TR1 = 0
    EXPECT_EQ(b.get(sfr::TCON), 0x30);
    b.set(sfr::TCON, 0x40); // TR1: TH0
    b.run(600);
    EXPECT_EQ(b.get(sfr::TL0), 300 - 256);
    EXPECT_EQ(b.get(sfr::TH0), 300 - 256);
    EXPECT_EQ(b.get(sfr::TCON), 0xC0);
    b.set(sfr::TMOD, 0x33); // its own mode 3 stops timer 1
    b.run(700);
    EXPECT_EQ(b.get(sfr::TL1) + 256 * b.get(sfr::TH1), 600);
}

TEST(timers, th0_in_mode_3_interrupts_through_tf1)
{
    bare_cpu b;
    b.load(0x1B, {0x80, 0xFE});
    b.load(0x100, {0x00, 0x80, 0xFD});
    mcs51_set_pc(b.cpu, 0x100);
    b.set(sfr::TMOD, 0x03);
    b.set(sfr::IE, 0x88);
    b.set(sfr::TCON, 0x40);
    const uint64_t at = b.reach(0x1B);
    EXPECT_GE(at, 256u + 3u);
    EXPECT_LE(at, 256u + 4u);
}

} // namespace
