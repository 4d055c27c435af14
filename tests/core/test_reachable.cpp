/// \file   test_reachable.cpp
/// \brief  Handshake and extended link, both sides: every state they can reach, with every octet and event.
///
/// A state's key leaves out what a block holds, but whether its number is the last one's and whether its CRC can still be right;
/// counters; and how long it waited, but nothing, less than the time-out, or more.
/// SPDX-License-Identifier: MIT
#include "handshake_link.h"
#include "reachable.h"
using namespace core_test;

namespace
{
constexpr uint_least8_t LEN = 4;     ///< the shortest block with a sequence number
constexpr uint_least8_t RETRIES = 1; ///< the first try, one more, none left
constexpr int MOVES_MAX = 1000;      ///< of an exchange that comes to its end

template <class T> struct Timed
{
    T machine;
    uint16_t now;
};

/// 0: none, 1: less than the time-out, 2: the time-out is over.
unsigned waited(uint16_t now, uint16_t since, unsigned end)
{
    const auto silence = static_cast<uint16_t>(now - since);
    return silence == 0 ? 0 : silence < end ? 1 : 2;
}

const Octets& good_block()
{
    static const Octets block = {0x01, 0xAA, 0x02, 0x55};
    return block;
}

// One set of names for the paper's machines and the extended ones.
const ins_hs_host_t& inner(const ins_hs_host_t& h)
{
    return h;
}
const ins_hs_host_t& inner(const ins_link_host_t& h)
{
    return h.hs;
}
ins_status_t init(ins_hs_board_t& b, const ins_hs_config_t& c)
{
    return ins_hs_board_init(&b, &c);
}
ins_status_t init(ins_link_board_t& b, const ins_hs_config_t& c)
{
    return ins_link_board_init(&b, &c);
}
ins_status_t init(ins_hs_host_t& h, const ins_hs_config_t& c)
{
    return ins_hs_host_init(&h, &c);
}
ins_status_t init(ins_link_host_t& h, const ins_hs_config_t& c)
{
    return ins_link_host_init(&h, &c);
}
ins_status_t offer(ins_hs_board_t& b, unsigned seq, uint16_t now)
{
    return ins_hs_board_offer(&b, good_block().data(), static_cast<uint_least8_t>(seq), now);
}
ins_status_t offer(ins_link_board_t& b, unsigned seq, uint16_t now)
{
    return ins_link_board_offer(&b, good_block().data(), static_cast<uint_least8_t>(seq), now);
}
bool busy(const ins_hs_board_t& b)
{
    return ins_hs_board_busy(&b) != 0;
}
bool busy(const ins_link_board_t& b)
{
    return ins_link_board_busy(&b) != 0;
}
int16_t tx(ins_hs_board_t& b, uint16_t now)
{
    return ins_hs_board_tx(&b, now);
}
int16_t tx(ins_link_board_t& b, uint16_t now)
{
    return ins_link_board_tx(&b, now);
}
void rx(ins_hs_board_t& b, ins_octet_t o, uint16_t now)
{
    ins_hs_board_rx(&b, o, now);
}
void rx(ins_link_board_t& b, ins_octet_t o, uint16_t now)
{
    ins_link_board_rx(&b, o, now);
}
void tick(ins_hs_board_t& b, uint16_t now)
{
    ins_hs_board_tick(&b, now);
}
void tick(ins_link_board_t& b, uint16_t now)
{
    ins_link_board_tick(&b, now);
}
int rx(ins_hs_host_t& h, ins_octet_t o, uint16_t now, int16_t* r)
{
    return ins_hs_host_rx(&h, o, now, r);
}
int rx(ins_link_host_t& h, ins_octet_t o, uint16_t now, int16_t* r)
{
    return ins_link_host_rx(&h, o, now, r);
}
void tick(ins_hs_host_t& h, uint16_t now)
{
    ins_hs_host_tick(&h, now);
}
void tick(ins_link_host_t& h, uint16_t now)
{
    ins_link_host_tick(&h, now);
}

/// The two talk until the board is idle. \return the host's last event that was one, or -1 if the board stays busy.
template <class Board, class Host> int talk(Timed<Board>& b, Host& host)
{
    int last = INS_HS_NOTHING;
    for (int n = 0; n < MOVES_MAX && busy(b.machine); n++)
    {
        b.now++;
        const int16_t out = tx(b.machine, b.now);
        int16_t reply = -1;
        if (out >= 0)
        {
            const int event = rx(host, octet_of(out), b.now, &reply);
            last = event != INS_HS_NOTHING ? event : last;
        }
        else
        {
            tick(host, b.now);
        }
        if (reply >= 0)
        {
            rx(b.machine, octet_of(reply), b.now);
        }
        tick(b.machine, b.now);
    }
    return busy(b.machine) ? -1 : last;
}

/// What is under way comes to an end, and the block after it arrives.
template <class Host, class Board> bool board_recovers(Timed<Board> b, const ins_hs_config_t& cfg)
{
    Host host;
    if (init(host, cfg) != INS_OK || talk(b, host) < 0)
    {
        return false;
    }
    const bool was = offer(b.machine, 0x5C, b.now) == INS_OK;
    return was && talk(b, host) == INS_HS_BLOCK &&
           std::equal(good_block().begin(), good_block().end(), inner(host).block);
}

template <class Board> void board_move(Timed<Board>& b, int n)
{
    switch (n - OCTETS)
    {
    case 0:
        tx(b.machine, b.now);
        break;
    case 1:
        offer(b.machine, 0xA7, b.now);
        break;
    case 2:
        b.now++;
        tick(b.machine, b.now);
        break;
    case 3:
        b.now = static_cast<uint16_t>(b.now + REPLY_TIMEOUT);
        break;
    case 4:
        b.now = static_cast<uint16_t>(b.now + REPLY_TIMEOUT);
        tick(b.machine, b.now);
        break;
    default:
        rx(b.machine, octet_of(n), b.now);
        break;
    }
}
constexpr int BOARD_MOVES = OCTETS + 5;

unsigned board_waits(const ins_hs_board_t& b, uint16_t now, bool waiting)
{
    return waiting ? waited(now, b.since, REPLY_TIMEOUT) : 0;
}

template <class Host> void host_move(Timed<Host>& h, int n)
{
    int16_t reply;
    switch (n - OCTETS)
    {
    case 0:
        h.now++;
        tick(h.machine, h.now);
        break;
    case 1:
        h.now = static_cast<uint16_t>(h.now + OCTET_TIMEOUT + 1);
        break;
    case 2:
        h.now = static_cast<uint16_t>(h.now + OCTET_TIMEOUT + 1);
        tick(h.machine, h.now);
        break;
    default:
        rx(h.machine, octet_of(n), h.now, &reply);
        break;
    }
}
constexpr int HOST_MOVES = OCTETS + 3;

/// After a silence, a board's next block arrives, in the form that the board has.
template <class Board, class Host> bool host_recovers(Timed<Host> h, const ins_hs_config_t& cfg)
{
    h.now = static_cast<uint16_t>(h.now + OCTET_TIMEOUT + 1);
    tick(h.machine, h.now);
    Timed<Board> b = {{}, h.now};
    return init(b.machine, cfg) == INS_OK && offer(b.machine, inner(h.machine).seq + 1u, b.now) == INS_OK &&
           talk(b, h.machine) == INS_HS_BLOCK &&
           std::equal(good_block().begin(), good_block().end(), inner(h.machine).block);
}

/// Has what came of the block the number of the last one, nibble by nibble?
unsigned same_number(const ins_hs_host_t& h)
{
    const auto same = [&](unsigned at, unsigned nibble) { return h.count > at && h.block[at] >> 4 == nibble; };
    return !h.have_seq ? 0u : (same(0, h.seq >> 4) ? 1u : 0u) + (same(2, h.seq & 0x0Fu) ? 2u : 0u);
}

Key host_key(const ins_hs_host_t& h, uint16_t now)
{
    const bool block = h.state == HOST_BLOCK;
    return {h.state,
            block ? h.count : 0u,
            block ? h.tries : 0u,
            h.have_seq,
            block && h.cfg.seq ? same_number(h) : 0u,
            block ? waited(now, h.since, OCTET_TIMEOUT + 1u) : 0u};
}
} // namespace

