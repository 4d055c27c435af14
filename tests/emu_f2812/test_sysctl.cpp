/// Clock tree: PLLCR, lock time, LOSPCP, crystal error; instants against integer arithmetic of the test's own.
/// SPDX-License-Identifier: MIT
#include "rig.hpp"

namespace
{
constexpr uint64_t LOCK = 131072; ///< OSCCLK

/// SYSCLKOUT at OSCCLK / 2 up to the end of the lock, PLLCR written at cycle 0.
constexpr uint64_t LOCK_CYCLES = LOCK / 2;

TEST(sysctl, pllcr_multiplies_once_it_has_locked)
{
    for (unsigned div = 1; div <= 10; div++)
    {
        rig r;
        r.quiet();
        r.put_guarded("PLLCR", div);
        EXPECT_EQ(r.get("PLLCR"), div);
        r.pass(LOCK_CYCLES);
        EXPECT_EQ(f2812_now(r.dsp), exact(LOCK, rig::OSC_HZ)) << "OSCCLK / 2 while it locks";
        r.pass(15000001);
        EXPECT_EQ(f2812_now(r.dsp), exact(LOCK * div + 2 * 15000001, rig::OSC_HZ * div)) << div;
        EXPECT_TRUE(r.reports.empty());
    }
}

TEST(sysctl, before_and_after_the_bypass_sysclkout_is_half_of_oscclk)
{
    rig r;
    r.quiet();
    r.pass(15000);
    EXPECT_EQ(f2812_now(r.dsp), 1000 * EMU_PS_PER_US);
    r.put_guarded("PLLCR", 10);
    r.pass(LOCK_CYCLES + 150);
    const emu_time_t bypass = f2812_now(r.dsp);
    r.put_guarded("PLLCR", 0);
    r.pass(15);
    EXPECT_EQ(f2812_now(r.dsp), bypass + EMU_PS_PER_US) << "at once";
}

TEST(sysctl, another_write_begins_the_lock_anew_and_the_same_value_does_not)
{
    rig r;
    r.quiet();
    r.put_guarded("PLLCR", 10);
    r.pass(10000);
    r.put_guarded("PLLCR", 8);
    r.pass(10000);
    r.put_guarded("PLLCR", 8);
    r.pass(LOCK_CYCLES - 10000);
    EXPECT_EQ(f2812_now(r.dsp), exact(20000 + LOCK, rig::OSC_HZ));
    r.pass(120);
    EXPECT_EQ(f2812_now(r.dsp), exact(20000 + LOCK + 30, rig::OSC_HZ)) << "120 MHz";
}

TEST(sysctl, a_reserved_multiplier_is_refused_and_more_than_150_mhz_is_told)
{
    for (unsigned div = 11; div <= 15; div++)
    {
        rig r;
        r.put_guarded("PLLCR", div);
        EXPECT_EQ(r.get("PLLCR"), 0u);
        ASSERT_EQ(r.reports.size(), 1u) << div;
        EXPECT_EQ(r.reports[0].kind, EMU_GUEST_ERROR);
    }
    rig fast({}, 40000000);
    fast.put_guarded("PLLCR", 7);
    EXPECT_TRUE(fast.reports.empty()) << "140 MHz";
    fast.put_guarded("PLLCR", 8);
    ASSERT_EQ(fast.reports.size(), 1u);
    EXPECT_NE(fast.reports[0].text.find("150 MHz"), std::string::npos);
}

TEST(sysctl, crystals_that_there_are_not_are_refused)
{
    for (const uint64_t hz : {UINT64_C(0), F2812_OSCCLK_HZ_MIN - 1, F2812_OSCCLK_HZ_MAX + 1})
    {
        EXPECT_EQ(rig({}, hz).dsp, nullptr) << hz;
    }
    EXPECT_NE(rig({}, F2812_OSCCLK_HZ_MAX).dsp, nullptr);
}

TEST(sysctl, a_crystal_that_is_off_takes_every_clock_along_from_its_cycle_on)
{
    constexpr int32_t PPB = -200000;
    rig r;
    r.quiet();
    r.pass(150);
    f2812_set_osc_ppb(r.dsp, PPB);
    r.put_guarded("PLLCR", 10);
    r.pass(LOCK_CYCLES);
    const double lock_ps = 1e12 * LOCK / (30e6 * (1 + PPB * 1e-9));
    EXPECT_NEAR(static_cast<double>(f2812_now(r.dsp)), 10e6 + lock_ps, 2e5) << "the lock is counted in OSCCLK";
    const emu_time_t from = f2812_now(r.dsp);
    r.pass(150000000);
    EXPECT_NEAR(static_cast<double>(f2812_now(r.dsp) - from), 1e12 / (1 + PPB * 1e-9), 1.0);
}

/// Instants of edges on SCITXDA while the program sends 55h: one edge a bit.
struct sender : rig
{
    std::vector<emu_time_t> edges;
    sender()
    {
        quiet();
        (void)emu_wire_watch(
            f2812_wire(dsp, "SCITXDA"),
            [](void* ctx, bool, emu_time_t at) { static_cast<sender*>(ctx)->edges.push_back(at); }, this);
        put_guarded("PCLKCR", 0x0400);
        put_guarded("GPFMUX", 0x0030);
        pass(2);
        put("SCICCRA", 0x07);
        put("SCICTL1A", 0x02);
        put("SCILBAUDA", 0xF3);
        put("SCICTL1A", 0x22);
    }
    emu_time_t bit()
    {
        edges.clear();
        put("SCITXBUFA", 0x55);
        for (unsigned i = 0; i < 20 && edges.size() < 10; i++)
        {
            f2812_skip(dsp, EMU_TIME_MAX / 4);
        }
        EXPECT_EQ(edges.size(), 10u);
        return edges[5] - edges[4];
    }
};

TEST(sysctl, a_word_goes_out_behind_its_write_however_long_nothing_was_due_before_it)
{
    static constexpr uint64_t CYCLES = 1000003;
    sender s;
    const emu_time_t from = f2812_now(s.dsp);
    s.pass(CYCLES);
    const emu_time_t bit = s.bit(), written = from + exact(CYCLES, rig::OSC_HZ / 2);
    EXPECT_GT(s.edges[0], written);
    EXPECT_LT(s.edges[0], written + bit);
}

TEST(sysctl, lospcp_divides_what_the_sci_is_clocked_with)
{
    for (unsigned n = 0; n <= 7; n++)
    {
        sender s;
        s.put_guarded("LOSPCP", n);
        const double lspclk = 15e6 / (n == 0 ? 1 : 2 * n);
        EXPECT_NEAR(static_cast<double>(s.bit()), 1e12 * 1952 / lspclk, 1.0) << n;
    }
}

/// The thesis's 19200 Bd: LSPCLK 37.5 MHz, BRR F3h. While the PLL locks LSPCLK is 3.75 MHz, and so is the baud a tenth.
TEST(sysctl, the_baud_is_wrong_while_the_pll_locks)
{
    sender s;
    s.put_guarded("PLLCR", 10);
    EXPECT_NEAR(static_cast<double>(s.bit()), 1e12 * 19520 / 37.5e6, 1.0) << "1921 Bd";
    s.pass_until(exact(LOCK, rig::OSC_HZ) + EMU_PS_PER_US);
    EXPECT_NEAR(static_cast<double>(s.bit()), 1e12 * 1952 / 37.5e6, 1.0);
}

TEST(sysctl, a_frame_that_is_under_way_goes_on_at_the_new_rate)
{
    sender s;
    s.put("SCITXBUFA", 0x55);
    while (s.edges.size() < 3)
    {
        f2812_skip(s.dsp, EMU_TIME_MAX / 4);
    }
    s.put_guarded("LOSPCP", 1); // twice as fast
    while (s.edges.size() < 10)
    {
        f2812_skip(s.dsp, EMU_TIME_MAX / 4);
    }
    EXPECT_EQ(s.edges[2] - s.edges[1], exact(1952, 3750000));
    EXPECT_NEAR(static_cast<double>(s.edges[5] - s.edges[4]), 1e12 * 1952 / 7.5e6, 1.0);
    EXPECT_NEAR(static_cast<double>(s.edges[9] - s.edges[8]), 1e12 * 1952 / 7.5e6, 1.0);
}
} // namespace
