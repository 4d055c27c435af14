/// Watchdog, WDINT and /XRS. Instants are OSCCLK periods.
/// SPDX-License-Identifier: MIT
#include "rig.hpp"

namespace
{
constexpr uint64_t WDCLK = 512; ///< OSCCLK
constexpr unsigned GOOD = 0x28, DISABLE = 0x40, FLAG = 0x80;
constexpr int WAKEINT = 39;

uint64_t cycles(uint64_t oscclk)
{
    return oscclk / 2;
}

TEST(watchdog, runs_after_reset_and_resets_the_device_after_256_counts)
{
    rig r;
    r.put_guarded("HISPCP", 3);
    r.pass(cycles(256 * WDCLK) - 1);
    EXPECT_EQ(r.get("WDCNTR"), 255u);
    EXPECT_FALSE(f2812_in_reset(r.dsp));
    r.pass(1);
    EXPECT_TRUE(f2812_in_reset(r.dsp));
    EXPECT_EQ(r.get("HISPCP"), 1u);
    ASSERT_EQ(r.reports.size(), 1u);
    EXPECT_EQ(r.reports[0].kind, EMU_GUEST_ERROR);
    EXPECT_EQ(r.reports[0].at, exact(256 * WDCLK, rig::OSC_HZ));
    EXPECT_TRUE(f2812_interrupt_pending(r.dsp));
    EXPECT_EQ(r.take(), F2812_VECTOR_RESET);
    EXPECT_EQ(r.get("WDCR"), FLAG);
}

TEST(watchdog, holds_xrs_low_for_512_oscclk)
{
    rig r;
    std::vector<std::pair<bool, emu_time_t>> edges;
    (void)emu_wire_watch(
        f2812_wire(r.dsp, "XRS"),
        [](void* ctx, bool level, emu_time_t at)
        { static_cast<std::vector<std::pair<bool, emu_time_t>>*>(ctx)->emplace_back(level, at); },
        &edges);
    r.put_guarded("WDCR", 0); // WDCHK 000
    EXPECT_TRUE(f2812_in_reset(r.dsp));
    r.pass(cycles(512) - 1);
    EXPECT_TRUE(f2812_in_reset(r.dsp));
    r.pass(1);
    EXPECT_FALSE(f2812_in_reset(r.dsp));
    EXPECT_EQ(edges, (std::vector<std::pair<bool, emu_time_t>>{{false, 0}, {true, exact(512, rig::OSC_HZ)}}));
    EXPECT_EQ(r.get("WDCR"), FLAG);
    r.pass(cycles(5 * WDCLK));
    EXPECT_EQ(r.get("WDCNTR"), 5u) << "counts from the end of the reset on";
}

TEST(watchdog, any_check_value_but_101_resets_at_once_also_when_disabled)
{
    for (unsigned check = 0; check < 8; check++)
    {
        rig r;
        r.quiet();
        r.put_guarded("WDCR", check << 3 | DISABLE);
        EXPECT_EQ(f2812_in_reset(r.dsp), check != 5) << check;
    }
}

/// TI's table of key sequences (SPRUI07, table 1-26).
TEST(watchdog, only_aa_right_after_55_clears_the_counter)
{
    const struct
    {
        unsigned key;
        bool clears;
    } steps[] = {{0xAA, false}, {0xAA, false}, {0x55, false}, {0x55, false}, {0x55, false},
                 {0xAA, true},  {0xAA, false}, {0x55, false}, {0xAA, true},  {0x55, false},
                 {0x32, false}, {0xAA, false}, {0x55, false}, {0xAA, true}};
    rig r;
    unsigned count = 0;
    for (const auto& step : steps)
    {
        r.pass(cycles(WDCLK));
        count++;
        r.put_guarded("WDKEY", step.key);
        count = step.clears ? 0 : count;
        EXPECT_EQ(r.get("WDCNTR"), count) << std::hex << step.key;
    }
    r.pass(cycles(255 * WDCLK));
    EXPECT_FALSE(f2812_in_reset(r.dsp));
    r.pass(cycles(WDCLK));
    EXPECT_TRUE(f2812_in_reset(r.dsp));
}

TEST(watchdog, prescale_is_2_to_the_wdps_minus_1)
{
    const unsigned divider[8] = {1, 1, 2, 4, 8, 16, 32, 64};
    for (unsigned wdps = 0; wdps < 8; wdps++)
    {
        rig r;
        r.put_guarded("WDCR", GOOD | wdps);
        EXPECT_EQ(r.get("WDCR"), wdps) << "WDCHK reads 000";
        r.pass(cycles(10 * WDCLK * divider[wdps]) - 1);
        EXPECT_EQ(r.get("WDCNTR"), 9u) << wdps;
        r.pass(1);
        EXPECT_EQ(r.get("WDCNTR"), 10u) << wdps;
        r.pass(cycles(246 * WDCLK * divider[wdps]) - 1);
        EXPECT_FALSE(f2812_in_reset(r.dsp)) << wdps;
        r.pass(1);
        EXPECT_TRUE(f2812_in_reset(r.dsp)) << wdps;
    }
}

TEST(watchdog, disabled_it_stands)
{
    rig r;
    r.pass(cycles(3 * WDCLK));
    r.put_guarded("WDCR", GOOD | DISABLE);
    EXPECT_EQ(r.get("WDCR"), DISABLE);
    r.pass(cycles(1000 * WDCLK));
    EXPECT_EQ(r.get("WDCNTR"), 3u);
    EXPECT_TRUE(r.reports.empty());
    r.put_guarded("WDCR", GOOD);
    r.pass(cycles(252 * WDCLK));
    EXPECT_FALSE(f2812_in_reset(r.dsp));
    r.pass(cycles(WDCLK));
    EXPECT_TRUE(f2812_in_reset(r.dsp));
}

TEST(watchdog, wddis_stays_once_wdoverride_is_cleared_by_writing_1)
{
    rig r;
    r.put_guarded("SCSR", 0);
    EXPECT_EQ(r.get("SCSR"), 5u) << "writing 0 leaves WDOVERRIDE";
    r.put_guarded("SCSR", 1);
    EXPECT_EQ(r.get("SCSR"), 4u);
    r.put_guarded("SCSR", 1);
    EXPECT_EQ(r.get("SCSR"), 4u) << "it does not come back";
    EXPECT_TRUE(r.reports.empty());
    r.put_guarded("WDCR", GOOD | DISABLE);
    EXPECT_EQ(r.get("WDCR"), 0u);
    ASSERT_EQ(r.reports.size(), 1u);
    EXPECT_EQ(r.reports[0].kind, EMU_GUEST_ERROR);
    f2812_reset(r.dsp, F2812_RESET_XRS);
    EXPECT_EQ(r.get("SCSR"), 5u);
}

TEST(watchdog, interrupts_instead_with_wdenint)
{
    rig r;
    r.listen();
    r.put("PIEIER1", 0x80);
    r.put_guarded("SCSR", 2);
    r.pass(cycles(256 * WDCLK));
    EXPECT_FALSE(f2812_in_reset(r.dsp));
    EXPECT_EQ(r.get("SCSR"), 3u) << "WDINTS is low";
    EXPECT_EQ(r.serve(), (std::vector<int>{WAKEINT}));
    r.pass(cycles(512) - 1);
    EXPECT_EQ(r.get("SCSR"), 3u);
    r.pass(1);
    EXPECT_EQ(r.get("SCSR"), 7u);
    EXPECT_EQ(r.get("WDCNTR"), 1u) << "it counts on";
    r.put_guarded("WDCR", 0);
    EXPECT_FALSE(f2812_in_reset(r.dsp)) << "a wrong WDCHK interrupts too";
    EXPECT_EQ(r.serve(), (std::vector<int>{WAKEINT}));
    EXPECT_TRUE(r.reports.empty());
}

TEST(watchdog, wdflag_is_cleared_by_writing_1)
{
    rig r;
    f2812_reset(r.dsp, F2812_RESET_WATCHDOG);
    r.put_guarded("WDCR", GOOD);
    EXPECT_EQ(r.get("WDCR"), FLAG);
    r.put_guarded("WDCR", GOOD | FLAG);
    EXPECT_EQ(r.get("WDCR"), 0u);
}

TEST(watchdog, goes_by_oscclk_whatever_the_pll_does)
{
    rig r;
    r.put_guarded("PLLCR", 10);
    r.put_guarded("WDCR", GOOD | 7);
    r.pass_until(exact(255 * WDCLK * 64, rig::OSC_HZ));
    EXPECT_EQ(r.get("WDCNTR"), 255u);
    f2812_set_osc_ppb(r.dsp, 100000000); // 10 % fast: the last count is shorter
    const emu_time_t from = f2812_now(r.dsp);
    while (!f2812_in_reset(r.dsp))
    {
        f2812_skip(r.dsp, EMU_TIME_MAX / 4);
    }
    EXPECT_NEAR(static_cast<double>(f2812_now(r.dsp) - from), 1e12 * WDCLK * 64 / 33e6, 1e5);
}

TEST(reset, xrs_low_resets_and_holds_the_device)
{
    rig r;
    emu_wire_t* const xrs = f2812_wire(r.dsp, "XRS");
    const int driver = emu_wire_add_driver(xrs);
    r.put_guarded("WDCR", GOOD | 3);
    r.put_guarded("PLLCR", 10);
    r.pass(100000);
    emu_wire_drive(xrs, driver, EMU_STRONG0, f2812_now(r.dsp));
    EXPECT_TRUE(f2812_in_reset(r.dsp));
    EXPECT_EQ(r.take(), F2812_VECTOR_RESET);
    EXPECT_EQ(r.get("PLLCR"), 0u);
    EXPECT_EQ(r.get("WDCR"), 0u) << "no WDFLAG";
    const emu_time_t low = f2812_now(r.dsp);
    r.pass(15000000);
    EXPECT_EQ(f2812_now(r.dsp), low + EMU_PS_PER_S) << "OSCCLK / 2 again";
    EXPECT_TRUE(f2812_in_reset(r.dsp)) << "and no watchdog meanwhile";
    EXPECT_EQ(r.get("WDCNTR"), 0u);
    emu_wire_drive(xrs, driver, EMU_Z, f2812_now(r.dsp));
    EXPECT_FALSE(f2812_in_reset(r.dsp));
    r.pass(cycles(7 * WDCLK));
    EXPECT_EQ(r.get("WDCNTR"), 7u);
}

TEST(reset, takes_every_register_and_pin_back)
{
    rig r;
    r.quiet();
    r.listen();
    r.put_guarded("GPADIR", 0x0001);
    emu_wire_t* const pin = f2812_wire(r.dsp, "GPIOA0");
    EXPECT_FALSE(pin->level);
    r.put("PIEIER9", 1);
    r.put("PIEIFR9", 1);
    EXPECT_TRUE(f2812_interrupt_pending(r.dsp));
    f2812_reset(r.dsp, F2812_RESET_XRS);
    EXPECT_TRUE(pin->level) << "its pull-up";
    EXPECT_EQ(r.take(), F2812_VECTOR_RESET);
    EXPECT_EQ(r.take(), F2812_NO_VECTOR);
    EXPECT_EQ(r.get("PIEIFR9") | r.get("PIEIER9") | r.get("PIEACK") | r.get("PIECTRL"), 0u);
}
} // namespace
