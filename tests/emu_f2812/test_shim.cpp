/// The shim: what compiled firmware does to registers, interrupts, reset and time (F2812_SCI.md, section 2).
#include "shim_board.hpp"
#include <algorithm>

using values = std::vector<unsigned>;

TEST(shim, registers_are_written_as_their_fields_say)
{
    const case_board b(CASE_FIELDS);
    EXPECT_EQ(b.results, (values{0xA2, 0xE2, 0xEA, 0x6A, 19, 16, 0x1234, 0x5678, 0x5C}));
    EXPECT_EQ(b.end(), "ESTOP0");
    EXPECT_TRUE(b.reports.empty());
}

TEST(shim, an_interrupt_never_comes_between_read_and_write_of_one_statement)
{
    EXPECT_EQ(case_board(CASE_ATOMIC).results, (values{1, 1}));
}

TEST(shim, ier_ifr_and_intm_are_the_cpus)
{
    const case_board b(CASE_IER);
    EXPECT_EQ(b.results, (values{0x0106, 0, 0, 1, 0, 1}));
}

TEST(shim, the_vector_table_is_written_under_eallow_alone)
{
    const case_board b(CASE_EALLOW);
    EXPECT_EQ(b.results, (values{0, 1})) << "the first function went on being called";
    ASSERT_EQ(b.reports.size(), 2u) << "one a word";
    EXPECT_EQ(b.reports[0].kind, EMU_GUEST_ERROR);
    EXPECT_EQ(b.reports[0].address, 0x0D4Cu) << "TINT0, entry 38";
}

TEST(shim, an_interrupt_function_lets_another_in)
{
    const case_board b(CASE_NESTED);
    ASSERT_GE(b.vectors.size(), 2u);
    EXPECT_EQ(b.vectors[0], 97u) << "SCITXINTA";
    EXPECT_EQ(b.vectors[1], 38u) << "TINT0, inside it";
    ASSERT_EQ(b.results.size(), 2u);
    EXPECT_GT(b.results[0], 100u);
}

TEST(shim, an_interrupt_without_a_function_ends_the_run_with_a_guest_error)
{
    const case_board b(CASE_NO_FUNCTION);
    EXPECT_EQ(b.end(), "interrupt without a function");
    ASSERT_EQ(b.reports.size(), 1u);
    EXPECT_EQ(b.reports[0].kind, EMU_GUEST_ERROR);
    EXPECT_EQ(b.reports[0].address, 38u);
}

TEST(shim, an_instruction_that_is_not_known_is_reported_and_the_others_are_done)
{
    const case_board b(CASE_ASM);
    EXPECT_EQ(b.results, (values{7}));
    ASSERT_EQ(b.reports.size(), 1u);
    EXPECT_EQ(b.reports[0].kind, EMU_NOT_MODELLED);
    EXPECT_EQ(b.reports[0].text, " MOV AL, #1");
    EXPECT_FALSE(f2812_cpu(b.dsp)->intm);
    EXPECT_FALSE(f2812_cpu(b.dsp)->dbgm);
}

TEST(shim, returning_from_main_ends_the_run_and_time_goes_on_without_it)
{
    case_board b(CASE_RETURN);
    EXPECT_EQ(b.end(), "main() returned");
    const emu_time_t later = b.sched.now + EMU_PS_PER_S;
    EXPECT_EQ(f2812_shim_run(b.shim, later), F2812_ENDED);
    EXPECT_GE(b.sched.now, later);
}

TEST(shim, a_watchdog_reset_starts_main_with_the_variables_as_loaded)
{
    const case_board b(CASE_DOG, true, EMU_PS_PER_S / 20);
    const f2812_shim_stats_t* const s = f2812_shim_stats(b.shim);
    ASSERT_GE(s->starts, 3u);
    ASSERT_EQ(b.results.size(), 2 * s->starts);
    for (size_t i = 0; i < b.results.size(); i += 2)
    {
        EXPECT_EQ(b.results[i], 6u) << "start " << i / 2;
        EXPECT_EQ(b.results[i + 1], i > 0 ? 1u : 0u) << "WDFLAG, start " << i / 2;
    }
}

TEST(shim, xrs_holds_the_firmware_and_starts_it_anew)
{
    case_board b(CASE_FOREVER, true, EMU_PS_PER_S / 100);
    emu_wire_t* const xrs = f2812_wire(b.dsp, "XRS");
    const int driver = emu_wire_add_driver(xrs);
    emu_wire_drive(xrs, driver, EMU_STRONG0, b.sched.now);
    const uint64_t before = f2812_shim_stats(b.shim)->blocks;
    EXPECT_EQ(b.run(EMU_PS_PER_S / 100), F2812_REACHED);
    EXPECT_EQ(f2812_shim_stats(b.shim)->starts, 1u);
    EXPECT_LE(f2812_shim_stats(b.shim)->blocks, before + 1);
    emu_wire_drive(xrs, driver, EMU_Z, b.sched.now);
    EXPECT_EQ(b.run(EMU_PS_PER_S / 1000), F2812_REACHED) << "sooner than the watchdog";
    EXPECT_EQ(f2812_shim_stats(b.shim)->starts, 2u);
}

