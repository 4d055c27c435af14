/// \file   test_handshake.cpp
/// \brief  Both machines of the handshake: the reference transcripts, each lost octet, and a bad line between them.
/// SPDX-License-Identifier: MIT
#include "core_test.h"
#include <deque>
#include <map>
#include <random>
using namespace core_test;

namespace
{
const int RANDOM_RUNS = 400;    // lines, each with its own seed and faults
const int RANDOM_BLOCKS = 150;  // blocks offered per run; below 256, so that sequence numbers do not come round
const int FUZZ_OCTETS = 200000; // random octets into each machine
const uint16_t REPLY_TIMEOUT = 40;
const uint16_t OCTET_TIMEOUT = 10;
const uint16_t PERIOD = 100;

using Octets = std::vector<ins_octet_t>;

ins_hs_config_t config(bool seq, uint_least8_t retries, uint_least8_t len = 6)
{
    return {len, static_cast<uint_least8_t>(seq), retries, REPLY_TIMEOUT, OCTET_TIMEOUT};
}

std::string hex(const Octets& octets)
{
    std::string text;
    for (const ins_octet_t o : octets)
    {
        char two[3];
        std::snprintf(two, sizeof two, "%02X", o);
        text += two;
    }
    return text;
}

/// The two machines and a line in each direction; one octet takes one tick of time.
struct Link
{
    ins_hs_board_t board;
    ins_hs_host_t host;
    uint16_t now = 60000;                                 // wraps early in each run
    std::deque<std::pair<uint16_t, ins_octet_t>> to_host; ///< (arrival, octet)
    std::deque<std::pair<uint16_t, ins_octet_t>> to_board;
    std::function<void(std::deque<std::pair<uint16_t, ins_octet_t>>&, uint16_t, ins_octet_t)> line;
    std::vector<int> events;
    std::vector<Octets> delivered;
    std::vector<unsigned> gaps;
    std::vector<unsigned> numbers;

    /// The board tries more often than the host answers FF, so that lost alignment ends in a new request.
    explicit Link(ins_hs_config_t cfg, uint_least8_t more_board_retries = 2)
    {
        EXPECT_EQ(ins_hs_host_init(&host, &cfg), INS_OK);
        cfg.retries = static_cast<uint_least8_t>(cfg.retries + more_board_retries);
        EXPECT_EQ(ins_hs_board_init(&board, &cfg), INS_OK);
        line = [](auto& queue, uint16_t at, ins_octet_t octet) { queue.push_back({at, octet}); };
    }

    void tick()
    {
        now++;
        const int16_t out = ins_hs_board_tx(&board, now);
        if (out >= 0)
        {
            line(to_host, static_cast<uint16_t>(now + 1), static_cast<ins_octet_t>(out));
        }
        bool heard = false;
        while (!to_host.empty() && static_cast<int16_t>(now - to_host.front().first) >= 0)
        {
            int16_t reply;
            const int event = ins_hs_host_rx(&host, to_host.front().second, now, &reply);
            to_host.pop_front();
            heard = true;
            if (event == INS_HS_BLOCK)
            {
                delivered.push_back(Octets(host.block, host.block + host.cfg.block_len));
                gaps.push_back(host.gap);
                numbers.push_back(host.seq);
            }
            if (event != INS_HS_NOTHING)
            {
                events.push_back(event);
            }
            if (reply >= 0)
            {
                line(to_board, static_cast<uint16_t>(now + 1), static_cast<ins_octet_t>(reply));
            }
        }
        if (!heard)
        {
            ins_hs_host_tick(&host, now);
        }
        while (!to_board.empty() && static_cast<int16_t>(now - to_board.front().first) >= 0)
        {
            ins_hs_board_rx(&board, to_board.front().second, now);
            to_board.pop_front();
        }
        ins_hs_board_tick(&board, now);
    }

    void run(int ticks)
    {
        for (int i = 0; i < ticks; i++)
        {
            tick();
        }
    }
};

/// A block that carries its own number, so that a delivered one can be told right from wrong.
Octets block_number(unsigned n)
{
    return {static_cast<ins_octet_t>((n >> 8) & 0x0F), static_cast<ins_octet_t>(n & 0xFF),
            static_cast<ins_octet_t>((n * 7) & 0x0F),  static_cast<ins_octet_t>((n * 13 + 1) & 0xFF),
            static_cast<ins_octet_t>((n * 3) & 0x0F),  static_cast<ins_octet_t>((n * 29 + 0xAA) & 0xFF)};
}
} // namespace

