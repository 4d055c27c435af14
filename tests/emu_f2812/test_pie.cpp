/// PIE and the CPU's interrupt flow, row by row of the table in docs/f2812.md.
/// SPDX-License-Identifier: MIT
#include "rig.hpp"

namespace
{
/// Any PIE interrupt can be raised by its flag, as a program may; INT9.y here.
constexpr int SCIRXINTA = 96, SCITXINTA = 97;

TEST(pie, a_flag_that_is_enabled_sets_its_acknowledge_bit_and_ifr)
{
    rig r;
    r.quiet();
    r.put("PIEIFR9", 0x01);
    EXPECT_EQ(f2812_cpu(r.dsp)->ifr, 0u);
    EXPECT_EQ(r.get("PIEACK"), 0u);
    r.put("PIEIER9", 0x01);
    EXPECT_EQ(f2812_cpu(r.dsp)->ifr, 0x0100u);
    EXPECT_EQ(r.get("PIEACK"), 0x0100u);
    EXPECT_EQ(r.get("PIEIFR9"), 0x01u) << "until the vector is fetched";
}

TEST(pie, nothing_of_a_group_comes_until_it_is_acknowledged)
{
    rig r;
    r.quiet();
    r.listen();
    r.put("PIEIER9", 0x03);
    r.put("PIEIFR9", 0x01);
    f2812_context_t saved;
    EXPECT_EQ(f2812_take_interrupt(r.dsp, &saved), SCIRXINTA);
    EXPECT_EQ(r.get("PIEIFR9"), 0u);
    r.put("PIEIFR9", 0x02);
    f2812_iret(r.dsp, &saved);
    EXPECT_FALSE(f2812_interrupt_pending(r.dsp)) << "PIEACK.9 is set";
    EXPECT_EQ(r.get("PIEIFR9"), 0x02u) << "and the request waits";
    r.put("PIEACK", 0xFEFF);
    EXPECT_FALSE(f2812_interrupt_pending(r.dsp)) << "writing 0 acknowledges nothing";
    r.put("PIEACK", 0x0100);
    EXPECT_TRUE(f2812_interrupt_pending(r.dsp));
    EXPECT_EQ(r.take(), SCITXINTA);
}

TEST(pie, taking_an_interrupt_does_what_the_cpu_does)
{
    rig r;
    r.quiet();
    r.listen();
    f2812_set_ier(r.dsp, 0x0101);
    f2812_set_dbgm(r.dsp, false);
    f2812_set_eallow(r.dsp, true);
    r.put("PIEIER9", 0x01);
    r.put("PIEIFR9", 0x01);
    f2812_context_t saved;
    ASSERT_EQ(f2812_take_interrupt(r.dsp, &saved), SCIRXINTA);
    const f2812_cpu_t* const cpu = f2812_cpu(r.dsp);
    EXPECT_EQ(cpu->ifr, 0u);
    EXPECT_EQ(cpu->ier, 0x0001u) << "its own bit only";
    EXPECT_TRUE(cpu->intm);
    EXPECT_TRUE(cpu->dbgm);
    EXPECT_FALSE(cpu->eallow);
    EXPECT_EQ(r.get("PIECTRL"), 0x0DC1u) << "address of the vector, and ENPIE";
    f2812_set_ier(r.dsp, 0xFFFF); // lost with IRET
    f2812_iret(r.dsp, &saved);
    EXPECT_EQ(cpu->ier, 0x0101u);
    EXPECT_FALSE(cpu->intm);
    EXPECT_FALSE(cpu->dbgm);
    EXPECT_TRUE(cpu->eallow);
}
} // namespace
