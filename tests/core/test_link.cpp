/// \file   test_link.cpp
/// \brief  Extended frame: agreement and fall-back, bad lines, every state with every octet, undetected errors against theory.
/// SPDX-License-Identifier: MIT
#include "handshake_link.h"
#include "undetected.h"
#include <random>
using namespace core_test;
using namespace undetected;

namespace
{
constexpr int BLOCKS = 400;
constexpr long TRIALS = 300000;         ///< damaged frames for each number of wrong bits
constexpr long TRIALS_BENCH = 30000000; ///< with INS_BENCH set

/// Board and host, each new (this module) or old (the paper's), one octet a tick, with a line that may damage octets.
struct Pair
{
    bool new_board, new_host;
    ins_link_board_t board;
    ins_link_host_t host;
    uint16_t now = 65000;
    bool answering = false; ///< the octet in `line` is the host's
    std::deque<ins_octet_t> to_host, to_board;
    std::function<bool(ins_octet_t&)> line = [](ins_octet_t&) { return true; }; ///< false: the octet is lost
    std::vector<Octets> delivered;
    std::vector<bool> extended;

    Pair(bool b, bool h, bool seq = false) : new_board(b), new_host(h)
    {
        ins_hs_config_t cfg = config(seq, 3);
        EXPECT_EQ(ins_link_host_init(&host, &cfg), INS_OK);
        cfg.retries = 6;
        EXPECT_EQ(ins_link_board_init(&board, &cfg), INS_OK);
    }
    void send(std::deque<ins_octet_t>& queue, int16_t octet)
    {
        auto o = static_cast<ins_octet_t>(octet);
        answering = &queue == &to_board;
        if (octet >= 0 && line(o))
        {
            queue.push_back(o);
        }
    }
    bool busy() { return new_board ? ins_link_board_busy(&board) : ins_hs_board_busy(&board.hs); }
    void tick()
    {
        now++;
        send(to_host, new_board ? ins_link_board_tx(&board, now) : ins_hs_board_tx(&board.hs, now));
        if (to_host.empty())
        {
            new_host ? ins_link_host_tick(&host, now) : ins_hs_host_tick(&host.hs, now);
        }
        while (!to_host.empty())
        {
            int16_t reply;
            const ins_octet_t o = to_host.front();
            to_host.pop_front();
            const int event =
                new_host ? ins_link_host_rx(&host, o, now, &reply) : ins_hs_host_rx(&host.hs, o, now, &reply);
            if (event == INS_HS_BLOCK)
            {
                delivered.push_back(Octets(host.hs.block, host.hs.block + LEN));
                extended.push_back(host.extended != 0);
            }
            send(to_board, reply);
        }
        while (!to_board.empty())
        {
            const ins_octet_t o = to_board.front();
            to_board.pop_front();
            new_board ? ins_link_board_rx(&board, o, now) : ins_hs_board_rx(&board.hs, o, now);
        }
        new_board ? ins_link_board_tick(&board, now) : ins_hs_board_tick(&board.hs, now);
    }
    void transfer(unsigned n)
    {
        const Octets block = block_number(n);
        const auto seq = static_cast<uint_least8_t>(n);
        ASSERT_EQ(new_board ? ins_link_board_offer(&board, block.data(), seq, now)
                            : ins_hs_board_offer(&board.hs, block.data(), seq, now),
                  INS_OK);
        for (int t = 0; busy(); t++)
        {
            tick();
            ASSERT_LT(t, 20 * REPLY_TIMEOUT * 12) << "the board hangs";
        }
        for (int t = 0; t < 2 * OCTET_TIMEOUT; t++)
        {
            tick();
        }
    }
};

/// A frame with some bits wrong into a host that waits for it. \return accepted
bool accepts(bool extended, const Octets& frame)
{
    ins_link_host_t host;
    const ins_hs_config_t cfg = config(false, 0);
    EXPECT_EQ(ins_link_host_init(&host, &cfg), INS_OK);
    int16_t reply;
    ins_link_host_rx(&host, extended ? INS_LINK_REQUEST : INS_HS_REQUEST, 0, &reply);
    int event = INS_HS_NOTHING;
    for (const ins_octet_t o : frame)
    {
        event = ins_link_host_rx(&host, o, 0, &reply);
    }
    EXPECT_NE(event, INS_HS_NOTHING);
    return event == INS_HS_BLOCK;
}

Octets random_frame(bool extended, std::mt19937& random)
{
    Octets frame;
    for (unsigned i = 0; i < LEN; i++)
    {
        frame.push_back(static_cast<ins_octet_t>(random() % (i % 2 ? 256 : 16)));
    }
    unsigned sum = 0;
    for (const ins_octet_t o : frame)
    {
        sum += o;
    }
    if (!extended)
    {
        frame.push_back(static_cast<ins_octet_t>(sum & 0xFF));
        return frame;
    }
    frame.insert(frame.begin(), static_cast<ins_octet_t>(random() % 256));
    uint16_t crc = INS_LINK_CRC_START;
    for (const ins_octet_t o : frame)
    {
        crc = ins_link_crc(crc, o);
    }
    frame.push_back(static_cast<ins_octet_t>(crc >> 8));
    frame.push_back(static_cast<ins_octet_t>(crc & 0xFF));
    return frame;
}

void undetected_errors(bool extended, const std::vector<double>& theory)
{
    const unsigned seed = 16;
    const long trials = std::getenv("INS_BENCH") ? TRIALS_BENCH : TRIALS;
    std::mt19937 random(seed);
    const char* const name = extended ? "CRC-16" : "sum";
    std::printf("seed %u, %ld frames of random data for each number of wrong bits\n", seed, trials);
    std::vector<double> measured(FLIPS_MAX + 1, 0);
    const unsigned bits = 8 * (extended ? LEN + 3 : LEN + 1);
    for (unsigned k = 1; k <= FLIPS_MAX; k++)
    {
        long escaped = 0;
        for (long t = 0; t < trials; t++)
        {
            Octets frame = random_frame(extended, random);
            std::vector<unsigned> wrong;
            while (wrong.size() < k)
            {
                const unsigned bit = static_cast<unsigned>(random() % bits);
                if (std::find(wrong.begin(), wrong.end(), bit) == wrong.end())
                {
                    wrong.push_back(bit);
                    frame[bit / 8] = static_cast<ins_octet_t>(frame[bit / 8] ^ (0x80u >> (bit % 8)));
                }
            }
            escaped += accepts(extended, frame);
        }
        measured[k] = static_cast<double>(escaped) / static_cast<double>(trials);
        const double expected = theory[k] * static_cast<double>(trials);
        EXPECT_NEAR(static_cast<double>(escaped), expected, 5 * std::sqrt(expected) + 1e-9)
            << name << ", " << k << " wrong bits";
    }
    for (const double p : {1e-3, 1e-4})
    {
        double rate = 0;
        double want = 0;
        for (unsigned k = 1; k <= FLIPS_MAX; k++)
        {
            const double chance = binomial(bits, k) * std::pow(p, k) * std::pow(1 - p, bits - k);
            rate += chance * measured[k];
            want += chance * theory[k];
        }
        std::printf("[ figure   ] %s, bit errors %.0e: undetected in a frame %.3e, theory %.3e\n", name, p, rate, want);
        if (!extended)
        {
            EXPECT_NEAR(rate, want, 0.05 * want);
        }
    }
}
} // namespace