TEST(vector_handshake, transcripts)
{
    const json file = load("handshake.json");
    ASSERT_FALSE(file["cases"].empty());
    for (const json& c : file["cases"])
    {
        const ins_hs_config_t cfg = config(false, 2); // a block is sent three times in the file
        ins_hs_board_t board;
        ins_hs_host_t host;
        ASSERT_EQ(ins_hs_board_init(&board, &cfg), INS_OK);
        ASSERT_EQ(ins_hs_host_init(&host, &cfg), INS_OK);
        const auto xyz = c["xyz"].get<std::array<uint16_t, 3>>();
        Octets block(6);
        ins_hs_block_put(xyz.data(), block.data());
        ASSERT_EQ(ins_hs_board_offer(&board, block.data(), 0, 0), INS_OK);
        std::vector<std::pair<std::string, std::string>> transcript;
        json accepted = nullptr;
        size_t frames = 0;
        Octets frame;
        for (int16_t out; (out = ins_hs_board_tx(&board, 0)) >= 0;)
        {
            frame.push_back(static_cast<ins_octet_t>(out));
            if (frame.size() != (transcript.empty() ? 1u : 7u))
            {
                continue;
            }
            if (frame.size() == 7 && frames < c["faults"].size())
            {
                const json& fault = c["faults"][frames];
                const size_t at = fault[1];
                if (fault[0] == "bit")
                {
                    frame[at] = static_cast<ins_octet_t>(frame[at] ^ (1u << fault[2].get<unsigned>()));
                }
                else
                {
                    ASSERT_EQ(fault[0], "swap");
                    std::swap(frame[at], frame[at + 1]);
                }
            }
            frames += frame.size() == 7;
            transcript.push_back({"A>B", hex(frame)});
            for (const ins_octet_t octet : frame)
            {
                int16_t reply;
                const int event = ins_hs_host_rx(&host, octet, 0, &reply);
                if (event == INS_HS_BLOCK)
                {
                    accepted = Octets(host.block, host.block + 6);
                }
                if (reply >= 0)
                {
                    transcript.push_back({"B>A", hex({static_cast<ins_octet_t>(reply)})});
                    ins_hs_board_rx(&board, static_cast<ins_octet_t>(reply), 0);
                }
            }
            frame.clear();
        }
        EXPECT_EQ(json(transcript), c["transcript"]) << c.dump();
        EXPECT_EQ(accepted, c["accepted"]) << c.dump();
        EXPECT_EQ(board.sum, c["checksum"].get<unsigned>());
        EXPECT_EQ(ins_hs_board_busy(&board), 0);
        EXPECT_EQ(board.sent, accepted.is_null() ? 0 : 1);
        EXPECT_EQ(board.given_up, accepted.is_null() ? 1 : 0);
        EXPECT_EQ(!accepted.is_null() && accepted != json(block), c["undetected"].get<bool>());
    }
}

TEST(handshake, sequence_number_travels_in_the_high_nibbles)
{
    Link link(config(true, 3));
    const Octets block = block_number(0x5A3);
    ASSERT_EQ(ins_hs_board_offer(&link.board, block.data(), 0xC7, link.now), INS_OK);
    EXPECT_EQ(ins_hs_board_offer(&link.board, block.data(), 0xC8, link.now), INS_E_STATE);
    Octets sent;
    link.line = [&](auto& queue, uint16_t at, ins_octet_t octet) {
        queue.push_back({at, octet});
        sent.push_back(octet);
    };
    link.run(20);
    ASSERT_EQ(sent.size(), 10u); // AA BB block sum 00
    EXPECT_EQ(sent[2], 0xC0 | block[0]);
    EXPECT_EQ(sent[4], 0x70 | block[2]);
    ASSERT_EQ(link.delivered.size(), 1u);
    EXPECT_EQ(link.delivered[0], block);
    EXPECT_EQ(link.host.seq, 0xC7);
    uint16_t codes[3];
    ins_hs_block_codes(link.host.block, codes);
    EXPECT_EQ(codes[0], 0x5A3);
}

