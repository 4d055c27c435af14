/// Messages between a run and a board program: each kind goes there and back, and nothing else is taken for one.
/// SPDX-License-Identifier: MIT
#include "emu_f2812/wirelink.h"
#include <cstring>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

namespace
{

constexpr unsigned cut_most = 64; ///< octets that are cut off a message, one by one
constexpr emu_time_t second = EMU_PS_PER_S;

using message_t = std::unique_ptr<f2812_link_t>;
using octets_t = std::vector<uint8_t>;

octets_t saved(f2812_link_t& message)
{
    octets_t octets(F2812_LINK_OCTETS);
    emu_state_t io{};
    io.to = octets.data();
    io.size = octets.size();
    octets.resize(f2812_link_walk(&message, &io));
    return octets;
}

message_t loaded(const octets_t& octets)
{
    message_t message = std::make_unique<f2812_link_t>();
    emu_state_t io{};
    io.from = octets.data();
    io.size = octets.size();
    return f2812_link_walk(message.get(), &io) == octets.size() ? std::move(message) : nullptr;
}

message_t made(f2812_link_kind_t kind)
{
    message_t message = std::make_unique<f2812_link_t>();
    std::memset(static_cast<void*>(message.get()), 0, sizeof *message);
    message->kind = static_cast<uint8_t>(kind);
    return message;
}

void put_edges(uint16_t& count, f2812_link_edge_t* edges, unsigned n)
{
    count = static_cast<uint16_t>(n);
    for (unsigned i = 0; i < n; i++)
    {
        edges[i].at = second + i;
        edges[i].wire = static_cast<uint8_t>(i % F2812_LINK_WIRES);
        edges[i].level = i % 2 != 0;
    }
}

/// One of each kind, with every array as long as may be.
std::vector<message_t> all()
{
    std::vector<message_t> list;
    for (unsigned kind = 0; kind < F2812_LINK_KINDS; kind++)
    {
        list.push_back(made(static_cast<f2812_link_kind_t>(kind)));
    }
    list[F2812_LINK_HELLO]->u.hello.bits = 32;
    f2812_link_text(list[F2812_LINK_HELLO]->u.hello.name, F2812_LINK_NAME, "echo");
    auto& start = list[F2812_LINK_START]->u.start;
    start.oscclk_hz = 30000000;
    start.count = F2812_LINK_SWITCHES;
    for (f2812_link_pair_t& pair : start.switches)
    {
        f2812_link_text(pair.name, F2812_LINK_NAME, "clock_off");
        f2812_link_text(pair.value, F2812_LINK_NAME, "take");
    }
    list[F2812_LINK_WIRE]->u.wire.driven = true;
    list[F2812_LINK_WIRE]->u.wire.answered = true;
    f2812_link_text(list[F2812_LINK_WIRE]->u.wire.name, F2812_LINK_NAME, "SCIRXDB");
    auto& run = list[F2812_LINK_RUN]->u.run;
    run.until = 2 * second;
    run.answer = second;
    put_edges(run.count, run.edges, F2812_LINK_EDGES);
    list[F2812_LINK_PEEK]->u.peek = {0x7050, F2812_LINK_VALUES};
    list[F2812_LINK_BREAK]->u.at = {0x0CE1, 0x0100, 0x0100, F2812_ACCESS_WRITE};
    list[F2812_LINK_RECORD]->u.record = {true, true};
    list[F2812_LINK_CLOCK]->u.clock.ppb = -25000;
    auto& done = list[F2812_LINK_DONE]->u.done;
    done.reached = 2 * second;
    done.quiet = EMU_TIME_MAX;
    done.why = F2812_WHY_ENDED;
    f2812_link_text(done.end, F2812_LINK_TEXT, "ESTOP0");
    put_edges(done.count, done.edges, F2812_LINK_EDGES);
    auto& values = list[F2812_LINK_VALUES_ARE]->u.values;
    values.count = F2812_LINK_VALUES;
    values.values[F2812_LINK_VALUES - 1] = 0xFFFF;
    auto& records = list[F2812_LINK_RECORDS_ARE]->u.records;
    records.count = F2812_LINK_RECORDS;
    records.records[F2812_LINK_RECORDS - 1] = {second, F2812_INTERRUPT_ENDED, 96, 1};
    put_edges(list[F2812_LINK_EDGES_ARE]->u.edges.count, list[F2812_LINK_EDGES_ARE]->u.edges.edges, F2812_LINK_EDGES);
    auto& counts = list[F2812_LINK_COUNTS_ARE]->u.counts;
    counts.count = F2812_LINK_COUNTS;
    counts.counts[F2812_LINK_COUNTS - 1].value = UINT64_MAX;
    auto& report = list[F2812_LINK_REPORT]->u.report;
    report.at = second;
    report.detail = 0x7050;
    report.kind = EMU_NOT_MODELLED;
    f2812_link_text(report.text, F2812_LINK_TEXT, "register not modelled");
    f2812_link_text(list[F2812_LINK_REFUSED]->u.refused.text, F2812_LINK_TEXT, "clock_off: no such value");
    return list;
}

TEST(wirelink, each_kind_comes_back_as_it_went)
{
    for (const message_t& message : all())
    {
        const octets_t octets = saved(*message);
        ASSERT_FALSE(octets.empty()) << "kind " << unsigned{message->kind};
        const message_t back = loaded(octets);
        ASSERT_TRUE(back) << "kind " << unsigned{message->kind};
        EXPECT_EQ(back->kind, message->kind);
        EXPECT_EQ(saved(*back), octets) << "kind " << unsigned{message->kind};
    }
}

TEST(wirelink, a_window_keeps_its_instants_and_levels)
{
    const message_t back = loaded(saved(*all()[F2812_LINK_RUN]));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->u.run.until, 2 * second);
    EXPECT_EQ(back->u.run.answer, second);
    ASSERT_EQ(back->u.run.count, F2812_LINK_EDGES);
    EXPECT_EQ(back->u.run.edges[3].at, second + 3);
    EXPECT_EQ(back->u.run.edges[3].wire, 3);
    EXPECT_TRUE(back->u.run.edges[3].level);
    EXPECT_EQ(loaded(saved(*all()[F2812_LINK_CLOCK]))->u.clock.ppb, -25000);
    EXPECT_STREQ(loaded(saved(*all()[F2812_LINK_DONE]))->u.done.end, "ESTOP0");
}