TEST(link, crc)
{
    uint16_t crc = INS_LINK_CRC_START;
    unsigned reference = 0xFFFF; // bit by bit, as a division
    for (const char c : std::string("123456789"))
    {
        crc = ins_link_crc(crc, static_cast<ins_octet_t>(c));
        for (int bit = 7; bit >= 0; bit--)
        {
            const unsigned out = ((reference >> 15) ^ (static_cast<unsigned>(c) >> bit)) & 1;
            reference = ((reference << 1) & 0xFFFF) ^ (out ? POLYNOMIAL : 0);
        }
    }
    EXPECT_EQ(crc, reference);
    std::printf("CRC of 123456789: %04X\n", crc);
}

/// No two, three, four or five columns cancel, in the longest frame and so in all shorter.
TEST(link, any_five_wrong_bits_are_seen)
{
    const auto s = syndromes(8 * (INS_LINK_BLOCK_MAX + 3));
    std::vector<bool> sums[3] = {std::vector<bool>(65536), std::vector<bool>(65536), std::vector<bool>(65536)};
    for (size_t a = 0; a < s.size(); a++)
    {
        EXPECT_FALSE(sums[0][s[a]]) << "two";
        sums[0][s[a]] = true;
    }
    for (size_t a = 0; a < s.size(); a++)
    {
        for (size_t b = 0; b < a; b++)
        {
            EXPECT_FALSE(sums[0][s[a] ^ s[b]]) << "three";
            EXPECT_FALSE(sums[1][s[a] ^ s[b]]) << "four";
            sums[1][s[a] ^ s[b]] = true;
        }
    }
    for (size_t a = 0; a < s.size(); a++)
    {
        for (size_t b = 0; b < a; b++)
        {
            for (size_t c = 0; c < b; c++)
            {
                ASSERT_FALSE(sums[1][s[a] ^ s[b] ^ s[c]]) << "five";
            }
        }
    }
}