TEST(handshake, every_single_octet_lost_flipped_or_doubled_costs_one_exchange_at_most)
{
    // For each place in the first exchange, octet by octet in both directions, and each kind of fault.
    for (int place = 0; place < 10; place++)
    {
        for (int kind = 0; kind < 10; kind++)
        {
            Link link(config(true, 1));
            int count = 0;
            link.line = [&](auto& queue, uint16_t at, ins_octet_t octet) {
                const bool here = count++ == place;
                if (here && kind == 8)
                {
                    return; // lost
                }
                if (here && kind < 8)
                {
                    octet = static_cast<ins_octet_t>(octet ^ (1u << kind));
                }
                queue.push_back({at, octet});
                if (here && kind == 9)
                {
                    queue.push_back({at, octet});
                }
            };
            for (unsigned n = 0; n < 3; n++)
            {
                ASSERT_EQ(
                    ins_hs_board_offer(&link.board, block_number(n).data(), static_cast<uint_least8_t>(n), link.now),
                    INS_OK);
                link.run(4 * REPLY_TIMEOUT);
                EXPECT_EQ(ins_hs_board_busy(&link.board), 0) << "place " << place << ", kind " << kind;
            }
            ASSERT_EQ(link.delivered.size(), 3u) << "place " << place << ", kind " << kind;
            for (unsigned n = 0; n < 3; n++)
            {
                EXPECT_EQ(link.delivered[n], block_number(n)) << "place " << place << ", kind " << kind;
                EXPECT_EQ(link.gaps[n], 0u);
            }
            EXPECT_EQ(link.board.sent, 3);
        }
    }
}

TEST(handshake, a_lost_acceptance_makes_a_duplicate_and_not_a_second_block)
{
    for (const bool seq : {true, false})
    {
        Link link(config(seq, 3));
        bool lost = false;
        link.line = [&](auto& queue, uint16_t at, ins_octet_t octet) {
            if (&queue == &link.to_board && octet == INS_HS_ACCEPT && !lost)
            {
                lost = true;
                return;
            }
            queue.push_back({at, octet});
        };
        ASSERT_EQ(ins_hs_board_offer(&link.board, block_number(5).data(), 5, link.now), INS_OK);
        link.run(3 * REPLY_TIMEOUT);
        EXPECT_TRUE(lost);
        EXPECT_EQ(link.board.sent, 1);
        EXPECT_EQ(link.board.resent, 1);
        EXPECT_EQ(link.host.duplicates, seq ? 1u : 0u);
        EXPECT_EQ(link.host.accepted, seq ? 1u : 2u); // off, the paper's octets cannot tell
    }
}

TEST(handshake, a_silent_host_costs_bounded_tries_and_the_gap_is_known)
{
    Link link(config(true, 2), 0);
    bool cut = false;
    int requests = 0;
    link.line = [&](auto& queue, uint16_t at, ins_octet_t octet) {
        requests += octet == INS_HS_REQUEST && &queue == &link.to_host && cut;
        if (!cut)
        {
            queue.push_back({at, octet});
        }
    };
    for (unsigned n = 0; n < 12; n++)
    {
        cut = n >= 3 && n < 8;
        requests = 0;
        ASSERT_EQ(
            ins_hs_board_offer(&link.board, block_number(n).data(), static_cast<uint_least8_t>(n + 250), link.now),
            INS_OK);
        link.run(4 * REPLY_TIMEOUT);
        EXPECT_EQ(requests, cut ? 3 : 0);
    }
    EXPECT_EQ(link.board.given_up, 5);
    EXPECT_EQ(link.board.sent, 7);
    EXPECT_EQ(link.host.accepted, 7u);
    EXPECT_EQ(link.gaps, (std::vector<unsigned>{0, 0, 0, 5, 0, 0, 0}));
}

TEST(handshake, a_request_again_is_not_eaten_as_the_first_octet)
{
    // BB was lost and nobody called tick: AA after more than octet_timeout of silence is a request.
    const ins_hs_config_t cfg = config(true, 3);
    ins_hs_host_t host;
    ASSERT_EQ(ins_hs_host_init(&host, &cfg), INS_OK);
    int16_t reply;
    ins_hs_host_rx(&host, INS_HS_REQUEST, 100, &reply);
    EXPECT_EQ(reply, INS_HS_READY);
    ins_hs_host_rx(&host, INS_HS_REQUEST, 100 + REPLY_TIMEOUT, &reply);
    EXPECT_EQ(reply, INS_HS_READY);
    EXPECT_EQ(host.timeouts, 1u);
    // At once, it is data: sequence numbers from A0h on put Ah there.
    ins_hs_host_rx(&host, INS_HS_REQUEST, 101 + REPLY_TIMEOUT, &reply);
    EXPECT_EQ(reply, -1);
    EXPECT_EQ(host.count, 1);
}

