/// Nets, their resolution and their record.
/// SPDX-License-Identifier: MIT
#include "emu/trace.h"
#include <gtest/gtest.h>
#include <vector>

namespace
{
struct row_t
{
    emu_drive_t a, b;
    bool level, floating, contention;
};

TEST(wire, two_drivers_resolve_as_the_header_says)
{
    const row_t rows[] = {
        {EMU_Z, EMU_WEAK0, false, false, false},         {EMU_Z, EMU_WEAK1, true, false, false},
        {EMU_Z, EMU_STRONG0, false, false, false},       {EMU_Z, EMU_STRONG1, true, false, false},
        {EMU_WEAK0, EMU_WEAK0, false, false, false},     {EMU_WEAK1, EMU_WEAK1, true, false, false},
        {EMU_WEAK0, EMU_WEAK1, false, false, false},     {EMU_WEAK1, EMU_STRONG0, false, false, false},
        {EMU_WEAK0, EMU_STRONG1, true, false, false},    {EMU_WEAK1, EMU_STRONG1, true, false, false},
        {EMU_STRONG0, EMU_STRONG0, false, false, false}, {EMU_STRONG1, EMU_STRONG1, true, false, false},
        {EMU_STRONG0, EMU_STRONG1, false, false, true},
    };
    for (const row_t& r : rows)
    {
        for (const bool swap : {false, true})
        {
            emu_wire_t w;
            emu_wire_init(&w, "w", !r.level);
            const int d[2] = {emu_wire_add_driver(&w), emu_wire_add_driver(&w)};
            emu_wire_drive(&w, d[swap], r.a, 1);
            emu_wire_drive(&w, d[!swap], r.b, 2);
            EXPECT_EQ(w.level, r.level) << r.a << " with " << r.b;
            EXPECT_EQ(w.floating, r.floating);
            EXPECT_EQ(w.contentions, r.contention ? 1u : 0u) << r.a << " with " << r.b;
        }
    }
}

TEST(wire, an_undriven_net_keeps_its_level_and_says_so)
{
    emu_wire_t w;
    emu_wire_init(&w, "w", true);
    EXPECT_TRUE(w.level && w.floating);
    const int d = emu_wire_add_driver(&w);
    emu_wire_drive(&w, d, EMU_STRONG0, 1);
    EXPECT_TRUE(!w.level && !w.floating);
    emu_wire_drive(&w, d, EMU_Z, 2);
    EXPECT_TRUE(!w.level && w.floating);
}

TEST(wire, counts_a_lasting_contention_once)
{
    emu_wire_t w;
    emu_wire_init(&w, "w", true);
    const int a = emu_wire_add_driver(&w), b = emu_wire_add_driver(&w), c = emu_wire_add_driver(&w);
    emu_wire_drive(&w, a, EMU_STRONG0, 1);
    emu_wire_drive(&w, b, EMU_STRONG1, 2);
    emu_wire_drive(&w, c, EMU_WEAK1, 3);
    EXPECT_EQ(w.contentions, 1u);
    emu_wire_drive(&w, b, EMU_Z, 4);
    emu_wire_drive(&w, b, EMU_STRONG1, 5);
    EXPECT_EQ(w.contentions, 2u);
}

TEST(wire, refuses_more_than_it_holds)
{
    emu_wire_t w;
    emu_wire_init(&w, "w", true);
    for (int i = 0; i < EMU_WIRE_DRIVERS; i++)
    {
        EXPECT_EQ(emu_wire_add_driver(&w), i);
    }
    EXPECT_EQ(emu_wire_add_driver(&w), -1);
    const auto nothing = [](void*, bool, emu_time_t) {};
    for (int i = 0; i < EMU_WIRE_WATCHERS; i++)
    {
        EXPECT_EQ(emu_wire_watch(&w, nothing, nullptr), 0);
    }
    EXPECT_EQ(emu_wire_watch(&w, nothing, nullptr), -1);
    emu_trace_t trace{};
    emu_trace_probe_t probe;
    EXPECT_EQ(emu_trace_watch(&probe, &trace, &w, 0), -1);
}

TEST(trace, records_the_level_at_the_start_and_each_change)
{
    struct line_t
    {
        std::string wire;
        bool level;
        emu_time_t at;
        bool operator==(const line_t& o) const { return wire == o.wire && level == o.level && at == o.at; }
    };
    std::vector<line_t> lines;
    const emu_trace_t trace{[](void* ctx, const char* wire, bool level, emu_time_t at) {
                                static_cast<std::vector<line_t>*>(ctx)->push_back({wire, level, at});
                            },
                            &lines};
    emu_wire_t w[2];
    emu_trace_probe_t probe[2];
    emu_wire_init(&w[0], "EOC", true);
    emu_wire_init(&w[1], "/CS", false);
    ASSERT_EQ(emu_trace_watch(&probe[0], &trace, &w[0], 3), 0);
    ASSERT_EQ(emu_trace_watch(&probe[1], &trace, &w[1], 3), 0);
    const int d0 = emu_wire_add_driver(&w[0]), d1 = emu_wire_add_driver(&w[1]);
    emu_wire_drive(&w[0], d0, EMU_STRONG1, 5);
    emu_wire_drive(&w[0], d0, EMU_STRONG0, 7);
    emu_wire_drive(&w[1], d1, EMU_WEAK1, 9);
    EXPECT_TRUE(
        (lines == std::vector<line_t>{{"EOC", true, 3}, {"/CS", false, 3}, {"EOC", false, 7}, {"/CS", true, 9}}));
}
struct told_t
{
    std::vector<bool> levels;
    static void level(void* ctx, bool level, emu_time_t) { static_cast<told_t*>(ctx)->levels.push_back(level); }
};

TEST(wire, a_supply_wins_over_any_driver_until_it_is_taken_away)
{
    for (const emu_rail_t rail : {EMU_RAIL_GND, EMU_RAIL_VCC})
    {
        for (const emu_drive_t drive : {EMU_Z, EMU_WEAK0, EMU_WEAK1, EMU_STRONG0, EMU_STRONG1})
        {
            emu_wire_t w;
            emu_wire_init(&w, "w", rail == EMU_RAIL_GND);
            const int d = emu_wire_add_driver(&w);
            told_t told;
            ASSERT_EQ(emu_wire_watch(&w, told_t::level, &told), 0);
            emu_wire_short(&w, rail, 1);
            emu_wire_drive(&w, d, drive, 2);
            EXPECT_EQ(w.level, rail == EMU_RAIL_VCC) << drive;
            EXPECT_FALSE(w.floating);
            EXPECT_EQ(told.levels, std::vector<bool>{rail == EMU_RAIL_VCC});
            emu_wire_short(&w, EMU_RAIL_NONE, 3);
            const bool alone = drive == EMU_Z ? rail == EMU_RAIL_VCC : drive == EMU_WEAK1 || drive == EMU_STRONG1;
            EXPECT_EQ(w.level, alone) << drive;
            EXPECT_EQ(w.floating, drive == EMU_Z);
        }
    }
}

/// As one net with all drivers of both, at every step of a walk over what two drivers can do.
TEST(wire, two_nets_shorted_are_one)
{
    emu_wire_t one, other, whole;
    emu_wire_init(&one, "one", true);
    emu_wire_init(&other, "other", true);
    emu_wire_init(&whole, "whole", true);
    const int a = emu_wire_add_driver(&one), b = emu_wire_add_driver(&other);
    const int c = emu_wire_add_driver(&whole), d = emu_wire_add_driver(&whole);
    told_t told, told_whole;
    ASSERT_EQ(emu_wire_watch(&other, told_t::level, &told), 0);
    ASSERT_EQ(emu_wire_watch(&whole, told_t::level, &told_whole), 0);
    ASSERT_EQ(emu_wire_bridge(&one, &other, 0), 0);
    EXPECT_EQ(emu_wire_bridge(&one, &whole, 0), -1);
    EXPECT_EQ(emu_wire_bridge(&whole, &whole, 0), -1);
    unsigned random = 1;
    for (int step = 0; step < 2000; step++)
    {
        random = random * 1103515245u + 12345u;
        const auto drive = static_cast<emu_drive_t>((random >> 16) % 5u);
        const bool first = (random >> 24 & 1u) != 0;
        emu_wire_drive(first ? &one : &other, first ? a : b, drive, step);
        emu_wire_drive(&whole, first ? c : d, drive, step);
        ASSERT_EQ(one.level, whole.level) << step;
        ASSERT_EQ(other.level, whole.level) << step;
        ASSERT_EQ(one.floating && other.floating, whole.floating) << step;
    }
    EXPECT_EQ(told.levels, told_whole.levels);
    emu_wire_drive(&one, a, EMU_STRONG0, 3000);
    emu_wire_drive(&other, b, EMU_WEAK1, 3000);
    EXPECT_FALSE(other.level);
    emu_wire_unbridge(&other, 3001);
    EXPECT_TRUE(!one.level && other.level);
    emu_wire_drive(&one, a, EMU_STRONG1, 3002);
    emu_wire_drive(&other, b, EMU_STRONG0, 3002);
    EXPECT_TRUE(one.level && !other.level);
}

} // namespace