TEST(link, undetected_errors_of_the_crc)
{
    const auto theory = crc_escapes(8 * (LEN + 3));
    for (unsigned k = 1; k < 6; k++)
    {
        EXPECT_EQ(theory[k], 0) << k;
    }
    EXPECT_NEAR(theory[6], 1.0 / 32768, 0.2 / 32768);
    undetected_errors(true, theory);
}

TEST(link, undetected_errors_of_the_sum)
{
    undetected_errors(false, sum_escapes());
}

TEST(link, agreement_and_fall_back)
{
    for (const bool new_board : {false, true})
    {
        for (const bool new_host : {false, true})
        {
            for (const bool seq : {false, true})
            {
                SCOPED_TRACE(std::to_string(new_board) + " " + std::to_string(new_host) + " " + std::to_string(seq));
                Pair link(new_board, new_host, seq);
                for (unsigned n = 0; n < 40; n++)
                {
                    link.transfer(n);
                    ASSERT_EQ(link.delivered.size(), n + 1);
                    ASSERT_EQ(link.delivered.back(), block_number(n));
                    ASSERT_EQ(link.extended.back(), new_board && new_host);
                    ASSERT_EQ(link.host.hs.gap, 0);
                }
                EXPECT_EQ(link.board.hs.sent, 40);
                EXPECT_EQ(link.host.hs.corrupt, 0u);
                EXPECT_EQ(link.board.fallbacks, new_board && !new_host ? 3 : 0) << "at blocks 0, 16 and 32";
                EXPECT_EQ(link.board.extended, new_board && new_host ? 40 : 0);
            }
        }
    }
}

TEST(link, an_old_host_costs_one_time_out)
{
    Pair link(true, false);
    link.transfer(0);
    EXPECT_EQ(link.board.hs.resent, 0) << "a board that was never answered 44 does not ask again";
    EXPECT_EQ(link.board.fallbacks, 1);
    EXPECT_EQ(link.host.hs.stray, 1u);
}

TEST(link, the_host_is_replaced_by_one_that_knows_and_back)
{
    Pair link(true, false, true);
    unsigned n = 0;
    for (; n < 5; n++)
    {
        link.transfer(n);
    }
    link.new_host = true;
    for (; n < 5 + INS_LINK_PROBE_EVERY; n++)
    {
        link.transfer(n);
        EXPECT_EQ(link.host.hs.gap, 0);
    }
    EXPECT_TRUE(link.extended.back()) << "asked again after INS_LINK_PROBE_EVERY blocks";
    link.new_host = false;
    link.transfer(n++);
    EXPECT_EQ(link.delivered.size(), n) << "retries, then the paper's form";
    EXPECT_FALSE(link.board.known);
}

TEST(link, a_lost_answer_makes_a_duplicate_and_gaps_are_counted)
{
    Pair link(true, true);
    link.transfer(7);
    int octets = 0;
    link.line = [&](ins_octet_t& o) { return !(link.answering && o == INS_HS_ACCEPT && octets++ == 0); };
    link.transfer(8);
    EXPECT_EQ(link.delivered.size(), 2u);
    EXPECT_EQ(link.host.hs.duplicates, 1u);
    EXPECT_EQ(link.board.hs.given_up, 0);
    link.line = [](ins_octet_t&) { return true; };
    link.transfer(12);
    EXPECT_EQ(link.host.hs.gap, 3);
    link.line = [](ins_octet_t&) { return false; };
    link.transfer(13);
    EXPECT_EQ(link.board.hs.given_up, 1);
    link.line = [](ins_octet_t&) { return true; };
    for (unsigned n = 14; n < 14 + INS_LINK_PROBE_EVERY; n++)
    {
        link.transfer(n);
    }
    EXPECT_TRUE(link.extended.back());
}

TEST(link, a_request_again_counts_one_time_out)
{
    // 44 was lost and nobody called tick.
    const ins_hs_config_t cfg = config(false, 3);
    ins_link_host_t host;
    ASSERT_EQ(ins_link_host_init(&host, &cfg), INS_OK);
    int16_t reply;
    for (unsigned asked = 0; asked < 3; asked++)
    {
        EXPECT_EQ(ins_link_host_rx(&host, INS_LINK_REQUEST, static_cast<uint16_t>(asked * REPLY_TIMEOUT), &reply),
                  INS_HS_NOTHING);
        EXPECT_EQ(reply, INS_LINK_READY);
        EXPECT_EQ(host.hs.timeouts, asked);
    }
}

/// After a plain block without a number the next frame's is neither that of a duplicate nor after a gap; with one it counts on.
TEST(link, the_number_after_a_plain_block)
{
    for (const bool seq : {false, true})
    {
        Pair link(true, true, seq);
        link.transfer(5);
        link.new_board = false;
        link.transfer(seq ? 6 : 5);
        ASSERT_EQ(link.extended, (std::vector<bool>{true, false})) << seq;
        link.new_board = true;
        link.transfer(seq ? 9 : 5);
        EXPECT_EQ(link.extended, (std::vector<bool>{true, false, true})) << seq;
        EXPECT_EQ(link.host.hs.duplicates, 0u) << seq;
        EXPECT_EQ(link.host.hs.gap, seq ? 2 : 0) << seq;
    }
}