TEST(handshake, a_host_that_starts_in_the_middle_of_a_frame_gets_the_next_block)
{
    for (int start = 0; start < 2 * REPLY_TIMEOUT; start++)
    {
        Link link(config(true, 5));
        unsigned n = 0xA00; // data octets full of Ah
        for (int t = 0; t < 30 * PERIOD; t++)
        {
            if (t == start)
            {
                const ins_hs_config_t cfg = link.host.cfg;
                ins_hs_host_init(&link.host, &cfg);
                link.delivered.clear();
            }
            if (!ins_hs_board_busy(&link.board) && t % PERIOD == 0)
            {
                ins_hs_board_offer(&link.board, block_number(n).data(), static_cast<uint_least8_t>(n), link.now);
                n++;
            }
            link.tick();
        }
        ASSERT_GE(link.delivered.size(), 29u) << "restart at " << start;
        EXPECT_EQ(link.delivered.back(), block_number(n - 1));
        EXPECT_EQ(link.board.given_up, 0);
    }
}

TEST(handshake, bad_lines_lose_blocks_but_count_every_one)
{
    long undetected = 0;
    long delivered = 0;
    long lost = 0;
    long duplicates = 0;
    for (int run = 0; run < RANDOM_RUNS; run++)
    {
        std::mt19937 random(static_cast<unsigned>(run));
        SCOPED_TRACE("seed " + std::to_string(run));
        const double drop = 0.03 * (run % 4);
        const double flip = 0.02 * (run / 4 % 3);
        const double twice = 0.01 * (run / 12 % 2);
        const double stall = 0.02 * (run / 24 % 2);
        const auto chance = [&](double p) { return std::uniform_real_distribution<double>(0, 1)(random) < p; };
        Link link(config(true, static_cast<uint_least8_t>(run % 5)));
        bool clean = false;
        std::map<std::deque<std::pair<uint16_t, ins_octet_t>>*, uint16_t> free_at; // octets stay in order
        link.line = [&](auto& queue, uint16_t at, ins_octet_t octet) {
            if (!clean)
            {
                if (chance(drop))
                {
                    return;
                }
                if (chance(flip))
                {
                    octet = static_cast<ins_octet_t>(octet ^ (1u << (random() % 8)));
                }
                if (chance(stall))
                {
                    at = static_cast<uint16_t>(at + random() % (2 * REPLY_TIMEOUT));
                }
            }
            if (!queue.empty() && static_cast<int16_t>(at - queue.back().first) < 0)
            {
                at = queue.back().first;
            }
            queue.push_back({at, octet});
            if (!clean && chance(twice))
            {
                queue.push_back({at, octet});
            }
        };
        unsigned offered = 0;
        for (int t = 0; offered < RANDOM_BLOCKS; t++)
        {
            clean = offered <= 1 ||
                    offered > RANDOM_BLOCKS - 10; // a clean start fixes the count, a clean end shows recovery
            if (t % PERIOD == 0 && !ins_hs_board_busy(&link.board))
            {
                ASSERT_EQ(ins_hs_board_offer(&link.board, block_number(offered).data(),
                                             static_cast<uint_least8_t>(offered), link.now),
                          INS_OK);
                offered++;
            }
            link.tick();
            ASSERT_LT(t, 100 * RANDOM_BLOCKS * PERIOD) << "the board hangs";
        }
        link.run(20 * REPLY_TIMEOUT);
        ASSERT_EQ(ins_hs_board_busy(&link.board), 0);
        EXPECT_EQ(link.board.sent + link.board.given_up, offered);
        EXPECT_EQ(link.host.accepted, link.delivered.size());
        bool wrong = false;
        for (size_t i = 0; i < link.delivered.size(); i++)
        {
            wrong = wrong || link.delivered[i] != block_number(link.numbers[i]);
        }
        if (wrong)
        {
            undetected++; // errors that the sum cannot show may also hit the sequence number
            continue;
        }
        ASSERT_FALSE(link.delivered.empty());
        unsigned missing = 0;
        for (size_t i = 1; i < link.delivered.size(); i++)
        {
            ASSERT_GT(link.numbers[i], link.numbers[i - 1]) << "delivered twice or out of order";
            EXPECT_EQ(link.gaps[i], link.numbers[i] - link.numbers[i - 1] - 1);
            missing += link.gaps[i];
        }
        EXPECT_EQ(link.numbers.front(), 0u);
        EXPECT_EQ(link.numbers.back(), offered - 1);
        EXPECT_EQ(link.host.accepted + missing, offered);
        delivered += link.host.accepted;
        lost += missing;
        duplicates += link.host.duplicates;
    }
    std::printf(
        "[ figure   ] %d lines: %ld delivered, %ld lost and counted, %ld duplicates; %ld lines with an error the sum "
        "cannot show\n",
        RANDOM_RUNS, delivered, lost, duplicates, undetected);
    EXPECT_GT(lost, 100);
    EXPECT_GT(duplicates, 100);
    EXPECT_LT(undetected, RANDOM_RUNS / 4);
}

