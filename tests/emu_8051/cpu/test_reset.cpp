/// \file   test_reset.cpp
/// \brief  Resets at any instant: the RST pin, brown-out, power, from callbacks; the pulse that the watchdog drives (Atmel 2487D).
/// SPDX-License-Identifier: MIT
#include "bare_cpu.hpp"
#include <algorithm>

namespace
{

TEST(rst, two_cycles_high_reset_and_hold_until_low)
{
    bare_cpu b;
    b.load(0, {0x05, 0x30, 0x75, sfr::P1, 0x55, 0x00, 0x80, 0xFD}); // INC 30h; MOV P1,#
    b.run(100);
    EXPECT_EQ(b.get(sfr::P1), 0x55);
    mcs51_hold_reset(b.cpu, true);
    EXPECT_EQ(b.run(101), MCS51_RAN);
    EXPECT_EQ(b.get(sfr::P1), 0x55);
    b.run(103);
    EXPECT_EQ(b.get(sfr::P1), 0xFF);
    EXPECT_EQ(b.edges.back().out, 0xFF);
    const uint64_t executed = mcs51_instructions(b.cpu);
    EXPECT_EQ(b.run(5000), MCS51_RAN);
    EXPECT_EQ(b.now(), 5000u);
    EXPECT_EQ(mcs51_instructions(b.cpu), executed);
    EXPECT_EQ(b.get(sfr::P1), 0xFF);
    mcs51_hold_reset(b.cpu, false);
    EXPECT_EQ(b.pc(), 0);
    b.run(5003);
    EXPECT_EQ(b.ram(0x30), 2); // RAM was kept
    EXPECT_EQ(b.get(sfr::P1), 0x55);
}

TEST(rst, a_pulse_of_one_cycle_is_none)
{
    bare_cpu b;
    b.load(0, {0x05, 0x30, 0x00, 0x80, 0xFD}); // INC 30h; NOP; SJMP
    b.run(100);
    mcs51_hold_reset(b.cpu, true);
    b.run(101);
    mcs51_hold_reset(b.cpu, false);
    b.run(200);
    EXPECT_EQ(b.ram(0x30), 1);
    mcs51_hold_reset(b.cpu, true);
    b.run(202);
    mcs51_hold_reset(b.cpu, false);
    b.run(300);
    EXPECT_EQ(b.ram(0x30), 2);
}

TEST(rst, ends_idle_and_power_down)
{
    for (const int pcon : {0x01, 0x02})
    {
        bare_cpu b;
        b.load(0, {0x05, 0x30, 0x75, sfr::PCON, pcon});
        b.run(100);
        mcs51_hold_reset(b.cpu, true);
        b.run(200);
        EXPECT_EQ(b.get(sfr::PCON) & 3, 0);
        mcs51_hold_reset(b.cpu, false);
        b.run(300);
        EXPECT_EQ(b.ram(0x30), 2);
    }
}

TEST(rst, nothing_counts_and_nothing_is_sent_while_it_is_high)
{
    bare_cpu b;
    b.load(0, {0x80, 0xFE});
    b.set(sfr::IE, 0x80);
    b.set(sfr::TMOD, 0x21);
    b.set(sfr::TH1, 0xFD);
    b.set(sfr::SCON, 0x50);
    b.set(sfr::TCON, 0x50);
    b.run(100);
    b.set(sfr::SBUF, 0x00);
    b.run(500);
    EXPECT_EQ(mcs51_port_out(b.cpu, 3) & 2, 0); // in the middle of a frame
    mcs51_hold_reset(b.cpu, true);
    b.run(502);
    EXPECT_EQ(mcs51_port_out(b.cpu, 3) & 2, 2);
    const size_t edges = b.edges.size();
    b.run(5000);
    EXPECT_EQ(b.get(sfr::TL0), 0);
    mcs51_hold_reset(b.cpu, false);
    b.run(9000);
    EXPECT_EQ(b.edges.size(), edges);
    EXPECT_EQ(b.get(sfr::SCON), 0);
}

/// The same resets from inside a callback: they come at the instruction's end, and leave nothing of it behind.
TEST(rst, a_reset_in_a_callback_comes_at_the_next_boundary)
{
    struct outside
    {
        mcs51_t* cpu = nullptr;
        int kind = 0;
        uint64_t at = 0;
    };
    for (const int kind : {1, 2, 3})
    {
        outside o;
        o.kind = kind;
        mcs51_config_t config{};
        config.ctx = &o;
        config.clock = {11059200, 12};
        config.port = [](void* ctx, unsigned port, uint8_t out, uint8_t, uint64_t cycle)
        {
            auto* self = static_cast<outside*>(ctx);
            if (port != 1 || out != 0x55 || self->at)
            {
                return;
            }
            self->at = cycle;
            self->kind == 1   ? mcs51_reset(self->cpu, false)
            : self->kind == 2 ? mcs51_brown_out(self->cpu, 0)
                              : mcs51_hold_reset(self->cpu, true);
        };
        o.cpu = mcs51_create(&config);
        const uint8_t code[] = {0x05, 0x30, 0x75, sfr::P1, 0x55, 0x05, 0x31, 0x00, 0x80, 0xFD};
        ASSERT_EQ(mcs51_load(o.cpu, 0, code, sizeof code), 0);
        mcs51_set_sfr(o.cpu, sfr::PCON, 0x00);
        mcs51_run(o.cpu, 50);
        EXPECT_EQ(o.at, 3u);
        if (kind == 3)
        {
            EXPECT_EQ(mcs51_iram(o.cpu, 0x30), 1);
            mcs51_hold_reset(o.cpu, false);
            mcs51_run(o.cpu, 100);
            EXPECT_EQ(mcs51_iram(o.cpu, 0x31), 2); // RST was high for an INC longer
        }
        else
        {
            EXPECT_EQ(mcs51_iram(o.cpu, 0x31), 1); // the first turn ended with the write to P1
        }
        EXPECT_EQ(mcs51_iram(o.cpu, 0x30), 2);
        EXPECT_EQ(mcs51_sfr(o.cpu, sfr::PCON), kind == 2 ? 0x10 : 0x00);
        mcs51_destroy(o.cpu);
    }
}

TEST(power, brown_out_sets_pof_and_scrambles_ram_by_its_seed)
{
    mcs51_config_t config{};
    config.part = MCS51_AT89S52;
    config.xdata_octets = 16;
    std::vector<std::vector<uint8_t>> ram;
    for (const uint64_t seed : {0u, 1u, 1u, 2u})
    {
        bare_cpu b(config);
        b.load(0, {0x80, 0xFE});
        b.set(sfr::PCON, 0x00);
        mcs51_set_xdata(b.cpu, 3, 0x12);
        for (int i = 0; i < 256; ++i)
        {
            b.set_ram(static_cast<uint8_t>(i), i);
        }
        b.run(100);
        mcs51_brown_out(b.cpu, seed);
        EXPECT_EQ(b.get(sfr::PCON), 0x10);
        EXPECT_EQ(b.pc(), 0);
        EXPECT_EQ(mcs51_xdata(b.cpu, 3), 0x12);
        ram.emplace_back();
        for (int i = 0; i < 256; ++i)
        {
            ram.back().push_back(b.ram(static_cast<uint8_t>(i)));
        }
    }
    const std::vector<uint8_t>& kept = ram[0];
    for (size_t i = 0; i < kept.size(); ++i)
    {
        EXPECT_EQ(kept[i], i);
    }
    EXPECT_EQ(ram[1], ram[2]);
    EXPECT_NE(ram[1], ram[3]);
    EXPECT_GT(std::count_if(ram[1].begin(), ram[1].end(), [&](const uint8_t& v) { return v != &v - ram[1].data(); }),
              200);
}

TEST(power, ram_is_random_at_power_on_when_asked_for)
{
    mcs51_config_t config{};
    config.ram_seed = 7;
    const bare_cpu a(config), b(config);
    int differs = 0;
    for (int i = 0; i < 128; ++i)
    {
        EXPECT_EQ(a.ram(static_cast<uint8_t>(i)), b.ram(static_cast<uint8_t>(i)));
        differs += a.ram(static_cast<uint8_t>(i)) != 0;
    }
    EXPECT_GT(differs, 100);
}

TEST(power, pof_is_set_by_power_only_and_software_clears_it)
{
    bare_cpu b;
    b.load(0, {0x53, sfr::PCON, 0xEF, 0x80, 0xFE}); // ANL PCON,#
    EXPECT_EQ(b.get(sfr::PCON), 0x10);
    b.run(10);
    EXPECT_EQ(b.get(sfr::PCON), 0x00);
    mcs51_reset(b.cpu, false);
    EXPECT_EQ(b.get(sfr::PCON), 0x00);
    mcs51_reset(b.cpu, true);
    EXPECT_EQ(b.get(sfr::PCON), 0x10);
    mcs51_reset(b.cpu, false);
    EXPECT_EQ(b.get(sfr::PCON), 0x10); // a reset alone keeps it
}

TEST(watchdog, drives_rst_for_98_periods_unless_disrto)
{
    struct outside
    {
        std::vector<std::pair<uint64_t, bool>> rst;
    };
    for (const int auxr : {0x00, 0x08})
    {
        outside o;
        mcs51_config_t config{};
        config.ctx = &o;
        config.clock = {11059200, 12};
        config.rst = [](void* ctx, bool high, uint64_t cycle)
        { static_cast<outside*>(ctx)->rst.emplace_back(cycle, high); };
        mcs51_t* const cpu = mcs51_create(&config);
        const uint8_t code[] = {
            0x75, sfr::AUXR, static_cast<uint8_t>(auxr), 0x75, sfr::WDTRST, 0x1E, 0x75, sfr::WDTRST, 0xE1, 0x00,
            0x80, 0xFD};
        ASSERT_EQ(mcs51_load(cpu, 0, code, sizeof code), 0);
        mcs51_run(cpu, 6 + 16383 + 20);
        if (auxr)
        {
            EXPECT_TRUE(o.rst.empty());
        }
        else
        {
            ASSERT_EQ(o.rst.size(), 2u);
            EXPECT_NEAR(static_cast<double>(o.rst[0].first), 6 + 16383, 1);
            EXPECT_TRUE(o.rst[0].second);
            EXPECT_EQ(o.rst[1].first, o.rst[0].first + (98 + 11) / 12);
            EXPECT_FALSE(o.rst[1].second);
        }
        EXPECT_EQ(mcs51_sfr(cpu, sfr::AUXR), auxr); // it was reset, and the program has written it again
        mcs51_destroy(cpu);
    }
}

} // namespace
