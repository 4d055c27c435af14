/// \file   test_handshake_line.cpp
/// \brief  Both machines over random bad lines, and with octets out of nowhere.
/// SPDX-License-Identifier: MIT
#include "handshake_link.h"
#include <map>
#include <random>
using namespace core_test;

namespace
{
const int RANDOM_RUNS = 400;    // lines, each with its own seed and faults
const int RANDOM_BLOCKS = 150;  // blocks offered per run; below 256, so that sequence numbers do not come round
const int FUZZ_OCTETS = 200000; // random octets into each machine
} // namespace

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
        link.line = [&](auto& queue, uint16_t at, ins_octet_t octet)
        {
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