TEST(handshake, any_octets_at_any_time_leave_both_machines_sane)
{
    for (unsigned seed = 1; seed <= 4; seed++)
    {
        std::mt19937 random(seed);
        SCOPED_TRACE("seed " + std::to_string(seed));
        const auto len = static_cast<uint_least8_t>(seed == 4 ? INS_HS_BLOCK_MAX : 3 + seed);
        const ins_hs_config_t cfg = config(seed % 2 == 0, 2, len);
        ins_hs_board_t board;
        ins_hs_host_t host;
        ASSERT_EQ(ins_hs_board_init(&board, &cfg), INS_OK);
        ASSERT_EQ(ins_hs_host_init(&host, &cfg), INS_OK);
        const ins_octet_t likely[] = {0x00, 0xFF, 0xAA, 0xBB};
        Octets block(len);
        uint16_t now = 0;
        unsigned offered = 0;
        for (int i = 0; i < FUZZ_OCTETS; i++)
        {
            now = static_cast<uint16_t>(now + random() % (random() % 16 ? 3 : 2 * REPLY_TIMEOUT));
            const auto octet = static_cast<ins_octet_t>(random() % 2 ? likely[random() % 4] : random() % 256);
            int16_t reply = 99;
            const int event = ins_hs_host_rx(&host, octet, now, &reply);
            ASSERT_TRUE(event >= INS_HS_NOTHING && event <= INS_HS_CORRUPT);
            ASSERT_TRUE(reply == -1 || reply == 0x00 || reply == 0xFF || reply == 0xBB);
            if (random() % 8 == 0)
            {
                ins_hs_host_tick(&host, now);
                ins_hs_board_tick(&board, now);
            }
            offered += ins_hs_board_offer(&board, block.data(), octet, now) == INS_OK;
            const int16_t out = ins_hs_board_tx(&board, now);
            ASSERT_TRUE(out >= -1 && out <= 255);
            ins_hs_board_rx(&board, octet, now);
        }
        EXPECT_GT(host.accepted, 0u);
        EXPECT_GT(host.stray, 0u);
        EXPECT_GT(host.corrupt, 0u);
        EXPECT_EQ(static_cast<uint16_t>(board.sent + board.given_up + ins_hs_board_busy(&board)),
                  static_cast<uint16_t>(offered));
    }
}

TEST(handshake, refuses_settings_that_cannot_work)
{
    ins_hs_board_t board;
    ins_hs_host_t host;
    const auto bad = [&](void (*change)(ins_hs_config_t*), bool for_board, bool for_host) {
        ins_hs_config_t cfg = config(true, 3);
        change(&cfg);
        EXPECT_EQ(ins_hs_board_init(&board, &cfg), for_board ? INS_E_RANGE : INS_OK);
        EXPECT_EQ(ins_hs_host_init(&host, &cfg), for_host ? INS_E_RANGE : INS_OK);
    };
    bad([](ins_hs_config_t*) {}, false, false);
    bad([](ins_hs_config_t* c) { c->block_len = 0; }, true, true);
    bad([](ins_hs_config_t* c) { c->block_len = INS_HS_BLOCK_MAX + 1; }, true, true);
    bad([](ins_hs_config_t* c) { c->block_len = 3; }, true, true); // seq needs 4
    bad([](ins_hs_config_t* c) { c->reply_timeout = 0; }, true, false);
    bad([](ins_hs_config_t* c) { c->octet_timeout = 0; }, false, true);
    bad([](ins_hs_config_t* c) { c->reply_timeout = 40000; }, true, false);
    bad([](ins_hs_config_t* c) { c->octet_timeout = 40000; }, false, true);
    bad([](ins_hs_config_t* c) { c->octet_timeout = c->reply_timeout; }, false, true);
}
