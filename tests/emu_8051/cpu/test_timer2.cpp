/// \file   test_timer2.cpp
/// \brief  Timer 2 of the AT89S52 against a model made count by count, its interrupt, baud rates and clock-out (Atmel 1919D, "Timer 2").
/// SPDX-License-Identifier: MIT
#include "bare_cpu.hpp"
#include <random>

namespace
{

constexpr int TRIALS = 400;
constexpr uint8_t T2_PIN = 0x01, T2EX_PIN = 0x02, TXD = 0x02;
constexpr int CAPTURE = 0x01, COUNTER = 0x02, TR2 = 0x04, EXEN2 = 0x08, TCLK = 0x10, RCLK = 0x20, EXF2 = 0x40,
              TF2 = 0x80, DCEN = 0x01, T2OE = 0x02;

mcs51_config_t s52()
{
    mcs51_config_t config{};
    config.part = MCS51_AT89S52;
    return config;
}

/// An AT89S52 that spins at 100h with EA = 1, and timer 2 set up.
struct rig : bare_cpu
{
    rig(int t2con, int t2mod, int count = 0, int reload = 0) : bare_cpu(s52())
    {
        load(0x100, {0x80, 0xFE});
        mcs51_set_pc(cpu, 0x100);
        set(sfr::IE, 0x80);
        set(sfr::TL2, count & 255);
        set(sfr::TH2, count >> 8);
        set(sfr::RCAP2L, reload & 255);
        set(sfr::RCAP2H, reload >> 8);
        set(sfr::T2MOD, t2mod);
        set(sfr::T2CON, t2con);
    }
    int count() { return get(sfr::TL2) | get(sfr::TH2) << 8; }
    int reload() { return get(sfr::RCAP2L) | get(sfr::RCAP2H) << 8; }
    void pins(int level, uint64_t at)
    {
        run(at);
        mcs51_set_pins(cpu, 1, static_cast<uint8_t>(level), at);
    }
};

/// Timer 2 as the data sheet draws it, one count at a time.
struct model
{
    int t2con, t2mod;
    uint16_t count, reload;
    bool t2 = true, t2ex = true;

