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

TEST(pie, intm_and_ier_hold_an_interrupt_back)
{
    rig r;
    r.quiet();
    r.listen();
    r.put("PIEIER9", 0x01);
    f2812_set_intm(r.dsp, true);
    r.put("PIEIFR9", 0x01);
    EXPECT_FALSE(f2812_interrupt_pending(r.dsp));
    EXPECT_EQ(r.take(), F2812_NO_VECTOR);
    f2812_set_ier(r.dsp, 0x3EFF);
    f2812_set_intm(r.dsp, false);
    EXPECT_FALSE(f2812_interrupt_pending(r.dsp));
    f2812_set_ier(r.dsp, 0x0100);
    EXPECT_EQ(r.take(), SCIRXINTA);
}

TEST(pie, a_bit_of_ifr_is_cleared_by_writing_0_and_set_by_writing_1)
{
    rig r;
    r.quiet();
    r.listen();
    f2812_set_intm(r.dsp, true);
    r.put("PIEIER9", 0x01);
    r.put("PIEIFR9", 0x01);
    f2812_set_ifr(r.dsp, 0);
    f2812_set_intm(r.dsp, false);
    EXPECT_FALSE(f2812_interrupt_pending(r.dsp)) << "the request is lost, its flag stays";
    EXPECT_EQ(r.get("PIEIFR9"), 0x01u);
    f2812_set_ifr(r.dsp, 0x2000); // INT14
    EXPECT_EQ(r.take(), F2812_VECTOR_INT14);
}

TEST(pie, of_one_group_the_lowest_comes_first_at_the_moment_of_the_fetch)
{
    rig r;
    r.quiet();
    r.listen();
    f2812_set_intm(r.dsp, true);
    r.put("PIEIER9", 0x0F);
    r.put("PIEIFR9", 0x08); // SCITXINTB is sent to the CPU
    r.put("PIEIFR9", 0x09); // then SCIRXINTA is flagged
    f2812_set_intm(r.dsp, false);
    EXPECT_EQ(r.serve(), (std::vector<int>{96, 99}));
}

TEST(pie, of_several_groups_the_lowest_comes_first)
{
    rig r;
    r.quiet();
    r.listen();
    f2812_set_intm(r.dsp, true);
    for (const char* group : {"12", "9", "5", "2"})
    {
        r.put((std::string("PIEIER") + group).c_str(), 0x80);
        r.put((std::string("PIEIFR") + group).c_str(), 0x80);
    }
    f2812_set_ifr(r.dsp, static_cast<uint16_t>(f2812_cpu(r.dsp)->ifr | 0x1000)); // INT13
    f2812_set_intm(r.dsp, false);
    EXPECT_EQ(r.serve(), (std::vector<int>{47, 71, 103, 127, 13}));
}

/// The program clears the enable bit between the request and the fetch.
TEST(pie, an_enable_that_disappears_gives_the_first_vector_of_the_group)
{
    rig r;
    r.quiet();
    r.listen();
    f2812_set_intm(r.dsp, true);
    r.put("PIEIER9", 0x02);
    r.put("PIEIFR9", 0x02);
    r.put("PIEIER9", 0x00);
    f2812_set_intm(r.dsp, false);
    EXPECT_EQ(r.take(), SCIRXINTA);
    EXPECT_EQ(r.get("PIEIFR9"), 0x02u) << "no flag is cleared";
}

/// What TI's examples do by PieCtrlRegs.PIEACK.all |= x: the read gives 1 for each group that waits, and the write acknowledges them all.
TEST(pie, reading_and_writing_back_pieack_acknowledges_every_group)
{
    rig r;
    r.quiet();
    r.put("PIEIER1", 0x40);
    r.put("PIEIFR1", 0x40);
    r.put("PIEIER9", 0x01);
    r.put("PIEIFR9", 0x01);
    EXPECT_EQ(r.get("PIEACK"), 0x0101u);
    f2812_set_ifr(r.dsp, 0);
    r.put("PIEIFR1", 0);
    r.put("PIEIFR9", 0);
    r.put("PIEACK", r.get("PIEACK") | 0x0100);
    EXPECT_EQ(r.get("PIEACK"), 0u);
}

TEST(pie, acknowledging_sends_what_waits_at_once)
{
    rig r;
    r.quiet();
    r.put("PIEIER9", 0x03);
    r.put("PIEIFR9", 0x03);
    f2812_set_ifr(r.dsp, 0);
    r.put("PIEACK", 0x0100);
    EXPECT_EQ(f2812_cpu(r.dsp)->ifr, 0x0100u);
    EXPECT_EQ(r.get("PIEACK"), 0x0100u) << "set again";
}

TEST(pie, with_enpie_0_no_interrupt_is_taken_and_it_is_told_once)
{
    rig r;
    r.quiet();
    r.listen();
    r.put("PIECTRL", 0);
    r.put("PIEIER9", 0x01);
    r.put("PIEIFR9", 0x01);
    EXPECT_FALSE(f2812_interrupt_pending(r.dsp));
    f2812_set_intm(r.dsp, false);
    ASSERT_EQ(r.reports.size(), 1u);
    EXPECT_EQ(r.reports[0].kind, EMU_NOT_MODELLED);
    EXPECT_NE(r.reports[0].text.find("ENPIE"), std::string::npos);
    r.put("PIECTRL", 1);
    EXPECT_EQ(r.take(), SCIRXINTA);
}

TEST(pie, registers_hold_eight_bits_and_the_vector_cannot_be_written)
{
    rig r;
    r.put("PIECTRL", 0xFFFF);
    EXPECT_EQ(r.get("PIECTRL"), 0x0001u);
    r.put("PIEIER12", 0xFFFF);
    EXPECT_EQ(r.get("PIEIER12"), 0x00FFu);
    r.put("PIEIFR11", 0xFFFF);
    EXPECT_EQ(r.get("PIEIFR11"), 0x00FFu);
}

/// With PIEACK clear again inside the handler another group may come once the program has cleared INTM.
TEST(pie, a_handler_that_lets_interrupts_in_is_interrupted)
{
    rig r;
    r.quiet();
    r.listen();
    r.put("PIEIER9", 0x01);
    r.put("PIEIER1", 0x40);
    r.put("PIEIFR9", 0x01);
    f2812_context_t outer, inner;
    ASSERT_EQ(f2812_take_interrupt(r.dsp, &outer), SCIRXINTA);
    r.put("PIEIFR1", 0x40);
    EXPECT_FALSE(f2812_interrupt_pending(r.dsp));
    f2812_set_intm(r.dsp, false);
    ASSERT_EQ(f2812_take_interrupt(r.dsp, &inner), 38);
    EXPECT_EQ(f2812_cpu(r.dsp)->ier, 0x3EFEu);
    f2812_iret(r.dsp, &inner);
    EXPECT_EQ(f2812_cpu(r.dsp)->ier, 0x3EFFu);
    f2812_iret(r.dsp, &outer);
    EXPECT_EQ(f2812_cpu(r.dsp)->ier, 0x3FFFu);
}
} // namespace