TEST(link, bad_lines)
{
    const unsigned seed = 5544;
    std::printf("seed %u, %d blocks\n", seed, BLOCKS);
    std::mt19937 random(seed);
    const auto chance = [&](double p) { return std::uniform_real_distribution<double>(0, 1)(random) < p; };
    Pair link(true, true);
    link.line = [&](ins_octet_t& o)
    {
        for (unsigned bit = 0; bit < 8; bit++)
        {
            o = static_cast<ins_octet_t>(o ^ (chance(5e-3) ? 1u << bit : 0u));
        }
        return !chance(0.01);
    };
    for (unsigned n = 0; n < BLOCKS; n++)
    {
        link.transfer(n);
        if (HasFatalFailure())
        {
            return;
        }
    }
    size_t extended = 0;
    for (size_t i = 0; i < link.delivered.size(); i++)
    {
        bool right = false;
        for (unsigned n = 0; n < BLOCKS && !right; n++)
        {
            right = link.delivered[i] == block_number(n);
        }
        EXPECT_TRUE(right || !link.extended[i]) << "a wrong block in the extended form";
        extended += link.extended[i];
    }
    EXPECT_GE(link.board.hs.sent + link.board.hs.given_up, BLOCKS);
    EXPECT_GT(link.host.hs.corrupt, 10u);
    EXPECT_GT(extended, BLOCKS / 2u);
    std::printf("delivered %zu, %zu of them extended; corrupt %u, fall-backs %u\n", link.delivered.size(), extended,
                link.host.hs.corrupt, link.board.fallbacks);
}

/// Both machines after each number of ticks of a transfer, with every octet out of nowhere: the next blocks get through.
TEST(link, every_state_with_every_octet)
{
    long cases = 0;
    for (const bool to_board : {false, true})
    {
        for (int ticks = 0; ticks < 16; ticks++)
        {
            for (unsigned octet = 0; octet < 256; octet++)
            {
                Pair link(true, true);
                link.transfer(1);
                const Octets block = block_number(2);
                ASSERT_EQ(ins_link_board_offer(&link.board, block.data(), 2, link.now), INS_OK);
                for (int t = 0; t < ticks; t++)
                {
                    link.tick();
                }
                (to_board ? link.to_board : link.to_host).push_back(static_cast<ins_octet_t>(octet));
                for (int t = 0; link.busy(); t++)
                {
                    link.tick();
                    ASSERT_LT(t, 100 * REPLY_TIMEOUT);
                }
                for (int t = 0; t < 2 * OCTET_TIMEOUT; t++)
                {
                    link.tick();
                }
                link.transfer(3);
                ASSERT_EQ(link.delivered.back(), block_number(3)) << ticks << " " << octet;
                for (const Octets& d : link.delivered)
                {
                    ASSERT_TRUE(d == block_number(1) || d == block || d == block_number(3)) << ticks << " " << octet;
                }
                cases++;
            }
        }
    }
    std::printf("[ figure   ] %ld states with an octet\n", cases);
}

TEST(link, refusals)
{
    ins_link_board_t board;
    ins_link_host_t host;
    for (const unsigned len : {0u, INS_LINK_BLOCK_MAX + 1u, 32u})
    {
        const ins_hs_config_t bad = config(false, 3, static_cast<uint_least8_t>(len));
        EXPECT_EQ(ins_link_board_init(&board, &bad), INS_E_RANGE) << len;
        EXPECT_EQ(ins_link_host_init(&host, &bad), INS_E_RANGE) << len;
    }
    const ins_hs_config_t good = config(false, 3, INS_LINK_BLOCK_MAX);
    ASSERT_EQ(ins_link_host_init(&host, &good), INS_OK);
    const ins_hs_config_t hasty = {INS_LINK_BLOCK_MAX, 0, 3, REPLY_TIMEOUT, 0}; // refused by the machine inside
    EXPECT_EQ(ins_link_host_init(&host, &hasty), INS_E_RANGE);
    EXPECT_EQ(host.hs.cfg.octet_timeout, OCTET_TIMEOUT) << "a refused start leaves the host alone";
    ASSERT_EQ(ins_link_board_init(&board, &good), INS_OK);
    const Octets block(INS_LINK_BLOCK_MAX, 1);
    ASSERT_EQ(ins_link_board_offer(&board, block.data(), 0, 0), INS_OK);
    EXPECT_EQ(ins_link_board_offer(&board, block.data(), 0, 0), INS_E_STATE);
}
