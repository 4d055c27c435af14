/// \file   test_fast.cpp
/// \brief  The fast engine against the plain one: the same state, cycles, interrupts, edges and reports, whatever runs; what it costs.
/// SPDX-License-Identifier: MIT
#include "soup.hpp"
#include <cstdlib>

namespace
{

constexpr unsigned PROGRAMS = 400, BENCH_PROGRAMS = 6000, FIRST_SEED = 8051;
constexpr uint64_t CYCLES = 20'000;

/// One run of a program in slices, with pins that move between them and ways out of dead ends, all from one seed.
class rig
{
  public:
    bare_cpu b;
    uint64_t stops = 0;

    rig(const soup& program, unsigned seed) : rng_(seed)
    {
        EXPECT_EQ(mcs51_load(b.cpu, 0, program.image().data(), program.image().size()), 0);
        start();
    }
    void slice()
    {
        const uint64_t until = b.now() + 1 + rng_() % (rng_() % 4 ? 300 : 3000);
        mcs51_stop_t stop = MCS51_RAN;
        while ((stop = b.run(until)) == MCS51_STOPPED)
        {
            ++stops;
        }
        mcs51_set_pins(b.cpu, rng_() % 4, static_cast<uint8_t>(rng_()), b.now());
        if (stop != MCS51_RAN || rng_() % 8 == 0)
        {
            start();
        }
    }

  private:
    std::mt19937 rng_;

