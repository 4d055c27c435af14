// The link: the handshake's octets, numbering of samples across gaps, and a noisy line against the board's machine of ins_core.
// SPDX-License-Identifier: MIT
#include "ins_nav/nav.h"
#include <cstdlib>
#include <cstring>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <vector>

namespace
{
/// A board that is always in time: one exchange per block, each octet a millisecond.
class Exchange
{
  public:
    explicit Exchange(const ins_nav_config_t& cfg) : block_len(cfg.block_len), seq_on(cfg.seq)
    {
        EXPECT_EQ(ins_nav_init(&nav, &cfg), INS_OK);
    }

    std::vector<uint8_t> block(uint8_t seq, const std::vector<uint16_t>& code) const
    {
        std::vector<uint8_t> b(block_len);
        for (size_t i = 0; i < 3; i++)
        {
            b[2 * i] = static_cast<uint8_t>(code[i] >> 8);
            b[2 * i + 1] = static_cast<uint8_t>(code[i] & 0xFF);
        }
        if (seq_on)
        {
            b[0] = static_cast<uint8_t>(b[0] | (seq & 0xF0));
            b[2] = static_cast<uint8_t>(b[2] | (seq << 4 & 0xF0));
        }
        return b;
    }

    /// \return new states; `replies` are the host's octets.
    int send(uint8_t seq, const std::vector<uint16_t>& code, uint64_t at_ms, uint8_t spoil = 0)
    {
        const auto b = block(seq, code);
        uint8_t sum = spoil;
        replies.clear();
        int states = octet(INS_HS_REQUEST, at_ms);
        for (const uint8_t o : b)
        {
            sum = static_cast<uint8_t>(sum + o);
            states += octet(o, at_ms);
        }
        return states + octet(sum, at_ms);
    }

    int octet(unsigned o, uint64_t at_ms)
    {
        int reply;
        const int got = ins_nav_octet(&nav, static_cast<ins_octet_t>(o), at_ms, &reply, &state);
        if (reply >= 0)
        {
            replies.push_back(reply);
        }
        return got;
    }

    ins_nav_t nav;
    ins_nav_state_t state = {};
    std::vector<int> replies;

