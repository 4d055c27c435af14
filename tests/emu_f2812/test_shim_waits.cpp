/// Waiting costs nothing and changes nothing: runs with and without the turns of waiting loops, side by side.
#include "shim_board.hpp"

namespace
{
/// What can be seen of a run.
struct outcome
{
    std::vector<unsigned> results, vectors;
    std::vector<shim_board::access> writes;
    emu_time_t end;
    std::string why;
    f2812_shim_stats_t stats;
};

outcome run_case(int which, bool skip)
{
    const case_board b(which, skip);
    return {b.results, b.vectors, b.writes, b.sched.now, b.end(), *f2812_shim_stats(b.shim)};
}

/// The case with waiting loops passed over, after it was compared with the one that executes each turn.
outcome compared(int which)
{
    const outcome with = run_case(which, true);
    const outcome without = run_case(which, false);
    EXPECT_EQ(with.results, without.results);
    EXPECT_TRUE(with.writes == without.writes) << with.writes.size() << " and " << without.writes.size() << " writes";
    EXPECT_EQ(with.vectors, without.vectors);
    EXPECT_EQ(with.end, without.end);
    EXPECT_EQ(with.why, without.why);
    EXPECT_EQ(with.stats.turns, without.stats.turns);
    EXPECT_EQ(with.stats.accesses, without.stats.accesses);
    EXPECT_EQ(with.stats.blocks, without.stats.blocks);
    EXPECT_EQ(without.stats.skipped, 0u);
    return with;
}
} // namespace

TEST(shim_waits, loops_that_wait_are_passed_over_to_the_same_end)
{
    const outcome o = compared(CASE_WAITS);
    EXPECT_EQ(o.results, (std::vector<unsigned>{0x40, 0x41, 0x42, 0, 1, 2}));
    EXPECT_GT(o.stats.skipped, o.stats.turns / 2);
}

TEST(shim_waits, an_empty_loop_costs_nothing_between_interrupts)
{
    const outcome o = compared(CASE_FOREVER);
    EXPECT_EQ(o.stats.interrupts, o.vectors.size());
    EXPECT_GE(o.stats.interrupts, 49u);
    EXPECT_GT(o.stats.skipped, o.stats.turns / 100 * 99);
}

TEST(shim_waits, loops_that_count_store_or_call_are_not)
{
    const outcome o = compared(CASE_NOT_WAITS);
    ASSERT_EQ(o.results.size(), 8u);
    EXPECT_EQ(o.results[0], 2000u);
    EXPECT_EQ(o.why, "ESTOP0");
}

TEST(shim_waits, the_programs_send_the_same_bits_at_the_same_instants)
{
    for (const f2812_program_t* const program : {&f2812_program_echo, &f2812_program_autobaud, &f2812_program_modem})
    {
        std::vector<shim_board::access> log[2];
        std::string heard[2];
        for (const bool skip : {true, false})
        {
            shim_board b(*program, skip);
            host a(b, "SCIRXDA", "SCITXDA", program == &f2812_program_modem ? 115200 : 9600);
            b.run(EMU_PS_PER_S / 50);
            a.send("ARE YOU THERE?");
            b.run(EMU_PS_PER_S / 50);
            log[skip] = b.writes;
            heard[skip] = a.octets;
            EXPECT_EQ(f2812_shim_stats(b.shim)->skipped > 0, skip && program != &f2812_program_modem) << program->name;
        }
        EXPECT_TRUE(log[0] == log[1]) << program->name;
        EXPECT_EQ(heard[0], heard[1]);
        EXPECT_FALSE(heard[0].empty()) << program->name;
    }
}