    void start()
    {
        if (rng_() % 16 == 0)
        {
            mcs51_reset(b.cpu, false);
        }
        mcs51_set_pc(b.cpu, static_cast<uint16_t>(rng_() % soup::SIZE));
        b.set(sfr::PCON, rng_() % 2 ? 0 : 0x80);
        b.set(sfr::IE, static_cast<int>((rng_() & 0x9F) | (rng_() % 4 ? 0x80 : 0)));
        b.set(sfr::TMOD, static_cast<int>(rng_() & 0x33));
        b.set(sfr::TCON, static_cast<int>(0x50 | (rng_() & 0x0F)));
        b.set(sfr::SCON, static_cast<int>(0x10 | (rng_() & 0xC0)));
        b.set(sfr::SP, static_cast<int>(0x30 + rng_() % 0x30));
    }
};

void observe_nothing(bare_cpu& b)
{
    mcs51_observer_t o{};
    o.access = [](void*, mcs51_space_t, uint16_t, uint8_t, bool, uint64_t) {};
    mcs51_observe(b.cpu, &o);
}

std::string state(bare_cpu& b)
{
    std::string s = "pc " + std::to_string(b.pc()) + " cycle " + std::to_string(b.now()) + " instructions " +
                    std::to_string(mcs51_instructions(b.cpu)) + " interrupts " +
                    std::to_string(mcs51_interrupts(b.cpu)) + " edges " + std::to_string(b.edges.size()) + " reports " +
                    std::to_string(b.reports.size());
    for (unsigned a = 0; a < 0x100; ++a)
    {
        const unsigned v = a < 0x80 ? b.ram(static_cast<uint8_t>(a)) : b.get(static_cast<uint8_t>(a));
        s += (a % 16 ? " " : "\n") + std::to_string(v);
    }
    return s;
}

void expect_same_edges(const bare_cpu& a, const bare_cpu& b)
{
    ASSERT_EQ(a.edges.size(), b.edges.size());
    for (size_t i = 0; i < a.edges.size(); ++i)
    {
        ASSERT_EQ(a.edges[i].cycle, b.edges[i].cycle) << "edge " << i;
        ASSERT_EQ(a.edges[i].out, b.edges[i].out) << "edge " << i;
        ASSERT_EQ(a.edges[i].port, b.edges[i].port) << "edge " << i;
    }
    for (size_t i = 0; i < a.reports.size(); ++i)
    {
        ASSERT_EQ(a.reports[i].at, b.reports[i].at) << a.reports[i].text;
        ASSERT_EQ(a.reports[i].detail, b.reports[i].detail) << a.reports[i].text;
    }
}

TEST(fast, agrees_with_the_plain_engine_on_random_programs)
{
    const unsigned programs = std::getenv("INS_BENCH") ? BENCH_PROGRAMS : PROGRAMS;
    uint64_t instructions = 0, interrupts = 0, edges = 0, stops = 0;
    for (unsigned seed = FIRST_SEED; seed < FIRST_SEED + programs; ++seed)
    {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const soup program(seed);
        rig fast(program, seed), plain(program, seed), turning(program, seed), patched(program, seed);
        observe_nothing(plain.b);
        mcs51_spin(turning.b.cpu, false);
        mcs51_cover(patched.b.cpu, true);
        unsigned place = seed * 40503u;
        while (plain.b.now() < CYCLES)
        {
            for (const bool on : {true, true, true, false})
            {
                const auto pc = static_cast<uint16_t>((place += on ? 977u : 2053u) % soup::SIZE);
                mcs51_set_break(patched.b.cpu, pc, on);
                mcs51_set_break(plain.b.cpu, pc, on);
            }
            plain.slice();
            const std::string want = state(plain.b);
            for (rig* const r : {&fast, &turning, &patched})
            {
                r->slice();
                ASSERT_EQ(state(r->b), want) << (r == &fast ? "fast" : r == &turning ? "spin off" : "patched");
            }
            ASSERT_EQ(patched.stops, plain.stops);
        }
        for (rig* const r : {&fast, &turning, &patched})
        {
            ASSERT_NO_FATAL_FAILURE(expect_same_edges(r->b, plain.b));
        }
        instructions += mcs51_instructions(plain.b.cpu);
        interrupts += mcs51_interrupts(plain.b.cpu);
        edges += plain.b.edges.size();
        stops += patched.stops;
    }
    std::printf("seeds %u..%u: %llu instructions, %llu interrupts, %llu edges, %llu stops at breakpoints: equal\n",
                FIRST_SEED, FIRST_SEED + programs - 1, static_cast<unsigned long long>(instructions),
                static_cast<unsigned long long>(interrupts), static_cast<unsigned long long>(edges),
                static_cast<unsigned long long>(stops));
    EXPECT_GT(instructions, programs * 2000u);
    EXPECT_GT(interrupts, programs * 20u);
    EXPECT_GT(edges, programs * 20u);
    EXPECT_GT(stops, programs);
}

constexpr uint64_t HOUR = 3600ull * (11'059'200 / 12);

/// Timer 0 runs over every 65,536 cycles; what is loaded at 0x40 waits, the handler counts in 30h and 31h.
void set_up_hour(bare_cpu& b, const std::vector<uint8_t>& waiting)
{
    b.load(0, {0x80, 0x5E});
    b.load(0x60, {0x75, sfr::TMOD, 0x21, 0x75, sfr::TH1, 0xFD, 0xD2, 0x8C, 0xD2, 0x8E});
    b.load(0x6A, {0x75, sfr::SCON, 0x40, 0x80, 0xD1});
    b.load(0x0B, {0x02, 0x00, 0x80});
    ASSERT_EQ(mcs51_load(b.cpu, 0x40, waiting.data(), waiting.size()), 0);
    b.load(0x80, {0x05, 0x30, 0xE5, 0x30, 0x70, 0x02, 0x05, 0x31, 0xD2, 0x08, 0x32}); // count; SETB 21h.0; RETI
}

TEST(fast, an_hour_of_waiting_costs_what_its_events_cost)
{
    constexpr uint64_t OVERFLOWS = HOUR / 0x10000 - 1, PASSES_AN_EVENT = 8;
    const std::vector<std::vector<uint8_t>> waits = {
        {0x75, sfr::IE, 0x82, 0x75, sfr::PCON, 0x01, 0x80, 0xFB},        // idle, again and again
        {0x75, sfr::IE, 0x82, 0x80, 0xFE},                               // SJMP $
        {0x75, sfr::IE, 0x82, 0x30, 0x08, 0xFD, 0xC2, 0x08, 0x80, 0xF9}, // JNB flag,$
        {0x75, sfr::IE, 0x82, 0x10, 0x08, 0x02, 0x80, 0xFB, 0x80, 0xF9}, // JBC flag; SJMP back
        {0x30, 0x8D, 0xFD, 0xC2, 0x8D, 0x80, 0xF9},                      // JNB TF0,$
        {0x20, 0x90, 0xFD},                                              // JB P1.0,$, to the end
        {0x75, sfr::IE, 0x82, 0x30, 0x99, 0xFD},                         // JNB TI,$, which never comes
    };
    for (size_t i = 0; i < waits.size(); ++i)
    {
        bare_cpu b;
        set_up_hour(b, waits[i]);
        EXPECT_EQ(b.run(HOUR), MCS51_RAN) << i;
        EXPECT_LE(mcs51_passes(b.cpu), PASSES_AN_EVENT * (OVERFLOWS + 2)) << i;
        if (i < 4 || i == 6)
        {
            EXPECT_EQ(mcs51_interrupts(b.cpu), OVERFLOWS) << i;
        }
    }
}

// TXD has an event where it changes; what passes without one counts at the rate of its time.
TEST(fast, smod_changed_amid_equal_bits_is_exact)
{
    constexpr uint64_t BIT = 32; // T1 overflows in each cycle, SMOD = 0
    for (const uint64_t after : {3 * BIT + 5, 5 * BIT + 17, 8 * BIT + 1})
    {
        bare_cpu b;
        b.load(0, {0x80, 0xFE});
        b.set(sfr::IE, 0x80);
        b.set(sfr::TMOD, 0x20);
        b.set(sfr::TH1, 0xFF);
        b.set(sfr::TL1, 0xFF);
        b.set(sfr::SCON, 0x40);
        b.set(sfr::TCON, 0x40);
        b.run(1000);
        b.set(sfr::SBUF, 0x00); // low from the start bit to the stop bit
        b.run(1000 + BIT);
        ASSERT_EQ(b.edges.size(), 1u);
        const uint64_t start = b.edges[0].cycle;
        b.run(start + after);
        b.set(sfr::PCON, 0x80);
        b.run(3000);
        ASSERT_EQ(b.edges.size(), 2u);
        const uint64_t changed = (after / BIT + 1) * BIT; // the bit under way keeps its length
        EXPECT_EQ(b.edges[1].cycle - start, changed + (9 - changed / BIT) * BIT / 2) << after;
    }
}

TEST(fast, breakpoint_on_the_jump_back_of_a_waiting_loop_stops_in_each_turn)
{
    bare_cpu b;
    b.load(0, {0x10, 0x08, 0x02, 0x80, 0xFB, 0x80, 0xFE}); // JBC 21h.0,+2; SJMP 0; SJMP $
    EXPECT_EQ(b.run(101), MCS51_RAN);
    for (unsigned turn = 0; turn < 5; ++turn)
    {
        mcs51_set_break(b.cpu, 3, true);
        const uint64_t from = b.now();
        ASSERT_EQ(b.run(from + 100), MCS51_STOPPED);
        EXPECT_EQ(b.pc(), 3);
        EXPECT_LE(b.now() - from, 4u);
    }
}

} // namespace
