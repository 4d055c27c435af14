/// \file   test_handshake.cpp
/// \brief  The handshake: the reference transcripts, each octet lost or damaged in turn, restarts, refusals.
/// SPDX-License-Identifier: MIT
#include "handshake_link.h"
using namespace core_test;

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
        json accepted;
        EXPECT_EQ(transcript_of(c, &board, &host, &accepted), c["transcript"]) << c.dump();
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
    link.line = [&](auto& queue, uint16_t at, ins_octet_t octet)
    {
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
            link.line = [&](auto& queue, uint16_t at, ins_octet_t octet)
            {
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
        link.line = [&](auto& queue, uint16_t at, ins_octet_t octet)
        {
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
    link.line = [&](auto& queue, uint16_t at, ins_octet_t octet)
    {
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
    // Any other octet that late is data: the block is late, and nothing was lost.
    for (const unsigned octet : {0u, INS_HS_REQUEST - 1u, INS_HS_REQUEST + 1u, 0xFFu})
    {
        ASSERT_EQ(ins_hs_host_init(&host, &cfg), INS_OK);
        ins_hs_host_rx(&host, INS_HS_REQUEST, 100, &reply);
        ins_hs_host_rx(&host, static_cast<ins_octet_t>(octet), 100 + REPLY_TIMEOUT, &reply);
        EXPECT_EQ(host.count, 1) << octet;
        EXPECT_EQ(host.stray + host.timeouts, 0u) << octet;
    }
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

TEST(handshake, refuses_settings_that_cannot_work)
{
    ins_hs_board_t board;
    ins_hs_host_t host;
    const auto bad = [&](void (*change)(ins_hs_config_t*), bool for_board, bool for_host)
    {
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

TEST(handshake, codes_of_a_block_and_the_count_of_wrong_sums)
{
    const ins_octet_t block[6] = {0xF1, 0x02, 0x03, 0xF4, 0x05, 0x06};
    uint16_t codes[3];
    ins_hs_block_codes(block, codes);
    EXPECT_EQ(codes[0], 0x102);
    EXPECT_EQ(codes[1], 0x3F4);
    EXPECT_EQ(codes[2], 0x506);
    ins_hs_host_t host;
    const ins_hs_config_t cfg = config(false, 3);
    ASSERT_EQ(ins_hs_host_init(&host, &cfg), INS_OK);
    int16_t reply;
    ins_hs_host_rx(&host, INS_HS_REQUEST, 0, &reply);
    for (unsigned wrong = 1; wrong <= 2; wrong++)
    {
        for (const ins_octet_t o : block)
        {
            EXPECT_EQ(ins_hs_host_rx(&host, o, 0, &reply), INS_HS_NOTHING);
        }
        EXPECT_EQ(ins_hs_host_rx(&host, 0, 0, &reply), INS_HS_CORRUPT);
        EXPECT_EQ(reply, INS_HS_RESEND);
        EXPECT_EQ(host.corrupt, wrong);
    }
}
