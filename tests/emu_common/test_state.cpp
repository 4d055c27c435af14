/// Snapshot and restore of fields, events, wires, serial ends and lines. Seeds are printed.
/// SPDX-License-Identifier: MIT
#include "emu/serial.h"
#include <cstdlib>
#include <gtest/gtest.h>
#include <memory>
#include <random>
#include <vector>

namespace
{
constexpr uint64_t kSeed = 20100501;
constexpr double kBaud = 9600.0;

unsigned count(unsigned reduced, unsigned bench)
{
    return std::getenv("INS_BENCH") != nullptr ? bench : reduced;
}

struct fields_t
{
    bool flag = false;
    uint8_t u8 = 0;
    uint16_t u16 = 0;
    uint32_t u32 = 0;
    uint64_t u64 = 0;
    int64_t i64 = 0;
    double f64 = 0.0;
    uint8_t octets[3] = {};
    void state(emu_state_t* io)
    {
        emu_state_tag(io, "TEST", 0x01020304);
        emu_state_bool(io, &flag);
        emu_state_u8(io, &u8);
        emu_state_u16(io, &u16);
        emu_state_u32(io, &u32);
        emu_state_u64(io, &u64);
        emu_state_i64(io, &i64);
        emu_state_f64(io, &f64);
        emu_state_octets(io, octets, sizeof octets);
    }
};

const fields_t kFields{true, 0xFE, 0xABCD, 0x89ABCDEF, 0xFEDCBA9876543210, -2, -0.5, {7, 8, 9}};
const std::vector<uint8_t> kOctets = {'T',  'E',  'S',  'T',  0x04, 0x03, 0x02, 0x01, 1,    0xFE, 0xCD,
                                      0xAB, 0xEF, 0xCD, 0xAB, 0x89, 0x10, 0x32, 0x54, 0x76, 0x98, 0xBA,
                                      0xDC, 0xFE, 0xFE, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0,
                                      0,    0,    0,    0,    0,    0xE0, 0xBF, 7,    8,    9};

template <typename Part> std::vector<uint8_t> save(Part* part)
{
    emu_state_t size{};
    part->state(&size);
    std::vector<uint8_t> octets(size.at);
    emu_state_t io{octets.data(), nullptr, octets.size(), 0, false};
    part->state(&io);
    EXPECT_FALSE(io.bad);
    EXPECT_EQ(io.at, octets.size()) << "counting and saving walk alike";
    return octets;
}

template <typename Part> bool load(Part* part, const std::vector<uint8_t>& octets)
{
    emu_state_t io{nullptr, octets.data(), octets.size(), 0, false};
    part->state(&io);
    return !io.bad && io.at == octets.size();
}

TEST(state, is_little_endian_and_comes_back)
{
    fields_t in = kFields, out;
    EXPECT_EQ(save(&in), kOctets);
    ASSERT_TRUE(load(&out, kOctets));
    EXPECT_EQ(save(&out), kOctets);
    EXPECT_EQ(out.i64, -2);
    EXPECT_EQ(out.f64, -0.5);
    EXPECT_TRUE(out.flag);
}

TEST(state, writes_nothing_past_the_end_and_says_so)
{
    for (size_t size = 1; size < kOctets.size(); size++)
    {
        fields_t in = kFields;
        std::vector<uint8_t> octets(size);
        emu_state_t io{octets.data(), nullptr, size, 0, false};
        in.state(&io);
        EXPECT_TRUE(io.bad) << size;
        EXPECT_EQ(io.at, kOctets.size()) << "the octets needed";
        fields_t out;
        EXPECT_FALSE(load(&out, {kOctets.begin(), kOctets.begin() + static_cast<long>(size)})) << size;
    }
}

TEST(state, refuses_another_name_another_version_and_a_bool_that_is_none)
{
    for (const size_t at : {0, 3, 4, 7})
    {
        std::vector<uint8_t> octets = kOctets;
        octets[at] ^= 0x80;
        fields_t out;
        EXPECT_FALSE(load(&out, octets)) << at;
        EXPECT_EQ(out.u64, 0u) << "nothing is loaded after a refusal";
    }
    std::vector<uint8_t> octets = kOctets;
    octets[8] = 2;
    fields_t out;
    EXPECT_FALSE(load(&out, octets));
}

/// Three events that log and set themselves and each other.
struct queue_t
{
    queue_t()
    {
        emu_sched_init(&sched);
        for (unsigned i = 0; i < 3; i++)
        {
            links[i] = {this, i};
            events[i] = {fire, &links[i], 0, false, nullptr, 0};
        }
    }
    static void fire(void* ctx, emu_time_t at)
    {
        const auto* link = static_cast<const link_t*>(ctx);
        link->queue->fired.emplace_back(link->index, at);
    }
    void state(emu_state_t* io)
    {
        emu_sched_state(&sched, io);
        for (emu_event_t& event : events)
        {
            emu_event_state(&sched, &event, io);
        }
    }
    struct link_t
    {
        queue_t* queue;
        unsigned index;
    };
    emu_sched_t sched;
    link_t links[3];
    emu_event_t events[3];
    std::vector<std::pair<unsigned, emu_time_t>> fired;
};

using fired_t = std::vector<std::pair<unsigned, emu_time_t>>;

TEST(state, events_of_equal_times_keep_the_order_they_were_set_in)
{
    queue_t q;
    emu_sched_advance(&q.sched, 5);
    for (const unsigned i : {2, 0, 1})
    {
        emu_sched_at(&q.sched, &q.events[i], 30);
    }
    const std::vector<uint8_t> octets = save(&q);
    emu_sched_advance(&q.sched, 40);
    queue_t r;
    emu_sched_at(&r.sched, &r.events[1], 3); // is replaced
    for (queue_t* target : {&q, &r})
    {
        target->fired.clear();
        ASSERT_TRUE(load(target, octets));
        EXPECT_EQ(target->sched.now, 5);
        emu_sched_at(&target->sched, &target->events[0], 30); // set anew: after those that were
        emu_sched_advance(&target->sched, 30);
        EXPECT_EQ(target->fired, (fired_t{{2, 30}, {1, 30}, {0, 30}}));
    }
}

TEST(state, an_event_that_is_not_loaded_stays_and_time_does_not_go_back)
{
    queue_t q, later;
    emu_sched_at(&q.sched, &q.events[0], 30);
    emu_sched_advance(&later.sched, 50);
    emu_state_t size{};
    emu_sched_state(&later.sched, &size);
    std::vector<uint8_t> octets(size.at);
    emu_state_t out{octets.data(), nullptr, octets.size(), 0, false},
        in{nullptr, octets.data(), octets.size(), 0, false};
    emu_sched_state(&later.sched, &out);
    emu_sched_state(&q.sched, &in);
    ASSERT_FALSE(in.bad);
    emu_sched_advance(&q.sched, 60);
    EXPECT_EQ(q.fired, (fired_t{{0, 50}}));
}

TEST(state, wire_comes_back_without_telling_and_refuses_another_number_of_drivers)
{
    struct net_t
    {
        explicit net_t(int drivers)
        {
            emu_wire_init(&wire, "w", true);
            for (int i = 0; i < drivers; i++)
            {
                emu_wire_add_driver(&wire);
            }
            emu_wire_watch(
                &wire, [](void* ctx, bool, emu_time_t) { ++*static_cast<unsigned*>(ctx); }, &told);
        }
        void state(emu_state_t* io) { emu_wire_state(&wire, io); }
        emu_wire_t wire;
        unsigned told = 0;
    };
    net_t a(2), b(2), c(1);
    emu_wire_drive(&a.wire, 0, EMU_STRONG1, 1);
    emu_wire_drive(&a.wire, 1, EMU_STRONG0, 2);
    const std::vector<uint8_t> octets = save(&a);
    ASSERT_TRUE(load(&b, octets));
    EXPECT_FALSE(b.wire.level || b.wire.floating);
    EXPECT_EQ(b.wire.contentions, 1u);
    EXPECT_EQ(b.told, 0u);
    emu_wire_drive(&b.wire, 1, EMU_Z, 3);
    EXPECT_TRUE(b.wire.level) << "the other driver is back as well";
    EXPECT_FALSE(load(&c, octets));
    std::vector<uint8_t> bad = octets;
    bad[1] = 3;
    EXPECT_FALSE(load(&b, bad));
}

/// An end that sends through a noisy line to another.
struct line_t
{
    explicit line_t(double baud = kBaud)
    {
        emu_sched_init(&sched);
        emu_wire_init(&a, "a", true);
        emu_wire_init(&b, "b", true);
        emu_wire_init(&nc, "nc", true);
        static const emu_serial_cut_t cuts[] = {{EMU_PS_PER_S / 10, EMU_PS_PER_S / 5},
                                                {EMU_PS_PER_S / 4, EMU_PS_PER_S / 3}};
        const emu_serial_faults_t faults{kBaud, 0.01, 0.05, cuts, 2, kSeed};
        EXPECT_EQ(emu_serial_end_init(&tx, &sched, &a, &nc, baud, nullptr, nullptr), 0);
        EXPECT_EQ(emu_serial_end_init(&rx, &sched, nullptr, &b, baud, put, this), 0);
        EXPECT_EQ(emu_serial_line_init(&line, &sched, &a, &b, &faults), 0);
    }
    static void put(void* ctx, uint8_t octet, bool framing_ok, emu_time_t at)
    {
        static_cast<line_t*>(ctx)->got.push_back({octet, framing_ok, at});
    }
    void send(unsigned from, unsigned to)
    {
        for (unsigned i = from; i < to; i++)
        {
            emu_serial_end_send(&tx, static_cast<uint8_t>(i * 89 + 7));
        }
    }
    void state(emu_state_t* io)
    {
        emu_state_tag(io, "BOTH", 1);
        emu_sched_state(&sched, io);
        for (emu_wire_t* wire : {&a, &b, &nc})
        {
            emu_wire_state(wire, io);
        }
        emu_serial_end_state(&tx, io);
        emu_serial_end_state(&rx, io);
        emu_serial_line_state(&line, io);
    }
    struct got_t
    {
        uint8_t octet;
        bool framing_ok;
        emu_time_t at;
        bool operator==(const got_t& o) const { return octet == o.octet && framing_ok == o.framing_ok && at == o.at; }
    };
    emu_sched_t sched;
    emu_wire_t a, b, nc;
    emu_serial_end_t tx, rx;
    emu_serial_line_t line;
    std::vector<got_t> got;
};

TEST(state, a_serial_line_goes_on_from_any_instant_as_it_did)
{
    constexpr emu_time_t kEnd = EMU_PS_PER_S / 2;
    std::mt19937_64 random(kSeed);
    const auto whole = std::make_unique<line_t>();
    whole->send(0, 400);
    emu_sched_advance(&whole->sched, kEnd);
    ASSERT_GT(whole->rx.framing_errors, 0u) << "the line is as bad as meant";
    ASSERT_GT(whole->line.octets_swallowed, 0u);
    const std::vector<uint8_t> end = save(whole.get());
    const auto back = std::make_unique<line_t>();
    for (unsigned n = 0; n < count(50, 1000); n++)
    {
        const auto at = static_cast<emu_time_t>(random() % kEnd);
        const auto first = std::make_unique<line_t>();
        first->send(0, 400);
        emu_sched_advance(&first->sched, at);
        const std::vector<uint8_t> octets = save(first.get());
        ASSERT_TRUE(load(back.get(), octets)) << at;
        ASSERT_EQ(save(back.get()), octets) << "seed " << kSeed << ", instant " << at;
        back->got = first->got;
        emu_sched_advance(&back->sched, kEnd);
        ASSERT_TRUE(back->got == whole->got) << "seed " << kSeed << ", instant " << at;
        ASSERT_EQ(save(back.get()), end) << "seed " << kSeed << ", instant " << at;
    }
}

TEST(state, no_octets_make_a_serial_line_leave_its_arrays)
{
    std::mt19937_64 random(kSeed);
    const auto sender = std::make_unique<line_t>();
    sender->send(0, 300);
    emu_sched_advance(&sender->sched, EMU_PS_PER_S / 7);
    const std::vector<uint8_t> octets = save(sender.get());
    unsigned refused = 0;
    const unsigned n = count(2000, 20000);
    for (unsigned i = 0; i < n; i++)
    {
        const auto victim = std::make_unique<line_t>();
        std::vector<uint8_t> changed = octets;
        changed[random() % changed.size()] ^= static_cast<uint8_t>(1u << random() % 8);
        if (!load(victim.get(), changed))
        {
            refused++;
            continue;
        }
        emu_sched_advance(&victim->sched, EMU_PS_PER_S / 2); // the sanitizers look on
    }
    EXPECT_GT(refused, 0u) << "seed " << kSeed << ", of " << n;
}
} // namespace