TEST(reachable, handshake_board)
{
    for (const bool seq : {false, true})
    {
        const ins_hs_config_t cfg = config(seq, RETRIES, LEN);
        using S = Timed<ins_hs_board_t>;
        S start = {{}, 65000};
        ASSERT_EQ(init(start.machine, cfg), INS_OK);
        const auto key = [](const S& s) -> Key
        {
            const ins_hs_board_t& b = s.machine;
            const bool waiting = b.state == BOARD_WAIT_READY || b.state == BOARD_WAIT_ACK;
            return {b.state, b.state == BOARD_FRAME ? b.next : 0u, b.state == BOARD_IDLE ? 0u : b.tries,
                    board_waits(b, s.now, waiting)};
        };
        const auto sound = [](const S& s) { return sound_board(&s.machine) != 0; };
        const auto recovers = [&](const S& s) { return board_recovers<ins_hs_host_t>(s, cfg); };
        const auto seen = Search<S>{BOARD_MOVES, board_move<ins_hs_board_t>, key, sound, recovers}.from(start);
        EXPECT_EQ(column(seen, 0), up_to(BOARD_WAIT_ACK));
        EXPECT_EQ(column(seen, 1), up_to(LEN));
        EXPECT_EQ(column(seen, 2), up_to(RETRIES));
    }
}

