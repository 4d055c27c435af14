/// \file   handshake_link.h
/// \brief  Board and host machines with a line in each direction, whose faults a test sets.
/// SPDX-License-Identifier: MIT
#ifndef INS_TESTS_HANDSHAKE_LINK_H
#define INS_TESTS_HANDSHAKE_LINK_H
#include "core_test.h"
#include <deque>

namespace core_test
{
constexpr uint16_t REPLY_TIMEOUT = 40;
constexpr uint16_t OCTET_TIMEOUT = 10;
constexpr uint16_t PERIOD = 100;

using Octets = std::vector<ins_octet_t>;

inline ins_hs_config_t config(bool seq, uint_least8_t retries, uint_least8_t len = 6)
{
    return {len, static_cast<uint_least8_t>(seq), retries, REPLY_TIMEOUT, OCTET_TIMEOUT};
}

inline std::string hex(const Octets& octets)
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

/// What passes between the two for a case of handshake.json, whose faults the line adds. \param[out] accepted  the block, or null.
inline json transcript_of(const json& c, ins_hs_board_t* board, ins_hs_host_t* host, json* accepted)
{
    *accepted = nullptr;
    std::vector<std::pair<std::string, std::string>> transcript;
    size_t frames = 0;
    Octets frame;
    for (int16_t out; (out = ins_hs_board_tx(board, 0)) >= 0;)
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
                EXPECT_EQ(fault[0], "swap");
                std::swap(frame[at], frame[at + 1]);
            }
        }
        frames += frame.size() == 7;
        transcript.push_back({"A>B", hex(frame)});
        for (const ins_octet_t octet : frame)
        {
            int16_t reply;
            const int event = ins_hs_host_rx(host, octet, 0, &reply);
            if (event == INS_HS_BLOCK)
            {
                *accepted = Octets(host->block, host->block + 6);
            }
            if (reply >= 0)
            {
                transcript.push_back({"B>A", hex({static_cast<ins_octet_t>(reply)})});
                ins_hs_board_rx(board, static_cast<ins_octet_t>(reply), 0);
            }
        }
        frame.clear();
    }
    return transcript;
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
inline Octets block_number(unsigned n)
{
    return {static_cast<ins_octet_t>((n >> 8) & 0x0F), static_cast<ins_octet_t>(n & 0xFF),
            static_cast<ins_octet_t>((n * 7) & 0x0F),  static_cast<ins_octet_t>((n * 13 + 1) & 0xFF),
            static_cast<ins_octet_t>((n * 3) & 0x0F),  static_cast<ins_octet_t>((n * 29 + 0xAA) & 0xFF)};
}
} // namespace core_test

#endif // INS_TESTS_HANDSHAKE_LINK_H