TEST(wirelink, octets_are_little_endian_and_pinned)
{
    const message_t peek = made(F2812_LINK_PEEK);
    peek->u.peek = {0x7050, 0x0003};
    EXPECT_EQ(saved(*peek), (octets_t{F2812_LINK_PEEK, 0x50, 0x70, 0x03, 0x00}));
    const message_t hello = made(F2812_LINK_HELLO);
    hello->u.hello.bits = 64;
    f2812_link_text(hello->u.hello.name, F2812_LINK_NAME, "ab");
    EXPECT_EQ(saved(*hello),
              (octets_t{F2812_LINK_HELLO, 'F', '2', '8', 'W', F2812_LINK_VERSION, 0, 0, 0, 64, 2, 'a', 'b'}));
}

TEST(wirelink, a_message_that_is_cut_or_longer_is_refused)
{
    for (const message_t& message : all())
    {
        const octets_t octets = saved(*message);
        for (size_t cut = 1; cut <= std::min<size_t>(cut_most, octets.size()); cut++)
        {
            EXPECT_FALSE(loaded(octets_t(octets.begin(), octets.end() - static_cast<ptrdiff_t>(cut))))
                << "kind " << unsigned{message->kind} << " without its last " << cut;
        }
        octets_t longer = octets;
        longer.push_back(0);
        EXPECT_FALSE(loaded(longer)) << "kind " << unsigned{message->kind};
    }
}

TEST(wirelink, what_cannot_be_is_refused)
{
    const auto refused = [](f2812_link_kind_t kind, auto change)
    {
        const message_t message = std::move(all()[kind]);
        EXPECT_TRUE(loaded(saved(*message)));
        change(message->u);
        return loaded(saved(*message)) == nullptr;
    };
    EXPECT_TRUE(refused(F2812_LINK_RUN, [](auto& u) { u.run.edges[1].at = u.run.edges[0].at - 1; }));
    EXPECT_TRUE(refused(F2812_LINK_RUN, [](auto& u) { u.run.until = -1; }));
    EXPECT_TRUE(refused(F2812_LINK_RUN, [](auto& u) { u.run.edges[0].wire = F2812_LINK_WIRES; }));
    EXPECT_TRUE(refused(F2812_LINK_DONE, [](auto& u) { u.done.quiet = u.done.reached; }));
    EXPECT_TRUE(refused(F2812_LINK_DONE, [](auto& u) { u.done.why = F2812_WHYS; }));
    EXPECT_TRUE(refused(F2812_LINK_BREAK, [](auto& u) { u.at.access = 4; }));
    EXPECT_TRUE(refused(F2812_LINK_RECORDS_ARE, [](auto& u) { u.records.records[0].what = F2812_WHATS; }));
    EXPECT_TRUE(refused(F2812_LINK_REPORT, [](auto& u) { u.report.kind = EMU_NOT_MODELLED + 1; }));
    EXPECT_TRUE(refused(F2812_LINK_PEEK, [](auto& u) { u.peek.count = F2812_LINK_VALUES + 1; }));
    EXPECT_FALSE(loaded({F2812_LINK_KINDS}));
    EXPECT_FALSE(loaded({}));
}

TEST(wirelink, another_version_is_refused)
{
    octets_t octets = saved(*all()[F2812_LINK_HELLO]);
    octets[5]++;
    EXPECT_FALSE(loaded(octets));
}

TEST(wirelink, a_long_text_is_cut_to_what_a_message_holds)
{
    std::array<char, 5> text{};
    f2812_link_text(text.data(), text.size(), "abcdefgh");
    EXPECT_STREQ(text.data(), "abcd");
}

} // namespace
