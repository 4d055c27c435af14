/// Passing of time: events at their cycle, waiting, IDLE.
/// SPDX-License-Identifier: MIT
#include "rig.hpp"

namespace
{
struct noted
{
    emu_event_t event{};
    f2812_t* dsp = nullptr;
    std::vector<std::pair<emu_time_t, uint64_t>> fired; ///< instant, cycle
    static void fire(void* ctx, emu_time_t at)
    {
        noted* const self = static_cast<noted*>(ctx);
        self->fired.emplace_back(at, f2812_cycle(self->dsp));
    }
    void set(rig& r, emu_time_t at)
    {
        dsp = r.dsp;
        event.fire = fire;
        event.ctx = this;
        emu_sched_at(&r.sched, &event, at);
    }
};

/// A cycle is 66 666.67 ps.
TEST(device, an_event_fires_at_its_instant_and_is_seen_by_the_first_cycle_from_there_on)
{
    rig r;
    r.quiet();
    noted n;
    n.set(r, 200001);
    r.pass(3);
    EXPECT_EQ(f2812_now(r.dsp), 200000);
    EXPECT_TRUE(n.fired.empty());
    r.pass(1);
    EXPECT_EQ(n.fired, (std::vector<std::pair<emu_time_t, uint64_t>>{{200001, 4}}));
    n.set(r, 400000);
    r.pass(100);
    EXPECT_EQ(n.fired.back(), (std::pair<emu_time_t, uint64_t>{400000, 6}));
    EXPECT_EQ(f2812_cycle(r.dsp), 104u);
}

TEST(device, waiting_goes_to_the_next_event_or_to_the_limit)
{
    rig r;
    r.quiet();
    noted n;
    n.set(r, EMU_PS_PER_S);
    EXPECT_EQ(f2812_skip(r.dsp, EMU_PS_PER_S / 2), EMU_PS_PER_S / 2);
    EXPECT_TRUE(n.fired.empty());
    EXPECT_EQ(f2812_skip(r.dsp, 2 * EMU_PS_PER_S), EMU_PS_PER_S);
    EXPECT_EQ(n.fired.size(), 1u);
    EXPECT_EQ(f2812_cycle(r.dsp), 15000000u);
    f2812_set_ifr(r.dsp, 0x1000);
    r.listen();
    EXPECT_EQ(f2812_skip(r.dsp, 2 * EMU_PS_PER_S), EMU_PS_PER_S) << "not while an interrupt is pending";
}

TEST(device, a_limit_between_two_cycles_is_passed_by_less_than_one)
{
    rig r;
    r.quiet();
    const emu_time_t now = f2812_skip(r.dsp, 100000);
    EXPECT_EQ(now, 133333);
    EXPECT_EQ(f2812_cycle(r.dsp), 2u);
}

TEST(device, idle_ends_with_an_interrupt_that_ier_lets_through)
{
    rig r;
    r.quiet();
    r.put("TIMER1PRD", 999);
    r.put("TIMER1TCR", 0x4020);
    r.put("TIMER2PRD", 2999);
    r.put("TIMER2TCR", 0x4020);
    f2812_set_ier(r.dsp, 0x2000); // INT14, with INTM = 1
    EXPECT_EQ(f2812_idle(r.dsp, EMU_PS_PER_S), exact(2999, 15000000));
    EXPECT_EQ(f2812_cpu(r.dsp)->ifr, 0x3000u) << "INT13 did not end it";
    EXPECT_EQ(f2812_idle(r.dsp, EMU_PS_PER_S), exact(2999, 15000000)) << "nor does it begin with one there";
    f2812_set_ier(r.dsp, 0);
    EXPECT_EQ(f2812_idle(r.dsp, EMU_PS_PER_S), EMU_PS_PER_S) << "up to the limit";
    EXPECT_TRUE(r.reports.empty());
    r.put_guarded("LPMCR0", 1);
    (void)f2812_idle(r.dsp, EMU_PS_PER_S);
    ASSERT_EQ(r.reports.size(), 1u);
    EXPECT_EQ(r.reports[0].kind, EMU_NOT_MODELLED);
}

TEST(device, idle_ends_with_a_reset)
{
    rig r;
    const emu_time_t at = f2812_idle(r.dsp, EMU_PS_PER_S);
    EXPECT_EQ(at, exact(256 * 512, rig::OSC_HZ)) << "by the watchdog";
    EXPECT_EQ(r.take(), F2812_VECTOR_RESET);
}

TEST(device, leaves_no_event_behind)
{
    emu_sched_t sched;
    emu_sched_init(&sched);
    f2812_config_t config;
    f2812_default_config(&config);
    f2812_t* const dsp = f2812_create(&config, &sched);
    ASSERT_NE(dsp, nullptr);
    f2812_set_eallow(dsp, true);
    f2812_write(dsp, rig::at("PCLKCR"), 0x0C00);
    f2812_write(dsp, rig::at("PLLCR"), 10);
    f2812_advance(dsp, 2);
    f2812_write(dsp, rig::at("TIMER0TCR"), 0x4020);
    f2812_write(dsp, rig::at("SCICCRA"), 0x07);
    f2812_write(dsp, rig::at("SCICTL1A"), 0x22);
    f2812_write(dsp, rig::at("SCITXBUFA"), 0x55);
    EXPECT_NE(sched.head, nullptr);
    f2812_destroy(dsp);
    EXPECT_EQ(sched.head, nullptr);
    f2812_destroy(nullptr);
}

TEST(device, is_created_at_any_instant)
{
    emu_sched_t sched;
    emu_sched_init(&sched);
    emu_sched_advance(&sched, 3 * EMU_PS_PER_S);
    f2812_config_t config;
    f2812_default_config(&config);
    f2812_t* const dsp = f2812_create(&config, &sched);
    EXPECT_EQ(f2812_now(dsp), 3 * EMU_PS_PER_S);
    f2812_advance(dsp, 256 * 256 - 1);
    EXPECT_FALSE(f2812_in_reset(dsp));
    f2812_advance(dsp, 1);
    EXPECT_TRUE(f2812_in_reset(dsp)) << "the watchdog counts from there";
    f2812_destroy(dsp);
}

/// The same program twice, with everything that moves by itself: the same instants.
TEST(device, two_runs_are_equal)
{
    const auto run = []
    {
        rig r;
        r.listen();
        r.put("PIEIER1", 0xFF);
        r.put_guarded("SCSR", 2);
        r.put_guarded("PLLCR", 9);
        r.put("TIMER0PRD", 7777);
        r.put("TIMER0TCR", 0x4020);
        std::vector<std::pair<int, emu_time_t>> taken;
        while (f2812_now(r.dsp) < EMU_PS_PER_S / 50 && !::testing::Test::HasFailure())
        {
            f2812_skip(r.dsp, EMU_PS_PER_S / 50);
            for (const int vector : r.serve())
            {
                taken.emplace_back(vector, f2812_now(r.dsp));
            }
        }
        return taken;
    };
    const auto first = run();
    EXPECT_GT(first.size(), 200u);
    EXPECT_EQ(first, run());
}
} // namespace
