/// \file   test_sfr.cpp
/// \brief  Ports, reset values, dual data pointer, watchdog and power flags of the AT89S51 (Atmel 2487D).
/// SPDX-License-Identifier: MIT
#include "bare_cpu.hpp"

namespace
{

TEST(ports, pin_is_latch_and_outside)
{
    bare_cpu b;
    mcs51_set_pins(b.cpu, 1, 0xF0, 0);
    b.execute(0, {0xE5, sfr::P1});
    EXPECT_EQ(b.get(sfr::ACC), 0xF0);
    b.execute(0, {0x75, sfr::P1, 0x3C, 0xE5, sfr::P1}, 2);
    EXPECT_EQ(b.get(sfr::ACC), 0x30);
    EXPECT_EQ(b.get(sfr::P1), 0x3C);
    EXPECT_EQ(mcs51_port_out(b.cpu, 1), 0x3C);
}

TEST(ports, read_modify_write_works_on_the_latch)
{
    const std::vector<std::pair<std::vector<uint8_t>, uint8_t>> cases = {
        {{0x05, sfr::P1}, 0x00},       {{0x15, sfr::P1}, 0xFE},       {{0x53, sfr::P1, 0x7F}, 0x7F},
        {{0x43, sfr::P1, 0x00}, 0xFF}, {{0x63, sfr::P1, 0x81}, 0x7E}, {{0x52, sfr::P1}, 0x55},
        {{0x42, sfr::P1}, 0xFF},       {{0x62, sfr::P1}, 0xAA},       {{0xD5, sfr::P1, 0x00}, 0xFE},
        {{0xB2, 0x97}, 0x7F},          {{0xC2, 0x90}, 0xFE},          {{0xD2, 0x90}, 0xFF},
        {{0x92, 0x91}, 0xFD},          {{0x10, 0x92, 0x00}, 0xFB}};
    for (const auto& [code, latch] : cases)
    {
        bare_cpu b;
        mcs51_set_pins(b.cpu, 1, 0x00, 0); // all pins held low from outside
        b.set(sfr::ACC, 0x55);
        ASSERT_EQ(mcs51_load(b.cpu, 0, code.data(), code.size()), 0);
        b.step();
        EXPECT_EQ(b.get(sfr::P1), latch) << std::hex << +code[0];
    }
    // CJNE, MOV, JB, ORL C,bit read the pin.
    bare_cpu b;
    mcs51_set_pins(b.cpu, 1, 0x00, 0);
    b.execute(0, {0x20, 0x90, 0x10});
    EXPECT_EQ(b.pc(), 3);
    b.execute(0, {0xA0, 0x90}); // ORL C,/P1.0
    EXPECT_EQ(b.get(sfr::PSW) >> 7, 1);
}

TEST(ports, a_read_of_pins_that_nothing_drives_is_told_once)
{
    struct outside
    {
        std::vector<uint32_t> reports;
    } o;
    mcs51_config_t config{};
    config.clock = {11059200, 12};
    config.ctx = &o;
    config.undriven = [](void*, unsigned port) -> uint8_t { return port == 0 ? 0xF3 : port == 2 ? 0xFF : 0x00; };
    config.report.ctx = &o;
    config.report.put = [](void* ctx, emu_report_kind_t kind, const char*, uint32_t detail, emu_time_t)
    {
        EXPECT_EQ(kind, EMU_GUEST_ERROR);
        static_cast<outside*>(ctx)->reports.push_back(detail);
    };
    mcs51_t* const cpu = mcs51_create(&config);
    // MOV A,P0 (some are driven); JB P0.2 (driven); MOV A,P1; MOV P0,#7Fh; JB P0.7 (latch 0); MOV C,P0.4 twice; MOV A,P2; SETB P2.0
    const uint8_t code[] = {0xE5, sfr::P0, 0x20, 0x82, 0x00, 0xE5, sfr::P1, 0x75, sfr::P0, 0x7F, 0x20, 0x87,
                            0x00, 0xA2,    0x84, 0xA2, 0x84, 0xE5, sfr::P2, 0xD2, 0xA0,    0x80, 0xFE};
    ASSERT_EQ(mcs51_load(cpu, 0, code, sizeof code), 0);
    mcs51_run(cpu, 100);
    EXPECT_EQ(o.reports, (std::vector<uint32_t>{0x010, 0x2FF}));
    mcs51_destroy(cpu);
}

TEST(ports, changes_are_told_with_their_cycle)
{
    bare_cpu b;
    b.load(0, {0x75, sfr::P1, 0x0F, 0xC2, 0x90, 0xC2, 0x90, 0xD2, 0x97});
    b.run(5);
    ASSERT_EQ(b.edges.size(), 3u); // the second CLR changes nothing
    EXPECT_EQ(b.edges[0].cycle, 2u);
    EXPECT_EQ(b.edges[0].out, 0x0F);
    EXPECT_EQ(b.edges[0].changed, 0xF0);
    EXPECT_EQ(b.edges[1].cycle, 3u);
    EXPECT_EQ(b.edges[1].changed, 0x01);
    EXPECT_EQ(b.edges[2].cycle, 5u);
    EXPECT_EQ(b.edges[2].out, 0x8E);
}

TEST(ports, sync_comes_before_a_pin_is_read_and_shorten_ends_the_slice)
{
    struct outside
    {
        mcs51_t* cpu = nullptr;
        std::vector<uint64_t> synced;
    } o;
    mcs51_config_t config{};
    config.clock = {11059200, 12};
    config.ctx = &o;
    config.sync = [](void* ctx, uint64_t cycle)
    {
        auto* self = static_cast<outside*>(ctx);
        self->synced.push_back(cycle);
        EXPECT_EQ(mcs51_cycle(self->cpu), cycle);
        mcs51_set_pins(self->cpu, 1, static_cast<uint8_t>(cycle), cycle);
    };
    config.port = [](void* ctx, unsigned, uint8_t, uint8_t, uint64_t cycle)
    { mcs51_shorten(static_cast<outside*>(ctx)->cpu, cycle + 1); };
    o.cpu = mcs51_create(&config);
    const uint8_t code[] = {0x00, 0xE5, sfr::P1, 0xC2, 0xA0, 0x00, 0x00, 0x00};
    ASSERT_EQ(mcs51_load(o.cpu, 0, code, sizeof code), 0);
    EXPECT_EQ(mcs51_run(o.cpu, 1000), MCS51_RAN);
    EXPECT_EQ(o.synced, std::vector<uint64_t>{2});
    EXPECT_EQ(mcs51_sfr(o.cpu, sfr::ACC), 2);
    EXPECT_EQ(mcs51_cycle(o.cpu), 4u); // CLR P2.0 ends at 3
    mcs51_destroy(o.cpu);
}

TEST(reset, sfrs_have_their_values_and_ram_is_kept)
{
    bare_cpu b;
    EXPECT_EQ(b.get(sfr::PCON), 0x10); // POF
    b.set(sfr::PCON, 0x80);
    for (const uint8_t a : {sfr::P0, sfr::P1, sfr::P2, sfr::P3, sfr::SP, sfr::DPL, sfr::DP1H, sfr::TMOD, sfr::TH1,
                            sfr::AUXR, sfr::AUXR1, sfr::IE, sfr::IP, sfr::PSW, sfr::ACC, sfr::B})
    {
        b.set(a, 0x5A);
    }
    b.set_ram(0x33, 0x5A);
    mcs51_reset(b.cpu, false);
    for (const uint8_t port : {sfr::P0, sfr::P1, sfr::P2, sfr::P3})
    {
        EXPECT_EQ(b.get(port), 0xFF);
    }
    EXPECT_EQ(b.get(sfr::SP), 0x07);
    for (const uint8_t a : {sfr::PCON, sfr::DPL, sfr::DP1H, sfr::TMOD, sfr::TH1, sfr::AUXR, sfr::AUXR1, sfr::IE,
                            sfr::IP, sfr::PSW, sfr::ACC, sfr::B})
    {
        EXPECT_EQ(b.get(a), 0x00) << std::hex << +a;
    }
    EXPECT_EQ(b.ram(0x33), 0x5A);
    mcs51_reset(b.cpu, true);
    EXPECT_EQ(b.get(sfr::PCON), 0x10);
    EXPECT_EQ(b.ram(0x33), 0x00);
}

TEST(data_pointer, auxr1_selects_one_of_two)
{
    bare_cpu b;
    b.execute(0, {0x90, 0x12, 0x34, 0x05, sfr::AUXR1, 0x90, 0x56, 0xFF, 0xA3, 0x05, sfr::AUXR1, 0xA3}, 6);
    EXPECT_EQ(b.get(sfr::DPH) << 8 | b.get(sfr::DPL), 0x1235);
    EXPECT_EQ(b.get(sfr::DP1H) << 8 | b.get(sfr::DP1L), 0x5700);
    b.load(0x456, {0xC3});
    b.execute(0, {0x75, sfr::AUXR1, 0x01, 0x90, 0x04, 0x56, 0xE4, 0x93}, 4);
    EXPECT_EQ(b.get(sfr::ACC), 0xC3);
}

constexpr uint64_t WDT_CYCLES = 16383, WDT_RESET_CYCLES = 9; // 98 oscillator periods

TEST(watchdog, resets_16383_cycles_after_it_was_last_cleared)
{
    bare_cpu b;
    b.load(0, {0x75, 0x30, 0x01, 0x75, sfr::WDTRST, 0x1E, 0x75, sfr::WDTRST, 0xE1, 0x80, 0xFE});
    EXPECT_EQ(b.run(6 + WDT_CYCLES - 1), MCS51_RAN); // not halted: the watchdog can end the loop
    EXPECT_EQ(b.pc(), 9);
    EXPECT_TRUE(b.reports.empty());
    b.set(sfr::P1, 0x00);
    b.run(b.now() + 3);
    EXPECT_EQ(b.pc(), 0);
    EXPECT_GE(b.now(), 6 + WDT_CYCLES + WDT_RESET_CYCLES);
    EXPECT_LE(b.now(), 6 + WDT_CYCLES + WDT_RESET_CYCLES + 1);
    EXPECT_EQ(b.get(sfr::P1), 0xFF);
    EXPECT_EQ(b.ram(0x30), 0x01);
    ASSERT_EQ(b.reports.size(), 1u);
    EXPECT_EQ(b.reports[0].kind, EMU_GUEST_ERROR);
}

TEST(watchdog, is_fed_by_the_sequence_only)
{
    bare_cpu b;
    // 1Eh, E1h; then a loop that feeds it every 256 * 256 * ... cycles: DJNZ R0,$; DJNZ R1,-4; feed; again
    b.load(0, {0x75, sfr::WDTRST, 0x1E, 0x75, sfr::WDTRST, 0xE1, 0x79, 0x18, 0xD8, 0xFE, 0xD9, 0xFC, 0x80, 0xF2});
    b.run(100 * WDT_CYCLES);
    EXPECT_TRUE(b.reports.empty()); // 24 * 514 cycles a turn
    bare_cpu wrong;
    wrong.load(0, {0x75, sfr::WDTRST, 0x1E, 0x75, sfr::WDTRST, 0xE1, 0x75, sfr::WDTRST, 0xE1, 0x80, 0xFB});
    wrong.run(WDT_CYCLES + 100);
    EXPECT_EQ(wrong.reports.size(), 1u); // E1h alone does nothing
    bare_cpu off;
    off.load(0, {0x75, sfr::WDTRST, 0xE1, 0x75, sfr::WDTRST, 0x1E, 0x80, 0xFE});
    EXPECT_EQ(off.run(1000), MCS51_HALTED);
}

TEST(watchdog, counts_in_idle_unless_wdidle)
{
    for (const int auxr : {0x00, 0x10})
    {
        bare_cpu b;
        b.load(0, {0x75, sfr::AUXR, auxr, 0x75, sfr::WDTRST, 0x1E, 0x75, sfr::WDTRST, 0xE1, 0x43, sfr::PCON, 0x01, 0x80,
                   0xFE});
        b.run(2 * WDT_CYCLES);
        EXPECT_EQ(b.reports.size(), auxr ? 0u : 1u);
    }
}

} // namespace