  private:
    uint8_t block_len;
    uint8_t seq_on;
};

ins_nav_config_t defaults()
{
    ins_nav_config_t cfg;
    ins_nav_config_default(&cfg);
    return cfg;
}

const std::vector<uint16_t> rest = {2048, 2048, 2048};
const std::vector<int> taken = {INS_HS_READY, INS_HS_ACCEPT};

TEST(NavLink, NumbersSamplesBySequence)
{
    Exchange x(defaults());
    ASSERT_EQ(x.send(200, {2048, 2049, 2050}, 1000), 1);
    EXPECT_EQ(x.replies, taken);
    EXPECT_EQ(x.state.index, 0u);
    EXPECT_EQ(x.state.seq, 200u);
    EXPECT_DOUBLE_EQ(x.state.w_ib_b[2], 2 * x.nav.solver.cfg.lsb_rad_s[2]);
    ASSERT_EQ(x.send(201, rest, 1020), 1);
    EXPECT_EQ(x.state.index, 1u);
    ASSERT_EQ(x.send(2, rest, 1020 + 57 * 20), 1); // 201 -> 258: 56 lost, over the wrap of the number
    EXPECT_EQ(x.state.index, 58u);
    EXPECT_EQ(x.state.bridged, 56u);
    EXPECT_EQ(x.state.counts.lost, 56u);
    EXPECT_EQ(x.state.counts.accepted, 3u);
    EXPECT_EQ(x.state.status & INS_NAV_DISAGREE, 0u);
}

// The sequence number alone cannot tell 3 lost from 259: the arrival time can, in spite of its own error.
TEST(NavLink, ArrivalTimeCountsTheRoundsOfTheSequenceNumber)
{
    for (const uint64_t lost : {0u, 3u, 254u, 256u, 257u, 300u, 510u, 513u, 1000u, 25000u})
    {
        for (const int late_ms : {-400, 0, 400})
        {
            if (lost == 0 && late_ms < 0)
            {
                continue; // before the last one
            }
            Exchange x(defaults());
            ASSERT_EQ(x.send(7, rest, 5000), 1);
            const auto seq = static_cast<uint8_t>(7 + lost + 1);
            const int64_t at = 5000 + static_cast<int64_t>(lost + 1) * 20 + late_ms;
            if (at < 5000)
            {
                continue;
            }
            ASSERT_EQ(x.send(seq, rest, static_cast<uint64_t>(at)), 1) << lost;
            EXPECT_EQ(x.state.bridged, lost) << late_ms;
            EXPECT_EQ(x.state.index, lost + 1);
            EXPECT_EQ(x.state.status & INS_NAV_DISAGREE, 0u) << lost << " " << late_ms;
        }
    }
}

// 255 lost: the number is that of the last block, which the handshake takes for a block sent again. The next one sets it right.
TEST(NavLink, ARoundOfExactly256IsSetRightByTheNextBlock)
{
    Exchange x(defaults());
    ASSERT_EQ(x.send(7, rest, 0), 1);
    EXPECT_EQ(x.send(7, rest, 256 * 20), 0);
    EXPECT_EQ(x.replies, taken);
    ASSERT_EQ(x.send(8, rest, 257 * 20), 1);
    EXPECT_EQ(x.state.bridged, 256u);
    EXPECT_EQ(x.state.index, 257u);
}

TEST(NavLink, ARestartedBoardIsFlagged)
{
    Exchange x(defaults());
    ASSERT_EQ(x.send(7, rest, 0), 1);
    ASSERT_EQ(x.send(8, rest, 20), 1);
    EXPECT_EQ(x.state.status & INS_NAV_DISAGREE, 0u);
    ASSERT_EQ(x.send(0, rest, 1020), 1); // the number says 247 lost, the clock 49
    EXPECT_NE(x.state.status & INS_NAV_DISAGREE, 0u);
    ASSERT_EQ(x.send(1, rest, 1040), 1);
    EXPECT_NE(x.state.status & INS_NAV_DISAGREE, 0u) << "stays";
}

TEST(NavLink, WithoutSequenceNumberEverySampleIsTheNext)
{
    ins_nav_config_t cfg = defaults();
    cfg.seq = 0;
    Exchange x(cfg);
    for (unsigned k = 0; k < 5; k++)
    {
        ASSERT_EQ(x.send(0, rest, 60000 * k), 1);
        EXPECT_EQ(x.state.index, k);
    }
    EXPECT_EQ(x.state.counts.lost, 0u);
}

TEST(NavLink, DuplicatesAreAcknowledgedAndNotIntegrated)
{
    Exchange x(defaults());
    ASSERT_EQ(x.send(7, {2048, 2048, 3000}, 0), 1);
    ASSERT_EQ(x.send(8, {2048, 2048, 3000}, 20), 1);
    const ins_nav_solver_t before = x.nav.solver;
    EXPECT_EQ(x.send(8, {2048, 2048, 3000}, 24), 0);
    EXPECT_EQ(x.replies, taken);
    EXPECT_EQ(std::memcmp(&before, &x.nav.solver, sizeof before), 0);
    ASSERT_EQ(x.send(9, {2048, 2048, 3000}, 40), 1);
    EXPECT_EQ(x.state.counts.duplicates, 1u);
    EXPECT_EQ(x.state.index, 2u);
}

TEST(NavLink, WrongSumsAndHalfBlocksAreCounted)
{
    Exchange x(defaults());
    EXPECT_EQ(x.send(0, rest, 0, 1), 0);
    EXPECT_EQ(x.replies, (std::vector<int>{INS_HS_READY, INS_HS_RESEND}));
    ins_nav_tick(&x.nav, 50);
    x.octet(INS_HS_REQUEST, 100);
    x.octet(0x08, 101);
    ins_nav_tick(&x.nav, 130);
    x.octet(0x55, 140);
    ASSERT_EQ(x.send(0, rest, 200), 1);
    EXPECT_EQ(x.state.counts.corrupt, 1u);
    EXPECT_EQ(x.state.counts.timeouts, 2u); // the resend that did not come, and the half block
    EXPECT_EQ(x.state.counts.stray, 1u);
}

// A board with sequence numbers against a host without: their bits make codes above 4095, which are no samples.
TEST(NavLink, CodesAboveFullScaleAreInvalidNotIntegrated)
{
    ins_nav_config_t cfg = defaults();
    cfg.seq = 0;
    Exchange x(cfg);
    EXPECT_EQ(x.send(0, {0x1800, 2048, 2048}, 0), 0);
    ASSERT_EQ(x.send(0, rest, 20), 1);
    EXPECT_EQ(x.state.index, 0u) << "the first sample is the first good one";
    EXPECT_EQ(x.send(0, {2048, 2048, 0x1800}, 40), 0);
    ASSERT_EQ(x.send(0, rest, 60), 1);
    EXPECT_EQ(x.state.index, 2u);
    EXPECT_EQ(x.state.bridged, 1u);
    EXPECT_EQ(x.state.counts.invalid, 2u);
    EXPECT_EQ(x.state.counts.lost, 1u);
}

TEST(NavLink, LongBlocksCarryTheChannelsFirst)
{
    ins_nav_config_t cfg = defaults();
    cfg.block_len = INS_HS_BLOCK_MAX;
    Exchange x(cfg);
    ASSERT_EQ(x.send(0, {2047, 2048, 2049}, 0), 1);
    EXPECT_LT(x.state.w_ib_b[0], 0);
    EXPECT_EQ(x.state.w_ib_b[1], 0);
    EXPECT_GT(x.state.w_ib_b[2], 0);
}

/// A line of 9600 Bd with bit errors, lost octets and a cut between ins_hs_board_t and the link, in steps of one octet time.
class NoisyLine
{
  public:
    static constexpr double octet_ms = 10.0 / 9.6;

    NoisyLine(uint32_t seed, double bit_error_, double octet_loss_)
        : random(seed), bit_error(bit_error_), octet_loss(octet_loss_)
    {
    }