    bool clock() const { return (t2con & (RCLK | TCLK)) || ((t2mod & T2OE) && !(t2con & COUNTER)); }
    bool up_down() const { return !clock() && !(t2con & CAPTURE) && (t2mod & DCEN); }
    void overflow(uint16_t value)
    {
        count = value;
        t2con |= clock() ? 0 : TF2;
        t2con ^= up_down() ? EXF2 : 0;
    }
    void step()
    {
        if (up_down() && !t2ex)
        {
            if (--count == reload)
            {
                overflow(0xFFFF);
            }
        }
        else if (++count == 0)
        {
            overflow(!clock() && (t2con & CAPTURE) ? 0 : reload);
        }
    }
    void cycle()
    {
        for (int i = 0; (t2con & TR2) && !(t2con & COUNTER) && i < (clock() ? 6 : 1); ++i)
        {
            step();
        }
    }
    void sample(int level)
    {
        const bool now_t2 = level & T2_PIN, now_ex = level & T2EX_PIN;
        if (t2 && !now_t2 && (t2con & COUNTER) && (t2con & TR2))
        {
            const bool direction = t2ex;
            t2ex = now_ex;
            step();
            t2ex = direction;
        }
        if (t2ex && !now_ex && (t2con & EXEN2) && !up_down())
        {
            t2con |= EXF2;
            if (!clock() && (t2con & CAPTURE))
            {
                reload = count;
            }
            else if (!clock())
            {
                count = reload;
            }
        }
        t2 = now_t2;
        t2ex = now_ex;
    }
};

TEST(timer2, every_mode_equals_a_count_by_count_model)
{
    std::mt19937 rng(52);
    for (int trial = 0; trial < TRIALS; ++trial)
    {
        const int t2con = TR2 | static_cast<int>(rng() & (CAPTURE | COUNTER | EXEN2 | TCLK | RCLK)) * !(rng() % 8) |
                          static_cast<int>(rng() & (CAPTURE | COUNTER | EXEN2));
        const int t2mod = static_cast<int>(rng() & 3);
        model m{t2con, t2mod, static_cast<uint16_t>(rng()), static_cast<uint16_t>(rng() % 4 ? rng() : 0xFF00 | rng())};
        m.reload = rng() % 8 ? m.reload : m.count;
        rig b(t2con, t2mod, m.count, m.reload);
        uint64_t at = 0;
        int level = 0xFF;
        while (at < 20000)
        {
            const uint64_t until = at + 1 + (rng() % 3 ? rng() % 50 : rng() % 9000);
            b.run(until);
            for (; at < until; ++at)
            {
                m.cycle();
                if (level >= 0)
                {
                    m.sample(level);
                    level = -1;
                }
            }
            ASSERT_EQ(b.count(), m.count) << trial << " T2CON " << t2con << " T2MOD " << t2mod << " at " << at;
            ASSERT_EQ(b.reload(), m.reload) << trial << " T2CON " << t2con << " at " << at;
            ASSERT_EQ(b.get(sfr::T2CON), m.t2con) << trial << " T2MOD " << t2mod << " at " << at;
            level = static_cast<int>(rng() & 3) | 0xFC;
            b.pins(level, at);
        }
    }
}

TEST(timer2, interrupt_5_is_polled_in_the_cycle_of_the_overflow_and_flags_are_kept)
{
    rig b(TR2, 0, 0xFFFF - 40, 0xFF00);
    b.load(0x100, {0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x80, 0xF6});
    b.load(0x2B, {0x05, 0x30, 0x32});
    b.set(sfr::IE, 0xA0);
    EXPECT_EQ(b.reach(0x2B), 41u + 2u); // overflow after 41 cycles, LCALL: no cycle of waiting, as TF0 has
    EXPECT_EQ(b.get(sfr::T2CON), TF2 | TR2);
    b.run(60);
    EXPECT_GT(b.ram(0x30), 1);        // again and again until software clears it
    b.load(0x2B, {0xC2, 0xCF, 0x32}); // CLR TF2
    b.run(70);
    const uint64_t taken = mcs51_interrupts(b.cpu);
    b.run(280);
    EXPECT_EQ(mcs51_interrupts(b.cpu), taken);
    b.run(330);
    EXPECT_EQ(mcs51_interrupts(b.cpu), taken + 1); // 256 cycles later
}

TEST(timer2, exf2_requests_except_while_counting_up_and_down)
{
    for (const int mode : {0, CAPTURE, RCLK, TCLK})
    {
        rig b(EXEN2 | mode, 0);
        b.load(0x2B, {0xC2, 0xCE, 0x32}); // CLR EXF2
        b.set(sfr::IE, 0xA0);
        b.pins(0xFF & ~T2EX_PIN, 100);
        b.run(200);
        EXPECT_EQ(mcs51_interrupts(b.cpu), 1u) << mode;
        b.pins(0xFF, 200);
        b.run(300);
        EXPECT_EQ(mcs51_interrupts(b.cpu), 1u) << mode; // a rise is none
    }
    rig up_down(TR2, DCEN, 0xFFF0, 0xFFF0);
    up_down.load(0x2B, {0xC2, 0xCF, 0x32});
    up_down.set(sfr::IE, 0xA0);
    up_down.run(24); // one overflow: EXF2 = 1
    EXPECT_EQ(up_down.get(sfr::T2CON) & EXF2, EXF2);
    EXPECT_EQ(mcs51_interrupts(up_down.cpu), 1u);
    rig software(0, 0);
    software.load(0x2B, {0xC2, 0xCE, 0x32});
    software.load(0x100, {0xD2, 0xCE, 0x00, 0x00, 0x80, 0xFE}); // SETB EXF2
    software.set(sfr::IE, 0xA0);
    software.run(20);
    EXPECT_EQ(mcs51_interrupts(software.cpu), 1u);
}

TEST(timer2, its_interrupt_is_the_last_in_polling_order_and_has_a_priority)
{
    for (const int ip : {0x00, 0x20})
    {
        rig b(TF2, 0);
        b.load(0x2B, {0xC2, 0xCF, 0x32});
        b.load(0x23, {0xC2, 0x99, 0x32}); // CLR TI
        b.set(sfr::IP, ip);
        b.set(sfr::SCON, 0x02);
        b.set(sfr::IE, 0xB0);
        const uint64_t t2 = b.reach(0x2B, 20), serial = b.reach(0x23, 20);
        EXPECT_EQ(t2 != 0 && serial != 0 && t2 < serial, ip != 0);
    }
}

std::vector<uint64_t> edges_of(const bare_cpu& b, unsigned port, uint8_t pin)
{
    std::vector<uint64_t> result;
    for (const auto& e : b.edges)
    {
        if (e.port == port && (e.changed & pin))
        {
            result.push_back(e.cycle);
        }
    }
    return result;
}

TEST(timer2, baud_is_the_crystal_by_32_by_the_reload)
{
    constexpr int reload = 0x10000 - 36; // 9600 Bd at 11.0592 MHz: 96 cycles a bit
    for (const int smod : {0x00, 0x80})
    {
        rig b(TR2 | TCLK, 0, reload, reload);
        b.set(sfr::PCON, smod); // SMOD is for timer 1 only
        b.set(sfr::SCON, 0x40);
        b.run(500);
        b.set(sfr::SBUF, 0x55);
        b.run(3000);
        const auto edges = edges_of(b, 3, TXD);
        ASSERT_EQ(edges.size(), 10u);
        for (size_t i = 0; i < edges.size(); ++i)
        {
            EXPECT_EQ(edges[i] - edges[0], 96 * i);
        }
        EXPECT_EQ(b.get(sfr::T2CON) & TF2, 0);
    }
}

TEST(timer2, sends_by_one_timer_and_receives_by_the_other)
{
    for (const int clock : {TCLK, RCLK})
    {
        rig b(TR2 | clock, 0, 0xFFDC, 0xFFDC); // 96 cycles a bit, as timer 1 at FDh
        b.set(sfr::TMOD, 0x20);
        b.set(sfr::TH1, 0xFD);
        b.set(sfr::TL1, 0xFD);
        b.set(sfr::TCON, 0x40);
        b.set(sfr::SCON, 0x50);
        b.run(500);
        b.set(sfr::SBUF, 0xC5);
        size_t seen = b.edges.size();
        while (b.now() < 2000)
        {
            b.run(b.now() + 1);
            for (; seen < b.edges.size(); ++seen)
            {
                mcs51_set_pins(b.cpu, 3, b.edges[seen].out & TXD ? 0xFF : 0xFE, b.now());
            }
        }
        EXPECT_EQ(b.get(sfr::SBUF), 0xC5);
        EXPECT_EQ(b.get(sfr::SCON) & 0x07, 0x07);
    }
}

TEST(timer2, a_frame_goes_on_when_its_clock_is_changed)
{
    rig b(TR2 | TCLK, 0, 0xFFDC, 0xFFDC);
    b.set(sfr::TMOD, 0x20);
    b.set(sfr::TH1, 0xFD);
    b.set(sfr::TCON, 0x40);
    b.set(sfr::PCON, 0x80); // timer 1 makes 48 cycles a bit
    b.set(sfr::SCON, 0x40);
    b.run(500);
    b.set(sfr::SBUF, 0x55);
    b.run(900);
    const size_t before = edges_of(b, 3, TXD).size();
    ASSERT_GE(before, 3u);
    b.set(sfr::T2CON, TR2);
    b.run(3000);
    const auto edges = edges_of(b, 3, TXD);
    ASSERT_EQ(edges.size(), 10u);
    EXPECT_EQ(edges[9] - edges[8], 48u);
    EXPECT_EQ(edges[1] - edges[0], 96u);
}

TEST(timer2, clock_out_is_the_crystal_by_4_by_the_reload_at_half_duty)
{
    for (const int counts : {6, 30, 6000})
    {
        rig b(TR2, T2OE, 0x10000 - counts, 0x10000 - counts);
        b.run(20000);
        const auto edges = edges_of(b, 1, T2_PIN);
        ASSERT_EQ(edges.size(), 20000u / static_cast<unsigned>(counts / 6));
        for (size_t i = 0; i < edges.size(); ++i)
        {
            EXPECT_EQ(edges[i], (i + 1) * static_cast<unsigned>(counts / 6));
        }
        EXPECT_EQ(b.get(sfr::T2CON), TR2); // no TF2
        b.set(sfr::T2MOD, 0);
        EXPECT_EQ(mcs51_port_out(b.cpu, 1), 0xFF);
        b.set(sfr::P1, 0xFE); // a latch of 0 holds the pin low
        b.set(sfr::T2MOD, T2OE);
        const size_t seen = edges_of(b, 1, T2_PIN).size();
        b.run(25000);
        EXPECT_EQ(edges_of(b, 1, T2_PIN).size(), seen);
    }
    rig counter(TR2 | COUNTER, T2OE, 0xFFF0, 0xFFF0); // C/T2 = 1: no clock
    counter.run(1000);
    EXPECT_TRUE(edges_of(counter, 1, T2_PIN).empty());
}

TEST(timer2, stands_in_power_down_and_runs_in_idle)
{
    rig idle(TR2, 0);
    idle.load(0x100, {0x43, sfr::PCON, 0x01, 0x80, 0xFE});
    idle.run(500);
    EXPECT_EQ(idle.count(), 500);
    rig down(TR2, 0);
    down.load(0x100, {0x43, sfr::PCON, 0x02, 0x80, 0xFE});
    down.run(500);
    EXPECT_EQ(down.count(), 2);
}

TEST(timer2, is_not_in_the_s51)
{
    bare_cpu b;
    b.execute(0, {0x75, sfr::T2CON, 0x04, 0xE5, sfr::T2CON}, 2);
    EXPECT_EQ(b.get(sfr::ACC), 0xFF);
    ASSERT_EQ(b.reports.size(), 1u);
    EXPECT_EQ(b.reports[0].detail, sfr::T2CON);
    for (const int address : {0xC8, 0xC9, 0xCA, 0xCB, 0xCC, 0xCD})
    {
        rig s(0, 0);
        s.execute(0x200, {0x75, address, 0x01, 0xE5, address}, 2);
        EXPECT_EQ(s.get(sfr::ACC), 0x01) << std::hex << address;
        EXPECT_TRUE(s.reports.empty());
    }
}

} // namespace
