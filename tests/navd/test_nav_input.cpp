// Blocks of a navigating board to solutions: fields, clock, lost blocks, restarts, a noisy line; their JSON.
// SPDX-License-Identifier: MIT
#include "ins_nav/nav.h"
#include "ins_nav/nav_input.h"
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <random>

namespace
{
const double pi = 3.14159265358979323846;
const uint32_t period_ms = 167;
const size_t noisy_blocks = 4000;

ins_nav_block_t block_at(uint32_t time_ms)
{
    ins_nav_block_t nav = {};
    nav.time_ms = time_ms;
    nav.status = INS_NAV_BLOCK_ALIGNED | INS_NAV_BLOCK_POSITION | INS_NAV_BLOCK_FILTER;
    nav.sats = 7;
    nav.fix_age = 4;
    nav.en_cm[0] = 24712345;
    nav.en_cm[1] = 274321098;
    nav.v_en[0] = -1.5;
    nav.v_en[1] = 12.25;
    nav.q_nb[0] = std::cos(pi / 8); // heading 45 degrees
    nav.q_nb[3] = std::sin(pi / 8);
    return nav;
}

/// A board and the input, octets in between at one a millisecond.
class Exchange
{
  public:
    Exchange()
    {
        ins_nav_input_config_t cfg;
        ins_nav_input_config_default(&cfg);
        EXPECT_EQ(ins_nav_input_init(&input, &cfg), INS_OK);
        const ins_hs_config_t hs = {INS_NAV_BLOCK_LEN, 1, 10, 100, 0};
        EXPECT_EQ(ins_hs_board_init(&board, &hs), INS_OK);
    }

    /// \param[in] fault  what the line makes of an octet. \return solutions
    template <typename Fault> int send(const ins_nav_block_t& nav, uint8_t seq, Fault fault)
    {
        ins_octet_t block[INS_NAV_BLOCK_LEN];
        EXPECT_EQ(ins_nav_block_put(&nav, block), INS_OK);
        return send_octets(block, seq, fault);
    }
    int send(const ins_nav_block_t& nav, uint8_t seq)
    {
        return send(nav, seq, [](int octet) { return octet; });
    }
    template <typename Fault> int send_octets(const ins_octet_t* block, uint8_t seq, Fault fault)
    {
        int solutions = 0;
        EXPECT_EQ(ins_hs_board_offer(&board, block, seq, now()), INS_OK);
        while (ins_hs_board_busy(&board))
        {
            const int octet = ins_hs_board_tx(&board, now());
            now_ms++;
            ins_hs_board_tick(&board, now());
            const int heard = octet < 0 ? -1 : fault(octet);
            silence = heard < 0 ? silence + 1 : 0;
            if (silence > 30)
            {
                ins_nav_input_tick(&input, now_ms);
            }
            int reply = -1;
            solutions += heard >= 0 &&
                         ins_nav_input_octet(&input, static_cast<ins_octet_t>(heard), now_ms, &reply, &solution) == 1;
            const int answer = reply < 0 ? -1 : fault(reply);
            if (answer >= 0)
            {
                ins_hs_board_rx(&board, static_cast<ins_octet_t>(answer), now());
            }
        }
        return solutions;
    }
    uint16_t now() const { return static_cast<uint16_t>(now_ms & 0xFFFF); }

    ins_nav_input_t input;
    ins_hs_board_t board;
    ins_nav_solution_t solution = {};
    uint64_t now_ms = 1000;
    int silence = 0;
};
} // namespace