    int pass(int octet, double t_ms)
    {
        if (octet < 0 || (t_ms >= cut_from_ms && t_ms < cut_to_ms) || uniform(random) < octet_loss)
        {
            return -1;
        }
        for (int bit = 0; bit < 8; bit++)
        {
            octet ^= uniform(random) < bit_error ? 1 << bit : 0;
        }
        return octet;
    }

    double cut_from_ms = 0;
    double cut_to_ms = 0;

  private:
    std::mt19937 random;
    std::uniform_real_distribution<double> uniform{0, 1};
    double bit_error;
    double octet_loss;
};

unsigned count_of(const char* variable, unsigned usual)
{
    const char* text = std::getenv(variable);
    return text == nullptr ? usual : static_cast<unsigned>(std::strtoul(text, nullptr, 10));
}

TEST(NavLink, OnANoisyLineEverySampleIsAcceptedOrCountedAsLost)
{
    const unsigned samples = count_of("INS_NAV_NOISY_SAMPLES", 5000);
    for (const uint32_t seed : {1u, 2u, 3u})
    {
        SCOPED_TRACE("seed " + std::to_string(seed));
        NoisyLine line(seed, 1e-4, 1e-3);
        line.cut_from_ms = 20.0 * samples / 2;
        line.cut_to_ms = line.cut_from_ms + 12000; // more than two rounds of the sequence number
        ins_hs_config_t hs = {};
        hs.block_len = 6;
        hs.seq = 1;
        hs.retries = 3;
        hs.octet_timeout = 5;
        hs.reply_timeout = 10;
        ins_nav_config_t cfg = defaults();
        cfg.octet_timeout_ms = 5;
        ins_hs_board_t board;
        ASSERT_EQ(ins_hs_board_init(&board, &hs), INS_OK);
        ins_nav_t nav;
        ASSERT_EQ(ins_nav_init(&nav, &cfg), INS_OK);
        unsigned made = 0;
        int64_t first = -1; // the sample that became index 0
        ins_nav_state_t state = {};
        std::map<uint64_t, unsigned> integrated;
        unsigned wrong = 0;
        for (unsigned slot = 0; made < samples || slot * line.octet_ms < 20.0 * samples + 200; slot++)
        {
            const double t_ms = slot * line.octet_ms;
            const auto now = static_cast<uint16_t>(static_cast<uint64_t>(t_ms) & 0xFFFF);
            if (made < samples && t_ms >= 20.0 * made)
            {
                // The block tells its number: its low 12 bits in X, the rest in Y.
                const uint8_t b[6] = {static_cast<uint8_t>(made >> 8 & 0x0F),
                                      static_cast<uint8_t>(made & 0xFF),
                                      static_cast<uint8_t>(made >> 20 & 0x0F),
                                      static_cast<uint8_t>(made >> 12 & 0xFF),
                                      8,
                                      0};
                (void)ins_hs_board_offer(&board, b, static_cast<uint8_t>(made & 0xFF), now); // busy: the sample is lost
                made++;
            }
            ins_hs_board_tick(&board, now);
            const int up = line.pass(ins_hs_board_tx(&board, now), t_ms);
            if (up < 0)
            {
                ins_nav_tick(&nav, static_cast<uint64_t>(t_ms));
                continue;
            }
            int reply = -1;
            if (ins_nav_octet(&nav, static_cast<ins_octet_t>(up), static_cast<uint64_t>(t_ms), &reply, &state) == 1)
            {
                const auto code = [&](int i)
                { return std::lround(state.w_ib_b[i] / cfg.lsb_rad_s[i] + cfg.null_code[i]); };
                const int64_t number = code(0) | code(1) << 12;
                first = first < 0 ? number : first;
                wrong += number - first != static_cast<int64_t>(state.index);
                integrated[state.index]++;
            }
            const int down = line.pass(reply, t_ms);
            if (down >= 0)
            {
                ins_hs_board_rx(&board, static_cast<ins_octet_t>(down), now);
            }
        }
        const auto& c = state.counts;
        EXPECT_EQ(state.index + 1, state.used + state.missed);
        EXPECT_EQ(state.used, c.accepted);
        EXPECT_EQ(state.missed, c.lost);
        EXPECT_EQ(integrated.size(), state.used) << "a block was integrated twice";
        EXPECT_EQ(wrong, 0u) << "blocks under a number that is not theirs";
        EXPECT_GT(c.corrupt + c.timeouts, 20u) << "the line is noisy";
        EXPECT_GT(c.duplicates, 0u);
        EXPECT_GE(c.lost, 12000u / 20) << "at least the cut";
        EXPECT_GT(c.accepted, (samples - 12000 / 20) * 9 / 10);
        EXPECT_NE(state.status & INS_NAV_LONG_GAP, 0u);
        EXPECT_EQ(state.status & INS_NAV_DISAGREE, 0u);
        EXPECT_GE(state.index + 1 + static_cast<uint64_t>(first), samples - 1u);
    }
}
} // namespace
