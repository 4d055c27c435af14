/// Snapshot and restore of the board: it goes on from any instant as it did, with the link and its faults, and refuses what is not its own.
/// Seeds are printed.
/// SPDX-License-Identifier: MIT
#include "acq_rig.hpp"
#include <cstdlib>
#include <memory>
#include <random>

namespace
{
constexpr uint64_t kSeed = 20100501;
constexpr double kEndMs = 300.0;

unsigned count(unsigned reduced, unsigned bench)
{
    return std::getenv("INS_BENCH") != nullptr ? bench : reduced;
}

struct edge_t
{
    unsigned wire;
    bool level;
    emu_time_t at;
    bool operator==(const edge_t& o) const { return wire == o.wire && level == o.level && at == o.at; }
};

/// The rig with a noisy line, its edges on record, and a snapshot of all of it: board, wires outside, line, and both ends.
struct whole_t
{
    whole_t() : rig(config_of())
    {
        const char* const names[] = {"EOC", "I/O CLOCK", "DATA IN", "DATA OUT", "/CS", "TXD", "RXD"};
        for (unsigned i = 0; i < taps.size(); i++)
        {
            taps[i] = {this, i};
            EXPECT_EQ(emu_wire_watch(acq_board_wire(rig.board, names[i]), record, &taps[i]), 0);
        }
    }
    static rig_config_t config_of()
    {
        rig_config_t config;
        config.up = {config.baud, 2e-3, 5e-3, nullptr, 0, kSeed};
        config.down = {config.baud, 2e-3, 5e-3, nullptr, 0, kSeed + 1};
        config.volts = [](unsigned channel, int64_t t) { return 1.0 + channel + 1e-12 * static_cast<double>(t); };
        return config;
    }
    static void record(void* ctx, bool level, emu_time_t at)
    {
        const auto* tap = static_cast<const tap_t*>(ctx);
        tap->whole->edges.push_back({tap->wire, level, at});
    }
    std::vector<uint8_t> save()
    {
        std::vector<uint8_t> octets(acq_board_save(rig.board, nullptr, 0));
        EXPECT_EQ(acq_board_save(rig.board, octets.data(), octets.size()), octets.size());
        emu_state_t size{};
        rig.outside_state(&size);
        const size_t board = octets.size();
        octets.resize(board + size.at);
        emu_state_t io{octets.data() + board, nullptr, size.at, 0, false};
        rig.outside_state(&io);
        return octets;
    }
    bool restore(const std::vector<uint8_t>& octets)
    {
        const size_t board = acq_board_save(rig.board, nullptr, 0);
        emu_state_t io{nullptr, octets.data() + board, octets.size() - board, 0, false};
        const bool restored = acq_board_restore(rig.board, octets.data(), board) == 0;
        rig.outside_state(&io);
        return restored && !io.bad;
    }
    struct tap_t
    {
        whole_t* whole;
        unsigned wire;
    };
    acq_rig_t rig;
    std::array<tap_t, 7> taps;
    std::vector<edge_t> edges;
};

TEST(acq_state, goes_on_from_any_instant_as_it_did)
{
    std::mt19937_64 random(kSeed);
    const auto whole = std::make_unique<whole_t>();
    whole->rig.run_to_ms(kEndMs);
    const std::vector<uint8_t> end = whole->save();
    ASSERT_GT(whole->rig.end.framing_errors + whole->rig.up.octets_swallowed, 0u) << "the line is as bad as meant";
    ASSERT_GT(whole->rig.blocks.size(), 5u) << "and the link works all the same";
    unsigned in_transfer = 0;
    for (unsigned n = 0; n < count(60, 1000); n++)
    {
        // Every other one within a scan, which takes 380 us of the 20 ms.
        double ms = static_cast<double>(random() % static_cast<uint64_t>(kEndMs * 1e6)) * 1e-6;
        const auto& samples = whole->rig.samples;
        if (n % 2 == 0)
        {
            ms = static_cast<double>(samples[random() % (samples.size() - 4)].at) * 1e-9 +
                 1e-6 * static_cast<double>(random() % 100000);
        }
        const auto first = std::make_unique<whole_t>(), second = std::make_unique<whole_t>();
        first->rig.run_to_ms(ms);
        in_transfer += !acq_board_wire(first->rig.board, "/CS")->level;
        const std::vector<uint8_t> octets = first->save();
        second->rig.run_to_ms(static_cast<double>(random() % 40)); // what it was before does not matter
        ASSERT_TRUE(second->restore(octets)) << ms << " ms, seed " << kSeed;
        ASSERT_EQ(second->save(), octets) << ms << " ms, seed " << kSeed;
        const size_t edges = first->edges.size();
        second->edges = first->edges;
        second->rig.run_to_ms(kEndMs);
        ASSERT_TRUE(std::equal(second->edges.begin() + static_cast<long>(edges), second->edges.end(),
                               whole->edges.begin() + static_cast<long>(edges), whole->edges.end()))
            << ms << " ms, seed " << kSeed;
        ASSERT_EQ(second->save(), end) << ms << " ms, seed " << kSeed;
        ASSERT_EQ(mcs51_instructions(second->rig.cpu), mcs51_instructions(whole->rig.cpu));
        ASSERT_EQ(mcs51_interrupts(second->rig.cpu), mcs51_interrupts(whole->rig.cpu));
    }
    EXPECT_GT(in_transfer, count(60, 1000) / 5) << "snapshots in the middle of a transfer";
}

TEST(acq_state, refuses_what_is_not_its_own_and_stays_as_it_was)
{
    std::mt19937_64 random(kSeed);
    const auto whole = std::make_unique<whole_t>();
    whole->rig.run_to_ms(61.3);
    acq_board_t* const board = whole->rig.board;
    std::vector<uint8_t> octets(acq_board_save(board, nullptr, 0));
    acq_board_save(board, octets.data(), octets.size());
    whole->rig.run_to_ms(75.0);
    const std::vector<uint8_t> now = whole->save();
    for (unsigned n = 0; n < count(200, 20000); n++)
    {
        std::vector<uint8_t> changed = octets;
        const size_t at = n < 24 * 8 ? n / 8 : random() % octets.size(); // the header bit by bit, then anywhere
        changed[at] ^= static_cast<uint8_t>(1u << n % 8);
        ASSERT_EQ(acq_board_restore(board, changed.data(), changed.size()), -1) << "octet " << at << ", seed " << kSeed;
        ASSERT_EQ(acq_board_restore(board, octets.data(), random() % octets.size()), -1) << "cut short";
    }
    octets.push_back(0);
    EXPECT_EQ(acq_board_restore(board, octets.data(), octets.size()), -1) << "one octet too many";
    octets.pop_back();
    EXPECT_EQ(whole->save(), now) << "nothing was changed";
    for (const size_t room : {size_t{1}, size_t{24}, size_t{25}, octets.size() / 2, octets.size() - 1})
    {
        std::vector<uint8_t> small(room);
        EXPECT_EQ(acq_board_save(board, small.data(), room), octets.size()) << "does not fit in " << room;
    }

    acq_board_config_t other;
    emu_sched_t sched;
    for (unsigned what = 0; what < 5; what++)
    {
        (what == 4 ? acq_board_six_config : acq_board_default_config)(&other);
        other.part = what == 0 ? MCS51_AT89S52 : MCS51_AT89S51;
        other.code_octets = what == 1 ? 65536 : 0;
        other.xdata_octets = what == 2 ? 256 : 0;
        other.crystal_hz += what == 3 ? 1 : 0;
        emu_sched_init(&sched);
        acq_board_t* const stranger = acq_board_create(&other, &sched);
        ASSERT_NE(stranger, nullptr);
        EXPECT_EQ(acq_board_restore(stranger, octets.data(), octets.size()), -1) << what;
        acq_board_destroy(stranger);
    }
    EXPECT_EQ(acq_board_restore(board, octets.data(), octets.size()), 0) << "as it is, it is taken";
}

TEST(acq_state, a_snapshot_of_one_machine_is_that_of_all)
{
    const auto whole = std::make_unique<whole_t>();
    whole->rig.run_to_ms(44.4);
    std::vector<uint8_t> octets(acq_board_save(whole->rig.board, nullptr, 0));
    acq_board_save(whole->rig.board, octets.data(), octets.size());
    EXPECT_EQ(std::string(octets.begin(), octets.begin() + 4), "ACQB");
    EXPECT_EQ(octets[4], 1u) << "version, little endian";
    EXPECT_EQ(octets[8] | octets[9] << 8 | octets[10] << 16, static_cast<int>(octets.size()) - 24);
}
} // namespace