TEST(NavInput, GivesWhatTheBoardSays)
{
    Exchange line;
    ASSERT_EQ(line.send(block_at(12345), 200), 1);
    const ins_nav_solution_t& s = line.solution;
    EXPECT_EQ(s.index, 0u);
    EXPECT_DOUBLE_EQ(s.t_s, 12.345);
    EXPECT_EQ(s.seq, 200u);
    EXPECT_EQ(s.sats, 7u);
    EXPECT_DOUBLE_EQ(s.fix_age_s, 0.4);
    EXPECT_EQ(s.zone, 121u);
    EXPECT_DOUBLE_EQ(s.en_m[0], 247123.45);
    EXPECT_DOUBLE_EQ(s.en_m[1], 2743210.98);
    EXPECT_DOUBLE_EQ(s.v_en_m_s[0], -1.5);
    EXPECT_DOUBLE_EQ(s.v_en_m_s[1], 12.25);
    EXPECT_NEAR(s.euler_rad[2], pi / 4, 4.2e-7);
    EXPECT_EQ(s.status, INS_NAV_BLOCK_ALIGNED | INS_NAV_BLOCK_POSITION | INS_NAV_BLOCK_FILTER);
    ins_tm_t tm;
    double en[2];
    ASSERT_EQ(ins_tm_init_twd97(&tm, 121), INS_OK);
    ASSERT_EQ(ins_tm_forward(&tm, s.lat_lon_rad[0], s.lat_lon_rad[1], en, nullptr), INS_OK);
    EXPECT_NEAR(en[0], s.en_m[0], 1e-8);
    EXPECT_NEAR(en[1], s.en_m[1], 1e-8);
}

TEST(NavInput, ThePositionIsTheZonesOwnAndNoneWithoutAFix)
{
    Exchange line;
    ins_nav_block_t nav = block_at(0);
    ASSERT_EQ(line.send(nav, 0), 1);
    const double lon_121 = line.solution.lat_lon_rad[1];
    nav.status |= INS_NAV_BLOCK_ZONE_119;
    ASSERT_EQ(line.send(nav, 1), 1);
    EXPECT_EQ(line.solution.zone, 119u);
    EXPECT_NEAR(lon_121 - line.solution.lat_lon_rad[1], 2 * pi / 180, 1e-12);
    nav.status = INS_NAV_BLOCK_ALIGNED;
    ASSERT_EQ(line.send(nav, 2), 1);
    EXPECT_EQ(line.solution.zone, 0u);
    EXPECT_EQ(line.solution.lat_lon_rad[0], 0.0);
    EXPECT_EQ(line.solution.en_m[1], 0.0);
}

TEST(NavInput, LostBlocksAndTheClocksWrapAreBridged)
{
    Exchange line;
    ASSERT_EQ(line.send(block_at(0xFFFFFFF0u), 254), 1);
    ASSERT_EQ(line.send(block_at(0x00000010u), 2), 1); // 255, 0, 1 never came
    EXPECT_EQ(line.solution.lost, 3u);
    EXPECT_EQ(line.solution.index, 4u);
    EXPECT_EQ(line.solution.counts.lost, 3u);
    EXPECT_EQ(line.solution.counts.accepted, 2u);
    EXPECT_DOUBLE_EQ(line.solution.t_s, 4294967.312);
    EXPECT_EQ(line.solution.status & INS_NAV_RESTARTED, 0u);
}

TEST(NavInput, ARestartIsSaidOnceAndIsNoLoss)
{
    Exchange line;
    ASSERT_EQ(line.send(block_at(60000), 100), 1);
    ASSERT_EQ(line.send(block_at(500), 0), 1);
    EXPECT_NE(line.solution.status & INS_NAV_RESTARTED, 0u);
    EXPECT_EQ(line.solution.lost, 0u);
    EXPECT_EQ(line.solution.index, 1u);
    EXPECT_DOUBLE_EQ(line.solution.t_s, 0.5);
    ASSERT_EQ(line.send(block_at(667), 1), 1);
    EXPECT_EQ(line.solution.status & INS_NAV_RESTARTED, 0u);
}

TEST(NavInput, ABlockOfAnotherVersionIsInvalidAndCounted)
{
    Exchange line;
    ASSERT_EQ(line.send(block_at(0), 0), 1);
    ins_octet_t block[INS_NAV_BLOCK_LEN];
    const ins_nav_block_t nav = block_at(167);
    ASSERT_EQ(ins_nav_block_put(&nav, block), INS_OK);
    block[0] = 0x08; // version 2
    EXPECT_EQ(line.send_octets(block, 1, [](int octet) { return octet; }), 0);
    EXPECT_EQ(line.input.counts.invalid, 1u);
    EXPECT_EQ(line.input.counts.lost, 1u);
    ASSERT_EQ(line.send(block_at(334), 2), 1);
    EXPECT_EQ(line.solution.index, 2u);
    EXPECT_EQ(line.solution.lost, 0u);
}

