/// \file   test_watch.cpp
/// \brief  Observers, breakpoints, coverage and stops: what is told, when, and that watching changes nothing.
/// SPDX-License-Identifier: MIT
#include "bare_cpu.hpp"

namespace
{

struct watcher
{
    struct access
    {
        mcs51_space_t space;
        unsigned address, value;
        bool write;
        uint64_t cycle;
        bool operator==(const access& x) const
        {
            return space == x.space && address == x.address && value == x.value && write == x.write && cycle == x.cycle;
        }
    };
    struct vector
    {
        unsigned irq, from;
        uint64_t cycle;
    };

    bare_cpu b;
    std::vector<uint16_t> steps;
    std::vector<uint64_t> cycles;
    std::vector<access> seen;
    std::vector<vector> vectors;
    int refuse_at = -1, stop_at = -1; ///< addresses: the observer refuses the step; calls mcs51_stop in it
    int stop_access = -1;             ///< address whose access stops

    watcher()
    {
        mcs51_observer_t o{};
        o.ctx = this;
        o.step = [](void* ctx, uint16_t pc, uint64_t cycle)
        {
            auto* const self = static_cast<watcher*>(ctx);
            if (pc == self->refuse_at)
            {
                return false;
            }
            if (pc == self->stop_at)
            {
                mcs51_stop(self->b.cpu);
            }
            self->steps.push_back(pc);
            self->cycles.push_back(cycle);
            return true;
        };
        o.access = [](void* ctx, mcs51_space_t space, uint16_t address, uint8_t value, bool write, uint64_t cycle)
        {
            auto* const self = static_cast<watcher*>(ctx);
            self->seen.push_back({space, address, value, write, cycle});
            if (address == self->stop_access)
            {
                mcs51_stop(self->b.cpu);
            }
        };
        o.vector = [](void* ctx, unsigned irq, uint16_t from_pc, uint64_t cycle) {
            static_cast<watcher*>(ctx)->vectors.push_back({irq, from_pc, cycle});
        };
        mcs51_observe(b.cpu, &o);
    }
    /// The accesses of one instruction; cycles are those at its end.
    std::vector<access> of(std::initializer_list<int> octets)
    {
        seen.clear();
        b.execute(0x100, octets);
        for (access& a : seen)
        {
            EXPECT_EQ(a.cycle, b.now());
            a.cycle = 0;
        }
        return seen;
    }
};

std::ostream& operator<<(std::ostream& out, const watcher::access& a)
{
    return out << (a.write ? "write " : "read ") << a.space << ':' << std::hex << a.address << ' ' << a.value;
}

using accesses = std::vector<watcher::access>;
constexpr bool R = false, W = true;

TEST(watch, accesses_are_those_that_the_instruction_names)
{
    watcher w;
    w.b.set_ram(0x00, 0x40);
    w.b.set_ram(0x40, 0x77);
    w.b.set_ram(0x30, 0x12);
    w.b.set(sfr::ACC, 0x21);
    const struct
    {
        std::initializer_list<int> octets;
        accesses want;
    } cases[] = {
        {{0xE4}, {}},                                                                                  // CLR A
        {{0x74, 0x21}, {}},                                                                            // MOV A,#
        {{0xE5, 0x30}, {{MCS51_IRAM, 0x30, 0x12, R, 0}}},                                              // MOV A,dir
        {{0x05, 0x30}, {{MCS51_IRAM, 0x30, 0x12, R, 0}, {MCS51_IRAM, 0x30, 0x13, W, 0}}},              // INC dir
        {{0x76, 0x55}, {{MCS51_IRAM, 0x40, 0x55, W, 0}}},                                              // MOV @R0,#
        {{0x7B, 0x66}, {{MCS51_IRAM, 0x03, 0x66, W, 0}}},                                              // MOV R3,#
        {{0xEB}, {{MCS51_IRAM, 0x03, 0x66, R, 0}}},                                                    // MOV A,R3
        {{0xDB, 0x00}, {{MCS51_IRAM, 0x03, 0x66, R, 0}, {MCS51_IRAM, 0x03, 0x65, W, 0}}},              // DJNZ R3
        {{0xD2, 0x91}, {{MCS51_SFR, sfr::P1, 0xFF, R, 0}, {MCS51_SFR, sfr::P1, 0xFF, W, 0}}},          // SETB P1.1
        {{0x30, 0x93, 0x00}, {{MCS51_SFR, sfr::P1, 0xFF, R, 0}}},                                      // JNB P1.3
        {{0x85, 0x30, sfr::TH1}, {{MCS51_IRAM, 0x30, 0x13, R, 0}, {MCS51_SFR, sfr::TH1, 0x13, W, 0}}}, // MOV dir,dir
        {{0x75, sfr::PSW, 0x18}, {{MCS51_SFR, sfr::PSW, 0x18, W, 0}}},                                 // MOV PSW,#
        {{0x7B, 0x67}, {{MCS51_IRAM, 0x1B, 0x67, W, 0}}}, // MOV R3,# in bank 3
        {{0x75, sfr::PSW, 0x00}, {{MCS51_SFR, sfr::PSW, 0x00, W, 0}}},
        {{0xC0, 0x30}, {{MCS51_IRAM, 0x30, 0x13, R, 0}, {MCS51_IRAM, 0x08, 0x13, W, 0}}},             // PUSH
        {{0x12, 0x01, 0x03}, {{MCS51_IRAM, 0x09, 0x03, W, 0}, {MCS51_IRAM, 0x0A, 0x01, W, 0}}},       // LCALL
        {{0x22}, {{MCS51_IRAM, 0x0A, 0x01, R, 0}, {MCS51_IRAM, 0x09, 0x03, R, 0}}},                   // RET
        {{0x90, 0x01, 0x02}, {{MCS51_SFR, sfr::DPL, 0x02, W, 0}, {MCS51_SFR, sfr::DPH, 0x01, W, 0}}}, // MOV DPTR,#
        {{0xE4}, {}},
        {{0x93}, {{MCS51_CODE, 0x102, 0x02, R, 0}}},  // MOVC A,@A+DPTR
        {{0xF0}, {{MCS51_XDATA, 0x102, 0x02, W, 0}}}, // MOVX @DPTR,A
    };
    for (const auto& c : cases)
    {
        EXPECT_EQ(w.of(c.octets), c.want) << std::hex << *c.octets.begin();
    }
}

TEST(watch, a_refused_step_is_not_executed_and_is_told_again)
{
    watcher w;
    w.b.load(0, {0x04, 0x04, 0x04, 0x80, 0xFE}); // INC A; INC A; INC A; SJMP $
    w.refuse_at = 2;
    EXPECT_EQ(w.b.run(100), MCS51_STOPPED);
    EXPECT_EQ(w.b.pc(), 2);
    EXPECT_EQ(w.b.now(), 2u);
    EXPECT_EQ(w.b.run(100), MCS51_STOPPED);
    EXPECT_EQ(w.b.get(sfr::ACC), 2);
    w.refuse_at = -1;
    EXPECT_EQ(w.b.run(100), MCS51_HALTED);
    EXPECT_EQ(w.b.get(sfr::ACC), 3);
    EXPECT_EQ(w.steps, (std::vector<uint16_t>{0, 1, 2, 3}));
    EXPECT_EQ(w.cycles, (std::vector<uint64_t>{0, 1, 2, 3}));
}

TEST(watch, stop_ends_the_run_at_the_next_boundary)
{
    watcher w;
    w.b.load(0, {0x04, 0x75, 0x30, 0x01, 0x04, 0x04, 0x80, 0xFE});
    w.stop_at = 0;
    EXPECT_EQ(w.b.run(100), MCS51_STOPPED);
    EXPECT_EQ(w.b.pc(), 1);
    w.stop_access = 0x30;
    EXPECT_EQ(w.b.run(100), MCS51_STOPPED);
    EXPECT_EQ(w.b.pc(), 4);
    EXPECT_EQ(w.b.ram(0x30), 1);
    mcs51_stop(w.b.cpu); // before a run: nothing is executed
    EXPECT_EQ(w.b.run(100), MCS51_STOPPED);
    EXPECT_EQ(w.b.pc(), 4);
    EXPECT_EQ(w.b.run(100), MCS51_HALTED);
    EXPECT_EQ(w.b.now(), 5u);
}

TEST(watch, breakpoint_stops_once_each_time_it_is_reached)
{
    bare_cpu b;
    b.load(0, {0x78, 0x03, 0x04, 0xD8, 0xFD, 0x80, 0xFE}); // MOV R0,#3; again: INC A; DJNZ R0,again; SJMP $
    ASSERT_EQ(mcs51_set_break(b.cpu, 2, true), 0);
    for (int turn = 0; turn < 3; ++turn)
    {
        ASSERT_EQ(b.run(1000), MCS51_STOPPED) << turn;
        EXPECT_EQ(b.pc(), 2);
        EXPECT_EQ(b.get(sfr::ACC), turn);
        EXPECT_EQ(b.now(), 1u + 3u * static_cast<unsigned>(turn));
    }
    EXPECT_EQ(b.run(1000), MCS51_HALTED);
    mcs51_set_pc(b.cpu, 0);
    ASSERT_EQ(mcs51_set_break(b.cpu, 2, false), 0);
    EXPECT_EQ(b.run(1000), MCS51_HALTED);
    EXPECT_EQ(mcs51_set_break(b.cpu, 0x1000, true), -1);
}

TEST(watch, breakpoint_on_the_first_instruction_and_on_a_jump_to_itself)
{
    bare_cpu b;
    b.load(0, {0x00, 0x80, 0xFE});
    mcs51_set_break(b.cpu, 0, true);
    mcs51_set_break(b.cpu, 1, true);
    EXPECT_EQ(b.run(100), MCS51_STOPPED);
    EXPECT_EQ(b.now(), 0u);
    EXPECT_EQ(b.run(100), MCS51_STOPPED);
    EXPECT_EQ(b.now(), 1u);
    EXPECT_EQ(b.run(100), MCS51_HALTED);
}

TEST(watch, vectors_tell_source_place_and_cycle)
{
    watcher w;
    w.b.load(0, {0x75, sfr::IE, 0x82, 0xD2, 0x8D, 0x00, 0x00, 0x80, 0xFE}); // IE = EA, ET0; SETB TF0; NOP; NOP
    w.b.load(0x0B, {0x32});
    w.b.run(12);
    ASSERT_EQ(w.vectors.size(), 1u);
    EXPECT_EQ(w.vectors[0].irq, 1u);
    EXPECT_EQ(w.vectors[0].from, 6u); // polled in the cycle after SETB: the first NOP is executed
    EXPECT_EQ(w.vectors[0].cycle, 4u);
    const accesses pushes = {{MCS51_IRAM, 0x08, 6, W, 6}, {MCS51_IRAM, 0x09, 0, W, 6}};
    ASSERT_GE(w.seen.size(), 5u);
    EXPECT_EQ(accesses(w.seen.begin() + 3, w.seen.begin() + 5), pushes);
    EXPECT_EQ(w.steps, (std::vector<uint16_t>{0, 3, 5, 0x0B, 6, 7, 7}));
}

TEST(watch, coverage_tells_instructions_and_both_ways_of_branches)
{
    bare_cpu b;
    // MOV R0,#2; again: JZ skip; INC A; skip: DJNZ R0,again; JNC end; NOP; end: SJMP $
    b.load(0, {0x78, 0x02, 0x60, 0x01, 0x04, 0xD8, 0xFB, 0x50, 0x01, 0x00, 0x80, 0xFE});
    b.set(sfr::ACC, 1);
    mcs51_cover(b.cpu, true);
    b.run(100);
    for (const uint16_t pc : std::vector<uint16_t>{0, 2, 4, 5, 7})
    {
        EXPECT_TRUE(mcs51_covered(b.cpu, pc)) << pc;
    }
    for (const uint16_t pc : std::vector<uint16_t>{1, 3, 6, 9})
    {
        EXPECT_FALSE(mcs51_covered(b.cpu, pc)) << pc;
    }
    EXPECT_EQ(mcs51_branches(b.cpu, 2), 1u); // JZ never taken
    EXPECT_EQ(mcs51_branches(b.cpu, 5), 3u);
    EXPECT_EQ(mcs51_branches(b.cpu, 7), 2u);
    EXPECT_EQ(mcs51_branches(b.cpu, 4), 0u);
    mcs51_cover(b.cpu, false);
    EXPECT_TRUE(mcs51_covered(b.cpu, 4));
    mcs51_cover(b.cpu, true);
    EXPECT_FALSE(mcs51_covered(b.cpu, 4));
}

TEST(watch, watching_changes_neither_state_nor_time)
{
    bare_cpu plain;
    watcher w;
    mcs51_cover(w.b.cpu, true);
    for (bare_cpu* const b : {&plain, &w.b})
    {
        b->load_file(std::string(MCS51_IMAGES) + "/bench_board.bin");
        b->run(100'000);
    }
    EXPECT_EQ(w.b.now(), plain.now());
    EXPECT_EQ(w.steps.size(), mcs51_instructions(plain.cpu));
    EXPECT_EQ(w.vectors.size(), mcs51_interrupts(plain.cpu));
    EXPECT_GT(w.vectors.size(), 50u);
    for (unsigned a = 0; a < 0x80; ++a)
    {
        EXPECT_EQ(w.b.ram(static_cast<uint8_t>(a)), plain.ram(static_cast<uint8_t>(a))) << a;
        EXPECT_EQ(w.b.get(static_cast<uint8_t>(a + 0x80)), plain.get(static_cast<uint8_t>(a + 0x80))) << a;
    }
    ASSERT_EQ(w.b.edges.size(), plain.edges.size());
    for (size_t i = 0; i < plain.edges.size(); ++i)
    {
        ASSERT_EQ(w.b.edges[i].cycle, plain.edges[i].cycle) << i;
    }
}

} // namespace
