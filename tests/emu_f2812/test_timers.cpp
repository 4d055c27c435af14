/// CPU timers: counting, reload, interrupts.
/// SPDX-License-Identifier: MIT
#include "rig.hpp"

namespace
{
constexpr unsigned TIF = 0x8000, TIE = 0x4000, TRB = 0x20, TSS = 0x10;
constexpr int TINT0 = 38;

std::string of(unsigned n, const char* what)
{
    return "TIMER" + std::to_string(n) + what;
}

/// Counter stopped and loaded.
void load(rig& r, unsigned n, uint32_t period, uint32_t divide_down)
{
    r.put(of(n, "TCR").c_str(), TSS);
    r.put(of(n, "PRD").c_str(), period & 0xFFFF);
    r.put(of(n, "PRDH").c_str(), period >> 16);
    r.put(of(n, "TPR").c_str(), divide_down & 0xFF);
    r.put(of(n, "TPRH").c_str(), divide_down >> 8);
    r.put(of(n, "TCR").c_str(), TSS | TRB);
}

uint32_t counter(rig& r, unsigned n)
{
    return r.get(of(n, "TIM").c_str()) | r.get(of(n, "TIMH").c_str()) << 16;
}

TEST(timers, count_down_every_tddr_plus_1_cycles_and_reload_one_tick_after_zero)
{
    for (unsigned n = 0; n < 3; n++)
    {
        for (const uint32_t div : {0u, 1u, 3u, 300u})
        {
            rig r;
            r.quiet();
            load(r, n, 5, div);
            EXPECT_EQ(counter(r, n), 5u);
            r.put(of(n, "TCR").c_str(), 0);
            for (unsigned tick = 0; tick < 20; tick++)
            {
                EXPECT_EQ(counter(r, n), 5 - tick % 6) << n << ' ' << div << ' ' << tick;
                r.pass(div);
                EXPECT_EQ(counter(r, n), 5 - tick % 6) << n << ' ' << div << ' ' << tick;
                EXPECT_EQ(r.get(of(n, "TPR").c_str()) >> 8, 0u) << "PSC";
                r.pass(1);
            }
        }
    }
}

TEST(timers, the_prescale_counter_can_be_watched)
{
    rig r;
    r.quiet();
    load(r, 1, 100, 0x0203);
    EXPECT_EQ(r.get("TIMER1TPR"), 0x0303u);
    EXPECT_EQ(r.get("TIMER1TPRH"), 0x0202u);
    r.put("TIMER1TCR", 0);
    r.pass(4);
    EXPECT_EQ(r.get("TIMER1TPR"), 0xFF03u);
    EXPECT_EQ(r.get("TIMER1TPRH"), 0x0102u);
}

TEST(timers, a_counter_of_32_bits_wraps_into_its_high_word)
{
    rig r;
    r.quiet();
    load(r, 2, 0x00020001, 0);
    r.put("TIMER2TCR", 0);
    r.pass(3);
    EXPECT_EQ(counter(r, 2), 0x0001FFFEu);
    r.put("TIMER2TIM", 0x1234);
    EXPECT_EQ(counter(r, 2), 0x00011234u);
    r.put("TIMER2TIMH", 0xABCD);
    r.pass(0x1235);
    EXPECT_EQ(counter(r, 2), 0xABCCFFFFu);
}

TEST(timers, zero_sets_tif_which_is_cleared_by_writing_1)
{
    rig r;
    r.quiet();
    load(r, 0, 3, 0);
    r.put("TIMER0TCR", 0);
    r.pass(2);
    EXPECT_EQ(r.get("TIMER0TCR"), 0u);
    r.pass(1);
    EXPECT_EQ(counter(r, 0), 0u);
    EXPECT_EQ(r.get("TIMER0TCR"), TIF);
    r.put("TIMER0TCR", 0);
    EXPECT_EQ(r.get("TIMER0TCR"), TIF) << "writing 0 leaves it";
    r.put("TIMER0TCR", TIF);
    EXPECT_EQ(r.get("TIMER0TCR"), 0u);
    r.pass(3);
    EXPECT_EQ(r.get("TIMER0TCR"), 0u);
    r.pass(1);
    EXPECT_EQ(r.get("TIMER0TCR"), TIF) << "PRD + 1 ticks later";
}

TEST(timers, tss_stops_and_trb_reads_0)
{
    rig r;
    r.quiet();
    load(r, 0, 1000, 1);
    r.put("TIMER0TCR", TRB);
    EXPECT_EQ(r.get("TIMER0TCR"), 0u);
    r.pass(21);
    r.put("TIMER0TCR", TSS);
    EXPECT_EQ(counter(r, 0), 990u);
    r.pass(1000);
    EXPECT_EQ(counter(r, 0), 990u);
    r.put("TIMER0TCR", 0);
    r.pass(1);
    EXPECT_EQ(counter(r, 0), 989u) << "the half tick was kept";
}

TEST(timers, interrupt_at_each_zero_with_tie)
{
    const int vector[3] = {TINT0, F2812_VECTOR_INT13, F2812_VECTOR_INT14};
    for (unsigned n = 0; n < 3; n++)
    {
        rig r;
        r.quiet();
        r.listen();
        r.put("PIEIER1", 0x40);
        load(r, n, 149, 9);
        r.put(of(n, "TCR").c_str(), TIE);
        r.pass(1489);
        EXPECT_FALSE(f2812_interrupt_pending(r.dsp)) << n;
        r.pass(1);
        EXPECT_EQ(r.serve(), (std::vector<int>{vector[n]})) << "TIF is still set";
        r.pass(1499);
        EXPECT_FALSE(f2812_interrupt_pending(r.dsp)) << n;
        r.pass(1);
        EXPECT_EQ(r.serve(), (std::vector<int>{vector[n]}));
        r.put(of(n, "TCR").c_str(), 0);
        r.pass(3000);
        EXPECT_FALSE(f2812_interrupt_pending(r.dsp)) << "TIE is 0";
    }
}

/// The waiting program comes to each zero at its very cycle.
TEST(timers, interrupts_come_at_their_cycle_over_a_change_of_rate)
{
    rig r;
    r.quiet();
    r.listen();
    load(r, 2, 99999, 0);
    r.put_guarded("PLLCR", 10);
    r.put("TIMER2TCR", TIE);
    for (unsigned k = 1; k <= 20; k++)
    {
        while (!f2812_interrupt_pending(r.dsp))
        {
            f2812_skip(r.dsp, EMU_TIME_MAX / 4);
        }
        EXPECT_EQ(f2812_cycle(r.dsp), 100000 * k - 1);
        EXPECT_EQ(r.serve(), (std::vector<int>{F2812_VECTOR_INT14}));
    }
    EXPECT_EQ(f2812_now(r.dsp), exact(655360 + 1999999 - 65536, 150000000));
}

TEST(timers, a_period_of_0_interrupts_every_tick)
{
    rig r;
    r.quiet();
    r.listen();
    load(r, 1, 0, 9);
    r.put("TIMER1TCR", TIE);
    r.pass(9);
    EXPECT_FALSE(f2812_interrupt_pending(r.dsp));
    for (unsigned k = 0; k < 5; k++)
    {
        r.pass(1);
        EXPECT_EQ(r.serve(), (std::vector<int>{F2812_VECTOR_INT13}));
        r.pass(9);
    }
}
} // namespace