// One octet in 500 is lost and one in 500 is another one: what is given out is right or passed the sum by chance.
TEST(NavInput, OnANoisyLineEachBlockComesOnceAndInOrder)
{
    const unsigned seed = 19200;
    std::mt19937 random(seed);
    Exchange line;
    const auto noise = [&](int octet)
    {
        const auto dice = random() % 500;
        return dice == 0 ? -1 : dice == 1 ? static_cast<int>(random() % 256) : octet;
    };
    uint64_t last_index = 0;
    double last_s = -1;
    size_t solutions = 0;
    for (size_t k = 0; k < noisy_blocks; k++)
    {
        const int got =
            line.send(block_at(static_cast<uint32_t>(k) * period_ms), static_cast<uint8_t>(k & 0xFF), noise);
        ASSERT_LE(got, 1) << "block " << k << " twice, seed " << seed;
        if (got == 1)
        {
            ASSERT_GT(line.solution.t_s, last_s) << "seed " << seed;
            ASSERT_TRUE(solutions == 0 || line.solution.index > last_index) << "seed " << seed;
            ASSERT_DOUBLE_EQ(line.solution.en_m[0], 247123.45) << "block " << k << ", seed " << seed;
            last_s = line.solution.t_s;
            last_index = line.solution.index;
            solutions++;
        }
    }
    EXPECT_GT(solutions, noisy_blocks * 99 / 100);
    EXPECT_GT(line.input.counts.corrupt + line.input.counts.timeouts, noisy_blocks / 100) << "the line was noisy";
    EXPECT_EQ(line.input.counts.accepted, solutions);
}

TEST(NavInput, JsonReadsBackBitForBit)
{
    Exchange line;
    ASSERT_EQ(line.send(block_at(12345), 5), 1);
    line.solution.status = INS_NAV_BLOCK_STATUS_ALL | INS_NAV_RESTARTED;
    char text[INS_NAV_JSON_MAX];
    const size_t length = ins_nav_solution_json(&line.solution, text, sizeof text);
    ASSERT_GT(length, 0u);
    ASSERT_EQ(text[length - 1], '\n');
    const auto json = nlohmann::json::parse(text);
    const auto same = [](const nlohmann::json& got, double want)
    {
        const auto value = got.get<double>();
        return std::memcmp(&value, &want, sizeof want) == 0;
    };
    for (size_t i = 0; i < 4; i++)
    {
        EXPECT_TRUE(same(json["q_nb"][i], line.solution.q_nb[i]));
    }
    for (size_t i = 0; i < 2; i++)
    {
        EXPECT_TRUE(same(json["lat_lon_rad"][i], line.solution.lat_lon_rad[i]));
        EXPECT_TRUE(same(json["en_m"][i], line.solution.en_m[i]));
        EXPECT_TRUE(same(json["v_en_m_s"][i], line.solution.v_en_m_s[i]));
    }
    EXPECT_EQ(json["status"].size(), 12u);
    EXPECT_EQ(json["status"][0], "aligned");
    EXPECT_EQ(json["status"][11], "restarted");
    EXPECT_EQ(json["link"]["accepted"], 1);
    EXPECT_EQ(ins_nav_solution_json(&line.solution, text, length), 0u) << "no room for the final 0";
}

TEST(NavInput, AConfigurationThatIsNoneIsRefused)
{
    ins_nav_input_t input;
    ins_nav_input_config_t cfg;
    ins_nav_input_config_default(&cfg);
    cfg.octet_timeout_ms = 0;
    EXPECT_EQ(ins_nav_input_init(&input, &cfg), INS_E_RANGE);
    cfg.octet_timeout_ms = 32768;
    EXPECT_EQ(ins_nav_input_init(&input, &cfg), INS_E_RANGE);
}