TEST(reachable, handshake_host)
{
    for (const bool seq : {false, true})
    {
        const ins_hs_config_t cfg = config(seq, RETRIES, LEN);
        using S = Timed<ins_hs_host_t>;
        S start = {{}, 65000};
        ASSERT_EQ(init(start.machine, cfg), INS_OK);
        const auto key = [](const S& s) { return host_key(s.machine, s.now); };
        const auto sound = [](const S& s) { return sound_host(&s.machine) != 0; };
        const auto recovers = [&](const S& s) { return host_recovers<ins_hs_board_t>(s, cfg); };
        const auto seen = Search<S>{HOST_MOVES, host_move<ins_hs_host_t>, key, sound, recovers}.from(start);
        EXPECT_EQ(column(seen, 0), up_to(HOST_BLOCK));
        EXPECT_EQ(column(seen, 1), up_to(LEN));
        EXPECT_EQ(column(seen, 2), up_to(RETRIES));
        EXPECT_EQ(column(seen, 4), up_to(seq ? 3 : 0));
    }
}

TEST(reachable, link_board)
{
    const ins_hs_config_t cfg = config(true, RETRIES, LEN);
    using S = Timed<ins_link_board_t>;
    S start = {{}, 65000};
    ASSERT_EQ(init(start.machine, cfg), INS_OK);
    const auto key = [](const S& s) -> Key
    {
        const ins_link_board_t& b = s.machine;
        const unsigned state = b.state != BOARD_IDLE ? b.state : b.hs.state;
        const bool waiting = state == BOARD_WAIT_READY || state == BOARD_WAIT_ACK;
        return {b.state, b.hs.state,   state == BOARD_FRAME ? b.hs.next : 0u, busy(b) ? b.hs.tries : 0u,
                b.known, b.paper_left, board_waits(b.hs, s.now, waiting)};
    };
    const auto sound = [](const S& s) { return sound_link_board(&s.machine) != 0; };
    const auto recovers = [&](const S& s)
    { return board_recovers<ins_link_host_t>(s, cfg) && board_recovers<ins_hs_host_t>(s, cfg); };
    const auto seen = Search<S>{BOARD_MOVES, board_move<ins_link_board_t>, key, sound, recovers}.from(start);
    EXPECT_EQ(column(seen, 0), up_to(BOARD_WAIT_ACK));
    EXPECT_EQ(column(seen, 1), up_to(BOARD_WAIT_ACK));
    EXPECT_EQ(column(seen, 2), up_to(LEN + 2));
    EXPECT_EQ(column(seen, 5), up_to(INS_LINK_PROBE_EVERY - 1));
}

TEST(reachable, link_host)
{
    const ins_hs_config_t cfg = config(true, RETRIES, LEN);
    using S = Timed<ins_link_host_t>;
    S start = {{}, 65000};
    ASSERT_EQ(init(start.machine, cfg), INS_OK);
    const auto key = [](const S& s) -> Key
    {
        const ins_link_host_t& h = s.machine;
        if (h.state == 0)
        {
            Key k = host_key(h.hs, s.now);
            k.insert(k.begin(), {0, h.extended});
            return k;
        }
        bool right = false; // can the second octet of the CRC make it so?
        for (int o = 0; h.hs.count == LEN + 2 && o < OCTETS; o++)
        {
            right = right || ins_link_crc(h.crc, octet_of(o)) == 0;
        }
        const bool same = h.hs.count > 0 && h.hs.sum == h.hs.seq;
        return {1, right, h.hs.count, h.hs.tries, h.hs.have_seq, same, waited(s.now, h.hs.since, OCTET_TIMEOUT + 1u)};
    };
    const auto sound = [](const S& s) { return sound_link_host(&s.machine) != 0; };
    const auto recovers = [&](const S& s)
    { return host_recovers<ins_link_board_t>(s, cfg) && host_recovers<ins_hs_board_t>(s, cfg); };
    const auto seen = Search<S>{HOST_MOVES, host_move<ins_link_host_t>, key, sound, recovers}.from(start);
    EXPECT_EQ(column(seen, 0), up_to(1));
    EXPECT_EQ(column(seen, 1), up_to(1));
}