TEST(shim, a_run_stops_at_exactly_the_instant_asked_for)
{
    case_board b(CASE_FOREVER, true, 0);
    for (const emu_time_t t : {emu_time_t{1}, emu_time_t{999999}, emu_time_t{1000001}, EMU_PS_PER_S / 100 + 7})
    {
        EXPECT_EQ(f2812_shim_run(b.shim, t), F2812_REACHED);
        EXPECT_EQ(b.sched.now, t);
    }
}

TEST(shim, all_that_is_due_at_the_instant_has_happened)
{
    struct two
    {
        emu_sched_t* sched;
        emu_event_t first, second;
        bool happened;
    };
    case_board b(CASE_FOREVER, true, 0);
    two t{&b.sched, {}, {}, false};
    t.second.fire = [](void* ctx, emu_time_t) { static_cast<two*>(ctx)->happened = true; };
    t.first.fire = [](void* ctx, emu_time_t at)
    {
        auto* const both = static_cast<two*>(ctx);
        emu_sched_at(both->sched, &both->second, at);
    };
    t.first.ctx = t.second.ctx = &t;
    emu_sched_at(&b.sched, &t.first, EMU_PS_PER_S / 1000);
    EXPECT_EQ(f2812_shim_run(b.shim, EMU_PS_PER_S / 1000), F2812_REACHED);
    EXPECT_TRUE(t.happened) << "set at the instant itself";
}

TEST(shim, windows_of_any_length_give_the_same_run)
{
    std::vector<shim_board::access> writes;
    std::vector<unsigned> vectors;
    uint64_t turns = 0;
    {
        const case_board whole(CASE_WAITS);
        writes = whole.writes;
        vectors = whole.vectors;
        turns = f2812_shim_stats(whole.shim)->turns;
        EXPECT_EQ(whole.end(), "ESTOP0");
    }
    case_board parts(CASE_WAITS, true, 0);
    uint64_t seed = 2812;
    while (f2812_shim_run(parts.shim, parts.sched.now + 1 + static_cast<emu_time_t>(emu_random(&seed) % 3000000)) !=
           F2812_ENDED)
    {
    }
    EXPECT_EQ(parts.end(), "ESTOP0");
    EXPECT_TRUE(writes == parts.writes);
    EXPECT_EQ(vectors, parts.vectors);
    EXPECT_EQ(turns, f2812_shim_stats(parts.shim)->turns);
}

TEST(shim, a_program_has_one_shim)
{
    const case_board b(CASE_RETURN);
    EXPECT_EQ(f2812_shim_create(b.dsp, nullptr, &f2812_program_cases, nullptr), nullptr);
}

TEST(shim, a_break_comes_right_after_the_access_that_asks_for_it)
{
    case_board b(CASE_FIELDS, true, 0);
    b.break_at = rig::at("TIMER2PRD");
    EXPECT_EQ(b.run(EMU_PS_PER_S), F2812_BROKEN);
    EXPECT_EQ(b.results.size(), 6u) << "and not one result more";
    b.break_at = 0;
    EXPECT_EQ(b.run(EMU_PS_PER_S), F2812_ENDED);
    EXPECT_EQ(b.results.size(), 9u);
}

TEST(shim, idle_waits_for_an_interrupt)
{
    const case_board b(CASE_IDLE);
    EXPECT_EQ(b.results, (values{1}));
    EXPECT_LT(f2812_shim_stats(b.shim)->blocks, 500u);
}

namespace
{
/// SYSCLKOUT is OSCCLK / 2 = 15 MHz as long as the PLL is left alone.
uint64_t cycles(emu_time_t from, emu_time_t to)
{
    return static_cast<uint64_t>((to - from + 33333) * 15 / 1000000);
}
} // namespace

TEST(shim, each_piece_takes_the_cycles_that_are_written_down)
{
    const case_board b(CASE_COST);
    std::vector<uint64_t> spent;
    emu_time_t last = 0;
    for (const auto& w : b.writes)
    {
        if (w.address == shim_board::RESULT)
        {
            spent.push_back(cycles(last, w.at));
            last = w.at;
        }
    }
    // Each from a store of a register to the next: 2 for that one, and a block where the compiler made one.
    const uint64_t access = 2, block = 4, turn = 4;
    ASSERT_EQ(spent.size(), 7u);
    EXPECT_EQ(spent[1], access + 1) << "NOP";
    EXPECT_EQ(spent[2], access + 9 + 5 * 100) << "DSP28x_usDelay(100)";
    EXPECT_EQ(spent[3], access + 10 * turn + 11 * block) << "ten turns, a block each, one behind";
    EXPECT_EQ(spent[4], access + 1 + 100) << "RPT #99 || NOP";
    EXPECT_EQ(spent[5], access + 20) << "rand()";
    EXPECT_EQ(spent[6], access + 1) << "a variable";
}

TEST(shim, an_interrupt_takes_14_cycles_and_its_return_8)
{
    const case_board b(CASE_INTERRUPT_COST);
    ASSERT_EQ(b.results.size(), 1u);
    ASSERT_EQ(b.entered.size(), 1u);
    ASSERT_EQ(b.left.size(), 1u);
    const auto told =
        std::find_if(b.writes.begin(), b.writes.end(), [](const auto& w) { return w.address == shim_board::RESULT; });
    const uint64_t access = 2, block = 4;
    EXPECT_EQ(cycles(b.entered[0], told->at), 14 + block + access);
    EXPECT_EQ(cycles(told->at, b.left[0]), access + 8) << "PIEACK, and the return";
}
